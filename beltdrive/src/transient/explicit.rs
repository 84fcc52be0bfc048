//! The explicit step: the classical Runge–Kutta method of order four.
//!
//! Bristles are cut back to their largest displacement before every evaluation of the rates. The convective terms
//! leave its stability alone, unlike that of one-evaluation schemes, which need axial damping.

use super::dynamics::Dynamics;
use super::schedule::Schedule;
use super::simulation::StepBound;
use super::system::Wheel;
use pulp::{Arch, NullaryFnOnce};

/// Radius of the half disc in the left half plane in which the method is stable: 2.78 on the real axis, 2.82 on
/// the imaginary one, rounded down.
const STABLE: f64 = 2.7;

/// Share of the largest stable step that is taken: the stretch and the speed of the belt grow until the next look
/// at it, by far less than a tenth of the speed of waves.
const SAFETY: f64 = 0.9;

/// The way to the next evaluation, compiled as [`Rates`](super::rates::Rates) are.
struct Advance<'r> {
    /// What rates are multiplied by in the sum and on the way, s.
    by: [f64; 2],
    from: &'r [f64],
    rates: &'r [f64],
    sum: &'r mut [f64],
    to: &'r mut [f64],
}

impl NullaryFnOnce for Advance<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let count = self.to.len();
        let (from, rates) = (&self.from[..count], &self.rates[..count]);
        let (sum, to) = (&mut self.sum[..count], &mut self.to[..count]);
        let [weight, ahead] = self.by;
        for index in 0..count {
            sum[index] += weight * rates[index];
            to[index] = from[index] + ahead * rates[index];
        }
    }
}

/// A Runge–Kutta step and what it works with.
pub(crate) struct Explicit {
    rates: Vec<f64>,
    from: Vec<f64>,
    sum: Vec<f64>,
    arch: Arch,
}

impl Explicit {
    /// Room for states of a length.
    pub(crate) fn new(length: usize) -> Self {
        let room = || vec![0.0; length];
        Self {
            rates: room(),
            from: room(),
            sum: room(),
            arch: Arch::new(),
        }
    }

    /// Rates of a state, which is set right as by [`Dynamics::of`].
    pub(crate) fn rates(
        &mut self,
        rates: &mut impl Dynamics,
        time: f64,
        state: &mut [f64],
    ) -> &[f64] {
        rates.of(time, state, &mut self.rates);
        &self.rates
    }

    /// Takes a state at a time in s over a step in s, whose first rates are those of [`Self::rates`].
    pub(crate) fn step(
        &mut self,
        rates: &mut impl Dynamics,
        time: f64,
        step: f64,
        state: &mut [f64],
    ) {
        self.from.copy_from_slice(state);
        self.sum.copy_from_slice(state);
        // Weight of the rates in the sum, place of the next evaluation.
        for [weight, next] in [[1.0 / 6.0, 0.5], [1.0 / 3.0, 0.5], [1.0 / 3.0, 1.0]] {
            let (weight, ahead) = (weight * step, next * step);
            self.arch.dispatch(Advance {
                by: [weight, ahead],
                from: &self.from,
                rates: &self.rates,
                sum: &mut self.sum,
                to: state,
            });
            self.stop(rates, time, state);
            rates.of(time + ahead, state, &mut self.rates);
        }
        let weight = step / 6.0;
        for ((to, sum), known) in state.iter_mut().zip(&self.sum).zip(&self.rates) {
            *to = sum + weight * known;
        }
        self.stop(rates, time, state);
    }

    /// Stops the pulleys whose speed has changed its sign under a load that opposes motion.
    fn stop(&self, rates: &impl Dynamics, time: f64, state: &mut [f64]) {
        for (pulley, place) in rates.speeds().enumerate() {
            if self.from[place] * state[place] < 0.0
                && rates.axles().holds(rates.wheels(), pulley, time)
            {
                state[place] = 0.0;
            }
        }
    }
}

/// Rates of a sine that is given over time in steps: the method misses 3e-5 of a swing with 26 steps a period.
pub(super) const PER_SINE: f64 = 10.0;

/// The step that is taken from a state, s: stable for its largest rate, and short beside sines that are given over time.
pub(crate) fn stable_step(rates: &impl Dynamics, state: &[f64]) -> f64 {
    bounded_step(rates, state).0
}

/// The step of [`stable_step`], and what bounds it.
pub(crate) fn bounded_step(rates: &impl Dynamics, state: &[f64]) -> (f64, StepBound) {
    let of_axles = rates.wheels().iter().enumerate().map(|(pulley, wheel)| {
        let torque = (wheel.axle.rate(), StepBound::Torque { pulley });
        larger(torque, (of_sines(wheel), StepBound::Pulsation { pulley }))
    });
    let (rate, bound) = of_axles.fold(rates.fastest(state), larger);
    (SAFETY * STABLE / rate, bound)
}

/// The longest step that resolves the sines that the axles of pulleys are given over time, s.
pub(crate) fn step_of_sines(wheels: &[Wheel]) -> f64 {
    SAFETY * STABLE / wheels.iter().map(of_sines).fold(0.0, f64::max)
}

/// The largest rate of sines that the axle of a pulley is given over time, 1/s.
fn of_sines(wheel: &Wheel) -> f64 {
    let given = wheel.axle.schedule().into_iter().flatten();
    let sines = given.filter_map(Schedule::pulsation);
    sines.fold(0.0, |fastest: f64, sine| {
        fastest.max(PER_SINE * sine.angular_frequency)
    })
}

/// The larger one of two rates, with what it is of.
pub(super) fn larger(one: (f64, StepBound), other: (f64, StepBound)) -> (f64, StepBound) {
    match other.0 > one.0 {
        true => other,
        false => one,
    }
}

/// The rate of waves between two cells, 1/s, of a belt that is held on pulleys with squares of rates, and what it is of.
pub(super) fn with_waves(
    wave: f64,
    held: impl Iterator<Item = (f64, StepBound)>,
) -> (f64, StepBound) {
    let (held, of) = held.fold((0.0, StepBound::Cells), larger);
    let is_held = held > wave * wave;
    (
        (wave * wave + held).sqrt(),
        if is_held { of } else { StepBound::Cells },
    )
}
