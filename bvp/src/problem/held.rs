//! Equations in the form in which the solver works with them.

use crate::problem::equations::{Equations, Shape};
use crate::problem::guess::Guess;
use crate::problem::in_units::{InUnits, Units, divide};
use crate::problem::pieces::Pieces;
use crate::problem::problem::{Ends, Segment};
use std::sync::Arc;

/// Equations on the pieces of their segments, in units, with more conditions after their own: continuity
/// where pieces meet, and pᵢ − value = 0 for each of some parameters that are held. Their shape is asked
/// for once, so that no evaluation allocates.
#[derive(Clone)]
pub(crate) struct Held<'a> {
    equations: InUnits<'a>,
    /// The equations as stated, where every segment is its own piece and there are no units.
    as_stated: Option<&'a dyn Equations>,
    pieces: Arc<Pieces>,
    parameters: usize,
    /// Number of conditions of the equations themselves.
    own: usize,
    /// Index of each held parameter, and its value in its unit.
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
        Self::with_values(InUnits::none(equations), values)
    }

    fn with_values(equations: InUnits<'a>, values: Vec<(usize, f64)>) -> Self {
        let shape = equations.shape();
        let pieces = Arc::new(Pieces::new(shape.segments));
        Self {
            as_stated: as_stated(&equations, &pieces),
            equations,
            pieces,
            parameters: shape.parameters,
            own: shape.conditions,
            values,
        }
    }

    /// Other equations with the same parameters held at the same values, in the same units.
    pub(crate) fn exchanged<'b>(&self, equations: &'b dyn Equations) -> Held<'b> {
        Held::with_values(self.equations.exchanged(equations), self.values.clone())
    }

    /// The same equations with their states and parameters in units of about these sizes, those of the
    /// states of all segments and then those of the parameters, or without these; with none as they are.
    pub(crate) fn in_units(&self, absolute: &[f64]) -> Self {
        let mut new = self.clone();
        new.equations = self.equations.with(absolute);
        new.as_stated = as_stated(&new.equations, &new.pieces);
        for (index, value) in &mut new.values {
            *value *= self.equations.parameter_unit(*index);
            *value /= new.equations.parameter_unit(*index);
        }
        new
    }

    /// The units of states and parameters, if there are any.
    pub(crate) fn units(&self) -> Option<&Units> {
        self.equations.units()
    }

    /// The pieces, which are the segments of the solver.
    pub(crate) fn segments(&self) -> &[Segment] {
        self.pieces.all()
    }

    /// How the segments are divided into pieces.
    pub(crate) fn pieces(&self) -> &Pieces {
        &self.pieces
    }

    /// A guess of the segments as one of the pieces, in units.
    pub(crate) fn divided(&'a self, guess: &'a dyn Guess) -> Divided<'a> {
        let equations = self;
        Divided { guess, equations }
    }

    /// Number of parameters, held or not.
    pub(crate) fn parameters(&self) -> usize {
        self.parameters
    }

    /// Number of all conditions.
    pub(crate) fn condition_count(&self) -> usize {
        self.own + self.pieces.continuity() + self.values.len()
    }

    /// Number of conditions of the equations themselves.
    pub(crate) fn own_conditions(&self) -> usize {
        self.own
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
        held.map(|(_, value)| value * self.equations.parameter_unit(index))
    }

    /// Holds a parameter at another value; returns whether it is held at all.
    pub(crate) fn hold(&mut self, index: usize, value: f64) -> bool {
        let value = value / self.equations.parameter_unit(index);
        let held = self.values.iter_mut().find(|(held, _)| *held == index);
        held.map(|(_, held)| *held = value).is_some()
    }

    /// The states at the ends of all pieces as those at the ends and joined points of the segments.
    fn stated<'b>(&'b self, at: Ends<'b, f64>) -> Ends<'b, f64> {
        Ends::new(self.pieces.stated(), at.values())
    }

    /// The places, among the states at the ends of all pieces, of those that are equal: before and
    /// behind every joined point.
    fn meetings(&self) -> impl Iterator<Item = [usize; 2]> {
        let mut first = 0;
        let each = self.pieces.stated().iter().map(move |segment| {
            let (n, start) = (segment.states, first);
            first += 2 * n * (segment.joined.len() + 1);
            (n, start, segment.joined.len())
        });
        each.flat_map(|(n, start, points)| {
            let before = move |i| start + (2 * (i / n) + 1) * n + i % n;
            (0..n * points).map(move |i| [before(i), before(i) + n])
        })
    }

    /// The right-hand side of a piece.
    #[inline(never)]
    fn evaluate_piece(&self, piece: usize, t: f64, y: &[f64], p: &[f64], dy: &mut [f64]) {
        let (segment, s, sign) = self.pieces.place(piece, t);
        self.equations.evaluate_rhs(segment, s, y, p, dy);
        scale(dy, sign);
    }

    /// The same with its derivatives.
    #[inline(never)]
    fn piece_jacobian(
        &self,
        piece: usize,
        t: f64,
        y: &[f64],
        p: &[f64],
        dy: &mut [f64],
        jacobian: &mut [f64],
    ) {
        let (segment, s, sign) = self.pieces.place(piece, t);
        self.equations.rhs_jacobian(segment, s, y, p, dy, jacobian);
        scale(dy, sign);
        scale(jacobian, sign);
    }

    /// Writes the held values, in their units, into `p`.
    pub(crate) fn fill(&self, p: &mut [f64]) {
        for &(index, value) in &self.values {
            p[index] = value;
        }
    }
}

impl Equations for Held<'_> {
    fn shape(&self) -> Shape {
        Shape {
            segments: self.segments().to_vec(),
            parameters: self.parameters,
            conditions: self.condition_count(),
        }
    }

    #[inline(always)]
    fn evaluate_rhs(&self, piece: usize, t: f64, y: &[f64], p: &[f64], dy: &mut [f64]) {
        match self.as_stated {
            Some(equations) => equations.evaluate_rhs(piece, t, y, p, dy),
            None => self.evaluate_piece(piece, t, y, p, dy),
        }
    }

    #[inline(always)]
    fn rhs_jacobian(
        &self,
        piece: usize,
        t: f64,
        y: &[f64],
        p: &[f64],
        dy: &mut [f64],
        jacobian: &mut [f64],
    ) {
        match self.as_stated {
            Some(equations) => equations.rhs_jacobian(piece, t, y, p, dy, jacobian),
            None => self.piece_jacobian(piece, t, y, p, dy, jacobian),
        }
    }

    /// In pieces and in units the points are evaluated one by one.
    fn is_vectorised(&self) -> bool {
        self.as_stated.is_some_and(Equations::is_vectorised)
    }

    fn evaluate_rhs_at(&self, piece: usize, t: &[f64], y: &[f64], p: &[f64], dy: &mut [f64]) {
        if let Some(equations) = self.as_stated {
            equations.evaluate_rhs_at(piece, t, y, p, dy);
        }
    }

    fn rhs_jacobian_at(
        &self,
        piece: usize,
        t: &[f64],
        y: &[f64],
        p: &[f64],
        dy: &mut [f64],
        jacobians: &mut [f64],
    ) {
        if let Some(equations) = self.as_stated {
            equations.rhs_jacobian_at(piece, t, y, p, dy, jacobians);
        }
    }

    fn evaluate_conditions(&self, at: Ends<'_, f64>, p: &[f64], r: &mut [f64]) {
        let (own, rest) = r.split_at_mut(self.own);
        let (continuity, held) = rest.split_at_mut(self.pieces.continuity());
        self.equations.evaluate_conditions(self.stated(at), p, own);
        for (r, [before, behind]) in continuity.iter_mut().zip(self.meetings()) {
            *r = at.values()[before] - at.values()[behind];
        }
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
        let (own, rest) = r.split_at_mut(self.own);
        let (continuity, held) = rest.split_at_mut(self.pieces.continuity());
        let ends = at.values().len();
        let columns = ends + p.len();
        let (own_rows, rows) = jacobian.split_at_mut(own.len() * columns);
        let (continuity_rows, held_rows) = rows.split_at_mut(continuity.len() * columns);
        let stated = self.stated(at);
        self.equations.conditions_jacobian(stated, p, own, own_rows);
        let rows = continuity.iter_mut();
        let rows = rows.zip(continuity_rows.chunks_exact_mut(columns));
        for ((r, row), [before, behind]) in rows.zip(self.meetings()) {
            *r = at.values()[before] - at.values()[behind];
            row.fill(0.0);
            row[before] = 1.0;
            row[behind] = -1.0;
        }
        let rows = held.iter_mut().zip(held_rows.chunks_exact_mut(columns));
        for ((r, row), (index, value)) in rows.zip(&self.values) {
            *r = p[*index] - value;
            row.fill(0.0);
            row[ends + index] = 1.0;
        }
    }
}

/// The equations as stated, where every segment is its own piece and there are no units.
fn as_stated<'a>(equations: &InUnits<'a>, pieces: &Pieces) -> Option<&'a dyn Equations> {
    equations.as_stated().filter(|_| pieces.are_plain())
}

/// Turns the sign where that is wanted.
fn scale(values: &mut [f64], sign: f64) {
    values.iter_mut().for_each(|value| *value *= sign);
}

/// A guess of the segments as one of the pieces, in units.
pub(crate) struct Divided<'a> {
    guess: &'a dyn Guess,
    equations: &'a Held<'a>,
}

impl Guess for Divided<'_> {
    fn state(&self, piece: usize, t: f64, y: &mut [f64]) {
        let (segment, s, _) = self.equations.pieces.place(piece, t);
        self.guess.state(segment, s, y);
        if let Some(units) = self.equations.units() {
            divide(y, units.of_states(segment));
        }
    }

    fn parameters(&self, p: &mut [f64]) {
        self.guess.parameters(p);
        if let Some(units) = self.equations.units() {
            divide(p, units.of_parameters());
        }
    }

    fn mesh(&self) -> Option<Vec<Vec<f64>>> {
        let mesh = self.guess.mesh()?;
        Some(self.equations.pieces.divide(mesh))
    }
}
