//! A map as a text file of two-dimensional tables for simulation programs.

use crate::OperatingMap;
use crate::quantity::map::SCALARS;
use std::fmt::Write;

/// Why a map cannot be a table.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum NoTable {
    /// A table has a number everywhere.
    #[error(
        "{missing} of {points} points have no steady state, and a lookup table has no place for them: choose a \
         range without them{}",
        .rows.map_or(String::new(), |rows| format!("; the first {rows} values of y have none"))
    )]
    Missing {
        /// The number of points without a state.
        missing: usize,
        /// The number of points.
        points: usize,
        /// How many of the first values of y have a state at all values of x, if any.
        rows: Option<usize>,
    },
    /// A table has rising axes.
    #[error("the values of {0} do not rise, as those of a lookup table must")]
    Falling(String),
}

/// The tables of a map as text in the format of the Modelica Standard Library (tables on file), which
/// `CombiTable2D` reads, one for each number: its name is the key of the number in JSON and CSV, with the unit. The
/// first column holds the values of x (`u1`), the first row those of y (`u2`), in the units of their keys. A number that
/// some state does not have, as the efficiency without a torque, has no table.
///
/// # Errors
/// A point has no steady state, or an axis does not rise.
pub fn lookup_tables(map: &OperatingMap) -> Result<String, NoTable> {
    for axis in [&map.x, &map.y] {
        if axis.values.windows(2).any(|pair| pair[0] >= pair[1]) {
            return Err(NoTable::Falling(axis.varied.name()));
        }
    }
    let columns = map.x.values.len();
    let missing = map.points.iter().filter(|point| point.is_err()).count();
    if missing > 0 {
        let rows = map.points.chunks(columns);
        let whole = rows.take_while(|row| row.iter().all(Result::is_ok)).count();
        return Err(NoTable::Missing {
            missing,
            points: map.points.len(),
            rows: (whole > 0).then_some(whole),
        });
    }
    let [x, y] = [&map.x, &map.y].map(|axis| {
        let (unit, factor) = axis.varied.measure().stored();
        let values: Vec<_> = axis.values.iter().map(|value| value * factor).collect();
        (axis.varied.key() + unit, values)
    });
    let mut text = String::from("#1\n");
    for scalar in &SCALARS {
        let (unit, factor) = scalar.measure.stored();
        let values = map.points.iter().flatten().map(scalar.of);
        let Some(values) = values.collect::<Option<Vec<_>>>() else {
            continue;
        };
        let name = format!("{}{unit}", scalar.key);
        let (height, width) = (x.1.len() + 1, y.1.len() + 1);
        text += &format!(
            "# {name}: rows are u1 = {}, columns are u2 = {}\n",
            x.0, y.0
        );
        text += &format!("double {name}({height},{width})\n0");
        write_numbers(&mut text, y.1.iter().copied());
        for (row, at) in x.1.iter().enumerate() {
            text += &format!("{at}");
            let of_row = values.iter().skip(row).step_by(columns);
            write_numbers(&mut text, of_row.map(|value| value * factor));
        }
    }
    Ok(text)
}

/// Numbers behind the first of a line, which ends.
fn write_numbers(text: &mut String, numbers: impl Iterator<Item = f64>) {
    for number in numbers {
        write!(text, " {number}").expect("written into memory");
    }
    text.push('\n');
}
