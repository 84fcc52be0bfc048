//! The state of a drive nearly without friction, from which Newton's method starts.
//!
//! On each pulley F runs linearly between the tensions of the spans and presses the belt to the
//! depth a = F/(k R tan β). The belt enters and leaves on the pitch circle; linearised in x, its
//! way there is x'' = λ² (x − a) in φ with λ² = k R² tan β/F = 1/a, so in units of R
//!
//! ```text
//! x = a (1 − e^(−λφ)) (1 − e^(−λ(Φ−φ)))        θ = −dx/dφ
//! ```
//!
//! with λ of each end in its own boundary layer (seating and unseating, Gerbert and Sorge 2002).
//! Thus θ = −√a at entry and √a at exit; the sweeps Φ are those that close the drive with these
//! inclinations. Bristles are deflected by half of their limit along the motion: undeflected ones
//! fail as a start at high loads, as do speeds without any loss.

use super::groove::{ANGLE, INCLINATION, LAW, PENETRATION, TENSION};
use super::{BeltProblem, DRIVEN, DRIVER, DriveProblem, EndAngles, Groove, Law, deepening};
use crate::{Drive, SpanTension};

/// Tractive tension F = T − m V²/(1 + T/EA) of a belt with a tension T that runs on the pitch circles at the speed V of the rim of the
/// driver, N.
pub(super) fn tractive_on_pitch_line(drive: &Drive, tension: f64) -> f64 {
    let (belt, rim) = (drive.belt, drive.rim_speed());
    tension - belt.mass_per_length * rim * rim / (1.0 + tension / belt.axial_stiffness)
}

/// A first approximation to the solution of a [`DriveProblem`].
#[derive(Clone, Debug)]
pub(crate) struct Guess<'a> {
    problem: &'a DriveProblem,
    flow: f64,
    /// Of both pulleys.
    rim_speeds: [f64; 2],
    pulleys: [Contacting; 2],
}

/// The belt on one pulley.
#[derive(Clone, Copy, Debug)]
pub(super) struct Contacting {
    /// Tractive tension at entry and exit.
    pub(super) tension: [f64; 2],
    /// Swept angle Φ, also the scaled contact length.
    pub(super) swept: f64,
}

impl Contacting {
    /// Inclination at entry and exit of a belt that presses with F, positive outward.
    pub(super) fn end_angles(groove: &Groove, tension: [f64; 2]) -> EndAngles<f64> {
        let [entry, exit] = tension.map(|force| {
            let depth = groove.frictionless_penetration(force);
            depth.max(0.0).sqrt()
        });
        EndAngles {
            entry: -entry,
            exit,
        }
    }

    /// The state at a part of the contact, 0 at the entry and 1 at the exit, with the penetration x itself.
    pub(super) fn state(&self, groove: &Groove, flow: f64, part: f64, y: &mut [f64]) {
        let Self {
            tension: [entry, exit],
            swept,
        } = *self;
        let angle = part * swept;
        let slope = (exit - entry) / swept;
        let force = entry + slope * angle;

        let depth = groove.frictionless_penetration(force);
        let depth_slope = groove.frictionless_penetration(slope);
        let layer = |end: f64, distance: f64| {
            let lambda = 1.0
                / groove
                    .frictionless_penetration(end)
                    .max(f64::MIN_POSITIVE)
                    .sqrt();
            let decay = (-lambda * distance).exp();
            (1.0 - decay, lambda * decay)
        };
        let (rise, rise_slope) = layer(entry, angle);
        let (fall, fall_slope) = layer(exit, swept - angle);
        y[TENSION] = force;
        y[INCLINATION] =
            -(depth_slope * rise * fall + depth * (rise_slope * fall - rise * fall_slope));
        y[PENETRATION] = depth * rise * fall;
        y[ANGLE] = angle;
        if let Some(elastic) = groove.elastic() {
            let [start, here] = [entry, force].map(|force| groove.strand.tension(force, flow));
            y[groove.displacement()] = ((start + here) / 2.0 - elastic.unstretched) * angle;
        }
        match groove.law {
            Law::Normalised { .. } => {}
            Law::Sliding { .. } => y[LAW] = 0.0,
            Law::Bristle { .. } | Law::Vector { .. } => {
                y[LAW] = 0.5 * groove.friction_coefficient.copysign(slope);
                y[LAW + 1] = 0.0;
            }
        }
    }
}

impl<'a> Guess<'a> {
    /// The approximation at the prescribed load.
    pub(crate) fn new(problem: &'a DriveProblem) -> Self {
        let strand = problem.groove(DRIVER).strand;
        let [slack, tight] = problem.load();
        // The belt meets the driver at its circumferential speed, 1.
        let tension = match tight {
            SpanTension::Tractive(force) => strand.tension(force, 1.0),
            tension => tension.value(),
        };
        let flow = 1.0 / strand.speed(tension, 1.0);
        let [slack, tight] = [slack, tight].map(|span| strand.tractive_of(span, flow));
        let tensions = [[slack, tight], [tight, slack]];
        let ends = [DRIVEN, DRIVER]
            .map(|pulley| Contacting::end_angles(problem.groove(pulley), tensions[pulley]));
        let swept = problem.layout().wraps(ends);
        // The mean depth of the belt, half of that at the tight end, slows it on the driver; the
        // driven pulley loses as much again.
        let force = tensions[DRIVER][0];
        let [driven, driver] = [DRIVEN, DRIVER].map(|pulley| {
            let depth = problem.groove(pulley).frictionless_penetration(force);
            1.0 / (1.0 + 0.5 * depth)
        });
        Self {
            problem,
            flow,
            rim_speeds: [driven / flow, 1.0 / (flow * driver)],
            pulleys: [DRIVEN, DRIVER].map(|pulley| Contacting {
                tension: tensions[pulley],
                swept: swept[pulley],
            }),
        }
    }

    /// Position of a segment among the zones of its pulley.
    fn zone(&self, segment: usize) -> f64 {
        let first = self.problem.zones(self.problem.pulley(segment)).start;
        (segment - first) as f64
    }

    /// Part of the contact that one zone of `pulley` takes.
    fn zone_share(&self, pulley: usize) -> f64 {
        1.0 / self.problem.zones(pulley).len() as f64
    }
}

impl bvp::Guess for Guess<'_> {
    /// The state at `s` in \[0, 1\] of a segment. The zones of a pulley have equal lengths.
    fn state(&self, segment: usize, s: f64, y: &mut [f64]) {
        let pulley = self.problem.pulley(segment);
        let part = (self.zone(segment) + s) * self.zone_share(pulley);
        self.pulleys[pulley].state(self.problem.groove(pulley), self.flow, part, y);
        y[PENETRATION] *= deepening(self.rim_speeds[pulley]);
    }

    /// The parameters; the tight tension is that of the load if it is unknown.
    fn parameters(&self, p: &mut [f64]) {
        let [_, tight] = self.problem.load();
        p.fill(tight.value());
        p[DriveProblem::DRIVEN_RIM_SPEED] = self.rim_speeds[DRIVEN];
        p[DriveProblem::DRIVER_RIM_SPEED] = self.rim_speeds[DRIVER];
        for pulley in [DRIVEN, DRIVER] {
            for segment in self.problem.zones(pulley) {
                p[DriveProblem::length_index(segment)] =
                    self.pulleys[pulley].swept * self.zone_share(pulley);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::scaling::tests::kim;
    use super::super::{Regime, Scales};
    use super::*;
    use crate::FrictionLaw;
    use bvp::{Ends, Guess as _, Problem};

    /// Both ends of every segment, in the layout of `Ends`, and the parameters.
    fn ends(problem: &DriveProblem) -> (Vec<f64>, Vec<f64>) {
        let guess = Guess::new(problem);
        let mut values = Vec::new();
        for (segment, shape) in problem.segments().iter().enumerate() {
            for s in [0.0, 1.0] {
                let mut y = vec![f64::NAN; shape.states];
                guess.state(segment, s, &mut y);
                values.extend(y);
            }
        }
        let mut p = vec![f64::NAN; problem.parameters()];
        guess.parameters(&mut p);
        (values, p)
    }

    #[test]
    fn the_guess_meets_the_conditions_up_to_its_boundary_layers() {
        for radius in [0.25, 0.15] {
            let drive = kim(FrictionLaw::Bristle { stiffness: 1620.0 }, radius);
            let problem = DriveProblem::new(&drive, Scales::new(&drive), 0.0);
            let (values, p) = ends(&problem);
            let mut r = vec![f64::NAN; problem.condition_count()];
            problem.conditions(Ends::new(&problem.segments(), &values), &p, &mut r);
            // Of the seven conditions of a pulley the last two are that its bristles are not bent yet.
            let (pulleys, closure) = r.split_at(14);
            let mechanical = pulleys.chunks(7).flat_map(|conditions| &conditions[..5]);
            for residual in mechanical.chain(closure) {
                assert!(residual.abs() < 1e-5, "{residual}");
            }
        }
    }

    #[test]
    fn zones_share_a_pulley_continuously() {
        let drive = kim(FrictionLaw::Epp { stiffness: 8.1e6 }, 0.2);
        let whole = DriveProblem::new(&drive, Scales::new(&drive), 1e-3);
        let zoned = whole
            .clone()
            .with_zones(&[vec![Regime::Elastic, Regime::Slip], vec![Regime::Slip]]);
        let (mut left, mut right, mut middle) = ([0.0; 6], [0.0; 6], [0.0; 6]);
        Guess::new(&zoned).state(0, 1.0, &mut left);
        Guess::new(&zoned).state(1, 0.0, &mut right);
        Guess::new(&whole).state(0, 0.5, &mut middle);
        assert_eq!(left, right);
        assert_eq!(left, middle);
        let (_, p) = ends(&zoned);
        let (_, q) = ends(&whole);
        assert!((p[2] + p[3] - q[2]).abs() < 1e-15 && p[4] == q[3]);
    }

    #[test]
    fn the_inclination_is_the_slope_of_the_penetration() {
        let drive = kim(FrictionLaw::Coulomb, 0.2);
        let problem = DriveProblem::new(&drive, Scales::new(&drive), 1e-3);
        let guess = Guess::new(&problem);
        let at = |s: f64| {
            let mut y = [0.0; 5];
            guess.state(1, s, &mut y);
            y
        };
        for s in [0.01, 0.2, 0.97] {
            let (before, here, after) = (at(s - 1e-5), at(s), at(s + 1e-5));
            let slope = (after[PENETRATION] - before[PENETRATION]) / (after[ANGLE] - before[ANGLE]);
            let slope = slope / deepening(guess.rim_speeds[DRIVER]);
            assert!((here[INCLINATION] + slope).abs() < 1e-6);
        }
    }
}
