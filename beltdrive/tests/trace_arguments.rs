//! What the command line is answered where it names what cannot be traced.

use beltdrive::input::{self, Argument, Key};
use beltdrive::{Drive, examples};
use insta::assert_snapshot;

/// A shipped drive with overrides.
fn example(name: &str, overrides: &[&str]) -> Drive {
    let overrides: Vec<_> = overrides.iter().map(|text| (*text).to_owned()).collect();
    let example = examples::find(name).unwrap();
    input::parse(example.name, example.text, &overrides).unwrap()
}

/// The thesis drive with overrides.
fn drive(overrides: &[&str]) -> Drive {
    example("kim2009", overrides)
}

/// The error of an entry of the thesis drive with overrides.
#[track_caller]
fn key_error(overrides: &[&str], value: &str) -> String {
    error_of(&drive(overrides), value)
}

/// The error of an entry of a drive.
#[track_caller]
fn error_of(drive: &Drive, value: &str) -> String {
    let option = "--parameter";
    let argument = Argument { option, value };
    argument.key(drive).unwrap_err().to_string()
}

/// The value of an entry of the thesis drive, or the error.
#[track_caller]
fn value(path: &str, value: &str) -> Result<f64, String> {
    let drive = drive(&[]);
    let option = "--from";
    let key = Key::all(&drive).find(|key| key.path() == path).unwrap();
    let argument = Argument { option, value };
    let value = argument.value(key, &drive, None);
    value.map_err(|error| error.to_string())
}

#[track_caller]
fn value_error(path: &str, text: &str) -> String {
    value(path, text).unwrap_err()
}

#[test]
fn misspelled_entries() {
    assert_snapshot!(key_error(&[], "friction.coeficient"), @r"
    error: unknown key `friction.coeficient`
      --> command line:1:13
      |
    1 | --parameter friction.coeficient
      |             ^^^^^^^^^^^^^^^^^^^
    expected: one of `belt.mass_per_length`, `belt.axial_stiffness`, `belt.radial_stiffness`, `groove.half_angle`, `friction.coefficient`, `pulleys.driver.radius`, `pulleys.driver.speed`, `pulleys.driven.radius`, `layout.centre_distance`, `load.slack_tractive_tension`, `load.tight_tractive_tension`
    help: did you mean `friction.coefficient`?
    ");
    let error = key_error(&["friction.law=epp"], "stifness");
    assert!(
        error.ends_with("did you mean `friction.stiffness`?"),
        "{error}"
    );
    let error = key_error(&[], "tight_tractive_tension");
    assert!(
        error.ends_with("did you mean `load.tight_tractive_tension`?"),
        "{error}"
    );
}

/// The message of an error and its help.
fn shortened(error: &str) -> String {
    let message = error.lines().next().unwrap_or_default();
    let help = error.lines().find(|line| line.starts_with("help"));
    [message, help.unwrap_or_default()].join("\n")
}

#[test]
fn entries_that_are_none_of_the_drive() {
    let first = |overrides, path| shortened(&key_error(overrides, path));
    assert_snapshot!(first(&[], "friction.law"), @r"error: `friction.law` is no number, so it cannot be traced");
    assert_snapshot!(first(&[], "friction.stiffness"), @r"error: `friction.stiffness` does not apply to the friction law `coulomb`");
    assert_snapshot!(first(&["friction.law=epp"], "friction.velocity"), @r"error: `friction.velocity` does not apply to the friction law `epp`");
    assert_snapshot!(first(&[], "load.tight_tension"), @r"
    error: `load.tight_tension` is not given: the drive has `load.tight_tractive_tension`
    help: did you mean `load.tight_tractive_tension`?
    ");
    assert_snapshot!(first(&[], "load.torque"), @r"
    error: `load.torque` is not given: the drive has `load.tight_tractive_tension`
    help: did you mean `load.tight_tractive_tension`?
    ");
    assert_snapshot!(first(&[], "load.driven_torque"), @r"error: `load.driven_torque` does not apply to a V-belt");
    assert_snapshot!(first(&[], "friction.velocity"), @r"error: `friction.velocity` does not apply to the friction law `coulomb`");
    assert_snapshot!(first(&[], "model.normal_force"), @r"error: `model.normal_force` is no number, so it cannot be traced");
    assert_snapshot!(first(&[], "belt.height"), @r"error: `belt.height` does not change the steady state, so it cannot be traced");
    assert_snapshot!(first(&[], "groove"), @r"error: unknown key `groove`");
}

#[test]
fn entries_that_are_none_of_a_flat_belt_drive() {
    let first =
        |overrides: &[&str], path| shortened(&error_of(&example("flat-unequal", overrides), path));
    let tensions = ["load.driven_torque=", "load.tight_tension=550 N"];
    let tight = ["load.slack_tension=", "load.tight_tension=550 N"];
    assert_snapshot!(first(&[], "groove.half_angle"), @r"error: `groove.half_angle` does not apply to a flat belt");
    assert_snapshot!(first(&[], "belt.radial_stiffness"), @r"error: `belt.radial_stiffness` does not apply to a flat belt");
    assert_snapshot!(first(&[], "belt.height"), @r"error: `belt.height` does not apply to a flat belt");
    assert_snapshot!(first(&[], "friction.bristle_stiffness"), @r"error: `friction.bristle_stiffness` does not apply to the friction law `epp`");
    assert_snapshot!(first(&[], "friction.velocity"), @r"error: `friction.velocity` does not apply to the friction law `epp`");
    assert_snapshot!(first(&[], "load.tight_tension"), @r"
    error: `load.tight_tension` is not given: the drive has `load.driven_torque`
    help: did you mean `load.driven_torque`?
    ");
    assert_snapshot!(first(&[], "load.slack_tractive_tension"), @r"
    error: `load.slack_tractive_tension` is not given: the drive has `load.slack_tension`
    help: did you mean `load.slack_tension`?
    ");
    assert_snapshot!(first(&tight, "load.slack_tension"), @r"
    error: `load.slack_tension` is not given: the drive has `load.driven_torque`
    help: did you mean `load.driven_torque`?
    ");
    assert_snapshot!(first(&tensions, "load.driven_torque"), @r"
    error: `load.driven_torque` is not given: the drive has `load.tight_tension`
    help: did you mean `load.tight_tension`?
    ");
    // Both names of the driven torque name it.
    let torque = Argument {
        option: "--parameter",
        value: "load.torque",
    };
    let key = torque.key(&example("flat-unequal", &[])).unwrap();
    assert_eq!(key.path(), "load.driven_torque");
    assert_snapshot!(error_of(&example("flat-unequal", &[]), "driven_torqe"), @r"
    error: unknown key `driven_torqe`
      --> command line:1:13
      |
    1 | --parameter driven_torqe
      |             ^^^^^^^^^^^^
    expected: one of `belt.mass_per_length`, `belt.axial_stiffness`, `friction.coefficient`, `friction.stiffness`, `pulleys.driver.radius`, `pulleys.driver.speed`, `pulleys.driven.radius`, `layout.centre_distance`, `load.slack_tension`, `load.driven_torque`
    help: did you mean `load.driven_torque`?
    ");
}

#[test]
fn values_are_read_by_the_rules_of_the_drive_file() {
    assert_eq!(value("friction.coefficient", "0.2"), Ok(0.2));
    assert_eq!(value("load.tight_tractive_tension", "0.7 kN"), Ok(700.0));
    assert_eq!(
        value("groove.half_angle", "18 deg"),
        Ok(18_f64.to_radians())
    );
    assert_snapshot!(value_error("load.tight_tractive_tension", "700 Nn"), @r#"
    error: unknown unit `Nn`
      --> command line:1:12
      |
    1 | --from 700 Nn
      |            ^^
    expected: a force, e.g. "700 N"
    help: did you mean `nN`?
    "#);
    assert_snapshot!(value_error("friction.coefficient", "0.2 N"), @r"
    error: wrong dimension: expected a pure number, got a force
      --> command line:1:12
      |
    1 | --from 0.2 N
      |            ^
    expected: a pure number, e.g. 0.4
    ");
    assert_snapshot!(value_error("groove.half_angle", "18"), @r#"
    error: `groove.half_angle` has no unit: 18 rad must lie between 0 and 90 deg
      --> command line:1:8
      |
    1 | --from 18
      |        ^^
    expected: an angle, e.g. "18 deg"
    help: did you mean `18 deg`?
    "#);
    assert_snapshot!(value_error("friction.coefficient", "-1"), @r"
    error: `friction.coefficient` must be positive
      --> command line:1:8
      |
    1 | --from -1
      |        ^^
    expected: a pure number, e.g. 0.4
    ");
}

#[test]
fn values_that_contradict_the_drive() {
    assert_snapshot!(value_error("load.tight_tractive_tension", "50 N"), @r"
    error: the tight tension 50 N is below the slack tension 100 N
      --> command line:1:8
      |
    1 | --from 50 N
      |        ^^^^
    ");
    assert_snapshot!(value_error("load.slack_tractive_tension", "1 kN"), @r"
    error: the tight tension 700 N is below the slack tension 1000 N
      --> command line:1:8
      |
    1 | --from 1 kN
      |        ^^^^
    ");
    assert_snapshot!(value_error("pulleys.driver.radius", "2 m"), @r"
    error: the pulleys overlap: their radii add up to 2.25 m, the centre distance is 1.393328 m
      --> command line:1:8
      |
    1 | --from 2 m
      |        ^^^
    ");
}

#[test]
fn a_torque_contradicts_no_tension() {
    let drive = example("flat-unequal", &[]);
    let key = Key::load(&drive);
    let argument = |value| Argument {
        option: "--to",
        value,
    };
    assert_eq!(argument("90 N*m").value(key, &drive, None), Ok(90.0));
    let error = argument("90 N").value(key, &drive, None).unwrap_err();
    assert_snapshot!(error, @r#"
    error: wrong dimension: expected a torque, got a force
      --> command line:1:9
      |
    1 | --to 90 N
      |         ^
    expected: a torque, e.g. "45 N*m"
    "#);
}

#[test]
fn an_entry_that_is_free_contradicts_nothing() {
    let drive = drive(&[]);
    let find = |path| Key::all(&drive).find(|key| key.path() == path).unwrap();
    let argument = Argument {
        option: "--to",
        value: "1 kN",
    };
    let slack = find("load.slack_tractive_tension");
    let free = |path| argument.value(slack, &drive, Some(find(path)));
    assert_eq!(free("load.tight_tractive_tension"), Ok(1000.0));
    assert!(free("friction.coefficient").is_err());
}
