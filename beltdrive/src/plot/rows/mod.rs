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
use diagram::{CURVE, Curve, Diagram, described, stroke};
use std::ops::RangeInclusive;

/// Width of the figure, and height of its panels together, of one alone, and of a line of the list of events, px.
const WIDTH: f64 = 1100.0;
const PANELS: f64 = 680.0;
const PANEL: f64 = 560.0;
const LINE: f64 = 20.0;

/// Most panels in the figure.
const COUNT: usize = 4;

/// Numbers of a drive with two pulleys that have a panel if they vary, where they stand in a row, and what they
/// are called.
const OF_TWO_PULLEYS: [(&[&str], &str); 2] = [
    (&["driven", "angular_speed"], "speed of the driven pulley"),
    (&["efficiency"], "efficiency"),
];

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

/// The figure: a panel for each of the first four numbers that vary, with the events or cusps of the answer.
pub(super) fn figure(answer: &Answer) -> String {
    let mut groups = answer.groups.iter();
    let rows = groups.find(|group| group.layout == Layout::Rows);
    let rows = rows.map_or(&[][..], |group| &group.subjects);
    let marked = ["events", "cusps"].map(|key| answer.subjects(key)).concat();
    let reasons = reasons(rows);
    let diagrams = diagrams(rows, &marked, &reasons);
    let legend = legend(rows, &marked, &diagrams, &reasons);
    let header = Header::new(answer, "", legend, WIDTH);
    let panels = if diagrams.len() > 1 { PANELS } else { PANEL };
    let top = spot(0.0, header.height);
    let size = top + spot(WIDTH, panels);
    let mut sheet = Sheet::new(size + spot(0.0, LINE * marked.len() as f64));
    header.draw(&mut sheet);
    let Some(across) = rows.first().and_then(|row| numbers(row).next()) else {
        return sheet.finish();
    };
    let turns = rows.iter().any(|row| row.word("event") == Some("fold"));
    let first = |row| numbers(row).next();
    let parameter = Diagram {
        title: String::new(),
        axis: described(&across.label, across.measure),
        // A wide range is logarithmic, unless the parameter turns back, which has to be seen.
        scale: if turns {
            Scale::Decimal
        } else {
            Scale::Parameter
        },
        curves: vec![Curve {
            rows: values(rows, across.measure, first),
            marked: values(&marked, across.measure, first),
        }],
    };
    let below = Frame {
        from: top,
        to: size,
    };
    let columns = diagrams.len().min(2);
    let pieces = pieces(rows, &reasons);
    for (diagram, part) in diagrams.iter().zip(grid(below, columns, diagrams.len())) {
        diagram.draw(&mut sheet, part, &parameter, &pieces);
    }
    for (number, subject) in marked.iter().enumerate() {
        let place = numbers(subject)
            .next()
            .and_then(|place| place.shown(DIGITS));
        let what = &subject.head;
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

/// The number at a path through the objects of a row.
fn at<'a>(row: &'a Subject, path: &[&str]) -> Option<&'a Quantity> {
    let (key, objects) = path.split_last()?;
    let mut quantities = &row.quantities;
    let find = |quantities: &'a [Quantity], key: &str| quantities.iter().find(|of| of.key == key);
    for object in objects {
        quantities = match &find(quantities, object)?.value {
            Value::Object(Some(inner)) => inner,
            _ => return None,
        };
    }
    find(quantities, key)
}

/// The names of the pulleys of a row.
fn pulleys(row: &Subject) -> Vec<&str> {
    match row.list("pulleys") {
        [] => vec!["driver", "driven"],
        pulleys => pulleys.iter().map(|pulley| &*pulley.head).collect(),
    }
}

/// The quantity of a pulley in a row.
fn of_pulley<'a>(row: &'a Subject, index: usize, key: &str) -> Option<&'a Quantity> {
    match row.list("pulleys") {
        [] => at(row, &[["driver", "driven"].get(index)?, key]),
        pulleys => pulleys.get(index)?.quantity(key),
    }
}

/// The panels of rows. Among limits, where colours tell their reasons, there are none of pulleys.
fn diagrams(rows: &[Subject], marked: &[Subject], reasons: &[&str]) -> Vec<Diagram> {
    let Some(first) = rows.first() else {
        return Vec::new();
    };
    let curve = |measure, of: &dyn Fn(&Subject) -> Option<&Quantity>| Curve {
        rows: values(rows, measure, of),
        marked: values(marked, measure, of),
    };
    let own = numbers(first).skip(1).filter(|of| !of.key.is_empty());
    let own = own.map(|of| {
        let curve = curve(of.measure, &|row| row.quantity(&of.key));
        Diagram::of(&of.label, of.measure, vec![curve])
    });
    let of_two = OF_TWO_PULLEYS.iter();
    let of_two = of_two.filter(|_| first.list("pulleys").is_empty() && reasons.is_empty());
    let of_two = of_two.filter_map(|(path, label)| {
        let measure = at(first, path)?.measure;
        let curve = curve(measure, &|row| at(row, path));
        Some(Diagram::of(label, measure, vec![curve]))
    });
    let of_pulleys = OF_PULLEYS.iter().filter(|_| reasons.is_empty());
    let of_pulleys = of_pulleys.filter_map(|key| {
        let Quantity { label, measure, .. } = of_pulley(first, 0, key)?;
        let of = |index| curve(*measure, &move |row| of_pulley(row, index, key));
        let curves = (0..pulleys(first).len()).map(of).collect();
        (!label.is_empty()).then(|| Diagram::of(label, *measure, curves))
    });
    let varying = own.chain(of_two).chain(of_pulleys).filter(Diagram::varies);
    varying.take(COUNT).collect()
}

/// Why a row is a limit, in the words that are shown.
fn reason(row: &Subject) -> Option<&str> {
    let shown = row.quantities.iter().find(|of| of.label == "reason")?;
    match &shown.value {
        Value::Word(word) => word.as_deref(),
        _ => None,
    }
}

/// The reasons of limits that occur, in order.
fn reasons(rows: &[Subject]) -> Vec<&str> {
    let mut reasons = Vec::new();
    for reason in rows.iter().filter_map(reason) {
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
        let reason = reason(row);
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
    pieces
}

fn legend(
    rows: &[Subject],
    marked: &[Subject],
    diagrams: &[Diagram],
    reasons: &[&str],
) -> Vec<(String, Mark)> {
    let line = |label: &str, stroke| (label.to_owned(), Mark::Line(stroke));
    let limits = reasons.iter().enumerate();
    let limits = limits.map(|(index, reason)| line(reason, stroke(index)));
    let shows_pulleys = diagrams.iter().any(|diagram| diagram.curves.len() > 1);
    let pulleys = rows.first().map(pulleys).filter(|_| shows_pulleys);
    let pulleys = pulleys.into_iter().flatten().enumerate();
    let pulleys = pulleys.map(|(index, pulley)| line(pulley, stroke(index)));
    let behind = rows.iter().any(|row| row.word("event") == Some("fold"));
    let behind = behind.then(|| line("behind the limit point", Stroke::dashed(GREY, CURVE)));
    let event = (!marked.is_empty()).then(|| ("event".to_owned(), Mark::Sign(Sign::Dot, INK)));
    limits.chain(pulleys).chain(behind).chain(event).collect()
}
