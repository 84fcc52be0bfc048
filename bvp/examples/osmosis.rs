//! A kink at a known place: the salt that a cell pumps into one half of a tube draws water through its
//! wall, and the flow carries the salt out at the open end,
//!
//! ```text
//! v′ = (C − 1)/n,   C′ = (v C − min(x, 1))/η,   v(0) = 0,   C(λ) = 1,   0 ≤ x ≤ λ
//! ```
//!
//! with velocity v, concentration C, n = 0.05, λ = 2 and η = λ²/(n κ²). The right-hand side has a kink
//! at x = 1, where two segments meet and v and C go through. Without the junction the order of the
//! method is lost there, and the mesh shrinks around the kink.
//!
//! C. C. Lin & L. A. Segel, *Mathematics Applied to Deterministic Problems in the Natural Sciences*
//! (SIAM 1988), chapter 8. The concentration of what leaves the tube is Os = 1/v(λ); the values are those
//! of the example `threebvp` of MATLAB. For small n it is about 1/(1 − λ sinh(κ/λ) / (κ cosh κ)).
//!
//! Run with `cargo run -p bvp --example osmosis`.

use bvp::{Constant, Ends, Error, Options, Problem, Real, Segment, solve};

/// Permeability n of the wall.
const N: f64 = 0.05;
/// Length λ of the tube.
const LENGTH: f64 = 2.0;

/// States v and C, along the pumping half and along the rest.
struct Osmosis {
    kappa: f64,
}

impl Problem for Osmosis {
    fn segments(&self) -> Vec<Segment> {
        vec![Segment::on(2, 0.0, 1.0), Segment::on(2, 1.0, LENGTH)]
    }

    fn rhs<T: Real>(&self, segment: usize, x: T, y: &[T], _p: &[T], dy: &mut [T]) {
        let eta = (LENGTH / self.kappa).powi(2) / N;
        let pumped = if segment == 0 { x } else { T::from(1.0) };
        dy[0] = (y[1] - 1.0) / N;
        dy[1] = (y[0] * y[1] - pumped) / eta;
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, _p: &[T], r: &mut [T]) {
        r[0] = at.start(0)[0];
        r[1] = at.end(1)[1] - 1.0;
        r[2] = at.end(0)[0] - at.start(1)[0];
        r[3] = at.end(0)[1] - at.start(1)[1];
    }
}

fn main() -> Result<(), Error> {
    let guess = Constant {
        states: vec![vec![1.0, 1.0]; 2],
        parameters: vec![],
    };
    println!("κ            Os   published   for small n   intervals");
    for (kappa, published) in [(2.0, 1.462), (3.0, 1.172), (4.0, 1.078), (5.0, 1.039)] {
        let solution = solve(&Osmosis { kappa }, &guess, &Options::to(1e-9))?;
        let concentration = 1.0 / solution.end(1)[0];
        let k: f64 = LENGTH * (kappa / LENGTH).sinh() / (kappa * kappa.cosh());
        println!(
            "{kappa} {concentration:13.9} {published:11.3} {:13.3} {:11}",
            1.0 / (1.0 - k),
            solution.mesh(0).len() + solution.mesh(1).len() - 2
        );
        assert!((concentration - published).abs() < 6e-4);
    }
    Ok(())
}
