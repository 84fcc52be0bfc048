//! Where the search of a design begins.

use super::problem::{Evaluated, Problem};
use crate::answers::shares::each;
use std::sync::Arc;

/// Places that are judged before a search, for each free number and once more, and at most: the centre of all ranges and
/// what the drive file has are two of them.
const PLACES: usize = 4;
const MOST_PLACES: usize = 16;

/// Searches from the best of them, at most, and no more than one for each free number and another: drives whose limits
/// leave separate regions are rare, and most starts come to the same end.
const MOST_STARTS: usize = 3;

/// How far starts lie from each other at least, as a share of the ranges.
const APART: f64 = 0.25;

/// The bases of the Halton sequence, one for each number; further numbers repeat them, shifted.
const BASES: [usize; 6] = [2, 3, 5, 7, 11, 13];

/// Places with what was found there, the best first and apart from each other.
pub(super) fn starts(problem: &Problem<'_>) -> Vec<(Vec<f64>, Arc<Evaluated>)> {
    let places = places(problem);
    let found = each(places.len(), |index| problem.evaluate(&places[index]));
    let mut all: Vec<_> = places.into_iter().zip(found).collect();
    all.sort_by(|(_, one), (_, other)| {
        rank(one)
            .partial_cmp(&rank(other))
            .unwrap_or(std::cmp::Ordering::Equal)
    });
    let most = MOST_STARTS.min(problem.question.free.len() + 1);
    let mut starts: Vec<(Vec<f64>, Arc<Evaluated>)> = Vec::new();
    for (place, found) in all {
        let distance = |(start, _): &(Vec<f64>, Arc<Evaluated>)| {
            let parts = start
                .iter()
                .zip(&place)
                .map(|(one, other)| (one - other).abs());
            parts.fold(0.0, f64::max)
        };
        if starts.is_empty()
            || starts.len() < most && starts.iter().all(|start| distance(start) >= APART)
        {
            starts.push((place, found));
        }
    }
    starts
}

/// First whole states, then known margins; by the largest share that is missed, then by what is to be small.
fn rank(found: &Evaluated) -> (u8, f64, f64) {
    match (&found.whole, &found.margins) {
        (Some((pieces, limits)), _) => {
            let missed = limits
                .iter()
                .map(|limited| limited.missed())
                .fold(0.0, f64::max);
            (
                0,
                missed,
                pieces.iter().copied().fold(f64::NEG_INFINITY, f64::max),
            )
        }
        (None, Some(margins)) => {
            let missed = margins
                .iter()
                .map(|limited| limited.missed())
                .fold(0.0, f64::max);
            (1, missed, 0.0)
        }
        (None, None) => (2, 0.0, 0.0),
    }
}

/// Places spread over the ranges: what the file has, and a Halton sequence after its centre.
fn places(problem: &Problem<'_>) -> Vec<Vec<f64>> {
    let free = &problem.question.free;
    if free.is_empty() {
        return vec![Vec::new()];
    }
    let given = free.iter().map(|free| {
        let [low, high] = free.bounds;
        let value = problem.file.value(&free.key).unwrap_or(low);
        ((value - low) / (high - low)).clamp(0.0, 1.0)
    });
    let count = (PLACES * (free.len() + 1)).min(MOST_PLACES);
    let spread = (1..count - 1).map(|index| {
        (0..free.len())
            .map(|number| {
                let turns = (number / BASES.len()) as f64 / free.len() as f64;
                (radical_inverse(index, BASES[number % BASES.len()]) + turns).fract()
            })
            .collect()
    });
    let centre = vec![0.5; free.len()];
    [given.collect(), centre]
        .into_iter()
        .chain(spread)
        .collect()
}

/// The digits of an index in a base, mirrored at the point.
fn radical_inverse(mut index: usize, base: usize) -> f64 {
    let (mut value, mut digit) = (0.0, 1.0 / base as f64);
    while index > 0 {
        value += (index % base) as f64 * digit;
        index /= base;
        digit /= base as f64;
    }
    value
}

#[cfg(test)]
mod tests {
    use super::radical_inverse;

    #[test]
    fn the_halton_sequence_fills_its_range() {
        let found: Vec<_> = (1..5).map(|index| radical_inverse(index, 2)).collect();
        assert_eq!(found, [0.5, 0.25, 0.75, 0.125]);
        assert!((radical_inverse(5, 3) - (2.0 / 3.0 + 1.0 / 9.0)).abs() < 1e-15);
    }
}
