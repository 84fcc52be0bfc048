//! Boundary value problems with known solutions, shared by the tests and the benches.
//!
//! [`all`] lists 89 cases. Each states a problem
//!
//! ```text
//! dy/dx = f(x, y, p)  on its segments,      g(all ends, p) = 0,
//! ```
//!
//! with an initial guess and a table of its solution to compare with by [`scaled_error`]: the
//! closed form where there is one, else a solution of order 16 confirmed by a second code. The
//! cases named T are those of the test set of Cash, Wright and Mazzia under their own numbers, in
//! up to three degrees of difficulty; the cases named E come from the examples of other codes and
//! textbooks and from this project. [`exact_problems`] lists smooth problems whose solution is a
//! function to be evaluated anywhere, for convergence orders. An [`Attempt`] is a case solved once,
//! with its true error and cost.
//!
//! ```
//! use reference_problems::{case, scaled_error};
//!
//! // y″ = y, y(0) = 1, y(1) = 0.
//! let case = case("E11a").expect("a case of this crate");
//! for (_, x, y) in &case.reference.points {
//!     let computed = [(1.0 - x).sinh() / 1f64.sinh(), -(1.0 - x).cosh() / 1f64.sinh()];
//!     assert!(scaled_error(&computed, y) < 1e-15);
//! }
//!
//! // A case is its own guess.
//! let solution = bvp::solve(&*case.equations, &case, &bvp::Options::default())?;
//! assert!((solution.start(0)[1] + 1f64.cosh() / 1f64.sinh()).abs() < 1e-6);
//! # Ok::<(), bvp::Error>(())
//! ```

mod eigenvalues;
mod exact;
mod fluid_flow;
mod linear_layers;
mod multiple_solutions;
mod multipoint;
mod nonlinear_layers;
mod periodic;
mod reference;
mod special_conditions;
mod systems;
mod turning_points;

mod attempt;
mod statistics;

pub use attempt::{Attempt, FALSE_FROM, Outcome, max_or_nan, true_error};
use bvp::{Ends, Equations, Real, Segment};
pub use exact::{ExactProblem, exact_problems};
pub use reference::Reference;
pub use statistics::{geometric_mean, quantile};

/// The tolerances that the cases are tested and timed at.
pub const TOLERANCES: [f64; 3] = [1e-3, 1e-6, 1e-9];

/// An initial guess: writes the states at x of a segment into the slice.
pub type Guess = Box<dyn Fn(usize, f64, &mut [f64]) + Send + Sync>;

/// A boundary value problem with an initial guess and a known solution.
pub struct Case {
    /// Short name: T and the number of the test set, or E and a number, then a letter for the
    /// variant.
    pub id: &'static str,
    /// What the problem is.
    pub name: &'static str,
    /// Where the statement comes from.
    pub source: &'static str,
    /// The statement.
    pub equations: Box<dyn Equations + Send + Sync>,
    /// The initial guess of the states.
    pub guess: Guess,
    /// The initial guess of the unknown parameters.
    pub parameter_guess: Vec<f64>,
    /// Intervals of the initial mesh in all, to be shared over the segments.
    pub initial_intervals: usize,
    /// The solution.
    pub reference: Reference,
}

impl Case {
    /// A case without unknown parameters, guessed zero, on ten initial intervals.
    fn new(
        id: &'static str,
        name: &'static str,
        source: &'static str,
        equations: impl Equations + Send + 'static,
    ) -> Self {
        Self {
            id,
            name,
            source,
            equations: Box::new(equations),
            guess: Box::new(|_, _, y| y.fill(0.0)),
            parameter_guess: Vec::new(),
            initial_intervals: 10,
            reference: Reference::of(id),
        }
    }

    /// The same case with a guess of the states that is a function of x.
    fn with_guess<const N: usize>(
        mut self,
        guess: impl Fn(f64) -> [f64; N] + Send + Sync + 'static,
    ) -> Self {
        self.guess = Box::new(move |_, x, y| y.copy_from_slice(&guess(x)));
        self
    }

    /// The same case with a guess of the unknown parameters.
    fn with_parameter_guess(mut self, guess: &[f64]) -> Self {
        self.parameter_guess = guess.to_vec();
        self
    }

    /// The same case with another initial mesh.
    fn with_intervals(mut self, intervals: usize) -> Self {
        self.initial_intervals = intervals;
        self
    }
}

/// A case is the guess that it states, on equal intervals.
impl bvp::Guess for Case {
    fn state(&self, segment: usize, s: f64, y: &mut [f64]) {
        (self.guess)(segment, s, y);
    }

    fn parameters(&self, p: &mut [f64]) {
        p.copy_from_slice(&self.parameter_guess);
    }

    fn mesh(&self) -> Option<Vec<Vec<f64>>> {
        let segments = self.equations.shape().segments;
        let count = self.initial_intervals.div_ceil(segments.len());
        let nodes = |segment: &Segment| -> Vec<f64> {
            let length = segment.to - segment.from;
            let inner = (0..count).map(|i| segment.from + length * i as f64 / count as f64);
            inner.chain([segment.to]).collect()
        };
        Some(segments.iter().map(nodes).collect())
    }
}

/// All cases, grouped by kind.
pub fn all() -> Vec<Case> {
    [
        linear_layers::cases(),
        turning_points::cases(),
        nonlinear_layers::cases(),
        multiple_solutions::cases(),
        fluid_flow::cases(),
        eigenvalues::cases(),
        periodic::cases(),
        multipoint::cases(),
        special_conditions::cases(),
        systems::cases(),
    ]
    .into_iter()
    .flatten()
    .collect()
}

/// The case named `id`, if there is one.
pub fn case(id: &str) -> Option<Case> {
    all().into_iter().find(|case| case.id == id)
}

/// The error measure of the reference tables: max |y − yref| / (1 + |yref|).
///
/// A value that is not a number gives a result that is not a number.
///
/// # Panics
/// If the slices differ in length.
pub fn scaled_error(computed: &[f64], reference: &[f64]) -> f64 {
    assert_eq!(computed.len(), reference.len(), "one value per component");
    let errors = computed
        .iter()
        .zip(reference)
        .map(|(y, yref)| (y - yref).abs() / (1.0 + yref.abs()));
    // Not f64::max, which would drop a NaN.
    errors.fold(0.0, |max: f64, error| {
        if max.is_nan() || error <= max {
            max
        } else {
            error
        }
    })
}

/// The source of the cases T.
const TEST_SET: &str = "Cash, Wright and Mazzia, test set for boundary value problem solvers";

/// Two states on 0 ≤ x ≤ 1.
const UNIT: &[Segment] = &[Segment::new(2)];

/// Two states on −1 ≤ x ≤ 1.
const SYMMETRIC: &[Segment] = &[Segment::on(2, -1.0, 1.0)];

/// The conditions y₁ = `left` at the left end of segment 0 and y₁ = `right` at its right end.
fn end_values<T: Real>(at: Ends<'_, T>, left: f64, right: f64, r: &mut [T]) {
    r[0] = at.start(0)[0] - left;
    r[1] = at.end(0)[0] - right;
}

/// The straight line from `left` at x = 0 to `right` at x = 1, and its slope.
fn straight(left: f64, right: f64) -> impl Fn(f64) -> [f64; 2] {
    move |x| [left + (right - left) * x, right - left]
}
