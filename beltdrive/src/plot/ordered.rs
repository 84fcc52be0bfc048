//! Colours in the order of a quantity, and the bar that tells them.

use super::axis::Axis;
use super::occupied::Frame;
use super::sheet::{Anchor, BODY, Color, INK, SMALL, Sheet, Stroke, spot};
use std::sync::LazyLock;

/// Colours at equal distances from the lowest to the highest value: viridis (Smith and van der Walt, 2015), which grows lighter
/// evenly, also to a colour-blind eye and in grey.
const STOPS: [[u8; 3]; 11] = [
    [0x44, 0x01, 0x54],
    [0x48, 0x24, 0x75],
    [0x41, 0x44, 0x87],
    [0x35, 0x5F, 0x8D],
    [0x2A, 0x78, 0x8E],
    [0x21, 0x91, 0x8C],
    [0x22, 0xA8, 0x84],
    [0x44, 0xBF, 0x70],
    [0x7A, 0xD1, 0x51],
    [0xBD, 0xDF, 0x26],
    [0xFD, 0xE7, 0x25],
];

/// Steps from the lowest colour to the highest one, ten from stop to stop: neighbours differ by less than is seen.
const STEPS: u8 = 100;

static COLORS: LazyLock<Vec<String>> = LazyLock::new(|| (0..=STEPS).map(mixed).collect());

/// The colour of a step.
fn mixed(step: u8) -> String {
    let between = STEPS / 10;
    let from = usize::from((step / between).min(9));
    let part = f64::from(step) / f64::from(between) - from as f64;
    let channel = |index: usize| {
        let [low, high] = [from, from + 1].map(|stop| f64::from(STOPS[stop][index]));
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "between two bytes"
        )]
        let mixed = (low + part * (high - low)).round() as u8;
        mixed
    };
    let [red, green, blue] = [0, 1, 2].map(channel);
    format!("#{red:02X}{green:02X}{blue:02X}")
}

/// The colour of a part of the range of values, 0 to 1; beyond it that of its end.
pub(super) fn color(part: f64) -> Color {
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "0 … 100; no number is the lowest"
    )]
    let step = (f64::from(STEPS) * part.clamp(0.0, 1.0)).round() as usize;
    &COLORS[step]
}

/// Length of a tick, px.
const TICK: f64 = 4.0;

/// Draws the colours over an axis into a frame, with what they measure at its left and numbers below it.
pub(super) fn bar(sheet: &mut Sheet, frame: Frame, axis: &Axis, description: &str) {
    let Frame { from, to } = frame;
    let across = |part: f64| from.x + part * (to.x - from.x);
    for step in 0..=STEPS {
        // A step reaches from half a step before its value to the end, so that there is no gap before the next one.
        let start = (f64::from(step) - 0.5) / f64::from(STEPS);
        let start = spot(across(start.max(0.0)), from.y);
        sheet.rectangle([start, to], &COLORS[usize::from(step)], 1.0);
    }
    for tick in axis.ticks() {
        let foot = spot(across(axis.part(tick)), to.y);
        sheet.line(&[foot, foot + spot(0.0, TICK)], Stroke::solid(INK, 1.0));
        let below = foot + spot(0.0, TICK + 9.0);
        sheet.text(&axis.label(tick), SMALL, INK, Anchor::Middle, below);
    }
    let beside = spot(from.x - 10.0, frame.middle().y);
    sheet.text(description, BODY, INK, Anchor::End, beside);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colours_grow_lighter_from_end_to_end() {
        assert_eq!(
            [0.0, 0.5, 1.0].map(color),
            ["#440154", "#21918C", "#FDE725"]
        );
        assert_eq!(
            [-1.0, 2.0, f64::NAN].map(color),
            ["#440154", "#FDE725", "#440154"]
        );
        // Relative luminance of sRGB.
        let luminance = |color: &String| {
            let channel = |index: usize| {
                let value = u8::from_str_radix(&color[1 + 2 * index..3 + 2 * index], 16);
                (f64::from(value.unwrap()) / 255.0).powf(2.2)
            };
            0.2126 * channel(0) + 0.7152 * channel(1) + 0.0722 * channel(2)
        };
        let steps: Vec<_> = COLORS.iter().map(luminance).collect();
        assert!(steps.windows(2).all(|pair| pair[0] < pair[1]), "{steps:?}");
    }
}
