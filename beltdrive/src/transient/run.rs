//! A run: from the first state to the end, step by step.

use super::events::Watch;
use super::explicit::{Explicit, stable_step};
use super::history::{Effort, Ending, History, Observer};
use super::rates::Rates;
use super::simulation::{Simulation, TransientError, Until};
use super::steady::Stillness;
use super::system::System;
use crate::drive::layout::Layout;
use web_time::Instant;

/// Takes the first state of a system to the end of a simulation. `progress` is told the time in s and the share of
/// the run that is done; the run ends where it answers no.
pub(crate) fn run(
    simulation: &Simulation,
    (system, layout): (&System, &Layout),
    mut state: Vec<f64>,
    progress: &mut dyn FnMut(f64, f64) -> bool,
) -> Result<History, TransientError> {
    let begun = Instant::now();
    let (end, is_steady_sought) = match simulation.until {
        Until::Time(end) => (end, false),
        Until::Steady { latest } => (latest, true),
    };
    let mut rates = Rates::new(system);
    let mut explicit = Explicit::new(system);
    let observer = Observer::new(&rates, layout, system.energy(&state));
    let wave = (system.axial_stiffness / system.mass).sqrt();
    let mut watch = Watch::new(system.wheels.len(), system.mesh.length() / wave);
    let mut stillness = Stillness::new(&rates);
    let mut history = History {
        pulleys: layout
            .pulleys()
            .iter()
            .map(|pulley| pulley.name.clone())
            .collect(),
        samples: vec![],
        events: vec![],
        belts: vec![],
        ending: match is_steady_sought {
            true => Ending::NotSteady,
            false => Ending::Time,
        },
        effort: Effort {
            cells: system.mesh.cells(),
            step: [f64::INFINITY, 0.0],
            ..Effort::default()
        },
    };
    let mut instants = simulation.instants.clone();
    instants.sort_by(f64::total_cmp);
    let mut instants = instants.into_iter().peekable();
    let (mut time, mut sampled) = (0.0, 0_usize);
    loop {
        // What is given over time is that from here on.
        rates.begin(time);
        let changes = explicit.rates(&mut rates, time, &mut state);
        watch.look(time, &rates, &state);
        let sample_at = |count: usize| (count as f64 * simulation.interval).min(end);
        if time >= sample_at(sampled) {
            let sample = observer.sample(time, &rates, &state, watch.take_least_stretch());
            let ledger = sample.ledger;
            history.samples.push(sample);
            if !ledger.closes() {
                return Err(TransientError::Ledger {
                    residual: ledger.residual(),
                    turnover: ledger.turnover,
                    time,
                });
            }
            sampled += 1;
            if is_steady_sought && stillness.look(time, &rates, &state, changes) {
                history.ending = Ending::Steady;
                break;
            }
            if time < end && !progress(time, time / end) {
                history.ending = Ending::Interrupted;
                break;
            }
        }
        if instants.next_if(|&instant| instant <= time).is_some() {
            history.belts.push(Observer::belt(time, &rates, &state));
        }
        if time >= end {
            break;
        }
        let stop = system
            .wheels
            .iter()
            .map(|wheel| wheel.axle.next_corner(time));
        let stop = stop.fold(sample_at(sampled), f64::min);
        let stop = instants.peek().map_or(stop, |&instant| instant.min(stop));
        let (count, step, stop) = step_to(simulation, system, &state, [time, stop])?;
        let [shortest, longest] = history.effort.step;
        history.effort.step = [shortest.min(step), longest.max(step)];
        history.effort.steps += count;
        for index in 0..count {
            let at = time + index as f64 * step;
            if index > 0 {
                explicit.rates(&mut rates, at, &mut state);
                watch.look(at, &rates, &state);
            }
            explicit.step(&mut rates, at, step, &mut state);
        }
        possible(system, &state, time)?;
        time = stop;
    }
    history.events = watch.into_events();
    history.effort.seconds = begun.elapsed().as_secs_f64();
    Ok(history)
}

/// Most steps between two looks at the largest stable one: in so many a wave passes 40 cells at most.
const MOST_STEPS: usize = 100;

/// How many equal steps lead from one time towards another in s, how long they are, and where they end.
fn step_to(
    simulation: &Simulation,
    system: &System,
    state: &[f64],
    [time, stop]: [f64; 2],
) -> Result<(usize, f64, f64), TransientError> {
    let stable = stable_step(system, state);
    let longest = match simulation.step {
        Some(asked) if asked > stable => {
            return Err(TransientError::Unstable {
                asked,
                stable,
                time,
            });
        }
        Some(asked) => asked,
        None => stable,
    };
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a number of steps"
    )]
    let count = (((stop - time) / longest).ceil() as usize).max(1);
    let step = (stop - time) / count as f64;
    Ok(match count > MOST_STEPS {
        true => (MOST_STEPS, step, time + MOST_STEPS as f64 * step),
        false => (count, step, stop),
    })
}

/// Whether a state is that of a belt, after a time in s at which it was.
fn possible(system: &System, state: &[f64], time: f64) -> Result<(), TransientError> {
    let impossible = |problem| Err(TransientError::Impossible { time, problem });
    if !state.iter().all(|number| number.is_finite()) {
        return impossible("a number is not finite");
    }
    let mut densities = state[system.parts.density.clone()].iter();
    if densities.any(|density| *density <= 0.0) {
        return impossible("the belt is stretched without bounds");
    }
    Ok(())
}
