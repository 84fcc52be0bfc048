//! Points of a branch with what is followed along it.

use crate::curve::metric::Metric;
use crate::point::{Kind, Point};
use crate::special_points::null_space;

/// A second vector that turns by more than this, rad, without its component η, has turned over. With
/// η alone 10 of 100 pairs of branch points close to a bound were missed.
const OVER: f64 = 2.1;
/// The witness has seen something if it turns by more than this, rad. Of 1000 pairs of branch points 0.1 to 1e-5
/// apart on curves of up to seven unknowns one was missed with it; without a witness 5 of 300. Such curves take 6 to 9
/// percent more points; with 0.5 they took more, and the points depended on copies of equations.
const OVERLOOKED: f64 = 0.7;

/// An accepted point with everything that is followed along the branch.
#[derive(Clone, Debug)]
pub(crate) struct Node {
    pub(crate) z: Vec<f64>,
    /// Unit tangent in the direction of travel.
    pub(crate) tangent: Vec<f64>,
    /// Whether the system orients its null vector in the direction of travel: changes at branch
    /// points.
    pub(crate) along: bool,
    pub(crate) arclength: f64,
    /// Values of the event functions.
    pub(crate) events: Vec<f64>,
    /// Value of the cusp function of the system.
    pub(crate) cusp: Option<f64>,
    /// The second vector of the null space of \[J b\].
    pub(crate) second: Vec<f64>,
    /// The second vector with another bordering vector.
    pub(crate) witness: Vec<f64>,
}

impl Node {
    pub(crate) fn new(z: Vec<f64>, tangent: Vec<f64>) -> Self {
        Self {
            z,
            tangent,
            along: true,
            arclength: 0.0,
            events: Vec::new(),
            cusp: None,
            second: Vec::new(),
            witness: Vec::new(),
        }
    }

    /// The point, of this kind, that a caller sees.
    pub(crate) fn point(&self, kind: Kind) -> Point {
        Point {
            z: self.z.clone(),
            tangent: self.tangent.clone(),
            arclength: self.arclength,
            kind,
            other: None,
            approximate: false,
            error: None,
        }
    }

    /// Length of the cubic from this node to another one with their tangents, by the Gauss rule with
    /// three points.
    pub(crate) fn length_to(&self, to: &Self, metric: &Metric) -> f64 {
        let ends = to.z.iter().zip(&self.z);
        let secant: Vec<f64> = ends.map(|(b, a)| b - a).collect();
        let chord = metric.norm(&secant);
        let rule = [
            (0.5 - 0.15f64.sqrt(), 5.0),
            (0.5, 8.0),
            (0.5 + 0.15f64.sqrt(), 5.0),
        ];
        let speed = |u: f64| {
            // Derivatives of the Hermite basis.
            let (d, a, b) = (
                6.0 * u * (1.0 - u),
                (1.0 - u) * (1.0 - 3.0 * u),
                u * (3.0 * u - 2.0),
            );
            let tangents = self.tangent.iter().zip(&to.tangent);
            let rate: Vec<f64> = secant
                .iter()
                .zip(tangents)
                .map(|(s, (p, q))| d * s + chord * (a * p + b * q))
                .collect();
            metric.norm(&rate)
        };
        rule.iter()
            .map(|&(u, weight)| weight * speed(u))
            .sum::<f64>()
            / 18.0
    }

    /// The angle between the second vectors of two nodes, each continued smoothly along the branch. It
    /// is beyond a right angle where one turned over that should not have: two branch points have been
    /// passed, or there is another branch in between. The witness counts where it turns by more than that
    /// which b may overlook.
    pub(crate) fn second_angle(&self, to: &Self, metric: &Metric) -> f64 {
        let sign = if self.along == to.along { 1.0 } else { -1.0 };
        let angle = |a: &[f64], b: &[f64]| {
            let turn = |dot: &dyn Fn(&[f64], &[f64]) -> f64| {
                let cosine = sign * dot(a, b) / (dot(a, a) * dot(b, b)).sqrt();
                cosine.clamp(-1.0, 1.0).acos()
            };
            // η has the same sign behind two branch points, and outweighs the rest where b is small.
            let without_eta = turn(&|a, b| metric.dot(&a[..a.len() - 1], &b[..b.len() - 1]));
            if without_eta > OVER {
                without_eta
            } else {
                turn(&|a, b| null_space::dot(metric, a, b))
            }
        };
        let (own, witness) = (
            angle(&self.second, &to.second),
            angle(&self.witness, &to.witness),
        );
        if witness > OVERLOOKED {
            own.max(witness)
        } else {
            own
        }
    }

    /// The component η of the second vector, with a sign that changes at branch points.
    pub(crate) fn eta(&self) -> f64 {
        let eta = self.second.last().map_or(0.0, |eta| eta.abs());
        if self.along { eta } else { -eta }
    }
}

/// A point between two nodes, at 0 ≤ u ≤ 1 of the secant.
#[derive(Clone, Debug)]
pub(crate) struct Located {
    pub(crate) u: f64,
    pub(crate) z: Vec<f64>,
    pub(crate) tangent: Vec<f64>,
    /// Whether the system orients its null vector in the direction of travel.
    pub(crate) along: bool,
}
