//! Gross slip, its end, slack, loads that hold and loads that do not.

use super::{driver, follow, from_rest, kim, loaded};
use beltdrive::transient::{
    Ending, Load, Motion, Motor, Schedule, Simulation, Start, TransientEventKind, Until,
};
use beltdrive::{Duty, simulate};

#[test]
fn a_pulse_of_load_makes_the_driven_pulley_slip_and_it_recovers() {
    let axles = vec![
        driver(Schedule::constant(120.0)),
        loaded(
            0.005,
            Load::new(Schedule::pulse([0.02, 0.05], [30.0, 90.0])),
        ),
    ];
    let mut simulation = from_rest(kim(2.0e8, 5.45e-3, 30.0), axles, 120, 0.3);
    simulation.start = Start::Running;
    simulation.axial_damping = 0.5;
    let history = follow(&simulation);
    let events = &history.events;
    println!("{events:?}");
    let of = |kind| {
        let mut events = events.iter().filter(|event| event.kind == kind);
        let event = events.next().expect("an event");
        assert!(events.next().is_none(), "once");
        event
    };
    let begin = of(TransientEventKind::GrossSlip(1));
    let end = of(TransientEventKind::GrossSlipEnds(1));
    assert!(
        begin.time > 0.02 && begin.time < 0.05 && end.time > 0.05,
        "{events:?}"
    );
    let speeds = |range: std::ops::Range<usize>| {
        let samples = history.samples[range].iter();
        samples
            .map(|sample| sample.pulleys[1].angular_speed)
            .fold(f64::INFINITY, f64::min)
    };
    // It falls while it slips, and is back at its creep in the end.
    assert!(speeds(20..100) < 100.0);
    assert!((history.samples[300].pulleys[1].angular_speed - 119.45).abs() < 2.0);
    // While it slips the belt gives what its capacity is, not the load. The tension grows on both pulleys by the
    // factor exp(μ φ) and keeps its mean along the belt, of which inertia takes m v². Waves ride on it.
    let exponent = 1.2 * std::f64::consts::PI;
    let low = (-exponent).exp();
    let arc = 0.08125 * std::f64::consts::PI;
    let mean = (0.25 * 0.5 * (1.0 + low) + arc * (1.0 - low) / exponent) / (0.25 + arc);
    let inertia = 0.1036 * 9.75_f64.powi(2);
    let capacity = 0.08125 * (80_068.0 * 5.45e-3 - inertia) * (1.0 - low) / mean;
    let slipping = history
        .samples
        .iter()
        .filter(|sample| sample.time > begin.time + 2e-3 && sample.time < end.time - 2e-3);
    let slipping: Vec<_> = slipping.map(|sample| sample.pulleys[1]).collect();
    let full = |arc: f64| (arc - std::f64::consts::PI).abs() < 1e-9;
    assert!(slipping.iter().all(|pulley| full(pulley.slip_arc)));
    let torques = slipping.iter().map(|pulley| pulley.torque);
    let mean = torques.sum::<f64>() / slipping.len() as f64;
    println!("{mean} N·m on average, capacity {capacity} N·m");
    assert!((mean / capacity - 1.0).abs() < 0.02, "{mean} {capacity}");
}

#[test]
fn a_load_holds_a_pulley_at_rest_unless_it_is_one_way() {
    for (is_one_way, speed) in [(false, 0.0), (true, -1.0)] {
        let load = Load {
            is_one_way,
            ..Load::new(Schedule::constant(20.0))
        };
        let axles = vec![driver(Schedule::constant(0.0)), loaded(0.005, load)];
        let history = follow(&from_rest(kim(2.0e8, 5.45e-3, 20.0), axles, 60, 0.003));
        let found = history.samples[1].pulleys[1].angular_speed;
        assert_eq!(found.partial_cmp(&0.0), speed.partial_cmp(&0.0), "{found}");
        // The load can be carried either way.
        if !is_one_way {
            assert!(
                history
                    .samples
                    .iter()
                    .all(|sample| sample.pulleys[1].torque == 0.0)
            );
        }
    }
}

#[test]
fn a_motor_settles_where_its_line_meets_the_load() {
    let motor = Motor::line(120.0, 130.0);
    let mut motors = loaded(0.02, Load::new(Schedule::constant(0.0)));
    let Motion::Torques { motor: place, .. } = &mut motors.motion else {
        panic!("torques")
    };
    *place = Some(motor);
    let axles = vec![
        motors,
        loaded(
            0.01,
            Load {
                per_speed: 0.2,
                ..Load::new(Schedule::constant(10.0))
            },
        ),
    ];
    let mut simulation = from_rest(kim(2.0e8, 5.45e-3, 30.0), axles, 60, 0.5);
    simulation.axial_damping = 0.5;
    let history = follow(&simulation);
    let [motor, driven] = history.samples.last().unwrap().pulleys[..] else {
        panic!("two pulleys")
    };
    println!("{motor:?} {driven:?}");
    let [drives, loads] = [
        120.0 * (1.0 - motor.angular_speed / 130.0),
        10.0 + 0.2 * driven.angular_speed,
    ];
    assert!((motor.axle_torque - drives).abs() < 1e-9 * drives);
    assert!((driven.axle_torque + loads).abs() < 1e-9 * loads);
    assert!((drives / loads - 1.0).abs() < 0.02, "{drives} {loads}");
    assert!(driven.angular_speed < motor.angular_speed && driven.angular_speed > 80.0);
}

#[test]
fn a_run_ends_where_it_is_told_to() {
    let axles = vec![
        driver(Schedule::ramp([0.0, 0.1], [0.0, 120.0])),
        loaded(0.005, Load::new(Schedule::constant(2.0))),
    ];
    let simulation = from_rest(kim(2.0e8, 5.45e-3, 2.0), axles, 60, 0.02);
    let mut told = vec![];
    let history = simulate(&simulation, &mut |time, share| {
        told.push([time, share]);
        time < 0.01
    });
    let history = history.unwrap();
    assert_eq!(history.ending, Ending::Interrupted);
    assert_eq!(history.samples.len(), told.len());
    for (sample, [time, share]) in history.samples.iter().zip(told) {
        assert_eq!(sample.time, time);
        assert!((share - time / 0.02).abs() < 1e-12);
    }
    assert!((history.samples.last().unwrap().time - 0.01).abs() < 1e-12);
}

/// A drive with little tension whose driver is stopped in half a millisecond, on a mesh.
fn slackened(cells: usize) -> Simulation {
    let axles = vec![
        driver(Schedule::ramp([0.01, 0.0105], [100.0, 0.0])),
        loaded(5e-4, Load::new(Schedule::constant(0.5))),
    ];
    let mut simulation = from_rest(kim(2.0e8, 6e-4, 0.5), axles, cells, 0.03);
    simulation.drive.pulleys[0].duty = Duty::Driver(100.0);
    simulation.start = Start::Running;
    simulation.axial_damping = 0.1;
    simulation.interval = 1e-4;
    simulation
}

#[test]
fn a_run_ends_with_the_first_slip_or_slack() {
    let load = |most: f64| Load::new(Schedule::pulse([0.02, 0.05], [30.0, most]));
    let pulse = |most: f64| {
        let axles = vec![driver(Schedule::constant(120.0)), loaded(0.005, load(most))];
        let mut simulation = from_rest(kim(2.0e8, 5.45e-3, 30.0), axles, 60, 0.3);
        simulation.start = Start::Running;
        simulation.until = Until::Slip { latest: 0.1 };
        simulation.frames = 200;
        simulation
    };
    let history = follow(&pulse(90.0));
    assert_eq!(history.ending, Ending::Event);
    let [event] = history.events[..] else {
        panic!("one event: {:?}", history.events)
    };
    assert_eq!(event.kind, TransientEventKind::GrossSlip(1));
    let last = history.samples.last().unwrap();
    assert!(last.time == event.time && event.time > 0.02 && event.time < 0.03);
    // The whole contact slips, and the belt of the frames is that of the samples at equal intervals.
    assert!((last.pulleys[1].slip_arc - std::f64::consts::PI).abs() < 1e-9);
    assert_eq!(history.frames.len() + 1, history.samples.len());
    let creep = 1.0 - last.pulleys[1].angular_speed / 120.0;
    assert!(
        (last.pulleys[1].speed_loss - creep).abs() < 1e-12 && last.pulleys[0].speed_loss == 0.0
    );
    // What does not happen is waited for up to the latest time.
    let history = follow(&pulse(40.0));
    assert_eq!((history.ending, history.samples.len()), (Ending::Time, 101));
    let mut slackened = slackened(60);
    slackened.until = Until::Slack { latest: 0.03 };
    let history = follow(&slackened);
    let last = history.samples.last().unwrap();
    assert_eq!(history.ending, Ending::Event);
    assert!(last.smallest_tension < 0.0 && last.time > 0.01 && last.time < 0.012);
}

#[test]
fn a_slack_span_gives_way_and_snaps() {
    let histories = [60, 120, 240].map(|cells| follow(&slackened(cells)));
    let residuals = histories.each_ref().map(|history| {
        let ledger = history.samples.last().unwrap().ledger;
        ledger.residual() / ledger.turnover
    });
    let history = &histories[2];
    println!(
        "{residuals:?} {:?} {:?}",
        history.events, history.slack_spans
    );
    let first = |kind| {
        let mut events = history.events.iter();
        events.find(|event| event.kind == kind).unwrap().time
    };
    let [slack, taut] = [TransientEventKind::Slack, TransientEventKind::SlackEnds].map(first);
    assert!(slack > 0.01 && taut > slack, "{slack} {taut}");
    let samples = || history.samples.iter();
    let least = samples().map(|sample| sample.smallest_tension);
    let least = least.fold(f64::INFINITY, f64::min);
    // What pushes is a thousandth of what the same stretch would pull: the 48 N at rest are the scale of that.
    assert!(least < 0.0 && least > -0.5, "{least}");
    // The tension in the middle of a span is below zero in some of the samples while the span is slack, and never rises
    // above what is told of the time after that.
    let mut is_any_slack = false;
    for (index, span) in history.slack_spans.iter().enumerate() {
        let is_slack = |tension: f64| tension < 0.0;
        let in_samples = samples().filter(|sample| is_slack(sample.tensions[index]));
        let time = in_samples.count() as f64 * 1e-4;
        assert!(span.time >= time - 2e-4, "{span:?} {time}");
        let after = samples().skip_while(|sample| !is_slack(sample.tensions[index]));
        let largest = after.map(|sample| sample.tensions[index]);
        let largest = largest.fold(f64::NEG_INFINITY, f64::max);
        assert!(span.largest_tension >= largest, "{span:?} {largest}");
        is_any_slack |= span.time > 1e-3 && span.largest_tension > 48.0;
    }
    assert!(is_any_slack, "{:?}", history.slack_spans);
    // Second order, where the kink of the stiffness allows it.
    assert!(residuals[2].abs() < 1e-5, "{residuals:?}");
}

#[test]
fn a_damped_belt_that_is_stretched_far_stays_stable() {
    // Damping bounds the step, and is larger by the square of the stretch.
    let axles = vec![
        driver(Schedule::ramp([0.0, 0.01], [0.0, 20.0])),
        loaded(0.005, Load::new(Schedule::constant(1.0))),
    ];
    let mut simulation = from_rest(kim(2.0e8, 0.2, 1.0), axles, 60, 0.01);
    simulation.axial_damping = 20.0;
    assert_eq!(follow(&simulation).ending, Ending::Time);
}
