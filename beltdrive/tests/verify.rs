//! The published results recomputed, as the user of the program sees them.

use serde_json::Value;
use std::collections::BTreeMap;
use std::process::{Command, Output};
use std::{fs, path::PathBuf};

fn verify(arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_beltdrive"));
    command.arg("verify").args(arguments).output().unwrap()
}

#[test]
fn every_published_number_agrees_or_differs_for_a_known_reason() {
    let directory = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("verify");
    fs::create_dir_all(&directory).unwrap();
    let path = |name: &str| directory.join(name).to_str().unwrap().to_owned();
    let beside = path("a.csv.origin.json");
    let (json, csv, markdown) = (path("a.json"), path("a.csv"), path("a.md"));
    let output = verify(&["--json", &json, "--csv", &csv, "--markdown", &markdown]);
    let table = String::from_utf8(output.stdout).unwrap();
    let notes = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(0), "{table}{notes}");
    assert!(notes.contains(&format!("wrote {markdown}")), "{notes}");

    let report: Value = serde_json::from_str(&fs::read_to_string(json).unwrap()).unwrap();
    let origin = &report["origin"];
    assert_eq!(origin["version"], env!("CARGO_PKG_VERSION"));
    assert_eq!(origin["command_line"][1], "verify");
    let beside: Value = serde_json::from_str(&fs::read_to_string(beside).unwrap()).unwrap();
    assert_eq!(&beside, origin);
    let counts = ["agree", "within_band", "known", "unexplained"];
    let counts = counts.map(|count| report[count].as_u64().unwrap());
    assert_eq!(counts, COUNTS);
    let sources = report["sources"].as_array().unwrap();
    let rows_of = |source: &Value| -> Vec<Value> {
        let sections = source["sections"].as_array().unwrap().iter();
        let rows = sections.map(|section| section["comparisons"].as_array().unwrap().clone());
        rows.flatten().collect()
    };
    let by_source: Vec<_> = sources.iter().map(|source| rows_of(source).len()).collect();
    assert_eq!(by_source, [34, 21, 36, 11]);
    let rows: Vec<_> = sources.iter().flat_map(rows_of).collect();
    every_row_is_consistent(&rows);

    for line in table.lines() {
        assert!(
            line.chars().count() <= 100 && !line.ends_with('…'),
            "{line}"
        );
    }
    let summary = table.lines().last().unwrap();
    assert!(summary.ends_with(", 0 unexplained"), "{summary}");
    let csv = fs::read_to_string(csv).unwrap();
    assert_eq!(csv.lines().count(), 1 + rows.len());
    page_has_every_row_and_footnote(&fs::read_to_string(markdown).unwrap(), &rows);
}

/// Numbers that agree to the digits, lie within a band, differ for a known reason, differ.
const COUNTS: [u64; 4] = [48, 8, 46, 0];

fn every_row_is_consistent(rows: &[Value]) {
    let mut criteria = BTreeMap::new();
    for row in rows {
        let number = |key: &str| row[key].as_f64().unwrap();
        let deviation = number("computed") - number("published_value");
        assert!((deviation - number("deviation")).abs() < 1e-9);
        let agrees = deviation.abs() <= number("half_unit") * (1.0 + 1e-9);
        let criterion = row["criterion"].as_str().unwrap();
        *criteria.entry(criterion).or_insert(0) += 1;
        // What agrees to the digits needs no reason.
        assert_eq!(
            agrees && criterion != "band",
            criterion == "digits",
            "{row}"
        );
        if criterion == "known difference" {
            assert!(row["note"].as_str().unwrap().len() > 20, "{row}");
            // No reason covers a number that agrees.
            let explained = (number("expected") - number("published_value")).abs();
            let least = number("half_unit") + number("expected_tolerance");
            assert!(explained > least, "{row}");
        }
    }
    assert_eq!(Vec::from_iter(criteria.into_values()), [8, 48, 46]);
}

fn page_has_every_row_and_footnote(page: &str, rows: &[Value]) {
    assert!(page.starts_with("# Published results, recomputed\n"));
    let tabled = page
        .lines()
        .filter(|line| line.ends_with(" |") || line.contains("[^"));
    let of_rows = tabled.filter(|line| line.matches(" | ").count() == 6);
    let headings = page.matches("| quantity |").count();
    let rules = page.matches("| ---: | ---: | ---: | ---: |").count();
    assert_eq!(of_rows.count(), rows.len() + headings + rules);
    for footnote in page.lines().filter_map(|line| line.strip_prefix("[^")) {
        let (number, text) = footnote.split_once("]: ").unwrap();
        assert!(page.contains(&format!("[^{number}] |")), "{number}");
        assert!(text.ends_with('.'), "{text}");
    }
}

#[test]
fn one_result_goes_to_standard_output() {
    let output = verify(&["--json", "-", "--markdown", "-"]);
    assert_eq!(output.status.code(), Some(2));
    let message = String::from_utf8(output.stderr).unwrap();
    assert!(
        message.contains("only one of --json and --markdown can go"),
        "{message}"
    );
}
