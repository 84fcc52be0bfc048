//! Problems stated by closures: exact Jacobians of any width, and the solutions of the general form.

use bvp::{
    Constant, Ends, Function, LeftOf, Options, Problem, Real, Segment, TwoPoint, check_jacobians,
    solve,
};

#[test]
fn bratus_problem_in_ten_lines() {
    let bratu = TwoPoint::new(
        [2, 0],
        [0.0, 1.0],
        |_s, y, _p, dy| dy.copy_from_slice(&[y[1], -y[0].exp()]),
        |start, end, _p, r| r.copy_from_slice(&[start[0], end[0]]),
    );
    let guess = Constant::new([0.0, 0.0]);
    let solution = solve(&bratu, &guess, &Options::to(1e-10)).unwrap();
    // y'(0) = θ tanh(θ/4) with θ = √2 cosh(θ/4).
    let theta = (0..60).fold(1.5f64, |theta, _| 2f64.sqrt() * (0.25 * theta).cosh());
    assert!((solution.start(0)[1] - theta * (0.25 * theta).tanh()).abs() < 1e-9);
}

/// A ring of n oscillators with a common, unknown stiffness p₀ and load p₁.
struct Ring(usize);

const SPAN: [f64; 2] = [-0.5, 1.5];

impl Problem for Ring {
    fn segments(&self) -> Vec<Segment> {
        vec![Segment::on(self.0, SPAN[0], SPAN[1])]
    }

    fn parameters(&self) -> usize {
        2
    }

    fn rhs<T: Real>(&self, _: usize, s: T, y: &[T], p: &[T], dy: &mut [T])
    where
        f64: LeftOf<T>,
    {
        for (i, dy) in dy.iter_mut().enumerate() {
            let next = y[(i + 1) % y.len()];
            *dy = (1.0 - p[0] * next).sin() - 0.5 * y[i] * s + p[1];
        }
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, p: &[T], r: &mut [T])
    where
        f64: LeftOf<T>,
    {
        let (start, end) = (at.start(0), at.end(0));
        for i in 0..self.0 {
            r[i] = 2.0 * start[i] - 0.1 * end[i].sin() + 0.1 * i as f64;
        }
        r[self.0] = p[0] - 0.3 + 0.1 * start[0];
        r[self.0 + 1] = 0.2 - p[1] * (2.0 + end[0].cos());
    }
}

/// The same ring by closures.
fn ring(n: usize) -> impl bvp::Equations {
    TwoPoint::new(
        [n, 2],
        SPAN,
        |s, y, p, dy| {
            for (i, dy) in dy.iter_mut().enumerate() {
                let next = y[(i + 1) % y.len()];
                *dy = (1.0 - p[0] * next).sin() - 0.5 * y[i] * s + p[1];
            }
        },
        move |start, end, p, r| {
            for i in 0..n {
                r[i] = 2.0 * start[i] - 0.1 * end[i].sin() + 0.1 * i as f64;
            }
            r[n] = p[0] - 0.3 + 0.1 * start[0];
            r[n + 1] = 0.2 - p[1] * (2.0 + end[0].cos());
        },
    )
}

/// In one pass of dual numbers and in several.
#[test]
fn closures_have_the_jacobians_of_the_general_form() {
    for n in 1..13 {
        let guess = Function {
            state: |_: usize, s: f64| (0..n).map(|i| (s + i as f64).cos()).collect::<Vec<_>>(),
            parameters: vec![0.7, -0.4],
        };
        let check = check_jacobians(&ring(n), &Ring(n), &guess);
        assert!(check.difference < 1e-14, "{n}: {check:?}");
    }
}

#[test]
fn closures_have_the_solution_of_the_general_form() {
    for n in [1, 3, 9] {
        let guess = Constant {
            parameters: vec![0.3, 0.2],
            ..Constant::new(vec![0.0; n])
        };
        let options = Options::to(1e-9);
        let closed = solve(&ring(n), &guess, &options).unwrap();
        let general = solve(&Ring(n), &guess, &options).unwrap();
        assert_eq!(closed.mesh(0).len(), general.mesh(0).len());
        let values = |solution: &bvp::Solution| [solution.end(0), solution.parameters()].concat();
        for (a, b) in values(&closed).iter().zip(values(&general)) {
            assert!((a - b).abs() < 1e-12 * (1.0 + b.abs()), "{n}: {a} {b}");
        }
    }
}
