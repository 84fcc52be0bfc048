//! What drive files take from the belt sections that they name.

use beltdrive::input::{DriveFile, FilledValue, parse};
use beltdrive::sections::find;
use beltdrive::{BeltKind, Drive, examples};

fn text(example: &str) -> &'static str {
    examples::find(example).unwrap().text
}

fn read(example: &str, overrides: &[&str]) -> DriveFile {
    let overrides: Vec<_> = overrides.iter().map(|text| (*text).to_owned()).collect();
    DriveFile::read(&format!("{example}.toml"), text(example), &overrides).unwrap()
}

fn drive(example: &str, overrides: &[&str]) -> Drive {
    read(example, overrides)
        .drive()
        .unwrap_or_else(|error| panic!("{error}"))
}

#[track_caller]
fn refused(example: &str, overrides: &[&str], message: &str) {
    let error = read(example, overrides).drive().unwrap_err().to_string();
    assert!(error.contains(message), "{error}");
}

fn paths(file: &DriveFile) -> Vec<String> {
    let entries = file.filled_in().map(|filled| filled.entries.clone());
    let entries = entries.unwrap_or_default().into_iter();
    entries.map(|entry| entry.path).collect()
}

#[test]
fn a_section_fills_in_what_is_not_given() {
    let section = find("SPB").unwrap();
    let drive = drive("spb-fan", &[]);
    assert_eq!(drive.belt.mass_per_length, 0.195);
    assert_eq!(
        drive.belt.axial_stiffness,
        section.axial_stiffness.unwrap().value
    );
    let belt = match drive.belt.kind {
        BeltKind::V(belt) => belt,
        BeltKind::Flat { .. } => panic!("an SPB belt is a V-belt"),
    };
    // The groove of the small pulley has 34°, that of the large one 38°.
    assert!((belt.half_angle.to_degrees() - 17.0).abs() < 1e-12);
    let other = drive.pulleys[1].half_angle.unwrap();
    assert!((other.to_degrees() - 19.0).abs() < 1e-12);
    assert_eq!(drive.pulleys[0].half_angle, None);
    let stiffness = section.radial_stiffness(belt.half_angle).unwrap();
    assert_eq!(belt.radial_stiffness, stiffness.value);
    assert_eq!(belt.height, Some(0.013));
}

#[test]
fn what_is_given_is_not_filled_in() {
    let all = [
        "belt.type",
        "belt.mass_per_length",
        "belt.axial_stiffness",
        "groove.half_angle",
        "pulleys.driven.half_angle",
        "belt.radial_stiffness",
        "belt.height",
    ];
    assert_eq!(paths(&read("spb-fan", &[])), all);
    let given = read(
        "spb-fan",
        &["belt.mass_per_length=0.2 kg/m", "groove.half_angle=18 deg"],
    );
    assert_eq!(
        paths(&given),
        [
            "belt.type",
            "belt.axial_stiffness",
            "belt.radial_stiffness",
            "belt.height"
        ]
    );
    let found = given.drive().unwrap();
    assert_eq!(found.belt.mass_per_length, 0.2);
    assert_eq!(found.pulleys[1].half_angle, None);
    // Equal pulleys have one groove.
    let equal = read("spb-fan", &["pulleys.driven.diameter=140 mm"]);
    assert!(!paths(&equal).contains(&"pulleys.driven.half_angle".to_owned()));
    assert!(read("v-power", &[]).filled_in().is_none());
}

#[test]
fn pulleys_below_the_smallest_diameter_are_told() {
    let too_small = |overrides: &[&str]| {
        let file = read("spb-fan", overrides);
        file.filled_in().unwrap().too_small.clone()
    };
    assert!(too_small(&[]).is_empty());
    let found = too_small(&["pulleys.driver.radius=60 mm"]);
    let [(name, diameter)] = &found[..] else {
        panic!("{found:?}")
    };
    assert_eq!(name, "driver");
    assert!((diameter - 0.12).abs() < 1e-12);
}

#[test]
fn several_belts_carry_together() {
    let [one, three] = ["belt.ribs=1", "belt.ribs=3"].map(|ribs| drive("spb-fan", &[ribs]).belt);
    let stiffness = |kind| match kind {
        BeltKind::V(belt) => (belt.radial_stiffness, belt.height),
        BeltKind::Flat { .. } => panic!("V-belts"),
    };
    let ((one_k, one_height), (three_k, three_height)) =
        (stiffness(one.kind), stiffness(three.kind));
    assert!((three_k / one_k - 3.0).abs() < 1e-12);
    assert_eq!(one_height, three_height);
    assert!((three.mass_per_length / one.mass_per_length - 3.0).abs() < 1e-12);
    assert!((three.axial_stiffness / one.axial_stiffness - 3.0).abs() < 1e-12);
    assert_eq!(three.ribs, 3);
}

#[test]
fn a_filled_number_is_a_number_of_the_file() {
    let file = read("spb-fan", &[]);
    let keys = file.keys();
    let key = keys.iter().find(|key| key.path() == "belt.axial_stiffness");
    let changed = file.with(key.unwrap(), 100e3).drive().unwrap();
    assert_eq!(changed.belt.axial_stiffness, 100e3);
    let entries = &file.filled_in().unwrap().entries;
    let number = entries
        .iter()
        .find(|entry| entry.path == "belt.mass_per_length");
    match number.unwrap().value {
        FilledValue::Number(_, figure) => assert_eq!(Some(figure), find("SPB").unwrap().mass),
        FilledValue::Word(_) => panic!("a mass is a number"),
    }
}

#[test]
fn ribs_and_widths_multiply_the_numbers_of_their_sections() {
    let ribbed = [
        "belt.section=PK",
        "belt.mass_per_length=",
        "belt.axial_stiffness=",
    ];
    let belt = drive("poly-v", &ribbed).belt;
    assert!(matches!(belt.kind, BeltKind::Flat { .. }));
    assert!((belt.mass_per_length - 5.0 * 0.021).abs() < 1e-15);
    refused(
        "poly-v",
        &[&ribbed[..], &["belt.ribs="]].concat(),
        "the numbers of section PK are those of one rib: `belt.mass_per_length` follows from `belt.ribs`, \
         which is missing",
    );
    let flat = [
        "belt.section=F8-steel",
        "belt.mass_per_length=",
        "belt.axial_stiffness=",
    ];
    let wide = [&flat[..], &["belt.width=50 mm"]].concat();
    let belt = drive("flat-unequal", &wide).belt;
    assert!((belt.axial_stiffness - 0.05 * 19_085e3).abs() < 1e-6);
    assert!((belt.mass_per_length - 0.05 * 3.3).abs() < 1e-15);
    refused(
        "flat-unequal",
        &flat,
        "follows from `belt.width`, which is missing",
    );
    refused(
        "flat-unequal",
        &["belt.width=50 mm"],
        "`belt.width` is for flat belts",
    );
    refused(
        "kim2009",
        &["belt.section=F8-steel"],
        "that of a flat belt, not of a V-belt",
    );
}

#[test]
fn every_pulley_of_a_list_has_the_groove_of_its_diameter() {
    let list = r#"
        [belt]
        section = "A"
        [friction]
        law = "coulomb"
        coefficient = 0.4
        [[pulley]]
        name = "large"
        diameter = "300 mm"
        centre = ["500 mm", "0 mm"]
        power = "1 kW"
        [[pulley]]
        name = "motor"
        diameter = "100 mm"
        centre = ["0 mm", "0 mm"]
        speed = "1450 rpm"
        [[pulley]]
        name = "own"
        diameter = "100 mm"
        centre = ["250 mm", "-300 mm"]
        half_angle = "18 deg"
        [load]
        setup_tension = "300 N"
        [layout]
        sense = "counter-clockwise"
    "#;
    let drive = parse("list.toml", list, &[]).unwrap();
    let degrees = |angle: Option<f64>| angle.map(|angle| angle.to_degrees().round());
    let angles: Vec<_> = drive
        .pulleys
        .iter()
        .map(|pulley| degrees(pulley.half_angle))
        .collect();
    assert_eq!(angles, [Some(19.0), None, Some(18.0)]);
    assert_eq!(degrees(Some(drive.belt.v_half_angle())), Some(17.0));
}

/// The half groove angle of a V-belt.
trait HalfAngle {
    fn v_half_angle(&self) -> f64;
}

impl HalfAngle for beltdrive::Belt {
    fn v_half_angle(&self) -> f64 {
        match self.kind {
            BeltKind::V(belt) => belt.half_angle,
            BeltKind::Flat { .. } => panic!("a V-belt"),
        }
    }
}

#[test]
fn faults_are_shown_where_they_stand() {
    let text = text("spb-fan").replacen("\"SPB\"", "\"SBP\"", 1);
    let error = parse("spb-fan.toml", &text, &[]).unwrap_err().to_string();
    let lines: Vec<_> = error.lines().collect();
    assert_eq!(lines[0], "error: unknown belt section `SBP`");
    assert!(lines[1].ends_with("spb-fan.toml:6:11"), "{error}");
    assert!(error.ends_with("help: did you mean `SPB`?"), "{error}");
    let tensions = [
        "load.power=",
        "load.setup_tension=",
        "load.tight_tension=900 N",
        "load.slack_tension=300 N",
    ];
    refused(
        "spb-fan",
        &tensions,
        "`pulleys.driven.half_angle` differs from the groove of the belt, and two tensions close a drive with \
         one groove angle",
    );
    let one_groove = [&tensions[..], &["groove.half_angle=18 deg"]].concat();
    assert!(drive("spb-fan", &one_groove).two_pulleys().is_some());
}
