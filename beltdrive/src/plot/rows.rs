//! The numbers in the rows of an answer as curves over the first of them.

use super::axis::{Axis, Scale};
use super::header::Header;
use super::panel::Panel;
use super::style::{self, Stroke, px};
use crate::quantity::{Answer, Layout, Quantity, Subject, UnitSystem, Value};
use std::iter;

/// Width of the figure and height of its panels together, px.
const WIDTH: f64 = 1100.0;
const PANELS: f64 = 680.0;

/// Panels in the figure, two beside each other.
const COUNT: usize = 4;

/// Width of a curve, px.
const CURVE: f64 = 2.0;

/// The figure: a panel for each of the first four numbers that vary.
pub(super) fn figure(answer: &Answer) -> String {
    let mut groups = answer.groups.iter();
    let rows = groups.find(|group| group.layout == Layout::Rows);
    let rows = rows.map_or(&[][..], |group| &group.subjects);
    let mut columns = columns(rows).into_iter();
    let header = Header::of_answer(answer);
    let top = header.height(WIDTH);
    style::render([WIDTH, top + PANELS], |canvas| {
        header.draw(canvas, &[])?;
        let Some(across) = columns.next() else {
            return Ok(());
        };
        let (_, below) = canvas.split_vertically(px(top));
        let panels = below.split_evenly((2, COUNT / 2));
        for (panel, up) in panels.iter().zip(columns.filter(Column::varies)) {
            let title = up.name.clone();
            let chart = Panel {
                title: &title,
                axes: &[
                    Axis::spanning(across.values.iter().copied(), Scale::Parameter).padded(),
                    Axis::spanning(up.values.iter().copied(), Scale::Decimal).padded(),
                ],
                descriptions: [&across.description(), &up.description()],
            }
            .draw(panel, iter::empty())?;
            let points = across.values.iter().copied().zip(up.values.iter().copied());
            let known: Vec<_> = points.filter(|(_, up)| up.is_finite()).collect();
            Stroke::solid(style::INK, CURVE).draw(chart.plotting_area(), known)?;
        }
        Ok(())
    })
}

/// A number of every row.
struct Column {
    name: String,
    symbol: &'static str,
    values: Vec<f64>,
}

impl Column {
    fn description(&self) -> String {
        match self.symbol {
            "" => self.name.clone(),
            symbol => format!("{} in {symbol}", self.name),
        }
    }

    /// Whether there is anything to see.
    fn varies(&self) -> bool {
        let finite = || self.values.iter().filter(|value| value.is_finite());
        let low = finite().copied().fold(f64::INFINITY, f64::min);
        finite().any(|value| *value > low)
    }
}

/// The shown numbers of rows.
fn columns(rows: &[Subject]) -> Vec<Column> {
    let first = rows.first().into_iter().flat_map(|row| &row.quantities);
    let is_shown = |quantity: &&Quantity| {
        !quantity.label.is_empty() && matches!(quantity.value, Value::Number(_))
    };
    let column = |quantity: &Quantity| {
        let unit = quantity.measure.shown(UnitSystem::Engineering);
        let value = |row: &Subject| {
            let mut quantities = row.quantities.iter();
            let found = quantities.find(|other| other.key == quantity.key);
            match found.map(|found| &found.value) {
                Some(Value::Number(Some(value))) => value * unit.factor,
                _ => f64::NAN,
            }
        };
        Column {
            name: quantity.label.to_string(),
            symbol: unit.symbol,
            values: rows.iter().map(value).collect(),
        }
    };
    first.filter(is_shown).map(column).collect()
}
