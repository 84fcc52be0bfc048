//! `tension`: the setup tension that `check` confirms, and what follows from it.

use beltdrive::input::DriveFile;
use beltdrive::quantity::{UnitSystem, tension::answer};
use beltdrive::report::{csv, json, table};
use beltdrive::{
    Belt, BeltKind, Closure, Drive, Duty, FrictionLaw, LoadCase, NormalForce, Pulley, Sense,
    Service, Set, Setup, SetupQuestion, SlipMargin, SolveError, SolveOptions, check, examples,
    tension,
};
use std::f64::consts::PI;
use std::process::{Command, Output};

/// The load cases and requirements of an example with overrides.
fn service(example: &str, overrides: &[String]) -> Service {
    let example = examples::find(example).unwrap();
    let file = DriveFile::read(example.name, example.text, overrides).unwrap();
    file.service().unwrap()
}

fn asked(slip_margin: f64) -> SetupQuestion {
    SetupQuestion {
        slip_margin,
        elongation: 0.005,
        moved: None,
    }
}

fn set_up(service: &Service, question: SetupQuestion) -> Result<Setup, SolveError> {
    tension(service, question, &SolveOptions::default(), &mut |_, _| {})
}

/// The smallest slip margin of the load cases of an example with overrides, as `check` finds it.
fn margin(example: &str, overrides: &[String]) -> f64 {
    let found = check(
        &service(example, overrides),
        &SolveOptions::default(),
        &mut |_, _| {},
    );
    let margins =
        found
            .unwrap()
            .cases
            .into_iter()
            .map(|case| match case.outcome.unwrap().slip_margin {
                SlipMargin::Factor(margin) => margin.value,
                other => panic!("{other:?}"),
            });
    margins.fold(f64::INFINITY, f64::min)
}

/// The overrides that set up an example as found.
fn overrides(found: &Setup) -> Vec<String> {
    let set = match found.setting {
        Set::Tension(tension) => format!("load.setup_tension={tension:?}"),
        Set::FreeCoordinate { coordinate, .. } => {
            format!("tensioner.arm.free_angle={coordinate:?}")
        }
        Set::Weight(weight) => format!("tensioner.slide.weight={weight:?}"),
        other => panic!("{other:?}"),
    };
    vec![set]
}

#[test]
fn check_finds_the_asked_margin_on_flat_belts() {
    let drives = [
        "back-side-idler",
        "crossed",
        "serpentine-cases",
        "kim2009-flat",
    ];
    for example in drives {
        for asked_margin in [1.0, 1.2, 2.0, 5.0] {
            let found = set_up(&service(example, &[]), asked(asked_margin)).unwrap();
            assert!(found.ends_below.is_none());
            let mut set = overrides(&found);
            if example == "kim2009-flat" {
                // The torque that its span tensions have stands beside the setup tension.
                let Duty::Torque(torque) = found.checked.service.cases[0].drive.pulleys[1].duty
                else {
                    panic!("a torque")
                };
                set.extend([
                    "load.slack_tension=".to_owned(),
                    "load.tight_tension=".to_owned(),
                    format!("load.torque={torque:?}"),
                ]);
            }
            let margin = margin(example, &set);
            println!(
                "{example}, {asked_margin}: {:.1e}",
                margin / asked_margin - 1.0
            );
            assert!(margin >= asked_margin && margin < asked_margin * (1.0 + 1e-6));
        }
    }
}

#[test]
fn check_finds_the_asked_margin_on_v_belts() {
    for law in ["bristle", "coulomb"] {
        the_asked_margin_is_found("v-power", &format!("friction.law={law}"));
    }
}

fn the_asked_margin_is_found(example: &str, law: &str) {
    let law = [law.to_owned()];
    let found = set_up(&service(example, &law), asked(1.5)).unwrap();
    let margin = margin(example, &[&law[..], &overrides(&found)].concat());
    println!("{:.1e}", margin / 1.5 - 1.0);
    assert!(margin >= 1.5 && margin <= 1.5 * (1.0 + found.accuracy));
    assert!(found.accuracy < 1.01e-6);
    // The belt length that was found has this tension.
    let length = format!("load.belt_length={:?}", found.unstretched_length);
    let by_length = service(example, &[&law[..], &[length]].concat());
    let state = beltdrive::belt_loop::solve(&by_length.cases[0].drive).unwrap();
    assert!((state.rest_tension / found.tension - 1.0).abs() < 1e-5);
}

/// Two equal pulleys, each with a radius R, so that both slip at once; a belt without inertia that hardly stretches.
fn capstan(radius: f64, distance: f64, friction: f64, torque: f64) -> Drive {
    let pulley = |name, x, duty| Pulley::new(name, [x, 0.0], radius, friction, duty);
    Drive {
        title: None,
        belt: Belt {
            ribs: 1,
            mass_per_length: 1e-12,
            axial_stiffness: 1e12,
            kind: BeltKind::Flat {
                normal_force: NormalForce::Inertia,
            },
        },
        law: FrictionLaw::Coulomb,
        sense: Sense::CounterClockwise,
        turning_number: 1,
        pulleys: vec![
            pulley("driver", 0.0, Duty::Driver(1.0)),
            pulley("driven", distance, Duty::Torque(torque)),
        ],
        closure: Closure::SetupTension(1.0),
    }
}

#[test]
fn a_rigid_belt_without_inertia_needs_what_eulers_formula_says() {
    let (radius, distance, friction, torque) = (0.1, 0.7, 0.4, 30.0);
    let drive = capstan(radius, distance, friction, torque);
    let case = LoadCase {
        name: "only".to_owned(),
        share: None,
        drive,
    };
    let service = Service {
        cases: vec![case],
        ..service("back-side-idler", &[])
    };
    for margin in [1.0, 1.5, 3.0] {
        let found = set_up(&service, asked(margin)).unwrap();
        // At the limit both contacts slip wholly, from F to F exp(μπ). The length of the belt is kept, so that the
        // mean tension along it is the setup tension.
        let difference = margin * torque / radius;
        let slack = difference / (friction * PI).exp_m1();
        let on_pulleys = 2.0 * radius * difference / friction;
        let in_spans = distance * (2.0 * slack + difference);
        let known = (on_pulleys + in_spans) / (2.0 * (distance + PI * radius));
        println!(
            "{margin}: {} N, {:.1e}",
            found.tension,
            found.tension / known - 1.0
        );
        assert!((found.tension / known - 1.0).abs() < 2e-9);
    }
}

#[test]
fn the_case_that_needs_most_decides() {
    let all = service("serpentine-cases", &[]);
    let found = set_up(&all, asked(2.0)).unwrap();
    let alone = all.cases.iter().map(|case| {
        let service = Service {
            cases: vec![case.clone()],
            ..all.clone()
        };
        set_up(&service, asked(2.0)).unwrap().tension
    });
    let alone: Vec<_> = alone.collect();
    let largest = alone.iter().copied().fold(0.0, f64::max);
    assert!((found.tension / largest - 1.0).abs() < 1e-8, "{alone:?}");
    assert_eq!(alone[found.deciding_case], largest);
    // The order of the cases does not matter.
    let mut turned = all.clone();
    turned.cases.rotate_left(2);
    let again = set_up(&turned, asked(2.0)).unwrap();
    assert!((again.tension / found.tension - 1.0).abs() < 1e-8);
    assert_eq!(
        again.checked.service.cases[again.deciding_case].name,
        "parking on a hot day"
    );
}

#[test]
fn the_bands_are_what_check_finds() {
    let example = "back-side-idler";
    let found = set_up(&service(example, &[]), asked(2.0)).unwrap();
    let state = &found.checked.cases[0].outcome.as_ref().unwrap().state;
    // Elongation: the uniform strain of the belt at rest.
    let drive = &found.checked.service.cases[0].drive;
    let axial = drive.belt.axial_stiffness;
    let stretched = 1.0 + found.tension / axial;
    let before = axial * (stretched * 1.005 - 1.0);
    assert!((found.elongated.tension_before.unwrap() / before - 1.0).abs() < 1e-10);
    let left = axial * (stretched / 1.005 - 1.0);
    assert!(left < 0.0 && found.elongated.tension.is_err());
    assert!((state.unstretched_length - found.unstretched_length).abs() < 1e-12);
    let short = SetupQuestion {
        elongation: 1e-4,
        ..asked(2.0)
    };
    let short = set_up(&service(example, &[]), short).unwrap();
    let left = axial * (stretched / 1.0001 - 1.0);
    assert!((short.elongated.tension.unwrap() / left - 1.0).abs() < 1e-10);
    let set = format!("load.setup_tension={left:?}");
    let known = margin(example, &[set]);
    assert!((short.elongated.slip_margin.unwrap() / known - 1.0).abs() < 1e-8);
    // Friction.
    for other in &found.other_friction {
        let stated = service(example, &[]);
        let friction = stated.cases[0].drive.pulleys.iter().map(|pulley| {
            let value = pulley.friction_coefficient * other.factor;
            format!("pulley.{}.friction_coefficient={value:?}", pulley.name)
        });
        let friction: Vec<_> = friction.collect();
        let with = |tension: f64| {
            let set = format!("load.setup_tension={tension:?}");
            margin(example, &[&friction[..], &[set]].concat())
        };
        assert!((with(found.tension) / other.slip_margin.unwrap() - 1.0).abs() < 1e-9);
        assert!((with(*other.tension.as_ref().unwrap()) / 2.0 - 1.0).abs() < 1e-8);
    }
}

#[test]
fn the_travel_is_that_of_the_length_of_the_loop() {
    let question = SetupQuestion {
        moved: Some(2),
        ..asked(2.0)
    };
    let found = set_up(&service("back-side-idler", &[]), question).unwrap();
    let travel = found.travel.unwrap();
    let drive = &found.checked.service.cases[0].drive;
    let moved = |by: f64| {
        let mut drive = drive.clone();
        if let beltdrive::Mount::Fixed(centre) = &mut drive.pulleys[2].mount {
            for (part, along) in centre.iter_mut().zip(travel.direction) {
                *part += by * along;
            }
        }
        drive.layout(0.0).unwrap().length()
    };
    let free = moved(-travel.from_free.unwrap());
    assert!((free / found.unstretched_length - 1.0).abs() < 1e-12);
    let longer = moved(travel.for_elongation.unwrap());
    assert!((longer / moved(0.0) / 1.005 - 1.0).abs() < 1e-12);
    // Of two pulleys the driver is moved.
    let two = set_up(&service("crossed", &[]), asked(2.0)).unwrap();
    assert!(
        two.travel
            .is_some_and(|travel| travel.from_free.unwrap() > 0.0)
    );
    assert!(
        set_up(&service("back-side-idler", &[]), asked(2.0))
            .unwrap()
            .travel
            .is_none()
    );
}

#[test]
fn what_ends_below_the_answer_is_said() {
    let found = set_up(&service("conveyor", &[]), asked(2.0)).unwrap();
    assert!(matches!(
        found.ends_below,
        Some(SolveError::TensionerBeyondTravel { .. })
    ));
    let Set::Weight(weight) = found.setting else {
        panic!("{:?}", found.setting)
    };
    let with = |weight: f64| {
        let case = &found.checked.service.cases[0];
        let mut drive = case.drive.clone();
        for pulley in &mut drive.pulleys {
            if let beltdrive::Mount::Tensioner(tensioner) = &mut pulley.mount {
                tensioner.load = beltdrive::TensionerLoad::Weight(weight);
            }
        }
        beltdrive::belt_loop::solve(&drive)
    };
    assert!(with(weight).is_ok());
    assert!(with(weight * (1.0 - 1e-8)).is_err());
}

/// A V-belt between fixed centres runs with less tension at rest than centrifugal force takes up of it: at rest it lies
/// deeper. The lightly loaded one needs hardly more than that at which it lifts off.
#[test]
fn a_light_load_needs_the_tension_that_does_not_lift_off() {
    let overrides = [
        "pulleys.driver.speed=4500 rpm",
        "load.power=",
        "load.torque=0.01 N*m",
        "load.belt_length=",
        "load.setup_tension=300 N",
    ];
    let light = service("v-power", &overrides.map(str::to_owned));
    let found = set_up(&light, asked(1.5)).unwrap();
    assert!(matches!(
        found.ends_below,
        Some(SolveError::LiftsOff { .. })
    ));
    let drive = &found.checked.service.cases[0].drive;
    let rim = drive.pulleys[0].radius * 4500.0 * PI / 30.0;
    let centrifugal = drive.belt.mass_per_length * rim * rim;
    let Set::Tension(tension) = found.setting else {
        panic!("{:?}", found.setting)
    };
    assert!(tension < 0.9 * centrifugal, "{tension} {centrifugal}");
    let with = |share: f64| {
        let mut drive = drive.clone();
        drive.closure = Closure::SetupTension(share * tension);
        beltdrive::belt_loop::solve(&drive)
    };
    assert!(with(1.0).is_ok());
    assert!(matches!(with(1.0 - 3e-4), Err(SolveError::LiftsOff { .. })));
}

/// Where a first tension would press the belt through its grooves it is sought from a lower one. The margin of this soft belt
/// jumps from 0.8 to 1.7, and with less friction no tension is enough.
#[test]
fn a_start_that_presses_the_belt_through_its_grooves_is_lowered() {
    let soft = "belt.radial_stiffness=1.7 N/mm^2".to_owned();
    let found = set_up(&service("v-power", &[soft]), asked(1.2)).unwrap();
    let shown = table(&answer(&found), UnitSystem::Engineering);
    for text in [
        "with less tension it slips below 1.2 times the load",
        "pressed through groove",
    ] {
        assert!(shown.contains(text), "{shown}");
    }
    let drive = &found.checked.service.cases[0].drive;
    let margin = |share: f64| {
        let mut drive = drive.clone();
        drive.closure = Closure::SetupTension(share * found.tension);
        let state = beltdrive::belt_loop::solve_with_margins(&drive, &SolveOptions::default());
        state.map(|state| state.load_limit.unwrap().factor)
    };
    assert!(margin(1.0).unwrap() > 1.6);
    // The jump is known as accurately as it is told.
    assert!(found.accuracy <= 1e-3, "{}", found.accuracy);
    let below = margin(1.0 - found.accuracy);
    assert!(below.map_or(true, |margin| margin < 1.0));
}

/// Runs the program on a text from standard input.
fn run(arguments: &[&str], text: &str) -> Output {
    use std::io::Write;
    let mut program = Command::new(env!("CARGO_BIN_EXE_beltdrive"))
        .args(arguments)
        .stdin(std::process::Stdio::piped())
        .stdout(std::process::Stdio::piped())
        .stderr(std::process::Stdio::piped())
        .spawn()
        .unwrap();
    let mut input = program.stdin.take().unwrap();
    // A fault of the command line ends the program before it reads.
    input.write_all(text.as_bytes()).ok();
    drop(input);
    program.wait_with_output().unwrap()
}

#[test]
fn faults_of_the_question_are_said_in_one_error() {
    let text = examples::find("back-side-idler").unwrap().text;
    let serpentine = examples::find("serpentine-cases").unwrap().text;
    let cases: [(&[&str], &str, &str); 8] = [
        (&[], text, "no slip margin is asked for"),
        (&["--margin", "0.9"], text, "at least 1"),
        (&["--margin", "two"], text, "not a number"),
        (
            &["--margin", "2", "--elongation", "2 mm"],
            text,
            "not a share",
        ),
        (
            &["--margin", "2", "--elongation", "100 %"],
            text,
            "below 100 %",
        ),
        (
            &["--margin", "2", "--move", "moter"],
            text,
            "did you mean `motor`?",
        ),
        (
            &["--move", "crankshaft"],
            serpentine,
            "which the tensioner does",
        ),
        (
            &["--margin", "2", "--set", "pulley.fan.power=0"],
            text,
            "none slips",
        ),
    ];
    for (arguments, text, word) in cases {
        let arguments = [&["tension", "-"], arguments].concat();
        let output = run(&arguments, text);
        let message = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(2), "{word}: {message}");
        assert!(message.contains(word), "{word}: {message}");
        println!("{message}");
    }
}

#[test]
fn the_exit_status_tells_of_other_requirements() {
    let text = examples::find("serpentine-cases").unwrap().text;
    let status = |overrides: &[&str]| {
        let mut arguments = vec!["tension", "-"];
        arguments.extend(overrides.iter().flat_map(|text| ["--set", text]));
        run(&arguments, text).status.code()
    };
    assert_eq!(status(&[]), Some(3));
    assert_eq!(status(&["requirements.largest_speed_loss="]), Some(0));
}

#[test]
fn tables_and_files_hold_the_answer() {
    let found = set_up(&service("serpentine-cases", &[]), asked(2.0)).unwrap();
    let answer = answer(&found);
    let text = table(&answer, UnitSystem::Engineering);
    assert!(text.contains("pulley `crankshaft` decides in the load case `parking on a hot day`"));
    assert!(text.lines().all(|line| line.chars().count() <= 100));
    assert_eq!(csv(&answer).lines().count(), 4);
    let all: serde_json::Value = serde_json::from_str(&json(&answer)).unwrap();
    assert_eq!(all["setup"]["tension_N"], found.tension);
    assert_eq!(all["setup"]["deciding_case"], "parking on a hot day");
    assert_eq!(all["setup"]["slips_first"], "crankshaft");
    assert_eq!(all["friction"][0]["factor"], 0.8);
    assert_eq!(all["spans"][0]["from_pulley"], "crankshaft");
    let span = &found.checked.cases[0].outcome.as_ref().unwrap().state.spans[0];
    assert_eq!(all["spans"][0]["rest_frequency_Hz"], span.rest_frequency);
}
