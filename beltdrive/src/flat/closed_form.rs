//! The whole drive: the speed of the belt, and the contact with both pulleys.

use super::geometry::OpenBelt;
use super::{DRIVEN, DRIVER};
use crate::friction::rim::contact::{Arc, Contact};
use crate::friction::rim::traction::Traction;
use crate::mechanics::root::bracketed;
use crate::{BeltKind, LimitReason, NormalForce, Role, SpanTension, TwoPulleys};

/// Most steps of the secant method for the belt speed, which takes three or four unless the driver all
/// but slips.
const MAX_STEPS: usize = 12;

/// The steady state of a flat-belt drive in closed form.
#[derive(Clone, Debug)]
pub struct ClosedForm {
    /// The belt around the pulleys.
    pub(super) geometry: OpenBelt,
    /// Speed c = G/m of the unstretched belt, m/s.
    pub(super) speed: f64,
    /// Belt tension of the slack and of the tight span, N.
    pub(super) tension: [f64; 2],
    /// Contact with the driven pulley and with the driver.
    pub(super) contact: [Contact; 2],
    /// Evaluations of scalar equations that it took.
    pub(super) evaluations: usize,
}

/// Why there is no steady state.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Refusal {
    /// The load is too large.
    Slips(LimitReason),
    /// The tight tension is below the slack one.
    Backwards {
        /// Tension of the slack and of the tight span, N.
        tension: [f64; 2],
    },
    /// The belt does not press on the pulleys.
    LiftsOff {
        /// Tension of the slack span, N.
        tension: f64,
        /// Belt speed there, m/s.
        speed: f64,
        /// Momentum flow G V there, N.
        centrifugal: f64,
    },
}

impl ClosedForm {
    /// The steady state of a flat-belt drive.
    ///
    /// The driver turns with the belt at its reference tension, `ω₂ R₂ = c (1 + T_o/EA)`, which is one
    /// equation for c. A drive slips grossly if a pulley does not carry the load at the speed at which
    /// the driver would take the belt along without slip.
    ///
    /// # Panics
    /// If the drive is none of those that [`crate::solve`] passes on.
    pub(super) fn find(drive: &TwoPulleys) -> Result<Self, Refusal> {
        let statement = Statement::new(drive);
        let rim = drive.driver_speed * drive.driver_radius;
        let unslipped = statement.unslipped_speed(rim);
        let loaded = statement.at(unslipped);
        statement.check(&loaded)?;
        let taken_along =
            |contact: &Contact| rim / (1.0 + contact.arc.belt.strain(contact.reference()));
        let mut evaluations = 0;
        let mut speed = unslipped;
        let mut settled = None;
        // The secant method on the fixed point, which begins with an iteration of it.
        let mut last: Option<[f64; 2]> = None;
        for _ in 0..MAX_STEPS {
            let Some(driver) = statement.contact(&statement.at(speed), DRIVER) else {
                break;
            };
            evaluations += driver.evaluations;
            let next = taken_along(&driver);
            let change = next - speed;
            if change.abs() <= 2.0 * f64::EPSILON * speed {
                settled = Some(driver);
                break;
            }
            let here = [speed, change];
            let slope = last.map_or(-1.0, |[before, changed]| {
                (change - changed) / (speed - before)
            });
            speed = match slope < 0.0 {
                true => (speed - change / slope).clamp(0.5 * speed, unslipped),
                false => next,
            };
            last = Some(here);
        }
        if settled.is_none() {
            // The driver all but slips: the belt lags behind.
            let excess = |speed: f64| {
                let driver = statement.contact(&statement.at(speed), DRIVER);
                driver.map_or(1.0, |driver| speed / taken_along(&driver) - 1.0)
            };
            let slowest = f64::EPSILON * unslipped;
            let ends = [slowest, unslipped];
            let slips = Refusal::Slips(LimitReason::Capstan(Role::Driver));
            speed = bracketed(excess, ends, ends.map(excess)).ok_or(slips)?;
        }
        let state = statement.at(speed);
        statement.check(&state)?;
        let slips = |pulley| Refusal::Slips(LimitReason::Capstan(pulley));
        let driver = settled.or_else(|| statement.contact(&state, DRIVER));
        let contact = [
            statement
                .contact(&state, DRIVEN)
                .ok_or(slips(Role::Driven))?,
            driver.ok_or(slips(Role::Driver))?,
        ];
        evaluations += contact[DRIVEN].evaluations;
        let closed_form = Self {
            geometry: statement.geometry,
            speed,
            tension: state.tension,
            contact,
            evaluations,
        };
        match closed_form.rim_speed(DRIVEN) > 0.0 {
            true => Ok(closed_form),
            false => Err(Refusal::Slips(LimitReason::DrivenSlips)),
        }
    }

    /// Circumferential speed `c (1 + T_o/EA)` of a pulley, m/s.
    pub(super) fn rim_speed(&self, pulley: usize) -> f64 {
        let contact = &self.contact[pulley];
        self.speed * (1.0 + contact.arc.belt.strain(contact.reference()))
    }
}

/// A drive as the closed form needs it.
struct Statement<'d> {
    drive: &'d TwoPulleys,
    geometry: OpenBelt,
    convention: NormalForce,
}

/// The loaded belt at a speed.
struct Loaded {
    /// Speed c of the unstretched belt, m/s.
    speed: f64,
    /// Belt tension of the slack and of the tight span, N.
    tension: [f64; 2],
    /// The arcs of the driven pulley and of the driver.
    arc: [Arc; 2],
}

impl<'d> Statement<'d> {
    fn new(drive: &'d TwoPulleys) -> Self {
        let BeltKind::Flat { normal_force } = drive.belt.kind else {
            panic!("a flat belt was expected")
        };
        Self {
            drive,
            geometry: OpenBelt::new(drive),
            convention: drive.law.row().convention(normal_force),
        }
    }

    /// Speed c of the belt if the driver took it along without slip, m/s: c (1 + T/EA) = R₂ ω₂ at the
    /// tension of the tight span. Not below the critical speed if there is none below it.
    fn unslipped_speed(&self, rim: f64) -> f64 {
        let belt = self.drive.belt;
        let critical = (belt.axial_stiffness / belt.mass_per_length).sqrt();
        let excess = |speed: f64| {
            let [_, tight] = self.at(speed).tension;
            speed * (1.0 + tight / belt.axial_stiffness) / rim - 1.0
        };
        let fastest = rim.min(critical * (1.0 - 1e-9));
        bracketed(excess, [0.0, fastest], [-1.0, excess(fastest)]).unwrap_or(rim)
    }

    /// The belt and its load at a speed c.
    fn at(&self, speed: f64) -> Loaded {
        let (drive, belt) = (self.drive, self.drive.belt);
        let axial = belt.axial_stiffness;
        let kinetic = belt.mass_per_length * speed * speed;
        let share = 1.0 - kinetic / axial;
        let tension = |span: SpanTension| match span {
            SpanTension::Tractive(force) => Some((force + kinetic) / share),
            SpanTension::Belt(tension) => Some(tension),
            SpanTension::DrivenTorque(_) => None,
        };
        let traction = |slack: f64| {
            let speed = match self.convention {
                NormalForce::Thesis => speed * (1.0 + slack / axial),
                NormalForce::Inertia | NormalForce::Exact => speed,
            };
            Traction::new(self.convention, belt.mass_per_length, axial, speed)
        };
        let by_torque = |torque: f64| torque / drive.driven_radius;
        let (moving, slack, change) = match [drive.load.slack, drive.load.tight] {
            [SpanTension::DrivenTorque(torque), tight] => {
                let tight = tension(tight).expect("one span has a tension");
                let change = by_torque(torque);
                // The slack tension enters the speed of the convention `thesis` alone.
                let mut slack = tight - change;
                for _ in 0..MAX_STEPS {
                    let moving = traction(slack);
                    slack = moving.tension(moving.of_tension(tight) - change);
                }
                (traction(slack), slack, change)
            }
            [slack, SpanTension::DrivenTorque(torque)] => {
                let slack = tension(slack).expect("one span has a tension");
                (traction(slack), slack, by_torque(torque))
            }
            [slack, tight] => {
                let difference = match [slack, tight] {
                    [SpanTension::Belt(slack), SpanTension::Belt(tight)] => tight - slack,
                    [SpanTension::Tractive(slack), SpanTension::Tractive(tight)] => {
                        (tight - slack) / share
                    }
                    spans => {
                        let [slack, tight] = spans.map(|span| tension(span).unwrap_or(f64::NAN));
                        tight - slack
                    }
                };
                let slack = tension(slack).expect("a tension");
                let moving = traction(slack);
                (moving, slack, difference * moving.stiffness / axial)
            }
        };
        let low = moving.of_tension(slack);
        let radius = [drive.driven_radius, drive.driver_radius];
        let arc = |pulley: usize, sense| Arc {
            belt: moving,
            sense,
            slip_rate: moving.slip_rate(drive.friction_coefficient, radius[pulley]),
            length: radius[pulley] * self.geometry.wrap[pulley],
            low,
            change,
        };
        Loaded {
            speed,
            tension: [slack, moving.tension(low + change)],
            arc: [arc(DRIVEN, 1.0), arc(DRIVER, -1.0)],
        }
    }

    /// Whether the belt presses on the pulleys and both carry the load. Where both do not, the one with
    /// less capacity lets go first; with equal capacities the driver is named.
    fn check(&self, loaded: &Loaded) -> Result<(), Refusal> {
        let [driven, driver] = &loaded.arc;
        let tension = loaded.tension;
        let is_subcritical = driven.belt.stiffness > 0.0;
        if driven.change < 0.0 && is_subcritical {
            return Err(Refusal::Backwards { tension });
        }
        // Overflow is no pressure. The convention `thesis` leaves inertia out of the normal force, but a belt
        // lifts off by it all the same.
        let belt = self.drive.belt;
        let kinetic = belt.mass_per_length * loaded.speed * loaded.speed;
        let tractive = tension[0] * (1.0 - kinetic / belt.axial_stiffness) - kinetic;
        let presses =
            driven.low > 0.0 && tractive > 0.0 && driven.change.is_finite() && is_subcritical;
        if !presses {
            let [tension, _] = tension;
            let speed = loaded.speed * (1.0 + tension / belt.axial_stiffness);
            return Err(Refusal::LiftsOff {
                tension,
                speed,
                centrifugal: belt.mass_per_length * loaded.speed * speed,
            });
        }
        let first = match driven.capacity() < driver.capacity() {
            true => (driven, Role::Driven),
            false => (driver, Role::Driver),
        };
        match first {
            (arc, pulley) if arc.load() >= arc.capacity() => {
                Err(Refusal::Slips(LimitReason::Capstan(pulley)))
            }
            _ => Ok(()),
        }
    }

    /// The contact with a pulley, unless it slips grossly.
    fn contact(&self, loaded: &Loaded, pulley: usize) -> Option<Contact> {
        let arc = loaded.arc[pulley];
        let law = self.drive.law;
        law.contact(arc, loaded.speed, law.parameter().unwrap_or_default())
    }
}
