//! Functions of Python as the equations of a boundary value problem.

use crate::numbers::Numbers;
use ::bvp::{Ends, Equations, Segment, Shape};
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use std::sync::{Mutex, PoisonError};

/// Step of a central difference relative to 1 + |z|: the cube root of the rounding unit balances rounding against
/// truncation, for about ten correct digits.
const STEP: f64 = 6e-6;

/// A function of Python that returns the bytes of an array, and one for its derivatives.
type Function = (Py<PyAny>, Option<Py<PyAny>>);

/// A problem with n states on one segment and k parameters, and n + k conditions.
pub(super) struct Statement {
    states: usize,
    parameters: usize,
    range: [f64; 2],
    /// (places, states, parameters): arrays of m, n × m and k numbers. Returns n × m numbers; the derivatives are
    /// n × (n + k) × m numbers.
    rhs: Function,
    /// (start, end, parameters): arrays of n, n and k numbers. Returns n + k numbers; the derivatives are
    /// (n + k) × (2 n + k) numbers.
    conditions: Function,
    /// The first exception; nothing is called after it.
    failure: Mutex<Option<PyErr>>,
}

/// The numbers of the bytes of an array.
pub(super) fn numbers(bytes: &[u8]) -> Vec<f64> {
    let numbers = bytes.as_chunks().0.iter();
    numbers.map(|bytes| f64::from_ne_bytes(*bytes)).collect()
}

impl Statement {
    /// n states and k parameters on a range, with right-hand side and conditions.
    pub(super) fn new(
        [states, parameters]: [usize; 2],
        range: [f64; 2],
        [rhs, conditions]: [Function; 2],
    ) -> Self {
        Self {
            states,
            parameters,
            range,
            rhs,
            conditions,
            failure: Mutex::new(None),
        }
    }

    /// The first exception of the functions.
    pub(super) fn failure(self) -> Option<PyErr> {
        let failure = self.failure.into_inner();
        failure.unwrap_or_else(PoisonError::into_inner)
    }

    /// What a function of Python returns for three arrays, if it returns that many numbers.
    fn call(&self, function: &Py<PyAny>, arrays: [Numbers; 3], count: usize) -> Option<Vec<f64>> {
        let mut failure = self.failure.lock().unwrap_or_else(PoisonError::into_inner);
        if failure.is_some() {
            return None;
        }
        let called = Python::attach(|py| {
            // An interrupt from the keyboard ends the work.
            py.check_signals()?;
            let [first, second, third] = arrays;
            let bytes = function.bind(py).call1((first, second, third))?;
            Ok(numbers(bytes.cast::<PyBytes>()?.as_bytes()))
        });
        match called {
            Ok(numbers) => Some(numbers).filter(|numbers| numbers.len() == count),
            Err(error) => {
                *failure = Some(error);
                None
            }
        }
    }

    /// f at points: n numbers for each, one state after the other; `y` alike.
    fn rhs(&self, s: &[f64], y: &[f64], p: &[f64]) -> Option<Vec<f64>> {
        let points = Numbers::table(y.to_vec(), [self.states, s.len()]);
        let arrays = [Numbers::row(s.to_vec()), points, Numbers::row(p.to_vec())];
        self.call(&self.rhs.0, arrays, y.len())
    }

    /// The derivatives of f at points, each an array of one number a point: one row of the Jacobian after the other.
    fn rhs_derivatives(&self, s: &[f64], y: &[f64], p: &[f64]) -> Option<Vec<f64>> {
        let (n, m, columns) = (self.states, s.len(), self.states + self.parameters);
        if let Some(function) = &self.rhs.1 {
            let points = Numbers::table(y.to_vec(), [n, m]);
            let arrays = [Numbers::row(s.to_vec()), points, Numbers::row(p.to_vec())];
            return self.call(function, arrays, n * columns * m);
        }
        let mut derivatives = vec![0.0; n * columns * m];
        let (mut y, mut p) = (y.to_vec(), p.to_vec());
        for column in 0..columns {
            let moved = match column.checked_sub(n) {
                None => column * m..(column + 1) * m,
                Some(parameter) => parameter..parameter + 1,
            };
            let is_state = column < n;
            let own = if is_state { &y } else { &p }[moved.clone()].to_vec();
            let mut at = |sign: f64| {
                let varied = if is_state { &mut y } else { &mut p };
                for (value, own) in varied[moved.clone()].iter_mut().zip(&own) {
                    *value = own + sign * step(*own);
                }
                self.rhs(s, &y, &p)
            };
            let [above, below] = [at(1.0)?, at(-1.0)?];
            let varied = if is_state { &mut y } else { &mut p };
            varied[moved].copy_from_slice(&own);
            for state in 0..n {
                for point in 0..m {
                    let own = own[point % own.len()];
                    let difference = above[state * m + point] - below[state * m + point];
                    derivatives[(state * columns + column) * m + point] = difference / width(own);
                }
            }
        }
        Some(derivatives)
    }

    fn condition_values(&self, ends: &[f64], p: &[f64]) -> Option<Vec<f64>> {
        let (start, end) = ends.split_at(self.states);
        let arrays = [start, end, p].map(|numbers| Numbers::row(numbers.to_vec()));
        self.call(&self.conditions.0, arrays, self.states + self.parameters)
    }

    fn condition_derivatives(&self, ends: &[f64], p: &[f64]) -> Option<Vec<f64>> {
        let (rows, columns) = (self.states + self.parameters, ends.len() + p.len());
        if let Some(function) = &self.conditions.1 {
            let (start, end) = ends.split_at(self.states);
            let arrays = [start, end, p].map(|numbers| Numbers::row(numbers.to_vec()));
            return self.call(function, arrays, rows * columns);
        }
        let mut derivatives = vec![0.0; rows * columns];
        let mut all = [ends, p].concat();
        for column in 0..columns {
            let own = all[column];
            let mut at = |sign: f64| {
                all[column] = own + sign * step(own);
                let (ends, p) = all.split_at(ends.len());
                self.condition_values(ends, p)
            };
            let [above, below] = [at(1.0)?, at(-1.0)?];
            all[column] = own;
            for (row, (above, below)) in above.iter().zip(&below).enumerate() {
                derivatives[row * columns + column] = (above - below) / width(own);
            }
        }
        Some(derivatives)
    }
}

fn step(value: f64) -> f64 {
    STEP * (1.0 + value.abs())
}

/// The distance of both values of a central difference as they are, after rounding.
fn width(value: f64) -> f64 {
    (value + step(value)) - (value - step(value))
}

/// Columns of a table with some rows as its rows.
fn transposed(table: &[f64], rows: usize) -> Vec<f64> {
    let columns = table.len() / rows;
    let place = |place: usize| table[place % rows * columns + place / rows];
    (0..table.len()).map(place).collect()
}

/// Results that are missing stay as they are: no numbers.
fn write(results: Option<Vec<f64>>, into: &mut [f64]) {
    if let Some(results) = results {
        into.copy_from_slice(&results);
    }
}

impl Equations for Statement {
    fn shape(&self) -> Shape {
        let [from, to] = self.range;
        Shape::new(vec![Segment::on(self.states, from, to)], self.parameters)
    }

    fn is_vectorised(&self) -> bool {
        true
    }

    fn evaluate_rhs(&self, segment: usize, s: f64, y: &[f64], p: &[f64], dy: &mut [f64]) {
        self.evaluate_rhs_at(segment, &[s], y, p, dy);
    }

    fn evaluate_rhs_at(&self, _segment: usize, s: &[f64], y: &[f64], p: &[f64], dy: &mut [f64]) {
        let values = self.rhs(s, &transposed(y, s.len()), p);
        write(values.map(|values| transposed(&values, self.states)), dy);
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
        self.rhs_jacobian_at(segment, &[s], y, p, dy, jacobian);
    }

    fn rhs_jacobian_at(
        &self,
        segment: usize,
        s: &[f64],
        y: &[f64],
        p: &[f64],
        dy: &mut [f64],
        jacobians: &mut [f64],
    ) {
        self.evaluate_rhs_at(segment, s, y, p, dy);
        let values = self.rhs_derivatives(s, &transposed(y, s.len()), p);
        let entries = self.states * (self.states + self.parameters);
        write(values.map(|values| transposed(&values, entries)), jacobians);
    }

    fn evaluate_conditions(&self, at: Ends<'_, f64>, p: &[f64], r: &mut [f64]) {
        write(self.condition_values(at.values(), p), r);
    }

    fn conditions_jacobian(
        &self,
        at: Ends<'_, f64>,
        p: &[f64],
        r: &mut [f64],
        jacobian: &mut [f64],
    ) {
        write(self.condition_values(at.values(), p), r);
        write(self.condition_derivatives(at.values(), p), jacobian);
    }
}
