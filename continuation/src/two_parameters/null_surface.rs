//! The null space of \[J b\] along the solutions of a two-parameter system, and how it changes.

use crate::curve::corrector::Corrector;
use crate::curve::curve::Curve;
use crate::curve::metric::{FARTHEST, Metric};
use crate::difficulty::{Cause, Difficulty};
use crate::options::Options;
use crate::special_points::branch_point::equation_sizes;
use crate::special_points::null_space::NullSpace;
use crate::special_points::second_derivative::{Line, Precision, mixed};
use crate::system::difference::{Stencil, Step};
use crate::system::system::TwoParameter;

/// `G_μ` by differences is searched with other steps where formulas of sixth and of fourth order differ by
/// more than this share of their terms: the former is then accurate to about the power 3/2 of it.
const RESOLVED: f64 = 1e-6;

/// A place (z, μ) with the null space there.
#[derive(Clone)]
struct Place {
    z: Vec<f64>,
    mu: f64,
    border: Vec<f64>,
    space: NullSpace,
}

/// How the equations are unfolded.
#[derive(Clone)]
struct Unfolding {
    /// The bordering vector b; `G_μ` where there is none.
    border: Option<Vec<f64>>,
    /// The sizes of the equations.
    sizes: Vec<f64>,
}

impl Unfolding {
    /// With this bordering vector, at `z`.
    fn new<S: TwoParameter>(
        system: &mut S,
        metric: &Metric,
        border: Option<Vec<f64>>,
        z: &[f64],
    ) -> Self {
        let sizes = match &border {
            Some(border) => border.iter().map(|b| b.abs()).collect(),
            None => {
                let anywhere = [f64::NEG_INFINITY, f64::INFINITY];
                let mut curve = Curve::new(system, metric.clone(), anywhere);
                // Where no change of the unknowns shows them, all count alike.
                equation_sizes(&mut curve, z).unwrap_or_else(|_| vec![1.0; z.len() - 1])
            }
        };
        Self { border, sizes }
    }
}

/// A two-parameter system with the null space of \[J b\] and its rates of change.
#[derive(Clone)]
pub(crate) struct NullSurface<S> {
    /// Linearised at `here`.
    pub(crate) base: S,
    /// Linearised at `ahead`.
    probe: S,
    pub(crate) metric: Metric,
    corrector: Corrector,
    unfolding: Unfolding,
    here: Place,
    ahead: Option<Place>,
    /// The bounds of μ.
    pub(crate) bounds: [f64; 2],
    /// Second derivatives of G along the basis.
    own_second: [Vec<f64>; 2],
}

impl<S: TwoParameter + Clone> NullSurface<S> {
    /// The surface at `z` and the present μ of the system, with the bordering vector that `border` chooses.
    pub(crate) fn new(
        base: S,
        z: &[f64],
        border: impl FnOnce(&mut S, &Metric) -> Result<Option<Vec<f64>>, Difficulty>,
    ) -> Result<Self, Difficulty> {
        let anywhere = Options::within(f64::NEG_INFINITY, f64::INFINITY);
        let mut metric = Metric::new(&base, &anywhere, z);
        metric.reach(&vec![0.0; z.len()], FARTHEST);
        let mu = base.second();
        Self::with_metric(base, metric, anywhere.bounds, z, mu, border)
    }

    fn with_metric(
        base: S,
        metric: Metric,
        bounds: [f64; 2],
        z: &[f64],
        mu: f64,
        border: impl FnOnce(&mut S, &Metric) -> Result<Option<Vec<f64>>, Difficulty>,
    ) -> Result<Self, Difficulty> {
        let (mut probe, mut corrector) = (base.clone(), Corrector::anywhere());
        probe.set_second(mu);
        let border = border(&mut probe, &metric)?;
        let unfolding = Unfolding::new(&mut probe, &metric, border, z);
        let here = place(
            &mut probe,
            &mut corrector,
            &metric,
            &unfolding,
            z,
            mu,
            bounds,
        )?;
        Ok(Self {
            base,
            probe,
            metric,
            corrector,
            unfolding,
            ahead: Some(here.clone()),
            bounds,
            here,
            own_second: [Vec::new(), Vec::new()],
        })
    }

    /// The null space at the last linearisation.
    pub(crate) fn space(&self) -> &NullSpace {
        &self.here.space
    }

    /// The bordering vector b at the last linearisation.
    pub(crate) fn border(&self) -> &[f64] {
        let fixed = self.unfolding.border.as_deref();
        fixed.unwrap_or(&self.here.border)
    }

    /// Evaluates G away from the linearisation.
    pub(crate) fn residual(&mut self, z: &[f64], mu: f64, g: &mut [f64]) {
        self.ahead = None;
        self.probe.set_second(mu);
        self.probe.residual(z, g);
    }

    /// The null space away from the linearisation.
    pub(crate) fn null_space_at(&mut self, z: &[f64], mu: f64) -> Result<&NullSpace, Difficulty> {
        self.ahead = None;
        let (probe, corrector) = (&mut self.probe, &mut self.corrector);
        let found = place(
            probe,
            corrector,
            &self.metric,
            &self.unfolding,
            z,
            mu,
            self.bounds,
        )?;
        Ok(&self.ahead.insert(found).space)
    }

    /// Linearises at (z, μ), with a basis oriented as `reference`.
    pub(crate) fn linearise(
        &mut self,
        z: &[f64],
        mu: f64,
        reference: &NullSpace,
    ) -> Result<(), Difficulty> {
        self.here = match self.ahead.take() {
            Some(ahead) if ahead.z == z && ahead.mu == mu => {
                std::mem::swap(&mut self.base, &mut self.probe);
                ahead
            }
            _ => {
                let (base, corrector) = (&mut self.base, &mut self.corrector);
                place(
                    base,
                    corrector,
                    &self.metric,
                    &self.unfolding,
                    z,
                    mu,
                    self.bounds,
                )?
            }
        };
        self.here.space.orient(&self.metric, reference);
        self.own_second = [0, 1].map(|i| {
            let (direction, mu) = self.split(i);
            self.second_derivative(&direction, mu, Precision::Fine)
        });
        Ok(())
    }

    /// The z and μ components of a basis vector.
    fn split(&self, i: usize) -> (Vec<f64>, f64) {
        let mut direction = self.here.space.0[i].clone();
        let last = direction.pop().unwrap_or(0.0);
        let with_mu = self.unfolding.border.is_none();
        (direction, if with_mu { last } else { 0.0 })
    }

    /// Second derivative of G along a direction from the last linearisation.
    fn second_derivative(
        &mut self,
        direction: &[f64],
        rate: f64,
        precision: Precision,
    ) -> Vec<f64> {
        self.ahead = None;
        let (probe, Place { z, mu, .. }) = (&mut self.probe, &self.here);
        let line = Line {
            z: &[z, &[*mu][..]].concat(),
            direction: &[direction, &[rate]].concat(),
            bounds: self.bounds,
            sizes: &self.unfolding.sizes,
        };
        let found = line.second_derivative(probe, precision, |probe, z| {
            probe.set_second(z[z.len() - 1]);
        });
        found.values
    }

    /// The vector w orthogonal to the null space with \[J b\] w = r.
    pub(crate) fn shortest(&mut self, r: &[f64]) -> Vec<f64> {
        let Place { border, space, .. } = &self.here;
        space.shortest(&mut self.base, &self.metric, border, r)
    }

    fn turned(&mut self, second: &[f64]) -> Vec<f64> {
        self.shortest(second).iter().map(|w| -w).collect()
    }

    /// The rates of both basis vectors along a unit direction with this μ component.
    pub(crate) fn rates(
        &mut self,
        direction: &[f64],
        rate: f64,
        precision: Precision,
    ) -> [Vec<f64>; 2] {
        let own = self.second_derivative(direction, rate, precision);
        [0, 1].map(|i| {
            let (mut both, mu) = self.split(i);
            both.iter_mut().zip(direction).for_each(|(b, d)| *b += d);
            let both = self.second_derivative(&both, mu + rate, precision);
            self.turned(&mixed(&both, &own, &self.own_second[i]))
        })
    }

    /// The rates of both basis vectors along either.
    pub(crate) fn own_rates(&mut self) -> [[Vec<f64>; 2]; 2] {
        let [(first, mu), (second, nu)] = [0, 1].map(|i| self.split(i));
        let sum: Vec<f64> = first.iter().zip(&second).map(|(a, b)| a + b).collect();
        let both = self.second_derivative(&sum, mu + nu, Precision::Fine);
        let [a, b] = self.own_second.clone();
        let cross = self.turned(&mixed(&both, &a, &b));
        [[self.turned(&a), cross.clone()], [cross, self.turned(&b)]]
    }

    /// `G_μ` at the last linearisation.
    pub(crate) fn mu_derivative(&mut self) -> Vec<f64> {
        self.ahead = None;
        let Place { z, mu, .. } = &self.here;
        mu_derivative(&mut self.probe, z, *mu, self.bounds, &self.unfolding.sizes)
    }

    /// The same in a better discretisation of the base at its solution, the first of `vectors`, which
    /// have `more` entries behind those of z, μ the last; `border` then chooses a new one.
    pub(crate) fn adapted(
        &mut self,
        vectors: &mut [Vec<f64>],
        more: usize,
        border: impl FnOnce(&mut S, &Metric, &[f64]) -> Result<Option<Vec<f64>>, Difficulty>,
    ) -> Result<Option<Self>, Cause> {
        let mu = vectors[0][vectors[0].len() - 1];
        self.base.set_second(mu);
        let adapted = with_last(vectors, more, |short| self.base.adapted(short))?;
        let z = &vectors[0][..vectors[0].len() - more];
        let Some(base) = adapted else {
            self.metric.observe(z);
            return Ok(None);
        };
        let mut metric = self.metric.clone();
        metric.regroup(&base);
        metric.observe(z);
        let adapted = Self::with_metric(base, metric, self.bounds, z, mu, |base, metric| {
            border(base, metric, z)
        });
        Ok(Some(adapted?))
    }

    /// The refined base at the first of `vectors`, which have `more` entries behind those of z, μ the
    /// last.
    pub(crate) fn refined(&self, vectors: &mut [Vec<f64>], more: usize) -> Option<S> {
        let mut fine = with_last(vectors, more, |short| self.base.refined(short))?;
        fine.set_second(*vectors.first()?.last()?);
        Some(fine)
    }
}

/// The null space at (z, μ) of a system that is linearised there.
fn place<S: TwoParameter>(
    system: &mut S,
    corrector: &mut Corrector,
    metric: &Metric,
    unfolding: &Unfolding,
    z: &[f64],
    mu: f64,
    bounds: [f64; 2],
) -> Result<Place, Difficulty> {
    system.set_second(mu);
    let border = match &unfolding.border {
        Some(border) => border.clone(),
        None => mu_derivative(system, z, mu, bounds, &unfolding.sizes),
    };
    let space = NullSpace::at(system, corrector, metric, z, &border)?;
    Ok(Place {
        z: z.to_vec(),
        mu,
        border,
        space,
    })
}

/// `G_μ`, exact where the system knows it, else by differences within the bounds of μ; leaves the system at
/// μ.
fn mu_derivative(
    system: &mut impl TwoParameter,
    z: &[f64],
    mu: f64,
    [low, high]: [f64; 2],
    sizes: &[f64],
) -> Vec<f64> {
    let mut here = vec![f64::NAN; z.len() - 1];
    let mut direction = vec![0.0; z.len()];
    direction.push(1.0);
    system.set_second(mu);
    if system.derivative_along(z, &direction, &mut here) {
        return here;
    }
    system.residual(z, &mut here);
    let mut with_step = |h: f64| {
        let (stencil, h) = Stencil::first([mu - low, high - mu], h);
        stencil.apply(&here, h, |change, g| {
            system.set_second((mu + change).clamp(low, high));
            system.residual(z, g);
        })
    };
    let mut found = with_step(Step::default().length(mu));
    let left = found.unresolved(sizes, 0.0);
    if left > RESOLVED {
        found = Step::searched(found, left, sizes, with_step).1;
    }
    system.set_second(mu);
    found.values
}

/// Works on vectors without their last entries, which are kept.
fn with_last<T>(
    vectors: &mut [Vec<f64>],
    last: usize,
    work: impl FnOnce(&mut [Vec<f64>]) -> T,
) -> T {
    let split = |v: &mut Vec<f64>| v.split_off(v.len() - last);
    let tails: Vec<Vec<f64>> = vectors.iter_mut().map(split).collect();
    let result = work(vectors);
    for (vector, tail) in vectors.iter_mut().zip(tails) {
        vector.extend(tail);
    }
    result
}
