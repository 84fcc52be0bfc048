//! The problems of `benches/auto-07p/`, stated at the top of its `.f90` files.

use bvp::{Ends, Problem, Real, Segment};

/// Bratu: u″ + λ eᵘ = 0, u(0) = u(1) = 0. States u, u′; parameter λ.
pub(crate) struct Bratu;

impl Problem for Bratu {
    fn segments(&self) -> Vec<Segment> {
        vec![Segment::new(2)]
    }

    fn parameters(&self) -> usize {
        1
    }

    fn condition_count(&self) -> usize {
        2
    }

    fn rhs<T: Real>(&self, _: usize, _: T, y: &[T], p: &[T], dy: &mut [T]) {
        dy[0] = y[1];
        dy[1] = -p[0] * y[0].exp();
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, _: &[T], r: &mut [T]) {
        r[0] = at.start(0)[0];
        r[1] = at.end(0)[0];
    }
}

/// Flow above a rotating disk, below a fluid that rotates with speed s. States F, F′, G, G′, H with
/// ′ = d/dz on z = L x, 0 < x < 1; parameter s.
pub(crate) struct Swirl;

/// Where the swirling flow is cut off.
const L: f64 = 10.0;

impl Problem for Swirl {
    fn segments(&self) -> Vec<Segment> {
        vec![Segment::new(5)]
    }

    fn parameters(&self) -> usize {
        1
    }

    fn condition_count(&self) -> usize {
        5
    }

    fn rhs<T: Real>(&self, _: usize, _: T, y: &[T], p: &[T], dy: &mut [T]) {
        let &[f, f_slope, g, g_slope, h] = y else {
            unreachable!("five states")
        };
        dy[0] = f_slope * L;
        dy[1] = (f * f - g * g + h * f_slope + p[0] * p[0]) * L;
        dy[2] = g_slope * L;
        dy[3] = (f * g * 2.0 + h * g_slope) * L;
        dy[4] = f * (-2.0 * L);
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, p: &[T], r: &mut [T]) {
        let (bottom, top) = (at.start(0), at.end(0));
        r[0] = bottom[0];
        r[1] = bottom[2] - 1.0;
        r[2] = bottom[4];
        r[3] = top[0];
        r[4] = top[2] - p[0];
    }
}

/// A ring of m weakly coupled Bratu problems. States u₁ … uₘ, u₁′ … uₘ′; parameter λ.
pub(crate) struct Copies([Segment; 1]);

/// How strongly neighbours are coupled.
const COUPLING: f64 = 0.01;

impl Copies {
    /// With so many equations of first order, 2 m.
    pub(crate) fn new(equations: usize) -> Self {
        Self([Segment::new(equations)])
    }
}

impl Problem for Copies {
    fn segments(&self) -> Vec<Segment> {
        self.0.to_vec()
    }

    fn parameters(&self) -> usize {
        1
    }

    fn condition_count(&self) -> usize {
        self.0[0].states
    }

    fn rhs<T: Real>(&self, _: usize, _: T, y: &[T], p: &[T], dy: &mut [T]) {
        let m = y.len() / 2;
        let (u, slope) = y.split_at(m);
        for i in 0..m {
            let source = u[i].exp() * (1.0 + 0.01 * (i + 1) as f64 / m as f64);
            let bend = u[(i + 1) % m] - u[i] * 2.0 + u[(i + m - 1) % m];
            dy[i] = slope[i];
            dy[m + i] = -p[0] * source - bend * COUPLING;
        }
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, _: &[T], r: &mut [T]) {
        let m = r.len() / 2;
        r[..m].copy_from_slice(&at.start(0)[..m]);
        r[m..].copy_from_slice(&at.end(0)[..m]);
    }
}
