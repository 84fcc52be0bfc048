//! A drive as its engineer describes it, in SI units.

pub(crate) mod check;
mod closure;
mod direction;
pub(crate) mod layout;
mod number;
mod pulley;
mod service;
mod tensioner;
mod two_pulleys;

pub use closure::{Closure, Load, SpanTension};
pub(crate) use direction::Direction;
pub(crate) use number::Number;
pub use pulley::{Duty, Mount, Pulley};
pub use service::{BendingLoss, GivenLosses, LoadCase, Requirements, Service};
pub use tensioner::{Guide, Tensioner, TensionerLoad};
pub use two_pulleys::TwoPulleys;

use crate::{Belt, FrictionLaw};
use layout::{Layout, LayoutError, PlacedPulley, Sense};

/// A belt round two or more pulleys: everything that a drive file states and that decides the steady state.
#[derive(Clone, Debug, PartialEq)]
pub struct Drive {
    /// A name for outputs and figures.
    pub title: Option<String>,
    /// The belt.
    pub belt: Belt,
    /// How friction depends on slip: [`FrictionLaw::Bristle`] on V-belts only, [`FrictionLaw::CreepRate`] on
    /// flat belts with a normal force other than [`crate::NormalForce::Thesis`] only.
    pub law: FrictionLaw,
    /// Sense in which the belt runs round the loop.
    pub sense: Sense,
    /// Turning number ν: 1 for a plain loop, 0 for a crossed belt round two pulleys.
    pub turning_number: u32,
    /// The pulleys in the order in which the belt meets them; one of them is the driver.
    pub pulleys: Vec<Pulley>,
    /// What fixes how tight the belt is.
    pub closure: Closure,
}

impl Drive {
    /// The belt round the pulleys with the tensioner, if there is one, at a coordinate.
    ///
    /// # Errors
    /// As [`Layout::new`].
    pub fn layout(&self, coordinate: f64) -> Result<Layout, LayoutError> {
        let placed = |pulley: &Pulley| PlacedPulley {
            name: pulley.name.clone(),
            centre: match &pulley.mount {
                Mount::Fixed(centre) => *centre,
                Mount::Tensioner(tensioner) => tensioner.guide.centre(coordinate)[0],
            },
            radius: pulley.radius,
            side: pulley.side,
        };
        let pulleys = self.pulleys.iter().map(placed).collect();
        Layout::new(self.sense, self.turning_number, pulleys)
    }

    /// The coordinate from which the equilibrium of the tensioner is sought, rad or m; without one it means
    /// nothing.
    pub(crate) fn start_coordinate(&self) -> f64 {
        match (self.closure, self.tensioner()) {
            (Closure::RestCoordinate(coordinate), _) => coordinate,
            (_, Some((_, tensioner))) => tensioner.start_coordinate,
            (_, None) => 0.0,
        }
    }

    /// The drive, which has two pulleys, as a loop that is closed by its slack tractive tension in N, with the torque of
    /// the driven pulley in N·m.
    pub(crate) fn as_loop(&self, torque: f64, slack: f64) -> Self {
        let mut drive = self.clone();
        let driver = drive.driver();
        drive.pulleys[1 - driver].duty = Duty::Torque(torque);
        drive.closure = Closure::SpanTractiveTension {
            span: driver,
            tension: slack,
        };
        drive
    }

    /// Whether no pulley has a torque.
    pub(crate) fn is_idle(&self) -> bool {
        let mut pulleys = self.pulleys.iter();
        pulleys.all(|pulley| pulley.duty.torque_at(1.0) == 0.0)
    }

    /// Multiplies the torques and powers of all pulleys.
    pub(crate) fn multiply_load(&mut self, factor: f64) {
        for pulley in &mut self.pulleys {
            if let Duty::Torque(load) | Duty::Power(load) = &mut pulley.duty {
                *load *= factor;
            }
        }
    }

    /// Whether its belt is at rest as that of another drive, as far as the statement says: they differ in speeds, torques
    /// and powers alone.
    pub(crate) fn is_at_rest_as(&self, other: &Self) -> bool {
        let mut same = other.clone();
        for (pulley, here) in same.pulleys.iter_mut().zip(&self.pulleys) {
            pulley.duty = here.duty;
        }
        same == *self
    }

    /// The factor by which all torques or powers are those of another drive, if the two differ in nothing else; a
    /// tension that closes them may differ by rounding.
    pub(crate) fn load_factor_over(&self, other: &Self) -> Option<f64> {
        let mut same = other.clone();
        let mut factor = None;
        for (pulley, here) in same.pulleys.iter_mut().zip(&self.pulleys) {
            if let (Duty::Torque(load), Duty::Torque(own)) | (Duty::Power(load), Duty::Power(own)) =
                (pulley.duty, here.duty)
            {
                if load == 0.0 && own == 0.0 {
                    continue;
                }
                let known = *factor.get_or_insert(own / load);
                if !is_near(own, known * load) {
                    return None;
                }
                pulley.duty = here.duty;
            }
        }
        if let (
            Closure::SpanTractiveTension { span, tension },
            Closure::SpanTractiveTension { tension: own, .. },
        ) = (same.closure, self.closure)
            && is_near(own, tension)
        {
            same.closure = Closure::SpanTractiveTension { span, tension: own };
        }
        factor.filter(|factor| same == *self && *factor > 0.0)
    }

    /// The index of the driver.
    pub(crate) fn driver(&self) -> usize {
        let mut pulleys = self.pulleys.iter();
        let driver = pulleys.position(|pulley| matches!(pulley.duty, Duty::Driver(_)));
        driver.unwrap_or(0)
    }

    /// Angular speed of the driver, rad/s.
    pub(crate) fn driver_speed(&self) -> f64 {
        match self.pulleys[self.driver()].duty {
            Duty::Driver(speed) => speed,
            Duty::Torque(_) | Duty::Power(_) | Duty::Driven => 0.0,
        }
    }

    /// Radius of the driver, m.
    pub(crate) fn driver_radius(&self) -> f64 {
        self.pulleys[self.driver()].radius
    }

    /// Circumferential speed R ω of the driver, m/s.
    pub(crate) fn rim_speed(&self) -> f64 {
        let rims = self.pulleys.iter().map(|pulley| match pulley.duty {
            Duty::Driver(speed) => speed * pulley.radius,
            Duty::Torque(_) | Duty::Power(_) | Duty::Driven => 0.0,
        });
        rims.sum()
    }

    /// The index of the pulley on the tensioner, and the tensioner.
    pub(crate) fn tensioner(&self) -> Option<(usize, &Tensioner)> {
        let mounts = self.pulleys.iter().map(|pulley| &pulley.mount);
        mounts.enumerate().find_map(|(index, mount)| match mount {
            Mount::Tensioner(tensioner) => Some((index, tensioner)),
            Mount::Fixed(_) => None,
        })
    }
}

/// Whether two numbers differ by rounding: those of a drive come from a few operations.
fn is_near(one: f64, other: f64) -> bool {
    (one - other).abs() <= 1e-12 * one.abs().max(other.abs())
}
