//! The numbers in the rows of an answer as curves over the first of them: branches and limits.

mod diagram;
#[cfg(test)]
mod tests;

use super::axis::Scale;
use super::header::{Header, Mark, Sign};
use super::occupied::Frame;
use super::panel::grid;
use super::sheet::{Anchor, BODY, GREY, INK, MARGIN, Sheet, Stroke, cut, spot};
use crate::quantity::{Answer, Layout, Measure, Quantity, Subject, UnitSystem, Value};
use diagram::{CURVE, Diagram, described, stroke};
use std::ops::RangeInclusive;

/// Width of the figure, and height of its panels together, of one alone, and of a line of the list of events, px.
const WIDTH: f64 = 1100.0;
const PANELS: f64 = 680.0;
const PANEL: f64 = 560.0;
const LINE: f64 = 20.0;

/// Most panels in the figure.
const COUNT: usize = 4;

/// Numbers of pulleys that have a panel if they vary and rows have not enough of their own.
const OF_PULLEYS: [&str; 5] = [
    "wrap_angle",
    "exit_inclination",
    "torque",
    "slip_arc",
    "speed_loss",
];

/// Digits of a place in the list of events.
const DIGITS: f64 = 10.0;

/// Rows of one kind, in which a curve does not jump.
#[derive(Debug, PartialEq)]
struct Piece {
    rows: RangeInclusive<usize>,
    /// Place of their reason among all reasons, if the rows are limits.
    reason: Option<usize>,
    /// Whether they are behind a limit point.
    behind: bool,
}

/// The figure: a panel for each of the first four numbers that vary.
pub(super) fn figure(answer: &Answer) -> String {
    let mut groups = answer.groups.iter();
    let rows = groups.find(|group| group.layout == Layout::Rows);
    let rows = rows.map_or(&[][..], |group| &group.subjects);
    let diagrams = diagrams(rows);
    let events: Vec<_> = (0..rows.len())
        .filter(|row| rows[*row].word("event").is_some())
        .collect();
    let reasons = reasons(rows);
    let header = Header::new(answer, "", legend(rows, &diagrams, &reasons), WIDTH);
    let panels = if diagrams.len() > 1 { PANELS } else { PANEL };
    let top = spot(0.0, header.height);
    let size = top + spot(WIDTH, panels);
    let mut sheet = Sheet::new(size + spot(0.0, LINE * events.len() as f64));
    header.draw(&mut sheet);
    let Some(across) = rows.first().and_then(|row| numbers(row).next()) else {
        return sheet.finish();
    };
    let places = values(rows, across.measure, |row| numbers(row).next());
    let turns = rows.iter().any(|row| row.word("event") == Some("fold"));
    let parameter = Diagram {
        title: String::new(),
        axis: described(&across.label, across.measure),
        // A wide range is logarithmic, unless the parameter turns back, which has to be seen.
        scale: if turns {
            Scale::Decimal
        } else {
            Scale::Parameter
        },
        curves: vec![places],
    };
    let below = Frame {
        from: top,
        to: size,
    };
    let columns = diagrams.len().min(2);
    for (diagram, part) in diagrams.iter().zip(grid(below, columns, diagrams.len())) {
        diagram.draw(
            &mut sheet,
            part,
            &parameter,
            &pieces(rows, &reasons),
            &events,
        );
    }
    for (number, row) in events.iter().enumerate() {
        let place = numbers(&rows[*row])
            .next()
            .and_then(|place| place.shown(DIGITS));
        let what = rows[*row].word("description").unwrap_or_default();
        let text = format!("{}   {}: {what}", number + 1, place.unwrap_or_default());
        let at = spot(MARGIN, size.y + LINE * (number as f64 + 0.3));
        let text = cut(&text, BODY, WIDTH - 2.0 * MARGIN);
        sheet.text(&text, BODY, INK, Anchor::Start, at);
    }
    sheet.finish()
}

/// The shown numbers of a row.
fn numbers(row: &Subject) -> impl Iterator<Item = &Quantity> {
    let is_shown = |quantity: &&Quantity| {
        !quantity.label.is_empty() && matches!(quantity.value, Value::Number(_))
    };
    row.quantities.iter().filter(is_shown)
}

/// A number of every row in the unit in which it is shown; not a number where there is none.
fn values<'a>(
    rows: &'a [Subject],
    measure: Measure,
    of: impl Fn(&'a Subject) -> Option<&'a Quantity>,
) -> Vec<f64> {
    let factor = measure.shown(UnitSystem::Engineering).factor;
    let value = |row| match of(row).map(|quantity| &quantity.value) {
        Some(Value::Number(Some(value))) => factor * value,
        _ => f64::NAN,
    };
    rows.iter().map(value).collect()
}

/// The panels of rows.
fn diagrams(rows: &[Subject]) -> Vec<Diagram> {
    let Some(first) = rows.first() else {
        return Vec::new();
    };
    let own = numbers(first).skip(1).map(|quantity| {
        let values = values(rows, quantity.measure, |row| row.quantity(&quantity.key));
        Diagram::of(quantity, vec![values])
    });
    let of_pulleys = OF_PULLEYS.iter().filter_map(|key| {
        let pulleys = first.list("pulleys");
        let quantity = pulleys.first()?.quantity(key)?;
        let of = |index: usize| {
            values(rows, quantity.measure, move |row| {
                row.list("pulleys").get(index)?.quantity(key)
            })
        };
        Some(Diagram::of(quantity, (0..pulleys.len()).map(of).collect()))
    });
    let varying = own.chain(of_pulleys).filter(Diagram::varies);
    varying.take(COUNT).collect()
}

/// The reasons of limits that occur, in order.
fn reasons(rows: &[Subject]) -> Vec<&str> {
    let mut reasons = Vec::new();
    for reason in rows.iter().filter_map(|row| row.word("reason")) {
        if !reasons.contains(&reason) {
            reasons.push(reason);
        }
    }
    reasons
}

/// The pieces of rows. Those before and behind a limit point share it; where the reason of limits changes, the
/// limit may jump.
fn pieces(rows: &[Subject], reasons: &[&str]) -> Vec<Piece> {
    let mut pieces: Vec<Piece> = Vec::new();
    for (index, row) in rows.iter().enumerate() {
        let reason = row.word("reason");
        let reason = reasons.iter().position(|known| Some(*known) == reason);
        match pieces.last_mut() {
            Some(last) if last.reason == reason => {
                last.rows = *last.rows.start()..=index;
            }
            _ => pieces.push(Piece {
                rows: index..=index,
                reason,
                behind: false,
            }),
        }
        if row.word("event") == Some("fold") && index + 1 < rows.len() {
            pieces.push(Piece {
                rows: index..=index,
                reason,
                behind: true,
            });
        }
    }
    // Where limits have reasons, a row without one is no limit.
    pieces.retain(|piece| reasons.is_empty() || piece.reason.is_some());
    pieces
}

fn legend(rows: &[Subject], diagrams: &[Diagram], reasons: &[&str]) -> Vec<(String, Mark)> {
    let line = |label: &str, stroke| (label.to_owned(), Mark::Line(stroke));
    let limits = reasons.iter().enumerate();
    let limits = limits.map(|(index, reason)| line(reason, stroke(index)));
    let shows_pulleys = diagrams.iter().any(|diagram| diagram.curves.len() > 1);
    let pulleys = rows.first().map_or(&[][..], |row| row.list("pulleys"));
    let pulleys = pulleys.iter().enumerate().filter(|_| shows_pulleys);
    let pulleys = pulleys.map(|(index, pulley)| line(&pulley.head, stroke(index)));
    let has = |kind: fn(&str) -> bool| rows.iter().any(|row| row.word("event").is_some_and(kind));
    let behind = has(|event| event == "fold");
    let behind = behind.then(|| line("behind the limit point", Stroke::dashed(GREY, CURVE)));
    let event = has(|_| true).then(|| ("event".to_owned(), Mark::Sign(Sign::Dot, INK)));
    limits.chain(pulleys).chain(behind).chain(event).collect()
}
