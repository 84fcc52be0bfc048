//! The implicit step: TR-BDF2 with the bristles projected in each stage.
//!
//! The trapezoidal rule over the share 2 d of a step, then the second backward difference formula over the whole one
//! (Hosea and Shampine, Applied Numerical Mathematics 20, 1996); of order two, L-stable:
//!
//! ```text
//! y₁ = c₁ + d Δt k₁,   c₁ = y₀ + d Δt k₀                       d = 1 − 1/√2
//! y₂ = c₂ + d Δt k₂,   c₂ = y₀ + (y₁ − y₀)/√8/d               k₀ of a step is k₂ of the one before
//! ```
//!
//! In each stage k = y′(y) but for bristles at their largest displacement, b = clip(c + d Δt ḃ(y), `±μ n λ/k_f`), and
//! k = (y − c)/(d Δt). Newton's method takes the derivatives of the side on which a projection is; the work of the axles,
//! of damping and of friction is integrated with the weights of the stages.
//!
//! Its steps damp what vibrates faster than they are long, so that it leads to the steady state and follows no
//! vibrations. No load may hold a pulley at rest within a step.
//!
//! Damped bristles have the friction `k_f` b + `c_f` (v − R ω) up to its limit μ n λ, where it follows that.
//!
//! Creep-rate friction has no bristles: in their place stands the friction q = μ n λ clip((v − R ω)/`v_c`) itself, with its
//! derivatives.
//!
//! A general integrator such as those of the crate `diffsol` has no place for the projection: it needs a law of the
//! bristles that is smooth at their largest displacement, as ḃ = v − |v| sgn(b) |b/`b_max`|ⁿ, and then finds another
//! steady state: with n = 16 the tight tension of 728 N is off by 0.31 N, with n = 4 by 1.1 N, in as many steps.

use super::bordered::Bordered;
use super::dynamics::{Dynamics, ImplicitSteps, StepLimits};
use super::explicit::stable_step;
use super::jacobian::{Unknowns, derivatives, of_cap, of_slip};
use super::ledger::{BOUND, Ledger};
use super::rates::Rates;
use super::system::{Resistance, System};
use std::f64::consts::SQRT_2;
use std::ops::Range;

/// d.
const DIAGONAL: f64 = 1.0 - 0.5 * SQRT_2;

/// Weight of k₀ and of k₁ in y₂.
const OUTER: f64 = 0.25 * SQRT_2;

/// By what the weights of k₀, k₁ and k₂ differ from those of the embedded formula of order three.
const ERROR: [f64; 3] = [
    OUTER - (1.0 - OUTER) / 3.0,
    OUTER - (3.0 * OUTER + 1.0) / 3.0,
    DIAGONAL * (1.0 - 1.0 / 3.0),
];

/// Newton's method ends with a correction of this share of the largest error, or of the change in a stage where that is
/// smaller: what it leaves is not taken for a motion, and dies out with it on the way to a steady state.
const NEWTON: f64 = 1e-2;

/// Smaller corrections, in the scales of [`Implicit::new`], are of rounding: strains of 1e-3 have eleven digits beside
/// densities of 1.
const ROUNDING: f64 = 1e-11;

/// Worse contraction than this refreshes the derivatives: four digits then take eight iterations.
const CONTRACTION: f64 = 0.3;

/// Most iterations of Newton's method; stages that took more did not come to an end.
const MOST_ITERATIONS: usize = 15;

/// A step that takes other derivatives has to be longer by this, which pays for a factorisation of its own.
const WORTHWHILE: f64 = 1.2;

/// The field of the bristles, or of creep-rate friction.
const FRICTION: usize = 2;

/// A step that makes the next one longer by less has found the length that errors allow, but for a factor of a few.
const GROWTH: f64 = 2.0;

/// Largest energy that a step may win or lose beside what the ledger accounts for, in shares of the energy of the state
/// and of the work in the step: a run of a thousand such steps closes with half of the bound.
const UNACCOUNTED: [f64; 2] = [0.25e-3 * BOUND, 0.25 * BOUND];

/// What implicit steps took.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct ImplicitWork {
    /// Implicit time steps.
    pub steps: usize,
    /// Iterations of Newton's method, those of refused steps included.
    pub iterations: usize,
    /// Factorisations of its matrix.
    pub factorisations: usize,
}

/// Implicit steps and what they work with.
pub(crate) struct Implicit {
    unknowns: Unknowns,
    /// Where the unknowns stand in the matrix; none for given speeds.
    places: Vec<Option<usize>>,
    /// The unknowns in the order of the matrix: places in the state and scales.
    order: Vec<(usize, f64)>,
    /// Of which field each of them is: density, velocity, bristles, speed.
    fields: Vec<usize>,
    matrix: Bordered,
    entries: Vec<(usize, usize, f64)>,
    /// Δt d of the matrix, s; 0 if there is none.
    factorised: f64,
    /// The pulleys and the cells of the loop of the bristles.
    arcs: Vec<(usize, usize)>,
    /// Rates at the start, in the stage and at the end of the last step.
    slopes: [Vec<f64>; 3],
    /// The state at the start of the last step, and the one on the way.
    from: Vec<f64>,
    constant: Vec<f64>,
    rates: Vec<f64>,
    /// Whether bristles are at their bounds, and their places in the state.
    slips: Vec<bool>,
    bristles: Range<usize>,
    side: Vec<f64>,
    /// Length of the next step, s.
    next: f64,
    first: f64,
    /// Whether steps have become longer and longer since the last start.
    is_growing: bool,
    limits: StepLimits,
    work: ImplicitWork,
}

impl Implicit {
    /// Steps from a state of a system.
    ///
    /// Errors are measured by what belongs to the mean strain ε of that state: ε itself in the densities, the velocity
    /// ε √(EA/m) of a wave with that strain, that velocity over the radius in the speeds, and the largest displacement of
    /// the bristles.
    pub(crate) fn new(rates: &Rates<'_>, state: &[f64], limits: StepLimits) -> Self {
        let system = rates.system;
        let unknowns = Unknowns::new(system);
        let cells = system.mesh.cells();
        let density = &state[system.parts.density.clone()][1..];
        let strains = density.iter().map(|density| (1.0 / density - 1.0).abs());
        // A belt without tension has no scale of its own.
        let strain = (strains.sum::<f64>() / cells as f64).max(1e-5);
        let velocity = strain * (system.axial_stiffness / system.mass).sqrt();
        let displacement = |pulley: usize| {
            let wheel = &system.wheels[pulley];
            let pressed = wheel.friction_coefficient * system.axial_stiffness * strain;
            match pressed > 0.0 {
                true => pressed / (wheel.radius * system.friction_stiffness()),
                false => 1.0,
            }
        };
        let on_arcs = system.mesh.arcs.iter().enumerate();
        let arcs: Vec<_> = on_arcs
            .flat_map(|(pulley, arc)| arc.clone().map(move |cell| (pulley, cell)))
            .collect();
        let mut inner = vec![];
        let mut bristle = 0;
        // The loop is cut open at its last cell, which is one of a span.
        for cell in 0..cells - 1 {
            inner.push((unknowns.density(cell), 0, strain));
            inner.push((unknowns.velocity(cell), 1, velocity));
            if arcs.get(bristle).is_some_and(|on| on.1 == cell) {
                let scale = displacement(arcs[bristle].0);
                inner.push((unknowns.bristle(bristle), FRICTION, scale));
                bristle += 1;
            }
        }
        let mut border = vec![
            (unknowns.density(cells - 1), 0, strain),
            (unknowns.velocity(cells - 1), 1, velocity),
        ];
        for (pulley, wheel) in system.wheels.iter().enumerate() {
            if wheel.axle.slope(0.0).is_some() {
                border.push((unknowns.speed(pulley), 3, velocity / wheel.radius));
            }
        }
        let matrix = Bordered::new(inner.len(), border.len());
        inner.extend(border);
        let mut places = vec![None; unknowns.count()];
        for (place, &(unknown, ..)) in inner.iter().enumerate() {
            places[unknown] = Some(place);
        }
        let room = || vec![0.0; state.len()];
        let first = stable_step(rates, state).min(limits.longest);
        Self {
            unknowns,
            places,
            order: { inner.iter() }
                .map(|&(unknown, _, scale)| (place(unknowns, system, unknown), scale))
                .collect(),
            fields: inner.iter().map(|&(_, field, _)| field).collect(),
            matrix,
            entries: vec![],
            factorised: 0.0,
            slips: vec![false; arcs.len()],
            bristles: system.parts.bristle.clone(),
            arcs,
            slopes: [room(), room(), room()],
            from: state.to_vec(),
            constant: room(),
            rates: room(),
            side: vec![0.0; inner.len()],
            next: first,
            first,
            is_growing: true,
            limits,
            work: ImplicitWork::default(),
        }
    }

    /// Whether its longest steps pay.
    pub(crate) fn is_worthwhile(&self) -> bool {
        self.pays(self.limits.longest)
    }

    /// Whether a step of a length in s is as long as one has to be.
    fn pays(&self, step: f64) -> bool {
        step >= self.limits.shortest * self.first
    }

    /// Whether the speed of a pulley has changed its sign under a load that opposes motion.
    fn stops(&self, rates: &Rates<'_>, time: f64, state: &[f64]) -> bool {
        let mut speeds = rates.system.parts.speed.clone().enumerate();
        speeds.any(|(pulley, place)| {
            self.from[place] * state[place] <= 0.0
                && rates.axles().holds(rates.wheels(), pulley, time)
        })
    }

    /// Tries a step; its error, of which 1 is the largest, or none if Newton's method fails.
    fn attempt(
        &mut self,
        rates: &mut Rates<'_>,
        time: f64,
        step: f64,
        state: &mut [f64],
    ) -> Option<f64> {
        let parts = &rates.system.parts;
        let ahead = DIAGONAL * step;
        let works = parts.work.start;
        for (index, to) in state.iter_mut().enumerate() {
            self.constant[index] = self.from[index] + ahead * self.slopes[0][index];
            *to = self.constant[index] + ahead * self.slopes[0][index];
        }
        self.stage(rates, time + 2.0 * ahead, ahead, state)?;
        self.slope(1, ahead, state, works);
        for (index, to) in state[..works].iter_mut().enumerate() {
            let change = *to - self.from[index];
            self.constant[index] = self.from[index] + OUTER / DIAGONAL * change;
            *to = self.constant[index] + ahead * self.slopes[1][index];
        }
        self.stage(rates, time + step, ahead, state)?;
        self.slope(2, ahead, state, works);
        let [first, second, third] = &self.slopes;
        for index in works..state.len() {
            let known = OUTER * (first[index] + second[index]) + DIAGONAL * third[index];
            state[index] = self.from[index] + step * known;
        }
        for (place, &(index, _)) in self.order.iter().enumerate() {
            let slopes =
                ERROR[0] * first[index] + ERROR[1] * second[index] + ERROR[2] * third[index];
            self.side[place] = step * slopes;
        }
        // What is stiff is filtered from the estimate.
        self.matrix.solve(&mut self.side);
        if let Resistance::Creep { .. } = rates.system.resistance {
            // Friction follows the speeds without a rate of its own, and has no error but theirs.
            for (value, &field) in self.side.iter_mut().zip(&self.fields) {
                *value *= f64::from(u8::from(field != FRICTION));
            }
        }
        let error = self.norm() / self.limits.tolerance + self.unaccounted(rates.system, state);
        error.is_finite().then_some(error)
    }

    /// The energy that a step to a state won or lost beside what the ledger accounts for, over the largest allowed.
    fn unaccounted(&self, system: &System, state: &[f64]) -> f64 {
        let before = Ledger::of(system, &self.from, 0.0);
        let after = Ledger::of(system, state, 0.0);
        let [of_energy, of_work] = UNACCOUNTED;
        let allowed =
            of_energy * system.energy(state) + of_work * (after.turnover - before.turnover);
        (after.residual() - before.residual()).abs() / allowed
    }

    /// Takes the slopes of a stage.
    fn slope(&mut self, stage: usize, ahead: f64, state: &[f64], works: usize) {
        let slopes = &mut self.slopes[stage];
        slopes.copy_from_slice(&self.rates);
        for index in 0..works {
            slopes[index] = (state[index] - self.constant[index]) / ahead;
        }
    }

    /// The largest mean square of the fields of a list in the order of the matrix, in the scales of the errors.
    fn norm(&self) -> f64 {
        let mut sums = [[0.0; 2]; 4];
        for ((value, (_, scale)), field) in self.side.iter().zip(&self.order).zip(&self.fields) {
            let value = value / scale;
            sums[*field][0] += value * value;
            sums[*field][1] += 1.0;
        }
        let means = sums.map(|[sum, count]| sum / f64::max(count, 1.0));
        let largest = means
            .into_iter()
            .fold(0.0, |one: f64, other| match other.is_nan() {
                true => other,
                false if one.is_nan() => one,
                false => one.max(other),
            });
        largest.sqrt()
    }

    /// Solves for a stage at a time in s from a first guess.
    fn stage(
        &mut self,
        rates: &mut Rates<'_>,
        time: f64,
        ahead: f64,
        state: &mut [f64],
    ) -> Option<()> {
        let parts = &rates.system.parts;
        for (value, &(index, _)) in self.side.iter_mut().zip(&self.order) {
            *value = ahead * self.slopes[0][index];
        }
        let enough = (NEWTON * self.norm().min(self.limits.tolerance)).max(ROUNDING);
        let mut refresh = self.factorised != ahead;
        let mut last = f64::INFINITY;
        for _ in 0..MOST_ITERATIONS {
            parts.close(state);
            rates.of(time, state, &mut self.rates);
            self.residual(rates, ahead, state);
            if refresh {
                self.factorise(rates, ahead, state)?;
            }
            self.matrix.solve(&mut self.side);
            self.work.iterations += 1;
            for (value, &(index, _)) in self.side.iter().zip(&self.order) {
                state[index] -= value;
            }
            let size = self.norm();
            if !size.is_finite() {
                break;
            }
            if size <= enough {
                parts.close(state);
                rates.of(time, state, &mut self.rates);
                let bristles = &mut state[parts.bristle.clone()];
                let at_bounds = self.slips.iter().zip(bristles).zip(&rates.caps);
                for ((_, bristle), cap) in at_bounds.filter(|((slips, _), _)| **slips) {
                    *bristle = cap.copysign(*bristle);
                }
                return Some(());
            }
            refresh = size > CONTRACTION * last;
            last = size;
        }
        self.factorised = 0.0;
        None
    }

    /// What a stage lacks, in the order of the matrix.
    fn residual(&mut self, rates: &Rates<'_>, ahead: f64, state: &[f64]) {
        let system = rates.system;
        for (value, &(index, _)) in self.side.iter_mut().zip(&self.order) {
            *value = state[index] - self.constant[index] - ahead * self.rates[index];
        }
        if let Resistance::Creep { .. } = system.resistance {
            // The rates have set friction to what it is at the slip velocity.
            for bristle in 0..self.slips.len() {
                let index = system.parts.bristle.start + bristle;
                self.slips[bristle] = state[index].abs() >= rates.caps[bristle];
                if let Some(place) = self.places[self.unknowns.bristle(bristle)] {
                    self.side[place] = 0.0;
                }
            }
            return;
        }
        for (bristle, slips) in self.slips.iter_mut().enumerate() {
            let index = system.parts.bristle.start + bristle;
            let cap = rates.caps[bristle];
            let free = self.constant[index] + ahead * self.rates[index];
            *slips = free.abs() >= cap;
            if let (true, Some(place)) = (*slips, self.places[self.unknowns.bristle(bristle)]) {
                self.side[place] = state[index] - cap.copysign(free);
            }
        }
    }

    /// Factorises the matrix of Newton's method.
    fn factorise(&mut self, rates: &Rates<'_>, ahead: f64, state: &[f64]) -> Option<()> {
        let Self {
            unknowns,
            places,
            entries,
            slips,
            arcs,
            ..
        } = self;
        entries.clear();
        entries.extend((0..self.order.len()).map(|place| (place, place, 1.0)));
        // What creep-rate friction is full at, m/s; c_f/k_f, s.
        let (creep, damping) = match rates.system.resistance {
            Resistance::Bristles { stiffness, damping } => (None, damping / stiffness),
            Resistance::Creep { velocity } => (Some(velocity), 0.0),
        };
        derivatives(rates, state, &mut |row, column, value| {
            let is_carried = |bristle: usize| creep.is_none() && !slips[bristle];
            let at_bound = { unknowns.as_bristle(row) }.is_some_and(|bristle| !is_carried(bristle));
            let Some(row_place) = places[row].filter(|_| !at_bound) else {
                return;
            };
            let mut add = |unknown: usize, value: f64| {
                if let Some(column) = places[unknown] {
                    entries.push((row_place, column, -ahead * value));
                }
            };
            let damped = { unknowns.as_bristle(column) }
                .filter(|_| damping > 0.0 && unknowns.as_bristle(row).is_none());
            let Some(bristle) = damped else {
                return add(column, value);
            };
            let (pulley, cell) = arcs[bristle];
            let pulled = rates.pulled(state, [pulley, cell, bristle]);
            if pulled.abs() >= rates.caps[bristle] {
                for (unknown, slope) in of_cap(rates, pulley, cell) {
                    add(unknown, value * pulled.signum() * slope);
                }
            } else {
                add(column, value);
                for (unknown, slope) in of_slip(rates.system, pulley, cell) {
                    add(unknown, value * damping * slope);
                }
            }
        });
        for (bristle, &(pulley, cell)) in arcs.iter().enumerate() {
            let index = rates.system.parts.bristle.start + bristle;
            let row = places[unknowns.bristle(bristle)];
            let mut add = |unknown: usize, value: f64| {
                if let (Some(row), Some(column)) = (row, places[unknown]) {
                    entries.push((row, column, -value));
                }
            };
            // Friction over its largest, b/b_max, and how it rises with the slip velocity.
            let cap = rates.caps[bristle];
            let (share, rise) = match creep {
                _ if slips[bristle] => {
                    let free = self.constant[index] + ahead * self.rates[index];
                    let towards = if creep.is_some() { state[index] } else { free };
                    (towards.signum(), 0.0)
                }
                Some(velocity) => (state[index] / cap, cap / velocity),
                None => continue,
            };
            for (unknown, slope) in of_cap(rates, pulley, cell) {
                add(unknown, share * slope);
            }
            for (unknown, slope) in of_slip(rates.system, pulley, cell) {
                add(unknown, rise * slope);
            }
        }
        self.work.factorisations += 1;
        self.factorised = ahead;
        self.matrix.factorise(entries).then_some(())
    }
}

impl ImplicitSteps<Rates<'_>> for Implicit {
    fn begin(&mut self, rates: &Rates<'_>, state: &[f64], changes: &[f64]) {
        let last = &mut self.slopes[2];
        last.copy_from_slice(changes);
        // Bristles that slip stay at their largest displacement, which changes slowly, however fast the belt passes.
        for (index, cap) in self.bristles.clone().zip(&rates.caps) {
            if state[index].abs() >= *cap && state[index] * last[index] > 0.0 {
                last[index] = 0.0;
            }
        }
        self.next = self.first;
        self.is_growing = true;
    }

    fn changes(&self) -> &[f64] {
        &self.slopes[2]
    }

    fn work(&self) -> ImplicitWork {
        self.work
    }

    fn next(&self) -> f64 {
        self.next
    }

    /// The cubic with the states and the rates at both ends (Hermite). Bristles that slip at the end of the step are beyond
    /// their bounds, to which rates cut them back.
    fn within(&self, share: f64, step: f64, state: &[f64], to: &mut [f64]) {
        let left = 1.0 - share;
        let [from_weight, to_weight] = [
            left * left * (1.0 + 2.0 * share),
            share * share * (3.0 - 2.0 * share),
        ];
        let [first, last] = [left * left * share * step, -share * share * left * step];
        for (index, value) in to.iter_mut().enumerate() {
            *value = from_weight * self.from[index]
                + to_weight * state[index]
                + first * self.slopes[0][index]
                + last * self.slopes[2][index];
        }
        let slipping = self.slips.iter().zip(self.bristles.clone());
        for (_, index) in slipping.filter(|(slips, _)| **slips) {
            to[index] = f64::MAX.copysign(state[index]);
        }
    }

    fn step(
        &mut self,
        rates: &mut Rates<'_>,
        [time, stop]: [f64; 2],
        state: &mut [f64],
    ) -> Option<f64> {
        self.from.copy_from_slice(state);
        let [first, _, last] = &mut self.slopes;
        first.copy_from_slice(last);
        loop {
            let left = stop - time;
            // No step is left that is much shorter than the others.
            let step = match self.next {
                next if next >= 0.999 * left => left,
                next if 2.0 * next > left && next < self.limits.longest => 0.5 * left,
                next => next,
            };
            // Not even the first steps are as short, half of one that is shared between two aside.
            let is_tiny = step < 0.5 * self.first.min(left);
            if is_tiny || !self.is_growing && !self.pays(self.next) {
                return None;
            }
            let error = self.attempt(rates, time, step, state);
            // The error is in proportion to the third power.
            let factor = error.map_or(0.25, |error| (0.9 * error.powf(-1.0 / 3.0)).clamp(0.2, 4.0));
            if error.is_some_and(|error| error <= 1.0) {
                if self.stops(rates, time, state) {
                    state.copy_from_slice(&self.from);
                    return None;
                }
                self.work.steps += 1;
                self.is_growing &= factor > GROWTH;
                let longer = if !(1.0..=WORTHWHILE).contains(&factor) {
                    factor
                } else {
                    1.0
                };
                self.next =
                    (self.next.min(step.max(0.5 * self.next)) * longer).min(self.limits.longest);
                return Some(if step == left { stop } else { time + step });
            }
            self.is_growing = false;
            self.next = step * factor.min(0.5);
            state.copy_from_slice(&self.from);
        }
    }
}

/// The place of an unknown in the state.
fn place(unknowns: Unknowns, system: &System, unknown: usize) -> usize {
    let parts = &system.parts;
    let [of_velocity, of_bristle] = [unknowns.velocity(0), unknowns.bristle(0)];
    let of_speed = unknowns.speed(0);
    if unknown < of_velocity {
        parts.density.start + 1 + unknown
    } else if unknown < of_bristle {
        parts.velocity.start + unknown - of_velocity
    } else if unknown < of_speed {
        parts.bristle.start + unknown - of_bristle
    } else {
        parts.speed.start + unknown - of_speed
    }
}
