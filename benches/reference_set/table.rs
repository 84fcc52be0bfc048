//! The tables as Markdown.

use reference_problems::{geometric_mean, quantile};

/// A case at one tolerance; times in microseconds.
pub(crate) struct Row {
    /// The name.
    pub(crate) case: &'static str,
    /// Whether a right solution was returned.
    pub(crate) right: bool,
    /// The fastest run.
    pub(crate) least: f64,
    /// The median run.
    pub(crate) median: f64,
    /// The fastest native code that solves it.
    pub(crate) native: Option<f64>,
    /// `SciPy`, where it solves it.
    pub(crate) scipy: Option<f64>,
}

impl Row {
    /// Our time over another one.
    fn ratio(&self, other: Option<f64>) -> Option<f64> {
        other.filter(|_| self.right).map(|time| self.least / time)
    }
}

/// Three significant digits, all of those before the point; a dash for nothing.
fn number(value: Option<f64>) -> String {
    let Some(value) = value.filter(|v| v.is_finite() && *v > 0.0) else {
        return "–".to_owned();
    };
    let decimals = (0..5)
        .take_while(|&n| value * 10f64.powi(n) < 100.0)
        .count();
    format!("{value:.decimals$}")
}

/// One line of a table.
fn line(cells: &[String]) -> String {
    format!("| {} |", cells.join(" | "))
}

/// The head of a table: names, then the rule, the first column aligned left.
fn print_head(names: &[&str]) {
    let names: Vec<String> = names.iter().map(ToString::to_string).collect();
    let rule = |i: usize| if i == 0 { "---" } else { "---:" }.to_owned();
    println!("{}", line(&names));
    println!(
        "{}",
        line(&(0..names.len()).map(rule).collect::<Vec<String>>())
    );
}

/// Prints a line per case.
pub(crate) fn print_rows(tolerance: f64, rows: &[Row], with_scipy: bool) {
    println!("\n## {tolerance:e}\n");
    let names = [
        "case",
        "least, µs",
        "median, µs",
        "native, µs",
        "least / native",
        "SciPy, µs",
        "least / SciPy",
    ];
    let columns = if with_scipy { 7 } else { 5 };
    print_head(&names[..columns]);
    for row in rows {
        let time = |time| Some(time).filter(|_| row.right);
        let cells = [
            row.case.to_owned(),
            number(time(row.least)),
            number(time(row.median)),
            number(row.native),
            number(row.ratio(row.native)),
            number(row.scipy),
            number(row.ratio(row.scipy)),
        ];
        println!("{}", line(&cells[..columns]));
    }
}

/// Prints a line per tolerance: how many are solved, medians of times, geometric means of ratios.
pub(crate) fn print_summary(tables: &[(f64, Vec<Row>)], with_scipy: bool) {
    println!("\n## Summary\n");
    println!("Medians over the cases; ratios as geometric means over the cases that both solve.\n");
    let names = [
        "tolerance",
        "solved",
        "least, µs",
        "median, µs",
        "native, µs",
        "least / native",
        "at most 1",
        "largest",
        "SciPy, µs",
        "least / SciPy",
        "largest",
    ];
    let columns = if with_scipy { 11 } else { 8 };
    print_head(&names[..columns]);
    for (tolerance, rows) in tables {
        let right: Vec<&Row> = rows.iter().filter(|row| row.right).collect();
        let of = |value: &dyn Fn(&Row) -> Option<f64>| -> Vec<f64> {
            right.iter().filter_map(|row| value(row)).collect()
        };
        let median = |value: &dyn Fn(&Row) -> Option<f64>| number(Some(quantile(&of(value), 0.5)));
        let to_native = of(&|row| row.ratio(row.native));
        let to_scipy = of(&|row| row.ratio(row.scipy));
        let faster = to_native.iter().filter(|&&ratio| ratio <= 1.0).count();
        let cells = [
            format!("{tolerance:e}"),
            format!("{} of {}", right.len(), rows.len()),
            median(&|row| Some(row.least)),
            median(&|row| Some(row.median)),
            median(&|row| row.native),
            number(Some(geometric_mean(&to_native))),
            format!("{faster} of {}", to_native.len()),
            number(Some(quantile(&to_native, 1.0))),
            median(&|row| row.scipy),
            number(Some(geometric_mean(&to_scipy))),
            number(Some(quantile(&to_scipy, 1.0))),
        ];
        println!("{}", line(&cells[..columns]));
    }
}
