//! The S-curve of a stirred tank reactor, its limit points, and the curve of limit points in two
//! parameters with its cusp.
//!
//! ```text
//! −u₁ + p₁ (1 − u₁) exp u₂ = 0
//! −u₂ + p₁ p₂ (1 − u₁) exp u₂ − p₃ u₂ = 0
//! ```
//!
//! A. Uppal, W. H. Ray & A. B. Poore, "On the dynamic behavior of continuous stirred tank reactors",
//! Chem. Eng. Sci. 29 (1974) 967-985. The limit points satisfy k u₂² − u₂ + 1 = 0 with
//! k = (1 + p₃)/p₂: there are two for p₂ > 4 (1 + p₃), and they meet in a cusp.

use continuation::{Branch, DenseSystem, Direction, Error, Kind, LimitPointCurve, Options};

fn tank(u: &[f64], p: &[f64], g: &mut [f64]) {
    let rate = p[0] * (1.0 - u[0]) * u[1].exp();
    g[0] = rate - u[0];
    g[1] = p[1] * rate - (1.0 + p[2]) * u[1];
}

fn main() -> Result<(), Error> {
    let mut system = DenseSystem::new(2, &[0.0, 18.0, 3.0], 0, tank).with_second(1);
    let options = Options::within(0.0, 0.3);
    let mut branch = Branch::new(&mut system, &[0.0; 3], Direction::Increasing, &options)?;
    println!("steady states for p2 = 18");
    let mut folds = Vec::new();
    for point in branch.by_ref() {
        println!(
            "{:12.8} {:12.8} {:12.8}  {:?}",
            point.lambda(),
            point.z[0],
            point.z[1],
            point.kind
        );
        if point.kind == Kind::LimitPoint {
            folds.push(point.z);
        }
    }
    println!("{}", branch.into_stop().expect("the branch has ended"));
    // u₂ = 3/2 and 3, u₁ = 1/3 and 2/3
    assert_eq!(folds.len(), 2);
    assert!((folds[0][2] - 0.5 * (-1.5f64).exp()).abs() < 1e-12);
    assert!((folds[1][2] - 2.0 * (-3.0f64).exp()).abs() < 1e-12);

    let mut curve = LimitPointCurve::new(system, &folds[0])?;
    let start = curve.start(&folds[0]);
    let options = Options {
        targets: vec![17.0],
        ..Options::within(10.0, 20.0)
    };
    let branch = Branch::new(&mut curve, &start, Direction::Decreasing, &options)?;
    println!("limit points: p2, p1, u2");
    let mut cusps = Vec::new();
    for point in branch {
        println!(
            "{:12.8} {:12.8} {:12.8}  {:?}",
            point.z[3], point.z[2], point.z[1], point.kind
        );
        if point.kind == Kind::Cusp {
            cusps.push(point.z);
        }
    }
    let exact = [0.5, 2.0, (-2.0f64).exp(), 16.0];
    assert_eq!(cusps.len(), 1);
    assert!(
        cusps[0]
            .iter()
            .zip(exact)
            .all(|(z, exact)| (z - exact).abs() < 1e-8)
    );
    Ok(())
}
