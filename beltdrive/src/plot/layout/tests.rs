use super::super::occupied::Frame;
use super::super::profiles;
use super::super::tests::check;
use super::model::Point;
use super::*;
use crate::belt_loop::solve;
use crate::input;
use crate::quantity::{belt_loop, two_pulleys};
use crate::results::samples::{flat, v_belt};
use crate::{
    Belt, BeltKind, Closure, Drive, Duty, FrictionLaw, NormalForce, Pulley, Sense, Side,
    SteadyState, examples,
};
use std::f64::consts::TAU;

fn example(name: &str) -> Drive {
    input::parse(name, examples::find(name).unwrap().text, &[]).unwrap()
}

/// A loop without its torques.
fn idle(mut drive: Drive) -> Drive {
    for pulley in &mut drive.pulleys {
        match pulley.duty {
            Duty::Driver(_) => {}
            _ => pulley.duty = Duty::Torque(0.0),
        }
    }
    drive
}

fn pulley(name: &str, centre: [f64; 2], radius: f64, side: Side, duty: Duty) -> Pulley {
    Pulley {
        side,
        ..Pulley::new(name, centre, radius, 0.6, duty)
    }
}

fn round_pulleys(title: &str, turning_number: u32, pulleys: Vec<Pulley>) -> Drive {
    Drive {
        title: Some(title.to_owned()),
        belt: Belt {
            ribs: 1,
            mass_per_length: 0.3,
            axial_stiffness: 200e3,
            kind: BeltKind::Flat {
                normal_force: NormalForce::Inertia,
            },
        },
        law: FrictionLaw::Coulomb,
        sense: Sense::Clockwise,
        turning_number,
        pulleys,
        closure: Closure::SetupTension(900.0),
    }
}

/// Pulleys on a circle, every third one an idler on the back, two of them driving, with names of 25 letters.
fn ring(count: u32) -> Drive {
    let pulleys = (0..count).map(|index| {
        let angle = -0.25 * TAU - TAU * f64::from(index) / f64::from(count);
        let (side, radius, at) = match index % 3 {
            // Just inside the span between its neighbours.
            1 if count > 4 && index + 1 < count => {
                let middle = 0.5 * (TAU / f64::from(count)).cos();
                (Side::Outside, 0.03, middle + 0.02)
            }
            _ => (Side::Inside, 0.05 + 0.01 * f64::from(index % 4), 0.5),
        };
        let duty = match index {
            0 => Duty::Driver(40.0),
            2 => Duty::Torque(-8.0),
            _ if side == Side::Outside => Duty::Torque(0.0),
            _ => Duty::Torque(5.0),
        };
        let name = format!("pulley with long name {index:3}");
        assert_eq!(name.len(), 25);
        let centre = [at * angle.cos(), at * angle.sin()];
        pulley(&name, centre, radius, side, duty)
    });
    round_pulleys("Ring", 1, pulleys.collect())
}

/// Two pulleys of these radii, whose distance and torque are given.
fn pair(radii: [f64; 2], distance: f64, torque: f64, side: Side) -> Drive {
    let turning_number = u32::from(side == Side::Inside);
    let [one, other] = radii;
    let pulleys = vec![
        pulley("driver", [0.0; 2], one, Side::Inside, Duty::Driver(100.0)),
        pulley(
            "driven",
            [distance, 0.1 * distance],
            other,
            side,
            Duty::Torque(torque),
        ),
    ];
    round_pulleys("Two pulleys", turning_number, pulleys)
}

fn loops() -> Vec<Drive> {
    let mut loops: Vec<_> = ["serpentine", "crossed", "back-side-idler", "conveyor"]
        .map(example)
        .into();
    loops.push(idle(example("serpentine")));
    loops.extend((3..=9).map(ring));
    loops.push(pair([0.009, 0.13], 0.29, 2.0, Side::Inside));
    loops.push(pair([0.001, 0.3], 0.9, 0.5, Side::Inside));
    loops.push(pair([0.1, 0.1], 60.0, 10.0, Side::Inside));
    loops.push(pair([0.1, 0.1], 60.0, 10.0, Side::Outside));
    let mut named = pair([0.01, 0.1], 0.3, 2.0, Side::Inside);
    named.pulleys[0].name = "a name of more words than a label has room for on one line".repeat(2);
    loops.push(named);
    loops.push(pair([0.05, 0.08], 0.15, 0.0, Side::Inside));
    loops
}

/// The answers of the loops, and of drives with two pulleys.
fn answers() -> Vec<Answer> {
    let loops = loops().into_iter().map(|stated| {
        let state = solve(&stated).unwrap_or_else(|error| panic!("{error}: {stated:?}"));
        belt_loop::answer(&stated, &state)
    });
    let mut answers: Vec<_> = loops.collect();
    answers.extend(drives().iter().map(two_pulleys::drawn));
    answers
}

fn drives() -> [SteadyState; 6] {
    [
        v_belt::loaded(),
        v_belt::idle(),
        v_belt::overhanging(),
        flat::epp(),
        flat::coulomb(),
        flat::creep(),
    ]
}

/// Places at most 1 px apart along a line.
fn along([start, end]: [Spot; 2]) -> impl Iterator<Item = Spot> {
    let steps = (end - start).norm().ceil().max(1.0);
    let parts = (0..).map(move |step| f64::from(step) / steps);
    parts
        .take_while(|part| *part <= 1.0)
        .map(move |part| start.lerp(&end, part))
}

/// Places on the rim of every pulley, within its disc, on every span and on the arrows.
fn drawn(view: &View<'_>) -> Vec<Spot> {
    let pulleys = &view.drawn.pulleys;
    let spans = (0..pulleys.len()).map(|index| view.span(index));
    let loads = pulleys.iter().flat_map(|pulley| {
        let loads = pulley.hub_loads.iter().flatten();
        loads.map(|load| view.hub_load(pulley, *load))
    });
    let tensioner = view.drawn.tensioner.iter();
    let tensioner = tensioner.map(|tensioner| view.guide(tensioner));
    let lines = spans.chain(loads).chain(tensioner).flat_map(along);
    let discs = pulleys.iter().flat_map(|pulley| {
        let (centre, radius) = (view.at(pulley.centre), view.scale * pulley.radius);
        (0..720).flat_map(move |step| {
            let out = super::super::sheet::unit(TAU * f64::from(step) / 720.0);
            [1.0, 0.7, 0.4].map(|part| centre + part * radius * out)
        })
    });
    let arrowheads = view.arrowheads.iter().flatten().copied();
    lines.chain(discs).chain(arrowheads).collect()
}

#[test]
fn labels_cover_nothing_and_leaders_pass_labels() {
    for answer in answers() {
        let (title, drawn_loop) = (&answer.heading, Loop::of(&answer));
        let (_, view, labels) = placed(&drawn_loop, |width| {
            Header::new(&answer, "Steady state", legend(&answer, &drawn_loop), width)
        });
        let count = answer.subjects("pulleys").len();
        let tensioners = answer.subjects("tensioner").len();
        assert_eq!(labels.len(), 2 * count + tensioners, "{title:?}");
        let inside = |frame: Frame, place: Spot| frame.from <= place && place <= frame.to;
        let drawn = drawn(&view);
        for (index, label) in labels.iter().enumerate() {
            let frame = label.place.frame;
            assert!(view.frame.contains(&frame), "{title:?}: {label:?}");
            let covered = drawn.iter().find(|place| inside(frame, **place));
            assert_eq!(covered, None, "{title:?}: {label:?}");
            for (other, label) in labels.iter().enumerate() {
                if other != index {
                    assert!(!frame.meets(&label.place.frame), "{title:?}: {label:?}");
                    let mut leader = label.place.leader.into_iter().flat_map(along);
                    let covers = leader.any(|place| inside(frame, place));
                    assert!(!covers, "{title:?}: {label:?}");
                }
            }
        }
    }
}

#[test]
fn figures_are_well_formed_on_the_sheet_with_minus_signs() {
    for answer in answers() {
        check(&figure(&answer));
        profiles::figures(&answer).for_each(|(_, figure)| check(&figure));
    }
    let blank = two_pulleys::drawn(&v_belt::blank());
    check(&figure(&blank));
    profiles::figures(&blank).for_each(|(_, figure)| check(&figure));
    let crossed = example("crossed");
    let text = figure(&belt_loop::answer(&crossed, &solve(&crossed).unwrap()));
    assert!(text.contains("torque −17.14 N·m") && text.contains("826.4 rpm"));
}

#[test]
fn the_numbers_are_those_of_the_state() {
    let stated = example("serpentine");
    let state = solve(&stated).unwrap();
    let loop_drawn = Loop::of(&belt_loop::answer(&stated, &state));
    let same = |line: &str, known: f64| {
        let numbers = line
            .split(' ')
            .filter_map(|word| word.trim_end_matches('°').parse().ok());
        let shown: Vec<f64> = numbers.collect();
        assert!(
            (shown[0] - known).abs() <= 5.1e-4 * known.abs(),
            "{line}: {known}"
        );
    };
    for (pulley, drawn) in state.pulleys.iter().zip(&loop_drawn.pulleys) {
        let [running, rest] = [pulley.hub_load, pulley.rest_hub_load];
        let mut known = vec![
            pulley.angular_speed * 60.0 / TAU,
            pulley.torque,
            pulley.wrap.to_degrees(),
            running[0].hypot(running[1]),
            rest[0].hypot(rest[1]),
        ];
        let mut lines = drawn.lines.clone();
        if pulley.torque == 0.0 {
            assert_eq!(lines.remove(1), "no torque");
            known.remove(1);
        }
        assert_eq!(lines.len(), known.len());
        lines
            .iter()
            .zip(known)
            .for_each(|(line, known)| same(line, known));
    }
    for (span, lines) in state.spans.iter().zip(&loop_drawn.spans) {
        let known = [span.tension, span.tractive_tension];
        lines
            .iter()
            .zip(known)
            .for_each(|(line, known)| same(line, known));
    }
}

#[test]
fn the_belt_joins_its_spans() {
    for drive in loops() {
        let state = solve(&drive).unwrap();
        let drawn = Loop::of(&belt_loop::answer(&drive, &state));
        for (index, span) in state.layout.spans().iter().enumerate() {
            for (drawn, known) in drawn.span(index).into_iter().zip([span.start, span.end]) {
                assert!((drawn - Point::from(known)).norm() < 1e-9 * state.length);
            }
        }
    }
    for answer in answers() {
        let drawn = Loop::of(&answer);
        for (index, span) in answer.subjects("spans").iter().enumerate() {
            let [start, end] = drawn.span(index);
            let [direction, length] = ["direction", "length"].map(|key| span.number(key).unwrap());
            let off = end - start - polar(direction, length);
            assert!(off.norm() < 1e-6 * length, "{:?}: {off}", answer.heading);
            let pulley = &drawn.pulleys[index];
            if let Some((angle, penetration, _)) = pulley.belt.last() {
                let last = pulley.point(*angle, *penetration);
                assert!(
                    (last - start).norm() < 1e-9 * length.max(1.0),
                    "{last} {start}"
                );
            }
        }
    }
}

#[test]
fn an_overhanging_belt_has_its_zone_up_to_the_exit() {
    let mut state = v_belt::overhanging();
    let profile = &mut state.driver.profile;
    let wrap = state.driver.wrap_angle;
    // The angle goes beyond the exit and comes back.
    let count = profile.angle.len();
    for (index, angle) in profile.angle.iter_mut().enumerate().skip(count - 20) {
        let part = (index + 20 - count) as f64 / 19.0;
        *angle = wrap + 0.2 * part * (1.0 - part);
    }
    let drawn = Loop::of(&two_pulleys::drawn(&state));
    let belt = &drawn.pulleys[0].belt;
    assert!(belt.iter().any(|(angle, ..)| *angle > wrap));
    assert!(belt.iter().all(|(_, _, kind)| kind == "slip"));
    // A zone ends within a step where the profile has no point.
    let driven = &drawn.pulleys[1].belt;
    let change = driven
        .windows(2)
        .find(|step| step[0].2 != step[1].2)
        .unwrap();
    assert!((change[0].0 - 1.7).abs() < 1e-9, "{change:?}");
}

#[test]
fn only_invisible_penetrations_are_exaggerated() {
    let shown = [0.02, 0.0004, 0.0].map(|depth| view::exaggeration(depth, 0.01));
    assert_eq!(shown, [1.0, 50.0, 1.0]);
}

#[test]
fn close_places_of_a_line_are_left_out() {
    let line = |places: &[f64]| {
        let kept = thinned(places.iter().map(|x| spot(*x, 0.0))).into_iter();
        kept.map(|place| place.x).collect::<Vec<_>>()
    };
    assert_eq!(line(&[0.0, 0.2, 0.9, 5.0, 5.3, 9.0, 9.2]), [0.0, 5.0, 9.2]);
    assert_eq!(line(&[0.0, 0.2]), [0.0, 0.2]);
    assert_eq!(line(&[0.0, 10.0]), [0.0, 10.0]);
}

#[test]
fn round_numbers_are_not_above() {
    assert_eq!([0.37, 1.0, 4.9, 75.0].map(round), [0.2, 1.0, 2.0, 50.0]);
    assert_eq!([metres(0.2), metres(5.0)], ["200 mm", "5 m"]);
    assert_eq!([newtons(500.0), newtons(2e4)], ["500 N", "20 kN"]);
}
