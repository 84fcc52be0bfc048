//! Many trials on all cores, counted.

use crate::draw::Draw;
use crate::trial::{Trial, Verdict};
use reference_problems::TOLERANCES;
use std::collections::BTreeMap;
use std::sync::atomic::{AtomicU32, Ordering};
use std::sync::{LazyLock, Mutex};
use std::time::Instant;

/// What is added to the seeds of the families, by the variable `SEEDS`: another number draws another sample.
pub(crate) static OTHER_SEEDS: LazyLock<u32> = LazyLock::new(|| {
    let seeds = std::env::var("SEEDS").ok();
    seeds.map_or(0, |seeds| seeds.parse().expect("SEEDS is a number"))
});

/// A family of random problems.
pub(crate) struct Family {
    /// Its number among the seeds, which stays when families are added.
    pub(crate) seed: u32,
    pub(crate) name: &'static str,
    pub(crate) draw: fn(&mut Draw) -> Trial,
}

impl Family {
    /// The problem of an index, and its tolerance.
    pub(crate) fn trial(&self, index: u32) -> (Trial, f64) {
        let tolerance = TOLERANCES[index as usize % TOLERANCES.len()];
        let seed = self.seed + *OTHER_SEEDS;
        ((self.draw)(&mut Draw::new(seed, index)), tolerance)
    }
}

/// How often what came of the trials of a formula at a tolerance.
#[derive(Clone, Debug, Default)]
pub(crate) struct Tally {
    pub(crate) solved: usize,
    pub(crate) another: usize,
    pub(crate) refused: BTreeMap<String, usize>,
    pub(crate) wrong: usize,
    pub(crate) panics: usize,
    pub(crate) seconds: f64,
}

impl Tally {
    fn add(&mut self, verdict: &Verdict, seconds: f64) {
        match verdict {
            Verdict::Solved => self.solved += 1,
            Verdict::Another => self.another += 1,
            Verdict::Refused(name) => *self.refused.entry(name.clone()).or_default() += 1,
            Verdict::False(_) => self.wrong += 1,
            Verdict::Panic => self.panics += 1,
        }
        self.seconds += seconds;
    }

    pub(crate) fn refusals(&self) -> usize {
        self.refused.values().sum()
    }

    /// Both together.
    pub(crate) fn plus(mut self, other: &Self) -> Self {
        self.solved += other.solved;
        self.another += other.another;
        self.wrong += other.wrong;
        self.panics += other.panics;
        self.seconds += other.seconds;
        for (name, count) in &other.refused {
            *self.refused.entry(name.clone()).or_default() += count;
        }
        self
    }
}

/// What came of the trials of a family.
#[derive(Default)]
pub(crate) struct Survey {
    /// By formula and the index of the tolerance.
    pub(crate) tallies: BTreeMap<(&'static str, usize), Tally>,
    /// Every false success and panic, in words.
    pub(crate) wrong: Vec<String>,
}

impl Survey {
    /// Tries the first `count` problems of a family on all cores.
    pub(crate) fn of(family: &Family, count: u32) -> Self {
        Self::by(family, count, || Trial::attempt)
    }

    /// The same by another solver: every thread makes one for itself.
    pub(crate) fn by<S: FnMut(&Trial, f64) -> Verdict>(
        family: &Family,
        count: u32,
        solver: impl Fn() -> S + Sync,
    ) -> Self {
        let survey = Mutex::new(Self::default());
        let next = AtomicU32::new(0);
        let threads = std::thread::available_parallelism().map_or(1, usize::from);
        let work = || {
            let mut solver = solver();
            loop {
                let index = next.fetch_add(1, Ordering::Relaxed);
                if index >= count {
                    break;
                }
                let (trial, tolerance) = family.trial(index);
                let start = Instant::now();
                let verdict = solver(&trial, tolerance);
                let seconds = start.elapsed().as_secs_f64();
                let mut survey = survey.lock().expect("no thread panics while it counts");
                survey.count(family.name, index, &trial, &verdict, seconds);
            }
        };
        std::thread::scope(|scope| {
            for _ in 0..threads {
                scope.spawn(work);
            }
        });
        let mut survey = survey
            .into_inner()
            .expect("no thread panics while it counts");
        survey.wrong.sort();
        survey
    }

    fn count(&mut self, family: &str, index: u32, trial: &Trial, verdict: &Verdict, seconds: f64) {
        let which = index as usize % TOLERANCES.len();
        let tally = self.tallies.entry((trial.kind, which)).or_default();
        tally.add(verdict, seconds);
        let what = match verdict {
            Verdict::False(error) => format!("error {error:.1e}"),
            Verdict::Panic => "panic".to_owned(),
            _ => return,
        };
        let Trial { kind, numbers, .. } = trial;
        let tolerance = TOLERANCES[which];
        self.wrong.push(format!(
            "{family} {index} ({kind}) at {tolerance:e}: {what}; {numbers}"
        ));
    }

    /// All formulas together, at a tolerance or at all of them.
    pub(crate) fn total(&self, tolerance: Option<usize>) -> Tally {
        let of = self
            .tallies
            .iter()
            .filter(|((_, index), _)| tolerance.is_none_or(|t| t == *index));
        of.fold(Tally::default(), |sum, (_, tally)| sum.plus(tally))
    }

    /// One line per formula and tolerance.
    pub(crate) fn lines(&self, family: &str) -> String {
        let mut text = String::new();
        for ((kind, tolerance), tally) in &self.tallies {
            text.push_str(&line(&format!("{family}: {kind}"), *tolerance, tally));
        }
        text
    }
}

/// One row of a table.
pub(crate) fn line(name: &str, tolerance: usize, tally: &Tally) -> String {
    let Tally {
        solved,
        another,
        refused,
        wrong,
        panics,
        seconds,
    } = tally;
    let reasons: Vec<String> = refused
        .iter()
        .map(|(name, n)| format!("{name} {n}"))
        .collect();
    format!(
        "| {name} | {:e} | {solved} | {another} | {} | {wrong} | {panics} | {seconds:.1} | {} |\n",
        TOLERANCES[tolerance],
        tally.refusals(),
        reasons.join(", ")
    )
}
