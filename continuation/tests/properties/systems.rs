//! Small systems with exact Jacobians.

use continuation::DenseSystem;

/// x² + λ² = 1.
pub(crate) fn circle() -> DenseSystem {
    DenseSystem::new(1, &[0.0], 0, |x, p, g| {
        g[0] = x[0] * x[0] + p[0] * p[0] - 1.0;
    })
    .with_jacobian(|x, p, j| j.copy_from_slice(&[2.0 * x[0], 2.0 * p[0]]))
}

/// λ + μ x − x³ = 0: limit points x² = μ/3 for μ > 0, with a cusp at the origin.
pub(crate) fn cusp(mu: f64) -> DenseSystem {
    DenseSystem::new(1, &[0.0, mu], 0, |x, p, g| {
        g[0] = p[0] + p[1] * x[0] - x[0].powi(3);
    })
    .with_jacobian(|x, p, j| j.copy_from_slice(&[p[1] - 3.0 * x[0] * x[0], 1.0, x[0]]))
    .with_second(1)
}

/// a (1 − a) τ = (1 + κ τ)², a closed curve for κ < 1/16.
pub(crate) fn isola(kappa: f64) -> DenseSystem {
    DenseSystem::new(1, &[16.0, kappa], 0, |a, p, g| {
        g[0] = a[0] * (1.0 - a[0]) * p[0] - (1.0 + p[1] * p[0]).powi(2);
    })
    .with_jacobian(|a, p, j| {
        let b = 2.0 * (1.0 + p[1] * p[0]);
        j[0] = (1.0 - 2.0 * a[0]) * p[0];
        j[1] = a[0] * (1.0 - a[0]) - b * p[1];
        j[2] = -b * p[0];
    })
    .with_second(1)
}

/// The upper point of the isola at τ = 16.
pub(crate) fn on_isola(kappa: f64) -> [f64; 2] {
    [
        0.5 + (0.25 - (1.0f64 + 16.0 * kappa).powi(2) / 16.0).sqrt(),
        16.0,
    ]
}

/// The undivided steady states of the same tank, a = 1 among them.
pub(crate) fn washed_out(kappa: f64) -> DenseSystem {
    DenseSystem::new(1, &[16.0], 0, move |a, p, g| {
        let b = (1.0 - a[0]) / (1.0 + kappa * p[0]);
        g[0] = (1.0 - a[0]) / p[0] - a[0] * b * b;
    })
}

fn tank_residual(u: &[f64], p: &[f64], g: &mut [f64]) {
    let rate = p[0] * (1.0 - u[0]) * u[1].exp();
    g[0] = rate - u[0];
    g[1] = p[1] * rate - (1.0 + p[2]) * u[1];
}

/// The stirred tank of the example with p₃ = 3, λ = p₁, μ = p₂.
pub(crate) fn tank(p2: f64) -> DenseSystem {
    differenced_tank(p2).with_jacobian(|u, p, j| {
        let heat = u[1].exp();
        let (rise, slope) = (p[0] * heat, (1.0 - u[0]) * heat);
        let rate = p[0] * slope;
        let first = [-rise - 1.0, rate, slope, 0.0, 0.0];
        let second = [
            -p[1] * rise,
            p[1] * rate - 1.0 - p[2],
            p[1] * slope,
            rate,
            -u[1],
        ];
        j.copy_from_slice(&[first, second].concat());
    })
}

/// The same without its Jacobian.
pub(crate) fn differenced_tank(p2: f64) -> DenseSystem {
    DenseSystem::new(2, &[0.0, p2, 3.0], 0, tank_residual).with_second(1)
}

/// x (λ − x²) = imperfection.
pub(crate) fn pitchfork(imperfection: f64) -> DenseSystem {
    DenseSystem::new(1, &[0.0, imperfection], 0, |x, p, g| {
        g[0] = x[0] * (p[0] - x[0] * x[0]) - p[1];
    })
    .with_jacobian(|x, p, j| j.copy_from_slice(&[p[0] - 3.0 * x[0] * x[0], x[0], -1.0]))
    .with_second(1)
}

/// (x − 0.3 λ) (x + λ − 0.1) = 0: two lines.
pub(crate) fn transcritical() -> DenseSystem {
    DenseSystem::new(1, &[0.0], 0, |x, p, g| {
        g[0] = (x[0] - 0.3 * p[0]) * (x[0] + p[0] - 0.1);
    })
    .with_jacobian(|x, p, j| {
        let [a, b] = [x[0] - 0.3 * p[0], x[0] + p[0] - 0.1];
        j.copy_from_slice(&[a + b, a - 0.3 * b]);
    })
}
