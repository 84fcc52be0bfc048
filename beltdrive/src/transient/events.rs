//! What happens on the way: gross slip and slack, located to a time step.

use super::rates::Rates;
use super::slip::slips;
use super::string;
use super::system::System;

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
    /// The tension falls below zero somewhere. The belt then has a thousandth of its stiffness there.
    Slack,
    /// It is above zero everywhere again.
    SlackEnds,
}

/// How slack a span was in a run.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct SlackSpan {
    /// Time with a tension below zero somewhere on the span, s; to the time steps at its ends.
    pub time: f64,
    /// Largest tension EA (λ − 1) on the span after it was slack first, as it snaps taut or later, N; −∞ if it never was.
    pub largest_tension: f64,
}

impl SlackSpan {
    /// A span that was not.
    const NEVER: Self = Self {
        time: 0.0,
        largest_tension: f64::NEG_INFINITY,
    };
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
    /// The smallest stretch since it was last asked for.
    least_stretch: f64,
    /// Whether any tension was ever below zero.
    is_slack: bool,
    /// The last time, s.
    last: f64,
    pub(crate) slack_spans: Vec<SlackSpan>,
    /// The largest displacement across of each span since it was last asked for, m; none where spans do not move so.
    largest: Vec<f64>,
    pub(crate) events: Vec<TransientEvent>,
}

impl Watch {
    /// Watches a drive whose waves take a time in s round the loop.
    pub(crate) fn new(system: &System, pause: f64) -> Self {
        let pulleys = system.wheels.len();
        Self {
            largest: match system.across {
                Some(_) => vec![0.0; pulleys],
                None => vec![],
            },
            slip: vec![Condition::default(); pulleys],
            slack: Condition::default(),
            pause,
            least_stretch: f64::INFINITY,
            is_slack: false,
            last: 0.0,
            slack_spans: vec![SlackSpan::NEVER; pulleys],
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
        self.is_slack |= least < 1.0;
        if self.is_slack {
            self.look_at_spans(time, rates);
        }
        self.last = time;
        for (span, largest) in self.largest.iter_mut().enumerate() {
            let displaced = string::displacements(system, state, span).iter();
            *largest = displaced.fold(*largest, |largest, w| largest.max(w.abs()));
        }
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
            let slips = cells.all(|(bristle, cap)| slips(*bristle, *cap));
            let kinds = [
                TransientEventKind::GrossSlip(pulley),
                TransientEventKind::GrossSlipEnds(pulley),
            ];
            note(condition.look(time, slips, *pause), kinds);
        }
        let kinds = [TransientEventKind::Slack, TransientEventKind::SlackEnds];
        note(slack.look(time, least < 1.0, *pause), kinds);
    }

    /// Looks at the tensions of the spans.
    fn look_at_spans(&mut self, time: f64, rates: &Rates<'_>) {
        let system = rates.system;
        for (span, slack) in system.mesh.spans.iter().zip(&mut self.slack_spans) {
            let stretches = &rates.stretches()[span.clone()];
            if stretches.iter().any(|&stretch| stretch < 1.0) {
                slack.time += time - self.last;
                slack.largest_tension = slack.largest_tension.max(0.0);
            }
            if slack.largest_tension >= 0.0 {
                let largest = stretches.iter().copied().fold(0.0, f64::max);
                let tension = system.tension(largest);
                slack.largest_tension = slack.largest_tension.max(tension);
            }
        }
    }

    /// The smallest stretch since this was last asked.
    pub(crate) fn take_least_stretch(&mut self) -> f64 {
        std::mem::replace(&mut self.least_stretch, f64::INFINITY)
    }

    /// The largest displacement across of each span since this was last asked, m; none where spans do not move so.
    pub(crate) fn take_largest(&mut self) -> Vec<f64> {
        let asked = vec![0.0; self.largest.len()];
        std::mem::replace(&mut self.largest, asked)
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
