//! Initial guesses.

use crate::problem::problem::Segment;

/// A first guess of the solution: constants, a function, a table, or a previous
/// [`Solution`](crate::Solution) of any scheme on any mesh.
pub trait Guess {
    /// Writes the guessed states of `segment` at `s` into `y`; asked anywhere on the segment.
    fn state(&self, segment: usize, s: f64, y: &mut [f64]);

    /// Writes the guessed parameters into `p`.
    fn parameters(&self, p: &mut [f64]);

    /// The mesh to start on: for each segment its nodes in the order from its start to its end. `None`
    /// starts on equal intervals, as many as the options say.
    fn mesh(&self) -> Option<Vec<Vec<f64>>> {
        None
    }

    /// The number of values that this guess has for the states of a segment, which is number `index`: over
    /// all nodes of the segment where there is a [`mesh`](Self::mesh), at one place otherwise. A
    /// number that does not suit the segment is refused before anything is written; `None`, the
    /// default, is not checked.
    fn state_values(&self, index: usize, segment: &Segment) -> Option<usize> {
        let _ = (index, segment);
        None
    }

    /// The number of parameters that this guess has; `None`, the default, is not checked.
    fn parameter_values(&self) -> Option<usize> {
        None
    }
}

/// The number of values in a list of segments; none where there is no such segment.
fn values(states: &[Vec<f64>], segment: usize) -> usize {
    states.get(segment).map_or(0, Vec::len)
}

/// The same states everywhere on a segment.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Constant {
    /// The states of each segment.
    pub states: Vec<Vec<f64>>,
    /// The parameters.
    pub parameters: Vec<f64>,
}

impl Constant {
    /// A guess for one segment and no parameters.
    pub fn new(states: impl Into<Vec<f64>>) -> Self {
        Self {
            states: vec![states.into()],
            parameters: vec![],
        }
    }
}

impl Guess for Constant {
    fn state(&self, segment: usize, _s: f64, y: &mut [f64]) {
        y.copy_from_slice(&self.states[segment]);
    }

    fn parameters(&self, p: &mut [f64]) {
        p.copy_from_slice(&self.parameters);
    }

    fn state_values(&self, index: usize, _segment: &Segment) -> Option<usize> {
        Some(values(&self.states, index))
    }

    fn parameter_values(&self) -> Option<usize> {
        Some(self.parameters.len())
    }
}

/// States given by a function of (segment, s) that returns them, as an array or a vector.
///
/// ```
/// use bvp::Function;
///
/// // y = sin s and y' = cos s.
/// let guess = Function {
///     state: |_segment: usize, s: f64| [s.sin(), s.cos()],
///     parameters: vec![],
/// };
/// ```
#[derive(Clone, Debug)]
pub struct Function<F> {
    /// Returns the states of a segment at s, as many as the segment has.
    pub state: F,
    /// The parameters.
    pub parameters: Vec<f64>,
}

impl<F, S> Guess for Function<F>
where
    F: Fn(usize, f64) -> S,
    S: AsRef<[f64]>,
{
    fn state(&self, segment: usize, s: f64, y: &mut [f64]) {
        let states = (self.state)(segment, s);
        let states = states.as_ref();
        if states.len() == y.len() {
            y.copy_from_slice(states);
        } else {
            // Their number was right at the start of the segment; a guess that is not a number is refused.
            y.fill(f64::NAN);
        }
    }

    fn parameters(&self, p: &mut [f64]) {
        p.copy_from_slice(&self.parameters);
    }

    fn state_values(&self, index: usize, segment: &Segment) -> Option<usize> {
        Some((self.state)(index, segment.from).as_ref().len())
    }

    fn parameter_values(&self) -> Option<usize> {
        Some(self.parameters.len())
    }
}

/// States given at nodes and interpolated linearly; the nodes are also the first mesh.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Table {
    /// For each segment its nodes, in the order from its start to its end.
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

    fn state_values(&self, index: usize, _segment: &Segment) -> Option<usize> {
        Some(values(&self.states, index))
    }

    fn parameter_values(&self) -> Option<usize> {
        Some(self.parameters.len())
    }

    fn mesh(&self) -> Option<Vec<Vec<f64>>> {
        Some(self.nodes.clone())
    }
}

/// The index of the interval of `nodes`, ascending or descending, that holds `s`; the nearest one where
/// `s` is outside.
pub(crate) fn interval_of(nodes: &[f64], s: f64) -> usize {
    let passed = if nodes[0] < nodes[1] {
        nodes.partition_point(|&node| node <= s)
    } else {
        nodes.partition_point(|&node| node >= s)
    };
    passed.clamp(1, nodes.len() - 1) - 1
}
