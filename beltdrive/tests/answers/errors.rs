//! The stated errors of numbers against states to a finer tolerance.

use super::{drive, json};
use beltdrive::quantity::two_pulleys;
use beltdrive::{Drive, SolveOptions, solve};
use serde_json::Value;

/// An answer as JSON.
fn solved(drive: &Drive, tolerance: f64) -> Value {
    let state = solve(drive, &SolveOptions { tolerance }).unwrap();
    serde_json::from_str(&json(&two_pulleys::answer(&state, None))).unwrap()
}

/// How many times its stated error each number is off, and its key.
fn exceeded(errors: &Value, [numbers, finer]: [&Value; 2]) -> Vec<(f64, String)> {
    let errors = errors.as_object().unwrap().iter();
    let all = errors.flat_map(|(key, error)| {
        let [number, finer] = [numbers, finer].map(|of| &of[key]);
        if error.is_object() {
            return exceeded(error, [number, finer]);
        }
        let [number, finer, error] = [number, finer, error].map(|of| of.as_f64().unwrap());
        vec![((number - finer).abs() / error, key.clone())]
    });
    all.collect()
}

#[test]
fn numbers_are_off_by_no_more_than_their_errors() {
    let vector = "friction.epp.kind=vector";
    let cases: [(&str, &[&str]); 5] = [
        ("kim2009", &[]),
        ("kim2009-epp", &[]),
        ("kim2009-epp", &[vector]),
        ("kim2009-bristle", &[]),
        ("cvt-variator", &["friction.law=bristle"]),
    ];
    for (example, overrides) in cases {
        let drive = drive(example, overrides);
        let fine = solved(&drive, 1e-9);
        for tolerance in [1e-2, 1e-4, 1e-6] {
            let coarse = solved(&drive, tolerance);
            let mut found = exceeded(&coarse["errors"], [&coarse, &fine]);
            assert!(found.len() > 25);
            found.sort_by(|a, b| b.0.total_cmp(&a.0));
            println!("{example} {overrides:?} {tolerance:e}: {:.2?}", &found[..3]);
            // Both are known to a few percent.
            assert!(found[0].0 < 1.2, "{:?}", found[0]);
            // The errors are not stated at random: some number is off by a few percent of its error at least.
            assert!(found[0].0 > 0.02, "{:?}", found[0]);
        }
    }
}
