//! Dual numbers: derivatives against central differences, and identities.

use bvp::{Dual, Real};
use proptest::prelude::*;

/// A function of two arguments with any scalar.
trait Function {
    fn at<T: Real>(&self, x: T, y: T) -> T;
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
}

const ALL: [Smooth; 28] = [
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
];

impl Function for Smooth {
    fn at<T: Real>(&self, x: T, y: T) -> T {
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
                z
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
    }
}

#[test]
fn values_outside_the_domain_are_not_numbers() {
    let x = Dual::<1>::variable(-1.0, 0);
    assert!(x.ln().value().is_nan() && x.sqrt().value().is_nan());
    assert!((x * 2.0).asin().value().is_nan());
    assert_eq!(
        Dual::<1>::variable(0.0, 0).sqrt().gradient[0],
        f64::INFINITY
    );
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
