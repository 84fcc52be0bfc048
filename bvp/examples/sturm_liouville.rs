//! Eigenvalues in order: the problem of Coffey and Evans,
//!
//! ```text
//! −y″ + q y = λ y,   q = β² sin² 2x − 2β cos 2x,   y(±π/2) = 0
//! ```
//!
//! whose eigenvalues come in ever closer triples as β grows. The angle θ of Prüfer, tan θ = σ y/y′,
//! obeys an equation of its own,
//!
//! ```text
//! θ′ = σ cos² θ + (λ − q)/σ sin² θ,   θ(−π/2) = 0,   θ(0) = (k + 1) π/2
//! ```
//!
//! and grows through every multiple of π, the zeros of y. So the conditions name the eigenvalue, the
//! one with k zeros inside, and no other can be found; since q is even, y is even or odd with k, and
//! half of the interval suffices. The scale σ makes θ a straight line where λ − q is near σ². At β = 0
//! it is one, with λ = (k + 1)², and each solution is the guess of the next β.
//!
//! The values for β = 20 are those of Matslise: V. Ledoux, M. Van Daele & G. Vanden Berghe, ACM Trans.
//! Math. Softw. 31 (2005) 532-554.
//!
//! Run with `cargo run -p bvp --example sturm_liouville`.

use bvp::{Ends, Error, Function, LeftOf, Options, Problem, Real, Segment, Solution, solve};
use std::f64::consts::FRAC_PI_2;

/// The angle θ; the parameter is λ.
struct Pruefer {
    beta: f64,
    /// Zeros of y inside.
    k: u32,
}

impl Problem for Pruefer {
    fn segments(&self) -> Vec<Segment> {
        vec![Segment::on(1, -FRAC_PI_2, 0.0)]
    }

    fn parameters(&self) -> usize {
        1
    }

    fn rhs<T: Real>(&self, _segment: usize, x: T, y: &[T], p: &[T], dy: &mut [T])
    where
        f64: LeftOf<T>,
    {
        let scale = self.beta.max(f64::from(self.k + 1));
        let (sin2x, cos2x) = (2.0 * x).sin_cos();
        let q = (sin2x * self.beta).powi(2) - cos2x * (2.0 * self.beta);
        let (sin, cos) = y[0].sin_cos();
        dy[0] = cos * cos * scale + (p[0] - q) / scale * sin * sin;
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, _p: &[T], r: &mut [T]) {
        r[0] = at.start(0)[0];
        r[1] = at.end(0)[0] - FRAC_PI_2 * f64::from(self.k + 1);
    }
}

/// The solution with k zeros inside, at β = 20 in steps of one.
fn follow(k: u32) -> Result<Solution, Error> {
    let n = f64::from(k + 1);
    let line = Function {
        state: |_segment: usize, x: f64| [n * (x + FRAC_PI_2)],
        parameters: vec![n * n],
    };
    let options = Options::to(1e-8);
    let mut solution = solve(&Pruefer { beta: 0.0, k }, &line, &options)?;
    for beta in 1..=20 {
        let problem = Pruefer {
            beta: f64::from(beta),
            k,
        };
        solution = solve(&problem, &solution, &options)?;
    }
    Ok(solution)
}

fn main() -> Result<(), Error> {
    let published = [
        77.916_195_677_144,
        151.462_778_346_457,
        151.463_223_657_659,
        151.463_668_988_352,
        220.154_229_835_260,
    ];
    println!("k             λ       published   estimated error   intervals");
    for (k, published) in (1..).zip(published) {
        let solution = follow(k)?;
        let lambda = solution.parameters()[0];
        let error = solution.error_estimate().unwrap_or(f64::NAN);
        let intervals = solution.mesh(0).len() - 1;
        println!("{k} {lambda:13.6} {published:15.6} {error:17.1e} {intervals:11}");
        assert!((lambda - published).abs() < 1e-8 * (1.0 + published));
    }
    Ok(())
}
