//! Initial guesses.

use crate::discretisation::mesh::Mesh;
use crate::problem::problem::Segment;
use crate::result::error::Error;

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

    /// Checks that the guess has the states and parameters of a problem with these segments and so
    /// many parameters; called once, after the mesh is found to fit and before anything is written.
    /// The default accepts everything.
    ///
    /// # Errors
    /// [`Error::GuessStates`] or [`Error::GuessParameters`].
    fn check_shape(&self, segments: &[Segment], parameters: usize) -> Result<(), Error> {
        let _ = (segments, parameters);
        Ok(())
    }
}

/// Compares the numbers of values of each segment and of parameters with those needed.
pub(crate) fn compare_shape(
    found: impl Fn(usize) -> usize,
    needed: impl Iterator<Item = usize>,
    found_parameters: usize,
    needed_parameters: usize,
) -> Result<(), Error> {
    for (segment, needed) in needed.enumerate() {
        let found = found(segment);
        if found != needed {
            return Err(Error::GuessStates {
                segment,
                found,
                needed,
            });
        }
    }
    if found_parameters != needed_parameters {
        return Err(Error::GuessParameters {
            found: found_parameters,
            needed: needed_parameters,
        });
    }
    Ok(())
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

impl Guess for Constant {
    fn state(&self, segment: usize, _s: f64, y: &mut [f64]) {
        y.copy_from_slice(&self.states[segment]);
    }

    fn parameters(&self, p: &mut [f64]) {
        p.copy_from_slice(&self.parameters);
    }

    fn check_shape(&self, segments: &[Segment], parameters: usize) -> Result<(), Error> {
        compare_shape(
            |segment| values(&self.states, segment),
            segments.iter().map(|segment| segment.states),
            self.parameters.len(),
            parameters,
        )
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

    fn check_shape(&self, _segments: &[Segment], parameters: usize) -> Result<(), Error> {
        let none = std::iter::empty();
        compare_shape(|_| 0, none, self.parameters.len(), parameters)
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

    fn check_shape(&self, segments: &[Segment], parameters: usize) -> Result<(), Error> {
        compare_shape(
            |segment| values(&self.states, segment),
            segments
                .iter()
                .zip(&self.nodes)
                .map(|(segment, nodes)| segment.states * nodes.len()),
            self.parameters.len(),
            parameters,
        )
    }

    fn mesh(&self) -> Option<Mesh> {
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
