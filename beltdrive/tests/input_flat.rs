//! Flat belts in drive files: what they need, what may stand beside, and the errors of model, law and load.

mod support;

use beltdrive::{BeltKind, Drive, FrictionLaw, NormalForce, SpanTension, examples, input};
use insta::assert_snapshot;
use support::{overridden, override_error};

/// The shipped flat-belt drive under a torque.
fn unequal() -> &'static str {
    examples::find("flat-unequal").unwrap().text
}

/// A flat-belt drive file with overrides.
fn read(text: &str, overrides: &[&str]) -> Result<Drive, String> {
    let overrides: Vec<_> = overrides.iter().map(|text| (*text).to_owned()).collect();
    input::parse("flat.toml", text, &overrides).map_err(|error| error.to_string())
}

/// A shipped flat-belt drive with overrides.
fn flat(overrides: &[&str]) -> Result<Drive, String> {
    read(unequal(), overrides)
}

/// The error of a shipped flat-belt drive with overrides.
#[track_caller]
fn flat_error(overrides: &[&str]) -> String {
    flat(overrides).unwrap_err()
}

/// The error of the shipped flat-belt drive in which `to` replaces the first `from`.
#[track_caller]
fn error(from: &str, to: &str) -> String {
    assert!(unequal().contains(from), "{from} is in the drive file");
    read(&unequal().replacen(from, to, 1), &[]).unwrap_err()
}

#[test]
fn what_only_v_belts_have_may_stand_in_the_file_of_a_flat_belt() {
    let drive = overridden(&["belt.type=flat", "belt.height=8 mm"]).unwrap();
    let normal_force = NormalForce::Inertia;
    assert_eq!(drive.belt.kind, BeltKind::Flat { normal_force });
    // A wrong value is wrong all the same.
    let error = override_error(&["belt.type=flat", "groove.half_angle=90 deg"]);
    assert!(error.contains("must lie between 0 and 90 deg"), "{error}");
}

#[test]
fn what_a_v_belt_needs_beyond_a_flat_one() {
    assert_snapshot!(flat_error(&["belt.type=v", "friction.law=coulomb"]), @r#"
    error: missing keys `belt.radial_stiffness`, `groove.half_angle`
       --> flat.toml:36:25
       |
    36 | normal_force = "inertia"
       |                         ^
    expected: belt.radial_stiffness = "900 kN/m^2", groove.half_angle = "18 deg"
    "#);
    assert_snapshot!(override_error(&["model.normal_force=inertia"]), @r"
    error: `model.normal_force` is for flat belts; this drive has a V-belt
      --> command line:1:13
      |
    1 | --set model.normal_force=inertia
      |             ^^^^^^^^^^^^
    help: `--set model.normal_force=`, without a value, leaves that entry out for one run
    ");
    let model = "[model]\nnormal_force = \"exact\"\n[load]";
    assert_snapshot!(support::error("[load]", model), @r#"
    error: `model.normal_force` is for flat belts; this drive has a V-belt
       --> drive.toml:28:1
       |
    28 | normal_force = "exact"
       | ^^^^^^^^^^^^
    help: `--set model.normal_force=`, without a value, leaves that entry out for one run
    "#);
}

#[test]
fn the_normal_force_has_a_default_and_names() {
    let kind = |overrides: &[&str]| flat(overrides).unwrap().belt.kind;
    for normal_force in NormalForce::ALL {
        let entry = format!("model.normal_force={}", normal_force.name());
        assert_eq!(kind(&[&entry]), BeltKind::Flat { normal_force });
    }
    let normal_force = NormalForce::Inertia;
    let flat = BeltKind::Flat { normal_force };
    assert_eq!(kind(&["model.normal_force="]), flat);
    assert_snapshot!(flat_error(&["model.normal_force=inertial"]), @r"
    error: unknown normal force `inertial`
      --> command line:1:26
      |
    1 | --set model.normal_force=inertial
      |                          ^^^^^^^^
    expected: one of `inertia`, `thesis`, `exact`
    help: did you mean `inertia`?
    ");
    assert_snapshot!(flat_error(&["model.normalforce=exact"]), @r"
    error: unknown key `normalforce` in [model]
      --> command line:1:13
      |
    1 | --set model.normalforce=exact
      |             ^^^^^^^^^^^
    expected: `normal_force`
    help: did you mean `normal_force`?
    ");
    assert_snapshot!(flat_error(&["friction.law=creep-rate", "model.normal_force=thesis"]), @r"
    error: creep-rate friction needs the inertia of the belt in the normal force, which `thesis` leaves out
      --> command line:2:26
      |
    2 | --set model.normal_force=thesis
      |                          ^^^^^^
    expected: one of `inertia`, `exact`
    ");
}

#[test]
fn laws_of_the_other_type_of_belt() {
    assert_snapshot!(override_error(&["friction.law=creep-rate"]), @r"
    error: creep-rate is a law for flat belts; this drive has a V-belt
      --> command line:1:20
      |
    1 | --set friction.law=creep-rate
      |                    ^^^^^^^^^^
    expected: one of `coulomb`, `epp`, `bristle`
    ");
    assert_snapshot!(flat_error(&["friction.law=bristle"]), @r"
    error: bristle is a law for V-belts; this drive has a flat belt
      --> command line:1:20
      |
    1 | --set friction.law=bristle
      |                    ^^^^^^^
    expected: one of `coulomb`, `epp`, `creep-rate`
    ");
}

#[test]
fn the_creep_velocity() {
    let law = flat(&["friction.law=creep-rate"]).unwrap().law;
    assert_eq!(law, FrictionLaw::CreepRate { velocity: 0.02 });
    assert_snapshot!(flat_error(&["friction.law=creep-rate", "friction.velocity="]), @r#"
    error: missing key `velocity` in [friction]
       --> flat.toml:10:2
       |
    10 | [friction]
       |  ^^^^^^^^
    expected: velocity = "0.05 m/s"
    help: the friction law `creep-rate` needs it
    "#);
}

#[test]
fn a_driven_torque_takes_the_place_of_a_tension() {
    let load = |overrides: &[&str]| {
        let load = flat(overrides).unwrap().two_pulleys().unwrap().load;
        (load.slack, load.tight)
    };
    let torque = SpanTension::DrivenTorque(60.0);
    assert_eq!(load(&[]), (SpanTension::Belt(250.0), torque));
    let tight = ["load.slack_tension=", "load.tight_tractive_tension=0.5 kN"];
    assert_eq!(load(&tight), (torque, SpanTension::Tractive(500.0)));
    let tensions = ["load.driven_torque=", "load.tight_tension=500 N"];
    let tight = SpanTension::Belt(500.0);
    assert_eq!(load(&tensions), (SpanTension::Belt(250.0), tight));
    for same in ["60 J", "60 Nm", "60", "0.06 kN m"] {
        let entry = format!("load.driven_torque={same}");
        assert_eq!(load(&[&entry]), (SpanTension::Belt(250.0), torque));
    }
}

#[test]
fn wrong_torques() {
    assert_snapshot!(error("60 N*m", "60 N"), @r#"
    error: wrong dimension: expected a torque, got a force
       --> flat.toml:30:21
       |
    30 | driven_torque = "60 N"
       |                     ^
    expected: a torque, e.g. "45 N*m"
    "#);
    let tight = |overrides: &[&str]| flat(overrides).unwrap().two_pulleys().unwrap().load.tight;
    let no_load = tight(&["load.driven_torque=0"]);
    assert_eq!(no_load, SpanTension::DrivenTorque(0.0));
    assert_snapshot!(flat_error(&["load.driven_torque=-5"]), @r#"
    error: `load.driven_torque` must not be negative
      --> command line:1:26
      |
    1 | --set load.driven_torque=-5
      |                          ^^
    expected: a torque, e.g. "45 N*m"
    "#);
    // Of two pulleys it is the driven one that takes it.
    let torque = ["load.driven_torque=", "load.torque=60 N*m"];
    assert_eq!(tight(&torque), SpanTension::DrivenTorque(60.0));
    assert_snapshot!(error("driven_torque = ", "driver_torque = "), @r#"
    error: `load.driver_torque` may not be given: the load is the torque of the driven pulley
       --> flat.toml:30:1
       |
    30 | driver_torque = "60 N*m"
       | ^^^^^^^^^^^^^
    expected: one of `slack_tractive_tension`, `slack_tension`, `tight_tractive_tension`, `tight_tension`, `driven_torque`, `torque`, `power`, `setup_tension`, `belt_length`, `span`, `span_tension`, `span_tractive_tension`
    help: did you mean `driven_torque`?
    "#);
    assert_snapshot!(override_error(&["load.driven_torque=45 N*m"]), @r"
    error: overdetermined: two quantities close a drive, 3 are given: `load.slack_tractive_tension`, `load.tight_tractive_tension`, `load.driven_torque`
      --> command line:1:26
      |
    1 | --set load.driven_torque=45 N*m
      |                          ^^^^^^
    expected: two tensions, or the torque or power of the driven pulley with a span tension, the setup tension or the belt length
    help: `--set load.tight_tractive_tension=`, without a value, leaves that entry out for one run
    ");
}

#[test]
fn loads_of_three_quantities() {
    assert_snapshot!(flat_error(&["load.tight_tension=500 N"]), @r"
    error: overdetermined: two quantities close a drive, 3 are given: `load.slack_tension`, `load.driven_torque`, `load.tight_tension`
      --> command line:1:26
      |
    1 | --set load.tight_tension=500 N
      |                          ^^^^^
    expected: two tensions, or the torque or power of the driven pulley with a span tension, the setup tension or the belt length
    help: `--set load.driven_torque=`, without a value, leaves that entry out for one run
    ");
    let tensions = ["load.driven_torque=", "load.tight_tractive_tension=500 N"];
    let last = [&tensions[..], &["load.driven_torque=45 N*m"]].concat();
    assert_snapshot!(flat_error(&last), @r"
    error: overdetermined: two quantities close a drive, 3 are given: `load.slack_tension`, `load.tight_tractive_tension`, `load.driven_torque`
      --> command line:3:26
      |
    3 | --set load.driven_torque=45 N*m
      |                          ^^^^^^
    expected: two tensions, or the torque or power of the driven pulley with a span tension, the setup tension or the belt length
    help: `--set load.tight_tractive_tension=`, without a value, leaves that entry out for one run
    ");
    assert_snapshot!(error("[load]", "[load]\ntight_tension = 550"), @r#"
    error: overdetermined: two quantities close a drive, 3 are given: `load.tight_tension`, `load.slack_tension`, `load.driven_torque`
       --> flat.toml:31:17
       |
    31 | driven_torque = "60 N*m"
       |                 ^^^^^^^^
    expected: two tensions, or the torque or power of the driven pulley with a span tension, the setup tension or the belt length
    help: `--set load.slack_tension=`, without a value, leaves that entry out for one run
    "#);
    assert_snapshot!(error("[load]", "[load]\nslack_tractive_tension = 180"), @r#"
    error: both `load.slack_tractive_tension` and `load.slack_tension` are given
       --> flat.toml:30:17
       |
    30 | slack_tension = "250 N"
       |                 ^^^^^^^
    expected: one of them: the tension of a span is stated once
    "#);
}

#[test]
fn loads_of_one_quantity_or_none() {
    assert_snapshot!(flat_error(&["load.driven_torque="]), @r#"
    error: missing key `tight_tractive_tension` or `tight_tension` or `driven_torque` in [load]
       --> flat.toml:26:2
       |
    26 | [load]                             # the slack tension and the torque of the driven pulley close the drive
       |  ^^^^
    expected: tight_tractive_tension = "700 N" or tight_tension = "710 N" or driven_torque = "45 N*m"
    help: two quantities close a drive: two tensions, or the torque or power of the driven pulley with a span tension, the setup tension or the belt length
    "#);
    assert_snapshot!(flat_error(&["load.slack_tension="]), @r#"
    error: missing key `slack_tractive_tension` or `slack_tension` or `tight_tractive_tension` or `tight_tension` or `setup_tension` or `belt_length` in [load]
       --> flat.toml:26:2
       |
    26 | [load]                             # the slack tension and the torque of the driven pulley close the drive
       |  ^^^^
    expected: slack_tractive_tension = "100 N" or slack_tension = "110 N" or tight_tractive_tension = "700 N" or tight_tension = "710 N" or setup_tension = "400 N" or belt_length = "4.36 m"
    help: two quantities close a drive: two tensions, or the torque or power of the driven pulley with a span tension, the setup tension or the belt length
    "#);
    assert_snapshot!(flat_error(&["load.slack_tension=", "load.driven_torque=", "load.tight_tension=550 N"]), @r#"
    error: missing key `slack_tractive_tension` or `slack_tension` or `driven_torque` in [load]
       --> flat.toml:26:2
       |
    26 | [load]                             # the slack tension and the torque of the driven pulley close the drive
       |  ^^^^
    expected: slack_tractive_tension = "100 N" or slack_tension = "110 N" or driven_torque = "45 N*m"
    help: two quantities close a drive: two tensions, or the torque or power of the driven pulley with a span tension, the setup tension or the belt length
    "#);
    assert_snapshot!(flat_error(&["load.slack_tension=", "load.driven_torque="]), @r#"
    error: missing key `slack_tractive_tension` or `slack_tension` in [load]
       --> flat.toml:26:2
       |
    26 | [load]                             # the slack tension and the torque of the driven pulley close the drive
       |  ^^^^
    expected: slack_tractive_tension = "100 N" or slack_tension = "110 N"
    help: two quantities close a drive: two tensions, or the torque or power of the driven pulley with a span tension, the setup tension or the belt length
    "#);
}

#[test]
fn tensions_contradict_each_other_but_not_a_torque() {
    let error = flat_error(&["load.driven_torque=", "load.tight_tension=240 N"]);
    assert!(
        error.contains("240 N is below the slack tension 250 N"),
        "{error}"
    );
    // Whether a torque can be carried is not for the file to say.
    flat(&["load.driven_torque=60 kN*m"]).unwrap();
    flat(&["load.slack_tension=", "load.tight_tension=1 N"]).unwrap();
}
