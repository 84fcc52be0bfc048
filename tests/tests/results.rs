//! Writes the table of results, RESULTS.md.
//!
//! `cargo test -p reference-problems --release --test results -- --ignored write_table`

use bvp::Options;
use reference_problems::{Attempt, FALSE_FROM, Outcome, TOLERANCES, all, quantile};
use std::fmt::Write;
use std::fs;

/// What stands above the tables.
const HEAD: &str = "\
# Results of the reference problems

Every case from its stated guess on its stated mesh with `Options::to(tolerance)`. Written by

    cargo test -p reference-problems --release --test results -- --ignored write_table

The true error is max |y − yref| / (1 + |yref|) over the points of the reference table and the
parameters, the estimate that of the solver; both are divided by the tolerance. \"N\" is the number of
intervals of the mesh returned, \"steps\" and \"LU\" are the Newton steps and the factorisations of the
Newton matrix over all meshes.
";

/// All cases at all tolerances, one row per tolerance.
fn attempts() -> Vec<Vec<Attempt>> {
    let at = |tolerance| {
        let options = Options::to(tolerance);
        let of_case = |case| Attempt::new(&case, &options);
        all().into_iter().map(of_case).collect()
    };
    TOLERANCES.map(at).into()
}

/// The cells of one case at one tolerance.
fn cells(attempt: &Attempt) -> String {
    if !attempt.is_solved() {
        return "failed | | | | ".to_owned();
    }
    let of_tolerance = |error: f64| format!("{:.1e}", error / attempt.tolerance);
    format!(
        "{} | {} | {} | {} | {}",
        of_tolerance(attempt.true_error),
        attempt.estimate.map_or_else(String::new, of_tolerance),
        attempt.intervals,
        attempt.newton_steps,
        attempt.factorisations,
    )
}

/// The lines on all cases: one per tolerance.
fn summary(rows: &[Vec<Attempt>]) -> String {
    let mut text = format!(
        "\n## All cases\n\nSolved: a solution with a true error of at most {FALSE_FROM} tolerances; false: one \
         with a larger\nerror. The other columns are the true error over the tolerance and medians over \
         all solutions.\n\n\
         | tolerance | solved | false | failed | median | 90 % | largest | N, median | LU, median |\n\
         | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |\n"
    );
    for attempts in rows {
        let returned: Vec<_> = attempts.iter().filter(|a| a.is_solved()).collect();
        let of = |value: fn(&Attempt) -> f64| -> Vec<f64> {
            returned.iter().map(|attempt| value(attempt)).collect()
        };
        let errors = of(|a| a.true_error / a.tolerance);
        let wrong = returned.iter().filter(|a| a.is_false_success()).count();
        let _ = writeln!(
            text,
            "| {:e} | {} | {wrong} | {} | {:.2e} | {:.2e} | {:.2e} | {} | {} |",
            attempts[0].tolerance,
            returned.len() - wrong,
            attempts.len() - returned.len(),
            quantile(&errors, 0.5),
            quantile(&errors, 0.9),
            quantile(&errors, 1.0),
            quantile(&of(|a| a.intervals as f64), 0.5),
            quantile(&of(|a| a.factorisations as f64), 0.5),
        );
    }
    text
}

/// The failures and the false successes, one line each.
fn remarks(rows: &[Vec<Attempt>]) -> String {
    let mut text = String::from("\n## Failures\n\n");
    for attempt in rows.iter().flatten() {
        let what = match &attempt.outcome {
            Outcome::Failed(error) => error.clone(),
            Outcome::Solved if attempt.is_false_success() => {
                format!("false success, true error {:.1e}", attempt.true_error)
            }
            Outcome::Solved => continue,
        };
        let _ = writeln!(
            text,
            "- {} at {:e}: {what}",
            attempt.case, attempt.tolerance
        );
    }
    if text.ends_with("\n\n") {
        text.push_str("None.\n");
    }
    text
}

/// One row per case.
fn table(rows: &[Vec<Attempt>]) -> String {
    let mut text = String::from("\n## Every case\n\n| case |");
    let mut rule = String::from("| --- |");
    for attempts in rows {
        let tolerance = attempts[0].tolerance;
        let _ = write!(text, " {tolerance:e}: error | estimate | N | steps | LU |");
        rule.push_str(" ---: | ---: | ---: | ---: | ---: |");
    }
    let _ = writeln!(text, "\n{rule}");
    for (index, case) in all().iter().enumerate() {
        let of_rows: Vec<_> = rows.iter().map(|row| cells(&row[index])).collect();
        let _ = writeln!(text, "| {} | {} |", case.id, of_rows.join(" | "));
    }
    text
}

#[test]
#[ignore = "writes RESULTS.md; run it in release"]
fn write_table() {
    let rows = attempts();
    let text = [
        HEAD.to_owned(),
        summary(&rows),
        remarks(&rows),
        table(&rows),
    ]
    .concat();
    println!("{text}");
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/RESULTS.md");
    // The sections on random problems are written by the tests in families.
    let before = fs::read_to_string(path).unwrap_or_default();
    let others = before
        .find("\n## Random problems")
        .map_or("", |place| &before[place..]);
    let text = text + others;
    fs::write(path, text).expect("RESULTS.md is writable");
}
