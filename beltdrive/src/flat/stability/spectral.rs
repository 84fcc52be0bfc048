//! Eigenvalues by spectral elements.
//!
//! The weak form of the scaled problem is (σ² M + σ C + K + B) f = 0 with
//!
//! ```text
//! M = ∫ W f g        C = ∫ W M (f' g − f g')   + M f g at the outlet (Thesis)
//! K = ∫ W (δ f' g' + k f g)        B = ∫ e f' g   (not Conservative)
//! W = exp(−e (x − x*)) in the slip zone (Conservative),  1 otherwise
//! ```
//!
//! for all g that vanish where f does. With the factors M = L Lᵀ and K = N Nᵀ, y = σ Lᵀ f and
//! z = Nᵀ f it becomes
//!
//! ```text
//!   ⎡z⎤   ⎡           0                Nᵀ L⁻ᵀ    ⎤ ⎡z⎤
//! σ ⎢ ⎥ = ⎢                                      ⎥ ⎢ ⎥
//!   ⎣y⎦   ⎣ −L⁻¹ (N + B N⁻ᵀ)        −L⁻¹ C L⁻ᵀ   ⎦ ⎣y⎦
//! ```
//!
//! whose matrix is skew but for outlet and friction, so that its eigenvalues are as exact as its
//! entries.

use super::LinearisedForm;
use super::polynomials::{gauss, shape_functions};
use super::scaled::{Scaled, Zone};
use faer::linalg::triangular_solve::solve_lower_triangular_in_place;
use faer::{Mat, Par, Side, c64};
use std::f64::consts::PI;

/// A mode that decays by e to this power on its way through a zone does not feel its far end.
const DECAYED: f64 = 20.0;
/// ln of the relative error of a polynomial of sufficient degree, whose square is that of the
/// eigenvalue.
const LN_ERROR: f64 = -22.0;
/// The most unknowns, which bounds time and memory.
const MOST_UNKNOWNS: usize = 800;
/// Points of the quadrature beyond those for the polynomials, for the weight.
const POINTS_FOR_WEIGHT: usize = 12;

/// An element: a zone, or what moves of it, and the degree of its polynomials.
#[derive(Clone, Copy, Debug)]
struct Element {
    zone: Zone,
    degree: usize,
}

/// The matrices of the weak form.
struct Matrices {
    mass: Mat<f64>,
    gyroscopic: Mat<f64>,
    stiffness: Mat<f64>,
    friction: Mat<f64>,
}

impl Scaled {
    /// Eigenvalues with Im σ ≥ 0 in the order of Im σ, real ones from the largest, at least `count`
    /// of them accurate; none if these modes are too short to be resolved, or the matrices have no
    /// factors or eigenvalues in finite arithmetic.
    pub(super) fn spectral_eigenvalues(&self, count: usize) -> Option<Vec<c64>> {
        let highest = self.highest(count);
        let elements = self.elements(highest);
        if elements.iter().map(|element| element.degree).sum::<usize>() > MOST_UNKNOWNS {
            return None;
        }
        let matrix = Matrices::new(self, &elements).linearised()?;
        let mut values = matrix.eigenvalues().ok()?;
        // Those far beyond belong to the elements, not to the belt.
        values.retain(|value| value.im >= 0.0 && value.norm() < 2.0 * highest + 1.0);
        values.sort_by(|a, b| a.im.total_cmp(&b.im).then(b.re.total_cmp(&a.re)));
        Some(values)
    }

    /// A bound of the frequency of mode `count`. The belt is on springs as a whole, or held at the
    /// end of the elastic zone, whichever is lower: without friction and with the natural outlet
    /// f = exp(M σ x/δ) y leads to −δ² y'' + δ k y = −σ² y.
    fn highest(&self, count: usize) -> f64 {
        let waves = (count as f64 + 0.5) * PI;
        let stiffness = self
            .zones
            .iter()
            .map(|zone| zone.stiffness)
            .fold(0.0, f64::max);
        let slip = self
            .zones
            .iter()
            .map(|zone| zone.slip.abs())
            .fold(0.0, f64::max);
        let whole = (self.delta * (stiffness + self.delta * waves * waves)).sqrt();
        let free = self.zones.iter().filter(|zone| zone.stiffness == 0.0);
        let held = free
            .map(|zone| self.delta * waves / zone.length)
            .fold(f64::INFINITY, f64::min);
        whole.min(held) + 0.5 * slip
    }

    /// Elements that resolve all modes up to the frequency `highest`.
    fn elements(&self, highest: f64) -> Vec<Element> {
        // A zone on its own has no layers, and its end is that of the belt.
        let layered = self.zones.len() > 1;
        let element = |zone: &Zone| {
            let mut zone = *zone;
            // f goes like exp((a ± d) x).
            let [slow, fast] = [0.0, highest].map(|frequency| {
                let at = self.coefficients(&zone, c64::new(0.0, frequency));
                (at.a, (at.a * at.a + at.b).sqrt())
            });
            // An elastic zone in which even the highest mode dies out moves at its end only.
            let reach = DECAYED / fast.1.re;
            if layered && zone.stiffness > 0.0 && reach < zone.length {
                zone.start += zone.length - reach;
                zone.length = reach;
            }
            let half = |(a, d): (c64, c64)| 0.5 * zone.length * (a.norm() + d.norm());
            let layers = if layered { half(slow) } else { 0.0 };
            let degree = degree(half(fast), 0.0).max(degree(layers, layers));
            Element { zone, degree }
        };
        self.zones.iter().map(element).collect()
    }
}

/// The degree at which polynomials on −1 ≤ t ≤ 1 resolve exp(±i θ t), or exp(±θ t) relative to its
/// largest value exp(`growth`), growth being θ: the Legendre coefficients fall like
/// (θ/2)^n/n! exp(`growth`²/4n − `growth`).
fn degree(theta: f64, growth: f64) -> usize {
    let (mut n, mut ln_factorial) = (1, 0.0);
    while n <= MOST_UNKNOWNS {
        let m = n as f64;
        ln_factorial += m.ln();
        let decay = m * (0.5 * theta).ln() - ln_factorial + growth * (growth / (4.0 * m) - 1.0);
        if decay < LN_ERROR {
            break;
        }
        n += 1;
    }
    n + 1
}

impl Matrices {
    fn new(scaled: &Scaled, elements: &[Element]) -> Self {
        let size: usize = elements.iter().map(|element| element.degree).sum();
        let zero = || Mat::zeros(size, size);
        let mut matrices = Self {
            mass: zero(),
            gyroscopic: zero(),
            stiffness: zero(),
            friction: zero(),
        };
        // Unknowns: of every element its end, then what vanishes at both ends. The start of an
        // element is the end of the one before; the first one is held there.
        let (mut start, mut first) = (None, 0);
        for element in elements {
            let inner = (2..=element.degree).map(|n| Some(first + n - 1));
            let unknowns: Vec<_> = [start, Some(first)].into_iter().chain(inner).collect();
            matrices.add(scaled, element, &unknowns);
            start = Some(first);
            first += element.degree;
        }
        if let (LinearisedForm::Thesis, Some(outlet)) = (scaled.form, start) {
            matrices.gyroscopic[(outlet, outlet)] += scaled.mach;
        }
        matrices
    }

    /// Adds the integrals over an element whose shape functions have these `unknowns`.
    fn add(&mut self, scaled: &Scaled, element: &Element, unknowns: &[Option<usize>]) {
        let Element { zone, degree } = *element;
        let conservative = scaled.form == LinearisedForm::Conservative;
        for (t, weight) in gauss(degree + 1 + POINTS_FOR_WEIGHT) {
            let (values, derivatives) = shape_functions(degree, t);
            let x = 0.5 * (1.0 + t) * zone.length;
            let (density, slip) = if conservative {
                ((-zone.slip * x).exp(), 0.0)
            } else {
                (1.0, zone.slip)
            };
            // ∫ f g, ∫ f' g and ∫ f' g' take these factors.
            let weight = weight * density;
            let (over, once, under) = (
                0.5 * zone.length * weight,
                weight,
                2.0 * weight / zone.length,
            );
            for (i, row) in unknowns.iter().enumerate() {
                for (j, column) in unknowns.iter().enumerate() {
                    let (&Some(row), &Some(column)) = (row, column) else {
                        continue;
                    };
                    let plain = over * (values[i] * values[j]);
                    let (left, right) = (values[i] * derivatives[j], values[j] * derivatives[i]);
                    let at = (row, column);
                    self.mass[at] += plain;
                    self.gyroscopic[at] += once * scaled.mach * (left - right);
                    self.stiffness[at] += under * scaled.delta * (derivatives[i] * derivatives[j]);
                    self.stiffness[at] += zone.stiffness * plain;
                    self.friction[at] += once * slip * left;
                }
            }
        }
    }

    /// The matrix of the linear eigenvalue problem.
    fn linearised(&self) -> Option<Mat<f64>> {
        let size = self.mass.nrows();
        let mass = self.mass.llt(Side::Lower).ok()?;
        let stiffness = self.stiffness.llt(Side::Lower).ok()?;
        let over = |factor: &Mat<f64>, mut right: Mat<f64>| {
            solve_lower_triangular_in_place(factor.as_ref(), right.as_mut(), Par::Seq);
            right
        };
        let (lower, root) = (mass.L().to_owned(), stiffness.L().to_owned());
        let elastic = over(&lower, root.clone());
        let friction = over(
            &root,
            over(&lower, self.friction.clone()).transpose().to_owned(),
        );
        let gyroscopic = over(
            &lower,
            over(&lower, self.gyroscopic.clone()).transpose().to_owned(),
        );
        let entry = |i: usize, j: usize| match (i < size, j < size) {
            (true, true) => 0.0,
            (true, false) => elastic[(j - size, i)],
            (false, true) => -elastic[(i - size, j)] - friction[(j, i - size)],
            (false, false) => -gyroscopic[(j - size, i - size)],
        };
        let matrix = Mat::from_fn(2 * size, 2 * size, entry);
        let columns = 0..matrix.ncols();
        let finite = columns
            .flat_map(|j| matrix.col(j).iter())
            .all(|x| x.is_finite());
        finite.then_some(matrix)
    }
}

#[cfg(test)]
mod tests {
    use super::super::examples::{FORMS, coulomb_at_rest, driven};
    use super::*;

    fn first(scaled: &Scaled, degree: usize) -> c64 {
        let elements: Vec<_> = scaled
            .zones
            .iter()
            .map(|&zone| Element { zone, degree })
            .collect();
        let matrix = Matrices::new(scaled, &elements)
            .linearised()
            .expect("factors");
        let values = matrix.eigenvalues().expect("eigenvalues");
        let upper = values.into_iter().filter(|value| value.im >= 0.0);
        upper.min_by(|a, b| a.im.total_cmp(&b.im)).expect("one")
    }

    #[test]
    fn errors_fall_exponentially_with_the_degree() {
        for form in FORMS {
            let scaled = Scaled::new(&driven(800.0), form);
            let exact = scaled.root_near(first(&scaled, 20)).expect("convergence");
            let error = |degree| (first(&scaled, degree) / exact - 1.0).norm();
            let errors = [2, 4, 6, 8, 10, 12].map(error);
            for pair in errors.windows(2) {
                assert!(
                    pair[1] < 0.1 * pair[0] || pair[1] < 1e-12,
                    "{form:?} {errors:?}"
                );
            }
            assert!(errors[5] < 1e-11, "{form:?} {errors:?}");
        }
    }

    #[test]
    fn a_rod_vibrates() {
        let scaled = Scaled::new(&coulomb_at_rest(), LinearisedForm::Thesis);
        let values = scaled.spectral_eigenvalues(40).expect("eigenvalues");
        for (n, value) in values.iter().take(40).enumerate() {
            let exact = (n as f64 + 0.5) * PI;
            assert!((value.im / exact - 1.0).abs() < 1e-12 && value.re.abs() < 1e-12 * exact);
        }
    }
}
