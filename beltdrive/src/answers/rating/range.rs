//! The speeds at which a drive is rated.

use super::{RatedLoad, RatingQuestion};
use crate::mechanics::root::bracketed;
use crate::model::{NearLargest, model};
use crate::results::largest_load::LargestLoad;
use crate::{
    BeltKind, Drive, Duty, FrictionLaw, NormalForce, Side, SolveError, SolveOptions, flat,
};
use std::borrow::Cow;

/// Why the range of speeds of a rating ends.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub enum RatingEnd {
    /// Centrifugal force takes up the whole tension there: the belt presses on no pulley.
    LiftsOff {
        /// Angular speed of the driver, rad/s, to rounding.
        speed: f64,
    },
    /// The belt runs no faster even without load, for this reason.
    NoState {
        /// Angular speed of the driver, rad/s, to rounding; of a V-belt with a tensioner, that of a belt that does not
        /// sink.
        speed: f64,
        /// The reason.
        reason: Box<SolveError>,
    },
    /// At higher speeds the driver slips ever more under more load, and no load is the largest: the belt slows down, and
    /// centrifugal force falls. V-belts only.
    SlipsEverMore {
        /// Angular speed of the driver up to which this was not found, rad/s; to 0.005 of it.
        speed: f64,
    },
    /// It is the end that was asked for.
    Given,
    /// The load has no end up to where the belt would be as fast as axial waves along it: the range ends at this
    /// factor on the speed of the drive file.
    Chosen {
        /// The factor.
        factor: f64,
    },
}

/// The end of the range of a drive that never lifts off, as a factor on its speed: beyond the quadruple no belt
/// drive is run.
const FACTOR: f64 = 4.0;

/// Where the range begins, as a share of its end: nothing changes below it by more than its square.
const BEGINNING: f64 = 1e-3;

/// Factor between the speeds at which the end is sought.
const STEP: f64 = 1.2;

/// Largest coefficient of friction of a wedge: with more of it hardly anything slips.
const LARGEST_FRICTION: f64 = 10.0;

/// Bisections that locate an end without a sign to rounding.
const BISECTIONS: usize = 60;

/// A drive at any speed.
pub(super) struct Speeds<'d> {
    pub(super) drive: &'d Drive,
    pub(super) options: &'d SolveOptions,
    /// The same without load; a V-belt by a flat belt of its length on the pitch circles, which lifts off with it: a
    /// belt that does not press does not sink.
    idle: Drive,
}

impl<'d> Speeds<'d> {
    pub(super) fn new(drive: &'d Drive, options: &'d SolveOptions) -> Self {
        let mut idle = drive.clone();
        idle.multiply_load(0.0);
        if let BeltKind::V(_) = idle.belt.kind {
            let normal_force = NormalForce::default();
            idle.belt.kind = BeltKind::Flat { normal_force };
            idle.law = FrictionLaw::Coulomb;
            for pulley in &mut idle.pulleys {
                pulley.half_angle = None;
            }
        }
        Self {
            drive,
            options,
            idle,
        }
    }

    /// Tractive tension without load, N; not positive where the belt lifts off.
    fn tension(&self, speed: f64) -> Result<f64, SolveError> {
        flat::belt_loop::unloaded_tension(&at_speed(&self.idle, speed))
    }

    /// About the factor on the load of a V-belt at its largest at a speed: that of a flat belt on the pitch circles with
    /// the friction of wedges.
    pub(super) fn expected(&self, speed: f64) -> Result<f64, SolveError> {
        let mut flat = at_speed(&self.idle, speed);
        for (flat, stated) in flat.pulleys.iter_mut().zip(&self.drive.pulleys) {
            if let Duty::Torque(_) = flat.duty {
                flat.duty = stated.duty;
            }
            let wedge = match (self.drive.belt.kind, stated.side) {
                (BeltKind::V(belt), Side::Inside) => {
                    stated.half_angle.unwrap_or(belt.half_angle).sin()
                }
                _ => 1.0,
            };
            flat.friction_coefficient = (stated.friction_coefficient / wedge).min(LARGEST_FRICTION);
        }
        let model = model(flat.belt.kind);
        let (found, _) = model.largest_load(&flat, None, 1.0, self.options)?;
        Ok(found.factor)
    }

    /// The largest load at a speed, expected to be about a factor on that of the drive, and what others are found from.
    pub(super) fn largest(
        &self,
        speed: f64,
        near: Option<&NearLargest>,
        expected: f64,
    ) -> Result<(RatedLoad, NearLargest), SolveError> {
        let drive = at_speed(self.drive, speed);
        let model = model(drive.belt.kind);
        let (found, near) = model.largest_load(&drive, near, expected, self.options)?;
        let LargestLoad {
            factor,
            end,
            driver_torque: torque,
            power_out,
            error,
        } = found;
        let load = RatedLoad {
            speed,
            factor,
            torque,
            power: torque * speed,
            power_out,
            end,
            error,
        };
        Ok((load, near))
    }

    /// The speeds that are asked for, as far as the belt presses, and why they end there. The end is sought from the
    /// speed of the drive file.
    pub(super) fn range(
        &self,
        question: RatingQuestion,
        stated: f64,
    ) -> Result<([f64; 2], RatingEnd), SolveError> {
        let end = self.end(question.from.unwrap_or(stated))?;
        let last = match &end {
            Some(RatingEnd::LiftsOff { speed } | RatingEnd::NoState { speed, .. }) => *speed,
            _ => f64::INFINITY,
        };
        let (to, end) = match (question.to, end) {
            (Some(to), _) if to < last => (to, RatingEnd::Given),
            (_, Some(end)) => (last, end),
            (_, None) => {
                let to = FACTOR * stated.max(question.from.unwrap_or(0.0));
                (
                    to,
                    RatingEnd::Chosen {
                        factor: to / stated,
                    },
                )
            }
        };
        let from = question.from.unwrap_or(BEGINNING * to);
        match from < to {
            true => Ok(([from, to], end)),
            false => {
                self.pressing(from)?;
                Err(SolveError::Statement {
                    subject: "speed".to_owned(),
                    problem: Cow::Borrowed("the range of speeds is empty"),
                })
            }
        }
    }

    /// Tractive tension without load, N, of a belt that presses.
    pub(super) fn pressing(&self, speed: f64) -> Result<f64, SolveError> {
        let tractive_tension = self.tension(speed)?;
        match tractive_tension > 0.0 {
            true => Ok(tractive_tension),
            false => Err(SolveError::LiftsOff {
                tractive_tension,
                speed: speed * self.drive.driver_radius(),
                is_loaded: false,
            }),
        }
    }

    /// The speed from which on the belt has no state without load, sought from another one; none up to the speed of
    /// axial waves.
    fn end(&self, start: f64) -> Result<Option<RatingEnd>, SolveError> {
        let belt = &self.drive.belt;
        let waves = (belt.axial_stiffness / belt.mass_per_length).sqrt();
        let fastest = waves / self.drive.driver_radius();
        let mut inside = start.min(0.5 * fastest);
        while let Err(error) = self.pressing(inside) {
            inside /= STEP;
            if inside < BEGINNING * BEGINNING * start {
                return Err(error);
            }
        }
        let (mut outside, found) = loop {
            let next = STEP * inside;
            if next > fastest {
                return Ok(None);
            }
            match self.tension(next) {
                Ok(tension) if tension > 0.0 => inside = next,
                found => break (next, found),
            }
        };
        let mut reason = match found {
            Ok(beyond) => {
                let ends = [self.tension(inside)?, beyond];
                let tension = |speed| self.tension(speed).unwrap_or(f64::NAN);
                return match bracketed(tension, [inside, outside], ends) {
                    Some(speed) => Ok(Some(RatingEnd::LiftsOff { speed })),
                    None => Err(SolveError::NotFound {
                        what: "speed of lift-off",
                    }),
                };
            }
            Err(reason) => reason,
        };
        for _ in 0..BISECTIONS {
            let middle = f64::midpoint(inside, outside);
            match self.pressing(middle) {
                Ok(_) => inside = middle,
                Err(error) => (outside, reason) = (middle, error),
            }
        }
        Ok(Some(RatingEnd::NoState {
            speed: inside,
            reason: Box::new(reason),
        }))
    }
}

/// A drive at a speed of its driver.
pub(in crate::answers) fn at_speed(drive: &Drive, speed: f64) -> Drive {
    let mut drive = drive.clone();
    let driver = drive.driver();
    drive.pulleys[driver].duty = Duty::Driver(speed);
    drive
}
