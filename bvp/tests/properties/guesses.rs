//! Every kind of guess, and restarts.

use crate::end_to_end::Mathieu;
use crate::exact::{bratu, exponential};
use bvp::{
    Constant, Control, Ends, Error, Function, Guess, Options, Problem, Real, Scheme, Segment,
    Solution, Table, solve,
};

fn options() -> Options {
    Options {
        tolerance: 1e-8,
        ..Options::default()
    }
}

/// The states at many places are those at each of them, in any order.
#[test]
fn states_at_many_places_are_those_at_each() {
    let problem = Growing;
    let guess = Function {
        state: |segment: usize, s: f64| vec![s; segment + 1],
        parameters: vec![],
    };
    let solution = solve(&problem, &guess, &Options::to(1e-9)).unwrap();
    let places = [0.7, 0.0, 0.31, 1.0, 0.31, 0.699];
    for segment in 0..2 {
        let n = segment + 1;
        let mut states = vec![f64::NAN; n * places.len()];
        solution.states(segment, &places, &mut states);
        let mut y = vec![f64::NAN; n];
        for (s, found) in places.iter().zip(states.chunks(n)) {
            solution.state(segment, *s, &mut y);
            assert_eq!(found, y);
            assert!((y[n - 1] - s.exp()).abs() < 1e-8);
        }
    }
    solution.states(0, &[], &mut []);
}

/// eˢ on a segment with one state, and on one with two.
struct Growing;

impl Problem for Growing {
    fn segments(&self) -> Vec<Segment> {
        vec![Segment::new(1), Segment::new(2)]
    }

    fn rhs<T: Real>(&self, _segment: usize, _s: T, y: &[T], _p: &[T], dy: &mut [T]) {
        dy.copy_from_slice(y);
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, _p: &[T], r: &mut [T]) {
        r[0] = at.start(0)[0] - 1.0;
        r[1] = at.start(1)[0] - 1.0;
        r[2] = at.start(1)[1] - 1.0;
    }
}

/// A function that returns too few or too many states is refused before anything is evaluated, and one
/// that does so at some places only where it is found to.
#[test]
fn functions_with_a_wrong_number_of_states_are_refused() {
    for wrong in 0..2usize {
        for found in (0..5).filter(|found| *found != wrong + 1) {
            let guess = Function {
                state: |segment: usize, _: f64| {
                    vec![1.0; if segment == wrong { found } else { segment + 1 }]
                },
                parameters: vec![],
            };
            let error = solve(&Growing, &guess, &Options::default()).unwrap_err();
            let Error::GuessStates {
                segment,
                found: stated,
                needed,
            } = error
            else {
                panic!("{error}");
            };
            assert_eq!((segment, stated, needed), (wrong, found, wrong + 1));
        }
    }
    let changing = Function {
        state: |segment: usize, s: f64| vec![1.0; if s > 0.5 { 7 } else { segment + 1 }],
        parameters: vec![],
    };
    let error = solve(&Growing, &changing, &Options::default()).unwrap_err();
    assert!(
        matches!(error, Error::Guess { segment: 0, s } if s > 0.2),
        "{error}"
    );
}

#[test]
fn constant_function_and_table_reach_the_same_solution() {
    let problem = bratu(1.5);
    let constant = Constant {
        states: vec![vec![0.1, 0.0]],
        parameters: vec![],
    };
    let function = Function {
        state: |_: usize, s: f64| [s * (1.0 - s), 1.0 - 2.0 * s],
        parameters: vec![],
    };
    let table = Table {
        nodes: vec![vec![0.0, 0.3, 0.7, 1.0]],
        states: vec![vec![0.0, 1.0, 0.2, 0.0, 0.2, 0.0, 0.0, -1.0]],
        parameters: vec![],
    };
    let guesses: [&dyn Guess; 3] = [&constant, &function, &table];
    for guess in guesses {
        let solution = solve(&*problem.equations, guess, &options()).unwrap();
        // λ = 1, lower branch: y(½) = 0.140539214400...
        let mut y = [0.0; 2];
        solution.state(0, 0.5, &mut y);
        let mut exact = [0.0; 2];
        problem.state(0, 0.5, &mut exact);
        assert!((y[0] - exact[0]).abs() < 1e-8);
        assert!((exact[0] - 0.140_539_214_4).abs() < 1e-9);
    }
}

#[test]
fn a_table_brings_its_mesh() {
    let problem = exponential(1.0);
    let nodes = vec![0.0, 0.1, 0.4, 1.0];
    let table = Table {
        nodes: vec![nodes.clone()],
        states: vec![vec![0.0; 8]],
        parameters: vec![],
    };
    let loose = Options {
        tolerance: 1e-4,
        ..options()
    };
    let as_stated = Options {
        control: Control::Defect,
        ..loose.clone()
    };
    let solution = solve(&*problem.equations, &table, &as_stated).unwrap();
    assert_eq!(solution.mesh(0), nodes);
    assert_eq!(solution.stats().meshes, 1);
    // Intervals that differ are those of somebody who knows.
    let solution = solve(&*problem.equations, &table, &loose).unwrap();
    assert_eq!(solution.mesh(0), nodes);
    assert_eq!(solution.stats().meshes, 1);
}

fn mathieu() -> Solution {
    let guess = Mathieu::guess();
    solve(&Mathieu, &guess, &options()).unwrap()
}

/// With the mesh chosen for the defect.
fn by_defect() -> Options {
    Options {
        control: Control::Defect,
        ..options()
    }
}

#[test]
fn a_restart_on_the_same_mesh_costs_a_linearisation_and_one_at_the_result() {
    // Without an estimate of the error on the same mesh.
    let first = solve(&Mathieu, &Mathieu::guess(), &by_defect()).unwrap();
    let again = solve(&Mathieu, &first, &by_defect()).unwrap();
    assert_eq!(again.mesh(0), first.mesh(0));
    let stats = again.stats();
    assert_eq!(
        (stats.meshes, stats.newton_steps, stats.factorisations),
        (1, 1, 1)
    );
    assert_eq!(again.error_estimate(), None);
    assert_eq!(again.state_errors(0), None);
    assert_eq!(again.parameter_errors(), None);
    // With one the same.
    let first = mathieu();
    let again = solve(&Mathieu, &first, &options()).unwrap();
    assert_eq!(again.mesh(0), first.mesh(0));
    let stats = again.stats();
    assert_eq!(
        (stats.meshes, stats.newton_steps, stats.factorisations),
        (1, 1, 2)
    );
    assert!(again.error_estimate().unwrap() <= 1e-6);
}

#[test]
fn a_solution_of_another_scheme_is_a_guess() {
    let first = mathieu();
    let scheme = Scheme::LobattoIIIA { stages: 4 };
    let lobatto = Options {
        scheme: Some(scheme),
        ..options()
    };
    let other = solve(&Mathieu, &first, &lobatto).unwrap();
    assert_eq!(other.scheme(), scheme);
    assert!((other.parameters()[0] - first.parameters()[0]).abs() < 1e-7);
}

#[test]
fn a_solution_can_be_asked_for_everything() {
    let solution = mathieu();
    assert_eq!(
        solution.segments(),
        [Segment::on(2, 0.0, std::f64::consts::PI)]
    );
    assert_eq!(solution.scheme(), Scheme::for_tolerance(1e-6));
    let nodes = solution.mesh(0);
    assert_eq!(solution.defects(0).len(), nodes.len() - 1);
    let largest = solution.defects(0).iter().copied().fold(0.0, f64::max);
    assert_eq!(solution.defect(), largest);
    assert!(solution.condition_residual() <= options().tolerance);
    let errors = solution.state_errors(0).unwrap();
    let parameter = solution.parameter_errors().unwrap();
    let largest = errors.iter().chain(parameter).copied().fold(0.0, f64::max);
    assert_eq!(solution.error_estimate(), Some(largest));
    assert!(largest <= options().tolerance);

    // The continuous solution passes through its nodes and, where the mesh is chosen for the defect,
    // satisfies the equation.
    let solution = solve(&Mathieu, &solution, &by_defect()).unwrap();
    assert!(solution.defect() <= options().tolerance);
    let nodes = solution.mesh(0);
    let (mut y, mut slope) = ([0.0; 2], [0.0; 2]);
    for (i, &s) in nodes.iter().enumerate() {
        solution.state(0, s, &mut y);
        let node = solution.node(0, i);
        assert!((y[0] - node[0]).abs() < 1e-12 && (y[1] - node[1]).abs() < 1e-12);
        solution.derivative(0, s, &mut slope);
        assert!((slope[0] - y[1]).abs() < 1e-5);
    }
    assert_eq!(solution.start(0), solution.node(0, 0));
    assert_eq!(solution.end(0), solution.node(0, nodes.len() - 1));
}
