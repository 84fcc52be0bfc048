//! A run: from the first state to the end, step by step.
//!
//! Steps are explicit. They are implicit on the way to a steady state, after the last corner of what is given over time,
//! and in a run that would take more than [`MANY`] explicit steps; these end at samples or lie between two of them, and
//! begin anew at corners. Where no implicit step leads on, because a load stops a pulley, steps are explicit up to the
//! next sample. Spans that move across take explicit steps only.

use super::dynamics::{Dynamics, ImplicitSteps, StepLimits};
use super::events::{TransientEventKind, Watch};
use super::explicit::{Explicit, bounded_step, step_of_sines};
use super::frames::Frames;
use super::history::{Effort, Ending, Entry, History, Observer};
use super::simulation::{Simulation, StepBound, TransientError, Until};
use super::steady::Stillness;
use crate::Duty;
use crate::drive::layout::Layout;
use web_time::Instant;

/// Takes the first state of a drive, whose belt meets the pulleys at places, to the end of a simulation. `progress` is
/// told the time in s and the share of the run that is done; the run ends where it answers no.
pub(crate) fn run<R: Dynamics>(
    simulation: &Simulation,
    (mut rates, entries, layout): (R, &[Entry], &Layout),
    mut state: Vec<f64>,
    progress: &mut dyn FnMut(f64, f64) -> bool,
) -> Result<History, TransientError> {
    let begun = Instant::now();
    let mut explicit = Explicit::new(state.len());
    rates.begin(0.0);
    explicit.rates(&mut rates, 0.0, &mut state);
    possible(&rates, &state, 0.0)?;
    let mut run = Run::new(simulation, (rates, entries, layout), &state);
    let outcome = follow(simulation, &mut run, (explicit, state), progress);
    run.history.effort.seconds = begun.elapsed().as_secs_f64();
    match outcome {
        Ok(()) => Ok(run.told()),
        Err(error) => Err(error.after(run.told())),
    }
}

/// Takes the first state of a run to its end.
fn follow<R: Dynamics>(
    simulation: &Simulation,
    run: &mut Run<R>,
    (mut explicit, mut state): (Explicit, Vec<f64>),
    progress: &mut dyn FnMut(f64, f64) -> bool,
) -> Result<(), TransientError> {
    let mut stillness = Stillness::new(&run.rates);
    let mut implicit: Option<R::Implicit> = None;
    let mut between = state.clone();
    let mut instants = simulation.instants.clone();
    instants.sort_by(f64::total_cmp);
    let mut instants = instants.into_iter().peekable();
    let mut time = 0.0;
    // Whether the last step was implicit, and the time up to which steps are explicit after one that failed.
    let (mut is_implicit, mut explicit_until) = (false, 0.0);
    // Whether explicit steps are too many up to the end of what is to be followed: a steady state does not depend on the way.
    let mut is_long = false;
    let followed = match simulation.until {
        Until::Steady { .. } => stillness.last_corner(),
        until => until.latest(),
    };
    loop {
        // What is given over time is that from here on.
        run.rates.begin(time);
        let changes = explicit.rates(&mut run.rates, time, &mut state);
        run.watch.look(time, &run.rates, &state);
        if run.is_at(time, run.next_sample()) {
            run.sample(time, &state)?;
            // What Newton's method leaves is no motion, but is multiplied by the fastest rate of the mesh in the rates.
            let changes = match &implicit {
                Some(implicit) if is_implicit => implicit.changes(),
                _ => changes,
            };
            if run.is_steady_sought() && stillness.look(time, &run.rates, &state, changes) {
                run.history.ending = Ending::Steady;
                break;
            }
            if time < run.end() && !progress(time, time / run.end()) {
                run.history.ending = Ending::Interrupted;
                break;
            }
        }
        if run.has_what_ends_it() {
            if { run.history.samples.last() }.is_none_or(|last| last.time < time) {
                run.sample(time, &state)?;
            }
            run.history.ending = Ending::Event;
            break;
        }
        if instants
            .next_if(|&instant| run.is_at(time, instant))
            .is_some()
        {
            let belt = Observer::belt(time, &run.rates, &state);
            run.history.belts.push(belt);
        }
        if run.is_at(time, run.end()) {
            break;
        }
        let corners = run.rates.wheels().iter();
        let corners = corners.map(|wheel| wheel.axle.next_corner(time));
        let corner = corners.fold(run.end(), f64::min);
        let stop = { instants.peek() }.map_or(corner, |&instant| run.earlier(instant, corner));
        let bounded = bounded_step(&run.rates, &state);
        is_long |= followed > MANY * bounded.0;
        let is_on_the_way = run.is_steady_sought() && time >= followed;
        if (is_on_the_way || is_long) && simulation.step.is_none() && time >= explicit_until {
            if implicit.is_none() {
                implicit = run.rates.implicit(&state, run.limits());
            }
            let Some(implicit) = &mut implicit else {
                explicit_until = f64::INFINITY;
                continue;
            };
            if !is_implicit {
                implicit.begin(&run.rates, &state, changes);
            }
            let reach = run.earlier(run.last_sample_to(time + implicit.next()), stop);
            let reached = implicit.step(&mut run.rates, [time, reach], &mut state);
            run.history.effort.implicit = implicit.work();
            let Some(reached) = reached else {
                is_implicit = false;
                explicit_until = run.next_sample();
                continue;
            };
            is_implicit = !run.is_at(reached, corner);
            possible(&run.rates, &state, time)?;
            run.took(1, reached - time);
            while !run.is_at(run.next_sample(), reached) {
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
        let stop = run.earlier(run.next_sample(), stop);
        let is_short_of_end = run.is_steady_sought() || implicit.is_some();
        let counted = if is_short_of_end { stop } else { run.end() };
        let (count, step, stop) = step_to(simulation.step, bounded, [time, stop, counted])?;
        let mut taken = 0;
        while taken < count {
            let at = time + taken as f64 * step;
            if taken > 0 {
                explicit.rates(&mut run.rates, at, &mut state);
                run.watch.look(at, &run.rates, &state);
                if run.has_what_ends_it() {
                    break;
                }
            }
            explicit.step(&mut run.rates, at, step, &mut state);
            taken += 1;
        }
        run.took(taken, step);
        possible(&run.rates, &state, time)?;
        time = match taken == count {
            true => stop,
            false => time + taken as f64 * step,
        };
    }
    Ok(())
}

/// Explicit steps of a run from which on it is followed by implicit ones: ten seconds on 240 cells.
const MANY: f64 = 1e6;

/// Explicit steps that take as long as an implicit one of a history: 28 with 240 cells.
const PAYS: f64 = 25.0;

/// Longest implicit step towards a steady state in intervals between samples. A steady state is told from five steps one after the other, and a
/// step ten times as long as what decays takes a seventh of that with it, its sense turned: with 100 `soft-start` was not
/// steady at 6 s and with 20 not at 3 s, where explicit steps find it steady at 2.35 s.
const LONGEST: f64 = 5.0;

/// Most steps between two looks at the largest stable one: in so many a wave passes 40 cells at most.
const MOST_STEPS: usize = 100;

/// Most explicit steps of a run: a day of computing on 240 cells.
pub(super) const MOST_IN_ALL: f64 = 1e9;

/// What a run has told up to now, and what tells it.
struct Run<R> {
    rates: R,
    observer: Observer,
    watch: Watch,
    frames: Frames,
    history: History,
    /// Time between two samples, s.
    interval: f64,
    until: Until,
}

impl<R: Dynamics> Run<R> {
    fn new(
        simulation: &Simulation,
        (rates, entries, layout): (R, &[Entry], &Layout),
        state: &[f64],
    ) -> Self {
        let mut pulleys = simulation.drive.pulleys.iter();
        let driver = pulleys.position(|pulley| matches!(pulley.duty, Duty::Driver(_)));
        let driver = driver.unwrap_or(0);
        Self {
            observer: Observer::new(&rates, (driver, entries), state),
            watch: Watch::new(&rates, state),
            frames: Frames::new(simulation.frames),
            history: History {
                pulleys: { simulation.drive.pulleys.iter() }
                    .map(|pulley| pulley.name.clone())
                    .collect(),
                layout: layout.clone(),
                arcs: rates.mesh().arcs.clone(),
                samples: vec![],
                events: vec![],
                slack_spans: vec![],
                coarse: vec![],
                belts: vec![],
                frames: vec![],
                ending: match simulation.until {
                    Until::Steady { .. } => Ending::NotSteady,
                    _ => Ending::Time,
                },
                effort: Effort {
                    cells: rates.mesh().cells(),
                    step: [f64::INFINITY, 0.0],
                    ..Effort::default()
                },
            },
            rates,
            interval: simulation.interval,
            until: simulation.until,
        }
    }

    /// The history up to where the run has come.
    fn told(mut self) -> History {
        self.history.frames = self.frames.into_kept();
        self.history.slack_spans = self.watch.slack_spans.clone();
        self.history.events = self.watch.into_events();
        self.history
    }

    /// Whether the run is to end in a steady state.
    fn is_steady_sought(&self) -> bool {
        matches!(self.until, Until::Steady { .. })
    }

    /// The latest end, s.
    fn end(&self) -> f64 {
        self.until.latest()
    }

    /// What implicit steps keep to. A steady state does not depend on the errors of the way; tensions in the seconds after a
    /// load step on a stiff drive are off by 0.6 N with 1e-3, and by 0.15 N with 1e-4 in as much time.
    fn limits(&self) -> StepLimits {
        let (intervals, shortest, tolerance) = match self.until {
            Until::Steady { .. } => (LONGEST, 0.0, 1e-3),
            _ => (f64::INFINITY, PAYS, 1e-4),
        };
        StepLimits {
            longest: step_of_sines(self.rates.wheels()).min(intervals * self.interval),
            shortest,
            tolerance,
        }
    }

    /// Whether the event has happened that the run was to end with.
    fn has_what_ends_it(&self) -> bool {
        let mut kinds = self.watch.events.iter().map(|event| event.kind);
        match self.until {
            Until::Time(_) | Until::Steady { .. } => false,
            Until::Slip { .. } => {
                kinds.any(|kind| matches!(kind, TransientEventKind::GrossSlip(_)))
            }
            Until::Slack { .. } => kinds.any(|kind| kind == TransientEventKind::Slack),
        }
    }

    /// Whether a time is that of a sample, an instant or the end in s, or after it: sums of intervals differ by rounding
    /// from corners of what is given, and no step leads from one to the other.
    fn is_at(&self, time: f64, other: f64) -> bool {
        time >= other - 1e-9 * self.interval
    }

    /// The earlier one of a time of this run and a corner, s; the corner if they are the same.
    fn earlier(&self, time: f64, corner: f64) -> f64 {
        match self.is_at(time, corner) {
            true => corner,
            false => time,
        }
    }

    /// Time of a sample by its number, s.
    fn sample_at(&self, count: f64) -> f64 {
        (count * self.interval).min(self.end())
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
        let number = self.history.samples.len();
        // A last sample that the end of the run brings forward is none of evenly spaced ones.
        if self.is_at(time, number as f64 * self.interval) {
            self.frames
                .look(number, || Observer::belt(time, &self.rates, state));
        }
        self.history.samples.push(sample);
        match ledger.closes() {
            true => Ok(()),
            false => Err(TransientError::Ledger {
                residual: ledger.residual(),
                turnover: ledger.turnover,
                time,
                history: None,
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

/// How many equal steps lead from one time towards another in s, how long they are, and where they end: of a length that was
/// asked for, or of the stable one. Up to a third time there may be [`MOST_IN_ALL`].
fn step_to(
    asked: Option<f64>,
    (stable, bound): (f64, StepBound),
    [time, stop, counted]: [f64; 3],
) -> Result<(usize, f64, f64), TransientError> {
    let (longest, bound) = match asked {
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
    let steps = (counted - time) / longest;
    if steps > MOST_IN_ALL {
        return Err(TransientError::TooManySteps {
            end: counted,
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
fn possible(rates: &impl Dynamics, state: &[f64], time: f64) -> Result<(), TransientError> {
    let is_finite = state.iter().all(|number| number.is_finite());
    let problem = match rates.impossible(state) {
        None if !is_finite => Some("a number is not finite"),
        problem => problem,
    };
    match problem {
        Some(problem) => Err(TransientError::Impossible {
            time,
            problem,
            history: None,
        }),
        None => Ok(()),
    }
}
