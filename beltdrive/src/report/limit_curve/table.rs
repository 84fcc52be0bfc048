//! A curve of limits as a table for a terminal.

use crate::report::branch::convergence;
use crate::report::{Precision, heading, law, lines, torque_scale, value, words};
use crate::{LimitCurve, LimitCurvePoint};

/// Most rows shown.
const ROWS: usize = 30;

/// Most significant digits of a scalar.
const DIGITS: u8 = 6;

/// The curve on lines of at most 100 columns: limits at even distances along it, its cusps, and why
/// it ends.
pub fn table(curve: &LimitCurve) -> String {
    let LimitCurve { key, second, .. } = *curve;
    let title = vec![
        heading(&curve.drive),
        law(&curve.drive, &[key, second]),
        format!(
            "Limit of {} over {}: {} limits",
            key.path(),
            second.path(),
            curve.points.len()
        ),
    ];
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
        convergence(&curve.convergence),
    ])
}

fn limits(curve: &LimitCurve) -> Vec<String> {
    let [second, unit] = [curve.second, curve.key].map(|key| match key.unit() {
        "" => "–",
        unit => unit,
    });
    let header = [
        [
            "second", "limit", "driven", "driven", "effi-", "exit of", "",
        ],
        ["parameter", "", "speed", "torque", "ciency", "driver", ""],
        [second, unit, "rad/s", "N·m", "%", "°", "reason"],
    ];
    let stride = curve.points.len().div_ceil(ROWS).max(1);
    let rows = curve.points.iter().step_by(stride);
    header
        .map(|cells| line(cells.map(str::to_owned)))
        .into_iter()
        .chain(rows.map(|point| limit(curve, point)))
        .collect()
}

/// A limit on one line.
fn limit(curve: &LimitCurve, point: &LimitCurvePoint) -> String {
    let LimitCurve { key, second, .. } = *curve;
    let state = &point.state;
    let error = state.error_estimate.unwrap_or(curve.convergence.tolerance);
    let precision = Precision::new(error, DIGITS);
    let mut drive = curve.drive.clone();
    key.set(&mut drive, point.value);
    second.set(&mut drive, point.second);
    let torque = torque_scale(&drive, state.tight_tension);
    let exit = state.driver.inclination[1].to_degrees();
    line([
        value::cell(second, point.second, None),
        value::cell(key, point.value, point.value_error),
        precision.show_against(state.driven.angular_speed, state.driver.angular_speed),
        precision.show_against(state.driven.torque, torque),
        precision.show_against(100.0 * state.efficiency, 100.0),
        precision.show_against(exit, 1_f64.to_degrees()),
        words::limit_label(point.reason).to_owned(),
    ])
}

fn line([second, limit, speed, torque, efficiency, exit, reason]: [String; 7]) -> String {
    format!("{second:>12}{limit:>14}{speed:>12}{torque:>12}{efficiency:>10}{exit:>10}  {reason}")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::{lines::WIDTH, sample_branch};

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
    }
}
