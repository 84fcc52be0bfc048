use super::super::geometry::Point;
use super::super::occupied::{Frame, Spot, distance};
use super::*;
use crate::belt_loop::{Closure, LoopPulley, Mount, Sense, Side, solve};
use crate::input::{DriveFile, Stated};
use crate::{Belt, BeltKind, FrictionLaw, NormalForce, examples};
use std::f64::consts::TAU;

fn example(name: &str) -> BeltLoop {
    let file = DriveFile::read(name, examples::find(name).unwrap().text, &[]);
    match file.and_then(|file| file.stated()).unwrap() {
        Stated::Loop(belt_loop) => belt_loop,
        Stated::Drive(_) => panic!("{name} is no loop"),
    }
}

/// A loop without its torques.
fn idle(mut belt_loop: BeltLoop) -> BeltLoop {
    for pulley in &mut belt_loop.pulleys {
        match pulley.duty {
            Duty::Driver(_) => {}
            _ => pulley.duty = Duty::Torque(0.0),
        }
    }
    belt_loop
}

fn pulley(name: &str, centre: [f64; 2], radius: f64, side: Side, duty: Duty) -> LoopPulley {
    LoopPulley {
        name: name.to_owned(),
        mount: Mount::Fixed(centre),
        radius,
        side,
        friction_coefficient: 0.6,
        half_angle: None,
        duty,
    }
}

fn round_pulleys(title: &str, turning_number: u32, pulleys: Vec<LoopPulley>) -> BeltLoop {
    BeltLoop {
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
fn ring(count: u32) -> BeltLoop {
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
fn pair(radii: [f64; 2], distance: f64, torque: f64, side: Side) -> BeltLoop {
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

fn loops() -> Vec<BeltLoop> {
    let mut loops: Vec<_> = ["serpentine", "crossed", "back-side-idler", "conveyor"]
        .map(example)
        .into();
    loops.push(idle(example("serpentine")));
    loops.extend((3..=9).map(ring));
    loops.push(pair([0.009, 0.13], 0.29, 2.0, Side::Inside));
    loops.push(pair([0.001, 0.3], 0.9, 0.5, Side::Inside));
    loops.push(pair([0.1, 0.1], 60.0, 10.0, Side::Inside));
    loops.push(pair([0.1, 0.1], 60.0, 10.0, Side::Outside));
    loops.push(pair([0.05, 0.08], 0.15, 0.0, Side::Inside));
    loops
}

/// Places at most 1 px apart along a line.
fn along([start, end]: [Spot; 2]) -> impl Iterator<Item = Spot> {
    let steps = (1_u32..)
        .find(|steps| f64::from(*steps) >= distance(start, end))
        .unwrap_or(1);
    (0..=steps).map(move |step| {
        let part = f64::from(step) / f64::from(steps);
        [0, 1].map(|axis| start[axis] + part * (end[axis] - start[axis]))
    })
}

/// Places on the rim of every pulley, within its disc, on every span and on the arrows.
fn drawn(view: &View<'_>) -> Vec<Spot> {
    let plan = &view.plan;
    let lines = (0..view.circles.len()).flat_map(|index| {
        let pulley = &view.state.pulleys[index];
        let loads = [pulley.hub_load, pulley.rest_hub_load];
        let [running, rest] = loads.map(|load| view.hub_load(index, load));
        [view.span(index), running, rest]
    });
    let tensioner = view.tensioner.iter().map(|tensioner| tensioner.line);
    let lines = lines.chain(tensioner);
    let lines = lines.flat_map(|line| along(line.map(|end| plan.position(end))));
    let discs = view.circles.iter().flat_map(|circle| {
        let [x, y] = plan.position(circle.centre);
        let radius = plan.scale * circle.radius;
        (0..720).flat_map(move |step| {
            let (sin, cos) = (TAU * f64::from(step) / 720.0).sin_cos();
            [1.0, 0.7, 0.4].map(|part| [x + part * radius * cos, y + part * radius * sin])
        })
    });
    let arrowheads = view.arrowheads.iter().flatten();
    let arrowheads = arrowheads.map(|at| plan.position(*at));
    lines.chain(discs).chain(arrowheads).collect()
}

#[test]
fn labels_cover_nothing_and_leaders_pass_labels() {
    for belt_loop in loops() {
        let state = solve(&belt_loop).unwrap_or_else(|error| panic!("{error}: {belt_loop:?}"));
        let header = Header::of_loop(&belt_loop, CAPTION);
        let (view, labels) = placed(&belt_loop, &state, &header);
        let count = belt_loop.pulleys.len();
        let tensioners = usize::from(belt_loop.tensioner().is_some());
        assert_eq!(labels.len(), 2 * count + tensioners);
        let title = (belt_loop.title.as_ref(), count);
        let inside = |frame: Frame, [x, y]: Spot| {
            frame.from[0] <= x && x <= frame.to[0] && frame.from[1] <= y && y <= frame.to[1]
        };
        let drawn = drawn(&view);
        for (index, label) in labels.iter().enumerate() {
            let frame = label.place.frame;
            assert!(view.frame.contains(&frame), "{title:?}: {label:?}");
            let covered = drawn.iter().find(|place| inside(frame, **place));
            assert_eq!(covered, None, "{title:?}: {label:?}");
            for (other, label) in labels.iter().enumerate() {
                if other != index {
                    assert!(!frame.meets(&label.place.frame), "{title:?}: {label:?}");
                    let leader = label.place.leader.into_iter();
                    let mut leader = leader.flat_map(along);
                    assert!(
                        !leader.any(|place| inside(frame, place)),
                        "{title:?}: {label:?}"
                    );
                }
            }
        }
    }
}

#[test]
fn figures_are_well_formed_with_minus_signs() {
    for belt_loop in loops() {
        let state = solve(&belt_loop).unwrap();
        let drawn = [("loop.svg", figure(&belt_loop, &state))];
        for (file, text) in drawn
            .into_iter()
            .chain(profiles::figures(&belt_loop, &state))
        {
            assert_well_formed(&text);
            assert!(!text.contains("NaN") && !text.contains("inf"), "{file}");
            let hyphen = |pair: &[char]| pair[0] == '-' && pair[1].is_ascii_digit();
            let shown = text.split('<').filter_map(|tag| tag.split_once('>'));
            for (_, words) in shown {
                let letters: Vec<_> = words.chars().collect();
                assert!(!letters.windows(2).any(hyphen), "{file}: {words}");
            }
        }
    }
    let crossed = example("crossed");
    let text = figure(&crossed, &solve(&crossed).unwrap());
    assert!(text.contains("torque −17.14 N·m") && text.contains("826.4 rpm"));
}

/// Every element that begins ends, in order.
fn assert_well_formed(text: &str) {
    let mut open: Vec<&str> = Vec::new();
    for tag in text.split('<').skip(1) {
        let (tag, _) = tag.split_once('>').expect("a tag ends");
        if let Some(name) = tag.strip_prefix('/') {
            assert_eq!(open.pop(), Some(name.trim()));
        } else if !tag.ends_with('/') {
            assert_eq!(tag.matches('"').count() % 2, 0, "{tag}");
            open.extend(tag.split_whitespace().next());
        }
    }
    assert_eq!(open, [""; 0]);
}

#[test]
fn the_belt_joins_its_spans() {
    for belt_loop in loops() {
        let state = solve(&belt_loop).unwrap();
        let header = Header::of_loop(&belt_loop, CAPTION);
        let view = View::of(&belt_loop, &state, &header, 1000.0);
        for (index, span) in state.layout.spans().iter().enumerate() {
            let ends = view.span(index);
            for (drawn, known) in ends.into_iter().zip([span.start, span.end]) {
                assert!((drawn - Point::from(known)).norm() < 1e-9 * state.length);
            }
            let contact = view.contact(index);
            let (last, leaves) = (contact.last().unwrap().1, ends[0]);
            assert!(
                (last - leaves).norm() < 1e-9 * state.length,
                "{last} {leaves}"
            );
        }
    }
}

#[test]
fn round_numbers_are_not_above() {
    assert_eq!([0.37, 1.0, 4.9, 75.0].map(round), [0.2, 1.0, 2.0, 50.0]);
    assert_eq!([metres(0.2), metres(5.0)], ["200 mm", "5 m"]);
    assert_eq!([newtons(500.0), newtons(2e4)], ["500 N", "20 kN"]);
}
