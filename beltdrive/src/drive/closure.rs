//! What closes a drive.

/// What fixes how tight the belt is. With a tensioner each of them stands beside its equilibrium.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Closure {
    /// Length of the belt without tension, m.
    UnstretchedLength(f64),
    /// Uniform belt tension of the loop at rest without torques, N.
    SetupTension(f64),
    /// Belt tension of a span of the running loop.
    SpanTension {
        /// Index of the span: that of the pulley it leaves.
        span: usize,
        /// Belt tension T there, N.
        tension: f64,
    },
    /// Tractive tension of a span of the running loop.
    SpanTractiveTension {
        /// Index of the span: that of the pulley it leaves.
        span: usize,
        /// Tractive tension F = T − G V there, N.
        tension: f64,
    },
    /// Coordinate of the tensioner at rest, rad or m.
    RestCoordinate(f64),
    /// The tensions of both spans of a drive with two pulleys ([`TwoPulleys`](crate::TwoPulleys)): they also
    /// decide what the driven pulley takes.
    BothSpans(Load),
}

impl Closure {
    /// The number that it gives, SI; of two tensions that of the slack span.
    pub(crate) fn value(self) -> f64 {
        match self {
            Self::UnstretchedLength(value)
            | Self::SetupTension(value)
            | Self::SpanTension { tension: value, .. }
            | Self::SpanTractiveTension { tension: value, .. }
            | Self::RestCoordinate(value) => value,
            Self::BothSpans(load) => load.slack.value(),
        }
    }
}

/// What is prescribed for the two spans.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Load {
    /// Tension of the slack span.
    pub slack: SpanTension,
    /// Tension of the tight span; at least that of the slack span.
    pub tight: SpanTension,
}

/// What the tension of a span is prescribed by.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SpanTension {
    /// Tractive tension F = T − G V, N.
    Tractive(f64),
    /// Belt tension T, N.
    Belt(f64),
    /// Torque of the driven pulley, N·m, not negative: the tension follows from that of the other
    /// span. One span at most; flat belts only.
    DrivenTorque(f64),
}

impl SpanTension {
    /// The prescribed number, N or N·m, whatever it is.
    pub fn value(self) -> f64 {
        match self {
            Self::Tractive(value) | Self::Belt(value) | Self::DrivenTorque(value) => value,
        }
    }

    /// Another number of the same kind.
    pub(crate) fn with_value(self, value: f64) -> Self {
        match self {
            Self::Tractive(_) => Self::Tractive(value),
            Self::Belt(_) => Self::Belt(value),
            Self::DrivenTorque(_) => Self::DrivenTorque(value),
        }
    }
}
