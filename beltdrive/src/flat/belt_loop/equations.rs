//! The equations of the running loop, solved together from a state near by.
//!
//! ```text
//! 0   tension of the slackest span     the belt is as tight as the closure asks for
//! 1   speed c of the belt              the driver takes it along: c (1 + T_o/EA) = R ω
//! 2   coordinate q of the tensioner    Q(q) − F_t dL/dq = 0
//! 3   factor on all torques            the first pulley slips
//! ```
//!
//! The first N equations determine the first N unknowns, the others are given. Their derivatives are those of a belt
//! that sticks to the pulleys, as a first estimate.

use super::closing::Target;
use super::loads::Loads;
use super::numbers::Numbers;
use super::problem::{Loaded, Problem};
use super::running::{LOOSEST, Running};
use crate::drive::layout::Layout;
use crate::mechanics::root::{Local, near};
use crate::mechanics::tensioner::{
    BALANCED, Towards, largest_step, length_derivatives, resolution,
};
use crate::{FrictionLaw, NormalForce};
use nalgebra::{Matrix4, SMatrix, Vector2, Vector4};
use std::borrow::Cow;

/// Tension of the slackest span as in [`Running::moving`] in N, speed c in m/s, coordinate of the tensioner in rad
/// or m, and factor on all torques.
pub(super) type Unknowns = [f64; 4];

/// The last step, relative to the tension without torques, the speed, the largest step of a search for the tensioner,
/// and the factor. The error is smaller by [`OF_LAST_STEP`], as the derivatives are known to a few percent.
const WITHIN: Unknowns = [1e-11, 1e-13, 1e-9, 1e-11];

/// The error over the last step, at most.
const OF_LAST_STEP: f64 = 1e-2;

/// The equations are solved once more from the solution if the coordinate of the tensioner asks for steps that are
/// smaller by this: where a span at the idler is short, and not in a usual drive.
const SHARPER: f64 = 0.1;

/// How often the derivatives are estimated: at the start and after the first step, the longest. With one estimate a loop
/// of eight pulleys with a tensioner takes seven evaluations in place of five, with three as many as with two.
const ESTIMATES: usize = 2;

/// The equations of a loop.
pub(super) struct Equations<'p> {
    problem: &'p Problem<'p>,
    law: FrictionLaw,
    layout: Cow<'p, Layout>,
    sticking: Sticking,
}

/// What the closure asks for of a belt that sticks to the pulleys.
#[derive(Clone, Copy)]
struct Sticking {
    /// Strain without torques.
    strain: f64,
    /// Tension without torques as in [`Running::moving`], N.
    slackest: f64,
    /// By how much a factor of 1 on the torques takes the slackest span below that, N.
    offset: f64,
    /// Derivative of [`Running::tightness`] with the tension.
    slope: f64,
}

impl Sticking {
    fn new(problem: &Problem<'_>, layout: &Layout) -> Self {
        let Problem {
            drive,
            numbers,
            target,
            ..
        } = problem;
        let Numbers {
            loads,
            rim,
            convention,
            ..
        } = numbers;
        let (belt, whole) = (drive.belt, layout.length());
        let axial = belt.axial_stiffness;
        let count = drive.pulleys.len();
        let (strain, offset) = match *target {
            Target::Unstretched { length, elongation } => {
                let asked = (whole - length) + elongation;
                let spans = layout.spans().iter().zip(&loads.offsets);
                let spans: f64 = spans.map(|(span, offset)| span.length * offset).sum();
                // Most of a contact has the tension of its entry.
                let pulleys = drive.pulleys.iter().zip(layout.wraps());
                let arcs = pulleys.enumerate().map(|(index, (pulley, wrap))| {
                    pulley.radius * wrap * loads.offsets[(index + count - 1) % count]
                });
                (asked / (whole - asked), (spans + arcs.sum::<f64>()) / whole)
            }
            Target::Tension { span, tension } => (tension / axial, loads.offsets[span]),
            Target::TractiveTension { span, tension } => {
                let kinetic = belt.mass_per_length * rim * rim;
                ((tension + kinetic) / axial, loads.offsets[span])
            }
        };
        let tension = axial * strain;
        let speed = rim / (1.0 + strain);
        Self {
            strain,
            slackest: match convention {
                NormalForce::Thesis => tension,
                _ => tension - belt.mass_per_length * speed * rim,
            },
            offset,
            slope: match target {
                Target::Unstretched { .. } => whole / (axial * (1.0 + strain).powi(2)),
                _ => 1.0,
            },
        }
    }
}

impl<'p> Equations<'p> {
    /// With the belt where the tensioner is, or where a search for it begins.
    pub(super) fn new(problem: &'p Problem<'p>, law: FrictionLaw, layout: &'p Layout) -> Self {
        Self {
            problem,
            law,
            layout: Cow::Borrowed(layout),
            sticking: Sticking::new(problem, layout),
        }
    }

    fn running(&self, factor: f64) -> Running<'_> {
        Running::new(&self.problem.numbers, self.layout.wound(), self.law, factor)
    }

    /// The state of a belt that sticks.
    pub(super) fn guess(&self, coordinate: f64, factor: f64) -> Unknowns {
        let Sticking {
            slackest, offset, ..
        } = self.sticking;
        let slackest = slackest - factor * offset;
        let speed = self.running(factor).rigid_speed(slackest);
        [slackest, speed, coordinate, factor]
    }

    /// The state in which the first pulley slips, if the belt sticks from a state on.
    pub(super) fn guess_of_slip(
        &self,
        [slackest, speed, coordinate, factor]: Unknowns,
    ) -> Unknowns {
        let Sticking { offset, .. } = self.sticking;
        let bound = self.running(1.0).capacity_bound();
        let slipping = (slackest + factor * offset) / (bound + offset);
        [slipping * bound, speed, coordinate, slipping]
    }

    /// The state whose first N unknowns solve the first N equations, with the belt there, if it is found at once near
    /// a state.
    pub(super) fn solve<const N: usize>(
        mut self,
        start: Unknowns,
    ) -> Option<(Unknowns, Cow<'p, Layout>)> {
        let [slackest, speed, _, factor] = start;
        if slackest.is_nan() || slackest <= LOOSEST {
            return None;
        }
        let drive = self.problem.drive;
        let largest = drive.tensioner().map_or(1.0, |(pulley, tensioner)| {
            largest_step(drive.pulleys[pulley].radius, &tensioner.guide)
        });
        let infinite = f64::INFINITY;
        let from = [LOOSEST, 0.5 * speed, -infinite, 0.0];
        let to = [infinite, 2.0 * speed, infinite, infinite];
        let tension = drive.belt.axial_stiffness * self.sticking.strain;
        let [within, units] = [WITHIN, [tension, speed, largest, factor]].map(Vector4::from);
        let mut within: Unknowns = within.component_mul(&units).into();
        let state = |found: [f64; N]| {
            let mut state = start;
            state[..N].copy_from_slice(&found);
            state
        };
        let [from, to] = [first(from), first(to)];
        let mut start = start;
        loop {
            let mut estimates = 0..ESTIMATES;
            let local = |found| {
                let values = self.residuals(state(found))?;
                let inverse = match estimates.next() {
                    Some(_) => Some(self.inverse(state(found))?),
                    None => None,
                };
                Some(Local { values, inverse })
            };
            let found = near(local, first(start), [from, to], first(within))?;
            start = state(found);
            self.place::<N>(start)?;
            match self.coordinate_within::<N>(start) {
                Some(needed) if needed < SHARPER * within[2] => within[2] = needed,
                _ => return Some((start, self.layout)),
            }
        }
    }

    /// The last step of the coordinate of the tensioner that balances its load where the belt is laid, but no
    /// less than doubles resolve; `None` if the coordinate is given.
    fn coordinate_within<const N: usize>(&self, state: Unknowns) -> Option<f64> {
        let (_, tensioner) = self.problem.drive.tensioner()?;
        if N <= 2 {
            return None;
        }
        let [_, _, coordinate, _] = state;
        // At this tension, which is an unknown of its own.
        let stiffness = self.derivatives::<N>(state)[(2, 2)];
        let [load, _] = tensioner.load_at(coordinate);
        let [_, velocity, _] = tensioner.guide.centre(coordinate).map(Vector2::from);
        let resolved = resolution(&self.layout, &tensioner.guide) / velocity.norm();
        Some((BALANCED / OF_LAST_STEP * (load / stiffness).abs()).max(resolved))
    }

    /// About the inverse of the derivatives where the belt is laid; `None` if the tensioner is pushed away from the
    /// equilibrium that the derivatives point at.
    fn inverse<const N: usize>(&self, state: Unknowns) -> Option<SMatrix<f64, N, N>> {
        let derivatives = self.derivatives::<N>(state);
        // Slope of the load of the tensioner less the force of the belt, which gets tighter as the idler is pushed on.
        let tightened = derivatives[(2, 0)] * derivatives[(0, 2)] / derivatives[(0, 0)];
        let is_pushed = self.problem.towards == Towards::Force && self.is_moved::<N>();
        match is_pushed && derivatives[(2, 2)] > tightened {
            true => None,
            false => derivatives
                .fixed_view::<N, N>(0, 0)
                .into_owned()
                .try_inverse(),
        }
    }

    /// As [`Self::solve`], the whole loop there and its factor.
    pub(super) fn loaded<const N: usize>(self, start: Unknowns) -> Option<(Loaded, f64)> {
        let (problem, law) = (self.problem, self.law);
        let ([slackest, speed, coordinate, factor], layout) = self.solve::<N>(start)?;
        let running = Running::new(&problem.numbers, layout.wound(), law, factor);
        let belt = running.at(running.moving(speed, slackest))?;
        let loaded = Loaded {
            coordinate,
            belt: Some(belt),
            layout: layout.into_owned(),
        };
        Some((loaded, factor))
    }

    /// Whether there is a tensioner whose coordinate is not given.
    fn is_moved<const N: usize>(&self) -> bool {
        N > 2 && self.problem.drive.tensioner().is_some()
    }

    /// Lays the belt round the idler of a tensioner whose coordinate is not given.
    fn place<const N: usize>(&mut self, [_, _, coordinate, _]: Unknowns) -> Option<()> {
        match self.problem.drive.tensioner() {
            Some((pulley, tensioner)) if N > 2 => {
                let [centre, ..] = tensioner.guide.centre(coordinate);
                self.layout.to_mut().move_pulley(pulley, centre).ok()
            }
            _ => Some(()),
        }
    }

    /// What is to vanish in a state.
    fn residuals<const N: usize>(&mut self, state: Unknowns) -> Option<[f64; N]> {
        #[cfg(test)]
        tests::EVALUATIONS.set(tests::EVALUATIONS.get() + 1);
        self.place::<N>(state)?;
        let [slackest, speed, coordinate, factor] = state;
        let running = self.running(factor);
        let moving = running.moving(speed, slackest);
        let tightness = running.tightness(moving, self.problem.target)?;
        let outruns = running.outruns(moving, tightness.reference);
        let mut residuals = [tightness.surplus, outruns, 0.0, 0.0];
        if N > 2
            && let Some((pulley, tensioner)) = self.problem.drive.tensioner()
        {
            let [slope, _] = length_derivatives(&self.layout, pulley, &tensioner.guide, coordinate);
            let [load, _] = tensioner.load_at(coordinate);
            residuals[2] = load - running.tractive(moving, pulley) * slope;
        }
        if N > 3 {
            residuals[3] = moving.lowest - running.slipping_at(moving.belt);
        }
        Some(first(residuals))
    }

    /// About the derivatives of the equations with the unknowns where the belt is laid, in rows.
    fn derivatives<const N: usize>(&self, state: Unknowns) -> Matrix4<f64> {
        let [slackest, speed, coordinate, factor] = state;
        let Sticking {
            strain,
            offset,
            slope,
            ..
        } = self.sticking;
        let Problem { drive, numbers, .. } = self.problem;
        let Numbers {
            loads: Loads { offsets, .. },
            driver,
            ..
        } = numbers;
        let (belt, running) = (drive.belt, self.running(factor));
        let inertia = 2.0 * belt.mass_per_length * speed;
        // Of the belt tension and the tractive tension with the speed.
        let [tension, tractive] = match numbers.convention {
            NormalForce::Thesis => [0.0, -inertia],
            NormalForce::Inertia | NormalForce::Exact => [inertia, 0.0],
        };
        let asked = match self.problem.target {
            Target::TractiveTension { .. } => tractive,
            Target::Tension { .. } | Target::Unstretched { .. } => tension,
        };
        let mut derivatives = Matrix4::identity();
        derivatives.set_row(0, &[slope, slope * asked, 0.0, slope * offset].into());
        let [behind, _] = running.spans(*driver);
        let strained = [1.0, tension, 0.0, offsets[behind]].map(|part| part / belt.axial_stiffness);
        derivatives.set_row(1, &strained.into());
        derivatives[(1, 1)] += speed.recip();
        if let Some((pulley, tensioner)) = drive.tensioner() {
            let [slope, curvature] =
                length_derivatives(&self.layout, pulley, &tensioner.guide, coordinate);
            let [_, load_slope] = tensioner.load_at(coordinate);
            let moving = running.moving(speed, slackest);
            let force = [1.0, tractive, 0.0, offsets[pulley]].map(|part| -slope * part);
            derivatives.set_row(2, &force.into());
            derivatives[(2, 2)] = load_slope - running.tractive(moving, pulley) * curvature;
            if let Target::Unstretched { .. } = self.problem.target {
                derivatives[(0, 2)] = -slope / (1.0 + strain);
            }
        }
        if N > 3 {
            let bound = self.running(1.0).capacity_bound();
            derivatives.set_row(3, &[1.0, 0.0, 0.0, -bound].into());
        }
        derivatives
    }
}

/// The first N of four numbers.
fn first<const N: usize>(numbers: [f64; 4]) -> [f64; N] {
    std::array::from_fn(|index| numbers[index])
}

#[cfg(test)]
mod tests {
    use crate::belt_loop::solve;
    use crate::input;
    use std::cell::Cell;

    thread_local! {
        /// How often the equations were evaluated.
        pub(super) static EVALUATIONS: Cell<usize> = const { Cell::new(0) };
    }

    /// The unloaded loop, the load, its limit, and EPP friction in place of Coulomb friction.
    #[test]
    fn a_loop_takes_this_many_evaluations() {
        let count = |law: &str, normal_force: &str| {
            let text = include_str!("../../../tests/drives/eight-pulleys.toml");
            let law = law
                .split_whitespace()
                .map(|entry| format!("friction.{entry}"));
            let overrides = law.chain([format!("model.normal_force={normal_force}")]);
            let overrides: Vec<_> = overrides.collect();
            let drive = input::parse("eight-pulleys.toml", text, &overrides).unwrap();
            EVALUATIONS.set(0);
            solve(&drive).unwrap();
            EVALUATIONS.get()
        };
        let epp = "law=epp stiffness=1e8";
        let counts = [
            count("law=coulomb", "inertia"),
            count("law=coulomb", "thesis"),
            count(epp, "inertia"),
            count(epp, "exact"),
        ];
        assert_eq!(counts, [15, 16, 20, 20]);
    }
}
