//! A verification as a table for a terminal.

use super::notes::Notes;
use super::{figures, words};
use crate::report::lines::{self, wrapped};
use crate::verify::{Comparison, Section, Source, Verdict, Verification};

/// Every published number beside the computed one, by source, with numbered notes, on lines of at most
/// 100 columns.
pub fn table(verification: &Verification) -> String {
    let mut notes = Notes::default();
    let mut blocks = vec![vec![
        format!("Published results, recomputed with {}", words::PROGRAM),
        words::summary(verification),
    ]];
    for source in &verification.sources {
        blocks.extend(self::source(source, &mut notes));
    }
    blocks.push(legend());
    blocks.push(vec![words::summary(verification)]);
    lines::text(blocks)
}

/// The blocks of a source.
fn source(source: &Source, notes: &mut Notes) -> Vec<Vec<String>> {
    let before = notes.len();
    let title = source.title.to_owned();
    let rule = "─".repeat(title.chars().count());
    let mut blocks = vec![[vec![title, rule], wrapped("", source.method)].concat()];
    blocks.push(vec![header()]);
    for section in &source.sections {
        blocks.push(self::section(section, notes));
    }
    let texts = notes.after(before);
    blocks.push(
        texts
            .flat_map(|(number, text)| wrapped(&format!("{:<5}", format!("[{number}]")), text))
            .collect(),
    );
    blocks
}

fn section(section: &Section, notes: &mut Notes) -> Vec<String> {
    let rows = section.comparisons.iter().map(|comparison| {
        let number = notes.number(comparison);
        row(comparison, number)
    });
    [section.title.to_owned()].into_iter().chain(rows).collect()
}

/// The columns: quantity, unit, published, computed, deviation, the same relatively, verdict.
fn columns(texts: [&str; 7]) -> String {
    let [
        quantity,
        unit,
        published,
        computed,
        deviation,
        relative,
        verdict,
    ] = texts;
    format!(
        "{quantity:<40}{unit:<6}{published:>9}{computed:>11}{deviation:>10}{relative:>11} {verdict}"
    )
}

fn header() -> String {
    columns([
        "",
        "",
        "published",
        "computed",
        "deviation",
        "relative",
        "verdict",
    ])
}

fn row(comparison: &Comparison, note: Option<usize>) -> String {
    let verdict = match comparison.verdict() {
        Verdict::Agrees => "agrees",
        Verdict::Within => "in band",
        Verdict::Known => "known",
        Verdict::Differs => "DIFFERS",
    };
    let note = note.map_or_else(String::new, |number| format!(" [{number}]"));
    columns([
        &format!("  {}", comparison.quantity),
        comparison.unit,
        comparison.published.text(),
        &figures::computed(comparison),
        &figures::deviation(comparison),
        &figures::relative(comparison),
        &(verdict.to_owned() + &note),
    ])
}

fn legend() -> Vec<String> {
    [
        "agrees   computed and published differ by at most half a unit of the last printed digit",
        "in band  they differ by at most the band that the source is given, as digits are no measure there",
        "known    they differ for the reason in the note, and the computed number is the expected one",
        "DIFFERS  nothing explains the difference",
    ]
    .map(str::to_owned)
    .to_vec()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::verification::sample;

    #[test]
    fn the_table_is_grouped_noted_and_summed_up() {
        let text = table(&sample::mixed()).replace(words::PROGRAM, "PROGRAM");
        insta::assert_snapshot!(text, @r"
        Published results, recomputed with PROGRAM
        2 agree to the printed digits, 1 within a stated band, 1 known why, 2 unexplained

        Author (2001)
        ─────────────
        closed form

                                                      published   computed deviation   relative verdict

        Table 1, a
          transition                            rad        2.34     2.3435   +0.0035   +0.150 % agrees
          driven speed                          rad/s     11.34     11.308    -0.032   -0.282 % in band
          load                                  N           380    373.205      -6.8   -1.788 % known [1]
          wrap angle                            °           180        180         0   +0.000 % agrees [2]

        [1]  read off a plot
        [2]  of the driver

        Other (2002)
        ────────────
        boundary value problem

                                                      published   computed deviation   relative verdict

        Text
          load                                  N           380      373.3      -6.7   -1.763 % DIFFERS [3]
          mass flow                             kg/s        2.8          –         –          – DIFFERS [4]

        [3]  373.205 ± 0.001 is expected here, and would differ for this reason: read off a plot
        [4]  not computed: no steady state

        agrees   computed and published differ by at most half a unit of the last printed digit
        in band  they differ by at most the band that the source is given, as digits are no measure there
        known    they differ for the reason in the note, and the computed number is the expected one
        DIFFERS  nothing explains the difference

        2 agree to the printed digits, 1 within a stated band, 1 known why, 2 unexplained
        ");
    }
}
