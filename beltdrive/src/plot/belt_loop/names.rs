//! The names of pulleys in rows above a panel.

use super::super::occupied::{Frame, Occupied, Place, Spot};
use super::super::panel::TOP;
use super::super::style::{self, Canvas, Drawn, SMALL, Stroke, px};
use super::labels::WIDE;
use plotters::style::text_anchor::HPos;

/// Height of a row, px.
const ROW: f64 = 17.0;

/// Half the room between names, px.
const GAP: f64 = 4.0;

/// Rows of names in the middle above their places: with more, leaders would pass between names where they
/// are hard to follow.
const CENTRED: u32 = 3;

/// A name where it stands, from the top of the panel.
#[derive(Clone, Debug)]
pub(super) struct Name<'a> {
    text: &'a str,
    pub(super) place: Place,
}

/// Names that belong to places across a sheet of a width, px.
///
/// They stand in the middle above their places if they have room in a few rows. Else they begin above their
/// places, so that the leaders of those to the left pass them; those that would leave the sheet, and those
/// that would cover the leaders of these, end above their places.
pub(super) fn placed<'a>(names: &[(&'a str, f64)], width: f64) -> Vec<Name<'a>> {
    let middle = names.iter().map(|_| 0.0).enumerate();
    let centred = (1..=CENTRED).find_map(|rows| in_order(names, width, rows, middle.clone()));
    if let Some(names) = centred {
        return names;
    }
    let end = |&(text, at): &(&str, f64)| at + 2.0 * half(text);
    let mut bound = width;
    while let Some((_, at)) = names
        .iter()
        .find(|name| name.1 < bound && end(name) > bound)
    {
        bound = *at;
    }
    let begin = (0..names.len())
        .rev()
        .filter(|index| names[*index].1 < bound);
    let finish = (0..names.len()).filter(|index| names[*index].1 >= bound);
    let order = begin
        .map(|index| (index, 1.0))
        .chain(finish.map(|index| (index, -1.0)));
    let rows = u32::try_from(names.len()).unwrap_or(u32::MAX);
    in_order(names, width, rows, order.clone()).unwrap_or_else(|| {
        let places = order.map(|(index, side)| Name {
            text: names[index].0,
            place: place(names[index], side, 0),
        });
        places.collect()
    })
}

/// Names placed one after the other, each to one side of its place and in the lowest row that is free.
fn in_order<'a>(
    names: &[(&'a str, f64)],
    width: f64,
    rows: u32,
    order: impl Iterator<Item = (usize, f64)>,
) -> Option<Vec<Name<'a>>> {
    let mut occupied = Occupied {
        sheet: Frame {
            from: [0.0, -f64::from(rows) * ROW],
            to: [width, TOP],
        },
        shapes: vec![],
    };
    order
        .map(|(index, side)| {
            let places = (0..rows).map(|row| place(names[index], side, row));
            let place = occupied.place(places)?;
            let text = names[index].0;
            Some(Name { text, place })
        })
        .collect()
}

fn half(text: &str) -> f64 {
    0.5 * WIDE * style::text_width(text.chars().count(), SMALL) + GAP
}

/// The place of a name in a row, counted from below: in the middle above its place, or to the right or left.
fn place((text, at): (&str, f64), side: f64, row: u32) -> Place {
    let (half, below) = (half(text), -ROW * f64::from(row));
    Place {
        frame: Frame::around(
            [at + side * (half - 1.0), below - 0.5 * ROW],
            [half, 0.5 * ROW],
        ),
        leader: Some([[at, TOP], [at, below]]),
        cost: -below,
    }
}

/// Height that names take above the panel, px.
pub(super) fn height(names: &[Name<'_>]) -> f64 {
    let tops = names.iter().map(|name| -name.place.frame.from[1]);
    tops.fold(0.0, f64::max)
}

impl Name<'_> {
    /// Draws the name with its leader over a panel whose top is at a height, px.
    pub(super) fn draw(&self, canvas: &Canvas<'_>, top: f64) -> Drawn {
        let on_sheet = |[x, y]: Spot| [x, top + y];
        if let Some(leader) = self.place.leader {
            let ends = leader.map(|end| on_sheet(end).map(px).into());
            Stroke::solid(style::GREY, 0.8).draw(canvas, ends.to_vec())?;
        }
        let face = style::face(SMALL, style::INK, HPos::Center);
        let middle = on_sheet(self.place.frame.middle());
        style::write(canvas, self.text, &face, middle)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The names stand apart, and no leader passes a name.
    fn check(names: &[(&str, f64)], rows: f64) {
        let placed = placed(names, 1100.0);
        assert_eq!(placed.len(), names.len());
        assert_eq!(height(&placed), rows * ROW, "{placed:?}");
        for (index, one) in placed.iter().enumerate() {
            let Frame { from, to } = one.place.frame;
            assert!(from[0] >= 0.0 && to[0] <= 1100.0, "{one:?}");
            for (_, other) in placed
                .iter()
                .enumerate()
                .filter(|(other, _)| *other != index)
            {
                assert!(
                    !one.place.frame.meets(&other.place.frame),
                    "{one:?} {other:?}"
                );
                let [[at, _], [_, below]] = other.place.leader.unwrap();
                let passes = from[0] < at && at < to[0] && to[1] > below;
                assert!(!passes, "{one:?} {other:?}");
            }
        }
    }

    #[test]
    fn names_with_room_stand_in_one_row() {
        check(
            &[("crankshaft", 120.0), ("idler", 300.0), ("fan", 900.0)],
            1.0,
        );
    }

    #[test]
    fn close_names_stand_in_rows() {
        let long = "a name with 25 characters";
        check(
            &[120.0, 230.0, 340.0, 450.0, 560.0, 670.0].map(|at| (long, at)),
            2.0,
        );
        check(&[500.0, 503.0, 506.0, 509.0].map(|at| (long, at)), 4.0);
        check(&[300.0, 900.0, 1000.0, 1050.0].map(|at| (long, at)), 3.0);
    }
}
