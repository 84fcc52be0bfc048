//! The cost of reference problems, exactly: a change of these numbers is a change of the method.

use crate::end_to_end::{FitzHughNagumo, Mathieu, MinimalTime};
use crate::exact::{Exact, bratu, exponential};
use bvp::{Constant, Control, Equations, Guess, Options, solve};

/// Newton steps, factorisations, meshes, and intervals of the mesh returned.
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
    assert_eq!(from_zero(&bratu(1.5)), [5, 2, 1, 3]);
}

#[test]
fn a_boundary_layer() {
    assert_eq!(from_zero(&exponential(1000.0)), [4, 3, 3, 17]);
}

#[test]
fn a_linear_problem_costs_one_linearisation_a_mesh() {
    let problem = exponential(1.0);
    let guess = Constant {
        states: vec![vec![0.0; 2]],
        parameters: vec![],
    };
    let [thinned, stated] = [Control::Error, Control::Defect].map(|control| {
        let options = Options {
            control,
            ..Options::default()
        };
        *solve(&*problem.equations, &guess, &options)
            .unwrap()
            .stats()
    });
    assert_eq!((stated.meshes, stated.factorisations), (1, 1));
    assert_eq!((thinned.meshes, thinned.factorisations), (1, 1));
    // Besides the stages, 7 an interval, the defect asks for 8 places an interval, the error for none, and
    // acceptance for both ends of every interval and 66 places in all.
    let of_stages = |evaluations: usize, intervals: usize| evaluations - 8 * intervals;
    assert_eq!(stated.jacobian_evaluations, 7 * 10);
    assert_eq!(of_stages(stated.rhs_evaluations, 10), 2 * 7 * 10);
    // That the problem is linear is seen from the Jacobian at one stage of every interval.
    assert_eq!(thinned.jacobian_evaluations, 7 * 3 + 3);
    assert_eq!(
        of_stages(thinned.rhs_evaluations, 3),
        2 * 7 * 3 + 2 * 3 + 66
    );
}

#[test]
fn the_fourth_eigenvalue_of_mathieus_equation() {
    assert_eq!(work(&Mathieu, &Mathieu::guess()), [9, 4, 2, 10]);
}

#[test]
fn the_fitzhugh_nagumo_impulse() {
    assert_eq!(
        work(&FitzHughNagumo, &FitzHughNagumo::guess()),
        [33, 25, 5, 21]
    );
}

#[test]
fn a_solution_from_that_of_a_neighbour_is_not_examined_for_what_is_known_of_that() {
    let near = solve(
        &FitzHughNagumo,
        &FitzHughNagumo::guess(),
        &Options::to(1e-3),
    )
    .unwrap();
    let [own, known] = [false, true].map(|from_neighbour| {
        let options = Options {
            from_neighbour,
            ..Options::default()
        };
        let solution = solve(&FitzHughNagumo, &near, &options).unwrap();
        let stats = solution.stats();
        let work = [stats.newton_steps, stats.factorisations, stats.meshes];
        (solution.parameters()[0], work)
    });
    assert!((own.0 - known.0).abs() < 1e-6, "{own:?} {known:?}");
    assert_eq!((own.1, known.1), ([4, 3, 2], [4, 2, 2]));
}

#[test]
fn the_time_optimal_double_integrator() {
    let guess = Constant {
        states: vec![vec![0.5, 0.5]; 2],
        parameters: vec![0.5, 2.0],
    };
    assert_eq!(work(&MinimalTime, &guess), [2, 2, 1, 6]);
}
