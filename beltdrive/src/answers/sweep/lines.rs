//! The answers along rows of a sweep that follow each other.

use super::{Sweep, SweepQuestion, SweepRow, Swept};
use crate::answers::belt_loop::closed_once;
use crate::answers::check::check;
use crate::answers::drive::summary;
use crate::answers::limits;
use crate::answers::map::line::Family;
use crate::answers::members::{Refusal, Varied};
use crate::input::{DriveFile, Key};
use crate::{Drive, SolveError, SteadyState};

/// The most rows of a line. Only its first is sought from nothing, which takes about twice as long; shorter lines share
/// the rows of a chunk better among threads.
const LONGEST: usize = 32;

/// Rows parted into lines, in each of which a row differs from that before it in one number at most, each with the index
/// of its first row.
pub(super) fn lines(rows: &[SweepRow]) -> Vec<(usize, &[SweepRow])> {
    let follows = |one: &SweepRow, next: &SweepRow| {
        let pairs = one.values.iter().zip(&next.values);
        pairs.filter(|(one, next)| one != next).count() <= 1
    };
    let runs = rows.chunk_by(follows);
    let lines = runs.flat_map(|run| run.chunks(LONGEST));
    let mut first = 0;
    let numbered = lines.map(|line| {
        first += line.len();
        (first - line.len(), line)
    });
    numbered.collect()
}

impl Sweep {
    /// The answers of a line.
    pub(super) fn line(
        &self,
        family: &Family<'_>,
        line: &[SweepRow],
    ) -> Vec<Result<Swept, Refusal>> {
        let is_right = |row: &&SweepRow| row.fault.is_none();
        let mut answers = match self.question {
            SweepQuestion::Solve if self.is_of_two() => {
                let mut near = None;
                let rows = line.iter().filter(is_right);
                rows.map(|row| self.of_two(family, row, &mut near))
                    .collect()
            }
            SweepQuestion::Solve => {
                let mut near = None;
                let solved = |row: &SweepRow| {
                    let (found, state) = family.point(near.as_ref(), &row.values)?;
                    near = Some(found);
                    Ok(Swept::Loop(Box::new(state)))
                };
                line.iter().filter(is_right).map(solved).collect()
            }
            SweepQuestion::Check if self.cases().is_none() => {
                let states = family.line(None, line.iter().filter(is_right));
                let told = |state| Swept::State(Box::new(state));
                states.into_iter().map(|state| state.map(told)).collect()
            }
            SweepQuestion::Check => {
                let rows = line.iter().filter(is_right);
                rows.map(|row| self.judged(row)).collect::<Vec<_>>()
            }
            SweepQuestion::Limits => {
                let rows = line.iter().filter(is_right);
                rows.map(|row| self.limits(family, row)).collect()
            }
        }
        .into_iter();
        let told = line.iter().map(|row| match &row.fault {
            Some(fault) => Err(Refusal::Input(fault.clone())),
            None => answers.next().expect("an answer for each right row"),
        });
        told.collect()
    }

    /// The steady state of two pulleys, from that of a row before it.
    fn of_two(
        &self,
        family: &Family<'_>,
        row: &SweepRow,
        near: &mut Option<SteadyState>,
    ) -> Result<Swept, Refusal> {
        let (drive, _) = family.stated(&row.values)?;
        let (found, next) = summary(near.as_ref(), &drive, &self.options)?;
        *near = next;
        Ok(Swept::Drive(Box::new(found)))
    }

    /// What is found in each load case.
    fn judged(&self, row: &SweepRow) -> Result<Swept, Refusal> {
        let file = self.file_of(row);
        let service = file.service();
        let mut service = service.map_err(|error| Refusal::Input(Box::new(error)))?;
        let pairs = self.varied.iter().zip(&row.values);
        for (_, &factor) in pairs.filter(|(varied, _)| **varied == Varied::LoadFactor) {
            for case in &mut service.cases {
                case.drive = closed_once(&case.drive, &self.options)?.into_owned();
                case.drive.multiply_load(factor);
            }
        }
        let checked = check(&service, &self.options, &mut |_, _| {})?;
        Ok(Swept::Cases(Box::new(checked)))
    }

    /// The range of the load.
    fn limits(&self, family: &Family<'_>, row: &SweepRow) -> Result<Swept, Refusal> {
        let (drive, _) = family.stated(&row.values)?;
        Ok(match self.is_of_two() {
            true => Swept::DriveLimits(Box::new(self.limits_of_two(&drive)?)),
            false => {
                let file = self.file_of(row);
                let found = limits(&file, &Varied::LoadFactor, &self.options, &mut |_, _| {})?;
                Swept::LoopLimits(Box::new(found))
            }
        })
    }

    fn limits_of_two(&self, drive: &Drive) -> Result<crate::Limits, SolveError> {
        crate::limits(drive, &Key::load(drive), &self.options, &mut |_, _| {})
    }

    /// The drive file of a row.
    fn file_of(&self, row: &SweepRow) -> DriveFile {
        let pairs = self.varied.iter().zip(&row.values);
        pairs.fold(self.file.clone(), |file, (varied, &value)| match varied {
            Varied::Key(key) => file.with(key, value),
            Varied::LoadFactor => file,
        })
    }
}
