//! Smooth problems with a solution in closed form, for convergence orders.

use crate::eigenvalues::{Catenary, Wavenumber};
use crate::linear_layers::Reaction;
use crate::multiple_solutions::Bratu;
use crate::multipoint::{OscillationToTransport, SandwichBeam};
use crate::periodic::Duffing;
use crate::systems::RotatingModes;
use crate::turning_points::Spike;
use bvp::Equations;
use std::f64::consts::PI;

/// A problem whose solution is known at every point.
pub struct ExactProblem {
    /// What the problem is.
    pub name: &'static str,
    /// The statement.
    pub equations: Box<dyn Equations + Send + Sync>,
    /// The solution: writes the states at x of a segment into the slice.
    pub solution: fn(usize, f64, &mut [f64]),
    /// The values of the unknown parameters.
    pub parameters: Vec<f64>,
}

/// Smooth problems with exact solutions, one per kind of statement.
///
/// No component is a polynomial, and each solution varies enough for schemes of order up to 14 to
/// show their order on a few intervals before they reach rounding. Newton's method finds these
/// solutions from a guess near them; the nonlinear problems have others too.
pub fn exact_problems() -> Vec<ExactProblem> {
    vec![
        problem(
            "linear reaction",
            Reaction { eps: 1.0 / 400.0 },
            reaction,
            [],
        ),
        problem("variable coefficients", Spike { eps: 0.1 }, spike, []),
        problem("Bratu, upper solution", Bratu { lambda: 1.0 }, bratu, []),
        problem("unknown wavenumber", Wavenumber, wave, [6.0 * PI]),
        problem("free length", catenary_statement(), catenary, [LENGTH]),
        problem("periodic", Duffing, duffing, []),
        problem("three points", beam_statement(), beam, []),
        problem("unequal segments", OscillationToTransport, transport, []),
        problem("rotating modes", RotatingModes, rotating_modes, []),
    ]
}

fn problem<const K: usize>(
    name: &'static str,
    equations: impl Equations + Send + 'static,
    solution: fn(usize, f64, &mut [f64]),
    parameters: [f64; K],
) -> ExactProblem {
    ExactProblem {
        name,
        equations: Box::new(equations),
        solution,
        parameters: parameters.to_vec(),
    }
}

/// sinh(κ (1 − x)) / sinh κ with κ = 1/√ε = 20.
fn reaction(_: usize, x: f64, y: &mut [f64]) {
    let kappa = 20.0;
    y[0] = (kappa * (1.0 - x)).sinh() / f64::sinh(kappa);
    y[1] = -kappa * (kappa * (1.0 - x)).cosh() / f64::sinh(kappa);
}

/// 1/(ε + x²) with ε = 0.1.
fn spike(_: usize, x: f64, y: &mut [f64]) {
    y[0] = 1.0 / (0.1 + x * x);
    y[1] = -2.0 * x * y[0] * y[0];
}

/// Larger root of θ = √2 cosh(θ/4).
const THETA: f64 = 10.938_702_772_122_107;

/// −2 ln(cosh((x − 1/2) θ/2) / cosh(θ/4)).
fn bratu(_: usize, x: f64, y: &mut [f64]) {
    let z = (x - 0.5) * THETA / 2.0;
    y[0] = -2.0 * (z.cosh() / (THETA / 4.0).cosh()).ln();
    y[1] = -THETA * z.tanh();
}

/// sin κx with κ = 6π, the sixth wavenumber; the first is too smooth for high orders.
fn wave(_: usize, x: f64, y: &mut [f64]) {
    let (sin, cos) = (6.0 * PI * x).sin_cos();
    y[0] = sin;
    y[1] = 6.0 * PI * cos;
}

/// Parameter a of the catenary.
const A: f64 = 0.5;
/// Arc length from the lowest point of the catenary to its start, negative to the left.
const START: f64 = -0.8;
/// Length of the catenary.
const LENGTH: f64 = 2.0;

fn catenary_statement() -> Catenary {
    let mut end = [0.0; 3];
    catenary(0, 1.0, &mut end);
    Catenary {
        a: A,
        to: [end[0], end[1]],
    }
}

/// x = a arsinh(σ/a), y = √(a² + σ²), tan θ = σ/a at the arc length σ from the lowest point.
fn catenary(_: usize, s: f64, y: &mut [f64]) {
    let sigma = START + LENGTH * s;
    y[0] = A * ((sigma / A).asinh() - (START / A).asinh());
    y[1] = A.hypot(sigma) - A.hypot(START);
    y[2] = (sigma / A).atan();
}

fn duffing(_: usize, x: f64, y: &mut [f64]) {
    let [value, slope, _] = Duffing::orbit(x);
    y[0] = value;
    y[1] = slope;
}

/// Constant k of the sandwich beam; its load is k², so that the slopes are near 1.
const STIFFNESS: f64 = 20.0;

fn beam_statement() -> SandwichBeam {
    SandwichBeam {
        stiffness: STIFFNESS,
        load: STIFFNESS * STIFFNESS,
    }
}

fn beam(_: usize, x: f64, y: &mut [f64]) {
    let k = STIFFNESS;
    let z = k * (x - 0.5);
    let scale = (k / 2.0).cosh();
    y[0] = x - 0.5 - z.sinh() / (k * scale);
    y[1] = 1.0 - z.cosh() / scale;
    y[2] = -k * z.sinh() / scale;
}

fn transport(segment: usize, x: f64, y: &mut [f64]) {
    let transported = OscillationToTransport::transported;
    if segment == 0 {
        let amplitude = transported(1.0) / f64::cos(9.0);
        y[0] = amplitude * (9.0 * x).cos();
        y[1] = -9.0 * amplitude * (9.0 * x).sin();
    } else {
        y[0] = transported(x);
    }
}

fn rotating_modes(_: usize, x: f64, y: &mut [f64]) {
    y.copy_from_slice(&RotatingModes::states(x));
}
