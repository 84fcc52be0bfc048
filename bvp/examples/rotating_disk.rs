//! An infinite interval mapped to a finite one: the flow over a rotating disk after von Kármán,
//!
//! ```text
//! F″ = F² − G² + H F′,   G″ = 2 F G + H G′,   H′ = −2 F,   0 ≤ x < ∞
//! F = H = 0, G = 1 at x = 0,   F → 0, G → 0 as x → ∞
//! ```
//!
//! F, G, H are the radial, circular and axial velocity at the distance x from the disk. With
//! x = L s/(1 − s) the interval is 0 ≤ s < 1 and every right-hand side is multiplied by
//! dx/ds = L/(1 − s)². The points of Gauss lie inside the intervals, so s = 1 is never asked for.
//! States must be bounded, and the length L should be that of the decay. Near s = 1 the factor
//! magnifies the rounding of the states, and with it the defect: the mesh is chosen for the error,
//! not for the defect.
//!
//! M. H. Rogers & G. N. Lance, "The rotationally symmetric flow of a viscous fluid in the presence of
//! an infinite rotating disk", J. Fluid Mech. 7 (1960) 617-631: F′(0) = 0.510233,
//! G′(0) = −0.615922, H(∞) = −0.884474.
//!
//! Run with `cargo run -p bvp --example rotating_disk`.

use bvp::{Ends, Error, Function, LeftOf, Options, Problem, Real, Segment, solve};

/// The length L.
const LENGTH: f64 = 2.0;

/// States F, F′, G, G′, H over s, the derivatives with respect to x.
struct Disk;

impl Problem for Disk {
    fn segments(&self) -> Vec<Segment> {
        vec![Segment::new(5)]
    }

    fn rhs<T: Real>(&self, _segment: usize, s: T, y: &[T], _p: &[T], dy: &mut [T])
    where
        f64: LeftOf<T>,
    {
        let [radial, d_radial, circular, d_circular, axial] = [0, 1, 2, 3, 4].map(|i| y[i]);
        dy[0] = d_radial;
        dy[1] = radial * radial - circular * circular + axial * d_radial;
        dy[2] = d_circular;
        dy[3] = 2.0 * radial * circular + axial * d_circular;
        dy[4] = -2.0 * radial;
        let stretch = (-s + 1.0).powi(-2) * LENGTH;
        dy.iter_mut().for_each(|dy| *dy *= stretch);
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, _p: &[T], r: &mut [T]) {
        let (disk, infinity) = (at.start(0), at.end(0));
        r[0] = disk[0];
        r[1] = disk[2] - 1.0;
        r[2] = disk[4];
        r[3] = infinity[0];
        r[4] = infinity[2];
    }
}

fn main() -> Result<(), Error> {
    let guess = Function {
        state: |_segment: usize, s: f64| {
            let decay = (-LENGTH * s / (1.0 - s)).exp();
            [0.0, 0.0, decay, -decay, decay - 1.0]
        },
        parameters: vec![],
    };
    let published = [0.510_233, -0.615_922, -0.884_474];
    println!("tolerance   intervals           F′(0)           G′(0)            H(∞)");
    println!(
        "published             {:15.6} {:15.6} {:15.6}",
        published[0], published[1], published[2]
    );
    for tolerance in [1e-6, 1e-8, 1e-10] {
        let solution = solve(&Disk, &guess, &Options::to(tolerance))?;
        let (disk, infinity) = (solution.start(0), solution.end(0));
        let found = [disk[1], disk[3], infinity[4]];
        println!(
            "{tolerance:9.0e} {:11} {:15.11} {:15.11} {:15.11}",
            solution.mesh(0).len() - 1,
            found[0],
            found[1],
            found[2]
        );
        for (found, published) in found.into_iter().zip(published) {
            assert!((found - published).abs() < 6e-7 + tolerance);
        }
    }
    Ok(())
}
