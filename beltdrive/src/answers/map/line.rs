//! The states along a line of drives that differ in some numbers.

use super::MapState;
use super::limit::{Limit, beyond};
use crate::answers::belt_loop::closed_once;
use crate::answers::check::{OnPulley, SlipMargin, case_state};
use crate::answers::drive::summary;
use crate::answers::members::{Refusal, Varied};
use crate::belt_loop::LoopState;
use crate::input::{Diagnostic, DriveFile, Variants};
use crate::model::{Neighbour, model};
use crate::{Drive, Duty, GivenLosses, SolveOptions, SteadyState};

/// The drives that differ from a file in some numbers.
pub(in crate::answers) struct Family<'f> {
    variants: Variants<'f>,
    axes: Vec<&'f Varied>,
    options: SolveOptions,
    given: GivenLosses,
}

/// A solved drive, from which its neighbours are found.
#[derive(Clone)]
pub(in crate::answers) struct Near {
    /// As it is closed once its torques are known.
    closed: Drive,
    state_of_two: Option<Box<SteadyState>>,
    neighbour: Neighbour,
}

impl<'f> Family<'f> {
    /// The drives of a file, which says the sense of its belt.
    ///
    /// # Errors
    /// An entry of the file is at fault.
    pub(in crate::answers) fn new(
        file: &'f DriveFile,
        axes: Vec<&'f Varied>,
        options: SolveOptions,
        given: GivenLosses,
    ) -> Result<Self, Diagnostic> {
        let keys = axes.iter().filter_map(|axis| match axis {
            Varied::Key(key) => Some(key),
            Varied::LoadFactor => None,
        });
        Ok(Self {
            variants: Variants::new(file, &keys.collect::<Vec<_>>())?,
            axes,
            options,
            given,
        })
    }

    /// The axis of two along which lines run: x where it alone raises the load, else y.
    pub(super) fn along(&self, values: [&[f64]; 2]) -> usize {
        let raises = |axis: usize| {
            let [Some(&x), Some(&y)] = values.map(<[f64]>::first) else {
                return false;
            };
            let mut other = [x, y];
            other[axis] = values[axis].last().copied().unwrap_or(f64::NAN);
            let drives = [[x, y], other].map(|values| self.stated(&values));
            let [Ok((one, first)), Ok((other, last))] = drives else {
                return false;
            };
            first != last || one.load_factor_over(&other).is_some() && one != other
        };
        match raises(0) && !raises(1) {
            true => 0,
            false => 1,
        }
    }

    /// The drive as the file states it with these values of the axes, and the factor on its torques.
    pub(in crate::answers) fn stated(&self, values: &[f64]) -> Result<(Drive, f64), Refusal> {
        let numbers = |factors: bool| {
            let all = self.axes.iter().zip(values);
            all.filter_map(move |(axis, &value)| {
                (matches!(axis, Varied::LoadFactor) == factors).then_some(value)
            })
        };
        let drive = self.variants.drive(numbers(false));
        let drive = drive.map_err(|error| Refusal::Input(Box::new(error)))?;
        Ok((drive, numbers(true).product()))
    }

    /// The state with these values of the axes, and what its neighbours are found from.
    pub(in crate::answers) fn point(
        &self,
        near: Option<&Near>,
        values: &[f64],
    ) -> Result<(Near, LoopState), Refusal> {
        let stated = self.stated(values)?;
        self.solve(near, stated)
    }

    fn solve(
        &self,
        near: Option<&Near>,
        (stated, factor): (Drive, f64),
    ) -> Result<(Near, LoopState), Refusal> {
        let options = &self.options;
        let (mut closed, state_of_two) = match stated.two_pulleys() {
            Some(_) => {
                let near = near.and_then(|near| near.state_of_two.as_deref());
                let (found, state) = summary(near, &stated, options)?;
                let closed = stated.as_loop(found.driven.torque, found.slack_tractive_tension);
                (closed, state.map(Box::new))
            }
            None => (closed_once(&stated, options)?.into_owned(), None),
        };
        if factor != 1.0 {
            closed.multiply_load(factor);
        }
        let neighbour = near.map(|near| &near.neighbour);
        let model = model(closed.belt.kind);
        let (state, neighbour) = model.solve_loop_from(&closed, neighbour, options)?;
        let near = Near {
            closed,
            state_of_two,
            neighbour,
        };
        Ok((near, state))
    }

    /// The states of a line, each from the one before.
    pub(in crate::answers) fn line<Values: AsRef<[f64]>>(
        &self,
        start: Option<&Near>,
        values: impl Iterator<Item = Values>,
    ) -> Vec<Result<MapState, Refusal>> {
        let mut near = start.cloned().map(Near::at_a_turn);
        let (mut line, mut limit, mut refused) = (Vec::new(), None, None);
        // The drives of the last states, whose load alone rises; their limit is found with the last of them.
        let mut rising: Vec<(usize, Drive)> = Vec::new();
        for values in values {
            let place = line.len();
            let stated = self.stated(values.as_ref());
            let known = stated.as_ref().ok();
            let error = known.and_then(|stated| beyond(stated, limit.as_ref(), refused.as_ref()));
            let found = match (stated, error) {
                (Err(refusal), _) => Err(refusal),
                (_, Some(error)) => Err(error.into()),
                (Ok(stated), None) => {
                    let found = self.solve(near.as_ref(), stated.clone());
                    if let Err(Refusal::Loop(error)) = &found {
                        limit = limit.or_else(|| Limit::refusing(&stated, error));
                        refused = Some((stated.0, (**error).clone()));
                    }
                    found
                }
            };
            let told = found.map(|(here, state)| {
                let first = rising.first().map(|(_, first)| first);
                let torques = with_torques(&here.closed, &state);
                let rises = first.is_none_or(|first| torques.load_factor_over(first).is_some());
                if !rises {
                    self.limit(&mut line, &mut rising, near.as_ref(), limit.take());
                }
                rising.push((place, torques));
                let told = self.told(&here.closed, state);
                near = Some(here);
                told
            });
            line.push(told);
        }
        self.limit(&mut line, &mut rising, near.as_ref(), limit);
        line
    }

    /// Tells the slip margins of the states of drives whose load alone rises to that of the last one, `near`.
    fn limit(
        &self,
        line: &mut [Result<MapState, Refusal>],
        rising: &mut Vec<(usize, Drive)>,
        near: Option<&Near>,
        known: Option<Limit>,
    ) {
        let (Some(near), Some((_, last))) = (near, rising.last()) else {
            return;
        };
        let Neighbour::V(neighbour) = &near.neighbour else {
            rising.clear();
            return;
        };
        let is_known = |limit: &Limit| limit.of.load_factor_over(last).is_some();
        let limit = known.filter(is_known).or_else(|| {
            let top = neighbour.load_limit(self.options.tolerance)?;
            let of = last.clone();
            Some(Limit { of, top })
        });
        for (place, drive) in rising.drain(..) {
            let Ok(state) = &mut line[place] else {
                continue;
            };
            let over = limit
                .as_ref()
                .and_then(|limit| drive.load_factor_over(&limit.of));
            if let (Some(limit), Some(over), SlipMargin::NotFound) =
                (&limit, over, state.slip_margin)
            {
                state.slip_margin = SlipMargin::Factor(OnPulley {
                    value: limit.top.factor / over,
                    pulley: limit.top.pulley,
                });
            }
        }
    }

    /// What a map tells of a state.
    fn told(&self, drive: &Drive, state: LoopState) -> MapState {
        MapState::of(&case_state(drive, state, &self.given))
    }
}

impl Near {
    /// The same, from which a line in another direction begins.
    fn at_a_turn(self) -> Self {
        let neighbour = match self.neighbour {
            Neighbour::V(near) => Neighbour::V(Box::new(near.at_a_turn())),
            Neighbour::Flat => Neighbour::Flat,
        };
        Self { neighbour, ..self }
    }
}

/// A drive with the torques of a state in place of powers: margins are factors on torques.
fn with_torques(drive: &Drive, state: &LoopState) -> Drive {
    let mut drive = drive.clone();
    for (pulley, found) in drive.pulleys.iter_mut().zip(&state.pulleys) {
        if let Duty::Power(_) = pulley.duty {
            pulley.duty = Duty::Torque(found.torque);
        }
    }
    drive
}
