//! States of a drive under other loads, from which the branch of its load is followed.

use super::limit::slips_far;
use super::path::{Path, Solved};
use crate::Drive;
use crate::input::Key;

/// How far a load is lowered, as powers of its ratio to the slack tension: the nearer, the shorter the way, but not all
/// states are found. Of 10 000 drives with Coulomb friction two that are overloaded were not refused without 0.5.
const LIGHTER: [f64; 9] = [0.8, 0.6, 0.5, 0.4, 0.25, 0.15, 0.08, 0.03, 0.01];
/// Multiples of the slack tension at which one may begin at last: soft scalar elastic friction on a stiff belt carries no more
/// than 0.02 to 0.4 % more than no load, where vector EPP friction carries 18 and 52 times as much. With the first one loads
/// beyond 42.085 N are refused of a drive with a slack tension of 41.913 N, whose branch from 1.001 times that is lost at 42.01 N.
/// With the last three, friction that is softer still is found to carry next to nothing: of 80 random drives with `k_f` from 0.001
/// to 0.03 of the radial stiffness six are neither solved nor refused without them, and none with them.
const LIGHTEST: [f64; 8] = [
    1.003, 1.001, 1.0005, 1.0002, 1.0001, 1.000_03, 1.000_01, 1.000_003,
];
/// Loads within this share of the slack tension are hardly other loads than none: powers of a ratio that come nearer are left out.
const NEAR_NO_LOAD: f64 = 1e-4;
/// Multiples of the slack tension at which a branch may begin in place of the load of the drive, and first does if that
/// is less than the last of them: nearer to no load the belt hardly slips, and states are hard to find and to follow.
const HEAVIER: [f64; 4] = [2.0, 3.0, 1.5, 1.2];

/// A load that is hardly any, as multiple of the slack tension: nearer to none, states are harder to follow.
pub(super) const HARDLY_ANY: f64 = 1.1;

/// A load from which a branch may begin.
#[derive(Clone, Copy, Debug)]
pub(super) struct StartLoad {
    /// The tight tension or tractive tension, SI.
    pub(super) value: f64,
    /// Whether friction is to have its direction as a state: a normalised direction is harder to follow.
    pub(super) has_direction: bool,
}

/// Loads from which the branch of the load of a drive may begin, the best first; its own load among them if that is
/// asked for.
pub(super) fn start_loads(drive: &Drive, with_own: bool) -> impl Iterator<Item = StartLoad> {
    let slack = drive.pair().load.slack.value();
    let ratio = Key::load(drive).get(drive) / slack;
    let own = with_own.then_some(ratio);
    let lighter = LIGHTER.map(|power| ratio.powf(power));
    let lighter = lighter
        .into_iter()
        .filter(|ratio| (ratio - 1.0).abs() >= NEAR_NO_LOAD);
    let lighter = own.into_iter().chain(lighter);
    let mut ratios: Vec<f64> = match (1.0..HEAVIER[3]).contains(&ratio) {
        true => HEAVIER.into_iter().chain(lighter).collect(),
        false => lighter.chain(HEAVIER).collect(),
    };
    ratios.extend(LIGHTEST);
    [true, false].into_iter().flat_map(move |has_direction| {
        ratios.clone().into_iter().map(move |ratio| StartLoad {
            value: slack * ratio,
            has_direction,
        })
    })
}

impl StartLoad {
    /// The drive of a search under this load and its state, if that is found below the limits of the load and the driven
    /// pulley is not slow. Hardly any load leads from rest to its state, even if the driver creeps. The search counts what it costs.
    pub(super) fn state(self, path: &mut Path<'_>) -> Option<(Drive, Solved)> {
        let mut near = path.drive.clone();
        Key::load(path.drive).set(&mut near, self.value);
        let mut search = Path::of_branch(&near, path.tolerance);
        search.was_raised_in_vain = path.was_raised_in_vain;
        let found = match self.has_direction {
            true => search.with_direction(),
            false => search.start(),
        };
        let is_light = self.value <= HARDLY_ANY * path.drive.pair().load.slack.value();
        let found = found.filter(|solved| match is_light {
            true => !slips_far(solved) && search.is_before_limit(solved),
            false => search.is_below_limit(solved),
        });
        path.stats += search.stats;
        path.problems += search.problems;
        found.map(|solved| (near, solved))
    }
}
