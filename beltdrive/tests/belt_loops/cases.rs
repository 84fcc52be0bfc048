//! Loops that were solved with 40 digits, and once more by integrating along every contact.

use super::invariants::{close, hold};
use beltdrive::belt_loop::solve;
use beltdrive::{
    Belt, BeltKind, Closure, Drive, Duty, FrictionLaw, Guide, LoadedState, Mount, NormalForce,
    Pulley, Sense, Side, SolveError, Tensioner, TensionerLoad,
};
use serde_json::Value;

/// Relative bound of all quantities, and absolute bound of speed losses.
const WITHIN: f64 = 1e-12;
const SPEED_LOSS: f64 = 1e-15;

/// The cases: name, loop, and what is known of it.
pub(crate) fn read() -> Vec<(String, Drive, Value)> {
    let all: Value = serde_json::from_str(include_str!("cases.json")).unwrap();
    let cases = all["cases"].as_array().unwrap();
    let case = |case: &Value| {
        let name = case["id"].as_str().unwrap().to_owned();
        (name, drive(&case["input"]), case.clone())
    };
    cases.iter().map(case).collect()
}

fn number(value: &Value) -> f64 {
    value
        .as_f64()
        .unwrap_or_else(|| panic!("a number: {value}"))
}

fn numbers<const N: usize>(value: &Value) -> [f64; N] {
    std::array::from_fn(|index| number(&value[index]))
}

fn drive(input: &Value) -> Drive {
    let pulley = |pulley: &Value| Pulley {
        name: pulley["name"].as_str().unwrap().to_owned(),
        mount: match pulley.get("x_m") {
            Some(x) => Mount::Fixed([number(x), number(&pulley["y_m"])]),
            None => Mount::Tensioner(tensioner(&input["tensioner"])),
        },
        radius: number(&pulley["radius_m"]),
        side: match pulley["side"].as_str() {
            Some("inside") => Side::Inside,
            _ => Side::Outside,
        },
        friction_coefficient: number(&pulley["friction_coefficient"]),
        half_angle: None,
        duty: match pulley.get("speed_rad_per_s") {
            Some(speed) => Duty::Driver(number(speed)),
            None => Duty::Torque(number(&pulley["torque_N_m"])),
        },
    };
    let closure = &input["closure"];
    Drive {
        title: None,
        belt: Belt {
            ribs: 1,
            mass_per_length: number(&input["belt"]["mass_per_length_kg_per_m"]),
            axial_stiffness: number(&input["belt"]["axial_stiffness_N"]),
            kind: BeltKind::Flat {
                normal_force: NormalForce::Inertia,
            },
        },
        law: match input["friction"].get("stiffness_N_per_m2") {
            Some(stiffness) => FrictionLaw::Epp {
                stiffness: number(stiffness),
            },
            None => FrictionLaw::Coulomb,
        },
        sense: match input["sense"].as_str() {
            Some("ccw") => Sense::CounterClockwise,
            _ => Sense::Clockwise,
        },
        turning_number: match input.get("turning_number") {
            Some(_) => 0,
            None => 1,
        },
        pulleys: input["pulleys"]
            .as_array()
            .unwrap()
            .iter()
            .map(pulley)
            .collect(),
        closure: match closure["kind"].as_str().unwrap() {
            "setup_tension" => Closure::SetupTension(number(&closure["tension_N"])),
            "tensioner_position_at_rest" => Closure::RestCoordinate(number(&closure["angle_rad"])),
            kind => panic!("{kind}"),
        },
    }
}

fn tensioner(stated: &Value) -> Tensioner {
    Tensioner {
        guide: Guide::Rotary {
            pivot: numbers(&stated["pivot_m"]),
            arm_length: number(&stated["arm_length_m"]),
        },
        load: TensionerLoad::Spring {
            stiffness: number(&stated["stiffness_N_m_per_rad"]),
            free_coordinate: number(&stated["free_angle_rad"]),
        },
        start_coordinate: number(&stated["start_angle_rad"]),
        travel: Some(numbers(&stated["range_rad"])),
    }
}

/// Every number of an object of the cases, by key, against those found.
fn compare(name: &str, known: &Value, found: &[(&str, f64)]) {
    for (key, found) in found {
        let what = format!("{name} {key}");
        match *key {
            "speed_loss" => assert!((found - number(&known[key])).abs() < SPEED_LOSS, "{what}"),
            _ => close(&what, *found, number(&known[key]), WITHIN),
        }
    }
}

#[test]
fn solved_loops_have_every_number() {
    let mut count = 0;
    for (name, drive, case) in read() {
        let Some(known) = case.get("result") else {
            continue;
        };
        count += 1;
        let state = solve(&drive).unwrap_or_else(|error| panic!("{name}: {error}"));
        hold(&drive, &state);
        let limit = state.load_limit.as_ref().unwrap();
        compare(
            &name,
            known,
            &[
                ("mass_flow_kg_per_s", state.mass_flow),
                ("belt_length_unstretched_m", state.unstretched_length),
                ("belt_length_running_m", state.length),
                ("rest_tension_N", state.rest_tension),
                ("power_in_W", state.power_in),
                ("power_out_W", state.power_out),
                ("power_loss_W", state.power_loss),
                ("efficiency", state.efficiency.unwrap()),
                ("load_factor_limit", limit.factor),
            ],
        );
        assert_eq!(known["limiting_pulley"], state.pulleys[limit.pulley].name);
        let crossing = serde_json::to_value(state.layout.crossing_spans()).unwrap();
        assert_eq!(known["crossing_spans"], crossing);
        for (index, span) in state.spans.iter().enumerate() {
            compare(
                &format!("{name} span {index}"),
                &known["spans"][index],
                &[
                    ("length_m", span.length),
                    ("direction_rad", span.direction),
                    ("tension_N", span.tension),
                    ("tractive_tension_N", span.tractive_tension),
                    ("speed_m_per_s", span.speed),
                    ("frequency_Hz", span.frequency),
                    ("rest_length_m", span.rest_length),
                    ("rest_frequency_Hz", span.rest_frequency),
                    ("deflection_m", span.deflection),
                    ("deflection_force_N", span.deflection_force.unwrap()),
                ],
            );
        }
        for (index, pulley) in state.pulleys.iter().enumerate() {
            let (name, known) = (format!("{name} {}", pulley.name), &known["pulleys"][index]);
            compare(
                &name,
                known,
                &[
                    ("angular_speed_rad_per_s", pulley.angular_speed),
                    ("torque_N_m", pulley.torque),
                    ("power_W", pulley.power),
                    ("wrap_rad", pulley.wrap),
                    ("rest_wrap_rad", pulley.rest_wrap),
                    ("slip_arc_rad", pulley.slip_arc),
                    ("no_slip_arc_rad", pulley.no_slip_arc),
                    ("entry_strain", pulley.entry_strain.unwrap()),
                    ("reference_tension_N", pulley.reference_tension.unwrap()),
                    ("friction_utilisation", pulley.friction_utilisation.unwrap()),
                    ("torque_capacity_N_m", pulley.torque_capacity.unwrap()),
                    ("speed_loss", pulley.speed_loss),
                    ("friction_loss_W", pulley.friction_loss),
                ],
            );
            let margin = known["torque_margin"].as_f64();
            assert_eq!(margin.is_some(), pulley.torque_margin.is_some(), "{name}");
            close(
                &name,
                pulley.torque_margin.unwrap_or(1.0),
                margin.unwrap_or(1.0),
                WITHIN,
            );
            let vectors = [
                ("hub_load_N", pulley.hub_load),
                ("hub_load_rest_N", pulley.rest_hub_load),
                ("centre_m", pulley.centre),
            ];
            for (key, found) in vectors {
                let expected: [f64; 2] = numbers(&known[key]);
                let size = expected[0].hypot(expected[1]);
                let off = (found[0] - expected[0]).hypot(found[1] - expected[1]);
                assert!(off <= WITHIN * size, "{name} {key}: {off:e} of {size}");
            }
        }
        if let Some(found) = &state.tensioner {
            compare(
                &name,
                &known["tensioner"],
                &[
                    ("angle_rad", found.coordinate),
                    ("rest_angle_rad", found.rest_coordinate),
                    ("spring_load", found.load),
                    ("dlength_dcoordinate", found.length_derivatives[0]),
                    ("d2length_dcoordinate2", found.length_derivatives[1]),
                    ("tensioner_constant", found.constant),
                    ("stiffness", found.stiffness),
                    ("rest_stiffness", found.rest_stiffness),
                    ("rest_tensioner_constant", found.rest_constant),
                ],
            );
        }
    }
    assert_eq!(count, 4);
}

#[test]
fn a_refused_loop_has_every_margin() {
    let refused = read()
        .into_iter()
        .filter(|(_, _, case)| case.get("refusal").is_some());
    let mut count = 0;
    for (name, drive, case) in refused {
        count += 1;
        let known = &case["refusal"];
        let error = solve(&drive).expect_err(&name);
        let SolveError::GrossSlip {
            pulley,
            load_factor,
            margin,
            at_limit,
            formal,
        } = &error
        else {
            panic!("{name}: {error}")
        };
        assert_eq!(&known["pulley"], pulley);
        compare(&name, known, &[("load_factor_limit", *load_factor)]);
        let formal = formal.as_ref().expect("a formal state");
        let driver = formal.torque_margins[0];
        assert_eq!(*margin, driver);
        for (state, known) in [(at_limit, &known["at_limit"]), (formal, &known["formal"])] {
            compare_loaded(&name, known, state);
        }
        let message = error.to_string();
        assert!(
            message.contains("driver") && message.contains("0.5277"),
            "{message}"
        );
    }
    assert_eq!(count, 1);
}

fn compare_loaded(name: &str, known: &Value, state: &LoadedState) {
    let margins: Vec<f64> = state
        .torque_margins
        .iter()
        .map(|margin| margin.unwrap())
        .collect();
    let lists = [
        ("torques_N_m", &state.torques),
        ("tractive_tensions_N", &state.tractive_tensions),
        ("tensions_N", &state.tensions),
        ("friction_utilisation", &state.friction_utilisations),
        ("torque_margin", &margins),
        ("torque_capacity_N_m", &state.torque_capacities),
    ];
    let mut compared = 0;
    for (key, found) in lists {
        for (index, expected) in known[key].as_array().into_iter().flatten().enumerate() {
            close(
                &format!("{name} {key}"),
                found[index],
                number(expected),
                WITHIN,
            );
            compared += 1;
        }
    }
    assert!(compared >= 16, "{name}");
    if let Some(flow) = known["mass_flow_kg_per_s"].as_f64() {
        close(name, state.mass_flow, flow, WITHIN);
    }
}
