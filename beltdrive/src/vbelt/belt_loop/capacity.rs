//! How much torque one pulley could take from the belt, or give to it, as the belt runs round it in a state.
//!
//! The slack side of the contact keeps its tractive tension, the belt its mass flow, and the spans their
//! directions; the speed of the pulley is free, and its torque rises until no state of the contact has more,
//! or until a driven pulley stands still:
//!
//! ```text
//! F = F_slack on the slack side          x = 0 at entry and exit, φ = 0 and B = 0 (or p B = 0) at entry
//! φ − (θ_out − θ_in) = the angle between the spans          R (F_out cos θ_out − F_in cos θ_in) = λ M
//! ```
//!
//! with the unknown rim speed ν and lengths of the contact, and the logarithm of λ, since a torque may be small beside
//! the largest. On the back of the belt nothing of this depends on the law: it carries R F (exp(μ φ) − 1). Where the
//! curve cannot be followed with the friction of the state itself it is that of bristles (see `stiffening`).

use super::super::belt_problem::{BeltProblem, Zoning, in_groove};
use super::super::groove::{ANGLE, INCLINATION, TENSION};
use super::super::path::{Effort, Solved};
use super::super::{Contact, Groove, Law, Regime, Units};
use super::climb::{limit_accuracy, without_zones};
use super::levelling::Levelling;
use super::pieces::{Curved, LOCKS, Lost, Place};
use super::problem::LoopProblem;
use super::seat::Seat;
use super::solve::Search;
use super::stiffening::{Stiffened, is_followed};
use crate::FrictionLaw;
use crate::results::difficulty;
use bvp::{Ends, Problem, Real, Segment, Solution};

/// Indices of the parameters: the lengths of all zones follow, and the logarithm of λ if it is one.
const RIM_SPEED: usize = 0;
const FIRST_LENGTH: usize = 1;

/// Where the search ends, as multiple of what the slack side carries with all friction along the pulley. Radial
/// friction presses a belt deeper into the groove of a driver: limits of up to four times were seen.
const BEYOND: f64 = 100.0;

/// One groove under a multiple of its torque, scaled.
#[derive(Clone, Debug)]
struct OneGroove {
    groove: Groove,
    units: Units,
    /// Pitch radius, m.
    radius: f64,
    /// The sense of friction.
    sense: f64,
    /// Scaled mass flow.
    flow: f64,
    /// Tension at which the displacement of EPP friction does not grow.
    reference: f64,
    /// Tractive tension on the slack side.
    slack: f64,
    /// Angle between the spans, rad.
    turned: f64,
    /// Change of the tension of the state, F cos θ between exit and entry; positive on a driven pulley.
    change: f64,
    /// The logarithm of λ; unknown where there is none.
    growth: Option<f64>,
    zoning: Zoning,
}

impl OneGroove {
    fn growth<T: Real>(&self, p: &[T]) -> T {
        self.growth
            .map_or_else(|| p[FIRST_LENGTH + self.zoning.count()], T::from_f64)
    }
}

/// The logarithm of λ.
impl Curved for OneGroove {
    fn freed(self) -> Self {
        let growth = None;
        Self { growth, ..self }
    }

    fn held(self, value: f64) -> Self {
        let growth = Some(value);
        Self { growth, ..self }
    }

    fn number(&self, p: &[f64]) -> f64 {
        self.growth(p)
    }
}

impl BeltProblem for OneGroove {
    fn zoning(&self) -> &Zoning {
        &self.zoning
    }

    fn in_groove(&self, _: usize) -> Option<&Groove> {
        Some(&self.groove)
    }

    fn rim_speed<T: Real>(&self, _: usize, p: &[T]) -> T {
        p[RIM_SPEED]
    }

    fn sense(&self, _: usize) -> f64 {
        self.sense
    }

    fn flow<T: Real>(&self, _: &[T]) -> T {
        T::from_f64(self.flow)
    }

    fn first_length(&self) -> usize {
        FIRST_LENGTH
    }

    fn behind_lengths(&self, solution: &Solution) -> f64 {
        self.growth(solution.parameters())
    }

    fn constants(&self, solution: &Solution) -> Vec<f64> {
        let p = solution.parameters();
        vec![self.omega(0, p), self.contact_length(0, p)]
    }

    fn pitch_radius(&self, _: usize) -> f64 {
        self.radius
    }

    fn units(&self) -> Units {
        self.units
    }

    fn with_zones(self, zones: &[Vec<Regime>]) -> Self {
        let zoning = Zoning::new(zones);
        Self { zoning, ..self }
    }

    fn with_laws(mut self, change: impl Fn(Law, f64) -> Law) -> Self {
        self.groove.law = change(self.groove.law, self.radius);
        self
    }
}

impl Problem for OneGroove {
    fn segments(&self) -> Vec<Segment> {
        vec![Segment::new(self.groove.states()); self.zoning.count()]
    }

    fn parameters(&self) -> usize {
        FIRST_LENGTH + self.zoning.count() + usize::from(self.growth.is_none())
    }

    fn condition_count(&self) -> usize {
        (self.groove.states() + 1) * self.zoning.count() + FIRST_LENGTH
    }

    fn rhs<T: Real>(&self, segment: usize, _s: T, y: &[T], p: &[T], dy: &mut [T]) {
        let (regime, flow) = (self.regime(segment), self.flow(p));
        let contact = Contact::new(&self.groove, regime, y, self.rim_speed(0, p), flow);
        contact.rates(&self.groove, y, dy);
        if self.groove.elastic().is_some() {
            dy[self.groove.displacement()] -= self.reference;
        }
        let length = self.length(segment, p);
        for rate in dy {
            *rate *= length;
        }
    }

    fn depends(&self, segment: usize, parameter: usize) -> bool {
        [RIM_SPEED, FIRST_LENGTH + segment].contains(&parameter)
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, p: &[T], r: &mut [T]) {
        let (entry, exit) = (at.start(0), at.end(self.zoning.count() - 1));
        let slack_side = if self.change > 0.0 { entry } else { exit };
        let pull = |end: &[T]| end[TENSION] * end[INCLINATION].cos();
        let own = [
            slack_side[TENSION] - self.slack,
            exit[ANGLE] - (exit[INCLINATION] - entry[INCLINATION]) - self.turned,
            pull(exit) - pull(entry) - self.growth(p).exp() * self.change,
        ];
        let (own_residuals, others) = r.split_at_mut(own.len());
        own_residuals.copy_from_slice(&own);
        let mut others = others.iter_mut();
        in_groove(self, (0, &self.groove), &at, p, |value| {
            if let Some(residual) = others.next() {
                *residual = value;
            }
        });
    }
}

/// The largest multiple of a torque, and the states on the way.
type Largest = (f64, Vec<Solved<OneGroove>>);

/// The contact with a pulley of a state, as it is with λ = 1.
struct OfState<'s> {
    solved: &'s Solved<LoopProblem>,
    pulley: usize,
}

impl OfState<'_> {
    /// The segment of the loop that is one of the contact.
    fn of_loop(&self, segment: usize) -> usize {
        self.solved.problem.zones(self.pulley).start + segment
    }
}

impl bvp::Guess for OfState<'_> {
    fn state(&self, segment: usize, s: f64, y: &mut [f64]) {
        let mut states = [0.0; super::super::MAX_STATES];
        let solution = &self.solved.solution;
        let segment = self.of_loop(segment);
        let known = solution.segments()[segment].states;
        solution.state(segment, s, &mut states[..known]);
        y.copy_from_slice(&states[..y.len()]);
    }

    fn parameters(&self, p: &mut [f64]) {
        let (problem, known) = (&self.solved.problem, self.solved.solution.parameters());
        p[RIM_SPEED] = problem.rim_speed(self.pulley, known);
        let zones = problem.zones(self.pulley);
        for (length, segment) in p[FIRST_LENGTH..].iter_mut().zip(zones) {
            *length = problem.length(segment, known);
        }
    }

    fn mesh(&self) -> Option<Vec<Vec<f64>>> {
        let Solved { problem, solution } = self.solved;
        let zones = problem.zones(self.pulley);
        Some(
            zones
                .map(|segment| solution.mesh(segment).to_vec())
                .collect(),
        )
    }
}

impl Search<'_> {
    /// The largest torque of a pulley over that of a state, with its error; `None` if it has none or the largest was
    /// not found. It is sought with the friction of the state if that can be followed, else from rough states of the same
    /// loop.
    pub(super) fn torque_margin<'r>(
        &mut self,
        state: &Solved<LoopProblem>,
        pulley: usize,
        rough: impl FnOnce(&mut Self) -> Option<&'r Stiffened>,
    ) -> Option<[f64; 2]> {
        if is_followed(state) {
            let is_elastic = matches!(self.drive.law, FrictionLaw::Epp { .. });
            match self.torque_margin_as(state, pulley, state) {
                Ok(margin) => return margin,
                // Bristles are softer than elastic friction that holds the belt so: with 1e9 N/m² `v-power` at 3000 W has margins of
                // 5.5 and 8.7 with two of them.
                Err(Lost { cause: LOCKS, .. }) if is_elastic => return None,
                Err(_) => {}
            }
        }
        let rough = rough(self)?;
        let follows_law = self.follows_law();
        let mut with = |rough: &_| self.torque_margin_as(state, pulley, rough).ok().flatten();
        match follows_law {
            true => with(rough.softest()),
            false => rough.value(|rough| with(rough).map(|[margin, _]| margin)),
        }
    }

    /// The same with friction as it is in one state of the same loop, near the end with sharper friction, if it is a vector that
    /// sets in gradually; `None` if the curve has no largest torque, lost if it is not followed to its end.
    fn torque_margin_as(
        &mut self,
        state: &Solved<LoopProblem>,
        pulley: usize,
        like: &Solved<LoopProblem>,
    ) -> Result<Option<[f64; 2]>, Lost> {
        let problem = &state.problem;
        if problem.is_idle(pulley) {
            return Ok(None);
        }
        let p = state.solution.parameters();
        let coordinate = problem.coordinate(p);
        let ends = state.round(|round| round.end_angles());
        let [entry, exit] = [state.entry(pulley), state.exit(pulley)];
        let change =
            exit[TENSION] * ends[pulley].exit.cos() - entry[TENSION] * ends[pulley].entry.cos();
        if change == 0.0 {
            return Ok(None);
        }
        let slack = if change > 0.0 { entry } else { exit }[TENSION];
        let turned = problem.plane.lay(coordinate, &ends).turned[pulley];
        let capstan = |friction: f64| slack * (friction * turned).exp_m1() / change.abs();
        let groove = match like.problem.seats[pulley] {
            Seat::Groove(groove) => groove,
            Seat::Back(back) => {
                let margin = capstan(back.friction_coefficient);
                return Ok(Some([margin, limit_accuracy(self.tolerance) * margin]));
            }
            Seat::Idle => return Ok(None),
        };
        let to = BEYOND * capstan(groove.friction_coefficient / groove.sin_beta);
        let one = OneGroove {
            groove,
            units: problem.units,
            radius: problem.pitch_radius(pulley),
            sense: problem.sense(pulley),
            flow: problem.flow(p),
            reference: problem.reference(p),
            slack,
            turned,
            change,
            growth: Some(0.0),
            zoning: Zoning::new(&like.problem.regimes()[pulley..=pulley]),
        };
        let near = OfState {
            solved: like,
            pulley,
        };
        let begin = self.attempt(one, &near, Effort::Rough);
        let begin = begin.map_err(|error| Lost {
            reached: 1.0,
            cause: difficulty::of_solver(&error),
        })?;
        let Some((mut margin, mut below)) = self.largest_torque(&begin, to)? else {
            return Ok(None);
        };
        let mut error = limit_accuracy(self.tolerance) + without_zones(begin.problem.law());
        while let Some(sharper) = self.sharper_below(&below)
            && let Ok(Some((sharp, of_curve))) = self.largest_torque(&sharper, to)
        {
            let of_law = self.error_by_sharper(sharper.problem.law(), [margin, sharp]);
            error = of_law.unwrap_or(error);
            (margin, below) = (sharp, of_curve);
        }
        Ok(Some([margin, error * margin]))
    }

    /// The largest multiple of its torque on a curve of one groove, up to a largest one, and the states on the way; `None` if none is
    /// the largest, lost if the curve is not followed to its end.
    fn largest_torque(
        &mut self,
        begin: &Solved<OneGroove>,
        to: f64,
    ) -> Result<Option<Largest>, Lost> {
        let (mut levelling, mut below) = (Levelling::default(), Vec::new());
        let within = [-1.0, to.ln()];
        let margin = self.along(begin, within, &[RIM_SPEED], |_, place, point, here| {
            let growth = match place {
                Place::LimitPoint | Place::Zero(_) => Some(point.lambda()),
                Place::End => return Some(None),
                Place::Way => levelling.top(point, 1.0),
            };
            if growth.is_none() {
                below.push(here);
            }
            growth.map(|growth| Some(growth.exp()))
        });
        Ok(margin?.map(|margin| (margin, below)))
    }
}
