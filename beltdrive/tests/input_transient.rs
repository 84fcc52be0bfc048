//! What a drive file with a fault in `[transient]` is answered: one error, at the line of the fault, before any step.

use beltdrive::input::{Argument, DriveFile};
use beltdrive::simulate;

/// A right drive file; the tables of the two pulleys and of the spans stand at its end.
const DRIVE: &str = r#"[belt]
type = "flat"
mass_per_length = "0.1036 kg/m"
axial_stiffness = "80068 N"

[friction]
law = "epp"
coefficient = 1.2
stiffness = "2e8 N/m^2"

[pulleys.driver]
radius = "81.25 mm"
speed = "120 rad/s"

[pulleys.driven]
radius = "81.25 mm"

[layout]
centre_distance = "250 mm"

[load]
setup_tension = "436 N"
torque = "30 N*m"

[transient]
end = "2 ms"
cells = 40

[transient.transverse]
damping = "0.1 N*s/m^2"

[transient.pulley.driver]
speed = [["0 s", "0 rad/s"], ["10 ms", "20 rad/s"]]

[transient.pulley.driven]
inertia = "0.005 kg*m^2"
load = [["0 s", "0 N*m"], ["1 ms", "5 N*m"]]
"#;

const TRANSIENT: &str = "[transient]";
const ACROSS: &str = "[transient.transverse]";
const DRIVER: &str = "[transient.pulley.driver]";
const DRIVEN: &str = "[transient.pulley.driven]";

/// The drive file with lines first in a table, in place of those with the same keys.
fn with(table: &str, lines: &str) -> String {
    let (before, rest) = DRIVE.split_once(&format!("{table}\n")).expect("a table");
    let end = rest.find("\n[").map_or(rest.len(), |end| end + 1);
    let (own, after) = rest.split_at(end);
    let is_replaced = |line: &&str| {
        let key = |line: &str| line.split('=').next().map(|key| key.trim().to_owned());
        lines.lines().any(|new| key(new) == key(line))
    };
    let kept: String = { own.lines().filter(|line| !is_replaced(line)) }
        .map(|line| format!("{line}\n"))
        .collect();
    format!("{before}{table}\n{lines}\n{kept}{after}")
}

/// What a text is answered; none if it runs.
fn answer(text: &str) -> Option<String> {
    let read = || {
        let file = DriveFile::read("drive.toml", text, &[])?;
        let simulation = file.simulation(None)?;
        Ok((file, simulation))
    };
    let (file, simulation) = match read() {
        Ok(read) => read,
        Err(diagnostic) => {
            let diagnostic: beltdrive::input::Diagnostic = diagnostic;
            return Some(diagnostic.to_string());
        }
    };
    let error = simulate(&simulation, &mut |_, _| true).err()?;
    let placed = file.of_simulation(&simulation, &error);
    Some(placed.map_or_else(|| format!("without a place: {error}"), |at| at.to_string()))
}

/// Answers to lines in a table: an error at the first of them that has all words.
#[track_caller]
fn each_is_answered(cases: &[(&str, &str, &[&str])]) {
    for &(table, lines, words) in cases {
        let text = with(table, lines);
        let found = answer(&text).unwrap_or_else(|| panic!("{table} {lines} runs"));
        let at = { text.lines() }.position(|line| line == table).unwrap() + 2;
        let places = at..at + lines.lines().count();
        let is_placed =
            { places.clone() }.any(|line| found.contains(&format!("--> drive.toml:{line}:")));
        assert!(is_placed, "{table} {lines}: not in {places:?}\n{found}");
        for words in words {
            assert!(found.contains(words), "{table} {lines}: {words}\n{found}");
        }
    }
}

#[test]
fn the_right_file_runs() {
    assert_eq!(answer(DRIVE), None);
}

#[test]
fn numbers_out_of_range_are_refused() {
    each_is_answered(&[
        (
            TRANSIENT,
            r#"end = "0 s""#,
            &["`transient.end` must be positive", "a time"],
        ),
        (TRANSIENT, r#"end = "-1 s""#, &["must be positive"]),
        (TRANSIENT, "end = nan", &["is not a finite number"]),
        (TRANSIENT, r#"end = "inf s""#, &["is not a finite number"]),
        (TRANSIENT, r#"interval = "0 s""#, &["must be positive"]),
        (TRANSIENT, r#"interval = "-1 ms""#, &["must be positive"]),
        (TRANSIENT, r#"time_step = "0 s""#, &["must be positive"]),
        (TRANSIENT, r#"time_step = "-1 us""#, &["must be positive"]),
        (TRANSIENT, "cells = 0", &["a whole number from 1 to 1000"]),
        (TRANSIENT, "cells = -4", &["a whole number from 1 to 1000"]),
        (TRANSIENT, "cells = 3.5", &["a whole number from 1 to 1000"]),
        (TRANSIENT, "cells = 1e9", &["a whole number from 1 to 1000"]),
        (
            TRANSIENT,
            r#"axial_damping = "-1 N*s""#,
            &["must not be negative"],
        ),
        (
            TRANSIENT,
            r#"friction_damping = "-1 N*s/m^2""#,
            &["must not be negative"],
        ),
        (
            ACROSS,
            r#"damping = "-1 N*s/m^2""#,
            &["must not be negative"],
        ),
        (
            ACROSS,
            r#"gravity = "-9.81 m/s^2""#,
            &["must not be negative"],
        ),
        (
            ACROSS,
            r#"gravity_direction = "inf deg""#,
            &["is not a finite number"],
        ),
        (
            DRIVEN,
            r#"inertia = "0 kg*m^2""#,
            &["must be positive", "0.005 kg*m^2"],
        ),
        (DRIVEN, r#"inertia = "-1 kg*m^2""#, &["must be positive"]),
        (DRIVEN, "inertia = nan", &["is not a finite number"]),
        (DRIVER, r#"inertia = "-1 kg*m^2""#, &["must be positive"]),
        (
            DRIVEN,
            r#"load = [["0 s", "nan N*m"]]"#,
            &["is not a finite number"],
        ),
        (
            DRIVEN,
            r#"load = [["inf s", "1 N*m"]]"#,
            &["is not a finite number"],
        ),
        (
            DRIVEN,
            r#"load_per_speed = "-1 N*m*s/rad""#,
            &["must not be negative"],
        ),
        (
            DRIVEN,
            "load_amplitude = \"-5 N*m\"\nload_frequency = \"50 Hz\"",
            &["must not be negative"],
        ),
        (
            DRIVEN,
            "load_amplitude = \"5 N*m\"\nload_frequency = \"0 Hz\"",
            &["must be positive"],
        ),
        (DRIVEN, r#"run_out = "-0.1 mm""#, &["must not be negative"]),
        (
            DRIVEN,
            "run_out = \"0.1 mm\"\nrun_out_order = 0",
            &["a whole number"],
        ),
        (
            DRIVEN,
            "run_out = \"0.1 mm\"\nrun_out_order = 1.5",
            &["a whole number"],
        ),
        (DRIVEN, r#"pluck = "nan mm""#, &["is not a finite number"]),
        (
            DRIVEN,
            "pluck = \"1 mm\"\npluck_mode = 0",
            &["a whole number"],
        ),
        (
            DRIVEN,
            "pluck = \"1 mm\"\npluck_mode = 1001",
            &["a whole number"],
        ),
    ]);
}

#[test]
fn wrong_units_and_types_are_refused() {
    each_is_answered(&[
        (
            TRANSIENT,
            r#"end = "1 m""#,
            &["expected a time, got a length", "0.6 s"],
        ),
        (
            TRANSIENT,
            "end = [1]",
            &["must be a quantity, got an array"],
        ),
        (
            TRANSIENT,
            "end = true",
            &["must be a quantity, got a boolean"],
        ),
        (
            TRANSIENT,
            r#"interval = "1 kg""#,
            &["expected a time, got a mass"],
        ),
        (
            TRANSIENT,
            r#"time_step = "1 N""#,
            &["expected a time, got a force"],
        ),
        (TRANSIENT, r#"cells = "many""#, &["malformed number `many`"]),
        (
            TRANSIENT,
            r#"axial_damping = "1 N""#,
            &["expected an axial damping, got a force"],
        ),
        (TRANSIENT, "start = 1", &["must be a text, got a number"]),
        (
            ACROSS,
            r#"damping = "1 N*s""#,
            &["expected a damping per length"],
        ),
        (
            ACROSS,
            r#"gravity = "9.81 m/s""#,
            &["expected an acceleration, got a velocity"],
        ),
        (
            ACROSS,
            r#"gravity_direction = "1 m""#,
            &["expected an angle, got a length"],
        ),
        (
            DRIVEN,
            r#"inertia = "1 kg""#,
            &["expected a moment of inertia, got a mass"],
        ),
        (
            DRIVEN,
            "load = 30",
            &["must be an array of points, each a pair, or the name of a CSV file, got a number"],
        ),
        (
            DRIVEN,
            r#"load = "30 N*m""#,
            &["must be an array of points"],
        ),
        (
            DRIVEN,
            "load = [[]]",
            &["a point must have two numbers, got 0"],
        ),
        (
            DRIVEN,
            r#"load = [["1 s", "1 N*m", "2 N*m"]]"#,
            &["two numbers, got 3"],
        ),
        (
            DRIVEN,
            r#"load = [["1 s", "1 N"]]"#,
            &["expected a torque, got a force"],
        ),
        (
            DRIVEN,
            r#"load_per_speed = "1 N*m""#,
            &["expected a torque per angular speed"],
        ),
        (DRIVEN, "load_sense = 3", &["must be a text, got a number"]),
        (
            DRIVEN,
            "load_amplitude = \"5 N*m\"\nload_frequency = \"50 s\"",
            &["expected an angular speed, got a time"],
        ),
        (
            DRIVEN,
            r#"motor_torque = [["0 rpm", "10 N*m"]]"#,
            &["expected a time, got an angular speed"],
        ),
        (
            DRIVEN,
            r#"motor_torque_over_speed = [["0 s", "10 N*m"]]"#,
            &["expected an angular speed, got a time"],
        ),
        (
            DRIVER,
            r#"speed = [["0 s", "0 rad"]]"#,
            &["expected an angular speed, got an angle"],
        ),
        (
            DRIVEN,
            r#"run_out = "1 N""#,
            &["expected a length, got a force"],
        ),
        (
            DRIVEN,
            r#"pluck = "1 N""#,
            &["expected a length, got a force"],
        ),
    ]);
}

#[test]
fn misspelt_keys_and_words_are_answered_with_the_right_ones() {
    each_is_answered(&[
        (
            TRANSIENT,
            r#"ende = "1 s""#,
            &["unknown key `ende`", "did you mean `end`?"],
        ),
        (TRANSIENT, "celsl = 40", &["did you mean `cells`?"]),
        (
            TRANSIENT,
            r#"intervall = "1 ms""#,
            &["did you mean `interval`?"],
        ),
        (
            TRANSIENT,
            r#"start = "runing""#,
            &["did you mean `running`?"],
        ),
        (
            ACROSS,
            r#"gravty = "9.81 m/s^2""#,
            &["did you mean `gravity`?"],
        ),
        (DRIVEN, "inertai = 1", &["did you mean `inertia`?"]),
        (
            DRIVEN,
            r#"motor_torqe = [["0 s", "1 N*m"]]"#,
            &["did you mean `motor_torque`?"],
        ),
        (
            DRIVEN,
            r#"load_sense = "oneway""#,
            &["did you mean `one-way`?"],
        ),
        (DRIVEN, r#"pluk = "1 mm""#, &["did you mean `pluck`?"]),
    ]);
    let text = DRIVE.replace("pulley.driven]", "pulley.drivn]");
    let found = answer(&text).unwrap();
    assert!(found.contains("there is no pulley `drivn`"), "{found}");
    assert!(found.contains("did you mean `driven`?"), "{found}");
}

#[test]
fn contradictions_and_missing_halves_are_told() {
    each_is_answered(&[
        (
            DRIVEN,
            "motor_torque = [[\"0 s\", \"1 N*m\"]]\nmotor_torque_over_speed = [[\"0 rpm\", \"1 N*m\"]]",
            &["a torque over time and one over speed", "one of them"],
        ),
        (
            DRIVEN,
            "speed = [[\"0 s\", \"0 rpm\"]]\nload = [[\"0 s\", \"1 N*m\"]]",
            &[
                "the speed of `driven` is given",
                "either `speed`, or torques",
            ],
        ),
        (
            DRIVEN,
            "run_out_order = 2",
            &["`run_out_order` needs an amplitude", "`run_out`"],
        ),
        (
            DRIVEN,
            "pluck_mode = 2",
            &["`pluck_mode` needs an amplitude", "`pluck`"],
        ),
    ]);
    for (lines, missing) in [
        (
            r#"load_amplitude = "5 N*m""#,
            "missing key `load_frequency`",
        ),
        (
            r#"load_frequency = "50 Hz""#,
            "missing key `load_amplitude`",
        ),
    ] {
        let found = answer(&with(DRIVEN, lines)).unwrap();
        assert!(found.contains(missing), "{found}");
    }
    let without = with(DRIVEN, r#"run_out = "0.1 mm""#)
        .replace("[transient.transverse]\ndamping = \"0.1 N*s/m^2\"\n", "");
    let found = answer(&without).unwrap();
    assert!(
        found.contains("nothing says that the spans move across"),
        "{found}"
    );
}

#[test]
fn tables_out_of_order_and_with_jumps_are_refused_where_they_stand() {
    each_is_answered(&[
        (DRIVEN, "load = []", &["`load` has no points"]),
        (
            DRIVEN,
            r#"load = [["1 s", "1 N*m"], ["0 s", "2 N*m"]]"#,
            &[
                "out of order: 0 after 1",
                ":27",
                "points in ascending order",
            ],
        ),
        (
            DRIVEN,
            r#"motor_torque_over_speed = [["1 rad/s", "1 N*m"], ["0 rad/s", "0 N*m"]]"#,
            &["out of order: 0 after 1"],
        ),
        (
            DRIVEN,
            r#"motor_torque_over_speed = [["1 rad/s", "1 N*m"], ["1 rad/s", "0 N*m"]]"#,
            &[
                "must not jump, as it does at 1",
                "a steep line between them",
            ],
        ),
        (
            DRIVER,
            r#"speed = [["0 s", "0 rad/s"], ["0 s", "9 rad/s"]]"#,
            &["`speed` must not jump, as it does at 0"],
        ),
        (
            DRIVER,
            r#"speed = [["0 s", "9 rad/s"]]"#,
            &["cannot start with a speed of 9 rad/s: let it rise from 0"],
        ),
    ]);
    // What is right: one point, points before the start, and a jump of a torque.
    for load in [
        r#"load = [["0 s", "1 N*m"]]"#,
        r#"load = [["-1 s", "0 N*m"], ["1 ms", "1 N*m"]]"#,
        r#"load = [["1 ms", "0 N*m"], ["1 ms", "0 N*m"], ["1 ms", "1 N*m"]]"#,
    ] {
        assert_eq!(answer(&with(DRIVEN, load)), None, "{load}");
    }
}

#[test]
fn runs_that_would_never_end_or_fill_the_memory_are_refused_before_they_begin() {
    each_is_answered(&[
        (
            TRANSIENT,
            r#"interval = "2e-12 s""#,
            &["interval: 1e9 samples, one every 2e-12 s up to 0.002 s, are more than 1e6"],
        ),
        (TRANSIENT, r#"end = "1e6 s""#, &["interval: 1e9 samples"]),
        (
            TRANSIENT,
            r#"time_step = "1 ms""#,
            &["is unstable: the largest stable one is"],
        ),
        (
            TRANSIENT,
            r#"time_step = "1e-15 s""#,
            &[
                "2e12 time steps of 1.0e-15 s, more than 1e9",
                "the step asked for",
            ],
        ),
        (
            TRANSIENT,
            r#"axial_damping = "1e9 N*s""#,
            &["more than 1e9, because of axial damping"],
        ),
        (
            ACROSS,
            r#"damping = "1e12 N*s/m^2""#,
            &["damping of the spans across"],
        ),
        (
            DRIVEN,
            r#"inertia = "1e-30 kg*m^2""#,
            &["on a light pulley"],
        ),
        (
            DRIVEN,
            r#"load_per_speed = "1e30 N*m*s/rad""#,
            &["torques that depend on the speed"],
        ),
        (
            DRIVEN,
            "load_amplitude = \"1 N*m\"\nload_frequency = \"1e12 Hz\"",
            &["because of a pulsation"],
        ),
        (
            DRIVEN,
            "pluck = \"1e-6 m\"\npluck_mode = 100",
            &["100 half waves of a pluck need two cells each"],
        ),
    ]);
}

#[test]
fn what_another_table_is_at_fault_for_is_shown_there() {
    for (from, to, line, words) in [
        (
            "\"epp\"",
            "\"coulomb\"",
            7,
            "needs elastic/perfectly-plastic friction",
        ),
        (
            "cells = 40",
            "cells = 40\nstart = \"running\"",
            0,
            "its speed starts with 0 rad/s",
        ),
    ] {
        assert!(DRIVE.contains(from));
        let text = DRIVE.replace(from, to);
        let line = match line {
            0 => {
                { text.lines() }
                    .position(|line| line.starts_with("speed = [["))
                    .unwrap()
                    + 1
            }
            line => line,
        };
        let found = answer(&text).unwrap();
        assert!(
            found.contains(&format!("--> drive.toml:{line}:")),
            "{found}"
        );
        assert!(found.contains(words), "{found}");
    }
}

#[test]
fn a_pulsation_is_never_steady() {
    let text = with(
        DRIVEN,
        "load_amplitude = \"1 N*m\"\nload_frequency = \"50 Hz\"",
    );
    let file = DriveFile::read("drive.toml", &text, &[]).unwrap();
    let until = Argument {
        option: "--until",
        value: "steady",
    };
    let simulation = file.simulation(Some(until)).unwrap();
    let error = simulate(&simulation, &mut |_, _| true).unwrap_err();
    let found = file.of_simulation(&simulation, &error).unwrap().to_string();
    assert!(found.contains("the drive is never steady"), "{found}");
    assert!(found.contains("| load_frequency = "), "{found}");
}

#[test]
fn a_belt_without_tension_is_refused_or_reported() {
    let found = answer(&DRIVE.replace("436 N", "0 N")).unwrap();
    assert!(
        found.contains("`load.setup_tension` must be positive"),
        "{found}"
    );
    // Hardly any tension: the belt gives way, and the run says where it was slack.
    assert_eq!(answer(&DRIVE.replace("436 N", "0.1 N")), None);
}
