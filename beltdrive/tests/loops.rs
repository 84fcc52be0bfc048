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
        "v-power",
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
            let profile = pulley.get("angle_deg");
            let profile = profile.unwrap_or_else(|| &found["profiles"][name]["angle_deg"]);
            assert_eq!(points.count(), profile.as_array().unwrap().len());
        }
        for units in ["si", "engineering", "us"] {
            let output = run(&["solve", &example(name), "--units", units]);
            let table = String::from_utf8(output.stdout).unwrap();
            assert!(
                table.lines().all(|line| line.chars().count() <= 100),
                "{table}"
            );
            assert!(table.contains("belt tension at rest") && !table.contains("NaN"));
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
    let over = ["--parameter", "friction.coefficient", "--from", "0.01"];
    let output = run(&[
        &["trace", &example("serpentine")],
        &over[..],
        &["--to", "5"],
    ]
    .concat());
    let errors = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(1));
    assert!(
        errors.contains("gross slip") && errors.contains("--from 0.01"),
        "{errors}"
    );
}

#[test]
fn two_pulleys_have_the_keys_of_a_drive_and_those_of_a_loop() {
    let drive = [
        "slack_span_m",
        "driver",
        "driven",
        "tension_N",
        "profiles",
        "convergence",
    ];
    let of_loop = ["pulleys", "spans", "loop"];
    // Of the torque: the power that it carries is 1.9153 times that of the file.
    let limit = &json(&["solve", &example("v-power")])["loop"]["load_factor_limit"];
    assert!((limit.as_f64().unwrap() - 2.049_8).abs() < 1e-3, "{limit}");
    for name in ["kim2009-bristle", "flat-unequal", "poly-v", "v-power"] {
        let found = json(&["solve", &example(name)]);
        for key in drive.iter().chain(&of_loop) {
            assert!(found.get(key).is_some(), "{name} {key}");
        }
        let [driver, driven] = [0, 1].map(|pulley| &found["pulleys"][pulley]);
        assert_eq!(driver["name"], "driver");
        let close = |one: &Value, other: &Value, sign: f64| {
            let [one, other] = [one, other].map(|value| value.as_f64().unwrap());
            // A V-belt is solved as a loop and as a drive, each to 1e-6.
            let within = if name == "v-power" { 1e-6 } else { 1e-9 };
            let off = (one - sign * other).abs();
            assert!(off < within * one.abs(), "{name}: {one} {other}");
        };
        close(&driven["torque_N_m"], &found["driven"]["torque_N_m"], 1.0);
        close(&driver["torque_N_m"], &found["driver"]["torque_N_m"], -1.0);
        close(
            &driven["wrap_angle_deg"],
            &found["driven"]["wrap_angle_deg"],
            1.0,
        );
        close(
            &found["spans"][0]["tension_N"],
            &found["tension_N"]["slack"],
            1.0,
        );
        close(&found["loop"]["efficiency"], &found["efficiency"], 1.0);
        // The forces of the belt on both hubs are in equilibrium.
        for part in [0, 1] {
            let [one, other] = [driver, driven].map(|of| of["hub_load_N"][part].as_f64().unwrap());
            let scale = found["tension_N"]["tight"].as_f64().unwrap();
            assert!((one + other).abs() < 1e-6 * scale, "{name}");
        }
    }
}

#[test]
fn a_branch_ends_where_a_pulley_slips() {
    let file = example("back-side-idler");
    let range = [
        "--parameter",
        "pulley.fan.torque",
        "--from",
        "1 N*m",
        "--to",
        "90 N*m",
    ];
    let found = json(&[&["trace", &file], &range[..]].concat());
    let points = found["points"].as_array().unwrap();
    assert_eq!(found["end"]["reason"], "gross slip");
    let last = points.last().unwrap();
    // All torques belong to the fan: its limit is that of the load factor.
    let solved = json(&["solve", &file]);
    let limit = 20.0 * solved["loop"]["load_factor_limit"].as_f64().unwrap();
    let torque = last["pulley_fan_torque_N_m"].as_f64().unwrap();
    assert!((torque / limit - 1.0).abs() < 1e-9, "{torque} {limit}");
    let limits = json(&["limits", &file]);
    let factor = limits["largest"]["load_factor"].as_f64().unwrap();
    assert!((20.0 * factor / limit - 1.0).abs() < 1e-9, "{factor}");
    assert_eq!(limits["largest"]["reason"], "gross slip");
    assert_eq!(limits["largest"]["limiting_pulley"], "motor");
    assert_eq!(limits["smallest"]["reason"], "no load");
    let over = [
        "--parameter",
        "pulley.fan.torque",
        "--curve",
        "load.setup_tension",
    ];
    let range = ["--from", "250 N", "--to", "300 N"];
    let curve = json(&[&["trace", &file], &over[..], &range[..]].concat());
    let first = curve["points"][0]["pulley_fan_torque_N_m"]
        .as_f64()
        .unwrap();
    assert!((first / limit - 1.0).abs() < 1e-9, "{first}");
    let count = curve["points"].as_array().unwrap().len();
    assert_eq!(
        [count, curve["end"]["reason"].as_str().unwrap().len()],
        [41, 6]
    );
}

#[test]
fn branches_and_limits_have_figures() {
    let directory = directory("loops-figures");
    let file = example("back-side-idler");
    let range = [
        "--parameter",
        "pulley.fan.torque",
        "--from",
        "1 N*m",
        "--to",
        "90 N*m",
    ];
    let over = [
        "--parameter",
        "pulley.fan.torque",
        "--curve",
        "load.setup_tension",
    ];
    let of = ["--from", "250 N", "--to", "300 N"];
    for (arguments, name) in [
        ([&["trace", &file], &range[..]].concat(), "branch.svg"),
        (
            [&["trace", &file], &over[..], &of[..]].concat(),
            "limit_curve.svg",
        ),
        (vec!["limits", &file], "branch.svg"),
        (vec!["solve", &file], "loop.svg"),
    ] {
        let figures = directory.join(arguments[0]).join(name);
        let figures = figures.to_str().unwrap();
        json(&[&arguments[..], &["--plot", figures]].concat());
        let figure = fs::read_to_string(format!("{figures}/{name}")).unwrap();
        assert!(figure.starts_with("<svg") && figure.trim_end().ends_with("</svg>"));
        assert!(figure.contains("Flat-belt drive with an idler") && !figure.contains("NaN"));
    }
}

#[test]
fn every_number_of_a_loop_has_a_branch_and_limits() {
    for (name, key, from, to) in [
        (
            "serpentine",
            "tensioner.arm.stiffness",
            "15 N*m/rad",
            "30 N*m/rad",
        ),
        (
            "serpentine",
            "tensioner.arm.rest_angle",
            "-60 deg",
            "-50 deg",
        ),
        (
            "serpentine",
            "pulley.water pump.centre.y",
            "290 mm",
            "310 mm",
        ),
        (
            "serpentine",
            "pulley.crankshaft.diameter",
            "150 mm",
            "170 mm",
        ),
        ("serpentine", "pulley.alternator.power", "-1 kW", "3 kW"),
        ("conveyor", "load.belt_length", "19.3 m", "19.4 m"),
        ("conveyor", "tensioner.slide.weight", "4 kN", "8 kN"),
        ("back-side-idler", "friction.coefficient", "0.6", "0.8"),
        ("crossed", "friction.stiffness", "20 N/mm^2", "80 N/mm^2"),
    ] {
        let file = example(name);
        let range = ["--parameter", key, "--from", from, "--to", to];
        let found = json(&[&["trace", &file], &range[..]].concat());
        assert_eq!(found["parameter"], key);
        assert_eq!(found["points"].as_array().unwrap().len(), 41, "{key}");
        let limits = json(&["limits", &file, "--parameter", key]);
        for end in ["smallest", "largest"] {
            assert!(
                limits[end]["reason"].is_string() && limits[end]["pulleys"].is_array(),
                "{key}"
            );
        }
    }
    let output = run(&[
        "limits",
        &example("serpentine"),
        "--parameter",
        "pulley.alternatr.power",
    ]);
    let errors = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(2));
    assert!(
        errors.contains("did you mean `pulley.alternator.power`?"),
        "{errors}"
    );
}

/// Near these ends a span at the idler of the tensioner is so short that the force of the belt changes abruptly with
/// the coordinate.
#[test]
fn a_range_ends_where_pulleys_touch_and_not_just_before() {
    for key in [
        "tensioner.arm.length",
        "pulley.tensioner.diameter",
        "pulley.crankshaft.diameter",
        "pulley.alternator.diameter",
    ] {
        let found = json(&["limits", &example("serpentine"), "--parameter", key]);
        let found = &found["largest"];
        let description = found["description"].as_str().unwrap();
        assert_eq!(found["reason"], "layout", "{key}: {description}");
        assert!(description.contains("overlap"), "{key}: {description}");
    }
}

/// The driver runs ten million times as fast as the belt; a stiff belt tells its length to rounding only.
#[test]
fn rounding_is_no_end_of_a_range() {
    for (name, key, end) in [
        ("crossed", "pulley.driver.radius", "smallest"),
        ("serpentine", "belt.axial_stiffness", "largest"),
    ] {
        let found = json(&["limits", &example(name), "--parameter", key]);
        let found = &found[end];
        assert_eq!(
            found["reason"], "none found",
            "{key}: {}",
            found["description"]
        );
    }
}

/// Standard error of a command that fails.
fn errors(arguments: &[&str]) -> String {
    let output = run(arguments);
    assert!(!output.status.success(), "{arguments:?}");
    String::from_utf8(output.stderr).unwrap()
}

/// A bare speed is in rad/s: one that was meant in rpm makes the belt too fast.
#[test]
fn a_refused_drive_with_a_bare_speed_is_told_its_unit() {
    for (name, key, number) in [
        ("poly-v", "pulleys.driver.speed", "12000"),
        ("back-side-idler", "pulley.motor.speed", "1900"),
    ] {
        let file = example(name);
        let refusal = |speed: &str| errors(&["solve", &file, "--set", &format!("{key}={speed}")]);
        let bare = refusal(number);
        let meant = format!("`{key}` has no unit: it is {number} rad/s");
        assert!(bare.contains(&meant), "{bare}");
        assert!(bare.contains(&format!("write \"{number} rpm\"")), "{bare}");
        let stated = refusal(&format!("{number} rad/s"));
        assert!(!stated.contains("help:"), "{stated}");
    }
}

#[test]
fn a_branch_that_begins_where_the_belt_cannot_be_laid_says_where() {
    let file = example("back-side-idler");
    let range = ["--from", "200 mm", "--to", "400 mm"];
    let trace = ["trace", &file, "--parameter", "pulley.fan.centre.x"];
    let refusal = errors(&[&trace, &range[..]].concat());
    assert!(refusal.contains("overlap"), "{refusal}");
    assert!(
        refusal.contains("help: that is at --from 200 mm; begin where"),
        "{refusal}"
    );
}

/// A number of ribs has no neighbours, and no limits.
#[test]
fn a_whole_number_does_not_vary() {
    let file = example("serpentine");
    let refusal = errors(&["limits", &file, "--parameter", "belt.ribs"]);
    let reason = "`belt.ribs` is a whole number and does not vary";
    assert!(refusal.contains(reason), "{refusal}");
    let listed = refusal.split_once("expected: ").unwrap().1;
    assert!(!listed.contains("belt.ribs"), "{refusal}");
}

/// With the compressor beyond 0.67 m the belt would fit the other way round, too.
#[test]
fn a_belt_that_comes_to_fit_either_way_keeps_its_sense() {
    let file = example("serpentine");
    let trace = ["trace", &file, "--parameter", "pulley.compressor.centre.x"];
    let found = json(&[&trace[..], &["--from", "0.2 m", "--to", "20 m"]].concat());
    assert_eq!(found["end"]["reason"], "target", "{}", found["end"]);
}

#[test]
fn at_the_end_of_its_travel_no_number_is_beyond_itself() {
    let file = example("conveyor");
    let limits = json(&["limits", &file, "--parameter", "load.belt_length"]);
    for end in ["smallest", "largest"] {
        assert_eq!(
            limits[end]["description"],
            "the tensioner `take-up` reaches the end of its travel"
        );
    }
}

#[test]
fn a_v_belt_with_a_tensioner_has_all_that_a_loop_has() {
    let directory = directory("loops-v");
    let text = fs::read_to_string(example("v-power")).unwrap();
    let (head, _) = text.split_once("[pulleys.driver]").unwrap();
    let pulleys = r#"
[[pulley]]
name = "motor"
centre = ["0 mm", "0 mm"]
diameter = "125 mm"
speed = "1450 rpm"
[[pulley]]
name = "idler"
diameter = "90 mm"
side = "outside"
[[pulley]]
name = "fan"
centre = ["500 mm", "0 mm"]
diameter = "250 mm"
power = "5 kW"
[layout]
sense = "counter-clockwise"
[tensioner]
pulley = "idler"
[tensioner.slide]
origin = ["230 mm", "-100 mm"]
direction = "90 deg"
stiffness = "8 N/mm"
preload = "200 N"
rest_position = "0 mm"
"#;
    let path = directory.join("v.toml");
    fs::write(&path, head.to_owned() + pulleys).unwrap();
    let found = json(&["solve", path.to_str().unwrap()]);
    let number = |value: &Value| value.as_f64().unwrap();
    for check in found["checks"].as_array().unwrap() {
        assert!(
            number(&check["deviation"]) <= number(&check["limit"]),
            "{check}"
        );
    }
    assert!(number(&found["convergence"]["error_estimate"]) < 1e-6);
    assert!((number(&found["pulleys"][2]["power_W"]) / 5e3 - 1.0).abs() < 1e-6);
    assert!(found["pulleys"][1]["max_penetration_m"].is_null());
    assert!(number(&found["pulleys"][0]["max_penetration_m"]) > 1e-3);
    assert_eq!(number(&found["tensioner"]["rest_position_m"]), 0.0);
    assert!(number(&found["loop"]["load_factor_limit"]) > 1.0);
    for part in [0, 1] {
        let hubs = found["pulleys"].as_array().unwrap().iter();
        let sum: f64 = hubs.map(|pulley| number(&pulley["hub_load_N"][part])).sum();
        assert!(sum.abs() < 1e-2, "{sum}");
    }
    // A tighter tolerance changes no more than the looser one allows.
    let fine = json(&["solve", path.to_str().unwrap(), "--tolerance", "1e-9"]);
    let [one, other] = [&found, &fine].map(|found| number(&found["spans"][2]["tension_N"]));
    assert!(
        (one / other - 1.0).abs() < 1e-6 && one != other,
        "{one} {other}"
    );
}
