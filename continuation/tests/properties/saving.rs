//! Points and options are data.

use crate::systems::{isola, on_isola, pitchfork};
use crate::{assert_close, finish, of, trace};
use continuation::Direction::Increasing;
use continuation::{Branch, Kind, Options, Point};

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
