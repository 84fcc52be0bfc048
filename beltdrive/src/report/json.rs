//! The steady state as JSON: complete, at full precision, every key with its unit.

use super::answer::Groups;
use super::belt::BeltReport;
use super::columns::COLUMNS;
use super::scalars::Scalars;
use super::warning;
use crate::quantity::Group;
use crate::{Convergence, Profile, Pulley, StateSummary, SteadyState, Warning};
use serde::{Serialize, Serializer};

/// The whole state as pretty-printed JSON. Angles are in degrees (`_deg`), everything else is SI.
/// A number that is not finite is `null`.
///
/// # Panics
/// Never: strings and numbers always have a representation.
///
/// `groups` are the pulleys, the spans and the loop, as of any loop of pulleys.
pub fn json(state: &SteadyState, groups: &[Group]) -> String {
    pretty(&Whole {
        report: Report::from(state),
        groups: Groups(groups),
    })
}

/// A state with its pulleys, spans and loop as those of any loop.
#[derive(Serialize)]
struct Whole<'a> {
    #[serde(flatten)]
    report: Report<'a>,
    #[serde(flatten)]
    groups: Groups<'a>,
}

/// A report as text.
pub(super) fn pretty(report: &impl Serialize) -> String {
    serde_json::to_string_pretty(report).expect("strings and numbers")
}

#[derive(Serialize)]
struct Report<'a> {
    title: Option<&'a str>,
    #[serde(flatten)]
    belt: BeltReport,
    friction_law: &'static str,
    #[serde(flatten)]
    scalars: Scalars,
    profiles: Profiles<'a>,
    warnings: Vec<WarningReport>,
    checks: Vec<CheckReport>,
    convergence: ConvergenceReport,
}

impl<'a> From<&'a SteadyState> for Report<'a> {
    fn from(state: &'a SteadyState) -> Self {
        Self {
            title: state.drive.title.as_deref(),
            belt: BeltReport::from(&state.drive),
            friction_law: state.drive.law.name(),
            scalars: Scalars::from(&StateSummary::from(state)),
            profiles: Profiles {
                driven: ProfileReport(&state.driven.profile),
                driver: ProfileReport(&state.driver.profile),
            },
            warnings: state.warnings.iter().map(WarningReport::from).collect(),
            checks: state
                .checks
                .iter()
                .map(|check| CheckReport {
                    name: check.name,
                    deviation: check.deviation,
                    limit: check.limit,
                })
                .collect(),
            convergence: ConvergenceReport::from(&state.convergence),
        }
    }
}

#[derive(Serialize)]
struct Profiles<'a> {
    driven: ProfileReport<'a>,
    driver: ProfileReport<'a>,
}

/// A profile as a map from the name of each column to its values.
struct ProfileReport<'a>(&'a Profile);

impl Serialize for ProfileReport<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(
            COLUMNS
                .iter()
                .map(|column| (column.key, column.values(self.0))),
        )
    }
}

/// A remark on the validity of a state.
#[derive(Serialize)]
pub(super) struct WarningReport {
    kind: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    pulley: Option<Pulley>,
    #[serde(skip_serializing_if = "Option::is_none")]
    inclination_deg: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    strain: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    penetration_m: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    height_m: Option<f64>,
    message: String,
}

impl From<&Warning> for WarningReport {
    fn from(remark: &Warning) -> Self {
        let blank = Self {
            kind: "",
            pulley: None,
            inclination_deg: None,
            strain: None,
            penetration_m: None,
            height_m: None,
            message: warning(remark),
        };
        match *remark {
            Warning::Overhang {
                pulley,
                inclination,
            } => Self {
                kind: "overhang",
                pulley: Some(pulley),
                inclination_deg: Some(inclination.to_degrees()),
                ..blank
            },
            Warning::LargeStrain { strain } | Warning::LargeStretch { strain } => Self {
                kind: "large strain",
                strain: Some(strain),
                ..blank
            },
            Warning::Sunk {
                pulley,
                penetration,
                height,
            } => Self {
                kind: "belt height",
                pulley: Some(pulley),
                penetration_m: Some(penetration),
                height_m: Some(height),
                ..blank
            },
        }
    }
}

#[derive(Serialize)]
struct CheckReport {
    name: &'static str,
    deviation: f64,
    limit: f64,
}

#[derive(Serialize)]
struct ConvergenceReport {
    tolerance: f64,
    defect: f64,
    error_estimate: f64,
    mesh_intervals: [usize; 2],
    newton_iterations: usize,
    rhs_evaluations: usize,
    factorisations: usize,
    continuation_steps: usize,
    slip_normalisation: f64,
    slip_normalisation_effect: f64,
    seconds: f64,
}

impl From<&Convergence> for ConvergenceReport {
    fn from(convergence: &Convergence) -> Self {
        Self {
            tolerance: convergence.tolerance,
            defect: convergence.defect,
            error_estimate: convergence.error_estimate,
            mesh_intervals: convergence.mesh_intervals,
            newton_iterations: convergence.newton_iterations,
            rhs_evaluations: convergence.rhs_evaluations,
            factorisations: convergence.factorisations,
            continuation_steps: convergence.continuation_steps,
            slip_normalisation: convergence.slip_normalisation,
            slip_normalisation_effect: convergence.slip_normalisation_effect,
            seconds: convergence.seconds,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::{sample, sample_flat};
    use serde_json::Value;

    const KEYS: [&str; 18] = [
        "/title",
        "/belt_type",
        "/friction_law",
        "/mass_flow_kg_per_s",
        "/belt_length_m",
        "/slack_span_m",
        "/tight_span_m",
        "/efficiency",
        "/friction_loss_W",
        "/speed_loss",
        "/tension_N/slack",
        "/tension_N/tight",
        "/tractive_tension_N/slack",
        "/tractive_tension_N/tight",
        "/warnings/0/kind",
        "/warnings/0/inclination_deg",
        "/warnings/0/message",
        "/checks/0/deviation",
    ];

    const PULLEY_KEYS: [&str; 11] = [
        "angular_speed_rad_per_s",
        "torque_N_m",
        "power_W",
        "wrap_angle_deg",
        "max_penetration_m",
        "inclination_deg/0",
        "inclination_deg/1",
        "slip_arc_deg",
        "zones/0/kind",
        "zones/0/from_deg",
        "zones/0/to_deg",
    ];

    const PROFILE_KEYS: [&str; 10] = [
        "angle_deg",
        "arc_length_m",
        "tension_N",
        "tractive_tension_N",
        "inclination_deg",
        "penetration_m",
        "displacement_m",
        "sliding_angle_deg",
        "normal_force_N_per_m",
        "friction_force_N_per_m",
    ];

    const CONVERGENCE_KEYS: [&str; 12] = [
        "tolerance",
        "defect",
        "error_estimate",
        "mesh_intervals/0",
        "mesh_intervals/1",
        "newton_iterations",
        "rhs_evaluations",
        "factorisations",
        "continuation_steps",
        "slip_normalisation",
        "slip_normalisation_effect",
        "seconds",
    ];

    fn parsed(state: &SteadyState) -> Value {
        serde_json::from_str(&json(state, &[])).unwrap()
    }

    #[test]
    fn has_every_key() {
        let report = parsed(&sample::overhanging());
        let mut keys: Vec<String> = KEYS.iter().map(ToString::to_string).collect();
        for pulley in ["driver", "driven"] {
            keys.extend(PULLEY_KEYS.iter().map(|key| format!("/{pulley}/{key}")));
            keys.extend(
                PROFILE_KEYS
                    .iter()
                    .map(|key| format!("/profiles/{pulley}/{key}/200")),
            );
        }
        keys.extend(
            CONVERGENCE_KEYS
                .iter()
                .map(|key| format!("/convergence/{key}")),
        );
        for key in keys {
            let value = report
                .pointer(&key)
                .unwrap_or_else(|| panic!("{key} is missing"));
            assert!(value.is_number() || value.is_string(), "{key}: {value}");
        }
    }

    #[test]
    fn a_flat_belt_has_the_keys_of_a_v_belt_and_more() {
        fn keys(value: &Value) -> Vec<&String> {
            value.as_object().unwrap().keys().collect()
        }
        let (v, flat) = (parsed(&sample::loaded()), parsed(&sample_flat::epp()));
        assert!(keys(&v).iter().all(|key| keys(&flat).contains(key)));
        assert_eq!([&v["belt_type"], &flat["belt_type"]], ["v", "flat"]);
        assert_eq!(flat["normal_force"], "inertia");
        assert!(v.get("normal_force").is_none());
        let own: Vec<_> = keys(&flat["driver"])
            .into_iter()
            .filter(|key| v["driver"].get(key.as_str()).is_none())
            .collect();
        let expected = [
            "entry_strain",
            "reference_tension_N",
            "smallest_friction_stiffness_N_per_m2",
        ];
        assert!(own.len() == 3 && expected.iter().all(|key| own.contains(&&key.to_string())));
        assert_eq!(flat["driven"]["entry_strain"], 2.5e-7);
        assert_eq!(flat["driven"]["zones"][1]["kind"], "slip");
        let coulomb = parsed(&sample_flat::coulomb());
        assert!(coulomb["driven"]["smallest_friction_stiffness_N_per_m2"].is_null());
        assert_eq!(coulomb["driven"]["zones"][0]["kind"], "adhesion");
    }

    #[test]
    fn numbers_keep_their_precision() {
        let state = sample::loaded();
        let report = parsed(&state);
        assert_eq!(report["driven"]["torque_N_m"], state.driven.torque);
        let wrap = report["driver"]["wrap_angle_deg"].as_f64().unwrap();
        assert_eq!(wrap, state.driver.wrap_angle.to_degrees());
        assert_eq!(report["driven"]["zones"][0]["kind"], "elastic");
    }

    #[test]
    fn what_is_not_finite_is_null() {
        let mut state = sample::idle();
        state.drive.title = None;
        state.efficiency = f64::NAN;
        let report = parsed(&state);
        assert!(report["efficiency"].is_null() && report["title"].is_null());
        assert_eq!(report["speed_loss"], 0.0);
    }
}
