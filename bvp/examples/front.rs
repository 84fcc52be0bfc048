//! An infinite interval cut off, with projected conditions: the front of a nerve impulse, a solution
//! u(x − ct) of Nagumo's equation between its two rest states,
//!
//! ```text
//! u″ + c u′ + u (1 − u) (u − a) = 0,   u → 1 as x → −∞,   u → 0 as x → ∞
//! ```
//!
//! with the speed c = (1 − 2a)/√2 and u = 1/(1 + exp(x/√2)) in closed form. On −L ≤ x ≤ L the
//! decaying solutions of the equations linearised about the rest states are kept and the growing ones
//! forbidden:
//!
//! ```text
//! u′ = μ (u − 1) at −L,   μ > 0,   μ² + c μ = 1 − a
//! u′ = ν u        at  L,   ν < 0,   ν² + c ν = a
//! ```
//!
//! Their error is of second order in what is left of the front at ±L, that of the plain conditions
//! u(−L) = 1, u(L) = 0 of first order. c is a parameter, and u(0) = ½ holds the front in the middle,
//! where two segments meet. L is doubled until c stays.
//!
//! M. Lentini & H. B. Keller, "Boundary value problems on semi-infinite intervals and their numerical
//! solution", SIAM J. Numer. Anal. 17 (1980) 577-604.
//!
//! Run with `cargo run -p bvp --example front`.

use bvp::{Ends, Error, Function, LeftOf, Options, Problem, Real, Segment, Solution, solve};
use std::f64::consts::SQRT_2;

const TOLERANCE: f64 = 1e-10;

/// States u and u′ on −L ≤ x ≤ 0 and on 0 ≤ x ≤ L; the parameter is c.
struct Front {
    segments: [Segment; 2],
    a: f64,
    projected: bool,
}

impl Front {
    fn new(a: f64, length: f64, projected: bool) -> Self {
        let segments = [Segment::on(2, -length, 0.0), Segment::on(2, 0.0, length)];
        Self {
            segments,
            a,
            projected,
        }
    }
}

impl Problem for Front {
    fn segments(&self) -> Vec<Segment> {
        self.segments.to_vec()
    }

    fn parameters(&self) -> usize {
        1
    }

    fn rhs<T: Real>(&self, _segment: usize, _x: T, y: &[T], p: &[T], dy: &mut [T]) {
        let u = y[0];
        dy[0] = y[1];
        dy[1] = -p[0] * y[1] - u * (-u + 1.0) * (u - self.a);
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, p: &[T], r: &mut [T])
    where
        f64: LeftOf<T>,
    {
        let (left, right) = (at.start(0), at.end(1));
        let root = |product: f64| (p[0] * p[0] + 4.0 * product).sqrt();
        let growth = 0.5 * (root(1.0 - self.a) - p[0]);
        let decay = -0.5 * (root(self.a) + p[0]);
        r[0] = left[0] - 1.0;
        r[1] = right[0];
        if self.projected {
            r[0] = left[1] - growth * r[0];
            r[1] = right[1] - decay * r[1];
        }
        r[2] = at.end(0)[0] - 0.5;
        r[3] = at.end(0)[0] - at.start(1)[0];
        r[4] = at.end(0)[1] - at.start(1)[1];
    }
}

fn exact(x: f64) -> f64 {
    1.0 / (1.0 + (x / SQRT_2).exp())
}

fn front(a: f64, length: f64, projected: bool) -> Result<Solution, Error> {
    let guess = Function {
        state: |_segment: usize, x: f64| {
            let height = 0.5 * (1.0 - (0.5 * x).tanh());
            [height, -height * (1.0 - height)]
        },
        parameters: vec![0.0],
    };
    solve(
        &Front::new(a, length, projected),
        &guess,
        &Options::to(TOLERANCE),
    )
}

/// The errors of c and, the largest, of u.
fn errors(solution: &Solution, a: f64) -> [f64; 2] {
    let c = (1.0 - 2.0 * a) / SQRT_2;
    let length = solution.segments()[1].to;
    let mut largest = 0.0f64;
    let mut y = [0.0; 2];
    for i in -100..=100 {
        let x = 0.01 * length * f64::from(i);
        solution.state(usize::from(i > 0), x, &mut y);
        largest = largest.max((y[0] - exact(x)).abs());
    }
    [(solution.parameters()[0] - c).abs(), largest]
}

fn main() -> Result<(), Error> {
    let a = 0.25;
    println!("c = {:.10}", (1.0 - 2.0 * a) / SQRT_2);
    println!("         plain conditions      projected conditions");
    println!("   L   error of c        u     error of c        u   intervals");
    let (mut length, mut previous) = (4.0, f64::INFINITY);
    loop {
        let plain = errors(&front(a, length, false)?, a);
        let solution = front(a, length, true)?;
        let projected = errors(&solution, a);
        println!(
            "{length:4} {:12.1e} {:8.1e} {:14.1e} {:8.1e} {:11}",
            plain[0],
            plain[1],
            projected[0],
            projected[1],
            solution.mesh(0).len() + solution.mesh(1).len() - 2
        );
        let c = solution.parameters()[0];
        if (c - previous).abs() <= TOLERANCE {
            assert!(projected.into_iter().all(|error| error <= TOLERANCE));
            return Ok(());
        }
        (length, previous) = (2.0 * length, c);
    }
}
