//! Every reference problem from its stated guess: solved, to the tolerance, with an honest estimate.
//!
//! `cargo test -p reference-problems --test reference -- --nocapture` prints the tables.

use bvp::{Options, Scheme, Solution, solve};
use reference_problems::{
    Attempt, FALSE_FROM, Outcome, TOLERANCES, all, max_or_nan, quantile, scaled_error,
};

/// The estimate is at least this share of the true error. Measured: 0.62.
const LEAST: f64 = 0.5;
/// In nine of ten cases it is at most so many times that. Measured: 4.2, and 1.5 in the median; the largest are 11 and 38. On
/// meshes that were graded by whole intervals 3.4 and 1.5, 33, 38 and 41.
const MOST: f64 = 4.5;

/// f has a kink at an unknown place, which may lie between a node and the next place where f is evaluated: no
/// estimate sees it there.
const HIDDEN: [&str; 1] = ["E07a"];
/// Errors below are rounding.
const ROUNDING: f64 = 1e-13;

/// What an attempt is worth: nothing if it is as it should be, else a complaint.
fn complaint(attempt: &Attempt) -> Option<String> {
    let what = match &attempt.outcome {
        Outcome::Failed(error) => error.clone(),
        Outcome::Solved if attempt.is_false_success() => {
            format!("false, true error {:e}", attempt.true_error)
        }
        Outcome::Solved => return None,
    };
    Some(format!(
        "{} at {:e}: {what}",
        attempt.case, attempt.tolerance
    ))
}

#[test]
fn every_case_is_solved_with_an_error_near_the_tolerance() {
    let mut complaints = Vec::new();
    for tolerance in TOLERANCES {
        let options = Options::to(tolerance);
        println!("\ntolerance {tolerance:e}");
        println!("case   intervals  steps     rhs  estimate  true error");
        let mut errors = Vec::new();
        for case in all() {
            let attempt = Attempt::new(&case, &options);
            println!(
                "{:6} {:9} {:6} {:7}  {:8.1e}  {:10.1e}",
                case.id,
                attempt.intervals,
                attempt.newton_steps,
                attempt.rhs_evaluations,
                attempt.estimate.unwrap_or(f64::NAN),
                attempt.true_error,
            );
            errors.push(attempt.true_error / tolerance);
            complaints.extend(complaint(&attempt));
        }
        let most = quantile(&errors, 0.9);
        println!("true error over the tolerance: 90 % below {most:.2e}");
        // Not beyond, and below 1e-3 not wasteful: there a mesh of a few intervals may do far better.
        assert!(most <= 1.0, "{tolerance:e}: {most}");
        assert!(tolerance == 1e-3 || most >= 0.05, "{tolerance:e}: {most}");
    }
    assert!(complaints.is_empty(), "{complaints:#?}");
}

/// The largest difference of two solutions on the mesh of the first, at the nodes and at 10 places
/// of every interval, relative to 1 + |second|; parameters included.
fn difference(solution: &Solution, fine: &Solution) -> f64 {
    let mut largest = scaled_error(solution.parameters(), fine.parameters());
    for (segment, shape) in solution.segments().iter().enumerate() {
        let (mut y, mut exact) = (vec![0.0; shape.states], vec![0.0; shape.states]);
        for pair in solution.mesh(segment).windows(2) {
            for place in 0..=10 {
                let s = pair[0] + (pair[1] - pair[0]) * f64::from(place) / 10.0;
                solution.state(segment, s, &mut y);
                fine.state(segment, s, &mut exact);
                largest = max_or_nan(largest, scaled_error(&y, &exact));
            }
        }
    }
    largest
}

#[test]
fn the_error_estimate_bounds_the_true_error_and_is_mostly_near_it() {
    let (mut complaints, mut shares) = (Vec::new(), Vec::new());
    for tolerance in [1e-3, 1e-6] {
        println!("\ntolerance {tolerance:e}: estimate / true error");
        for case in all() {
            let solution = solve(&*case.equations, &case, &Options::to(tolerance))
                .unwrap_or_else(|error| panic!("{}: {error}", case.id));
            // The solution itself is the guess: no other solution of the problem is found.
            let options = Options {
                tolerance: 1e-3 * tolerance,
                scheme: Some(Scheme::Gauss { stages: 7 }),
                ..Options::default()
            };
            let fine = solve(&*case.equations, &solution, &options)
                .unwrap_or_else(|error| panic!("{}: {error}", case.id));
            let (error, estimate) = (difference(&solution, &fine), solution.error_estimate());
            let unknown = 10.0 * fine.error_estimate().unwrap();
            if error < unknown.max(ROUNDING) {
                println!("{:6} too small to be known", case.id);
                continue;
            }
            let share = estimate.unwrap() / error;
            println!("{:6} {share:.2}", case.id);
            if HIDDEN.contains(&case.id) {
                assert!(error <= FALSE_FROM * tolerance, "{}: {error:e}", case.id);
                continue;
            }
            shares.push(share);
            if share < LEAST {
                complaints.push(format!(
                    "{} at {tolerance:e}: {estimate:?} of {error:e}",
                    case.id
                ));
            }
        }
    }
    assert!(complaints.is_empty(), "{complaints:#?}");
    let most = quantile(&shares, 0.9);
    assert!(most <= MOST, "{most}");
}
