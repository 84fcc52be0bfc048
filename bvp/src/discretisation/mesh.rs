//! Partitions of the segments into intervals.

use crate::problem::problem::Segment;
use crate::shares::{PARTS, SPACINGS};

/// The nodes of every segment: ascending, the first and the last are the ends of the segment.
pub(crate) type Mesh = Vec<Vec<f64>>;

/// The nodes of `intervals` equal intervals of a segment.
pub(crate) fn uniform(segment: &Segment, intervals: usize) -> Vec<f64> {
    let mut nodes: Vec<f64> = (0..=intervals)
        .map(|i| segment.from + (segment.to - segment.from) * i as f64 / intervals as f64)
        .collect();
    nodes[intervals] = segment.to;
    nodes
}

/// The mesh with every interval halved.
pub(crate) fn halved(mesh: &Mesh) -> Mesh {
    mesh.iter()
        .map(|nodes| split(nodes, &vec![2; nodes.len() - 1]))
        .collect()
}

/// The mesh in which the number of intervals is divided by `factor`, rounded up, on segments with more than
/// three intervals of equal length.
pub(crate) fn thinned(mesh: &Mesh, factor: f64) -> Mesh {
    let fewer = |nodes: &Vec<f64>| {
        let (count, ends) = (nodes.len() - 1, [nodes[0], nodes[nodes.len() - 1]]);
        if count > 3 && is_uniform(nodes) {
            split(&ends, &[ceil(count as f64 / factor)])
        } else {
            nodes.clone()
        }
    };
    mesh.iter().map(fewer).collect()
}

/// Whether all intervals of a segment are equal up to rounding.
fn is_uniform(nodes: &[f64]) -> bool {
    let count = (nodes.len() - 1) as f64;
    let length = nodes[nodes.len() - 1] - nodes[0];
    let equal =
        |pair: &[f64]| ((pair[1] - pair[0]) * count / length - 1.0).abs() < f64::EPSILON.sqrt();
    nodes.windows(2).all(equal)
}

/// Cuts interval i of a segment into `pieces[i]` equal parts.
pub(crate) fn split(nodes: &[f64], pieces: &[usize]) -> Vec<f64> {
    let mut refined = Vec::with_capacity(pieces.iter().sum::<usize>() + 1);
    for (pair, &pieces) in nodes.windows(2).zip(pieces) {
        let width = pair[1] - pair[0];
        refined.extend((0..pieces).map(|j| pair[0] + width * j as f64 / pieces as f64));
    }
    refined.extend(nodes.last());
    refined
}

/// The intervals that the piecewise constant `density` asks for (one positive number per old interval, intervals
/// per length), two at least, so that each holds the same share of it.
pub(crate) fn equidistribute(nodes: &[f64], density: &[f64]) -> Vec<f64> {
    let share = |i: usize| density[i] * (nodes[i + 1] - nodes[i]);
    let total: f64 = (0..density.len()).map(share).sum();
    let intervals = ceil(total).max(2);
    let mut placed = Vec::with_capacity(intervals + 1);
    placed.push(nodes[0]);
    let (mut old, mut passed) = (0, 0.0);
    for i in 1..intervals {
        let target = total * i as f64 / intervals as f64;
        while old + 1 < density.len() && passed + share(old) < target {
            passed += share(old);
            old += 1;
        }
        placed.push(nodes[old] + (target - passed) / density[old]);
    }
    placed.extend(nodes.last());
    placed
}

/// Whether every interval is long enough for floating-point numbers: the ends of its parts are told apart, so
/// that its collocation points stay apart and its density of nodes is finite.
pub(crate) fn is_representable(mesh: &Mesh) -> bool {
    let spacing = |pair: &[f64]| {
        let largest = pair[0].abs().max(pair[1].abs());
        (f64::EPSILON * largest).max(f64::MIN_POSITIVE)
    };
    let resolved = |pair: &[f64]| pair[1] - pair[0] > PARTS as f64 * SPACINGS * spacing(pair);
    mesh.iter().all(|nodes| nodes.windows(2).all(resolved))
}

/// Total number of intervals.
pub(crate) fn intervals(mesh: &Mesh) -> usize {
    mesh.iter().map(|nodes| nodes.len() - 1).sum()
}

/// The smallest whole number that is not less than x.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "counts of intervals are positive and far below 2^53"
)]
pub(crate) fn ceil(x: f64) -> usize {
    x.ceil() as usize
}

/// The share of every node of a segment in the mean over it, by the trapezoidal rule.
pub(crate) fn shares(nodes: &[f64]) -> impl Iterator<Item = f64> {
    let last = nodes.len() - 1;
    let length = nodes[last] - nodes[0];
    (0..=last).map(move |i| {
        let around = nodes[(i + 1).min(last)] - nodes[i.saturating_sub(1)];
        0.5 * around / length
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equidistribution_gives_every_interval_the_same_share() {
        let nodes = [0.0, 0.5, 1.0];
        let placed = equidistribute(&nodes, &[6.0, 2.0]);
        let expected = [0.0, 1.0 / 6.0, 1.0 / 3.0, 0.5, 1.0];
        for (found, exact) in placed.iter().zip(expected) {
            assert!((found - exact).abs() < 1e-15, "{placed:?}");
        }
    }

    #[test]
    fn intervals_at_the_spacing_of_numbers_are_not_representable() {
        assert!(is_representable(&vec![vec![0.0, 1e-300, 1.0]]));
        assert!(!is_representable(&vec![vec![0.0, 1e-307, 1.0]]));
        assert!(is_representable(&vec![vec![1.0, 1.0 + 1e-13, 2.0]]));
        assert!(!is_representable(&vec![vec![1.0, 1.0 + 1e-15, 2.0]]));
        assert!(!is_representable(&vec![
            vec![0.0, 1.0],
            vec![0.0, 0.0, 1.0]
        ]));
    }

    #[test]
    fn halving_doubles_every_segment() {
        let segments = [Segment::new(1), Segment::on(2, -1.0, 3.0)];
        let mesh: Mesh = segments.iter().map(|segment| uniform(segment, 2)).collect();
        assert_eq!(mesh, [vec![0.0, 0.5, 1.0], vec![-1.0, 1.0, 3.0]]);
        assert_eq!(intervals(&halved(&mesh)), 8);
        assert_eq!(halved(&mesh)[1], [-1.0, 0.0, 1.0, 2.0, 3.0]);
    }

    #[test]
    fn equal_intervals_are_thinned_and_others_kept() {
        let equal = |intervals| vec![uniform(&Segment::on(1, -1.0, 1.0), intervals)];
        for (stated, left) in [(1, 1), (3, 3), (4, 2), (10, 3), (68, 20), (69, 21)] {
            let few = thinned(&equal(stated), 3.4);
            assert_eq!(few, equal(left));
        }
        let graded = vec![vec![0.0, 0.1, 0.4, 0.7, 1.0]];
        assert_eq!(thinned(&graded, 3.4), graded);
    }

    #[test]
    fn splitting_keeps_the_old_nodes() {
        assert_eq!(
            split(&[0.0, 1.0, 3.0], &[1, 4]),
            [0.0, 1.0, 1.5, 2.0, 2.5, 3.0]
        );
    }
}
