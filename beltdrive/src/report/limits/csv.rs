//! Both limits of a drive as comma-separated values.

use crate::Limits;
use crate::report::{rows, state_columns::columns_beside, words};

/// One row for the smallest and one for the largest value, with the names of the JSON report.
pub fn csv(limits: &Limits) -> String {
    let key = limits.branch.key;
    let columns = columns_beside(&limits.branch.drive, &[key]);
    let own = ["limit", &key.column(), "value_error", "reason", "pulley"].map(str::to_owned);
    let header = own.into_iter();
    let header = header.chain(columns.iter().map(|column| column.key.to_owned()));
    let ends = [("smallest", &limits.smallest), ("largest", &limits.largest)];
    let rows = ends.map(|(name, limit)| {
        let pulley = words::range_end_pulley(limit.reason);
        let own = [
            name.to_owned(),
            key.reported(limit.value).to_string(),
            rows::optional(limit.value_error.map(|error| key.reported(error))),
            words::range_end_kind(limit.reason).to_owned(),
            pulley.map_or("", words::pulley_word).to_owned(),
        ];
        let scalars = columns.iter().map(|column| column.text(&limit.state));
        own.into_iter().chain(scalars).collect()
    });
    rows::csv(header.collect(), rows)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::{sample_branch, sample_flat};

    #[test]
    fn a_flat_belt_slips_on_a_pulley() {
        let text = csv(&sample_flat::limits());
        let largest = text.lines().nth(2).unwrap();
        let row = "largest,560,0.000000001,gross slip,driver,3,";
        assert!(largest.starts_with(row), "{text}");
        assert!(largest.ends_with(",0.00000025,765432.1,inertia"), "{text}");
    }

    #[test]
    fn has_a_row_for_each_end() {
        let text = csv(&sample_branch::limits());
        let lines: Vec<_> = text.lines().collect();
        assert_eq!(lines.len(), 3);
        assert!(lines[0].starts_with("limit,tight_tractive_tension_N,value_error,reason,pulley,"));
        assert!(
            lines[1].starts_with("smallest,700,0.004,no load,,2.768,"),
            "{text}"
        );
        assert!(
            lines[2].starts_with("largest,8221.013,0.004,fold,driver,2.768,"),
            "{text}"
        );
    }
}
