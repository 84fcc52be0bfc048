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
use bvp::{Guess, Problem};

/// Fixed-point steps for the tensions of the spans and the speed of the belt.
const STEPS: usize = 4;
/// Slip zones are guessed no shorter and no longer than these shares of the wrap.
const SLIP: [f64; 2] = [0.05, 0.95];
/// Largest share of the load of a pulley that a zone of creep before slip is guessed to carry.
const LESS: f64 = 0.9;
/// Exponential functions of lower rates are straight lines.
const STRAIGHT: f64 = 1e-3;
/// A zone whose layer is thinner than this share of it starts on a graded mesh.
const THIN: f64 = 0.1;

/// A guess of the solution.
#[derive(Clone, Debug)]
pub(super) struct Start {
    /// The belt on every zone.
    pub(super) zones: Vec<Line>,
    /// Parameters of the problem.
    pub(super) parameters: Vec<f64>,
    /// The mesh to start on; equal intervals if there is none.
    pub(super) mesh: Option<Vec<Vec<f64>>>,
}

/// The belt on a zone: between two states as [exp(r ξ) − 1]/[exp(r) − 1].
#[derive(Clone, Copy, Debug)]
pub(super) struct Line {
    /// Excess of tension, displacement and arc length where the zone begins.
    pub(super) from: [f64; 3],
    /// Where it ends.
    pub(super) to: [f64; 3],
    /// Rate r, not negative.
    pub(super) rate: f64,
    /// Length of the zone.
    pub(super) length: f64,
}

/// The zones of a pulley, roughly.
struct Sketch {
    /// Length of each zone.
    lengths: Vec<f64>,
    /// Tension at the end of each zone.
    ends: Vec<f64>,
    /// Rate of each zone.
    rates: Vec<f64>,
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

    /// The same guess on a mesh of so many intervals a zone. In a zone with a thin layer at its end they
    /// are where the slope of the exponential function is more than `least`, and one more is before it.
    pub(super) fn on_mesh(mut self, intervals: usize, least: f64) -> Self {
        let nodes = self.zones.iter().map(|zone| {
            let depth = (zone.rate / least).ln() / zone.rate;
            let uniform = (0..=intervals).map(|i| i as f64 / intervals as f64);
            match zone.rate * THIN > 1.0 && depth < 1.0 {
                false => uniform.collect(),
                true => std::iter::once(0.0)
                    .chain(uniform.map(|place| 1.0 - depth * (1.0 - place)))
                    .collect(),
            }
        });
        self.mesh = Some(nodes.collect());
        self
    }

    /// Adds the zones of a pulley.
    fn add_pulley(&mut self, problem: &Formulation, pulley: usize) {
        let p = &self.parameters;
        let (speed, sense) = (p[SPEED], SENSE[pulley]);
        let entry = p[SPANS + ENTRY[pulley]];
        let friction = problem.friction_coefficient;
        let kinds: Vec<_> = problem.zones(pulley).map(|i| problem.kind(i)).collect();
        let Sketch {
            lengths,
            ends,
            rates,
        } = sketch(problem, pulley, &kinds, p);
        let mut begin = entry;
        let mut from = [0.0; 3];
        for (zone, &kind) in kinds.iter().enumerate() {
            let unit = problem.units.displacement(pulley, kind);
            let free = problem.units.displacement(pulley, ZoneKind::Slip);
            let (length, end) = (lengths[zone], ends[zone]);
            let displacement = match kind {
                ZoneKind::Elastic if zone + 1 < kinds.len() => sense * problem.normal(end, speed),
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
                rate: rates[zone],
                length,
            });
            (begin, from) = (end, to);
            if let Some(&next) = kinds.get(zone + 1) {
                from[DISPLACEMENT] *= unit / problem.units.displacement(pulley, next);
            }
        }
    }
}

/// A sketch of the zones of a pulley, from the tensions of the spans.
fn sketch(problem: &Formulation, pulley: usize, kinds: &[ZoneKind], p: &[f64]) -> Sketch {
    let (speed, sense) = (p[SPEED], SENSE[pulley]);
    let [entry, exit] = [p[SPANS + ENTRY[pulley]], p[SPANS + EXIT[pulley]]];
    let friction = problem.friction_coefficient;
    let normal = |tension: f64| problem.normal(tension, speed);
    let wrap = problem.wrap[pulley] / problem.stretch(entry);
    let slip_from = |tension: f64| (normal(exit) / normal(tension)).ln().abs() / friction;
    let within = |length: f64| length.clamp(SLIP[0] * wrap, SLIP[1] * wrap);
    let then_slip = |slip: f64, border: f64, rate: f64| Sketch {
        lengths: vec![wrap - slip, slip],
        ends: vec![border, exit],
        rates: vec![rate, 0.0],
    };
    match kinds {
        [ZoneKind::Elastic, ZoneKind::Slip] => {
            let (johnson, w) = (slip_from(entry), problem.stiffness[pulley].sqrt());
            let slip = within(johnson - (0.5 * johnson).min(w.recip()));
            let border = normal(exit) * (-sense * friction * slip).exp();
            let border = problem.tension_of_normal(border, speed);
            then_slip(slip, border, w * (wrap - slip))
        }
        [ZoneKind::Creep, ZoneKind::Slip] => {
            let gain = problem.saturation / (problem.compliance * speed);
            let border = entry + sense * gain.min(LESS * (exit - entry).abs());
            let slip = within(slip_from(border));
            let rate = friction * normal(entry) * (wrap - slip) / gain;
            then_slip(slip, border, rate)
        }
        [ZoneKind::Adhesion, ZoneKind::Slip] => then_slip(slip_from(entry).min(wrap), entry, 0.0),
        _ => Sketch {
            lengths: vec![wrap],
            ends: vec![exit],
            rates: vec![match kinds {
                [ZoneKind::Elastic] => problem.stiffness[pulley].sqrt() * wrap,
                [ZoneKind::Creep] => 1.0,
                _ => 0.0,
            }],
        },
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
        let grown = match zone.rate > STRAIGHT {
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
