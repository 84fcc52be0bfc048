//! How far the next branch point is from one that is located.
//!
//! At a branch point with unit tangent τ, J has a second null vector, and [J b] has a regular inverse across
//! its null space, w = [J b]⁺ r. Another branch point a distance s ahead is, to first order, where J + s J′ has
//! one more, J′ w = G″ τ w:
//!
//! ```text
//! w = −s [J b]⁺ J′ w
//! ```
//!
//! so that the power iteration w ← [J b]⁺ J′ w enlarges w by 1/|s| each time, with the nearest one the
//! fastest. It needs no test function, and one bordering vector cannot hide what is next to it.

use crate::curve::curve::Curve;
use crate::difficulty::Difficulty;
use crate::special_points::branch_point::irregular;
use crate::special_points::null_space::{NullSpace, dot};
use crate::special_points::second_derivative::{Line, Precision, mixed};
use crate::system::system::System;

/// Power iterations. The first starts anywhere, the second is along the nearest branch point where the next one is
/// not as near, and the third gives its distance.
const ITERATIONS: usize = 3;

/// The distance, in the arclength norm, to the next branch point from the one at `z` with unit `tangent`,
/// estimated to first order.
pub(crate) fn distance_to_next<S: System>(
    curve: &mut Curve<'_, S>,
    z: &[f64],
    tangent: &[f64],
) -> Result<f64, Difficulty> {
    let Curve {
        system,
        metric,
        corrector,
        border: b,
        ..
    } = curve;
    let (system, metric) = (&mut **system, &*metric);
    let n = z.len() - 1;
    let space = NullSpace::at(system, corrector, metric, z, b)?;
    let bounds = corrector.bounds();
    let second = |system: &mut S, direction: &[f64]| {
        let line = Line {
            z,
            direction,
            bounds,
            sizes: b,
        };
        line.second_derivative(system, Precision::Rough, |_, _| {})
            .values
    };
    let along = second(system, tangent);
    let start: Vec<f64> = (0..n).map(|i| irregular(i * i + 3) * b[i].abs()).collect();
    let mut w = space.shortest(system, metric, b, &start);
    let mut growth = 0.0;
    for _ in 0..ITERATIONS {
        let length = dot(metric, &w, &w).sqrt();
        if length == 0.0 {
            break;
        }
        w.iter_mut().for_each(|w| *w /= length);
        let both: Vec<f64> = w.iter().zip(tangent).map(|(w, t)| w + t).collect();
        let own = second(system, &w[..=n]);
        let right = mixed(&second(system, &both), &along, &own);
        w = space.shortest(system, metric, b, &right);
        growth = dot(metric, &w, &w).sqrt();
    }
    if growth.is_finite() {
        Ok(growth.recip())
    } else {
        Err(Difficulty::Singular)
    }
}
