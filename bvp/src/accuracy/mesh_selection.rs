//! Mesh selection: refine, coarsen and redistribute from the defects.

use crate::discretisation::mesh::{Mesh, ceil, equidistribute, split};
use crate::result::quality::Defects;
use crate::shares::{AIM, TWO_DIGITS, UNNOTICED};

/// With a larger relative defect than this an interval does not resolve the solution: no power law holds
/// yet, and it is halved at least.
pub(crate) const UNRESOLVED: f64 = 0.5;
/// An interval is not asked to be cut into more than this many at once: defects on intervals that
/// coarse do not yet follow their power law.
const LARGEST_CUT: f64 = 8.0;
/// Nor to grow more than by the inverse of this: with 1/8, 15 of 463 solved random problems with jumps were
/// lost.
const SMALLEST_CUT: f64 = 0.2;
/// Where an interval is not shorter than this share of the one before, its order does not show: with 1 one
/// more of 600 random problems with jumps was solved wrongly.
const SHORTER: f64 = 0.7;
/// Neighbouring intervals may differ in length by about this factor. With 3 one of 28 branches of the
/// perturbed problem of Bratu ended early.
pub(crate) const GRADING: f64 = 2.5;
/// The same where the mesh is made for the error. With 2.5 another 92 of 7500 random problems with jumps were
/// solved, but boundary-layer equations on a mapped infinite interval were not at 1e-9, nor one of those branches.
pub(crate) const GRADING_BY_ERROR: f64 = 3.0;
/// Where at most this share of the intervals is too long, only they are cut: without this 150 random shocks
/// took 55 % more factorisations.
const FEW: f64 = 0.12;

/// The next mesh, from the relative defects r on this one and the tolerance they must meet, given that r ∝
/// hᵐ, and how much neighbours may differ. Each interval wants to be cut into ν = (r / aim)^(1/m) parts; the
/// new nodes equidistribute the density ν/h, per segment.
pub(crate) fn next_mesh(
    mesh: &Mesh,
    defects: &[Vec<f64>],
    tolerance: f64,
    m: usize,
    grading: f64,
) -> Mesh {
    let next = |(nodes, defects): (&Vec<f64>, &Vec<f64>)| -> Vec<f64> {
        let cuts: Vec<f64> = defects.iter().map(|&r| wanted(r, tolerance, m)).collect();
        let too_long = defects.iter().filter(|&&r| r > tolerance).count();
        let total: f64 = cuts.iter().sum();
        let count = cuts.len() as f64;
        if (too_long as f64) <= FEW * count && total > 0.5 * count {
            let pieces: Vec<usize> = defects
                .iter()
                .zip(&cuts)
                .map(|(&r, &cut)| if r > tolerance { ceil(cut).max(2) } else { 1 })
                .collect();
            return split(nodes, &pieces);
        }
        let lengths: Vec<f64> = cuts
            .iter()
            .zip(nodes.windows(2))
            .map(|(cut, pair)| (pair[1] - pair[0]) / cut)
            .collect();
        let (nodes, density) = graded(nodes, &lengths, grading);
        equidistribute(&nodes, &density)
    };
    mesh.iter().zip(defects).map(next).collect()
}

/// Raises the defects of intervals in which the solution does not show the order of its scheme, as where the
/// right-hand side jumps, so that they are cut into as many parts as are allowed at once; returns whether
/// there are any. `before` are an earlier mesh and the defects there, which should be ∝ hᵐ.
///
/// An interval is rough if it is θ times as long as the one before at its place and has more than θ^`least`
/// times its defect, and that shows beside the largest.
pub(crate) fn amplify_rough(
    defects: &mut [Vec<f64>],
    mesh: &Mesh,
    before: &(Mesh, Vec<Vec<f64>>),
    m: usize,
    least: i32,
) -> bool {
    let mut any = false;
    let largest = defects.iter().flatten().copied().fold(0.0, f64::max);
    let cut = LARGEST_CUT.powf(m as f64);
    let before = before.0.iter().zip(&before.1);
    for ((defects, nodes), (old_nodes, old)) in defects.iter_mut().zip(mesh).zip(before) {
        let mut j = 0;
        for (defect, pair) in defects.iter_mut().zip(nodes.windows(2)) {
            let middle = 0.5 * (pair[0] + pair[1]);
            while j + 2 < old_nodes.len() && old_nodes[j + 1] <= middle {
                j += 1;
            }
            let share = (pair[1] - pair[0]) / (old_nodes[j + 1] - old_nodes[j]);
            let slow = *defect > old[j] * share.powi(least);
            if share < SHORTER && slow && *defect > TWO_DIGITS * largest {
                *defect *= cut;
                any = true;
            }
        }
    }
    any
}

/// The relative defects of a solution; where its error is to be within a tolerance, without those of intervals so
/// short that their local defects do not show, as next to a jump of the right-hand side: these need not resolve
/// it. All that are not resolved share what does not show: where a state decides on the jump, the right-hand side is
/// that of its other side along many short intervals.
pub(crate) fn relevant(
    defects: &Defects,
    tolerance: Option<f64>,
) -> impl Iterator<Item = impl Iterator<Item = f64>> {
    let Defects { relative, local } = defects;
    let all = relative.iter().flatten();
    let unresolved = all.filter(|&&relative| relative > UNRESOLVED).count();
    let harmless = match tolerance {
        Some(tolerance) => UNNOTICED * tolerance / unresolved.max(1) as f64,
        None => f64::NEG_INFINITY,
    };
    relative.iter().zip(local).map(move |(relative, local)| {
        let each = relative.iter().zip(local);
        each.map(move |(&relative, &local)| match local <= harmless {
            true => relative.min(AIM * UNRESOLVED),
            false => relative,
        })
    })
}

/// Whether these defects, all within the tolerance, want fewer than half of the intervals.
pub(crate) fn is_wasteful(defects: &[Vec<f64>], tolerance: f64, m: usize) -> bool {
    let (mut total, mut count) = (0.0, 0.0);
    for &r in defects.iter().flatten() {
        total += wanted(r, tolerance, m);
        count += 1.0;
    }
    total < 0.5 * count
}

/// How many parts an interval with the relative defect r wants to be cut into.
fn wanted(r: f64, tolerance: f64, m: usize) -> f64 {
    let cut = (r / (AIM * tolerance)).powf(1.0 / m as f64);
    let least = if r > UNRESOLVED { 2.0 } else { SMALLEST_CUT };
    cut.clamp(least, LARGEST_CUT)
}

/// The density of nodes, piecewise constant between places of its own, for intervals of these `lengths` on a mesh that differ
/// from their neighbours by a factor g at most.
///
/// Beside an interval of length h others may be g h, g² h, … long. Where the length is c h + σ ln g at the distance σ from
/// its end, with c = g ln g/(g − 1), each of them has the share ∫ dσ/(c h + σ ln g) = 1. The length at a place is the least
/// that the intervals before it and behind it, and its own, ask for.
fn graded(nodes: &[f64], lengths: &[f64], g: f64) -> (Vec<f64>, Vec<f64>) {
    let (slope, c) = (g.ln(), g * g.ln() / (g - 1.0));
    // What the intervals behind each ask for at its end.
    let mut behind = vec![f64::INFINITY; lengths.len()];
    for i in (1..lengths.len()).rev() {
        let passed = behind[i] + slope * (nodes[i + 1] - nodes[i]);
        behind[i - 1] = passed.min(c * lengths[i]);
    }
    let (mut places, mut density) = (vec![nodes[0]], vec![]);
    let mut before = f64::INFINITY;
    for ((pair, &length), behind) in nodes.windows(2).zip(lengths).zip(behind) {
        let passed = before + slope * (pair[1] - pair[0]);
        let top = length.min(0.5 * (behind + passed));
        let mut until = |end: f64, value: f64| {
            let end = end.min(pair[1]);
            if end > places[places.len() - 1] {
                places.push(end);
                density.push(value);
            }
        };
        let mut s = pair[0];
        for (width, value) in ramp(before, top, g) {
            s += width;
            until(s, value);
        }
        let fall = ramp(behind, top, g);
        s = pair[1] - fall.iter().map(|(width, _)| width).sum::<f64>();
        until(s, 1.0 / top);
        for (width, value) in fall.into_iter().rev() {
            s += width;
            until(s, value);
        }
        until(pair[1], 1.0 / top);
        before = passed.min(c * length);
    }
    (places, density)
}

/// Places along which the length of intervals rises with the slope ln g: their widths and mean densities of nodes.
fn ramp(from: f64, to: f64, g: f64) -> Vec<(f64, f64)> {
    let mut pieces = vec![];
    let mut low = from;
    while low < to {
        let high = to.min(g * low);
        pieces.push(((high - low) / g.ln(), (high / low).ln() / (high - low)));
        low = high;
    }
    pieces
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::discretisation::mesh::intervals;

    fn uniform(count: u32) -> Vec<f64> {
        (0..=count)
            .map(|i| f64::from(i) / f64::from(count))
            .collect()
    }

    /// Defects C(s) hᵐ of a problem with a layer at the left end.
    fn model(nodes: &[f64], m: i32) -> Vec<f64> {
        let defect = |pair: &[f64]| {
            let (s, h) = (0.5 * (pair[0] + pair[1]), pair[1] - pair[0]);
            ((1.0 + 1e3 * (-s / 0.02).exp()) * h).powi(m)
        };
        nodes.windows(2).map(defect).collect()
    }

    #[test]
    fn a_power_law_is_met_in_a_few_meshes_of_sensible_size() {
        for m in 1..=7 {
            let tolerance = 1e-4;
            let mut mesh = vec![uniform(10)];
            let mut meshes = 1;
            while model(&mesh[0], m).iter().any(|&r| r > tolerance) {
                let defects = vec![model(&mesh[0], m)];
                mesh = next_mesh(
                    &mesh,
                    &defects,
                    tolerance,
                    usize::try_from(m).unwrap(),
                    GRADING,
                );
                meshes += 1;
                assert!(meshes < 12, "m = {m}");
                assert!(mesh[0].windows(2).all(|pair| pair[0] < pair[1]));
                assert_eq!((mesh[0].first(), mesh[0].last()), (Some(&0.0), Some(&1.0)));
            }
            // An interval is as long as it may be where h C^(1/m) = tolerance^(1/m).
            let best = (1.0 + 1e3 * 0.02) / tolerance.powf(1.0 / f64::from(m));
            assert!(
                (intervals(&mesh) as f64) < 5.0 * best + 10.0,
                "m = {m}: {mesh:?}"
            );
        }
    }

    #[test]
    fn one_long_interval_is_cut_and_the_others_stay() {
        let nodes = uniform(20);
        let mut defects = vec![0.5e-6; 20];
        defects[7] = 1e-5;
        let finer = next_mesh(&vec![nodes.clone()], &[defects], 1e-6, 4, GRADING);
        assert!(nodes.iter().all(|s| finer[0].contains(s)));
        assert!(finer[0].len() > nodes.len());
        assert!(
            finer[0]
                .iter()
                .all(|s| nodes.contains(s) || (0.35..0.4).contains(s))
        );
    }

    #[test]
    fn a_segment_far_too_fine_is_coarsened_while_another_is_refined() {
        let mesh = vec![uniform(40), uniform(10)];
        let defects = vec![vec![1e-14; 40], vec![1e-3; 10]];
        let next = next_mesh(&mesh, &defects, 1e-6, 4, GRADING);
        assert!(next[0].len() < 20 && next[1].len() > 20);
    }

    #[test]
    fn a_mesh_twice_too_fine_is_wasteful() {
        let tolerance = 1e-6;
        let defects = |parts: f64| vec![vec![AIM * tolerance * parts.powi(4); 10]; 2];
        assert!(is_wasteful(&defects(0.49), tolerance, 4));
        assert!(!is_wasteful(&defects(0.51), tolerance, 4));
    }

    /// Lengths of the intervals of the mesh that has the density of `graded`.
    fn lengths_of(nodes: &[f64], lengths: &[f64], g: f64) -> Vec<f64> {
        let (places, density) = graded(nodes, lengths, g);
        assert_eq!(
            (places.first(), places.last()),
            (nodes.first(), nodes.last())
        );
        assert!(places.is_sorted_by(|a, b| a < b));
        let mesh = equidistribute(&places, &density);
        mesh.windows(2).map(|pair| pair[1] - pair[0]).collect()
    }

    #[test]
    fn neighbouring_intervals_are_graded() {
        // Long intervals beside and between short ones: 1, 3, 9, … from each of these.
        for (nodes, lengths) in [
            (vec![0.0, 1.0, 400.0], vec![1.0, 399.0]),
            (vec![-400.0, -1.0, 0.0], vec![399.0, 1.0]),
            (vec![0.0, 1.0, 400.0, 401.0], vec![1.0, 399.0, 1.0]),
        ] {
            let widths = lengths_of(&nodes, &lengths, 3.0);
            let shorts = lengths.len() - 1;
            let steps = (2.0 * 399.0 / shorts as f64 / 3.0 + 1.0_f64).ln() / 3.0_f64.ln();
            let fewest = steps * shorts as f64 + shorts as f64;
            assert!((widths.len() as f64) < fewest + 2.0, "{widths:?}");
            let ratios = widths.windows(2).map(|pair| pair[1] / pair[0]);
            let largest = ratios
                .map(|ratio| ratio.max(1.0 / ratio))
                .fold(0.0, f64::max);
            assert!(largest < 1.3 * 3.0, "{widths:?}");
        }
        // Beside an interval of length 1e-20 there are 42 in a segment of length one.
        assert_eq!(lengths_of(&[0.0, 1e-20, 1.0], &[1e-20, 1.0], 3.0).len(), 43);
        // Lengths that differ by less than c stay.
        let (places, density) = graded(&[0.0, 1.0, 3.0, 5.0], &[0.5, 0.8, 0.625], 3.0);
        assert_eq!(places, [0.0, 1.0, 3.0, 5.0]);
        assert_eq!(density, [2.0, 1.25, 1.6]);
    }
}
