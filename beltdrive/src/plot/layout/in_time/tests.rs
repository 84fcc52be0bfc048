use super::super::super::ordered;
use super::super::super::tests::check;
use super::*;
use crate::input::DriveFile;
use crate::transient::{Ending, Motion, Pluck, Schedule, Simulation, Transverse, Until};
use crate::{examples, simulate};

/// An example in time on few cells, with samples every millisecond up to an end in s.
fn example(name: &str, end: f64) -> Simulation {
    let example = examples::find(name).unwrap();
    let mut simulation = DriveFile::read(example.name, example.text, &[])
        .unwrap()
        .simulation(None)
        .unwrap();
    simulation.cells = crate::transient::Cells::Total(60);
    simulation.interval = 1e-3;
    simulation.until = Until::Time(end);
    simulation
}

fn follow(simulation: &Simulation) -> History {
    simulate(simulation, &mut |_, _| true).unwrap()
}

/// A run of an example with so many frames at most.
fn filmed(name: &str, end: f64, frames: usize) -> (Drive, History) {
    let mut simulation = example(name, end);
    simulation.frames = frames;
    let history = follow(&simulation);
    (simulation.drive, history)
}

/// The values of an attribute of every element that begins with some text.
fn attributes<'a>(figure: &'a str, element: &str, attribute: &str) -> Vec<&'a str> {
    let elements = figure.split('<').filter(|tag| tag.starts_with(element));
    let values = elements.filter_map(|tag| {
        let (_, rest) = tag.split_once(&format!(" {attribute}=\""))?;
        rest.split_once('"').map(|(value, _)| value)
    });
    values.collect()
}

/// The angles in degrees of every pulley in the frames of an animation, with the last frame twice.
fn angles(figure: &str) -> Vec<Vec<f64>> {
    let turns = "animateTransform attributeName=\"transform\" type=\"rotate\"";
    let turns = attributes(figure, turns, "values").into_iter();
    let numbers = |values: &str| {
        values
            .split(';')
            .map(|angle| angle.parse().unwrap())
            .collect()
    };
    turns.map(numbers).collect()
}

#[test]
fn an_animation_has_every_frame_with_its_time() {
    let (drive, history) = filmed("slip-pulse", 0.06, 50);
    assert_eq!(history.frames.len(), 31);
    let figure = animation(&drive, &history).unwrap();
    check(&figure);
    let times: Vec<_> = { figure.split(">t = ").skip(1) }
        .map(|text| text.split_once('<').unwrap().0)
        .collect();
    assert_eq!(times.len(), 31);
    assert_eq!(
        [times[0], times[1], times[30]],
        ["0.000 s", "0.002 s", "0.060 s"]
    );
    // One is seen without an animation, and one at every time.
    assert_eq!(figure.matches("<g visibility=\"visible\">").count(), 1);
    assert!(figure.contains("keyTimes=\"0;0.03226;0.06452\" values=\"hidden;visible;hidden\""));
    for values in attributes(&figure, "animate attributeName=\"stroke\"", "values") {
        assert_eq!(values.split(';').count(), 32);
    }
    // The pulleys turn 1.1 times, which would take less than is watched.
    assert!(figure.contains("0 to 0.06 s, 50 times slower than real time"));
    let durations = attributes(&figure, "animate", "dur");
    assert!(
        durations.iter().all(|duration| *duration == "3.1s"),
        "{durations:?}"
    );
    assert!(figure.contains("slip zone") && !figure.contains("<script"));
}

#[test]
fn the_colours_of_a_frame_are_those_of_its_tensions() {
    let (drive, history) = filmed("slip-pulse", 0.06, 50);
    let figure = animation(&drive, &history).unwrap();
    let axis = tensions(&history.frames);
    // The paths of the pieces are those of the width of the colour.
    let tags = figure.split("<path").skip(1);
    let pieces: Vec<_> = tags
        .filter(|tag| tag.contains("stroke-width=\"6\"") && tag.contains("stroke=\"#"))
        .collect();
    let parts = parts(&history);
    let cells: Vec<_> = parts.iter().flat_map(parts::Part::pieces).collect();
    assert_eq!((pieces.len(), cells.len()), (60, 60));
    let steps: Vec<_> = (0..=100)
        .map(|step| ordered::color(f64::from(step) / 100.0))
        .collect();
    for (piece, cells) in pieces.iter().zip(cells) {
        let (_, values) = piece
            .split_once("attributeName=\"stroke\" values=\"")
            .unwrap();
        let colors = values.split_once('"').unwrap().0.split(';');
        // Without an animation the first one is seen.
        let tag = format!("<path{piece}");
        let first = attributes(&tag, "path", "stroke");
        assert_eq!(colors.clone().next(), first.first().copied());
        for (color, belt) in colors.zip(&history.frames) {
            let step = steps.iter().position(|step| *step == color).unwrap();
            let shown = axis.from + 0.01 * step as f64 * (axis.to - axis.from);
            let half = 0.005 * (axis.to - axis.from) * (1.0 + 1e-9);
            let [least, most] = [f64::min, f64::max].map(|of| {
                let tensions = belt.tension[cells.clone()].iter().copied();
                tensions.reduce(of).unwrap()
            });
            assert!(
                (least - half..=most + half).contains(&shown),
                "{shown} at {}",
                belt.time
            );
        }
    }
    // In the middle of the tight span the frames have the tensions of the samples.
    let tight = &parts[3];
    let middle = tight.cells.start + tight.cells.len() / 2;
    for belt in &history.frames {
        let sample = history
            .samples
            .iter()
            .find(|sample| sample.time == belt.time);
        let known = sample.unwrap().tensions[1];
        assert!((belt.tension[middle] - known).abs() < 0.02 * known);
    }
}

#[test]
fn pulleys_turn_by_the_integral_of_their_speeds() {
    let mut simulation = example("slip-pulse", 0.05);
    simulation.start = crate::transient::Start::Rest;
    simulation.frames = 200;
    // Between samples too.
    simulation.instants = vec![0.0405];
    let ramp = Schedule::ramp([0.0, 0.04], [0.0, 120.0]);
    simulation.axles[0].motion = Motion::Speed(ramp);
    let history = follow(&simulation);
    let known = |time: f64| match time < 0.04 {
        true => 0.5 * 120.0 / 0.04 * time * time,
        false => 2.4 + 120.0 * (time - 0.04),
    };
    let turned = turned(&history, &history.frames);
    let shown = angles(&animation(&simulation.drive, &history).unwrap());
    assert_eq!([turned.len(), shown.len(), shown[0].len()], [51, 2, 52]);
    for (frame, belt) in history.frames.iter().enumerate() {
        assert!(
            (turned[frame][0] - known(belt.time)).abs() < 1e-9,
            "{}",
            belt.time
        );
        // The loop runs counter-clockwise, which is negative on the sheet.
        assert!((shown[0][frame] + known(belt.time).to_degrees()).abs() <= 0.051);
    }
    let still = &stills(&simulation.drive, &history)[0];
    let angle = attributes(still, "g", "transform")[1];
    assert_eq!(angle, format!("rotate({:.1})", -known(0.0405).to_degrees()));
    // The driven pulley, whose speed is free, turns in each frame at a speed between those at its ends.
    for (angles, belts) in turned.windows(2).zip(history.frames.windows(2)) {
        let speed = (angles[1][1] - angles[0][1]) / (belts[1].time - belts[0].time);
        let [one, other] = [0, 1].map(|end| belts[end].angular_speeds[1]);
        let slack = 1e-9 * one.abs().max(other.abs());
        assert!((one.min(other) - slack..=one.max(other) + slack).contains(&speed));
    }
}

#[test]
fn a_pulley_outside_the_loop_turns_the_other_way() {
    let text = examples::find("crossed").unwrap().text;
    let text = format!(
        "{text}\n[transient]\nstart = \"running\"\nend = \"10 ms\"\naxial_damping = \"1 N*s\"\n\
         [transient.pulley.driven]\ninertia = \"0.01 kg*m^2\"\n"
    );
    let file = DriveFile::read("crossed", &text, &[]).unwrap();
    let mut simulation = file.simulation(None).unwrap();
    simulation.frames = 10;
    let history = follow(&simulation);
    let figure = animation(&simulation.drive, &history).unwrap();
    check(&figure);
    let shown = angles(&figure);
    let last = shown[0].len() - 1;
    assert!(shown[0][last] * shown[1][last] < 0.0, "{shown:?}");
}

#[test]
fn a_figure_at_an_instant_is_that_of_its_state() {
    let mut simulation = example("slip-pulse", 0.045);
    simulation.instants = vec![0.04, 0.01];
    let history = follow(&simulation);
    let [before, slipping] = &stills(&simulation.drive, &history)[..] else {
        panic!("two instants");
    };
    for figure in [before, slipping] {
        check(figure);
        assert!(!figure.contains("<animate"));
    }
    assert!(before.contains("at 0.01 s") && slipping.contains("at 0.04 s"));
    // The tension in the middle of a span and the speed of a pulley, to four digits.
    let belt = &history.belts[1];
    let sample = history
        .samples
        .iter()
        .find(|sample| sample.time == belt.time)
        .unwrap();
    let text = format!("T = {:.0} N", sample.tensions[1]);
    assert!(slipping.contains(&text), "{text}");
    let speed = sample.pulleys[1].angular_speed * 30.0 / std::f64::consts::PI;
    assert!(slipping.contains(&format!("{speed:.1} rpm")), "{speed}");
    // All of both contacts slips: one zone of slip on each, from end to end.
    assert!(
        history.layout.wraps().len() == 2 && belt.slips.iter().filter(|slips| **slips).count() > 20
    );
    let amber = format!("stroke=\"{}\"", super::super::zones::color("slip"));
    let zones = |figure: &str| {
        let paths = figure.split("<path").filter(|tag| tag.contains(&amber));
        paths.filter(|tag| tag.contains(" A ")).count()
    };
    // With that in the legend, which is a line.
    assert_eq!([zones(before), zones(slipping)], [2, 2]);
    assert!(!follow(&example("slip-pulse", 0.002)).samples.is_empty());
}

#[test]
fn extreme_runs_have_their_animation() {
    // One frame: the figure at that time.
    let (drive, history) = filmed("slip-pulse", 0.01, 1);
    let figure = animation(&drive, &history).unwrap();
    check(&figure);
    assert!(figure.contains("at 0 s") && !figure.contains("<animate"));
    // Two.
    let (drive, history) = filmed("slip-pulse", 0.001, 200);
    assert_eq!(history.frames.len(), 2);
    check(&animation(&drive, &history).unwrap());
    // None.
    let (drive, history) = filmed("slip-pulse", 0.001, 0);
    assert!(history.frames.is_empty() && animation(&drive, &history).is_none());
    assert!(stills(&drive, &history).is_empty());
    // A belt whose tension is the same everywhere and always.
    let mut simulation = example("slip-pulse", 0.01);
    simulation.start = crate::transient::Start::Rest;
    simulation.frames = 200;
    simulation.axles[0].motion = Motion::Speed(Schedule::constant(0.0));
    if let Motion::Torques { load, .. } = &mut simulation.axles[1].motion {
        load.torque = Schedule::constant(0.0);
    }
    let history = follow(&simulation);
    let figure = animation(&simulation.drive, &history).unwrap();
    check(&figure);
    assert!(!figure.contains("<animateTransform") && !figure.contains("attributeName=\"stroke\""));
    assert_eq!(figure.matches(">t = ").count(), 11);
    assert!(!figure.contains("slip zone"));
    // A run that whoever watched it ended.
    let mut simulation = example("slip-pulse", 0.05);
    simulation.frames = 200;
    let history = simulate(&simulation, &mut |time, _| time < 0.0095).unwrap();
    assert_eq!(
        (history.ending, history.frames.len()),
        (Ending::Interrupted, 11)
    );
    check(&animation(&simulation.drive, &history).unwrap());
    // A last sample that the end brings forward is no frame.
    let (_, history) = filmed("slip-pulse", 0.0104, 200);
    assert_eq!((history.samples.len(), history.frames.len()), (12, 11));
}

#[test]
fn a_slack_belt_has_a_colour_of_its_own() {
    let mut simulation = example("slip-pulse", 0.005);
    simulation.start = crate::transient::Start::Rest;
    simulation.drive.closure = crate::Closure::SetupTension(150.0);
    simulation.axles[0].motion = Motion::Speed(Schedule::ramp([0.0, 0.005], [0.0, 120.0]));
    simulation.cells = crate::transient::Cells::Total(120);
    simulation.interval = 1e-4;
    simulation.frames = 200;
    let history = follow(&simulation);
    assert!(
        history
            .samples
            .iter()
            .any(|sample| sample.smallest_tension < 0.0)
    );
    let figure = animation(&simulation.drive, &history).unwrap();
    check(&figure);
    assert!(figure.contains("slack belt") && figure.contains(";#D55E00;"));
    assert!(tensions(&history.frames).from >= 0.0);
    // All of both contacts sticks at first.
    simulation.instants = vec![0.0];
    let history = follow(&simulation);
    let figure = &stills(&simulation.drive, &history)[0];
    assert!(figure.contains("elastic zone"));
    assert!(!figure.contains("slip zone") && !figure.contains("slack belt"));
}

#[test]
fn frames_change_nothing_in_a_run() {
    let simulation = example("slip-pulse", 0.03);
    let plain = follow(&simulation);
    let filmed = follow(&Simulation {
        frames: 7,
        ..simulation
    });
    assert_eq!(plain.samples, filmed.samples);
    assert_eq!(plain.events, filmed.events);
}

#[test]
fn a_run_to_the_steady_state_has_frames_up_to_it() {
    let mut simulation = example("soft-start", 1.0);
    simulation.interval = 0.01;
    simulation.until = Until::Steady { latest: 6.0 };
    simulation.frames = 50;
    let history = follow(&simulation);
    assert_eq!(history.ending, Ending::Steady);
    let [end, last] = [
        history.samples.last().unwrap().time,
        history.frames.last().unwrap().time,
    ];
    let gap = history.frames[1].time;
    assert!(
        history.frames.len() >= 25 && end - last < gap,
        "{end} {last}"
    );
    check(&animation(&simulation.drive, &history).unwrap());
}

#[test]
fn spans_move_across_in_view() {
    let mut simulation = example("slip-pulse", 0.01);
    let pluck = Pluck {
        amplitude: 1.2e-4,
        mode: 1,
    };
    simulation.transverse = Some(Transverse {
        plucks: vec![Some(pluck), None],
        ..Transverse::free(2)
    });
    simulation.frames = 200;
    let history = follow(&simulation);
    let figure = animation(&simulation.drive, &history).unwrap();
    check(&figure);
    // 1.6 px/mm or so.
    assert!(figure.contains("displacement across 50 times larger"));
    let moving = attributes(&figure, "animate attributeName=\"d\"", "values");
    let spans: Vec<_> = moving
        .iter()
        .filter(|values| !values.contains('A'))
        .collect();
    // The pieces of the span that is plucked, and its outline.
    assert!(spans.len() >= 15, "{}", spans.len());
    assert!(spans.iter().all(|values| values.split(';').count() == 12));
    // The first one is plucked outwards: down on a counter-clockwise loop with the driver at the left.
    let outline = figure
        .split("<path")
        .find(|tag| tag.contains("stroke-width=\"8\"") && tag.contains(" L "));
    let first = outline.unwrap().split('"').nth(1).unwrap();
    let heights: Vec<f64> = first
        .split(" L ")
        .map(|place| place.rsplit_once(' ').unwrap().1.parse().unwrap())
        .collect();
    let swing = heights[heights.len() / 2] - heights[0];
    assert!((8.0..20.0).contains(&swing), "{heights:?}");
}
