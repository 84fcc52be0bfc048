//! The loops that differ in one number, and which of them have a steady state.

use super::belt_loop::{closed_once, solve_to};
use crate::belt_loop::LoopState;
use crate::input::{Diagnostic, DriveFile, FileKey};
use crate::quantity::Measure;
use crate::{BeltKind, Drive, SolveError, SolveOptions};
use std::fmt;

/// What varies.
#[derive(Clone, Debug, PartialEq)]
pub enum Varied {
    /// A number of the drive file.
    Key(FileKey),
    /// A factor on the torques and powers of all pulleys; 1 is the drive file.
    LoadFactor,
}

impl Varied {
    /// What a column of a table varies: a number of the drive file, or the load factor without one.
    #[must_use]
    pub fn of(key: Option<&FileKey>) -> Self {
        key.map_or(Self::LoadFactor, |key| Self::Key(key.clone()))
    }
}

/// Why there is no state with a value.
#[derive(Clone, Debug)]
pub enum Refusal {
    /// The drive file would be at fault: a value out of its range, a belt that cannot be laid round the
    /// pulleys.
    Input(Box<Diagnostic>),
    /// The drive has no steady state.
    Loop(Box<SolveError>),
}

impl Refusal {
    /// One word for programs.
    pub fn kind(&self) -> &'static str {
        match self {
            Self::Input(_) => "impossible input",
            Self::Loop(error) => error.kind(),
        }
    }

    /// The largest factor on the load that has a state, if there is one for that reason.
    pub(super) fn largest_load(&self) -> Option<f64> {
        match self {
            Self::Loop(error) => match &**error {
                SolveError::Overloaded { load_factor, .. } => Some(*load_factor),
                _ => None,
            },
            Self::Input(_) => None,
        }
    }
}

impl From<SolveError> for Refusal {
    fn from(error: SolveError) -> Self {
        Self::Loop(Box::new(error))
    }
}

/// In words, on one line.
impl fmt::Display for Refusal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Input(error) => f.write_str(error.message()),
            Self::Loop(error) => error.fmt(f),
        }
    }
}

/// How often there is no state for which reason.
#[derive(Clone, Debug, Default)]
pub struct Refusals(Vec<(&'static str, usize, String)>);

impl Refusals {
    /// Counts a refusal.
    pub fn add(&mut self, refusal: &Refusal) {
        let kind = refusal.kind();
        match self.0.iter_mut().find(|(known, ..)| *known == kind) {
            Some((_, count, _)) => *count += 1,
            None => self.0.push((kind, 1, refusal.to_string())),
        }
    }

    /// Counts refusals that come later.
    pub fn join(&mut self, later: Self) {
        for (kind, more, first) in later.0 {
            match self.0.iter_mut().find(|(known, ..)| *known == kind) {
                Some((_, count, _)) => *count += more,
                None => self.0.push((kind, more, first)),
            }
        }
    }

    /// How many there are.
    pub fn count(&self) -> usize {
        self.0.iter().map(|(_, count, _)| count).sum()
    }

    /// Each reason in one word, how often it was there, and what was said the first time.
    pub fn by_reason(&self) -> impl Iterator<Item = (&'static str, usize, &str)> {
        let reasons = self.0.iter();
        reasons.map(|(kind, count, first)| (*kind, *count, first.as_str()))
    }
}

/// A loop and its steady state.
#[derive(Clone, Debug)]
pub(super) struct Member {
    pub(super) drive: Drive,
    pub(super) state: LoopState,
}

/// Bisections that bring a located value to 1e-12 of the step in which it lies.
const BISECTIONS: usize = 40;

/// That of a V-belt, whose states are only known to the tolerance, is located to this share of it: half as many
/// bisections at 1e-6.
const LOCATED: f64 = 0.1;

/// The loops that differ in one number of a drive file.
pub(super) struct Members<'f> {
    /// With the sense of the loop.
    file: DriveFile,
    varied: &'f Varied,
    pub(super) options: &'f SolveOptions,
}

impl<'f> Members<'f> {
    pub(super) fn new(file: &'f DriveFile, varied: &'f Varied, options: &'f SolveOptions) -> Self {
        Self {
            file: file.with_sense(),
            varied,
            options,
        }
    }

    /// The drive with a value, SI.
    pub(super) fn drive(&self, value: f64) -> Result<Drive, Refusal> {
        let stated = match self.varied {
            Varied::Key(key) => self.file.with(key, value).drive(),
            Varied::LoadFactor => self.file.drive(),
        };
        let drive = stated.map_err(|error| Refusal::Input(Box::new(error)))?;
        let Varied::LoadFactor = self.varied else {
            return Ok(drive);
        };
        let mut drive = closed_once(&drive, self.options)?.into_owned();
        drive.multiply_load(value);
        Ok(drive)
    }

    /// The loop and its steady state with a value, SI.
    pub(super) fn at(&self, value: f64) -> Result<Member, Refusal> {
        let drive = self.drive(value)?;
        let state = solve_to(&drive, self.options)?;
        Ok(Member { drive, state })
    }

    /// The last value that has a state between one that has one and one that has none, for this reason, SI, how
    /// far it may be off, and why there is none beyond.
    pub(super) fn end_between(
        &self,
        inside: f64,
        outside: f64,
        mut refusal: Refusal,
    ) -> (f64, f64, Refusal) {
        let [mut inside, mut outside] = [inside, outside];
        let is_v = |drive: Drive| matches!(drive.belt.kind, BeltKind::V(_));
        let resolved = match self.drive(inside).is_ok_and(is_v) {
            true => LOCATED * self.options.tolerance,
            false => 0.0,
        };
        for _ in 0..BISECTIONS {
            let middle = 0.5 * (inside + outside);
            if (outside - inside).abs() <= resolved * middle.abs()
                || middle == inside
                || middle == outside
            {
                break;
            }
            match self.at(middle) {
                Ok(_) => inside = middle,
                Err(error) => (outside, refusal) = (middle, error),
            }
        }
        let error = (outside - inside).abs();
        (inside, error, refusal)
    }

    /// The value in the drive file, SI.
    pub(super) fn given(&self) -> f64 {
        match self.varied {
            Varied::Key(key) => self.file.value(key).unwrap_or(f64::NAN),
            Varied::LoadFactor => 1.0,
        }
    }
}

impl Varied {
    /// What it is called in text.
    pub fn name(&self) -> String {
        match self {
            Self::Key(key) => key.path().to_owned(),
            Self::LoadFactor => "load factor".to_owned(),
        }
    }

    /// Its key in JSON and CSV, without the unit.
    pub fn key(&self) -> String {
        match self {
            Self::Key(key) => key.stem(),
            Self::LoadFactor => "load_factor".to_owned(),
        }
    }

    /// What it measures.
    pub fn measure(&self) -> Measure {
        match self {
            Self::Key(key) => key.measure(),
            Self::LoadFactor => Measure::Number,
        }
    }

    /// Whether it cannot be negative.
    pub(super) fn ends_at_zero(&self) -> bool {
        match self {
            Self::Key(key) => key.ends_at_zero(),
            Self::LoadFactor => true,
        }
    }

    /// Whether it cannot be 0 or negative.
    pub(super) fn is_positive(&self) -> bool {
        match self {
            Self::Key(key) => key.is_positive(),
            Self::LoadFactor => false,
        }
    }
}
