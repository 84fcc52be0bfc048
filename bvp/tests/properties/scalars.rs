//! Dual numbers: derivatives against central differences, and identities.

use bvp::{Complex, Dual, LeftOf, Real};
use proptest::prelude::*;

/// A function of two arguments with any scalar.
trait Function {
    fn at<T: Real>(&self, x: T, y: T) -> T
    where
        f64: LeftOf<T>;
}

/// Every function of [`Real`] whose derivative exists for all x, and y > 0 or y away from 0.
#[derive(Clone, Copy, Debug)]
enum Smooth {
    Exp,
    LnOfPositive,
    Sin,
    Cos,
    SinCos,
    Tan,
    Atan,
    Atan2,
    Asin,
    Sinh,
    Cosh,
    Tanh,
    SqrtOfPositive,
    Powi,
    NegativePowi,
    Powf,
    Abs,
    Hypot,
    Min,
    Max,
    Erf,
    Sum,
    Difference,
    Product,
    Quotient,
    Negative,
    WithConstants,
    Assigned,
    ExpM1,
    Ln1p,
    Acos,
    Asinh,
    AcoshAboveOne,
    Atanh,
    Pow,
    Applied,
    OnTheLeft,
}

const ALL: [Smooth; 37] = [
    Smooth::Exp,
    Smooth::LnOfPositive,
    Smooth::Sin,
    Smooth::Cos,
    Smooth::SinCos,
    Smooth::Tan,
    Smooth::Atan,
    Smooth::Atan2,
    Smooth::Asin,
    Smooth::Sinh,
    Smooth::Cosh,
    Smooth::Tanh,
    Smooth::SqrtOfPositive,
    Smooth::Powi,
    Smooth::NegativePowi,
    Smooth::Powf,
    Smooth::Abs,
    Smooth::Hypot,
    Smooth::Min,
    Smooth::Max,
    Smooth::Erf,
    Smooth::Sum,
    Smooth::Difference,
    Smooth::Product,
    Smooth::Quotient,
    Smooth::Negative,
    Smooth::WithConstants,
    Smooth::Assigned,
    Smooth::ExpM1,
    Smooth::Ln1p,
    Smooth::Acos,
    Smooth::Asinh,
    Smooth::AcoshAboveOne,
    Smooth::Atanh,
    Smooth::Pow,
    Smooth::Applied,
    Smooth::OnTheLeft,
];

impl Function for Smooth {
    fn at<T: Real>(&self, x: T, y: T) -> T
    where
        f64: LeftOf<T>,
    {
        match self {
            Self::Exp => (x * y).exp(),
            Self::LnOfPositive => y.ln() * x,
            Self::Sin => (x * y).sin(),
            Self::Cos => (x * y).cos(),
            Self::SinCos => {
                let (sin, cos) = (x * y).sin_cos();
                sin * 2.0 - cos
            }
            Self::Tan => (x * 0.4).tan() * y,
            Self::Atan => (x * y).atan(),
            Self::Atan2 => x.atan2(y) + y.atan2(x),
            Self::Asin => (x / 3.0).asin() * y,
            Self::Sinh => x.sinh() + y.sinh(),
            Self::Cosh => x.cosh() * y.cosh(),
            Self::Tanh => (x * y).tanh(),
            Self::SqrtOfPositive => y.sqrt() * x,
            Self::Powi => x.powi(3) * y.powi(1) + x.powi(0),
            Self::NegativePowi => y.powi(-2) * x,
            Self::Powf => y.powf(1.7) + y.powf(-0.3) * x + y.powf(0.0),
            Self::Abs => x.abs() * y,
            Self::Hypot => x.hypot(y),
            Self::Min => x.min(y) * x,
            Self::Max => x.max(y) * x,
            Self::Erf => (x - y).erf(),
            Self::Sum => x + y,
            Self::Difference => x - y,
            Self::Product => x * y,
            Self::Quotient => x / y,
            Self::Negative => -x,
            Self::WithConstants => {
                ((x + 2.0) * 3.0 - 1.0) / 4.0 + T::from(1.5) * y + T::from_f64(0.5)
            }
            Self::Assigned => {
                let mut z = x;
                z += y;
                z *= x;
                z -= y;
                z /= y;
                z += 2.0;
                z *= 0.3;
                z -= 1.0;
                z /= 0.7;
                [z, T::ONE, x, T::ZERO].into_iter().sum()
            }
            Self::ExpM1 => (x * y).exp_m1(),
            Self::Ln1p => (x * 0.4).ln_1p() * y.ln_1p(),
            Self::Acos => (x / 3.0).acos() * y,
            Self::Asinh => (x * y).asinh(),
            Self::AcoshAboveOne => (y + 1.0).acosh() * x,
            Self::Atanh => (x / 3.0).atanh() + y,
            Self::Pow => y.pow(x) + y.pow(T::ZERO) + x.pow(T::from(3.0)),
            Self::Applied => {
                // x³ y as a function of two variables.
                let (a, b) = (x.value(), y.value());
                x.apply(|a| (a.powi(3) * b, 3.0 * a * a * b)) + y.apply(|_| (0.0, a.powi(3)))
            }
            Self::OnTheLeft => {
                // Products of plain numbers stay plain.
                let half: f64 = 0.5;
                let [sum, product] = [1.0 - half * half, 2.0 * 3.0 * half];
                let z = 1.0 / (2.0 - 3.0 * Complex::new(x, 1.0 + y));
                sum * x + (1.0 - y) * product - 1.0 / y + half / x + (half + x) * z.re * z.im
            }
        }
    }
}

proptest! {
    #[test]
    fn every_function_agrees_with_central_differences(
        x in prop_oneof![-2.0..-0.1f64, 0.1..2.0f64],
        y in 0.2..2.0f64,
    ) {
        // Kinks of minimum and maximum.
        prop_assume!((x - y).abs() > 1e-3);
        let step = 1e-5;
        for function in ALL {
            let dual = function.at(Dual::<2>::variable(x, 0), Dual::variable(y, 1));
            prop_assert_eq!(dual.value, function.at(x, y), "{:?}", function);
            let along_x = (function.at(x + step, y) - function.at(x - step, y)) / (2.0 * step);
            let along_y = (function.at(x, y + step) - function.at(x, y - step)) / (2.0 * step);
            for (exact, differenced) in dual.gradient.into_iter().zip([along_x, along_y]) {
                let error = (exact - differenced).abs() / (1.0 + exact.abs());
                prop_assert!(error < 1e-7, "{function:?}: {exact} {differenced}");
            }
        }
    }

    #[test]
    fn identities_hold_with_their_derivatives(x in -1.5..1.5f64) {
        let x = Dual::<1>::variable(x, 0);
        let same = |a: Dual<1>, b: Dual<1>| {
            (a.value - b.value).abs() < 1e-13 * (1.0 + a.value.abs())
                && (a.gradient[0] - b.gradient[0]).abs() < 1e-12 * (1.0 + a.gradient[0].abs())
        };
        let one = Dual::constant(1.0);
        prop_assert!(same(x.sin() * x.sin() + x.cos() * x.cos(), one));
        prop_assert!(same(x.cosh() * x.cosh() - x.sinh() * x.sinh(), one));
        prop_assert!(same(x.exp().ln(), x));
        prop_assert!(same((x + 2.0).sqrt().powi(2), x + 2.0));
        prop_assert!(same(x.tan().atan(), x));
        prop_assert!(same(x.sinh() / x.cosh(), x.tanh()));
        prop_assert!(same(x.sin().asin(), x));
        prop_assert!(same(-(-x).erf(), x.erf()));
        prop_assert!(same(x.exp_m1().ln_1p(), x));
        prop_assert!(same(x.cos().abs().acos().cos(), x.cos().abs()));
        prop_assert!(same(x.sinh().asinh(), x));
        prop_assert!(same((x + 2.5).cosh().acosh(), x + 2.5));
        prop_assert!(same(x.tanh().atanh(), x));
        prop_assert!(same((x + 2.0).pow(x), (x * (x + 2.0).ln()).exp()));
        prop_assert!(same((x + 2.0).pow(Dual::constant(1.7)), (x + 2.0).powf(1.7)));
        prop_assert!(same(1.0 - x, -(x - 1.0)));
        prop_assert!(same(2.0 / (x + 2.0), ((x + 2.0) / 2.0).powi(-1)));
        prop_assert!(same(x.apply(|x| (x.sin(), x.cos())), x.sin()));
    }
}

#[test]
fn values_outside_the_domain_are_not_numbers() {
    let x = Dual::<1>::variable(-1.0, 0);
    assert!(x.ln().value().is_nan() && x.sqrt().value().is_nan());
    assert!((x * 2.0).asin().value().is_nan() && (x * 2.0).acos().value().is_nan());
    assert!((x * 2.0).ln_1p().value().is_nan() && (x * 2.0).atanh().value().is_nan());
    assert!((-x * 0.9).acosh().value().is_nan() && x.pow(-x / 2.0).value().is_nan());
    assert_eq!(
        Dual::<1>::variable(0.0, 0).sqrt().gradient[0],
        f64::INFINITY
    );
}

/// Where an exponent does not vary, the logarithm of the base does not matter.
#[test]
fn powers_of_zero_and_of_negative_numbers_have_their_derivatives() {
    let (x, a) = (Dual::<2>::variable(-2.0, 0), Dual::<2>::constant(3.0));
    let cube = x.pow(a);
    assert_eq!((cube.value, cube.gradient), (-8.0, [12.0, 0.0]));
    let varying = x.pow(Dual::variable(3.0, 1));
    assert!(varying.gradient[1].is_nan() && varying.gradient[0] == 12.0);
    let zero = Dual::<2>::variable(0.0, 0).pow(Dual::variable(2.0, 1));
    assert_eq!((zero.value, zero.gradient), (0.0, [0.0, 0.0]));
    let one = Dual::<2>::variable(0.0, 0).pow(Dual::variable(0.0, 1) * 0.0);
    assert_eq!((one.value, one.gradient[0]), (1.0, 0.0));
}

/// Near zero 1 + x keeps no digit of x.
#[test]
fn small_arguments_keep_their_digits() {
    let x = Dual::<1>::variable(1e-20, 0);
    for y in [x.ln_1p(), x.exp_m1(), x.asinh(), x.atanh()] {
        assert_eq!((y.value, y.gradient), (1e-20, [1.0]));
    }
    assert!((Dual::<1>::variable(1e200, 0).acosh().gradient[0] * 1e200 - 1.0).abs() < 1e-15);
}

#[test]
fn comparisons_look_at_the_value_only() {
    let (a, b) = (Dual::<2>::variable(1.0, 0), Dual::<2>::variable(1.0, 1));
    assert!(a == b && a <= b);
    assert_eq!(a.min(b).gradient, [1.0, 0.0]);
    assert_eq!(a.max(b).gradient, [1.0, 0.0]);
    assert_eq!((-a).abs().gradient, [1.0, 0.0]);
}

#[test]
fn radii_do_not_overflow() {
    let (x, y) = (Dual::<2>::variable(3e200, 0), Dual::variable(4e200, 1));
    let (radius, angle) = (x.hypot(y), y.atan2(x));
    assert!((radius.value / 5e200 - 1.0).abs() < 1e-15);
    assert!((radius.gradient[0] - 0.6).abs() < 1e-15);
    assert!((angle.gradient[1] * 5e200 - 0.6).abs() < 1e-15);
}

/// A branch may compare with a plain number, and is differentiated along the side that is taken.
#[test]
fn numbers_compare_with_plain_ones() {
    fn kinked<T: Real>(x: T) -> T {
        if x < 1.0 { x } else { x * 3.0 - 2.0 }
    }
    let [below, above] = [0.5, 2.0].map(|x| kinked(Dual::<1>::variable(x, 0)));
    assert_eq!((below.value, below.gradient), (0.5, [1.0]));
    assert_eq!((above.value, above.gradient), (4.0, [3.0]));
    assert!(above == 4.0 && above > below && above != 4.5);
}
