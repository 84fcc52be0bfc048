//! A state that is found by the slip of the driven pulley in place of its load.
//!
//! With scalar elastic friction a drive may carry ten times the tension of the slack span, or a hundred-thousandth more than that,
//! which is not known before a state is. But the driven pulley may have any slip, so that a slip has a state where most loads have
//! none; and where the belt slips, neither the direction of friction nor its zones depend on a slip of hardly any size.

use super::{Asked, AtLoad};
use crate::input::Key;
use crate::vbelt::carried::Carried;
use crate::vbelt::path::{Effort, Path, Solved};
use crate::vbelt::{DriveProblem, Instead};
use crate::{Drive, FrictionLaw};

/// Slips of the driven pulley at which a state is sought, the first that is found in front of the largest load: the larger, the
/// nearer to that. Belts slip grossly from slips of the order of their largest strain on.
const SLIPS: [f64; 5] = [0.1, 0.05, 0.02, 0.005, 0.002];
/// Multiples of the slack tension under which a belt is sought that friction keeps from being pressed through a groove. Of two
/// random drives that carry a load though they are pressed through at rest one has bristles from 1.01 and one from 1.1 on.
const LOADS: [f64; 4] = [1.0, 1.1, 1.3, 2.0];

/// A drive whose driven pulley has a scaled speed.
struct AtSlip<'d> {
    near: AtLoad<'d>,
    speed: f64,
}

impl Asked for AtSlip<'_> {
    type Problem = DriveProblem;

    const FIRST: Effort = Effort::Final;

    fn drive(&self) -> &Drive {
        self.near.drive
    }

    fn problem(&self, law: FrictionLaw, lag: f64) -> DriveProblem {
        let problem = self.near.problem(law, lag);
        problem.with_unknown_tight_tension(Instead::DrivenSpeed(self.speed))
    }

    fn guess<'p>(&'p self, problem: &'p DriveProblem) -> impl bvp::Guess + 'p {
        self.near.guess(problem)
    }
}

impl Path<'_> {
    /// The state without load with bristles that have the limit of elastic friction, if it is found.
    pub(in crate::vbelt) fn idle_bristles(&mut self) -> Option<Solved> {
        self.elastic_bristles_at(self.slack())
    }

    /// Whether such a state is found under no or a small load.
    pub(in crate::vbelt) fn has_bristles(&mut self) -> bool {
        let slack = self.slack();
        let mut loads = LOADS.into_iter();
        loads.any(|ratio| self.elastic_bristles_at(ratio * slack).is_some())
    }

    fn elastic_bristles_at(&mut self, tight: f64) -> Option<Solved> {
        let drive = self.drive;
        let asked = AtLoad { drive, tight };
        let start = self.cold(&asked, asked.softest(), Effort::Start).ok()?;
        self.elastic_bristles(&asked, &start, asked.soft()).ok()
    }

    /// The drive under a load below `below`, SI, at which its driven pulley slips, and its state, if that is found below the limits
    /// of the load.
    pub(in crate::vbelt) fn slipping(
        &mut self,
        idle: &Solved,
        below: f64,
    ) -> Option<(Drive, Solved)> {
        let slack = self.drive.pair().load.slack.value();
        let mut slips = SLIPS.into_iter();
        slips.find_map(|slip| self.at_slip(idle, slip, [slack, below]))
    }

    /// Such bristles at a slip, with the scaled tight tension that they carry.
    pub(in crate::vbelt) fn bristles_at_slip(
        &mut self,
        idle: &Solved,
        slip: f64,
    ) -> Option<Solved> {
        let speed = Instead::DrivenSpeed(idle.driven_speed() * (1.0 - slip));
        let problem = idle.problem.clone().with_unknown_tight_tension(speed);
        self.attempt(problem, &Carried(idle), Effort::Start).ok()
    }

    /// The drive under the load at which its driven pulley is slower by a share `slip` than that of the state without load, and its
    /// state, if that is found below the limits of the load and the load, SI, is between two others.
    pub(in crate::vbelt) fn at_slip(
        &mut self,
        idle: &Solved,
        slip: f64,
        between: [f64; 2],
    ) -> Option<(Drive, Solved)> {
        let (drive, force) = (self.drive, self.scales().units.force);
        let is_between = |solved: &Solved| {
            let tight = solved.tight_tension() * force;
            between[0] < tight && tight < between[1]
        };
        let bristles = self.bristles_at_slip(idle, slip)?;
        if !is_between(&bristles) {
            return None;
        }
        let tight = self.slack();
        let asked = AtSlip {
            near: AtLoad { drive, tight },
            speed: bristles.driven_speed(),
        };
        let sliding = self.epp_by_bristles(&asked, &bristles);
        let found = sliding.or_else(|| self.normalised(&asked, bristles).ok())?;
        if !is_between(&found) {
            return None;
        }
        let tight = found.tight_tension();
        let problem = found.problem.clone().with_tight_tension(tight);
        let found = self
            .attempt(problem, &Carried(&found), Effort::Final)
            .ok()?;
        let mut near = drive.clone();
        Key::load(drive).set(&mut near, tight * force);
        self.is_below_limit(&found).then_some((near, found))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::SolveOptions;
    use crate::vbelt::by_branch::by_branch;
    use crate::vbelt::scaling::tests::{kim, tractive, v_belt};
    use crate::vbelt::solve::solve;
    use crate::{SolveError, TwoPulleys};
    use web_time::Instant;

    #[test]
    fn a_state_of_a_stated_slip_is_that_of_its_load() {
        let drive = Drive::from(kim(FrictionLaw::Epp { stiffness: 8.1e6 }, 0.25));
        let mut path = Path::new(&drive, 1e-6);
        let idle = path.idle_bristles().unwrap();
        let slip = 0.02;
        let (near, solved) = path
            .at_slip(&idle, slip, [100.0, f64::INFINITY])
            .expect("a state in front of the limits");
        let speed = solved.driven_speed();
        assert!((speed / idle.driven_speed() - (1.0 - slip)).abs() < 1e-12);
        let state = solve(&near, &SolveOptions::default()).unwrap();
        let rim = state.driven.angular_speed * 0.25 / drive.rim_speed();
        assert!((rim / speed - 1.0).abs() < 1e-6, "{rim} {speed}");
        // Its load is outside of other ranges.
        let load = Key::load(&near).get(&near);
        for between in [[100.0, 0.9 * load], [1.1 * load, f64::INFINITY]] {
            assert!(path.at_slip(&idle, slip, between).is_none());
        }
    }

    #[test]
    fn a_load_of_soft_friction_is_refused_from_a_slip() {
        // It carries 2.2 mN, found from one of 40 loads in 19 000 Newton steps without a slip.
        let law = FrictionLaw::Epp {
            stiffness: 125_000.0,
        };
        let drive = Drive::from(TwoPulleys {
            belt: v_belt([0.039_018_47, 287_216.5, 6_294_816.3, 0.333_017_87]),
            friction_coefficient: 0.235_783_75,
            driver_radius: 0.073_469_276,
            driver_speed: 11.658_544,
            driven_radius: 0.149_276_36,
            centre_distance: 0.353_996_94,
            load: tractive(47.025_566, 175.325),
            ..kim(law, 0.25)
        });
        let mut path = Path::new(&drive, 1e-6);
        let refused = by_branch(&mut path, Instant::now(), false).unwrap();
        let Err(SolveError::NoSteadyState { limit, .. }) = refused else {
            panic!("{refused:?}");
        };
        assert!((limit - 47.027_719_5).abs() < 1e-6, "{limit}");
        let steps = path.stats.newton_steps;
        assert!(steps <= 3600, "{steps}");
    }
}
