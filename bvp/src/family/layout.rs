//! The flat vectors of a family.

use crate::discretisation::iterate::{Iterate, Residual};
use crate::discretisation::mesh::{Mesh, shares};
use crate::problem::problem::Segment;

/// Where the unknowns stand in a flat vector: for every segment the states at its nodes and its
/// stage slopes, then the free parameters, that of the family last. Residuals follow them: for every
/// segment the continuity and the stage residuals, then the conditions.
#[derive(Clone, Debug)]
pub(super) struct Layout {
    /// The indices in p of the free parameters, that of the family last.
    pub(super) free: Vec<usize>,
}

impl Layout {
    /// All of `parameters` are free but those `held`; the family has that of index `own`.
    pub(super) fn new(parameters: usize, own: usize, held: &[usize]) -> Self {
        let others = (0..parameters).filter(|index| *index != own && !held.contains(index));
        Self {
            free: others.chain([own]).collect(),
        }
    }

    /// Copies a flat vector into an iterate, but for the parameters that are held.
    pub(super) fn read(&self, mut z: &[f64], x: &mut Iterate) {
        for segment in &mut x.segments {
            take(&mut z, &mut segment.nodes);
            take(&mut z, &mut segment.stages);
        }
        for (&index, &value) in self.free.iter().zip(z) {
            x.p[index] = value;
        }
    }

    /// Copies an iterate into a flat vector.
    pub(super) fn write(&self, x: &Iterate, z: &mut [f64]) {
        let mut rest = z;
        for segment in &x.segments {
            rest = put(rest, &segment.nodes);
            rest = put(rest, &segment.stages);
        }
        for (&index, value) in self.free.iter().zip(rest) {
            *value = x.p[index];
        }
    }

    /// Copies a flat residual, with its sign turned, into a residual, with nothing for
    /// the conditions on the parameters that are held.
    pub(super) fn read_negative(&self, mut r: &[f64], segments: &[Segment], to: &mut Residual) {
        for (segment, values) in segments.iter().zip(&mut to.equations) {
            take(&mut r, &mut values.nodes[segment.states..]);
            take(&mut r, &mut values.stages);
        }
        let (own, held) = to.conditions.split_at_mut(r.len());
        own.copy_from_slice(r);
        held.fill(0.0);
        let values = to.equations.iter_mut();
        let values = values.flat_map(|values| values.nodes.iter_mut().chain(&mut values.stages));
        values.chain(own).for_each(|value| *value = -*value);
    }

    /// Copies a residual into a flat one.
    pub(super) fn write_residual(&self, from: &Residual, segments: &[Segment], g: &mut [f64]) {
        let mut rest = g;
        for (segment, values) in segments.iter().zip(&from.equations) {
            rest = put(rest, &values.nodes[segment.states..]);
            rest = put(rest, &values.stages);
        }
        let conditions = &from.conditions[..rest.len()];
        rest.copy_from_slice(conditions);
    }

    /// For every unknown but the last the function that it samples and the share of the function
    /// that it stands for: of a state the nodes, by the trapezoidal rule, and not the stages; a
    /// parameter is a function of its own.
    pub(super) fn groups(
        &self,
        segments: &[Segment],
        mesh: &Mesh,
        stages: usize,
        group: &mut [usize],
        share: &mut [f64],
    ) {
        let mut unknowns = group.iter_mut().zip(share);
        let mut set = |(group, share): (usize, f64)| {
            if let Some((g, s)) = unknowns.next() {
                (*g, *s) = (group, share);
            }
        };
        let mut first = 0;
        for (segment, nodes) in segments.iter().zip(mesh) {
            let states = first..first + segment.states;
            let last = nodes.len() - 1;
            for share in shares(nodes) {
                states.clone().for_each(|state| set((state, share)));
            }
            for _ in 0..last * stages {
                states.clone().for_each(|state| set((state, 0.0)));
            }
            first += segment.states;
        }
        (0..self.free.len() - 1).for_each(|parameter| set((first + parameter, 1.0)));
    }
}

/// Fills `to` with the first entries of `from` and goes on behind them.
fn take(from: &mut &[f64], to: &mut [f64]) {
    let (values, rest) = from.split_at(to.len());
    to.copy_from_slice(values);
    *from = rest;
}

/// Writes `values` at the beginning of `to` and returns what follows.
fn put<'z>(to: &'z mut [f64], values: &[f64]) -> &'z mut [f64] {
    let (here, rest) = to.split_at_mut(values.len());
    here.copy_from_slice(values);
    rest
}
