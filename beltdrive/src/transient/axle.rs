//! What drives and what loads a pulley.

use super::schedule::Schedule;

/// The axle of a pulley.
#[derive(Clone, Debug, PartialEq)]
pub struct Axle {
    /// Moment of inertia J of the pulley and what turns with it, kg·m²; positive, or not negative where the speed is
    /// prescribed.
    pub inertia: f64,
    /// What moves it.
    pub motion: Motion,
}

/// What moves an axle.
#[derive(Clone, Debug, PartialEq)]
pub enum Motion {
    /// Its speed is given over time, rad/s, positive along the motion of the belt; it must not jump.
    Speed(Schedule),
    /// It turns as torques make it.
    Torques {
        /// The motor, if there is one.
        motor: Option<Motor>,
        /// The load.
        load: Load,
    },
}

/// A motor, which drives along the motion of the belt.
#[derive(Clone, Debug, PartialEq)]
pub enum Motor {
    /// Its torque is given over time, N·m.
    Torque(Schedule),
    /// Its torque in N·m is given over its speed in rad/s, in points of a schedule; it must not jump.
    Characteristic(Schedule),
}

impl Motor {
    /// The straight line `M_s` (1 − ω/`ω_s`) of torque over speed, at any speed.
    #[must_use]
    pub fn line(stall_torque: f64, no_load_speed: f64) -> Self {
        // Straight on beyond both ends, as far as any drive turns.
        let reach = 1e3;
        let torque = |share: f64| [share * no_load_speed, stall_torque * (1.0 - share)];
        Self::Characteristic(Schedule::ramp(
            [torque(-reach)[0], torque(reach)[0]],
            [torque(-reach)[1], torque(reach)[1]],
        ))
    }
}

/// What loads a pulley: M(t) + c ω.
#[derive(Clone, Debug, PartialEq)]
pub struct Load {
    /// Torque M over time, N·m. Where it is positive it opposes motion in either sense, and at most holds the pulley
    /// at rest; where it is negative it drives.
    pub torque: Schedule,
    /// Torque c per speed, N·m·s; not negative.
    pub per_speed: f64,
    /// Whether M has one sense whatever that of the motion, so that it turns a pulley at rest backwards, as a
    /// hanging weight does.
    pub is_one_way: bool,
}

impl Load {
    /// A torque over time that opposes motion.
    #[must_use]
    pub fn new(torque: Schedule) -> Self {
        Self {
            torque,
            per_speed: 0.0,
            is_one_way: false,
        }
    }

    /// Torque in N·m against a motion at a speed in rad/s, where the schedule gives M and all else would turn the
    /// pulley with `others` N·m.
    pub(crate) fn against(&self, torque: f64, speed: f64, others: f64) -> f64 {
        let constant = if self.is_one_way || torque < 0.0 || speed > 0.0 {
            torque
        } else if speed < 0.0 {
            -torque
        } else {
            others.clamp(-torque, torque)
        };
        constant + self.per_speed * speed
    }

    /// Whether it stops the pulley where the speed changes sign.
    pub(crate) fn holds(&self, torque: f64) -> bool {
        !self.is_one_way && torque > 0.0
    }
}

impl Axle {
    /// The schedules over time.
    pub(crate) fn schedule(&self) -> [Option<&Schedule>; 2] {
        match &self.motion {
            Motion::Speed(speed) => [Some(speed), None],
            Motion::Torques { motor, load } => {
                let motor = match motor {
                    Some(Motor::Torque(torque)) => Some(torque),
                    Some(Motor::Characteristic(_)) | None => None,
                };
                [motor, Some(&load.torque)]
            }
        }
    }

    /// The first corner of what is given over time, after a time, s.
    pub(crate) fn next_corner(&self, time: f64) -> f64 {
        let given = self.schedule().into_iter().flatten();
        given
            .map(|given| given.next_corner(time))
            .fold(f64::INFINITY, f64::min)
    }

    /// How much the torque of an axle that turns freely rises with its speed about one in rad/s, N·m·s; `None` where
    /// the speed is given.
    pub(crate) fn slope(&self, speed: f64) -> Option<f64> {
        let Motion::Torques { motor, load } = &self.motion else {
            return None;
        };
        let motor = match motor {
            Some(Motor::Characteristic(over_speed)) => {
                over_speed.on(over_speed.line(speed), speed)[1]
            }
            Some(Motor::Torque(_)) | None => 0.0,
        };
        Some(motor - load.per_speed)
    }

    /// The fastest rate at which torques that depend on speed change the speed, 1/s.
    pub(crate) fn rate(&self) -> f64 {
        let Motion::Torques { motor, load } = &self.motion else {
            return 0.0;
        };
        let slope = match motor {
            Some(Motor::Characteristic(over_speed)) => {
                let pairs = over_speed.points().windows(2);
                let slopes =
                    pairs.map(|pair| (pair[1][1] - pair[0][1]) / (pair[1][0] - pair[0][0]));
                slopes.map(f64::abs).fold(0.0, f64::max)
            }
            Some(Motor::Torque(_)) | None => 0.0,
        };
        (slope + load.per_speed) / self.inertia
    }
}
