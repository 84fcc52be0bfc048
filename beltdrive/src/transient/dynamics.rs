//! What a run needs of the equations of motion: flat belts and V-belts are followed by one loop of steps.

use super::axles::Axles;
use super::implicit::ImplicitWork;
use super::ledger::Ledger;
use super::mesh::Mesh;
use super::simulation::StepBound;
use super::system::Wheel;
use std::convert::Infallible;
use std::ops::Range;

/// The rates of the states of a drive. What is told of a state without its rates as an argument belongs to the state
/// whose rates were computed last.
pub(crate) trait Dynamics: Sized {
    /// Implicit steps over these rates; [`Infallible`] where there are none.
    type Implicit: ImplicitSteps<Self>;

    /// The mesh along the loop.
    fn mesh(&self) -> &Mesh;

    /// The pulleys in belt order.
    fn wheels(&self) -> &[Wheel];

    /// Torques on the pulleys.
    fn axles(&self) -> &Axles;

    /// Where the speeds of the pulleys stand in a state.
    fn speeds(&self) -> Range<usize>;

    /// Takes what is given over time from the straight lines that hold from a time in s on.
    fn begin(&mut self, time: f64);

    /// The rates of a state at a time in s, which is set right.
    fn of(&mut self, time: f64, state: &mut [f64], rates: &mut [f64]);

    /// The largest rate of a state but for those of the axles, 1/s, and what it is of: a step is stable up to a multiple of
    /// its inverse.
    fn fastest(&self, state: &[f64]) -> (f64, StepBound);

    /// Implicit steps from a state; `None` where all steps have to be explicit.
    fn implicit(&self, state: &[f64], limits: StepLimits) -> Option<Self::Implicit>;

    /// Speed √(EA/m) of axial waves against the belt, m/s.
    fn wave_speed(&self) -> f64;

    /// Tension EA (λ − 1) at a stretch, without damping, N.
    fn tension(&self, stretch: f64) -> f64;

    /// Stretches of the cells.
    fn stretches(&self) -> &[f64];

    /// Belt speed in the middles of the cells, m/s.
    fn middles(&self) -> &[f64];

    /// Whether the belt slips in a cell of an arc, by its index there.
    fn slips(&self, state: &[f64], pulley: usize, index: usize) -> bool;

    /// Whether the belt slips on the whole contact with a pulley.
    fn slips_grossly(&self, state: &[f64], pulley: usize) -> bool;

    /// Length of the part of a contact on which the belt slips, in cells.
    fn slipping(&self, state: &[f64], pulley: usize) -> f64;

    /// Force of the belt on a pulley in a cell of its arc, by its index there, N: along the motion of the pulley and
    /// towards the axis.
    fn force(&self, state: &[f64], pulley: usize, index: usize) -> [f64; 2];

    /// Friction along the belt against its motion, per length in N/m, in all cells; 0 on the spans.
    fn friction(&self, state: &[f64]) -> Vec<f64>;

    /// Displacements of the belt across at the faces of a span, m; none where spans stay straight.
    fn displacements<'a>(&self, state: &'a [f64], span: usize) -> &'a [f64];

    /// Kinetic and strain energy, J.
    fn energy(&self, state: &[f64]) -> f64;

    /// The ledger of a run that started with an energy in J.
    fn ledger(&self, state: &[f64], at_start: f64) -> Ledger;

    /// How fast the tension changes, of itself, or a span moves across, of the length of the loop, where that is fastest,
    /// with rates of the state; 1/s.
    fn unrest(&self, state: &[f64], rates: &[f64]) -> f64;

    /// What makes a state one that no belt has.
    fn impossible(&self, state: &[f64]) -> Option<&'static str>;
}

/// What implicit steps keep to.
#[derive(Clone, Copy, Debug)]
pub(crate) struct StepLimits {
    /// The longest step, s.
    pub(crate) longest: f64,
    /// The shortest step that the first ones may lead to, in explicit steps.
    pub(crate) shortest: f64,
    /// The largest error of a step, in the scales of the state.
    pub(crate) tolerance: f64,
}

/// Implicit steps over rates.
pub(crate) trait ImplicitSteps<R> {
    /// Begins anew at a state whose rates were computed last, with a short step, as at a corner of what is given.
    fn begin(&mut self, rates: &R, state: &[f64], changes: &[f64]);

    /// Length that the next step will have, s.
    fn next(&self) -> f64;

    /// Takes a state at a time in s towards another time; the time that it reaches. None, with the state as it was, if
    /// no step that is longer than an explicit one leads on or a load would stop a pulley on the way.
    fn step(&mut self, rates: &mut R, span: [f64; 2], state: &mut [f64]) -> Option<f64>;

    /// The state at a share of the last step, which was of a length in s and led to a state.
    fn within(&self, share: f64, step: f64, state: &[f64], to: &mut [f64]);

    /// The rates at the end of the last step.
    fn changes(&self) -> &[f64];

    /// What the steps took up to now.
    fn work(&self) -> ImplicitWork;
}

impl<R> ImplicitSteps<R> for Infallible {
    fn begin(&mut self, _: &R, _: &[f64], _: &[f64]) {
        match *self {}
    }

    fn next(&self) -> f64 {
        match *self {}
    }

    fn step(&mut self, _: &mut R, _: [f64; 2], _: &mut [f64]) -> Option<f64> {
        match *self {}
    }

    fn within(&self, _: f64, _: f64, _: &[f64], _: &mut [f64]) {
        match *self {}
    }

    fn changes(&self) -> &[f64] {
        match *self {}
    }

    fn work(&self) -> ImplicitWork {
        match *self {}
    }
}
