//! The unknowns of a problem, named.

use crate::problem::problem::Segment;
use std::fmt;

/// An unknown of the discretised problem.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Unknown {
    /// A state at a mesh node.
    State {
        /// Index of the segment.
        segment: usize,
        /// The node.
        s: f64,
        /// Index of the state.
        component: usize,
    },
    /// A parameter.
    Parameter {
        /// Index of the parameter.
        index: usize,
    },
}

impl fmt::Display for Unknown {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::State {
                segment,
                s,
                component,
            } => write!(f, "component {component} of segment {segment} at s = {s}"),
            Self::Parameter { index } => write!(f, "parameter {index}"),
        }
    }
}

impl Unknown {
    /// The unknown in a column of the conditions' Jacobian: the ends of all segments in turn, then the
    /// parameters.
    pub(crate) fn of_column(segments: &[Segment], column: usize) -> Self {
        let mut rest = column;
        for (segment, shape) in segments.iter().enumerate() {
            for s in [shape.from, shape.to] {
                if rest < shape.states {
                    return Self::State {
                        segment,
                        s,
                        component: rest,
                    };
                }
                rest -= shape.states;
            }
        }
        Self::Parameter { index: rest }
    }
}
