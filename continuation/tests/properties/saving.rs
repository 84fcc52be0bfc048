//! Points and options are data.

use crate::systems::{isola, on_isola, pitchfork};
use crate::{assert_close, finish, of, trace};
use bvp::{Constant, Ends, Family, Problem, Real, Segment};
use continuation::Direction::Increasing;
use continuation::{Branch, Error, Kind, Options, Point};

#[test]
fn a_branch_resumed_from_a_saved_point_goes_the_rest_of_the_way() {
    let kappa = 0.05;
    let options = Options {
        targets: vec![12.0],
        ..Options::within(1.0, 100.0)
    };
    let (whole, _) = trace(&mut isola(kappa), &on_isola(kappa), Increasing, &options);
    let saved = whole
        .iter()
        .filter(|p| p.kind == Kind::Regular)
        .nth(4)
        .unwrap();
    let saved = serde_json::to_string(saved).unwrap();
    let point: Point = serde_json::from_str(&saved).unwrap();
    let mut system = isola(kappa);
    let (rest, _) = finish(Branch::resume(&mut system, &point, &options).unwrap());
    let labelled = |points: &[Point]| -> Vec<(Kind, Vec<f64>)> {
        let labelled = points
            .iter()
            .filter(|p| matches!(p.kind, Kind::LimitPoint | Kind::Target));
        labelled
            .map(|point| (point.kind, point.z.clone()))
            .collect()
    };
    let (expected, found) = (labelled(&whole), labelled(&rest));
    assert_eq!(expected.len(), 4);
    assert_eq!(found.len(), expected.len());
    for (found, expected) in found.iter().zip(&expected) {
        assert_eq!(found.0, expected.0);
        assert_close(&found.1, &expected.1, 1e-12);
    }
}

#[test]
fn a_resumed_branch_goes_against_the_tangent_when_that_is_turned() {
    let options = Options::within(1.0, 100.0);
    let (whole, _) = trace(&mut isola(0.05), &on_isola(0.05), Increasing, &options);
    let mut point = whole[3].clone();
    point.tangent.iter_mut().for_each(|t| *t = -*t);
    let mut system = isola(0.05);
    let mut branch = Branch::resume(&mut system, &point, &options).unwrap();
    let next = branch.nth(1).unwrap();
    assert!(next.lambda() < point.lambda());
}

/// u'' + λ eᵘ = 0, u(0) = u(1) = 0.
struct Bratu;

impl Problem for Bratu {
    fn segments(&self) -> Vec<Segment> {
        vec![Segment::on(2, 0.0, 1.0)]
    }
    fn parameters(&self) -> usize {
        1
    }
    fn condition_count(&self) -> usize {
        2
    }
    fn rhs<T: Real>(&self, _: usize, _: T, y: &[T], p: &[T], dy: &mut [T]) {
        dy[0] = y[1];
        dy[1] = -p[0] * y[0].exp();
    }
    fn conditions<T: Real>(&self, at: Ends<'_, T>, _: &[T], r: &mut [T]) {
        r[0] = at.start(0)[0];
        r[1] = at.end(0)[0];
    }
}

/// Follows the branch of Bratu's problem for some steps and saves where it is: the mesh and the point.
fn half_of_a_branch(steps: usize, tolerance: f64) -> String {
    let guess = Constant {
        states: vec![vec![0.0; 2]],
        parameters: vec![0.0],
    };
    let settings = bvp::Options::to(tolerance);
    let (mut family, z) = Family::new(&Bratu, 0, &[], &guess, &settings).unwrap();
    let options = Options::within(0.0, 4.0);
    let mut branch = Branch::new(&mut family, &z, Increasing, &options).unwrap();
    let point = branch.nth(steps).unwrap();
    assert_eq!(point.kind, Kind::Regular);
    serde_json::to_string(&(branch.system().mesh(), point, options)).unwrap()
}

#[test]
fn a_branch_of_a_boundary_value_problem_is_saved_and_resumed_to_the_same_limit_point() {
    for (steps, tolerance) in [(2, 1e-6), (5, 1e-6), (5, 1e-9)] {
        let saved = half_of_a_branch(steps, tolerance);
        let (mesh, point, options): (Vec<Vec<f64>>, Point, Options) =
            serde_json::from_str(&saved).unwrap();
        let settings = bvp::Options::to(tolerance);
        let mut family = Family::on_mesh(&Bratu, 0, &[], mesh, &settings).unwrap();
        let branch = Branch::resume(&mut family, &point, &options).unwrap();
        let (points, _) = finish(branch);
        // Resumed where it was left, but corrected down to rounding.
        assert_close(&points[0].z, &point.z, 1e-7);
        let [limit] = of(&points, Kind::LimitPoint)[..] else {
            panic!("one limit point");
        };
        assert_close(&[limit.lambda()], &[3.513_830_719_125], tolerance);
    }
}

#[test]
fn a_mesh_that_does_not_fit_is_refused() {
    let settings = bvp::Options::to(1e-6);
    for mesh in [vec![], vec![vec![0.0, 0.9]], vec![vec![0.0, 0.5, 0.5, 1.0]]] {
        let refused = Family::on_mesh(&Bratu, 0, &[], mesh, &settings);
        assert!(matches!(refused, Err(bvp::Error::GuessMesh { .. })));
    }
    let mesh = vec![vec![0.0, 1.0]];
    let refused = Family::on_mesh(&Bratu, 1, &[], mesh.clone(), &settings);
    assert!(matches!(refused, Err(bvp::Error::FamilyParameter { .. })));
    // A point of another mesh.
    let (_, point, options): (Vec<Vec<f64>>, Point, Options) =
        serde_json::from_str(&half_of_a_branch(2, 1e-6)).unwrap();
    let mut family = Family::on_mesh(&Bratu, 0, &[], mesh, &settings).unwrap();
    let refused = Branch::resume(&mut family, &point, &options);
    assert!(matches!(refused, Err(Error::StartCount { .. })));
}

#[test]
fn points_and_options_survive_being_saved() {
    let options = Options {
        weights: Some(vec![1.0, 2.0]),
        ..Options::within(-1.0, 2.0)
    };
    let text = serde_json::to_string(&options).unwrap();
    assert_eq!(serde_json::from_str::<Options>(&text).unwrap(), options);
    let (points, _) = trace(&mut pitchfork(0.0), &[0.0, -1.0], Increasing, &options);
    assert_eq!(of(&points, Kind::BranchPoint).len(), 1);
    for point in points {
        let text = serde_json::to_string(&point).unwrap();
        assert_eq!(serde_json::from_str::<Point>(&text).unwrap(), point);
    }
}
