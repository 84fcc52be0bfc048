//! Complex numbers: the axioms of a field, their derivatives, and a complex eigenvalue.

use bvp::{Complex, Dual, Ends, Function, Options, Problem, Real, Segment, solve};
use proptest::prelude::*;
use std::f64::consts::FRAC_PI_2;

fn number() -> impl Strategy<Value = Complex<f64>> {
    (-2.0..2.0f64, -2.0..2.0f64).prop_map(|(re, im)| Complex::new(re, im))
}

/// A number away from zero.
fn divisor() -> impl Strategy<Value = Complex<f64>> {
    number().prop_filter("away from zero", |z| z.norm_squared() > 0.01)
}

fn near(a: Complex<f64>, b: Complex<f64>) -> bool {
    (a - b).norm_squared().sqrt() < 1e-12 * (1.0 + b.norm_squared().sqrt())
}

const I: Complex<f64> = Complex::new(0.0, 1.0);

proptest! {
    #[test]
    fn the_axioms_of_a_field(a in number(), b in number(), c in number(), d in divisor()) {
        prop_assert!(near(a + b, b + a) && near(a * b, b * a));
        prop_assert!(near((a + b) + c, a + (b + c)) && near((a * b) * c, a * (b * c)));
        prop_assert!(near(a * (b + c), a * b + a * c));
        prop_assert!(near(a - a, Complex::from(0.0)) && near(a + -b, a - b));
        prop_assert!(near(d / d, Complex::from(1.0)) && near(a / d * d, a));
    }

    #[test]
    fn products_with_real_numbers_and_i(a in number(), x in 0.1..3.0f64) {
        let real = Complex::from(x);
        prop_assert_eq!(a + x, a + real);
        prop_assert_eq!(a - x, a - real);
        prop_assert!(near(a * x, a * real) && near(a / x, a / real) && near(a.scale(x), a * real));
        prop_assert_eq!((x + a, x - a), (real + a, real - a));
        prop_assert!(near(x * a, real * a));
        prop_assert!(a.norm_squared() < 0.01 || near(x / a, real / a));
        prop_assert!(near(a.times_i(), a * I) && near(I * I, Complex::from(-1.0)));
        let (mut b, mut pairs) = (a, [0.0; 6]);
        b += real;
        b *= a;
        b -= a;
        b /= real;
        prop_assert!(near(b, ((a + x) * a - a) / x));
        b.write(&mut pairs, 1);
        prop_assert_eq!(pairs, [0.0, 0.0, b.re, b.im, 0.0, 0.0]);
        prop_assert_eq!(Complex::read(&pairs, 1), b);
    }

    #[test]
    fn conjugates_moduli_and_exponentials(a in number(), b in number()) {
        prop_assert!(near((a * b).conj(), a.conj() * b.conj()));
        prop_assert!(near(a * a.conj(), Complex::from(a.norm_squared())));
        prop_assert!(near((a + b).exp(), a.exp() * b.exp()));
        prop_assert!(near(a.exp().conj(), a.conj().exp()));
    }

    #[test]
    fn derivatives_are_those_of_a_holomorphic_function(z in number(), d in divisor()) {
        // exp(z²)/d + z/(z + 4i) and its derivative.
        let derivative = z * (z * z).exp() * 2.0 / d + I * 4.0 / ((z + I * 4.0) * (z + I * 4.0));
        let w: Complex<Dual<2>> = Complex::new(Dual::variable(z.re, 0), Dual::variable(z.im, 1));
        let constant = |c: Complex<f64>| Complex::new(Dual::constant(c.re), Dual::constant(c.im));
        let f = (w * w).exp() / constant(d) + w / (w + constant(I * 4.0));
        let [along_re, along_im] = [0, 1].map(|j| Complex::new(f.re.gradient[j], f.im.gradient[j]));
        prop_assert!(near(along_re, derivative));
        // Cauchy and Riemann: ∂f/∂(im z) = i ∂f/∂(re z).
        prop_assert!(near(along_im, derivative.times_i()));
    }
}

#[test]
fn quotients_do_not_overflow() {
    let z = Complex::new(3e200, 4e200);
    assert!(near(z / z, Complex::from(1.0)));
    assert!(near(z.conj() / z * 25.0, Complex::new(-7.0, -24.0)));
    let nothing = z / Complex::from(0.0);
    assert!(nothing.re.is_nan() && nothing.im.is_nan());
}

/// Light in a slab of refractive index n that leaks out through one face: w″ = −κ² w, w(0) = 0,
/// w′(1) = i κ w(1)/n with unknown complex κ, and w′(0) = κ. With w = sin κs,
///
/// ```text
/// cot κ = i/n,   κ = (j + ½) π − (i/2) ln((n + 1)/(n − 1))
/// ```
struct Slab {
    n: f64,
}

impl Problem for Slab {
    fn segments(&self) -> Vec<Segment> {
        vec![Segment::new(4)]
    }

    fn parameters(&self) -> usize {
        2
    }

    fn rhs<T: Real>(&self, _: usize, _s: T, y: &[T], p: &[T], dy: &mut [T]) {
        let kappa = Complex::read(p, 0);
        Complex::read(y, 1).write(dy, 0);
        (-kappa * kappa * Complex::read(y, 0)).write(dy, 1);
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, p: &[T], r: &mut [T]) {
        let (wall, face, kappa) = (at.start(0), at.end(0), Complex::read(p, 0));
        let [w, slope] = [0, 1].map(|j| Complex::read(face, j));
        Complex::read(wall, 0).write(r, 0);
        (Complex::read(wall, 1) - kappa).write(r, 1);
        (slope - (kappa * w).times_i() / self.n).write(r, 2);
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(16))]

    #[test]
    fn complex_wavenumbers_of_a_leaking_slab(n in 1.5..4.0f64, j in 0..4u32) {
        let real = FRAC_PI_2 * f64::from(2 * j + 1);
        let imaginary = -0.5 * ((n + 1.0) / (n - 1.0)).ln();
        // The wave of a slab that does not leak.
        let guess = Function {
            state: |_: usize, s: f64| [(real * s).sin(), 0.0, real * (real * s).cos(), 0.0],
            parameters: vec![real, -0.1],
        };
        let solution = solve(&Slab { n }, &guess, &Options::to(1e-10)).unwrap();
        let kappa = Complex::read(solution.parameters(), 0);
        let error = (kappa - Complex::new(real, imaginary)).norm_squared().sqrt();
        prop_assert!(error < 2e-10 * (1.0 + real), "{error:e}");
    }
}
