//! The range of an axis and its ticks.

/// The range of an axis with ticks at round numbers.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Axis {
    /// Lower end.
    pub(super) from: f64,
    /// Upper end, greater than the lower one.
    pub(super) to: f64,
    spacing: Spacing,
}

/// Where the ticks of an axis are.
#[derive(Clone, Debug, PartialEq)]
enum Spacing {
    /// At multiples of a number.
    Even(f64),
    /// At these multiples of every so manieth power of ten; distances on the axis are ratios.
    Powers(&'static [f64], i32),
}

/// What a round number is on an axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Scale {
    /// 1, 2 or 5 times a power of ten.
    Decimal,
    /// Divisors of the full circle, in degrees; decimal below 10°.
    Degrees,
    /// That of an entry of the drive file: logarithmic over a wide range of positive values, else
    /// decimal.
    Parameter,
}

/// A range is wide if the ratio of its ends is larger.
const WIDE: f64 = 20.0;

/// Up to so many decades have ticks at 1, 2 and 5 times a power of ten.
const FEW_DECADES: f64 = 2.5;

/// A longer axis has no tick at every power of ten.
const MANY_DECADES: f64 = 7.0;

/// Numbers from the larger one on, or all below the smaller one, are written as powers of ten.
const LARGE: f64 = 1e6;
const SMALL: f64 = 1e-3;

/// About so many intervals between ticks.
const INTERVALS: f64 = 5.0;

/// A range below this part of its values is widened to be drawn: there is no room for the digits of its
/// ticks, and nothing to see.
const NARROW: f64 = 1e-5;

impl Axis {
    /// The axis that the finite ones of the values span exactly.
    pub(super) fn spanning(values: impl Iterator<Item = f64> + Clone, scale: Scale) -> Self {
        let finite = values.filter(|value| value.is_finite());
        let low = finite.clone().fold(f64::INFINITY, f64::min);
        let high = finite.fold(f64::NEG_INFINITY, f64::max);
        let (low, high) = if low <= high { (low, high) } else { (0.0, 0.0) };
        let magnitude = low.abs().max(high.abs());
        let (from, to) = if high - low > NARROW * magnitude {
            (low, high)
        } else if magnitude > 0.0 {
            (low - 0.1 * magnitude, high + 0.1 * magnitude)
        } else {
            (0.0, 1.0)
        };
        let spacing = if scale == Scale::Parameter && from > 0.0 && to > WIDE * from {
            match (to / from).log10() {
                few if few <= FEW_DECADES => Spacing::Powers(&[1.0, 2.0, 5.0], 1),
                decades if decades <= MANY_DECADES => Spacing::Powers(&[1.0], 1),
                #[expect(clippy::cast_possible_truncation, reason = "at most 616 decades")]
                many => Spacing::Powers(&[1.0], (many / INTERVALS).ceil() as i32),
            }
        } else {
            Spacing::Even(scale.step((to - from) / INTERVALS))
        };
        Self { from, to, spacing }
    }

    /// The axis with room at both ends so that no curve touches the frame, except at zero.
    pub(super) fn padded(self) -> Self {
        if let Spacing::Powers(..) = self.spacing {
            let room = (self.to / self.from).powf(0.05);
            let (from, to) = (self.from / room, self.to * room);
            return Self { from, to, ..self };
        }
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
    pub(super) fn ticks(&self) -> Vec<f64> {
        match self.spacing {
            Spacing::Even(step) => {
                let tolerance = 1e-6 * step;
                let first = ((self.from - tolerance) / step).ceil();
                (0..)
                    .map(|tick| (first + f64::from(tick)) * step)
                    .take_while(|tick| *tick <= self.to + tolerance)
                    .collect()
            }
            Spacing::Powers(digits, every) => {
                #[expect(clippy::cast_possible_truncation, reason = "-324 … 308")]
                let [first, last] = [self.from, self.to].map(|end| end.log10().floor() as i32);
                (first..=last)
                    .filter(|power| power.rem_euclid(every) == 0)
                    .flat_map(|power| digits.iter().map(move |digit| digit * 10_f64.powi(power)))
                    .filter(|tick| (self.from..=self.to).contains(tick))
                    .collect()
            }
        }
    }

    /// Whether numbers on the axis are written as powers of ten.
    fn in_powers(&self) -> bool {
        let largest = self.from.abs().max(self.to.abs());
        !(SMALL..LARGE).contains(&largest)
    }

    /// Where a value is on the axis: 0 at its lower end, 1 at its upper end.
    pub(super) fn part(&self, value: f64) -> f64 {
        match self.spacing {
            Spacing::Even(_) => (value - self.from) / (self.to - self.from),
            Spacing::Powers(..) => (value / self.from).ln() / (self.to / self.from).ln(),
        }
    }

    /// The text at a tick, with the decimals that tell it from the next.
    pub(super) fn label(&self, tick: f64) -> String {
        let decimals = |unit: f64| {
            #[expect(clippy::cast_possible_truncation, reason = "clamped to 0 … 12")]
            let decimals = (-unit.log10().floor()).clamp(0.0, 12.0) as usize;
            decimals
        };
        // No trailing zero.
        let power = |decimals: usize| {
            let text = format!("{tick:.decimals$e}");
            text.parse().map_or(text, |tick: f64| format!("{tick:e}"))
        };
        match self.spacing {
            Spacing::Even(step) => {
                // Adding zero makes a negative zero positive.
                let round = (tick / step).round() * step + 0.0;
                if round == 0.0 && self.in_powers() {
                    "0".to_owned()
                } else if self.in_powers() {
                    power(decimals(step / 10_f64.powf(round.abs().log10().floor())))
                } else {
                    format!("{round:.0$}", decimals(step))
                }
            }
            Spacing::Powers(..) if self.in_powers() || self.from < SMALL => power(0),
            Spacing::Powers(..) => format!("{tick:.0$}", decimals(tick)),
        }
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
        assert_eq!(labels(&axis), ["-0.10", "-0.05", "0.00", "0.05", "0.10"]);
    }

    fn labels(axis: &Axis) -> Vec<String> {
        let ticks = axis.ticks().into_iter();
        ticks.map(|tick| axis.label(tick)).collect()
    }

    #[test]
    fn a_wide_range_has_powers_of_ten() {
        let stiffness = axis(&[1e5, 1e10], Scale::Parameter).padded();
        let powers = ["1e5", "1e6", "1e7", "1e8", "1e9", "1e10"];
        assert_eq!(labels(&stiffness), powers);
        assert_eq!((1000.0 * stiffness.part(10_f64.powf(7.5))).round(), 500.0);
        let load = axis(&[210.0, 8332.8], Scale::Parameter).padded();
        let round = ["200", "500", "1000", "2000", "5000"];
        assert_eq!(labels(&load)[..5], round);
        assert!(load.from < 210.0 && load.to > 8332.8);
        let small = axis(&[1e-5, 3e-4], Scale::Parameter);
        assert_eq!(labels(&small)[..4], ["1e-5", "2e-5", "5e-5", "1e-4"]);
        let friction = axis(&[0.02, 2.0], Scale::Parameter);
        assert_eq!(labels(&friction)[..4], ["0.02", "0.05", "0.1", "0.2"]);
        let longest = axis(&[1e-12, 1e12], Scale::Parameter);
        assert_eq!(labels(&longest)[..3], ["1e-10", "1e-5", "1e0"]);
    }

    #[test]
    fn other_ranges_are_decimal() {
        for values in [[500.0, 9000.0], [0.0, 1e9], [-1.0, 1e3]] {
            let parameter = axis(&values, Scale::Parameter);
            assert_eq!(parameter, axis(&values, Scale::Decimal));
        }
    }

    #[test]
    fn labels_of_large_and_small_numbers_are_short() {
        let large = axis(&[0.0, 8e9], Scale::Decimal);
        assert_eq!(labels(&large), ["0", "2e9", "4e9", "6e9", "8e9"]);
        let narrow = axis(&[9.4e6, 1.1e7], Scale::Decimal);
        assert_eq!(labels(&narrow), ["9.5e6", "1e7", "1.05e7", "1.1e7"]);
        let small = axis(&[-2e-7, 4e-7], Scale::Decimal);
        assert_eq!(labels(&small), ["-2e-7", "0", "2e-7", "4e-7"]);
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
            &[-3.0, -3.0 - 1e-6],
            &[f64::NAN],
        ] {
            for scale in [Scale::Decimal, Scale::Degrees, Scale::Parameter] {
                let axis = axis(values, scale).padded();
                assert!(
                    axis.from < axis.to && (2..20).contains(&axis.ticks().len()),
                    "{axis:?}"
                );
            }
        }
    }
}
