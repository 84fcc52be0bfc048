//! A run: from the first state to the end, step by step.
//!
//! Steps are explicit. On the way to a steady state, after the last corner of what is given over time, they are
//! implicit, and end at samples or lie between two of them; where no implicit step leads on, because a load stops a
//! pulley, they are explicit up to the next sample. Spans that move across take explicit steps only.

use super::events::Watch;
use super::explicit::{Explicit, bounded_step};
use super::history::{Effort, Ending, History, Observer};
use super::implicit::Implicit;
use super::rates::Rates;
use super::simulation::{Simulation, StepBound, TransientError, Until};
use super::steady::Stillness;
use super::string;
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
    possible(system, &state, 0.0)?;
    let mut run = Run::new(simulation, (system, layout), &state);
    let mut explicit = Explicit::new(system);
    let mut stillness = Stillness::new(&run.rates);
    let mut implicit: Option<Implicit> = None;
    let mut between = state.clone();
    let mut instants = simulation.instants.clone();
    instants.sort_by(f64::total_cmp);
    let mut instants = instants.into_iter().peekable();
    let mut time = 0.0;
    // Whether the last step was implicit, and the time up to which steps are explicit after one that failed.
    let (mut is_implicit, mut explicit_until) = (false, 0.0);
    loop {
        // What is given over time is that from here on.
        run.rates.begin(time);
        let changes = explicit.rates(&mut run.rates, time, &mut state);
        run.watch.look(time, &run.rates, &state);
        if time >= run.next_sample() {
            run.sample(time, &state)?;
            // What Newton's method leaves is no motion, but is multiplied by the fastest rate of the mesh in the rates.
            let changes = match &implicit {
                Some(implicit) if is_implicit => implicit.changes(),
                _ => changes,
            };
            if run.is_steady_sought && stillness.look(time, &run.rates, &state, changes) {
                run.history.ending = Ending::Steady;
                break;
            }
            if time < run.end && !progress(time, time / run.end) {
                run.history.ending = Ending::Interrupted;
                break;
            }
        }
        if instants.next_if(|&instant| instant <= time).is_some() {
            let belt = Observer::belt(time, &run.rates, &state);
            run.history.belts.push(belt);
        }
        if time >= run.end {
            break;
        }
        let stop = system
            .wheels
            .iter()
            .map(|wheel| wheel.axle.next_corner(time));
        let stop = stop.fold(run.end, f64::min);
        let stop = instants.peek().map_or(stop, |&instant| instant.min(stop));
        if run.is_steady_sought
            && simulation.step.is_none()
            && system.across.is_none()
            && stillness.is_after_corners(time)
            && time >= explicit_until
        {
            let implicit = implicit.get_or_insert_with(|| {
                Implicit::new(system, &state, LONGEST * simulation.interval)
            });
            if !is_implicit {
                implicit.begin(changes);
            }
            let reach = run.last_sample_to(time + implicit.next()).min(stop);
            let reached = implicit.step(&mut run.rates, [time, reach], &mut state);
            run.history.effort.implicit = implicit.work();
            is_implicit = reached.is_some();
            let Some(reached) = reached else {
                explicit_until = run.next_sample();
                continue;
            };
            possible(system, &state, time)?;
            run.took(1, reached - time);
            while run.next_sample() < reached {
                let at = run.next_sample();
                let step = reached - time;
                implicit.within((at - time) / step, step, &state, &mut between);
                explicit.rates(&mut run.rates, at, &mut between);
                run.watch.look(at, &run.rates, &between);
                run.sample(at, &between)?;
            }
            time = reached;
            continue;
        }
        is_implicit = false;
        let stop = stop.min(run.next_sample());
        let (count, step, stop) = step_to(simulation, system, &state, [time, stop])?;
        run.took(count, step);
        for index in 0..count {
            let at = time + index as f64 * step;
            if index > 0 {
                explicit.rates(&mut run.rates, at, &mut state);
                run.watch.look(at, &run.rates, &state);
            }
            explicit.step(&mut run.rates, at, step, &mut state);
        }
        possible(system, &state, time)?;
        time = stop;
    }
    run.history.slack_spans = run.watch.slack_spans.clone();
    run.history.events = run.watch.into_events();
    run.history.effort.seconds = begun.elapsed().as_secs_f64();
    Ok(run.history)
}

/// Longest implicit step in intervals between samples. A steady state is told from five steps one after the other, and a
/// step ten times as long as what decays takes a seventh of that with it, its sense turned: with 100 `soft-start` was not
/// steady at 6 s and with 20 not at 3 s, where explicit steps find it steady at 2.35 s.
const LONGEST: f64 = 5.0;

/// Largest slope of a span that moves across: the stretch leaves out s⁴/8, which is then a thousandth.
const STEEPEST: f64 = 0.3;

/// Most steps between two looks at the largest stable one: in so many a wave passes 40 cells at most.
const MOST_STEPS: usize = 100;

/// Most explicit steps of a run: a day of computing on 240 cells.
pub(super) const MOST_IN_ALL: f64 = 1e9;

/// What a run has told up to now, and what tells it.
struct Run<'s> {
    rates: Rates<'s>,
    observer: Observer,
    watch: Watch,
    history: History,
    /// Time between two samples, s.
    interval: f64,
    /// The latest end, s.
    end: f64,
    is_steady_sought: bool,
}

impl<'s> Run<'s> {
    fn new(
        simulation: &Simulation,
        (system, layout): (&'s System, &Layout),
        state: &[f64],
    ) -> Self {
        let (end, is_steady_sought) = match simulation.until {
            Until::Time(end) => (end, false),
            Until::Steady { latest } => (latest, true),
        };
        let rates = Rates::new(system);
        let wave = (system.axial_stiffness / system.mass).sqrt();
        Self {
            observer: Observer::new(&rates, layout, system.energy(state)),
            watch: Watch::new(system, system.mesh.length() / wave),
            rates,
            history: History {
                pulleys: layout
                    .pulleys()
                    .iter()
                    .map(|pulley| pulley.name.clone())
                    .collect(),
                samples: vec![],
                events: vec![],
                slack_spans: vec![],
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
            },
            interval: simulation.interval,
            end,
            is_steady_sought,
        }
    }

    /// Time of a sample by its number, s.
    fn sample_at(&self, count: f64) -> f64 {
        (count * self.interval).min(self.end)
    }

    /// Time of the next sample, s.
    fn next_sample(&self) -> f64 {
        self.sample_at(self.history.samples.len() as f64)
    }

    /// The last sample up to a time in s, or the next one if it is later.
    fn last_sample_to(&self, time: f64) -> f64 {
        self.sample_at((time / self.interval).floor())
            .max(self.next_sample())
    }

    /// Takes a sample of a state at a time in s whose rates were computed last.
    fn sample(&mut self, time: f64, state: &[f64]) -> Result<(), TransientError> {
        let least_stretch = self.watch.take_least_stretch();
        let mut sample = self
            .observer
            .sample(time, &self.rates, state, least_stretch);
        sample.amplitudes = self.watch.take_largest();
        let ledger = sample.ledger;
        self.history.samples.push(sample);
        match ledger.closes() {
            true => Ok(()),
            false => Err(TransientError::Ledger {
                residual: ledger.residual(),
                turnover: ledger.turnover,
                time,
            }),
        }
    }

    /// Counts steps of a length in s.
    fn took(&mut self, count: usize, step: f64) {
        let Effort {
            steps, step: range, ..
        } = &mut self.history.effort;
        *range = [range[0].min(step), range[1].max(step)];
        *steps += count;
    }
}

/// How many equal steps lead from one time towards another in s, how long they are, and where they end.
fn step_to(
    simulation: &Simulation,
    system: &System,
    state: &[f64],
    [time, stop]: [f64; 2],
) -> Result<(usize, f64, f64), TransientError> {
    let (stable, bound) = bounded_step(system, state);
    let (longest, bound) = match simulation.step {
        Some(asked) if asked > stable => {
            return Err(TransientError::Unstable {
                asked,
                stable,
                time,
            });
        }
        Some(asked) => (asked, StepBound::Asked),
        None => (stable, bound),
    };
    // On the way to a steady state steps stay explicit up to the next stop only.
    let end = match simulation.until {
        Until::Time(end) => end,
        Until::Steady { .. } => stop,
    };
    let steps = (end - time) / longest;
    if steps > MOST_IN_ALL {
        return Err(TransientError::TooManySteps {
            end,
            steps,
            step: longest,
            bound,
        });
    }
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
    if string::steepest(system, state) > STEEPEST {
        return impossible("a span moves across with a slope beyond which its stretch is wrong");
    }
    Ok(())
}
