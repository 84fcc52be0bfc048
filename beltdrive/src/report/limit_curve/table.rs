//! A curve of limits as a table for a terminal.

use crate::LimitCurve;
use crate::report::branch::convergence;
use crate::report::{self, lines, shown::Shown, table_columns, value, words};

/// Most rows shown.
const ROWS: usize = 30;

/// The curve on lines of at most 100 columns: limits at even distances along it, its cusps, and why
/// it ends.
pub fn table(curve: &LimitCurve) -> String {
    let LimitCurve { key, second, .. } = *curve;
    let mut title = report::title(&curve.drive, &[key, second]);
    title.push(format!(
        "Limit of {} over {}: {} limits",
        key.path(),
        second.path(),
        curve.points.len()
    ));
    let cusps = curve.cusps.iter().map(|cusp| {
        format!(
            "cusp at {} and {}: two limit points meet and vanish",
            value::quantity(second, cusp.second, None),
            value::quantity(key, cusp.value, cusp.value_error)
        )
    });
    lines::text([
        title,
        limits(curve),
        cusps.collect(),
        vec![format!("end of the curve: {}", curve.end)],
        convergence(&curve.drive, &curve.convergence),
    ])
}

fn limits(curve: &LimitCurve) -> Vec<String> {
    let [second, unit] = [curve.second, curve.key].map(|key| match key.unit() {
        "" => "–",
        unit => unit,
    });
    let columns = table_columns::of_limit_curve(&curve.drive);
    let leads = [["second", "limit"], ["parameter", ""], [second, unit]];
    let trails = ["", "", "reason"];
    let header = (0..table_columns::HEADS).map(|place| {
        let heads = table_columns::head(columns, place);
        line(leads[place], &heads, trails[place])
    });
    let stride = curve.points.len().div_ceil(ROWS).max(1);
    let rows = curve.points.iter().step_by(stride);
    let limits = rows.map(|point| {
        let LimitCurve { key, second, .. } = *curve;
        let values = [(key, point.value), (second, point.second)];
        let tolerance = curve.convergence.tolerance;
        let state = Shown::of(&curve.drive, &values, &point.state, tolerance);
        let lead = [
            value::cell(second, point.second, None),
            value::cell(key, point.value, point.value_error),
        ];
        line(
            lead.each_ref().map(String::as_str),
            &table_columns::cells(columns, &state),
            words::limit_label(point.reason),
        )
    });
    header.chain(limits).collect()
}

/// A limit on one line.
fn line([second, limit]: [&str; 2], scalars: &str, reason: &str) -> String {
    format!("{second:>12}{limit:>14}{scalars}  {reason}")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::{lines::WIDTH, sample_branch, sample_flat};

    #[test]
    fn shows_limits_cusps_and_the_end() {
        let mut curve = sample_branch::curve();
        curve.cusps = vec![curve.points[3].clone()];
        let text = table(&curve);
        for needle in [
            "friction, μ varied",
            "Limit of load.tight_tractive_tension over friction.coefficient: 21 limits",
            "fold: driver slips",
            "fold: driver overhangs",
            "cusp at 0.26 and 1746.15 N",
            "end of the curve",
        ] {
            assert!(text.contains(needle), "{needle} is not in\n{text}");
        }
        assert!(text.lines().all(|line| line.chars().count() <= WIDTH));
        let text = table(&sample_flat::curve());
        for needle in [
            "slip      arc\n",
            "47.2852  47.1992  driver slips",
            "closed form",
        ] {
            assert!(text.contains(needle), "{needle} is not in\n{text}");
        }
        assert!(text.lines().all(|line| line.chars().count() <= WIDTH));
    }
}
