//! The coefficients of the schemes: nodes, weights and the polynomials behind them.

use crate::discretisation::scheme::MAX_STAGES;
use crate::discretisation::scheme::Scheme;
use crate::kernels::dense::{add_product, add_scaled};
use std::f64::consts::PI;
use std::ops::Range;
use std::sync::{Arc, OnceLock};

/// The number of powers of the stage matrix that are stored.
pub(crate) const POWERS: usize = 4;

/// A rule on \[0, 1\]: ∫ g ≈ Σ weights g(points).
#[derive(Clone, Debug)]
pub(crate) struct Quadrature {
    pub(crate) points: Vec<f64>,
    pub(crate) weights: Vec<f64>,
}

/// The coefficients of a [`Scheme`] and its collocation polynomial at the points the solver needs.
///
/// Matrices are row-major.
#[derive(Clone, Debug)]
pub(crate) struct Tableau {
    pub(crate) scheme: Scheme,
    /// Number of stages m.
    pub(crate) stages: usize,
    /// Collocation points cⱼ in \[0, 1\].
    pub(crate) c: Vec<f64>,
    /// Weights bⱼ = βⱼ(1).
    pub(crate) b: Vec<f64>,
    /// Stage matrix aⱼₗ = βₗ(cⱼ), m × m.
    pub(crate) a: Vec<f64>,
    /// Its powers A, A², …, m × m each.
    pub(crate) powers: Vec<f64>,
    /// The same column by column.
    pub(crate) columns: Vec<f64>,
    /// bᵀ, bᵀ A, bᵀ A², …, m numbers each; as many as there are powers.
    pub(crate) weights: Vec<f64>,
    /// Where the defect is sampled: the Gauss rule with m + 1 points, which integrates the square
    /// of the leading defect ∝ Πⱼ (θ − cⱼ) exactly and whose points are never collocation points.
    pub(crate) defect_rule: Quadrature,
    /// The widest gap between the collocation and defect points of an interval, as a share of it.
    pub(crate) widest_gap: f64,
    /// βₗ at the defect points, (m + 1) × m.
    pub(crate) defect_value: Vec<f64>,
    /// βₗ' at the defect points, (m + 1) × m.
    pub(crate) defect_slope: Vec<f64>,
    /// Integrals from 0 of the polynomial through values at the defect points: to the collocation points,
    /// m × (m + 1), and to the defect points, (m + 1) × (m + 1).
    pub(crate) defect_to_stage: Vec<f64>,
    pub(crate) defect_to_defect: Vec<f64>,
    /// βₗ' at the collocation points of the left and of the right half of an interval, 2m × m.
    pub(crate) half_slopes: Vec<f64>,
    /// βₗ(½).
    pub(crate) half_value: Vec<f64>,
    /// The polynomials behind the continuous solution.
    basis: Basis,
    /// The coefficients of uᵏ, u = 2θ − 1, in the Lagrange polynomials on the collocation points, m × m, a
    /// row per power.
    pub(crate) powers_of_slope: Vec<f64>,
    /// m + 1 distinct points, the first 0, at which a guess is interpolated.
    pub(crate) guess_points: Vec<f64>,
    /// Slopes at the collocation points of the polynomial through values at the guess points,
    /// m × (m + 1).
    pub(crate) guess_slope: Vec<f64>,
}

impl Tableau {
    /// The tableau of a scheme that is provided, computed once.
    pub(crate) fn of(scheme: Scheme) -> Arc<Self> {
        static GAUSS: [OnceLock<Arc<Tableau>>; MAX_STAGES + 1] =
            [const { OnceLock::new() }; MAX_STAGES + 1];
        static LOBATTO: [OnceLock<Arc<Tableau>>; MAX_STAGES + 1] =
            [const { OnceLock::new() }; MAX_STAGES + 1];
        let computed = match scheme {
            Scheme::Gauss { stages } => &GAUSS[stages],
            Scheme::LobattoIIIA { stages } => &LOBATTO[stages],
        };
        Arc::clone(computed.get_or_init(|| Arc::new(Self::new(scheme))))
    }

    pub(crate) fn new(scheme: Scheme) -> Self {
        let stages = scheme.stages();
        let c = match scheme {
            Scheme::LobattoIIIA { stages } => lobatto_points(stages),
            Scheme::Gauss { stages } => gauss(stages).points,
        };
        let basis = Basis::new(c.clone());
        let defect_rule = gauss(stages + 1);
        let of_defect = Basis::new(defect_rule.points.clone());
        let values = |points: &[f64]| basis.table(points, Basis::values);
        let halves = [0.0, 0.5].map(|left| c.iter().map(move |c| left + 0.5 * c));
        let halves: Vec<f64> = halves.into_iter().flatten().collect();
        let mut guess_points = c.clone();
        if c[0] > 0.0 {
            guess_points.insert(0, 0.0);
        } else {
            guess_points.insert(1, 0.5 * (c[0] + c[1]));
        }
        let (b, a) = (values(&[1.0]), values(&c));
        let mut powers = a.clone();
        let mut weights = b.clone();
        for power in 1..POWERS {
            let next = product(&powers[(power - 1) * stages * stages..], &a, stages);
            powers.extend(next);
            let next = product(&weights[(power - 1) * stages..], &a, stages);
            weights.extend(next);
        }
        Self {
            scheme,
            stages,
            b,
            a,
            columns: powers
                .chunks_exact(stages * stages)
                .flat_map(|power| {
                    (0..stages * stages).map(|i| power[i % stages * stages + i / stages])
                })
                .collect(),
            powers,
            weights,
            widest_gap: widest_gap([&c[..], &defect_rule.points].concat()),
            defect_value: values(&defect_rule.points),
            defect_slope: basis.table(&defect_rule.points, Basis::slopes),
            defect_to_stage: of_defect.table(&c, Basis::values),
            defect_to_defect: of_defect.table(&defect_rule.points, Basis::values),
            half_slopes: basis.table(&halves, Basis::slopes),
            half_value: values(&[0.5]),
            powers_of_slope: basis.powers(),
            guess_slope: c
                .iter()
                .flat_map(|&x| lagrange_slopes(&guess_points, x))
                .collect(),
            basis,
            c,
            defect_rule,
            guess_points,
        }
    }

    /// The weights βₗ(θ) of the continuous solution into `weights` (m numbers), for 0 ≤ θ ≤ 1.
    #[inline]
    pub(crate) fn value_weights(&self, theta: f64, weights: &mut [f64]) {
        self.basis.values(theta, weights);
    }

    /// The weights βₗ'(θ) of its derivative into `weights`.
    #[inline]
    pub(crate) fn slope_weights(&self, theta: f64, weights: &mut [f64]) {
        self.basis.slopes(theta, weights);
    }
}

/// The two collocation points in the middle of an interval, of m.
pub(crate) fn middle(m: usize) -> Range<usize> {
    (m / 2).saturating_sub(1)..m / 2 + 1
}

/// The product of a row-major matrix with n columns and an n × n matrix.
fn product(a: &[f64], b: &[f64], n: usize) -> Vec<f64> {
    let mut c = vec![0.0; a.len()];
    add_product(&mut c, a, b, n, n);
    c
}

/// Lagrange polynomials ℓₗ on the collocation points and their integrals βₗ(θ) = ∫₀^θ ℓₗ.
#[derive(Clone, Debug)]
struct Basis {
    points: Vec<f64>,
    /// 1 / Πⱼ (cₗ − cⱼ), j ≠ l.
    scale: Vec<f64>,
    /// The smallest Gauss rule that integrates ℓₗ exactly.
    rule: Quadrature,
}

impl Basis {
    fn new(points: Vec<f64>) -> Self {
        let scale = (0..points.len())
            .map(|l| {
                let others = (0..points.len()).filter(|&j| j != l);
                1.0 / others.map(|j| points[l] - points[j]).product::<f64>()
            })
            .collect();
        let rule = gauss(points.len().div_ceil(2));
        Self {
            points,
            scale,
            rule,
        }
    }

    /// ℓₗ(x) for all l.
    #[inline(always)]
    fn slopes(&self, x: f64, out: &mut [f64]) {
        // Products of the factors to the left of l, then times those to its right.
        let mut product = 1.0;
        for (out, (c, scale)) in out.iter_mut().zip(self.points.iter().zip(&self.scale)) {
            *out = scale * product;
            product *= x - c;
        }
        product = 1.0;
        for (out, c) in out.iter_mut().zip(&self.points).rev() {
            *out *= product;
            product *= x - c;
        }
    }

    /// ∫₀^x ℓₗ for all l.
    #[inline(always)]
    fn values(&self, x: f64, out: &mut [f64]) {
        let mut at_point = [0.0; MAX_STAGES + 1];
        let at_point = &mut at_point[..out.len()];
        out.fill(0.0);
        for (t, weight) in self.rule.points.iter().zip(&self.rule.weights) {
            self.slopes(t * x, at_point);
            add_scaled(out, weight * x, at_point);
        }
    }

    /// The coefficients of uᵏ, u = 2x − 1, in all ℓₗ, a row per power.
    fn powers(&self) -> Vec<f64> {
        let m = self.points.len();
        let mut powers = vec![0.0; m * m];
        for l in 0..m {
            // Factors x − cⱼ = u/2 + ½ − cⱼ, one after the other.
            let mut product = vec![self.scale[l]];
            for c in (0..m).filter(|&j| j != l).map(|j| self.points[j]) {
                let shifted = [&[0.0], &product[..]].concat();
                product.push(0.0);
                for (coefficient, before) in product.iter_mut().zip(shifted) {
                    *coefficient = (0.5 - c) * *coefficient + 0.5 * before;
                }
            }
            for (row, coefficient) in powers.chunks_exact_mut(m).zip(product) {
                row[l] = coefficient;
            }
        }
        powers
    }

    /// One row of `function` per point, row-major.
    fn table(&self, points: &[f64], function: fn(&Self, f64, &mut [f64])) -> Vec<f64> {
        let m = self.points.len();
        let mut table = vec![0.0; points.len() * m];
        for (row, &x) in table.chunks_exact_mut(m).zip(points) {
            function(self, x, row);
        }
        table
    }
}

/// The largest distance between neighbours among points.
fn widest_gap(mut points: Vec<f64>) -> f64 {
    points.sort_by(f64::total_cmp);
    let gaps = points.windows(2).map(|pair| pair[1] - pair[0]);
    gaps.fold(0.0, f64::max)
}

/// ℓ'(x) of all Lagrange polynomials on `points`.
fn lagrange_slopes(points: &[f64], x: f64) -> Vec<f64> {
    let slope = |index: usize| -> f64 {
        let without = |skip: usize| -> f64 {
            (0..points.len())
                .filter(|&j| j != index && j != skip)
                .map(|j| (x - points[j]) / (points[index] - points[j]))
                .product()
        };
        (0..points.len())
            .filter(|&k| k != index)
            .map(|k| without(k) / (points[index] - points[k]))
            .sum()
    };
    (0..points.len()).map(slope).collect()
}

/// Legendre polynomials Pₙ₋₁(x) and Pₙ(x), n ≥ 1, by the three-term recurrence.
fn legendre(n: usize, x: f64) -> (f64, f64) {
    let (mut previous, mut current) = (1.0, x);
    for k in 2..=n {
        let k = k as f64;
        let next = ((2.0 * k - 1.0) * x * current - (k - 1.0) * previous) / k;
        (previous, current) = (current, next);
    }
    (previous, current)
}

/// The Gauss-Legendre rule with n points on \[0, 1\].
pub(crate) fn gauss(n: usize) -> Quadrature {
    let order = n as f64;
    let mut rule = Quadrature {
        points: Vec::with_capacity(n),
        weights: Vec::with_capacity(n),
    };
    for i in (0..n).rev() {
        // Tricomi's estimate of the root of Pₙ, polished by Newton's method.
        let mut x = (PI * (i as f64 + 0.75) / (order + 0.5)).cos();
        let mut slope = 1.0;
        for _ in 0..6 {
            let (previous, current) = legendre(n, x);
            slope = order * (previous - x * current) / (1.0 - x * x);
            x -= current / slope;
        }
        rule.points.push(0.5 * (1.0 + x));
        rule.weights.push(1.0 / ((1.0 - x * x) * slope * slope));
    }
    rule
}

/// The Lobatto points on \[0, 1\]: both ends and the roots of P'ₙ₋₁, all of them roots of
/// Pₙ − Pₙ₋₂, whose derivative is (2n − 1) Pₙ₋₁.
fn lobatto_points(n: usize) -> Vec<f64> {
    let interior = |i: usize| {
        let mut x = -(PI * i as f64 / (n - 1) as f64).cos();
        for _ in 0..8 {
            let (p1, p) = legendre(n, x);
            let (_, p2) = legendre(n - 2, x);
            x -= (p - p2) / ((2 * n - 1) as f64 * p1);
        }
        0.5 * (1.0 + x)
    };
    let mut points = vec![0.0];
    points.extend((1..n - 1).map(interior));
    points.push(1.0);
    points
}

#[cfg(test)]
mod tests {
    use super::*;

    fn all_schemes() -> Vec<Scheme> {
        let mut schemes: Vec<_> = (1..=7).map(|stages| Scheme::Gauss { stages }).collect();
        schemes.extend([3, 4].map(|stages| Scheme::LobattoIIIA { stages }));
        schemes
    }

    #[test]
    fn order_conditions() {
        // B(order): Σ bⱼ cⱼ^(q−1) = 1/q; C(m): Σ aⱼₗ cₗ^(q−1) = cⱼ^q/q (Hairer & Wanner, IV.5).
        for scheme in all_schemes() {
            let t = Tableau::new(scheme);
            for q in 1..=scheme.order() {
                let power = |x: f64| x.powi(i32::try_from(q).unwrap() - 1);
                let sum: f64 = (0..t.stages).map(|j| t.b[j] * power(t.c[j])).sum();
                assert!((sum * q as f64 - 1.0).abs() < 1e-14, "{scheme:?} B({q})");
                for j in 0..t.stages {
                    if q <= t.stages {
                        let row = &t.a[j * t.stages..][..t.stages];
                        let sum: f64 = row.iter().zip(&t.c).map(|(a, &c)| a * power(c)).sum();
                        let exact = t.c[j] * power(t.c[j]) / q as f64;
                        assert!((sum - exact).abs() < 1e-15, "{scheme:?} C({q})");
                    }
                }
            }
        }
    }

    #[test]
    fn lobatto_with_three_stages_is_simpsons_rule() {
        let t = Tableau::new(Scheme::LobattoIIIA { stages: 3 });
        for (found, exact) in t.b.iter().zip([1.0 / 6.0, 2.0 / 3.0, 1.0 / 6.0]) {
            assert!((found - exact).abs() < 1e-15);
        }
        let c = Tableau::new(Scheme::LobattoIIIA { stages: 4 }).c;
        assert!((c[1] - 0.5 * (1.0 - 1.0 / 5f64.sqrt())).abs() < 1e-16);
    }

    #[test]
    fn guess_slopes_are_exact_for_polynomials_of_the_solutions_degree() {
        for scheme in all_schemes() {
            let t = Tableau::new(scheme);
            assert_eq!(t.guess_points.len(), t.stages + 1);
            assert_eq!(t.guess_points[0], 0.0);
            let degree = i32::try_from(t.stages).unwrap();
            for j in 0..t.stages {
                let row = &t.guess_slope[j * (t.stages + 1)..][..=t.stages];
                let slope: f64 = row
                    .iter()
                    .zip(&t.guess_points)
                    .map(|(d, &x)| d * x.powi(degree))
                    .sum();
                let exact = f64::from(degree) * t.c[j].powi(degree - 1);
                assert!((slope - exact).abs() < 1e-12, "{scheme:?}");
            }
        }
    }

    #[test]
    fn defect_points_are_no_collocation_points() {
        for scheme in all_schemes() {
            let t = Tableau::new(scheme);
            for x in &t.defect_rule.points {
                assert!(t.c.iter().all(|c| (c - x).abs() > 1e-3), "{scheme:?}");
            }
        }
    }
}
