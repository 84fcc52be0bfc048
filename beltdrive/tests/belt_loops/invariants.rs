//! What holds in every steady state of a belt loop.

use beltdrive::belt_loop::LoopState;
use beltdrive::{
    BeltKind, Closure, Drive, Duty, FrictionLaw, Guide, Mount, NormalForce, TensionerLoad,
};
use std::f64::consts::TAU;

/// Whether two numbers agree, relative.
pub(crate) fn close(what: &str, found: f64, expected: f64, within: f64) {
    let off = (found - expected).abs();
    let allowed = within * expected.abs().max(f64::MIN_POSITIVE);
    assert!(
        off <= allowed,
        "{what}: {found} for {expected}, off by {:e}",
        off / expected.abs()
    );
}

/// Balances of torques, forces and powers, the closing of the polygon, the length of the belt and the
/// equilibrium of the tensioner.
pub(crate) fn hold(drive: &Drive, state: &LoopState) {
    let count = state.spans.len();
    let belt = drive.belt;
    let axial = belt.axial_stiffness;
    let largest = state
        .spans
        .iter()
        .map(|span| span.tractive_tension)
        .fold(0.0, f64::max);
    let small = 1e-11 * largest;
    let flow = state.mass_flow;
    let is_thesis = normal_force(drive) == NormalForce::Thesis;
    let traction = |index: usize| traction(drive, state, index);
    close("L", state.layout.length(), state.length, 1e-15);
    close(
        "rest",
        axial * (state.rest_layout.length() / state.unstretched_length - 1.0),
        state.rest_tension,
        1e-9,
    );

    let mut polygon = [0.0; 2];
    let mut hub = [[0.0; 2]; 2];
    let mut turned = 0.0;
    let mut unstretched = Some(0.0);
    for index in 0..count {
        let (span, pulley) = (&state.spans[index], &state.pulleys[index]);
        let behind = &state.spans[(index + count - 1) % count];
        let stated = &drive.pulleys[index];
        // Torque, and the belt on the way.
        let change = match is_thesis {
            true => traction(index) - traction((index + count - 1) % count),
            false => span.tractive_tension - behind.tractive_tension,
        };
        assert!((change * stated.radius - pulley.torque).abs() <= small * stated.radius);
        assert!(span.tractive_tension > 0.0 && span.tension > span.tractive_tension - small);
        let speed = state.unstretched_speed * (1.0 + span.tension / axial);
        close("V", span.speed, speed, 1e-14);
        close(
            "F",
            span.tractive_tension,
            span.tension - flow * span.speed,
            1e-9,
        );
        if let Duty::Power(power) = stated.duty {
            close("P", pulley.power, power, 1e-12);
        }
        if let Duty::Torque(torque) = stated.duty {
            close("M", pulley.torque, torque, 1e-13);
        }
        let rim = state.unstretched_speed * (1.0 + pulley.reference_tension.unwrap() / axial);
        close("rim", pulley.angular_speed * stated.radius, rim, 1e-12);
        assert!(pulley.angular_speed > 0.0 && pulley.wrap >= 0.0);
        assert!((pulley.slip_arc + pulley.no_slip_arc - pulley.wrap).abs() < 1e-12);
        assert!(pulley.friction_loss >= 0.0 && pulley.friction_utilisation.unwrap() < 1.0);
        assert!(pulley.torque_margin.is_none_or(|margin| margin > 1.0));
        // Geometry and hubs.
        let end = state.layout.spans()[index].end;
        let next = &state.layout.pulleys()[(index + 1) % count];
        close(
            "tangent",
            (end[0] - next.centre[0]).hypot(end[1] - next.centre[1]),
            next.radius,
            1e-10,
        );
        polygon[0] += span.length * span.direction.cos();
        polygon[1] += span.length * span.direction.sin();
        let start = state.layout.spans()[index].start;
        let arrived = state.layout.spans()[(index + count - 1) % count].end;
        polygon[0] += start[0] - arrived[0];
        polygon[1] += start[1] - arrived[1];
        for (sum, load) in hub.iter_mut().zip([pulley.hub_load, pulley.rest_hub_load]) {
            *sum = [sum[0] + load[0], sum[1] + load[1]];
        }
        let side = match stated.side {
            beltdrive::Side::Inside => 1.0,
            beltdrive::Side::Outside => -1.0,
        };
        turned += side * pulley.wrap;
        let on_pulley = unstretched_on(drive, state, index);
        let on_span = span.length / (1.0 + span.tension / axial);
        unstretched = unstretched
            .zip(on_pulley)
            .map(|(sum, arc)| sum + arc + on_span);
    }
    // With the friction force as the slope of the tension on every interval, and as fine as that allows.
    let on_pulleys = (0..count).map(|index| by_profile(drive, state, index));
    let on_spans = state
        .spans
        .iter()
        .map(|span| span.length / (1.0 + span.tension / axial));
    let by_profile = on_pulleys.sum::<f64>() + on_spans.sum::<f64>();
    close("L_0", by_profile, state.unstretched_length, 1e-9);
    let scale = state.length;
    assert!(
        polygon.iter().all(|part| part.abs() < 1e-13 * scale),
        "{polygon:?}"
    );
    assert!(
        hub[0].iter().all(|part| part.abs() < small * count as f64),
        "{hub:?}"
    );
    let resting = 1e-12 * state.rest_tension * count as f64;
    assert!(hub[1].iter().all(|part| part.abs() < resting), "{hub:?}");
    assert!((turned - TAU * f64::from(drive.turning_number)).abs() < 1e-12);
    if let Some(unstretched) = unstretched {
        close("L_0", unstretched, state.unstretched_length, 2e-12);
    }

    let powers: f64 = state.pulleys.iter().map(|pulley| pulley.power).sum();
    let balance = powers + state.power_loss;
    assert!(
        balance.abs() <= 1e-11 * state.power_in,
        "{balance} of {}",
        state.power_in
    );
    assert!((state.power_in - state.power_out + powers).abs() <= 1e-12 * state.power_in);
    close(
        "P",
        state.power_in - state.power_out + 1.0,
        state.power_loss + 1.0,
        1e-11 * (1.0 + state.power_in),
    );

    match drive.closure {
        Closure::SetupTension(tension) => close("T_s", state.rest_tension, tension, 1e-10),
        Closure::UnstretchedLength(length) => close("L_0", state.unstretched_length, length, 1e-14),
        Closure::SpanTension { span, tension } => {
            close("T", state.spans[span].tension, tension, 1e-11);
        }
        Closure::SpanTractiveTension { span, tension } => {
            close("F", state.spans[span].tractive_tension, tension, 1e-11);
        }
        Closure::RestCoordinate(coordinate) => {
            let found = state
                .tensioner
                .as_ref()
                .map(|tensioner| tensioner.rest_coordinate);
            assert_eq!(found, Some(coordinate));
        }
        Closure::BothSpans(_) => unreachable!("no loop is closed by two tensions"),
    }
    for (index, pulley) in drive.pulleys.iter().enumerate() {
        let Mount::Tensioner(tensioner) = pulley.mount else {
            continue;
        };
        let found = state.tensioner.as_ref().expect("a tensioner");
        let at = |coordinate: f64, hub: [f64; 2]| {
            // The derivative of the centre by differences of the layout.
            let step = 1e-6;
            let centre = |coordinate| {
                drive
                    .layout(coordinate)
                    .map(|layout| layout.pulleys()[index].centre)
            };
            let [Ok(low), Ok(high)] = [coordinate - step, coordinate + step].map(centre) else {
                return;
            };
            let way = [0, 1].map(|part| (high[part] - low[part]) / (2.0 * step));
            let work = [0, 1].map(|part| hub[part] * way[part]);
            let spring = match (tensioner.load, tensioner.guide) {
                (
                    TensionerLoad::Spring {
                        stiffness,
                        free_coordinate,
                    },
                    _,
                ) => -stiffness * (coordinate - free_coordinate),
                (TensionerLoad::Weight(weight), Guide::Translating { .. }) => weight,
                // Its moment about the pivot.
                (TensionerLoad::Weight(weight), Guide::Rotary { arm_length, .. }) => {
                    -weight * arm_length * coordinate.cos()
                }
            };
            let off = spring + work[0] + work[1];
            // The rounding of the differences grows with the force, also with one across the way.
            let scale = spring.abs() + hub[0].hypot(hub[1]) * way[0].hypot(way[1]);
            assert!(off.abs() < 1e-8 * scale, "{off} of {scale}");
        };
        at(found.coordinate, state.pulleys[index].hub_load);
        at(found.rest_coordinate, state.pulleys[index].rest_hub_load);
        assert!(found.stiffness > 0.0 && found.rest_stiffness > 0.0);
    }
}

fn normal_force(drive: &Drive) -> NormalForce {
    match drive.belt.kind {
        BeltKind::Flat { normal_force } => normal_force,
        BeltKind::V(_) => panic!("a flat belt"),
    }
}

/// The traction of a span with the convention `thesis`, N.
fn traction(drive: &Drive, state: &LoopState, index: usize) -> f64 {
    state.spans[index].tension * dynamic_stiffness(drive, state) / drive.belt.axial_stiffness
}

/// D = EA − m v², N.
fn dynamic_stiffness(drive: &Drive, state: &LoopState) -> f64 {
    let speeds = state.spans.iter().map(|span| span.speed);
    let speed = match normal_force(drive) {
        NormalForce::Thesis => speeds.fold(f64::INFINITY, f64::min),
        NormalForce::Inertia | NormalForce::Exact => state.unstretched_speed,
    };
    let belt = drive.belt;
    belt.axial_stiffness - belt.mass_per_length * speed * speed
}

/// Unstretched length of the belt on a pulley from its profile, m, by the trapezoidal rule with end
/// corrections: the slope of the tension is EA f/D.
fn by_profile(drive: &Drive, state: &LoopState, index: usize) -> f64 {
    let profile = state.profile(index);
    let stiffness = dynamic_stiffness(drive, state);
    let sense = state.pulleys[index].torque.signum();
    let stretch = |point: usize| 1.0 + profile.tension[point] / drive.belt.axial_stiffness;
    let slope = |point: usize| {
        -sense * profile.friction_force[point] / (stiffness * stretch(point).powi(2))
    };
    let panel = |point: usize| {
        let step = profile.arc_length[point + 1] - profile.arc_length[point];
        let mean = 0.5 * (stretch(point).recip() + stretch(point + 1).recip());
        step * mean + step * step / 12.0 * (slope(point) - slope(point + 1))
    };
    (0..profile.angle.len() - 1).map(panel).sum()
}

/// Unstretched length of the belt on a pulley by its closed form, m: adhesion or elastic friction, then
/// slip. `None` for other friction and other conventions than `inertia`, where soft bristles let the belt
/// stick again after it has slipped, and where the strain at the entry is below the smallest number.
fn unstretched_on(drive: &Drive, state: &LoopState, index: usize) -> Option<f64> {
    let is_inertia = normal_force(drive) == NormalForce::Inertia;
    if !is_inertia || matches!(drive.law, FrictionLaw::CreepRate { .. }) {
        return None;
    }
    let count = state.spans.len();
    let (stated, pulley) = (&drive.pulleys[index], &state.pulleys[index]);
    let axial = drive.belt.axial_stiffness;
    let stiffness = axial - drive.belt.mass_per_length * state.unstretched_speed.powi(2);
    let entering = state.spans[(index + count - 1) % count].tractive_tension;
    let leaving = state.spans[index].tractive_tension;
    let slip_rate = stated.friction_coefficient / stated.radius;
    let sense = (leaving - entering).signum();
    let first = pulley.no_slip_arc * stated.radius;
    let slipped = leaving * (-sense * slip_rate * stated.radius * pulley.slip_arc).exp();
    let on_slip = stiffness / (slip_rate * axial)
        * (leaving / slipped * ((axial + slipped) / (axial + leaving)))
            .ln()
            .abs();
    let unslipped = match drive.law {
        FrictionLaw::Epp {
            stiffness: bristles,
        } if pulley.torque != 0.0 => {
            let rate = (bristles / stiffness).sqrt();
            let sticks_again = sense > 0.0 && rate < slip_rate && pulley.slip_arc > 0.0;
            if sticks_again || rate * first > 600.0 {
                return None;
            }
            let b = stiffness * pulley.entry_strain.unwrap();
            let a = axial + entering - b;
            let tanh = (0.5 * rate * first).tanh();
            let ratio = ((a - b) / (a + b)).abs().sqrt();
            let integral = match a > b {
                // artanh x with 1 − x in parts, of which none is a difference.
                true => {
                    let less = 2.0 / ((rate * first).exp() + 1.0)
                        + tanh * (2.0 * b / (a + b)) / (1.0 + ratio);
                    0.5 * ((1.0 + ratio * tanh) / less).ln()
                }
                false => (ratio * tanh).atan(),
            };
            2.0 * stiffness / rate / ((a - b) * (a + b)).abs().sqrt() * integral
        }
        _ => first * stiffness / (axial + entering),
    };
    Some(unslipped + on_slip)
}
