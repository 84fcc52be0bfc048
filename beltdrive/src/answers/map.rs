//! How a drive behaves over a rectangle of two of its numbers.

mod limit;
pub(in crate::answers) mod line;

use super::check::{CaseState, OnPulley, SlipMargin};
use super::members::{Refusal, Varied};
use super::shares::each;
use crate::input::{Diagnostic, DriveFile};
use crate::{Closure, Drive, Losses, SolveOptions};
use line::{Family, Near};
use std::sync::Mutex;

/// Usual ends of the axes, as shares of what the drive file gives, and the usual number of values: enough for smooth
/// contours.
const SPEEDS: [f64; 2] = [0.25, 1.25];
const LOADS: [f64; 2] = [0.1, 1.5];
const USUAL: usize = 21;

/// One of the two numbers of a map.
#[derive(Clone, Debug, PartialEq)]
pub struct MapAxis {
    /// What varies.
    pub varied: Varied,
    /// Its values, SI, each other than the one before it.
    pub values: Vec<f64>,
}

/// The states of a drive over a rectangle of two numbers.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct OperatingMap {
    /// The drive as its file states it.
    pub drive: Drive,
    /// The horizontal axis.
    pub x: MapAxis,
    /// The vertical axis.
    pub y: MapAxis,
    /// What was found at every point: all values of x at the first value of y, then at the next one.
    pub points: Vec<Result<MapState, Refusal>>,
}

/// What a map tells of a steady state.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct MapState {
    /// The largest speed loss of a pulley that takes or gives a torque.
    pub speed_loss: OnPulley,
    /// Power out over power in; `None` without torques.
    pub efficiency: Option<f64>,
    /// How far the drive is from gross slip.
    pub slip_margin: SlipMargin,
    /// The largest hub load of the running drive, N.
    pub hub_load: OnPulley,
    /// The largest hub load at rest, N.
    pub rest_hub_load: OnPulley,
    /// The largest belt tension, N.
    pub largest_tension: f64,
    /// The smallest tractive tension, N.
    pub smallest_tractive_tension: f64,
    /// Belt tension at rest, N.
    pub rest_tension: f64,
    /// Power that pulleys put into the belt, W.
    pub power_in: f64,
    /// Power that pulleys take out of the belt, W.
    pub power_out: f64,
    /// Where the power goes.
    pub losses: Losses,
    /// Estimated relative error of the state.
    pub error: f64,
}

impl MapState {
    /// What is told of a state of a load case.
    pub(crate) fn of(found: &CaseState) -> Self {
        let state = &found.state;
        let tensions = state.spans.iter().map(|span| span.tension);
        let tractive = state.spans.iter().map(|span| span.tractive_tension);
        Self {
            speed_loss: found.speed_loss,
            efficiency: state.efficiency,
            slip_margin: found.slip_margin,
            hub_load: found.hub_load,
            rest_hub_load: found.rest_hub_load,
            largest_tension: tensions.fold(f64::NEG_INFINITY, f64::max),
            smallest_tractive_tension: tractive.fold(f64::INFINITY, f64::min),
            rest_tension: state.rest_tension,
            power_in: state.power_in,
            power_out: state.power_out,
            losses: found.losses,
            error: state.relative_error(),
        }
    }

    /// The name of the pulley of a drive that slips first, if the slip margin was found.
    pub(crate) fn slips_first(&self, drive: &Drive) -> Option<String> {
        match self.slip_margin {
            SlipMargin::Factor(margin) => Some(drive.pulleys[margin.pulley].name.clone()),
            SlipMargin::NoLoad | SlipMargin::NotFound => None,
        }
    }
}

impl MapAxis {
    /// Values at equal steps from one end of a range to the other, SI; the ends are exact.
    #[must_use]
    pub fn over(varied: Varied, [from, to]: [f64; 2], count: usize) -> Self {
        let last = count.saturating_sub(1).max(1) as f64;
        let value = |index: usize| match index as f64 / last {
            1.0 => to,
            share => from + share * (to - from),
        };
        Self {
            varied,
            values: (0..count).map(value).collect(),
        }
    }
}

impl MapAxis {
    /// The speed of the driver from a quarter to five quarters of that in the drive file; `None` if it gives none.
    #[must_use]
    pub fn speed(file: &DriveFile) -> Option<Self> {
        let mut keys = file.keys().into_iter();
        let key = keys.find(|key| key.path().ends_with(".speed"))?;
        let given = file.value(&key)?;
        let range = SPEEDS.map(|share| share * given);
        Some(Self::over(Varied::Key(key), range, USUAL))
    }

    /// The load from a tenth to one and a half of that in the drive file: the only torque or power that it gives, or the
    /// tight tension above the slack one, or else a factor on all torques and powers. `None` if the file is at fault.
    #[must_use]
    pub fn load(file: &DriveFile) -> Option<Self> {
        let drive = file.drive().ok()?;
        let tensions = match drive.closure {
            Closure::BothSpans(load) => Some(load),
            _ => None,
        };
        let is_load = |path: &str| {
            let name = path.rsplit('.').next().unwrap_or(path);
            ["torque", "power", "driven_torque"].contains(&name)
                || name.starts_with("tight") && tensions.is_some()
        };
        let keys = file.keys().into_iter().filter(|key| is_load(key.path()));
        let keys: Vec<_> = keys.collect();
        let [key] = &keys[..] else {
            return Some(Self::over(Varied::LoadFactor, LOADS, USUAL));
        };
        let given = file.value(key)?;
        let none = match tensions {
            Some(load) if key.path().contains("tight") => load.slack.value(),
            _ => 0.0,
        };
        let range = LOADS.map(|share| none + share * (given - none));
        Some(Self::over(Varied::Key(key.clone()), range, USUAL))
    }
}

impl OperatingMap {
    /// What was found at a pair of places on the axes.
    ///
    /// # Panics
    /// If there is no such pair.
    pub fn at(&self, x: usize, y: usize) -> &Result<MapState, Refusal> {
        assert!(x < self.x.values.len(), "a place on the horizontal axis");
        &self.points[y * self.x.values.len() + x]
    }

    /// The points with their values of x and y, SI.
    pub fn rows(&self) -> impl Iterator<Item = ([f64; 2], &Result<MapState, Refusal>)> {
        let ys = self.y.values.iter();
        let values = ys.flat_map(|&y| self.x.values.iter().map(move |&x| [x, y]));
        values.zip(&self.points)
    }
}

/// Finds the steady states of a drive over a rectangle of two of its numbers.
///
/// Along lines of one number every state of a V-belt with bristle friction is sought from that before it, and the
/// first of a line from the first of the line before; where that fails, and with other laws, from nothing. The lines
/// run along x if x alone raises the load (all torques or powers by one factor), else along y. On a line of rising
/// load the slip margin of a V-belt is found once and divided by the load; no state is sought beyond it. With the
/// feature `parallel` lines are shared among the threads of rayon's pool. A point without a steady state keeps its
/// place, with the reason. `progress` is called with the share of the lines that are done.
///
/// ```
/// use beltdrive::belt_loop::Varied;
/// use beltdrive::input::DriveFile;
/// use beltdrive::{MapAxis, SolveOptions, examples, map};
///
/// let example = examples::find("serpentine").expect("a shipped example");
/// let file = DriveFile::read(example.name, example.text, &[])?;
/// let speed = file.keys().into_iter().find(|key| key.path().ends_with(".speed"));
/// let speed = Varied::Key(speed.expect("the driver has a speed"));
/// let x = MapAxis::over(speed, [50.0, 150.0], 3);
/// let y = MapAxis::over(Varied::LoadFactor, [0.5, 1.0], 2);
/// let map = map(&file, x, y, &SolveOptions::default(), &mut |_, _| {})?;
/// let corner = map.at(2, 1).as_ref().expect("a steady state");
/// assert!(corner.efficiency.is_some_and(|share| share > 0.9 && share < 1.0));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// The drive file is at fault as it stands.
pub fn map(
    file: &DriveFile,
    x: MapAxis,
    y: MapAxis,
    options: &SolveOptions,
    progress: &mut (dyn FnMut(f64, &str) + Send),
) -> Result<OperatingMap, Diagnostic> {
    let drive = file.drive()?;
    let given = file.service()?.given_losses;
    let file = file.with_sense();
    let family = Family::new(&file, vec![&x.varied, &y.varied], *options, given)?;
    let along = family.along([&x.values, &y.values]);
    let axes = [&x, &y];
    let [marched, across] = [axes[along], axes[1 - along]].map(|axis| &axis.values[..]);
    let values = |first: f64, second: f64| match along {
        0 => [first, second],
        _ => [second, first],
    };
    // The states from which the lines begin, each from the one before.
    let mut near = None;
    let begin = marched.first().copied().unwrap_or(f64::NAN);
    let starts: Vec<Option<Near>> = across
        .iter()
        .map(|&at| {
            if let Ok((found, _)) = family.point(near.as_ref(), &values(begin, at)) {
                near = Some(found);
            }
            near.clone()
        })
        .collect();
    let done = Mutex::new((0.0, progress));
    let lines = each(across.len(), |index| {
        let at = marched.iter().map(|&value| values(value, across[index]));
        let line = family.line(starts[index].as_ref(), at);
        if let Ok(mut done) = done.lock() {
            done.0 += 1.0;
            let share = done.0 / across.len() as f64;
            (done.1)(share, "states");
        }
        line
    });
    let points = match along {
        1 => {
            let lines = &lines;
            let rows = 0..marched.len();
            rows.flat_map(|row| lines.iter().map(move |line| line[row].clone()))
                .collect()
        }
        _ => lines.concat(),
    };
    Ok(OperatingMap {
        drive,
        x,
        y,
        points,
    })
}
