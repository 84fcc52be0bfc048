//! The keys and columns of steady states.

use super::*;
use beltdrive::{Solved, belt_loop, solve_any};

#[test]
fn json_of_a_state_has_its_keys() {
    let state = state("kim2009-epp", &[]);
    let answer = of_state(&state);
    let report = parsed(&answer);
    has(&report, &STATE);
    has(
        &report,
        &[
            "/title",
            "/friction_law",
            "/checks/0/deviation",
            "/warnings",
        ],
    );
    assert_eq!(report["belt_type"], "v");
    assert!(report.get("normal_force").is_none());
    for (name, pulley) in [("driver", &state.driver), ("driven", &state.driven)] {
        let found = &report[name];
        close(&found["angular_speed_rad_per_s"], pulley.angular_speed);
        close(&found["torque_N_m"], pulley.torque);
        close(&found["wrap_angle_deg"], pulley.wrap_angle.to_degrees());
        close(&found["max_penetration_m"], pulley.max_penetration);
        // No digit is lost where it is written.
        let torque = format!("\"torque_N_m\": {:?},", pulley.torque);
        assert!(json(&answer).contains(&torque), "{torque}");
        has(
            found,
            &["/power_W", "/geometric_wrap_angle_deg", "/slip_arc_deg"],
        );
        assert!(found.get("entry_strain").is_none());
        let (profile, known) = (&report["profiles"][name], &pulley.profile);
        for (key, values) in [
            ("tension_N", &known.tension),
            ("tractive_tension_N", &known.tractive_tension),
            ("arc_length_m", &known.arc_length),
            ("penetration_m", &known.penetration),
            ("displacement_m", &known.displacement),
            ("normal_force_N_per_m", &known.normal_force),
            ("friction_force_N_per_m", &known.friction_force),
        ] {
            let found = profile[key].as_array().unwrap();
            assert_eq!(found.len(), values.len(), "{key}");
            for (found, value) in found.iter().zip(values) {
                close(found, *value);
            }
        }
        for key in ["angle_deg", "inclination_deg", "sliding_angle_deg"] {
            assert_eq!(
                profile[key].as_array().unwrap().len(),
                known.angle.len(),
                "{key}"
            );
        }
    }
    let convergence = &report["convergence"];
    for key in [
        "mesh_intervals/1",
        "newton_iterations",
        "rhs_evaluations",
        "factorisations",
    ] {
        assert!(
            convergence.pointer(&format!("/{key}")).unwrap().is_u64(),
            "{key}"
        );
    }
    for key in ["tolerance", "defect", "error_estimate", "seconds"] {
        assert!(convergence[key].is_f64(), "{key}");
    }
}

#[test]
fn a_flat_belt_has_the_keys_of_a_v_belt_and_more() {
    let epp = state("kim2009-flat", &[]);
    let report = parsed(&of_state(&epp));
    has(&report, &STATE);
    assert_eq!(
        [&report["belt_type"], &report["normal_force"]],
        ["flat", "inertia"]
    );
    let entry = epp.driven.entry.unwrap();
    close(&report["driven"]["entry_strain"], entry.strain);
    close(
        &report["driven"]["reference_tension_N"],
        entry.reference_tension,
    );
    let stiffness = "smallest_friction_stiffness_N_per_m2";
    close(
        &report["driven"][stiffness],
        entry.smallest_stiffness.unwrap(),
    );
    let coulomb = parsed(&of_state(&state("kim2009-flat", &["friction.law=coulomb"])));
    assert!(coulomb["driven"][stiffness].is_null());
    assert_eq!(coulomb["driven"]["zones"][0]["kind"], "adhesion");
}

#[test]
fn csv_of_a_state_has_a_row_for_each_point() {
    let state = state("flat-unequal", &[]);
    let answer = of_state(&state);
    let table = columns(&csv(&answer));
    let profile = &state.driver.profile;
    let count = profile.angle.len();
    assert_eq!(table.1.len(), count + state.driven.profile.angle.len());
    assert_eq!(table.0[..3], ["pulley", "angle_deg", "arc_length_m"]);
    assert_eq!(table.0.last().unwrap(), "normal_force");
    assert_eq!(
        [field(&table, 5, "pulley"), field(&table, count, "pulley")],
        ["driver", "driven"]
    );
    assert_eq!(
        field(&table, 5, "tension_N").parse(),
        Ok(profile.tension[5])
    );
    assert_eq!(
        field(&table, 5, "angle_deg").parse(),
        Ok(profile.angle[5].to_degrees())
    );
    assert_eq!(field(&table, 7, "normal_force"), "inertia");
    let mut blank = state;
    for pulley in [&mut blank.driver, &mut blank.driven] {
        pulley.profile = beltdrive::Profile::default();
    }
    assert_eq!(csv(&of_state(&blank)).lines().count(), 1);
}

/// Between 50 and 60 N·m near lift-off the tensions of the spans belong to two states, of which one has the length of the
/// belt. What is told is that one: its powers and speeds agree.
#[test]
fn a_state_that_two_tensions_do_not_tell_is_that_of_the_loop() {
    for torque in [45.0, 50.0, 52.0, 54.0, 56.0, 60.0] {
        let torque = format!("load.torque={torque} N*m");
        let overrides = ["pulleys.driver.speed=11000 rpm", "load.power=", &torque];
        let example = examples::find("v-power").unwrap();
        let overrides = overrides.map(str::to_owned);
        let file = input::DriveFile::read(example.name, example.text, &overrides).unwrap();
        let drive = file.drive().unwrap();
        let (efficiency, speed) = match solve_any(&drive, &SolveOptions::default()).unwrap() {
            Solved::Drive { state, .. } => (state.efficiency, state.driven.angular_speed),
            Solved::Loop { state, .. } => {
                (state.efficiency.unwrap(), state.pulleys[1].angular_speed)
            }
        };
        let state = belt_loop::solve(&drive).unwrap();
        for (found, known) in [
            (efficiency, state.efficiency.unwrap()),
            (speed, state.pulleys[1].angular_speed),
        ] {
            assert!(
                (found / known - 1.0).abs() < 1e-5,
                "{torque}: {found} {known}"
            );
        }
    }
}
