//! A curve of limits as comma-separated values.

use crate::LimitCurve;
use crate::report::{rows, state_columns::columns_beside, words};

/// The limits, one row each, in order along the curve, with the names of the JSON report.
///
/// The first column is the second parameter, the next one the limit.
pub fn csv(curve: &LimitCurve) -> String {
    let LimitCurve { key, second, .. } = *curve;
    let columns = columns_beside(&curve.drive, &[key, second]);
    let own = [second.column(), key.column()].into_iter();
    let own = own.chain(["value_error", "reason", "pulley"].map(str::to_owned));
    let header = own.chain(columns.iter().map(|column| column.key.to_owned()));
    let rows = curve.points.iter().map(|point| {
        let own = [
            second.reported(point.second).to_string(),
            key.reported(point.value).to_string(),
            rows::optional(point.value_error.map(|error| key.reported(error))),
            words::limit_kind(point.reason).to_owned(),
            words::limit_pulley(point.reason)
                .map_or("", words::pulley_word)
                .to_owned(),
        ];
        let scalars = columns.iter().map(|column| column.text(&point.state));
        own.into_iter().chain(scalars).collect()
    });
    rows::csv(header.collect(), rows)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::sample_branch;

    #[test]
    fn has_a_row_for_each_limit() {
        let curve = sample_branch::curve();
        let text = csv(&curve);
        let lines: Vec<_> = text.lines().collect();
        assert_eq!(lines.len(), 1 + curve.points.len());
        let header = "coefficient,tight_tractive_tension_N,value_error,reason,pulley,";
        assert!(lines[0].starts_with(header), "{}", lines[0]);
        let first = &curve.points[0];
        let row = format!("0.2,{},0.01,fold,driver,", first.value);
        assert!(lines[1].starts_with(&row), "{}", lines[1]);
    }
}
