//! Drives that differ in one or two entries of the drive file, as a family of boundary value
//! problems.
//!
//! The family has the parameters of [`DriveProblem`] and then the entries, each in a unit of its
//! own. States and constants are differentiated exactly, entries by central differences: these
//! only set the direction of a branch, never the place of a point on it.

use super::groove::Groove;
use super::{BeltProblem, DRIVEN, DRIVER, DriveProblem, Regime, Scales, Solved};
use crate::Drive;
use crate::input::Key;
use bvp::{Ends, Equations, Problem, Segment, Shape};
use std::sync::Mutex;

/// Relative step of the differences.
const DIFFERENCE: f64 = 1e-5;

/// Where only cuts move the rates of the constants of the drive are those of the load, zero but for the accuracy of
/// a limit point; at limits of the load they are of the order of those of the lengths.
const CUTS_ONLY: f64 = 1e-3;

/// Why the members can be used.
const UNPOISONED: &str = "no evaluation of a member panics";

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
    entries: Vec<Entry>,
    force: f64,
    smoothing: f64,
    regimes: Vec<Vec<Regime>>,
    has_direction: bool,
    segments: Vec<Segment>,
    /// Number of parameters of a member.
    constants: usize,
    members: Mutex<Members>,
}

/// The members in use, and buffers.
struct Members {
    values: Vec<f64>,
    here: DriveProblem,
    /// For each entry the members with a smaller and a larger value, if they were asked for.
    beside: Option<Vec<[DriveProblem; 2]>>,
    jacobian: Vec<f64>,
    low: Vec<f64>,
    high: Vec<f64>,
}

impl DriveFamily {
    /// The drives like `solved`, of which `drive` is one, over `entries`: with its zones, and its ℓ or ε.
    pub(super) fn new(drive: &Drive, solved: &Solved, entries: Vec<Entry>) -> Self {
        let problem = &solved.problem;
        Self {
            drive: drive.clone(),
            entries,
            force: problem.scales().units.force,
            smoothing: problem.smoothing(),
            regimes: problem.regimes(),
            has_direction: problem.has_direction(),
            segments: Problem::segments(problem).to_vec(),
            constants: Problem::parameters(problem),
            members: Mutex::new(Members {
                values: Vec::new(),
                here: problem.clone(),
                beside: None,
                jacobian: Vec::new(),
                low: Vec::new(),
                high: Vec::new(),
            }),
        }
    }

    /// The same family with another length ℓ/R or normalisation ε.
    pub(super) fn with_smoothing(mut self, smoothing: f64) -> Self {
        self.smoothing = smoothing;
        let members = self.members.get_mut().expect(UNPOISONED);
        members.values.clear();
        self
    }

    /// Index of the first entry among the parameters.
    pub(super) fn first_entry(&self) -> usize {
        self.constants
    }

    /// Those of a vector of unknowns that are parameters of the drive: they stand before λ.
    pub(super) fn own<'z>(&self, z: &'z [f64]) -> &'z [f64] {
        let lambda = z.len() - 1;
        &z[lambda - self.constants..lambda]
    }

    /// Speed of the driven pulley, mass flow and both contact lengths: linear in the unknowns `z`.
    pub(super) fn constants(&self, z: &[f64]) -> [f64; 4] {
        let p = self.own(z);
        let lengths = &p[DriveProblem::length_index(0)..];
        let (driven, others) = lengths.split_at(self.regimes[DRIVEN].len());
        let driver = &others[..self.regimes[DRIVER].len()];
        [
            p[DriveProblem::DRIVEN_SPEED],
            p[DriveProblem::MASS_FLOW],
            driven.iter().sum(),
            driver.iter().sum(),
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
        for (entry, value) in self.entries.iter().zip(values) {
            entry.key.set(&mut drive, value * entry.unit);
        }
        drive
    }

    /// Its problem.
    pub(super) fn member(&self, values: &[f64]) -> DriveProblem {
        let drive = self.drive(values).pair();
        let scales = Scales::with_force(&drive, self.force);
        DriveProblem::new(&drive, scales, self.smoothing)
            .with_direction(self.has_direction)
            .with_zones(&self.regimes)
    }

    /// Works with the members at the values of the entries among the parameters `p`.
    fn with<T>(&self, p: &[f64], beside: bool, work: impl FnOnce(&mut Members, &[f64]) -> T) -> T {
        let (constants, values) = p.split_at(self.constants);
        let members = &mut *self.members.lock().expect(UNPOISONED);
        if members.values != values {
            members.here = self.member(values);
            members.values = values.to_vec();
            members.beside = None;
        }
        if beside && members.beside.is_none() {
            let mut moved = values.to_vec();
            let pairs = (0..values.len()).map(|i| {
                let pair = [-1.0, 1.0].map(|sign| {
                    moved[i] = values[i] + sign * step(values[i]);
                    self.member(&moved)
                });
                moved[i] = values[i];
                pair
            });
            members.beside = Some(pairs.collect());
        }
        work(members, constants)
    }
}

/// The step of a difference at the scaled value of an entry.
fn step(value: f64) -> f64 {
    DIFFERENCE * value.abs().max(DIFFERENCE)
}

impl Members {
    /// Completes the rows of a Jacobian: those of the member, found in `jacobian`, and the
    /// derivatives by the entries, as differences of `evaluate`.
    fn complete(
        &mut self,
        rows: usize,
        to: &mut [f64],
        differs: impl Fn(&DriveProblem, &DriveProblem) -> bool,
        mut evaluate: impl FnMut(&DriveProblem, &mut [f64]),
    ) {
        let columns = to.len() / rows;
        let known = columns - self.values.len();
        for (to, from) in to
            .chunks_exact_mut(columns)
            .zip(self.jacobian.chunks_exact(known))
        {
            to[..known].copy_from_slice(from);
        }
        self.low.resize(rows, 0.0);
        self.high.resize(rows, 0.0);
        for (i, [below, above]) in self.beside.iter().flatten().enumerate() {
            if differs(below, above) {
                evaluate(below, &mut self.low);
                evaluate(above, &mut self.high);
            } else {
                self.low.fill(0.0);
                self.high.fill(0.0);
            }
            let width = 2.0 * step(self.values[i]);
            let pairs = self.low.iter().zip(&self.high);
            for (to, (low, high)) in to.chunks_exact_mut(columns).zip(pairs) {
                to[known + i] = (high - low) / width;
            }
        }
    }
}

impl Equations for DriveFamily {
    fn shape(&self) -> Shape {
        let states: usize = self.segments.iter().map(|segment| segment.states).sum();
        Shape {
            segments: self.segments.clone(),
            parameters: self.constants + self.entries.len(),
            conditions: states + self.constants,
        }
    }

    fn evaluate_rhs(&self, segment: usize, s: f64, y: &[f64], p: &[f64], dy: &mut [f64]) {
        self.with(p, false, |members, p| {
            members.here.rhs(segment, s, y, p, dy);
        });
    }

    fn rhs_jacobian(
        &self,
        segment: usize,
        s: f64,
        y: &[f64],
        p: &[f64],
        dy: &mut [f64],
        jacobian: &mut [f64],
    ) {
        self.with(p, true, |members, p| {
            let mut own = std::mem::take(&mut members.jacobian);
            own.resize(y.len() * (y.len() + p.len()), 0.0);
            members.here.rhs_jacobian(segment, s, y, p, dy, &mut own);
            members.jacobian = own;
            let grooves = |problem: &DriveProblem| -> [Groove; 2] {
                [DRIVEN, DRIVER].map(|pulley| *problem.groove(pulley))
            };
            members.complete(
                y.len(),
                jacobian,
                |one, other| grooves(one) != grooves(other),
                |problem, dy| problem.rhs(segment, s, y, p, dy),
            );
        });
    }

    fn evaluate_conditions(&self, at: Ends<'_, f64>, p: &[f64], r: &mut [f64]) {
        self.with(p, false, |members, p| {
            members.here.conditions(at, p, r);
        });
    }

    fn conditions_jacobian(
        &self,
        at: Ends<'_, f64>,
        p: &[f64],
        r: &mut [f64],
        jacobian: &mut [f64],
    ) {
        self.with(p, true, |members, p| {
            let mut own = std::mem::take(&mut members.jacobian);
            own.resize(r.len() * (at.values().len() + p.len()), 0.0);
            members.here.conditions_jacobian(at, p, r, &mut own);
            members.jacobian = own;
            members.complete(
                r.len(),
                jacobian,
                |_, _| true,
                |problem, r| problem.conditions(at, p, r),
            );
        });
    }
}
