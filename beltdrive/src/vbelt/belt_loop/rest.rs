//! The V-belt at rest: no friction, one tension in all spans.
//!
//! The belt has been turned without torques, so that friction holds nothing; it lies in every groove as deep
//! as its tension presses it. Segments are the grooves, with the states of the running belt without
//! friction and inertia, and the elongation. Unknown parameters are the tension and the coordinate of the
//! tensioner, unless they are given, and the lengths of all contacts.

use super::super::groove::{ANGLE, INCLINATION, PENETRATION, TENSION};
use super::super::path::Effort;
use super::super::{Contact, EndAngles, Groove, Regime, Units};
use super::plane::{Laid, Plane, Spot};
use super::seat::frictionless;
use super::solve::Search;
use super::tensioner::{coordinate_unit, unbalanced};
use crate::drive::layout::{Layout, Side};
use crate::{Drive, Mount, Tensioner};
use bvp::{Control, Ends, Options, Problem, Real, Segment, Solution};

/// What is known of the belt at rest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Known {
    /// Length of the unstretched belt, m.
    Length(f64),
    /// Belt tension, N.
    Tension(f64),
    /// That the tensioner is in equilibrium at the coordinate at which it is held.
    Equilibrium,
}

/// The belt at rest, as a boundary value problem.
#[derive(Clone, Debug)]
pub(super) struct RestProblem {
    pub(super) plane: Plane,
    pub(super) units: Units,
    known: Known,
    /// The grooves, with the index of their pulley.
    pub(super) grooves: Vec<(usize, Groove)>,
    pub(super) tensioner: Option<(usize, Tensioner)>,
    /// Coordinate at which the tensioner is held, if it is.
    held: Option<f64>,
    segments: Vec<Segment>,
}

impl RestProblem {
    /// Of a loop whose pitch line is laid out in `layout`, in units of a force of about the tension.
    pub(super) fn new(drive: &Drive, layout: &Layout, force: f64, known: Known) -> Self {
        let units = Units::new(&drive.belt, 1.0, force);
        let pulleys = drive.pulleys.iter().enumerate();
        let grooves = pulleys.filter(|(_, pulley)| pulley.side == Side::Inside);
        let grooves: Vec<_> = grooves
            .map(|(index, pulley)| (index, frictionless(drive, pulley, units)))
            .collect();
        let segments = grooves
            .iter()
            .map(|(_, groove)| Segment::new(groove.states() + 1));
        Self {
            plane: Plane::new(drive, layout),
            units,
            known,
            segments: segments.collect(),
            grooves,
            tensioner: drive
                .tensioner()
                .map(|(pulley, tensioner)| (pulley, *tensioner)),
            held: None,
        }
    }

    /// The same belt with something else known of it.
    pub(super) fn with(mut self, known: Known) -> Self {
        self.known = known;
        self
    }

    /// The same belt with its tensioner held at a coordinate.
    pub(super) fn held(mut self, coordinate: f64) -> Self {
        self.held = Some(coordinate);
        self
    }

    /// The same belt with a point on its back, behind a pulley in belt order; the tensioner stays where
    /// it is.
    pub(super) fn deflected(mut self, span: usize, point: [f64; 2], coordinate: f64) -> Self {
        let back = Spot {
            mount: Mount::Fixed(point),
            radius: 0.0,
            turns: -self.plane.spots[self.grooves[0].0].turns,
            wrap: 0.0,
        };
        self.plane.spots.insert(span + 1, back);
        for (pulley, _) in &mut self.grooves {
            *pulley += usize::from(*pulley > span);
        }
        self.held(coordinate)
    }

    /// Whether the tension is unknown.
    pub(super) fn has_tension(&self) -> bool {
        !matches!(self.known, Known::Tension(_))
    }

    /// Whether the coordinate is unknown.
    pub(super) fn is_free(&self) -> bool {
        self.tensioner.is_some() && self.held.is_none()
    }

    /// Index of the first length among the parameters.
    pub(super) fn first_length(&self) -> usize {
        usize::from(self.has_tension()) + usize::from(self.is_free())
    }

    fn tension<T: Real>(&self, p: &[T]) -> T {
        match self.known {
            Known::Tension(tension) => T::from_f64(tension / self.units.force),
            _ => p[0],
        }
    }

    fn coordinate<T: Real>(&self, p: &[T]) -> T {
        match (self.held, &self.tensioner) {
            (None, Some((pulley, tensioner))) => {
                let unit = coordinate_unit(tensioner, self.plane.spots[*pulley].radius);
                p[usize::from(self.has_tension())] * unit
            }
            (held, _) => T::from_f64(held.unwrap_or(0.0)),
        }
    }

    fn end_angles<T: Real>(&self, at: &Ends<'_, T>) -> Vec<EndAngles<T>> {
        let flat = EndAngles {
            entry: T::ZERO,
            exit: T::ZERO,
        };
        let mut ends = vec![flat; self.plane.spots.len()];
        for (segment, (pulley, _)) in self.grooves.iter().enumerate() {
            ends[*pulley] = EndAngles {
                entry: at.start(segment)[INCLINATION],
                exit: at.end(segment)[INCLINATION],
            };
        }
        ends
    }

    /// Length of the belt less that of the unstretched belt, and that of the stretched one, m.
    fn elongation<T: Real>(&self, at: &Ends<'_, T>, p: &[T], laid: &Laid<T>) -> [T; 2] {
        let strain = self.units.strand().strain(self.tension(p));
        let mut straight: T = laid.lengths.iter().copied().sum();
        let pulleys = self.plane.spots.iter().zip(&laid.turned).enumerate();
        for (pulley, (spot, &turned)) in pulleys {
            if self.grooves.iter().all(|(groove, _)| *groove != pulley) {
                straight += turned * spot.radius;
            }
        }
        let (mut elongation, mut length) = (straight * (strain / (strain + 1.0)), straight);
        for (segment, (pulley, _)) in self.grooves.iter().enumerate() {
            let radius = self.plane.spots[*pulley].radius;
            let end = at.end(segment);
            length += p[self.first_length() + segment] * radius;
            elongation += end[end.len() - 1] * radius;
        }
        [elongation, length]
    }

    /// Solves the problem from a guess.
    pub(super) fn solve(
        &self,
        guess: &dyn bvp::Guess,
        search: &mut Search<'_>,
    ) -> Result<Rest, bvp::Error> {
        let tolerance = search.tolerance;
        let options = Options {
            // The elongation is a difference of lengths of which it is this share.
            tolerance: (tolerance * self.units.strand().compliance).max(SMALLEST_TOLERANCE),
            control: Control::Error,
            initial_intervals: 40,
            retries: 2,
            ..Effort::Full.options(tolerance)
        };
        let outcome = bvp::solve(self, guess, &options);
        search.count(&outcome);
        Ok(self.seen(outcome?))
    }

    /// A solution in SI units.
    fn seen(&self, solution: Solution) -> Rest {
        let p = solution.parameters();
        let segments = 0..self.segments.len();
        let values = segments.flat_map(|i| [solution.start(i), solution.end(i)]);
        let values: Vec<f64> = values.flatten().copied().collect();
        let at = Ends::new(&self.segments, &values);
        let coordinate = self.coordinate(p);
        let ends = self.end_angles(&at);
        let laid = self.plane.lay(coordinate, &ends);
        let [elongation, length] = self.elongation(&at, p, &laid);
        let mut wraps = laid.turned.clone();
        for (segment, (pulley, _)) in self.grooves.iter().enumerate() {
            wraps[*pulley] = solution.end(segment)[ANGLE];
        }
        Rest {
            coordinate,
            tension: self.tension(p) * self.units.force,
            unstretched: length - elongation,
            wraps,
            exits: ends.iter().map(|ends| ends.exit).collect(),
            laid,
            solution,
        }
    }
}

/// Tolerances below this drown in rounding.
const SMALLEST_TOLERANCE: f64 = 1e-12;

/// The belt at rest.
#[derive(Clone, Debug)]
pub(super) struct Rest {
    /// Coordinate of the tensioner, rad or m; without one it means nothing.
    pub(super) coordinate: f64,
    /// Belt tension, N.
    pub(super) tension: f64,
    /// Length `L_0` of the unstretched belt, m.
    pub(super) unstretched: f64,
    /// Wrap angles, rad.
    pub(super) wraps: Vec<f64>,
    /// Inclinations where the belt leaves the pulleys, rad.
    pub(super) exits: Vec<f64>,
    pub(super) laid: Laid<f64>,
    pub(super) solution: Solution,
}

impl Problem for RestProblem {
    fn segments(&self) -> Vec<Segment> {
        self.segments.clone()
    }

    fn parameters(&self) -> usize {
        self.first_length() + self.segments.len()
    }

    fn rhs<T: Real>(&self, segment: usize, _s: T, y: &[T], p: &[T], dy: &mut [T]) {
        let (_, groove) = &self.grooves[segment];
        let contact = Contact::new(groove, Regime::Slip, y, T::ONE, T::ONE);
        contact.rates(groove, y, dy);
        let strain = groove.strand.strain(contact.tension);
        dy[groove.states()] = strain / (strain + 1.0);
        let length = p[self.first_length() + segment];
        for rate in dy {
            *rate *= length;
        }
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, p: &[T], r: &mut [T]) {
        let mut residuals = r.iter_mut();
        let mut zero = |value: T| {
            if let Some(residual) = residuals.next() {
                *residual = value;
            }
        };
        let (tension, coordinate) = (self.tension(p), self.coordinate(p));
        let ends = self.end_angles(&at);
        let laid = self.plane.lay(coordinate, &ends);
        for (segment, (pulley, groove)) in self.grooves.iter().enumerate() {
            let (entry, exit) = (at.start(segment), at.end(segment));
            zero(entry[TENSION] - tension);
            zero(entry[PENETRATION]);
            zero(exit[PENETRATION]);
            zero(entry[ANGLE]);
            zero(entry[groove.states()]);
            let turned = exit[ANGLE] - (ends[*pulley].exit - ends[*pulley].entry);
            zero(turned - laid.turned[*pulley]);
        }
        if let Known::Length(unstretched) = self.known {
            let [elongation, length] = self.elongation(&at, p, &laid);
            zero(
                (length - unstretched - elongation)
                    / (unstretched * self.units.strand().compliance),
            );
        }
        if let (true, Some((pulley, tensioner))) = (
            self.is_free() || self.known == Known::Equilibrium,
            &self.tensioner,
        ) {
            let hub_load = laid.hub_load(&self.plane, *pulley, [tension; 2]);
            zero(unbalanced(
                tensioner,
                self.units.force,
                coordinate,
                hub_load,
            ));
        }
    }
}
