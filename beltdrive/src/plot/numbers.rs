//! The numbers of events beside their dots.

use super::occupied::{Frame, Occupied, Place};
use super::sheet::{DOT, SMALL, Spot, spot, text_width, unit};
use std::f64::consts::{FRAC_PI_4, TAU};

/// Dots of a curve that are no farther apart have a common label: two labels would overlap, px.
const CLOSE: f64 = 14.0;

/// Dots that are no farther apart look like one, px.
const TOGETHER: f64 = 2.0;

/// Distances of a label from its dots, px. From the third on it has a leader.
const GAPS: [f64; 7] = [6.0, 10.0, 16.0, 24.0, 34.0, 46.0, 60.0];
const LED: f64 = 14.0;

/// Directions in which a label is tried, from above to the right.
const DIRECTIONS: u32 = 16;

/// The label of one event, or of several whose labels would overlap.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Label {
    /// The numbers.
    pub(super) text: String,
    /// The curve it belongs to.
    pub(super) curve: usize,
    /// Where it stands.
    pub(super) place: Place,
}

/// The labels of events, whose dots stand on every curve in the same order, where they cover nothing.
///
/// Where events have the same places on two curves, the label belongs to the curve that is drawn later.
pub(super) fn labels(dots: &[Vec<Spot>], occupied: &mut Occupied) -> Vec<Label> {
    let groups: Vec<_> = dots.iter().map(|dots| groups(dots)).collect();
    let mut labels = Vec::new();
    for (curve, own) in groups.iter().enumerate() {
        for events in own {
            let looks_like = |other: usize| {
                let distance = |event: &usize| (dots[other][*event] - dots[curve][*event]).norm();
                groups[other].contains(events) && events.iter().all(|at| distance(at) <= TOGETHER)
            };
            if (curve + 1..dots.len()).any(looks_like) {
                continue;
            }
            let text = text(events);
            let first = dots[curve][events[0]];
            let [from, to] = { events.iter() }
                .map(|event| dots[curve][*event])
                .fold([first; 2], |[from, to], dot| [from.inf(&dot), to.sup(&dot)]);
            let places = places(
                Frame { from, to },
                0.5 * spot(text_width(&text, SMALL), SMALL),
            );
            if let Some(place) = occupied.place(places) {
                labels.push(Label { text, curve, place });
            }
        }
    }
    labels
}

/// Where a label of half a width and height may be round dots.
fn places(dots: Frame, half: Spot) -> impl Iterator<Item = Place> {
    let (middle, reach) = (dots.middle(), 0.5 * dots.size() + half);
    GAPS.into_iter().flat_map(move |gap| {
        (0..DIRECTIONS).map(move |step| {
            let turn = TAU * f64::from(step) / f64::from(DIRECTIONS);
            let out = unit(turn - FRAC_PI_4);
            // The nearest place in this direction where the label does not cover the dots.
            let away = reach.component_div(&out.abs()).min();
            let frame = Frame::around(middle + (away + gap) * out, half);
            let near = dots.nearest(frame.middle()) + (DOT + 2.0) * out;
            Place {
                frame,
                leader: (gap > LED).then(|| [near, frame.nearest(near)]),
                cost: gap + 1.0 - turn.cos(),
            }
        })
    })
}

/// The events of a curve in groups of which every dot is close to another one of the group.
fn groups(dots: &[Spot]) -> Vec<Vec<usize>> {
    let mut groups: Vec<Vec<usize>> = Vec::new();
    for (event, dot) in dots.iter().enumerate() {
        let is_close = |other: &usize| (dots[*other] - dot).norm() < CLOSE;
        let (near, far) =
            { groups.into_iter() }.partition::<Vec<_>, _>(|group| group.iter().any(is_close));
        let mut group: Vec<_> = near.into_iter().flatten().chain([event]).collect();
        group.sort_unstable();
        groups = far;
        groups.push(group);
    }
    groups
}

/// The numbers of events; three and more in a row are a range.
fn text(events: &[usize]) -> String {
    let runs = events.chunk_by(|one, next| one + 1 == *next);
    let texts = runs.flat_map(|run| match run {
        [first, .., last] if run.len() > 2 => vec![format!("{}–{}", first + 1, last + 1)],
        few => few.iter().map(|event| (event + 1).to_string()).collect(),
    });
    texts.collect::<Vec<_>>().join(", ")
}

#[cfg(test)]
mod tests {
    use super::super::occupied::Shape;
    use super::*;

    /// The labels of dots on a small panel with the lines between them.
    fn labelled(dots: &[Vec<Spot>]) -> (Vec<Label>, Vec<Shape>) {
        let lines = dots.iter().flat_map(|dots| dots.windows(2));
        let lines = lines.map(|ends| Shape::Line([ends[0], ends[1]], 3.0));
        let discs = dots.iter().flatten().map(|dot| Shape::Disc(*dot, 5.0));
        let shapes: Vec<_> = lines.chain(discs).collect();
        let mut occupied = Occupied {
            sheet: Frame {
                from: Spot::zeros(),
                to: spot(400.0, 300.0),
            },
            shapes: shapes.clone(),
        };
        (labels(dots, &mut occupied), shapes)
    }

    fn texts(dots: &[Vec<Spot>]) -> Vec<(usize, String)> {
        let labels = labelled(dots).0.into_iter();
        labels.map(|label| (label.curve, label.text)).collect()
    }

    fn row(places: &[f64]) -> Vec<Spot> {
        places.iter().map(|x| spot(*x, 50.0)).collect()
    }

    #[test]
    fn events_at_one_place_have_one_label() {
        let found = texts(&[row(&[50.0, 53.0, 56.0, 90.0, 120.0, 120.0])]);
        assert_eq!(
            found,
            [(0, "1–3"), (0, "4"), (0, "5, 6")].map(|(at, text)| (at, text.to_owned()))
        );
        // A branch that turns back.
        let found = texts(&[row(&[50.0, 90.0, 51.0])]);
        assert_eq!(
            found,
            [(0, "2"), (0, "1, 3")].map(|(at, text)| (at, text.to_owned()))
        );
    }

    #[test]
    fn curves_at_one_place_have_one_label() {
        let curve = row(&[50.0, 120.0]);
        let other = vec![curve[0], spot(120.0, 200.0)];
        let found = texts(&[curve, other]);
        let known = [(0, "2"), (1, "1"), (1, "2")].map(|(at, text)| (at, text.to_owned()));
        assert_eq!(found, known);
    }

    #[test]
    fn labels_cover_neither_curves_nor_each_other_nor_leave_the_panel() {
        for distance in [4.0, 8.0, 11.0, 20.0] {
            let low = [(6.0, 295.0), (6.0 + distance, 295.0), (200.0, 100.0)];
            let high = [(6.0, 289.0), (6.0 + distance, 280.0), (203.0, 104.0)];
            let curves = [low, high].map(|curve| curve.map(|(x, y)| spot(x, y)).to_vec());
            let (labels, shapes) = labelled(&curves);
            assert!(labels.len() >= 4, "{distance}: {labels:?}");
            for (index, label) in labels.iter().enumerate() {
                let frame = label.place.frame;
                assert!(frame.from.min() >= 0.0 && frame.to.x <= 400.0 && frame.to.y <= 300.0);
                assert!(!shapes.iter().any(|shape| shape.meets(&frame)), "{label:?}");
                let mut others = labels[..index].iter();
                assert!(
                    !others.any(|other| other.place.frame.meets(&frame)),
                    "{label:?}"
                );
            }
        }
    }
}
