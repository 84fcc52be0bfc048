//! What the program says of drives without an answer, and its exit status.

use std::process::{Command, Output};

fn run(command: &str, example: &str, set: &[&str]) -> Output {
    let file = format!("{}/examples/{example}.toml", env!("CARGO_MANIFEST_DIR"));
    let overrides = set.iter().flat_map(|set| ["--set", set]);
    Command::new(env!("CARGO_BIN_EXE_beltdrive"))
        .args([command, &file])
        .args(overrides)
        .args(["--json", "-"])
        .output()
        .unwrap()
}

#[track_caller]
fn refused(output: &Output, status: i32, message: &str) {
    let text = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(status), "{text}");
    assert!(text.contains(message), "{text}");
}

/// One tension is stated as belt tension, the other as tractive: only the belt speed tells which is larger.
const BACKWARDS: [&str; 2] = [
    "load.slack_tension=200 N",
    "load.tight_tractive_tension=100 N",
];

#[test]
fn a_tight_tension_below_the_slack_one_is_at_fault_for_every_belt() {
    for command in ["solve", "limits"] {
        let output = run(command, "kim2009", &BACKWARDS);
        refused(
            &output,
            2,
            "the tight tension 173.602 N is below the slack tension 200 N",
        );
    }
    let output = run("solve", "kim2009-flat", &BACKWARDS);
    refused(&output, 2, "is below the slack tension 200 N");
}

#[test]
fn the_limits_of_crossed_tensions_begin_without_load() {
    let crossed = [
        "load.slack_tension=200 N",
        "load.tight_tractive_tension=150 N",
    ];
    let output = run("limits", "kim2009", &crossed);
    let limits: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    let smallest = &limits["smallest"];
    assert_eq!(smallest["reason"], "no load");
    let number = |key: &str| smallest.pointer(key).unwrap().as_f64().unwrap();
    assert!((number("/tension_N/slack") - number("/tension_N/tight")).abs() < 1e-3);
    assert!((number("/value") - number("/tractive_tension_N/tight")).abs() < 1e-9);
    assert!(number("/value") < 150.0 && number("/value_error") < 1e-3);
}

#[test]
fn a_drive_without_load_has_limits() {
    let output = run("limits", "kim2009", &["load.tight_tractive_tension=100 N"]);
    assert_eq!(output.status.code(), Some(0));
    let limits: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(limits["smallest"]["reason"], "no load");
    assert_eq!(limits["largest"]["reason"], "fold");
}
