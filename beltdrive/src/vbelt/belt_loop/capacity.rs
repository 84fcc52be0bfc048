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
//! with the unknown speed ω and length L of the contact, and the logarithm of λ, since a torque may be small beside
//! the largest. On the back of the belt nothing of this depends on
//! the law: it carries R F (exp(μ φ) − 1). The curve is that of bristles where friction is Coulomb's or EPP
//! (see `stiffening`).

use super::super::groove::{ANGLE, INCLINATION, LAW, PENETRATION, TENSION};
use super::super::path::Solved;
use super::super::vector::Yielding;
use super::super::{BeltProblem, Contact, Groove, Regime};
use super::climb::{followed, on_the_way};
use super::levelling::Levelling;
use super::problem::LoopProblem;
use super::seat::Seat;
use super::stiffening::Stiffened;
use super::unknowns::FLOW;
use bvp::{Ends, Family, Problem, Real, Segment};
use continuation::{Branch, Direction, Kind};

/// Indices of the parameters.
const SPEED: usize = 0;
const LENGTH: usize = 1;
const GROWTH: usize = 2;

/// Where the search ends, as multiple of what the slack side carries with all friction along the pulley. Radial
/// friction presses a belt deeper into the groove of a driver: limits of up to four times were seen.
const BEYOND: f64 = 100.0;

/// One groove under a multiple of its torque, scaled.
#[derive(Clone, Debug)]
struct OneGroove {
    groove: Groove,
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
}

impl Problem for OneGroove {
    fn segments(&self) -> Vec<Segment> {
        vec![Segment::new(self.groove.states())]
    }

    fn parameters(&self) -> usize {
        GROWTH + 1
    }

    fn condition_count(&self) -> usize {
        self.groove.states() + GROWTH
    }

    fn rhs<T: Real>(&self, _segment: usize, _s: T, y: &[T], p: &[T], dy: &mut [T]) {
        let flow = T::from_f64(self.flow);
        let contact = Contact::new(&self.groove, Regime::Either, y, p[SPEED], flow);
        contact.rates(&self.groove, y, dy);
        if self.groove.elastic().is_some() {
            dy[self.groove.displacement()] -= self.reference;
        }
        for rate in dy {
            *rate *= p[LENGTH];
        }
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, p: &[T], r: &mut [T]) {
        let (entry, exit) = (at.start(0), at.end(0));
        let slack_side = if self.change > 0.0 { entry } else { exit };
        let pull = |end: &[T]| end[TENSION] * end[INCLINATION].cos();
        let fixed = [
            slack_side[TENSION] - self.slack,
            entry[PENETRATION],
            exit[PENETRATION],
            entry[ANGLE],
            exit[ANGLE] - (exit[INCLINATION] - entry[INCLINATION]) - self.turned,
            pull(exit) - pull(entry) - p[GROWTH].exp() * self.change,
        ];
        let flow = T::from_f64(self.flow);
        let contact = Contact::new(&self.groove, Regime::Either, entry, p[SPEED], flow);
        let entering = Yielding::new(&contact, &self.groove, entry).map(|vector| vector.entering());
        let law = match &entering {
            Some(entering) => entering.as_slice(),
            None => &entry[LAW..],
        };
        for (residual, value) in r.iter_mut().zip(fixed.iter().chain(law)) {
            *residual = *value;
        }
    }
}

/// The contact of a state that has one zone on every pulley, as it is with λ = 1.
struct OfState<'s> {
    solved: &'s Solved<LoopProblem>,
    pulley: usize,
}

impl bvp::Guess for OfState<'_> {
    fn state(&self, _segment: usize, s: f64, y: &mut [f64]) {
        let mut states = [0.0; super::super::MAX_STATES];
        let Solved { problem, solution } = self.solved;
        let segment = problem.zones(self.pulley).start;
        let known = solution.segments()[segment].states;
        solution.state(segment, s, &mut states[..known]);
        y.copy_from_slice(&states[..y.len()]);
    }

    fn parameters(&self, p: &mut [f64]) {
        let (problem, known) = (&self.solved.problem, self.solved.solution.parameters());
        p[SPEED] = problem.omega(self.pulley, known);
        p[LENGTH] = problem.contact_length(self.pulley, known);
        p[GROWTH] = 0.0;
    }

    fn mesh(&self) -> Option<Vec<Vec<f64>>> {
        let Solved { problem, solution } = self.solved;
        let segment = problem.zones(self.pulley).start;
        Some(vec![solution.mesh(segment).to_vec()])
    }
}

impl Solved<LoopProblem> {
    /// The largest torque of a pulley over that of the state, with its error; `None` if it has none or the largest was
    /// not found. It is sought from rough states of the same loop.
    pub(super) fn torque_margin(
        &self,
        pulley: usize,
        rough: &Stiffened,
        tolerance: f64,
    ) -> Option<[f64; 2]> {
        rough.value(|rough| self.torque_margin_as(pulley, rough, tolerance))
    }

    /// The same with friction as it is in one rough state.
    fn torque_margin_as(&self, pulley: usize, rough: &Self, tolerance: f64) -> Option<f64> {
        let problem = &self.problem;
        if problem.is_idle(pulley) {
            return None;
        }
        let p = self.solution.parameters();
        let coordinate = problem.coordinate(p);
        let ends = self.round(|round| round.end_angles());
        let [entry, exit] = [self.entry(pulley), self.exit(pulley)];
        let change =
            exit[TENSION] * ends[pulley].exit.cos() - entry[TENSION] * ends[pulley].entry.cos();
        if change == 0.0 {
            return None;
        }
        let slack = if change > 0.0 { entry } else { exit }[TENSION];
        let turned = problem.plane.lay(coordinate, &ends).turned[pulley];
        let capstan = |friction: f64| slack * (friction * turned).exp_m1() / change.abs();
        let groove = match rough.problem.seats[pulley] {
            Seat::Groove(groove) => groove,
            Seat::Back(back) => return Some(capstan(back.friction_coefficient)),
            Seat::Idle => return None,
        };
        let to = BEYOND * capstan(groove.friction_coefficient / groove.sin_beta);
        let one = OneGroove {
            groove,
            flow: p[FLOW],
            reference: problem.reference(p),
            slack,
            turned,
            change,
        };
        let options = on_the_way(tolerance, groove.law);
        let guess = OfState {
            solved: rough,
            pulley,
        };
        let (mut family, z) = Family::new(&one, GROWTH, &[], &guess, &options).ok()?;
        let within = followed([-1.0, to.ln()], &options, groove.law, 0);
        let branch = Branch::new(&mut family, &z, Direction::Increasing, &within).ok()?;
        let branch = branch.event(|_, point| point.z[point.z.len() - 1 - GROWTH + SPEED]);
        let mut levelling = Levelling::default();
        for point in branch {
            match point.kind {
                Kind::LimitPoint | Kind::Event(_) => return Some(point.lambda().exp()),
                Kind::Bound => return None,
                _ => {
                    if let Some(limit) = levelling.top(&point, 1.0) {
                        return Some(limit.exp());
                    }
                }
            }
        }
        None
    }
}
