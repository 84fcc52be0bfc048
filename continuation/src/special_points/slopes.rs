//! The derivatives of the η components of a null space: the Hessian of η on the unfolded surface.

use crate::curve::corrector::Corrector;
use crate::curve::metric::Metric;
use crate::difficulty::Difficulty;
use crate::special_points::null_space::NullSpace;
use crate::special_points::second_derivative::{Line, Precision, Second, mixed};
use crate::system::difference::{IRREGULAR, largest};
use crate::system::system::System;

/// Step of the differences of φ, in the arclength norm: those of a function of size one are accurate to
/// 1e-7, or 1e-5 with a Jacobian by differences, by which corrections then shrink. A kink further away than
/// this does not matter.
const STEP: f64 = 1e-7;

/// The derivatives of φ, the η components of the null space of \[J b\] in a basis dual to a fixed one.
pub(crate) struct Slopes {
    /// D = grad φ along the basis, row by row.
    pub(crate) hessian: [[f64; 2]; 2],
    /// The change of φ by the way onto the surface.
    pub(crate) change: [f64; 2],
    /// By how much D is uncertain, relative to its largest entry; infinite where it is not known.
    pub(crate) doubt: f64,
}

impl Slopes {
    /// The derivatives at `z`, where the system was linearised last and the null space is `space`, and the
    /// change by `onto`.
    ///
    /// They follow from second derivatives of G. Where G has a kink so close that these are none, D is
    /// found by differences of φ, which needs first derivatives only, in two further linearisations; the
    /// last one is then not at `z`.
    pub(crate) fn at<S: System>(
        system: &mut S,
        corrector: &mut Corrector,
        metric: &Metric,
        z: &[f64],
        b: &[f64],
        space: &NullSpace,
        onto: &[f64],
    ) -> Result<Self, Difficulty> {
        let bounds = corrector.bounds();
        let sizes: Vec<f64> = b.iter().map(|b| b.abs()).collect();
        let second = |system: &mut S, direction: &[f64], precision: Precision| {
            let line = Line {
                z,
                direction,
                bounds,
                sizes: &sizes,
            };
            line.second_derivative(system, precision, |_, _| {})
        };
        let sum =
            |a: &[f64], b: &[f64]| -> Vec<f64> { a.iter().zip(b).map(|(a, b)| a + b).collect() };
        let basis = [0, 1].map(|i| &space.0[i][..z.len()]);
        let own = basis.map(|direction| second(system, direction, Precision::Fine));
        let both = second(system, &sum(basis[0], basis[1]), Precision::Fine);
        let [doubt, kink] = relative([&own[0], &own[1], &both], &sizes);
        let own = own.map(|own| own.values);
        let cross = mixed(&both.values, &own[0], &own[1]);
        let length = metric.norm(onto);
        let along_onto = (length > 0.0).then(|| {
            let unit: Vec<f64> = onto.iter().map(|v| v / length).collect();
            let onward = second(system, &unit, Precision::Rough).values;
            [0, 1].map(|i| {
                let both = second(system, &sum(&unit, basis[i]), Precision::Rough);
                mixed(&both.values, &onward, &own[i])
            })
        });
        let mut rate = |seconds: [&Vec<f64>; 2]| {
            let rates = seconds.map(|second| {
                let turned = space.shortest(system, metric, b, second);
                turned.iter().map(|w| -w).collect()
            });
            space
                .eta_rate(metric, space, &rates)
                .ok_or(Difficulty::Singular)
        };
        let ([p, r], [q, s]) = (rate([&own[0], &cross])?, rate([&cross, &own[1]])?);
        let change = match &along_onto {
            Some([first, last]) => rate([first, last])?.map(|rate| length * rate),
            None => [0.0; 2],
        };
        let (hessian, doubt) = if kink <= IRREGULAR {
            ([[p, q], [r, s]], doubt)
        } else {
            let hessian = differenced(system, corrector, metric, z, b, space)?;
            (hessian, f64::INFINITY)
        };
        Ok(Self {
            hessian,
            change,
            doubt,
        })
    }
}

/// The largest doubt of second derivatives, and the largest kink, relative to the largest of them.
fn relative([a, b, c]: [&Second; 3], sizes: &[f64]) -> [f64; 2] {
    let all = [a, b, c];
    let size = all.iter().map(|second| largest(&second.values, sizes));
    let size = size.fold(0.0, f64::max);
    let doubt = all.iter().fold(0.0, |m: f64, second| m.max(second.doubt));
    let kink = all.iter().fold(0.0, |m: f64, second| m.max(second.kink));
    [doubt / size, kink / size]
}

/// D by differences of φ within the bounds of λ.
fn differenced<S: System>(
    system: &mut S,
    corrector: &mut Corrector,
    metric: &Metric,
    z: &[f64],
    b: &[f64],
    space: &NullSpace,
) -> Result<[[f64; 2]; 2], Difficulty> {
    let mut columns = [[0.0; 2]; 2];
    for (column, basis) in columns.iter_mut().zip(&space.0) {
        let line = Line {
            z,
            direction: &basis[..z.len()],
            bounds: corrector.bounds(),
            sizes: &[],
        };
        let [behind, ahead] = line.room();
        let step = if ahead >= behind { STEP } else { -STEP };
        let there = NullSpace::at(system, corrector, metric, &line.moved(step), b)?;
        let moved = there.eta(metric, space).ok_or(Difficulty::Singular)?;
        *column = [moved[0] / step, (moved[1] - space.last(1)) / step];
    }
    let [[p, r], [q, s]] = columns;
    Ok([[p, q], [r, s]])
}
