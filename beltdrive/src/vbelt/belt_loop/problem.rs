//! The steady state of a V-belt round n pulleys as a boundary value problem.
//!
//! Segments are the contacts in belt order, with the scaled arc length L s, 0 ≤ s ≤ 1; an idler on the back
//! of the belt needs none, since the tension passes it unchanged. The last state of every segment is the
//! elongation e of the belt from the entry, de/ds = (T/EA)/(1 + T/EA). Unknown parameters are G, the
//! coordinate q of the tensioner, the speeds of all pulleys with a segment but the driver, and the length L
//! of every segment; with EPP friction also the tension `T_o` at which the displacement does not grow.
//!
//! ```text
//! conditions of a segment with n states                                           number
//!   the tension with which the belt has left the pulley before                    1
//!   x = 0 at entry and exit, φ = 0 at entry (in grooves)                          3
//!   B = 0, e = 0 at entry                                                         n − 4 or n − 1
//!   the belt turns by as much as between the spans (see `plane`)                  1
//! R (F_out cos θ_out − F_in cos θ_in) = M on every pulley but the driver          speeds
//! closure                                                                         1
//! tensioner   Q(q) + H·dC/dq = 0 with the hub load H                              0 or 1
//! T_o of EPP friction is the tension of the slackest span                         0 or 1
//! ```
//!
//! A groove has two conditions more than states, the back of the belt one more: together as many as there
//! are parameters.

use super::super::groove::{ANGLE, INCLINATION, LAW, PENETRATION, TENSION};
use super::super::{Contact, EndAngles, Regime, Units};
use super::back;
use super::plane::{Laid, Plane};
use super::seat::{Seat, scaled_law};
use super::tensioner::{coordinate_unit, unbalanced};
use crate::FrictionLaw;
use crate::drive::belt_loop::{BeltLoop, Duty, Tensioner};
use crate::drive::layout::Layout;
use bvp::{Ends, Problem, Real, Segment};

/// Index of G among the parameters.
pub(super) const FLOW: usize = 0;

/// What a pulley does, scaled.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Load {
    Driver,
    Torque(f64),
    Power(f64),
}

/// What the closure asks of the running belt.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Target {
    /// Length of the unstretched belt, m.
    Length(f64),
    /// Belt tension of a span, N.
    Tension { span: usize, tension: f64 },
    /// Tractive tension of a span, N.
    Tractive { span: usize, tension: f64 },
}

/// A belt loop in steady motion, scaled.
#[derive(Clone, Debug)]
pub(super) struct LoopProblem {
    pub(super) plane: Plane,
    pub(super) units: Units,
    pub(super) seats: Vec<Seat>,
    pub(super) target: Target,
    loads: Vec<Load>,
    /// Factor on all torques and powers; unknown where there is none.
    factor: Option<f64>,
    tensioner: Option<(usize, Tensioner)>,
    /// Segment of each pulley, if it has one.
    segment_of: Vec<Option<usize>>,
    /// Pulley of each segment.
    pub(super) pulley_of: Vec<usize>,
    driver: usize,
    segments: Vec<Segment>,
    epsilon: f64,
    /// Whether friction is elastic/perfectly-plastic.
    has_reference: bool,
}

impl LoopProblem {
    /// The problem of a loop whose pitch line is laid out in `layout`, in units of `units`; the slip
    /// direction is normalised by `epsilon`, which bristles do not use.
    pub(super) fn new(
        belt_loop: &BeltLoop,
        layout: &Layout,
        units: Units,
        target: Target,
        law: FrictionLaw,
        epsilon: f64,
    ) -> Self {
        let pulleys = belt_loop.pulleys.iter();
        let seats = pulleys.map(|pulley| Seat::new(belt_loop, pulley, units, law, epsilon));
        let seats: Vec<_> = seats.collect();
        let loads = belt_loop.pulleys.iter().map(|pulley| match pulley.duty {
            Duty::Driver(_) => Load::Driver,
            Duty::Torque(torque) => Load::Torque(torque / units.torque(pulley.radius)),
            Duty::Power(power) => Load::Power(power / units.power()),
        });
        let mut segment_of = Vec::with_capacity(seats.len());
        let (mut pulley_of, mut segments) = (vec![], vec![]);
        for (pulley, seat) in seats.iter().enumerate() {
            segment_of.push(seat.states().map(|states| {
                pulley_of.push(pulley);
                segments.push(Segment::new(states));
                segments.len() - 1
            }));
        }
        Self {
            plane: Plane::new(belt_loop, layout),
            units,
            loads: loads.collect(),
            factor: Some(1.0),
            target,
            tensioner: belt_loop
                .tensioner()
                .map(|(pulley, tensioner)| (pulley, *tensioner)),
            segment_of,
            pulley_of,
            driver: belt_loop.driver(),
            segments,
            seats,
            epsilon,
            has_reference: matches!(law, FrictionLaw::Epp { .. }),
        }
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

    /// The same loop with the slip direction normalised by another ε.
    pub(super) fn with_epsilon(mut self, epsilon: f64) -> Self {
        for law in self.seats.iter_mut().filter_map(Seat::law_mut) {
            *law = law.with_smoothing(epsilon);
        }
        self.epsilon = epsilon;
        self
    }

    /// The same loop with bristles of the stiffness κ, 1/m.
    pub(super) fn with_bristles(mut self, stiffness: f64) -> Self {
        for (seat, spot) in self.seats.iter_mut().zip(&self.plane.spots) {
            if let Some(law) = seat.law_mut() {
                *law = scaled_law(
                    FrictionLaw::Bristle { stiffness },
                    self.units,
                    spot.radius,
                    0.0,
                );
            }
        }
        self
    }

    /// The same loop with EPP friction blended into Coulomb friction by `share` in \[0, 1\].
    pub(super) fn with_epp_weight(mut self, share: f64) -> Self {
        for law in self.seats.iter_mut().filter_map(Seat::law_mut) {
            if let Some(elastic) = law.elastic_mut() {
                elastic.weight = share;
            }
        }
        self
    }

    /// The normalisation ε of the slip direction.
    pub(super) fn epsilon(&self) -> f64 {
        self.epsilon
    }

    /// Index of the tension at which the displacement of EPP friction does not grow, among the parameters.
    fn reference_index(&self) -> Option<usize> {
        self.has_reference
            .then(|| self.length_index(self.segments.len()))
    }

    /// That tension, scaled; 0 with other laws.
    pub(super) fn reference(&self, p: &[f64]) -> f64 {
        self.reference_index().map_or(0.0, |index| p[index])
    }

    /// Number of parameters but for the factor.
    fn constants(&self) -> usize {
        self.length_index(self.segments.len()) + usize::from(self.has_reference)
    }

    /// The tension of the slackest span, scaled: the tractive one where the closure gives such a tension.
    pub(super) fn slackest<T: Real>(&self, at: &Ends<'_, T>, p: &[T]) -> T {
        let spans = (0..self.seats.len()).map(|span| self.leaving(span, at));
        let slackest = spans.fold(T::from_f64(f64::INFINITY), Real::min);
        match self.target {
            Target::Tractive { .. } => slackest,
            _ => self.units.strand().tension(slackest, p[FLOW]),
        }
    }

    /// The factor on all torques and powers.
    pub(super) fn factor<T: Real>(&self, p: &[T]) -> T {
        self.factor.map_or_else(|| p[self.constants()], T::from_f64)
    }

    /// The index of the driver.
    pub(super) fn driver(&self) -> usize {
        self.driver
    }

    /// Number of states of a segment before those of the friction law.
    pub(super) fn mechanical_states(&self, segment: usize) -> usize {
        match self.seats[self.pulley_of[segment]] {
            Seat::Groove(_) => LAW,
            Seat::Back(_) | Seat::Idle => back::TENSION + 1,
        }
    }

    /// The segment of a pulley.
    pub(super) fn segment(&self, pulley: usize) -> Option<usize> {
        self.segment_of[pulley]
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

    /// Index of the speed of the pulley of a segment among the parameters; `None` for the driver.
    pub(super) fn speed_index(&self, segment: usize) -> Option<usize> {
        let first = FLOW + 1 + usize::from(self.tensioner.is_some());
        let driver = self.segment_of[self.driver].unwrap_or(usize::MAX);
        (segment != driver).then(|| first + segment - usize::from(segment > driver))
    }

    /// Index of the length of a segment among the parameters.
    pub(super) fn length_index(&self, segment: usize) -> usize {
        let first = FLOW + usize::from(self.tensioner.is_some());
        first + self.segments.len() + segment
    }

    /// Scaled angular speed of the pulley of a segment.
    pub(super) fn omega<T: Real>(&self, segment: usize, p: &[T]) -> T {
        self.speed_index(segment).map_or(T::ONE, |index| p[index])
    }

    /// Tractive tension with which the belt leaves a pulley, scaled.
    pub(super) fn leaving<T: Real>(&self, pulley: usize, at: &Ends<'_, T>) -> T {
        let mut pulley = pulley;
        for _ in &self.seats {
            if let Some(segment) = self.segment_of[pulley] {
                return at.end(segment)[TENSION];
            }
            pulley = self.plane.arriving(pulley);
        }
        T::from_f64(f64::NAN)
    }

    /// Inclinations at both ends of every contact.
    pub(super) fn end_angles<T: Real>(&self, at: &Ends<'_, T>) -> Vec<EndAngles<T>> {
        let pulleys = self.seats.iter().zip(&self.segment_of);
        let ends = pulleys.map(|(seat, segment)| match (seat, segment) {
            (Seat::Groove(_), Some(segment)) => EndAngles {
                entry: at.start(*segment)[INCLINATION],
                exit: at.end(*segment)[INCLINATION],
            },
            _ => EndAngles {
                entry: T::ZERO,
                exit: T::ZERO,
            },
        });
        ends.collect()
    }

    /// Length of the belt less that of the unstretched belt, and that of the stretched one, m.
    fn elongation<T: Real>(&self, at: &Ends<'_, T>, p: &[T], laid: &Laid<T>) -> [T; 2] {
        let strand = self.units.strand();
        let (mut elongation, mut length) = (T::ZERO, T::ZERO);
        for (pulley, &span) in laid.lengths.iter().enumerate() {
            let tension = strand.tension(self.leaving(pulley, at), p[FLOW]);
            let strain = strand.strain(tension);
            length += span;
            elongation += span * (strain / (strain + 1.0));
            let radius = self.plane.spots[pulley].radius;
            match self.segment_of[pulley] {
                Some(segment) => {
                    let end = at.end(segment);
                    length += p[self.length_index(segment)] * radius;
                    elongation += end[end.len() - 1] * radius;
                }
                None => {
                    let arc = laid.turned[pulley] * radius;
                    length += arc;
                    elongation += arc * (strain / (strain + 1.0));
                }
            }
        }
        [elongation, length]
    }

    /// Length of the unstretched belt, and of the running one, m.
    pub(super) fn lengths(&self, at: &Ends<'_, f64>, p: &[f64]) -> [f64; 2] {
        let laid = self.plane.lay(self.coordinate(p), &self.end_angles(at));
        let [elongation, length] = self.elongation(at, p, &laid);
        [length - elongation, length]
    }

    /// The residual of the closure.
    fn closing<T: Real>(&self, at: &Ends<'_, T>, p: &[T], laid: &Laid<T>) -> T {
        match self.target {
            Target::Length(unstretched) => {
                let [elongation, length] = self.elongation(at, p, laid);
                (length - unstretched - elongation) / (unstretched * self.units.strand().compliance)
            }
            Target::Tension { span, tension } => {
                let tractive = self.leaving(span, at);
                self.units.strand().tension(tractive, p[FLOW]) - tension / self.units.force
            }
            Target::Tractive { span, tension } => {
                self.leaving(span, at) - tension / self.units.force
            }
        }
    }
}

impl Problem for LoopProblem {
    fn segments(&self) -> Vec<Segment> {
        self.segments.clone()
    }

    fn parameters(&self) -> usize {
        self.constants() + usize::from(self.factor.is_none())
    }

    fn condition_count(&self) -> usize {
        let states: usize = self.segments.iter().map(|segment| segment.states).sum();
        states + self.constants()
    }

    fn rhs<T: Real>(&self, segment: usize, _s: T, y: &[T], p: &[T], dy: &mut [T]) {
        let (omega, flow) = (self.omega(segment, p), p[FLOW]);
        let tension = match &self.seats[self.pulley_of[segment]] {
            Seat::Groove(groove) => {
                let contact = Contact::new(groove, Regime::Either, y, omega, flow);
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
        let length = p[self.length_index(segment)];
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
        for (segment, &pulley) in self.pulley_of.iter().enumerate() {
            let (entry, exit) = (at.start(segment), at.end(segment));
            zero(entry[TENSION] - self.leaving(self.plane.arriving(pulley), &at));
            let turned = match &self.seats[pulley] {
                Seat::Groove(_) => {
                    zero(entry[PENETRATION]);
                    zero(exit[PENETRATION]);
                    zero(entry[ANGLE]);
                    for &state in &entry[LAW..] {
                        zero(state);
                    }
                    exit[ANGLE] - (ends[pulley].exit - ends[pulley].entry)
                }
                Seat::Back(_) | Seat::Idle => {
                    for &state in &entry[back::TENSION + 1..] {
                        zero(state);
                    }
                    p[self.length_index(segment)]
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
                    zero((before - behind) * self.omega(segment, p) - factor * power);
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
