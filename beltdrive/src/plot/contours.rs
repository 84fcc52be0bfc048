//! The numbers of a map as contours over its axes.

use super::axis::{Axis, Scale};
use super::header::{Header, Mark, Sign};
use super::occupied::Frame;
use super::panel::{Chart, Panel, grid};
use super::sheet::{Anchor, Color, GREY, INK, SMALL, Sheet, Spot, Stroke, WHITE, spot, text_width};
use crate::quantity::map::{SCALARS, Scalar, answer};
use crate::quantity::{Answer, Measure, UnitSystem};
use crate::{MapAxis, OperatingMap};

/// Width of the figure and height of a row of panels, px.
const WIDTH: f64 = 1100.0;
const PANELS: f64 = 400.0;
const COLUMNS: usize = 2;

/// The numbers that have a panel, by their keys.
const SHOWN: [&str; 4] = ["speed_loss", "efficiency", "slip_margin", "hub_load"];

/// Colours of rising levels, from dark to light: viridis without its palest end, which is lost on white.
const LEVELS: [Color; 7] = [
    "#440154", "#443983", "#31688E", "#21918C", "#35B779", "#6CCD3F", "#B5C620",
];

/// Half the height of a label, and the empty space around it, px.
const HALF: f64 = 7.0;
const ROOM: f64 = 3.0;

/// Radius of the dot at a point without a state, px.
const NO_STATE: f64 = 1.5;

/// A piece of a contour on the sheet.
type Piece = [Spot; 2];

/// The figure: a panel for each of four numbers that varies.
pub(super) fn figure(map: &OperatingMap) -> String {
    let shown = SCALARS.iter().filter(|scalar| SHOWN.contains(&scalar.key));
    let shown: Vec<_> = shown
        .filter(|scalar| !levels(map, scalar).is_empty())
        .collect();
    let has_missing = map.points.iter().any(Result::is_err);
    let legend = ("no steady state".to_owned(), Mark::Sign(Sign::Dot, GREY));
    let legend = has_missing.then_some(legend);
    let Answer { heading, .. } = answer(map);
    let heading = Answer {
        heading,
        ..Answer::default()
    };
    let header = Header::new(&heading, "", legend, WIDTH);
    let rows = shown.len().div_ceil(COLUMNS).max(1);
    let size = spot(WIDTH, header.height + PANELS * rows as f64);
    let mut sheet = Sheet::new(size);
    header.draw(&mut sheet);
    let below = Frame {
        from: spot(0.0, header.height),
        to: size,
    };
    for (scalar, part) in shown.iter().zip(grid(below, COLUMNS, shown.len())) {
        panel(&mut sheet, part, map, scalar);
    }
    sheet.finish()
}

/// The values of a number at all points, in the unit in which it is shown.
fn values(map: &OperatingMap, scalar: &Scalar) -> Vec<Option<f64>> {
    let factor = scalar.measure.shown(UnitSystem::Engineering).factor;
    let points = map.points.iter();
    let values = points.map(|point| point.as_ref().ok().and_then(scalar.of));
    values
        .map(|value| value.map(|value| value * factor))
        .collect()
}

/// An axis of the values of a number. A ratio, such as a margin, has levels at ratios where its range is wide.
fn spanning(values: &[Option<f64>], scalar: &Scalar) -> Axis {
    let scale = match scalar.measure {
        Measure::Number => Scale::Parameter,
        _ => Scale::Decimal,
    };
    Axis::spanning(values.iter().flatten().copied(), scale)
}

/// The round values at which contours are drawn: those between the smallest and the largest one.
fn levels(map: &OperatingMap, scalar: &Scalar) -> Vec<f64> {
    let values = values(map, scalar);
    let known = || values.iter().flatten().copied();
    let [low, high] = [
        known().fold(f64::INFINITY, f64::min),
        known().fold(f64::NEG_INFINITY, f64::max),
    ];
    let ticks = spanning(&values, scalar).ticks().into_iter();
    ticks.filter(|tick| low < *tick && *tick < high).collect()
}

fn panel(sheet: &mut Sheet, part: Frame, map: &OperatingMap, scalar: &Scalar) {
    let across = |axis: &MapAxis| {
        let unit = axis.varied.measure().shown(UnitSystem::Engineering);
        let values: Vec<_> = axis
            .values
            .iter()
            .map(|value| value * unit.factor)
            .collect();
        (values, described(&axis.varied.name(), unit.symbol))
    };
    let [(xs, x), (ys, y)] = [&map.x, &map.y].map(across);
    let unit = scalar.measure.shown(UnitSystem::Engineering).symbol;
    let mut letters = scalar.label.chars();
    let first = letters.next().into_iter().flat_map(char::to_uppercase);
    let axes = [&xs, &ys].map(|values| Axis::spanning(values.iter().copied(), Scale::Decimal));
    let panel = Panel {
        title: described(&first.chain(letters).collect::<String>(), unit),
        axes,
        descriptions: [x, y],
    };
    let chart = panel.draw(sheet, part, []);
    let values = values(map, scalar);
    let places = ys.iter().flat_map(|&y| xs.iter().map(move |&x| [x, y]));
    let places: Vec<_> = places.map(|[x, y]| chart.at(x, y)).collect();
    for (at, point) in places.iter().zip(&map.points) {
        if point.is_err() {
            sheet.disc(*at, NO_STATE, GREY);
        }
    }
    let labels = spanning(&values, scalar);
    let mut taken: Vec<Frame> = Vec::new();
    for (index, level) in levels(map, scalar).into_iter().enumerate() {
        let color = LEVELS[index % LEVELS.len()];
        let pieces = contour(&places, &values, xs.len(), level);
        for piece in &pieces {
            sheet.line(piece, Stroke::solid(color, 2.0));
        }
        if let Some(frame) = label(sheet, &chart, &pieces, &labels.label(level), &taken) {
            taken.push(frame);
        }
    }
}

/// A name with its unit.
fn described(name: &str, unit: &str) -> String {
    match unit {
        "" => name.to_owned(),
        unit => format!("{name} in {unit}"),
    }
}

/// The contour of a level through values at places that stand in rows of so many: marching squares, with straight lines
/// between the places where the level is crossed on the sides of a cell. At a saddle the mean of the cell decides. A
/// cell with one corner without a value is a triangle, with more it has no contour.
fn contour(places: &[Spot], values: &[Option<f64>], columns: usize, level: f64) -> Vec<Piece> {
    let rows = values.len() / columns.max(1);
    let mut pieces = Vec::new();
    for row in 1..rows {
        for column in 1..columns {
            let corner = row * columns + column;
            // In turn round the cell.
            let corners = [corner - columns - 1, corner - columns, corner, corner - 1];
            let known = corners.iter().filter_map(|&corner| {
                let value = values[corner]?;
                Some((places[corner], value - level))
            });
            let known: Vec<_> = known.collect();
            if known.len() < 3 {
                continue;
            }
            let crossings = (0..known.len()).filter_map(|side| {
                let [(from, start), (to, end)] =
                    [side, (side + 1) % known.len()].map(|at| known[at]);
                let crosses = (start < 0.0) != (end < 0.0);
                crosses.then(|| from + start / (start - end) * (to - from))
            });
            let crossings: Vec<_> = crossings.collect();
            match crossings[..] {
                [from, to] => pieces.push([from, to]),
                // All four sides: the first corner is cut off where it differs from the middle.
                [first, second, third, fourth] => {
                    let middle: f64 = known.iter().map(|(_, height)| height).sum();
                    match (known[0].1 < 0.0) == (middle < 0.0) {
                        true => pieces.extend([[first, second], [third, fourth]]),
                        false => pieces.extend([[fourth, first], [second, third]]),
                    }
                }
                _ => {}
            }
        }
    }
    pieces
}

/// Writes the label of a contour on that of its pieces that is nearest to the middle of the panel and leaves other labels
/// and the frame alone, if there is one; where it stands.
fn label(
    sheet: &mut Sheet,
    chart: &Chart,
    pieces: &[Piece],
    text: &str,
    taken: &[Frame],
) -> Option<Frame> {
    let half = spot(0.5 * text_width(text, SMALL) + ROOM, HALF);
    let middle = chart.frame.middle();
    let frames = pieces.iter().map(|[from, to]| {
        let at = 0.5 * (from + to);
        Frame {
            from: at - half,
            to: at + half,
        }
    });
    let meets = |one: &Frame, other: &Frame| {
        one.from.x < other.to.x
            && other.from.x < one.to.x
            && one.from.y < other.to.y
            && other.from.y < one.to.y
    };
    let inside = |frame: &Frame| {
        let (from, to) = (frame.from - chart.frame.from, chart.frame.to - frame.to);
        from.min() > 0.0 && to.min() > 0.0
    };
    let free =
        frames.filter(|frame| inside(frame) && !taken.iter().any(|other| meets(frame, other)));
    let distance = |frame: &Frame| (frame.middle() - middle).norm();
    let frame = free.min_by(|one, other| distance(one).total_cmp(&distance(other)))?;
    sheet.rectangle([frame.from, frame.to], WHITE, 0.85);
    sheet.text(text, SMALL, INK, Anchor::Middle, frame.middle());
    Some(frame)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Places of a grid of so many columns and rows, and values there.
    fn sampled(count: usize, of: impl Fn(f64, f64) -> f64) -> (Vec<Spot>, Vec<Option<f64>>) {
        let at = |index: usize| -1.0 + 2.0 * index as f64 / (count - 1) as f64;
        let places = (0..count * count).map(|index| spot(at(index % count), at(index / count)));
        let places: Vec<_> = places.collect();
        let values = places.iter().map(|at| Some(of(at.x, at.y)));
        let values = values.collect();
        (places, values)
    }

    #[test]
    fn the_contour_of_a_plane_is_the_straight_line() {
        let (places, values) = sampled(6, |x, y| 2.0 * x - y);
        let pieces = contour(&places, &values, 6, 0.3);
        assert!(pieces.len() >= 6);
        for end in pieces.iter().flatten() {
            assert!((2.0 * end.x - end.y - 0.3).abs() < 1e-14, "{end:?}");
        }
    }

    #[test]
    fn the_contour_of_a_paraboloid_is_a_closed_circle() {
        let (places, values) = sampled(41, |x, y| x * x + y * y);
        // No place of the grid lies on the circle: 400 × 0.47 is no sum of two squares.
        let level: f64 = 0.47;
        let radius = level.sqrt();
        let pieces = contour(&places, &values, 41, level);
        let length: f64 = pieces.iter().map(|[from, to]| (to - from).norm()).sum();
        assert!(
            (length / (std::f64::consts::TAU * radius) - 1.0).abs() < 2e-3,
            "{length}"
        );
        for (index, [from, to]) in pieces.iter().enumerate() {
            assert!((from.norm() - radius).abs() < 1e-3);
            for end in [from, to] {
                let others = pieces
                    .iter()
                    .enumerate()
                    .filter(|(other, _)| *other != index);
                let meeting =
                    others.filter(|(_, piece)| piece.iter().any(|at| (at - end).norm() < 1e-12));
                assert_eq!(meeting.count(), 1, "{end:?}");
            }
        }
    }

    #[test]
    fn at_a_saddle_the_mean_of_the_cell_decides() {
        let places = [
            spot(0.0, 0.0),
            spot(1.0, 0.0),
            spot(0.0, 1.0),
            spot(1.0, 1.0),
        ];
        for (level, joined) in [(0.4, true), (0.6, false)] {
            // The corners on one diagonal are high.
            let values = [1.0, 0.0, 0.0, 1.0].map(Some);
            let pieces = contour(&places, &values, 2, level);
            assert_eq!(pieces.len(), 2);
            // Where the mean is above the level the low corners are cut off.
            let cuts_low = pieces
                .iter()
                .any(|piece| piece.iter().all(|at| at.x - at.y > 0.0));
            assert_eq!(cuts_low, joined);
        }
    }

    #[test]
    fn a_cell_with_a_missing_corner_is_a_triangle() {
        let (places, mut values) = sampled(2, |x, y| x + y);
        values[3] = None;
        let pieces = contour(&places, &values, 2, -0.5);
        let [piece] = &pieces[..] else {
            panic!("one piece: {pieces:?}");
        };
        assert!(piece.iter().all(|at| (at.x + at.y + 0.5).abs() < 1e-14));
        values[0] = None;
        assert!(contour(&places, &values, 2, -0.5).is_empty());
    }
}
