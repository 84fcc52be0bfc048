//! A curve of limits as JSON: complete, at full precision, every key with its unit.

use crate::report::branch::{ConvergenceReport, EndReport};
use crate::report::{belt::BeltReport, json::pretty, scalars::Scalars, value::Named, words};
use crate::{LimitCurve, LimitCurvePoint, Pulley};
use serde::Serialize;

/// The whole curve as pretty-printed JSON.
///
/// Every limit has both parameters under the names of their entries with units and as
/// `second_value` and `value`, and the scalars of the report of a steady state.
pub fn json(curve: &LimitCurve) -> String {
    let reports = |points: &[LimitCurvePoint]| {
        let reports = points.iter().map(|point| PointReport::of(curve, point));
        reports.collect()
    };
    pretty(&Report {
        title: curve.drive.title.as_deref(),
        belt: BeltReport::from(&curve.drive),
        friction_law: curve.drive.law.name(),
        parameter: curve.key.path(),
        unit: curve.key.unit(),
        second_parameter: curve.second.path(),
        second_unit: curve.second.unit(),
        points: reports(&curve.points),
        cusps: reports(&curve.cusps),
        end: EndReport::from(&curve.end),
        convergence: ConvergenceReport::from(&curve.convergence),
    })
}

#[derive(Serialize)]
struct Report<'a> {
    title: Option<&'a str>,
    #[serde(flatten)]
    belt: BeltReport,
    friction_law: &'static str,
    parameter: &'static str,
    unit: &'static str,
    second_parameter: &'static str,
    second_unit: &'static str,
    points: Vec<PointReport>,
    cusps: Vec<PointReport>,
    end: EndReport,
    convergence: ConvergenceReport,
}

#[derive(Serialize)]
struct PointReport {
    #[serde(flatten)]
    second_parameter: Named,
    #[serde(flatten)]
    parameter: Named,
    second_value: f64,
    value: f64,
    value_error: Option<f64>,
    reason: &'static str,
    pulley: Option<Pulley>,
    description: String,
    #[serde(flatten)]
    scalars: Scalars,
    error_estimate: Option<f64>,
}

impl PointReport {
    fn of(curve: &LimitCurve, point: &LimitCurvePoint) -> Self {
        let LimitCurve { key, second, .. } = *curve;
        Self {
            second_parameter: Named(second, point.second),
            parameter: Named(key, point.value),
            second_value: second.reported(point.second),
            value: key.reported(point.value),
            value_error: point.value_error.map(|error| key.reported(error)),
            reason: words::limit_kind(point.reason),
            pulley: words::limit_pulley(point.reason),
            description: point.reason.to_string(),
            scalars: Scalars::from(&point.state),
            error_estimate: point.state.error_estimate,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::{sample_branch, sample_flat};
    use serde_json::Value;

    #[test]
    fn each_limit_has_both_parameters() {
        let mut curve = sample_branch::curve();
        curve.cusps = vec![curve.points[3].clone()];
        let report: Value = serde_json::from_str(&json(&curve)).unwrap();
        assert_eq!(report["parameter"], "load.tight_tractive_tension");
        assert_eq!(report["second_parameter"], "friction.coefficient");
        let (found, point) = (&report["points"][3], &curve.points[3]);
        assert_eq!(found["coefficient"], point.second);
        assert_eq!(found["second_value"], point.second);
        assert_eq!(found["tight_tractive_tension_N"], point.value);
        assert_eq!(found["value"], point.value);
        assert_eq!(found["reason"], "fold");
        assert_eq!(found["description"], "the driver slips grossly");
        assert_eq!(found["mass_flow_kg_per_s"], point.state.mass_flow);
        assert_eq!(&report["cusps"][0], found);
        let report: Value = serde_json::from_str(&json(&sample_flat::curve())).unwrap();
        assert_eq!(report["normal_force"], "inertia");
        assert_eq!(report["points"][20]["reason"], "gross slip");
    }
}
