//! What is told of a run over time.

use super::dynamics::Dynamics;
use super::events::{SlackSpan, TransientEvent};
use super::implicit::ImplicitWork;
use super::ledger::Ledger;
use crate::drive::layout::Layout;
use nalgebra::Vector2;
use std::ops::Range;

/// The history of a drive.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct History {
    /// Names of the pulleys, in belt order.
    pub pulleys: Vec<String>,
    /// The loop of the belt, whose pulleys stay where they are; of a V-belt that of its pitch line, as in
    /// [`LoopState`](crate::belt_loop::LoopState).
    pub layout: Layout,
    /// Places of the contact with each pulley in the lists of [`BeltAlongLoop`]; what follows up to the next one is of the
    /// span behind it.
    pub arcs: Vec<Range<usize>>,
    /// The drive at instants at equal intervals, the first at time 0, and where a run ends between two of them.
    pub samples: Vec<Sample>,
    /// What happened, in the order of time.
    pub events: Vec<TransientEvent>,
    /// How slack each span was; span i leaves pulley i.
    pub slack_spans: Vec<SlackSpan>,
    /// Pulleys, by their places in belt order, into whose grooves a V-belt sinks within less than a cell in the steady state
    /// of the drive, so that tensions are off by per cents.
    pub coarse: Vec<usize>,
    /// The belt along the loop at the instants asked for.
    pub belts: Vec<BeltAlongLoop>,
    /// The belt along the loop at evenly spaced samples, from time 0 on; [`Simulation::frames`](super::Simulation::frames)
    /// at most.
    pub frames: Vec<BeltAlongLoop>,
    /// How the run ended.
    pub ending: Ending,
    /// How it was computed.
    pub effort: Effort,
}

/// How a run ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ending {
    /// At the time asked for.
    Time,
    /// In a steady state, as asked for.
    Steady,
    /// At the latest time, without the steady state that was asked for.
    NotSteady,
    /// At the first gross slip or slack, as asked for: the last of the events.
    Event,
    /// Whoever watched the run ended it.
    Interrupted,
    /// By the error that has it.
    Failed,
}

/// How a run was computed.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct Effort {
    /// Cells of the mesh.
    pub cells: usize,
    /// Time steps, explicit and implicit.
    pub steps: usize,
    /// The shortest and the longest time step, s.
    pub step: [f64; 2],
    /// What the implicit steps among them took: those on the way to a steady state and in runs of many steps.
    pub implicit: ImplicitWork,
    /// Time that it took, s.
    pub seconds: f64,
}

/// A drive at an instant.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Sample {
    /// Time, s.
    pub time: f64,
    /// The pulleys, in belt order.
    pub pulleys: Vec<PulleySample>,
    /// Tension EA (λ − 1) in the middle of each span, N; span i leaves pulley i. Axial damping adds `c_d` λ̇.
    pub tensions: Vec<f64>,
    /// Smallest tension EA (λ − 1) of the belt since the sample before, N.
    pub smallest_tension: f64,
    /// Largest displacement of each span across since the sample before, m; none where spans stay straight.
    pub amplitudes: Vec<f64>,
    /// Where the energy went.
    pub ledger: Ledger,
}

/// A pulley at an instant.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct PulleySample {
    /// Angular speed ω, rad/s; positive along the motion of the belt.
    pub angular_speed: f64,
    /// Speed loss 1 − R ω/(R ω of the driver); 0 while the driver stands still.
    pub speed_loss: f64,
    /// Torque of the belt on the pulley, N·m; positive where it takes power out of the belt that runs forward.
    pub torque: f64,
    /// Torque of the axle on the pulley along the motion of the belt, N·m: of the motor less that of the load. With
    /// a prescribed speed what keeps it.
    pub axle_torque: f64,
    /// Power that the belt gives to the pulley, W.
    pub power: f64,
    /// Arc on which the belt slips, rad.
    pub slip_arc: f64,
    /// Force of the belt on the hub, N.
    pub hub_load: [f64; 2],
}

/// The belt along the loop at an instant; lists from where it meets the first pulley.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct BeltAlongLoop {
    /// Time, s.
    pub time: f64,
    /// Coordinate σ of the loop, m.
    pub position: Vec<f64>,
    /// Tension EA (λ − 1), N.
    pub tension: Vec<f64>,
    /// Belt speed, m/s.
    pub speed: Vec<f64>,
    /// Friction per length on the belt against its motion, N/m; 0 on the spans.
    pub friction: Vec<f64>,
    /// Whether the belt slips, its bristles at their largest displacement; not on the spans.
    pub slips: Vec<bool>,
    /// Displacement across away from the inside of the loop, m; 0 on the arcs, none where spans stay straight.
    pub displacement: Vec<f64>,
    /// Angular speed ω of each pulley, rad/s, in belt order; positive along the motion of the belt.
    pub angular_speeds: Vec<f64>,
}

/// Where the belt meets a pulley.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Entry {
    /// Direction of the pitch circle there, along the motion of the belt, rad, counter-clockwise from x.
    pub(crate) direction: f64,
    /// 1 if the belt turns counter-clockwise round the pulley, else −1.
    pub(crate) turns: f64,
}

/// What takes samples.
pub(crate) struct Observer {
    /// Unit vectors along the motion of a pulley and towards its axis in the cells of each arc.
    frames: Vec<Vec<[Vector2<f64>; 2]>>,
    /// The driver, by its place in belt order.
    driver: usize,
    /// Energy at the start, J.
    energy: f64,
}

impl Observer {
    /// An observer of a drive with a driver whose belt meets the pulleys at places, from a state on whose rates were
    /// computed last.
    pub(crate) fn new(
        rates: &impl Dynamics,
        (driver, entries): (usize, &[Entry]),
        state: &[f64],
    ) -> Self {
        let mesh = rates.mesh();
        let frames = mesh.arcs.iter().enumerate().map(|(pulley, arc)| {
            let Entry { direction, turns } = entries[pulley];
            let radius = rates.wheels()[pulley].radius;
            let cell = mesh.lengths[arc.start];
            let frame = |index: usize| {
                let passed = (index as f64 + 0.5) * cell / radius;
                let (sine, cosine) = (direction + turns * passed).sin_cos();
                let along = Vector2::new(cosine, sine);
                [along, turns * Vector2::new(-sine, cosine)]
            };
            (0..arc.len()).map(frame).collect()
        });
        Self {
            frames: frames.collect(),
            driver,
            energy: rates.energy(state),
        }
    }

    /// The drive at a time in s, with a state and its rates, and the smallest stretch since the sample before.
    pub(crate) fn sample(
        &self,
        time: f64,
        rates: &impl Dynamics,
        state: &[f64],
        least_stretch: f64,
    ) -> Sample {
        let (mesh, axles) = (rates.mesh(), rates.axles());
        let speeds = &state[rates.speeds()];
        let rim = |index: usize| rates.wheels()[index].radius * speeds[index];
        let driving = rim(self.driver);
        let pulley = |index: usize| {
            let torque = axles.torque[index];
            let cell = mesh.lengths[mesh.arcs[index].start];
            PulleySample {
                angular_speed: speeds[index],
                speed_loss: match driving == 0.0 {
                    true => 0.0,
                    false => 1.0 - rim(index) / driving,
                },
                torque,
                axle_torque: axles.shaft[index],
                power: torque * speeds[index],
                slip_arc: rates.slipping(state, index) * cell / rates.wheels()[index].radius,
                hub_load: self.hub_load(rates, state, index).into(),
            }
        };
        let middle = |span: &Range<usize>| {
            let at = |cell: usize| rates.tension(rates.stretches()[cell]);
            let middle = span.start + span.len() / 2;
            match span.len() % 2 {
                0 => 0.5 * (at(middle - 1) + at(middle)),
                _ => at(middle),
            }
        };
        Sample {
            time,
            pulleys: (0..speeds.len()).map(pulley).collect(),
            tensions: mesh.spans.iter().map(middle).collect(),
            smallest_tension: rates.tension(least_stretch),
            amplitudes: vec![],
            ledger: rates.ledger(state, self.energy),
        }
    }

    /// Force of the belt on a hub, N: of its pressure and its friction.
    fn hub_load(&self, rates: &impl Dynamics, state: &[f64], pulley: usize) -> Vector2<f64> {
        let frames = self.frames[pulley].iter().enumerate();
        let forces = frames.map(|(index, [along, inward])| {
            let [friction, pressure] = rates.force(state, pulley, index);
            friction * along + pressure * inward
        });
        forces.sum()
    }

    /// The belt along the loop at a time in s, with a state and its rates.
    pub(crate) fn belt(time: f64, rates: &impl Dynamics, state: &[f64]) -> BeltAlongLoop {
        BeltAlongLoop {
            time,
            position: rates.mesh().middles().collect(),
            tension: { rates.stretches().iter() }
                .map(|&stretch| rates.tension(stretch))
                .collect(),
            speed: rates.middles().to_vec(),
            friction: rates.friction(state),
            slips: slips(rates, state),
            displacement: displacements(rates, state),
            angular_speeds: state[rates.speeds()].to_vec(),
        }
    }
}

/// In which cells of a loop the belt slips.
fn slips(rates: &impl Dynamics, state: &[f64]) -> Vec<bool> {
    let mut slips = vec![false; rates.mesh().cells()];
    for (pulley, arc) in rates.mesh().arcs.iter().enumerate() {
        for (index, slips) in slips[arc.clone()].iter_mut().enumerate() {
            *slips = rates.slips(state, pulley, index);
        }
    }
    slips
}

/// Displacements across in the middles of the cells of a loop, m; none where the spans do not move so.
fn displacements(rates: &impl Dynamics, state: &[f64]) -> Vec<f64> {
    if rates.displacements(state, 0).is_empty() {
        return vec![];
    }
    let mut displaced = vec![0.0; rates.mesh().cells()];
    for (index, span) in rates.mesh().spans.iter().enumerate() {
        let faces = rates.displacements(state, index).windows(2);
        for (to, ends) in displaced[span.clone()].iter_mut().zip(faces) {
            *to = 0.5 * (ends[0] + ends[1]);
        }
    }
    displaced
}
