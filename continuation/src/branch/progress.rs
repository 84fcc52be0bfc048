//! Where a branch stands.

use crate::curve::predictor::History;
use crate::point::{Kind, Point};
use crate::special_points::node::Node;
use std::collections::VecDeque;

/// The last points of a branch, and those that are yet to be yielded.
pub(crate) struct Progress {
    /// The last accepted point, ...
    pub(crate) node: Node,
    /// ... and those before.
    pub(crate) history: History,
    /// The first point and its tangent.
    pub(crate) first: Node,
    /// Whether the first point is a branch point.
    pub(crate) from_branch_point: bool,
    /// Whether orientation and rates at the last node mean nothing: it is a branch point.
    pub(crate) unoriented: bool,
    /// The rate of η over the last step.
    pub(crate) trend: Option<f64>,
    pub(crate) steps: usize,
    pub(crate) queue: VecDeque<Point>,
}

impl Progress {
    /// A branch that stands at its first point.
    pub(crate) fn at(node: Node) -> Self {
        Self {
            first: node.clone(),
            node,
            history: History::default(),
            from_branch_point: false,
            unoriented: false,
            trend: None,
            steps: 0,
            queue: VecDeque::new(),
        }
    }

    /// The branch point at which a branch sets out has no other place on it.
    pub(crate) fn is_at_branch_point(&self) -> bool {
        self.unoriented && self.history.arclengths.is_empty()
    }

    /// Queues the last node as a point of this kind.
    pub(crate) fn yield_node(&mut self, kind: Kind) {
        let point = self.node.point(kind);
        self.queue.push_back(point);
    }

    /// All vectors that depend on the discretisation, a point the first.
    pub(crate) fn take_vectors(&mut self) -> Vec<Vec<f64>> {
        let own = [&mut self.node.z, &mut self.node.tangent];
        let first = [&mut self.first.z, &mut self.first.tangent];
        let mut vectors: Vec<_> = own.into_iter().chain(first).map(std::mem::take).collect();
        vectors.append(&mut self.history.points);
        for point in &mut self.queue {
            vectors.push(std::mem::take(&mut point.z));
            vectors.push(std::mem::take(&mut point.tangent));
            vectors.extend(point.other.as_mut().map(std::mem::take));
        }
        vectors
    }

    /// Puts them back.
    pub(crate) fn put_vectors(&mut self, vectors: Vec<Vec<f64>>) {
        let mut vectors = vectors.into_iter();
        let mut next = || vectors.next().unwrap_or_default();
        self.node.z = next();
        self.node.tangent = next();
        self.first.z = next();
        self.first.tangent = next();
        self.history.points = self.history.arclengths.iter().map(|_| next()).collect();
        for point in &mut self.queue {
            point.z = next();
            point.tangent = next();
            if let Some(other) = &mut point.other {
                *other = next();
            }
        }
    }
}
