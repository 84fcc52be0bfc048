//! How far a drive can be loaded: approaching a load from a smaller one, and the end of the range.
//!
//! Along the branch of steady states that begins without load, the tight tension rises with the
//! contact length of the driver until one of three things happens:
//!
//! - the speed of the driven pulley falls to zero: it slips grossly;
//! - the tension has a maximum at small inclination: the driver slips grossly;
//! - the tension has a maximum where the belt overhangs at the exit of the driver.
//!
//! A maximum of the tension is a limit point, at which the tension cannot be prescribed; the
//! contact length of the driver can, so near it that is prescribed and the tension is an unknown. Where the
//! driver slips grossly the length may have its maximum at nearly the same place; the speed of the driven pulley
//! falls all the way, and takes its part.

use super::carried::Carried;
use super::creep::{CREEP, begins_at_rest};
use super::path::{Effort, Path, Solved, Stuck};
use super::{ANGLE, DRIVEN, DRIVER, DriveProblem, INCLINATION, Instead, TENSION};
use crate::{FrictionLaw, LimitReason};

/// Smaller loads from which the load is approached: shares of the way from slack to tight tension,
/// in logarithms.
const SMALLER_LOADS: [f64; 5] = [0.75, 0.55, 0.35, 0.2, 0.08];
/// Larger loads from which it is approached: multiples of the tight tension.
const LARGER_LOADS: [f64; 3] = [1.5, 2.5, 5.0];
/// Below this ratio of tight to slack tension the belt hardly slips, which makes a load harder to
/// find than a larger one.
const LOW_RATIO: f64 = 2.0;
/// First step of the approach, in the logarithm of the tight tension.
const LOAD_STEP: f64 = 0.1;
/// First step in the logarithm of the contact length of the driver.
const LENGTH_STEP: f64 = 0.01;
/// Steps in that length before the search is given up.
const MAX_LENGTH_STEPS: usize = 200;
/// Where the belt leaves the driver more steeply than this, or the driven pulley loses more than this
/// share of its speed, a state may lie beyond a limit point.
const STEEP: f64 = 1.3;
const SLOW: f64 = 0.5;
/// Step in the logarithm of the contact length that tells on which side.
const SIDE_STEP: f64 = 1e-4;
/// Rough states with larger differences of their constants from a state are others: that of the drive of Kim (2009) at 7000 N
/// comes back with 3e-7, and speeds of other states differed by 0.03.
const SAME: f64 = 1e-3;
/// Relative accuracy of a limit.
const LIMIT_ACCURACY: f64 = 1e-7;

/// The end of the load range.
#[derive(Clone, Debug)]
pub(super) struct Limit {
    pub(super) reason: LimitReason,
    /// The state at the end.
    pub(super) state: Solved,
}

/// What is prescribed in place of the tension, and rises along the branch.
#[derive(Clone, Copy, Debug)]
pub(super) enum Coordinate {
    /// The contact length of the driver.
    DriverLength,
    /// The speed of the driven pulley with the sign turned round.
    DrivenSpeed,
}

impl Coordinate {
    /// Its value in a state.
    fn of(self, solved: &Solved) -> f64 {
        match self {
            Self::DriverLength => solved.driver_length(),
            Self::DrivenSpeed => -solved.driven_speed(),
        }
    }

    /// The value farther along by a step in its logarithm.
    pub(super) fn beyond(self, solved: &Solved, step: f64) -> f64 {
        let value = self.of(solved);
        match self {
            Self::DriverLength => value * step.exp(),
            Self::DrivenSpeed => value * (-step).exp(),
        }
    }

    fn instead(self, value: f64) -> Instead {
        match self {
            Self::DriverLength => Instead::DriverLength(value),
            Self::DrivenSpeed => Instead::DrivenSpeed(-value),
        }
    }
}

/// The outcome of a search at one load.
pub(super) enum Found {
    /// A steady state.
    State(Box<Solved>),
    /// There is none: the load lies beyond the end of the range.
    Beyond(Box<Limit>),
}

impl Path<'_> {
    /// The steady state at the scaled tight tension `target`, or the limit that it exceeds.
    pub(super) fn find(&mut self, target: f64) -> Result<Found, Stuck> {
        let direct = match self.at_load(target) {
            Ok(solved) if self.is_before_limit(&solved) => return self.classify(solved),
            // Zones change on the way from one load to another.
            Err(stuck) if matches!(self.drive.law, FrictionLaw::VectorEpp { .. }) => {
                return Err(stuck);
            }
            // The effect of ℓ or ε belongs to the state.
            beyond_or_stuck => beyond_or_stuck.map(|solved| (solved, self.smoothing_effect)),
        };
        let slack = self.slack();
        let ratio = target / slack;
        let smaller = SMALLER_LOADS.map(|share| slack * ratio.powf(share));
        let larger = LARGER_LOADS.map(|factor| target * factor);
        let others = if ratio < LOW_RATIO {
            [larger.as_slice(), &smaller].concat()
        } else {
            [smaller.as_slice(), &larger].concat()
        };
        for load in others {
            let Ok(solved) = self.at_load(load) else {
                continue;
            };
            match self.classify(solved)? {
                Found::State(solved) => {
                    if self.is_below_limit(&solved) {
                        self.reached = self.reached.max(load);
                    }
                    if let Ok(found) = self.approach(*solved, target)
                        && !self.is_refuted(&found)
                    {
                        return Ok(found);
                    }
                }
                // The range ends between the two loads.
                beyond if load <= target && !self.is_refuted(&beyond) => return Ok(beyond),
                Found::Beyond(_) => {}
            }
        }
        // Nothing, or only a state beyond the limit point.
        let (solved, effect) = direct?;
        self.smoothing_effect = effect;
        self.classify(solved)
    }

    /// Whether what was found is a limit below a load under which a state is known: with scalar elastic friction the way from a
    /// lighter load may end where the zones of a belt that sticks change, and others lead on.
    fn is_refuted(&self, found: &Found) -> bool {
        match found {
            Found::State(_) => false,
            Found::Beyond(limit) => limit.state.tight_tension() < self.reached,
        }
    }

    /// Whether the branch can be followed from a state up to its limit.
    pub(super) fn is_below_limit(&mut self, solved: &Solved) -> bool {
        !may_be_another(solved) && self.is_before_limit(solved)
    }

    /// Whether a rising load leads from rest to a state that may be another: lowered until the state may not, by which the
    /// driven pulley becomes faster with every step, it leads back to it.
    pub(super) fn is_reached(&mut self, solved: &Solved) -> bool {
        let target = solved.tight_tension().ln();
        let member = |problem: &DriveProblem, t: f64| problem.clone().with_tight_tension(t.exp());
        let (mut here, mut load) = (solved.clone(), target);
        while self.slack().ln() < load - LOAD_STEP {
            let (range, speed) = ([load, load - LOAD_STEP], here.driven_speed());
            let Ok(lower) = self.follow(here, range, LOAD_STEP, Effort::Rough, member) else {
                return false;
            };
            if lower.driven_speed() <= speed {
                return false;
            }
            if load == target && !slips_far(solved) && self.creeps_from_rest([&lower, solved]) {
                return true;
            }
            (here, load) = (lower, load - LOAD_STEP);
            if self.is_below_limit(&here) {
                let back = self.follow(here, [load, target], LOAD_STEP, Effort::Rough, member);
                return back.is_ok_and(|back| back.change_to(&solved.constants()) <= SAME);
            }
        }
        false
    }

    /// Whether the slip of the driver, through two states on a line over the tension, begins at rest.
    fn creeps_from_rest(&self, states: [&Solved; 2]) -> bool {
        let slips = states.map(|state| least_slip(state, DRIVER));
        begins_at_rest(slips, states.map(Solved::tight_tension), self.slack())
    }

    /// Whether the tension rises with the contact length of the driver, as it does from no load to
    /// the first limit point. Looked at only where a limit point can be near.
    pub(super) fn is_before_limit(&mut self, solved: &Solved) -> bool {
        let steep = solved.exit(DRIVER)[INCLINATION] > STEEP;
        if !steep && !is_slow(solved) {
            return true;
        }
        let coordinate = Coordinate::DriverLength;
        let longer = coordinate.beyond(solved, SIDE_STEP);
        match self.at(coordinate, longer, solved, Effort::Careful) {
            Ok(longer) => longer.tight_tension() > solved.tight_tension(),
            Err(_) => true,
        }
    }

    /// A state, unless the driven pulley does not turn with the belt: then the load at which it
    /// stops.
    pub(super) fn classify(&mut self, solved: Solved) -> Result<Found, Stuck> {
        if solved.driven_speed() > 0.0 {
            return Ok(Found::State(Box::new(solved)));
        }
        let range = [solved.driven_speed(), 0.0];
        let stopped = self.follow(solved, range, 0.5, Effort::Full, |problem, speed| {
            let instead = Instead::DrivenSpeed(speed);
            problem.clone().with_unknown_tight_tension(instead)
        })?;
        Ok(Found::Beyond(Box::new(Limit {
            reason: LimitReason::DrivenSlips,
            state: stopped,
        })))
    }

    /// Changes the load of a state to `target`, around a limit point if there is one on the way up.
    fn approach(&mut self, start: Solved, target: f64) -> Result<Found, Stuck> {
        match self.with_load(start, target, Effort::Careful) {
            Ok(solved) => {
                let solved = self.finish(solved)?;
                self.classify(solved)
            }
            Err(Stuck {
                last: Some(last), ..
            }) if last.driven_speed() > 0.0 && last.tight_tension() < target => {
                let outcome = self.lengthen(Coordinate::DriverLength, (*last).clone(), target);
                outcome.or_else(|_| self.lengthen(Coordinate::DrivenSpeed, *last, target))
            }
            Err(Stuck {
                last: Some(last), ..
            }) if last.driven_speed() <= 0.0 => self.classify(*last),
            Err(stuck) => Err(stuck),
        }
    }

    /// A state with another scaled tight tension, in steps.
    pub(super) fn with_load(
        &mut self,
        start: Solved,
        tight: f64,
        effort: Effort,
    ) -> Result<Solved, Stuck> {
        let range = [start.tight_tension().ln(), tight.ln()];
        let member = |problem: &DriveProblem, t: f64| problem.clone().with_tight_tension(t.exp());
        self.follow(start, range, LOAD_STEP, effort, member)
    }

    /// Follows the branch by another coordinate until the tension reaches `target`, or has passed its
    /// maximum, or the driven pulley stops.
    fn lengthen(
        &mut self,
        coordinate: Coordinate,
        start: Solved,
        target: f64,
    ) -> Result<Found, Stuck> {
        let (mut before, mut here) = (None, start);
        let mut step = LENGTH_STEP;
        for _ in 0..MAX_LENGTH_STEPS {
            let beyond = coordinate.beyond(&here, step);
            let next = match self.at(coordinate, beyond, &here, Effort::Careful) {
                Ok(next) => next,
                Err(_) if step > 1e-3 * LENGTH_STEP => {
                    step *= 0.4;
                    continue;
                }
                Err(cause) => return Err(Stuck::after(here, cause)),
            };
            if next.driven_speed() <= 0.0 {
                return self.classify(next);
            }
            if next.tight_tension() >= target {
                return self.arrive(next, target);
            }
            if next.tight_tension() < here.tight_tension() {
                let shorter = coordinate.beyond(&here, -step);
                let first = match before {
                    Some(before) => before,
                    // The very first step has passed the maximum.
                    None => self
                        .at(coordinate, shorter, &here, Effort::Careful)
                        .map_err(|cause| Stuck::after(here.clone(), cause))?,
                };
                return self.maximum(coordinate, [first, here, next]);
            }
            step *= 1.3;
            before = Some(std::mem::replace(&mut here, next));
        }
        self.arrive(here, target)
    }

    /// The state at the load `target`, from a neighbour.
    fn arrive(&mut self, from: Solved, target: f64) -> Result<Found, Stuck> {
        let problem = from.problem.clone().with_tight_tension(target);
        let solved = self
            .attempt(problem, &Carried(&from), Effort::Careful)
            .map_err(|cause| Stuck::after(from, cause))?;
        let solved = self.finish(solved)?;
        self.classify(solved)
    }

    /// The state with another value of a coordinate, from a neighbour.
    pub(super) fn at(
        &mut self,
        coordinate: Coordinate,
        value: f64,
        from: &Solved,
        effort: Effort,
    ) -> Result<Solved, bvp::Error> {
        let problem = from
            .problem
            .clone()
            .with_unknown_tight_tension(coordinate.instead(value));
        self.attempt(problem, &Carried(from), effort)
    }

    /// The maximum of the tight tension over a coordinate, between three states around it, by
    /// successive parabolas (Brent 1973, chapter 5, without the safeguard of golden sections: the
    /// states bracket one smooth maximum).
    fn maximum(&mut self, coordinate: Coordinate, states: [Solved; 3]) -> Result<Found, Stuck> {
        let [low, top, high] = states;
        // As accurate as those to come: else a rough state may seem to be the highest.
        let mut low = self.again(low, Effort::Full)?;
        let mut top = self.again(top, Effort::Full)?;
        let mut high = self.again(high, Effort::Full)?;
        for _ in 0..20 {
            let point = |s: &Solved| (coordinate.of(s), s.tight_tension());
            let [(a, fa), (b, fb), (c, fc)] = [point(&low), point(&top), point(&high)];
            let (left, right) = ((b - a) * (fb - fc), (b - c) * (fb - fa));
            let shift = 0.5 * ((b - a) * left - (b - c) * right) / (left - right);
            let summit = b - shift;
            let settled = shift.abs() <= LIMIT_ACCURACY.sqrt() * b.abs() || !shift.is_finite();
            let inside = if summit > a && summit < c {
                summit
            } else {
                0.5 * (a + b)
            };
            let next = self
                .at(coordinate, inside, &top, Effort::Full)
                .map_err(|cause| Stuck::after(top.clone(), cause))?;
            let better = next.tight_tension() >= top.tight_tension();
            match (better, inside < b) {
                (true, true) => high = std::mem::replace(&mut top, next),
                (true, false) => low = std::mem::replace(&mut top, next),
                (false, true) => low = next,
                (false, false) => high = next,
            }
            if settled {
                break;
            }
        }
        let reason = LimitReason::of_limit_point(top.exit(DRIVER)[INCLINATION], top.driven_speed());
        Ok(Found::Beyond(Box::new(Limit { reason, state: top })))
    }
}

/// Whether a state may be one of those to which no load leads from rest.
pub(super) fn may_be_another(solved: &Solved) -> bool {
    slips_far(solved) || driver_slips(solved)
}

/// The same of a state that is sought where a branch leads: the driver slips there before a limit point, too.
pub(super) fn slips_far(solved: &Solved) -> bool {
    is_slow(solved) || slips_beyond_capstan(solved)
}

/// Whether the driven pulley has lost more than half of its speed.
///
/// It may stand at one load and turn at a larger one again, to which no load leads from rest: that of one random drive stops at
/// 1418 N, and turns at up to a quarter of its speed from 1917 to 2320 N. That of the drive of Kim (2009) with Coulomb friction
/// is slow from 5.8 kN on, and a rising load leads to all these states.
fn is_slow(solved: &Solved) -> bool {
    solved.driven_speed() <= SLOW
}

/// Whether the driver slips all along by more than `CREEP`.
///
/// Then there may be another state under the same load, of less slip, in front of a limit point behind which this one lies or on
/// a branch of its own: at 600 N one random drive with bristles has a state with a slip of 0.39 on the driver, of a branch on which
/// the driven pulley stands at both ends, at 540 and 947 N, and one with 0.0065, to which a rising load leads.
fn driver_slips(solved: &Solved) -> bool {
    least_slip(solved, DRIVER) > CREEP
}

/// The smallest slip on a pulley.
fn least_slip(solved: &Solved, pulley: usize) -> f64 {
    solved.on_pulley(pulley).least_slip().slip
}

/// Whether a pulley slips all along by more than `CREEP` and changes the tension by more than friction against the slip does
/// where the belt is wedged on the whole arc φ,
///
/// ```text
/// |ln(F_out/F_in)| > μ φ/sin β
/// ```
///
/// Then its own friction presses the belt into the groove. The states of one random drive that are reached from rest end at
/// 26.3 kN, and others, with such slip, go from 2.3 kN, where the driven pulley stands, to beyond 60 kN.
fn slips_beyond_capstan(solved: &Solved) -> bool {
    [DRIVEN, DRIVER].into_iter().any(|pulley| {
        let on = solved.on_pulley(pulley);
        let friction = on.groove.friction_coefficient / on.groove.sin_beta;
        let load = (on.exit()[TENSION] / on.entry()[TENSION]).ln();
        load.abs() > friction * on.exit()[ANGLE] && least_slip(solved, pulley) > CREEP
    })
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::vbelt::scaling::tests::{kim, tractive, v_belt};
    use crate::{Drive, TwoPulleys};

    /// A drive whose driver holds its belt up to 305.03 N. States at larger loads are found, some between not.
    pub(in crate::vbelt) fn lets_go() -> Drive {
        let law = FrictionLaw::Epp {
            stiffness: 14_974_325.103,
        };
        Drive::from(TwoPulleys {
            belt: v_belt([0.037_124_974, 49_509.164, 2_090_492.98, 0.261_502_04]),
            friction_coefficient: 0.564_899_45,
            driver_radius: 0.217_053_51,
            driver_speed: 11.866_471,
            driven_radius: 0.594_053_82,
            centre_distance: 2.777_265_9,
            load: tractive(256.172_35, 306.0),
            ..kim(law, 0.25)
        })
    }

    #[test]
    fn a_limit_below_a_load_that_is_carried_is_none() {
        // From 259.8 N, in steps of the load, the states end at 259.9 N.
        let drive = lets_go();
        let mut path = Path::new(&drive, 1e-6);
        let force = path.scales().units.force;
        if let Ok(Found::Beyond(limit)) = path.find(path.target()) {
            panic!("{}", limit.state.tight_tension() * force);
        }
        assert!(path.reached > path.target());
    }
}
