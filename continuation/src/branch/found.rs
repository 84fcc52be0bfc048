//! Labelled points as they are found on a step.

use crate::curve::metric::Metric;
use crate::point::{Kind, Point};
use crate::special_points::node::{Located, Node};

/// On steps that are this share of the largest, branch points that cannot be verified are approximate. It is
/// as small as steps can well be, because the same signs tell of a jump to another branch.
pub(crate) const UNVERIFIED: f64 = 1e-6;

/// Where λ turns more slowly than this at a branch point or cusp, it turns because of it: tangents there
/// may be uncertain by so much.
pub(crate) const REST: f64 = 1e-5;
/// At a branch point whose tangents are certain, where it turns more slowly than this: ten times the error
/// of second derivatives by differences of G, from which the tangents follow.
pub(crate) const CERTAIN_REST: f64 = 1e-8;

/// A labelled point of a step.
pub(crate) struct Found {
    pub(crate) at: Located,
    pub(crate) kind: Kind,
    pub(crate) other: Option<Vec<f64>>,
    /// Whether its defining conditions could not be verified.
    pub(crate) approximate: bool,
    /// A rate of λ below this, with its range as unit, is none.
    pub(crate) rest: f64,
}

impl Found {
    pub(crate) fn new(at: Located, kind: Kind) -> Self {
        Self {
            at,
            kind,
            other: None,
            approximate: false,
            rest: REST,
        }
    }

    /// The point as a node, with the orientation behind it.
    pub(crate) fn node(&self) -> Node {
        let mut node = Node::new(self.at.z.clone(), self.at.tangent.clone());
        node.along = self.at.along;
        node
    }

    /// A point that is indicated at 0 ≤ u ≤ 1 of the secant of a short step, but not verified.
    pub(crate) fn approximate(from: &Node, to: &Node, u: f64, kind: Kind) -> Self {
        let between = |a: &[f64], b: &[f64]| -> Vec<f64> {
            a.iter().zip(b).map(|(a, b)| a + u * (b - a)).collect()
        };
        let z = between(&from.z, &to.z);
        let tangent = between(&from.tangent, &to.tangent);
        Self {
            approximate: true,
            ..Self::new(
                Located {
                    u,
                    z,
                    tangent,
                    along: to.along,
                },
                kind,
            )
        }
    }

    /// The point as it is yielded, on a step from a node.
    pub(crate) fn point(self, from: &Node, metric: &Metric) -> Point {
        let mut node = Node::new(self.at.z, self.at.tangent);
        node.arclength = from.arclength + from.length_to(&node, metric);
        Point {
            other: self.other,
            approximate: self.approximate,
            ..node.point(self.kind)
        }
    }
}
