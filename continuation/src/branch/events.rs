//! Functions whose zeros along a branch are located.

use crate::curve::metric::Metric;
use crate::point::{Kind, Point};
use crate::special_points::node::Node;

/// A function of the system and a point.
type Event<'a, S> = Box<dyn FnMut(&S, &Point) -> f64 + 'a>;

/// Functions of the system and a point, by their numbers.
pub(crate) struct Events<'a, S>(Vec<Event<'a, S>>);

impl<'a, S> Events<'a, S> {
    pub(crate) fn none() -> Self {
        Self(Vec::new())
    }

    pub(crate) fn push(&mut self, function: impl FnMut(&S, &Point) -> f64 + 'a) {
        self.0.push(Box::new(function));
    }

    pub(crate) fn count(&self) -> usize {
        self.0.len()
    }

    /// The value of one function at a node.
    pub(crate) fn value(&mut self, index: usize, system: &S, node: &Node) -> f64 {
        self.0[index](system, &node.point(Kind::Regular))
    }

    /// The value of one function at a place with this tangent, on the cubic that leaves a node.
    pub(crate) fn value_behind(
        &mut self,
        index: usize,
        system: &S,
        from: &Node,
        metric: &Metric,
        [z, tangent]: [&[f64]; 2],
    ) -> f64 {
        let mut node = Node::new(z.to_vec(), tangent.to_vec());
        node.arclength = from.arclength + from.length_to(&node, metric);
        self.value(index, system, &node)
    }

    /// Gives a node the values of all functions.
    pub(crate) fn evaluate(&mut self, system: &S, node: &mut Node) {
        let point = node.point(Kind::Regular);
        let values = self.0.iter_mut().map(|event| event(system, &point));
        node.events = values.collect();
    }
}
