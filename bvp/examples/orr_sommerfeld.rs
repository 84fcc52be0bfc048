//! Complex states and a complex eigenvalue: the Orr-Sommerfeld equation of a wave exp(iα(x − c t)) on
//! plane Poiseuille flow U = 1 − z²,
//!
//! ```text
//! (D² − α²)² φ = i α R ((U − c) (D² − α²) φ − U″ φ),   φ = Dφ = 0 at z = ±1,   D = d/dz
//! ```
//!
//! φ(z) is the amplitude of the stream function, R the Reynolds number; the wave grows where the
//! imaginary part of its speed c is positive. The unstable wave is even, so half of the channel
//! suffices: Dφ = D³φ = 0 at z = 0, where φ = 1 for c to have its condition. Four complex states are
//! eight real ones ([`Complex`]), c is two parameters, and five complex conditions are ten real ones.
//!
//! S. A. Orszag, "Accurate solution of the Orr-Sommerfeld stability equation", J. Fluid Mech. 50
//! (1971) 689-703: c = 0.23752649 + 0.00373967 i for α = 1 and R = 10 000; below R = 5772.22, where
//! α = 1.02056, no wave grows.
//!
//! Run with `cargo run -p bvp --example orr_sommerfeld`.

use bvp::{Complex, Ends, Error, Function, Options, Problem, Real, Segment, solve};

/// States φ, Dφ, ψ = (D² − α²) φ, Dψ, each complex.
struct Wave {
    alpha: f64,
    reynolds: f64,
}

impl Problem for Wave {
    fn segments(&self) -> Vec<Segment> {
        vec![Segment::new(8)]
    }

    fn parameters(&self) -> usize {
        2
    }

    fn rhs<T: Real>(&self, _segment: usize, z: T, y: &[T], p: &[T], dy: &mut [T]) {
        let [phi, d_phi, psi, d_psi] = [0, 1, 2, 3].map(|j| Complex::read(y, j));
        let (c, velocity) = (Complex::read(p, 0), Complex::from(-z * z + 1.0));
        let a2 = self.alpha * self.alpha;
        let inertia = ((velocity - c) * psi + phi * 2.0).times_i() * (self.alpha * self.reynolds);
        d_phi.write(dy, 0);
        (psi + phi * a2).write(dy, 1);
        d_psi.write(dy, 2);
        (psi * a2 + inertia).write(dy, 3);
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, _p: &[T], r: &mut [T]) {
        let (middle, wall) = (at.start(0), at.end(0));
        (Complex::read(middle, 0) - 1.0).write(r, 0);
        Complex::read(middle, 1).write(r, 1);
        Complex::read(middle, 3).write(r, 2);
        Complex::read(wall, 0).write(r, 3);
        Complex::read(wall, 1).write(r, 4);
    }
}

fn main() -> Result<(), Error> {
    // The profile (1 − z²)², which meets the conditions.
    let profile = |_segment: usize, z: f64| {
        let (phi, d_phi) = ((1.0 - z * z).powi(2), -4.0 * z * (1.0 - z * z));
        let [psi, d_psi] = [12.0 * z * z - 4.0 - phi, 24.0 * z - d_phi];
        [phi, 0.0, d_phi, 0.0, psi, 0.0, d_psi, 0.0]
    };
    let published = [
        (1.0, 10_000.0, [0.237_526_49, 0.003_739_67], 1e-8),
        (1.020_56, 5772.22, [0.264_002, 0.0], 1e-6),
    ];
    println!("      α         R     c computed                   published   intervals");
    for (alpha, reynolds, c, precision) in published {
        let guess = Function {
            state: profile,
            parameters: c.to_vec(),
        };
        let solution = solve(&Wave { alpha, reynolds }, &guess, &Options::to(1e-9))?;
        let found = solution.parameters();
        println!(
            "{alpha:7.5} {reynolds:9.2} {:12.9} {:+12.9} i {:11.8} {:+11.8} i {:9}",
            found[0],
            found[1],
            c[0],
            c[1],
            solution.mesh(0).len() - 1
        );
        assert!(
            found
                .iter()
                .zip(c)
                .all(|(found, c)| (found - c).abs() < precision)
        );
    }
    Ok(())
}
