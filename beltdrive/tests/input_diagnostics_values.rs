//! What a drive file with a wrong value is answered: numbers, units, dimensions, ranges and contradictions.

mod support;

use beltdrive::{BeltKind, SpanTension};
use insta::assert_snapshot;
use support::{error, overridden, override_error};

#[test]
fn malformed_numbers() {
    assert_snapshot!(error("120 kN", "1,2 kN"), @r#"
    error: malformed number `1,2`
      --> drive.toml:6:20
      |
    6 | axial_stiffness = "1,2 kN"
      |                    ^^^
    expected: a force, e.g. "120 kN"
    help: did you mean `1.2`?
    "#);
    assert_snapshot!(error("120 kN", "12O kN"), @r#"
    error: unknown unit `O`
      --> drive.toml:6:22
      |
    6 | axial_stiffness = "12O kN"
      |                      ^
    expected: a force, e.g. "120 kN"
    "#);
    assert_snapshot!(error("120 kN", "120 000 N"), @r#"
    error: malformed number `120 000 N`
      --> drive.toml:6:20
      |
    6 | axial_stiffness = "120 000 N"
      |                    ^^^^^^^^^
    expected: a force, e.g. "120 kN"
    "#);
    assert_snapshot!(error("120 kN", ""), @r#"
    error: missing number
      --> drive.toml:6:19
      |
    6 | axial_stiffness = ""
      |                   ^^
    expected: a force, e.g. "120 kN"
    "#);
    assert_snapshot!(error("120 kN", "stiff"), @r#"
    error: malformed number `stiff`
      --> drive.toml:6:20
      |
    6 | axial_stiffness = "stiff"
      |                    ^^^^^
    expected: a force, e.g. "120 kN"
    "#);
}

#[test]
fn unknown_units() {
    assert_snapshot!(error("120 kN", "120 kn"), @r#"
    error: unknown unit `kn`
      --> drive.toml:6:24
      |
    6 | axial_stiffness = "120 kn"
      |                        ^^
    expected: a force, e.g. "120 kN"
    help: did you mean `kN`?
    "#);
    assert_snapshot!(error("900 kN/m^2", "0.9 N/milimetre^2"), @r#"
    error: unknown unit `milimetre^2`
      --> drive.toml:7:27
      |
    7 | radial_stiffness = "0.9 N/milimetre^2"
      |                           ^^^^^^^^^^^
    expected: a force per area, e.g. "900 kN/m^2"
    help: did you mean `mm^2`?
    "#);
    assert_snapshot!(error("18 deg", "18 degrees"), @r#"
    error: unknown unit `degrees`
       --> drive.toml:10:18
       |
    10 | half_angle = "18 degrees"
       |                  ^^^^^^^
    expected: an angle, e.g. "18 deg"
    help: did you mean `deg`?
    "#);
    assert_snapshot!(error("18 deg", "18 d\\u0065gree"), @r#"
    error: unknown unit `degree`
       --> drive.toml:10:14
       |
    10 | half_angle = "18 d\u0065gree"
       |              ^^^^^^^^^^^^^^^^
    expected: an angle, e.g. "18 deg"
    help: did you mean `deg`?
    "#);
}

#[test]
fn wrong_dimensions() {
    assert_snapshot!(error("120 kN", "120 km"), @r#"
    error: wrong dimension: expected a force, got a length
      --> drive.toml:6:24
      |
    6 | axial_stiffness = "120 km"
      |                        ^^
    expected: a force, e.g. "120 kN"
    "#);
    assert_snapshot!(error("1000 rpm", "16 1/s"), @r#"
    error: wrong dimension: expected an angular speed, got an inverse time
       --> drive.toml:19:13
       |
    19 | speed = "16 1/s"
       |             ^^^
    expected: an angular speed, e.g. "1000 rpm"
    help: write what turns by: an angle in rad, deg or rev
    "#);
    assert_snapshot!(error("1000 rpm", "1000 N m s"), @r#"
    error: wrong dimension: expected an angular speed, got a quantity in kg m^2 s^-1
       --> drive.toml:19:15
       |
    19 | speed = "1000 N m s"
       |               ^^^^^
    expected: an angular speed, e.g. "1000 rpm"
    "#);
    assert_snapshot!(error("0.4", "\"0.4 rad\""), @r#"
    error: wrong dimension: expected a pure number, got an angle
       --> drive.toml:14:20
       |
    14 | coefficient = "0.4 rad"
       |                    ^^^
    expected: a pure number, e.g. 0.4
    "#);
}

#[test]
fn numbers_that_are_not_finite() {
    assert_snapshot!(error("0.4", "nan"), @r#"
    error: `friction.coefficient` is not a finite number
       --> drive.toml:14:15
       |
    14 | coefficient = nan
       |               ^^^
    expected: a pure number, e.g. 0.4
    "#);
    assert_snapshot!(error("120 kN", "1e999 kN"), @r#"
    error: `1e999 kN` is not a finite number
      --> drive.toml:6:20
      |
    6 | axial_stiffness = "1e999 kN"
      |                    ^^^^^^^^
    expected: a force, e.g. "120 kN"
    "#);
}

#[test]
fn values_out_of_range() {
    assert_snapshot!(error("0.108 kg/m", "0 kg/m"), @r#"
    error: `belt.mass_per_length` must be positive
      --> drive.toml:5:19
      |
    5 | mass_per_length = "0 kg/m"
      |                   ^^^^^^^^
    expected: a mass per length, e.g. "0.108 kg/m"
    "#);
    assert_snapshot!(error("120 kN", "-120 kN"), @r#"
    error: `belt.axial_stiffness` must be positive
      --> drive.toml:6:19
      |
    6 | axial_stiffness = "-120 kN"
      |                   ^^^^^^^^^
    expected: a force, e.g. "120 kN"
    "#);
    assert_snapshot!(error("0.4", "0.0"), @r#"
    error: `friction.coefficient` must be positive
       --> drive.toml:14:15
       |
    14 | coefficient = 0.0
       |               ^^^
    expected: a pure number, e.g. 0.4
    "#);
    assert_snapshot!(error("18 deg", "90 deg"), @r#"
    error: `groove.half_angle` must lie between 0 and 90 deg
       --> drive.toml:10:14
       |
    10 | half_angle = "90 deg"
       |              ^^^^^^^^
    expected: an angle, e.g. "18 deg"
    "#);
    assert_snapshot!(error("\"18 deg\"", "18"), @r#"
    error: `groove.half_angle` has no unit: 18 rad must lie between 0 and 90 deg
       --> drive.toml:10:14
       |
    10 | half_angle = 18
       |              ^^
    expected: an angle, e.g. "18 deg"
    help: did you mean `18 deg`?
    "#);
    assert_snapshot!(error("1000 rpm", "-1000 rpm"), @r#"
    error: `pulleys.driver.speed` must be positive
       --> drive.toml:19:9
       |
    19 | speed = "-1000 rpm"
       |         ^^^^^^^^^^^
    expected: an angular speed, e.g. "1000 rpm"
    "#);
    assert_snapshot!(error("100 N", "-1 lbf"), @r#"
    error: `load.slack_tractive_tension` must be positive
       --> drive.toml:28:26
       |
    28 | slack_tractive_tension = "-1 lbf"
       |                          ^^^^^^^^
    expected: a force, e.g. "100 N"
    "#);
}

#[test]
fn pulleys_that_overlap() {
    assert_snapshot!(error("1.4 m", "50 cm"), @r#"
    error: the pulleys overlap: their radii add up to 0.5 m, the centre distance is 0.5 m
       --> drive.toml:25:19
       |
    25 | centre_distance = "50 cm"
       |                   ^^^^^^^
    expected: a length greater than 0.5 m
    "#);
}

#[test]
fn tensions_that_contradict() {
    assert_snapshot!(error("700 N", "99.5 N"), @r#"
    error: the tight tension 99.5 N is below the slack tension 100 N
       --> drive.toml:29:26
       |
    29 | tight_tractive_tension = "99.5 N"
       |                          ^^^^^^^^
    expected: a force of at least 100 N; a driven pulley that drives the belt has a negative torque in [[pulley]] tables
    "#);
    assert_snapshot!(override_error(&["load.slack_tension=8 kN", "load.tight_tension=7 kN"]), @r#"
    error: the tight tension 7000 N is below the slack tension 8000 N
      --> command line:2:26
      |
    2 | --set load.tight_tension=7 kN
      |                          ^^^^
    expected: a force of at least 8000 N; a driven pulley that drives the belt has a negative torque in [[pulley]] tables
    "#);
    assert_snapshot!(error("[load]", "[load]\nslack_tension = 110"), @r#"
    error: both `load.slack_tractive_tension` and `load.slack_tension` are given
       --> drive.toml:28:17
       |
    28 | slack_tension = 110
       |                 ^^^
    expected: one of them: the tension of a span is stated once
    "#);
    assert_snapshot!(error("[load]", "[load]\ntight_tension = 710"), @r#"
    error: both `load.tight_tractive_tension` and `load.tight_tension` are given
       --> drive.toml:28:17
       |
    28 | tight_tension = 710
       |                 ^^^
    expected: one of them: the tension of a span is stated once
    "#);
}

#[test]
fn parameters_of_the_law() {
    assert_snapshot!(override_error(&["friction.law=bristle"]), @r#"
    error: missing key `bristle_stiffness` in [friction]
       --> drive.toml:12:2
       |
    12 | [friction]
       |  ^^^^^^^^
    expected: bristle_stiffness = "1620 1/m"
    help: the friction law `bristle` needs it
    "#);
    assert_snapshot!(override_error(&["friction.velocity=0.05 N"]), @r#"
    error: wrong dimension: expected a velocity, got a force
      --> command line:1:30
      |
    1 | --set friction.velocity=0.05 N
      |                              ^
    expected: a velocity, e.g. "0.05 m/s"
    "#);
}

#[test]
fn tensions_that_do_not_contradict() {
    for tight in [
        "load.tight_tractive_tension=100 N",
        "load.tight_tension=50 N",
    ] {
        overridden(&[tight]).unwrap();
    }
    let drive = overridden(&[
        "load.slack_tension=300 N",
        "load.slack_tractive_tension=200 N",
    ]);
    let two = drive.unwrap().two_pulleys().unwrap();
    assert_eq!(two.load.slack, SpanTension::Tractive(200.0));
}

#[test]
fn the_height_of_the_belt_may_be_given() {
    let height = |overrides: &[&str]| match overridden(overrides).unwrap().belt.kind {
        BeltKind::V(belt) => belt.height,
        BeltKind::Flat { .. } => panic!("a V-belt was expected"),
    };
    assert_eq!(height(&[]), None);
    assert_eq!(height(&["belt.height=8 mm"]), Some(0.008));
    let error = override_error(&["belt.height=0 m"]);
    assert!(error.contains("`belt.height` must be positive"), "{error}");
}
