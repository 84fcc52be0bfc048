//! Numbers of drive files found from measured rows: known ones come back, and intervals contain them as often as they
//! say.

#[path = "support/random.rs"]
mod random;

use beltdrive::calibrate::{Error, Scatter};
use beltdrive::input::{DriveFile, Measurements};
use beltdrive::{Calibration, SolveOptions, belt_loop, calibrate, examples};
use random::Random;
use std::fmt::Write;

/// The flat drive of the coverage trials: stiff enough friction that creep tells the axial stiffness, loads near
/// enough to slip that the speeds tell the friction.
fn bench(overrides: &[&str]) -> DriveFile {
    let text = examples::find("flat-bench").unwrap().text;
    let overrides: Vec<_> = overrides.iter().map(|text| (*text).to_owned()).collect();
    DriveFile::read("flat-bench.toml", text, &overrides).unwrap()
}

/// The values behind the readings.
const TRUTH: [(&str, f64); 2] = [
    ("belt.axial_stiffness", 90e3),
    ("friction.coefficient", 0.55),
];

/// Torques and setup tensions of the rows.
const ROWS: [[f64; 2]; 8] = [
    [8.0, 300.0],
    [16.0, 300.0],
    [24.0, 300.0],
    [28.0, 300.0],
    [10.0, 200.0],
    [18.0, 200.0],
    [32.0, 400.0],
    [38.0, 400.0],
];

/// Standard deviations of the speed in rad/s and of the tension in N.
const DEVIATIONS: [f64; 2] = [0.02, 2.0];

/// Speed and tight tension of each row without errors.
fn exact() -> Vec<[f64; 2]> {
    let rows = ROWS.iter().map(|[torque, tension]| {
        let mut overrides = vec![
            format!("load.torque={torque} N*m"),
            format!("load.setup_tension={tension} N"),
        ];
        overrides.extend(TRUTH.map(|(path, value)| format!("{path}={value}")));
        let overrides: Vec<_> = overrides.iter().map(String::as_str).collect();
        let drive = bench(&overrides).drive().unwrap();
        let state = belt_loop::solve(&drive).unwrap();
        [state.pulleys[1].angular_speed, state.spans[1].tension]
    });
    rows.collect()
}

/// The rows as CSV: with the tension and standard deviations, or the speeds alone.
fn csv(readings: &[[f64; 2]], has_deviations: bool) -> String {
    let mut text = "load.torque,load.setup_tension,driven.angular_speed".to_owned();
    if has_deviations {
        text += ",driven.angular_speed sd,driven.exit_tension,driven.exit_tension sd";
    }
    for ([torque, tension], [speed, tight]) in ROWS.iter().zip(readings) {
        write!(text, "\n{torque},{tension},{speed}").unwrap();
        if has_deviations {
            let [of_speed, of_tension] = DEVIATIONS;
            write!(text, ",{of_speed},{tight},{of_tension}").unwrap();
        }
    }
    text
}

fn found(file: &DriveFile, text: &str, free: &[&str]) -> Result<Calibration, Error> {
    found_to(SolveOptions::default().tolerance, file, text, free)
}

fn found_to(
    tolerance: f64,
    file: &DriveFile,
    text: &str,
    free: &[&str],
) -> Result<Calibration, Error> {
    let free: Vec<_> = free.iter().map(|path| (*path).to_owned()).collect();
    let keys = file
        .free_keys(&free)
        .unwrap_or_else(|error| panic!("{error}"));
    let data = Measurements::read("rows.csv", text, file).unwrap_or_else(|error| panic!("{error}"));
    calibrate(&keys, &data, &SolveOptions { tolerance }, &mut |_, _| {})
}

#[test]
fn exact_rows_give_the_numbers_behind_them() {
    let calibration = found(&bench(&[]), &csv(&exact(), true), &[]).unwrap();
    for (parameter, (path, truth)) in calibration.parameters.iter().zip(TRUTH) {
        assert_eq!(parameter.key.path(), path);
        assert!(
            (parameter.value / truth - 1.0).abs() < 1e-9,
            "{parameter:?}"
        );
    }
    assert!(calibration.sum_of_squares < 1e-10);
    assert_eq!(calibration.degrees_of_freedom, 2 * ROWS.len() - 2);
    assert!(
        matches!(calibration.scatter, Scatter::Stated(Some((reduced, [low, _]))) if reduced < low)
    );
}

/// The share of trials with normal errors that have the truth in the interval of each number.
fn coverage(trials: u32, has_deviations: bool) -> [f64; 2] {
    let (file, exact) = (bench(&[]), exact());
    let mut inside = [0.0; 2];
    let mut random = Random(0x9E37_79B9_7F4A_7C15);
    for _ in 0..trials {
        let mut normal = || {
            let [radius, angle] = [random.between(0.0, 1.0), random.between(0.0, 1.0)];
            (-2.0 * (1.0 - radius).ln()).sqrt() * (std::f64::consts::TAU * angle).cos()
        };
        let readings: Vec<_> = exact
            .iter()
            .map(|values| [0, 1].map(|index| values[index] + DEVIATIONS[index] * normal()))
            .collect();
        let calibration = found(&file, &csv(&readings, has_deviations), &[]).unwrap();
        for (index, (parameter, (_, truth))) in calibration.parameters.iter().zip(TRUTH).enumerate()
        {
            let [low, high] = parameter.interval.unwrap();
            inside[index] += f64::from(u8::from((low..=high).contains(&truth)));
        }
    }
    inside.map(|count| count / f64::from(trials))
}

#[test]
fn stated_errors_give_intervals_that_contain_the_truth_as_often_as_they_say() {
    let shares = coverage(1000, true);
    for share in shares {
        assert!((0.93..=0.97).contains(&share), "{shares:?}");
    }
}

#[test]
fn estimated_errors_give_intervals_that_contain_the_truth_as_often_as_they_say() {
    let shares = coverage(1000, false);
    for share in shares {
        assert!((0.93..=0.97).contains(&share), "{shares:?}");
    }
}

#[test]
fn rows_that_cannot_tell_numbers_apart_are_reported() {
    // A drive that hardly creeps has the speed of its driven pulley from the ratio of the radii.
    let text = "load.torque,load.setup_tension,driven.angular_speed,driven.angular_speed sd\n\
                6,400,156.9,0.02\n10,400,156.8,0.02\n14,400,156.7,0.02\n8,400,156.85,0.02";
    let radii = ["pulleys.driver.radius", "pulleys.driven.radius"];
    let calibration = found(&bench(&["belt.axial_stiffness=90 kN"]), text, &radii).unwrap();
    let ambiguity = &calibration.ambiguities[0];
    let [(one, raised), (other, too)] = &ambiguity.combination[..] else {
        panic!("{ambiguity:?}")
    };
    assert_eq!([one, other], radii);
    // Raised together, the radii leave the ratio as it is.
    assert!(
        (raised - 0.1).abs() < 1e-12 && (too - 0.1).abs() < 0.01,
        "{ambiguity:?}"
    );
    assert!(ambiguity.correlation.unwrap() > 0.99);
}

#[test]
fn a_number_without_effect_is_reported_and_has_no_interval() {
    let file = bench(&[]);
    let free = ["belt.axial_stiffness", "friction.velocity"];
    // Without load nothing creeps, so that only the stiffness of the belt at rest would count.
    let text = "load.torque,load.setup_tension,loop.rest_tension\n1,300,300\n2,300,301\n3,310,309";
    let calibration = found(&file, text, &free).unwrap();
    assert_eq!(calibration.ambiguities.len(), 2);
    assert!(
        calibration
            .ambiguities
            .iter()
            .all(|ambiguity| ambiguity.combination.len() == 1)
    );
    assert!(
        calibration
            .parameters
            .iter()
            .all(|parameter| parameter.interval.is_none())
    );
    assert_eq!(calibration.correlation, None);
}

#[test]
fn a_number_whose_best_value_is_zero_has_no_interval() {
    // The belt of the file is softer than that of the rows. It creeps more, and least without the mass that loosens it.
    let found = found(&bench(&[]), &csv(&exact(), true), &["belt.mass_per_length"]);
    let calibration = found.unwrap();
    let [mass] = &calibration.parameters[..] else {
        panic!("one number")
    };
    assert!(mass.value < 1e-6 * mass.start, "{mass:?}");
    assert_eq!([mass.standard_error, mass.interval.map(|_| 0.0)], [None; 2]);
    let [ambiguity] = &calibration.ambiguities[..] else {
        panic!("one remark")
    };
    assert_eq!(ambiguity.combination.len(), 1);
}

#[test]
fn the_scatter_of_a_single_quantity_is_estimated() {
    let mut readings = exact();
    for (index, [speed, _]) in readings.iter_mut().enumerate() {
        *speed += if index % 2 == 0 { 0.02 } else { -0.02 };
    }
    let calibration = found(&bench(&[]), &csv(&readings, false), &[]).unwrap();
    let Scatter::Estimated(Some(scatter)) = calibration.scatter else {
        panic!("{:?}", calibration.scatter)
    };
    assert!((0.015..0.03).contains(&scatter), "{scatter}");
    // Student's quantile of six degrees of freedom.
    let parameter = &calibration.parameters[0];
    let [low, high] = parameter.interval.unwrap();
    let relative = parameter.standard_error.unwrap() / parameter.value;
    let quantile = 0.5 * (high / low).ln() / relative;
    assert!((quantile - 2.447).abs() < 1e-3, "{quantile}");
}

/// Ntarladima, Pieber and Gerstmayr (2023): finite elements with EA = 8000 N on a reference length that is 1/0.95 of
/// the unstretched one, and μ = 0.5; 480 elements.
#[test]
fn the_belt_of_published_finite_elements_is_found_again() {
    let file = r#"
        [belt]
        type = "flat"
        mass_per_length = 0.872421
        axial_stiffness = "5 kN"
        [friction]
        law = "epp"
        coefficient = 0.7
        stiffness = 4.210526e8
        [pulleys.driver]
        radius = "0.1 m"
        speed = "12 rad/s"
        [pulleys.driven]
        radius = "0.1 m"
        [layout]
        centre_distance = 0.314159265358979
        [load]
        belt_length = 1.193805208364123
        torque = "47.652 N*m"
        [model]
        normal_force = "exact"
    "#;
    let file = DriveFile::read("finite-elements.toml", file, &[]).unwrap();
    // Deviations are half the bands that `verify` gives the errors of their mesh.
    let rows = "load.torque,driven.angular_speed,driven.angular_speed sd,driven.exit_tension,driven.exit_tension sd,\
                driver.exit_tension,driver.exit_tension sd,driven.slip_arc,driven.slip_arc sd,\
                driver.slip_arc,driver.slip_arc sd\n\
                47.652,11.3248,0.017,664.52,2.4,186.27,2.4,2.438,0.037,2.465,0.037";
    let free = ["belt.axial_stiffness", "friction.coefficient"];
    let calibration = found(&file, rows, &free).unwrap();
    for (parameter, truth) in calibration.parameters.iter().zip([7600.0, 0.5]) {
        let [low, high] = parameter.interval.unwrap();
        assert!(low < truth && truth < high, "{parameter:?}");
        assert!(
            (parameter.value / truth - 1.0).abs() < 0.02,
            "{parameter:?}"
        );
    }
    assert!(
        calibration.ambiguities.is_empty(),
        "{:?}",
        calibration.ambiguities
    );
}

#[test]
fn bristles_of_a_v_belt_are_found() {
    let text = examples::find("kim2009-bristle").unwrap().text;
    let file = DriveFile::read("kim2009-bristle.toml", text, &[]).unwrap();
    let mut rows =
        "load.tight_tractive_tension,driven.angular_speed,driven.angular_speed sd,driven.torque,\
                    driven.torque sd"
            .to_owned();
    for tension in [500.0, 3000.0] {
        let overrides = [format!("load.tight_tractive_tension={tension}")];
        let drive = DriveFile::read("kim2009-bristle.toml", text, &overrides).unwrap();
        let state = belt_loop::solve(&drive.drive().unwrap()).unwrap();
        let driven = &state.pulleys[1];
        write!(
            rows,
            "\n{tension},{},0.05,{},0.5",
            driven.angular_speed, driven.torque
        )
        .unwrap();
    }
    let file = {
        let keys = file.keys();
        let key = |path: &str| keys.iter().find(|key| key.path() == path).unwrap();
        let file = file.with(key("friction.coefficient"), 0.42);
        file.with(key("friction.bristle_stiffness"), 1300.0)
    };
    let free = ["friction.coefficient", "friction.bristle_stiffness"];
    let calibration = found(&file, &rows, &free).unwrap();
    for (parameter, truth) in calibration.parameters.iter().zip([0.4, 1620.0]) {
        assert!(
            (parameter.value / truth - 1.0).abs() < 3e-6,
            "{parameter:?}"
        );
    }
    // Those who ask for less get the same intervals.
    let less = found_to(1e-4, &file, &rows, &free).unwrap();
    for (parameter, known) in less.parameters.iter().zip(&calibration.parameters) {
        let [error, other] = [parameter, known].map(|found| found.standard_error.unwrap());
        assert!((error / other - 1.0).abs() < 1e-3, "{error} {other}");
    }
}

/// Rows on a drive with a slide, whose direction the numbers of the drive do not follow along a straight line: its
/// derivatives are differences, those of the axial stiffness are exact.
#[test]
fn a_number_is_found_by_differences_beside_one_with_exact_derivatives() {
    let (pulleys, _) = include_str!("drives/eight-pulleys.toml")
        .split_once("[tensioner.arm]")
        .unwrap();
    let slide = include_str!("drives/slide.toml");
    let text = format!("{pulleys}{slide}");
    let read = |overrides: &[String]| DriveFile::read("slide.toml", &text, overrides).unwrap();
    let mut rows = "pulley.4.torque,1.exit_tractive_tension,1.exit_tractive_tension sd,\
                    4.angular_speed,4.angular_speed sd"
        .to_owned();
    let torques = [6, 9, 12];
    for torque in torques {
        let drive = read(&[format!("pulley.4.torque={torque}")])
            .drive()
            .unwrap();
        let state = belt_loop::solve(&drive).unwrap();
        let (span, pulley) = (&state.spans[1], &state.pulleys[4]);
        let [tension, speed] = [span.tractive_tension, pulley.angular_speed];
        write!(rows, "\n{torque},{tension},1,{speed},0.01").unwrap();
    }
    let file = read(
        &["belt.axial_stiffness", "tensioner.slide.direction"].map(|path| {
            let start = if path.starts_with("belt") {
                "110 kN"
            } else {
                "230 deg"
            };
            format!("{path}={start}")
        }),
    );
    let find = |free: &[&str]| found(&file, &rows, free).unwrap();
    let both = find(&["belt.axial_stiffness", "tensioner.slide.direction"]);
    for (parameter, truth) in both.parameters.iter().zip([100e3, 225_f64.to_radians()]) {
        assert!(
            (parameter.value / truth - 1.0).abs() < 1e-6,
            "{parameter:?}"
        );
    }
    // A state of each row at every place, and two beside each of them for the differences.
    assert!(both.states > torques.len() * both.steps);
    let one = find(&["belt.axial_stiffness"]);
    assert_eq!(one.states, torques.len() * one.steps);
}

#[test]
fn what_cannot_be_found_is_refused() {
    let file = bench(&[]);
    let one = "load.torque,driven.angular_speed\n10,156";
    assert!(matches!(
        found(&file, one, &[]),
        Err(Error::TooFew {
            readings: 1,
            parameters: 2
        })
    ));
    let set = "friction.coefficient,driven.angular_speed\n0.5,156\n0.6,156";
    assert!(
        matches!(found(&file, set, &[]), Err(Error::Set { path }) if path == "friction.coefficient")
    );
    let slips = "load.torque,driven.angular_speed\n10,156\n\n# a comment\n4000,156";
    match found(&file, slips, &[]) {
        Err(Error::Start(row)) => {
            assert_eq!(row.line, 5);
            assert!(row.reason.contains("gross slip"), "{}", row.reason);
        }
        other => panic!("{other:?}"),
    }
}

#[track_caller]
fn refused(text: &str, place: &str, words: &[&str]) {
    let error = Measurements::read("rows.csv", text, &bench(&[]))
        .unwrap_err()
        .to_string();
    assert!(
        error.contains(&format!("--> rows.csv:{place}\n")),
        "{error}"
    );
    for words in words {
        assert!(error.contains(words), "{error}");
    }
}

#[test]
fn faults_of_the_data_are_shown_where_they_stand() {
    let head = "load.torque [N*m],driven.angular_speed [rpm]";
    refused("", "1:1", &["there is no line with headings"]);
    refused(head, "1:45", &["there are no rows below the headings"]);
    refused(
        "load.torque\n10",
        "1:1",
        &["no column holds a measured quantity"],
    );
    refused(
        "load.torqe,driven.angular_speed\n1,2",
        "1:1",
        &["unknown column `load.torqe`", "did you mean `load.torque`?"],
    );
    refused(
        "load.torque,driven.angular_sped\n1,2",
        "1:13",
        &["did you mean `driven.angular_speed`?"],
    );
    refused(
        "load.torque;colour\n1;2",
        "1:1",
        &["commas part the fields of a line"],
    );
    refused(
        "load.torque,colour\n1,2",
        "1:13",
        &["what can be measured: `driver.angular_speed`"],
    );
    refused(
        "load.torque [N],driven.angular_speed\n1,2",
        "1:14",
        &["wrong dimension: expected a torque, got a force"],
    );
    refused(
        "load.torque [N*mm,driven.angular_speed\n1,2",
        "1:1",
        &["has no end"],
    );
    refused(
        "driven.exit_frequency [rpm]\n1",
        "1:24",
        &["`rpm` is no unit of a frequency"],
    );
    refused(
        &format!("# rows\n{head}\n10,1490\n\n20"),
        "5:1",
        &["1 fields under 2 headings"],
    );
    refused(
        &format!("{head}\n10,1490\n20, 14x9 "),
        "3:5",
        &["malformed number `14x9`"],
    );
    refused(&format!("{head}\n,1490"), "2:1", &["missing number"]);
    refused(
        &format!("{head}\n-3,1490"),
        "2:1",
        &["`load.torque` is out of its range"],
    );
    refused(
        "driven.angular_speed,driven.exit_tension,driven.exit_tension sd\n1,2,3",
        "1:1",
        &[
            "`driven.angular_speed` has no standard deviation",
            "a column `driven.angular_speed sd`",
        ],
    );
    refused(
        "driven.angular_speed,driven.angular_speed sd\n1,0",
        "2:3",
        &["a standard deviation must be positive"],
    );
    refused(
        "driven.angular_speed,driven.angular_speed\n1,0",
        "1:22",
        &["stands twice"],
    );
    refused(
        "driven.angular_speed sd,driven.angular_speed\n1,0",
        "1:1",
        &["a standard deviation before its column"],
    );
}

#[test]
fn rows_of_spreadsheets_are_read() {
    let text = "\u{feff}\"load.torque [N*m]\", driven.angular_speed [rpm]\r\n10,1490\r\n 20 ,\r\n";
    let data = Measurements::read("rows.csv", text, &bench(&[])).unwrap();
    assert_eq!(data.rows.len(), 2);
    let reading = data.rows[0].readings[0].unwrap();
    assert!((reading.value - 1490.0 * std::f64::consts::PI / 30.0).abs() < 1e-12);
    assert_eq!(data.rows[1].readings, [None]);
    assert_eq!([data.rows[0].line, data.rows[1].line], [2, 3]);
}

#[test]
fn keys_that_are_to_be_found_are_numbers_of_the_file() {
    let error = |from: &str, to: &str| {
        let text = examples::find("flat-bench")
            .unwrap()
            .text
            .replacen(from, to, 1);
        let file = DriveFile::read("flat-bench.toml", &text, &[]).unwrap();
        let checked = file
            .drive()
            .map(|_| ())
            .and_then(|()| file.free_keys(&[]).map(|_| ()));
        checked.unwrap_err().to_string()
    };
    let unknown = error("\"belt.axial_stiffness\", ", "\"belt.axial_stifness\", ");
    assert!(
        unknown.contains("the drive file gives no number `belt.axial_stifness`"),
        "{unknown}"
    );
    assert!(
        unknown.contains("did you mean `belt.axial_stiffness`?"),
        "{unknown}"
    );
    assert!(unknown.contains("flat-bench.toml:30:9"), "{unknown}");
    let twice = error("\"belt.axial_stiffness\", ", "\"friction.coefficient\", ");
    assert!(
        twice.contains("`friction.coefficient` stands twice"),
        "{twice}"
    );
    let number = error(
        "free = [\"belt.axial_stiffness\", \"friction.coefficient\"]",
        "free = 3",
    );
    assert!(
        number.contains("`calibration.free` must be an array of keys, got a number"),
        "{number}"
    );
    let none = error(
        "free = [\"belt.axial_stiffness\", \"friction.coefficient\"]",
        "",
    );
    assert!(
        none.contains("nothing says which numbers are to be found"),
        "{none}"
    );
    let file = bench(&[]);
    let named = ["friction.coefficient", "friction.coefficient"].map(str::to_owned);
    assert!(
        file.free_keys(&named)
            .unwrap_err()
            .to_string()
            .contains("stands twice")
    );
}
