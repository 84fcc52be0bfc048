//! How to solve.

use crate::{Error, Scheme};

/// The settings of [`solve`](crate::solve) and [`Family`](crate::Family). Update the defaults with struct syntax:
///
/// ```
/// let options = bvp::Options { tolerance: 1e-9, ..bvp::Options::default() };
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Options {
    /// The defect of the solution in the differential equations relative to 1 + |f|, the residuals
    /// of the conditions (relative to the size of their terms where that exceeds one), and, unless
    /// skipped, the estimated global error relative to 1 + |y| are all brought to at most this
    /// number; not the defect if the mesh is chosen for the error. Between 1e-13 and 1e-1; default 1e-6.
    pub tolerance: f64,
    /// The collocation scheme; default Gauss with 4 stages.
    pub scheme: Scheme,
    /// Number of equal intervals per segment to start on, where the guess brings no mesh;
    /// default 10.
    pub initial_intervals: usize,
    /// Largest number of intervals over all segments; default 10 000.
    pub max_intervals: usize,
    /// Largest number of Newton steps on one mesh; default 60.
    pub max_newton_steps: usize,
    /// How often, after a failure of Newton's method, the mesh is halved and the guess taken again;
    /// default 2. Before that the guess is tried with its slopes replaced by f along it and integrated,
    /// one step of Picard's iteration. Callers that have a better answer to a failure set 0.
    pub retries: usize,
    /// How the global error is estimated; default on a halved mesh.
    pub global_error: GlobalError,
    /// What the mesh is chosen for; default the defect.
    pub control: Control,
}

/// What the mesh is chosen for, and brought to the tolerance.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Control {
    /// The defect, and the estimated global error where it is larger, which is rare: the defect of m
    /// stages is of order m, the error of order m + 1 and, at the nodes, 2 m.
    Defect,
    /// The estimated global error alone. Takes far fewer intervals, and an estimate on every mesh; without
    /// estimates, as [`Control::Defect`].
    Error,
}

/// How the global error of a solution is estimated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum GlobalError {
    /// By one Newton correction on the mesh with every interval halved, started at the solution:
    /// the correction is the difference of the two discrete solutions up to its own square.
    HalvedMesh,
    /// Not at all: for intermediate solutions on the way to another one.
    Skip,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            tolerance: 1e-6,
            scheme: Scheme::default(),
            initial_intervals: 10,
            max_intervals: 10_000,
            max_newton_steps: 60,
            retries: 2,
            global_error: GlobalError::HalvedMesh,
            control: Control::Defect,
        }
    }
}

impl Options {
    /// The settings that take the least time to a tolerance: the mesh is chosen for the error, and the
    /// scheme, of Gauss, has the more stages the smaller the tolerance is.
    ///
    /// ```
    /// let options = bvp::Options::to(1e-9);
    /// assert_eq!(options.scheme.order(), 14);
    /// ```
    pub fn to(tolerance: f64) -> Self {
        Self {
            tolerance,
            scheme: Scheme::for_tolerance(tolerance),
            control: Control::Error,
            ..Self::default()
        }
    }

    /// Checks every setting.
    ///
    /// # Errors
    /// [`Error::Tolerance`], [`Error::Stages`] or [`Error::NoIntervals`].
    pub fn validate(&self) -> Result<(), Error> {
        if !(1e-13..=1e-1).contains(&self.tolerance) {
            return Err(Error::Tolerance {
                tolerance: self.tolerance,
            });
        }
        if !self.scheme.is_valid() {
            return Err(Error::Stages {
                scheme: self.scheme,
            });
        }
        if self.initial_intervals == 0 {
            return Err(Error::NoIntervals);
        }
        Ok(())
    }
}
