//! Invariants, limits and symmetries of flat-belt drives.

use beltdrive::input::Key;
use beltdrive::{
    Belt, BeltKind, BranchEnd, Check, Drive, FrictionLaw, LimitReason, Load, NormalForce,
    PulleyState, RangeEnd, Role, SolveError, SolveOptions, SpanTension, SteadyState, TwoPulleys,
    ZoneKind, limit_curve, limits,
};
use proptest::prelude::*;

/// A drive of ordinary proportions, with equal pulleys.
fn plain(law: FrictionLaw, normal_force: NormalForce) -> TwoPulleys {
    TwoPulleys {
        belt: Belt {
            ribs: 1,
            mass_per_length: 0.25,
            axial_stiffness: 150e3,
            kind: BeltKind::Flat { normal_force },
        },
        friction_coefficient: 0.5,
        law,
        driver_radius: 0.1,
        driven_radius: 0.1,
        driver_speed: 150.0,
        centre_distance: 0.7,
        load: Load {
            slack: SpanTension::Belt(300.0),
            tight: SpanTension::DrivenTorque(40.0),
        },
    }
}

fn solve(drive: &TwoPulleys) -> Result<SteadyState, SolveError> {
    beltdrive::solve(&Drive::from(*drive), &SolveOptions::default())
}

fn solved(drive: &TwoPulleys) -> SteadyState {
    solve(drive).unwrap_or_else(|error| panic!("{error}\n{drive:?}"))
}

/// Where the first zone of a pulley ends, rad.
fn transition(pulley: &PulleyState) -> f64 {
    pulley.zones[0].to
}

/// The slope of log y over log x between the ends of two sequences.
fn slope(x: &[f64], y: &[f64]) -> f64 {
    let last = x.len() - 1;
    (y[last] / y[0]).ln() / (x[last] / x[0]).ln()
}

#[test]
fn epp_tends_to_coulomb_as_the_root_of_the_stiffness() {
    for convention in NormalForce::ALL {
        let rigid = solved(&plain(FrictionLaw::Coulomb, convention));
        let stiffness = [1e9, 1e10, 1e11, 1e12, 1e13];
        let off: Vec<_> = stiffness
            .iter()
            .map(|&stiffness| {
                let state = solved(&plain(FrictionLaw::Epp { stiffness }, convention));
                transition(&state.driven) - transition(&rigid.driven)
            })
            .collect();
        let order = slope(&stiffness, &off);
        assert!((order + 0.5).abs() < 0.01, "{convention:?}: {order}");
    }
}

#[test]
fn creep_rate_friction_tends_to_coulomb_with_its_velocity() {
    let convention = NormalForce::Inertia;
    let rigid = solved(&plain(FrictionLaw::Coulomb, convention));
    let velocities = [1e-4, 1e-5, 1e-6, 1e-7];
    let states =
        velocities.map(|velocity| solved(&plain(FrictionLaw::CreepRate { velocity }, convention)));
    let off = |quantity: fn(&SteadyState) -> f64| {
        states
            .each_ref()
            .map(|state| (quantity(state) - quantity(&rigid)).abs())
    };
    let driven: fn(&SteadyState) -> f64 = |state| transition(&state.driven);
    let driver: fn(&SteadyState) -> f64 = |state| transition(&state.driver);
    for place in [driven, driver] {
        let off = off(place);
        // The velocity where slip is fully developed is passed by a logarithm of it later.
        let order = slope(&velocities, &off);
        assert!((order - 1.0).abs() < 0.1, "{order}");
    }
    assert!(off(|state| state.driven.angular_speed)[0] < 1e-9);
}

#[test]
fn the_largest_load_is_the_capstan_limit_of_the_pulley_with_less_wrap() {
    for convention in [NormalForce::Inertia, NormalForce::Exact] {
        let mut drive = plain(FrictionLaw::Coulomb, convention);
        for (driver, driven, pulley) in [(0.05, 0.15, Role::Driver), (0.15, 0.05, Role::Driven)] {
            (drive.driver_radius, drive.driven_radius) = (driver, driven);
            let mut stated = Drive::from(drive);
            let load = Key::load(&stated);
            let found = limits(&stated, &load, &SolveOptions::default(), &mut |_, _| {}).unwrap();
            assert_eq!(
                found.largest.reason,
                RangeEnd::Limit(LimitReason::Capstan(pulley))
            );
            assert_eq!(found.smallest.reason, RangeEnd::NoLoad);
            let state = &found.largest.state;
            let wrap = state.driver.wrap_angle.min(state.driven.wrap_angle);
            let capstan = (drive.friction_coefficient * wrap).exp();
            let ratio = state.tight_tractive_tension / state.slack_tractive_tension;
            assert!((ratio / capstan - 1.0).abs() < 1e-12, "{ratio} {capstan}");
            load.set(&mut stated, found.largest.value * (1.0 + 1e-12));
            let error = beltdrive::solve(&stated, &SolveOptions::default()).unwrap_err();
            let SolveError::NoSteadyState { limit, reason, .. } = error else {
                panic!("{error}");
            };
            assert_eq!(
                (limit, reason),
                (found.largest.value, LimitReason::Capstan(pulley))
            );
        }
    }
}

#[test]
fn the_limits_of_a_load_are_found_from_no_load() {
    let loaded = plain(FrictionLaw::Epp { stiffness: 1e8 }, NormalForce::Inertia);
    let loaded = Drive::from(loaded);
    let mut idle = loaded.clone();
    let load = Key::load(&loaded);
    load.set(&mut idle, 0.0);
    let [of_loaded, of_idle] = [&loaded, &idle]
        .map(|drive| limits(drive, &load, &SolveOptions::default(), &mut |_, _| {}).unwrap());
    assert_eq!(of_idle.smallest.reason, RangeEnd::NoLoad);
    let share = of_idle.largest.value / of_loaded.largest.value;
    assert!((share - 1.0).abs() < 1e-13, "{share}");
}

#[test]
fn a_belt_that_is_too_slack_for_its_speed_lifts_off() {
    let mut drive = plain(FrictionLaw::Coulomb, NormalForce::Inertia);
    drive.load.slack = SpanTension::Belt(0.25 * 15.0 * 15.0 * 0.99);
    let error = solve(&drive).unwrap_err();
    assert!(matches!(error, SolveError::TooSlack { .. }), "{error}");
    drive.load.slack = SpanTension::Belt(100.0);
    drive.load.tight = SpanTension::Belt(105.0);
    let drive = Drive::from(drive);
    let speed = Key::all(&drive)
        .find(|key| key.path() == "pulleys.driver.speed")
        .unwrap();
    let found = limits(&drive, &speed, &SolveOptions::default(), &mut |_, _| {}).unwrap();
    // Before it lifts off, the belt does not press enough to carry the load.
    assert!(matches!(
        found.largest.reason,
        RangeEnd::Limit(LimitReason::Capstan(_))
    ));
    assert!(found.largest.state.slack_tractive_tension > 0.0);
}

#[test]
fn no_speed_is_too_high_for_an_answer() {
    for law in [FrictionLaw::Coulomb, FrictionLaw::Epp { stiffness: 1e8 }] {
        for exponent in 0..200 {
            let mut drive = plain(law, NormalForce::Inertia);
            drive.load.slack = SpanTension::Tractive(300.0);
            drive.load.tight = SpanTension::Tractive(700.0);
            drive.driver_speed = 10_f64.powi(exponent);
            match solve(&drive) {
                // A tractive tension holds whatever the belt stretches to.
                Ok(state) => assert!(state.driven.angular_speed > 0.0, "1e{exponent}"),
                // Squares of larger speeds overflow, and the message with them.
                Err(error) => {
                    let is_clear = !error.to_string().contains("NaN");
                    assert!(is_clear || exponent > 150, "1e{exponent}: {error}");
                }
            }
        }
    }
}

#[test]
fn a_chart_over_the_speed_ends_where_the_belt_lifts_off() {
    let drive = Drive::from(plain(FrictionLaw::Coulomb, NormalForce::Inertia));
    let load = Key::load(&drive);
    let mut keys = Key::all(&drive);
    let speed = keys
        .find(|key| key.path() == "pulleys.driver.speed")
        .unwrap();
    let options = SolveOptions::default();
    let chart = limit_curve(
        &drive,
        &load,
        &speed,
        [10.0, 1000.0],
        &options,
        &mut |_, _| {},
    );
    let chart = chart.unwrap();
    assert_eq!(chart.end, BranchEnd::LiftsOff);
    // G V = T at sqrt(T/m)/R, but for the stretch of 0.2 %.
    let last = chart.points.last().unwrap().second;
    assert!((280.0..347.0).contains(&last), "{last}");
    assert!(
        chart
            .points
            .windows(2)
            .all(|pair| pair[1].value < pair[0].value)
    );
}

#[test]
fn a_load_between_kinds_of_tension_is_not_backwards_unnoticed() {
    let mut drive = plain(FrictionLaw::Coulomb, NormalForce::Inertia);
    // F = 300 N is more than T = 300 N.
    drive.load.slack = SpanTension::Tractive(300.0);
    drive.load.tight = SpanTension::Belt(330.0);
    let error = solve(&drive).unwrap_err();
    assert!(matches!(error, SolveError::Backwards { .. }), "{error}");
}

#[test]
fn soft_friction_sticks_again_behind_its_slip_zone() {
    let mut drive = plain(FrictionLaw::Epp { stiffness: 1e6 }, NormalForce::Inertia);
    drive.friction_coefficient = 1.2;
    drive.belt.axial_stiffness = 80e3;
    drive.belt.mass_per_length = 0.05;
    drive.load.tight = SpanTension::DrivenTorque(480.0);
    let state = solved(&drive);
    let kinds: Vec<_> = state.driven.zones.iter().map(|zone| zone.kind).collect();
    assert_eq!(
        kinds,
        [ZoneKind::Elastic, ZoneKind::Slip, ZoneKind::Elastic]
    );
    let profile = &state.driven.profile;
    let [friction, normal] = [&profile.friction_force, &profile.normal_force];
    let share = |i: usize| friction[i] / (drive.friction_coefficient * normal[i]);
    let last = profile.arc_length.len() - 1;
    assert!(share(last) < 0.999);
    assert!((0..=last).all(|i| share(i) < 1.0 + 1e-12));
}

/// Any flat-belt drive with a load of a share of what the pulley with less wrap carries.
fn any_drive() -> impl Strategy<Value = TwoPulleys> {
    let log = |low: f64, high: f64| (low.ln()..high.ln()).prop_map(f64::exp);
    let law = prop_oneof![
        Just(FrictionLaw::Coulomb),
        log(1e5, 1e14).prop_map(|stiffness| FrictionLaw::Epp { stiffness }),
        log(1e-8, 1.0).prop_map(|velocity| FrictionLaw::CreepRate { velocity }),
    ];
    let convention = prop::sample::select(NormalForce::ALL.to_vec());
    let pulleys = (log(0.02, 0.5), log(0.2, 5.0), 1.01..10.0);
    let belt = (log(5e3, 1e6), log(1e-4, 0.3), 0.0..0.9);
    let load = (log(1e-8, 0.999), 0.1..1.5);
    (law, convention, pulleys, belt, load).prop_map(
        |(law, normal_force, (radius, ratio, distance), (axial, strain, inertia), (share, mu))| {
            let driven_radius = radius * ratio;
            let slack = axial * strain;
            let mass_per_length = 0.2;
            let speed = f64::sqrt(inertia * slack / mass_per_length).max(1.0);
            let normal_force = match law {
                FrictionLaw::CreepRate { .. } => NormalForce::Inertia,
                _ => normal_force,
            };
            let mut drive = plain(law, normal_force);
            drive.belt.axial_stiffness = axial;
            drive.belt.mass_per_length = mass_per_length;
            drive.friction_coefficient = mu;
            (drive.driver_radius, drive.driven_radius) = (radius, driven_radius);
            drive.driver_speed = speed / radius;
            drive.centre_distance = (radius + driven_radius) * distance;
            let inclination = ((driven_radius - radius) / drive.centre_distance)
                .asin()
                .abs();
            let capacity = mu * (std::f64::consts::PI - 2.0 * inclination);
            let pressing = slack - mass_per_length * speed * speed;
            drive.load = Load {
                slack: SpanTension::Belt(slack),
                tight: SpanTension::DrivenTorque(
                    pressing * (share * capacity).exp_m1() * driven_radius,
                ),
            };
            drive
        },
    )
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    #[test]
    fn every_drive_is_solved_or_refused_with_its_limit(drive in any_drive()) {
        match solve(&drive) {
            Ok(state) => verify(&drive, &state)?,
            Err(SolveError::NoSteadyState { asked, limit, .. }) => prop_assert!(asked > limit),
            // A belt stretched by some ten per cent runs at a tension that the guess above misses.
            Err(SolveError::TooSlack { tension, centrifugal, .. }) => {
                prop_assert!(tension <= centrifugal);
            }
            Err(error) => prop_assert!(false, "{error}"),
        }
    }

    #[test]
    fn units_do_not_matter(
        drive in any_drive(),
        length in 0.1..10.0,
        time in 0.1..10.0,
        mass in 0.1..10.0,
    ) {
        let force: f64 = mass * length / (time * time);
        let mut scaled = drive;
        scaled.belt.mass_per_length *= mass / length;
        scaled.belt.axial_stiffness *= force;
        match &mut scaled.law {
            FrictionLaw::Epp { stiffness } => *stiffness *= force / (length * length),
            FrictionLaw::CreepRate { velocity } => *velocity *= length / time,
            _ => {}
        }
        scaled.driver_radius *= length;
        scaled.driven_radius *= length;
        scaled.centre_distance *= length;
        scaled.driver_speed /= time;
        let (SpanTension::Belt(slack), SpanTension::DrivenTorque(torque)) =
            (drive.load.slack, drive.load.tight)
        else {
            unreachable!("the drives of this file")
        };
        scaled.load.slack = SpanTension::Belt(slack * force);
        scaled.load.tight = SpanTension::DrivenTorque(torque * force * length);
        if let (Ok(one), Ok(two)) = (solve(&drive), solve(&scaled)) {
            let same = |one: f64, two: f64| (one - two).abs() <= 1e-8 * one.abs();
            let [first, second] = [&one, &two].map(|state| state.driven.angular_speed);
            prop_assert!(same(first, second * time), "{} {}", first, second * time);
            prop_assert!(same(one.belt_length, two.belt_length / length));
            prop_assert!((transition(&one.driver) - transition(&two.driver)).abs() < 1e-6);
        }
    }

    #[test]
    fn a_larger_load_creeps_more(drive in any_drive(), factor in 1.001..2.0) {
        let mut heavier = drive;
        let torque = drive.load.tight.value() * factor;
        heavier.load.tight = SpanTension::DrivenTorque(torque);
        if let (Ok(light), Ok(heavy)) = (solve(&drive), solve(&heavier)) {
            let rounding = 1e-13 * light.driven.angular_speed;
            prop_assert!(heavy.driven.angular_speed <= light.driven.angular_speed + rounding);
            prop_assert!(heavy.tight_tension > light.tight_tension);
            prop_assert!(heavy.friction_loss >= light.friction_loss * (1.0 - 1e-9));
        }
    }
}

/// The state carries its load, and satisfies what it was not solved for.
fn verify(drive: &TwoPulleys, state: &SteadyState) -> Result<(), TestCaseError> {
    let near = |one: f64, other: f64, scale: f64| (one - other).abs() <= 1e-9 * scale;
    for Check {
        name,
        deviation,
        limit,
    } in &state.checks
    {
        prop_assert!(deviation <= limit, "{}: {}", name, deviation);
    }
    let [slack, tight] = [state.slack_tractive_tension, state.tight_tractive_tension];
    for (pulley, radius, [entry, exit]) in [
        (&state.driven, drive.driven_radius, [slack, tight]),
        (&state.driver, drive.driver_radius, [tight, slack]),
    ] {
        let profile = &pulley.profile;
        let last = profile.arc_length.len() - 1;
        prop_assert!(near(profile.tractive_tension[0], entry, tight));
        prop_assert!(near(profile.tractive_tension[last], exit, tight));
        prop_assert!(near(
            profile.arc_length[last],
            radius * pulley.wrap_angle,
            radius
        ));
        // The thesis accelerates the belt at a constant speed.
        let thesis = BeltKind::Flat {
            normal_force: NormalForce::Thesis,
        };
        let torque = (tight - slack) * radius;
        prop_assert!(drive.belt.kind == thesis || near(pulley.torque, torque, tight * radius));
        let falls = |pair: &[f64]| (pair[1] - pair[0]) * (exit - entry) < -1e-9 * tight * tight;
        prop_assert!(!profile.tractive_tension.windows(2).any(falls));
        for (friction, normal) in profile.friction_force.iter().zip(&profile.normal_force) {
            let limit = drive.friction_coefficient * normal;
            prop_assert!(*friction >= 0.0 && *friction <= limit * (1.0 + 1e-9));
        }
        let zones = &pulley.zones;
        prop_assert!(zones.windows(2).all(|pair| pair[0].to == pair[1].from));
        prop_assert!(zones[0].from == 0.0);
        prop_assert!(near(zones[zones.len() - 1].to, pulley.wrap_angle, 1.0));
    }
    let driver = state.driver.torque * state.driver.angular_speed;
    let driven = state.driven.torque * state.driven.angular_speed;
    prop_assert!(near(driver - driven, state.friction_loss, driver));
    prop_assert!(state.friction_loss >= -1e-12 * driver);
    prop_assert!(state.driven.angular_speed > 0.0);
    Ok(())
}
