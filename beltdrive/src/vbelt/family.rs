//! Drives that differ in one or two entries of the drive file, as a family of boundary value
//! problems.
//!
//! The family has the parameters of [`DriveProblem`] and then the entries, each in a unit of its
//! own: a member is that problem with the numbers of its drive, and the family has scalars in their place.

use super::numbers::{Numbers, Scaled};
use super::{BeltProblem, DRIVEN, DRIVER, DriveProblem, Groove, Scales};
use crate::Drive;
use crate::drive::Number;
use crate::input::Key;
use bvp::{Ends, Problem, Real, Segment};

/// Where only cuts move the rates of the constants of the drive are those of the load, zero but for the accuracy of
/// a limit point; at limits of the load they are of the order of those of the lengths.
const CUTS_ONLY: f64 = 1e-3;

/// An entry of a drive file that varies.
#[derive(Clone, Copy, Debug)]
pub(super) struct Entry {
    pub(super) key: Key,
    /// The value (SI) that counts as one; positive.
    pub(super) unit: f64,
}

/// A family of drives over its entries.
pub(super) struct DriveFamily {
    drive: Drive,
    numbers: Numbers,
    entries: Vec<Varied>,
    /// The member with the entries of `drive`, which has the zones, the units and the constants of all.
    problem: DriveProblem,
}

/// An entry, and what it is among the numbers of a drive.
#[derive(Clone, Copy, Debug)]
struct Varied {
    entry: Entry,
    number: Number,
    /// Whether the constants of the belt on each pulley depend on it.
    moves: [bool; 2],
}

impl DriveFamily {
    /// The drives like that of a problem, of which `drive` is one, over `entries`: with its zones, and its ℓ or ε.
    pub(super) fn new(drive: &Drive, like: &DriveProblem, entries: Vec<Entry>) -> Self {
        let two = drive.pair();
        let (numbers, problem) = (Numbers::new(&two), member(drive, like));
        let entries = entries.into_iter().map(|entry| {
            let number = entry.key.number(&two);
            // What depends on no number is no number, and unlike itself.
            let mut none = numbers;
            none.set(number, f64::NAN);
            let moves = |pulley| groove(&problem, &none, pulley) != *problem.groove(pulley);
            Varied {
                entry,
                number,
                moves: [DRIVEN, DRIVER].map(moves),
            }
        });
        Self {
            drive: drive.clone(),
            numbers,
            entries: entries.collect(),
            problem,
        }
    }

    /// The same family with its ℓ/R, ε or τ divided by a number, as [`Law::finer`](super::Law::finer).
    pub(super) fn finer(self, times: i32) -> Self {
        Self {
            problem: self.problem.with_laws(|law, _| law.finer(times)),
            ..self
        }
    }

    /// Index of the first entry among the parameters.
    pub(super) fn first_entry(&self) -> usize {
        Problem::parameters(&self.problem)
    }

    /// Those of a vector of unknowns that are parameters of the drive: they stand before λ.
    pub(super) fn own<'z>(&self, z: &'z [f64]) -> &'z [f64] {
        let lambda = z.len() - 1;
        &z[lambda - self.first_entry()..lambda]
    }

    /// Rim speeds of both pulleys and their contact lengths: linear in the unknowns `z`.
    pub(super) fn constants(&self, z: &[f64]) -> [f64; 4] {
        let p = self.own(z);
        [
            p[DriveProblem::DRIVEN_RIM_SPEED],
            p[DriveProblem::DRIVER_RIM_SPEED],
            self.problem.contact_length(DRIVEN, p),
            self.problem.contact_length(DRIVER, p),
        ]
    }

    /// Whether unknowns along this tangent move the ends of segments and no constant of the drive.
    pub(super) fn moves_cuts_only(&self, tangent: &[f64]) -> bool {
        let largest = |rates: &[f64]| {
            rates
                .iter()
                .fold(0.0, |most: f64, rate| most.max(rate.abs()))
        };
        largest(&self.constants(tangent)) < CUTS_ONLY * largest(self.own(tangent))
    }

    /// The drive with scaled values of the entries.
    pub(super) fn drive(&self, values: &[f64]) -> Drive {
        let mut drive = self.drive.clone();
        for (Varied { entry, .. }, value) in self.entries.iter().zip(values) {
            entry.key.set(&mut drive, value * entry.unit);
        }
        drive
    }

    /// Its problem.
    pub(super) fn member(&self, values: &[f64]) -> DriveProblem {
        member(&self.drive(values), &self.problem)
    }

    /// The numbers of the drive with these values of the entries.
    fn numbers<T: Real>(&self, values: &[T]) -> Numbers<T> {
        let mut numbers = self.numbers.lifted();
        for (varied, &value) in self.entries.iter().zip(values) {
            numbers.set(varied.number, value * varied.entry.unit);
        }
        numbers
    }
}

/// The problem of a drive with the reference force, the zones and the ℓ or ε of another one.
fn member(drive: &Drive, like: &DriveProblem) -> DriveProblem {
    let drive = drive.pair();
    let scales = Scales::with_force(&drive, like.units().force);
    DriveProblem::new(&drive, scales, like.smoothing())
        .with_direction(like.has_direction())
        .with_laws(|law, _| law.with_onset_of(like.law()))
        .with_zones(&like.regimes())
}

/// The belt on a pulley of a drive with these numbers, with the reference force and the ℓ or ε of a member.
fn groove<S: Real>(like: &DriveProblem, numbers: &Numbers<S>, pulley: usize) -> Groove<S> {
    let units = numbers.units(like.units().force);
    directed(like, numbers.groove(pulley, &units, like.smoothing()))
}

/// All that the equations take from these numbers, likewise.
fn scaled<S: Real>(like: &DriveProblem, numbers: &Numbers<S>) -> Scaled<S> {
    let units = numbers.units(like.units().force);
    let scaled = numbers.scaled(&units, like.smoothing());
    Scaled {
        grooves: scaled.grooves.map(|groove| directed(like, groove)),
        ..scaled
    }
}

/// The belt on a pulley with the direction of its friction as a state where it is one of a member, and the same onset of
/// vector EPP friction.
fn directed<S: Real>(like: &DriveProblem, groove: Groove<S>) -> Groove<S> {
    Groove {
        law: groove
            .law
            .with_direction(like.has_direction())
            .with_onset_of(like.law()),
        ..groove
    }
}

impl Problem for DriveFamily {
    fn segments(&self) -> Vec<Segment> {
        self.problem.segments()
    }

    fn parameters(&self) -> usize {
        self.first_entry() + self.entries.len()
    }

    fn condition_count(&self) -> usize {
        self.problem.condition_count()
    }

    fn rhs<T: Real>(&self, segment: usize, _s: T, y: &[T], p: &[T], dy: &mut [T]) {
        let (p, values) = p.split_at(self.first_entry());
        let pulley = self.problem.pulley(segment);
        if self.entries.iter().any(|varied| varied.moves[pulley]) {
            let groove = groove(&self.problem, &self.numbers(values), pulley);
            self.problem.rates(&groove, segment, y, p, dy);
        } else {
            self.problem
                .rates(self.problem.groove(pulley), segment, y, p, dy);
        }
    }

    /// As the member, and on the entries that the constants of the belt on its pulley depend on.
    fn depends(&self, segment: usize, parameter: usize) -> bool {
        match parameter.checked_sub(self.first_entry()) {
            None => self.problem.depends(segment, parameter),
            Some(entry) => self.entries[entry].moves[self.problem.pulley(segment)],
        }
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, p: &[T], r: &mut [T]) {
        let (p, values) = p.split_at(self.first_entry());
        let scaled = scaled(&self.problem, &self.numbers(values));
        self.problem.residuals(&scaled, at, p, r);
    }
}

#[cfg(test)]
mod tests;
