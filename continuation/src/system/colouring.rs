//! Sparse Jacobians by dual numbers: columns without common rows are evaluated together (Curtis, Powell &
//! Reid 1974).

use crate::difficulty::Cause;
use crate::system::exact::{Differentiable, derivative_along};
use bvp::Dual;

/// Number of derivatives that one evaluation carries.
const WIDTH: usize = 4;
/// The derivative along one direction may differ from that by the entries by this share of its terms:
/// rounding leaves 1e-15 times the number of terms.
const AGREEMENT: f64 = 1e-9;

/// Equations whose equation i depends on the states j of the pairs (i, j) of a pattern, and on λ.
pub(crate) struct Coloured<E> {
    equations: E,
    pattern: Vec<(usize, usize)>,
    /// The colour of every state: states of one colour share no equation.
    colours: Vec<usize>,
    /// The number of λ among the parameters.
    lambda: usize,
}

impl<E: Differentiable> Coloured<E> {
    /// Colours the states one after the other, each with the first colour that no state of its equations
    /// has.
    ///
    /// # Panics
    /// If the pattern has an equation or a state that does not exist.
    pub(crate) fn new(
        states: usize,
        pattern: &[(usize, usize)],
        lambda: usize,
        equations: E,
    ) -> Self {
        let mut columns = vec![Vec::new(); states];
        for &(row, column) in pattern {
            assert!(
                row < states && column < states,
                "no entry ({row}, {column})"
            );
            columns[column].push(row);
        }
        let mut used: Vec<Vec<usize>> = vec![Vec::new(); states];
        let colours = columns.iter().map(|rows| {
            let free = |colour: &usize| rows.iter().all(|&row| !used[row].contains(colour));
            let colour = (0..).find(free).unwrap_or(0);
            rows.iter().for_each(|&row| used[row].push(colour));
            colour
        });
        Self {
            colours: colours.collect(),
            equations,
            pattern: pattern.to_vec(),
            lambda,
        }
    }

    pub(crate) fn residual(&self, x: &[f64], p: &[f64], g: &mut [f64]) {
        self.equations.residual(x, p, g);
    }

    pub(crate) fn derivative_along(&self, at: [&[f64]; 2], rates: [&[f64]; 2], g: &mut [f64]) {
        derivative_along(&self.equations, at, rates, g);
    }

    /// Puts all entries of the pattern, then those of λ, in the same order always.
    ///
    /// # Errors
    /// Where an equation depends on a state outside the pattern.
    pub(crate) fn entries(
        &self,
        x: &[f64],
        p: &[f64],
        put: &mut dyn FnMut(usize, usize, f64),
    ) -> Result<(), Cause> {
        let n = x.len();
        let last = self.colours.iter().max().map_or(0, |colour| colour + 1);
        // Along one direction that no combination of entries can hide from.
        let rates: Vec<f64> = (0..=n).map(|i| 1.5 + (i as f64).sin()).collect();
        let (mut along, mut terms) = (vec![0.0; n], vec![0.0; n]);
        let mut found = |row: usize, column: usize, value: f64, rate: f64| {
            along[row] += value * rate;
            terms[row] += (value * rate).abs();
            put(row, column, value);
        };
        for first in (0..=last).step_by(WIDTH) {
            let g = self.batch(x, p, first, last);
            for &(row, column) in &self.pattern {
                let colour = self.colours[column];
                if (first..first + WIDTH).contains(&colour) {
                    found(row, column, g[row].gradient[colour - first], rates[column]);
                }
            }
            if (first..first + WIDTH).contains(&last) {
                for (row, g) in g.iter().enumerate() {
                    found(row, n + self.lambda, g.gradient[last - first], rates[n]);
                }
            }
        }
        let (mut check, mut parameters) = (vec![0.0; n], vec![0.0; p.len()]);
        parameters[self.lambda] = rates[n];
        self.derivative_along([x, p], [&rates[..n], &parameters], &mut check);
        let gap = |i: usize| (check[i] - along[i]).abs();
        match (0..n).find(|&i| gap(i) > AGREEMENT * (terms[i] + check[i].abs())) {
            Some(row) => {
                Err(format!("equation {row} depends on states outside the pattern").into())
            }
            None => Ok(()),
        }
    }

    /// G with the derivatives of the colours from `first` on, and of λ as the colour `last`.
    fn batch(&self, x: &[f64], p: &[f64], first: usize, last: usize) -> Vec<Dual<WIDTH>> {
        let dual = |value: f64, colour: usize| {
            let mut dual = Dual::<WIDTH>::constant(value);
            if (first..first + WIDTH).contains(&colour) {
                dual.gradient[colour - first] = 1.0;
            }
            dual
        };
        let states = x.iter().zip(&self.colours);
        let states: Vec<_> = states.map(|(&x, &colour)| dual(x, colour)).collect();
        let mut parameters: Vec<_> = p.iter().map(|&p| Dual::constant(p)).collect();
        parameters[self.lambda] = dual(p[self.lambda], last);
        let mut g = vec![Dual::constant(f64::NAN); x.len()];
        self.equations.residual(&states, &parameters, &mut g);
        g
    }
}
