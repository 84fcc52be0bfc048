//! Flat belts round n pulleys: computed cases, invariants, symmetries and random loops.

#[path = "belt_loops/cases.rs"]
mod cases;
#[path = "belt_loops/invariants.rs"]
mod invariants;
#[path = "belt_loops/random.rs"]
mod random;
#[path = "support/random.rs"]
mod random_numbers;

use beltdrive::belt_loop::{self, LoopState, Varied, solve};
use beltdrive::flat::ClosedForm;
use beltdrive::input::{Argument, DriveFile, Key};
use beltdrive::{
    Belt, BeltKind, Closure, Drive, Duty, FrictionLaw, Guide, Layout, LayoutError, Load, Mount,
    NormalForce, Pulley, Role, Sense, Side, SolveError, SolveOptions, SpanTension, Tensioner,
    TensionerLoad, TwoPulleys, examples, limits,
};
use invariants::{close, hold};

fn belt() -> Belt {
    Belt {
        ribs: 1,
        mass_per_length: 0.14,
        axial_stiffness: 1e5,
        kind: BeltKind::Flat {
            normal_force: NormalForce::Inertia,
        },
    }
}

fn pulley(name: &str, centre: [f64; 2], radius: f64, side: Side, duty: Duty) -> Pulley {
    Pulley {
        side,
        ..Pulley::new(name, centre, radius, 0.6, duty)
    }
}

fn two(law: FrictionLaw, closure: Closure) -> Drive {
    let inside = Side::Inside;
    Drive {
        title: None,
        belt: belt(),
        law,
        sense: Sense::CounterClockwise,
        turning_number: 1,
        pulleys: vec![
            pulley("driver", [0.0, 0.0], 0.06, inside, Duty::Driver(150.0)),
            pulley("driven", [0.5, 0.1], 0.11, inside, Duty::Torque(25.0)),
        ],
        closure,
    }
}

/// Where the idler of [`tensioned`] rests, m.
const AT_REST: f64 = 0.13;

/// A driver, a load, and an idler on a straight guide that pushes the slack span inwards.
fn tensioned(closure: Closure, law: FrictionLaw) -> Drive {
    let mut drive = two(law, closure);
    let tensioner = Tensioner {
        guide: Guide::Translating {
            origin: [0.25, -0.15],
            direction: [0.0, 1.0],
        },
        load: TensionerLoad::Spring {
            stiffness: 2e3,
            free_coordinate: 0.22,
        },
        start_coordinate: AT_REST,
        travel: None,
    };
    let mut idler = pulley("idler", [0.0; 2], 0.03, Side::Outside, Duty::Torque(0.0));
    idler.mount = Mount::Tensioner(tensioner);
    drive.pulleys.insert(1, idler);
    drive
}

fn solved(drive: &Drive) -> LoopState {
    let state = solve(drive).unwrap_or_else(|error| panic!("{error}\n{drive:?}"));
    hold(drive, &state);
    state
}

const LAWS: [FrictionLaw; 3] = [
    FrictionLaw::Coulomb,
    FrictionLaw::Epp { stiffness: 1.2e8 },
    FrictionLaw::CreepRate { velocity: 0.01 },
];

/// Every law with every convention that it can have.
fn laws_and_conventions() -> impl Iterator<Item = (FrictionLaw, NormalForce)> {
    let pairs = LAWS
        .into_iter()
        .flat_map(|law| NormalForce::ALL.map(|normal| (law, normal)));
    let is_excluded = |(law, normal): &(FrictionLaw, NormalForce)| {
        matches!(law, FrictionLaw::CreepRate { .. }) && *normal == NormalForce::Thesis
    };
    pairs.filter(move |pair| !is_excluded(pair))
}

fn with(mut drive: Drive, normal_force: NormalForce) -> Drive {
    drive.belt.kind = BeltKind::Flat { normal_force };
    drive
}

#[test]
fn two_pulleys_are_the_drive_with_two_pulleys() {
    let mut slacker = Vec::new();
    for (law, normal_force) in laws_and_conventions() {
        let drive = with(two(law, Closure::SetupTension(350.0)), normal_force);
        let state = solved(&drive);
        let [slack, tight] = [&state.spans[0], &state.spans[1]];
        let drive = TwoPulleys {
            belt: drive.belt,
            friction_coefficient: 0.6,
            law,
            driver_radius: 0.06,
            driver_speed: 150.0,
            driven_radius: 0.11,
            centre_distance: 0.5_f64.hypot(0.1),
            load: Load {
                slack: SpanTension::Belt(slack.tension),
                tight: SpanTension::DrivenTorque(25.0),
            },
        };
        let closed = ClosedForm::new(&drive.into()).unwrap();
        close("c", state.unstretched_speed, closed.speed(), 1e-13);
        close("T", tight.tension, closed.tension()[1], 1e-12);
        for (pulley, found) in [(Role::Driver, 0), (Role::Driven, 1)] {
            let found = &state.pulleys[found];
            close(
                "w",
                found.angular_speed,
                closed.angular_speed(pulley),
                1e-13,
            );
            close(
                "T_o",
                found.reference_tension.unwrap(),
                closed.reference_tension(pulley),
                1e-11,
            );
            let first = closed.zones(pulley)[0].to;
            close("first zone", found.no_slip_arc, first, 1e-10);
        }
        slacker.push(slack.tension);
        let again = solve(&drive.into()).unwrap();
        for (found, known) in again.spans.iter().zip(&state.spans) {
            close("F", found.tractive_tension, known.tractive_tension, 1e-11);
        }
        close(
            "L_0",
            again.unstretched_length,
            state.unstretched_length,
            1e-12,
        );
        // The loop carries what the drive carries: the limit at a held slack tension is the margin, in the
        // convention `thesis` but for the speed, which falls with the load.
        let margin = state.pulleys[0].torque_margin.unwrap();
        let at = |torque: f64| {
            let mut drive = drive;
            drive.load.slack = match normal_force {
                NormalForce::Thesis => SpanTension::Belt(slack.tension),
                _ => SpanTension::Tractive(slack.tractive_tension),
            };
            drive.load.tight = SpanTension::DrivenTorque(torque);
            drive.law = FrictionLaw::Coulomb;
            ClosedForm::new(&drive.into())
        };
        let within = match normal_force {
            NormalForce::Thesis => 1e-5,
            NormalForce::Inertia | NormalForce::Exact => 1e-9,
        };
        assert!(at(25.0 * margin * (1.0 - within)).is_ok());
        assert!(at(25.0 * margin * (1.0 + within)).is_err());
    }
    // Only where nothing is elastic or depends on speed the conventions `inertia` and `exact` are the same.
    slacker.sort_by(f64::total_cmp);
    let off = |pair: &[f64]| pair[1] / pair[0] - 1.0;
    let different = slacker.windows(2).filter(|pair| off(pair) > 1e-9).count();
    assert_eq!(different, 5, "{slacker:?}");
}

#[test]
fn a_drive_closed_by_both_tensions_has_the_same_limits_as_a_loop() {
    let example = examples::find("kim2009-flat").unwrap();
    // The load limit of a loop is that of Coulomb friction.
    let law = ["friction.law=coulomb".to_owned()];
    let file = DriveFile::read(example.name, example.text, &law).unwrap();
    let drive = file.drive().unwrap();
    let (key, options) = (Key::load(&drive), SolveOptions::default());
    let as_loop = |varied: &Varied| {
        let limits = belt_loop::limits(&file, varied, &options, &mut |_, _| {});
        limits.unwrap().largest
    };
    let argument = Argument {
        option: "--parameter",
        value: key.path(),
    };
    let found = as_loop(&Varied::Key(file.key(argument).unwrap()));
    let known = limits(&drive, &key, &options, &mut |_, _| {}).unwrap();
    close("limit", found.point.value, known.largest.value, 1e-9);
    assert_eq!(found.end.kind(), "gross slip");
    // Its torque alone can be raised up to the limit of the closure by the slack tension.
    let limit = solve(&drive).unwrap().load_limit.unwrap();
    let found = as_loop(&Varied::LoadFactor);
    close("factor", found.point.value, limit.factor, 1e-9);
}

#[test]
fn closures_of_the_same_loop_agree() {
    for (law, normal_force) in laws_and_conventions() {
        let two = |law, closure| with(two(law, closure), normal_force);
        let tensioned = |closure, law| with(tensioned(closure, law), normal_force);
        let state = solved(&two(law, Closure::SetupTension(350.0)));
        let length = Closure::UnstretchedLength(state.unstretched_length);
        let found = solved(&two(law, length));
        agree(&found, &state, 1e-11);
        same_limit(&found, &state, 1e-10);
        let tension = state.spans[1].tension;
        let tension = Closure::SpanTension { span: 1, tension };
        agree(&solved(&two(law, tension)), &state, 1e-11);
        let tension = state.spans[1].tractive_tension;
        let tension = Closure::SpanTractiveTension { span: 1, tension };
        agree(&solved(&two(law, tension)), &state, 1e-11);
        let state = solved(&tensioned(Closure::RestCoordinate(AT_REST), law));
        let tensioner = state.tensioner.as_ref().unwrap();
        assert!((tensioner.coordinate - tensioner.rest_coordinate).abs() > 1e-4);
        let closures = [
            Closure::UnstretchedLength(state.unstretched_length),
            Closure::SetupTension(state.rest_tension),
            Closure::SpanTension {
                span: 2,
                tension: state.spans[2].tension,
            },
        ];
        for closure in closures {
            let other = solved(&tensioned(closure, law));
            agree(&other, &state, 1e-10);
            let found = other.tensioner.unwrap();
            close("q", found.coordinate, tensioner.coordinate, 1e-11);
            close(
                "q_r",
                found.rest_coordinate,
                tensioner.rest_coordinate,
                1e-11,
            );
        }
    }
}

/// Whether two states have the same numbers on the same pulleys.
fn agree(one: &LoopState, other: &LoopState, within: f64) {
    close("G", one.mass_flow, other.mass_flow, within);
    close(
        "L_0",
        one.unstretched_length,
        other.unstretched_length,
        within,
    );
    close("T_rest", one.rest_tension, other.rest_tension, within);
    for (one, other) in one.spans.iter().zip(&other.spans) {
        close("T", one.tension, other.tension, within);
        close("F", one.tractive_tension, other.tractive_tension, within);
        close("length", one.length, other.length, within);
        let forces = [one.deflection_force, other.deflection_force];
        if let [Some(one), Some(other)] = forces {
            close("deflection force", one, other, 100.0 * within);
        }
    }
    for (one, other) in one.pulleys.iter().zip(&other.pulleys) {
        assert!((one.wrap - other.wrap).abs() < within);
        assert!((one.speed_loss - other.speed_loss).abs() < within);
        close("speed", one.angular_speed, other.angular_speed, within);
        assert!((one.slip_arc - other.slip_arc).abs() < 100.0 * within);
    }
}

/// Whether two states of one closure have the same load limit.
fn same_limit(one: &LoopState, other: &LoopState, within: f64) {
    let [one, other] = [one, other].map(|state| state.load_limit.as_ref().expect("a limit").factor);
    close("load limit", one, other, within);
}

#[test]
fn a_power_is_the_torque_at_the_speed_of_its_pulley() {
    for law in LAWS {
        let mut drive = tensioned(Closure::SetupTension(350.0), law);
        let state = solved(&drive);
        drive.pulleys[2].duty = Duty::Power(state.pulleys[2].power);
        let found = solved(&drive);
        agree(&found, &state, 1e-12);
        assert!((found.pulleys[2].power / state.pulleys[2].power - 1.0).abs() < 1e-13);
        // Creep brings the driven pulley to a standstill before it takes any power.
        drive.pulleys[2].duty = Duty::Power(1e5);
        assert!(matches!(solve(&drive), Err(SolveError::GrossSlip { .. })));
    }
}

#[test]
fn a_weight_is_carried_by_the_belt_whatever_the_speed() {
    let closure = Closure::RestCoordinate(AT_REST);
    let mut drive = tensioned(closure, FrictionLaw::Coulomb);
    let Mount::Tensioner(tensioner) = &mut drive.pulleys[1].mount else {
        panic!("the second pulley is the idler");
    };
    tensioner.load = TensionerLoad::Weight(300.0);
    for speed in [20.0, 200.0] {
        drive.pulleys[0].duty = Duty::Driver(speed);
        let state = solved(&drive);
        hold(&drive, &state);
        let [_, up] = state.pulleys[1].hub_load;
        assert!((up + 300.0).abs() < 1e-9, "{up}");
    }
}

#[test]
fn profiles_end_at_the_tensions_of_the_spans() {
    for (law, normal_force) in laws_and_conventions() {
        let drive = tensioned(Closure::SetupTension(350.0), law);
        let drive = with(drive, normal_force);
        let state = solved(&drive);
        for (index, pulley) in state.pulleys.iter().enumerate() {
            let profile = state.profile(index);
            let ends = [(index + 2) % 3, index].map(|span| state.spans[span].tension);
            let last = profile.tension.len() - 1;
            close("entry", profile.tension[0], ends[0], 1e-12);
            close("exit", profile.tension[last], ends[1], 1e-11);
            close("wrap", profile.angle[last], pulley.wrap, 1e-12);
            close("zones", pulley.zones.last().unwrap().to, pulley.wrap, 1e-12);
            assert_eq!(pulley.zones[0].from, 0.0);
            let steps = profile
                .arc_length
                .windows(2)
                .zip(profile.friction_force.windows(2));
            let moment = steps.map(|(s, f)| 0.5 * (s[1] - s[0]) * (f[0] + f[1]));
            let moment = moment.sum::<f64>() * drive.pulleys[index].radius;
            let scale = pulley.torque.abs().max(1e-9);
            assert!(
                (moment - pulley.torque.abs()).abs() < 1e-4 * scale,
                "{moment}"
            );
        }
    }
}

#[test]
fn start_of_the_loop_and_the_mirror_change_nothing() {
    for (_, drive, _) in cases::read() {
        let Ok(state) = solve(&drive) else {
            continue;
        };
        for first in 1..drive.pulleys.len() {
            let mut turned = drive.clone();
            turned.pulleys.rotate_left(first);
            let mut found = solved(&turned);
            found.pulleys.rotate_right(first);
            found.spans.rotate_right(first);
            agree(&found, &state, 1e-12);
            same_limit(&found, &state, 1e-11);
        }
        let found = solved(&mirrored(&drive));
        agree(&found, &state, 1e-12);
        same_limit(&found, &state, 1e-11);
    }
}

/// The loop with y reversed.
fn mirrored(drive: &Drive) -> Drive {
    let mut mirrored = drive.clone();
    mirrored.sense = match drive.sense {
        Sense::Clockwise => Sense::CounterClockwise,
        Sense::CounterClockwise => Sense::Clockwise,
    };
    for pulley in &mut mirrored.pulleys {
        match &mut pulley.mount {
            Mount::Fixed([_, y]) => *y = -*y,
            Mount::Tensioner(tensioner) => match &mut tensioner.guide {
                Guide::Rotary { pivot, .. } => {
                    pivot[1] = -pivot[1];
                    if let TensionerLoad::Spring {
                        free_coordinate, ..
                    } = &mut tensioner.load
                    {
                        *free_coordinate = -*free_coordinate;
                    }
                    tensioner.start_coordinate = -tensioner.start_coordinate;
                    tensioner.travel = tensioner.travel.map(|[low, high]| [-high, -low]);
                    if let Closure::RestCoordinate(coordinate) = &mut mirrored.closure {
                        *coordinate = -*coordinate;
                    }
                }
                Guide::Translating { origin, direction } => {
                    origin[1] = -origin[1];
                    direction[1] = -direction[1];
                }
            },
        }
    }
    mirrored
}

#[test]
fn the_tensioner_constant_is_the_change_of_tension_with_speed() {
    let at = |speed: f64| {
        let mut drive = tensioned(Closure::RestCoordinate(AT_REST), FrictionLaw::Coulomb);
        drive.pulleys[0].duty = Duty::Driver(speed);
        drive.pulleys[2].duty = Duty::Torque(0.0);
        let state = solved(&drive);
        assert!(state.load_limit.is_none() && state.efficiency.is_none());
        let span = &state.spans[0];
        let momentum = state.mass_flow * span.speed;
        (
            span.tractive_tension,
            momentum,
            state.tensioner.unwrap().constant,
        )
    };
    let [low, middle, high] = [149.0, 150.0, 151.0].map(at);
    let slope = (high.0 - low.0) / (high.1 - low.1);
    assert!(
        (slope + 1.0 - middle.2).abs() < 1e-5,
        "{slope} {}",
        middle.2
    );
}

#[test]
fn length_gradients_are_derivatives() {
    for (name, drive, _) in cases::read() {
        let coordinate = -1.5;
        let layout = drive.layout(coordinate).unwrap();
        for index in 0..drive.pulleys.len() {
            let gradient = layout.length_gradient(index);
            for (part, slope) in gradient.into_iter().enumerate() {
                let at = |step: f64| {
                    let mut pulleys = layout.pulleys().to_vec();
                    pulleys[index].centre[part] += step;
                    let moved = Layout::new(drive.sense, drive.turning_number, pulleys);
                    moved.unwrap().length()
                };
                let difference = (at(1e-5) - at(-1e-5)) / 2e-5;
                assert!((difference - slope).abs() < 1e-8, "{name} {index} {part}");
            }
        }
    }
}

#[test]
fn refusals_come_in_order_and_name_the_pulley() {
    let setup = Closure::SetupTension(350.0);
    let refused = |drive: &Drive| solve(drive).expect_err("a refusal");
    let mut drive = two(FrictionLaw::Coulomb, setup);
    let overlapping = pulley("idler", [0.1, 0.0], 0.05, Side::Inside, Duty::Torque(0.0));
    drive.pulleys.push(overlapping);
    let overlap = refused(&drive);
    assert!(
        matches!(&overlap, SolveError::Layout(LayoutError::Overlap { one, other, .. })
            if one == "driver" && other == "idler")
    );
    // Outside the loop, but away from the belt.
    drive.pulleys[2] = pulley("idler", [0.2, 0.4], 0.05, Side::Outside, Duty::Torque(0.0));
    let missed = refused(&drive);
    assert!(
        matches!(&missed, SolveError::Layout(LayoutError::NegativeWrap { pulley, wrap })
            if pulley == "idler" && *wrap < 0.0 && *wrap > -1.5),
        "{missed}"
    );
    // The idler pushes its two spans so far inwards that it reaches the opposite span.
    drive.pulleys[1] = pulley("driven", [1.0, 0.0], 0.06, Side::Inside, Duty::Torque(0.0));
    drive.pulleys[2] = pulley("deep", [0.5, -0.05], 0.04, Side::Outside, Duty::Torque(0.0));
    let top = pulley("top", [0.5, 0.8], 0.06, Side::Inside, Duty::Torque(0.0));
    drive.pulleys.push(top);
    let through = refused(&drive);
    assert!(
        matches!(&through, SolveError::Layout(LayoutError::SpanThroughPulley { from, to, pulley })
            if from == "driver" && to == "driven" && pulley == "deep"),
        "{through}"
    );
    drive.turning_number = 2;
    drive.pulleys.truncate(2);
    let turns = refused(&drive);
    assert!(matches!(
        turns,
        SolveError::Layout(LayoutError::TurningNumber {
            stated: 2,
            found: 1
        })
    ));

    let state = solved(&two(FrictionLaw::Coulomb, setup));
    let long = Closure::UnstretchedLength(1.01 * state.length);
    assert!(matches!(
        refused(&two(FrictionLaw::Coulomb, long)),
        SolveError::Slack { tension } if tension < 0.0
    ));
    let mut fast = two(FrictionLaw::Coulomb, setup);
    fast.pulleys[0].duty = Duty::Driver(1500.0);
    assert!(matches!(
        refused(&fast),
        SolveError::LiftsOff { tractive_tension, .. } if tractive_tension < 0.0
    ));
    let mut stopped = tensioned(Closure::RestCoordinate(AT_REST), FrictionLaw::Coulomb);
    let Mount::Tensioner(tensioner) = &mut stopped.pulleys[1].mount else {
        panic!("the idler")
    };
    tensioner.travel = Some([0.0, AT_REST + 1e-4]);
    let beyond = refused(&stopped);
    assert!(
        matches!(&beyond, SolveError::TensionerBeyondTravel { pulley, coordinate, .. }
            if pulley == "idler" && *coordinate > AT_REST + 1e-4)
    );
    // So large a torque that even the formal state does not press on the pulleys.
    let mut heavy = two(FrictionLaw::Coulomb, setup);
    heavy.pulleys[1].duty = Duty::Torque(1e3);
    assert!(matches!(
        refused(&heavy),
        SolveError::GrossSlip { formal: None, margin: None, load_factor, .. } if load_factor < 0.1
    ));
    // Friction that does not know of the inertia of the belt carries a load at which the belt lifts off.
    let tension = 0.14 * 9.0 * 9.0 + 1.0;
    let closure = Closure::SpanTension { span: 0, tension };
    let mut loose = with(two(FrictionLaw::Coulomb, closure), NormalForce::Thesis);
    loose.pulleys[1].duty = Duty::Torque(3.0);
    assert!(solve(&loose).is_ok());
    loose.closure = Closure::SpanTension {
        span: 1,
        tension: 3.0 / 0.11 + tension - 2.0,
    };
    let lifted = refused(&loose);
    assert!(
        matches!(lifted, SolveError::LiftsOff { is_loaded: true, tractive_tension, .. }
            if tractive_tension < 0.0 && tractive_tension > -3.0),
        "{lifted}"
    );
    let creep = FrictionLaw::CreepRate { velocity: 0.01 };
    let blind = refused(&with(two(creep, setup), NormalForce::Thesis));
    assert!(matches!(&blind, SolveError::Statement { problem, .. } if problem.contains("thesis")));
    let mut bad = two(FrictionLaw::Coulomb, setup);
    bad.pulleys[1].friction_coefficient = f64::NAN;
    assert!(matches!(refused(&bad), SolveError::Statement { subject, .. } if subject == "driven"));
}
