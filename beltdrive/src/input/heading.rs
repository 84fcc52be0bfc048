//! Headings of columns: a name and, in brackets, a unit.

use super::{diagnostic::Finding, dimension::Dimension, unit};
use crate::quantity::Measure;
use std::ops::Range;

/// A part of a text and where it stands.
pub(super) type Placed<'t> = (&'t str, Range<usize>);

/// The name and the unit of the heading at a place of a text: `load.torque [N*m]`.
pub(super) fn parted(
    text: &str,
    range: Range<usize>,
) -> Result<(Placed<'_>, Option<Placed<'_>>), Finding> {
    let heading = &text[range.clone()];
    let (name, unit) = match heading.split_once('[') {
        Some((name, unit)) => {
            let start = range.start + name.len() + 1;
            let unit = unit.strip_suffix(']').ok_or_else(|| {
                Finding::new(range.clone(), format!("the unit of `{heading}` has no end"))
                    .expected("the unit in brackets, e.g. load.torque [N*m]")
            })?;
            (name.trim_end(), Some((unit, start..start + unit.len())))
        }
        None => (heading, None),
    };
    let place = range.start..range.start + name.len();
    Ok(((name, place), unit))
}

/// The factor from a unit to SI for a measure; SI without a unit.
pub(super) fn factor(unit: Option<Placed<'_>>, measure: Measure) -> Result<f64, Finding> {
    let Some((symbols, range)) = unit else {
        return Ok(1.0);
    };
    let trimmed = symbols.trim();
    // Of vibration, not of turning.
    if measure == Measure::Frequency {
        return match trimmed {
            "Hz" => Ok(1.0),
            _ => Err(
                Finding::new(range, format!("`{trimmed}` is no unit of a frequency"))
                    .expected("Hz"),
            ),
        };
    }
    let dimension = match measure {
        Measure::Share => Dimension::NUMBER,
        Measure::Loss => Dimension::POWER,
        measure => Dimension::of(measure).unwrap_or(Dimension::NUMBER),
    };
    scale((symbols, range), dimension)
}

/// The factor from a unit to SI for a dimension.
pub(super) fn scale((symbols, range): Placed<'_>, dimension: Dimension) -> Result<f64, Finding> {
    let trimmed = symbols.trim();
    let found = unit::parse(trimmed).map_err(|_| {
        Finding::new(range.clone(), format!("unknown unit `{trimmed}`"))
            .expected(format!("{dimension}"))
            .did_you_mean(unit::nearest(trimmed))
    })?;
    match found.dimension == dimension {
        true => Ok(found.scale),
        false => {
            let message = format!(
                "wrong dimension: expected {dimension}, got {}",
                found.dimension
            );
            Err(Finding::new(range, message))
        }
    }
}
