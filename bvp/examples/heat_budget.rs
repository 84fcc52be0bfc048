//! Integrals: a reacting slab that releases a given heat λ, however hot it is,
//!
//! ```text
//! u″ + λ exp(u) / ∫₀¹ exp(u) dx = 0,   u(0) = u(1) = 0
//! ```
//!
//! The integral is an unknown parameter p, and the running integral E is one more state,
//!
//! ```text
//! u″ = −λ exp(u)/p,   E′ = exp(u),   E(0) = 0,   E(1) = p
//! ```
//!
//! An integral that is given is the same with its value instead of p. Where Bratu's slab ignites at
//! λ/p = 3.5138, the given heat allows one steady state for every λ:
//!
//! ```text
//! u = 2 ln( cosh(θ/4) / cosh((x − ½) θ/2) ),   λ = 2 θ tanh(θ/4),   p = (4/θ) sinh(θ/4) cosh(θ/4)
//! ```
//!
//! Run with `cargo run -p bvp --example heat_budget`.

use bvp::{Ends, Error, Function, Options, Problem, Real, Segment, solve};

/// States u, u′, E; the parameter is p.
struct Slab {
    heat: f64,
}

impl Problem for Slab {
    fn segments(&self) -> Vec<Segment> {
        vec![Segment::new(3)]
    }

    fn parameters(&self) -> usize {
        1
    }

    fn rhs<T: Real>(&self, _segment: usize, _x: T, y: &[T], p: &[T], dy: &mut [T]) {
        let rate = y[0].exp();
        dy[0] = y[1];
        dy[1] = -rate / p[0] * self.heat;
        dy[2] = rate;
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, p: &[T], r: &mut [T]) {
        let (left, right) = (at.start(0), at.end(0));
        r[0] = left[0];
        r[1] = left[2];
        r[2] = right[0];
        r[3] = right[2] - p[0];
    }
}

fn main() -> Result<(), Error> {
    println!("        λ       λ/p   u(½) computed     closed form   intervals");
    for theta in [1.0, 4.0, 4.798_714_561, 8.0, 12.0f64] {
        let (sinh, cosh) = ((0.25 * theta).sinh(), (0.25 * theta).cosh());
        let heat = 2.0 * theta * sinh / cosh;
        // The temperature of a uniform source.
        let guess = Function {
            state: |_segment: usize, x: f64| [0.5 * heat * x * (1.0 - x), heat * (0.5 - x), x],
            parameters: vec![1.0],
        };
        let solution = solve(&Slab { heat }, &guess, &Options::to(1e-9))?;
        let integral = solution.parameters()[0];
        let mut y = [0.0; 3];
        solution.state(0, 0.5, &mut y);
        let exact = 2.0 * cosh.ln();
        println!(
            "{heat:9.5} {:9.5} {:15.10} {exact:15.10} {:11}",
            heat / integral,
            y[0],
            solution.mesh(0).len() - 1
        );
        assert!((y[0] - exact).abs() < 1e-9 * (1.0 + exact));
        let exact = 4.0 / theta * sinh * cosh;
        assert!((integral - exact).abs() < 1e-9 * (1.0 + exact));
    }
    Ok(())
}
