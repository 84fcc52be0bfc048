//! Solutions and errors of the pieces that the solver knows, in the segments and units of the statement.

use crate::discretisation::iterate::{Iterate, SegmentIterate};
use crate::problem::held::Held;
use crate::problem::in_units::{divide, multiply};
use crate::problem::pieces::Pieces;
use crate::problem::unknown::Unknown;
use crate::result::error::Error;
use crate::result::quality::{Defects, GlobalErrors, Quality};
use crate::result::solution::Solution;

/// What the solver says of the pieces of equations, said of their segments.
pub(crate) fn restore(
    equations: &Held<'_>,
    outcome: Result<Solution, Error>,
) -> Result<Solution, Error> {
    match outcome {
        Ok(solution) => Ok(restored(equations, solution)),
        Err(error) => Err(restored_error(equations, error)),
    }
}

/// The solution of the segments with this solution of their pieces.
pub(crate) fn restored(equations: &Held<'_>, solution: Solution) -> Solution {
    let (pieces, own) = (equations.pieces(), equations.own_conditions());
    let mut solution = solution;
    if let Some(units) = equations.units() {
        solution.absolute = units.all();
        from_units(equations, &mut solution.x);
    }
    if pieces.are_plain() {
        return solution;
    }
    let segments = || 0..pieces.stated().len();
    let join = |values: &[Vec<f64>]| -> Vec<Vec<f64>> {
        let joined = |segment: usize| values[pieces.of(segment)].concat();
        segments().map(joined).collect()
    };
    let mut conditions = solution.quality.conditions;
    if !conditions.is_empty() {
        conditions.drain(own..own + pieces.continuity());
    }
    Solution {
        mesh: segments()
            .map(|segment| joined_nodes(pieces, segment, &solution.mesh))
            .collect(),
        x: Iterate {
            segments: segments()
                .map(|segment| joined_iterate(pieces, segment, &solution.x))
                .collect(),
            p: solution.x.p,
        },
        quality: Quality {
            defects: Defects {
                relative: join(&solution.quality.defects.relative),
                local: join(&solution.quality.defects.local),
            },
            conditions,
            errors: solution.quality.errors.map(|errors| GlobalErrors {
                states: segments()
                    .map(|segment| largest(&errors.states[pieces.of(segment)]))
                    .collect(),
                ..errors
            }),
        },
        segments: pieces.stated().to_vec(),
        absolute: solution.absolute,
        tableau: solution.tableau,
        stats: solution.stats,
    }
}

/// The nodes of a segment from those of its pieces.
pub(crate) fn joined_nodes(pieces: &Pieces, segment: usize, mesh: &[Vec<f64>]) -> Vec<f64> {
    let of = pieces.of(segment);
    let (_, sign) = pieces.origin(of.start);
    let first = mesh[of.start][0];
    let behind = mesh[of].iter().flat_map(|nodes| &nodes[1..]);
    [&first]
        .into_iter()
        .chain(behind)
        .map(|t| sign * t)
        .collect()
}

/// The polynomials of a segment from those of its pieces, which agree where they meet.
fn joined_iterate(pieces: &Pieces, segment: usize, x: &Iterate) -> SegmentIterate {
    let (of, n) = (pieces.of(segment), pieces.stated()[segment].states);
    let (_, sign) = pieces.origin(of.start);
    let mut joined = SegmentIterate {
        nodes: x.segments[of.start].nodes[..n].to_vec(),
        stages: vec![],
    };
    for piece in &x.segments[of] {
        joined.nodes.extend(&piece.nodes[n..]);
        joined.stages.extend(piece.stages.iter().map(|k| sign * k));
    }
    joined
}

/// The largest of each state.
fn largest(errors: &[Vec<f64>]) -> Vec<f64> {
    let mut all = errors[0].clone();
    for errors in &errors[1..] {
        for (a, &b) in all.iter_mut().zip(errors) {
            *a = a.max(b);
        }
    }
    all
}

/// What the numbers of an iterate in units stand for.
pub(crate) fn from_units(equations: &Held<'_>, x: &mut Iterate) {
    change_units(equations, x, multiply);
}

/// The numbers of an iterate in units.
pub(crate) fn to_units(equations: &Held<'_>, x: &mut Iterate) {
    change_units(equations, x, divide);
}

/// Multiplies all unknowns by their units, or divides them.
fn change_units(equations: &Held<'_>, x: &mut Iterate, change: fn(&mut [f64], &[f64])) {
    let Some(units) = equations.units() else {
        return;
    };
    for (piece, x) in x.segments.iter_mut().enumerate() {
        let (segment, _) = equations.pieces().origin(piece);
        change(&mut x.nodes, units.of_states(segment));
        change(&mut x.stages, units.of_states(segment));
    }
    change(&mut x.p, units.of_parameters());
}

/// The unknowns of the pieces of a solution of the segments of equations whose mesh has the joined points.
pub(crate) fn divided(equations: &Held<'_>, solution: &Solution) -> Iterate {
    let pieces = equations.pieces();
    let (m, mesh) = (
        solution.tableau.stages,
        pieces.divide(solution.mesh.clone()),
    );
    let mut first = vec![0; pieces.stated().len()];
    let each = mesh.iter().enumerate().map(|(piece, nodes)| {
        let (segment, sign) = pieces.origin(piece);
        let (n, intervals) = (pieces.stated()[segment].states, nodes.len() - 1);
        let x = &solution.x.segments[segment];
        let i = first[segment];
        first[segment] += intervals;
        let stages = &x.stages[i * m * n..][..intervals * m * n];
        SegmentIterate {
            nodes: x.nodes[i * n..][..(intervals + 1) * n].to_vec(),
            stages: stages.iter().map(|k| sign * k).collect(),
        }
    });
    let mut x = Iterate {
        segments: each.collect(),
        p: solution.x.p.clone(),
    };
    to_units(equations, &mut x);
    x
}

/// The error with the places and the conditions of the statement.
pub(crate) fn restored_error(equations: &Held<'_>, mut error: Error) -> Error {
    let (pieces, own) = (equations.pieces(), equations.own_conditions());
    if pieces.are_plain() && equations.units().is_none() {
        return error;
    }
    let place = |segment: &mut usize, s: &mut f64| {
        let sign;
        (*segment, sign) = pieces.origin(*segment);
        *s *= sign;
    };
    // Conditions of continuity stand between those of the statement and those of held parameters.
    let behind = own + pieces.continuity();
    let number = |condition: usize| match condition {
        _ if condition < own => Some(condition),
        _ if condition < behind => None,
        _ => Some(condition - pieces.continuity()),
    };
    let unknown = |unknown: &mut Option<Unknown>| {
        if let Some(Unknown::State { segment, s, .. }) = unknown {
            place(segment, s);
        }
    };
    match &mut error {
        Error::Guess { segment, s }
        | Error::NonFiniteRhs { segment, s, .. }
        | Error::MeshLimit { segment, s, .. }
        | Error::Unresolved { segment, s, .. } => place(segment, s),
        Error::SingularNode {
            segment,
            node,
            s,
            best,
        } => {
            let piece = *segment;
            place(segment, s);
            let before = &best.mesh[pieces.of(*segment).start..piece];
            *node += before.iter().map(|nodes| nodes.len() - 1).sum::<usize>();
        }
        Error::SingularConditions {
            conditions, free, ..
        } => {
            *conditions = conditions.iter().filter_map(|c| number(*c)).collect();
            unknown(free);
        }
        Error::NoConvergence { largest, .. } => unknown(largest),
        Error::ConditionViolated { condition, .. } => {
            *condition = number(*condition).unwrap_or(*condition);
        }
        _ => {}
    }
    if let Some(best) = error.best_mut() {
        let whole = restored(equations, best.clone());
        *best = whole;
    }
    error
}
