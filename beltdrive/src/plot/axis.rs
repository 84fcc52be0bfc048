//! The range of an axis and its ticks.

use plotters::coord::ranged1d::{KeyPointHint, NoDefaultFormatting, Ranged, ValueFormatter};
use std::ops::Range;

/// The range of an axis with ticks at round numbers.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Axis {
    /// Lower end.
    pub(super) from: f64,
    /// Upper end, greater than the lower one.
    pub(super) to: f64,
    step: f64,
}

/// What a round number is on an axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Scale {
    /// 1, 2 or 5 times a power of ten.
    Decimal,
    /// Divisors of the full circle, in degrees; decimal below 10°.
    Degrees,
}

/// About so many intervals between ticks.
const INTERVALS: f64 = 5.0;

/// A range below this part of its values is rounding noise, and widened to be drawn.
const NOISE: f64 = 1e-9;

impl Axis {
    /// The axis that the finite ones of the values span exactly.
    pub(super) fn spanning(values: impl Iterator<Item = f64> + Clone, scale: Scale) -> Self {
        let finite = values.filter(|value| value.is_finite());
        let low = finite.clone().fold(f64::INFINITY, f64::min);
        let high = finite.fold(f64::NEG_INFINITY, f64::max);
        let (low, high) = if low <= high { (low, high) } else { (0.0, 0.0) };
        let magnitude = low.abs().max(high.abs());
        let (from, to) = if high - low > NOISE * magnitude {
            (low, high)
        } else if magnitude > 0.0 {
            (low - 0.1 * magnitude, high + 0.1 * magnitude)
        } else {
            (0.0, 1.0)
        };
        Self {
            from,
            to,
            step: scale.step((to - from) / INTERVALS),
        }
    }

    /// The axis with room at both ends so that no curve touches the frame, except at zero.
    pub(super) fn padded(self) -> Self {
        let room = 0.05 * (self.to - self.from);
        let from = if self.from >= 0.0 {
            (self.from - room).max(0.0)
        } else {
            self.from - room
        };
        let to = if self.to <= 0.0 {
            (self.to + room).min(0.0)
        } else {
            self.to + room
        };
        Self { from, to, ..self }
    }

    /// The ticks within the range.
    fn ticks(&self) -> Vec<f64> {
        let tolerance = 1e-6 * self.step;
        let first = ((self.from - tolerance) / self.step).ceil();
        (0..)
            .map(|tick| (first + f64::from(tick)) * self.step)
            .take_while(|tick| *tick <= self.to + tolerance)
            .collect()
    }
}

impl Ranged for Axis {
    type FormatOption = NoDefaultFormatting;
    type ValueType = f64;

    fn map(&self, value: &f64, (first, last): (i32, i32)) -> i32 {
        let part = (value - self.from) / (self.to - self.from);
        #[expect(
            clippy::cast_possible_truncation,
            reason = "values lie within the axis"
        )]
        let offset = (part * f64::from(last - first)).round() as i32;
        first + offset
    }

    fn key_points<Hint: KeyPointHint>(&self, hint: Hint) -> Vec<f64> {
        if hint.weight().allow_light_points() {
            Vec::new()
        } else {
            self.ticks()
        }
    }

    fn range(&self) -> Range<f64> {
        self.from..self.to
    }
}

impl ValueFormatter<f64> for Axis {
    /// The text at a tick, with the decimals that tell it from the next.
    fn format_ext(&self, tick: &f64) -> String {
        #[expect(clippy::cast_possible_truncation, reason = "clamped to 0 … 12")]
        let decimals = (-self.step.log10().floor()).clamp(0.0, 12.0) as usize;
        // Adding zero makes a negative zero positive.
        let tick = (tick / self.step).round() * self.step + 0.0;
        format!("{tick:.decimals$}")
    }
}

impl Scale {
    /// The smallest round number that is not below an interval.
    fn step(self, interval: f64) -> f64 {
        let degrees = [10.0, 15.0, 30.0, 45.0, 60.0, 90.0, 180.0, 360.0];
        let round = degrees.into_iter().find(|step| *step >= interval);
        match round {
            Some(step) if self == Self::Degrees && interval > 5.0 => step,
            _ => {
                let power = 10_f64.powf(interval.log10().floor());
                let digit = [1.0, 2.0, 5.0]
                    .into_iter()
                    .find(|digit| digit * power >= interval);
                digit.unwrap_or(10.0) * power
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn axis(values: &[f64], scale: Scale) -> Axis {
        Axis::spanning(values.iter().copied(), scale)
    }

    #[test]
    fn ticks_are_round() {
        let tension = axis(&[171.0, 771.0], Scale::Decimal).padded();
        assert_eq!(tension.ticks(), [200.0, 400.0, 600.0, 800.0]);
        let wrap = axis(&[0.0, 198.3], Scale::Degrees);
        assert_eq!(wrap.ticks(), [0.0, 45.0, 90.0, 135.0, 180.0]);
        assert_eq!((wrap.from, wrap.to), (0.0, 198.3));
    }

    #[test]
    fn labels_carry_the_decimals_of_the_step() {
        let axis = axis(&[-0.11, 0.1], Scale::Decimal).padded();
        let labels: Vec<_> = axis
            .ticks()
            .into_iter()
            .map(|tick| axis.format_ext(&tick))
            .collect();
        assert_eq!(labels, ["-0.10", "-0.05", "0.00", "0.05", "0.10"]);
    }

    #[test]
    fn padding_keeps_zero_at_the_end() {
        let axis = axis(&[0.0, 10.0], Scale::Decimal).padded();
        assert_eq!((axis.from, axis.to), (0.0, 10.5));
    }

    #[test]
    fn no_range_is_empty() {
        for values in [
            &[][..],
            &[0.0],
            &[171.0, 171.0],
            &[-3.0, -3.0 - 1e-12],
            &[f64::NAN],
        ] {
            for scale in [Scale::Decimal, Scale::Degrees] {
                let axis = axis(values, scale).padded();
                assert!(
                    axis.from < axis.to && (2..20).contains(&axis.ticks().len()),
                    "{axis:?}"
                );
            }
        }
    }
}
