use super::*;
use crate::belt_loop::solve;
use crate::examples;
use crate::input::DriveFile;
use std::collections::BTreeSet;

const EIGHT: &str = include_str!("../../../../tests/drives/eight-pulleys.toml");

/// Each law with the conventions that it goes with. The softest bristles let the belt stick again behind a slip zone.
fn laws() -> Vec<Vec<String>> {
    let with = |law: &str, conventions: &[&str]| {
        let words = law
            .split_whitespace()
            .map(|word| format!("friction.{word}"));
        let words: Vec<_> = words.collect();
        let all = conventions.iter().map(|convention| {
            let mut overrides = words.clone();
            overrides.push(format!("model.normal_force={convention}"));
            overrides
        });
        all.collect::<Vec<_>>()
    };
    let all = ["thesis", "inertia", "exact"];
    [
        with("law=coulomb", &all),
        with("law=epp stiffness=1e8", &all),
        with("law=epp stiffness=3e6", &all),
        with("law=creep-rate velocity=0.02", &all[1..]),
    ]
    .concat()
}

fn file(text: &str, overrides: &[String]) -> DriveFile {
    DriveFile::read("drive.toml", text, overrides).unwrap_or_else(|error| panic!("{error}"))
}

/// The derivatives of all measured numbers with each number of a file, over the values, against differences of solved
/// states; the keys with which there are none.
fn compare(file: &DriveFile, what: &str) -> BTreeSet<String> {
    let drive = file
        .drive()
        .unwrap_or_else(|error| panic!("{what}: {error}"));
    let state = solve(&drive).unwrap_or_else(|error| panic!("{what}: {error}"));
    let measured = Measured::all(&drive);
    let known = Derivatives::new(&drive, &state).unwrap();
    let mut open = BTreeSet::new();
    for key in file.keys() {
        let value = file.value(&key).unwrap();
        let unit = if value == 0.0 { 1e-2 } else { value };
        let at = |by: f64| file.with(&key, value + by * unit).drive().ok();
        let direction = Direction::new(&drive, at).unwrap_or_else(|| panic!("{}", key.path()));
        let Some(found) = known.along(&direction, measured.iter()) else {
            open.insert(key.path().to_owned());
            continue;
        };
        // Central differences over one and two steps, of which the error of second order is taken off.
        let step = 1e-4;
        let beside = [-2.0, -1.0, 1.0, 2.0].map(|steps| solve(&at(steps * step).unwrap()).unwrap());
        for (measured, found) in measured.iter().zip(found) {
            let Some(here) = measured.of(&state) else {
                continue;
            };
            let [a, b, c, d] = beside.each_ref().map(|state| measured.of(state).unwrap());
            let difference = (8.0 * (c - b) - (d - a)) / (12.0 * step);
            let scale = here.abs().max(difference.abs());
            assert!(
                (found - difference).abs() <= 1e-7 * scale,
                "{what}: {} with {}: {found:e} {difference:e}, {here:e}",
                measured.name(),
                key.path()
            );
        }
    }
    open
}

/// Asserts that derivatives with all numbers of a file are exact.
fn assert_exact(text: &str, overrides: &[String]) {
    let what = overrides.join(" ");
    let open = compare(&file(text, overrides), &what);
    assert!(open.is_empty(), "{what}: {open:?}");
}

#[test]
fn two_pulleys_with_every_law_and_convention() {
    let text = examples::find("flat-bench").unwrap().text;
    for overrides in laws() {
        assert_exact(text, &overrides);
    }
}

/// Overrides from their texts.
fn set(overrides: &[&str]) -> Vec<String> {
    overrides.iter().map(|&entry| entry.to_owned()).collect()
}

#[test]
fn two_pulleys_with_every_closure() {
    let text = examples::find("flat-bench").unwrap().text;
    let none = ["load.torque=", "load.setup_tension="];
    for closure in [
        &["torque=20", "belt_length=1.4"][..],
        &["power=3000", "setup_tension=300"],
        &["power=3000", "belt_length=1.4"],
        &["power=2500", "slack_tension=200"],
        &["power=2500", "tight_tractive_tension=400"],
        &["torque=20", "slack_tension=200"],
        &["torque=20", "slack_tractive_tension=200"],
        &["torque=20", "tight_tension=400"],
        &["torque=20", "tight_tractive_tension=400"],
        &["slack_tension=200", "tight_tension=450"],
        &["slack_tractive_tension=200", "tight_tension=450"],
        &["slack_tension=200", "tight_tractive_tension=400"],
        &["slack_tractive_tension=200", "tight_tractive_tension=450"],
    ] {
        for overrides in laws() {
            let closure = closure.iter().map(|entry| format!("load.{entry}"));
            let mut overrides = [set(&none), overrides, closure.collect()].concat();
            overrides.push("pulleys.driven.radius=0.09".to_owned());
            let what = overrides[2..].join(" ");
            let open = compare(&file(text, &overrides), &what);
            assert!(open.is_empty(), "{what}: {open:?}");
        }
    }
}

#[test]
fn eight_pulleys_with_a_tensioner() {
    let arm = "tensioner.arm";
    let moved = [format!("{arm}.rest_angle="), format!("{arm}.angle=-45 deg")];
    let weight = [
        format!("{arm}.stiffness="),
        format!("{arm}.free_angle="),
        format!("{arm}.weight=430"),
    ];
    let preload = [format!("{arm}.free_angle="), format!("{arm}.preload=-24")];
    let closures = [
        vec![],
        [&moved[..], &set(&["load.setup_tension=500"])].concat(),
        [&moved[..], &set(&["load.belt_length=1.9"])].concat(),
        [&moved[..], &set(&["load.span=0", "load.span_tension=500"])].concat(),
        [
            &moved[..],
            &set(&["load.span=1", "load.span_tractive_tension=500"]),
        ]
        .concat(),
        weight.to_vec(),
        preload.to_vec(),
        set(&[
            "pulley.2.torque=",
            "pulley.2.power=1500",
            "pulley.6.torque=",
            "pulley.6.power=400",
        ]),
    ];
    // The first with every law, and every other one with another.
    let laws = laws();
    for (which, closure) in closures.iter().enumerate() {
        let with = match which {
            0 => &laws[..],
            _ => &laws[which..=which],
        };
        for overrides in with {
            assert_exact(EIGHT, &[&closure[..], overrides].concat());
        }
    }
}

#[test]
fn a_slide_has_no_exact_derivative_with_its_direction() {
    let (rest, _) = EIGHT.split_once("[tensioner.arm]").unwrap();
    let slide = include_str!("../../../../tests/drives/slide.toml");
    let text = format!("{rest}{slide}");
    for overrides in laws() {
        let open = compare(&file(&text, &overrides), &overrides.join(" "));
        assert_eq!(open, ["tensioner.slide.direction".to_owned()].into());
    }
}

#[test]
fn a_pulley_without_torque_has_no_exact_derivative_with_it() {
    for overrides in laws() {
        let overrides = [set(&["pulley.5.torque=0"]), overrides].concat();
        let open = compare(&file(EIGHT, &overrides), &overrides.join(" "));
        assert_eq!(open, ["pulley.5.torque".to_owned()].into());
    }
}

#[test]
fn a_crossed_belt() {
    let text = examples::find("crossed").unwrap().text;
    for overrides in laws() {
        assert_exact(text, &overrides);
    }
}

/// Zones on the pulleys of two: elastic over the whole arc, slip at its end, and sticking again behind that.
#[test]
fn every_zone_structure_of_elastic_friction() {
    let text = examples::find("flat-bench").unwrap().text;
    let mut counts = BTreeSet::new();
    for normal_force in ["thesis", "inertia", "exact"] {
        for [stiffness, torque] in [
            [1e9, 25.0],
            [3e7, 25.0],
            [3e5, 25.0],
            [2e5, 36.0],
            [1e6, 38.0],
        ] {
            let overrides = [
                "friction.law=epp".to_owned(),
                format!("friction.stiffness={stiffness}"),
                format!("load.torque={torque}"),
                format!("model.normal_force={normal_force}"),
            ];
            let file = file(text, &overrides);
            let state = solve(&file.drive().unwrap()).unwrap();
            let zones = state.pulleys.iter().map(|pulley| pulley.zones.len());
            counts.extend(zones);
            compare(&file, &overrides.join(" "));
        }
    }
    assert_eq!(counts, [1, 2, 3].into());
}

/// With Coulomb friction the speeds of two rims are as EA and the tractive tensions where the belt enters.
#[test]
fn the_derivatives_are_those_of_a_formula() {
    let text = examples::find("flat-bench").unwrap().text;
    let overrides = set(&[
        "friction.law=coulomb",
        "load.setup_tension=",
        "load.slack_tractive_tension=200",
        "pulleys.driven.radius=0.09",
    ]);
    let file = file(text, &overrides);
    let drive = file.drive().unwrap();
    let state = solve(&drive).unwrap();
    let known = Derivatives::new(&drive, &state).unwrap();
    let all = Measured::all(&drive);
    let of = |path: &str, name: &str| {
        let keys = file.keys();
        let key = keys.iter().find(|key| key.path() == path).unwrap();
        let value = file.value(key).unwrap();
        let at = |by: f64| file.with(key, value * (1.0 + by)).drive().ok();
        let direction = Direction::new(&drive, at).unwrap();
        let measured = all.iter().filter(|measured| measured.name() == name);
        known.along(&direction, measured).unwrap()[0]
    };
    let (axial, friction, slack, change) = (60e3, 0.8, 200.0, 20.0 / 0.09);
    let rim = 0.08 * 1500.0 * std::f64::consts::PI / 30.0;
    let (entry, exit) = (axial + slack, axial + slack + change);
    let speed = rim / 0.09 * entry / exit;
    let slip = (1.0 + change / slack).ln() / friction;
    let stiffening = axial * (1.0 / entry - 1.0 / exit);
    for (path, name, derivative) in [
        (
            "belt.axial_stiffness",
            "driven.angular_speed",
            speed * stiffening,
        ),
        (
            "load.torque",
            "driven.angular_speed",
            -speed * change / exit,
        ),
        ("pulleys.driver.speed", "driven.angular_speed", speed),
        ("friction.coefficient", "driven.slip_arc", -slip),
        ("friction.coefficient", "driven.angular_speed", 0.0),
        (
            "load.torque",
            "driven.slip_arc",
            change / (slack + change) / friction,
        ),
        (
            "load.slack_tractive_tension",
            "driver.exit_tractive_tension",
            slack,
        ),
        ("load.torque", "driven.exit_tractive_tension", change),
    ] {
        let found = of(path, name);
        let off = (found - derivative).abs();
        assert!(
            off <= 1e-13 * derivative.abs(),
            "{path} {name}: {found:e} {derivative:e}"
        );
    }
}
