//! The steady state of a V-belt round n pulleys as a boundary value problem.
//!
//! Segments are the friction zones of the pulleys in belt order, with the scaled arc length L s, 0 ≤ s ≤ 1; on its
//! back the belt has one for a pulley, and none for an idler, since the tension passes it unchanged. The last state
//! of every segment is the elongation e of the belt from the entry, de/ds = (T/EA)/(1 + T/EA). Unknown parameters are
//! G, the coordinate q of the tensioner, the speeds of all pulleys with a segment but the driver, and the length L
//! of every segment; with EPP friction also the tension `T_o` at which the displacement does not grow.
//!
//! ```text
//! conditions of a contact with z zones and n states                               number
//!   the tension with which the belt has left the pulley before                    1
//!   in grooves (see `in_groove`)                                                  (z − 1)(n + 1) + n − 1
//!   on the back u = 0 or B = 0, e = 0 at entry                                    n − 1
//!   the belt turns by as much as between the spans (see `plane`)                  1
//! R (F_out cos θ_out − F_in cos θ_in) = M on every pulley but the driver          speeds
//! closure (see `closing`)                                                         1
//! tensioner   Q(q) + H·dC/dq = 0 with the hub load H                              0 or 1
//! T_o of EPP friction is the tension of the slackest span                         0 or 1
//! ```
//!
//! A contact has as many conditions more than states as it has segments: together as many as there are parameters.

use super::super::belt_problem::{BeltProblem, Zoning, end_angles, in_groove};
use super::super::groove::{ANGLE, LAW, TENSION};
use super::super::path::Solved;
use super::super::{Contact, EndAngles, Groove, Law, Regime, Units};
use super::back;
use super::closing::Target;
use super::plane::Plane;
use super::seat::Seat;
use super::tensioner::{coordinate_unit, unbalanced};
use crate::FrictionLaw;
use crate::drive::belt_loop::{BeltLoop, Duty, Tensioner};
use crate::drive::layout::Layout;
use bvp::{Ends, Problem, Real, Segment, Solution};
use std::ops::Range;

/// Index of G among the parameters.
pub(super) const FLOW: usize = 0;

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
    /// Index of the speed of each pulley among the parameters, if it is unknown.
    speed_index: Vec<Option<usize>>,
    /// Index of the length of the first segment among the parameters.
    first_length: usize,
    /// Index of the driver.
    pub(super) driver: usize,
    zoning: Zoning,
    segments: Vec<Segment>,
    /// Whether friction is elastic/perfectly-plastic.
    has_reference: bool,
}

impl LoopProblem {
    /// The problem of a loop whose pitch line is laid out in `layout`, in units of `units`, with one segment on
    /// each pulley and the direction of Coulomb and EPP friction smoothed over the length ℓ/R `lag`.
    pub(super) fn new(
        belt_loop: &BeltLoop,
        layout: &Layout,
        units: Units,
        target: Target,
        law: FrictionLaw,
        lag: f64,
    ) -> Self {
        let pulleys = belt_loop.pulleys.iter();
        let seats = pulleys.map(|pulley| Seat::new(belt_loop, pulley, units, law, lag));
        let seats: Vec<_> = seats.collect();
        let loads = belt_loop.pulleys.iter().map(|pulley| match pulley.duty {
            Duty::Driver(_) => Load::Driver,
            Duty::Torque(torque) => Load::Torque(torque / units.torque(pulley.radius)),
            Duty::Power(power) => Load::Power(power / units.power()),
        });
        let (tensioner, driver) = (belt_loop.tensioner(), belt_loop.driver());
        let mut first_length = FLOW + 1 + usize::from(tensioner.is_some());
        let speed_index = seats.iter().enumerate().map(|(pulley, seat)| {
            let is_unknown = pulley != driver && !matches!(seat, Seat::Idle);
            first_length += usize::from(is_unknown);
            is_unknown.then_some(first_length - 1)
        });
        let speed_index = speed_index.collect();
        let has_reference = matches!(law, FrictionLaw::Epp { .. });
        let zones = seats.iter().map(|seat| match seat {
            Seat::Groove(_) if !has_reference => vec![Regime::Slip],
            Seat::Groove(_) | Seat::Back(_) => vec![Regime::Either],
            Seat::Idle => vec![],
        });
        let zones: Vec<_> = zones.collect();
        let problem = Self {
            plane: Plane::new(belt_loop, layout),
            units,
            loads: loads.collect(),
            factor: Some(1.0),
            target,
            tensioner: tensioner.map(|(pulley, tensioner)| (pulley, *tensioner)),
            speed_index,
            first_length,
            driver,
            zoning: Zoning::default(),
            segments: Vec::new(),
            seats,
            has_reference,
        };
        problem.with_zones(&zones)
    }

    /// The same loop with all torques and powers multiplied by a factor.
    pub(super) fn with_factor(mut self, factor: f64) -> Self {
        self.factor = Some(factor);
        self
    }

    /// The same loop with the factor as its last parameter, and no condition for it: a curve of states.
    pub(super) fn with_unknown_factor(mut self) -> Self {
        self.factor = None;
        self
    }

    /// Index of the tension at which the displacement of EPP friction does not grow, among the parameters.
    fn reference_index(&self) -> Option<usize> {
        let index = self.first_length + self.segments.len();
        self.has_reference.then_some(index)
    }

    /// That tension, scaled; 0 with other laws.
    pub(super) fn reference(&self, p: &[f64]) -> f64 {
        self.reference_index().map_or(0.0, |index| p[index])
    }

    /// Number of parameters but for the factor.
    fn known_parameters(&self) -> usize {
        self.first_length + self.segments.len() + usize::from(self.has_reference)
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

    /// Index of the coordinate of the tensioner among the parameters.
    pub(super) fn coordinate_index(&self) -> Option<usize> {
        self.tensioner.map(|_| FLOW + 1)
    }

    /// Unit of the coordinate, rad or m.
    pub(super) fn coordinate_unit(&self) -> f64 {
        self.tensioner.map_or(1.0, |(pulley, tensioner)| {
            coordinate_unit(&tensioner, self.plane.spots[pulley].radius)
        })
    }

    /// Coordinate of the tensioner, rad or m.
    pub(super) fn coordinate<T: Real>(&self, p: &[T]) -> T {
        let index = self.coordinate_index();
        index.map_or(T::ZERO, |index| p[index] * self.coordinate_unit())
    }

    /// Index of the speed of a pulley among the parameters, if it is unknown.
    pub(super) fn speed_index(&self, pulley: usize) -> Option<usize> {
        self.speed_index[pulley]
    }

    /// Tractive tension with which the belt leaves a pulley, scaled.
    pub(super) fn leaving<T: Real>(&self, pulley: usize, at: &Ends<'_, T>) -> T {
        let mut pulley = pulley;
        for _ in &self.seats {
            if let Some(last) = self.zones(pulley).last() {
                return at.end(last)[TENSION];
            }
            pulley = self.plane.arriving(pulley);
        }
        T::from_f64(f64::NAN)
    }

    /// Inclinations at both ends of every contact.
    pub(super) fn end_angles<T: Real>(&self, at: &Ends<'_, T>) -> Vec<EndAngles<T>> {
        let pulleys = self.seats.iter().enumerate();
        let ends = pulleys.map(|(pulley, seat)| match seat {
            Seat::Groove(_) => end_angles(self, pulley, at),
            Seat::Back(_) | Seat::Idle => EndAngles {
                entry: T::ZERO,
                exit: T::ZERO,
            },
        });
        ends.collect()
    }

    /// Calls `view` with the states at both ends of all segments of a solution.
    fn with_ends<R>(&self, solution: &Solution, view: impl FnOnce(&Ends<'_, f64>) -> R) -> R {
        let segments = 0..self.segments.len();
        let values = segments.flat_map(|i| [solution.start(i), solution.end(i)]);
        let values: Vec<f64> = values.flatten().copied().collect();
        view(&Ends::new(&self.segments, &values))
    }

    /// The number of states of every segment, as the laws ask for.
    fn laid_out(mut self) -> Self {
        let seats = (0..self.zoning.count()).map(|segment| &self.seats[self.pulley(segment)]);
        self.segments = seats.map(|seat| Segment::new(seat.states())).collect();
        self
    }
}

impl Solved<LoopProblem> {
    /// Calls `view` with the states at both ends of all segments, and the parameters.
    pub(super) fn with_ends<R>(&self, view: impl FnOnce(&Ends<'_, f64>, &[f64]) -> R) -> R {
        let p = self.solution.parameters();
        self.problem.with_ends(&self.solution, |at| view(at, p))
    }
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

    fn omega<T: Real>(&self, pulley: usize, p: &[T]) -> T {
        self.speed_index[pulley].map_or(T::ONE, |index| p[index])
    }

    fn flow<T: Real>(&self, p: &[T]) -> T {
        p[FLOW]
    }

    fn first_length(&self) -> usize {
        self.first_length
    }

    fn behind_lengths(&self, solution: &Solution) -> f64 {
        self.with_ends(solution, |at| self.slackest(at, solution.parameters()))
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
        let constants = p[..self.first_length].iter().copied();
        constants.chain([self.reference(p)]).chain(wraps).collect()
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
        let (omega, flow) = (self.omega(pulley, p), self.flow(p));
        let tension = match &self.seats[pulley] {
            Seat::Groove(groove) => {
                let contact = Contact::new(groove, self.regime(segment), y, omega, flow);
                contact.rates(groove, y, dy);
                contact.tension
            }
            Seat::Back(back) => {
                let rubbing = back.at(y, omega, flow);
                back.rates(&rubbing, y, dy);
                rubbing.tension
            }
            Seat::Idle => y[TENSION],
        };
        let strain = self.units.strand().strain(tension);
        if let Some(index) = self.reference_index() {
            dy[y.len() - 2] -= p[index];
        }
        dy[y.len() - 1] = strain / (strain + 1.0);
        let length = self.length(segment, p);
        for rate in dy {
            *rate *= length;
        }
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, p: &[T], r: &mut [T]) {
        let mut residuals = r.iter_mut();
        let mut zero = |value: T| {
            if let Some(residual) = residuals.next() {
                *residual = value;
            }
        };
        let ends = self.end_angles(&at);
        let (coordinate, factor) = (self.coordinate(p), self.factor(p));
        let laid = self.plane.lay(coordinate, &ends);
        for (pulley, seat) in self.seats.iter().enumerate() {
            let zones = self.zones(pulley);
            let Some(last) = zones.clone().last() else {
                continue;
            };
            let (entry, exit) = (at.start(zones.start), at.end(last));
            zero(entry[TENSION] - self.leaving(self.plane.arriving(pulley), &at));
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
            let [behind, before] = [
                entry[TENSION] * ends[pulley].entry.cos(),
                exit[TENSION] * ends[pulley].exit.cos(),
            ];
            match self.loads[pulley] {
                Load::Driver => {}
                Load::Torque(torque) => zero(before - behind - factor * torque),
                Load::Power(power) => {
                    zero((before - behind) * self.omega(pulley, p) - factor * power);
                }
            }
        }
        zero(self.closing(&at, p, &laid));
        if let Some(index) = self.reference_index() {
            zero(p[index] - self.slackest(&at, p));
        }
        if let Some((pulley, tensioner)) = &self.tensioner {
            let tractive =
                [self.plane.arriving(*pulley), *pulley].map(|span| self.leaving(span, &at));
            let hub_load = laid.hub_load(&self.plane, *pulley, tractive);
            zero(unbalanced(
                tensioner,
                self.units.force,
                coordinate,
                hub_load,
            ));
        }
    }
}

#[cfg(test)]
mod tests;
