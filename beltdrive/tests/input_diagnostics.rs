//! What a drive file or an override with a fault of form is answered: TOML, tables, keys, types, words.

mod support;

use insta::assert_snapshot;
use support::{error, override_error};

#[test]
fn unreadable_toml() {
    assert_snapshot!(error(r#""120 kN""#, "120 kN"), @r#"
    error: unreadable TOML: string values must be quoted
      --> drive.toml:6:19
      |
    6 | axial_stiffness = 120 kN
      |                   ^^^^^^
    expected: literal string
    help: did you mean `axial_stiffness = "120 kN"`?
    "#);
    assert_snapshot!(error("[groove]", "[groove"), @r#"
    error: unreadable TOML: unclosed table
      --> drive.toml:9:8
      |
    9 | [groove
      |        ^
    expected: `]`
    "#);
    assert_snapshot!(error("coefficient", "law"), @r#"
    error: unreadable TOML: duplicate key
       --> drive.toml:14:1
       |
    14 | law = 0.4
       | ^^^
    "#);
    assert_snapshot!(error(r#""coulomb""#, r#""coulomb"#), @r#"
    error: unreadable TOML: invalid basic string
       --> drive.toml:13:15
       |
    13 | law = "coulomb
       |               ^
    expected: `"`
    "#);
}

#[test]
fn unknown_tables_and_keys() {
    assert_snapshot!(error("[groove]", "[grove]"), @r"
    error: unknown table `grove`
      --> drive.toml:9:2
      |
    9 | [grove]
      |  ^^^^^
    expected: one of `title`, `belt`, `groove`, `friction`, `pulleys`, `pulley`, `tensioner`, `layout`, `load`, `model`, `calibration`, `case`, `requirements`, `losses`, `uncertainty`, `design`, `transient`
    help: did you mean `groove`?
    ");
    assert_snapshot!(error("[pulleys.driver]", "[pulleys.drive]"), @r#"
    error: unknown table `drive` in [pulleys]
       --> drive.toml:17:10
       |
    17 | [pulleys.drive]
       |          ^^^^^
    expected: one of `driver`, `driven`
    help: did you mean `driver`?
    "#);
    assert_snapshot!(error("law =", "lwa ="), @r#"
    error: unknown key `lwa` in [friction]
       --> drive.toml:13:1
       |
    13 | lwa = "coulomb"
       | ^^^
    expected: one of `law`, `coefficient`, `stiffness`, `bristle_stiffness`, `velocity`, `epp`
    help: did you mean `law`?
    "#);
    assert_snapshot!(error("[groove]", "half_angle = 0.3\n[groove]"), @r#"
    error: unknown key `half_angle` in [belt]
      --> drive.toml:9:1
      |
    9 | half_angle = 0.3
      | ^^^^^^^^^^
    expected: one of `type`, `section`, `width`, `mass_per_length`, `axial_stiffness`, `radial_stiffness`, `height`, `ribs`
    help: did you mean `groove.half_angle`?
    "#);
    assert_snapshot!(error("[groove]", "colour = 3\n[groove]"), @r#"
    error: unknown key `colour` in [belt]
      --> drive.toml:9:1
      |
    9 | colour = 3
      | ^^^^^^
    expected: one of `type`, `section`, `width`, `mass_per_length`, `axial_stiffness`, `radial_stiffness`, `height`, `ribs`
    "#);
}

#[test]
fn missing_tables_and_keys() {
    assert_snapshot!(error("[layout]\ncentre_distance = \"1.4 m\"\n", ""), @r#"
    error: missing table [layout]
       --> drive.toml:27:33
       |
    27 | tight_tractive_tension = "700 N"
       |                                 ^
    expected: [layout] with centre_distance = "1.4 m"
    "#);
    assert_snapshot!(error("half_angle = \"18 deg\"\n", ""), @r#"
    error: missing key `half_angle` in [groove]
      --> drive.toml:9:2
      |
    9 | [groove]
      |  ^^^^^^
    expected: half_angle = "18 deg"
    "#);
    assert_snapshot!(error("tight_tractive_tension = \"700 N\"\n", ""), @r#"
    error: missing key `tight_tractive_tension` or `tight_tension` or `driven_torque` in [load]
       --> drive.toml:27:2
       |
    27 | [load]
       |  ^^^^
    expected: tight_tractive_tension = "700 N" or tight_tension = "710 N" or driven_torque = "45 N*m"
    help: two quantities close a drive: two tensions, or the torque or power of the driven pulley with a span tension, the setup tension or the belt length
    "#);
    assert_snapshot!(error("radius = \"0.25 m\"\n", ""), @r#"
    error: missing key `radius` or `diameter` in [pulleys.driver]
       --> drive.toml:17:10
       |
    17 | [pulleys.driver]
       |          ^^^^^^
    expected: radius = "0.25 m" or diameter = "0.5 m"
    "#);
}

#[test]
fn wrong_types() {
    assert_snapshot!(error(r#""0.108 kg/m""#, "true"), @r#"
    error: `belt.mass_per_length` must be a quantity, got a boolean
      --> drive.toml:5:19
      |
    5 | mass_per_length = true
      |                   ^^^^
    expected: a mass per length, e.g. "0.108 kg/m"
    "#);
    assert_snapshot!(error(r#""coulomb""#, "3"), @r#"
    error: `friction.law` must be a text, got a number
       --> drive.toml:13:7
       |
    13 | law = 3
       |       ^
    expected: law = "coulomb"
    "#);
    assert_snapshot!(error(r#""Test""#, "2009-01-01"), @r#"
    error: `title` must be a text, got a date
      --> drive.toml:1:9
      |
    1 | title = 2009-01-01
      |         ^^^^^^^^^^
    expected: title = "Test drive"
    "#);
    assert_snapshot!(error(r#"half_angle = "18 deg""#, "half_angle.value = 18"), @r#"
    error: `groove.half_angle` must be a quantity, got a table
       --> drive.toml:10:1
       |
    10 | half_angle.value = 18
       | ^^^^^^^^^^
    expected: an angle, e.g. "18 deg"
    "#);
    assert_snapshot!(error("[layout]", "[[layout]]"), @r#"
    error: `layout` must be a table, got an array
       --> drive.toml:24:1
       |
    24 | [[layout]]
       | ^^^^^^^^^^
    expected: [layout]
    "#);
}

#[test]
fn words() {
    assert_snapshot!(error(r#""coulomb""#, r#""colomb""#), @r#"
    error: unknown friction law `colomb`
       --> drive.toml:13:7
       |
    13 | law = "colomb"
       |       ^^^^^^^^
    expected: one of `coulomb`, `epp`, `bristle`, `creep-rate`
    help: did you mean `coulomb`?
    "#);
    assert_snapshot!(error(r#""coulomb""#, r#""vector_epp""#), @r#"
    error: unknown friction law `vector_epp`
       --> drive.toml:13:7
       |
    13 | law = "vector_epp"
       |       ^^^^^^^^^^^^
    expected: one of `coulomb`, `epp`, `bristle`, `creep-rate`
    help: did you mean `epp` with `friction.epp.kind = "vector"`?
    "#);
    assert_snapshot!(error(r#""v""#, r#""toothed""#), @r#"
    error: unknown belt type `toothed`
      --> drive.toml:4:8
      |
    4 | type = "toothed"
      |        ^^^^^^^^^
    expected: one of `v`, `flat`
    "#);
}

#[test]
fn refused_entries() {
    assert_snapshot!(error("[layout]", "speed = \"990 rpm\"\n[layout]"), @r#"
    error: `pulleys.driven.speed` may not be given: the speed of the driven pulley follows from the load
       --> drive.toml:24:1
       |
    24 | speed = "990 rpm"
       | ^^^^^
    expected: one of `radius`, `diameter`, `half_angle`
    "#);
    assert_snapshot!(override_error(&["load.setup_tension=400 N"]), @r"
    error: overdetermined: two quantities close a drive, 3 are given: `load.slack_tractive_tension`, `load.tight_tractive_tension`, `load.setup_tension`
      --> command line:1:26
      |
    1 | --set load.setup_tension=400 N
      |                          ^^^^^
    expected: two tensions, or the torque or power of the driven pulley with a span tension, the setup tension or the belt length
    help: `--set load.tight_tractive_tension=`, without a value, leaves that entry out for one run
    ");
    assert_snapshot!(override_error(&["load.torque=45 N*m"]), @r"
    error: overdetermined: two quantities close a drive, 3 are given: `load.slack_tractive_tension`, `load.tight_tractive_tension`, `load.torque`
      --> command line:1:19
      |
    1 | --set load.torque=45 N*m
      |                   ^^^^^^
    expected: two tensions, or the torque or power of the driven pulley with a span tension, the setup tension or the belt length
    help: `--set load.tight_tractive_tension=`, without a value, leaves that entry out for one run
    ");
}

#[test]
fn overrides() {
    assert_snapshot!(override_error(&["friction.lwa=coulomb"]), @r#"
    error: unknown key `lwa` in [friction]
      --> command line:1:16
      |
    1 | --set friction.lwa=coulomb
      |                ^^^
    expected: one of `law`, `coefficient`, `stiffness`, `bristle_stiffness`, `velocity`, `epp`
    help: did you mean `law`?
    "#);
    assert_snapshot!(override_error(&["groove.half_angle=17 deg", "frction.law = epp"]), @r"
    error: unknown table `frction`
      --> command line:2:7
      |
    2 | --set frction.law = epp
      |       ^^^^^^^
    expected: one of `title`, `belt`, `groove`, `friction`, `pulleys`, `pulley`, `tensioner`, `layout`, `load`, `model`, `calibration`, `case`, `requirements`, `losses`, `uncertainty`, `design`, `transient`
    help: did you mean `friction`?
    ");
    assert_snapshot!(override_error(&["law=epp"]), @r"
    error: unknown key `law`
      --> command line:1:7
      |
    1 | --set law=epp
      |       ^^^
    expected: one of `title`, `belt`, `groove`, `friction`, `pulleys`, `pulley`, `tensioner`, `layout`, `load`, `model`, `calibration`, `case`, `requirements`, `losses`, `uncertainty`, `design`, `transient`
    help: did you mean `friction.law`?
    ");
    assert_snapshot!(override_error(&["friction.law"]), @r#"
    error: the override `friction.law` has no value
      --> command line:1:7
      |
    1 | --set friction.law
      |       ^^^^^^^^^^^^
    expected: KEY=VALUE with the dotted path of an entry, e.g. friction.law=coulomb
    "#);
    assert_snapshot!(override_error(&["friction..law=epp"]), @r#"
    error: malformed key `friction..law`
      --> command line:1:7
      |
    1 | --set friction..law=epp
      |       ^^^^^^^^^^^^^^^^^
    expected: KEY=VALUE with the dotted path of an entry, e.g. friction.law=coulomb
    "#);
    assert_snapshot!(override_error(&["friction.coefficient = 'high'"]), @r#"
    error: malformed number `high`
      --> command line:1:31
      |
    1 | --set friction.coefficient = 'high'
      |                               ^^^^
    expected: a pure number, e.g. 0.4
    "#);
    assert_snapshot!(override_error(&["groove.half_angle="]), @r#"
    error: missing key `half_angle` in [groove]
      --> drive.toml:9:2
      |
    9 | [groove]
      |  ^^^^^^
    expected: half_angle = "18 deg"
    "#);
    assert_snapshot!(override_error(&["belt="]), @r"
    error: `belt` must be a table, got a text
      --> command line:1:12
      |
    1 | --set belt=
      |            ^
    expected: [belt]
    ");
    assert_snapshot!(override_error(&["load.tigt_tension="]), @r"
    error: unknown key `tigt_tension` in [load]
      --> command line:1:12
      |
    1 | --set load.tigt_tension=
      |            ^^^^^^^^^^^^
    expected: one of `slack_tractive_tension`, `slack_tension`, `tight_tractive_tension`, `tight_tension`, `driven_torque`, `torque`, `power`, `setup_tension`, `belt_length`, `span`, `span_tension`, `span_tractive_tension`
    help: did you mean `tight_tension`?
    ");
    assert_snapshot!(override_error(&["belt=3"]), @r#"
    error: `belt` must be a table, got a text
      --> command line:1:12
      |
    1 | --set belt=3
      |            ^
    expected: [belt]
    "#);
    assert_snapshot!(override_error(&["friction.law=\"ep\""]), @r#"
    error: unknown friction law `ep`
      --> command line:1:20
      |
    1 | --set friction.law="ep"
      |                    ^^^^
    expected: one of `coulomb`, `epp`, `bristle`, `creep-rate`
    help: did you mean `epp`?
    "#);
}
