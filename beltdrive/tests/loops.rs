//! Loops of pulleys on the command line: drive files with known states, outputs, units and refusals.

use serde_json::Value;
use std::fmt::Write as _;
use std::fs;
use std::path::PathBuf;
use std::process::{Command, Output};

/// Relative bound of all quantities.
const WITHIN: f64 = 1e-11;

fn directory(name: &str) -> PathBuf {
    let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _ = fs::remove_dir_all(&path);
    fs::create_dir_all(&path).unwrap();
    path
}

fn run(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_beltdrive"))
        .args(arguments)
        .output()
        .unwrap()
}

/// The JSON of a drive file.
fn json(arguments: &[&str]) -> Value {
    let output = run(&[arguments, &["--json", "-"]].concat());
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{arguments:?}: {errors}");
    serde_json::from_slice(&output.stdout).unwrap()
}

/// The path of a shipped example.
fn example(name: &str) -> String {
    format!("{}/examples/{name}.toml", env!("CARGO_MANIFEST_DIR"))
}

/// The drive file of a case of the loops with known states.
fn drive_file(input: &Value) -> String {
    let number = |value: &Value| value.as_f64().unwrap();
    let belt = &input["belt"];
    let mut text = format!(
        "[belt]\ntype = \"flat\"\nmass_per_length = {:?}\naxial_stiffness = {:?}\n[friction]\nlaw = {}\n",
        number(&belt["mass_per_length_kg_per_m"]),
        number(&belt["axial_stiffness_N"]),
        input["friction"]["law"],
    );
    if let Some(stiffness) = input["friction"]["stiffness_N_per_m2"].as_f64() {
        writeln!(text, "stiffness = {stiffness:?}").unwrap();
    }
    for pulley in input["pulleys"].as_array().unwrap() {
        writeln!(text, "[[pulley]]\nname = {}", pulley["name"]).unwrap();
        writeln!(text, "radius = {:?}", number(&pulley["radius_m"])).unwrap();
        writeln!(text, "side = {}", pulley["side"]).unwrap();
        let friction = number(&pulley["friction_coefficient"]);
        writeln!(text, "friction_coefficient = {friction:?}").unwrap();
        if let Some(x) = pulley["x_m"].as_f64() {
            writeln!(text, "centre = [{x:?}, {:?}]", number(&pulley["y_m"])).unwrap();
        }
        match pulley["speed_rad_per_s"].as_f64() {
            Some(speed) => writeln!(text, "speed = {speed:?}").unwrap(),
            None if pulley.get("x_m").is_some() => {
                writeln!(text, "torque = {:?}", number(&pulley["torque_N_m"])).unwrap();
            }
            None => {}
        }
    }
    let sense = match input["sense"].as_str() {
        Some("cw") => "clockwise",
        _ => "counter-clockwise",
    };
    writeln!(text, "[layout]\nsense = \"{sense}\"").unwrap();
    if let Some(tensioner) = input.get("tensioner") {
        let angle = number(&input["closure"]["angle_rad"]);
        writeln!(
            text,
            "[tensioner]\npulley = {}\n[tensioner.arm]",
            tensioner["pulley"]
        )
        .unwrap();
        writeln!(text, "pivot = {}", tensioner["pivot_m"]).unwrap();
        writeln!(text, "length = {}", tensioner["arm_length_m"]).unwrap();
        writeln!(text, "stiffness = {}", tensioner["stiffness_N_m_per_rad"]).unwrap();
        writeln!(text, "free_angle = {}", tensioner["free_angle_rad"]).unwrap();
        writeln!(
            text,
            "stops = {}\nrest_angle = {angle:?}",
            tensioner["range_rad"]
        )
        .unwrap();
    } else {
        let tension = number(&input["closure"]["tension_N"]);
        writeln!(text, "[load]\nsetup_tension = {tension:?}").unwrap();
    }
    text
}

/// Every number of an object of a case whose key the program prints, too; returns how many there were.
fn compare(name: &str, known: &Value, found: &Value) -> usize {
    let mut count = 0;
    for (key, known) in known.as_object().unwrap() {
        let (key, factor) = match key.strip_suffix("_rad") {
            Some(stem) => {
                let stem = stem.replace("wrap", "wrap_angle");
                (format!("{stem}_deg"), 1_f64.to_degrees())
            }
            None => (key.clone(), 1.0),
        };
        let Some(found) = found.get(&key) else {
            continue;
        };
        let both = match (known, found) {
            (Value::Array(known), Value::Array(found)) => {
                assert_eq!(known.len(), found.len(), "{name} {key}");
                known.iter().zip(found).collect()
            }
            _ => vec![(known, found)],
        };
        for (known, found) in both {
            match (known.as_f64(), found.as_f64()) {
                (Some(known), Some(found)) => {
                    let known = known * factor;
                    let scale = if key == "speed_loss" {
                        1.0
                    } else {
                        known.abs().max(1e-300)
                    };
                    let off = (found - known).abs() / scale;
                    assert!(
                        off < WITHIN || known == found,
                        "{name} {key}: {found} for {known}"
                    );
                    count += 1;
                }
                _ => assert_eq!(known, found, "{name} {key}"),
            }
        }
    }
    count
}

#[test]
fn drive_files_with_known_states_are_solved_to_rounding() {
    let cases: Value = serde_json::from_str(include_str!("belt_loops/cases.json")).unwrap();
    let directory = directory("loops-known");
    let mut count = 0;
    for case in cases["cases"].as_array().unwrap() {
        let name = case["id"].as_str().unwrap();
        let path = directory.join(format!("{name}.toml"));
        fs::write(&path, drive_file(&case["input"])).unwrap();
        let path = path.to_str().unwrap();
        let Some(known) = case.get("result") else {
            let output = run(&["solve", path]);
            let errors = String::from_utf8_lossy(&output.stderr);
            assert_eq!(output.status.code(), Some(1), "{errors}");
            let limit = case["refusal"]["load_factor_limit"].as_f64().unwrap();
            let words = format!("pulley `driver` carries {limit:.4} of the load");
            assert!(errors.contains(&words), "{errors}");
            continue;
        };
        let found = json(&["solve", path]);
        count += compare(name, known, &found["loop"]);
        for list in ["spans", "pulleys"] {
            let pairs = known[list].as_array().unwrap().iter();
            let pairs: Vec<_> = pairs.zip(found[list].as_array().unwrap()).collect();
            assert_eq!(pairs.len(), known[list].as_array().unwrap().len());
            for (known, found) in pairs {
                count += compare(&format!("{name} {list}"), known, found);
            }
        }
    }
    assert_eq!(count, 453);
}

#[test]
fn every_example_of_a_loop_is_solved_in_every_form() {
    let directory = directory("loops-examples");
    for name in [
        "serpentine",
        "crossed",
        "poly-v",
        "back-side-idler",
        "conveyor",
    ] {
        let csv = directory.join(format!("{name}.csv"));
        let found = json(&["solve", &example(name), "--csv", csv.to_str().unwrap()]);
        let pulleys = found["pulleys"].as_array().unwrap();
        assert_eq!(found["spans"].as_array().unwrap().len(), pulleys.len());
        let rows = fs::read_to_string(&csv).unwrap();
        for pulley in pulleys {
            let name = pulley["name"].as_str().unwrap();
            let points = rows
                .lines()
                .filter(|row| row.starts_with(&format!("{name},")));
            assert_eq!(
                points.count(),
                pulley["angle_deg"].as_array().unwrap().len()
            );
        }
        for units in ["si", "engineering", "us"] {
            let output = run(&["solve", &example(name), "--units", units]);
            let table = String::from_utf8(output.stdout).unwrap();
            assert!(
                table.lines().all(|line| line.chars().count() <= 100),
                "{table}"
            );
            assert!(table.contains("load factor limit") && !table.contains("NaN"));
        }
    }
}

#[test]
fn what_is_at_fault_decides_the_exit_status() {
    let status = |arguments: &[&str]| {
        let output = run(&[&["solve", &example("serpentine")], arguments].concat());
        let errors = String::from_utf8(output.stderr).unwrap();
        (output.status.code().unwrap(), errors)
    };
    let (code, errors) = status(&["--set", "pulley.compressor.torque=200 N*m"]);
    assert!(
        code == 1 && errors.contains("gross slip: pulley `"),
        "{errors}"
    );
    let (code, errors) = status(&["--set", "tensioner.arm.rest_angle=-10 deg"]);
    assert!(
        code == 1 && errors.contains("beyond its travel"),
        "{errors}"
    );
    let (code, errors) = status(&["--set", "pulley.alternator.centre.x=-2 mm"]);
    assert!(code == 2 && errors.contains("pulley"), "{errors}");
    let output = run(&["stability", &example("serpentine")]);
    assert_eq!(output.status.code(), Some(2));
}
