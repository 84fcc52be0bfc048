//! The unknowns of a problem, named.

use crate::discretisation::iterate::Iterate;
use crate::discretisation::mesh::Mesh;
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
    /// The unknown whose correction is the largest relative to 1 + |x|; the first that is not a number.
    pub(crate) fn most_corrected(mesh: &Mesh, x: &Iterate, correction: &Iterate) -> Option<Self> {
        let mut worst = (0.0f64, None);
        let mut look = |x: f64, delta: f64, unknown: Self| {
            let relative = (delta / (1.0 + x.abs())).abs();
            if !worst.0.is_nan() && (relative.is_nan() || relative > worst.0) {
                worst = (relative, Some(unknown));
            }
        };
        let segments = x.segments.iter().zip(&correction.segments).zip(mesh);
        for (segment, ((x, delta), mesh)) in segments.enumerate() {
            let n = x.nodes.len() / mesh.len();
            for (i, (&x, &delta)) in x.nodes.iter().zip(&delta.nodes).enumerate() {
                let (s, component) = (mesh[i / n], i % n);
                let state = Self::State {
                    segment,
                    s,
                    component,
                };
                look(x, delta, state);
            }
        }
        for (index, (&x, &delta)) in x.p.iter().zip(&correction.p).enumerate() {
            look(x, delta, Self::Parameter { index });
        }
        worst.1
    }

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
