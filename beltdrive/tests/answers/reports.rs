//! Tables, JSON and CSV of any answer, and the files they are written to.

use beltdrive::quantity::{Answer, Group, Layout, Measure, Quantity, Subject, UnitSystem, Value};
use beltdrive::report::{csv, json, table, write_file};
use serde_json::json;
use std::fs;
use std::path::PathBuf;

fn subject(head: &str, quantities: Vec<Quantity>) -> Subject {
    Subject {
        head: head.to_owned(),
        quantities,
    }
}

fn pulley(name: &str, wrap: f64) -> Subject {
    Subject {
        head: name.to_owned(),
        quantities: vec![
            Quantity::word("name", "", name.to_owned()),
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
            Quantity::word("limiting_pulley", "slips first", "fan".to_owned()),
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
        quantities: vec![Quantity::word("kind", "kind", "slip".to_owned())],
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
            text.lines().all(|line| line.chars().count() <= 100),
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
    assert!(shown(UnitSystem::Us).contains("pulley number 0"));
}

#[test]
fn json_is_complete() {
    let found: serde_json::Value = serde_json::from_str(&json(&answer(1))).unwrap();
    let wrap = 1_f64.to_degrees();
    let expected = json!({
        "zones": [{ "kind": "slip" }],
        "pulleys": [{
            "name": "pulley number 0",
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
    assert_eq!(lines[0], "name,angle_deg");
    assert_eq!(lines[1], "pulley number 0,0");
    assert_eq!(csv(&Answer::default()), "");
}

/// A state with a part and an object, in a row.
fn row(place: usize, head: &str) -> Subject {
    let number = |key: &'static str, label: &'static str| {
        Quantity::number(key, label, Measure::Length, place as f64, 0.0)
    };
    let parts = Value::Parts(vec![("slack", 1.0), ("tight", 2.0)]);
    let inner = vec![
        number("radius", "radius"),
        number("", "shown only"),
        number("width", ""),
    ];
    let object = Value::Object(Some(inner));
    let quantities = vec![
        number("place", "where the belt is"),
        Quantity {
            label: "tension".into(),
            ..Quantity::data("tension", Measure::Force, parts)
        },
        Quantity {
            label: "fan".into(),
            ..Quantity::data("fan", Measure::Number, object)
        },
        Quantity::data("errors", Measure::Number, Value::Object(None)),
        Quantity::data("mesh", Measure::Number, Value::Json(json!([3, 4]))),
        Quantity::data("steps", Measure::Number, Value::Count(7)),
        number("place", ""),
        Quantity::word("", "event", head.to_owned()),
    ];
    subject(head, quantities)
}

fn rows(count: usize) -> Answer {
    let head = |place| if place == 34 { "fold" } else { "" };
    let rows = (0..count).map(|place| row(place, head(place)));
    Answer {
        groups: vec![Group {
            key: "points",
            layout: Layout::Rows,
            subjects: rows.collect(),
        }],
        ..Answer::default()
    }
}

#[test]
fn rows_are_thinned_but_for_the_last_and_those_with_a_head() {
    let text = table(&rows(100), UnitSystem::Si);
    insta::assert_snapshot!(text.lines().take(6).collect::<Vec<_>>().join("\n"), @r"
      where                                fan:
        the    slack    tight     fan:    shown
    belt is  tension  tension   radius     only  event
          m        N        N        m        m
          0  1.00000  2.00000        0        0
    4.00000  1.00000  2.00000  4.00000  4.00000
    ");
    assert_eq!(text.lines().count(), 4 + 25 + 2, "{text}");
    assert!(text.contains("34.0000") && text.contains("99.0000"));
}

#[test]
fn parts_and_objects_are_nested_in_json_and_flat_in_csv() {
    let found: serde_json::Value = serde_json::from_str(&json(&rows(2))).unwrap();
    let expected = json!({
        "place_m": 1.0,
        "tension_N": { "slack": 1.0, "tight": 2.0 },
        "fan": { "radius_m": 1.0, "width_m": 1.0 },
        "errors": null,
        "mesh": [3, 4],
        "steps": 7,
    });
    assert_eq!(found["points"][1], expected);
    let text = csv(&rows(2));
    let lines: Vec<_> = text.lines().collect();
    let header = "place_m,slack_tension_N,tight_tension_N,fan_radius_m,fan_width_m,steps";
    assert_eq!(lines, [header, "0,1,2,0,0,7", "1,1,2,1,1,7"]);
}

#[test]
fn errors_are_powers_of_ten() {
    let error = |value| Quantity {
        digits: 2,
        ..Quantity::number("e", "error", Measure::Length, value, 0.0)
    };
    let subject = subject("", vec![error(2.44e-6), error(0.0)]);
    let group = Group {
        key: "",
        layout: Layout::Single,
        subjects: vec![subject],
    };
    let answer = Answer {
        groups: vec![group],
        ..Answer::default()
    };
    let text = table(&answer, UnitSystem::Engineering);
    let cells: Vec<_> = text.lines().map(|line| line[5..].trim()).collect();
    assert_eq!(cells, ["2.4e−3  mm", "0  mm"]);
}

/// An empty directory of this test run.
fn directory(name: &str) -> PathBuf {
    let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR"))
        .join("answers")
        .join(name);
    drop(fs::remove_dir_all(&path));
    fs::create_dir_all(&path).unwrap();
    path
}

#[test]
fn a_file_is_replaced_and_nothing_else_is_left() {
    let directory = directory("replaced");
    let path = directory.join("a.json");
    for text in ["first", "second"] {
        write_file(&path, text).unwrap();
        assert_eq!(fs::read_to_string(&path).unwrap(), text);
    }
    assert!(write_file(&directory, "a directory").is_err());
    assert!(write_file(&directory.join("none/a.json"), "no directory").is_err());
    assert_eq!(fs::read_dir(&directory).unwrap().count(), 1);
}

#[cfg(unix)]
#[test]
fn links_devices_and_permissions_are_kept() {
    use std::os::unix::fs::{PermissionsExt, symlink};
    let directory = directory("links");
    let [file, link] = ["file", "link"].map(|name| directory.join(name));
    fs::write(&file, "first").unwrap();
    fs::set_permissions(&file, fs::Permissions::from_mode(0o640)).unwrap();
    symlink(&file, &link).unwrap();
    write_file(&link, "second").unwrap();
    assert!(link.is_symlink());
    assert_eq!(fs::read_to_string(&file).unwrap(), "second");
    assert_eq!(
        fs::metadata(&file).unwrap().permissions().mode() & 0o777,
        0o640
    );
    write_file(&PathBuf::from("/dev/null"), "gone").unwrap();
    assert!(!fs::metadata("/dev/null").unwrap().is_file());
}
