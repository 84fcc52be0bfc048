//! The steady state of a V-belt round n pulleys as a boundary value problem.
//!
//! Segments are the friction zones of the pulleys in belt order, with the scaled arc length L s, 0 ≤ s ≤ 1; on its
//! back the belt has one for a pulley, and none for an idler, since the tension passes it unchanged. The last state
//! of every segment is the elongation e of the belt from the entry, de/ds = (T/EA)/(1 + T/EA). Unknown parameters are
//! the rim speeds ν of all pulleys with a segment (see `contact`), the coordinate q of the tensioner, and the length L of every
//! segment; the speed of the driver is 1, so that G is one over its ν; with EPP friction also the tension `T_o` at which the displacement in grooves does not grow.
//!
//! ```text
//! conditions of a contact with z zones and n states                               number
//!   the tension with which the belt has left the pulley before                    1
//!   in grooves (see `in_groove`)                                                  (z − 1)(n + 1) + n − 1
//!   on the back u = 0 or B = 0, e = 0 at entry                                    n − 1
//!   the belt turns by as much as between the spans (see `plane`)                  1
//! R (F_out cos θ_out − F_in cos θ_in) = M on every pulley but the driver          speeds
//! closure (see `round`)                                                           1
//! tensioner   Q(q) + H·dC/dq = 0 with the hub load H                              0 or 1
//! T_o of EPP friction is the tension of the slackest span                         0 or 1
//! ```
//!
//! A contact has as many conditions more than states as it has segments: together as many as there are parameters.

use super::super::belt_problem::{BeltProblem, Zoning, in_groove};
use super::super::groove::{ANGLE, LAW, TENSION};
use super::super::{Contact, EndAngles, Groove, Law, Regime, Units};
use super::back;
use super::pieces::Curved;
use super::plane::Plane;
use super::round::Target;
use super::seat::Seat;
use super::tensioner::{coordinate_unit, unbalanced};
use super::unknowns::{DRIVER_RIM_SPEED, Unknowns};
use crate::drive::layout::Layout;
use crate::{Drive, Duty, FrictionLaw, Tensioner};
use bvp::{Ends, Problem, Real, Segment, Solution};
use std::ops::Range;

/// What a pulley does, scaled.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Load {
    Driver,
    Torque(f64),
    Power(f64),
}

/// A belt loop in steady motion, scaled.
#[derive(Clone, Debug)]
pub(crate) struct LoopProblem {
    pub(super) plane: Plane,
    pub(super) units: Units,
    pub(super) seats: Vec<Seat>,
    pub(super) target: Target,
    loads: Vec<Load>,
    /// Factor on all torques and powers; unknown where there is none.
    factor: Option<f64>,
    tensioner: Option<(usize, Tensioner)>,
    pub(super) unknowns: Unknowns,
    /// Index of the driver.
    pub(super) driver: usize,
    zoning: Zoning,
    segments: Vec<Segment>,
    /// By how much the torques or powers, and the closure, are missed: not at all but on the way from another state.
    missed: [f64; 2],
}

impl LoopProblem {
    /// The problem of a loop whose pitch line is laid out in `layout`, in units of `units`, with one segment on
    /// each pulley and the direction of Coulomb and EPP friction smoothed over the length ℓ/R `lag`.
    pub(super) fn new(
        drive: &Drive,
        layout: &Layout,
        units: Units,
        target: Target,
        law: FrictionLaw,
        lag: f64,
    ) -> Self {
        let seats = seated(drive, units, law, lag);
        let loads = drive.pulleys.iter().map(|pulley| match pulley.duty {
            Duty::Driver(_) | Duty::Driven => Load::Driver,
            Duty::Torque(torque) => Load::Torque(torque / units.torque(pulley.radius)),
            Duty::Power(power) => Load::Power(power / units.power()),
        });
        let (tensioner, driver) = (drive.tensioner(), drive.driver());
        let is_epp = matches!(law, FrictionLaw::Epp { .. });
        let problem = Self {
            plane: Plane::new(drive, layout),
            units,
            loads: loads.collect(),
            factor: Some(1.0),
            target,
            tensioner: tensioner.map(|(pulley, tensioner)| (pulley, *tensioner)),
            unknowns: Unknowns::new(&seats, driver, tensioner.is_some(), is_epp),
            driver,
            zoning: Zoning::default(),
            segments: Vec::new(),
            missed: [0.0; 2],
            seats,
        };
        problem.in_one_zone(law)
    }

    /// The same loop of a drive with a law of friction in its grooves, and one segment on each pulley.
    pub(super) fn with_law(mut self, drive: &Drive, law: FrictionLaw, lag: f64) -> Self {
        self.seats = seated(drive, self.units, law, lag);
        self.in_one_zone(law)
    }

    /// The same loop with one segment on each pulley.
    fn in_one_zone(self, law: FrictionLaw) -> Self {
        let zones = self.seats.iter().map(|seat| match seat {
            Seat::Groove(_) => vec![Regime::of_contact(law)],
            Seat::Back(_) => vec![Regime::Either],
            Seat::Idle => vec![],
        });
        let zones: Vec<_> = zones.collect();
        self.with_zones(&zones)
    }

    /// The same loop with all torques and powers multiplied by a factor.
    pub(super) fn with_factor(mut self, factor: f64) -> Self {
        self.factor = Some(factor);
        self
    }

    /// The same loop under torques at another circumferential speed of the driver, m/s, in units with another force, N.
    pub(super) fn at_speed(mut self, rim: f64, force: f64) -> Self {
        let factor = force / self.units.force;
        (self.units.speed, self.units.force) = (rim, force);
        for seat in &mut self.seats {
            seat.set_units(self.units, factor);
        }
        for load in &mut self.loads {
            if let Load::Torque(torque) = load {
                *torque /= factor;
            }
        }
        self
    }

    /// The same loop that misses its torques or powers, and its closure, by so much.
    pub(super) fn missing(mut self, missed: [f64; 2]) -> Self {
        self.missed = missed;
        self
    }

    /// By how much a guess misses the torque or power of the first pulley that has one, and the closure.
    pub(super) fn missed_by(&self, guess: &dyn bvp::Guess) -> [f64; 2] {
        let segments = self.segments();
        let mut values = Vec::new();
        for (index, segment) in segments.iter().enumerate() {
            for s in [0.0, 1.0] {
                let mut y = vec![0.0; segment.states];
                guess.state(index, s, &mut y);
                values.extend(y);
            }
        }
        let mut p = vec![0.0; self.parameters()];
        guess.parameters(&mut p);
        let at = Ends::new(&segments, &values);
        let round = self.round(&at, &p);
        let ends = round.end_angles();
        let laid = self.plane.lay(self.coordinate(&p), &ends);
        let pulleys = 0..self.seats.len();
        let mut loads = pulleys.filter_map(|pulley| self.unloaded(pulley, (&at, &ends), &p));
        [loads.next().unwrap_or(0.0), round.closing(&laid)]
    }

    /// The torque, or the power, that a pulley has beyond that which it is to have.
    fn unloaded<T: Real>(
        &self,
        pulley: usize,
        (at, ends): (&Ends<'_, T>, &[EndAngles<T>]),
        p: &[T],
    ) -> Option<T> {
        let zones = self.zones(pulley);
        let (entry, exit) = (at.start(zones.start), at.end(zones.last()?));
        let EndAngles {
            entry: arriving,
            exit: leaving,
        } = ends[pulley];
        let torque = exit[TENSION] * leaving.cos() - entry[TENSION] * arriving.cos();
        let factor = self.factor(p);
        match self.loads[pulley] {
            Load::Driver => None,
            Load::Torque(load) => Some(torque - factor * load),
            Load::Power(load) => Some(torque * self.omega(pulley, p) - factor * load),
        }
    }

    /// The same loop with torques in place of powers: those of its state with these parameters.
    pub(super) fn with_torques(mut self, p: &[f64]) -> Self {
        for pulley in 0..self.loads.len() {
            if let Load::Power(power) = self.loads[pulley] {
                self.loads[pulley] = Load::Torque(power / self.omega(pulley, p));
            }
        }
        self
    }

    /// The tension at which the displacement of EPP friction does not grow, scaled; 0 with other laws.
    pub(super) fn reference(&self, p: &[f64]) -> f64 {
        let index = self.unknowns.reference(self.segments.len());
        index.map_or(0.0, |index| p[index])
    }

    /// Number of parameters but for the factor.
    fn known_parameters(&self) -> usize {
        self.unknowns.count(self.segments.len())
    }

    /// The factor on all torques and powers.
    pub(super) fn factor<T: Real>(&self, p: &[T]) -> T {
        self.factor
            .map_or_else(|| p[self.known_parameters()], T::from_f64)
    }

    /// Whether a pulley is an idler on the back of the belt.
    pub(super) fn is_idle(&self, pulley: usize) -> bool {
        self.zones(pulley).is_empty()
    }

    /// Unit of the coordinate, rad or m.
    pub(super) fn coordinate_unit(&self) -> f64 {
        self.tensioner.map_or(1.0, |(pulley, tensioner)| {
            coordinate_unit(&tensioner, self.plane.spots[pulley].radius)
        })
    }

    /// Coordinate of the tensioner, rad or m.
    pub(super) fn coordinate<T: Real>(&self, p: &[T]) -> T {
        let index = self.unknowns.coordinate;
        index.map_or(T::ZERO, |index| p[index] * self.coordinate_unit())
    }

    /// The number of states of every segment, as the laws ask for.
    fn laid_out(mut self) -> Self {
        let seats = (0..self.zoning.count()).map(|segment| &self.seats[self.pulley(segment)]);
        self.segments = seats.map(|seat| Segment::new(seat.states())).collect();
        self
    }
}

/// How the belt of a drive lies on its pulleys.
fn seated(drive: &Drive, units: Units, law: FrictionLaw, lag: f64) -> Vec<Seat> {
    let pulleys = drive.pulleys.iter();
    let seats = pulleys.map(|pulley| Seat::new(drive, pulley, units, law, lag));
    seats.collect()
}

impl BeltProblem for LoopProblem {
    fn zoning(&self) -> &Zoning {
        &self.zoning
    }

    fn in_groove(&self, pulley: usize) -> Option<&Groove> {
        match &self.seats[pulley] {
            Seat::Groove(groove) => Some(groove),
            Seat::Back(_) | Seat::Idle => None,
        }
    }

    fn law_states(&self, segment: usize) -> Range<usize> {
        let seat = &self.seats[self.pulley(segment)];
        let first = match seat {
            Seat::Groove(_) => LAW,
            Seat::Back(_) | Seat::Idle => back::LAW,
        };
        first..seat.states() - 1
    }

    fn rim_speed<T: Real>(&self, pulley: usize, p: &[T]) -> T {
        let index = self.unknowns.rim_speeds[pulley];
        p[index.unwrap_or(DRIVER_RIM_SPEED)]
    }

    /// Exactly 1 of the driver, and of idlers, which have none of their own.
    fn omega<T: Real>(&self, pulley: usize, p: &[T]) -> T {
        match self.unknowns.rim_speeds[pulley] {
            None | Some(DRIVER_RIM_SPEED) => T::ONE,
            Some(index) => p[index] / p[DRIVER_RIM_SPEED],
        }
    }

    fn sense(&self, pulley: usize) -> f64 {
        match self.loads[pulley] {
            Load::Driver => -1.0,
            Load::Torque(0.0) | Load::Power(0.0) => 0.0,
            Load::Torque(load) | Load::Power(load) => load.signum(),
        }
    }

    fn flow<T: Real>(&self, p: &[T]) -> T {
        T::ONE / p[DRIVER_RIM_SPEED]
    }

    fn first_length(&self) -> usize {
        self.unknowns.first_length
    }

    fn behind_lengths(&self, solution: &Solution) -> f64 {
        self.solved_by(solution, |round| round.slackest())
    }

    /// With the coordinate of the tensioner and the tension `T_o`.
    fn constants(&self, solution: &Solution) -> Vec<f64> {
        let p = solution.parameters();
        let wraps = (0..self.seats.len()).filter_map(|pulley| {
            let last = self.zones(pulley).last()?;
            Some(match self.seats[pulley] {
                Seat::Groove(_) => solution.end(last)[ANGLE],
                Seat::Back(_) | Seat::Idle => self.length(last, p),
            })
        });
        let speeds = (0..self.seats.len()).map(|pulley| self.omega(pulley, p));
        let others = [self.flow(p), self.coordinate(p) / self.coordinate_unit()];
        let constants = speeds.chain(others).chain([self.reference(p)]);
        constants.chain(wraps).collect()
    }

    fn pitch_radius(&self, pulley: usize) -> f64 {
        self.plane.spots[pulley].radius
    }

    fn units(&self) -> Units {
        self.units
    }

    fn with_zones(mut self, zones: &[Vec<Regime>]) -> Self {
        self.zoning = Zoning::new(zones);
        self.laid_out()
    }

    fn with_laws(mut self, change: impl Fn(Law, f64) -> Law) -> Self {
        for (seat, spot) in self.seats.iter_mut().zip(&self.plane.spots) {
            if let Some(law) = seat.law_mut() {
                *law = change(*law, spot.radius);
            }
        }
        self.laid_out()
    }
}

/// The factor on all torques and powers.
impl Curved for LoopProblem {
    fn freed(mut self) -> Self {
        self.factor = None;
        self
    }

    fn held(self, value: f64) -> Self {
        self.with_factor(value)
    }

    fn number(&self, p: &[f64]) -> f64 {
        self.factor(p)
    }
}

impl Problem for LoopProblem {
    fn segments(&self) -> Vec<Segment> {
        self.segments.clone()
    }

    fn parameters(&self) -> usize {
        self.known_parameters() + usize::from(self.factor.is_none())
    }

    fn condition_count(&self) -> usize {
        let states: usize = self.segments.iter().map(|segment| segment.states).sum();
        states + self.known_parameters()
    }

    fn rhs<T: Real>(&self, segment: usize, _s: T, y: &[T], p: &[T], dy: &mut [T]) {
        let pulley = self.pulley(segment);
        let (rim_speed, flow) = (self.rim_speed(pulley, p), self.flow(p));
        let tension = match &self.seats[pulley] {
            Seat::Groove(groove) => {
                let contact = Contact::new(groove, self.regime(segment), y, rim_speed, flow);
                contact.rates(groove, y, dy);
                if let Some(index) = self.unknowns.reference(self.segments.len()) {
                    dy[groove.displacement()] -= p[index];
                }
                contact.tension
            }
            Seat::Back(back) => {
                let rubbing = back.at(y, rim_speed, flow);
                back.rates(&rubbing, y, dy);
                rubbing.tension
            }
            Seat::Idle => y[TENSION],
        };
        let strain = self.units.strand().strain(tension);
        dy[y.len() - 1] = strain / (strain + 1.0);
        let length = self.length(segment, p);
        for rate in dy {
            *rate *= length;
        }
    }

    /// On the rim speed of its pulley, the mass flow, its own length and the tension `T_o`.
    fn depends(&self, segment: usize, parameter: usize) -> bool {
        let unknowns = &self.unknowns;
        parameter == DRIVER_RIM_SPEED
            || parameter == unknowns.first_length + segment
            || unknowns.rim_speeds[self.pulley(segment)] == Some(parameter)
            || unknowns.reference(self.segments.len()) == Some(parameter)
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, p: &[T], r: &mut [T]) {
        let mut residuals = r.iter_mut();
        let mut zero = |value: T| {
            if let Some(residual) = residuals.next() {
                *residual = value;
            }
        };
        let round = self.round(&at, p);
        let ends = round.end_angles();
        let laid = self.plane.lay(self.coordinate(p), &ends);
        for (pulley, seat) in self.seats.iter().enumerate() {
            let zones = self.zones(pulley);
            let Some(last) = zones.clone().last() else {
                continue;
            };
            let (entry, exit) = (at.start(zones.start), at.end(last));
            zero(entry[TENSION] - round.leaving(self.plane.arriving(pulley)));
            let turned = match seat {
                Seat::Groove(groove) => {
                    in_groove(self, (pulley, groove), &at, p, &mut zero);
                    exit[ANGLE] - (ends[pulley].exit - ends[pulley].entry)
                }
                Seat::Back(_) | Seat::Idle => {
                    for &state in &entry[back::LAW..] {
                        zero(state);
                    }
                    self.length(last, p)
                }
            };
            zero(turned - laid.turned[pulley]);
            if let Some(load) = self.unloaded(pulley, (&at, &ends), p) {
                zero(load - self.missed[0]);
            }
        }
        zero(round.closing(&laid) - self.missed[1]);
        if let Some(index) = self.unknowns.reference(self.segments.len()) {
            zero(p[index] - round.slackest());
        }
        if let Some((pulley, tensioner)) = &self.tensioner {
            let tractive = [self.plane.arriving(*pulley), *pulley].map(|span| round.leaving(span));
            let hub_load = laid.hub_load(&self.plane, *pulley, tractive);
            zero(unbalanced(
                tensioner,
                self.units.force,
                self.coordinate(p),
                hub_load,
            ));
        }
    }
}

#[cfg(test)]
mod tests;
