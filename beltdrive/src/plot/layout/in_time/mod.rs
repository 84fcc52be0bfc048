//! The loop at an instant of a run, or over all of it: tension as colour, zones of friction, pulleys that turn.
//!
//! A figure at an instant is an animation of one frame.

mod film;
mod parts;
#[cfg(test)]
mod tests;
mod turning;

use super::super::axis::{Axis, Scale};
use super::super::clock::Clock;
use super::super::header::Header;
use super::model::{Loop, measured};
use super::placed;
use crate::quantity::precision::six_digits;
use crate::quantity::{Answer, Measure, title};
use crate::transient::{BeltAlongLoop, History};
use crate::{Drive, Duty};
use film::Film;
use parts::parts;
use std::slice;
use turning::{Pace, turned};

/// What every figure shows.
const CAPTION: &str = "Belt tension as colour, zones of friction inside the rims";

/// The figures at the instants of a run at which the belt was kept, in the order of time, with common colours.
pub(in super::super) fn stills(drive: &Drive, history: &History) -> Vec<String> {
    let tension = tensions(&history.belts);
    let belts = history.belts.iter();
    belts
        .map(|belt| still(drive, history, belt, &tension))
        .collect()
}

/// The figure at an instant, with the speeds of the pulleys and the tensions of the spans.
fn still(drive: &Drive, history: &History, belt: &BeltAlongLoop, tension: &Axis) -> String {
    let speed = |pulley: usize| {
        let speed = belt.angular_speeds[pulley];
        vec![measured(Measure::AngularSpeed, speed)]
    };
    let parts = parts(history);
    let spans = parts.iter().filter(|part| part.is_span);
    let spans = spans.map(|span| {
        // As of samples: in the middle.
        let cells = &belt.tension[span.cells.clone()];
        let count = cells.len();
        let middle = 0.5 * (cells[(count - 1) / 2] + cells[count / 2]);
        vec![format!("T = {}", measured(Measure::Force, middle))]
    });
    let belts = slice::from_ref(belt);
    let largest = displacement(belts);
    let drawn = Loop::laid(
        &history.layout,
        is_driver(drive),
        speed,
        spans.collect(),
        largest,
    );
    let title = format!("{}, at {} s", title(drive), six_digits(belt.time));
    let clock = Clock { duration: 0.0 };
    let texts = [title, CAPTION.to_owned()];
    figure(history, (&drawn, tension), (belts, clock), texts)
}

/// The run as an animation of the frames that it kept, if there are any; of one it is the figure at that instant.
pub(in super::super) fn animation(drive: &Drive, history: &History) -> Option<String> {
    let frames = &history.frames[..];
    let tension = tensions(frames);
    let [first, .., last] = frames else {
        let alone = frames.first()?;
        return Some(still(drive, history, alone, &tension));
    };
    let pace = Pace::of(&turned(history, frames), last.time - first.time);
    let clock = Clock {
        duration: pace.duration(frames.len()),
    };
    let [from, to] = [first, last].map(|belt| six_digits(belt.time));
    let caption = format!("{CAPTION}; {from} to {to} s, {}", pace.words());
    let largest = displacement(frames);
    let drawn = Loop::laid(
        &history.layout,
        is_driver(drive),
        |_| vec![],
        vec![],
        largest,
    );
    let texts = [title(drive), caption];
    Some(figure(history, (&drawn, &tension), (frames, clock), texts))
}

/// The largest displacement of the spans of belts across, m.
fn displacement(belts: &[BeltAlongLoop]) -> f64 {
    let displacements = belts.iter().flat_map(|belt| &belt.displacement);
    displacements.fold(0.0, |most, w| most.max(w.abs()))
}

/// The tensions of belts, N; those of a slack belt, which has a colour of its own, count as zero.
fn tensions(belts: &[BeltAlongLoop]) -> Axis {
    let tensions = belts.iter().flat_map(|belt| &belt.tension);
    let tensions = tensions.map(|tension| tension.max(0.0));
    Axis::spanning(tensions, Scale::Decimal)
}

fn is_driver(drive: &Drive) -> impl Fn(usize) -> bool {
    |pulley| matches!(drive.pulleys[pulley].duty, Duty::Driver(_))
}

/// The figure of a loop in frames that keep a time, with tensions on an axis and a title and a caption.
fn figure(
    history: &History,
    (drawn, tension): (&Loop, &Axis),
    (frames, clock): (&[BeltAlongLoop], Clock),
    [title, caption]: [String; 2],
) -> String {
    let heading = Answer {
        heading: vec![title],
        ..Answer::default()
    };
    let parts = parts(history);
    let legend = film::legend(frames, &parts);
    let (header, view, labels) = placed(drawn, |width| {
        Header::new(&heading, &caption, legend.clone(), width)
    });
    let film = Film::new(view, (frames, clock), tension, parts);
    film.figure(&header, &labels, &turned(history, frames))
}
