//! A branch as JSON: complete, at full precision, every key with its unit.

use crate::input::Key;
use crate::report::{
    belt::BeltReport, errors::ErrorReport, json::pretty, scalars::Scalars, value::Named, words,
};
use crate::{
    Branch, BranchEnd, BranchEvent, Drive, Pulley, TraceConvergence, TracePoint, ZoneKind,
};
use serde::Serialize;

/// The whole branch as pretty-printed JSON.
///
/// Every state has its parameter twice, as `value` and under the name of the entry with its unit,
/// and the scalars of the report of a steady state. Angles are in degrees (`_deg`), everything
/// else is SI. A number that is not known is `null`.
pub fn json(branch: &Branch) -> String {
    let key = branch.key;
    pretty(&Report {
        title: branch.drive.title.as_deref(),
        belt: BeltReport::from(&branch.drive),
        friction_law: branch.drive.law.name(),
        parameter: key.path(),
        unit: key.unit(),
        points: branch
            .points
            .iter()
            .map(|point| PointReport::of(key, point))
            .collect(),
        events: branch
            .events
            .iter()
            .map(|event| EventReport::of(&branch.drive, key, event))
            .collect(),
        end: EndReport::from(&branch.end),
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
    points: Vec<PointReport>,
    events: Vec<EventReport>,
    end: EndReport,
    convergence: ConvergenceReport,
}

#[derive(Serialize)]
struct PointReport {
    #[serde(flatten)]
    parameter: Named,
    value: f64,
    arclength: f64,
    #[serde(flatten)]
    scalars: Scalars,
    error_estimate: Option<f64>,
}

impl PointReport {
    fn of(key: Key, point: &TracePoint) -> Self {
        Self {
            parameter: Named(key, point.value),
            value: key.reported(point.value),
            arclength: point.arclength,
            scalars: Scalars::from(&point.state),
            error_estimate: point.state.error_estimate,
        }
    }
}

#[derive(Serialize)]
struct EventReport {
    kind: &'static str,
    pulley: Option<Pulley>,
    zone: Option<ZoneKind>,
    description: String,
    #[serde(flatten)]
    point: PointReport,
    value_error: Option<f64>,
    errors: Option<ErrorReport>,
}

impl EventReport {
    fn of(drive: &Drive, key: Key, event: &BranchEvent) -> Self {
        Self {
            kind: words::event_kind(event.kind),
            pulley: words::event_pulley(event.kind),
            zone: words::event_zone(event.kind),
            description: words::event(event.kind, key, drive),
            point: PointReport::of(key, &event.point),
            value_error: event.value_error.map(|error| key.reported(error)),
            errors: event.errors.as_ref().map(ErrorReport::from),
        }
    }
}

/// Why a branch or a curve ends.
#[derive(Serialize)]
pub(in crate::report) struct EndReport {
    reason: &'static str,
    description: String,
}

impl From<&BranchEnd> for EndReport {
    fn from(end: &BranchEnd) -> Self {
        Self {
            reason: words::end_kind(end),
            description: end.to_string(),
        }
    }
}

/// How a branch or a curve was traced.
#[derive(Serialize)]
pub(in crate::report) struct ConvergenceReport {
    tolerance: f64,
    slip_normalisation: f64,
    continuation_steps: usize,
    rhs_evaluations: usize,
    factorisations: usize,
    seconds: f64,
}

impl From<&TraceConvergence> for ConvergenceReport {
    fn from(convergence: &TraceConvergence) -> Self {
        Self {
            tolerance: convergence.tolerance,
            slip_normalisation: convergence.slip_normalisation,
            continuation_steps: convergence.continuation_steps,
            rhs_evaluations: convergence.rhs_evaluations,
            factorisations: convergence.factorisations,
            seconds: convergence.seconds,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::{sample_branch, sample_flat};
    use serde_json::Value;

    fn parsed(branch: &Branch) -> Value {
        serde_json::from_str(&json(branch)).unwrap()
    }

    #[test]
    fn points_carry_the_parameter_and_the_scalars_of_a_state() {
        let branch = sample_branch::folded();
        let report = parsed(&branch);
        assert_eq!(report["parameter"], "load.tight_tractive_tension");
        assert_eq!(report["unit"], "N");
        assert_eq!(
            report["points"].as_array().unwrap().len(),
            branch.points.len()
        );
        let (found, point) = (&report["points"][7], &branch.points[7]);
        assert_eq!(found["tight_tractive_tension_N"], point.value);
        assert_eq!(found["value"], point.value);
        assert_eq!(found["efficiency"], point.state.efficiency);
        assert_eq!(found["driven"]["torque_N_m"], point.state.driven.torque);
        assert_eq!(found["tractive_tension_N"]["tight"], point.value);
        assert_eq!(found["driven"]["zones"][1]["kind"], "slip");
        assert!(found["error_estimate"].is_null());
    }

    #[test]
    fn events_say_what_happens_and_how_accurately_it_is_known() {
        let report = parsed(&sample_branch::folded());
        let kinds: Vec<_> = report["events"]
            .as_array()
            .unwrap()
            .iter()
            .map(|event| &event["kind"])
            .collect();
        assert_eq!(kinds, ["start", "overhang", "fold", "end"]);
        let fold = &report["events"][2];
        assert_eq!(
            fold["description"],
            "limit point: the tight tractive tension turns back"
        );
        assert_eq!(fold["value_error"], 0.004);
        assert_eq!(fold["errors"]["driven"]["torque_N_m"], 3e-3);
        assert!(fold["pulley"].is_null());
        assert_eq!(report["events"][1]["pulley"], "driver");
        assert_eq!(report["end"]["reason"], "target");
        assert_eq!(report["convergence"]["continuation_steps"], 64);
    }

    #[test]
    fn a_flat_belt_enters_and_slips_at_every_point() {
        let report = parsed(&sample_flat::branch());
        assert_eq!(report["belt_type"], "flat");
        let point = &report["points"][40]["driven"];
        assert!(point["slip_arc_deg"].as_f64().unwrap() > 90.0);
        assert_eq!(point["entry_strain"], 2.5e-7);
        let appears = &report["events"][1];
        assert_eq!(appears["kind"], "zone appears");
        assert_eq!(appears["zone"], "slip");
        let slips = "the driver slips grossly";
        assert_eq!(report["events"][2]["description"], slips);
    }

    #[test]
    fn angles_are_in_degrees() {
        let mut branch = sample_branch::folded();
        let angle = |key: &Key| key.path() == "groove.half_angle";
        branch.key = Key::all(&branch.drive).find(angle).unwrap();
        branch.points[0].value = 0.3;
        let report = parsed(&branch);
        assert_eq!(report["points"][0]["half_angle_deg"], 0.3_f64.to_degrees());
        assert_eq!(report["unit"], "°");
    }
}
