//! The command `modes` as its user meets it, and its eigenvalues against histories.

use beltdrive::examples;
use beltdrive::input::DriveFile;
use beltdrive::transient::{Cells, Motion, Schedule, Simulation, Start, Until};
use beltdrive::{Drive, FrictionLaw, Modes, ModesQuestion, ZoneKind, modes, simulate};
use std::fs;
use std::path::PathBuf;
use std::process::{Command, Output};

fn example(name: &str) -> &'static str {
    examples::find(name).expect("a shipped example").text
}

fn directory(name: &str) -> PathBuf {
    let directory = PathBuf::from(env!("CARGO_TARGET_TMPDIR"))
        .join("modes")
        .join(name);
    fs::create_dir_all(&directory).unwrap();
    directory
}

/// Runs the command on a text in a directory of a name.
fn command(name: &str, text: &str, options: &[&str]) -> Output {
    let directory = directory(name);
    fs::write(directory.join("drive.toml"), text).unwrap();
    let mut command = Command::new(env!("CARGO_BIN_EXE_beltdrive"));
    command.args(["modes", "drive.toml"]).args(options);
    command.current_dir(directory).output().unwrap()
}

#[track_caller]
fn fails(output: &Output, status: i32, words: &str) {
    let errors = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(status), "{errors}");
    assert!(errors.contains(words), "{errors}\n{words}");
}

fn drive(name: &str, cells: usize) -> Simulation {
    let file = DriveFile::read(name, example(name), &[]).unwrap();
    let mut simulation = file.motion().unwrap();
    simulation.cells = Cells::Total(cells);
    simulation
}

fn of(simulation: &Simulation, count: usize) -> Modes {
    let question = ModesQuestion {
        count,
        speeds: None,
    };
    modes(simulation, question, &mut |_, _| {}).unwrap()
}

#[test]
fn modes_go_to_table_rows_json_and_figures() {
    let options = [
        "--set",
        "transient.cells=48",
        "--modes",
        "3",
        "--from",
        "600 rpm",
        "--to",
        "1500 rpm",
        "--csv",
        "modes.csv",
        "--json",
        "modes.json",
        "--plot",
        "figures",
    ];
    let output = command("outputs", example("slip-pulse"), &options);
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{errors}");
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(
        text.lines().all(|line| line.chars().count() <= 100),
        "{text}"
    );
    for words in ["torsional", "sticking", "slip zones held", "Vibrations"] {
        assert!(text.contains(words), "{text}");
    }
    let directory = directory("outputs");
    let read = |name: &str| fs::read_to_string(directory.join(name)).unwrap();
    let json: serde_json::Value = serde_json::from_str(&read("modes.json")).unwrap();
    let first = &json["modes"][0];
    assert_eq!(first["kind"], "torsional");
    assert!(first["growth_per_s"].as_f64().unwrap() < 0.0);
    assert_eq!(first["belt_velocity_shape"].as_array().unwrap().len(), 48);
    let sticking = json["sticking_modes"][0]["frequency_Hz"].as_f64().unwrap();
    assert!(first["frequency_Hz"].as_f64().unwrap() < sticking);
    let over_speed = json["over_speed"].as_array().unwrap();
    assert_eq!(over_speed.len(), 25);
    // The spans vibrate the slower across, the faster the belt runs.
    let across = |row: usize| {
        over_speed[row]["driven_span_frequency_Hz"]
            .as_f64()
            .unwrap()
    };
    assert!(across(24) < across(0));
    assert_eq!(read("modes.csv").lines().count(), 1 + 25);
    assert!(read("figures/campbell.svg").contains("1 × driven"));
    assert!(read("figures/mode_shapes.svg").contains("mode 1, torsional"));
}

#[test]
fn what_has_no_modes_is_refused() {
    let text = example("slip-pulse");
    let without = |key: &str| {
        let lines = text.lines().filter(|line| !line.starts_with(key));
        lines.collect::<Vec<_>>().join("\n")
    };
    fails(&command("inertia", &without("inertia"), &[]), 2, "inertia");
    fails(
        &command("table", example("kim2009-flat"), &[]),
        2,
        "transient",
    );
    fails(
        &command("slips", text, &["--set", "load.torque=300 N*m"]),
        1,
        "slip",
    );
    fails(
        &command(
            "law",
            text,
            &[
                "--set",
                "friction.law=coulomb",
                "--set",
                "friction.stiffness=",
            ],
        ),
        2,
        "epp",
    );
    fails(
        &command("range", text, &["--from", "900 rpm", "--to", "500 rpm"]),
        2,
        "range",
    );
    fails(&command("alone", text, &["--from", "900 rpm"]), 2, "--to");
    let v = example("kim2009").to_owned()
        + "\n[transient]\n[transient.pulley.driven]\ninertia = 0.1\nload = [[\"0 s\", \"1 N*m\"]]\n";
    fails(&command("v", &v, &[]), 2, "only flat belts");
    let creep = [
        "--set",
        "friction.law=creep-rate",
        "--set",
        "friction.stiffness=",
    ];
    let steep = [&creep[..], &["--set", "friction.velocity=1e-7 m/s"]].concat();
    fails(
        &command("steep", text, &steep),
        1,
        "Hz are lost in rounding",
    );
}

/// The eigenvalue of the response of the driven pulley to a small step of its load, from two histories whose steps
/// differ in sign: growth and angular frequency.
fn heard(simulation: &Simulation, [growth, frequency]: [f64; 2]) -> [f64; 2] {
    let driven = 1;
    let histories = [-1.0, 1.0].map(|sign| {
        let mut simulation = simulation.clone();
        let Motion::Torques { load, .. } = &mut simulation.axles[driven].motion else {
            panic!("it turns freely");
        };
        let torque = load.torque.at(0.0);
        load.torque = Schedule::step(1e-3, [torque, torque + sign * 0.01]);
        simulation.start = Start::Running;
        simulation.until = Until::Time(0.1);
        simulation.interval = 2e-4;
        simulate(&simulation, &mut |_, _| true).unwrap()
    });
    let [less, more] = histories.each_ref().map(|history| &history.samples);
    let samples = less.iter().zip(more).filter(|(less, _)| less.time > 0.01);
    let samples = samples.map(|(less, more)| {
        let [less_speed, more_speed] =
            [less, more].map(|sample| sample.pulleys[driven].angular_speed);
        (less.time, more_speed - less_speed)
    });
    let samples: Vec<_> = samples.collect();
    // A slow drift, of the third degree in time, and a vibration, whose growth and frequency are sought by Gauss and
    // Newton.
    let mut found = nalgebra::Vector2::new(growth, frequency);
    let mut linear = nalgebra::Vector6::zeros();
    for _ in 0..20 {
        let basis = |time: f64| {
            let (sine, cosine) = (found.y * time).sin_cos();
            let size = (found.x * time).exp();
            let part = 10.0 * time;
            let [square, cube] = [2, 3].map(|power| part.powi(power));
            nalgebra::Vector6::new(1.0, part, square, cube, size * cosine, size * sine)
        };
        let mut normal = nalgebra::SMatrix::<f64, 8, 8>::zeros();
        let mut right = nalgebra::SVector::<f64, 8>::zeros();
        for &(time, value) in &samples {
            let basis = basis(time);
            let by_growth = time * (linear[4] * basis[4] + linear[5] * basis[5]);
            let by_frequency = time * (linear[5] * basis[4] - linear[4] * basis[5]);
            let mut row = nalgebra::SVector::<f64, 8>::zeros();
            row.fixed_rows_mut::<6>(0).copy_from(&basis);
            (row[6], row[7]) = (by_growth, by_frequency);
            normal += row * row.transpose();
            right += row * (value - basis.dot(&linear));
        }
        if linear == nalgebra::Vector6::zeros() {
            let normal = normal.fixed_view::<6, 6>(0, 0).into_owned();
            let right = right.fixed_rows::<6>(0).into_owned();
            linear = normal.lu().solve(&right).expect("independent functions");
            continue;
        }
        let step = normal.lu().solve(&right).expect("independent functions");
        linear += step.fixed_rows::<6>(0);
        found += step.fixed_rows::<2>(6);
    }
    [found.x, found.y]
}

/// The first mode of `slip-pulse` at a torque in N·m with a friction law and a damping of bristles in N·s/m² is what
/// is heard of a small step of its load.
fn is_heard(torque: f64, law: FrictionLaw, friction_damping: f64) {
    let mut simulation = drive("slip-pulse", 48);
    let load = format!("load.torque = {torque} N*m");
    let file = DriveFile::read("slip-pulse", example("slip-pulse"), &[load]).unwrap();
    simulation.drive = Drive {
        law,
        ..file.drive().unwrap()
    };
    simulation.friction_damping = friction_damping;
    simulation.axial_damping = 2.0;
    for axle in &mut simulation.axles {
        if let Motion::Torques { load, .. } = &mut axle.motion {
            load.torque = Schedule::constant(torque);
        }
    }
    let found = of(&simulation, 4);
    let mode = &found.slipping[0];
    let known = [mode.growth, mode.angular_frequency];
    // Slip zones tell in the modes.
    let zones = found.state.pulleys.iter().flat_map(|pulley| &pulley.zones);
    let slips = { zones }.any(|zone| zone.kind == ZoneKind::Slip && zone.to > zone.from);
    let below = found.sticking[0].angular_frequency;
    assert_eq!(slips, (known[1] / below - 1.0).abs() > 1e-3);
    let [growth, frequency] = heard(&simulation, known);
    println!(
        "{law:?} {friction_damping} {torque} N·m, slip {slips}, below {below}: {known:?} heard as {growth} {frequency}: off by {:e} {:e}",
        growth / known[0] - 1.0,
        frequency / known[1] - 1.0
    );
    assert!(
        (frequency / known[1] - 1.0).abs() < 3e-4,
        "{known:?} {frequency}"
    );
    assert!((growth / known[0] - 1.0).abs() < 0.01, "{known:?} {growth}");
}

const BRISTLES: FrictionLaw = FrictionLaw::Epp { stiffness: 2e8 };

#[test]
fn a_small_step_of_the_load_is_heard_as_the_first_mode() {
    for torque in [0.0, 30.0] {
        is_heard(torque, BRISTLES, 0.0);
    }
}

#[test]
fn it_is_so_with_damped_bristles() {
    for torque in [0.0, 30.0] {
        for damping in [1e4, 1e5] {
            is_heard(torque, BRISTLES, damping);
        }
    }
}

#[test]
fn it_is_so_with_creep_rate_friction() {
    for torque in [0.0, 30.0] {
        for velocity in [0.1, 0.03] {
            is_heard(torque, FrictionLaw::CreepRate { velocity }, 0.0);
        }
    }
}
