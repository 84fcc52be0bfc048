//! What the answers for drives with two pulleys say, as tables, JSON and CSV.

mod branches;
mod errors;
mod figures;
mod ranges;
mod reports;
mod states;
mod states_as_tables;

use beltdrive::input::Key;
use beltdrive::quantity::{Answer, UnitSystem, branch, limit_curve, limits, two_pulleys};
use beltdrive::report::{csv, json, table};
use beltdrive::{
    Branch, BranchEnd, Check, Drive, LimitCurve, SolveOptions, SteadyState, Warning, examples,
    input, solve,
};
use serde_json::Value;

fn drive(example: &str, overrides: &[&str]) -> Drive {
    let example = examples::find(example).unwrap();
    let overrides: Vec<_> = overrides.iter().map(|text| (*text).to_owned()).collect();
    input::parse(example.name, example.text, &overrides).unwrap()
}

fn state(example: &str, overrides: &[&str]) -> SteadyState {
    solve(&drive(example, overrides), &SolveOptions::default()).unwrap()
}

fn of_state(state: &SteadyState) -> Answer {
    two_pulleys::answer(state, None)
}

fn of_limits(drive: &Drive) -> Answer {
    let options = SolveOptions::default();
    let found = beltdrive::limits(drive, &Key::load(drive), &options, &mut |_, _| {});
    limits::answer(&found.unwrap())
}

fn key(drive: &Drive, path: &str) -> Key {
    Key::all(drive).find(|key| key.path() == path).unwrap()
}

fn traced(drive: &Drive, path: &str, range: [f64; 2]) -> Branch {
    let (key, options) = (key(drive, path), SolveOptions::default());
    beltdrive::trace(drive, &key, range, &options, &mut |_, _| {}).unwrap()
}

fn curve(drive: &Drive, range: [f64; 2]) -> LimitCurve {
    let (load, options) = (Key::load(drive), SolveOptions::default());
    let second = key(drive, "friction.coefficient");
    beltdrive::limit_curve(drive, &load, &second, range, &options, &mut |_, _| {}).unwrap()
}

/// What depends on the mesh, on rounding or on the clock.
const VAGUE: [&str; 9] = [
    "check: ",
    "time ",
    "relative tolerance",
    "estimated error",
    "largest defect",
    "effect of smoothing",
    "mesh intervals",
    "  driven  ",
    "Newton steps",
];

/// The table in engineering units, without what is vague.
fn shown(answer: &Answer) -> String {
    let text = table(answer, UnitSystem::Engineering);
    let is_vague = |line: &str| VAGUE.iter().any(|start| line.starts_with(start));
    let lines = text.lines().filter(|line| !is_vague(line));
    let lines: Vec<_> = lines.collect();
    lines.join("\n").trim_end().to_owned()
}

fn parsed(answer: &Answer) -> Value {
    serde_json::from_str(&json(answer)).unwrap()
}

/// The columns of a CSV text and its rows.
fn columns(text: &str) -> (Vec<String>, Vec<csv::StringRecord>) {
    let mut reader = csv::Reader::from_reader(text.as_bytes());
    let header = reader
        .headers()
        .unwrap()
        .iter()
        .map(str::to_owned)
        .collect();
    (header, reader.records().map(Result::unwrap).collect())
}

/// The value of a row in a column.
fn field<'a>(table: &'a (Vec<String>, Vec<csv::StringRecord>), row: usize, name: &str) -> &'a str {
    let place = table.0.iter().position(|column| column == name);
    &table.1[row][place.unwrap_or_else(|| panic!("{name} among {:?}", table.0))]
}

/// Reading a number may change its last digit.
#[track_caller]
fn close(found: &Value, expected: f64) {
    let found = found.as_f64().unwrap();
    assert!(
        (found - expected).abs() <= 4e-16 * expected.abs(),
        "{found} for {expected}"
    );
}

#[track_caller]
fn has(report: &Value, keys: &[&str]) {
    for key in keys {
        assert!(report.pointer(key).is_some(), "{key} is missing");
    }
}

#[track_caller]
fn fits(answer: &Answer) {
    for units in [UnitSystem::Si, UnitSystem::Engineering, UnitSystem::Us] {
        let text = table(answer, units);
        let longest = text.lines().map(|line| line.chars().count()).max();
        assert!(longest <= Some(100), "{longest:?}\n{text}");
        assert!(!text.contains("NaN") && !text.contains("inf"), "{text}");
    }
}

/// The keys of a state that programs rely on.
const STATE: [&str; 15] = [
    "/mass_flow_kg_per_s",
    "/belt_length_m",
    "/slack_span_m",
    "/tight_span_m",
    "/efficiency",
    "/friction_loss_W",
    "/compression_power_W",
    "/speed_loss",
    "/tension_N/slack",
    "/tension_N/tight",
    "/tractive_tension_N/slack",
    "/tractive_tension_N/tight",
    "/driver/inclination_deg/1",
    "/driver/zones/0/kind",
    "/driven/zones/0/to_deg",
];
