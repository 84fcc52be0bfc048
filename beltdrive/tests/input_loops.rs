//! Drive files with a list of pulleys, and drives with two pulleys closed as a loop.

use beltdrive::belt_loop::solve;
use beltdrive::input;
use beltdrive::{Closure, Drive, Duty, Guide, Mount, Sense, Side, Tensioner, TensionerLoad};
use insta::assert_snapshot;

const SERPENTINE: &str = r#"
[belt]
type = "flat"
mass_per_length = "0.1 kg/m"
axial_stiffness = "95 kN"
ribs = 6

[friction]
law = "coulomb"
coefficient = 0.7

[[pulley]]
name = "driver"
centre = ["0 mm", "0 mm"]
radius = "70 mm"
friction_coefficient = 0.8
speed = "220 rad/s"

[[pulley]]
name = "tensioner"
radius = "35 mm"
side = "outside"
friction_coefficient = 0.4

[[pulley]]
name = "generator"
centre = { x = "-0.4 m", y = "300 mm" }
diameter = "100 mm"
torque = "10 N*m"

[[pulley]]
centre = ["-360 mm", "120 mm"]
radius = "30 mm"
side = "outside"
friction_coefficient = 0.4

[[pulley]]
name = "blower"
centre = ["-350 mm", "-80 mm"]
radius = "60 mm"
torque = "18 N*m"

[tensioner]
pulley = "tensioner"
[tensioner.arm]
pivot = ["-200 mm", "320 mm"]
length = "120 mm"
stiffness = "20 N*m/rad"
free_angle = "-2.15 rad"
rest_angle = "-1.5 rad"
stops = ["-1.9 rad", "-1.1 rad"]
"#;

fn stated(text: &str, overrides: &[&str]) -> Result<Drive, input::Diagnostic> {
    let overrides: Vec<_> = overrides.iter().map(|text| (*text).to_owned()).collect();
    input::parse("loop.toml", text, &overrides)
}

fn belt_loop(text: &str, overrides: &[&str]) -> Drive {
    let drive = stated(text, overrides).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(drive.two_pulleys(), None);
    drive
}

/// The error of the serpentine with a part replaced, without its excerpt.
fn error(from: &str, to: &str) -> String {
    assert!(from.is_empty() || SERPENTINE.contains(from), "{from}");
    diagnosed(&SERPENTINE.replacen(from, to, 1), &[])
}

fn diagnosed(text: &str, overrides: &[&str]) -> String {
    let error = stated(text, overrides).expect_err("an error").to_string();
    let is_shown = |line: &&str| line.starts_with(|c: char| c.is_alphabetic());
    let lines: Vec<_> = error.lines().filter(is_shown).collect();
    lines.join("\n")
}

#[test]
fn a_list_of_pulleys_is_a_loop() {
    let found = belt_loop(SERPENTINE, &[]);
    assert_eq!(found.belt.ribs, 6);
    assert_eq!(found.sense, Sense::CounterClockwise);
    assert_eq!(found.closure, Closure::RestCoordinate(-1.5));
    let names: Vec<_> = found.pulleys.iter().map(|pulley| &*pulley.name).collect();
    assert_eq!(names, ["driver", "tensioner", "generator", "4", "blower"]);
    let [driver, held, generator, idler, _] = &found.pulleys[..] else {
        panic!("five pulleys")
    };
    assert_eq!(driver.duty, Duty::Driver(220.0));
    assert_eq!(
        [driver.friction_coefficient, generator.friction_coefficient],
        [0.8, 0.7]
    );
    assert_eq!(generator.radius, 0.05);
    assert_eq!(generator.mount, Mount::Fixed([-0.4, 0.3]));
    assert_eq!([driver.side, idler.side], [Side::Inside, Side::Outside]);
    assert_eq!(idler.duty, Duty::Torque(0.0));
    let tensioner = Tensioner {
        guide: Guide::Rotary {
            pivot: [-0.2, 0.32],
            arm_length: 0.12,
        },
        load: TensionerLoad::Spring {
            stiffness: 20.0,
            free_coordinate: -2.15,
        },
        start_coordinate: -1.5,
        travel: Some([-1.9, -1.1]),
    };
    assert_eq!(held.mount, Mount::Tensioner(tensioner));
    let state = solve(&found).unwrap();
    let limit = state.load_limit.unwrap();
    assert_eq!(limit.pulley, 0);
    assert!((limit.factor - 3.386_78).abs() < 1e-5, "{}", limit.factor);
}

#[test]
fn overrides_reach_every_pulley() {
    let found = belt_loop(
        SERPENTINE,
        &[
            "pulley.blower.power=4 kW",
            "pulley.4.centre.x=-340 mm",
            "pulley.generator.radius=0.06",
        ],
    );
    assert_eq!(found.pulleys[4].duty, Duty::Power(4000.0));
    assert_eq!(found.pulleys[3].mount, Mount::Fixed([-0.34, 0.12]));
    assert_eq!(found.pulleys[2].radius, 0.06);
    let closed = [
        "tensioner.arm.rest_angle=",
        "tensioner.arm.angle=-86 deg",
        "load.setup_tension=500 N",
    ];
    assert_eq!(
        belt_loop(SERPENTINE, &closed).closure,
        Closure::SetupTension(500.0)
    );
    assert_snapshot!(diagnosed(SERPENTINE, &["pulley.blowr.power=4 kW"]), @r"
    error: there is no pulley `blowr`
    expected: one of `driver`, `tensioner`, `generator`, `4`, `blower`
    help: did you mean `blower`?
    ");
}

#[test]
fn a_preload_is_the_load_of_the_spring_where_the_tensioner_starts() {
    let preload = ["tensioner.arm.preload=-13 N*m"];
    let Mount::Tensioner(tensioner) = belt_loop(SERPENTINE, &preload).pulleys[1].mount else {
        panic!("a tensioner")
    };
    let TensionerLoad::Spring {
        free_coordinate, ..
    } = tensioner.load
    else {
        panic!("a spring")
    };
    assert!((free_coordinate + 2.15).abs() < 1e-15);
    let weight = "weight = \"60 N\"";
    let text = SERPENTINE.replace("stiffness = \"20 N*m/rad\"", weight);
    let text = text.replace("free_angle = \"-2.15 rad\"\n", "");
    let Mount::Tensioner(tensioner) = belt_loop(&text, &[]).pulleys[1].mount else {
        panic!("a tensioner")
    };
    assert_eq!(tensioner.load, TensionerLoad::Weight(60.0));
}

#[test]
fn what_a_loop_lacks_or_has_twice_is_counted() {
    assert_snapshot!(error("rest_angle = \"-1.5 rad\"", "angle = \"-1.5 rad\""), @r"
    error: nothing says how tight the belt is: one quantity closes the loop, none is given
    expected: one of `belt_length`, `setup_tension`, `span_tension` and `span_tractive_tension` in [load], or the position of the tensioner at rest
    ");
    assert_snapshot!(error("[tensioner]", "[load]\nsetup_tension = 400\nbelt_length = 2\n[tensioner]"), @r"
    error: one quantity closes the loop, 3 are given: `load.setup_tension`, `load.belt_length`, `tensioner.arm.rest_angle`
    expected: one of `belt_length`, `setup_tension`, `span_tension` and `span_tractive_tension` in [load], or the position of the tensioner at rest
    help: `--set tensioner.arm.rest_angle=`, without a value, leaves that entry out for one run
    ");
    assert_snapshot!(error("torque = \"10 N*m\"", "torque = 10\npower = 30"), @r"
    error: both `torque` and `power` are given in [[pulley]] `generator`
    expected: one of `speed`, `torque` and `power`, or none for an idler
    ");
    assert_snapshot!(error("torque = \"10 N*m\"", "speed = 30"), @r"
    error: `driver` and `generator` both have a `speed`, which the belt does not allow
    expected: one pulley with a speed; a torque or a power below 0 also drives the belt
    ");
    assert_snapshot!(error("speed = \"220 rad/s\"", "torque = 30"), @r#"
    error: no pulley has a `speed`: one of them drives the belt
    expected: speed = "1000 rpm" in one [[pulley]]
    "#);
    assert_snapshot!(error("radius = \"70 mm\"", ""), @r#"
    error: missing key `radius` or `diameter` in [[pulley]] `driver`
    expected: radius = "60 mm" or diameter = "120 mm"
    "#);
    assert_snapshot!(error("centre = [\"0 mm\", \"0 mm\"]", ""), @r#"
    error: missing key `centre` in [[pulley]] `driver`
    expected: centre = ["120 mm", "80 mm"]
    "#);
    assert_snapshot!(error("[\"0 mm\", \"0 mm\"]", "[\"0 mm\"]"), @r#"
    error: `pulley.driver.centre` must be a pair, got an array
    expected: an array of x and y, e.g. ["120 mm", "120 mm"]
    "#);
    assert_snapshot!(error("[\"0 mm\", \"0 mm\"]", "[\"0 mm\", \"2 N\"]"), @r#"
    error: wrong dimension: expected a length, got a force
    expected: a length, e.g. "80 mm"
    "#);
    assert_snapshot!(error("[tensioner]", "[load]\nspan_tension = 400\n[tensioner]"), @r"
    error: one quantity closes the loop, 2 are given: `load.span_tension`, `tensioner.arm.rest_angle`
    expected: one of `belt_length`, `setup_tension`, `span_tension` and `span_tractive_tension` in [load], or the position of the tensioner at rest
    help: `--set tensioner.arm.rest_angle=`, without a value, leaves that entry out for one run
    ");
    assert_snapshot!(error("[tensioner]", "[load]\ntorque = 40\n[tensioner]"), @r"
    error: `load.torque` does not go with a list of pulleys
    expected: `torque` or `power` in a [[pulley]]
    ");
    assert_snapshot!(error("stiffness = \"20 N*m/rad\"", ""), @r#"
    error: missing key `stiffness` or `weight` in [tensioner.arm]
    expected: stiffness = "20 N*m/rad" or weight = "50 N"
    "#);
    assert_snapshot!(error("pivot = [\"-200 mm\", \"320 mm\"]", ""), @r#"
    error: missing key `pivot` in [tensioner.arm]
    expected: pivot = ["120 mm", "80 mm"]
    "#);
    assert_snapshot!(error("[tensioner.arm]", "[tensioner.slide]\n[tensioner.arm]"), @r"
    error: a tensioner has an arm or a slide, both are given
    expected: [tensioner.arm] or [tensioner.slide]
    ");
}

#[test]
fn names_are_unique_and_known() {
    assert_snapshot!(error("name = \"blower\"", "name = \"driver\""), @r"
    error: two pulleys have the name `driver`
    expected: a name of its own for each pulley
    ");
    assert_snapshot!(error("name = \"blower\"", "name = \"a.b\""), @r"
    error: `a.b` is no name for a pulley
    expected: letters, digits, blanks, hyphens: the name stands in keys such as pulley.NAME.torque
    ");
    assert_snapshot!(error("pulley = \"tensioner\"", "pulley = \"tensoner\""), @r"
    error: there is no pulley `tensoner`
    expected: one of `driver`, `tensioner`, `generator`, `4`, `blower`
    help: did you mean `tensioner`?
    ");
    assert_snapshot!(error("[[pulley]]\nname = \"blower\"", "[pulley]\nname = \"blower\""), @r"
    error: unreadable TOML: duplicate key
    ");
    assert_snapshot!(error("torque = \"10 N*m\"", "torqe = \"10 N*m\""), @r"
    error: unknown key `torqe` in [[pulley]] `generator`
    expected: one of `name`, `radius`, `diameter`, `side`, `friction_coefficient`, `half_angle`, `speed`, `torque`, `power`, `centre`
    help: did you mean `torque`?
    ");
    assert_snapshot!(error("side = \"outside\"", "side = \"back\""), @r"
    error: unknown side of the belt `back`
    expected: one of `inside`, `outside`
    ");
}

#[test]
fn impossible_layouts_are_pointed_at() {
    assert_snapshot!(error("[\"-360 mm\", \"120 mm\"]", "[\"-360 mm\", \"-60 mm\"]"), @r"
    error: pulleys `4` and `blower` overlap: 0.022361 m between the centres, 0.090000 m of radii
    ");
    assert_snapshot!(error("[\"-360 mm\", \"120 mm\"]", "[\"-560 mm\", \"120 mm\"]"), @r#"
    error: the belt does not reach pulley `4`: its wrap would be -50.5494°
    help: the pulleys stand in belt order; `side = "outside"` is for one that runs on the back of the belt
    "#);
    assert_snapshot!(error("[tensioner]", "[layout]\nsense = \"clockwise\"\n[tensioner]"), @r#"
    error: the belt does not reach pulley `blower`: its wrap would be -74.9010°
    help: the pulleys stand in belt order; `side = "outside"` is for one that runs on the back of the belt
    "#);
}

#[test]
fn two_pulleys_are_closed_as_a_loop() {
    let text = beltdrive::examples::find("flat-unequal").unwrap().text;
    let given = ["load.slack_tension=", "load.setup_tension=450 N"];
    let found = belt_loop(text, &given);
    assert_eq!(found.closure, Closure::SetupTension(450.0));
    assert_eq!(found.pulleys[1].duty, Duty::Torque(60.0));
    let state = solve(&found).unwrap();
    // The same drive by its slack tension.
    let slack = format!("load.slack_tension={}", state.spans[0].tension);
    let drive = input::parse("two.toml", text, &[slack]).unwrap();
    let two = beltdrive::solve(&drive, &beltdrive::SolveOptions::default()).unwrap();
    let ratio = two.driven.angular_speed / state.pulleys[1].angular_speed;
    assert!((ratio - 1.0).abs() < 1e-12, "{ratio}");
    assert!((two.belt_length / state.unstretched_length - 1.0).abs() < 1e-9);
    let power = ["load.power=4 kW"];
    let found = belt_loop(text, &power);
    assert_eq!(
        found.closure,
        Closure::SpanTension {
            span: 0,
            tension: 250.0
        }
    );
    assert_eq!(found.pulleys[1].duty, Duty::Power(4000.0));
    assert_snapshot!(diagnosed(text, &["load.setup_tension=400 N"]), @r"
    error: overdetermined: two quantities close a drive, 3 are given: `load.slack_tension`, `load.driven_torque`, `load.setup_tension`
    expected: two tensions, or the torque or power of the driven pulley with a span tension, the setup tension or the belt length
    help: `--set load.slack_tension=`, without a value, leaves that entry out for one run
    ");
    assert_snapshot!(diagnosed(text, &["load.slack_tension=", "load.driven_torque=", "load.belt_length=3"]), @r#"
    error: missing key `driven_torque` or `torque` or `power` in [load]
    expected: driven_torque = "45 N*m" or torque = "45 N*m" or power = "4 kW"
    help: two quantities close a drive: two tensions, or the torque or power of the driven pulley with a span tension, the setup tension or the belt length
    "#);
    assert_snapshot!(diagnosed(text, &["load.span_tension=3"]), @r"
    error: `load.span_tension` is for a list of pulleys
    expected: the tension of the slack or of the tight span
    ");
}
