//! Why a belt cannot be laid round pulleys.

use crate::quantity::precision::rounded;
use thiserror::Error;

/// Why a belt cannot be laid round pulleys.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum LayoutError {
    /// A loop needs two pulleys.
    #[error("a belt loop needs at least two pulleys, not {count}")]
    TooFewPulleys {
        /// How many there are.
        count: usize,
    },
    /// A radius that is not positive, or a number that is not finite.
    #[error("pulley `{pulley}` needs a finite centre and a finite radius above 0")]
    NoPulley {
        /// The pulley.
        pulley: String,
    },
    /// Two pulleys overlap or touch.
    #[error(
        "pulleys `{one}` and `{other}` overlap: {distance:.6} m between the centres, {radii:.6} m of radii"
    )]
    Overlap {
        /// The first of them in belt order.
        one: String,
        /// The second.
        other: String,
        /// Distance between the centres, m.
        distance: f64,
        /// Sum of the radii, m.
        radii: f64,
    },
    /// The belt misses a pulley: its wrap is below zero.
    #[error("the belt does not reach pulley `{pulley}`: its wrap would be {}°", rounded(wrap.to_degrees(), 4.0))]
    NegativeWrap {
        /// The pulley.
        pulley: String,
        /// Its wrap, rad; negative.
        wrap: f64,
    },
    /// The loop turns round another number of times than was stated.
    #[error("the belt turns {found} times round the loop, not {stated} times")]
    TurningNumber {
        /// Turning number that was stated.
        stated: u32,
        /// Turning number of the pulleys.
        found: i64,
    },
    /// A span runs through a pulley that it is not laid on.
    #[error("the span from pulley `{from}` to `{to}` runs through pulley `{pulley}`")]
    SpanThroughPulley {
        /// The pulley behind the span.
        from: String,
        /// The pulley before it.
        to: String,
        /// The pulley in the way.
        pulley: String,
    },
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_wrap_just_below_zero_is_shown_without_a_sign() {
        let message = |wrap: f64| {
            let pulley = "fan".to_owned();
            LayoutError::NegativeWrap { pulley, wrap }.to_string()
        };
        let found = message(-1e-9);
        assert!(found.ends_with("would be 0°"), "{found}");
        let found = message(-1e-3);
        assert!(found.ends_with("would be -0.0573°"), "{found}");
    }
}
