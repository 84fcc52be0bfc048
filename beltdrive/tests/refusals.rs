//! What the program says of drives without an answer, and its exit status.

use std::process::{Command, Output};

fn run(command: &str, example: &str, set: &[&str]) -> Output {
    run_with(&[command], example, set)
}

fn run_with(command: &[&str], example: &str, set: &[&str]) -> Output {
    let file = format!("{}/examples/{example}.toml", env!("CARGO_MANIFEST_DIR"));
    let overrides = set.iter().flat_map(|set| ["--set", set]);
    Command::new(env!("CARGO_BIN_EXE_beltdrive"))
        .args(command)
        .arg(&file)
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

#[test]
fn a_belt_faster_than_its_axial_waves_is_refused_by_every_command() {
    let speed = ["pulleys.driver.speed=1000 Hz"];
    let waves = "faster than axial waves run along it, sqrt(EA/m) = 1054.09 m/s";
    for command in [
        &["solve"][..],
        &["limits"],
        &[
            "trace",
            "--parameter",
            "load.tight_tractive_tension",
            "--from",
            "150",
            "--to",
            "900",
        ],
        &[
            "trace",
            "--parameter",
            "pulleys.driver.speed",
            "--from",
            "6000",
            "--to",
            "7000",
        ],
    ] {
        refused(&run_with(command, "kim2009", &speed), 1, waves);
    }
    let output = run("solve", "kim2009-flat", &speed);
    refused(
        &output,
        1,
        "leaves nothing to press the belt on the pulleys",
    );
}

#[test]
fn tractive_tension_has_to_press_a_flat_belt_by_every_convention() {
    for normal_force in ["thesis", "inertia", "exact"] {
        let convention = format!("model.normal_force={normal_force}");
        let set = [convention.as_str(), "pulleys.driver.speed=700 rad/s"];
        let output = run("solve", "kim2009-flat", &set);
        refused(
            &output,
            1,
            "leaves nothing to press the belt on the pulleys",
        );
    }
}

#[test]
fn a_belt_that_sinks_below_its_groove_or_stretches_too_far_is_remarked() {
    let kinds = |report: &serde_json::Value| -> Vec<String> {
        let warnings = report["warnings"].as_array().unwrap();
        let kinds = warnings
            .iter()
            .map(|warning| warning["kind"].as_str().unwrap());
        kinds.map(str::to_owned).collect()
    };
    let set = ["belt.height=5 mm"];
    let state: serde_json::Value =
        serde_json::from_slice(&run("solve", "kim2009", &set).stdout).unwrap();
    assert_eq!(kinds(&state), ["belt height"]);
    assert_eq!(state["warnings"][0]["pulley"], "driven");
    assert_eq!(state["warnings"][0]["height_m"], 0.005);
    let limits: serde_json::Value =
        serde_json::from_slice(&run("limits", "kim2009", &set).stdout).unwrap();
    assert_eq!(kinds(&limits["smallest"]), [""; 0]);
    let largest = ["belt height", "belt height", "large strain"];
    assert_eq!(kinds(&limits["largest"]), largest);
    let soft = ["belt.axial_stiffness=12 kN"];
    let state: serde_json::Value =
        serde_json::from_slice(&run("solve", "kim2009", &soft).stdout).unwrap();
    assert_eq!(kinds(&state), ["large strain"]);
}

#[test]
fn the_wrap_of_the_pitch_circles_stands_beside_that_of_the_belt() {
    let output = run(
        "solve",
        "kim2009-bristle",
        &["pulleys.driven.radius=0.125 m"],
    );
    let state: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    let number = |key: &str| state.pointer(key).unwrap().as_f64().unwrap();
    let wrap = number("/driven/geometric_wrap_angle_deg");
    let circles = 180.0 - 2.0 * (0.125_f64 / 1.393_327_732_346_075).asin().to_degrees();
    assert!((wrap - circles).abs() < 1e-9);
    assert!(number("/driven/wrap_angle_deg") > wrap + 1.0);
}
