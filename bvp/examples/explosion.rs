//! The limit of a family of solutions, with a singular coefficient: a reacting slab, cylinder or
//! sphere (k = 0, 1, 2) explodes where its heat can no longer be conducted to the wall,
//!
//! ```text
//! u″ + (k/x) u′ + δ exp(u) = 0,   u′(0) = 0,   u(1) = 0
//! ```
//!
//! u is the dimensionless temperature, δ the strength of the reaction after Frank-Kamenetskii. At the
//! largest δ with a steady state the equations linearised about it have a solution v of their own,
//!
//! ```text
//! v″ + (k/x) v′ + δ exp(u) v = 0,   v′(0) = 0,   v(1) = 0,   v(0) = 1
//! ```
//!
//! so that u, v and δ are found together: four states, one parameter, five conditions. The slab has
//! δ = 2 (c/cosh c)² with c tanh c = 1, the cylinder δ = 2 with u(0) = ln 4. For the sphere δ is the
//! largest ξ² exp(−ψ) along ψ″ + (2/ξ) ψ′ = exp(−ψ), ψ(0) = ψ′(0) = 0, which a Runge-Kutta method
//! finds to be 3.3219921183. D. A. Frank-Kamenetskii, *Diffusion and Heat Transfer in Chemical
//! Kinetics* (Plenum 1969), gives 0.88, 2 and 3.32.
//!
//! Run with `cargo run -p bvp --example explosion`.

use bvp::{Constant, Ends, Error, Options, Problem, Real, Segment, solve};

/// States u, u′, v, v′; the parameter is δ.
struct Explosion {
    k: f64,
}

impl Problem for Explosion {
    fn segments(&self) -> Vec<Segment> {
        vec![Segment::new(4)]
    }

    fn parameters(&self) -> usize {
        1
    }

    fn rhs<T: Real>(&self, _segment: usize, x: T, y: &[T], p: &[T], dy: &mut [T]) {
        let source = p[0] * y[0].exp();
        dy[0] = y[1];
        dy[1] = -y[1] / x * self.k - source;
        dy[2] = y[3];
        dy[3] = -y[3] / x * self.k - source * y[2];
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, _p: &[T], r: &mut [T]) {
        let (middle, wall) = (at.start(0), at.end(0));
        r[0] = middle[1];
        r[1] = middle[3];
        r[2] = middle[2] - 1.0;
        r[3] = wall[0];
        r[4] = wall[2];
    }
}

/// The root of c tanh c = 1.
fn slab() -> f64 {
    let mut c = 1.2f64;
    for _ in 0..20 {
        let tanh = c.tanh();
        c -= (c * tanh - 1.0) / (tanh + c * (1.0 - tanh * tanh));
    }
    c
}

fn main() -> Result<(), Error> {
    let c = slab();
    let shapes = [
        ("slab", 2.0 * (c / c.cosh()).powi(2)),
        ("cylinder", 2.0),
        ("sphere", 3.321_992_118_3),
    ];
    println!("               δ          known         u(0)   intervals");
    for (k, (shape, known)) in shapes.into_iter().enumerate() {
        let guess = Constant {
            states: vec![vec![1.0, 0.0, 1.0, 0.0]],
            parameters: vec![known],
        };
        let solution = solve(&Explosion { k: k as f64 }, &guess, &Options::to(1e-10))?;
        let (delta, hottest) = (solution.parameters()[0], solution.start(0)[0]);
        let intervals = solution.mesh(0).len() - 1;
        println!("{shape:8} {delta:14.10} {known:14.10} {hottest:12.8} {intervals:8}");
        assert!((delta - known).abs() < 1e-9);
    }
    Ok(())
}
