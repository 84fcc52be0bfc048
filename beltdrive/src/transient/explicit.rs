//! The explicit step: the classical Runge–Kutta method of order four.
//!
//! Bristles are cut back to their largest displacement before every evaluation of the rates. The convective terms
//! leave its stability alone, unlike that of one-evaluation schemes, which need axial damping.

use super::rates::Rates;
use super::schedule::Schedule;
use super::simulation::StepBound;
use super::system::System;
use std::ops::Range;

/// Radius of the half disc in the left half plane in which the method is stable: 2.78 on the real axis, 2.82 on
/// the imaginary one, rounded down.
pub(super) const STABLE: f64 = 2.7;

/// Share of the largest stable step that is taken: the stretch and the speed of the belt grow until the next look
/// at it, by far less than a tenth of the speed of waves.
pub(super) const SAFETY: f64 = 0.9;

/// Rates over which steps are taken.
pub(crate) trait Dynamics {
    /// Where the speeds of the pulleys stand in a state.
    fn speeds(&self) -> Range<usize>;

    /// The rates of a state at a time in s, which is set right.
    fn of(&mut self, time: f64, state: &mut [f64], rates: &mut [f64]);

    /// Whether the load of a pulley stops it where its speed changes sign at a time in s.
    fn holds(&self, pulley: usize, time: f64) -> bool;
}

impl Dynamics for Rates<'_> {
    fn speeds(&self) -> Range<usize> {
        self.system.parts.speed.clone()
    }

    fn of(&mut self, time: f64, state: &mut [f64], rates: &mut [f64]) {
        self.of(time, state, rates);
    }

    fn holds(&self, pulley: usize, time: f64) -> bool {
        self.holds(pulley, time)
    }
}

/// A Runge–Kutta step and what it works with.
pub(crate) struct Explicit {
    rates: Vec<f64>,
    from: Vec<f64>,
    sum: Vec<f64>,
}

impl Explicit {
    /// Room for the states of a system.
    pub(crate) fn new(system: &System) -> Self {
        Self::with_room(system.parts.len())
    }

    /// Room for states of a length.
    pub(crate) fn with_room(length: usize) -> Self {
        let room = || vec![0.0; length];
        Self {
            rates: room(),
            from: room(),
            sum: room(),
        }
    }

    /// Rates of a state, which is set right as by [`Rates::of`].
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
            let count = state.len();
            let (from, known) = (&self.from[..count], &self.rates[..count]);
            let sums = &mut self.sum[..count];
            for index in 0..count {
                sums[index] += weight * known[index];
                state[index] = from[index] + ahead * known[index];
            }
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
            if self.from[place] * state[place] < 0.0 && rates.holds(pulley, time) {
                state[place] = 0.0;
            }
        }
    }
}

/// Rates of a sine that is given over time in steps: the method misses 3e-5 of a swing with 26 steps a period.
const PER_SINE: f64 = 10.0;

/// The step that is taken from a state, s: stable for the fastest axial wave between two cells with the belt held
/// by its bristles, and for axial damping, light pulleys and torques that depend on speed; short beside sines that are
/// given over time.
pub(crate) fn stable_step(system: &System, state: &[f64]) -> f64 {
    bounded_step(system, state).0
}

/// The step of [`stable_step`], and what bounds it.
pub(crate) fn bounded_step(system: &System, state: &[f64]) -> (f64, StepBound) {
    let (rate, bound) = fastest(system, state);
    (SAFETY * STABLE / rate, bound)
}

/// The largest rate of a state, 1/s, and of what it is.
fn fastest(system: &System, state: &[f64]) -> (f64, StepBound) {
    let System {
        mass,
        axial_stiffness,
        axial_damping,
        friction_stiffness,
        ref across,
        ref wheels,
        ref mesh,
        ref parts,
    } = *system;
    let densities = state[parts.density.clone()].iter().copied();
    // Waves across are slower than axial ones by the root of the strain.
    let stretch = densities.fold(f64::INFINITY, f64::min).recip();
    let speeds = state[parts.velocity.clone()].iter().copied();
    let speed = speeds.map(f64::abs).fold(0.0, f64::max);
    let cell = mesh.shortest();
    let wave = 2.0 * (stretch * (axial_stiffness / mass).sqrt() + speed) / cell;
    let arcs = mesh.arcs.iter().zip(wheels);
    // A belt held on a pulley that turns: its mass beside that of the pulley at the rim.
    let held = arcs.map(|(arc, wheel)| {
        let length = arc.len() as f64 * mesh.lengths[arc.start];
        let at_rim = wheel.radius * wheel.radius / wheel.axle.inertia;
        match wheel.axle.inertia > 0.0 {
            true => friction_stiffness * (mass.recip() + length * at_rim),
            false => friction_stiffness / mass,
        }
    });
    let larger = |one: (f64, StepBound), other: (f64, StepBound)| match other.0 > one.0 {
        true => other,
        false => one,
    };
    let held = held.enumerate();
    let (held, pulley) = held.fold((0.0, 0), |one, (pulley, held)| match held > one.0 {
        true => (held, pulley),
        false => one,
    });
    let elastic = match held > wave * wave {
        true => StepBound::Bristles { pulley },
        false => StepBound::Cells,
    };
    let axial = 4.0 * axial_damping / (mass * cell * cell);
    let damping = across.as_ref().map_or(0.0, |across| across.damping);
    let of_axles = wheels.iter().enumerate().map(|(pulley, wheel)| {
        let given = wheel.axle.schedule().into_iter().flatten();
        let sines = given.filter_map(Schedule::pulsation);
        let sine = sines.fold(0.0, |fastest: f64, sine| {
            fastest.max(PER_SINE * sine.angular_frequency)
        });
        let torque = (wheel.axle.rate(), StepBound::Torque { pulley });
        larger(torque, (sine, StepBound::Pulsation { pulley }))
    });
    let ends = across.iter().flat_map(|across| &across.spans);
    let ends = ends.flat_map(|span| span.ends).map(|end| {
        let round = end.order * state[parts.speed.start + end.pulley].abs();
        let rate = if end.amplitude == 0.0 {
            0.0
        } else {
            PER_SINE * round
        };
        (rate, StepBound::RunOut { pulley: end.pulley })
    });
    let first = ((wave * wave + held).sqrt(), elastic);
    let damped = [
        (axial, StepBound::AxialDamping),
        (damping * stretch / mass, StepBound::DampingAcross),
    ];
    damped
        .into_iter()
        .chain(of_axles)
        .chain(ends)
        .fold(first, larger)
}
