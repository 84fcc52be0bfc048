//! The chart of a limit over a second parameter.

use super::axis::{Axis, Scale};
use super::header::{Header, Legend};
use super::panel::Panel;
use super::style::{self, Canvas, Drawn, Stroke, px};
use crate::report::{value, words};
use crate::{LimitCurve, LimitCurvePoint, LimitReason, Pulley};
use plotters::prelude::*;
use std::iter;

/// Width and height of the figure, px.
const SIZE: [f64; 2] = [900.0, 640.0];

const WIDTH: f64 = 2.5;

/// The figure of a curve.
pub(super) fn figure(curve: &LimitCurve) -> String {
    let LimitCurve { key, second, .. } = *curve;
    let caption = format!("Limit of the {} over the {}", key.name(), second.name());
    let header = Header::new(&curve.drive, &[key, second], &caption);
    style::render(SIZE, |canvas| {
        header.draw(canvas, &legend(curve))?;
        let (_, below) = canvas.split_vertically(px(header.height(SIZE[0])));
        chart(&below, curve)
    })
}

/// The colour of a kind of limit.
fn color(reason: LimitReason) -> RGBColor {
    match reason {
        LimitReason::Overhang | LimitReason::LiftsOff => style::VERMILION,
        LimitReason::DriverSlips | LimitReason::Capstan(Pulley::Driver) => style::WINE,
        LimitReason::DrivenSlips | LimitReason::Capstan(Pulley::Driven) => style::BLUE,
    }
}

/// The kinds of limits that occur, in order along the curve.
fn legend(curve: &LimitCurve) -> Vec<Legend> {
    let mut reasons: Vec<LimitReason> = Vec::new();
    for point in &curve.points {
        if !reasons.contains(&point.reason) {
            reasons.push(point.reason);
        }
    }
    let cusp = (!curve.cusps.is_empty()).then_some(Legend::Dot("cusp", style::INK));
    let lines = reasons.into_iter().map(|reason| {
        Legend::Line(
            words::limit_label(reason),
            Stroke::solid(color(reason), WIDTH),
        )
    });
    lines.chain(cusp).collect()
}

fn chart(canvas: &Canvas<'_>, curve: &LimitCurve) -> Drawn {
    let LimitCurve { key, second, .. } = *curve;
    let at = |point: &LimitCurvePoint| (second.reported(point.second), key.reported(point.value));
    let points = || curve.points.iter().map(at);
    let descriptions = [second, key].map(value::name);
    let panel = Panel {
        title: "",
        axes: &[
            Axis::spanning(points().map(|(across, _)| across), Scale::Parameter).padded(),
            Axis::spanning(points().map(|(_, up)| up), Scale::Decimal).padded(),
        ],
        descriptions: descriptions.each_ref().map(String::as_str),
    };
    let chart = panel.draw(canvas, iter::empty())?;
    let area = chart.plotting_area();
    for (reason, piece) in pieces(curve) {
        if piece.len() > 1 {
            let line = piece.iter().map(at).collect();
            Stroke::solid(color(reason), WIDTH).draw(area, line)?;
        }
    }
    for point in &curve.points {
        let dot = color(point.reason).filled();
        area.draw(&Circle::new(at(point), px(WIDTH), dot))?;
    }
    for cusp in &curve.cusps {
        area.draw(&Circle::new(at(cusp), px(style::DOT), style::INK.filled()))?;
    }
    Ok(())
}

/// The parts of the curve with one kind of limit each. Between them the limit may jump.
fn pieces(curve: &LimitCurve) -> Vec<(LimitReason, &[LimitCurvePoint])> {
    let mut start = 0;
    let parts = curve.points.chunk_by(|one, next| one.reason == next.reason);
    parts
        .map(|part| {
            let from = start;
            start += part.len();
            (part[0].reason, &curve.points[from..start])
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::sample_branch;

    #[test]
    fn the_curve_is_parted_where_the_kind_of_limit_changes() {
        let mut curve = sample_branch::curve();
        let parts = pieces(&curve);
        assert_eq!(parts.len(), 2);
        assert_eq!(parts[0].1.len() + parts[1].1.len(), curve.points.len());
        assert_eq!(parts[1].0, LimitReason::Overhang);
        assert_eq!(legend(&curve).len(), 2);
        curve.cusps = vec![curve.points[3].clone()];
        assert_eq!(legend(&curve).len(), 3);
        assert!(figure(&curve).contains("cusp"));
    }

    #[test]
    fn a_parameter_over_decades_has_powers_of_ten() {
        let mut curve = sample_branch::curve();
        for (power, point) in (0..).zip(&mut curve.points) {
            point.second = 1e4 * 10_f64.powf(0.2 * f64::from(power));
        }
        let text = figure(&curve);
        for tick in ["1e4", "1e5", "1e6", "1e7", "1e8"] {
            assert!(text.contains(&format!("\n{tick}\n")), "{tick}");
        }
    }

    #[test]
    fn a_curve_without_points_has_a_figure() {
        let mut curve = sample_branch::curve();
        curve.points.clear();
        assert!(figure(&curve).contains("coefficient of friction"));
    }
}
