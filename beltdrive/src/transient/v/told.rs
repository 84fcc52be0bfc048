//! What is told of a state of a V-belt drive: the largest rate, tensions, slip, loads on the pulleys, energy, and whether
//! it stands still or is one that no belt has.

use super::super::axles::Axles;
use super::super::dynamics::{Dynamics, StepLimits};
use super::super::explicit::{larger, with_waves};
use super::super::ledger::Ledger;
use super::super::mesh::Mesh;
use super::super::simulation::StepBound;
use super::super::slip::{slipping, slips};
use super::super::system::Wheel;
use super::rates::Rates;
use super::system::System;
use crate::vbelt::SLIPPING_BRISTLES;
use std::convert::Infallible;
use std::ops::Range;

/// A pulley slips grossly where the belt slips everywhere by this share of its speed: creep is a fifth of that at the
/// usual loads of V-belts, and takes place on a part of the contact.
const GROSS: f64 = 0.01;

impl Dynamics for Rates<'_> {
    type Implicit = Infallible;

    fn mesh(&self) -> &Mesh {
        &self.system.mesh
    }

    fn wheels(&self) -> &[Wheel] {
        &self.system.wheels
    }

    fn axles(&self) -> &Axles {
        &self.axles
    }

    fn speeds(&self) -> Range<usize> {
        self.system.parts.speed.clone()
    }

    fn begin(&mut self, time: f64) {
        self.axles.begin(&self.system.wheels, time);
    }

    fn of(&mut self, time: f64, state: &mut [f64], rates: &mut [f64]) {
        self.evaluate(time, state, rates);
    }

    /// That of the fastest axial wave between two cells with the belt held by its bristles, of axial damping, of bristles
    /// that saturate.
    fn fastest(&self, state: &[f64]) -> (f64, StepBound) {
        let System {
            mass,
            axial_stiffness,
            axial_damping,
            bristle_stiffness,
            ref wheels,
            ref mesh,
            ref parts,
            ..
        } = *self.system;
        let largest = |values: &mut dyn Iterator<Item = f64>| values.fold(0.0, f64::max);
        let stretch = largest(&mut self.stretch.iter().copied());
        let speeds = &state[parts.velocity.clone()];
        let speed = largest(&mut speeds.iter().map(|v| v.abs()));
        let cell = { mesh.lengths.iter().zip(&self.lengths) }
            .map(|(length, g)| length * g)
            .fold(f64::INFINITY, f64::min);
        let wave = 2.0 * (stretch * (axial_stiffness / mass).sqrt() + speed) / cell;
        let arcs = mesh.arcs.iter().zip(wheels).enumerate();
        let held = arcs.clone().map(|(pulley, (arc, wheel))| {
            let seated = self.seated[mesh.bristles[pulley].clone()].iter();
            let pressure = largest(&mut seated.map(|seated| seated.pressure));
            let length = arc.len() as f64 * mesh.lengths[arc.start];
            let per_mass = stretch / mass + length * wheel.mobility();
            let rate = 2.0 * pressure * bristle_stiffness * per_mass;
            (rate, StepBound::Bristles { pulley })
        });
        let elastic = with_waves(wave, held);
        let saturating = arcs.map(|(pulley, (arc, wheel))| {
            let seated = self.seated[mesh.bristles[pulley].clone()].iter();
            let slips = seated.enumerate().map(|(index, seated)| {
                let outward = self.middle[arc.start + index] * seated.direction[0];
                seated.slip.hypot(outward / self.system.groove[1])
            });
            let slip = largest(&mut { slips });
            let rate = bristle_stiffness * slip / wheel.friction_coefficient;
            (rate + 2.0 * speed / cell, StepBound::Bristles { pulley })
        });
        let damping = 4.0 * axial_damping * stretch * stretch / (mass * cell * cell);
        saturating.fold(larger(elastic, (damping, StepBound::AxialDamping)), larger)
    }

    fn implicit(&self, _: &[f64], _: StepLimits) -> Option<Infallible> {
        None
    }

    fn wave_speed(&self) -> f64 {
        (self.system.axial_stiffness / self.system.mass).sqrt()
    }

    fn tension(&self, stretch: f64) -> f64 {
        self.system.tension(stretch)
    }

    fn stretches(&self) -> &[f64] {
        &self.stretch
    }

    fn middles(&self) -> &[f64] {
        &self.middle
    }

    fn slips(&self, state: &[f64], pulley: usize, index: usize) -> bool {
        let place = self.system.mesh.bristles[pulley].start + index;
        slips(bent(self.system, state, place), limit(self.system, pulley))
    }

    fn slips_grossly(&self, state: &[f64], pulley: usize) -> bool {
        let arc = self.system.mesh.arcs[pulley].clone();
        let (cells, own) = (arc.len(), &self.system.mesh.bristles[pulley]);
        let forward = self.middle[arc.start] + self.middle[arc.end - 1] >= 0.0;
        let towards_exit =
            |index: usize| 2 * index >= cells && forward || 2 * index < cells && !forward;
        (0..cells).all(|index| {
            let along = self.seated[own.start + index].slip;
            let slip = along.hypot(sliding(self, pulley, index));
            // From rest any slip is a large share of the speed until the bristles are bent.
            let is_bent = !towards_exit(index) || self.slips(state, pulley, index);
            is_bent && slip > GROSS * self.middle[arc.start + index].abs()
        })
    }

    fn slipping(&self, state: &[f64], pulley: usize) -> f64 {
        let own = self.system.mesh.bristles[pulley].clone();
        let bent: Vec<_> = own.map(|place| bent(self.system, state, place)).collect();
        slipping(&bent, &vec![limit(self.system, pulley); bent.len()])
    }

    fn force(&self, state: &[f64], pulley: usize, index: usize) -> [f64; 2] {
        let System {
            groove: [sine, cosine],
            ref mesh,
            ref parts,
            ..
        } = *self.system;
        let place = mesh.bristles[pulley].start + index;
        let seated = &self.seated[place];
        let [along, up] = [&parts.along, &parts.up].map(|part| state[part.start + place]);
        let faces =
            2.0 * seated.pressure * seated.shape.length * mesh.lengths[mesh.arcs[pulley].start];
        [faces * along, faces * (sine - up * cosine)]
    }

    fn friction(&self, state: &[f64]) -> Vec<f64> {
        let System { mesh, parts, .. } = self.system;
        let mut friction = vec![0.0; mesh.cells()];
        for (arc, own) in mesh.arcs.iter().zip(&mesh.bristles) {
            let cells = self.seated[own.clone()].iter();
            let bristles = &state[parts.along.clone()][own.clone()];
            for (to, (seated, along)) in friction[arc.clone()].iter_mut().zip(cells.zip(bristles)) {
                *to = 2.0 * seated.pressure * along;
            }
        }
        friction
    }

    fn displacements<'a>(&self, _: &'a [f64], _: usize) -> &'a [f64] {
        &[]
    }

    fn energy(&self, state: &[f64]) -> f64 {
        self.system.energy(state, &self.lengths)
    }

    fn ledger(&self, state: &[f64], at_start: f64) -> Ledger {
        let parts = &self.system.parts;
        Ledger {
            work: state[parts.work.clone()].iter().sum(),
            stored: self.energy(state) - at_start,
            damped: state[parts.damped],
            contact: state[parts.friction],
            compression: state[parts.compression],
            turnover: at_start + state[parts.turnover],
            ..Ledger::default()
        }
    }

    fn unrest(&self, state: &[f64], rates: &[f64]) -> f64 {
        let amounts = &self.system.parts.amount;
        let (amount, changes) = (&state[amounts.clone()], &rates[amounts.clone()]);
        let tensions = self.stretch.iter().enumerate().map(|(cell, stretch)| {
            // The rate of T = EA (g/a − 1) over T.
            let rate = (self.lengthening[cell] - stretch * changes[cell]) / amount[cell];
            (rate / (stretch - 1.0)).abs()
        });
        tensions.fold(0.0, f64::max)
    }

    fn impossible(&self, state: &[f64]) -> Option<&'static str> {
        let mut amounts = state[self.system.parts.amount.clone()].iter();
        if self.depths.iter().flatten().any(|depth| depth.is_nan()) {
            return Some(
                "no depth in a groove balances its tension: the belt is slack there, or centrifugal force lifts it off",
            );
        }
        (amounts.any(|amount| *amount <= 0.0)).then_some("the belt is stretched without bounds")
    }
}

/// Deflection of the bristles in a cell of all arcs.
fn bent(system: &System, state: &[f64], place: usize) -> f64 {
    let parts = &system.parts;
    state[parts.along.start + place].hypot(state[parts.up.start + place])
}

/// Deflection from which on the bristles of a pulley count as slipping.
fn limit(system: &System, pulley: usize) -> f64 {
    SLIPPING_BRISTLES * system.wheels[pulley].friction_coefficient
}

/// Slip `e_w` of the belt up the groove faces in a cell of an arc, m/s.
fn sliding(rates: &Rates<'_>, pulley: usize, index: usize) -> f64 {
    let mesh = &rates.system.mesh;
    let rate = &rates.sinking[pulley].rate;
    let sinking = 0.5 * (rate[index] + rate[index + 1]);
    let direction = rates.seated[mesh.bristles[pulley].start + index].direction;
    let v = rates.middle[mesh.arcs[pulley].start + index];
    (v * direction[0] - sinking) / rates.system.groove[1]
}
