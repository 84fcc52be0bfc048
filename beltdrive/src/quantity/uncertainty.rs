//! What there is to tell of how far an answer may be from its value.

use super::precision::six_digits;
use super::{Answer, Group, Layout, Measure, Quantity, Subject, UnitSystem};
use crate::LoadCase;
use crate::input::{Spread, Uncertain};
use crate::uncertainty::{Band, Distribution, Number, Uncertainty};
use serde_json::{Value as Json, json};

/// Digits of a band.
const DIGITS: u8 = 4;

/// An answer with the bands of its numbers, in these load cases.
#[must_use]
pub fn told_in(mut answer: Answer, found: &Uncertainty, cases: &[LoadCase]) -> Answer {
    if found.inputs.is_empty() {
        return answer;
    }
    let names: Vec<_> = cases.iter().map(|case| case.name.as_str()).collect();
    answer.groups.push(inputs(found));
    for of_case in found.bands.chunk_by(|one, other| one.case == other.case) {
        answer.groups.push(bands(of_case, found.samples, &names));
        if found.inputs.len() > 1 {
            answer.groups.push(causes(of_case, &found.inputs));
        }
    }
    if !found.holds.is_empty() {
        answer.groups.push(holds(found, &names));
    }
    answer.remarks.extend(remarks(found, &names));
    answer
        .groups
        .push(Group::single("uncertainty", data(found, &names)));
    answer
}

/// A number of an answer: its key, and what it is called.
fn named(number: Number) -> (&'static str, &'static str, Measure) {
    match number {
        Number::SlipMargin => ("slip_margin", "slip margin", Measure::Number),
        Number::SpeedLoss => ("speed_loss", "speed loss", Measure::Share),
        Number::Efficiency => ("efficiency", "efficiency", Measure::Share),
        Number::PowerLoss => ("power_loss", "power lost", Measure::Loss),
        Number::HubLoad => ("largest_hub_load", "hub load", Measure::Force),
        Number::RestHubLoad => ("largest_hub_load_rest", "hub load at rest", Measure::Force),
        Number::BestSpeed => (
            "optimum.speed",
            "speed of largest power",
            Measure::AngularSpeed,
        ),
        Number::BestTorque => ("optimum.torque", "torque there", Measure::Torque),
        Number::BestPower => ("optimum.power", "largest power", Measure::Power),
        Number::StatedTorque => (
            "stated.torque",
            "largest torque, drive file",
            Measure::Torque,
        ),
        Number::StatedPower => ("stated.power", "largest power, drive file", Measure::Power),
        Number::LiftOffSpeed => ("end_speed", "speed of lift-off", Measure::AngularSpeed),
        Number::SetupTension => ("tension", "belt tension at rest", Measure::Force),
    }
}

/// The label of a band, with its load case where there are several.
fn label(band: &Band, names: &[&str]) -> String {
    let (_, label, _) = named(band.number);
    match (band.case, names) {
        (Some(case), [_, _, ..]) => format!("{}: {label}", names[case]),
        _ => label.to_owned(),
    }
}

/// What is not known exactly, for people.
fn inputs(found: &Uncertainty) -> Group {
    type Part = fn(&Uncertain) -> Option<f64>;
    let parts: [(&str, Part); 4] = [
        ("not exact", |input| Some(input.value)),
        ("σ", |input| Some(input.standard_deviation())),
        ("between", |input| ends(input).map(|[from, _]| from)),
        ("and", |input| ends(input).map(|[_, to]| to)),
    ];
    let is_told = |part: &Part| found.inputs.iter().any(|input| part(input).is_some());
    let parts = parts.into_iter().filter(|(_, part)| is_told(part));
    let subjects = parts.map(|(head, part)| {
        let numbers = found.inputs.iter().map(|input| {
            let path = input.key.path().to_owned();
            let number = Quantity::number("", path, input.key.measure(), part(input), 0.0);
            Quantity {
                digits: DIGITS,
                ..number
            }
        });
        Subject::new(head, numbers.collect())
    });
    Group::new("", Layout::Columns, subjects.collect())
}

fn ends(input: &Uncertain) -> Option<[f64; 2]> {
    match input.spread {
        Spread::Normal(_) => None,
        Spread::Interval(ends) => Some(ends),
    }
}

/// The bands of the numbers of a load case, for people: side by side where both ways were gone.
fn bands(of_case: &[Band], samples: usize, names: &[&str]) -> Group {
    type Part = fn(&Band) -> Option<f64>;
    let head = match (of_case[0].case, names) {
        (Some(case), [_, _, ..]) => names[case],
        _ => "value",
    };
    let linear: [(&str, Part); 3] = [
        (head, |band| Some(band.value)),
        ("95 % from", |band| Some(band.linear?.interval[0])),
        ("to", |band| Some(band.linear?.interval[1])),
    ];
    let sampled: [(&str, Part); 2] = [
        ("sampled from", |band| {
            Some(band.sampled?.distribution.interval[0])
        }),
        ("to", |band| Some(band.sampled?.distribution.interval[1])),
    ];
    let sampled = sampled.into_iter().filter(|_| samples > 0);
    let subjects = linear.into_iter().chain(sampled).map(|(head, part)| {
        let numbers = of_case.iter().map(|band| {
            let (_, label, measure) = named(band.number);
            let number = Quantity::number("", label, measure, part(band), 0.0);
            Quantity {
                digits: DIGITS,
                ..number
            }
        });
        Subject::new(head, numbers.collect())
    });
    Group::new("", Layout::Columns, subjects.collect())
}

/// Where the variance of each number of a load case comes from, for people: its largest share.
fn causes(of_case: &[Band], inputs: &[Uncertain]) -> Group {
    let rows = of_case.iter().filter_map(|band| {
        let inputs = inputs.iter().zip(band.shares());
        let (input, share) = inputs.max_by(|(_, one), (_, other)| one.total_cmp(other))?;
        let text = format!("{:.0} % {}", 100.0 * share, input.key.path());
        let (_, label, _) = named(band.number);
        Some(Quantity::word("", format!("variance of {label}"), text))
    });
    Group::single("", rows.collect())
}

/// In which share of the samples each load case holds, for people.
fn holds(found: &Uncertainty, names: &[&str]) -> Group {
    let rows = found.holds.iter().zip(names).map(|(&share, name)| {
        let label = match names {
            [_] => "holds in".to_owned(),
            _ => format!("{name}: holds in"),
        };
        let text = format!("{} % of the samples", six_digits(100.0 * share));
        Quantity::word("", label, text)
    });
    Group::single("", rows.collect())
}

/// What else has to be said of the bands.
fn remarks(found: &Uncertainty, names: &[&str]) -> Vec<String> {
    let mut remarks = Vec::new();
    let disagreeing: Vec<_> = { found.bands.iter() }
        .filter(|band| band.disagrees())
        .map(|band| label(band, names))
        .collect();
    if !disagreeing.is_empty() {
        remarks.push(format!(
            "linearisation and sampling differ by more than the samples explain: {}",
            disagreeing.join(", ")
        ));
    }
    let without: Vec<_> = { found.bands.iter() }
        .filter(|band| band.linear.is_none())
        .map(|band| label(band, names))
        .collect();
    if !without.is_empty() {
        remarks.push(format!(
            "no steady state near enough for derivatives: {}",
            without.join(", ")
        ));
    }
    if found.no_drive > 0 {
        remarks.push(format!(
            "{} of {} samples are no drive: a number is out of its range there",
            found.no_drive, found.samples
        ));
    }
    let drawn = found.samples - found.no_drive;
    let mut before = None;
    for band in &found.bands {
        let count = band.sampled.map_or(0, |sampled| sampled.count);
        // A case without a steady state has none of its numbers.
        if count < drawn && before.replace(band.case) != Some(band.case) {
            let label = label(band, names);
            remarks.push(format!(
                "{label}: not found in {} of {drawn} samples",
                drawn - count
            ));
        }
    }
    remarks
}

/// All of it, for programs, SI.
fn data(found: &Uncertainty, names: &[&str]) -> Vec<Quantity> {
    let inputs = found.inputs.iter().map(|input| {
        let (_, factor) = input.key.measure().stored();
        json!({
            "key": input.key.path(),
            "unit": input.key.measure().shown(UnitSystem::Si).symbol,
            "value": input.value * factor,
            "standard_deviation": input.standard_deviation() * factor,
            "from": ends(input).map(|[from, _]| from * factor),
            "to": ends(input).map(|[_, to]| to * factor),
        })
    });
    let distribution = |found: Distribution, factor: f64| {
        json!({
            "mean": found.mean * factor,
            "standard_deviation": found.standard_deviation * factor,
            "low": found.interval[0] * factor,
            "high": found.interval[1] * factor,
        })
    };
    let bands = found.bands.iter().map(|band| {
        let (key, _, measure) = named(band.number);
        let (_, factor) = measure.stored();
        let effects = found.inputs.iter().zip(&band.effects);
        let effects = effects.map(|(input, effect)| {
            let effect = effect.map(|effect| effect * factor);
            (input.key.path().to_owned(), json!(effect))
        });
        json!({
            "quantity": key,
            "case": band.case.map(|case| names[case]),
            "unit": measure.shown(UnitSystem::Si).symbol,
            "value": band.value * factor,
            "effects": Json::Object(effects.collect()),
            "linear": band.linear.map(|found| distribution(found, factor)),
            "sampled": band.sampled.map(|found| distribution(found.distribution, factor)),
            "samples": band.sampled.map(|found| found.count),
            "disagrees": band.disagrees(),
        })
    });
    let holds = found.holds.iter().zip(names);
    let holds = holds.map(|(share, name)| ((*name).to_owned(), json!(share)));
    vec![
        Quantity::json("inputs", inputs.collect::<Vec<_>>()),
        Quantity::json("samples", found.samples),
        Quantity::json("samples_without_drive", found.no_drive),
        Quantity::json("bands", bands.collect::<Vec<_>>()),
        Quantity::json("holds", Json::Object(holds.collect())),
    ]
}
