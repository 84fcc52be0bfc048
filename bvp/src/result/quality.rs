//! The accuracy of an iterate, as far as it is known.

use crate::discretisation::mesh::Mesh;
use crate::kernels::dense::max_or_nan;
use crate::problem::unknown::Unknown;

/// What is known of the accuracy of an iterate; infinite where it is not known.
#[derive(Clone, Debug, Default)]
pub(crate) struct Quality {
    pub(crate) defects: Defects,
    /// |Residual| of every condition; none where they are not known.
    pub(crate) conditions: Vec<f64>,
    /// Estimated global error of the states of every segment and of the parameters.
    pub(crate) errors: Option<GlobalErrors>,
}

impl Quality {
    /// The accuracy of an iterate of which nothing is known.
    pub(crate) fn unknown(mesh: &Mesh) -> Self {
        Self {
            defects: Defects::unknown(mesh),
            conditions: vec![],
            errors: None,
        }
    }
}

/// The defects of a solution, one number per interval and segment.
#[derive(Clone, Debug, Default)]
pub(crate) struct Defects {
    /// Relative to 1 + |f|.
    pub(crate) relative: Vec<Vec<f64>>,
    /// Times the length of the interval and relative to 1 + |y|: what an interval adds to the error.
    pub(crate) local: Vec<Vec<f64>>,
}

impl Defects {
    /// Infinite ones, where they are not known.
    pub(crate) fn unknown(mesh: &Mesh) -> Self {
        let infinite = |nodes: &Vec<f64>| vec![f64::INFINITY; nodes.len() - 1];
        let relative: Vec<_> = mesh.iter().map(infinite).collect();
        Self {
            local: relative.clone(),
            relative,
        }
    }

    /// The largest that an interval adds to the error.
    pub(crate) fn largest_local(&self) -> f64 {
        self.local.iter().flatten().copied().fold(0.0, max_or_nan)
    }
}

/// Estimated global errors, relative to 1 + |value|.
#[derive(Clone, Debug, Default)]
pub(crate) struct GlobalErrors {
    /// For every segment one number per state, the largest over the segment.
    pub(crate) states: Vec<Vec<f64>>,
    /// One number per parameter.
    pub(crate) parameters: Vec<f64>,
}

impl GlobalErrors {
    pub(crate) fn largest(&self) -> f64 {
        let all = self.states.iter().flatten().chain(&self.parameters);
        all.copied().fold(0.0, max_or_nan)
    }
}

/// S' − f at the m + 1 defect points of every interval of every segment, n numbers each.
pub(crate) type Samples = Vec<Vec<f64>>;

/// In which direction a solution is not isolated.
#[derive(Clone, Debug, Default)]
pub(crate) struct Direction {
    /// Whether the conditions could feel it.
    pub(crate) felt: bool,
    /// Whether it is a shift of s.
    pub(crate) shift: bool,
    /// The unknown at the ends that changes most.
    pub(crate) free: Option<Unknown>,
}
