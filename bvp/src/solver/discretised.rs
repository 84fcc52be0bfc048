//! The problem on one mesh after the other: Newton's method on it, the solution, and what its linearisation
//! tells of that.

use crate::accuracy::amplification::is_open;
use crate::accuracy::defect::defects;
use crate::discretisation::iterate::{Iterate, NonFinite};
use crate::discretisation::mesh::{Mesh, intervals};
use crate::discretisation::tableau::Tableau;
use crate::newton::collocation::Collocation;
use crate::newton::failure::Failure;
use crate::newton::newton::Newton;
use crate::newton_matrix::dependence::Dependence;
use crate::problem::held::Held;
use crate::result::error::Error;
use crate::result::quality::{Direction, Quality, Samples};
use crate::result::solution::Solution;
use crate::result::stats::Stats;
use crate::shares::{INVISIBLE, NEGLIGIBLE, TWO_DIGITS, UNNOTICED};
use crate::solver::failure::{ill_conditioned, numerical};
use crate::solver::options::{Control, Options};
use crate::solver::transfer::transfer;
use std::sync::Arc;
use web_time::Instant;

/// A condition whose residual is larger than allowed.
struct Violation {
    condition: usize,
    residual: f64,
    allowed: f64,
}

/// What a solution is on another mesh than its own.
pub(crate) struct OnMesh {
    pub(crate) x: Iterate,
    /// The size of Newton's correction, infinite where there is none.
    pub(crate) correction: f64,
    /// The amplification of forcings, infinite where nothing can be told of it.
    pub(crate) amplification: f64,
}

/// A problem discretised on a mesh.
pub(crate) struct Discretised<'a> {
    pub(crate) equations: &'a Held<'a>,
    pub(crate) options: &'a Options,
    start: Instant,
    pub(crate) stats: Stats,
    pub(crate) collocation: Collocation<'a>,
    pub(crate) newton: Newton,
    /// The defects of the last solution.
    pub(crate) samples: Samples,
}

impl<'a> Discretised<'a> {
    /// Without a mesh yet, by a call that began at `start`.
    pub(crate) fn new(equations: &'a Held<'a>, options: &'a Options, start: Instant) -> Self {
        let tableau = Tableau::of(options.scheme());
        let collocation = Collocation::new(equations.clone(), tableau, vec![]);
        Self {
            equations,
            options,
            start,
            stats: Stats::default(),
            newton: Newton::new(&collocation),
            collocation,
            samples: vec![],
        }
    }

    /// Discretises the problem on a mesh.
    pub(crate) fn set_mesh(&mut self, mesh: Mesh) {
        self.collocation.set_mesh(mesh);
        self.newton.resize(&self.collocation);
    }

    /// Newton's method.
    pub(crate) fn iterate(&mut self, x: &mut Iterate) -> Result<(), Failure> {
        let (wanted, steps) = (self.wanted(), self.options.max_newton_steps);
        self.newton
            .iterate(&mut self.collocation, x, wanted, steps, &mut self.stats)
    }

    /// The solution with its defects and conditions, from a converged iterate; an error where a value is
    /// not finite or a condition is violated.
    pub(crate) fn assess(&mut self, mut x: Iterate) -> Result<Solution, Error> {
        let mut outcome = self.violated(&x);
        if let Ok((_, Some(_))) = outcome {
            // The last step was trusted too far.
            self.newton.curvature = f64::INFINITY;
            if let Err(failure) = self.iterate(&mut x) {
                return Err(self.failed(failure, x));
            }
            outcome = self.violated(&x);
        }
        let assessed = outcome.and_then(|(conditions, violated)| {
            let Collocation { tableau, mesh, .. } = &self.collocation;
            let (samples, stats) = (&mut self.samples, &mut self.stats);
            let defects = defects(self.equations, tableau, mesh, &x, samples, stats)?;
            let quality = Quality {
                defects,
                conditions,
                errors: None,
            };
            Ok((quality, violated))
        });
        match assessed {
            Ok((quality, None)) => Ok(self.solution(x, quality)),
            Ok((quality, Some(violation))) => Err(Error::ConditionViolated {
                condition: violation.condition,
                residual: violation.residual,
                tolerance: violation.allowed,
                best: Box::new(self.solution(x, quality)),
            }),
            Err(what) => {
                let best = self.solution(x, Quality::unknown(&self.collocation.mesh));
                Err(numerical(Failure::NonFinite(what), best, 0.0))
            }
        }
    }

    /// The sizes of the residuals of all conditions, and the first one that is violated.
    fn violated(&mut self, x: &Iterate) -> Result<(Vec<f64>, Option<Violation>), NonFinite> {
        let mut conditions = vec![0.0; self.equations.condition_count()];
        self.collocation.conditions(x, &mut conditions)?;
        conditions.iter_mut().for_each(|r| *r = r.abs());
        let all = conditions.iter().enumerate();
        let sizes = self.collocation.condition_sizes(x);
        let mut violations = all
            .zip(sizes)
            .filter_map(|((condition, &residual), (size, unit))| {
                let allowed = self.options.tolerance * size.max(unit);
                (residual > allowed).then_some(Violation {
                    condition,
                    residual,
                    allowed,
                })
            });
        let first = violations.next();
        Ok((conditions, first))
    }

    /// The size of Newton's correction at a solution.
    pub(crate) fn correction(&mut self, x: &Iterate) -> Result<f64, Failure> {
        let Self {
            newton,
            collocation,
            stats,
            ..
        } = self;
        newton.correction(collocation, x, stats)
    }

    /// The amplification of forcings by the last linearisation.
    pub(crate) fn amplification(&mut self, x: &Iterate) -> f64 {
        let tolerance = self.options.tolerance;
        self.newton
            .amplification(&mut self.collocation, x, tolerance)
    }

    /// The growth of errors of the size of the tolerance by the last linearisation.
    pub(crate) fn growth(&mut self, x: &Iterate) -> f64 {
        let tolerance = self.options.tolerance;
        self.newton.growth(&mut self.collocation, x, tolerance)
    }

    /// The direction of the last amplification.
    pub(crate) fn amplified(&self, x: &Iterate) -> Direction {
        self.newton
            .amplified(&self.collocation, x, self.options.tolerance)
    }

    /// The direction in which a solution with the last defects is not isolated, if so, after its
    /// amplification a. Where the conditions are not finite there is no telling.
    pub(crate) fn direction(&mut self, x: &Iterate, a: f64) -> Option<Direction> {
        let Self {
            newton,
            collocation,
            samples,
            stats,
            ..
        } = self;
        newton.correct_defects(collocation, x, samples).ok()?;
        newton.direction(collocation, x, samples, a, self.options.tolerance, stats)
    }

    /// Whether the last linearisation is that of the iterate to rounding.
    pub(crate) fn is_current(&mut self, x: &Iterate) -> bool {
        let Self {
            newton,
            collocation,
            stats,
            ..
        } = self;
        newton.may_be_current() && (newton.moved == 0.0 || collocation.is_linearised_at(x, stats))
    }

    /// A solution on another mesh; leaves the linearisation there.
    pub(crate) fn on_mesh(&mut self, mesh: Mesh, solution: &Solution) -> OnMesh {
        self.set_mesh(mesh);
        let Self {
            newton,
            collocation,
            samples,
            stats,
            ..
        } = self;
        let (t, mesh) = (&collocation.tableau, &collocation.mesh);
        let x = transfer(mesh, t, solution);
        let correction = match defects(self.equations, t, mesh, &x, samples, stats) {
            Err(_) => f64::INFINITY,
            Ok(_) => newton
                .correction(collocation, &x, stats)
                .unwrap_or(f64::INFINITY),
        };
        let amplification = match correction.is_infinite() {
            true => f64::INFINITY,
            false => newton.amplification(collocation, &x, self.options.tolerance),
        };
        OnMesh {
            x,
            correction,
            amplification,
        }
    }

    /// Whether rounding shows in a solution, or cannot since it vanishes. Where it is negligible, the
    /// amplification is one of slopes in thin layers alone.
    pub(crate) fn rounds(&mut self, solution: &Solution) -> bool {
        let rounding = self.collocation.rounding(&solution.x);
        rounding == 0.0 || rounding.is_nan() || rounding >= NEGLIGIBLE * self.options.tolerance
    }

    /// Whether a solution within the tolerance on its own mesh is so on another one, by its correction
    /// there.
    pub(crate) fn is_kept(&mut self, solution: &Solution, mesh: &Mesh) -> bool {
        self.set_mesh(mesh.clone());
        let Self {
            newton,
            collocation,
            ..
        } = self;
        let x = transfer(mesh, &collocation.tableau, solution);
        let correction = newton.correction(collocation, &x, &mut self.stats);
        correction.is_ok_and(|size| size <= self.options.tolerance)
    }

    /// The error for a failure of Newton's method.
    pub(crate) fn failed(&mut self, failure: Failure, x: Iterate) -> Error {
        let rounding = match failure {
            // Corrections no larger than that are rounding.
            Failure::NoConvergence { correction, .. } if correction <= TWO_DIGITS => {
                Some(self.collocation.rounding(&x)).filter(|&rounding| rounding >= correction)
            }
            _ => None,
        };
        if matches!(failure, Failure::NoConvergence { .. }) && is_open(self.amplification(&x)) {
            let direction = self.amplified(&x);
            let best = self.solution(x, Quality::unknown(&self.collocation.mesh));
            return self.undetermined(Some(f64::INFINITY), direction, best);
        }
        let best = self.solution(x, Quality::unknown(&self.collocation.mesh));
        match rounding {
            Some(rounding) => self.ill_conditioned(rounding, best),
            None => numerical(failure, best, self.wanted()),
        }
    }

    /// The error for a solution that is one of a family, where no rounding is known, or nothing but rounding.
    pub(crate) fn undetermined(
        &self,
        rounding: Option<f64>,
        direction: Direction,
        mut best: Solution,
    ) -> Error {
        let Direction { felt, shift, free } = direction;
        if felt && (shift || rounding.is_none()) {
            best.stats = self.cost();
            return Error::SingularConditions {
                conditions: vec![],
                free,
                shift,
                best: Box::new(best),
            };
        }
        self.ill_conditioned(rounding.unwrap_or(f64::INFINITY), best)
    }

    /// Whether the way to a solution on this mesh was so long that a look on a halved one, with twice as many
    /// Jacobians, does not show beside it. An interface whose place is exponentially ill determined is held by a
    /// coarse mesh at places that depend on the mesh alone; Newton's method finds them after many detours.
    pub(crate) fn struggled(&self, mesh: &Mesh) -> bool {
        let once = self.stages() * intervals(mesh);
        UNNOTICED * self.stats.jacobian_evaluations as f64 > 2.0 * once as f64
    }

    /// The error for a solution of which rounding may change this much.
    pub(crate) fn ill_conditioned(&self, rounding: f64, mut best: Solution) -> Error {
        best.stats = self.cost();
        ill_conditioned(rounding, self.options.tolerance, best)
    }

    /// Refuses a solution that the conditions leave free because they are on what vanishes at a singular end.
    pub(crate) fn refuse_free(&mut self, solution: &Solution) -> Result<(), Error> {
        let stats = &mut self.stats;
        let dependence = self.collocation.free_at_singular_ends(&solution.x, stats);
        if dependence == Dependence::default() {
            return Ok(());
        }
        let mut best = solution.clone();
        best.stats = self.cost();
        Err(numerical(Failure::Ends(dependence), best, self.wanted()))
    }

    /// An iterate on the present mesh as a solution.
    pub(crate) fn solution(&self, x: Iterate, quality: Quality) -> Solution {
        let Collocation { tableau, mesh, .. } = &self.collocation;
        Solution {
            segments: self.equations.segments().to_vec(),
            absolute: vec![],
            tableau: Arc::clone(tableau),
            mesh: mesh.clone(),
            x,
            quality,
            stats: self.cost(),
        }
    }

    /// The cost so far.
    pub(crate) fn cost(&self) -> Stats {
        Stats {
            seconds: self.start.elapsed().as_secs_f64(),
            ..self.stats
        }
    }

    /// Whether the global error is to be known.
    pub(crate) fn estimates(&self) -> bool {
        self.options.control != Control::Defect
    }

    /// Stages m of the scheme.
    pub(crate) fn stages(&self) -> usize {
        self.collocation.tableau.stages
    }

    /// Whether a mesh may be halved within the limit.
    pub(crate) fn may_halve(&self, mesh: &Mesh) -> bool {
        2 * intervals(mesh) <= self.options.max_intervals
    }

    /// How small corrections are to be, no less than what rounding permits.
    fn wanted(&self) -> f64 {
        let fraction = match self.estimates() {
            // What is left of the corrections is in the estimate.
            true => INVISIBLE,
            false => TWO_DIGITS,
        };
        (fraction * self.options.tolerance).max(f64::EPSILON / TWO_DIGITS)
    }
}
