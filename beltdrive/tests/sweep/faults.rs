//! What is written of rows without an answer, and what is refused.

use super::program::{answered, directory, refused, run};
use std::fs;

#[test]
fn every_row_of_the_csv_is_there_with_its_status() {
    let directory = directory("csv", "kim2009-flat");
    let output = run(
        &directory,
        &[
            "--over",
            "pulleys.driver.speed=60 rad/s,100 rad/s",
            "--over",
            "load.tight_tension=300 N:9 kN:30",
            "--csv",
            "rows.csv",
        ],
    );
    answered(&output);
    let mut rows = csv::Reader::from_path(directory.join("rows.csv")).unwrap();
    let header = rows.headers().unwrap().clone();
    assert_eq!(
        header.iter().take(4).collect::<Vec<_>>(),
        [
            "row",
            "pulleys_driver_speed_rad_per_s",
            "load_tight_tension_N",
            "belt_length_m"
        ]
    );
    let place = |name: &str| header.iter().position(|known| known == name).unwrap();
    let rows: Vec<_> = rows.records().map(Result::unwrap).collect();
    assert_eq!(rows.len(), 60);
    let mut counts = [0; 2];
    for (index, row) in rows.iter().enumerate() {
        assert_eq!(row[0], index.to_string());
        let is_answered = &row[place("status")] == "answered";
        assert_eq!(is_answered, !row[place("efficiency")].is_empty());
        assert_eq!(is_answered, row[place("reason")].is_empty());
        assert_eq!(is_answered, row[place("description")].is_empty());
        counts[usize::from(is_answered)] += 1;
    }
    assert!(counts[0] > 2 && counts[1] > 5, "{counts:?}");
    let table = String::from_utf8(output.stdout).unwrap();
    let told = format!("{} of 60 rows answered", counts[1]);
    assert!(table.contains(&told), "{table}");
    assert!(directory.join("rows.csv.origin.json").is_file());
}

#[test]
fn faults_of_the_command_line_are_one_error() {
    let directory = directory("faults", "kim2009-flat");
    for (args, message) in [
        (
            &["--over", "load.tight_tensoin=300:500:3"][..],
            "did you mean `load.tight_tension`?",
        ),
        (&["--over", "load.tight_tension"], "there is no `=`"),
        (
            &["--over", "load.tight_tension=300:500:0"],
            "N is not a whole number",
        ),
        (
            &["--over", "load.tight_tension=300:500:1"],
            "N is not a whole number",
        ),
        (&["--over", "load.tight_tension=500:300:3"], "A is above B"),
        (
            &["--over", "load.tight_tension=500:500:3"],
            "the same value",
        ),
        (
            &["--over", "load.tight_tension=nan:500:3"],
            "not a finite number",
        ),
        (
            &["--over", "load.tight_tension=300 kg:500 N:3"],
            "wrong dimension",
        ),
        (
            &["--over", "load.tight_tension=300 N:500 N"],
            "how many values",
        ),
        (&["--over", "load.tight_tension=300 N,"], "missing number"),
        (&["--over", "friction.law=epp,coulomb"], "no number"),
        (
            &[
                "--over",
                "load.tight_tension=300,400",
                "--over",
                "load.tight_tension=1:2:3",
            ],
            "varies twice",
        ),
        (
            &["--over", "load_factor=1:2:3", "--answer", "limits"],
            "load factor",
        ),
        (&["--over", "load_factor=nan:2:3"], "not negative"),
        (
            &["--over", "load.tight_tension=3,4", "--csv", "drive.toml"],
            "would overwrite",
        ),
        (
            &[
                "--over",
                "load.tight_tension=3,4",
                "--csv",
                "-",
                "--json",
                "-",
            ],
            "standard output",
        ),
        (
            &[
                "--over",
                "load.tight_tension=3,4",
                "--csv",
                "nowhere/rows.csv",
            ],
            "cannot write nowhere/rows.csv",
        ),
    ] {
        refused(&run(&directory, args), message);
    }
}

/// A sweep of 3000 rows.
const MANY: [&str; 5] = [
    "--over",
    "load.tight_tension=300 N:9 kN:3000",
    "--chunk",
    "100",
    "--quiet",
];

/// The options of the forms that the program is built with.
fn forms() -> impl Iterator<Item = &'static str> {
    let forms = [
        ("--csv", true),
        ("--parquet", cfg!(feature = "parquet")),
        ("--arrow", cfg!(feature = "arrow")),
    ];
    forms
        .into_iter()
        .filter_map(|(form, is_built)| is_built.then_some(form))
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_device_is_one_error_in_every_form() {
    let directory = directory("full-device", "kim2009-flat");
    for form in forms() {
        let output = run(&directory, &[&MANY[..], &[form, "/dev/full"]].concat());
        refused(&output, "error: cannot write /dev/full: No space left");
        let text = String::from_utf8(output.stderr).unwrap();
        assert_eq!(text.lines().count(), 1, "{text}");
    }
}

#[test]
fn who_closes_the_output_has_read_enough() {
    use std::io::Read;
    use std::process::Stdio;
    let directory = directory("closed", "kim2009-flat");
    for form in forms() {
        let args = [&MANY[..], &[form, "-"]].concat();
        let mut command = super::program::command(&directory, &args);
        let piped = command.stdout(Stdio::piped()).stderr(Stdio::piped());
        let mut child = piped.spawn().unwrap();
        let mut begin = [0; 10];
        child.stdout.take().unwrap().read_exact(&mut begin).unwrap();
        let output = child.wait_with_output().unwrap();
        answered(&output);
        assert!(output.stderr.is_empty(), "{form}");
    }
    // Another output has all rows.
    let file = directory.join("rows.csv");
    let args = [&MANY[..], &["--csv", "rows.csv", "--json", "-"]].concat();
    answered(&run(&directory, &args));
    let rows = fs::read_to_string(&file).unwrap();
    for form in forms().filter(|form| *form != "--csv") {
        fs::remove_file(&file).unwrap();
        let args = [&MANY[..], &["--csv", "rows.csv", form, "-"]].concat();
        let mut command = super::program::command(&directory, &args);
        let piped = command.stdout(Stdio::piped()).stderr(Stdio::piped());
        let mut child = piped.spawn().unwrap();
        drop(child.stdout.take());
        answered(&child.wait_with_output().unwrap());
        assert_eq!(fs::read_to_string(&file).unwrap(), rows, "{form}");
    }
}
