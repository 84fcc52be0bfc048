//! Initial guesses.

use crate::mesh::Mesh;

/// A first guess of the solution: constants, a function, a table, or a previous
/// [`Solution`](crate::Solution) on any mesh.
pub trait Guess {
    /// Writes the guessed states of `segment` at `s` into `y`.
    fn state(&self, segment: usize, s: f64, y: &mut [f64]);

    /// Writes the guessed parameters into `p`.
    fn parameters(&self, p: &mut [f64]);

    /// The mesh to start on: for each segment its nodes in ascending order. `None` starts on equal
    /// intervals, as many as the options say.
    fn mesh(&self) -> Option<Vec<Vec<f64>>> {
        None
    }
}

/// The same states everywhere on a segment.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Constant {
    /// The states of each segment.
    pub states: Vec<Vec<f64>>,
    /// The parameters.
    pub parameters: Vec<f64>,
}

impl Guess for Constant {
    fn state(&self, segment: usize, _s: f64, y: &mut [f64]) {
        y.copy_from_slice(&self.states[segment]);
    }

    fn parameters(&self, p: &mut [f64]) {
        p.copy_from_slice(&self.parameters);
    }
}

/// States given by a function of (segment, s) that writes them.
#[derive(Clone, Debug)]
pub struct Function<F> {
    /// Writes the states of a segment at s.
    pub state: F,
    /// The parameters.
    pub parameters: Vec<f64>,
}

impl<F: Fn(usize, f64, &mut [f64])> Guess for Function<F> {
    fn state(&self, segment: usize, s: f64, y: &mut [f64]) {
        (self.state)(segment, s, y);
    }

    fn parameters(&self, p: &mut [f64]) {
        p.copy_from_slice(&self.parameters);
    }
}

/// States given at nodes and interpolated linearly; the nodes are also the first mesh.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Table {
    /// For each segment its nodes, ascending from one end of the segment to the other.
    pub nodes: Vec<Vec<f64>>,
    /// For each segment the states at its nodes, one after the other (nodes × states).
    pub states: Vec<Vec<f64>>,
    /// The parameters.
    pub parameters: Vec<f64>,
}

impl Guess for Table {
    fn state(&self, segment: usize, s: f64, y: &mut [f64]) {
        let (nodes, states) = (&self.nodes[segment], &self.states[segment]);
        let i = interval_of(nodes, s);
        let theta = (s - nodes[i]) / (nodes[i + 1] - nodes[i]);
        let (left, right) = states[i * y.len()..].split_at(y.len());
        for (y, (left, right)) in y.iter_mut().zip(left.iter().zip(right)) {
            *y = left + theta * (right - left);
        }
    }

    fn parameters(&self, p: &mut [f64]) {
        p.copy_from_slice(&self.parameters);
    }

    fn mesh(&self) -> Option<Mesh> {
        Some(self.nodes.clone())
    }
}

/// The index of the interval of `nodes` that holds `s`; the nearest one where `s` is outside.
pub(crate) fn interval_of(nodes: &[f64], s: f64) -> usize {
    nodes
        .partition_point(|&node| node <= s)
        .clamp(1, nodes.len() - 1)
        - 1
}
