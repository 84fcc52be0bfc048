//! `check`: load cases, requirements, and where the power goes.

use beltdrive::input::DriveFile;
use beltdrive::quantity::check::answer;
use beltdrive::report::{csv, json, table};
use beltdrive::{CheckedService, Failing, SlipMargin, SolveOptions, check, examples};
use std::process::{Command, Output};

/// Judges an example with overrides to a tolerance.
fn checked(example: &str, overrides: &[&str], tolerance: f64) -> CheckedService {
    let example = examples::find(example).unwrap();
    let overrides: Vec<_> = overrides.iter().map(|text| (*text).to_owned()).collect();
    let file = DriveFile::read(example.name, example.text, &overrides).unwrap();
    let service = file.service().unwrap();
    check(&service, &SolveOptions { tolerance }, &mut |_, _| {}).unwrap()
}

/// The slip margin of the only case.
fn margin(checked: &CheckedService) -> f64 {
    match checked.cases[0].outcome.as_ref().unwrap().slip_margin {
        SlipMargin::Factor(found) => found.value,
        other => panic!("{other:?}"),
    }
}

/// Runs the program on a text from standard input.
fn run(arguments: &[&str], text: &str) -> Output {
    use std::io::Write;
    let mut program = Command::new(env!("CARGO_BIN_EXE_beltdrive"))
        .args(arguments)
        .stdin(std::process::Stdio::piped())
        .stdout(std::process::Stdio::piped())
        .stderr(std::process::Stdio::piped())
        .spawn()
        .unwrap();
    let mut input = program.stdin.take().unwrap();
    input.write_all(text.as_bytes()).unwrap();
    drop(input);
    program.wait_with_output().unwrap()
}

#[test]
fn losses_add_up_to_power_in_less_power_out() {
    let bristles = "friction.law=bristle";
    let flat: [&[&str]; 3] = [
        &[],
        &["friction.law=epp", "friction.stiffness=1e8"],
        &["friction.law=creep-rate", "friction.velocity=0.05"],
    ];
    let v: [&[&str]; 3] = [
        &[bristles],
        &["friction.law=coulomb"],
        &[
            "friction.law=epp",
            "friction.stiffness=5e7",
            "friction.epp.kind=vector",
        ],
    ];
    let flat = flat.iter().flat_map(|overrides| {
        ["serpentine", "conveyor", "crossed"].map(|example| (example, *overrides))
    });
    let v = v
        .iter()
        .flat_map(|overrides| ["v-power", "cvt-variator"].map(|example| (example, *overrides)));
    for (example, overrides) in flat.chain(v) {
        let found = checked(example, overrides, 1e-6);
        for case in &found.cases {
            let case = case.outcome.as_ref().unwrap();
            let (losses, power) = (case.losses, case.state.power_in);
            let parts = losses.sliding + losses.wedging + losses.elastic + losses.compression;
            let off = [losses.speed + losses.torque, parts].map(|sum| (sum - losses.total) / power);
            println!("{example} {overrides:?}: {:.1e}, {:.1e}", off[0], off[1]);
            assert!(off[0].abs() < 1e-9, "{example} {overrides:?}: {off:?}");
            assert!(off[1].abs() < 1e-9, "{example} {overrides:?}: {off:?}");
            // Vector elastic friction gives work back where its limit falls.
            assert!(losses.sliding >= 0.0 && (losses.elastic >= 0.0 || overrides.len() == 3));
        }
    }
}

#[test]
fn requirements_are_judged_in_each_case() {
    let found = checked("serpentine-cases", &[], 1e-6);
    assert_eq!((found.cases.len(), found.failing()), (3, 1));
    let [
        Failing::SpeedLoss {
            found: lost,
            required,
        },
    ] = found.cases[2].failures[..]
    else {
        panic!("{:?}", found.cases[2].failures)
    };
    assert_eq!(required, 0.005);
    assert!((lost.value - 0.00801653).abs() < 1e-8 && lost.pulley == 2);
    // The margin is that of the factor on all torques.
    let states = found
        .cases
        .iter()
        .map(|case| case.outcome.as_ref().unwrap());
    for state in states {
        let limit = state.state.load_limit.as_ref().unwrap();
        let SlipMargin::Factor(margin) = state.slip_margin else {
            panic!()
        };
        assert_eq!((margin.value, margin.pulley), (limit.factor, limit.pulley));
    }
    // Each requirement at what was found just holds, and fails when it is a little stricter.
    let state = found.cases[2].outcome.as_ref().unwrap();
    let SlipMargin::Factor(margin) = state.slip_margin else {
        panic!()
    };
    let hub = state.hub_load.value.max(state.rest_hub_load.value);
    for (key, value, stricter) in [
        ("smallest_slip_margin", margin.value, 1.0 + 1e-9),
        ("largest_speed_loss", state.speed_loss.value, 1.0 - 1e-9),
        ("largest_hub_load", hub, 1.0 - 1e-9),
    ] {
        for (factor, failing) in [(1.0, 0), (stricter, 1)] {
            let others = [
                "smallest_slip_margin",
                "largest_speed_loss",
                "largest_hub_load",
            ];
            let mut overrides: Vec<_> = others
                .iter()
                .filter(|other| **other != key)
                .map(|other| format!("requirements.{other}="))
                .collect();
            overrides.push(format!("requirements.{key}={:?}", value * factor));
            let overrides: Vec<_> = overrides.iter().map(String::as_str).collect();
            let found = checked("serpentine-cases", &overrides, 1e-6);
            assert_eq!(found.cases[2].failures.len(), failing, "{overrides:?}");
        }
    }
}

#[test]
fn the_margin_is_that_of_torques_however_the_load_is_stated() {
    for (example, law) in [("v-power", "bristle"), ("poly-v", "coulomb")] {
        let law = format!("friction.law={law}");
        let margin = |overrides: &[&str]| {
            let found = checked(example, overrides, 1e-8);
            let state = found.cases[0].outcome.as_ref().unwrap();
            let SlipMargin::Factor(margin) = state.slip_margin else {
                panic!("{:?}", state.slip_margin)
            };
            let torques = state.state.pulleys.iter().map(|pulley| pulley.torque);
            (margin.value, torques.fold(0.0, f64::max))
        };
        let (by_power, torque) = margin(&[&law]);
        let torque = format!("load.torque={torque:?}");
        let (by_torque, _) = margin(&[&law, &torque]);
        println!("{example}: {by_power} {by_torque}");
        assert!(
            (by_power / by_torque - 1.0).abs() < 1e-6,
            "{by_power} {by_torque}"
        );
    }
}

/// Near lift-off a driver that slips grossly slows the belt, centrifugal force falls, and there are states up to a
/// hundred times the load. The margin is that to the load at which the driver slips by a twentieth.
#[test]
fn near_lift_off_the_margin_is_that_to_gross_slip() {
    let at = |torque: f64| {
        let torque = format!("load.torque={torque} N*m");
        let overrides = ["pulleys.driver.speed=11000 rpm", "load.power=", &torque];
        checked("v-power", &overrides, 1e-6)
    };
    let base = margin(&at(1.75));
    assert!((30.0..40.0).contains(&base), "{base}");
    // The same load from another one, and from beyond it.
    for share in [0.5, 0.9, 1.1] {
        let found = share * margin(&at(1.75 * share * base));
        assert!((found - 1.0).abs() < 1e-3, "{share}: {found}");
    }
}

/// The belt of a variator sinks so deep that it is slow against the pitch circles by more than a twentieth, without
/// slipping: its margin is that to the load at which it overhangs, from whatever load it is sought.
#[test]
fn a_belt_that_sinks_deep_does_not_slip() {
    let bristle = "friction.law=bristle";
    let at = |torque: f64| {
        let torque = format!("load.torque={torque} N*m");
        let overrides = [bristle, "load.tight_tractive_tension=", &torque];
        checked("cvt-variator", &overrides, 1e-6)
    };
    let limits = [8.0, 40.0].map(|torque| torque * margin(&at(torque)));
    assert!((75.0..85.0).contains(&limits[0]), "{limits:?}");
    assert!((limits[1] / limits[0] - 1.0).abs() < 1e-4, "{limits:?}");
    let stated = checked("cvt-variator", &[bristle], 1e-6);
    let state = stated.cases[0].outcome.as_ref().unwrap();
    let limit = margin(&stated) * state.state.pulleys[1].torque;
    assert!((limit / limits[0] - 1.0).abs() < 1e-4, "{limit} {limits:?}");
}

#[test]
fn a_case_without_a_state_fails_and_the_others_are_judged() {
    let too_much = "case.idle.pulley.steering.power=300 kW";
    let found = checked("serpentine-cases", &[too_much], 1e-6);
    assert_eq!(found.failing(), 2);
    assert!(found.cases[1].outcome.is_err() && found.cases[0].holds());
    assert!(found.over_time().is_none());
    let answer = answer(&found);
    let text = table(&answer, beltdrive::quantity::UnitSystem::Engineering);
    assert!(
        text.contains("idle: FAILS, no steady state: gross slip: pulley `crankshaft`"),
        "{text}"
    );
    let rows = csv(&answer);
    assert_eq!(rows.lines().count(), 4);
    let all: serde_json::Value = serde_json::from_str(&json(&answer)).unwrap();
    assert_eq!(all["cases"][1]["verdict"], "FAILS");
    assert_eq!(all["cases"][1]["efficiency"], serde_json::Value::Null);
    assert_eq!(all["cases"][2]["pulleys"][2]["name"], "alternator");
    assert_eq!(all["requirements"]["largest_hub_load_N"], 2100.0);
}

#[test]
fn the_exit_status_tells_the_verdict() {
    let example = examples::find("serpentine-cases").unwrap();
    let status = |overrides: &[&str]| {
        let mut arguments = vec!["check", "-"];
        arguments.extend(overrides.iter().flat_map(|text| ["--set", text]));
        let output = run(&arguments, example.text);
        (
            output.status.code(),
            String::from_utf8(output.stderr).unwrap(),
        )
    };
    let (code, message) = status(&[]);
    assert_eq!(
        (code, &*message),
        (Some(3), "error: 1 of 3 load cases fails\n")
    );
    assert_eq!(status(&["requirements.largest_speed_loss="]).0, Some(0));
    assert_eq!(status(&["requirements.largest_speed_loss=2 %"]).0, Some(0));
}

/// A file with a fault, and what the message must say.
#[test]
fn faults_of_a_service_are_said_with_their_place() {
    let example = examples::find("serpentine-cases").unwrap();
    let plain = |from: &str, to: &str| {
        assert!(example.text.contains(from), "{from}");
        example.text.replace(from, to)
    };
    let cases = [
        (
            plain("smallest_slip_margin = 2 ", "smallest_slip_margin = 0.5"),
            "must be at least 1",
        ),
        (
            plain("smallest_slip_margin", "slip_margin"),
            "smallest_slip_margin",
        ),
        (
            plain(
                "largest_hub_load = \"2.1 kN\"",
                "largest_hub_load = \"2.1 kg\"",
            ),
            "a force",
        ),
        (
            plain("share = \"5 %\"", "share = \"6 %\""),
            "add up to 1.01, not to 1",
        ),
        (
            plain("share = \"5 %\"", ""),
            "the load case `parking on a hot day` has no share",
        ),
        (
            plain("share = \"25 %\"", "share = -0.25"),
            "must be above 0 and at most 1",
        ),
        (
            plain("name = \"idle\"", "name = \"cruise\""),
            "two load cases have the name `cruise`",
        ),
        (
            plain("name = \"idle\"", "name = \"i.dle\""),
            "no name for a load case",
        ),
        (
            plain(
                "[case.pulley.\"water pump\"]",
                "[case.pulley.\"waterpump\"]",
            ),
            "water pump",
        ),
        (
            plain("speed = \"900 rpm\"", "speed = \"900 N\""),
            "an angular speed",
        ),
        (
            plain("speed = \"900 rpm\"", "power = \"900 W\""),
            "4 pulleys have a torque or a power",
        ),
        (plain("speed = \"900 rpm\"", "sped = \"900 rpm\""), "speed"),
        (plain("bending_damping = \"25 %\"", "# "), "bending_damping"),
        (
            plain("[[case]]\nname = \"cruise\"", "[case]\nname = \"cruise\""),
            "case",
        ),
        (plain("[requirements]", "[[requirements]]"), "requirements"),
    ];
    for (text, word) in cases {
        let output = run(&["check", "-"], &text);
        let message = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(2), "{word}: {message}");
        assert!(message.contains(word), "{word}: {message}");
        assert!(message.contains("-->"), "{message}");
        println!("{message}");
    }
}
