//! The command `stability` as its user meets it, against converged eigenvalues.

use serde_json::Value;
use std::{
    fs,
    path::{Path, PathBuf},
    process::{Command, Output},
};

fn example(name: &str) -> String {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let path = root.join("examples").join(name).with_extension("toml");
    path.to_str().unwrap().to_owned()
}

fn stability(drive: &str, options: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_beltdrive"));
    command.args(["stability", &example(drive)]).args(options);
    command.output().unwrap()
}

/// The flat belt of Kim (2009) with the normal force of the thesis.
fn kim(options: &[&str]) -> Output {
    let model = ["--set", "model.normal_force=thesis"];
    stability("kim2009-flat", &[&model, options].concat())
}

#[track_caller]
fn stdout(output: Output) -> String {
    let errors = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(0), "{errors}");
    String::from_utf8(output.stdout).unwrap()
}

#[track_caller]
fn fails(output: &Output, status: i32, reason: &str) {
    let errors = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(status), "{errors}");
    assert!(
        errors.contains(reason) && !errors.contains("panicked"),
        "{errors}"
    );
    assert!(output.stdout.is_empty());
}

fn json(options: &[&str]) -> Value {
    let output = kim(&[options, &["--json", "-"]].concat());
    serde_json::from_str(&stdout(output)).unwrap()
}

#[track_caller]
fn close(found: &Value, expected: f64, tolerance: f64) {
    let found = found.as_f64().unwrap();
    let error = (found - expected).abs();
    assert!(error <= tolerance, "{found} for {expected}: {error:.1e}");
}

/// A fresh directory of this test run.
fn directory(name: &str) -> PathBuf {
    let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _ = fs::remove_dir_all(&path);
    path
}

#[test]
fn the_drive_of_kim_has_its_eigenvalues() {
    let report = json(&[]);
    close(&report["critical_speed_m_per_s"], 879.12, 0.005);
    assert_eq!(report["load"]["tight_tension_N"], 800.0);
    let driven = &report["driven"]["forms"];
    let thesis = driven["thesis"]["modes"].as_array().unwrap();
    assert_eq!(thesis.len(), 12);
    for (mode, (growth, frequency)) in thesis.iter().zip([
        (-128.177, 18_740.2),
        (-12.3965, 31_072.4),
        (-32.1234, 37_919.5),
    ]) {
        close(&mode["growth_per_s"], growth, 1e-3);
        close(&mode["angular_frequency_rad_per_s"], frequency, 0.1);
        assert_eq!(mode["grows"], false);
        close(&mode["method_difference"], 0.0, 1e-10);
        let shape = mode["shape"]["real"].as_array().unwrap();
        assert_eq!(
            shape.len(),
            mode["shape"]["arc_length_m"].as_array().unwrap().len()
        );
    }
    assert_eq!(driven["thesis"]["largest_growth"]["mode"], 2);
    assert_eq!(driven["thesis"]["grows"], false);
    assert!(driven["thesis"]["onset"].is_null());
    // With the terms kept that the thesis leaves out nothing grows or decays.
    for pulley in ["driver", "driven"] {
        let conservative = &report[pulley]["forms"]["conservative"];
        for mode in conservative["modes"].as_array().unwrap() {
            close(&mode["growth_per_s"], 0.0, 1e-6);
        }
        assert_eq!(conservative["high_mode_limit_per_s"], 0.0);
    }
}

#[test]
fn the_driver_turns_unstable() {
    let report = json(&["--modes", "3"]);
    let thesis = &report["driver"]["forms"]["thesis"];
    assert_eq!(thesis["grows"], false);
    let onset = &thesis["onset"];
    close(&onset["tight_tension_N"], 1698.85, 0.005);
    assert_eq!(onset["mode"], 2);
    for (load, grows) in [("1698 N", false), ("1700 N", true)] {
        let report = json(&["--set", &format!("load.tight_tension={load}")]);
        let thesis = &report["driver"]["forms"]["thesis"];
        assert_eq!(thesis["grows"], grows, "{load}");
        assert_eq!(thesis["modes"][1]["grows"], grows, "{load}");
        assert_eq!(report["driven"]["forms"]["thesis"]["grows"], false);
    }
}

#[test]
fn the_table_says_what_it_means() {
    for (load, meaning) in [
        (
            "800 N",
            "the belt on the driver turns unstable at a tight tension of 1698.85 N",
        ),
        (
            "2 kN",
            "the belt is unstable on the driver, as it is from a tight tension of 1698.85 N on",
        ),
        ("250 N", "the belt slips nowhere at this load"),
    ] {
        let load = format!("load.tight_tension={load}");
        let text = stdout(kim(&["--set", &load]));
        assert!(
            text.lines().all(|line| line.chars().count() <= 100),
            "{text}"
        );
        let words: Vec<_> = text.split_whitespace().collect();
        assert!(words.join(" ").contains(meaning), "{text}");
    }
    let text = stdout(stability("flat-unequal", &["--modes", "2"]));
    assert!(text.contains("at this load and at all that were"), "{text}");
}

#[test]
fn files_and_figures_are_written() {
    let directory = directory("stability");
    let csv = directory.join("modes.csv");
    let paths = [&directory, &csv].map(|path| path.to_str().unwrap().to_owned());
    let options = ["--modes", "4", "--quiet", "--plot", &paths[0]];
    assert_eq!(stdout(kim(&options)), "");
    assert_eq!(
        stdout(kim(&["--modes", "4", "--quiet", "--csv", &paths[1]])),
        ""
    );
    let rows = fs::read_to_string(csv).unwrap();
    assert_eq!(rows.lines().count(), 1 + 2 * 3 * 4);
    assert!(rows.contains("\ndriven,thesis,1,-128.17"), "{rows}");
    for (name, needle) in [
        ("modes.svg", "driven, mode 3"),
        ("spectrum.svg", "growth with"),
    ] {
        let text = fs::read_to_string(directory.join(name)).unwrap();
        assert!(text.contains(needle) && !text.contains("NaN"), "{name}");
    }
}

#[test]
fn what_is_not_modelled_is_refused() {
    fails(
        &stability("kim2009", &[]),
        2,
        "the stability of V-belt drives is not modelled",
    );
    let creep = stability("kim2009-flat", &["--set", "friction.law=creep-rate"]);
    fails(&creep, 2, "friction laws epp and coulomb only");
    for modes in ["0", "61", "x"] {
        fails(
            &stability("kim2009-flat", &["--modes", modes]),
            2,
            "--modes",
        );
    }
}

#[test]
fn coulomb_friction_holds_the_belt_before_it_slips() {
    let text = stdout(kim(&["--set", "friction.law=coulomb", "--json", "-"]));
    let report: Value = serde_json::from_str(&text).unwrap();
    let driver = &report["driver"];
    // Every motion grows alike: the gain of friction over the slip zone.
    let natural = &driver["forms"]["natural_outlet"];
    assert!(natural["largest_growth"]["mode"].is_null());
    let shape = &driver["forms"]["thesis"]["modes"][0]["shape"];
    let (places, real) = (&shape["arc_length_m"], &shape["real"]);
    let transition = driver["transition_m"].as_f64().unwrap();
    let places = places
        .as_array()
        .unwrap()
        .iter()
        .map(|s| s.as_f64().unwrap());
    let held = places.take_while(|s| *s < transition).count();
    assert!(held > 100);
    assert!(real.as_array().unwrap()[..held].iter().all(|f| *f == 0.0));
}
