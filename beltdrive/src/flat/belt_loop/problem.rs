//! A loop with its torques: without them, and under a share of them.

use super::closing::{Closing, Target};
use super::equations::{Equations, Unknowns};
use super::numbers::Numbers;
use super::rest::{Rest, rest_of_length};
use super::running::RunningBelt;
use crate::drive::layout::Layout;
use crate::mechanics::tensioner::{Towards, equilibrium};
use crate::{Drive, FrictionLaw, SolveError};

/// The loop under load.
pub(super) struct Loaded {
    /// Coordinate of the tensioner, rad or m; without one it means nothing.
    pub(super) coordinate: f64,
    pub(super) layout: Layout,
    /// The belt; `None` if it does not press on all pulleys, or not enough for elastic friction.
    pub(super) belt: Option<RunningBelt>,
}

impl Loaded {
    /// The unknowns of its equations under its whole load, if it presses on all pulleys.
    pub(super) fn state(&self) -> Option<Unknowns> {
        let belt = self.belt.as_ref()?;
        Some([belt.slackest, belt.speed, self.coordinate, 1.0])
    }
}

/// A loop with its torques and what its closure asks of the running belt.
pub(super) struct Problem<'l> {
    pub(super) drive: &'l Drive,
    pub(super) numbers: Numbers,
    pub(super) target: Target,
    /// Where the equilibrium of the tensioner is sought from, and the belt there.
    pub(super) start: (f64, Layout),
    pub(super) towards: Towards,
}

impl Problem<'_> {
    /// Coordinate of the tensioner in the running loop without torques, whose tension is uniform, and the belt
    /// there; an error if the belt lifts off.
    pub(super) fn unloaded(&self) -> Result<(f64, Layout), SolveError> {
        let presses = |layout: &Layout| {
            let tractive_tension = self.unloaded_tension(layout);
            match tractive_tension > 0.0 {
                true => Ok(()),
                false => Err(SolveError::LiftsOff {
                    tractive_tension,
                    speed: self.numbers.rim,
                    is_loaded: false,
                }),
            }
        };
        let found = equilibrium(
            self.drive,
            self.start.clone(),
            self.towards,
            "without load",
            |layout| Ok([self.unloaded_tension(layout), self.tension_per_length()]),
        );
        match found {
            Ok(found) => presses(&found.1).map(|()| found),
            Err(error) => Err(presses(&self.start.1).err().unwrap_or(error)),
        }
    }

    /// Tractive tension of the belt without torques in a layout, N.
    pub(super) fn unloaded_tension(&self, layout: &Layout) -> f64 {
        let (belt, rim) = (self.drive.belt, self.numbers.rim);
        let strain = match self.target {
            Target::Unstretched { length, elongation } => {
                let elongation = layout.length() - length + elongation;
                elongation / (layout.length() - elongation)
            }
            Target::Tension { tension, .. } => tension / belt.axial_stiffness,
            Target::TractiveTension { tension, .. } => return tension,
        };
        let flow = belt.mass_per_length * rim / (1.0 + strain);
        belt.axial_stiffness * strain - flow * rim
    }

    /// The loop under its torques multiplied by a factor; sought from a neighbouring state, if there is one.
    pub(super) fn loaded(
        &self,
        factor: f64,
        law: FrictionLaw,
        neighbour: Option<&Loaded>,
    ) -> Result<Loaded, SolveError> {
        let (coordinate, ref layout) = self.start;
        let (coordinate, layout) = neighbour.map_or((coordinate, layout), |neighbour| {
            (neighbour.coordinate, &neighbour.layout)
        });
        let equations = Equations::new(self, law, layout);
        let start = neighbour
            .and_then(Loaded::state)
            .unwrap_or_else(|| equations.guess(coordinate, factor));
        if let Some((loaded, _)) = equations.loaded::<3>(start) {
            return Ok(loaded);
        }
        let lost = SolveError::NotFound {
            what: "tension of the running belt",
        };
        let pulley = self.drive.tensioner().map_or(0, |(pulley, _)| pulley);
        let (coordinate, layout) = equilibrium(
            self.drive,
            (coordinate, layout.clone()),
            self.towards,
            "under load",
            |layout| {
                let running = Closing::new(self, layout, law, factor);
                let tractive = running.closed_tractive(pulley);
                let tractive = tractive.map_err(|()| lost.clone())?;
                Ok([tractive, self.tension_per_length()])
            },
        )?;
        let belt = Closing::new(self, &layout, law, factor).closed();
        Ok(Loaded {
            coordinate,
            belt: belt.map_err(|()| lost)?,
            layout,
        })
    }

    /// How fast the tension grows with the length of the loop, about, N/m.
    pub(super) fn tension_per_length(&self) -> f64 {
        match self.target {
            Target::Unstretched { length, elongation } => {
                self.drive.belt.axial_stiffness / (length - elongation)
            }
            Target::Tension { .. } | Target::TractiveTension { .. } => 0.0,
        }
    }

    /// The belt of a loaded loop at rest, if it presses on all pulleys.
    pub(super) fn rest_of(&self, loaded: &Loaded) -> Result<Option<Rest>, SolveError> {
        let rest = loaded.belt.as_ref().map(|belt| {
            let unstretched = loaded.layout.length() - belt.elongation;
            rest_of_length(
                self.drive,
                (loaded.coordinate, loaded.layout.clone()),
                unstretched,
            )
        });
        rest.transpose()
    }
}
