//! One random problem with what is known of its solutions, and the verdict on an attempt to solve it.

use crate::draw::Draw;
use bvp::{Ends, Equations, Error, Function, Guess, Options, Problem, Real, Segment, solve};
use reference_problems::FALSE_FROM;
use std::fmt::Write;
use std::panic::{AssertUnwindSafe, catch_unwind};

/// Equal steps of every segment at whose ends errors are measured.
const STEPS: u32 = 200;

/// States as a function of the segment and s, and parameters.
pub(crate) type Known = Box<dyn Guess + Send + Sync>;

/// A problem, its guess and its solutions.
pub(crate) struct Trial {
    /// The formula.
    pub(crate) kind: &'static str,
    /// Its numbers, for a reader.
    pub(crate) numbers: String,
    pub(crate) equations: Box<dyn Equations + Send + Sync>,
    pub(crate) guess: Known,
    pub(crate) truth: Truth,
    /// Places of segment 0, beside equal steps, where errors are measured.
    pub(crate) places: Vec<f64>,
}

/// The error of a candidate, relative to 1 + |y|.
pub(crate) type Measure = dyn Fn(&dyn Guess) -> f64 + Send + Sync;

/// What is known of the solutions of a problem.
pub(crate) enum Truth {
    /// All isolated solutions: none where there is no solution or only families of them.
    Only(Vec<Known>),
    /// One isolated solution; there may be others.
    OneOf(Known),
    /// The error of a candidate.
    Measured(Box<Measure>),
}

/// What came of a trial.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Verdict {
    /// A true solution.
    Solved,
    /// Not the known solution but, as far as another scheme at a smaller tolerance tells, another one.
    Another,
    /// An error: the name of its variant.
    Refused(String),
    /// A success that is wrong: its true error relative to 1 + |y|, infinite where there is no solution.
    False(f64),
    /// A panic.
    Panic,
}

/// A right-hand side and conditions for one segment.
pub(crate) trait Formula: Send + Sync + 'static {
    /// `dy` = f(x, y, p).
    fn slope<T: Real>(&self, x: f64, y: &[T], p: &[T], dy: &mut [T]);
    /// `r` = g(y(a), y(b), p).
    fn residual<T: Real>(&self, a: &[T], b: &[T], p: &[T], r: &mut [T]);
}

/// A formula on its segment, with a number of parameters.
pub(crate) struct OnSegment<F> {
    formula: F,
    segment: Segment,
    parameters: usize,
}

impl<F: Formula> OnSegment<F> {
    pub(crate) fn new(
        formula: F,
        states: usize,
        from: f64,
        to: f64,
        parameters: usize,
    ) -> Box<Self> {
        Box::new(Self {
            formula,
            segment: Segment::on(states, from, to),
            parameters,
        })
    }
}

impl<F: Formula> Problem for OnSegment<F> {
    fn segments(&self) -> Vec<Segment> {
        vec![self.segment.clone()]
    }

    fn parameters(&self) -> usize {
        self.parameters
    }

    fn rhs<T: Real>(&self, _segment: usize, s: T, y: &[T], p: &[T], dy: &mut [T]) {
        self.formula.slope(s.value(), y, p, dy);
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, p: &[T], r: &mut [T]) {
        self.formula.residual(at.start(0), at.end(0), p, r);
    }
}

/// States that are a function of x, without parameters.
pub(crate) fn known<const N: usize>(f: impl Fn(f64) -> [f64; N] + Send + Sync + 'static) -> Known {
    known_with(vec![], f)
}

/// States that are a function of x, and parameters.
pub(crate) fn known_with<const N: usize>(
    parameters: Vec<f64>,
    f: impl Fn(f64) -> [f64; N] + Send + Sync + 'static,
) -> Known {
    let state = move |_: usize, x: f64| f(x);
    Box::new(Function { state, parameters })
}

/// A guess: zero, constants of a size, or an exact solution with a smooth error of up to that size.
pub(crate) fn some_guess<const N: usize>(
    draw: &mut Draw,
    size: f64,
    exact: impl Fn(f64) -> [f64; N] + Send + Sync + 'static,
) -> Known {
    match draw.below(3) {
        0 => known(move |_| [0.0; N]),
        1 => {
            let constants: [f64; N] = std::array::from_fn(|_| size * draw.between(-1.0, 1.0));
            known(move |_| constants)
        }
        _ => {
            let amplitudes: [f64; N] = std::array::from_fn(|_| size * draw.between(-1.0, 1.0));
            let phase = draw.between(0.0, 6.0);
            known(move |x| -> [f64; N] {
                let y = exact(x);
                std::array::from_fn(|i| y[i] + amplitudes[i] * (3.0 * x + phase + i as f64).sin())
            })
        }
    }
}

impl Trial {
    /// Solves the problem and judges what is returned.
    pub(crate) fn attempt(&self, tolerance: f64) -> Verdict {
        let options = Options::to(tolerance);
        let solved = || match solve(&*self.equations, &*self.guess, &options) {
            Ok(solution) => self.judge(&solution, tolerance),
            Err(error) => Verdict::Refused(name(&error)),
        };
        catch_unwind(AssertUnwindSafe(solved)).unwrap_or(Verdict::Panic)
    }

    /// The number of its segments.
    pub(crate) fn segments(&self) -> usize {
        self.equations.shape().segments.len()
    }

    /// The verdict on a returned solution.
    pub(crate) fn judge(&self, solution: &dyn Guess, tolerance: f64) -> Verdict {
        let error = self.true_error(solution);
        if error <= FALSE_FROM * tolerance {
            Verdict::Solved
        } else if matches!(self.truth, Truth::OneOf(_)) && self.is_another(solution, tolerance) {
            Verdict::Another
        } else {
            Verdict::False(error)
        }
    }

    /// The distance of a candidate from the nearest isolated solution; infinite where there is none.
    fn true_error(&self, found: &dyn Guess) -> f64 {
        match &self.truth {
            Truth::Only(all) => {
                let distances = all.iter().map(|exact| self.distance(found, &**exact));
                distances.fold(f64::INFINITY, f64::min)
            }
            Truth::OneOf(exact) => self.distance(found, &**exact),
            Truth::Measured(error) => error(found),
        }
    }

    /// Whether the candidate stays what it is at a far smaller tolerance by another scheme.
    fn is_another(&self, found: &dyn Guess, tolerance: f64) -> bool {
        let sharper = (1e-3 * tolerance).max(1e-11);
        let options = Options {
            tolerance: sharper,
            scheme: Options::to(sharper).scheme,
            ..Options::default()
        };
        solve(&*self.equations, found, &options)
            .is_ok_and(|again| self.distance(found, &again) <= FALSE_FROM * tolerance)
    }

    /// max |y − z| / (1 + |z|) over the places, all states and parameters; NaN counts as infinite.
    fn distance(&self, y: &dyn Guess, z: &dyn Guess) -> f64 {
        let mut largest = 0.0f64;
        let mut compare = |y: &[f64], z: &[f64]| {
            for (y, z) in y.iter().zip(z) {
                let error = (y - z).abs() / (1.0 + z.abs());
                largest = largest.max(if error.is_nan() { f64::INFINITY } else { error });
            }
        };
        let shape = self.equations.shape();
        for (index, segment) in shape.segments.iter().enumerate() {
            let length = segment.to - segment.from;
            let steps =
                (0..=STEPS).map(|i| segment.from + length * f64::from(i) / f64::from(STEPS));
            let special = self.places.iter().copied().filter(|_| index == 0);
            let (mut of_y, mut of_z) = (vec![0.0; segment.states], vec![0.0; segment.states]);
            for s in steps.chain(special) {
                let s = s.clamp(segment.from, segment.to);
                y.state(index, s, &mut of_y);
                z.state(index, s, &mut of_z);
                compare(&of_y, &of_z);
            }
        }
        let k = shape.parameters;
        let (mut of_y, mut of_z) = (vec![0.0; k], vec![0.0; k]);
        y.parameters(&mut of_y);
        z.parameters(&mut of_z);
        compare(&of_y, &of_z);
        largest
    }
}

/// The name of the variant of an error.
fn name(error: &Error) -> String {
    /// Takes letters up to the first other character.
    struct Letters(String);
    impl Write for Letters {
        fn write_str(&mut self, text: &str) -> std::fmt::Result {
            let letters = text.chars().take_while(|c| c.is_alphabetic());
            let before = self.0.len();
            self.0.extend(letters);
            if self.0.len() - before < text.len() {
                Err(std::fmt::Error)
            } else {
                Ok(())
            }
        }
    }
    let mut letters = Letters(String::new());
    // It ends with an error on purpose, before the iterate is written out.
    let _ = write!(letters, "{error:?}");
    letters.0
}
