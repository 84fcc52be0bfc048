//! Branches of steady states and the limits of drives, against converged values.

use beltdrive::input::Key;
use beltdrive::{
    Belt, BeltKind, Branch, BranchEnd, BranchEvent, Closure, Drive, EventKind, FrictionLaw,
    LimitReason, Load, RangeEnd, Role, SolveError, SolveOptions, SpanTension, TwoPulleys, VBelt,
    examples, input, limits, solve, trace,
};

const BRISTLE: FrictionLaw = FrictionLaw::Bristle { stiffness: 1620.0 };
const EPP: FrictionLaw = FrictionLaw::Epp { stiffness: 8.1e6 };

/// The drive of Kim (2009), table 3, with slack tractive tension 100 N.
fn kim(law: FrictionLaw) -> Drive {
    let example = examples::find("kim2009").unwrap();
    let drive = input::parse(example.name, example.text, &[]).unwrap();
    Drive { law, ..drive }
}

/// That drive with Coulomb friction and another coefficient of friction.
fn with_friction(friction_coefficient: f64) -> Drive {
    Drive::from(TwoPulleys {
        friction_coefficient,
        ..kim(FrictionLaw::Coulomb).two_pulleys().unwrap()
    })
}

/// A V-belt with a mass, an axial and a radial stiffness and a half-angle of the groove, SI.
fn v_belt([mass, axial, radial, half_angle]: [f64; 4]) -> Belt {
    Belt {
        mass_per_length: mass,
        axial_stiffness: axial,
        kind: BeltKind::V(VBelt {
            radial_stiffness: radial,
            half_angle,
            height: None,
        }),
        ..kim(FrictionLaw::Coulomb).belt
    }
}

/// A load by two tractive tensions, N.
fn tractive(slack: f64, tight: f64) -> Load {
    Load {
        slack: SpanTension::Tractive(slack),
        tight: SpanTension::Tractive(tight),
    }
}

fn key(drive: &Drive, path: &str) -> Key {
    Key::all(drive).find(|key| key.path() == path).unwrap()
}

fn traced(drive: &Drive, path: &str, range: [f64; 2]) -> Branch {
    let key = key(drive, path);
    trace(drive, &key, range, &SolveOptions::default(), &mut |_, _| {}).unwrap()
}

fn event(branch: &Branch, kind: EventKind) -> &BranchEvent {
    let mut events = branch.events.iter();
    let found = events.find(|event| event.kind == kind);
    found.unwrap_or_else(|| panic!("{kind:?} among {:?}", branch.events))
}

fn close(found: f64, expected: f64, relative: f64) {
    let deviation = (found / expected - 1.0).abs();
    assert!(
        deviation <= relative,
        "{found} for {expected}: {deviation:.1e}"
    );
}

const TIGHT: &str = "load.tight_tractive_tension";

#[test]
fn steps_are_long_again_behind_a_driven_pulley_that_almost_stands() {
    // With less friction it stops, at 7687 N for 0.38742; here it goes on with a slip of 96 to 100 % over 800 N, in
    // which the branch of short steps ended.
    let drive = Drive::from(TwoPulleys {
        friction_coefficient: 0.38744,
        ..kim(BRISTLE).two_pulleys().unwrap()
    });
    let options = SolveOptions::default();
    let found = limits(&drive, &key(&drive, TIGHT), &options, &mut |_, _| {}).unwrap();
    assert_eq!(found.largest.reason, RangeEnd::Limit(LimitReason::Overhang));
    close(found.largest.value, 8_556.462_5, 1e-8);
    let steps = found.branch.convergence.continuation_steps;
    println!("{steps} steps");
    assert!(steps < 150);
}

#[test]
fn a_coulomb_branch_goes_through_90_degrees_around_the_limit_point() {
    let branch = traced(&kim(FrictionLaw::Coulomb), TIGHT, [310.0, 9000.0]);
    let overhang = event(&branch, EventKind::Overhang(Role::Driver));
    close(overhang.point.value, 7523.082013, 1e-8);
    close(
        overhang.point.state.driver.inclination[1].to_degrees(),
        90.0,
        1e-9,
    );
    let fold = event(&branch, EventKind::LimitPoint);
    close(fold.point.value, 8221.01476, 1e-8);
    close(fold.point.state.driven.angular_speed, 35.481_22, 1e-6);
    close(
        fold.point.state.driver.wrap_angle.to_degrees(),
        316.8958,
        1e-6,
    );
    close(
        fold.point.state.driver.inclination[1].to_degrees(),
        126.4294,
        1e-6,
    );
    assert!(fold.value_error.unwrap() < 1e-4);
    // Down the other side.
    assert_eq!(branch.end, BranchEnd::Returned);
    assert!(branch.points.last().unwrap().value < 7000.0);
    assert!(branch.points.is_sorted_by_key(|point| point.arclength));
    let largest = branch
        .points
        .iter()
        .map(|point| point.value)
        .fold(0.0, f64::max);
    assert!(largest <= fold.point.value * (1.0 + 1e-9));
}

#[test]
fn a_branch_from_near_no_load_takes_few_steps() {
    // 101 N is one per cent more than the slack tension. With contacts that are not cut where the belt breaks away
    // from where it hardly slips there are 163 points.
    let branch = traced(&kim(FrictionLaw::Coulomb), TIGHT, [101.0, 1000.0]);
    assert_eq!(branch.end, BranchEnd::Target);
    assert!(branch.points.len() <= 36, "{}", branch.points.len());
    // With a normalised direction, from 200 N.
    let last = branch.points.last().unwrap();
    close(last.state.driven.angular_speed, 101.403_600_20, 1e-7);
}

#[test]
fn a_branch_of_a_belt_that_locks_in_a_stiff_groove_takes_few_steps() {
    // The belt is lifted within 2.4e-3 of the contact. With a turn that is not cut there are 177 points.
    let drive = Drive::from(TwoPulleys {
        belt: v_belt([0.082_879_73, 39_306.55, 2.662_816_3e7, 0.301_887_13]),
        friction_coefficient: 0.448_576_24,
        law: FrictionLaw::Coulomb,
        driver_radius: 0.317_597_62,
        driver_speed: 138.222_43,
        driven_radius: 0.424_785_09,
        centre_distance: 2.500_685_4,
        load: tractive(28.838_88, 42.655_224),
    });
    let branch = traced(&drive, TIGHT, [42.655_224, 90.0]);
    assert_eq!(branch.end, BranchEnd::Target);
    assert!(branch.points.len() <= 15, "{}", branch.points.len());
}

#[test]
fn a_branch_of_a_belt_that_hardly_slips_takes_long_steps() {
    // With ω, G and x as unknowns, in which the slip is not linear, 325 factorisations and 54 points.
    let drive = Drive::from(TwoPulleys {
        belt: v_belt([0.186_438_5, 20_031.784, 2.890_924_8e7, 0.269_566_09]),
        friction_coefficient: 0.638_572_6,
        law: FrictionLaw::Coulomb,
        driver_radius: 0.142_344_42,
        driver_speed: 23.515_329,
        driven_radius: 0.064_014_127,
        centre_distance: 0.243_540_87,
        load: tractive(46.052_016, 61.078_36),
    });
    let branch = traced(&drive, TIGHT, [61.078_36, 2000.0]);
    assert_eq!(branch.end, BranchEnd::Target);
    let factorisations = branch.convergence.factorisations;
    assert!(factorisations <= 150, "{factorisations}");
}

#[test]
fn a_branch_passes_the_load_at_which_the_slip_of_a_turn_changes_its_sense() {
    // On the driver at 100.54 N. The place of the turn turns back there, and the branch came back to its start. In ever
    // shorter steps towards that load the branches took 191, 148 and 258 factorisations.
    for (law, from, most) in [
        (FrictionLaw::Coulomb, 100.01, 155),
        (FrictionLaw::Coulomb, 100.53, 110),
        (FrictionLaw::Epp { stiffness: 8.1e6 }, 100.3, 200),
    ] {
        let branch = traced(&kim(law), TIGHT, [from, 300.0]);
        assert_eq!(branch.end, BranchEnd::Target, "{law:?} {from}");
        let values: Vec<f64> = branch.points.iter().map(|point| point.value).collect();
        assert!(values.is_sorted(), "{values:?}");
        let factorisations = branch.convergence.factorisations;
        assert!(factorisations <= most, "{factorisations} {law:?} {from}");
        let last = branch.points.last().unwrap();
        let mut alone = kim(law);
        key(&alone, TIGHT).set(&mut alone, 300.0);
        let alone = solve(&alone, &SolveOptions::default()).unwrap();
        close(
            last.state.driven.angular_speed,
            alone.driven.angular_speed,
            1e-7,
        );
    }
}

#[test]
fn a_branch_goes_on_where_the_belt_ceases_to_stick() {
    // On the driver it does at 45.68 N. Behind that, soft bristles do not carry the load with the limit of elastic friction.
    let drive = Drive::from(TwoPulleys {
        belt: v_belt([0.110_117_68, 27_430.872, 3_109_906.5, 0.270_149_34]),
        friction_coefficient: 0.196_375_06,
        law: FrictionLaw::Epp {
            stiffness: 77_833_518.0,
        },
        driver_radius: 0.051_061_273,
        driver_speed: 22.976_605,
        driven_radius: 0.070_408_495,
        centre_distance: 0.427_270_37,
        load: tractive(41.916_054, 43.27),
    });
    let branch = traced(&drive, TIGHT, [43.27, 50.0]);
    assert_eq!(branch.end, BranchEnd::Target);
    let last = branch.points.last().unwrap();
    close(last.state.driven.angular_speed, 16.605_113_5, 1e-6);
}

#[test]
fn the_state_that_is_solved_is_that_to_which_a_light_load_is_raised() {
    // Of the first drive there are states at 500 N whose driven pulley is 2 % faster, and at 870 N some with an efficiency of 0.907,
    // of the second one states with 0.839.
    let first = Drive::from(TwoPulleys {
        belt: v_belt([0.254_530_15, 43_127.071_2, 12_670_466.1, 0.269_144_991]),
        friction_coefficient: 0.514_563_158,
        driver_radius: 0.108_738_117,
        driver_speed: 42.805_159_8,
        driven_radius: 0.046_547_541_2,
        centre_distance: 0.317_457_317,
        load: tractive(343.657_254, 870.0),
        law: FrictionLaw::Epp {
            stiffness: 715_327_228.0,
        },
    });
    let second = Drive::from(TwoPulleys {
        belt: v_belt([0.263_444_499, 16_250.350_3, 16_256_025.9, 0.289_015_102]),
        friction_coefficient: 0.619_370_459,
        driver_radius: 0.185_375_77,
        driver_speed: 42.952_129_8,
        driven_radius: 0.049_882_783_9,
        centre_distance: 0.650_858_88,
        load: tractive(860.388_019, 1_660.75),
        law: FrictionLaw::Epp {
            stiffness: 71_995_294.1,
        },
    });
    let cases = [
        (&first, [371.0, 500.0], 0.955_44),
        (&first, [500.0, 870.0], 0.931_42),
        (&second, [946.0, 1_660.75], 0.900_04),
    ];
    for (drive, range, efficiency) in cases {
        let branch = traced(drive, TIGHT, range);
        assert_eq!(branch.end, BranchEnd::Target);
        let led = &branch.points.last().unwrap().state;
        let mut drive = drive.clone();
        key(&drive, TIGHT).set(&mut drive, range[1]);
        let state = solve(&drive, &SolveOptions::default()).unwrap();
        close(state.driven.angular_speed, led.driven.angular_speed, 1e-6);
        close(state.efficiency, led.efficiency, 1e-6);
        close(state.efficiency, efficiency, 1e-5);
    }
}

#[test]
fn the_end_of_a_turn_is_no_limit() {
    // At 20 453 N the friction on the driver, which turns to lift the belt, ceases to pass the middle of that turn.
    let drive = Drive::from(TwoPulleys {
        belt: v_belt([0.062_728_92, 163_474.3, 1_230_142.4, 0.271_928_9]),
        friction_coefficient: 0.344_997_4,
        driver_radius: 0.390_039_15,
        driver_speed: 41.242_612,
        driven_radius: 0.278_158_05,
        centre_distance: 3.286_365_9,
        load: tractive(334.413_82, 827.658_5),
        law: FrictionLaw::Coulomb,
    });
    let options = SolveOptions::default();
    let limits = limits(&drive, &key(&drive, TIGHT), &options, &mut |_, _| {}).unwrap();
    assert_eq!(
        limits.largest.reason,
        RangeEnd::Limit(LimitReason::Overhang)
    );
    // With a normalised direction, whose branch has no turn among its segments.
    close(limits.largest.value, 24_697.669, 1e-6);
}

#[test]
fn a_limit_point_where_the_slip_of_a_turn_changes_its_sense_on_one_pulley_is_none() {
    // At 491.3 N on the driver, while the driven pulley slips. The largest load is 606 N.
    let drive = Drive::from(TwoPulleys {
        belt: v_belt([0.099_591_426_7, 25_018.398_58, 1_203_507.338, 0.265_264_859]),
        friction_coefficient: 0.555_808_113_3,
        driver_radius: 0.037_684_894_26,
        driver_speed: 31.405_708_78,
        driven_radius: 0.044_084_830_11,
        centre_distance: 0.224_922_522_1,
        load: tractive(362.796_218, 400.0),
        law: FrictionLaw::Coulomb,
    });
    let key = key(&drive, TIGHT);
    let found = limits(&drive, &key, &SolveOptions::default(), &mut |_, _| {}).unwrap();
    let turns = |event: &BranchEvent| event.kind == EventKind::LimitPoint;
    assert!(!found.branch.events.iter().any(turns));
    assert!(found.largest.value > 600.0, "{}", found.largest.value);
}

#[test]
fn states_on_a_branch_are_those_of_a_solve() {
    let drive = kim(BRISTLE);
    let branch = traced(&drive, TIGHT, [102.0, 3000.0]);
    assert_eq!(branch.end, BranchEnd::Target);
    assert_eq!(branch.points.last().unwrap().value, 3000.0);
    for point in branch.points.iter().step_by(5) {
        let mut drive = drive.clone();
        key(&drive, TIGHT).set(&mut drive, point.value);
        let state = solve(&drive, &SolveOptions::default()).unwrap();
        close(
            point.state.driven.angular_speed,
            state.driven.angular_speed,
            2e-6,
        );
        close(point.state.driver.wrap_angle, state.driver.wrap_angle, 2e-6);
        close(point.state.tight_tension, state.tight_tension, 2e-6);
        assert!((point.state.efficiency - state.efficiency).abs() < 2e-6);
    }
}

#[test]
fn the_bristle_branch_has_its_own_limit() {
    let found = limits(
        &kim(BRISTLE),
        &key(&kim(BRISTLE), TIGHT),
        &SolveOptions::default(),
        &mut |_, _| {},
    );
    let found = found.unwrap();
    close(found.largest.value, 8_330.214_368, 1e-9);
    assert_eq!(found.largest.reason, RangeEnd::Limit(LimitReason::Overhang));
    assert_eq!(
        (found.smallest.value, found.smallest.reason),
        (100.0, RangeEnd::NoLoad)
    );
    assert!(
        found
            .branch
            .points
            .is_sorted_by_key(|point| point.arclength)
    );
    assert_eq!(found.branch.points[0].value, 100.0);
}

#[test]
fn the_errors_of_the_state_without_load_are_told_with_bristles() {
    let without_load = |tolerance| {
        let key = key(&kim(BRISTLE), TIGHT);
        let options = SolveOptions { tolerance };
        let found = limits(&kim(BRISTLE), &key, &options, &mut |_, _| {});
        found.unwrap().smallest
    };
    let [found, known] = [1e-6, 1e-9].map(without_load);
    assert_eq!(found.value_error, Some(0.0));
    let errors = found.errors.unwrap();
    let pulleys = [
        (found.state.driver, known.state.driver, errors.driver),
        (found.state.driven, known.state.driven, errors.driven),
    ];
    for (found, known, told) in pulleys {
        let off = (found.wrap_angle - known.wrap_angle).abs();
        assert!(
            off <= told.wrap_angle && told.wrap_angle < 1e-5,
            "{off} {told:?}"
        );
        let off = (found.torque - known.torque).abs();
        assert!(off <= told.torque && told.torque < 1e-4, "{off} {told:?}");
    }
}

#[test]
fn a_limit_is_found_beyond_a_state_that_its_mesh_shows_pulling() {
    // Where the belt leaves the driven pulley its normal force is -8e-8 of the largest on a mesh for the error.
    let example = examples::find("kim2009-bristle").unwrap();
    let changes = [
        ("belt.axial_stiffness", "88314 N"),
        ("belt.radial_stiffness", "5.5622e6 N/m^2"),
        ("belt.mass_per_length", "0.241514 kg/m"),
        ("groove.half_angle", "12.8068 deg"),
        ("friction.coefficient", "0.26056"),
        ("friction.bristle_stiffness", "2488.03 1/m"),
        ("pulleys.driver.radius", "0.188332 m"),
        ("pulleys.driven.radius", "0.0954581 m"),
        ("layout.centre_distance", "0.384438 m"),
    ];
    let changes = changes.map(|(key, value)| match value.contains(' ') {
        true => format!("{key}='{value}'"),
        false => format!("{key}={value}"),
    });
    let drive = input::parse(example.name, example.text, &changes).unwrap();
    let key = key(&drive, TIGHT);
    let found = limits(&drive, &key, &SolveOptions::default(), &mut |_, _| {}).unwrap();
    let reason = RangeEnd::Limit(LimitReason::DrivenSlips);
    assert_eq!(found.largest.reason, reason);
    close(found.largest.value, 2464.58777036, 1e-9);
}

#[test]
fn the_kind_of_limit_changes_with_friction() {
    for (coefficient, limit, reason) in [
        (0.2, 777.164_87, LimitReason::DrivenSlips),
        (0.3, 2_233.702_20, LimitReason::DrivenSlips),
        (0.5, 7_224.969_9, LimitReason::Overhang),
    ] {
        let mut drive = with_friction(coefficient);
        let tight = key(&drive, TIGHT);
        let found = limits(&drive, &tight, &SolveOptions::default(), &mut |_, _| {}).unwrap();
        close(found.largest.value, limit, 1e-8);
        assert_eq!(
            found.largest.reason,
            RangeEnd::Limit(reason),
            "μ = {coefficient}"
        );
        // No state of the branch turns backwards.
        let speeds = found
            .branch
            .points
            .iter()
            .map(|p| p.state.driven.angular_speed);
        assert!(speeds.fold(f64::INFINITY, f64::min) > -1e-6);
        // The search that refuses a load beyond the limit is another one.
        tight.set(&mut drive, 1.05 * limit);
        let refused = solve(&drive, &SolveOptions::default());
        let Err(SolveError::NoSteadyState {
            limit: other,
            reason: why,
            ..
        }) = refused
        else {
            panic!("a load beyond the limit");
        };
        close(other, limit, 1e-6);
        assert_eq!(why, reason);
    }
}

#[test]
fn gross_slip_is_located_and_ends_the_branch() {
    let [slack, tight] = [200.0, 600.0].map(SpanTension::Belt);
    let mut drive = kim(EPP);
    drive.closure = Closure::BothSpans(Load { slack, tight });
    let branch = traced(&drive, "load.tight_tension", [600.0, 2000.0]);
    assert_eq!(branch.end, BranchEnd::GrossSlip(Role::Driven));
    let stop = event(&branch, EventKind::GrossSlip(Role::Driven));
    let error = stop.value_error.unwrap();
    assert!(error < 1e-3, "{error:e}");
    assert!((stop.point.value - 917.0273).abs() < 2.0 * error);
    assert!(stop.point.state.driven.angular_speed.abs() < 1e-9);
    assert!(
        branch
            .points
            .iter()
            .all(|p| p.state.driven.angular_speed > -1e-9)
    );
}

#[test]
fn a_short_stretch_in_which_the_driven_pulley_stops_is_not_stepped_over() {
    // The driven speed is negative between 7629.55 N and 7733.86 N only.
    let drive = with_friction(0.3865);
    let tight = key(&drive, TIGHT);
    let found = limits(&drive, &tight, &SolveOptions::default(), &mut |_, _| {}).unwrap();
    close(found.largest.value, 7_629.546, 1e-6);
    let slips = RangeEnd::Limit(LimitReason::DrivenSlips);
    assert_eq!(found.largest.reason, slips);
}

#[test]
fn epp_friction_has_nearly_the_limit_of_coulomb_friction_at_half_its_speed() {
    let drive = kim(EPP);
    let found = limits(
        &drive,
        &key(&drive, TIGHT),
        &SolveOptions::default(),
        &mut |_, _| {},
    );
    let largest = found.unwrap().largest;
    close(largest.value, 8221.0148, 1e-8);
    close(largest.state.driven.angular_speed, 16.5703, 1e-5);
    assert_eq!(largest.reason, RangeEnd::Limit(LimitReason::Overhang));
}

#[test]
fn other_entries_are_traced_too() {
    let drive = kim(FrictionLaw::Coulomb);
    let branch = traced(&drive, "friction.coefficient", [0.4, 0.1]);
    assert_eq!(branch.end, BranchEnd::GrossSlip(Role::Driven));
    close(branch.points.last().unwrap().value, 0.189_901_28, 1e-7);
    let branch = traced(&drive, "belt.radial_stiffness", [900e3, 300e3]);
    assert_eq!(branch.end, BranchEnd::Target);
    let branch = traced(&drive, "groove.half_angle", [18_f64.to_radians(), 0.28]);
    assert_eq!(branch.points.last().unwrap().value, 0.28);
}

#[test]
fn a_belt_that_sinks_beyond_its_height_is_an_event() {
    let mut drive = kim(BRISTLE);
    if let BeltKind::V(belt) = &mut drive.belt.kind {
        belt.height = Some(0.01);
    }
    let branch = traced(&drive, TIGHT, [700.0, 3000.0]);
    let sunk = event(&branch, EventKind::BeltHeight(Role::Driven));
    close(sunk.point.state.driven.max_penetration, 0.01, 1e-3);
}

#[test]
fn the_limit_of_a_drive_whose_branch_takes_many_steps_is_found() {
    // Where bristles hold a soft belt that hardly slips, steps are short: 600 of them end at 10 119 N.
    let law = FrictionLaw::Bristle {
        stiffness: 3_529.713_3,
    };
    let drive = Drive::from(TwoPulleys {
        belt: v_belt([0.511_404_95, 12_007.028_5, 10_176_960.4, 0.247_959_202]),
        friction_coefficient: 0.712_102_06,
        driver_radius: 0.356_365_592,
        driver_speed: 33.123_239_1,
        driven_radius: 0.280_168_979,
        centre_distance: 1.912_698_34,
        load: tractive(262.263_879, 393.337_016),
        law,
    });
    let options = SolveOptions::default();
    let tight = key(&drive, TIGHT);
    let limits = limits(&drive, &tight, &options, &mut |_, _| {}).unwrap();
    let largest = limits.largest;
    assert_eq!(largest.reason, RangeEnd::Limit(LimitReason::Overhang));
    let at = |share: f64| {
        let mut drive = drive.clone();
        tight.set(&mut drive, share * largest.value);
        solve(&drive, &options)
    };
    assert!(at(0.99).is_ok());
    let error = at(1.01).unwrap_err();
    let SolveError::NoSteadyState { limit, .. } = error else {
        panic!("{error}");
    };
    close(limit, largest.value, 1e-6);
}
