//! What happens on the way: gross slip and slack, located to a time step.

use super::rates::Rates;

/// Something that happened.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct TransientEvent {
    /// When, s; to one time step.
    pub time: f64,
    /// What.
    pub kind: TransientEventKind,
}

/// Something that happens in time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum TransientEventKind {
    /// The belt begins to slip on the whole contact with a pulley, by its index in belt order.
    GrossSlip(usize),
    /// It ends.
    GrossSlipEnds(usize),
    /// The tension falls below zero somewhere. The model goes on with the same stiffness in compression.
    Slack,
    /// It is above zero everywhere again.
    SlackEnds,
}

/// A condition that holds or does not, interrupted for no longer than a wave takes round the loop: the waves of
/// the belt interrupt slip and slack for shorter times again and again.
#[derive(Clone, Copy, Debug, Default)]
struct Condition {
    /// The last time at which it held, while it does.
    holds: Option<f64>,
}

impl Condition {
    /// Looks at a time; whether it begins, or the time at which it ended.
    fn look(&mut self, time: f64, holds: bool, pause: f64) -> Option<Result<(), f64>> {
        match (self.holds, holds) {
            (None, true) => {
                self.holds = Some(time);
                Some(Ok(()))
            }
            (Some(_), true) => {
                self.holds = Some(time);
                None
            }
            (Some(last), false) if time - last > pause => {
                self.holds = None;
                Some(Err(last))
            }
            _ => None,
        }
    }
}

/// What watches a run.
pub(crate) struct Watch {
    slip: Vec<Condition>,
    slack: Condition,
    pause: f64,
    /// The smallest density since it was last asked for.
    least_stretch: f64,
    pub(crate) events: Vec<TransientEvent>,
}

impl Watch {
    /// Watches a drive with a number of pulleys and a time in s that a wave takes round the loop.
    pub(crate) fn new(pulleys: usize, pause: f64) -> Self {
        Self {
            slip: vec![Condition::default(); pulleys],
            slack: Condition::default(),
            pause,
            least_stretch: f64::INFINITY,
            events: vec![],
        }
    }

    /// Looks at a state and its rates.
    pub(crate) fn look(&mut self, time: f64, rates: &Rates<'_>, state: &[f64]) {
        let system = rates.system;
        let stretches = rates.stretches().iter();
        let least = stretches.fold(f64::INFINITY, |least, &stretch| match stretch < least {
            true => stretch,
            false => least,
        });
        self.least_stretch = self.least_stretch.min(least);
        let bristles = &state[system.parts.bristle.clone()];
        let Self {
            slip,
            slack,
            pause,
            events,
            ..
        } = self;
        let mut note = |found: Option<Result<(), f64>>, kinds: [TransientEventKind; 2]| {
            let event = match found {
                Some(Ok(())) => (time, kinds[0]),
                Some(Err(ended)) => (ended, kinds[1]),
                None => return,
            };
            let (time, kind) = event;
            events.push(TransientEvent { time, kind });
        };
        for (pulley, condition) in slip.iter_mut().enumerate() {
            let own = &bristles[system.mesh.bristles[pulley].clone()];
            let mut cells = own.iter().zip(rates.caps(pulley));
            let slips = cells.all(|(bristle, cap)| bristle.abs() >= *cap);
            let kinds = [
                TransientEventKind::GrossSlip(pulley),
                TransientEventKind::GrossSlipEnds(pulley),
            ];
            note(condition.look(time, slips, *pause), kinds);
        }
        let kinds = [TransientEventKind::Slack, TransientEventKind::SlackEnds];
        note(slack.look(time, least < 1.0, *pause), kinds);
    }

    /// The smallest stretch since this was last asked.
    pub(crate) fn take_least_stretch(&mut self) -> f64 {
        std::mem::replace(&mut self.least_stretch, f64::INFINITY)
    }

    /// The events in the order of time.
    pub(crate) fn into_events(mut self) -> Vec<TransientEvent> {
        self.events
            .sort_by(|one, other| one.time.total_cmp(&other.time));
        self.events
    }
}

#[cfg(test)]
mod tests {
    use super::Condition;

    #[test]
    fn a_condition_ends_when_it_last_held_before_a_long_pause() {
        let mut condition = Condition::default();
        let looks = [
            (0.0, false),
            (1.0, true),
            (2.0, false),
            (2.5, true),
            (3.0, false),
            (3.6, false),
            (4.0, false),
            (5.0, true),
        ];
        let found = looks.map(|(time, holds)| condition.look(time, holds, 1.05));
        let none = None;
        let expected = [
            none,
            Some(Ok(())),
            none,
            none,
            none,
            Some(Err(2.5)),
            none,
            Some(Ok(())),
        ];
        assert_eq!(found, expected);
    }
}
