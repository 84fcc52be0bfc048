//! What is varied to tighten a drive.

use crate::{Closure, Drive, Guide, Mount, TensionerLoad};

/// What is varied to tighten a drive; it follows from its closure.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Setting {
    /// The belt tension at rest in N: fixed centres with any closure, or a tensioner whose place follows from the
    /// tension. The belt length follows.
    SetupTension,
    /// The load in N·m or N of a tensioner along its coordinate at `coordinate`, by the free position of its spring
    /// or by its weight. The belt length or the position at rest stays, whichever closes the drive.
    Preload {
        /// Index of the pulley on the tensioner.
        pulley: usize,
        /// Coordinate at which the load counts, rad or m.
        coordinate: f64,
    },
}

/// What has to be set.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Set {
    /// The belt tension at rest, N.
    Tension(f64),
    /// The coordinate at which the spring of the tensioner is free, rad on an arm or m.
    FreeCoordinate {
        /// The coordinate.
        coordinate: f64,
        /// Whether it is an angle.
        is_angle: bool,
    },
    /// The weight on the tensioner, N.
    Weight(f64),
}

impl Setting {
    /// What is varied of a drive.
    pub(super) fn of(drive: &Drive) -> Self {
        match (drive.closure, drive.tensioner()) {
            (Closure::RestCoordinate(_) | Closure::UnstretchedLength(_), Some((pulley, _))) => {
                Self::Preload {
                    pulley,
                    coordinate: drive.start_coordinate(),
                }
            }
            _ => Self::SetupTension,
        }
    }

    /// The drive with another value of what is varied. The sign of a preload is that of the drive.
    pub(super) fn applied(self, drive: &Drive, value: f64) -> Drive {
        let mut drive = drive.clone();
        match self {
            Self::SetupTension => drive.closure = Closure::SetupTension(value),
            Self::Preload { pulley, coordinate } => {
                if let Mount::Tensioner(tensioner) = &mut drive.pulleys[pulley].mount {
                    let [load, _] = tensioner.load_at(coordinate);
                    match &mut tensioner.load {
                        TensionerLoad::Spring {
                            stiffness,
                            free_coordinate,
                        } => *free_coordinate = coordinate + value.copysign(load) / *stiffness,
                        TensionerLoad::Weight(weight) => *weight *= value / load.abs(),
                    }
                }
            }
        }
        drive
    }

    /// What has to be set on a drive for a value of what is varied; the drive has it already.
    pub(super) fn set(self, drive: &Drive, value: f64) -> Set {
        match (self, drive.tensioner()) {
            (Self::Preload { .. }, Some((_, tensioner))) => match tensioner.load {
                TensionerLoad::Spring {
                    free_coordinate, ..
                } => Set::FreeCoordinate {
                    coordinate: free_coordinate,
                    is_angle: matches!(tensioner.guide, Guide::Rotary { .. }),
                },
                TensionerLoad::Weight(weight) => Set::Weight(weight),
            },
            _ => Set::Tension(value),
        }
    }
}
