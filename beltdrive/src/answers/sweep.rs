//! Many drives that differ from one in some of its numbers.

mod grid;
mod latin_hypercube;
mod lines;
mod mixing;
mod question;
mod sobol;
mod summary;
mod table;

use super::LoopLimits;
use super::check::CheckedService;
use super::map::MapState;
use super::map::line::Family;
use super::members::{Refusal, Varied};
use super::shares::each;
use crate::belt_loop::LoopState;
use crate::input::{Diagnostic, DriveFile};
use crate::{BeltKind, Drive, Limits, Service, SolveOptions, StateSummary};

pub use grid::Grid;
pub use latin_hypercube::LatinHypercube;
pub use question::SweepQuestion;
pub use sobol::Sobol;
pub use summary::SweepSummary;
pub use table::{SweepTable, TableError, TableRows};

/// A question asked of many drives, which differ from a drive file in some of its numbers.
#[derive(Clone, Debug)]
pub struct Sweep {
    /// With the sense of its loop.
    file: DriveFile,
    /// As the file states it.
    drive: Drive,
    service: Service,
    /// Whether the file has load cases or requirements.
    is_judged: bool,
    varied: Vec<Varied>,
    question: SweepQuestion,
    options: SolveOptions,
}

/// What a drive of a sweep has for the numbers that vary.
#[derive(Clone, Debug)]
pub struct SweepRow {
    /// The values in the order of the numbers, SI; NaN for one that is not known.
    pub values: Vec<f64>,
    /// What is wrong with the row, if anything is: it has no answer then.
    pub fault: Option<Box<Diagnostic>>,
}

/// The answer of a drive of a sweep.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub enum Swept {
    /// The steady state of two pulleys that are closed by the tensions of both spans.
    Drive(Box<StateSummary>),
    /// The steady state of another drive, as of [`solve_to`](crate::belt_loop::solve_to).
    Loop(Box<LoopState>),
    /// What a check finds in a drive without load cases and requirements.
    State(Box<MapState>),
    /// What a check finds in every load case.
    Cases(Box<CheckedService>),
    /// The range of the load of two pulleys.
    DriveLimits(Box<Limits>),
    /// The range of the load factor of another drive.
    LoopLimits(Box<LoopLimits>),
}

/// Why there is no such sweep.
#[derive(Clone, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SweepError {
    /// The drive file is at fault as it stands.
    #[error(transparent)]
    Input(#[from] Box<Diagnostic>),
    /// The limits of a load do not depend on a factor on it.
    #[error("the load factor is what the limits of a drive are found of, so it cannot vary")]
    LoadFactor,
}

impl Sweep {
    /// A question asked of the drives of a file with other values of some numbers.
    ///
    /// ```
    /// use beltdrive::belt_loop::Varied;
    /// use beltdrive::input::DriveFile;
    /// use beltdrive::{Grid, SolveOptions, Sweep, SweepQuestion, Swept, examples};
    ///
    /// let example = examples::find("kim2009-flat").expect("a shipped example");
    /// let file = DriveFile::read(example.name, example.text, &[])?;
    /// let tension = file.keys().into_iter().find(|key| key.path() == "load.tight_tension");
    /// let varied = vec![Varied::Key(tension.expect("a number of the file"))];
    /// let sweep = Sweep::new(&file, varied, SweepQuestion::Solve, SolveOptions::default())?;
    ///
    /// let rows: Vec<_> = Grid::new(vec![vec![600.0, 700.0, 1e6]]).rows(0).collect();
    /// let losses = sweep.answer(&rows, |_, _, answer| match answer {
    ///     Ok(Swept::Drive(state)) => Some(state.speed_loss),
    ///     _ => None,
    /// });
    /// assert!(losses[0] < losses[1] && losses[2].is_none());
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// The drive file is at fault, or the load factor varies where its limits are asked for.
    pub fn new(
        file: &DriveFile,
        varied: Vec<Varied>,
        question: SweepQuestion,
        options: SolveOptions,
    ) -> Result<Self, SweepError> {
        let drive = file.drive().map_err(Box::new)?;
        let service = file.service().map_err(Box::new)?;
        if question == SweepQuestion::Limits && varied.contains(&Varied::LoadFactor) {
            return Err(SweepError::LoadFactor);
        }
        Ok(Self {
            is_judged: file.has_cases() || service.requirements != Default::default(),
            file: file.with_sense(),
            drive,
            service,
            varied,
            question,
            options,
        })
    }

    /// The answers of rows, in their order, each as it is told with its index among the rows: a row without one keeps its
    /// place.
    ///
    /// A V-belt whose row differs from the one before in one number alone is sought from the state of that. What is
    /// found for a row does not depend on the number of threads, only on the rows before it in the same call.
    ///
    /// # Panics
    /// If a row has not a value for each number.
    pub fn answer<T: Send>(
        &self,
        rows: &[SweepRow],
        told: impl Fn(usize, &SweepRow, &Result<Swept, Refusal>) -> T + Send + Sync,
    ) -> Vec<T> {
        let varied = self.varied.iter().collect();
        let given = self.service.given_losses;
        let family = Family::new(&self.file, varied, self.options, given);
        let family = family.expect("a file that has been read");
        let lines = lines::lines(rows);
        let told = &told;
        let answers = each(lines.len(), |index| {
            let (first, line) = lines[index];
            let answers = self.line(&family, line);
            let rows = line.iter().zip(&answers).enumerate();
            let told = rows.map(|(place, (row, answer))| told(first + place, row, answer));
            told.collect::<Vec<_>>()
        });
        answers.into_iter().flatten().collect()
    }

    /// How many rows are best answered in one call, where their answers are written as they come: those of flat belts take
    /// some tenths of a second, those of V-belts some seconds.
    #[must_use]
    pub fn usual_chunk(&self) -> usize {
        match self.drive.belt.kind {
            BeltKind::Flat { .. } => 10_000,
            BeltKind::V(_) => 1000,
        }
    }

    /// The drive as the file states it.
    #[must_use]
    pub fn drive(&self) -> &Drive {
        &self.drive
    }

    /// What varies.
    #[must_use]
    pub fn varied(&self) -> &[Varied] {
        &self.varied
    }

    /// What is asked.
    #[must_use]
    pub fn question(&self) -> SweepQuestion {
        self.question
    }

    /// Whether rows are answered for two pulleys that are closed by the tensions of both spans.
    pub(crate) fn is_of_two(&self) -> bool {
        self.drive.two_pulleys().is_some() && !self.varied.contains(&Varied::LoadFactor)
    }

    /// The load cases in which each drive is judged; none if its file has neither cases nor requirements.
    pub(crate) fn cases(&self) -> Option<impl Iterator<Item = &str>> {
        let cases = self.service.cases.iter().map(|case| case.name.as_str());
        self.is_judged.then_some(cases)
    }
}

impl SweepRow {
    /// A row that is right.
    #[must_use]
    pub fn new(values: Vec<f64>) -> Self {
        let fault = None;
        Self { values, fault }
    }
}

/// The values of a row, where nothing is wrong with it.
impl AsRef<[f64]> for SweepRow {
    fn as_ref(&self) -> &[f64] {
        &self.values
    }
}
