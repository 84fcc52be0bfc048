//! The headings of measured rows.

use super::super::heading::{factor, parted};
use super::super::{DriveFile, FileKey, diagnostic::Finding, spelling};
use crate::Drive;
use crate::results::measured::Measured;
use std::ops::Range;

/// What follows the name of a measured quantity in the heading of its standard deviation.
const DEVIATION: &str = " sd";

/// What a column holds, with the factor from its unit to SI.
pub(super) enum Column {
    /// An entry of the drive file.
    Key(FileKey, f64),
    /// A measured quantity, by its index.
    Measured(usize, f64),
    /// The standard deviation of one, by its index.
    Deviation(usize, f64),
}

/// What the column of a heading holds.
pub(super) fn column(
    text: &str,
    range: Range<usize>,
    file: &DriveFile,
    drive: &Drive,
    measured: &mut Vec<Measured>,
) -> Result<Column, Finding> {
    let ((whole, place), unit) = parted(text, range.clone())?;
    let (name, is_deviation) = match whole.strip_suffix(DEVIATION) {
        Some(name) => (name.trim_end(), true),
        None => (whole, false),
    };
    let at_name = place.start..place.start + name.len();
    let keys = file.keys();
    if let Some(key) = keys.iter().find(|key| key.path() == name && !is_deviation) {
        let factor = factor(unit, key.measure())?;
        return Ok(Column::Key(key.clone(), factor));
    }
    let all = Measured::all(drive);
    let Some(found) = all.iter().find(|measured| measured.name() == name) else {
        let known = || {
            let names = all.iter().map(Measured::name);
            names.chain(keys.iter().map(FileKey::path))
        };
        let nearest = spelling::nearest(name, known().map(|name| (name, name)));
        let nearest = nearest.or_else(|| spelling::nearest_key(name, known));
        let finding = Finding::new(at_name, format!("unknown column `{name}`"))
            .expected("a number of the drive file, a measured quantity, or one with ` sd` for its standard deviation");
        return Err(match nearest {
            _ if name.contains([';', '\t']) => finding.help("commas part the fields of a line"),
            Some(_) => finding.did_you_mean(nearest),
            None => finding.help(format!(
                "what can be measured: `{}`",
                all.iter()
                    .map(Measured::name)
                    .collect::<Vec<_>>()
                    .join("`, `")
            )),
        });
    };
    let factor = factor(unit, found.measure())?;
    let index = measured.iter().position(|known| known.name() == name);
    match (index, is_deviation) {
        (Some(_), false) => Err(
            Finding::new(at_name, format!("the column `{name}` stands twice")).expected("it once"),
        ),
        (None, false) => {
            measured.push(found.clone());
            Ok(Column::Measured(measured.len() - 1, factor))
        }
        (Some(index), true) => Ok(Column::Deviation(index, factor)),
        (None, true) => {
            let message = format!("a standard deviation before its column `{name}`");
            Err(Finding::new(range, message).expected(format!("`{name}` to the left of it")))
        }
    }
}

/// The finding for measured quantities some or all of which have no standard deviation.
pub(super) fn without_deviation(
    text: &str,
    headings: &[Range<usize>],
    columns: &[Column],
    measured: &[Measured],
) -> Finding {
    let has = |index: usize| {
        let is_of = |column: &Column| matches!(column, Column::Deviation(of, _) if *of == index);
        columns.iter().any(is_of)
    };
    let lacking = (0..measured.len()).find(|&index| !has(index)).unwrap_or(0);
    let is_it = |column: &Column| matches!(column, Column::Measured(of, _) if *of == lacking);
    let place = columns.iter().position(is_it);
    let range = place.map_or(0..0, |place| headings[place].clone());
    let name = measured[lacking].name();
    let heading = &text[range.clone()];
    Finding::new(range, format!("`{name}` has no standard deviation"))
        .expected(format!("a column `{}`", heading.replacen(name, &format!("{name}{DEVIATION}"), 1)))
        .help("several measured quantities are weighed by their standard deviations; a single one needs none")
}
