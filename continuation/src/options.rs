//! How a branch is traced.

use crate::error::Error;

/// The settings of a trace. State the range of λ and update the defaults with struct syntax:
///
/// ```
/// use continuation::Options;
///
/// let options = Options { targets: vec![1.0], ..Options::within(0.0, 4.0) };
/// assert_eq!(options.bounds, [0.0, 4.0]);
/// ```
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Options {
    /// Hard bounds of λ: the system is never evaluated beyond them, and a branch that reaches one
    /// lands on it and stops. Their distance is the unit of λ in the arclength (the larger of 1 and
    /// |λ| of the first point where it is infinite).
    pub bounds: [f64; 2],
    /// Values of λ at which a point is wanted exactly, as often as the branch passes.
    pub targets: Vec<f64>,
    /// Weights wᵢ of the squares of all unknowns in the arclength, λ last, in place of the default,
    /// in which every group of unknowns counts alike and relative to its size (see
    /// [`System::groups`](crate::System::groups)).
    pub weights: Option<Vec<f64>>,
    /// Length of the first step, where the range of λ counts as one; default 0.05.
    pub first_step: f64,
    /// Largest step; default 0.2.
    pub largest_step: f64,
    /// Steps that have shrunk below this end the branch; default 1e-8.
    pub smallest_step: f64,
    /// The angle by which the tangent should turn per step, rad; default 0.35. Steps that turn it
    /// by three times as much are repeated.
    pub angle: f64,
    /// Points are on the branch when the next Newton correction would be shorter than this, or than a
    /// hundredth of [`System::tolerance`](crate::System::tolerance), in the arclength norm; default
    /// 1e-9.
    pub accuracy: f64,
    /// Limit points, cusps and events are located and corrected to this length in the arclength norm; 0, the default,
    /// stands for down to rounding, which is what branch points and points with a prescribed λ are corrected to always.
    /// At a limit point λ is then off by about the square of it. Labelled points on a refined system, with which their errors
    /// are found, are corrected to this length, too.
    #[cfg_attr(feature = "serde", serde(default))]
    pub location: f64,
    /// Whether branch points are looked for; default true. For that a second null vector is followed, and steps are
    /// shortened where it turns. Without it branch points are passed unseen, and a start at one is not refused: for systems
    /// that have none, or nearly singular ones, on which that vector turns in steps a thousandth as long as the tangent.
    #[cfg_attr(feature = "serde", serde(default = "yes"))]
    pub branch_points: bool,
    /// Largest number of Newton corrections per step; default 8.
    pub corrections: usize,
    /// Largest number of steps; default 1000.
    pub steps: usize,
    /// What is kept of a predicted point.
    pub parameterisation: Parameterisation,
    /// How the next point is predicted.
    pub predictor: Predictor,
}

/// What is kept of a predicted point while it is corrected.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Parameterisation {
    /// The component along the tangent (Keller 1977): passes limit points.
    Pseudoarclength,
    /// The parameter λ: natural continuation, which ends at limit points.
    Natural,
}

/// How the next point is predicted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Predictor {
    /// Along the tangent.
    Tangent,
    /// By the polynomial of up to third degree in the arclength through the last points and the
    /// tangent.
    Polynomial,
}

/// The default where saved settings do not say.
#[cfg(feature = "serde")]
fn yes() -> bool {
    true
}

impl Options {
    /// The defaults for λ between `low` and `high`.
    pub fn within(low: f64, high: f64) -> Self {
        Self {
            bounds: [low, high],
            targets: Vec::new(),
            weights: None,
            first_step: 0.05,
            largest_step: 0.2,
            smallest_step: 1e-8,
            angle: 0.35,
            accuracy: 1e-9,
            location: 0.0,
            branch_points: true,
            corrections: 8,
            steps: 1000,
            parameterisation: Parameterisation::Pseudoarclength,
            predictor: Predictor::Polynomial,
        }
    }

    /// Checks every setting against a system with this many unknowns.
    pub(crate) fn validate(&self, unknowns: usize) -> Result<(), Error> {
        let [low, high] = self.bounds;
        if low.is_nan() || high.is_nan() || low >= high {
            return Err(Error::Bounds { low, high });
        }
        let positive = [
            ("first_step", self.first_step),
            ("largest_step", self.largest_step),
            ("smallest_step", self.smallest_step),
            ("angle", self.angle),
            ("accuracy", self.accuracy),
        ];
        for (name, value) in positive {
            if !(value > 0.0 && value.is_finite()) {
                return Err(Error::Setting { name, value });
            }
        }
        if !(self.location >= 0.0 && self.location.is_finite()) {
            let (name, value) = ("location", self.location);
            return Err(Error::Setting { name, value });
        }
        if self.corrections == 0 {
            let (name, value) = ("corrections", 0.0);
            return Err(Error::Setting { name, value });
        }
        if let Some(&value) = self.targets.iter().find(|target| !target.is_finite()) {
            let name = "targets";
            return Err(Error::Setting { name, value });
        }
        let Some(weights) = &self.weights else {
            return Ok(());
        };
        if weights.len() != unknowns {
            let given = weights.len();
            return Err(Error::WeightCount { given, unknowns });
        }
        match weights.iter().find(|w| !(**w >= 0.0 && w.is_finite())) {
            Some(&value) => {
                let name = "weights";
                Err(Error::Setting { name, value })
            }
            None if weights.iter().all(|&w| w == 0.0) => {
                let (name, value) = ("weights", 0.0);
                Err(Error::Setting { name, value })
            }
            None => Ok(()),
        }
    }
}
