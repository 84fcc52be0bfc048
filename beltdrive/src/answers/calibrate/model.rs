//! What the steady states of measured rows have, and how it changes with the free numbers.

use crate::answers::map::line::{Family, Near};
use crate::answers::members::Varied;
use crate::belt_loop::LoopState;
use crate::drive::Direction;
use crate::input::{FileKey, MeasuredRow, Measurements, Reading};
use crate::model::model;
use crate::{BeltKind, FrictionLaw, GivenLosses, SolveOptions};
use std::num::NonZero;
use std::thread;

/// Least relative error of states, from which the step of their differences follows.
const ROUNDING: f64 = 1e-13;

/// Tolerance of the states of V-belts with bristles, at most, whose differences stand for derivatives: standard errors of
/// three numbers of one are then off by 1e-5, with 1e-6 by 4e-4.
const TOLERANCE: f64 = 1e-8;

/// A row without an answer.
#[derive(Clone, Debug, PartialEq)]
pub struct RowFailure {
    /// Its line in the file.
    pub line: usize,
    /// Why there is none.
    pub reason: String,
}

/// The rows as functions of the free numbers.
///
/// A place has a coordinate for each of them: the logarithm of one that is positive, over its start; of another one
/// its distance from the start, in units of its magnitude.
pub(super) struct Model<'d> {
    keys: &'d [FileKey],
    starts: Vec<f64>,
    data: &'d Measurements,
    /// The drives of the rows.
    rows: Vec<Result<Family<'d>, RowFailure>>,
    is_flat: bool,
}

/// For each row what the model has for each reading.
pub(super) type Predictions = Vec<Vec<Option<f64>>>;

/// The model at a place.
pub(super) struct At {
    pub(super) predictions: Predictions,
    /// Its relative error.
    pub(super) error: f64,
    /// The states of the rows, from which those beside them are found.
    pub(super) near: Vec<Near>,
    states: Vec<LoopState>,
}

/// The model at a place, or the first row without an answer there.
pub(super) type Evaluated = Result<At, RowFailure>;

/// What a row has for each reading, its state, and what those beside it are found from.
type OfRow = (Vec<Option<f64>>, LoopState, Near);

/// The derivatives of all readings with a coordinate, where they are known to rounding.
pub(super) type Column = Option<Vec<f64>>;

impl<'d> Model<'d> {
    /// With `varied` the keys as they vary.
    pub(super) fn new(
        keys: &'d [FileKey],
        varied: &'d [Varied],
        data: &'d Measurements,
        options: &SolveOptions,
    ) -> Self {
        let first = data.rows.first().map(|row| &row.file);
        let start = |key| first.and_then(|file| file.value(key));
        let drive = first.and_then(|file| file.drive().ok());
        let kind = drive.as_ref().map(|drive| drive.belt.kind);
        let tolerance = match drive.as_ref().map(|drive| drive.law) {
            Some(FrictionLaw::Bristle { .. }) => options.tolerance.min(TOLERANCE),
            // Zones are sought anew for every state, to 1e-9 in fifty times the time.
            _ => options.tolerance,
        };
        let rows = data.rows.iter().map(|row| {
            let (varied, options) = (varied.iter().collect(), SolveOptions { tolerance });
            Family::new(&row.file, varied, options, GivenLosses::default())
                .map_err(|error| row_failure(row, error.message()))
        });
        Self {
            starts: keys
                .iter()
                .map(|key| start(key).unwrap_or_default())
                .collect(),
            keys,
            data,
            rows: rows.collect(),
            is_flat: matches!(kind, Some(BeltKind::Flat { .. })),
        }
    }

    pub(super) fn keys(&self) -> &'d [FileKey] {
        self.keys
    }

    /// The number of readings.
    pub(super) fn readings(&self) -> usize {
        let rows = self.data.rows.iter();
        rows.map(|row| row.readings.iter().flatten().count()).sum()
    }

    /// The number of rows.
    pub(super) fn row_count(&self) -> usize {
        self.data.rows.len()
    }

    /// The value from which a number is sought, SI.
    pub(super) fn start(&self, index: usize) -> f64 {
        self.starts[index]
    }

    /// The numbers at a place, SI.
    pub(super) fn values(&self, place: &[f64]) -> Vec<f64> {
        let coordinates = place.iter().enumerate();
        coordinates
            .map(
                |(index, &coordinate)| match self.keys[index].is_positive() {
                    true => self.starts[index] * coordinate.exp(),
                    false => self.starts[index] + coordinate * self.magnitude(index),
                },
            )
            .collect()
    }

    /// What a number changes by with its coordinate at a place, SI.
    pub(super) fn scale(&self, index: usize, place: &[f64]) -> f64 {
        match self.keys[index].is_positive() {
            true => self.values(place)[index],
            false => self.magnitude(index),
        }
    }

    fn magnitude(&self, index: usize) -> f64 {
        match self.starts[index] {
            0.0 => 1.0,
            start => start.abs(),
        }
    }

    /// The model at several places, from the states `near` of the rows; the first failure for a place without an answer.
    ///
    /// Rows and places are shared among threads.
    pub(super) fn at(&self, places: &[Vec<f64>], near: &[Near]) -> Vec<Evaluated> {
        let tasks: Vec<_> = places
            .iter()
            .flat_map(|place| {
                let values = self.values(place);
                (0..self.data.rows.len()).map(move |row| (row, values.clone()))
            })
            .collect();
        // The closed form of a flat belt takes less time than a thread.
        let threads = match self.is_flat {
            true => 1,
            false => thread::available_parallelism().map_or(1, NonZero::get),
        };
        let share = tasks.len().div_ceil(threads).max(1);
        let solve = |tasks: &[(usize, Vec<f64>)]| -> Vec<_> {
            let tasks = tasks.iter();
            tasks
                .map(|(row, values)| self.row(*row, values, near.get(*row)))
                .collect()
        };
        let solved: Vec<_> = match tasks.len() <= share {
            true => solve(&tasks),
            false => thread::scope(|scope| {
                let parts = tasks.chunks(share);
                let running: Vec<_> = parts.map(|part| scope.spawn(|| solve(part))).collect();
                let done = running.into_iter();
                done.flat_map(|part| part.join().expect("a state does not panic"))
                    .collect()
            }),
        };
        let mut solved = solved.into_iter();
        let rows = self.data.rows.len();
        places
            .iter()
            .map(|_| {
                let of_place: Vec<_> = solved.by_ref().take(rows).collect();
                let mut at = At {
                    predictions: Vec::with_capacity(rows),
                    error: ROUNDING,
                    near: Vec::with_capacity(rows),
                    states: Vec::with_capacity(rows),
                };
                for row in of_place {
                    let (values, state, near) = row?;
                    at.error = at.error.max(state.relative_error());
                    at.predictions.push(values);
                    at.near.push(near);
                    at.states.push(state);
                }
                Ok(at)
            })
            .collect()
    }

    /// A row with values of the free numbers.
    fn row(&self, index: usize, values: &[f64], near: Option<&Near>) -> Result<OfRow, RowFailure> {
        let row = &self.data.rows[index];
        let family = self.rows[index].as_ref().map_err(RowFailure::clone)?;
        let found = family.point(near, values);
        let (near, state) = found.map_err(|refusal| row_failure(row, &refusal.to_string()))?;
        let read = |(index, reading): (usize, &Option<Reading>)| {
            reading.as_ref()?;
            self.data.measured[index].of(&state)
        };
        let found: Vec<_> = row.readings.iter().enumerate().map(read).collect();
        let lacks = found.iter().zip(&row.readings).zip(&self.data.measured);
        let lacking = lacks
            .into_iter()
            .find(|((found, reading), _)| reading.is_some() && !found.is_some_and(f64::is_finite));
        match lacking {
            Some((_, measured)) => {
                let reason = format!("the state has no `{}`", measured.name());
                Err(row_failure(row, &reason))
            }
            None => Ok((found, state, near)),
        }
    }

    /// The derivatives of all readings over σ with each coordinate at a place, from the states there.
    pub(super) fn derivatives(&self, place: &[f64], at: &At) -> Vec<Column> {
        let values = self.values(place);
        let rows = at.states.iter().enumerate();
        let rows = rows.map(|(row, state)| self.row_derivatives(row, place, &values, state));
        let rows: Vec<_> = rows.collect();
        let coordinates = 0..place.len();
        let column = |index: usize| {
            let parts = rows.iter().map(|row| row.as_ref()?[index].clone());
            Some(parts.collect::<Option<Vec<_>>>()?.concat())
        };
        coordinates.map(column).collect()
    }

    /// As [`Self::derivatives`], of a row.
    fn row_derivatives(
        &self,
        row: usize,
        place: &[f64],
        values: &[f64],
        state: &LoopState,
    ) -> Option<Vec<Column>> {
        let family = self.rows[row].as_ref().ok()?;
        let stated = |values: &[f64]| family.stated(values).ok().map(|(drive, _)| drive);
        let drive = stated(values)?;
        let known = model(drive.belt.kind).derivatives(&drive, state)?;
        let column = |index: usize| {
            let moved = |by: f64| {
                let mut beside = values.to_vec();
                beside[index] += by * self.scale(index, place);
                stated(&beside)
            };
            let readings = self.data.rows[row].readings.iter().zip(&self.data.measured);
            let readings = readings.filter_map(|(reading, of)| Some(((*reading)?, of)));
            let direction = Direction::new(&drive, moved)?;
            let derivatives = known.along(&direction, readings.clone().map(|(_, of)| of))?;
            let over = derivatives.into_iter().zip(readings);
            let over = over.map(|(value, (reading, _))| value / reading.deviation.unwrap_or(1.0));
            Some(over.collect())
        };
        Some((0..place.len()).map(column).collect())
    }

    /// The readings with their lines, the indices of what was measured, and what the model has.
    pub(super) fn told<'a>(
        &'a self,
        predictions: &'a Predictions,
    ) -> impl Iterator<Item = (usize, usize, Reading, f64)> + 'a {
        let rows = self.data.rows.iter().zip(predictions);
        rows.flat_map(|(row, predicted)| {
            let readings = row.readings.iter().zip(predicted).enumerate();
            readings.filter_map(|(index, (reading, model))| {
                Some((row.line, index, (*reading)?, (*model)?))
            })
        })
    }

    /// (y − f)/σ of all readings, with σ = 1 where none is stated.
    pub(super) fn residuals(&self, predictions: &Predictions) -> Vec<f64> {
        let told = self.told(predictions);
        told.map(|(_, _, reading, model)| {
            (reading.value - model) / reading.deviation.unwrap_or(1.0)
        })
        .collect()
    }
}

fn row_failure(row: &MeasuredRow, reason: &str) -> RowFailure {
    RowFailure {
        line: row.line,
        reason: reason.to_owned(),
    }
}
