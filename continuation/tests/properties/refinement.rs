//! Labelled points are compared with those of a refined system.

use crate::{of, trace};
use continuation::Direction::Increasing;
use continuation::{Branch, Cause, Kind, Options, Point, Stop, System};
use std::cell::Cell;
use std::rc::Rc;

/// λ = 1 − x² + offset(level), finer and finer.
#[derive(Clone)]
struct Refining {
    level: i32,
    offset: fn(i32) -> f64,
    tolerance: f64,
    slope: f64,
    /// How often refined systems were linearised.
    linearisations: Rc<Cell<usize>>,
}

impl Refining {
    fn new(offset: fn(i32) -> f64, tolerance: f64) -> Self {
        let (level, slope) = (0, 0.0);
        Self {
            level,
            offset,
            tolerance,
            slope,
            linearisations: Rc::default(),
        }
    }
}

impl System for Refining {
    fn unknowns(&self) -> usize {
        2
    }

    fn residual(&mut self, z: &[f64], g: &mut [f64]) {
        g[0] = z[1] - 1.0 - (self.offset)(self.level) + z[0] * z[0];
    }

    fn linearise(&mut self, z: &[f64]) -> Result<(), Cause> {
        self.slope = 2.0 * z[0];
        let is_refined = usize::from(self.level > 0);
        self.linearisations
            .set(self.linearisations.get() + is_refined);
        Ok(())
    }

    fn particular(&mut self, r: &[f64], v: &mut [f64]) {
        v.copy_from_slice(&[0.0, r[0]]);
    }

    fn null_vector(&mut self, t: &mut [f64]) {
        t.copy_from_slice(&[1.0, -self.slope]);
    }

    fn refined(&self, _: &mut [Vec<f64>]) -> Option<Self> {
        Some(Self {
            level: self.level + 1,
            ..self.clone()
        })
    }

    fn tolerance(&self) -> f64 {
        self.tolerance
    }
}

fn options() -> Options {
    Options {
        targets: vec![0.5],
        ..Options::within(-1.0, 2.0)
    }
}

#[test]
fn a_system_is_refined_until_the_error_is_below_the_tolerance() {
    let mut system = Refining::new(|level| 0.1 * 0.25f64.powi(level), 2e-3);
    let (points, stop) = trace(&mut system, &[-1.0, 0.0], Increasing, &options());
    assert!(matches!(stop, Stop::Bound { lambda: -1.0 }));
    // Halfway to the next level it is 0.075 / 4^level: 1.2e-3 on the third.
    assert_eq!(system.level, 3);
    let limit = of(&points, Kind::LimitPoint)[0];
    let exact = 1.0 + 0.1 / 64.0;
    assert!((limit.lambda() - exact).abs() < 1e-12);
    let error = limit.error.unwrap();
    assert!((error.lambda - 0.075 / 64.0).abs() < 1e-12);
    for point in points.iter().filter(|point| point.kind != Kind::Regular) {
        let error = point.error.unwrap();
        assert!(error.lambda <= 2e-3 && error.states <= 2e-3);
    }
    let targets = of(&points, Kind::Target);
    assert_eq!(targets.len(), 2);
    assert!(targets.iter().all(|target| target.lambda() == 0.5));
}

#[test]
fn an_error_that_stays_above_the_tolerance_ends_the_branch() {
    let mut system = Refining::new(|level| if level % 2 == 0 { 0.1 } else { -0.1 }, 1e-3);
    let (points, stop) = trace(&mut system, &[-1.0, 0.0], Increasing, &options());
    let Stop::Inaccurate { error, tolerance } = stop else {
        panic!("{stop}")
    };
    assert!(error > 0.05 && tolerance == 1e-3);
    assert_eq!(points.len(), 1);
    assert!(points[0].error.unwrap().states > 0.05);
}

#[test]
fn a_point_that_the_refined_system_has_not_is_not_trusted() {
    let mut system = Refining::new(|level| if level == 0 { 0.0 } else { f64::NAN }, 1e-3);
    let (points, stop) = trace(&mut system, &[-1.0, 0.0], Increasing, &options());
    assert!(matches!(stop, Stop::Inaccurate { error, .. } if error == f64::INFINITY));
    assert_eq!(points.len(), 1);
    assert_eq!(points[0].error.unwrap().lambda, f64::INFINITY);
}

#[test]
fn the_error_of_a_change_is_not_asked_for() {
    let mut system = Refining::new(|level| 1e-6 * 0.25f64.powi(level), 1e-3);
    let near = |point: &Point| point.z[0] + 0.5;
    let mut branch = Branch::new(&mut system, &[-1.0, 0.0], Increasing, &options())
        .unwrap()
        .event(move |_, point| near(point))
        .change(move |_, point| near(point));
    let found: Vec<_> = branch
        .by_ref()
        .filter(|point| matches!(point.kind, Kind::Event(_)))
        .collect();
    let [event, change] = &found[..] else {
        panic!("{found:?}");
    };
    assert_eq!((event.kind, change.kind), (Kind::Event(0), Kind::Event(1)));
    assert!((event.z[0] + 0.5).abs() < 1e-12 && (change.z[0] + 0.5).abs() < 1e-12);
    assert!(event.error.is_some() && change.error.is_none());
}

#[test]
fn errors_of_unassessed_kinds_are_not_asked_for() {
    let mut system = Refining::new(|level| 1e-6 * 0.25f64.powi(level), 1e-3);
    let branch = Branch::new(&mut system, &[-1.0, 0.0], Increasing, &options()).unwrap();
    let points: Vec<_> = branch.unassessed(&[Kind::Start, Kind::Bound]).collect();
    let has_error = |kind| of(&points, kind)[0].error.is_some();
    assert!(!has_error(Kind::Start) && !has_error(Kind::Bound));
    assert!(has_error(Kind::LimitPoint) && has_error(Kind::Target));
}

#[test]
fn labelled_points_of_a_refined_system_take_few_linearisations() {
    let mut system = Refining::new(|level| 1e-6 * 0.25f64.powi(level), 1e-3);
    let options = Options {
        targets: Vec::new(),
        location: 1e-10,
        ..options()
    };
    let (points, _) = trace(&mut system, &[-1.0, 0.0], Increasing, &options);
    let limit = of(&points, Kind::LimitPoint)[0];
    assert!((limit.error.unwrap().lambda - 7.5e-7).abs() < 1e-12);
    let labelled = points.iter().filter(|point| point.kind != Kind::Regular);
    assert_eq!(labelled.count(), 3);
    // One each for the start and the bound. For the limit point one to begin with and those of the tangents at three places.
    let count = system.linearisations.get();
    assert!(count <= 2 + 4, "{count}");
}
