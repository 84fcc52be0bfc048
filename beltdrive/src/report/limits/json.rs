//! Both limits of a drive as JSON: complete, at full precision, every key with its unit.

use crate::report::branch::ConvergenceReport;
use crate::report::{
    belt::BeltReport, errors::ErrorReport, json::WarningReport, json::pretty, scalars::Scalars,
    value::Named, words,
};
use crate::{Branch, Limit, Limits, Pulley};
use serde::Serialize;

/// Both limits as pretty-printed JSON, each with the state there under the keys of the report of a
/// steady state.
pub fn json(limits: &Limits) -> String {
    let branch = &limits.branch;
    let key = branch.key;
    pretty(&Report {
        title: branch.drive.title.as_deref(),
        belt: BeltReport::from(&branch.drive),
        friction_law: branch.drive.law.name(),
        parameter: key.path(),
        unit: key.unit(),
        smallest: LimitReport::of(branch, &limits.smallest),
        largest: LimitReport::of(branch, &limits.largest),
        convergence: ConvergenceReport::from(&branch.convergence),
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
    smallest: LimitReport,
    largest: LimitReport,
    convergence: ConvergenceReport,
}

#[derive(Serialize)]
struct LimitReport {
    #[serde(flatten)]
    parameter: Named,
    value: f64,
    value_error: Option<f64>,
    reason: &'static str,
    pulley: Option<Pulley>,
    description: String,
    warnings: Vec<WarningReport>,
    #[serde(flatten)]
    scalars: Scalars,
    error_estimate: Option<f64>,
    errors: Option<ErrorReport>,
}

impl LimitReport {
    fn of(branch: &Branch, limit: &Limit) -> Self {
        let key = branch.key;
        let warnings = limit.warnings(&branch.drive, &key);
        Self {
            parameter: Named(key, limit.value),
            value: key.reported(limit.value),
            value_error: limit.value_error.map(|error| key.reported(error)),
            reason: words::range_end_kind(limit.reason),
            pulley: words::range_end_pulley(limit.reason),
            description: limit.reason.to_string(),
            warnings: warnings.iter().map(WarningReport::from).collect(),
            scalars: Scalars::from(&limit.state),
            error_estimate: limit.state.error_estimate,
            errors: limit.errors.as_ref().map(ErrorReport::from),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::{sample_branch, sample_flat};
    use serde_json::Value;

    #[test]
    fn a_flat_belt_slips_on_a_pulley() {
        let text = json(&sample_flat::limits());
        let report: Value = serde_json::from_str(&text).unwrap();
        let (largest, belt) = (&report["largest"], &report["belt_type"]);
        assert_eq!([belt, &largest["reason"]], ["flat", "gross slip"]);
        assert_eq!(largest["pulley"], "driver");
        assert!(largest["driver"]["slip_arc_deg"].as_f64().unwrap() > 90.0);
    }

    #[test]
    fn each_end_has_value_reason_and_state() {
        let limits = sample_branch::limits();
        let report: Value = serde_json::from_str(&json(&limits)).unwrap();
        assert_eq!(report["parameter"], "load.tight_tractive_tension");
        let largest = &report["largest"];
        assert_eq!(largest["tight_tractive_tension_N"], 8221.013);
        assert_eq!(largest["value"], 8221.013);
        assert_eq!(largest["value_error"], 0.004);
        assert_eq!(largest["reason"], "fold");
        assert_eq!(largest["pulley"], "driver");
        let description = "the belt overhangs at the exit of the driver";
        assert_eq!(largest["description"], description);
        let wrap = limits.largest.state.driver.wrap_angle.to_degrees();
        assert_eq!(largest["driver"]["wrap_angle_deg"], wrap);
        assert_eq!(largest["errors"]["efficiency"], 1e-6);
        assert_eq!(report["smallest"]["reason"], "no load");
        assert!(report["smallest"]["pulley"].is_null());
        assert_eq!(report["convergence"]["tolerance"], 1e-6);
    }
}
