//! `rating`: the largest load against speed is that of `solve` and `limits`, and its optimum a maximum.

use beltdrive::belt_loop::{self, LoopEnd, Refusal, Varied, solve_to};
use beltdrive::input::DriveFile;
use beltdrive::quantity::{UnitSystem, rating::answer};
use beltdrive::report::{csv, json, table};
use beltdrive::{
    Belt, BeltKind, Closure, Drive, Duty, FrictionLaw, LoadEnd, NormalForce, Pulley, RatedLoad,
    Rating, RatingEnd, RatingQuestion, Sense, SlipMargin, SolveError, SolveOptions, check,
    examples, rating,
};
use std::f64::consts::PI;
use std::process::{Command, Output};

const OPTIONS: SolveOptions = SolveOptions { tolerance: 1e-6 };
const FLAT: [&str; 8] = [
    "back-side-idler",
    "conveyor",
    "crossed",
    "flat-bench",
    "flat-unequal",
    "kim2009-flat",
    "poly-v",
    "serpentine",
];

fn file(name: &str, overrides: &[&str]) -> DriveFile {
    let text = examples::find(name).unwrap().text;
    let overrides: Vec<_> = overrides.iter().map(|text| (*text).to_owned()).collect();
    DriveFile::read(name, text, &overrides).unwrap()
}

fn rated(drive: &Drive, question: RatingQuestion) -> Result<Rating, SolveError> {
    rating(drive, question, &OPTIONS, &mut |_, _| {})
}

fn of_example(name: &str, overrides: &[&str]) -> Rating {
    let drive = file(name, overrides).drive().unwrap();
    rated(&drive, RatingQuestion::default()).unwrap()
}

fn to(speed: f64) -> RatingQuestion {
    RatingQuestion {
        from: None,
        to: Some(speed),
    }
}

/// Whether the rated drive has a steady state at a speed with a factor on its torques.
fn runs(rating: &Rating, speed: f64, factor: f64) -> bool {
    solve_to(&loaded(rating, speed, factor), &OPTIONS).is_ok()
}

/// The rated drive at a speed with a factor on its torques.
fn loaded(rating: &Rating, speed: f64, factor: f64) -> Drive {
    let mut drive = rating.drive.clone();
    for pulley in &mut drive.pulleys {
        match &mut pulley.duty {
            Duty::Driver(own) => *own = speed,
            Duty::Torque(torque) => *torque *= factor,
            Duty::Power(_) | Duty::Driven => panic!("a rated drive has torques"),
        }
    }
    drive
}

/// Asserts that there is a state just below a load and none just above it.
fn assert_is_limit(rating: &Rating, load: &RatedLoad, within: f64) {
    let name = rating.drive.title.as_deref().unwrap_or_default();
    let [below, above] = [1.0 - within, 1.0 + within].map(|share| load.factor * share);
    assert!(runs(rating, load.speed, below), "{name}: {load:?}");
    assert!(!runs(rating, load.speed, above), "{name}: {load:?}");
}

#[test]
fn flat_belts_run_up_to_the_rated_load_and_not_beyond() {
    for name in FLAT {
        let found = of_example(name, &[]);
        assert_is_limit(&found, &found.optimum, 1e-9);
        assert_is_limit(&found, found.stated.as_ref().unwrap(), 1e-9);
        assert!(found.missing.len() <= 1, "{name}: {:?}", found.missing);
        let carried = found.points.iter().filter(|point| point.factor > 1e-3);
        for point in carried.step_by(10) {
            assert_is_limit(&found, point, 1e-9);
        }
    }
}

#[test]
fn every_law_of_flat_belts_is_rated() {
    for (law, number) in [
        ("coulomb", None),
        ("epp", Some("friction.stiffness=2e6 N/m^2")),
        ("creep-rate", Some("friction.velocity=0.05 m/s")),
    ] {
        for normal_force in ["inertia", "exact", "thesis"] {
            if (law, normal_force) == ("creep-rate", "thesis") {
                continue;
            }
            let law = format!("friction.law={law}");
            let normal_force = format!("model.normal_force={normal_force}");
            let mut overrides = vec![&*law, &*normal_force, "friction.stiffness="];
            overrides.extend(number);
            let found = of_example("crossed", &overrides);
            assert_is_limit(&found, &found.optimum, 1e-9);
            assert_is_limit(&found, &found.points[20], 1e-9);
        }
    }
}

#[test]
fn limits_finds_the_rated_torque_of_flat_belts() {
    for name in ["crossed", "back-side-idler", "flat-bench"] {
        let found = of_example(name, &[]);
        let speed = found.optimum.speed;
        let file = file(name, &[]);
        let keys = file.keys();
        let key = keys.iter().find(|key| key.path().ends_with(".speed"));
        let file = file.with(key.unwrap(), speed);
        let has_torque = keys.iter().any(|key| key.path().ends_with("torque"));
        assert!(has_torque, "{name}");
        let limits = belt_loop::limits(&file, &Varied::LoadFactor, &OPTIONS, &mut |_, _| {});
        let largest = limits.unwrap().largest;
        let off = largest.point.value / found.optimum.factor - 1.0;
        assert!(off.abs() < 1e-9, "{name}: {off:e}");
        let LoopEnd::Limit(Refusal::Loop(error)) = largest.end else {
            panic!("a limit");
        };
        assert_eq!(error.kind(), found.optimum.end.kind());
    }
}

/// Two equal pulleys with a belt that hardly stretches.
fn stiff(mass_per_length: f64, tension: f64) -> Drive {
    Drive {
        title: None,
        belt: Belt {
            mass_per_length,
            axial_stiffness: 1e12,
            kind: BeltKind::Flat {
                normal_force: NormalForce::Inertia,
            },
            ribs: 1,
        },
        law: FrictionLaw::Coulomb,
        sense: Sense::CounterClockwise,
        turning_number: 1,
        pulleys: vec![
            Pulley::new("driver", [0.0, 0.0], 0.1, 0.5, Duty::Driver(100.0)),
            Pulley::new("driven", [0.7, 0.0], 0.1, 0.5, Duty::Torque(1.0)),
        ],
        closure: Closure::SetupTension(tension),
    }
}

#[test]
fn a_stiff_belt_has_the_optimum_of_the_closed_form() {
    let (mass, tension, radius, friction, span) = (0.2_f64, 400.0, 0.1, 0.5, 0.7);
    let found = rated(&stiff(mass, tension), RatingQuestion::default()).unwrap();
    // ∫ T ds stays what it is at rest, T = F + m v², and both contacts slip: F grows as exp(μ φ) on them.
    let grown = (friction * PI).exp();
    let free = |speed: f64| {
        let tractive = tension - mass * (radius * speed).powi(2);
        let length = 2.0 * span + 2.0 * PI * radius;
        let slack =
            tractive * length / (span * (grown + 1.0) + 2.0 * radius * (grown - 1.0) / friction);
        radius * slack * (grown - 1.0)
    };
    for point in found.points.iter().take(60).chain([&found.optimum]) {
        let expected = free(point.speed);
        assert!(
            (point.torque / expected - 1.0).abs() < 1e-6,
            "{point:?} {expected}"
        );
    }
    let lift_off = (tension / mass).sqrt() / radius;
    let RatingEnd::LiftsOff { speed } = found.end else {
        panic!("{:?}", found.end);
    };
    assert!((speed / lift_off - 1.0).abs() < 1e-8, "{speed} {lift_off}");
    let best = lift_off / 3_f64.sqrt();
    assert!((found.optimum.speed / best - 1.0).abs() < 1e-6);
    assert!((found.optimum.power / (best * free(best)) - 1.0).abs() < 1e-6);
    assert!(!found.optimum_at_end);
    let last = found.points.last().unwrap();
    assert_eq!((last.factor, last.end.kind()), (0.0, "lift-off"));
}

#[test]
fn the_optimum_is_a_maximum() {
    for name in FLAT {
        let found = of_example(name, &[]);
        assert!(!found.optimum_at_end, "{name}");
        let speed = found.optimum.speed;
        for share in [0.9, 0.99, 0.999, 1.001, 1.01] {
            let other = rated(&found.drive, to(share * speed)).unwrap();
            let there = other.points.last().unwrap();
            assert!(there.power < found.optimum.power, "{name}: {share}");
            // Up to the maximum the power grows to the end.
            assert_eq!(other.optimum_at_end, share < 1.0, "{name}: {share}");
        }
        let powers = found.points.iter().map(|point| point.power);
        assert!(powers.fold(0.0, f64::max) <= found.optimum.power);
    }
}

#[test]
fn powers_are_torques_at_the_stated_speed() {
    let one = of_example("flat-bench", &["load.torque=10 N*m"]);
    let drive = file("flat-bench", &["load.torque=", "load.power=2 kW"])
        .drive()
        .unwrap();
    let other = rated(&drive, RatingQuestion::default()).unwrap();
    let off = one.optimum.power / other.optimum.power - 1.0;
    assert!(off.abs() < 1e-12, "{off:e}");
}

#[test]
fn a_drive_of_two_span_tensions_keeps_its_belt() {
    let found = of_example("kim2009-flat", &[]);
    let state = beltdrive::solve(&file("kim2009-flat", &[]).drive().unwrap(), &OPTIONS).unwrap();
    let Closure::UnstretchedLength(length) = found.drive.closure else {
        panic!("{:?}", found.drive.closure);
    };
    let mut drive = found.drive.clone();
    drive.closure = Closure::UnstretchedLength(length);
    let again = solve_to(&drive, &OPTIONS).unwrap();
    let off = again
        .spans
        .iter()
        .map(|span| span.tension)
        .fold(0.0, f64::max)
        / state.tight_tension;
    assert!((off - 1.0).abs() < 1e-10, "{off}");
}

#[test]
fn a_tensioner_ends_the_range_at_its_stop() {
    let found = of_example("serpentine", &[]);
    let RatingEnd::NoState { speed, reason } = &found.end else {
        panic!("{:?}", found.end);
    };
    assert_eq!(reason.kind(), "tensioner beyond travel");
    assert!(runs(&found, speed * (1.0 - 1e-9), 0.0));
    assert!(!runs(&found, speed * (1.0 + 1e-9), 0.0));
}

#[test]
fn a_span_tension_that_is_held_never_lifts_off() {
    let mut drive = stiff(0.2, 400.0);
    drive.closure = Closure::SpanTractiveTension {
        span: 1,
        tension: 200.0,
    };
    let found = rated(&drive, RatingQuestion::default()).unwrap();
    assert!(matches!(found.end, RatingEnd::Chosen { factor } if factor == 4.0));
    assert!(found.optimum_at_end && found.optimum.speed == 400.0);
    assert!(!table(&answer(&found), UnitSystem::Si).contains("NaN"));
}

#[test]
fn reasons_change_where_they_change() {
    for name in FLAT {
        let found = of_example(name, &[]);
        for pair in found.stretches.windows(2) {
            let [_, change] = pair[0].range;
            assert!((pair[1].range[0] / change - 1.0).abs() < 1e-9, "{name}");
            for (share, stretch) in [(0.999, &pair[0]), (1.001, &pair[1])] {
                let there = rated(&found.drive, to(share * change)).unwrap();
                let last = there.points.last().unwrap();
                assert!(last.end.is_like(&stretch.end), "{name} {share}: {last:?}");
            }
        }
    }
}

#[test]
fn a_range_that_is_none_is_refused() {
    let drive = stiff(0.2, 400.0);
    let of = |from, to| rated(&drive, RatingQuestion { from, to }).unwrap_err();
    for (from, to) in [
        (Some(50.0), Some(20.0)),
        (Some(50.0), Some(50.0)),
        (Some(-1.0), None),
        (None, Some(0.0)),
        (Some(f64::NAN), None),
        (None, Some(f64::INFINITY)),
    ] {
        let error = of(from, to);
        assert!(error.is_of_statement(), "{from:?} {to:?}: {error}");
    }
    // Lift-off is at 447 rad/s.
    let error = of(Some(450.0), None);
    assert!(matches!(error, SolveError::LiftsOff { .. }), "{error}");
    assert!(rated(&drive, to(1e6)).unwrap().points.last().unwrap().speed < 450.0);
    let mut idle = drive.clone();
    idle.pulleys[1].duty = Duty::Torque(0.0);
    let error = rated(&idle, RatingQuestion::default()).unwrap_err();
    assert!(error.is_of_statement(), "{error}");
    let mut slack = drive;
    slack.closure = Closure::UnstretchedLength(3.0);
    let error = rated(&slack, RatingQuestion::default()).unwrap_err();
    assert_eq!(error.kind(), "slack at rest");
}

#[test]
fn a_v_belt_runs_up_to_the_rated_load_and_not_beyond() {
    let found = of_example("v-power", &[]);
    for load in [&found.optimum, found.stated.as_ref().unwrap()] {
        assert_is_limit(&found, load, 1e-4);
        assert!(matches!(load.end, LoadEnd::Slips(_)));
    }
    let powers = found.points.iter().map(|point| point.power);
    let largest = powers.fold(0.0, f64::max);
    let allowed = 1.0 + 2.0 * found.error;
    assert!(largest <= allowed * found.optimum.power && found.optimum.power <= allowed * largest);
    // Between the speeds that were solved, within the stated error.
    let (last, inner) = found.points.split_last().unwrap();
    assert!(inner.iter().all(|point| point.error < 5e-3));
    assert!(last.error < 0.02 && last.error == found.error);
    for index in [12, 40, 52] {
        let point = &found.points[index];
        assert_is_limit(&found, point, 2.0 * point.error + 1e-4);
    }
    // Near lift-off, at 12 960 rpm, the driver slows the belt under a rising load, which then has no largest.
    let RatingEnd::SlipsEverMore { speed } = found.end else {
        panic!("{:?}", found.end);
    };
    assert!((1080.0..1180.0).contains(&speed), "{speed}");
    assert_eq!(found.points.last().unwrap().speed, speed);
}

/// Asserts that a pulley slips by 5 % under a load, and by more under more.
fn assert_slip_grows(rating: &Rating, load: &RatedLoad, pulley: usize) {
    let slip = |factor: f64| {
        let state = solve_to(&loaded(rating, load.speed, factor), &OPTIONS).unwrap();
        let groove = state.pulleys[pulley].groove.as_ref().unwrap();
        groove.least_slip.slip
    };
    let [below, above] = [1.0 - 1e-5, 1.0 + 1e-5].map(|share| slip(share * load.factor));
    assert!(below < 0.05 && 0.05 < above, "{below} {above}");
    assert!(slip(1.05 * load.factor) > above);
}

/// Three grooves whose driver slips first at every speed, and then slows the belt down: no load is the largest.
const THREE_GROOVES: &str = r#"
[belt]
type="v"
mass_per_length="0.274 kg/m"
axial_stiffness="139.9 kN"
radial_stiffness="21.17 N/mm^2"
[groove]
half_angle="16.25 deg"
[friction]
law="bristle"
coefficient=0.239
bristle_stiffness="2000 1/m"
[[pulley]]
name="driver"
centre=["0.0 mm","0.0 mm"]
radius="50.7 mm"
speed="1500 rpm"
[[pulley]]
name="a"
centre=["370.7 mm","-12.6 mm"]
radius="67.2 mm"
torque="4.77 N*m"
[[pulley]]
name="b"
centre=["115.6 mm","205.8 mm"]
radius="73.2 mm"
torque="11.55 N*m"
[layout]
sense="counter-clockwise"
[load]
setup_tension="681 N"
"#;

#[test]
fn a_driver_that_slips_ever_more_at_every_speed_is_rated_at_gross_slip() {
    let file = DriveFile::read("three grooves", THREE_GROOVES, &[]).unwrap();
    let drive = file.drive().unwrap();
    let found = rated(&drive, RatingQuestion::default()).unwrap();
    assert!(matches!(found.end, RatingEnd::LiftsOff { .. }));
    // Up to where two thirds of the tension are left.
    assert!(found.points[..40].iter().all(|point| point.error < 3e-3));
    for load in [&found.optimum, found.stated.as_ref().unwrap()] {
        assert!(matches!(load.end, LoadEnd::GrowingSlip(0)), "{load:?}");
        assert_slip_grows(&found, load, 0);
    }
    // The margin of `check` is found from another state, and to another mesh.
    let checked = check(&file.service().unwrap(), &OPTIONS, &mut |_, _| {}).unwrap();
    let SlipMargin::Factor(margin) = checked.cases[0].outcome.as_ref().unwrap().slip_margin else {
        panic!("there is a margin");
    };
    let ratio = margin.value / found.stated.as_ref().unwrap().factor;
    assert!((ratio - 1.0).abs() < 2e-6, "{ratio}");
}

/// A soft belt that sinks ever deeper has a limit point at ten times its load, and slips by an eighth on the way there.
#[test]
fn a_v_belt_that_slips_grossly_long_before_its_last_state_is_rated_at_gross_slip() {
    let found = of_example("cvt-variator", &[]);
    assert!(matches!(found.end, RatingEnd::LiftsOff { .. }));
    for load in [&found.optimum, found.stated.as_ref().unwrap()] {
        let LoadEnd::GrowingSlip(pulley) = load.end else {
            panic!("{load:?}");
        };
        assert_eq!(found.drive.pulleys[pulley].name, "driven");
        assert_slip_grows(&found, load, pulley);
    }
    // Up to where the reason changes, near lift-off; the load falls by a tenth there.
    let known = &found.points[..=54];
    assert!(known.iter().all(|point| point.error < 1e-3));
    assert!(found.error < 0.15, "{}", found.error);
}

#[test]
fn the_answer_has_a_row_for_each_speed() {
    let found = of_example("serpentine", &[]);
    let answer = answer(&found);
    let rows = csv(&answer);
    assert_eq!(rows.lines().count(), found.points.len() + 1);
    assert!(
        rows.starts_with("speed_rad_per_s,torque_N_m,power_W"),
        "{rows}"
    );
    let json: serde_json::Value = serde_json::from_str(&json(&answer)).unwrap();
    // The reader of JSON is exact to a unit in the last place.
    let speed = json["optimum"]["speed_rad_per_s"].as_f64().unwrap();
    assert!((speed / found.optimum.speed - 1.0).abs() < 1e-15);
    assert_eq!(json["end"], "tensioner beyond travel");
    assert_eq!(json["points"].as_array().unwrap().len(), found.points.len());
    let torques = json["optimum"]["pulleys"].as_array().unwrap();
    assert_eq!(torques.len(), 4, "{torques:?}");
    for line in table(&answer, UnitSystem::Us).lines() {
        assert!(line.chars().count() <= 100, "{line}");
    }
}

fn command(arguments: &[&str]) -> Output {
    let program = env!("CARGO_BIN_EXE_beltdrive");
    Command::new(program).args(arguments).output().unwrap()
}

#[test]
fn the_command_says_what_is_wrong() {
    let path = |name: &str| format!("{}/examples/{name}.toml", env!("CARGO_MANIFEST_DIR"));
    let crossed = &*path("crossed");
    for (arguments, status, text) in [
        (
            &["--from", "2000 rpm", "--to", "1000 rpm"][..],
            2,
            "begin below its end",
        ),
        (&["--from", "2000 mm"], 2, "--from"),
        (&["--to", "many"], 2, "--to"),
        (&["--from", "90000 rpm"], 1, "lifts off"),
        (&["--set", "load.setup_tension=-3 N"], 2, "setup_tension"),
        (&["--from", "1000 rpm", "--to", "2000 rpm"], 0, ""),
    ] {
        let output = command(&[&["rating", crossed], arguments].concat());
        let errors = String::from_utf8_lossy(&output.stderr);
        assert_eq!(
            output.status.code(),
            Some(status),
            "{arguments:?}: {errors}"
        );
        assert!(errors.contains(text), "{arguments:?}: {errors}");
    }
}

/// Every shipped example with every law of its belt: a rating or a reason. A minute.
#[test]
#[ignore = "a minute"]
fn every_example_is_rated_or_refused_with_a_reason() {
    for example in &examples::EXAMPLES {
        for law in [
            &[
                "friction.law=coulomb",
                "friction.stiffness=",
                "friction.bristle_stiffness=",
            ][..],
            &["friction.law=epp", "friction.stiffness=1e7 N/m^2"],
            &[
                "friction.law=epp",
                "friction.stiffness=1e7 N/m^2",
                "friction.epp.kind=vector",
            ],
            &[
                "friction.law=bristle",
                "friction.bristle_stiffness=2000 1/m",
            ],
            &["friction.law=creep-rate", "friction.velocity=0.05 m/s"],
        ] {
            let overrides: Vec<_> = law.iter().map(|text| (*text).to_owned()).collect();
            let Ok(file) = DriveFile::read(example.name, example.text, &overrides) else {
                continue;
            };
            let Ok(drive) = file.drive() else { continue };
            let told = match rated(&drive, RatingQuestion::default()) {
                Ok(found) => {
                    assert!(found.optimum.power > 0.0);
                    format!(
                        "{:.6e} W at {:.6e} rad/s, error {:.0e}, {} missing",
                        found.optimum.power,
                        found.optimum.speed,
                        found.error,
                        found.missing.len()
                    )
                }
                Err(error) => error.to_string(),
            };
            println!("{} {law:?}: {told}", example.name);
        }
    }
}

/// Belts that lock in their grooves overhang at a load that hardly depends on the tension. As a share of that, which ends
/// at lift-off, it is no polynomial: torques between the speeds that were solved were negative, by 0.001.
#[test]
fn an_overhang_is_rated_between_the_speeds_that_were_solved() {
    for friction in ["0.6", "0.8"] {
        let overrides = [format!("friction.coefficient={friction}")];
        let found = of_example("spb-fan", &[&overrides[0]]);
        let loads = found.points.iter();
        let overhanging: Vec<_> = loads
            .filter(|load| matches!(load.end, LoadEnd::Overhangs(0)))
            .collect();
        assert!(overhanging.len() > 50, "{}", overhanging.len());
        let solved = found.stated.as_ref().unwrap().torque;
        // It falls slowly with speed.
        for load in &overhanging[..50] {
            assert!(load.error < 1e-2, "{load:?}");
            let ratio = load.torque / solved;
            assert!((0.97..1.01).contains(&ratio), "{load:?}");
        }
    }
}

/// Near lift-off polynomials through the limits at other speeds are off by far more than elsewhere, and say so.
#[test]
fn ratings_near_lift_off_are_within_their_errors() {
    for name in ["kim2009-bristle", "kim2009-epp"] {
        let found = of_example(name, &[]);
        let last = found.points.len() - 1;
        for index in [last - 1, last - 3, last - 6] {
            let point = &found.points[index];
            // The rating of the same belt where it is solved at this speed.
            let drive = loaded(&found, point.speed, 1.0);
            let question = RatingQuestion {
                from: Some(0.999 * point.speed),
                to: Some(1.0001 * point.speed),
            };
            let solved = rated(&drive, question).unwrap().stated.unwrap();
            let off = (point.factor / solved.factor - 1.0).abs();
            assert!(
                off <= 2.0 * point.error,
                "{name} {index}: {off:e} {point:?}"
            );
        }
        // Where most of the tension is left they are known well.
        assert!(found.points[..40].iter().all(|point| point.error < 3e-3));
    }
}
