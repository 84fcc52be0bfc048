//! Bands of answers: by linearisation where it is exact, by sampling where it is not, and faults of `[uncertainty]`.

use beltdrive::input::{DriveFile, Spread};
use beltdrive::quantity::{self, UnitSystem};
use beltdrive::report::{json, table};
use beltdrive::uncertainty::{Band, Number, Uncertainty, of_check, of_rating, of_tension};
use beltdrive::{
    Rating, RatingQuestion, SetupQuestion, SolveOptions, check, examples, rating, tension,
};
use statrs::distribution::{ContinuousCDF, Normal};
use std::process::{Command, Output, Stdio};

fn file(example: &str, overrides: &[&str]) -> DriveFile {
    let example = examples::find(example).unwrap();
    let overrides: Vec<_> = overrides.iter().map(|text| (*text).to_owned()).collect();
    DriveFile::read(example.name, example.text, &overrides).unwrap()
}

fn checked(file: &DriveFile, samples: usize) -> Uncertainty {
    let options = SolveOptions::default();
    let found = check(&file.service().unwrap(), &options, &mut |_, _| {}).unwrap();
    of_check(file, &found, samples, &options, &mut |_, _| {}).unwrap()
}

fn band(found: &Uncertainty, number: Number) -> &Band {
    found
        .bands
        .iter()
        .find(|band| band.number == number)
        .unwrap()
}

/// Hub loads at rest are in proportion to the setup tension.
#[test]
fn linear_numbers_have_exact_bands() {
    let spread = ["uncertainty.load.setup_tension = 5 %"];
    let found = checked(&file("back-side-idler", &spread), 500);
    assert_eq!(found.inputs[0].spread, Spread::Normal(12.5));
    let hub = band(&found, Number::RestHubLoad);
    let linear = hub.linear.unwrap();
    assert!((hub.effects[0].unwrap() / hub.value - 0.05).abs() < 1e-9);
    assert!((linear.mean / hub.value - 1.0).abs() < 1e-12);
    for (end, sign) in linear.interval.into_iter().zip([-1.0, 1.0]) {
        let known = hub.value * (1.0 + sign * 0.05 * 1.959_963_984_540_054);
        assert!((end / known - 1.0).abs() < 1e-9);
    }
    let sampled = hub.sampled.unwrap();
    assert_eq!((sampled.count, found.no_drive), (500, 0));
    // A Latin hypercube of one number has its mean and its deviation all but exactly.
    let distribution = sampled.distribution;
    assert!((distribution.mean / hub.value - 1.0).abs() < 1e-4);
    assert!((distribution.standard_deviation / linear.standard_deviation - 1.0).abs() < 0.01);
    assert!(!hub.disagrees());
    assert_eq!(hub.shares(), [1.0]);
}

/// Of an interval, ± 1.96 σ is wider than 95 %, and its middle is not the stated value.
#[test]
fn an_interval_is_uniform_and_sampling_shows_it() {
    let spread = [
        "uncertainty.load.setup_tension.from = 240",
        "uncertainty.load.setup_tension.to = 280 N",
    ];
    let found = checked(&file("back-side-idler", &spread), 2000);
    assert_eq!(found.inputs[0].spread, Spread::Interval([240.0, 280.0]));
    let hub = band(&found, Number::RestHubLoad);
    let per_newton = hub.value / 250.0;
    let linear = hub.linear.unwrap();
    assert!((linear.mean / (260.0 * per_newton) - 1.0).abs() < 1e-9);
    let deviation = 40.0 / 12_f64.sqrt() * per_newton;
    assert!((linear.standard_deviation / deviation - 1.0).abs() < 1e-9);
    let sampled = hub.sampled.unwrap().distribution.interval;
    for (end, known) in sampled.into_iter().zip([241.0, 279.0]) {
        assert!((end / (known * per_newton) - 1.0).abs() < 1e-3);
    }
    assert!(hub.disagrees());
}

/// Variances of independent numbers add up, and a case holds in the share of samples that its margin says.
#[test]
fn effects_add_in_squares_and_shares_of_samples_follow() {
    let spread = [
        "uncertainty.friction.coefficient = 10 %",
        "uncertainty.pulley.fan.torque = 2 N*m",
        "requirements.smallest_slip_margin = 2.3",
    ];
    let file = file("back-side-idler", &spread);
    let found = checked(&file, 1000);
    let margin = band(&found, Number::SlipMargin);
    let [friction, torque] = [0, 1].map(|input| margin.effects[input].unwrap());
    // The margin is in proportion to 1/torque, whose curvature a difference quotient sees.
    assert!((torque / (-0.1 * margin.value) - 1.0).abs() < 1e-3);
    assert!(friction > 0.0);
    let linear = margin.linear.unwrap();
    assert!(
        (linear.standard_deviation.powi(2) / (friction.powi(2) + torque.powi(2)) - 1.0).abs()
            < 1e-12
    );
    assert!((margin.shares().iter().sum::<f64>() - 1.0).abs() < 1e-12);
    // The same by hand.
    let with = |coefficient: f64| {
        let key = file
            .keys()
            .into_iter()
            .find(|key| key.path() == "friction.coefficient");
        let file = file.with(&key.unwrap(), coefficient);
        band(&checked(&file, 0), Number::SlipMargin).value
    };
    let known = (with(0.7 * 1.025) - with(0.7 * 0.975)) / 0.5;
    assert!((friction / known - 1.0).abs() < 1e-9);
    let [share] = found.holds[..] else {
        panic!("one case")
    };
    // The margin is in proportion to the inverse of the torque: what a friction coefficient leaves of the torques is a
    // probability, whose mean over the coefficients is the share.
    let normal = Normal::standard();
    let places = (0..40).map(|index| normal.inverse_cdf((f64::from(index) + 0.5) / 40.0));
    let holding = places.map(|place| {
        let largest = 20.0 * with(0.7 * (1.0 + 0.1 * place)) / 2.3;
        normal.cdf((largest - 20.0) / 2.0)
    });
    let known = holding.sum::<f64>() / 40.0;
    println!("{share} of the samples hold, {known} of all drives");
    // Three standard deviations of 1000 samples.
    assert!((share - known).abs() < 3.0 * (known * (1.0 - known) / 1000.0).sqrt());
}

#[test]
fn a_band_of_the_tension_is_that_of_tension() {
    let question = SetupQuestion {
        slip_margin: 2.0,
        elongation: 0.005,
        moved: None,
    };
    let options = SolveOptions::default();
    let needed = |file: &DriveFile| {
        tension(&file.service().unwrap(), question, &options, &mut |_, _| {}).unwrap()
    };
    let spread = ["uncertainty.pulley.fan.torque = 10 %"];
    let stated = file("back-side-idler", &spread);
    let found = of_tension(&stated, &needed(&stated), 50, &options, &mut |_, _| {}).unwrap();
    let found = &found.bands[0];
    assert_eq!((found.number, found.case), (Number::SetupTension, None));
    let with = |torque: f64| {
        needed(&file(
            "back-side-idler",
            &[&format!("pulley.fan.torque={torque:?}")],
        ))
        .tension
    };
    let known = (with(20.5) - with(19.5)) / 0.5;
    assert!((found.effects[0].unwrap() / known - 1.0).abs() < 1e-6);
    let [low, high] = found.linear.unwrap().interval;
    assert!((with(20.0 - 1.96 * 2.0) / low - 1.0).abs() < 0.01);
    assert!((with(20.0 + 1.96 * 2.0) / high - 1.0).abs() < 0.01);
    assert!(!found.disagrees());
}

/// All that a rating says grows with the setup tension, so that the quantiles of samples are ratings at its quantiles.
#[test]
fn bands_of_a_rating_are_those_of_ratings() {
    let (question, options) = (RatingQuestion::default(), SolveOptions::default());
    let rated = |file: &DriveFile| {
        rating(&file.drive().unwrap(), question, &options, &mut |_, _| {}).unwrap()
    };
    let spread = [
        "uncertainty.load.setup_tension.from = 240 N",
        "uncertainty.load.setup_tension.to = 360 N",
    ];
    let stated = file("crossed", &spread);
    let found = of_rating(
        &stated,
        &rated(&stated),
        question,
        100,
        &options,
        &mut |_, _| {},
    );
    let found = found.unwrap();
    let with = |tension: f64| {
        rated(&file(
            "crossed",
            &[&format!("load.setup_tension={tension:?} N")],
        ))
    };
    type Of = fn(&Rating) -> f64;
    let numbers: [(Number, Of); 5] = [
        (Number::BestSpeed, |rated| rated.optimum.speed),
        (Number::BestTorque, |rated| rated.optimum.torque),
        (Number::BestPower, |rated| rated.optimum.power),
        (Number::StatedTorque, |rated| {
            rated.stated.as_ref().unwrap().torque
        }),
        (Number::StatedPower, |rated| {
            rated.stated.as_ref().unwrap().power
        }),
    ];
    assert_eq!(found.bands.len(), numbers.len() + 1);
    let quantiles = [0.025, 0.975].map(|quantile| with(240.0 + quantile * 120.0));
    let differences = [299.0, 301.0].map(with);
    for (number, of) in numbers {
        let band = band(&found, number);
        let sampled = band.sampled.unwrap();
        assert_eq!(sampled.count, 100);
        for (end, known) in sampled.distribution.interval.iter().zip(&quantiles) {
            assert!((end / of(known) - 1.0).abs() < 6e-3, "{number:?}");
        }
        // A standard deviation of an interval is its length over √12.
        let slope = 0.5 * (of(&differences[1]) - of(&differences[0]));
        let known = slope * 120.0 / 12_f64.sqrt();
        let found = band.effects[0].unwrap();
        assert!(
            (found / known - 1.0).abs() < 1e-3,
            "{number:?} {found} {known}"
        );
    }
}

#[test]
fn samples_that_are_no_drive_are_counted() {
    let spread = ["uncertainty.friction.coefficient = 60 %"];
    let found = checked(&file("back-side-idler", &spread), 200);
    // Φ(−1/0.6) = 0.0478.
    assert!((9..=10).contains(&found.no_drive), "{}", found.no_drive);
    let answer = quantity::Answer::default();
    let drive = file("back-side-idler", &spread).service().unwrap();
    let told = quantity::uncertainty::told_in(answer, &found, &drive.cases);
    assert!(
        told.remarks
            .iter()
            .any(|remark| remark.contains("of 200 samples are no drive"))
    );
}

#[test]
fn tables_and_json_hold_the_bands() {
    let spread = [
        "uncertainty.friction.coefficient = 10 %",
        "uncertainty.losses.bearing_torque = 50 %",
    ];
    let file = file("serpentine-cases", &spread);
    let options = SolveOptions::default();
    let service = file.service().unwrap();
    let checked = check(&service, &options, &mut |_, _| {}).unwrap();
    let found = of_check(&file, &checked, 20, &options, &mut |_, _| {}).unwrap();
    assert_eq!((found.bands.len(), found.holds.len()), (18, 3));
    let answer = quantity::check::answer(&checked);
    let answer = quantity::uncertainty::told_in(answer, &found, &service.cases);
    let text = table(&answer, UnitSystem::Engineering);
    println!("{text}");
    assert!(text.contains("sampled from"));
    let head = text
        .lines()
        .find(|line| line.contains("idle") && line.contains("95 % from"));
    assert!(head.is_some_and(|line| line.contains("sampled from")));
    assert!(text.contains("variance of slip margin"));
    assert!(text.lines().all(|line| line.chars().count() <= 100));
    let all: serde_json::Value = serde_json::from_str(&json(&answer)).unwrap();
    let all = &all["uncertainty"];
    assert_eq!(all["inputs"][0]["key"], "friction.coefficient");
    let deviation = all["inputs"][0]["standard_deviation"].as_f64().unwrap();
    assert!((deviation - 0.11).abs() < 1e-15);
    let band = &all["bands"][6];
    assert_eq!(
        (&band["quantity"], &band["case"]),
        (&"slip_margin".into(), &"idle".into())
    );
    assert_eq!(
        band["linear"]["low"],
        found.bands[6].linear.unwrap().interval[0]
    );
    assert_eq!(all["holds"]["cruise"], found.holds[0]);
}

/// Runs `check` on a text from standard input.
fn run(arguments: &[&str], text: &str) -> Output {
    use std::io::Write;
    let mut program = Command::new(env!("CARGO_BIN_EXE_beltdrive"))
        .args([&["check", "-"], arguments].concat())
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let mut input = program.stdin.take().unwrap();
    // A fault of the command line ends the program before it reads.
    input.write_all(text.as_bytes()).ok();
    drop(input);
    program.wait_with_output().unwrap()
}

#[test]
fn faults_are_said_where_they_stand() {
    let example = examples::find("serpentine-cases").unwrap().text;
    let cases = [
        (
            "friction.coeficient = 0.1",
            "unknown key `coeficient` in [uncertainty.friction]",
            "did you mean `coefficient`?",
        ),
        (
            "frction.coefficient = 0.1",
            "unknown",
            "did you mean `friction`?",
        ),
        (
            "friction.coefficient = \"0.1 N\"",
            "wrong dimension",
            "a pure number",
        ),
        ("friction.coefficient = 0", "must be positive", ""),
        ("friction.coefficient = \"-5 %\"", "must be positive", ""),
        ("friction.coefficient = \"5 5 %\"", "5 5", ""),
        (
            "friction.coefficient = [1.2, 1.0]",
            "the interval of `friction.coefficient`",
            "the lower end before",
        ),
        (
            "friction.coefficient = [1.2, 1.4]",
            "does not contain its value",
            "",
        ),
        (
            "friction.coefficient = [1.0]",
            "no spread of a number",
            "an interval such as",
        ),
        (
            "friction.coefficient = [1.0, 1.1, 1.2]",
            "no spread of a number",
            "",
        ),
        (
            "friction.coefficient = { from = 1.0 }",
            "has one end",
            "`from` and `to`",
        ),
        ("friction.coefficient = true", "no spread of a number", ""),
        ("friction.law = 0.1", "`friction.law` is not a number", ""),
        ("belt.ribs = 1", "whole number", ""),
        (
            "belt.radial_stiffness = \"5 %\"",
            "the drive file gives no number `belt.radial_stiffness`",
            "",
        ),
        (
            "pulley.alternater.power = \"5 %\"",
            "the drive file gives no number `pulley.alternater.power`",
            "did you mean `pulley.alternator.power`?",
        ),
        (
            "requirements.smallest_slip_margin = 0.1",
            "is not a number that varies",
            "",
        ),
        ("case.idle.share = 0.1", "is not a number that varies", ""),
    ];
    for (line, message, help) in cases {
        let text = format!("{example}\n[uncertainty]\n{line}\n");
        let output = run(&[], &text);
        let said = String::from_utf8(output.stderr).unwrap();
        println!("{said}");
        assert_eq!(output.status.code(), Some(2), "{line}: {said}");
        assert!(
            said.contains(message) && said.contains(help),
            "{line}: {said}"
        );
        let number = text.lines().count();
        assert!(
            said.contains(&format!("-:{number}:")) || said.contains(&format!(":{number}:")),
            "{line}: {said}"
        );
    }
    let without = run(&["--samples", "10"], example);
    assert_eq!(without.status.code(), Some(2));
    for samples in ["0", "1", "ten", "1e9"] {
        let text = format!("{example}\n[uncertainty]\nfriction.coefficient = 0.1\n");
        assert_eq!(
            run(&["--samples", samples], &text).status.code(),
            Some(2),
            "{samples}"
        );
    }
}

/// Every way to write an entry, and numbers of load cases.
#[test]
fn entries_are_read_in_every_form() {
    let example = examples::find("serpentine-cases").unwrap().text;
    for line in [
        "friction.coefficient = 0.11",
        "\"friction.coefficient\" = \"10 %\"",
        "friction = { coefficient = \"10 %\" }",
        "friction.coefficient = [0.9, \"1.3\"]",
        "pulley.\"water pump\".power = \"20 W\"",
        "\"pulley.water pump.power\" = \"5 %\"",
        "case.\"parking on a hot day\".pulley.compressor.torque = \"2 N*m\"",
        "losses.bearing_torque = \"50 %\"",
    ] {
        let text = format!("{example}\n[uncertainty]\n{line}\n");
        let file = DriveFile::read("drive.toml", &text, &[]).unwrap();
        let found = file
            .uncertainty()
            .unwrap_or_else(|error| panic!("{line}: {error}"));
        assert_eq!(found.len(), 1, "{line}");
        file.service().unwrap();
    }
}
