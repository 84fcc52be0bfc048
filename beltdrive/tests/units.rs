//! Every unit that the documentation lists is read, with the dimension under which it stands there.

use beltdrive::input;

const DRIVE: &str = r#"
belt = { type = "flat", mass_per_length = "0.1 kg/m", axial_stiffness = "120 kN" }
friction = { law = "epp", coefficient = 0.4, stiffness = "8.1e6 N/m^2" }
pulleys.driver = { radius = "0.25 m", speed = "1000 rpm" }
pulleys.driven = { radius = "0.25 m" }
layout = { centre_distance = "1e9 m" }
load = { slack_tension = "300 N", driven_torque = "10 N*m" }
"#;

/// A key of a dimension, by its name in the documentation.
fn key(quantity: &str) -> &'static str {
    match quantity {
        "length" => "layout.centre_distance",
        "mass per length" => "belt.mass_per_length",
        "force" => "load.slack_tension",
        "force per area" => "friction.stiffness",
        "inverse length" => "friction.bristle_stiffness",
        "angle" => "groove.half_angle",
        "angular speed" => "pulleys.driver.speed",
        "velocity" => "friction.velocity",
        "torque" => "load.driven_torque",
        "pure number" => "friction.coefficient",
        _ => panic!("{quantity} has no key"),
    }
}

#[test]
fn documented_units_are_read() {
    let text = include_str!("../../docs/commands.md");
    let (_, section) = text.split_once("### Units").unwrap();
    let (_, rows) = section.split_once("| --- | --- |\n").unwrap();
    let mut read = 0;
    for row in rows.lines().map_while(|row| row.strip_prefix("| ")) {
        let (quantity, units) = row.split_once(" | ").unwrap();
        let listed: Vec<_> = units.split('`').collect();
        for (unit, after) in listed[1..].chunks(2).map(|pair| (pair[0], pair[1])) {
            // Angles are small and distances large, so that all values are in their ranges.
            let number = match quantity {
                "angle" => "0.01",
                "length" => "1e9",
                _ => "12",
            };
            let prefixed = after.starts_with('*').then(|| format!("da{unit}"));
            for unit in [Some(unit.to_owned()), prefixed].into_iter().flatten() {
                let set = format!("{}={number} {unit}", key(quantity));
                let outcome = input::parse("drive.toml", DRIVE, std::slice::from_ref(&set));
                assert!(outcome.is_ok(), "{set}: {}", outcome.unwrap_err());
                read += 1;
            }
        }
    }
    assert!(read > 60, "{read} units");
}

#[test]
fn spellings_of_one_value_agree() {
    let speed = |unit: &str| {
        let set = format!("pulleys.driver.speed=1450 {unit}");
        input::parse("drive.toml", DRIVE, &[set])
            .unwrap()
            .two_pulleys()
            .unwrap()
            .driver_speed
    };
    for unit in [
        "1/min", "min-1", "min^-1", "min⁻¹", "r/min", "rev/min", "RPM",
    ] {
        let relative = speed(unit) / speed("rpm") - 1.0;
        assert!(relative.abs() < 1e-15, "{unit}: {relative}");
    }
    let set = |text: &str| input::parse("drive.toml", DRIVE, &[text.to_owned()]);
    assert_eq!(
        set("friction.coefficient=40 %").unwrap().pulleys[0].friction_coefficient,
        0.4
    );
    let refused = set("load.slack_tension=45 lb").unwrap_err().to_string();
    assert!(refused.contains("write lbf, kgf or N"), "{refused}");
}
