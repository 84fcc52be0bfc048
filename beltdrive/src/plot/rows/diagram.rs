//! A panel with curves through the rows of an answer.

use super::super::axis::{Axis, Scale};
use super::super::curve::smooth;
use super::super::numbers::labels;
use super::super::occupied::{Frame, Occupied, Shape};
use super::super::panel::Panel;
use super::super::sheet::{Anchor, Color, DOT, GREY, INK, PALETTE, SMALL, Sheet, Spot, Stroke};
use super::Piece;
use crate::quantity::{Measure, UnitSystem};

/// Widths of a curve, of one that a later one covers, and of one beyond the colours, px.
pub(super) const CURVE: f64 = 2.0;
pub(super) const COVERED: f64 = 4.5;
const FURTHER: f64 = 1.0;

/// Radius of a dot at a state of a curve of limits, px.
const STATE: f64 = 2.5;

/// A panel: numbers of one unit.
pub(super) struct Diagram {
    pub(super) title: String,
    pub(super) axis: String,
    pub(super) scale: Scale,
    /// One curve, or one for each pulley.
    pub(super) curves: Vec<Curve>,
}

/// The values of a number.
#[derive(Clone)]
pub(super) struct Curve {
    /// In every row.
    pub(super) rows: Vec<f64>,
    /// At every event.
    pub(super) marked: Vec<f64>,
}

/// What an axis measures.
pub(super) fn described(label: &str, measure: Measure) -> String {
    match measure.shown(UnitSystem::Engineering).symbol {
        "" => label.to_owned(),
        "°" => format!("{label} in degrees"),
        symbol => format!("{label} in {symbol}"),
    }
}

/// How one of several things is drawn.
pub(super) fn stroke(index: usize) -> Stroke {
    let width = if index < PALETTE.len() {
        CURVE
    } else {
        FURTHER
    };
    Stroke::solid(PALETTE[index % PALETTE.len()], width)
}

impl Diagram {
    /// The panel of a quantity of a label.
    pub(super) fn of(label: &str, measure: Measure, curves: Vec<Curve>) -> Self {
        let label = label.trim();
        let mut letters = label.chars();
        let first = letters.next().into_iter().flat_map(char::to_uppercase);
        Self {
            title: first.chain(letters).collect(),
            axis: described(label, measure),
            scale: match measure {
                Measure::Angle => Scale::Degrees,
                _ => Scale::Decimal,
            },
            curves,
        }
    }

    /// Whether there is anything to see.
    pub(super) fn varies(&self) -> bool {
        self.curves.iter().any(|curve| {
            let finite = || curve.rows.iter().filter(|value| value.is_finite());
            let ends = [f64::INFINITY, f64::NEG_INFINITY];
            let [low, high] = finite().fold(ends, |[low, high], value| {
                [low.min(*value), high.max(*value)]
            });
            high - low > 1e-9 * high.abs().max(low.abs())
        })
    }

    fn axis(&self) -> Axis {
        let values = self.curves.iter();
        let values = values.flat_map(|curve| curve.rows.iter().chain(&curve.marked));
        Axis::spanning(values.copied(), self.scale).padded()
    }

    /// How the curves are drawn: wide where a later one covers most of them.
    pub(super) fn strokes(&self) -> Vec<Stroke> {
        let axis = self.axis();
        let is_near = |one: f64, other: f64| (axis.part(one) - axis.part(other)).abs() < 0.004;
        // Along most of the way up and down, and of the states: these may be dense where curves begin.
        let covers = |one: &[f64], other: &[f64]| {
            let share = (one.len() as f64).recip();
            let weights = other.windows(2).zip(one).map(|(ends, value)| {
                let weight = share + (axis.part(ends[1]) - axis.part(ends[0])).abs();
                (weight, is_near(*value, ends[0]))
            });
            let [near, all] = weights.fold([0.0, 0.0], |[near, all], (weight, is_near)| {
                [near + if is_near { weight } else { 0.0 }, all + weight]
            });
            2.0 * near > all
        };
        let curves = self.curves.iter().enumerate();
        let strokes = curves.map(|(index, curve)| match self.curves.len() {
            1 => Stroke::solid(INK, CURVE),
            _ if self.curves[index + 1..]
                .iter()
                .any(|later| covers(&later.rows, &curve.rows)) =>
            {
                Stroke {
                    width: COVERED,
                    ..stroke(index)
                }
            }
            _ => stroke(index),
        });
        strokes.collect()
    }

    /// Draws the panel over those of a parameter, with the events on every curve.
    pub(super) fn draw(&self, sheet: &mut Sheet, part: Frame, parameter: &Self, pieces: &[Piece]) {
        let panel = Panel {
            title: self.title.clone(),
            axes: [parameter.axis(), self.axis()],
            descriptions: [parameter.axis.clone(), self.axis.clone()],
        };
        let chart = panel.draw(sheet, part, []);
        let places = |across: &[f64], up: &[f64]| -> Vec<_> {
            let points = across.iter().zip(up);
            points.map(|(across, up)| chart.at(*across, *up)).collect()
        };
        let across = &parameter.curves[0];
        let curves = self.curves.iter();
        let curves: Vec<_> = curves
            .map(|curve| places(&across.rows, &curve.rows))
            .collect();
        let mut shapes = Vec::new();
        let is_known = |place: &Spot| place.iter().all(|part| part.is_finite());
        for (places, stroke) in curves.iter().zip(self.strokes()) {
            for piece in pieces {
                let reason = piece.reason.filter(|_| curves.len() == 1);
                let color: Color = reason.map_or(stroke.color, |at| self::stroke(at).color);
                let dashed = piece.behind;
                let known = places[piece.rows.clone()].iter().copied().filter(is_known);
                let known: Vec<_> = known.collect();
                if known.len() > 1 {
                    sheet.path(
                        &smooth(&known),
                        Stroke {
                            color,
                            dashed,
                            ..stroke
                        },
                    );
                }
                if piece.reason.is_some() {
                    known.iter().for_each(|at| sheet.disc(*at, STATE, color));
                }
                let lines = known.windows(2).map(|ends| [ends[0], ends[1]]);
                shapes.extend(lines.map(|ends| Shape::Line(ends, 0.5 * stroke.width + 1.5)));
            }
        }
        let dots = self.curves.iter();
        let dots: Vec<Vec<_>> = dots
            .map(|curve| places(&across.marked, &curve.marked))
            .collect();
        shapes.extend(
            dots.iter()
                .flatten()
                .map(|dot| Shape::Disc(*dot, DOT + 1.0)),
        );
        let colors: Vec<_> = self.strokes().iter().map(|stroke| stroke.color).collect();
        for (dots, color) in dots.iter().zip(&colors) {
            let known = dots.iter().filter(|dot| is_known(dot));
            known.for_each(|dot| sheet.disc(*dot, DOT, color));
        }
        let mut occupied = Occupied {
            sheet: chart.frame,
            shapes,
        };
        for label in labels(&dots, &mut occupied) {
            if let Some(leader) = label.place.leader {
                sheet.line(&leader, Stroke::solid(GREY, 0.8));
            }
            let middle = label.place.frame.middle();
            sheet.text(
                &label.text,
                SMALL,
                colors[label.curve],
                Anchor::Middle,
                middle,
            );
        }
    }
}
