use super::{csv, json, table};
use crate::quantity::{Answer, Group, Layout, Measure, Quantity, Subject, UnitSystem, Value};
use crate::report::lines::WIDTH;
use serde_json::json;

fn pulley(name: &str, wrap: f64) -> Subject {
    Subject {
        head: name.to_owned(),
        quantities: vec![
            Quantity::number("wrap_angle", "wrap angle", Measure::Angle, wrap, 1e-12),
            Quantity::number("power", "power", Measure::Power, -1_234.567_89, 0.02),
            Quantity::number("torque_margin", "torque margin", Measure::Number, None, 0.0),
            Quantity::data("centre", Measure::Length, Value::Pair([0.1, -0.2])),
            Quantity::data("angle", Measure::Angle, Value::Series(vec![0.0, wrap])),
        ],
    }
}

fn answer(count: usize) -> Answer {
    let whole = Subject {
        head: String::new(),
        quantities: vec![
            Quantity::number("efficiency", "efficiency", Measure::Share, 0.98, 1e-12),
            Quantity::word("limiting_pulley", "slips first", Some("fan".to_owned())),
        ],
    };
    let pulleys = (0..count).map(|index| pulley(&format!("pulley number {index}"), 1.0));
    let group = |key, layout, subjects| Group {
        key,
        layout,
        subjects,
    };
    let zones = vec![Subject {
        head: String::new(),
        quantities: vec![Quantity::word("kind", "kind", Some("slip".to_owned()))],
    }];
    let root = Subject {
        head: String::new(),
        quantities: vec![Quantity::data("zones", Measure::Number, Value::List(zones))],
    };
    Answer {
        heading: vec!["Title".to_owned()],
        remarks: vec!["a long remark ".repeat(12)],
        groups: vec![
            group("", Layout::Single, vec![root]),
            group("pulleys", Layout::Columns, pulleys.collect()),
            group("loop", Layout::Single, vec![whole]),
        ],
        notes: vec!["a note".to_owned()],
    }
}

#[test]
fn tables_fit_a_terminal_and_show_known_digits() {
    for units in [UnitSystem::Si, UnitSystem::Engineering, UnitSystem::Us] {
        let text = table(&answer(7), units);
        assert!(
            text.lines().all(|line| line.chars().count() <= WIDTH),
            "{text}"
        );
        assert_eq!(text.matches("wrap angle").count(), 2);
        assert!(text.starts_with("Title\n\nWARNING: a long remark"));
        assert!(text.ends_with("a note\n") && text.contains("57.2958") && !text.contains('-'));
        assert!(!text.contains("torque margin"), "no pulley has one");
    }
    let shown = |units| table(&answer(1), units);
    assert!(shown(UnitSystem::Si).contains("−1234.6  W\n"));
    assert!(shown(UnitSystem::Engineering).contains("−1.2346  kW\n"));
    assert!(shown(UnitSystem::Us).contains("−1.6556  hp\n"));
    assert!(shown(UnitSystem::Us).contains("pulley num…"));
}

#[test]
fn json_is_complete() {
    let found: serde_json::Value = serde_json::from_str(&json(&answer(1))).unwrap();
    let wrap = 1_f64.to_degrees();
    let expected = json!({
        "zones": [{ "kind": "slip" }],
        "pulleys": [{
            "wrap_angle_deg": wrap,
            "power_W": -1_234.567_89,
            "torque_margin": null,
            "centre_m": [0.1, -0.2],
            "angle_deg": [0.0, wrap],
        }],
        "loop": { "efficiency": 0.98, "limiting_pulley": "fan" },
    });
    assert_eq!(found, expected);
}

#[test]
fn csv_has_a_row_for_each_point() {
    let text = csv(&answer(2));
    let lines: Vec<_> = text.lines().collect();
    assert_eq!(lines.len(), 5);
    assert_eq!(lines[0], "subject,angle_deg");
    assert_eq!(lines[1], "pulley number 0,0");
    assert_eq!(csv(&Answer::default()), "subject\n");
}
