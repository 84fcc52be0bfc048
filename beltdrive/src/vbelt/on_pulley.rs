//! A V-belt on one pulley of a solution: integrals, profile and friction zones.

use super::SLIPPING_BRISTLES;
use super::groove::{ANGLE, INCLINATION, LAW, MAX_STATES, PENETRATION, TENSION};
use super::path::Solved;
use super::{BeltProblem, Contact, EndAngles, Groove, Law, Regime, Units, deepening, limit_excess};
use crate::mechanics::maximum;
use crate::{LeastSlip, Profile, Zone, ZoneKind};
use bvp::Solution;
use std::f64::consts::FRAC_PI_2;

/// Gauss rule on \[0, 1\] for integrals over a mesh interval, at the points of collocation of a state to the tolerance
/// (abscissae ±x₁, ±x₂, ±x₃ and weights of the rule on \[−1, 1\], Abramowitz & Stegun table 25.4). There the equations
/// hold to rounding, and with them the balance of power: with four points losses of `cvt-variator` add up to the power
/// lost but for 1.1e-9 of that put in.
const GAUSS: [(f64, f64); 6] = [
    (0.033_765_242_898_423_99, 0.085_662_246_189_585_17),
    (0.169_395_306_766_867_74, 0.180_380_786_524_069_3),
    (0.380_690_406_958_401_55, 0.233_956_967_286_345_52),
    (0.619_309_593_041_598_5, 0.233_956_967_286_345_52),
    (0.830_604_693_233_132_3, 0.180_380_786_524_069_3),
    (0.966_234_757_101_576, 0.085_662_246_189_585_17),
];
/// Profiles have at least so many points per pulley.
const PROFILE_POINTS: usize = 240;
/// Samples of the slip per mesh interval.
const SLIP_SAMPLES: usize = 8;
/// Accuracy of the place of the largest penetration, as a share of the way between the places beside it: near it the
/// penetration changes by the square of the distance.
const SUMMIT: f64 = 1e-6;
/// The same of the place of the smallest slip, near which the slip may change in proportion to the distance.
const LEAST: f64 = 1e-8;
/// Multiple of ε by which a slip may be off: on the drive of Kim (2009) without load and at 300 and 400 N it was by 20 to 60.
const NORMALISED: f64 = 100.0;
/// Integrals over the contact with one pulley, scaled.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Integrals {
    /// Torque of the belt on the pulley, ∫ t r ds.
    pub(super) torque: f64,
    /// Power against friction.
    pub(super) friction: f64,
    /// Of that, power against friction at its limit across the rim, in and out of the groove.
    pub(super) wedging: f64,
    /// Of that, power against friction below its limit.
    pub(super) elastic: f64,
    /// Power gained from friction, where its traction is not against the slip.
    pub(super) gained: f64,
    /// Power into the transverse compression of the belt.
    pub(super) stored: f64,
    /// Length of the unstretched belt.
    pub(super) unstretched: f64,
}

/// A segment of a contact.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stretch {
    /// Its index in the solution.
    pub(super) segment: usize,
    /// What is known about its friction.
    pub(super) regime: Regime,
    /// Its scaled arc length.
    pub(super) length: f64,
}

/// The slip at a place of a contact.
struct Slip {
    /// The segment, and the place s on it.
    stretch: Stretch,
    place: f64,
    angle: f64,
    /// Its velocity as a share of the belt speed.
    slip: f64,
    /// Whether friction is at its limit.
    is_full: bool,
}

impl Slip {
    /// Whether friction is at its limit and the belt hardly slips.
    fn is_locked(&self) -> bool {
        self.is_full && self.slip < LeastSlip::LOCKED
    }
}

impl<P: BeltProblem> Solved<P> {
    /// The belt on a pulley, if it lies in a groove there.
    pub(super) fn in_groove(&self, pulley: usize) -> Option<OnPulley<'_>> {
        let (problem, p) = (&self.problem, self.solution.parameters());
        let stretches = problem.zones(pulley).map(|segment| Stretch {
            segment,
            regime: problem.regime(segment),
            length: problem.length(segment, p),
        });
        Some(OnPulley {
            solution: &self.solution,
            groove: problem.in_groove(pulley)?,
            stretches: stretches.collect(),
            rim_speed: problem.rim_speed(pulley, p),
            flow: problem.flow(p),
            radius: problem.pitch_radius(pulley),
            units: problem.units(),
        })
    }

    /// Whether the belt locks on all pulleys, in grooves, and overhangs on none. Then every number of a drive follows from an
    /// equation of its own (see `locked`), and a limit point is where the slip of a turn changes its sense: behind it the direction
    /// of friction turns the other way round, and that state is another one. At the limits of 60 random drives with Coulomb
    /// friction a pulley slips by more than 1e-3 or the belt overhangs.
    pub(super) fn locks(&self) -> bool {
        (0..self.problem.pulleys()).all(|pulley| {
            let on = self.in_groove(pulley);
            self.problem.zones(pulley).is_empty()
                || on.is_some_and(|on| {
                    on.least_slip().slip < LeastSlip::LOCKED && on.ends().exit < FRAC_PI_2
                })
        })
    }
}

impl Solved {
    /// The belt on a pulley of a drive.
    pub(super) fn on_pulley(&self, pulley: usize) -> OnPulley<'_> {
        let on = self.in_groove(pulley);
        on.expect("both pulleys of a drive have grooves")
    }
}

/// The belt in the groove of one pulley.
pub(super) struct OnPulley<'a> {
    pub(super) solution: &'a Solution,
    pub(super) groove: &'a Groove,
    /// The segments of the contact, from entry to exit.
    pub(super) stretches: Vec<Stretch>,
    /// Rim speed ν of the pulley.
    pub(super) rim_speed: f64,
    /// Scaled mass flow.
    pub(super) flow: f64,
    /// Pitch radius, m.
    pub(super) radius: f64,
    pub(super) units: Units,
}

impl OnPulley<'_> {
    /// States where the belt enters.
    pub(super) fn entry(&self) -> &[f64] {
        self.solution.start(self.stretches[0].segment)
    }

    /// States where the belt leaves.
    pub(super) fn exit(&self) -> &[f64] {
        self.solution
            .end(self.stretches[self.stretches.len() - 1].segment)
    }

    /// The inclination at entry and exit.
    pub(super) fn ends(&self) -> EndAngles<f64> {
        EndAngles {
            entry: self.entry()[INCLINATION],
            exit: self.exit()[INCLINATION],
        }
    }

    /// \[F R cos θ\] between the ends, at which x = 0, which is the torque of the belt on the pulley; scaled.
    pub(super) fn change_of_moment(&self) -> f64 {
        let arm = |y: &[f64]| y[TENSION] * y[INCLINATION].cos();
        arm(self.exit()) - arm(self.entry())
    }

    /// All local quantities at a point.
    pub(super) fn contact(&self, regime: Regime, y: &[f64]) -> Contact<f64> {
        Contact::new(self.groove, regime, y, self.rim_speed, self.flow)
    }

    /// Calls `visit(stretch, s, weight, y)` at the points of a rule that integrates over the scaled
    /// arc length.
    pub(super) fn for_each_point(&self, mut visit: impl FnMut(Stretch, f64, f64, &[f64])) {
        for &stretch in &self.stretches {
            points(self.solution, stretch.segment, |s, weight, y| {
                visit(stretch, s, weight * stretch.length, y);
            });
        }
    }

    /// The integrals over the contact.
    pub(super) fn integrate(&self) -> Integrals {
        let mut sum = Integrals::default();
        self.for_each_point(|stretch, _, weight, y| {
            let contact = self.contact(stretch.regime, y);
            sum.torque += weight * contact.torque_density();
            let [along, across] = contact.friction_power_densities();
            let friction = weight * (along + across);
            sum.friction += friction;
            match self.is_elastic(stretch.regime, y) {
                true => sum.elastic += friction,
                false => sum.wedging += weight * across,
            }
            // The traction of vector EPP friction may pull with the slip as it falls.
            if !matches!(self.groove.law, Law::Vector { .. }) {
                sum.gained += (-friction).max(0.0);
            }
            sum.stored += weight * contact.transverse_power_density(self.groove);
            sum.unstretched += weight * contact.unstretched_rate(&self.groove.strand);
        });
        sum
    }

    /// The belt along the contact in SI units.
    pub(super) fn profile(&self) -> Profile {
        let (units, radius) = (self.units, self.radius);
        let mut profile = Profile::default();
        let (mut before, mut stretched) = (0.0, 0.0);
        // Entry tension, at which the belt of a law without elastic displacement has none.
        let mut reference = None;
        let mut last: Option<(f64, f64)> = None;
        for stretch in &self.stretches {
            let mut y = [0.0; MAX_STATES];
            let y = &mut y[..self.solution.segments()[stretch.segment].states];
            let mut add = |s: f64, y: &mut [f64]| {
                self.solution.state(stretch.segment, s, y);
                let contact = self.contact(stretch.regime, y);
                let place = before + s * stretch.length;
                let reference = *reference.get_or_insert(contact.tension);
                let rate = contact.displacement_rate(reference);
                if let Some((at, rate_before)) = last {
                    stretched += 0.5 * (place - at) * (rate + rate_before);
                }
                last = Some((place, rate));
                let displacement = match self.groove.elastic() {
                    Some(_) => y[self.groove.displacement()],
                    None => stretched,
                };
                profile.angle.push(y[ANGLE]);
                profile.arc_length.push(place * radius);
                profile.tension.push(contact.tension * units.force);
                profile
                    .tractive_tension
                    .push(contact.tractive * units.force);
                profile.inclination.push(y[INCLINATION]);
                profile.penetration.push(contact.penetration * radius);
                profile
                    .displacement
                    .push(displacement * units.displacement(radius));
                profile
                    .sliding_angle
                    .push(contact.sliding_angle(self.groove, y));
                profile
                    .normal_force
                    .push(contact.pressure * units.line_load(radius));
                profile
                    .friction_force
                    .push(contact.friction() * units.line_load(radius));
            };
            for place in self.places(stretch.segment) {
                add(place, y);
            }
            before += stretch.length;
        }
        profile
    }

    /// Where the belt hardly slips, from samples: between two the logarithm of the slip is taken to be linear.
    pub(super) fn least_slip(&self) -> LeastSlip {
        let samples = self.slips();
        let crossing = |one: &Slip, other: &Slip| {
            let [here, there] = [one, other].map(|at| (at.slip / LeastSlip::LOCKED).ln());
            let share = (here / (here - there)).clamp(0.0, 1.0);
            one.angle + share * (other.angle - one.angle)
        };
        let (mut locked, mut first) = (None::<[f64; 2]>, 0);
        let length = |arc: Option<[f64; 2]>| arc.map_or(0.0, |[from, to]| to - from);
        for run in samples.chunk_by(|one, other| one.is_locked() == other.is_locked()) {
            let behind = first + run.len();
            if run[0].is_locked() {
                let before = samples[..first].last();
                let after = samples.get(behind);
                let last = &run[run.len() - 1];
                let arc = Some([
                    before.map_or(run[0].angle, |before| crossing(&run[0], before)),
                    after.map_or(last.angle, |after| crossing(after, last)),
                ]);
                if length(arc) > length(locked) {
                    locked = arc;
                }
            }
            first = behind;
        }
        LeastSlip {
            slip: self.smallest(&samples),
            normalised: match self.groove.law {
                Law::Normalised { epsilon, .. } => NORMALISED * epsilon,
                _ => 0.0,
            },
            locked,
        }
    }

    /// The size of the slip.
    fn slip(&self, regime: Regime, y: &[f64]) -> f64 {
        let [along, up] = self.contact(regime, y).slip;
        along.hypot(up)
    }

    /// The slip along the contact, at the same number of places on every mesh interval.
    fn slips(&self) -> Vec<Slip> {
        let mut slips = Vec::new();
        for stretch in &self.stretches {
            let mut y = [0.0; MAX_STATES];
            let y = &mut y[..self.solution.segments()[stretch.segment].states];
            for pair in self.solution.mesh(stretch.segment).windows(2) {
                for part in 0..=SLIP_SAMPLES {
                    let s = pair[0] + (pair[1] - pair[0]) * part as f64 / SLIP_SAMPLES as f64;
                    self.solution.state(stretch.segment, s, y);
                    slips.push(Slip {
                        stretch: *stretch,
                        place: s,
                        angle: y[ANGLE],
                        slip: self.slip(stretch.regime, y),
                        is_full: matches!(stretch.regime, Regime::Slip | Regime::Either),
                    });
                }
            }
        }
        slips
    }

    /// The smallest slip: the smallest of the samples, or what it falls to between those beside it. With the samples alone the load
    /// at which a pulley slips grossly changed by 1e-5 with the mesh, and 2.58e-6 was told of the drive of Kim (2009) with vector EPP
    /// friction in place of 2.48e-6. Where the belt is locked it is rounding.
    fn smallest(&self, samples: &[Slip]) -> f64 {
        let order = |one: &&Slip, other: &&Slip| one.slip.total_cmp(&other.slip);
        let Some(lowest) = samples.iter().min_by(order) else {
            return f64::INFINITY;
        };
        if lowest.slip < LeastSlip::LOCKED {
            return lowest.slip;
        }
        let Slip { stretch, place, .. } = *lowest;
        let beside = samples.iter();
        let beside = beside.filter(|at| at.stretch.segment == stretch.segment);
        let [from, to] = beside.fold([0.0_f64, 1.0], |[from, to], at| match at.place {
            before if before < place => [from.max(before), to],
            behind if behind > place => [from, to.min(behind)],
            _ => [from, to],
        });
        let mut y = [0.0; MAX_STATES];
        let y = &mut y[..self.solution.segments()[stretch.segment].states];
        let mut slip = |s: f64| {
            self.solution.state(stretch.segment, s, y);
            self.slip(stretch.regime, y)
        };
        let least = maximum::between(|s| -slip(s), [from, to], LEAST);
        lowest.slip.min(slip(least))
    }

    /// Whether friction is below its limit at a place of a segment in a regime.
    fn is_elastic(&self, regime: Regime, y: &[f64]) -> bool {
        match (self.groove.law, regime) {
            (_, Regime::Stick) => true,
            (Law::Bristle { .. }, _) => {
                let limit = SLIPPING_BRISTLES * self.groove.friction_coefficient;
                y[LAW].hypot(y[LAW + 1]) < limit
            }
            (_, Regime::Elastic | Regime::Reversed) => true,
            (_, Regime::Slip) => false,
            (_, Regime::Either) => {
                limit_excess(self.groove, regime, y, self.rim_speed, self.flow) < 0.0
            }
        }
    }

    /// The zones of friction by swept angle, where each segment is of one kind.
    pub(super) fn friction_zones(&self) -> Vec<Zone> {
        let mut zones = Vec::new();
        let angle = |y: &[f64]| y[ANGLE];
        for stretch in &self.stretches {
            let segment = stretch.segment;
            let ends = [self.solution.start(segment), self.solution.end(segment)].map(angle);
            let is_sampled = match (self.groove.law, stretch.regime) {
                (_, Regime::Stick) => false,
                (Law::Bristle { .. }, _) | (_, Regime::Either) => true,
                (_, Regime::Elastic | Regime::Reversed | Regime::Slip) => false,
            };
            let is_elastic = |y: &[f64]| self.is_elastic(stretch.regime, y);
            if is_sampled {
                self.sampled_zones(segment, is_elastic, &mut zones);
                continue;
            }
            extend(&mut zones, stretch.regime.kind(), ends[0], ends[1]);
        }
        // The entry is where the angle begins; its solved value is rounding.
        if let Some(first) = zones.first_mut() {
            first.from = 0.0;
        }
        zones
    }

    /// Adds the zones of a segment that are told apart at the places of the profile, and where they end.
    fn sampled_zones(
        &self,
        segment: usize,
        is_elastic: impl Fn(&[f64]) -> bool,
        zones: &mut Vec<Zone>,
    ) {
        let mut y = [0.0; MAX_STATES];
        let y = &mut y[..self.solution.segments()[segment].states];
        let mut kind_at = |s: f64| {
            self.solution.state(segment, s, y);
            let kind = match is_elastic(y) {
                true => ZoneKind::Elastic,
                false => ZoneKind::Slip,
            };
            (kind, y[ANGLE])
        };
        let places = self.places(segment);
        let mut last = places[0];
        let (mut kind, mut from) = kind_at(last);
        for &place in &places[1..] {
            let (next, angle) = kind_at(place);
            if next != kind {
                let end = halved([last, place], |s| kind_at(s).0 == kind);
                let between = kind_at(end).1;
                extend(zones, kind, from, between);
                (kind, from) = (next, between);
            }
            extend(zones, kind, from, angle);
            (last, from) = (place, angle);
        }
    }

    /// Places on a segment, at least [`PROFILE_POINTS`] on the pulley and as many on each interval of its meshes.
    fn places(&self, segment: usize) -> Vec<f64> {
        let parts = self.parts();
        let mut places = Vec::new();
        for pair in self.solution.mesh(segment).windows(2) {
            let place = |part| pair[0] + (pair[1] - pair[0]) * part as f64 / parts as f64;
            places.extend((0..parts).map(place));
        }
        places.push(1.0);
        places
    }

    /// The number of parts of every mesh interval between the places of the profile.
    fn parts(&self) -> usize {
        let meshes = self
            .stretches
            .iter()
            .map(|stretch| self.solution.mesh(stretch.segment));
        let intervals: usize = meshes.map(|mesh| mesh.len() - 1).sum();
        PROFILE_POINTS.div_ceil(intervals)
    }

    /// The largest penetration, m: the highest of the places of the profile, and then the summit beside it.
    pub(super) fn max_penetration(&self) -> f64 {
        let segments = self.stretches.iter().map(|stretch| stretch.segment);
        let deepest = segments.map(|segment| {
            let mut y = [0.0; MAX_STATES];
            let y = &mut y[..self.solution.segments()[segment].states];
            let mut depth = |s: f64| {
                self.solution.state(segment, s, y);
                y[PENETRATION]
            };
            let places = self.places(segment);
            let depths: Vec<f64> = places.iter().map(|&s| depth(s)).collect();
            let highest = (0..places.len()).max_by(|&i, &j| depths[i].total_cmp(&depths[j]));
            let highest = highest.expect("a segment has ends");
            let beside = [
                places[highest.saturating_sub(1)],
                places[(highest + 1).min(places.len() - 1)],
            ];
            let summit = maximum::between(&mut depth, beside, SUMMIT);
            depths[highest].max(depth(summit))
        });
        deepest.fold(0.0, f64::max) / deepening(self.rim_speed) * self.radius
    }
}

/// The place between two at which something ends that is so at the first and not at the second, down to rounding.
fn halved([mut from, mut to]: [f64; 2], mut is_so: impl FnMut(f64) -> bool) -> f64 {
    while to - from > f64::EPSILON {
        let middle = 0.5 * (from + to);
        match is_so(middle) {
            true => from = middle,
            false => to = middle,
        }
    }
    to
}

/// Calls `visit(s, weight, y)` at the points of a rule that integrates over s on a segment.
pub(super) fn points(solution: &Solution, segment: usize, mut visit: impl FnMut(f64, f64, &[f64])) {
    let mut y = [0.0; MAX_STATES];
    let y = &mut y[..solution.segments()[segment].states];
    for pair in solution.mesh(segment).windows(2) {
        let h = pair[1] - pair[0];
        for (point, weight) in GAUSS {
            let s = pair[0] + point * h;
            solution.state(segment, s, y);
            visit(s, weight * h, y);
        }
    }
}

/// Makes the last zone longer, or adds one of another kind.
pub(super) fn extend(zones: &mut Vec<Zone>, kind: ZoneKind, from: f64, to: f64) {
    match zones.last_mut() {
        Some(zone) if zone.kind == kind => zone.to = to,
        _ => zones.push(Zone { kind, from, to }),
    }
}
