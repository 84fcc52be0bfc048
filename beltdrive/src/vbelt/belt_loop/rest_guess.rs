//! Guesses of the belt at rest: from nothing, and from a solved one.

use super::rest::{Rest, RestProblem};
use super::seating::Seating;
use super::tensioner::coordinate_unit;

/// The belt at rest before it is solved: pressed into every groove as if the contact were long.
pub(super) struct RestGuess<'a> {
    problem: &'a RestProblem,
    /// Belt tension, N.
    tension: f64,
    /// Coordinate of the tensioner, rad or m.
    coordinate: f64,
    seated: Vec<Seated>,
}

/// The belt in a groove.
struct Seated {
    seating: Seating,
    /// Scaled contact length.
    length: f64,
    /// Angle swept, rad.
    swept: f64,
}

impl<'a> RestGuess<'a> {
    /// With a belt tension in N and a coordinate of the tensioner in rad or m. The error is a pulley
    /// through whose groove the belt is pressed, with the largest tension that it carries, N.
    pub(super) fn new(
        problem: &'a RestProblem,
        tension: f64,
        coordinate: f64,
    ) -> Result<Self, (usize, f64)> {
        let force = problem.units.force;
        let seated = problem.grooves.iter().map(|(pulley, groove)| {
            let largest = groove.largest_tension() * force;
            let seating = Seating::new(groove, tension / force).ok_or((*pulley, largest))?;
            let swept = problem.plane.spots[*pulley].wrap - 2.0 * seating.entry();
            Ok(Seated {
                length: seating.length(swept),
                swept,
                seating,
            })
        });
        let seated = seated.collect::<Result<_, _>>()?;
        Ok(Self {
            problem,
            tension,
            coordinate,
            seated,
        })
    }
}

impl bvp::Guess for RestGuess<'_> {
    fn state(&self, segment: usize, s: f64, y: &mut [f64]) {
        let (_, groove) = &self.problem.grooves[segment];
        let Seated {
            seating,
            length,
            swept,
        } = &self.seated[segment];
        y[..4].copy_from_slice(&seating.state(s * length, *length, *swept));
        let strain = groove.strand.strain(y[0]);
        y[groove.states()] = s * length * strain / (1.0 + strain);
    }

    fn parameters(&self, p: &mut [f64]) {
        let problem = self.problem;
        if problem.has_tension() {
            p[0] = self.tension / problem.units.force;
        }
        if let (true, Some((pulley, tensioner))) = (problem.is_free(), &problem.tensioner) {
            let unit = coordinate_unit(tensioner, problem.plane.spots[*pulley].radius);
            p[usize::from(problem.has_tension())] = self.coordinate / unit;
        }
        for (to, seated) in p[problem.first_length()..].iter_mut().zip(&self.seated) {
            *to = seated.length;
        }
    }
}

/// A belt at rest as the guess of one of which something else is known.
pub(super) struct RestNear<'a> {
    pub(super) problem: &'a RestProblem,
    pub(super) rest: &'a Rest,
    /// Number of parameters before the lengths in `rest`.
    pub(super) first_length: usize,
}

impl bvp::Guess for RestNear<'_> {
    fn state(&self, segment: usize, s: f64, y: &mut [f64]) {
        self.rest.solution.state(segment, s, y);
    }

    fn parameters(&self, p: &mut [f64]) {
        let problem = self.problem;
        if problem.has_tension() {
            p[0] = self.rest.tension / problem.units.force;
        }
        let lengths = &self.rest.solution.parameters()[self.first_length..];
        p[problem.first_length()..].copy_from_slice(lengths);
    }
}
