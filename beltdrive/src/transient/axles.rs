//! The axles of all pulleys over time.

use super::axle::{Motion, Motor};
use super::system::Wheel;
use std::ops::Range;

/// The torques of a drive; those of the last rates stay until the next ones.
#[derive(Clone, Debug)]
pub(crate) struct Axles {
    /// Torque of the belt on each pulley along the motion of the belt, N·m.
    pub(crate) torque: Vec<f64>,
    /// Torque of the axle on each pulley along the motion of the belt, N·m.
    pub(crate) shaft: Vec<f64>,
    /// On which straight line of its schedules each axle is.
    lines: Vec<[usize; 2]>,
}

impl Axles {
    /// Those of a number of pulleys.
    pub(super) fn new(pulleys: usize) -> Self {
        Self {
            torque: vec![0.0; pulleys],
            shaft: vec![0.0; pulleys],
            lines: vec![[0; 2]; pulleys],
        }
    }

    /// Takes what is given over time from the straight lines that hold from a time in s on.
    pub(super) fn begin(&mut self, wheels: &[Wheel], time: f64) {
        for (lines, wheel) in self.lines.iter_mut().zip(wheels) {
            let given = wheel.axle.schedule();
            *lines = given.map(|given| given.map_or(0, |given| given.line(time)));
        }
    }

    /// Sets the speeds that are given at a time in s.
    pub(super) fn prescribe(&self, wheels: &[Wheel], time: f64, speeds: &mut [f64]) {
        for ((speed, wheel), lines) in speeds.iter_mut().zip(wheels).zip(&self.lines) {
            if let Motion::Speed(given) = &wheel.axle.motion {
                *speed = given.on(lines[0], time)[0];
            }
        }
    }

    /// The torques of the axles at the speeds of a state, with those of the belt. The rates of speeds and works, and that of
    /// the turnover, stand at places of their own.
    pub(super) fn turn(
        &mut self,
        (wheels, time): (&[Wheel], f64),
        (speeds, works, turnover): (&Range<usize>, &Range<usize>, usize),
        state: &[f64],
        rates: &mut [f64],
    ) {
        rates[turnover] = 0.0;
        for (pulley, wheel) in wheels.iter().enumerate() {
            let (torque, lines) = (self.torque[pulley], self.lines[pulley]);
            let speed = state[speeds.start + pulley];
            let inertia = wheel.axle.inertia;
            let (shaft, change) = match &wheel.axle.motion {
                Motion::Speed(given) => {
                    let change = given.on(lines[0], time)[1];
                    (inertia * change - torque, change)
                }
                Motion::Torques { motor, load } => {
                    let drives = match motor {
                        Some(Motor::Torque(given)) => given.on(lines[0], time)[0],
                        Some(Motor::Characteristic(over_speed)) => over_speed.at(speed),
                        None => 0.0,
                    };
                    let given = load.torque.on(lines[1], time)[0];
                    let shaft = drives - load.against(given, speed, drives + torque);
                    (shaft, (shaft + torque) / inertia)
                }
            };
            self.shaft[pulley] = shaft;
            let power = shaft * speed;
            rates[speeds.start + pulley] = change;
            rates[works.start + pulley] = power;
            rates[turnover] += power.abs();
        }
    }

    /// Whether the load of a pulley stops it where its speed changes sign at a time in s.
    pub(crate) fn holds(&self, wheels: &[Wheel], pulley: usize, time: f64) -> bool {
        match &wheels[pulley].axle.motion {
            Motion::Speed(_) => false,
            Motion::Torques { load, .. } => {
                load.holds(load.torque.on(self.lines[pulley][1], time)[0])
            }
        }
    }
}
