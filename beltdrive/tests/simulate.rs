//! The command `simulate` as its user meets it.

use beltdrive::examples;
use beltdrive::input::{Argument, DriveFile};
use beltdrive::transient::{Motion, Until};
use std::fs;
use std::path::PathBuf;
use std::process::{Command, Output, Stdio};

fn example(name: &str) -> &'static str {
    examples::find(name).expect("a shipped example").text
}

fn directory(name: &str) -> PathBuf {
    let directory = PathBuf::from(env!("CARGO_TARGET_TMPDIR"))
        .join("simulate")
        .join(name);
    fs::create_dir_all(&directory).unwrap();
    directory
}

/// Runs the command on a text in a directory of a name.
fn simulate(name: &str, text: &str, options: &[&str]) -> Output {
    let directory = directory(name);
    fs::write(directory.join("drive.toml"), text).unwrap();
    let mut command = Command::new(env!("CARGO_BIN_EXE_beltdrive"));
    command.args(["simulate", "drive.toml"]).args(options);
    command.current_dir(directory).output().unwrap()
}

#[track_caller]
fn stdout(output: &Output) -> String {
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{errors}");
    String::from_utf8(output.stdout.clone()).unwrap()
}

#[track_caller]
fn fails(output: &Output, status: i32, words: &str) {
    let errors = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(status), "{errors}");
    assert!(errors.contains(words), "{errors}\n{words}");
}

#[test]
fn a_history_goes_to_table_rows_json_and_figures() {
    let options = [
        "--csv",
        "history.csv",
        "--json",
        "history.json",
        "--plot",
        "figures",
        "--at",
        "40 ms",
        "--at",
        "10 ms",
        "--animate",
        "run.svg",
    ];
    let text = stdout(&simulate("outputs", example("slip-pulse"), &options));
    assert!(
        text.lines().all(|line| line.chars().count() <= 100),
        "{text}"
    );
    for words in [
        "Simulation from 0 to 0.2 s",
        "gross slip ends",
        "not accounted for",
    ] {
        assert!(text.contains(words), "{text}");
    }
    let directory = directory("outputs");
    let read = |name: &str| fs::read_to_string(directory.join(name)).unwrap();
    let rows = read("history.csv");
    let head = rows.lines().next().unwrap();
    for column in [
        "time_s",
        "driven_angular_speed_rad_per_s",
        "driven_to_driver_tension_N",
        "driven_torque_N_m",
        "driven_slip_arc_deg",
        "energy_residual_J",
    ] {
        assert!(head.split(',').any(|name| name == column), "{head}");
    }
    assert_eq!(rows.lines().count(), 1 + 401);
    let json: serde_json::Value = serde_json::from_str(&read("history.json")).unwrap();
    let events = json["events"].as_array().unwrap();
    let slip = events
        .iter()
        .find(|event| event["kind"] == "gross slip" && event["pulley"] == "driven");
    let time = slip.unwrap()["time_s"].as_f64().unwrap();
    assert!(time > 0.02 && time < 0.05, "{time}");
    let samples = json["samples"].as_array().unwrap();
    assert_eq!(samples.len(), 401);
    let last = &samples[400];
    let speed = last["driven_angular_speed_rad_per_s"].as_f64().unwrap();
    // It slipped down to 40 rad/s, and vibrates about the speed of before.
    assert!((speed - 119.46).abs() < 2.0, "{speed}");
    assert_eq!(json["run"]["ending"], "time");
    let turnover = json["energy"]["turnover_J"].as_f64().unwrap();
    assert!(json["energy"]["residual_J"].as_f64().unwrap() < 1e-4 * turnover);
    assert!(read("figures/history.svg").contains("gross slip, driven"));
    let along = read("figures/belt.svg");
    assert!(along.find("at 0.010000 s").unwrap() < along.find("at 0.040000 s").unwrap());
    for (figure, instant) in [("loop-1", "at 0.01 s"), ("loop-2", "at 0.04 s")] {
        let figure = read(&format!("figures/{figure}.svg"));
        assert!(figure.contains(instant) && figure.contains("slip zone"));
        assert!(!figure.contains("<animate"));
    }
    // Every fourth of 401 samples.
    let animation = read("run.svg");
    assert!(animation.contains("0 to 0.2 s, 50 times slower than real time"));
    assert_eq!(animation.matches(">t = ").count(), 101);
    assert!(animation.contains(">t = 0.200 s</text>"));
    // A spoke of each pulley and the colours of the pieces of the belt.
    assert_eq!(animation.matches("<animateTransform").count(), 2);
    assert!(animation.matches("attributeName=\"stroke\"").count() > 50);
    assert!(animation.contains("\"command_line\"") && animation.len() < 300_000);
}

#[test]
fn instants_reach_from_the_start_to_the_end() {
    let pulse = example("slip-pulse");
    let at = |name: &str, instant: &str| {
        let at = format!("--at={instant}");
        simulate(name, pulse, &["--until", "10 ms", "--plot", "figures", &at])
    };
    for (name, instant, told) in [
        ("at-start", "0 s", "at 0 s"),
        ("at-end", "10 ms", "at 0.01 s"),
    ] {
        stdout(&at(name, instant));
        let figure = fs::read_to_string(directory(name).join("figures/loop-1.svg")).unwrap();
        assert!(figure.contains(told), "{figure}");
    }
    fails(&at("at-none", "-1 s"), 2, "`--at` must not be negative");
    fails(&at("at-late", "11 ms"), 2, "between 0 and the end");
}

#[test]
fn an_animation_goes_to_a_file_of_its_own_that_is_svg() {
    let text = example("slip-pulse");
    let run = |options: &[&str]| {
        let short = ["--until", "2 ms", "--animate"];
        simulate("animation", text, &[&short, options].concat())
    };
    fails(&run(&["run.png"]), 2, "a file whose name ends in .svg");
    fails(&run(&["-"]), 2, "a file whose name ends in .svg");
    fails(
        &run(&["no/such/run.svg"]),
        2,
        "cannot write figure no/such/run.svg",
    );
    let inside = ["figures/run.svg", "--plot", "figures"];
    fails(&run(&inside), 2, "is where --plot puts its figures");
    let wrote = run(&["run.SVG"]);
    stdout(&wrote);
    assert!(String::from_utf8_lossy(&wrote.stderr).contains("wrote run.SVG"));
}

#[test]
fn the_steady_state_is_reached_or_missed() {
    let options = [
        "--until",
        "steady",
        "--set",
        "transient.cells=60",
        "--set",
        "transient.end=3 s",
        "--set",
        "transient.axial_damping=5 N*s",
    ];
    let without_pulse = example("slip-pulse").replace("100 N*m", "30 N*m");
    let text = stdout(&simulate("steady", &without_pulse, &options));
    assert!(text.contains("to the steady state"), "{text}");
    // A motor and a load that depend on the speed, whose steady state the end of the example leaves time for.
    let text = stdout(&simulate(
        "steady",
        example("soft-start"),
        &["--until", "steady"],
    ));
    assert!(text.contains("to the steady state"), "{text}");
    let options = [
        "--until",
        "steady",
        "--set",
        "transient.cells=60",
        "--set",
        "transient.end=0.06 s",
    ];
    let output = simulate("unsteady", example("slip-pulse"), &options);
    fails(&output, 1, "the drive is not steady at 0.06 s");
    assert!(String::from_utf8_lossy(&output.stdout).contains("not steady in the end"));
}

#[test]
fn points_over_time_come_from_csv_files() {
    let points = example("slip-pulse");
    let start = points.find("load = [").unwrap();
    let named = format!("{}load = \"pulse.csv\"\n", &points[..start]);
    let csv = directory("points").join("pulse.csv");
    let rows =
        "# measured\ntime [ms], remark, torque [kN*mm]\n20,a,30\n20,b,100\n50,c,100\n50,d,30\n";
    fs::write(&csv, rows).unwrap();
    // All but the time that it took.
    let options = ["--until", "0.06 s", "--csv", "history.csv"];
    let history = || fs::read_to_string(directory("points").join("history.csv")).unwrap();
    stdout(&simulate("points", points, &options));
    let from_points = history();
    stdout(&simulate("points", &named, &options));
    assert_eq!(history(), from_points);
    for (text, words) in [
        ("", "there is no line with headings"),
        ("time [ms],torque\n", "there are no rows below the headings"),
        ("time [ms],torque\n1\n", "1 fields under 2 headings"),
        ("time [ms],torqe\n1,1\n", "no column is called `torque`"),
        (
            "time,time,torque\n1,1,1\n",
            "the column `time` stands twice",
        ),
        (
            "time [N],torque\n1,1\n",
            "wrong dimension: expected a time, got a force",
        ),
        ("time,torque\n1,1 N*m\n", "malformed number `1 N*m`"),
        ("time,torque\n1,\n", "missing number"),
        (
            "time,torque\n2,1\n1,1\n",
            "the points of `load` are out of order",
        ),
    ] {
        fs::write(&csv, text).unwrap();
        fails(&simulate("points", &named, &options), 2, words);
    }
    fs::remove_file(&csv).unwrap();
    let output = simulate("points", &named, &options);
    fails(&output, 2, "cannot read pulse.csv");
    // Without a file beside it, as from a library, a name is no points.
    let file = DriveFile::read("drive.toml", &named, &[]).unwrap();
    let error = file.simulation(None).unwrap_err().to_string();
    assert!(error.contains("or the name of a CSV file"), "{error}");
}

/// Whether a process catches an interrupt: the signal 2 is in the set of those that it has handlers for.
#[cfg(target_os = "linux")]
fn catches_interrupts(process: u32) -> bool {
    let status = fs::read_to_string(format!("/proc/{process}/status")).unwrap();
    let caught = { status.lines() }.find_map(|line| line.strip_prefix("SigCgt:"));
    let caught = u64::from_str_radix(caught.unwrap().trim(), 16).unwrap();
    caught & 0b10 != 0
}

#[cfg(target_os = "linux")]
#[test]
fn an_interrupted_run_keeps_what_it_has() {
    let directory = directory("interrupted");
    fs::write(directory.join("drive.toml"), example("slip-pulse")).unwrap();
    let options = "--until=100s --csv=history.csv --json=history.json --plot=figures";
    let mut run = Command::new(env!("CARGO_BIN_EXE_beltdrive"))
        .args(["simulate", "drive.toml"])
        .args(options.split(' '))
        .current_dir(&directory)
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    while run.try_wait().unwrap().is_none() && !catches_interrupts(run.id()) {
        std::thread::yield_now();
    }
    let interrupt = Command::new("kill")
        .args(["-INT", &run.id().to_string()])
        .status();
    assert!(interrupt.unwrap().success());
    let output = run.wait_with_output().unwrap();
    fails(&output, 130, "interrupted at");
    let table = String::from_utf8(output.stdout).unwrap();
    assert!(table.contains("s, interrupted"), "{table}");
    let read = |name: &str| fs::read_to_string(directory.join(name)).unwrap();
    let json: serde_json::Value = serde_json::from_str(&read("history.json")).unwrap();
    assert_eq!(json["run"]["ending"], "interrupted");
    let samples = json["samples"].as_array().unwrap();
    assert_eq!(read("history.csv").lines().count(), 1 + samples.len());
    let reached = samples.last().unwrap()["time_s"].as_f64().unwrap();
    assert!(reached < 100.0, "{reached}");
    assert!(read("figures/history.svg").contains("speed of the pulleys"));
}

#[test]
fn a_run_that_fails_keeps_what_it_has() {
    let text = example("parametric-resonance");
    for (amplitude, words) in [
        (100, "the belt has no possible state after"),
        (400, "the energy ledger does not close"),
    ] {
        let name = format!("failed-{amplitude}");
        let load = format!("transient.pulley.driven.load_amplitude={amplitude} N*m");
        let options =
            "--csv history.csv --json history.json --plot figures --animate run.svg --set";
        let options: Vec<_> = options.split(' ').chain([load.as_str()]).collect();
        let output = simulate(&name, text, &options);
        fails(&output, 1, words);
        let table = String::from_utf8(output.stdout).unwrap();
        assert!(table.contains("s, with an error in the end"), "{table}");
        let read = |file: &str| fs::read_to_string(directory(&name).join(file)).unwrap();
        let json: serde_json::Value = serde_json::from_str(&read("history.json")).unwrap();
        assert_eq!(json["run"]["ending"], "failed");
        let samples = json["samples"].as_array().unwrap();
        assert_eq!(read("history.csv").lines().count(), 1 + samples.len());
        let reached = samples.last().unwrap()["time_s"].as_f64().unwrap();
        assert!((0.005..0.1).contains(&reached), "{reached}");
        assert!(read("figures/history.svg").contains("speed of the pulleys"));
        assert!(read("run.svg").contains("<animate"));
    }
}

#[test]
fn a_soft_motor_brings_a_fan_up_to_the_speed_where_its_line_meets_the_load() {
    let text = example("soft-start").replace("cells = 80", "cells = 40");
    let options = ["--csv", "-", "--set", "transient.interval=50 ms"];
    let rows = stdout(&simulate("soft-start", &text, &options));
    let last: Vec<f64> = { rows.lines().last().unwrap().split(',') }
        .map(|field| field.parse().unwrap())
        .collect();
    let [time, motor, fan] = last[..3] else {
        panic!("{last:?}")
    };
    assert_eq!(time, 3.0);
    // 40 N·m up to 1400 rpm, then down to 0 at 1500 rpm.
    let torque = 40.0 * ((1500.0 - motor * 30.0 / std::f64::consts::PI) / 100.0).min(1.0);
    let load = 2.0 + 0.75 * fan;
    assert!((2.0 * torque / load - 1.0).abs() < 0.02, "{torque} {load}");
    assert!(
        2.0 * fan < motor && 2.0 * fan > 0.98 * motor,
        "{motor} {fan}"
    );
}

#[test]
fn a_file_without_the_table_says_what_is_missing() {
    let kim = example("kim2009-flat");
    let none = simulate("none", kim, &["--until", "1 s"]);
    fails(&none, 2, "nothing says how the drive moves in time");
    fails(&none, 2, "[transient]");
}

#[test]
fn faults_of_the_table_are_shown_where_they_stand() {
    let pulse = example("slip-pulse");
    let cases = [
        (
            "inertia = \"0.005 kg*m^2\"",
            "inertia = \"-1 kg*m^2\"",
            "must be positive",
        ),
        ("inertia = \"0.005 kg*m^2\"", "", "missing key `inertia`"),
        (
            "[\"20 ms\", \"100 N*m\"]",
            "[\"10 ms\", \"100 N*m\"]",
            "out of order: 0.01 after 0.02",
        ),
        (
            "[\"20 ms\", \"100 N*m\"]",
            "[\"20 ms\", \"110 N\"]",
            "wrong dimension",
        ),
        (
            "[\"20 ms\", \"100 N*m\"]",
            "[\"20 ms\"]",
            "a point must have two numbers, got 1",
        ),
        (
            "cells = 120",
            "cells = 2000",
            "must be a whole number from 1 to 1000",
        ),
        (
            "start = \"running\"",
            "start = \"moving\"",
            "unknown state at time 0 `moving`",
        ),
        (
            "start = \"running\"",
            "start = \"rest\"",
            "missing table [transient.pulley.driver]",
        ),
        ("end = \"0.2 s\"", "", "missing key `end` in [transient]"),
        (
            "transient.pulley.driven]",
            "transient.pulley.drivn]",
            "there is no pulley `drivn`",
        ),
        (
            "axial_damping",
            "axial_dampening",
            "did you mean `axial_damping`?",
        ),
        (
            "law = \"epp\"",
            "law = \"coulomb\"",
            "a flat belt in time needs elastic/perfectly-plastic friction",
        ),
        (
            "start = \"running\"",
            "start = \"rest\"\n[transient.pulley.driver]\nspeed = [[0, 0], [0.1, 0], [0.1, 120]]",
            "`speed` must not jump, as it does at 0.1",
        ),
        (
            "start = \"running\"",
            "time_step = \"1 ms\"\nstart = \"running\"",
            "a time step of 1.000e-3 s is unstable",
        ),
    ];
    for (number, (from, to, words)) in cases.into_iter().enumerate() {
        assert!(pulse.contains(from), "{from}");
        let text = pulse.replacen(from, to, 1);
        // What follows a table of a pulley would belong to it.
        let text = match to.contains("[transient.pulley.driver]") {
            true => text.replace(to, "start = \"rest\"") + "\n" + to.split_once('\n').unwrap().1,
            false => text,
        };
        fails(&simulate(&format!("fault-{number}"), &text, &[]), 2, words);
    }
    fails(
        &simulate("until", pulse, &["--until", "soon"]),
        2,
        "or `steady`",
    );
}

#[test]
fn a_file_states_motors_loads_and_ends() {
    let file = DriveFile::read("soft-start", example("soft-start"), &[]).unwrap();
    let until = Argument {
        option: "--until",
        value: "steady",
    };
    let simulation = file.simulation(Some(until)).unwrap();
    assert_eq!(simulation.until, Until::Steady { latest: 3.0 });
    let Motion::Torques { motor: Some(_), .. } = &simulation.axles[0].motion else {
        panic!("a motor")
    };
    let Motion::Torques { motor: None, load } = &simulation.axles[1].motion else {
        panic!("a load")
    };
    assert_eq!((load.per_speed, load.torque.at(1.0)), (0.75, 2.0));
    // What only matters in time is nothing to trace or sweep over.
    assert!(
        file.keys()
            .iter()
            .all(|key| !key.path().starts_with("transient"))
    );
}
