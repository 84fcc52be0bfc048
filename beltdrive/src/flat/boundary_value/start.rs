//! The first guess: the belt on each zone as a straight line or an exponential function.
//!
//! The slip zone has the length that Johnson (1985) gives it for rigid friction, ln(n₂/n₁)/μ in units of
//! R, less what the boundary layer of the zone before it carries.

use super::super::{DRIVEN, DRIVER};
use super::formulation::{
    ARC_LENGTH, DISPLACEMENT, ENTRY, EXCESS, EXIT, Formulation, LENGTHS, REFERENCE, SENSE, SPANS,
    SPEED,
};
use crate::{SpanTension, ZoneKind};
use bvp::{Guess, Problem, Solution};

/// Fixed-point steps for the tensions of the spans and the speed of the belt.
const STEPS: usize = 4;
/// Slip zones are guessed no shorter and no longer than these shares of the wrap.
const SLIP: [f64; 2] = [0.05, 0.95];
/// Places of a pulley at which slip is looked for.
const PLACES: usize = 100;
/// A zone whose layer is thinner than this share of it starts on a graded mesh.
const THIN: f64 = 0.1;

/// A guess of the solution.
#[derive(Clone, Debug)]
pub(super) struct Start {
    zones: Vec<Line>,
    parameters: Vec<f64>,
    mesh: Option<Vec<Vec<f64>>>,
}

/// The belt on a zone: between two states as [exp(r ξ) − 1]/[exp(r) − 1].
#[derive(Clone, Copy, Debug)]
struct Line {
    /// Excess of tension, displacement and arc length where the zone begins.
    from: [f64; 3],
    /// Where it ends.
    to: [f64; 3],
    /// Rate r, not negative.
    rate: f64,
    /// Length of the zone.
    length: f64,
}

impl Start {
    /// A guess for a drive on equal intervals.
    pub(super) fn new(problem: &Formulation) -> Self {
        let (speed, spans) = spans(problem);
        let mut start = Self {
            zones: Vec::new(),
            parameters: vec![0.0; problem.parameters()],
            mesh: None,
        };
        start.parameters[SPEED] = speed;
        start.parameters[SPANS..LENGTHS].copy_from_slice(&spans);
        for pulley in [DRIVEN, DRIVER] {
            // A belt that hardly creeps at the entry.
            start.parameters[REFERENCE + pulley] = spans[ENTRY[pulley]];
            start.add_pulley(problem, pulley);
        }
        for (index, zone) in start.zones.iter().enumerate() {
            start.parameters[LENGTHS + index] = zone.length;
        }
        start
    }

    /// A guess with zones as they are seen in a solution of [`Formulation::unzoned`]; `None` if their
    /// number differs.
    pub(super) fn from_unzoned(problem: &Formulation, found: &Solution) -> Option<Self> {
        let unzoned = problem.unzoned();
        let p = found.parameters();
        let mut start = Self {
            zones: Vec::new(),
            parameters: p[..LENGTHS].to_vec(),
            mesh: None,
        };
        for pulley in [DRIVEN, DRIVER] {
            let place = |i: usize| i as f64 / PLACES as f64;
            let state = |s: f64| {
                let mut y = [0.0; 3];
                found.state(pulley, s, &mut y);
                y
            };
            // Elastic friction of a zone is not cut off, that of the unzoned problem is.
            let slips = |s: f64| {
                let y = state(s);
                let elastic = y[DISPLACEMENT].abs() * problem.friction_coefficient;
                let limit = unzoned.friction(pulley, ZoneKind::Slip, &y, p).abs();
                elastic > limit
            };
            let slips: Vec<_> = (0..=PLACES).map(|i| slips(place(i))).collect();
            let changes = slips.windows(2).enumerate();
            let changes = changes.filter(|(_, pair)| pair[0] != pair[1]);
            let mut borders = vec![0.0];
            borders.extend(changes.map(|(i, _)| place(i) + 0.5 * place(1)));
            borders.push(1.0);
            if borders.len() != problem.zones(pulley).len() + 1 {
                return None;
            }
            for (segment, ends) in problem.zones(pulley).zip(borders.windows(2)) {
                let units = [ZoneKind::Elastic, problem.kind(segment)].map(|kind| {
                    let displacement = problem.units.displacement(pulley, kind);
                    [problem.units.excess(pulley, kind), displacement]
                });
                let [from, to] = [ends[0], ends[1]].map(|s| {
                    let mut y = state(s);
                    y[EXCESS] *= units[0][0] / units[1][0];
                    y[DISPLACEMENT] *= units[0][1] / units[1][1];
                    y
                });
                start.zones.push(Line {
                    from,
                    to,
                    rate: 0.0,
                    length: p[LENGTHS + pulley] * (ends[1] - ends[0]),
                });
            }
        }
        let lengths = start.zones.iter().map(|zone| zone.length);
        start.parameters.extend(lengths);
        Some(start)
    }

    /// The same guess on a mesh of so many intervals a zone, with those of a zone with a thin layer
    /// at its end where the exponential function is more than `least`.
    pub(super) fn on_mesh(mut self, intervals: usize, least: f64) -> Self {
        let nodes = self.zones.iter().map(|zone| {
            let depth = -least.ln() / zone.rate;
            let uniform = |i: usize| i as f64 / intervals as f64;
            match zone.rate * THIN > 1.0 && depth < 1.0 {
                false => (0..=intervals).map(uniform).collect(),
                true => std::iter::once(0.0)
                    .chain((0..=intervals).map(|i| 1.0 - depth * (1.0 - uniform(i))))
                    .collect(),
            }
        });
        self.mesh = Some(nodes.collect());
        self
    }

    /// The zones of a pulley.
    fn add_pulley(&mut self, problem: &Formulation, pulley: usize) {
        let p = &self.parameters;
        let (speed, sense) = (p[SPEED], SENSE[pulley]);
        let [entry, exit] = [p[SPANS + ENTRY[pulley]], p[SPANS + EXIT[pulley]]];
        let friction = problem.friction_coefficient;
        let normal = |tension: f64| problem.normal(tension, speed);
        let tension = |normal: f64| problem.tension_of_normal(normal, speed);
        let wrap = problem.wrap[pulley] / problem.stretch(entry);
        let slip_from = |tension: f64| (normal(exit) / normal(tension)).ln().abs() / friction;
        let within = |length: f64| length.clamp(SLIP[0] * wrap, SLIP[1] * wrap);
        let w = problem.stiffness[pulley].sqrt();
        let kinds: Vec<_> = problem.zones(pulley).map(|i| problem.kind(i)).collect();
        // Lengths, tensions at the borders, rates.
        let (lengths, mut ends, rates): (Vec<f64>, Vec<f64>, Vec<f64>) = match kinds[..] {
            [ZoneKind::Elastic] => (vec![wrap], vec![], vec![w * wrap]),
            [ZoneKind::Creep] => (vec![wrap], vec![], vec![1.0]),
            [ZoneKind::Elastic, ZoneKind::Slip] => {
                let johnson = slip_from(entry);
                let slip = within(johnson - (0.5 * johnson).min(w.recip()));
                let border = tension(normal(exit) * (-sense * friction * slip).exp());
                let lengths = vec![wrap - slip, slip];
                let rates = vec![w * lengths[0], 0.0];
                (lengths, vec![border], rates)
            }
            [ZoneKind::Creep, ZoneKind::Slip] => {
                let gain = problem.saturation / (problem.compliance * speed);
                let border = entry + sense * gain.min(0.9 * (exit - entry).abs());
                let slip = within(slip_from(border));
                let rate = friction * normal(entry) * (wrap - slip) / gain;
                (vec![wrap - slip, slip], vec![border], vec![rate, 0.0])
            }
            [ZoneKind::Adhesion, ZoneKind::Slip] => {
                let slip = slip_from(entry).min(wrap);
                (vec![wrap - slip, slip], vec![entry], vec![0.0; 2])
            }
            // No slip; or zones that only `from_unzoned` can tell.
            _ => (vec![wrap], vec![], vec![0.0]),
        };
        ends.push(exit);
        let mut begin = entry;
        let mut from = [0.0; 3];
        for (zone, &kind) in kinds.iter().enumerate() {
            let unit = problem.units.displacement(pulley, kind);
            let free = problem.units.displacement(pulley, ZoneKind::Slip);
            let (length, end) = (lengths[zone], ends[zone]);
            let displacement = match kind {
                ZoneKind::Elastic if zone + 1 < kinds.len() => sense * normal(end),
                ZoneKind::Elastic => {
                    let mean = (end - begin) / (friction * length);
                    mean * (2.0 + rates[zone])
                }
                _ => {
                    let mean = 0.5 * (begin + end) - entry;
                    from[DISPLACEMENT] + mean * length * (free / unit)
                }
            };
            let excess = problem.units.excess(pulley, kind);
            from[EXCESS] = (begin - entry) / excess;
            let to = [
                (end - entry) / excess,
                displacement,
                from[ARC_LENGTH] + length,
            ];
            self.zones.push(Line {
                from,
                to,
                rate: rates[zone].max(0.0),
                length,
            });
            (begin, from) = (end, to);
            if let Some(&next) = kinds.get(zone + 1) {
                from[DISPLACEMENT] *= unit / problem.units.displacement(pulley, next);
            }
        }
    }
}

/// Speed of the belt and tensions of the slack and the tight span, if the driver took the belt along
/// without slip.
fn spans(problem: &Formulation) -> (f64, [f64; 2]) {
    let mut speed = 1.0;
    let mut tensions = [0.0; 2];
    for _ in 0..STEPS {
        let share = 1.0 - problem.kinetic * speed * speed;
        let tension = |span: SpanTension| match span {
            SpanTension::Belt(tension) => tension,
            SpanTension::Tractive(force) => problem.tension_of_tractive(force, speed),
            SpanTension::DrivenTorque(torque) => torque / share,
        };
        let [slack, tight] = [problem.load.slack, problem.load.tight].map(tension);
        tensions = match [problem.load.slack, problem.load.tight] {
            [SpanTension::DrivenTorque(_), _] => [tight - slack, tight],
            [_, SpanTension::DrivenTorque(_)] => [slack, slack + tight],
            _ => [slack, tight],
        };
        speed = (1.0 + tensions[1] * problem.compliance).recip();
    }
    (speed, tensions)
}

impl Guess for Start {
    fn state(&self, segment: usize, s: f64, y: &mut [f64]) {
        let zone = &self.zones[segment];
        let grown = match zone.rate > 1e-3 {
            true => {
                let end = -(-zone.rate).exp_m1();
                ((zone.rate * (s - 1.0)).exp() - (-zone.rate).exp()) / end
            }
            false => s,
        };
        for (y, (from, to)) in y.iter_mut().zip(zone.from.iter().zip(&zone.to)) {
            *y = from + grown * (to - from);
        }
        y[ARC_LENGTH] = zone.from[ARC_LENGTH] + s * zone.length;
    }

    fn parameters(&self, p: &mut [f64]) {
        p.copy_from_slice(&self.parameters);
    }

    fn mesh(&self) -> Option<Vec<Vec<f64>>> {
        self.mesh.clone()
    }
}
