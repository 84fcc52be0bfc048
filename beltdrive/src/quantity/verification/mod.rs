//! What there is to tell of published results and those recomputed.

pub(crate) mod figures;
pub(crate) mod notes;
#[cfg(test)]
pub(crate) mod sample;
pub(crate) mod words;

use super::{Answer, Group, Layout, Measure, Quantity, Subject, Value};
use crate::verify::{Comparison, Criterion, Section, Source, Verdict, Verification};
use notes::Notes;

/// Every published number beside the computed one: a table for each section of a source, with numbered notes.
pub fn answer(verification: &Verification) -> Answer {
    let summary = words::summary(verification);
    let sources = verification.sources.iter();
    let described = sources
        .clone()
        .map(|source| Subject::new("", self::source(source)));
    let mut groups = vec![
        Group::single("", counts(verification)),
        Group::new("sources", Layout::Columns, described.collect()),
        Group::new("", Layout::Rows, rows(verification)),
    ];
    let mut notes = Notes::default();
    for source in sources {
        let method = Quantity::word("", source.title, source.method.to_owned());
        groups.push(Group::new(
            "",
            Layout::Rows,
            vec![Subject::new("", vec![method])],
        ));
        let sections = source.sections.iter();
        groups.extend(sections.map(|section| table(section, &mut notes)));
    }
    let numbered = notes.after(0);
    let numbered = numbered.map(|(number, text)| format!("{:<4} {text}", format!("[{number}]")));
    let mut below: Vec<_> = numbered.collect();
    below.push(String::new());
    below.extend(LEGEND.map(str::to_owned));
    below.extend([String::new(), summary.clone()]);
    let title = format!("Published results, recomputed with {}", words::PROGRAM);
    Answer {
        heading: vec![title, summary],
        groups,
        notes: below,
        ..Answer::default()
    }
}

const LEGEND: [&str; 4] = [
    "agrees   computed and published differ by at most half a unit of the last printed digit",
    "in band  they differ by at most the band that the source is given, as digits are no measure there",
    "known    they differ for the reason in the note, and the computed number is the expected one",
    "DIFFERS  nothing explains the difference",
];

fn text(key: &'static str, text: &str) -> Quantity {
    Quantity::word(key, "", text.to_owned())
}

fn number(key: &'static str, number: impl Into<Option<f64>>) -> Quantity {
    Quantity::number(key, "", Measure::Number, number, 0.0)
}

fn list(key: &'static str, subjects: impl Iterator<Item = Vec<Quantity>>) -> Quantity {
    let subjects = subjects.map(|quantities| Subject::new("", quantities));
    Quantity::data(key, Measure::Number, Value::List(subjects.collect()))
}

/// The program and how many numbers have which verdict, for programs.
fn counts(verification: &Verification) -> Vec<Quantity> {
    let count = |key, verdict| Quantity::count(key, "", verification.count(verdict));
    vec![
        text("program", words::PROGRAM),
        count("agree", Verdict::Agrees),
        count("within_band", Verdict::Within),
        count("known", Verdict::Known),
        count("unexplained", Verdict::Differs),
    ]
}

/// A source, for programs.
fn source(source: &Source) -> Vec<Quantity> {
    let section = |section: &Section| {
        let comparisons = section.comparisons.iter().map(comparison);
        vec![
            text("title", section.title),
            list("comparisons", comparisons),
        ]
    };
    vec![
        text("title", source.title),
        text("citation", source.citation),
        text("method", source.method),
        list("sections", source.sections.iter().map(section)),
    ]
}

/// A published number and the computed one, for programs.
fn comparison(comparison: &Comparison) -> Vec<Quantity> {
    let [band, expected, tolerance] = match comparison.criterion {
        Criterion::Digits => [None; 3],
        Criterion::Band { width } => [Some(width), None, None],
        Criterion::Known {
            expected,
            tolerance,
            ..
        } => [None, Some(expected), Some(tolerance)],
    };
    let published = comparison.published;
    vec![
        text("quantity", comparison.quantity),
        text("unit", comparison.unit),
        // It says how many digits are known.
        text("published", published.text()),
        number("published_value", published.value()),
        number("half_unit", published.half_unit()),
        number("computed", comparison.computed.as_ref().ok().copied()),
        number("deviation", comparison.deviation()),
        number("relative_deviation", comparison.relative_deviation()),
        text("verdict", words::verdict(comparison)),
        text("criterion", words::criterion(comparison)),
        number("band", band),
        number("expected", expected),
        number("expected_tolerance", tolerance),
        Quantity::word("note", "", comparison.note()),
    ]
}

/// A row for each number, for programs.
fn rows(verification: &Verification) -> Vec<Subject> {
    let sources = verification.sources.iter();
    let sections = sources.flat_map(|source| source.sections.iter().map(move |of| (source, of)));
    let rows = sections.flat_map(|(source, section)| {
        section.comparisons.iter().map(move |comparison| {
            let place = [text("source", source.title), text("section", section.title)];
            let row = place.into_iter().chain(self::comparison(comparison));
            Subject::new("", row.collect())
        })
    });
    rows.collect()
}

/// The numbers of a section, for people.
fn table(section: &Section, notes: &mut Notes) -> Group {
    let rows = section.comparisons.iter().map(|comparison| {
        let note = notes.number(comparison);
        let note = note.map_or_else(String::new, |number| format!(" [{number}]"));
        let verdict = match comparison.verdict() {
            Verdict::Agrees => "agrees",
            Verdict::Within => "in band",
            Verdict::Known => "known",
            Verdict::Differs => "DIFFERS",
        };
        let cell = |label: &'static str, text: &str| Quantity::word("", label, text.to_owned());
        let quantities = vec![
            cell(section.title, comparison.quantity),
            cell("unit", comparison.unit),
            cell("published", comparison.published.text()),
            cell("computed", &figures::computed(comparison)),
            cell("deviation", &figures::deviation(comparison)),
            cell("relative", &figures::relative(comparison)),
            cell("verdict", &(verdict.to_owned() + &note)),
        ];
        // All are shown.
        Subject::new(comparison.quantity, quantities)
    });
    Group::new("", Layout::Rows, rows.collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::quantity::UnitSystem;
    use crate::report::{csv, json, table};

    #[test]
    fn the_table_is_grouped_noted_and_summed_up() {
        let text = table(&answer(&sample::mixed()), UnitSystem::Engineering);
        let text = text.replace(words::PROGRAM, "PROGRAM");
        insta::assert_snapshot!(text, @r"
        Published results, recomputed with PROGRAM
        2 agree to the printed digits, 1 within a stated band, 1 known why, 2 unexplained

        Author
        (2001)
        closed form

        Table 1, a    unit   published  computed  deviation  relative  verdict
        transition    rad         2.34    2.3435    +0.0035  +0.150 %  agrees
        driven speed  rad/s      11.34    11.308     -0.032  -0.282 %  in band
        load          N            380   373.205       -6.8  -1.788 %  known [1]
        wrap angle    °            180       180          0  +0.000 %  agrees [2]

        Other (2002)
        boundary value problem

        Text       unit  published  computed  deviation  relative  verdict
        load       N           380     373.3       -6.7  -1.763 %  DIFFERS [3]
        mass flow  kg/s        2.8         –          –         –  DIFFERS [4]

        [1]  read off a plot
        [2]  of the driver
        [3]  373.205 ± 0.001 is expected here, and would differ for this reason: read off a plot
        [4]  not computed: no steady state

        agrees   computed and published differ by at most half a unit of the last printed digit
        in band  they differ by at most the band that the source is given, as digits are no measure there
        known    they differ for the reason in the note, and the computed number is the expected one
        DIFFERS  nothing explains the difference

        2 agree to the printed digits, 1 within a stated band, 1 known why, 2 unexplained
        ");
    }

    #[test]
    fn json_is_complete() {
        let text = json(&answer(&sample::mixed()));
        let report: serde_json::Value = serde_json::from_str(&text).unwrap();
        let counts = ["agree", "within_band", "known", "unexplained"];
        assert_eq!(
            counts.map(|count| report[count].as_u64().unwrap()),
            [2, 1, 1, 2]
        );
        let rows = &report["sources"][0]["sections"][0]["comparisons"];
        assert_eq!(
            (&rows[0]["published"], &rows[0]["half_unit"]),
            (&"2.34".into(), &0.005.into())
        );
        assert_eq!(
            [&rows[2]["verdict"], &rows[2]["note"]],
            ["known", "read off a plot"]
        );
        assert_eq!(
            [&rows[2]["expected"], &rows[2]["expected_tolerance"]],
            [373.205, 0.001]
        );
        let missing = &report["sources"][1]["sections"][0]["comparisons"][1];
        assert!(missing["computed"].is_null() && missing["deviation"].is_null());
    }

    #[test]
    fn csv_has_a_row_for_each_number() {
        let text = csv(&answer(&sample::mixed()));
        let lines: Vec<_> = text.lines().collect();
        assert_eq!(lines.len(), 7);
        let first = "Author (2001),\"Table 1, a\",transition,rad,2.34,2.34,";
        assert!(lines[1].starts_with(first), "{text}");
        assert!(
            lines[3].ends_with(",known,known difference,,373.205,0.001,read off a plot"),
            "{text}"
        );
        assert!(
            lines[6].ends_with(",differs,digits,,,,not computed: no steady state"),
            "{text}"
        );
    }
}
