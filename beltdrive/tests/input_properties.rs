//! Properties of reading: whatever the text, the answer is a drive or one diagnostic; and a quantity
//! is the same in every unit.

use beltdrive::{BeltKind, Drive, SpanTension, VBelt, examples, input};
use proptest::{prelude::*, sample::Index};
use std::f64::consts::TAU;

/// A right drive file.
const DRIVE: &str = examples::EXAMPLES[0].text;

/// The right drive file of a flat belt under a torque.
fn flat_drive() -> &'static str {
    examples::find("flat-unequal").unwrap().text
}

fn v_belt(drive: &Drive) -> VBelt {
    match drive.belt.kind {
        BeltKind::V(belt) => belt,
        BeltKind::Flat { .. } => panic!("a V-belt was expected"),
    }
}

/// A change of a text, as slips of editing make it.
#[derive(Clone, Debug)]
enum Edit {
    DeleteCharacter(Index),
    RepeatCharacter(Index),
    ReplaceCharacter(Index, char),
    DeleteLine(Index),
    RepeatLine(Index),
    SwapLines(Index, Index),
    SwapValues(Index, Index),
    ReplaceValue(Index, String),
}

fn edit() -> impl Strategy<Value = Edit> {
    let index = any::<Index>;
    let character = prop_oneof![
        any::<char>(),
        "[-\\[\\]\"'=.#,{}\n\r\t0-9eE]".prop_map(first)
    ];
    prop_oneof![
        index().prop_map(Edit::DeleteCharacter),
        index().prop_map(Edit::RepeatCharacter),
        (index(), character).prop_map(|(at, c)| Edit::ReplaceCharacter(at, c)),
        index().prop_map(Edit::DeleteLine),
        index().prop_map(Edit::RepeatLine),
        (index(), index()).prop_map(|(one, other)| Edit::SwapLines(one, other)),
        (index(), index()).prop_map(|(one, other)| Edit::SwapValues(one, other)),
        (index(), value()).prop_map(|(at, text)| Edit::ReplaceValue(at, text)),
    ]
}

fn first(text: String) -> char {
    text.chars().next().unwrap_or(' ')
}

/// A value, right or wrong.
fn value() -> impl Strategy<Value = String> {
    prop_oneof![
        any::<f64>().prop_map(|number| format!("{number:e}")),
        any::<i64>().prop_map(|number| number.to_string()),
        "\"[-+0-9.,eE]{0,8} ?[a-zA-Zµ°²⁻0-9^*·/ -]{0,8}\"",
        "\"[a-z]{0,8}\"",
        "true|inf|-nan|0x[0-9a-f]{1,40}|\\[1, 2\\]|\\{ a = 1 \\}|1979-05-27|'''\n'''",
        any::<String>(),
    ]
}

fn apply(text: &str, edit: &Edit) -> String {
    let mut characters: Vec<char> = text.chars().collect();
    let mut lines: Vec<String> = text.lines().map(str::to_owned).collect();
    if lines.is_empty() {
        return String::new();
    }
    let (length, count) = (characters.len(), lines.len());
    let part = |line: &str, i: usize| line.split('=').nth(i).unwrap_or_default().to_owned();
    match edit {
        Edit::DeleteCharacter(at) => {
            characters.remove(at.index(length));
            return characters.into_iter().collect();
        }
        Edit::RepeatCharacter(at) => {
            let at = at.index(length);
            characters.insert(at, characters[at]);
            return characters.into_iter().collect();
        }
        Edit::ReplaceCharacter(at, c) => {
            characters[at.index(length)] = *c;
            return characters.into_iter().collect();
        }
        Edit::DeleteLine(at) => {
            lines.remove(at.index(count));
        }
        Edit::RepeatLine(at) => {
            let at = at.index(count);
            lines.insert(at, lines[at].clone());
        }
        Edit::SwapLines(one, other) => lines.swap(one.index(count), other.index(count)),
        Edit::SwapValues(one, other) => {
            let (one, other) = (one.index(count), other.index(count));
            let (first, second) = (lines[one].clone(), lines[other].clone());
            lines[one] = format!("{}={}", part(&first, 0), part(&second, 1));
            lines[other] = format!("{}={}", part(&second, 0), part(&first, 1));
        }
        Edit::ReplaceValue(at, text) => {
            let at = at.index(count);
            lines[at] = format!("{}= {text}", part(&lines[at], 0));
        }
    }
    lines.join("\n")
}

/// Reads a text; an error must be complete and harmless to a terminal.
fn read(text: &str, overrides: &[String]) -> Option<Drive> {
    let shown = match input::parse("drive.toml", text, overrides) {
        Ok(drive) => return Some(drive),
        Err(error) => error.to_string(),
    };
    let lines: Vec<_> = shown.split('\n').collect();
    assert!(
        lines[0].starts_with("error: ") && lines[1].contains("--> "),
        "{shown}"
    );
    assert!(
        lines[4].contains("| ") && lines[4].ends_with('^'),
        "{shown}"
    );
    assert!(lines[5..].iter().all(|line| !line.is_empty()), "{shown}");
    assert!(!shown.contains(|c: char| c.is_control() && !matches!(c, '\n' | '\t')));
    None
}

fn is_sound(drive: &Drive) -> bool {
    let drive = drive.two_pulleys().unwrap();
    let positive = [
        drive.belt.mass_per_length,
        drive.belt.axial_stiffness,
        drive.friction_coefficient,
        drive.driver_radius,
        drive.driver_speed,
        drive.driven_radius,
        drive.centre_distance - drive.driver_radius - drive.driven_radius,
    ];
    let loads = [drive.load.slack, drive.load.tight].map(|span| match span {
        // No torque is a load, too.
        SpanTension::DrivenTorque(torque) => torque >= 0.0 && torque.is_finite(),
        tension => tension.value() > 0.0 && tension.value().is_finite(),
    });
    let of_kind = match drive.belt.kind {
        BeltKind::V(belt) => vec![belt.radial_stiffness, belt.half_angle],
        BeltKind::Flat { .. } => Vec::new(),
    };
    positive
        .iter()
        .chain(&of_kind)
        .all(|value| value.is_finite() && *value > 0.0)
        && loads == [true; 2]
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(2000) })]

    #[test]
    fn an_edited_file_is_a_sound_drive_or_one_diagnostic(edits in prop::collection::vec(edit(), 1..6)) {
        for file in [DRIVE, flat_drive()] {
            let text = edits.iter().fold(file.to_owned(), |text, edit| apply(&text, edit));
            if let Some(drive) = read(&text, &[]) {
                prop_assert!(is_sound(&drive), "{drive:?}");
            }
        }
    }

    #[test]
    fn any_override_is_taken_or_refused(
        key in "[a-z_.]{0,20}|belt|pulleys\\.driver|friction\\.(law|coefficient)|load\\.(tight_tension|driven_torque)|model\\.normal_force",
        value in value(),
        other in any::<String>(),
    ) {
        read(DRIVE, &[format!("{key}={value}")]);
        read(flat_drive(), &[format!("{key}={value}")]);
        read(DRIVE, &[format!("{key} = '{value}'"), other]);
    }

    #[test]
    fn any_text_is_answered(text in any::<String>(), lines in prop::collection::vec(value(), 0..4)) {
        read(&text, &[]);
        read(&format!("{DRIVE}{text}"), &[]);
        read(&lines.join("\n"), std::slice::from_ref(&text));
    }

    #[test]
    fn numbers_survive_exactly(force in 1e-300..1e300, angle in 1e-9..1.57) {
        let overrides = [
            format!("belt.axial_stiffness={force:e} N"),
            format!("groove.half_angle={angle}"),
            format!("load.slack_tension=\"{force:?}\""),
        ];
        let drive = input::parse("drive.toml", DRIVE, &overrides).unwrap();
        prop_assert_eq!(drive.belt.axial_stiffness, force);
        prop_assert_eq!(v_belt(&drive).half_angle, angle);
        prop_assert_eq!(drive.two_pulleys().unwrap().load.slack.value(), force);
    }

    #[test]
    fn a_quantity_is_the_same_in_every_unit(
        number in 0.1..1.0_f64,
        unit in prop::sample::select(UNITS.to_vec()),
        space in " ?",
        product in "\\*|·| |⋅| \\* ",
    ) {
        let (key, symbol, scale, get) = unit;
        let symbol = symbol.replace(' ', &product);
        let overrides = [
            format!("{key}={number}{space}{symbol}"),
            "pulleys.driver.radius=1 cm".to_owned(),
            "pulleys.driven.radius=1 cm".to_owned(),
        ];
        let drive = input::parse("drive.toml", DRIVE, &overrides);
        let found = get(&drive.unwrap_or_else(|error| panic!("{error}")));
        prop_assert!((found / (number * scale) - 1.0).abs() < 1e-12, "{overrides:?}: {found}");
    }
}

type Reader = fn(&Drive) -> f64;

const FORCE: (&str, Reader) = ("belt.axial_stiffness", |drive| drive.belt.axial_stiffness);
const DENSITY: (&str, Reader) = ("belt.mass_per_length", |drive| drive.belt.mass_per_length);
const PRESSURE: (&str, Reader) = ("belt.radial_stiffness", |drive| {
    v_belt(drive).radial_stiffness
});
const ANGLE: (&str, Reader) = ("groove.half_angle", |drive| v_belt(drive).half_angle);
const SPEED: (&str, Reader) = ("pulleys.driver.speed", |drive| {
    drive.two_pulleys().unwrap().driver_speed
});
const LENGTH: (&str, Reader) = ("layout.centre_distance", |drive| {
    drive.two_pulleys().unwrap().centre_distance
});

const fn row(of: (&'static str, Reader), symbol: &'static str, scale: f64) -> Unit {
    (of.0, symbol, scale, of.1)
}

type Unit = (&'static str, &'static str, f64, Reader);

/// Units by the entries that take them, with their values in SI units.
const UNITS: [Unit; 41] = [
    row(FORCE, "N", 1.0),
    row(FORCE, "kN", 1e3),
    row(FORCE, "MN", 1e6),
    row(FORCE, "mN", 1e-3),
    row(FORCE, "lbf", 4.448_221_615_260_5),
    row(FORCE, "kip", 4_448.221_615_260_5),
    row(FORCE, "ozf", 0.278_013_850_953_781_2),
    row(FORCE, "kgf", 9.806_65),
    row(FORCE, "kg m/s^2", 1.0),
    row(FORCE, "Nm/m", 1.0),
    row(FORCE, "kW s/m", 1e3),
    row(FORCE, "hp h/ft", 745.699_871_582_270_2 * 3600.0 / 0.3048),
    row(FORCE, "J/cm", 100.0),
    row(DENSITY, "kg/m", 1.0),
    row(DENSITY, "g/cm", 0.1),
    row(DENSITY, "t/h/rev h/m rev", 1000.0),
    row(DENSITY, "lb/ft", 0.453_592_37 / 0.3048),
    row(DENSITY, "lbm ft^-1", 0.453_592_37 / 0.3048),
    row(DENSITY, "oz/in", 0.028_349_523_125 / 0.0254),
    row(PRESSURE, "N/m²", 1.0),
    row(PRESSURE, "N/mm2", 1e6),
    row(PRESSURE, "kN m⁻²", 1e3),
    row(PRESSURE, "MPa", 1e6),
    row(PRESSURE, "bar", 1e5),
    row(PRESSURE, "psi", 6_894.757_293_168_361),
    row(ANGLE, "rad", 1.0),
    row(ANGLE, "mrad", 1e-3),
    row(ANGLE, "deg", TAU / 360.0),
    row(ANGLE, "°", TAU / 360.0),
    row(SPEED, "rad/s", 1.0),
    row(SPEED, "deg/s", TAU / 360.0),
    row(SPEED, "rpm", TAU / 60.0),
    row(SPEED, "rev/min", TAU / 60.0),
    row(SPEED, "rev/s", TAU),
    row(SPEED, "Hz", TAU),
    row(SPEED, "mph rad/in", 17.6),
    row(LENGTH, "m", 1.0),
    row(LENGTH, "hm", 100.0),
    row(LENGTH, "ft", 0.3048),
    row(LENGTH, "km mil/mm", 25.4),
    row(LENGTH, "µm min²/us/s", 3600.0),
];
