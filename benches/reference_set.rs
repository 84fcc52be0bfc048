//! How long does every reference problem take, and how does that compare with other codes?
//!
//! ```text
//! cargo bench -p benches --bench reference_set                  all, half a minute
//! cargo bench -p benches --bench reference_set -- T01 E31       names that begin so
//! cargo bench -p benches --bench reference_set -- --scipy FILE  beside `SciPy`'s times
//! ```
//!
//! Prints Markdown. Every case is solved from its stated guess on its stated mesh with
//! `Options::to` at three tolerances, until both 5 runs are done and 20 ms have passed. Ratios are those of
//! the fastest run, which other work on the machine disturbs least, to the other code's time. Native
//! codes: `reference_set/native_times.csv`. `SciPy`: FILE as written by `scipy/run.sh`, a path from here
//! or from the root of the workspace.

#[path = "reference_set/table.rs"]
mod table;
#[path = "reference_set/times.rs"]
mod times;

use bvp::{Options, solve};
use reference_problems::{Attempt, Case, TOLERANCES, all};
use std::hint::black_box;
use std::path::Path;
use std::time::{Duration, Instant};
use table::{Row, print_rows, print_summary};
use times::Times;

/// Every case is run at least this often.
const RUNS: usize = 5;
/// Every case is run for at least this long.
const DURATION: Duration = Duration::from_millis(20);
/// The times of the native codes.
const NATIVE: &str = include_str!("reference_set/native_times.csv");

/// What the command line asks for.
#[derive(Default)]
struct Arguments {
    /// The beginnings of the names wanted; none wants all.
    names: Vec<String>,
    /// The times of `SciPy`.
    scipy: Option<Times>,
}

impl Arguments {
    /// Reads the command line.
    fn parse(words: impl Iterator<Item = String>) -> Result<Self, String> {
        let mut arguments = Self::default();
        let mut words = words;
        while let Some(word) = words.next() {
            match word.as_str() {
                // Cargo gives it to every bench.
                "--bench" => {}
                // `record.sh` gives these, meant for criterion, to all benches.
                "--warm-up-time" | "--measurement-time" | "--sample-size" => drop(words.next()),
                "--scipy" => {
                    let file = words.next().ok_or("--scipy needs a file")?;
                    arguments.scipy = Some(Times::read(&found(&file)?)?);
                }
                option if option.starts_with('-') => return Err(format!("no option {option}")),
                _ => arguments.names.push(word),
            }
        }
        Ok(arguments)
    }

    /// Whether the case is wanted.
    fn wants(&self, case: &Case) -> bool {
        let begins = |name: &String| case.id.starts_with(name.as_str());
        self.names.is_empty() || self.names.iter().any(begins)
    }
}

/// The text of a file, whose path is from here or from the root of the workspace.
fn found(file: &str) -> Result<String, String> {
    let places = [
        Path::new(file).to_owned(),
        Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join(file),
    ];
    let text = places.iter().find_map(|p| std::fs::read_to_string(p).ok());
    text.ok_or_else(|| format!("cannot read {file}"))
}

/// Seconds of every run of a case, ascending.
fn seconds(case: &Case, options: &Options) -> Vec<f64> {
    let (start, mut seconds) = (Instant::now(), Vec::new());
    while seconds.len() < RUNS || start.elapsed() < DURATION {
        let run = Instant::now();
        // A failure has a time, too; whether it is one is known from the attempt.
        let _ = black_box(solve(&*case.equations, black_box(case), options));
        seconds.push(run.elapsed().as_secs_f64());
    }
    seconds.sort_by(f64::total_cmp);
    seconds
}

/// One case at one tolerance.
fn row(case: &Case, tolerance: f64, native: &Times, scipy: Option<&Times>) -> Row {
    let options = Options::to(tolerance);
    // The first run warms the caches.
    let attempt = Attempt::new(case, &options);
    let seconds = seconds(case, &options);
    Row {
        case: case.id,
        right: attempt.is_solved() && !attempt.is_false_success(),
        least: 1e6 * seconds[0],
        median: 1e6 * seconds[seconds.len() / 2],
        native: native.of(case.id, tolerance),
        scipy: scipy.and_then(|times| times.of(case.id, tolerance)),
    }
}

fn main() {
    let arguments = match Arguments::parse(std::env::args().skip(1)) {
        Ok(arguments) => arguments,
        Err(message) => {
            eprintln!("reference_set: {message}");
            std::process::exit(2);
        }
    };
    let native = Times::read(NATIVE).expect("the committed times are readable");
    let scipy = arguments.scipy.as_ref();
    let cases: Vec<Case> = all().into_iter().filter(|c| arguments.wants(c)).collect();
    let mut tables = Vec::new();
    for tolerance in TOLERANCES {
        let of_case = |case| row(case, tolerance, &native, scipy);
        let rows: Vec<Row> = cases.iter().map(of_case).collect();
        print_rows(tolerance, &rows, scipy.is_some());
        tables.push((tolerance, rows));
    }
    print_summary(&tables, scipy.is_some());
}
