//! The cost of reference problems, exactly: a change of these numbers is a change of the method.

use crate::end_to_end::{FitzHughNagumo, Mathieu, MinimalTime};
use crate::exact::{Exact, bratu, exponential};
use bvp::{Constant, Equations, Guess, Options, solve};

/// Newton steps, factorisations, meshes and intervals of the last mesh.
type Work = [usize; 4];

fn work(equations: &dyn Equations, guess: &dyn Guess) -> Work {
    let solution = solve(equations, guess, &Options::default()).unwrap();
    let stats = solution.stats();
    let segments = 0..solution.segments().len();
    let intervals = segments
        .map(|segment| solution.mesh(segment).len() - 1)
        .sum();
    [
        stats.newton_steps,
        stats.factorisations,
        stats.meshes,
        intervals,
    ]
}

fn from_zero(problem: &Exact) -> Work {
    let guess = Constant {
        states: vec![vec![0.0; 2]],
        parameters: vec![],
    };
    work(&*problem.equations, &guess)
}

#[test]
fn bratu_on_its_lower_branch() {
    assert_eq!(from_zero(&bratu(1.5)), [5, 2, 1, 10]);
}

#[test]
fn a_boundary_layer() {
    assert_eq!(from_zero(&exponential(1000.0)), [8, 5, 4, 207]);
}

#[test]
fn the_fourth_eigenvalue_of_mathieus_equation() {
    assert_eq!(work(&Mathieu, &Mathieu::guess()), [10, 5, 3, 84]);
}

#[test]
fn the_fitzhugh_nagumo_impulse() {
    assert_eq!(
        work(&FitzHughNagumo, &FitzHughNagumo::guess()),
        [26, 16, 4, 138]
    );
}

#[test]
fn the_time_optimal_double_integrator() {
    let guess = Constant {
        states: vec![vec![0.5, 0.5]; 2],
        parameters: vec![0.5, 2.0],
    };
    assert_eq!(work(&MinimalTime, &guess), [3, 2, 1, 20]);
}
