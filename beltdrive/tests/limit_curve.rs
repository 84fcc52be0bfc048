//! Limits followed over a second entry, against converged values and against limits located one by
//! one.

use beltdrive::input::Key;
use beltdrive::{
    BranchEnd, Drive, FrictionLaw, LimitCurve, LimitCurvePoint, LimitReason, RangeEnd, SolveError,
    SolveOptions, TwoPulleys, examples, input, limit_curve, limits, solve,
};

const TIGHT: &str = "load.tight_tractive_tension";
const SLACK: &str = "load.slack_tractive_tension";
const FRICTION: &str = "friction.coefficient";

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

fn key(drive: &Drive, path: &str) -> Key {
    Key::all(drive).find(|key| key.path() == path).unwrap()
}

fn chart(drive: &Drive, second: &str, range: [f64; 2]) -> LimitCurve {
    let [first, second] = [TIGHT, second].map(|path| key(drive, path));
    let options = SolveOptions::default();
    let curve = limit_curve(drive, &first, &second, range, &options, &mut |_, _| {}).unwrap();
    assert_eq!(curve.end, BranchEnd::Target);
    assert_eq!(curve.points[0].second, range[0]);
    assert_eq!(curve.points.last().unwrap().second, range[1]);
    curve
}

fn at(curve: &LimitCurve, second: f64) -> &LimitCurvePoint {
    let mut points = curve.points.iter();
    let found = points.find(|point| (point.second / second - 1.0).abs() < 1e-12);
    found.unwrap_or_else(|| panic!("no limit at {second}"))
}

#[track_caller]
fn close(found: f64, expected: f64, relative: f64) {
    let deviation = (found / expected - 1.0).abs();
    assert!(
        deviation <= relative,
        "{found} for {expected}: {deviation:.1e}"
    );
}

/// The limits before and behind the only place at which their kind changes.
fn change(curve: &LimitCurve) -> [&LimitCurvePoint; 2] {
    let changes = curve.points.windows(2);
    let mut changes = changes.filter(|pair| pair[0].reason != pair[1].reason);
    let pair = changes.next().unwrap();
    assert!(changes.next().is_none());
    [&pair[0], &pair[1]]
}

#[test]
fn limits_over_friction_are_followed_across_their_jump() {
    let drive = kim(FrictionLaw::Coulomb);
    let curve = chart(&drive, FRICTION, [0.3, 0.5]);
    for (friction, limit, reason) in [
        (0.3, 2233.70220, LimitReason::DrivenSlips),
        (0.38, 6159.445496, LimitReason::DrivenSlips),
        (0.4, 8221.01476, LimitReason::Overhang),
        (0.42, 7915.63414, LimitReason::Overhang),
        (0.5, 7224.96994, LimitReason::Overhang),
    ] {
        let point = at(&curve, friction);
        close(point.value, limit, 1e-8);
        assert_eq!(point.reason, reason, "μ = {friction}");
    }
    // Followed limits are those found on branches of their own.
    for friction in [0.33, 0.44] {
        let drive = with_friction(friction);
        let tight = key(&drive, TIGHT);
        let options = SolveOptions::default();
        let alone = limits(&drive, &tight, &options, &mut |_, _| {}).unwrap();
        let (alone, point) = (alone.largest, at(&curve, friction));
        let error = point.value_error.unwrap() + alone.value_error.unwrap();
        assert!((point.value - alone.value).abs() <= error);
        assert!(point.value_error.unwrap() < 1e-6 * point.value);
        assert_eq!(alone.reason, RangeEnd::Limit(point.reason));
        close(point.state.tight_tension, alone.state.tight_tension, 1e-7);
    }
    // The limit jumps where the driven pulley stops for a moment on the way to the limit point.
    let [slip, fold] = change(&curve);
    assert_eq!(slip.second, fold.second);
    close(slip.second, 0.386_509_65, 1e-6);
    close(fold.value, 8471.7161, 1e-6);
    assert!(fold.state.driven.angular_speed > 10.0);
    for (friction, carried) in [(slip.second - 2e-5, false), (slip.second + 2e-5, true)] {
        let mut drive = with_friction(friction);
        key(&drive, TIGHT).set(&mut drive, slip.value);
        match solve(&drive, &SolveOptions::default()) {
            Ok(state) => assert!(carried && state.driven.angular_speed < 0.5),
            Err(error) => {
                assert!(!carried && matches!(error, SolveError::NoSteadyState { .. }));
            }
        }
    }
}

#[test]
fn limits_over_the_slack_tension_are_followed() {
    let curve = chart(&kim(FrictionLaw::Coulomb), SLACK, [50.0, 400.0]);
    for (slack, limit, reason) in [
        (50.0, 3333.883596, LimitReason::DrivenSlips),
        (85.0, 7737.34532, LimitReason::Overhang),
        (102.5, 8295.99752, LimitReason::Overhang),
        (225.0, 10843.82972, LimitReason::Overhang),
        (400.0, 12764.73285, LimitReason::Overhang),
    ] {
        let point = at(&curve, slack);
        close(point.value, limit, 1e-8);
        assert_eq!(point.reason, reason, "{slack} N");
    }
    assert!(curve.cusps.is_empty());
}

#[test]
fn gross_slip_on_the_way_to_a_limit_point_comes_first() {
    // With EPP friction the driven pulley would stand at the limit point for μ = 0.392706 only, but
    // slips grossly at smaller loads up to a larger μ.
    let curve = chart(
        &kim(FrictionLaw::Epp { stiffness: 8.1e6 }),
        FRICTION,
        [0.41, 0.38],
    );
    let [fold, slip] = change(&curve);
    assert_eq!(slip.second, fold.second);
    close(slip.second, 0.398_135_25, 1e-6);
    close(fold.value, 8253.3784, 1e-6);
    assert!(fold.state.driven.angular_speed > 10.0);
    assert!(slip.value < 7700.0 && slip.state.driven.angular_speed.abs() < 1e-6);
}
