//! How to solve.

use crate::discretisation::scheme::Scheme;
use crate::result::error::{Error, check_sizes};

/// The settings of [`solve`](crate::solve) and [`Family`](crate::Family). Update the defaults with struct syntax:
///
/// ```
/// let options = bvp::Options { tolerance: 1e-9, ..bvp::Options::default() };
/// ```
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(default, deny_unknown_fields))]
pub struct Options {
    /// The estimated global error relative to 1 + |y| is brought to at most this number, or, where the
    /// defect is controlled alone, the defect in the differential equations relative to 1 + |f|; and so are
    /// the residuals of the conditions, relative to the size of their terms where that exceeds one.
    /// [`absolute`](Self::absolute) puts other numbers in the place of the ones.
    /// Between 1e-13 and 1e-1; default 1e-6.
    pub tolerance: f64,
    /// The collocation scheme; default `None`, [`Scheme::for_tolerance`].
    pub scheme: Option<Scheme>,
    /// Number of equal intervals per segment that the solver may think of as a first mesh, where the
    /// guess brings none; default 10. Where the error is estimated it begins with a third of more than
    /// three equal intervals, also with those of a guess: they tell nothing of the solution.
    pub initial_intervals: usize,
    /// Largest number of intervals over all segments; default 10 000.
    pub max_intervals: usize,
    /// Largest number of Newton steps on one mesh; default 60.
    pub max_newton_steps: usize,
    /// How often, after a failure of Newton's method, the mesh is halved and the guess taken again;
    /// default 3. Before that the guess is tried with its slopes replaced by f along it and integrated,
    /// one step of Picard's iteration; after all that, and where no mesh resolves the solution or rounding
    /// hides it, once more from a straight line between end states that meet the conditions, by a
    /// homotopy. Callers that have a better answer to a failure set 0, which omits all of it.
    pub retries: usize,
    /// What is brought to at most the tolerance, and so what the mesh is chosen for; default
    /// [`Control::Error`].
    pub control: Control,
    /// Whether the guess is a solution of a neighbouring problem on a mesh that resolves it, as along a path of problems; default
    /// false. What is true of a solution then holds for its neighbour: one within the tolerance is not
    /// [examined](crate::guide::accuracy#what-success-means) for other solutions near it, for hidden layers and for what grows from below
    /// the tolerance, and its rounding is told by the last linearisation. That saves one to three factorisations. From a guess that is
    /// no neighbour a wrong solution may be returned: layers a tenth as thick as those that the mesh resolves are not seen.
    pub from_neighbour: bool,
    /// Below what size the error of each state or parameter is absolute, in the unit of that state or
    /// parameter: where this documentation says 1 + |y| or 1 + |f|, the 1 stands for this number, or for
    /// this number per unit of s. One positive number for every state of all segments in turn, then one for
    /// every parameter; those of the parameters may be left out and are 1 then. Default empty: all are 1.
    ///
    /// Take the typical size of every unknown. The solver works with states and parameters divided by
    /// these numbers, rounded down to powers of two: states of 1e8 and 1e-8 are then solved equally well,
    /// and a change of units by a power of two changes no digit of the solution. The residual of a
    /// condition is compared with the size of its terms, or with the most that a change of one state or
    /// parameter by its number makes of it where that is larger.
    ///
    /// ```
    /// use bvp::{Constant, Options, TwoPoint, solve};
    ///
    /// // y'' = 0 on a length of 1e-9 m, for y of about 1e-19 and y' of about 1e-10 per metre.
    /// let line = TwoPoint::new(
    ///     [2, 0],
    ///     [0.0, 1e-9],
    ///     |_s, y, _p, dy| dy.copy_from_slice(&[y[1], 0.0 * y[0]]),
    ///     |start, end, _p, r| r.copy_from_slice(&[start[0] - 1.6e-19, end[0] - 3.2e-19]),
    /// );
    /// let options = Options { absolute: vec![1e-19, 1e-10], ..Options::default() };
    /// let solution = solve(&line, &Constant::new([0.0, 0.0]), &options)?;
    /// assert!((solution.start(0)[1] - 1.6e-10).abs() < 1e-16);
    /// # Ok::<(), bvp::Error>(())
    /// ```
    pub absolute: Vec<f64>,
}

/// What the tolerance bounds, and what the mesh is chosen for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Control {
    /// The global error, estimated by defect correction.
    Error,
    /// The defect; no error is estimated. For intermediate solutions on the way to another one. Takes
    /// more intervals than the error does.
    Defect,
    /// The estimated global error and the defect. For what depends on slopes or integrates right-hand
    /// sides. Takes as many intervals as the defect does.
    Both,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            tolerance: 1e-6,
            scheme: None,
            initial_intervals: 10,
            max_intervals: 10_000,
            max_newton_steps: 60,
            retries: 3,
            control: Control::Error,
            from_neighbour: false,
            absolute: vec![],
        }
    }
}

impl Options {
    /// The default settings with another tolerance.
    ///
    /// ```
    /// let options = bvp::Options::to(1e-9);
    /// assert_eq!(options.scheme().order(), 14);
    /// ```
    pub fn to(tolerance: f64) -> Self {
        Self {
            tolerance,
            ..Self::default()
        }
    }

    /// The scheme that is used: the one set, or that for the tolerance.
    pub fn scheme(&self) -> Scheme {
        self.scheme
            .unwrap_or_else(|| Scheme::for_tolerance(self.tolerance))
    }

    /// Checks every setting.
    ///
    /// # Errors
    /// [`Error::Tolerance`], [`Error::Stages`], [`Error::NoIntervals`] or [`Error::Absolute`].
    pub fn validate(&self) -> Result<(), Error> {
        if !(1e-13..=1e-1).contains(&self.tolerance) {
            return Err(Error::Tolerance {
                tolerance: self.tolerance,
            });
        }
        if !self.scheme().is_valid() {
            return Err(Error::Stages {
                scheme: self.scheme(),
            });
        }
        if self.initial_intervals == 0 {
            return Err(Error::NoIntervals);
        }
        check_sizes(&self.absolute)
    }
}
