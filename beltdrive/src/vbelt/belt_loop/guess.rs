//! The state of a loop nearly without friction, from which Newton's method starts.
//!
//! Torques change the tension as on a flat belt, and F runs linearly along every contact. How tight the
//! belt is follows from the closure, where it is the tension of a span; from the load of the tensioner,
//! which holds the tension of its idler about as it is at rest; or from the length of the belt, which
//! strain and the depth in the grooves share,
//!
//! ```text
//! Σ ∫ T/EA ds + Σ ∫ F/(k R tan β) dφ      is about what it is at rest.
//! ```

use super::super::groove::PENETRATION;
use super::super::guess::{Contacting, tractive_on_pitch_line};
use super::super::{BeltProblem, deepening};
use super::problem::LoopProblem;
use super::round::Target;
use super::seat::Seat;
use crate::Drive;
use crate::drive::layout::{Layout, Side};

/// A first approximation to the solution of a [`LoopProblem`].
#[derive(Clone, Debug)]
pub(super) struct LoopGuess<'a> {
    problem: &'a LoopProblem,
    /// Tractive tension of each span, scaled.
    tractive: Vec<f64>,
    /// Coordinate of the tensioner in its unit.
    coordinate: f64,
}

/// About how much the belt sinks round each pulley, as length of the loop per tractive tension, m/N; 0 on its
/// back.
pub(super) fn groove_compliances(drive: &Drive, layout: &Layout) -> Vec<f64> {
    let groove = drive.belt.v();
    let pulleys = drive.pulleys.iter().zip(layout.wraps());
    let compliances = pulleys.map(|(pulley, wrap)| match pulley.side {
        Side::Inside => {
            let half_angle = pulley.half_angle.unwrap_or(groove.half_angle);
            wrap / (groove.radial_stiffness * pulley.radius * half_angle.tan())
        }
        Side::Outside => 0.0,
    });
    compliances.collect()
}

/// Tension and tractive tension of a running belt of an unstretched length that does not sink, without torques, N.
pub(super) fn on_pitch_line(drive: &Drive, layout: &Layout, length: f64) -> [f64; 2] {
    let strain = (layout.length() - length) / length;
    let tension = drive.belt.axial_stiffness * strain;
    [tension, tractive_on_pitch_line(drive, tension)]
}

/// Tractive tensions of the spans of a loop that the friction of its pulleys does not limit, N. `rest` is the tension of the belt at
/// rest where the closure is one of it.
pub(super) fn tractive_tensions(
    drive: &Drive,
    layout: &Layout,
    target: Target,
    rest: Option<f64>,
    factor: f64,
) -> Vec<f64> {
    let belt = drive.belt;
    let rim = drive.rim_speed();
    let count = drive.pulleys.len();
    let driver = drive.driver();
    let mut offsets = vec![0.0; count];
    for step in 1..count {
        let pulley = (driver + step) % count;
        let stated = &drive.pulleys[pulley];
        offsets[pulley] = offsets[(pulley + count - 1) % count]
            + factor * stated.duty.torque_at(rim / stated.radius) / stated.radius;
    }
    let level = match (target, rest, drive.tensioner()) {
        (Target::Tension { span, tension }, _, _) => {
            tractive_on_pitch_line(drive, tension) - offsets[span]
        }
        (Target::Tractive { span, tension }, _, _) => tension - offsets[span],
        (Target::Length(_), None, _) => f64::NAN,
        (Target::Length(_), Some(rest), Some((idler, _))) => rest - offsets[idler],
        (Target::Length(length), Some(rest), None) => {
            let [mut by_tension, mut by_pressure, mut moment] = [0.0; 3];
            let grooves = groove_compliances(drive, layout);
            for (index, pulley) in drive.pulleys.iter().enumerate() {
                let sinking = grooves[index];
                let behind = offsets[(index + count - 1) % count];
                let mean = 0.5 * (behind + offsets[index]);
                let wrap = layout.wraps()[index];
                let span = layout.spans()[index].length / belt.axial_stiffness;
                let arc = pulley.radius * wrap / belt.axial_stiffness;
                by_tension += span + arc;
                by_pressure += sinking;
                moment += span * offsets[index] + (arc + sinking) * mean;
            }
            // A belt that lifts off does not sink: its pitch line is where centrifugal force takes up all.
            let [tension, tractive] = on_pitch_line(drive, layout, length);
            rest * tractive / tension - moment / (by_tension + by_pressure)
        }
    };
    offsets.iter().map(|offset| level + offset).collect()
}

impl<'a> LoopGuess<'a> {
    /// The approximation with these tractive tensions of the spans in N, and a coordinate of the tensioner
    /// in rad or m.
    pub(super) fn new(problem: &'a LoopProblem, tractive: &[f64], coordinate: f64) -> Self {
        let force = problem.units.force;
        Self {
            problem,
            tractive: tractive.iter().map(|tension| tension / force).collect(),
            coordinate: coordinate / problem.coordinate_unit(),
        }
    }

    /// Tractive tensions behind and before a pulley, scaled.
    fn tension(&self, pulley: usize) -> [f64; 2] {
        [self.problem.plane.arriving(pulley), pulley].map(|span| self.tractive[span])
    }

    fn contacting(&self, pulley: usize) -> Contacting {
        let tension = self.tension(pulley);
        let wrap = self.problem.plane.spots[pulley].wrap;
        Contacting {
            tension,
            swept: match &self.problem.seats[pulley] {
                Seat::Groove(groove) => {
                    let ends = Contacting::end_angles(groove, tension);
                    wrap + ends.exit - ends.entry
                }
                Seat::Back(_) | Seat::Idle => wrap,
            },
        }
    }

    /// Rim speed of a pulley: the belt slows down by its mean depth where it is driven, and a driven pulley loses as much again; an
    /// idler does not.
    fn rim_speed(&self, pulley: usize) -> f64 {
        let (strand, driver) = (self.problem.units.strand(), self.problem.driver);
        let [entering, _] = self.tension(driver);
        let stretch = strand.speed(strand.tension(entering, 1.0), 1.0);
        let [entry, exit] = self.tension(pulley);
        let depth = 0.5 * self.depth(pulley);
        stretch
            * match exit > entry {
                true if pulley != driver => 1.0 / (1.0 + depth),
                _ => 1.0 + depth,
            }
    }

    /// Depth of the belt in the groove of a pulley where its tension is larger; 0 on its back.
    fn depth(&self, pulley: usize) -> f64 {
        let [behind, before] = self.tension(pulley);
        match &self.problem.seats[pulley] {
            Seat::Groove(groove) => groove.frictionless_penetration(behind.max(before)),
            Seat::Back(_) | Seat::Idle => 0.0,
        }
    }
}

impl bvp::Guess for LoopGuess<'_> {
    fn state(&self, segment: usize, s: f64, y: &mut [f64]) {
        let pulley = self.problem.pulley(segment);
        let contacting = self.contacting(pulley);
        let [entry, exit] = contacting.tension;
        let last = y.len() - 1;
        match &self.problem.seats[pulley] {
            Seat::Groove(groove) => {
                contacting.state(groove, 1.0, s, y);
                y[PENETRATION] *= deepening(self.rim_speed(pulley));
                if entry == exit {
                    // Nothing bends the bristles of an idler one way rather than the other.
                    y[super::super::LAW..last].fill(0.0);
                }
            }
            Seat::Back(back) => {
                y[0] = entry + s * (exit - entry);
                y[1..last].fill(0.5 * back.friction_coefficient.copysign(exit - entry));
            }
            Seat::Idle => {}
        }
        let strand = self.problem.units.strand();
        let strain = strand.strain(strand.tension(0.5 * (entry + exit), 1.0));
        y[last] = s * contacting.swept * strain / (1.0 + strain);
    }

    fn parameters(&self, p: &mut [f64]) {
        let problem = self.problem;
        if let Some(index) = problem.unknowns.coordinate {
            p[index] = self.coordinate;
        }
        for pulley in 0..problem.pulleys() {
            if let Some(index) = problem.unknowns.rim_speeds[pulley] {
                p[index] = self.rim_speed(pulley);
            }
            for segment in problem.zones(pulley) {
                p[problem.first_length() + segment] = self.contacting(pulley).swept;
            }
        }
    }
}
