//! Writes the sections of RESULTS.md on random problems.
//!
//! `cargo test -p reference-problems --release --test families -- --ignored many_random_problems`
//! `cargo test -p reference-problems --release --test families -- --ignored beside_scipy`
//!
//! The variables `FAMILY`, the beginning of a name, `COUNT`, problems of every family, and `SEEDS`, a number
//! added to the seeds of all families, choose another survey, which is printed only: `SEEDS=100 COUNT=1112`
//! draws a fresh sample.

use crate::FAMILIES;
use crate::beside_scipy::SciPy;
use crate::survey::{OTHER_SEEDS, Survey, line};
use crate::trial::Verdict;
use reference_problems::{FALSE_FROM, TOLERANCES};
use std::env::var;
use std::fmt::Write;
use std::fs;
use std::process::Command;
use std::thread::available_parallelism;

/// Problems of every family: 100 000 in all.
const MANY: u32 = 10_002;
/// The same for the comparison with `SciPy`: 2000 in all.
const SAMPLE: u32 = 201;

const HEAD_OF_MANY: &str = "
Families of random problems with known solutions, or with none; what each holds is said in its file of
tests/families. Written by

    cargo test -p reference-problems --release --test families -- --ignored many_random_problems
";
const HEAD_BESIDE_SCIPY: &str = "
The first problems of every family, those of one segment, solved by `bvp::solve` and by `solve_bvp`, with
the same right-hand sides, exact Jacobians, guesses and tolerances, the limits of the mesh those that each
has by default, and judged alike. After `sh benches/scipy/run.sh E01`, which makes the environment, written by

    cargo test -p reference-problems --release --test families -- --ignored beside_scipy
";

/// The state of the code and the machine.
fn state() -> String {
    let commit = Command::new("git")
        .args(["log", "-1", "--format=commit %h of %cs"])
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .output();
    let commit = commit.map_or_else(
        |_| "commit unknown".to_owned(),
        |output| String::from_utf8_lossy(&output.stdout).trim().to_owned(),
    );
    let cores = available_parallelism().map_or(1, usize::from);
    format!("\nMeasured at {commit}, on {cores} cores.\n")
}

/// How many problems of every family, and the families whose name begins so; whether all are asked for.
fn wanted(count: u32) -> (u32, String, bool) {
    let (family, own) = (var("FAMILY").ok(), var("COUNT").ok());
    let own_count = own
        .as_ref()
        .map(|own| own.parse().expect("COUNT is a number"));
    let all = family.is_none() && own.is_none() && *OTHER_SEEDS == 0;
    (own_count.unwrap_or(count), family.unwrap_or_default(), all)
}

/// Prints a section, and replaces it in RESULTS.md if that is wanted.
fn publish(title: &str, body: &str, write: bool) {
    println!("{body}");
    if !write {
        return;
    }
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/RESULTS.md");
    let text = fs::read_to_string(path).expect("RESULTS.md is there");
    let heading = format!("\n## {title}\n");
    let (before, after) = match text.split_once(&heading) {
        None => (text.as_str(), ""),
        Some((before, rest)) => {
            let end = rest.find("\n## ").unwrap_or(rest.len());
            (before, &rest[end..])
        }
    };
    let text = [before, &heading, body, after].concat();
    fs::write(path, text).expect("RESULTS.md is writable");
}

#[test]
#[ignore = "takes an hour; run it in release"]
fn many_random_problems() {
    let (count, only, all) = wanted(MANY);
    let mut text = HEAD_OF_MANY.to_owned() + &state();
    let _ = write!(
        text,
        "\nFalse: a success with a true error of more than {FALSE_FROM} tolerances, or where no solution is \
         isolated; other: another\nsolution than the known one, confirmed at a smaller tolerance.\n\n\
         | family | tolerance | solved | other | refused | false | panics | seconds | refused as |\n\
         | --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | --- |\n"
    );
    let (mut wrong, mut details) = (vec![], String::new());
    for family in FAMILIES
        .iter()
        .filter(|family| family.name.starts_with(&only))
    {
        let survey = Survey::of(family, count);
        for tolerance in 0..TOLERANCES.len() {
            text.push_str(&line(
                family.name,
                tolerance,
                &survey.total(Some(tolerance)),
            ));
        }
        details.push_str(&survey.lines(family.name));
        wrong.extend(survey.wrong);
    }
    let _ = writeln!(text, "\nEvery false success:\n");
    for line in &wrong {
        let _ = writeln!(text, "- {line}");
    }
    if wrong.is_empty() {
        text.push_str("None.\n");
    }
    println!("{details}");
    publish("Random problems", &text, all);
}

#[test]
#[ignore = "needs SciPy, takes an hour"]
fn beside_scipy() {
    let (count, only, all) = wanted(SAMPLE);
    let mut text = HEAD_BESIDE_SCIPY.to_owned() + &state();
    text.push_str(
        "\n| family | problems | bvp: solved | refused | false | SciPy: solved | refused | false |\n\
         | --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: |\n",
    );
    for family in FAMILIES
        .iter()
        .filter(|family| family.name.starts_with(&only))
    {
        let skipped = || Verdict::Refused("Segments".to_owned());
        let own = Survey::by(family, count, || {
            move |trial, tolerance| match trial.segments() {
                1 => trial.attempt(tolerance),
                _ => skipped(),
            }
        });
        let other = Survey::by(family, count, || {
            let mut scipy = SciPy::start().expect("Python with SciPy");
            move |trial, tolerance| match trial.segments() {
                1 => match scipy.solve(trial, tolerance).expect("an answer of SciPy") {
                    Some(found) => trial.judge(&found, tolerance),
                    None => Verdict::Refused("SciPy".to_owned()),
                },
                _ => skipped(),
            }
        });
        let (own, other) = (own.total(None), other.total(None));
        let left_out = own.refused.get("Segments").copied().unwrap_or(0);
        let _ = write!(text, "| {} | {} |", family.name, count as usize - left_out);
        for tally in [own, other] {
            let (solved, refused) = (tally.solved + tally.another, tally.refusals() - left_out);
            let _ = write!(
                text,
                " {solved} | {refused} | {} |",
                tally.wrong + tally.panics
            );
        }
        text.push('\n');
        println!("{}", text.lines().last().unwrap_or_default());
    }
    publish("Random problems beside SciPy", &text, all);
}
