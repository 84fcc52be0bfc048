//! How far the pulleys have turned, and how fast it is shown.

use super::super::round;
use crate::quantity::precision::six_digits;
use crate::transient::{BeltAlongLoop, History};
use std::f64::consts::TAU;

/// Angles in rad by which each pulley has turned since time 0 at belts in the order of time, by belt: the sums of the means
/// of the speeds at samples, which are exact where speeds change evenly between samples.
pub(super) fn turned(history: &History, belts: &[BeltAlongLoop]) -> Vec<Vec<f64>> {
    let mut samples = history.samples.iter().peekable();
    let mut angles = vec![0.0; history.pulleys.len()];
    // The time and the speeds up to which the angles are.
    let mut time = 0.0;
    let mut speeds: Vec<f64> = vec![];
    let mut until = |to: f64, there: &[f64]| {
        if !speeds.is_empty() {
            for (angle, (from, to_speed)) in angles.iter_mut().zip(speeds.iter().zip(there)) {
                *angle += 0.5 * (to - time) * (from + to_speed);
            }
        }
        time = to;
        speeds = there.to_vec();
        angles.clone()
    };
    let turned = belts.iter().map(|belt| {
        while let Some(sample) = samples.next_if(|sample| sample.time <= belt.time) {
            let there = sample.pulleys.iter().map(|pulley| pulley.angular_speed);
            until(sample.time, &there.collect::<Vec<_>>());
        }
        until(belt.time, &belt.angular_speeds)
    });
    turned.collect()
}

/// Time in which a turn of the fastest pulley is shown, s: slow enough to see a pulley fall behind and slip spread over an
/// arc; the belt of a small drive then passes round in some ten seconds.
const TURN: f64 = 3.0;

/// Shortest and longest time of playing, s, before it is rounded: what changes in less is missed, and nobody watches more.
const SHORTEST: f64 = 5.0;
const LONGEST: f64 = 40.0;

/// How fast a run is shown: a round number of times slower or faster than it is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Pace {
    /// Time from the first frame to the last one, s.
    span: f64,
    /// Times slower than it is.
    slower: f64,
}

impl Pace {
    /// The pace of frames at which the pulleys have turned by angles in rad, with a positive time in s from the first to the last
    /// one.
    pub(super) fn of(turned: &[Vec<f64>], span: f64) -> Self {
        let angles = turned.iter().flatten();
        let largest = angles.fold(0.0_f64, |most, angle| most.max(angle.abs()));
        let wanted = (TURN * largest / TAU).clamp(SHORTEST, LONGEST);
        Self {
            span,
            slower: round(wanted / span),
        }
    }

    /// Time in which so many frames, two or more, are shown, s: the last one stands as long as one leads to the next.
    pub(super) fn duration(self, frames: usize) -> f64 {
        self.slower * self.span * frames as f64 / (frames - 1) as f64
    }

    /// What is said of it.
    pub(super) fn words(self) -> String {
        let times =
            |factor: f64, word: &str| format!("{} times {word} than real time", six_digits(factor));
        match self.slower {
            slower if slower > 1.0 => times(slower, "slower"),
            slower if slower < 1.0 => times(1.0 / slower, "faster"),
            _ => "in real time".to_owned(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_run_is_shown_at_a_round_pace() {
        let pace = |turns: f64, span: f64| Pace::of(&[vec![0.0; 2], vec![-TAU * turns, 0.0]], span);
        let words = |turns, span| pace(turns, span).words();
        // 12 s and 11 s are wanted.
        assert_eq!(words(4.0, 0.2), "50 times slower than real time");
        assert_eq!(words(11.0 / 3.0, 10.0), "in real time");
        assert_eq!(words(1e4, 100.0), "5 times faster than real time");
        assert_eq!(words(0.0, 0.1), "50 times slower than real time");
        assert!((pace(4.0, 0.2).duration(101) - 10.1).abs() < 1e-12);
    }
}
