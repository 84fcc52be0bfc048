//! The labels of a loop, placed where they cover nothing.

use super::super::occupied::{Frame, Occupied, Place, Spot, distance, distance_to};
use super::super::style::{self, BODY, SMALL, number};
use super::view::{PIVOT, View};
use crate::belt_loop::{Duty, PulleyState};
use crate::quantity::belt_loop::relative_error;
use crate::report::{Precision, rpm};
use std::f64::consts::TAU;

/// Distances of a label from what it belongs to, px. From the third on it has a leader.
const GAPS: [f64; 12] = [
    5.0, 12.0, 22.0, 34.0, 50.0, 70.0, 95.0, 130.0, 170.0, 220.0, 290.0, 380.0,
];
const LED: f64 = 20.0;

/// Directions in which a label is tried.
const DIRECTIONS: u32 = 32;

/// What a label pays on the far side of its pulley or on the inside of the belt, px.
const FAR_SIDE: f64 = 24.0;

/// What a label of a span pays where another span is not twice as far, px.
const AMBIGUOUS: f64 = 30.0;

/// What a label of a span pays for every tenth of the span that it is from its middle, px.
const OFF_MIDDLE: f64 = 6.0;

/// A line of text is so much higher than its letters, and labels have this much room round them, px.
const LINE: f64 = 1.25;
const PADDING: f64 = 2.0;

/// Width of text in `DejaVu` Sans, the widest of the common fonts, over that of [`style::text_width`].
pub(super) const WIDE: f64 = 1.12;

/// Lines of text with their sizes, px.
type Lines = Vec<(String, f64)>;

/// A label where it stands.
#[derive(Clone, Debug)]
pub(super) struct Label {
    /// What it says.
    pub(super) lines: Lines,
    /// Where it is.
    pub(super) place: Place,
}

/// What a label belongs to.
#[derive(Clone, Debug)]
enum Anchor {
    /// A disc with its radius, px, and the direction in which the label is best.
    Disc(Spot, f64, Spot),
    /// A span from its beginning to its end, the direction out of the loop, and the other spans.
    Span([Spot; 2], Spot, Vec<[Spot; 2]>),
}

/// The labels of a view, and whether each has a place of its own.
///
/// Those of the spans are placed after those of the pulleys, or before them, whichever is better.
pub(super) fn labels(view: &View<'_>) -> (Vec<Label>, bool) {
    let [around, along] = [around(view), along(view)];
    let orders = [[&around, &along], [&along, &around]];
    let [one, other] = orders.map(|order| arranged(view, order));
    match (one.1, other.1) {
        (None, Some(_)) => (other.0, true),
        (Some(cost), Some(less)) if less < cost => (other.0, true),
        (cost, _) => (one.0, cost.is_some()),
    }
}

/// Labels placed one after the other, and the sum of their costs if each has a place of its own.
fn arranged(view: &View<'_>, texts: [&Vec<(Lines, Anchor)>; 2]) -> (Vec<Label>, Option<f64>) {
    let mut occupied = Occupied {
        sheet: view.frame,
        shapes: view.shapes(),
    };
    let mut total = Some(0.0);
    let texts = texts.into_iter().flatten();
    let labels = texts.map(|(lines, anchor)| {
        let places = anchor.places(half(lines));
        let place = occupied.place(places.iter().copied());
        total = total.zip(place).map(|(total, place)| total + place.cost);
        let place = place.unwrap_or_else(|| {
            occupied.cover(&places[0]);
            places[0]
        });
        Label {
            lines: lines.clone(),
            place,
        }
    });
    (labels.collect(), total)
}

/// Half the width and height of lines of text, px.
fn half(lines: &Lines) -> Spot {
    let widths = lines.iter();
    let widths = widths.map(|(text, size)| WIDE * style::text_width(text.chars().count(), *size));
    let height: f64 = lines.iter().map(|(_, size)| LINE * size).sum();
    [
        0.5 * widths.fold(0.0, f64::max) + PADDING,
        0.5 * height + PADDING,
    ]
}

impl Label {
    /// Its lines with their sizes and middles.
    pub(super) fn rows(&self) -> impl Iterator<Item = (&str, f64, Spot)> {
        let Frame { from, to } = self.place.frame;
        let mut top = from[1] + PADDING;
        self.lines.iter().map(move |(text, size)| {
            let middle = top + 0.5 * LINE * size;
            top += LINE * size;
            (text.as_str(), *size, [0.5 * (from[0] + to[0]), middle])
        })
    }
}

impl Anchor {
    /// Where a label of half a width and height may be; the first place is that next to the anchor.
    fn places(&self, half: Spot) -> Vec<Place> {
        GAPS.into_iter()
            .flat_map(|gap| match self {
                Self::Disc(middle, radius, best) => {
                    let ahead = best[1].atan2(best[0]);
                    let places = (0..DIRECTIONS).map(move |step| {
                        let angle = TAU * f64::from(step) / f64::from(DIRECTIONS);
                        let (sin, cos) = (ahead + angle).sin_cos();
                        let foot = shifted(*middle, *radius, [cos, sin]);
                        let cost = FAR_SIDE * 0.5 * (1.0 - angle.cos());
                        let mut place = beside(half, foot, [cos, sin], gap, cost);
                        // Off the axes a label is farther from the rim than the line it is beyond.
                        let near = place.frame.nearest(foot);
                        place.cost += distance(near, foot) - gap;
                        if distance(near, foot) > LED {
                            let start = shifted(foot, 2.0, [cos, sin]);
                            place.leader = Some([start, place.frame.nearest(start)]);
                        }
                        place
                    });
                    places.collect::<Vec<_>>()
                }
                Self::Span(ends, out, others) => {
                    let places = [5, 4, 6, 3, 7, 2, 8].into_iter().flat_map(|tenth| {
                        let part = 0.1 * f64::from(tenth);
                        let off = OFF_MIDDLE * f64::from((tenth - 5_i32).abs());
                        let foot = [0, 1].map(|i| ends[0][i] + part * (ends[1][i] - ends[0][i]));
                        [(1.0, 0.0), (-1.0, FAR_SIDE)].map(|(side, cost)| {
                            let out = out.map(|part| side * part);
                            let mut place = beside(half, foot, out, gap, cost + off);
                            let middle = place.frame.middle();
                            let own = distance_to(*ends, middle);
                            let near = |other: &[Spot; 2]| distance_to(*other, middle) < 2.0 * own;
                            if others.iter().any(near) {
                                place.cost += AMBIGUOUS;
                            }
                            place
                        })
                    });
                    places.collect()
                }
            })
            .collect()
    }
}

/// A label of half a width and height beyond a line across `out`, at a distance from its foot.
fn beside(half: Spot, foot: Spot, out: Spot, gap: f64, cost: f64) -> Place {
    let away = gap + out[0].abs() * half[0] + out[1].abs() * half[1];
    let frame = Frame::around(shifted(foot, away, out), half);
    let near = shifted(foot, 2.0, out);
    Place {
        frame,
        leader: (gap > LED).then(|| [near, frame.nearest(near)]),
        cost: cost + gap,
    }
}

fn shifted(place: Spot, by: f64, out: Spot) -> Spot {
    [0, 1].map(|axis| place[axis] + by * out[axis])
}

/// The precision of a state, and the largest tension, N, as the scale of the errors of forces.
fn precision(view: &View<'_>) -> (Precision, f64) {
    let tensions = view.state.spans.iter().map(|span| span.tension);
    let precision = Precision::new(relative_error(view.state), 4);
    (precision, tensions.fold(0.0, f64::max))
}

/// What stands at the tensioner and at the pulleys.
fn around(view: &View<'_>) -> Vec<(Lines, Anchor)> {
    let plan = &view.plan;
    let (precision, tension) = precision(view);
    let force = |value: f64| number(&precision.show_against(value, tension));
    let from_middle = |place: Spot| {
        let middle = view.frame.middle();
        [0, 1].map(|axis| place[axis] - middle[axis])
    };
    let tensioner = view.tensioner.as_ref().zip(view.state.tensioner.as_ref());
    let tensioner = tensioner.map(|(tensioner, found)| {
        let coordinate = |value: f64| match tensioner.is_arm {
            true => format!(
                "{}°",
                number(&precision.show_against(value.to_degrees(), 90.0))
            ),
            false => format!("{} mm", number(&precision.show(1e3 * value))),
        };
        let name = if tensioner.is_arm {
            "arm at"
        } else {
            "slide at"
        };
        let lines = vec![
            (format!("{name} {}", coordinate(found.coordinate)), SMALL),
            (
                format!("at rest {}", coordinate(found.rest_coordinate)),
                SMALL,
            ),
        ];
        let anchor = plan.position(tensioner.anchor);
        (lines, Anchor::Disc(anchor, PIVOT, from_middle(anchor)))
    });
    let pulleys = view
        .state
        .pulleys
        .iter()
        .enumerate()
        .map(|(index, pulley)| {
            let circle = &view.circles[index];
            let centre = plan.position(circle.centre);
            let torque = number(&precision.show_against(pulley.torque, tension * circle.radius));
            let mut lines = vec![(name(view, index, pulley), BODY)];
            let speed = number(&precision.show(rpm(pulley.angular_speed)));
            let sense = match (view.shows_rotation(index), circle.sense > 0.0) {
                (true, _) => "",
                (false, true) => " ↺",
                (false, false) => " ↻",
            };
            lines.push((format!("{speed} rpm{sense}"), SMALL));
            lines.push(match pulley.torque {
                0.0 => ("no torque".to_owned(), SMALL),
                _ => (format!("torque {torque} N·m"), SMALL),
            });
            let [running, rest] =
                [pulley.hub_load, pulley.rest_hub_load].map(|[x, y]| force(x.hypot(y)));
            lines.push((format!("hub load {running} N"), SMALL));
            lines.push((format!("at rest {rest} N"), SMALL));
            let radius = plan.scale * circle.radius;
            (lines, Anchor::Disc(centre, radius, from_middle(centre)))
        });
    tensioner.into_iter().chain(pulleys).collect()
}

/// What stands at the spans.
fn along(view: &View<'_>) -> Vec<(Lines, Anchor)> {
    let (precision, tension) = precision(view);
    let force = |value: f64| number(&precision.show_against(value, tension));
    let count = view.state.spans.len();
    let ends = |index: usize| view.span(index).map(|end| view.plan.position(end));
    let spans = view.state.spans.iter().enumerate().map(|(index, span)| {
        let lines = vec![
            (format!("T = {} N", force(span.tension)), SMALL),
            (format!("F = {} N", force(span.tractive_tension)), SMALL),
        ];
        let others = (0..count).filter(|other| *other != index).map(ends);
        (
            lines,
            Anchor::Span(ends(index), view.outward(index), others.collect()),
        )
    });
    spans.collect()
}

/// The name of a pulley; the driver is named as such.
fn name(view: &View<'_>, index: usize, pulley: &PulleyState) -> String {
    match view.belt_loop.pulleys[index].duty {
        Duty::Driver(_) if pulley.name != "driver" => format!("{} (driver)", pulley.name),
        _ => pulley.name.clone(),
    }
}
