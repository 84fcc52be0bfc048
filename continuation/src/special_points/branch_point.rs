//! Simple branch points: located to rounding, with both branches.
//!
//! With a bordering vector b outside the range of J, the unfolded system G(z) + η b = 0 has a smooth surface
//! of solutions (z, η) around a simple branch point. The point is the saddle of η on this surface, and η is
//! zero along both branches. In
//! coordinates a of the tangent plane T
//!
//! ```text
//! grad η = φ(z) = η components of T = 0          the branch point, by Newton's method
//! aᵀ D a = 0,   D = grad φ                       the directions of the two branches
//! ```
//!
//! That system is regular where [G; arclength] is singular. The perturbed problem has η ≠ 0 at the
//! saddle: the branches miss each other (imperfect bifurcation). After M. Golubitsky & D. G.
//! Schaeffer, *Singularities and Groups in Bifurcation Theory* I, Springer 1985; compare H. B.
//! Keller (1977), section 5.

use crate::curve::curve::Curve;
use crate::difficulty::Difficulty;
use crate::special_points::node::{Located, Node};
use crate::special_points::null_space::{NullSpace, solve};
use crate::special_points::slopes::Slopes;
use crate::special_points::span::Span;
use crate::system::system::System;

/// Branch points are bracketed this closely before Newton's method takes over.
const BRACKET: f64 = 1e-3;
/// A located branch point may lie beside the step by this share of it: by Newton's method it is the
/// nearest one, bracketed to a thousandth.
const BESIDE: f64 = 0.05;
/// Newton steps shorter than this that no longer shrink are rounding.
const ROUNDING: f64 = 1e-7;
/// Branches that come closer than this, in the arclength norm, meet, if their system has a
/// discretisation error, which parts them, ...
const MEETING_DISCRETISED: f64 = 1e-5;
/// ... or none: the gap is the root of the residual there, whose rounding is about 1e-16.
const MEETING: f64 = 1e-7;
/// Changes of all unknowns tried for the sizes of the equations, relative to the sizes of the
/// unknowns.
const CHANGES: [f64; 3] = [0.1, 1e-3, 1e-6];
/// The most Newton steps.
const STEPS: usize = 25;

/// A simple branch point.
#[derive(Clone, Debug)]
pub(crate) struct Crossing {
    pub(crate) z: Vec<f64>,
    /// Unit tangents of both branches; none where only one point satisfies the equations nearby.
    pub(crate) tangents: Option<[Vec<f64>; 2]>,
    /// By how much the directions of the tangents are uncertain, rad.
    pub(crate) doubt: f64,
}

/// The size of each equation: its mean response to two changes of all unknowns by shares of their sizes.
/// The changes are so large that an equation whose derivatives all vanish at `z` responds too. Equations
/// that do not respond to them, which depend on unknowns without a size alone, have the size zero.
pub(crate) fn equation_sizes<S: System>(
    curve: &mut Curve<'_, S>,
    z: &[f64],
) -> Result<Vec<f64>, Difficulty> {
    let Curve {
        system,
        metric,
        corrector,
        ..
    } = curve;
    let n = z.len() - 1;
    let (mut here, mut there) = (vec![f64::NAN; n], vec![f64::NAN; n]);
    corrector.residual(*system, z, &mut here);
    // By the first all unknowns at some distance from each other change nearly alike, so that their
    // difference hardly responds, but not by the second.
    let patterns = [|i: usize| i, |i: usize| i.wrapping_mul(i).wrapping_add(1)];
    for share in CHANGES {
        let mut sizes = vec![0.0; n];
        for pattern in patterns {
            let change =
                |(i, z): (usize, &f64)| z + share * irregular(pattern(i)) * metric.scale(i);
            let mut moved: Vec<f64> = z.iter().enumerate().map(change).collect();
            moved[n] = corrector.reflected(moved[n]);
            corrector.residual(*system, &moved, &mut there);
            for (size, (a, b)) in sizes.iter_mut().zip(here.iter().zip(&there)) {
                *size += 0.5 * ((b - a) / share).abs();
            }
        }
        let total: f64 = sizes.iter().sum();
        if total > 0.0 && total.is_finite() {
            return Ok(sizes);
        }
    }
    Err(Difficulty::Singular)
}

/// A bordering vector, outside the range of J with certainty in practice: the sizes of the equations with
/// irregular signs. Each component has the unit of its own equation and depends on no other, so that units
/// of the equations do not matter.
pub(crate) fn bordering_vector<S: System>(
    curve: &mut Curve<'_, S>,
    z: &[f64],
) -> Result<Vec<f64>, Difficulty> {
    let sizes = equation_sizes(curve, z)?.into_iter().enumerate();
    Ok(sizes.map(|(i, size)| size * irregular(i + 1)).collect())
}

/// Gives a node with its unit tangent the second null vectors of \[J b\] for both bordering vectors, where the
/// system was linearised last, if branch points are looked for.
pub(crate) fn find_seconds<S: System>(
    curve: &mut Curve<'_, S>,
    node: &mut Node,
) -> Result<(), Difficulty> {
    if !curve.branch_points {
        return Ok(());
    }
    let mut second =
        |border: &[f64]| NullSpace::second(curve.system, &curve.metric, &node.tangent, border);
    let both = second(&curve.border).zip(second(&curve.witness));
    (node.second, node.witness) = both.ok_or(Difficulty::Singular)?;
    Ok(())
}

/// Sets the bordering vectors at `z`, of the sizes of the equations.
pub(crate) fn set_borders<S: System>(
    curve: &mut Curve<'_, S>,
    z: &[f64],
) -> Result<(), Difficulty> {
    curve.border = bordering_vector(curve, z)?;
    let sizes = curve.border.iter().enumerate();
    // The signs of two equations next to each other that agree in one of the vectors differ in the other.
    let alternating = |(i, b): (usize, &f64)| {
        let share = irregular(i * i + 2 * i).abs() / irregular(i + 1).abs();
        if i % 2 == 0 { b * share } else { -b * share }
    };
    curve.witness = sizes.map(alternating).collect();
    Ok(())
}

/// Chooses the bordering vectors for a node, where the system was linearised last, and gives the node its
/// second vectors, if branch points are looked for.
pub(crate) fn choose_border<S: System>(
    curve: &mut Curve<'_, S>,
    node: &mut Node,
) -> Result<(), Difficulty> {
    if !curve.branch_points {
        return Ok(());
    }
    set_borders(curve, &node.z)?;
    find_seconds(curve, node)?;
    lengthen(&mut curve.border, &node.second);
    lengthen(&mut curve.witness, &node.witness);
    find_seconds(curve, node)
}

/// Enlarges a bordering vector b until v has length one, with J v = b: the second vector is (v, −1) up to its
/// length. With a short v the component η outweighs it, and pairs of branch points are missed.
fn lengthen(border: &mut [f64], second: &[f64]) {
    let eta = second.last().map_or(1.0, |eta| eta.abs());
    let length = (1.0 - eta * eta).sqrt() / eta;
    let scale = if length > 0.0 { length.min(1.0) } else { 1.0 };
    border.iter_mut().for_each(|b| *b /= scale);
}

/// Numbers between 0.5 and 1 of irregular size and sign.
pub(crate) fn irregular(i: usize) -> f64 {
    let x = (i as f64 + 1.0) * 0.618_033_988_749_894_9;
    let fraction = x - x.floor();
    (0.5 + 0.5 * fraction)
        * if fraction * 7.0 % 2.0 < 1.0 {
            1.0
        } else {
            -1.0
        }
}

/// Finds the branch point near `z`.
pub(crate) fn branch_point<S: System>(
    curve: &mut Curve<'_, S>,
    z: &[f64],
) -> Result<Crossing, Difficulty> {
    let Curve {
        system,
        metric,
        corrector,
        border: b,
        ..
    } = curve;
    let (system, metric, b) = (&mut **system, &*metric, &b[..]);
    let n = z.len() - 1;
    let (mut z, mut eta) = (z.to_vec(), 0.0);
    let mut residual = vec![0.0; n];
    let mut before = f64::INFINITY;
    let mut saddle = None;
    for count in 0.. {
        let space = NullSpace::at(system, corrector, metric, &z, b)?;
        corrector.residual(system, &z, &mut residual);
        let right: Vec<f64> = residual
            .iter()
            .zip(b)
            .map(|(g, b)| -(g + eta * b))
            .collect();
        let onto = space.shortest(system, metric, b, &right);
        let slopes = Slopes::at(system, corrector, metric, &z, b, &space, &onto[..=n])?;
        let gradient = [slopes.change[0], space.last(1) + slopes.change[1]];
        let a = solve(slopes.hessian, gradient.map(|g| -g)).ok_or(Difficulty::Singular)?;
        let along = space.combine(a);
        let length = metric.norm(&onto[..=n]) + a[0].hypot(a[1]);
        // At the origin corrections may go on shrinking until they underflow.
        let settled = length > 0.25 * before && before <= ROUNDING || length <= f64::EPSILON;
        let lost = length.is_nan() || length > 1.0 || count == STEPS;
        if lost {
            return Err(Difficulty::NoConvergence {
                correction: length,
                steps: count,
                limit: ROUNDING,
            });
        }
        if settled {
            saddle = Some((space, slopes));
            break;
        }
        add(&mut z, &mut eta, &onto);
        add(&mut z, &mut eta, &along);
        before = length;
    }
    let Some((space, Slopes { hessian, doubt, .. })) = saddle else {
        return Err(Difficulty::Singular);
    };
    let steepest = hessian
        .iter()
        .flatten()
        .fold(0.0, |m: f64, h| m.max(h.abs()));
    let gap = (2.0 * eta.abs() / steepest).sqrt();
    let meeting = if system.tolerance().is_finite() {
        MEETING_DISCRETISED
    } else {
        MEETING
    };
    if gap.is_nan() || gap > meeting {
        return Err(Difficulty::Imperfect { gap });
    }
    let tangents = null_directions(hessian).map(|directions| {
        directions.map(|a| {
            let mut tangent = space.combine(a);
            tangent.truncate(n + 1);
            metric.normalise(&mut tangent);
            tangent
        })
    });
    Ok(Crossing { z, tangents, doubt })
}

/// The branch point that changes the orientation between the nodes.
pub(crate) fn crossing<S: System>(
    span: &mut Span<'_, '_, S>,
) -> Result<(Located, Crossing), Difficulty> {
    // η changes its sign with the orientation.
    let eta = [span.from, span.to].map(Node::eta);
    let (along, metric) = (span.from.along, span.curve.metric.clone());
    let border = span.curve.border.clone();
    let start = eta[0].signum();
    let mut signed = |system: &mut S, _: &[f64], tangent: &[f64]| {
        let mut null = tangent.to_vec();
        system.null_vector(&mut null);
        let same = (metric.dot(&null, tangent) > 0.0) == along;
        let second = NullSpace::second(system, &metric, tangent, &border);
        let eta = second.map_or(0.0, |second| second[second.len() - 1].abs());
        if same { start * eta } else { -start * eta }
    };
    let near = match span.zero(&mut signed, eta, BRACKET) {
        Ok(near) => near.z,
        // Too close to the branch point to stay on the curve: start from the better end.
        Err(_) if eta[0].abs() < eta[1].abs() => span.from.z.clone(),
        Err(_) => span.to.z.clone(),
    };
    let crossing = branch_point(span.curve, &near)?;
    let place = span.place(&crossing.z);
    // What is found must lie between the nodes.
    let off: Vec<f64> = span
        .secant()
        .iter()
        .zip(&span.from.z)
        .zip(&crossing.z)
        .map(|((d, a), z)| z - a - place * d)
        .collect();
    let length = span.curve.metric.norm(&span.secant());
    let gap = span.curve.metric.norm(&off);
    let tangent = match &crossing.tangents {
        Some(pair) => span.along_secant(pair),
        None => span.to.tangent.clone(),
    };
    let between = (-BESIDE..=1.0 + BESIDE).contains(&place) && gap <= length;
    if !between || !span.leads_through(&tangent) {
        return Err(Difficulty::Imperfect { gap });
    }
    let z = crossing.z.clone();
    let u = place.clamp(0.0, 1.0);
    let along = span.to.along;
    let at = Located {
        u,
        z,
        tangent,
        along,
    };
    Ok((at, crossing))
}

fn add(z: &mut [f64], eta: &mut f64, step: &[f64]) {
    z.iter_mut().zip(step).for_each(|(z, d)| *z += d);
    *eta += step[z.len()];
}

/// Both solutions a of aᵀ D a = 0, unless D is definite.
fn null_directions(d: [[f64; 2]; 2]) -> Option<[[f64; 2]; 2]> {
    let (p, q, r) = (d[0][0], 0.5 * (d[0][1] + d[1][0]), d[1][1]);
    let discriminant = q * q - p * r;
    let size = p.abs().max(q.abs()).max(r.abs());
    if discriminant.is_nan() || discriminant <= 1e-6 * size * size {
        return None;
    }
    let s = q + discriminant.sqrt().copysign(q);
    Some([[-s, p], [-r, s]])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn null_directions_annul_the_form() {
        for d in [
            [[0.0, 1.0], [1.0, 0.0]],
            [[1.0, 0.0], [0.0, -4.0]],
            [[2.0, -3.0], [-3.0, 0.5]],
        ] {
            for a in null_directions(d).unwrap() {
                let form: f64 = (0..2)
                    .flat_map(|i| (0..2).map(move |j| a[i] * d[i][j] * a[j]))
                    .sum();
                assert!(form.abs() < 1e-12 && a[0].hypot(a[1]) > 0.0);
            }
        }
        assert!(null_directions([[1.0, 0.0], [0.0, 1.0]]).is_none());
    }
}
