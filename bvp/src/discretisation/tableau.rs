//! The coefficients of the schemes: nodes, weights and the polynomials behind them.

use crate::discretisation::lagrange::{Basis, lagrange_slopes};
use crate::discretisation::quadrature::{Quadrature, gauss, lobatto_points};
use crate::discretisation::scheme::{MAX_STAGES, Scheme};
use crate::kernels::dense::{add_product, add_scaled};
use std::ops::Range;
use std::sync::{Arc, OnceLock};

/// The number of powers of the stage matrix that are stored.
pub(crate) const POWERS: usize = 4;

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
    /// The values D̃ⱼ at the collocation points, m × (m + 1), whose products with polynomials of degree m − 1 the weights
    /// b integrate as those of the integral D are integrated: D̃ⱼ = ∫₀¹ βⱼ' D dθ / bⱼ.
    pub(crate) defect_to_weighted: Vec<f64>,
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
        let defect_slope = basis.table(&defect_rule.points, Basis::slopes);
        let defect_to_defect = of_defect.table(&defect_rule.points, Basis::values);
        let mut defect_to_weighted = vec![0.0; stages * (stages + 1)];
        for (j, row) in defect_to_weighted.chunks_exact_mut(stages + 1).enumerate() {
            let each = defect_rule
                .weights
                .iter()
                .zip(defect_slope.chunks_exact(stages));
            for ((weight, slopes), integral) in each.zip(defect_to_defect.chunks_exact(stages + 1))
            {
                add_scaled(row, weight * slopes[j] / b[j], integral);
            }
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
            defect_slope,
            defect_to_stage: of_defect.table(&c, Basis::values),
            defect_to_defect,
            defect_to_weighted,
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

/// The largest distance between neighbours among points.
fn widest_gap(mut points: Vec<f64>) -> f64 {
    points.sort_by(f64::total_cmp);
    let gaps = points.windows(2).map(|pair| pair[1] - pair[0]);
    gaps.fold(0.0, f64::max)
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
