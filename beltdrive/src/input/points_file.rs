//! Points over time or speed in CSV files that a drive file names.

use super::csv::{fields, lines, number_of};
use super::dimension::Dimension;
use super::schema::{self, Kind};
use super::source::Source;
use super::{Diagnostic, DriveFile, check, diagnostic::Finding, document::Content, heading};
use std::ops::Range;

/// The names of the columns of the points of a key.
fn names(key: &str) -> [&'static str; 2] {
    match key {
        "speed" => ["time", "speed"],
        "motor_torque_over_speed" => ["speed", "torque"],
        _ => ["time", "torque"],
    }
}

impl DriveFile {
    /// The CSV files that the file names in place of points: dotted path of the key and name of the file.
    pub fn points_files(&self) -> Vec<(String, String)> {
        let entries = self.document.entries.iter();
        let named =
            entries.filter_map(|(path, entry)| match (&entry.content, schema::rule(path)) {
                (Content::Text(name), Some(rule)) if matches!(rule.kind, Kind::Points { .. }) => {
                    Some((path.clone(), name.clone()))
                }
                _ => None,
            });
        named.collect()
    }

    /// Takes the points of a key, by its dotted path, from a CSV text that is called `name` in messages.
    ///
    /// The first line has the headings of the columns. Of these one is called `time` and one `torque` or `speed`, as the
    /// key asks for; with `motor_torque_over_speed` they are `speed` and `torque`. Each has its unit in brackets where it
    /// is not SI, `torque [N*mm]`. Other columns are left alone. Lines that begin with `#` are comments.
    ///
    /// ```
    /// # let text = "[transient.pulley.fan]\nload = \"fan.csv\"\n";
    /// let file = beltdrive::input::DriveFile::read("drive.toml", text, &[])?;
    /// let [(path, name)] = &file.points_files()[..] else { panic!("one file is named") };
    /// assert_eq!(name, "fan.csv");
    /// let file = file.with_points(path, name, "time [ms],torque [N*m]\n0,2\n50,3.5\n")?;
    /// # Ok::<(), beltdrive::input::Diagnostic>(())
    /// ```
    ///
    /// # Errors
    /// The first finding: the key has no points, a column is missing or stands twice, its unit is wrong, a row has another number of fields, a
    /// field is no number, there are no rows.
    pub fn with_points(mut self, path: &str, name: &str, text: &str) -> Result<Self, Diagnostic> {
        let (_, key) = schema::split(path);
        let [place, value] = names(key);
        let points = dimensions(path)
            .ok_or_else(|| Finding::new(0..0, format!("`{path}` has no points")))
            .and_then(|[of_place, of_value]| points(text, [(place, of_place), (value, of_value)]))
            .map_err(|finding| Diagnostic::new(finding, &Source::new(name, text, &[])))?;
        self.document.points.insert(path.to_owned(), points);
        Ok(self)
    }
}

/// The dimensions of the points under a key.
fn dimensions(path: &str) -> Option<[Dimension; 2]> {
    match schema::rule(path)?.kind {
        Kind::Points { dimensions } => Some(dimensions),
        _ => None,
    }
}

/// The points of a text.
fn points(text: &str, columns: [(&str, Dimension); 2]) -> Result<Vec<[f64; 2]>, Finding> {
    let end = text.trim_end().len();
    let expected = || {
        format!(
            "a heading for each column, e.g. {},{}",
            columns[0].0, columns[1].0
        )
    };
    let mut lines = lines(text);
    let Some((_, headings)) = lines.next() else {
        return Err(Finding::new(end..end, "there is no line with headings").expected(expected()));
    };
    let headings: Vec<_> = fields(text, headings.clone()).collect();
    let places = [
        column(text, &headings, columns[0])?,
        column(text, &headings, columns[1])?,
    ];
    let rows = lines.map(|(_, line)| {
        let fields: Vec<_> = fields(text, line.clone()).collect();
        if fields.len() != headings.len() {
            let message = format!("{} fields under {} headings", fields.len(), headings.len());
            let finding = Finding::new(line, message).expected("a field for each heading");
            return Err(finding.help("a decimal point is a point; a comma parts fields"));
        }
        let [place, value] = places.map(|(column, factor)| {
            let field = fields[column].clone();
            number_of(&text[field.clone()], field).map(|number| number * factor)
        });
        Ok([place?, value?])
    });
    let rows: Vec<_> = rows.collect::<Result<_, _>>()?;
    match rows.is_empty() {
        true => Err(Finding::new(
            end..end,
            "there are no rows below the headings",
        )),
        false => Ok(rows),
    }
}

/// Where a column stands, and the factor from its unit to SI.
fn column(
    text: &str,
    headings: &[Range<usize>],
    (name, dimension): (&str, Dimension),
) -> Result<(usize, f64), Finding> {
    let mut found = None;
    let mut names = vec![];
    for (index, heading) in headings.iter().enumerate() {
        let ((own, place), unit) = heading::parted(text, heading.clone())?;
        names.push(own);
        if own != name {
            continue;
        }
        if found.is_some() {
            return Err(Finding::new(
                place,
                format!("the column `{name}` stands twice"),
            ));
        }
        let factor = unit.map_or(Ok(1.0), |unit| heading::scale(unit, dimension))?;
        found = Some((index, factor));
    }
    found.ok_or_else(|| {
        let line = headings[0].start..headings[headings.len() - 1].end;
        Finding::new(line, format!("no column is called `{name}`"))
            .expected(format!("`{name}` among {}", check::one_of(&names)))
    })
}
