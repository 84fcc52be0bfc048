//! Checks of what the caller states, before any arithmetic.

use crate::discretisation::iterate::Iterate;
use crate::discretisation::mesh::{Mesh, ceil, intervals, uniform};
use crate::problem::guess::Guess;
use crate::problem::held::Held;
use crate::problem::pieces::Pieces;
use crate::problem::problem::Segment;
use crate::result::error::Error;
use crate::solver::options::Options;

/// Checks that the problem is stated completely, with a condition for every state and parameter
/// except for `free` parameters.
pub(crate) fn check_statement(equations: &Held<'_>, free: usize) -> Result<(), Error> {
    let segments = equations.pieces().stated();
    if segments.is_empty() {
        return Err(Error::NoSegments);
    }
    for (index, segment) in segments.iter().enumerate() {
        if segment.states == 0 {
            return Err(Error::NoStates { segment: index });
        }
        let length = segment.to - segment.from;
        if length == 0.0 || !length.is_finite() {
            return Err(Error::Interval {
                segment: index,
                from: segment.from,
                to: segment.to,
            });
        }
        check_joined(index, segment)?;
    }
    let counts = segments.iter().map(|segment| segment.states);
    let states = counts.fold(0, usize::saturating_add);
    let parameters = equations.parameters() - free;
    let unknowns = states.saturating_add(parameters);
    let conditions = equations.own_conditions() + equations.held_count();
    if conditions != unknowns {
        return Err(Error::ConditionCount {
            conditions,
            unknowns,
            states,
            parameters,
        });
    }
    Ok(())
}

/// The equations with their states and parameters in the units of the options.
pub(crate) fn in_units<'a>(equations: &Held<'a>, options: &Options) -> Result<Held<'a>, Error> {
    let (found, parameters) = (options.absolute.len(), equations.parameters());
    let segments = equations.pieces().stated().iter();
    let states: usize = segments.map(|segment| segment.states).sum();
    if ![0, states, states + parameters].contains(&found) {
        return Err(Error::AbsoluteCount {
            found,
            states,
            parameters,
        });
    }
    Ok(equations.in_units(&options.absolute))
}

/// Checks that joined points lie inside their segment and in its order.
fn check_joined(index: usize, segment: &Segment) -> Result<(), Error> {
    let Segment { from, to, .. } = *segment;
    let mut before = from;
    for &point in &segment.joined {
        let is_between = |a: f64, b: f64| (a < point && point < b) || (b < point && point < a);
        if !is_between(before, to) {
            return Err(Error::Joined {
                segment: index,
                point,
                from,
                to,
            });
        }
        before = point;
    }
    Ok(())
}

/// The mesh to start on: that of the guess or equal intervals, if the guess fits the problem.
pub(crate) fn first_mesh(
    equations: &Held<'_>,
    guess: &dyn Guess,
    options: &Options,
) -> Result<Mesh, Error> {
    let pieces = equations.pieces();
    let segments = pieces.stated();
    let limit = options.max_intervals;
    let allow = |intervals| match intervals > limit {
        true => Err(Error::FirstMesh { intervals, limit }),
        false => Ok(()),
    };
    let stated = guess.mesh();
    match &stated {
        // Before so many nodes are made.
        None => allow(options.initial_intervals.saturating_mul(segments.len()))?,
        Some(mesh) => check_nodes(segments, mesh)?,
    }
    check_guess_shape(equations, guess, stated.as_ref())?;
    let mesh = match stated {
        None => equal_intervals(pieces, options.initial_intervals),
        Some(mesh) => pieces.divide(mesh),
    };
    allow(intervals(&mesh))?;
    Ok(mesh)
}

/// Checks that a guess with this mesh has the states and parameters of a problem.
pub(crate) fn check_guess_shape(
    equations: &Held<'_>,
    guess: &dyn Guess,
    mesh: Option<&Mesh>,
) -> Result<(), Error> {
    for (index, segment) in equations.pieces().stated().iter().enumerate() {
        let nodes = mesh.and_then(|mesh| mesh.get(index));
        let needed = segment.states * nodes.map_or(1, Vec::len);
        let found = guess.state_values(index, segment).unwrap_or(needed);
        if found != needed {
            return Err(Error::GuessStates {
                segment: index,
                found,
                needed,
            });
        }
    }
    let needed = equations.parameters();
    let found = guess.parameter_values().unwrap_or(needed);
    if found != needed {
        return Err(Error::GuessParameters { found, needed });
    }
    Ok(())
}

/// This number of equal intervals for every segment, shared among its pieces by their lengths.
fn equal_intervals(pieces: &Pieces, intervals: usize) -> Mesh {
    let nodes = |segment: usize| {
        let pieces = &pieces.all()[pieces.of(segment)];
        let length: f64 = pieces.iter().map(|piece| piece.to - piece.from).sum();
        let share = |piece: &Segment| match pieces.len() {
            1 => intervals,
            _ => ceil(intervals as f64 * ((piece.to - piece.from) / length)),
        };
        let of_piece = move |piece: &Segment| uniform(piece, share(piece));
        pieces.iter().map(of_piece).collect::<Mesh>()
    };
    (0..pieces.stated().len()).flat_map(nodes).collect()
}

/// Checks that a mesh which was given divides the segments.
pub(crate) fn check_nodes(segments: &[Segment], mesh: &Mesh) -> Result<(), Error> {
    for (index, segment) in segments.iter().enumerate() {
        let fits = mesh.get(index).is_some_and(|nodes| segment.has_mesh(nodes));
        if !fits || mesh.len() != segments.len() {
            return Err(Error::GuessMesh {
                segment: index,
                from: segment.from,
                to: segment.to,
            });
        }
    }
    Ok(())
}

/// Checks that a guess is finite.
pub(crate) fn check_guess(x: &Iterate, mesh: &Mesh) -> Result<(), Error> {
    for (index, (segment, nodes)) in x.segments.iter().zip(mesh).enumerate() {
        let values = segment.nodes.len();
        if let Some(i) = segment.nodes.iter().position(|y| !y.is_finite()) {
            return Err(Error::Guess {
                segment: index,
                s: nodes[i * nodes.len() / values],
            });
        }
        let slopes = segment.stages.len();
        if let Some(i) = segment.stages.iter().position(|y| !y.is_finite()) {
            return Err(Error::Guess {
                segment: index,
                s: nodes[i * (nodes.len() - 1) / slopes],
            });
        }
    }
    match x.p.iter().position(|p| !p.is_finite()) {
        Some(parameter) => Err(Error::GuessParameter { parameter }),
        None => Ok(()),
    }
}
