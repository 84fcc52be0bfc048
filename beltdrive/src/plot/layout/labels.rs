//! The labels of a loop, placed where they cover nothing.

use super::super::header::broken;
use super::super::occupied::{Frame, Occupied, Place, distance_to};
use super::super::sheet::{BODY, SMALL, Spot, spot, text_width, unit};
use super::view::{PIVOT, View};
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

/// Names are broken into lines of this width, px: one of 70 letters on a single line had room on no sheet
/// narrower than 3300 px.
const NAME: f64 = 180.0;

/// Lines of text with their sizes, px.
type Lines = Vec<(String, f64)>;

/// A label where it stands.
#[derive(Clone, Debug)]
pub(super) struct Label {
    /// What it says.
    lines: Lines,
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
    let [one, other] = [[&around, &along], [&along, &around]].map(|order| arranged(view, order));
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
    let labels = texts.into_iter().flatten().map(|(lines, anchor)| {
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
    let widths = lines.iter().map(|(text, size)| text_width(text, *size));
    let height: f64 = lines.iter().map(|(_, size)| LINE * size).sum();
    0.5 * spot(widths.fold(0.0, f64::max), height).add_scalar(2.0 * PADDING)
}

impl Label {
    /// Its lines with their sizes and middles.
    pub(super) fn rows(&self) -> impl Iterator<Item = (&str, f64, Spot)> {
        let frame = self.place.frame;
        let mut top = frame.from.y + PADDING;
        self.lines.iter().map(move |(text, size)| {
            let middle = top + 0.5 * LINE * size;
            top += LINE * size;
            (text.as_str(), *size, spot(frame.middle().x, middle))
        })
    }
}

impl Anchor {
    /// Where a label of half a width and height may be; the first place is that next to the anchor.
    fn places(&self, half: Spot) -> Vec<Place> {
        let places = GAPS.into_iter().flat_map(|gap| match self {
            Self::Disc(middle, radius, best) => {
                let ahead = best.y.atan2(best.x);
                let places = (0..DIRECTIONS).map(move |step| {
                    let angle = TAU * f64::from(step) / f64::from(DIRECTIONS);
                    let out = unit(ahead + angle);
                    let foot = middle + *radius * out;
                    let cost = FAR_SIDE * 0.5 * (1.0 - angle.cos());
                    let mut place = beside(half, foot, out, gap, cost);
                    // Off the axes a label is farther from the rim than the line it is beyond.
                    let away = (place.frame.nearest(foot) - foot).norm();
                    place.cost += away - gap;
                    if away > LED {
                        let start = foot + 2.0 * out;
                        place.leader = Some([start, place.frame.nearest(start)]);
                    }
                    place
                });
                places.collect::<Vec<_>>()
            }
            Self::Span(ends, out, others) => {
                let places = [5, 4, 6, 3, 7, 2, 8].into_iter().flat_map(|tenth| {
                    let off = OFF_MIDDLE * f64::from((tenth - 5_i32).abs());
                    let foot = ends[0].lerp(&ends[1], 0.1 * f64::from(tenth));
                    [(1.0, 0.0), (-1.0, FAR_SIDE)].map(|(side, cost)| {
                        let mut place = beside(half, foot, side * out, gap, cost + off);
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
        });
        places.collect()
    }
}

/// A label of half a width and height beyond a line across `out`, at a distance from its foot.
fn beside(half: Spot, foot: Spot, out: Spot, gap: f64, cost: f64) -> Place {
    let away = gap + out.abs().dot(&half);
    let frame = Frame::around(foot + away * out, half);
    let near = foot + 2.0 * out;
    Place {
        frame,
        leader: (gap > LED).then(|| [near, frame.nearest(near)]),
        cost: cost + gap,
    }
}

/// What stands at the tensioner and at the pulleys.
fn around(view: &View<'_>) -> Vec<(Lines, Anchor)> {
    let disc = |middle: Spot, radius| Anchor::Disc(middle, radius, middle - view.frame.middle());
    let small = |lines: &[String]| -> Lines {
        let lines = lines.iter().map(|text| (text.clone(), SMALL));
        lines.collect()
    };
    let tensioner = view.drawn.tensioner.iter();
    let tensioner =
        tensioner.map(|tensioner| (small(&tensioner.lines), disc(view.anchor(tensioner), PIVOT)));
    let pulleys = view.drawn.pulleys.iter().enumerate();
    let pulleys = pulleys.map(|(index, pulley)| {
        let name = broken(&pulley.name, BODY, NAME).into_iter();
        let names: Lines = name.map(|line| (line, BODY)).collect();
        // Behind the first thing that is said of it, or behind its name.
        let first = names.len() - usize::from(pulley.lines.is_empty());
        let mut lines = [names, small(&pulley.lines)].concat();
        if !view.shows_rotation(index) {
            lines[first].0 += if pulley.sense > 0.0 { " ↺" } else { " ↻" };
        }
        (
            lines,
            disc(view.at(pulley.centre), view.scale * pulley.radius),
        )
    });
    tensioner.chain(pulleys).collect()
}

/// What stands at the spans.
fn along(view: &View<'_>) -> Vec<(Lines, Anchor)> {
    let count = view.drawn.spans.len();
    let spans = view.drawn.spans.iter().enumerate().map(|(index, lines)| {
        let lines = lines.iter().map(|text| (text.clone(), SMALL));
        let others = (0..count).filter(|other| *other != index);
        let others = others.map(|other| view.span(other)).collect();
        (
            lines.collect(),
            Anchor::Span(view.span(index), view.outward(index), others),
        )
    });
    spans.collect()
}
