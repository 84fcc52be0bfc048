//! The numbers of a running loop, as scalars that may vary.

use super::loads::Loads;
use crate::{BeltKind, Drive, NormalForce};
use bvp::Real;

/// Reads numbers of a drive as scalars.
pub(super) trait Read<S>: Fn(&dyn Fn(&Drive) -> f64) -> S {}

impl<S, F: Fn(&dyn Fn(&Drive) -> f64) -> S> Read<S> for F {}

/// Reads the numbers of a drive as constants.
pub(super) fn constant<S: Real>(drive: &Drive) -> impl Read<S> {
    |of| S::from_f64(of(drive))
}

/// The numbers of a loop with its torques.
pub(super) struct Numbers<S = f64> {
    pub(super) convention: NormalForce,
    /// Index of the driver.
    pub(super) driver: usize,
    /// Mass m per length of the belt, kg/m.
    pub(super) mass_per_length: S,
    /// Axial stiffness EA, N.
    pub(super) axial_stiffness: S,
    /// Parameter of the friction law beside the coefficient, SI; 0 if it has none.
    pub(super) parameter: S,
    /// The pulleys.
    pub(super) rims: Vec<Rim<S>>,
    /// Angular speed ω of the driver, rad/s.
    pub(super) driver_speed: S,
    /// Circumferential speed R ω of the driver, m/s.
    pub(super) rim: S,
    pub(super) loads: Loads<S>,
}

/// The rim of a pulley.
#[derive(Clone, Copy)]
pub(super) struct Rim<S = f64> {
    /// Radius R, m.
    pub(super) radius: S,
    /// Coefficient of friction μ.
    pub(super) friction_coefficient: S,
}

impl<S: Real> Numbers<S> {
    /// The convention for the normal force in whose equations a drive with a flat belt is solved.
    pub(super) fn convention(drive: &Drive) -> NormalForce {
        match drive.belt.kind {
            BeltKind::Flat { normal_force } => drive.law.row().convention(normal_force),
            BeltKind::V(_) => panic!("a flat belt was expected"),
        }
    }

    /// Those of a drive with a flat belt and a torque of each pulley, N·m.
    pub(super) fn new(drive: &Drive, torques: &[S], read: impl Read<S>) -> Self {
        let driver = drive.driver();
        let rims = (0..drive.pulleys.len()).map(|pulley| Rim {
            radius: read(&|drive| drive.pulleys[pulley].radius),
            friction_coefficient: read(&|drive| drive.pulleys[pulley].friction_coefficient),
        });
        let rims: Vec<_> = rims.collect();
        let driver_speed = read(&Drive::driver_speed);
        let radii = rims.iter().map(|rim| rim.radius);
        Self {
            convention: Self::convention(drive),
            driver,
            mass_per_length: read(&|drive| drive.belt.mass_per_length),
            axial_stiffness: read(&|drive| drive.belt.axial_stiffness),
            parameter: read(&|drive| drive.law.parameter().unwrap_or_default()),
            driver_speed,
            rim: driver_speed * rims[driver].radius,
            loads: Loads::new(driver, radii.zip(torques.iter().copied())),
            rims,
        }
    }
}
