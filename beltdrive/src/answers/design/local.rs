//! The search of a design from one place: into its limits, then for the best within them, or the limits in conflict.

use super::problem::{DesignLimit, Evaluated, LimitPlace, Limited, Problem};
use super::search::{AT_END, Functions, Minimum, Search};
use super::{DecidingLimit, Found, Precision};

/// A number whose range is large beside it is varied in steps of at least this share of the range.
const LEAST_STEP: f64 = 1e-3;

/// A multiplier below this share of the largest one is that of a limit that does not decide.
const NEGLIGIBLE: f64 = 1e-6;

impl Problem<'_> {
    /// The best drive that is reached from a place; `None` if no state is.
    pub(super) fn local(
        &self,
        place: Vec<f64>,
        start: &Evaluated,
        precision: &Precision,
    ) -> Option<Found> {
        let mut place = place;
        if start.whole.is_none() {
            let margins = |place: &[f64]| self.margins(place);
            let found = self.minimum(&margins, place, Some(0.0), precision)?;
            let there = self.evaluate(&found.place);
            if there.whole.is_none() {
                let margins = there.margins.as_ref()?;
                return Some(self.missing((&found, precision), margins, None));
            }
            place = found.place;
        }
        let values = self.functions(&place)?;
        if values.excess() > 0.0 {
            let limits = |place: &[f64]| self.limits(place);
            let found = self.minimum(&limits, place, Some(0.0), precision)?;
            if found.values.largest_piece() > 0.0 {
                let there = self.evaluate(&found.place);
                let (pieces, limits) = there.whole.as_ref()?;
                let largest = pieces.iter().copied().reduce(f64::max);
                return Some(self.missing((&found, precision), limits, largest));
            }
            place = found.place;
        }
        let functions = |place: &[f64]| self.functions(place);
        let found = self.minimum(&functions, place, None, precision)?;
        let there = self.evaluate(&found.place);
        let (pieces, limits) = there.whole.as_ref()?;
        Some(Found {
            objective: pieces.iter().copied().reduce(f64::max),
            missed: self.missed(limits),
            limits: self.deciding(&found, limits, &found.multipliers.limits, self.unit),
            ..self.found(&found, precision)
        })
    }

    /// A search from a place.
    fn minimum(
        &self,
        functions: &Functions<'_>,
        place: Vec<f64>,
        enough: Option<f64>,
        precision: &Precision,
    ) -> Option<Minimum> {
        let values = functions(&place)?;
        let numbers = self.question.free.iter().zip(self.values(&place));
        let steps = numbers.map(|(free, value)| {
            let range = free.bounds[1] - free.bounds[0];
            precision.difference * (value.abs() / range).clamp(LEAST_STEP, 1.0)
        });
        Search {
            functions,
            steps: steps.collect(),
            accuracy: precision.search,
            enough,
        }
        .minimum(&place, values)
    }

    /// The drive that misses its limits least.
    fn missing(
        &self,
        (found, precision): (&Minimum, &Precision),
        limits: &[Limited],
        objective: Option<f64>,
    ) -> Found {
        Found {
            objective,
            // Within the clearance all of them may hold.
            missed: Some(self.missed(limits).unwrap_or(0.0)),
            limits: self.deciding(found, limits, &found.multipliers.pieces, 1.0),
            ..self.found(found, precision)
        }
    }

    /// What any end of a search tells.
    fn found(&self, found: &Minimum, precision: &Precision) -> Found {
        let idle = found.idle.iter().enumerate();
        Found {
            values: self.values(&found.place),
            objective: None,
            missed: None,
            limits: Vec::new(),
            residual: found.residual,
            precision: *precision,
            idle: idle
                .filter_map(|(index, idle)| idle.then_some(index))
                .collect(),
        }
    }

    /// The limits with multipliers, each with its price in a unit, in the order of the question.
    fn deciding(
        &self,
        found: &Minimum,
        limits: &[Limited],
        multipliers: &[f64],
        unit: f64,
    ) -> Vec<DecidingLimit> {
        let ends = found.place.iter().zip(&found.slopes).enumerate();
        let ends = ends.filter_map(|(index, (at, slope))| {
            let limit = match *slope > 0.0 {
                true if *at <= AT_END => DesignLimit::LowerBound(index),
                false if 1.0 - at <= AT_END => DesignLimit::UpperBound(index),
                _ => return None,
            };
            let [low, high] = self.question.free[index].bounds;
            let allowed = if limit.is_smallest() { low } else { high };
            let price = slope * unit / (high - low);
            let place = LimitPlace {
                case: None,
                pulley: None,
            };
            Some((slope.abs(), (limit, place), [allowed, allowed], price))
        });
        let others = limits.iter().zip(multipliers).map(|(limited, multiplier)| {
            let price = multiplier * unit * limited.missed_with_allowed();
            let values = [limited.allowed, limited.found];
            (*multiplier, (limited.limit, limited.place), values, price)
        });
        let all: Vec<_> = others.chain(ends).collect();
        let largest = all
            .iter()
            .map(|(multiplier, ..)| *multiplier)
            .fold(0.0, f64::max);
        let mut deciding: Vec<DecidingLimit> = Vec::new();
        for (multiplier, (limit, place), [allowed, value], price) in all {
            if multiplier <= NEGLIGIBLE * largest {
                continue;
            }
            match deciding.iter_mut().find(|known| known.limit == limit) {
                Some(known) => {
                    known.places.push(place);
                    known.price += price;
                    // Of several places the one that misses the limit most.
                    let is_worse = (value > known.found) != limit.is_smallest();
                    if is_worse {
                        known.found = value;
                    }
                }
                None => deciding.push(DecidingLimit {
                    limit,
                    places: vec![place],
                    allowed,
                    found: value,
                    price,
                }),
            }
        }
        deciding
    }
}
