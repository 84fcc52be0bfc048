//! The largest load of two pulleys with scalar EPP friction, from loads just below that with Coulomb friction.
//!
//! On the way up from a light load the arcs on which elastic friction holds the belt shrink and vanish. Where one does the curve of
//! states may have a limit point that is none, since the belt may be held on other arcs: that of `v-power` with 1e9 N/m² was
//! at 12.35 kW per 1000 rpm from one load, at 15.56 from others. Close to the largest load those arcs have vanished, and the curve
//! from there is short. A state there is that of the drive with the tensions of the loop with Coulomb friction (see `pair`).

use super::super::BeltProblem;
use super::super::groove::Law;
use super::super::path::{Effort, Solved};
use super::climb::{DOUBLED, LARGEST_FACTOR, Limit};
use super::pair::{in_any_way, is_pair};
use super::pieces::ROUGH;
use super::problem::LoopProblem;
use super::running::is_drive;
use super::slipping::is_slipping;
use super::solve::Search;
use super::start::Start;
use crate::results::loop_state::LoopState;
use crate::{Drive, Duty, FrictionLaw};

/// Shares of the load that slackens a span from which it is raised with Coulomb friction, in turn. Where the belt locks, as `v-power`
/// at 55 W, the curve is not followed to its end.
const SHARES: [f64; 3] = [0.5, 0.25, 0.1];
/// Shares of the largest load with Coulomb friction from which that with elastic friction is raised, in turn: softer friction carries
/// less. `v-power` carries 0.98 of it with 1e9 N/m², 0.93 with 1e8 and 0.28 with 1e7.
const BELOW: [f64; 7] = [0.97, 0.9, 0.8, 0.65, 0.5, 0.35, 0.2];

/// A loop of two pulleys with Coulomb friction in place of scalar EPP friction.
pub(super) struct Unelastic {
    drive: Drive,
    /// The factor on all torques up to which it has a state.
    largest: f64,
    /// States below that.
    states: Vec<Solved<LoopProblem>>,
}

impl Unelastic {
    /// That of a loop under its load; `None` if there is none, or its largest load is not found.
    pub(super) fn of(whole: &Start<'_>) -> Option<Self> {
        let FrictionLaw::Epp { .. } = whole.drive.law else {
            return None;
        };
        if whole.drive.is_idle() || !is_pair(whole.drive) {
            return None;
        }
        let drive = Drive {
            law: FrictionLaw::Coulomb,
            ..whole.drive.clone()
        };
        let (start, mut search) = (whole.of(&drive), Search::new(&drive, ROUGH));
        let slackened = start.slackened()?;
        let (limit, from) = SHARES.into_iter().find_map(|share| {
            let start = start.under(share * slackened);
            let bristles = search.enter_bristles(&start).ok()?;
            let begin = search.with_direction_near(&start, &bristles)?;
            search.rise_to_limit(begin)
        })?;
        let mut states = limit.below;
        states.push(from);
        Some(Self {
            drive,
            largest: limit.top.factor,
            states,
        })
    }

    /// Its state under a load.
    fn at(&self, factor: f64) -> Option<Solved<LoopProblem>> {
        let away = |state: &&Solved<LoopProblem>| (state.factor() - factor).abs();
        let states = self.states.iter();
        let near = states.min_by(|one, other| away(one).total_cmp(&away(other)))?;
        Search::new(&self.drive, ROUGH).at_factor(near, factor, Effort::Rough)
    }
}

impl Search<'_> {
    /// The largest load with scalar EPP friction, and the state from which it was raised to that, if it is found so.
    pub(super) fn elastic_limit(
        &mut self,
        whole: &Start<'_>,
        unelastic: &Unelastic,
    ) -> Option<(Limit, Solved<LoopProblem>)> {
        BELOW.into_iter().find_map(|share| {
            let factor = share * unelastic.largest;
            let near = unelastic.at(factor)?;
            let begin = self.by_pair(&whole.under(factor), &near, |path| path.with_direction());
            self.rise_to_limit(begin?)
        })
    }

    /// The state under the whole load with scalar EPP friction, which is below its largest, if it is found.
    pub(super) fn elastic(
        &mut self,
        whole: &Start<'_>,
        unelastic: &Unelastic,
    ) -> Option<Solved<LoopProblem>> {
        let near = unelastic.at(1.0)?;
        self.by_pair(whole, &near, in_any_way).filter(is_drive)
    }

    /// The largest load above that of a state. Beyond a limit point the load rises to it, too, so that the state may be one of a
    /// slow pulley or a steep belt: those found near the largest load of three of 16 random loops are.
    fn rise_to_limit(
        &mut self,
        begin: Solved<LoopProblem>,
    ) -> Option<(Limit, Solved<LoopProblem>)> {
        if !is_drive(&begin) {
            return None;
        }
        self.rise(&begin, DOUBLED, LARGEST_FACTOR, None).ok()?
    }
}

impl Limit {
    /// Whether the end of a curve is the largest load. Where no pulley slips grossly and the belt does not overhang, that of one
    /// with scalar EPP friction may be a place where an arc vanishes: one random loop was told to carry 8.652 times a load of
    /// which it carries 71.57 times.
    pub(super) fn is_largest(&self) -> bool {
        match self.at.problem.law() {
            Law::Sliding {
                elastic: Some(_), ..
            } => self.top.overhangs || is_slipping(&self.at),
            _ => true,
        }
    }
}

/// A drive with the torques of its state in place of powers.
pub(super) fn with_torques(drive: &Drive, state: &LoopState) -> Drive {
    let mut drive = drive.clone();
    for (pulley, found) in drive.pulleys.iter_mut().zip(&state.pulleys) {
        if let Duty::Power(_) = pulley.duty {
            pulley.duty = Duty::Torque(found.torque);
        }
    }
    drive
}
