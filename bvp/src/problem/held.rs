//! Equations with some of their parameters held.

use crate::problem::equations::{Equations, Shape};
use crate::problem::problem::{Ends, Segment};

/// Equations with one more condition pᵢ − value = 0 for each of some parameters, after their own.
/// Their shape is asked for once, so that no evaluation allocates.
#[derive(Clone)]
pub(crate) struct Held<'a> {
    equations: &'a dyn Equations,
    /// With the conditions of the held parameters.
    shape: Shape,
    /// Index and value of each held parameter.
    values: Vec<(usize, f64)>,
}

impl<'a> Held<'a> {
    /// The equations as they are.
    pub(crate) fn none(equations: &'a dyn Equations) -> Self {
        Self::new(equations, &[], &[])
    }

    /// The equations with the parameters of these indices held at their values in `p`.
    pub(crate) fn new(equations: &'a dyn Equations, indices: &[usize], p: &[f64]) -> Self {
        let values = indices.iter().map(|&index| (index, p[index])).collect();
        Self::with_values(equations, values)
    }

    fn with_values(equations: &'a dyn Equations, values: Vec<(usize, f64)>) -> Self {
        let mut shape = equations.shape();
        shape.conditions += values.len();
        Self {
            equations,
            shape,
            values,
        }
    }

    /// Other equations with the same parameters held at the same values.
    pub(crate) fn exchanged<'b>(&self, equations: &'b dyn Equations) -> Held<'b> {
        Held::with_values(equations, self.values.clone())
    }

    /// The segments.
    pub(crate) fn segments(&self) -> &[Segment] {
        &self.shape.segments
    }

    /// Number of parameters, held or not.
    pub(crate) fn parameters(&self) -> usize {
        self.shape.parameters
    }

    /// Number of conditions, with those of the held parameters.
    pub(crate) fn condition_count(&self) -> usize {
        self.shape.conditions
    }

    /// Number of parameters held.
    pub(crate) fn held_count(&self) -> usize {
        self.values.len()
    }

    /// The indices of the parameters held, in the order in which they were named.
    pub(crate) fn indices(&self) -> impl Iterator<Item = usize> {
        self.values.iter().map(|(index, _)| *index)
    }

    /// The value of a parameter, if it is held.
    pub(crate) fn value(&self, index: usize) -> Option<f64> {
        let held = self.values.iter().find(|(held, _)| *held == index);
        held.map(|(_, value)| *value)
    }

    /// Holds a parameter at another value; returns whether it is held at all.
    pub(crate) fn hold(&mut self, index: usize, value: f64) -> bool {
        let held = self.values.iter_mut().find(|(held, _)| *held == index);
        held.map(|(_, held)| *held = value).is_some()
    }

    /// Writes the held values into `p`.
    pub(crate) fn fill(&self, p: &mut [f64]) {
        for &(index, value) in &self.values {
            p[index] = value;
        }
    }
}

impl Equations for Held<'_> {
    fn shape(&self) -> Shape {
        self.shape.clone()
    }

    fn evaluate_rhs(&self, segment: usize, s: f64, y: &[f64], p: &[f64], dy: &mut [f64]) {
        self.equations.evaluate_rhs(segment, s, y, p, dy);
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
        self.equations.rhs_jacobian(segment, s, y, p, dy, jacobian);
    }

    fn evaluate_conditions(&self, at: Ends<'_, f64>, p: &[f64], r: &mut [f64]) {
        let (own, held) = r.split_at_mut(r.len() - self.values.len());
        self.equations.evaluate_conditions(at, p, own);
        for (r, (index, value)) in held.iter_mut().zip(&self.values) {
            *r = p[*index] - value;
        }
    }

    fn conditions_jacobian(
        &self,
        at: Ends<'_, f64>,
        p: &[f64],
        r: &mut [f64],
        jacobian: &mut [f64],
    ) {
        let (own, held) = r.split_at_mut(r.len() - self.values.len());
        let ends = at.values().len();
        let columns = ends + p.len();
        let (own_rows, held_rows) = jacobian.split_at_mut(own.len() * columns);
        self.equations.conditions_jacobian(at, p, own, own_rows);
        let rows = held.iter_mut().zip(held_rows.chunks_exact_mut(columns));
        for ((r, row), (index, value)) in rows.zip(&self.values) {
            *r = p[*index] - value;
            row.fill(0.0);
            row[ends + index] = 1.0;
        }
    }
}
