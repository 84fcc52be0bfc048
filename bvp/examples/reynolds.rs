//! A flow followed to a high Reynolds number: injection of a fluid through one side of a long
//! channel, Ascher, Mattheij & Russell (1995), example 1.4,
//!
//! ```text
//! f''' = R (f'² − f f'' − A),   f(0) = f'(0) = 0,   f(1) = 1,   f'(1) = 0
//! ```
//!
//! with a stream function f, the Reynolds number R and an unknown pressure gradient A. As R grows a
//! boundary layer of width 1/√R forms at the wall s = 0; outside it f = sin(πs/2), and A tends to
//! π²/4. The guess is zero for every R.
//!
//! Run with `cargo run -p bvp --example reynolds`.

use bvp::{Constant, Embedding, Ends, Error, Options, Problem, Real, Segment, solve_embedded};
use std::f64::consts::PI;

/// States f, f', f'' and parameters R, which is given, and A.
struct Injection;

impl Problem for Injection {
    fn segments(&self) -> Vec<Segment> {
        vec![Segment::new(3)]
    }

    fn parameters(&self) -> usize {
        2
    }

    fn condition_count(&self) -> usize {
        4
    }

    fn rhs<T: Real>(&self, _segment: usize, _s: T, y: &[T], p: &[T], dy: &mut [T]) {
        dy[0] = y[1];
        dy[1] = y[2];
        dy[2] = p[0] * (y[1] * y[1] - y[0] * y[2] - p[1]);
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, _p: &[T], r: &mut [T]) {
        r[0] = at.start(0)[0];
        r[1] = at.start(0)[1];
        r[2] = at.end(0)[0] - 1.0;
        r[3] = at.end(0)[1];
    }
}

fn main() -> Result<(), Error> {
    let guess = Constant {
        states: vec![vec![0.0; 3]],
        parameters: vec![1.0, 0.0],
    };
    let options = Options {
        tolerance: 1e-7,
        ..Options::default()
    };
    println!("        R               A   √R (A − π²/4)   intervals   meshes in all");
    for reynolds in [1.0, 1e2, 1e4, 1e6, 1e7] {
        let embedding = Embedding {
            parameter: 0,
            from: 1.0,
            to: reynolds,
        };
        let solution = solve_embedded(&Injection, &embedding, &guess, &options)?;
        let pressure = solution.parameters()[1];
        let beyond_limit = reynolds.sqrt() * (pressure - PI * PI / 4.0);
        println!(
            "{reynolds:9.0e} {pressure:15.10} {beyond_limit:15.5} {:11} {:15}",
            solution.mesh(0).len() - 1,
            solution.stats().meshes,
        );
        // As COLNEW has it for R = 100, and the limit for R → ∞ approached like 1/√R.
        assert!(reynolds != 1e2 || (pressure - 2.760_631_414_1).abs() < 1e-7);
        assert!(reynolds < 1e4 || (2.5..2.6).contains(&beyond_limit));
    }
    Ok(())
}
