//! The tables of reference solutions.

use std::collections::HashMap;
use std::str::FromStr;
use std::sync::LazyLock;

/// The committed tables; the format is described in their first lines.
const TABLES: &str = include_str!("reference_solutions.txt");

/// The solution of a case at some points.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Reference {
    /// Segment, x and states, in ascending order; both ends of every segment are among them.
    pub points: Vec<(usize, f64, Vec<f64>)>,
    /// Values of the unknown parameters.
    pub parameters: Vec<f64>,
}

impl Reference {
    /// The table of the case `id`.
    ///
    /// # Panics
    /// If there is none, or the tables are damaged.
    pub(crate) fn of(id: &str) -> Self {
        static PARSED: LazyLock<HashMap<&str, Reference>> = LazyLock::new(|| {
            parse(TABLES).unwrap_or_else(|line| panic!("reference_solutions.txt:{line}: damaged"))
        });
        let table = PARSED.get(id);
        table
            .unwrap_or_else(|| panic!("no reference solution of {id}"))
            .clone()
    }
}

/// The tables by case, or the number of the first line that cannot be read.
fn parse(text: &str) -> Result<HashMap<&str, Reference>, usize> {
    let mut tables = HashMap::new();
    let mut current = None;
    for (number, line) in (1..).zip(text.lines()) {
        let line = line.trim();
        if line.is_empty() || line.starts_with('#') {
            continue;
        }
        let mut words = line.split_whitespace();
        let first = words.next().ok_or(number)?;
        if first == "case" {
            let id = words.next().ok_or(number)?;
            if tables.insert(id, Reference::default()).is_some() {
                return Err(number);
            }
            current = Some(id);
            continue;
        }
        let table: &mut Reference = current.and_then(|id| tables.get_mut(id)).ok_or(number)?;
        let values: Result<Vec<f64>, _> = words.map(f64::from_str).collect();
        let values = values.map_err(|_| number)?;
        if first == "parameters" {
            table.parameters = values;
        } else {
            let segment = first.parse().map_err(|_| number)?;
            let (&x, states) = values.split_first().ok_or(number)?;
            table.points.push((segment, x, states.to_vec()));
        }
    }
    Ok(tables)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_section_is_read() {
        let tables = parse("# c\ncase A1\nparameters 2.5\n0 -1.0 1e-3 2\n1 0.5 3\n\ncase B\n");
        let tables = tables.expect("readable");
        let expected = Reference {
            points: vec![(0, -1.0, vec![1e-3, 2.0]), (1, 0.5, vec![3.0])],
            parameters: vec![2.5],
        };
        assert_eq!(tables["A1"], expected);
        assert_eq!(tables["B"], Reference::default());
    }

    #[test]
    fn a_damaged_line_is_named() {
        assert_eq!(parse("0 0.0 1.0\n"), Err(1));
        assert_eq!(parse("case A\n0 0.0 1,0\n"), Err(2));
        assert_eq!(parse("case A\n\ncase A\n"), Err(3));
        assert_eq!(parse("case A\nx 0.0 1.0\n"), Err(2));
    }
}
