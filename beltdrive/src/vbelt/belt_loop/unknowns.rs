//! The order of the unknown parameters of a running loop.

use super::seat::Seat;

/// Index of the rim speed ν of the driver among the parameters.
pub(super) const DRIVER_RIM_SPEED: usize = 0;

/// Where the parameters stand: the rim speed of the driver (see `contact`), the coordinate of the tensioner, the rim speeds of the
/// other pulleys with a segment, the lengths of all segments, and the tension `T_o` of EPP friction.
#[derive(Clone, Debug)]
pub(super) struct Unknowns {
    /// The coordinate of the tensioner.
    pub(super) coordinate: Option<usize>,
    /// The rim speed of each pulley but idlers.
    pub(super) rim_speeds: Vec<Option<usize>>,
    /// The length of the first segment.
    pub(super) first_length: usize,
    /// Whether `T_o` is one.
    has_reference: bool,
}

impl Unknowns {
    /// Of a loop with or without a tensioner, and with or without EPP friction.
    pub(super) fn new(
        seats: &[Seat],
        driver: usize,
        has_tensioner: bool,
        has_reference: bool,
    ) -> Self {
        let mut first_length = DRIVER_RIM_SPEED + 1 + usize::from(has_tensioner);
        let rim_speeds = seats.iter().enumerate().map(|(pulley, seat)| match seat {
            Seat::Idle => None,
            _ if pulley == driver => Some(DRIVER_RIM_SPEED),
            _ => {
                first_length += 1;
                Some(first_length - 1)
            }
        });
        Self {
            rim_speeds: rim_speeds.collect(),
            coordinate: has_tensioner.then_some(DRIVER_RIM_SPEED + 1),
            first_length,
            has_reference,
        }
    }

    /// Index of `T_o`, behind the lengths of so many segments.
    pub(super) fn reference(&self, segments: usize) -> Option<usize> {
        self.has_reference.then_some(self.first_length + segments)
    }

    /// Number of parameters with so many segments.
    pub(super) fn count(&self, segments: usize) -> usize {
        self.first_length + segments + usize::from(self.has_reference)
    }
}
