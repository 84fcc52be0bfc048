//! Comparison of two sources of derivatives.

use crate::problem::difference::difference;
use crate::problem::equations::{Equations, Shape};
use crate::problem::guess::Guess;
use crate::problem::problem::Ends;

/// The largest difference found between two providers of the same equations.
#[derive(Clone, Debug, PartialEq)]
pub struct JacobianCheck {
    /// Largest |a − b| / (1 + |a|) over all values and derivatives compared.
    pub difference: f64,
    /// Where it was found.
    pub place: Place,
}

/// A place in the derivatives of a problem.
#[derive(Clone, Debug, PartialEq)]
pub enum Place {
    /// The right-hand side.
    Rhs {
        /// Index of the segment.
        segment: usize,
        /// Where on the segment.
        s: f64,
        /// Component of the right-hand side.
        component: usize,
        /// Column of its Jacobian: a state, or n + the index of a parameter; `None` for the value.
        column: Option<usize>,
    },
    /// A condition.
    Condition {
        /// Index of the condition.
        condition: usize,
        /// Column of its Jacobian: an end state in the order of [`Ends`], then the parameters;
        /// `None` for the value.
        column: Option<usize>,
    },
}

/// Compares values and Jacobians of two providers along a guess, at seven places per segment and
/// at the ends. Put it in a unit test of a hand-written Jacobian.
///
/// # Panics
/// If the two do not have the same segments, parameters and number of conditions.
pub fn check_jacobians(a: &dyn Equations, b: &dyn Equations, along: &dyn Guess) -> JacobianCheck {
    let shape = a.shape();
    assert_eq!(shape, b.shape(), "the same segments and counts");
    let mut worst = JacobianCheck {
        difference: 0.0,
        place: Place::Condition {
            condition: 0,
            column: None,
        },
    };
    let mut compare = |a: f64, b: f64, place: Place| {
        let difference = (a - b).abs() / (1.0 + a.abs());
        // A NaN on either side is the worst difference of all.
        if difference.is_nan() || difference > worst.difference {
            worst = JacobianCheck { difference, place };
        }
    };
    let k = shape.parameters;
    let mut p = vec![0.0; k];
    along.parameters(&mut p);
    let mut ends = Vec::new();
    for (index, segment) in shape.segments.iter().enumerate() {
        let n = segment.states;
        let mut y = vec![0.0; n];
        let at = |theta: f64| segment.from + theta * (segment.to - segment.from);
        for theta in [0.02, 0.13, 0.31, 0.5, 0.73, 0.88, 0.99] {
            along.state(index, at(theta), &mut y);
            let evaluate = |equations: &dyn Equations| {
                let (mut dy, mut jacobian) = (vec![f64::NAN; n], vec![f64::NAN; n * (n + k)]);
                equations.rhs_jacobian(index, at(theta), &y, &p, &mut dy, &mut jacobian);
                (dy, jacobian)
            };
            let ((f_a, j_a), (f_b, j_b)) = (evaluate(a), evaluate(b));
            let place = |component, column| Place::Rhs {
                segment: index,
                s: at(theta),
                component,
                column,
            };
            for (i, (a, b)) in f_a.iter().zip(&f_b).enumerate() {
                compare(*a, *b, place(i, None));
            }
            for (i, (a, b)) in j_a.iter().zip(&j_b).enumerate() {
                compare(*a, *b, place(i / (n + k), Some(i % (n + k))));
            }
        }
        // A joined point is seen from before and from behind.
        let joined = segment.joined.iter().flat_map(|&s| [s, s]);
        for s in [segment.from].into_iter().chain(joined).chain([segment.to]) {
            along.state(index, s, &mut y);
            ends.extend_from_slice(&y);
        }
    }
    let at = Ends::new(&shape.segments, &ends);
    let (rows, columns) = (shape.conditions, ends.len() + k);
    let evaluate = |equations: &dyn Equations| {
        let (mut r, mut jacobian) = (vec![f64::NAN; rows], vec![f64::NAN; rows * columns]);
        equations.conditions_jacobian(at, &p, &mut r, &mut jacobian);
        (r, jacobian)
    };
    let ((r_a, j_a), (r_b, j_b)) = (evaluate(a), evaluate(b));
    let place = |condition, column| Place::Condition { condition, column };
    for (i, (a, b)) in r_a.iter().zip(&r_b).enumerate() {
        compare(*a, *b, place(i, None));
    }
    for (i, (a, b)) in j_a.iter().zip(&j_b).enumerate() {
        compare(*a, *b, place(i / columns, Some(i % columns)));
    }
    worst
}

/// The values of other equations with their Jacobians replaced by central differences, to compare
/// the originals with.
#[derive(Clone, Copy)]
pub struct Differenced<'a>(pub &'a dyn Equations);

impl Equations for Differenced<'_> {
    fn shape(&self) -> Shape {
        self.0.shape()
    }

    fn evaluate_rhs(&self, segment: usize, s: f64, y: &[f64], p: &[f64], dy: &mut [f64]) {
        self.0.evaluate_rhs(segment, s, y, p, dy);
    }

    fn rhs_jacobian(
        &self,
        segment: usize,
        s: f64,
        y: &[f64],
        p: &[f64],
        dy: &mut [f64],
        jacobian: &mut [f64],
    ) {
        let rhs = |y: &[f64], p: &[f64], dy: &mut [f64]| self.evaluate_rhs(segment, s, y, p, dy);
        rhs(y, p, dy);
        difference(rhs, y, p, dy.len(), jacobian);
    }

    fn evaluate_conditions(&self, at: Ends<'_, f64>, p: &[f64], r: &mut [f64]) {
        self.0.evaluate_conditions(at, p, r);
    }

    fn conditions_jacobian(
        &self,
        at: Ends<'_, f64>,
        p: &[f64],
        r: &mut [f64],
        jacobian: &mut [f64],
    ) {
        let conditions = |ends: &[f64], p: &[f64], r: &mut [f64]| {
            self.evaluate_conditions(at.with(ends), p, r);
        };
        self.evaluate_conditions(at, p, r);
        difference(conditions, at.values(), p, r.len(), jacobian);
    }
}
