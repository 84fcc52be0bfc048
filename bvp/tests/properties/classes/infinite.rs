//! Infinite intervals, cut off and mapped.

use bvp::{Ends, Function, Options, Problem, Real, Segment, solve};
use proptest::prelude::*;
use std::f64::consts::SQRT_2;

/// Falkner and Skan, f‴ + f f″ + β (1 − f′²) = 0, f(0) = f′(0) = 0, f′(∞) = 1, with the bounded
/// states f − x, f′ − 1 and f″; cut off at x = `length` or mapped by x = `length` s/(1 − s).
struct FalknerSkan {
    beta: f64,
    length: f64,
    mapped: bool,
}

impl FalknerSkan {
    /// x and dx/ds.
    fn place<T: Real>(&self, s: T) -> (T, T) {
        if self.mapped {
            let rest = -s + 1.0;
            (s / rest * self.length, rest.powi(-2) * self.length)
        } else {
            (s * self.length, T::from(self.length))
        }
    }
}

impl Problem for FalknerSkan {
    fn segments(&self) -> Vec<Segment> {
        vec![Segment::new(3)]
    }

    fn rhs<T: Real>(&self, _: usize, s: T, y: &[T], _p: &[T], dy: &mut [T]) {
        let (x, stretch) = self.place(s);
        dy[0] = y[1] * stretch;
        dy[1] = y[2] * stretch;
        dy[2] = (y[1] * (y[1] + 2.0) * self.beta - (y[0] + x) * y[2]) * stretch;
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, _p: &[T], r: &mut [T]) {
        r[0] = at.start(0)[0];
        r[1] = at.start(0)[1] + 1.0;
        r[2] = at.end(0)[1];
    }
}

#[test]
fn infinite_intervals_cut_off_and_mapped_agree_with_published_values() {
    // β = 0 is the boundary layer of Blasius, β = 1 the stagnation point of Hiemenz.
    for (beta, published) in [(0.0, 0.469_599_988_361), (1.0, 1.232_587_656_820)] {
        for (length, mapped) in [(8.0, false), (10.0, false), (1.0, true), (2.0, true)] {
            let problem = FalknerSkan {
                beta,
                length,
                mapped,
            };
            let guess = Function {
                state: |_: usize, s: f64| {
                    let decay = (-problem.place(s).0).exp();
                    [decay - 1.0, -decay, decay]
                },
                parameters: vec![],
            };
            let solution = solve(&problem, &guess, &Options::to(1e-9)).unwrap();
            let error = solution.start(0)[2] - published;
            assert!(error.abs() < 1e-10, "{beta} {length} {mapped}: {error:e}");
        }
    }
}

/// The front between the rest states 1 and 0 of Nagumo's equation u″ + c u′ + u (1 − u)(u − a) = 0 on
/// −L ≤ x ≤ L with u(0) = ½; c = (1 − 2a)/√2. At ±L the growing solutions of the linearised equations
/// are forbidden, or the rest states prescribed.
struct Front {
    segments: [Segment; 2],
    a: f64,
    projected: bool,
}

impl Problem for Front {
    fn segments(&self) -> Vec<Segment> {
        self.segments.to_vec()
    }

    fn parameters(&self) -> usize {
        1
    }

    fn rhs<T: Real>(&self, _: usize, _x: T, y: &[T], p: &[T], dy: &mut [T]) {
        let u = y[0];
        dy[0] = y[1];
        dy[1] = -p[0] * y[1] - u * (-u + 1.0) * (u - self.a);
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, p: &[T], r: &mut [T]) {
        let (left, right) = (at.start(0), at.end(1));
        let root = |product: f64| (p[0] * p[0] + 4.0 * product).sqrt();
        r[0] = left[0] - 1.0;
        r[1] = right[0];
        if self.projected {
            r[0] = left[1] - (root(1.0 - self.a) - p[0]) * 0.5 * r[0];
            r[1] = right[1] + (root(self.a) + p[0]) * 0.5 * r[1];
        }
        r[2] = at.end(0)[0] - 0.5;
        r[3] = at.end(0)[0] - at.start(1)[0];
        r[4] = at.end(0)[1] - at.start(1)[1];
    }
}

/// The error of c on −L ≤ x ≤ L.
fn front_error(a: f64, length: f64, projected: bool) -> f64 {
    let segments = [Segment::on(2, -length, 0.0), Segment::on(2, 0.0, length)];
    let guess = Function {
        state: |_: usize, x: f64| {
            let height = 0.5 * (1.0 - (0.5 * x).tanh());
            [height, -height * (1.0 - height)]
        },
        parameters: vec![0.0],
    };
    let problem = Front {
        segments,
        a,
        projected,
    };
    let solution = solve(&problem, &guess, &Options::to(1e-11)).unwrap();
    (solution.parameters()[0] - (1.0 - 2.0 * a) / SQRT_2).abs()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(16))]

    #[test]
    fn projected_conditions_are_of_second_order_in_what_is_cut_off(a in 0.1..0.25f64, length in 8.0..14.0f64) {
        let cut_off = (-length / SQRT_2).exp();
        let (plain, projected) = (front_error(a, length, false), front_error(a, length, true));
        prop_assert!(plain > 0.02 * cut_off, "{plain:e}");
        prop_assert!(projected < cut_off * cut_off, "{projected:e}");
    }
}
