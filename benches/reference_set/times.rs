//! Times of another code, read from a table.

use std::collections::HashMap;

/// Microseconds by case and tolerance.
pub(crate) struct Times(HashMap<(String, u64), f64>);

impl Times {
    /// Reads comma-separated values. Lines that begin with # are comments; of the others the first
    /// names the columns, among which are `case`, `tolerance` and `microseconds`. Where the last is
    /// empty the case is not solved.
    pub(crate) fn read(text: &str) -> Result<Self, String> {
        let mut lines = (1..).zip(text.lines()).filter(|(_, line)| {
            let line = line.trim();
            !line.is_empty() && !line.starts_with('#')
        });
        let (_, names) = lines.next().ok_or("no table of times")?;
        let column = |name: &str| {
            let place = names.split(',').position(|other| other.trim() == name);
            place.ok_or_else(|| format!("no column {name} of times"))
        };
        let (case, tolerance) = (column("case")?, column("tolerance")?);
        let microseconds = column("microseconds")?;
        let mut times = HashMap::new();
        for (number, line) in lines {
            let cells: Vec<&str> = line.split(',').map(str::trim).collect();
            let damaged = || format!("line {number} of times: {line}");
            let cell = |index: usize| cells.get(index).copied().ok_or_else(damaged);
            let parsed = |text: &str| text.parse::<f64>().map_err(|_| damaged());
            let key = (cell(case)?.to_owned(), parsed(cell(tolerance)?)?.to_bits());
            match cell(microseconds)? {
                "" => {}
                time => drop(times.insert(key, parsed(time)?)),
            }
        }
        Ok(Self(times))
    }

    /// The microseconds of a case at a tolerance, if it is solved.
    pub(crate) fn of(&self, case: &str, tolerance: f64) -> Option<f64> {
        self.0.get(&(case.to_owned(), tolerance.to_bits())).copied()
    }
}
