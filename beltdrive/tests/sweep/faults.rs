//! What is written of rows without an answer, and what is refused.

use super::program::{answered, directory, refused, run};

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
