//! An interior layer and the mesh that resolves it: the shock problem of Ascher, Mattheij &
//! Russell (1995), example 9.2,
//!
//! ```text
//! ε y'' + s y' = −ε π² cos πs − π s sin πs,   y(−1) = −2,   y(1) = 0
//! ```
//!
//! whose solution cos πs + erf(s/√(2ε)) / erf(1/√(2ε)) rises by two within a few √ε around zero.
//! The solver starts on ten equal intervals and a guess of zero.
//!
//! Run with `cargo run -p bvp --example shock`.

use bvp::{Constant, Ends, Error, Options, Problem, Real, Segment, solve};
use std::f64::consts::PI;

const EPSILON: f64 = 1e-4;

/// States y and y'.
struct Shock;

impl Problem for Shock {
    fn segments(&self) -> Vec<Segment> {
        vec![Segment::on(2, -1.0, 1.0)]
    }

    fn rhs<T: Real>(&self, _segment: usize, s: T, y: &[T], _p: &[T], dy: &mut [T]) {
        let (sin, cos) = (s * PI).sin_cos();
        dy[0] = y[1];
        dy[1] = -s * (y[1] + sin * PI) / EPSILON - cos * (PI * PI);
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, _p: &[T], r: &mut [T]) {
        r[0] = at.start(0)[0] + 2.0;
        r[1] = at.end(0)[0];
    }
}

fn exact(s: f64) -> f64 {
    let width = (2.0 * EPSILON).sqrt();
    (PI * s).cos() + Real::erf(s / width) / Real::erf(1.0 / width)
}

fn main() -> Result<(), Error> {
    let guess = Constant {
        states: vec![vec![0.0; 2]],
        parameters: vec![],
    };
    let solution = solve(&Shock, &guess, &Options::default())?;
    let mesh = solution.mesh(0);

    println!("        s    intervals   shortest   largest error");
    let mut y = [0.0; 2];
    let mut largest = 0.0f64;
    let places = [-1.0, -0.3, -0.1, -0.03, -0.01, 0.01, 0.03, 0.1, 0.3, 1.0];
    for ends in places.windows(2) {
        let inside = |pair: &&[f64]| pair[0] >= ends[0] && pair[0] < ends[1];
        let lengths = mesh.windows(2).filter(inside).map(|pair| pair[1] - pair[0]);
        let mut error = 0.0f64;
        for i in 0..=200 {
            let s = ends[0] + (ends[1] - ends[0]) * f64::from(i) / 200.0;
            solution.state(0, s, &mut y);
            error = error.max((y[0] - exact(s)).abs());
        }
        println!(
            "{:5.2} … {:5.2} {:8} {:10.1e} {error:15.1e}",
            ends[0],
            ends[1],
            lengths.clone().count(),
            lengths.fold(f64::INFINITY, f64::min),
        );
        largest = largest.max(error);
    }
    let stats = solution.stats();
    println!(
        "\n{} intervals after {} meshes, {} factorisations; estimated error {:.1e}",
        mesh.len() - 1,
        stats.meshes,
        stats.factorisations,
        solution.error_estimate().unwrap_or(f64::NAN)
    );
    assert!(largest < 1e-6);
    Ok(())
}
