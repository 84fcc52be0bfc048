//! The order of the unknown parameters of a running loop.

use super::seat::Seat;

/// Index of G among the parameters.
pub(super) const FLOW: usize = 0;

/// Where the parameters stand: G, the coordinate of the tensioner, the speeds of all pulleys with a segment but the
/// driver, the lengths of all segments, and the tension `T_o` of EPP friction.
#[derive(Clone, Debug)]
pub(super) struct Unknowns {
    /// The coordinate of the tensioner.
    pub(super) coordinate: Option<usize>,
    /// The speed of each pulley.
    pub(super) speeds: Vec<Option<usize>>,
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
        let mut first_length = FLOW + 1 + usize::from(has_tensioner);
        let speeds = seats.iter().enumerate().map(|(pulley, seat)| {
            let is_unknown = pulley != driver && !matches!(seat, Seat::Idle);
            first_length += usize::from(is_unknown);
            is_unknown.then_some(first_length - 1)
        });
        Self {
            speeds: speeds.collect(),
            coordinate: has_tensioner.then_some(FLOW + 1),
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
