//! What is seen of a solution along a pulley.

use super::Loose;
use super::kinds::{Zone, is_cut};
use crate::LeastSlip;
use crate::vbelt::path::Solved;
use crate::vbelt::{
    BREAKAWAY, BeltProblem, Contact, Groove, LAW, Law, MAX_STATES, Regime, beyond_breakaway,
    limit_excess,
};
use std::f64::consts::TAU;

/// Samples per mesh interval in search of crossings.
const SAMPLES: usize = 8;
/// Bristles below this share of their limit hold the belt. With 0.9 the belt was not seen to stick on 2 of 40
/// drives where it does; bristles that slide lag less than that, but in the turn.
const HOLDING: f64 = 0.98;
/// Cosine of the direction, from straight down the groove, in which the belt slips until it begins to stick.
const SINKING: f64 = -0.9;
/// Share of friction by which it is below its limit where a belt that sticks comes to rest. As it reaches the limit
/// the belt ceases to stick and slides at a speed that is zero but for an exponential, and the end of the zone moves
/// along the pulley at a load that does not change: 37 steps of a branch.
const RESTING: f64 = 3e-5;
/// By how much the share of friction that turns, and that which breaks the belt away, pass zero where they are
/// seen to. A limit of 20 453 N was found where the turn ended, of a drive that carries 24 698 N.
pub(super) const CLEAR_TURN: f64 = 0.05;
const CLEAR_BREAKAWAY: f64 = 0.75 * BREAKAWAY;
/// The belt breaks loose at least this share of the contact before the turn: bristles are too soft to show a way
/// between that is shorter, and without one Newton's method failed on 1 of 40 drives.
const ROOM: f64 = 0.01;

/// Shares of the contact behind the entry at which elastic friction is looked for. The pressure grows over some hundredths of
/// the contact, so that friction on a shorter way than the first is below what the checks allow.
pub(super) const BEHIND_ENTRY: [f64; 4] = [1e-6, 1e-5, 1e-4, 1e-3];

/// Share of its limit up to which elastic friction is hardly any, so that its displacement has no sign. That of a belt that enters
/// with the tension at which it does not grow leaves zero as the square of the way and more, and may be on the other side at first.
/// Cut where such a one changes its sign, seven of 120 random drives take 2 to 24 s in place of 0.1 to 0.5 s.
const FELT: f64 = 1e-4;

/// A belt passes a place at which it might have come to rest if it slips by this factor more in front of that and behind it: at
/// such places of random drives it slipped by 1.02 to 19 times as much, and the slip of six in seven drives has none.
const FASTER: f64 = 1.01;

/// What is seen of a solution at a place on a pulley.
#[derive(Clone, Copy, Debug)]
pub(in crate::vbelt) struct Sample {
    /// Scaled arc length from the entry.
    pub(in crate::vbelt) place: f64,
    /// Excess of elastic friction over its limit.
    pub(in crate::vbelt) limit: f64,
    /// The displacement of scalar EPP friction; zero with other laws.
    pub(in crate::vbelt) displacement: f64,
    /// Excess of the traction over that in the middle of the turn, as a share of friction.
    pub(in crate::vbelt) turn: f64,
    /// Direction of the traction, continuous along the pulley.
    pub(in crate::vbelt) direction: f64,
    /// Normalised slip |e|.
    pub(in crate::vbelt) slip: f64,
    /// Whether friction holds the belt.
    pub(in crate::vbelt) sticks: bool,
    /// Power that the belt gains from scalar elastic friction, which pulls with the slip, per length; zero where it loses some.
    pub(in crate::vbelt) gained: f64,
    /// Friction as a share of its limit.
    pub(in crate::vbelt) share: f64,
}

/// Looks at a solution along one pulley, at the exit and just behind the entry too if asked for.
pub(super) fn samples<P: BeltProblem>(
    solved: &Solved<P>,
    (pulley, groove): (usize, &Groove),
    at_ends: bool,
    loose: Loose,
) -> Vec<Sample> {
    let (problem, solution) = (&solved.problem, &solved.solution);
    let p = solution.parameters();
    let (rim_speed, flow) = (problem.rim_speed(pulley, p), problem.flow(p));
    let whole = problem.contact_length(pulley, p);
    let mut samples: Vec<Sample> = Vec::new();
    let mut before = 0.0;
    for segment in problem.zones(pulley) {
        let length = problem.length(segment, p);
        // A zone that has vanished.
        if length <= 0.0 {
            continue;
        }
        let is_at_rest = problem.regime(segment) == Regime::Stick
            && holds(groove, solution.start(segment), rim_speed, flow);
        let mut y = [0.0; MAX_STATES];
        let y = &mut y[..solution.segments()[segment].states];
        let inside = solution.mesh(segment).windows(2).flat_map(|pair| {
            let share = |sample| (sample as f64 + 0.5) / SAMPLES as f64;
            (0..SAMPLES).map(move |sample| pair[0] + (pair[1] - pair[0]) * share(sample))
        });
        let is_first = segment == problem.zones(pulley).start;
        let is_last = segment + 1 == problem.zones(pulley).end;
        let first = 0.5 / SAMPLES as f64 * solution.mesh(segment)[1];
        let entry = BEHIND_ENTRY.map(|share| share * whole / length);
        let entry = entry
            .into_iter()
            .filter(|&s| at_ends && is_first && s < first);
        let exit = (at_ends && is_last).then_some(1.0);
        for s in entry.chain(inside).chain(exit) {
            solution.state(segment, s, y);
            let regime = problem.regime(segment);
            let contact = Contact::new(groove, regime, y, rim_speed, flow);
            let direction = direction(groove.law, y, &contact);
            let share = match groove.law {
                Law::Bristle { .. } => y[LAW].hypot(y[LAW + 1]) / groove.friction_coefficient,
                _ => 1.0,
            };
            let limit = excess(groove, regime, y, rim_speed, flow);
            samples.push(Sample {
                place: before + s * length,
                limit,
                displacement: displacement_felt(groove, y, limit),
                turn: contact.turn_excess(groove) / contact.friction().max(f64::MIN_POSITIVE),
                direction: samples.last().map_or(direction, |last| {
                    let turns = (last.direction - direction) / TAU;
                    direction + turns.round() * TAU
                }),
                slip: contact.slip_norm,
                sticks: is_at_rest || is_held(groove.law, share),
                gained: match groove.elastic().is_some() && regime.is_elastic() {
                    true => (-contact.friction_power_densities().iter().sum::<f64>()).max(0.0),
                    false => 0.0,
                },
                share,
            });
        }
        before += length;
    }
    if loose != Loose::Seen {
        keep_first_stick(&mut samples, loose);
    }
    samples
}

/// What is zero where a zone ends, as in [`limit_excess`]. Where vector EPP friction is taken to be elastic and is not,
/// it slips as long as the plastic rate is positive, which ends before |B| is back at its limit.
fn excess(groove: &Groove, regime: Regime, y: &[f64], rim_speed: f64, flow: f64) -> f64 {
    let of = |regime| limit_excess(groove, regime, y, rim_speed, flow);
    match (groove.law, regime) {
        (Law::Vector { .. }, Regime::Elastic) => of(Regime::Elastic).min(of(Regime::Slip)),
        _ => of(regime),
    }
}

/// The displacement of scalar EPP friction, zero where friction is hardly any, from its excess over its limit.
pub(in crate::vbelt) fn displacement_felt(groove: &Groove, states: &[f64], limit: f64) -> f64 {
    let Some(elastic) = groove.elastic() else {
        return 0.0;
    };
    let friction = groove.elastic_friction(elastic, states);
    match friction > FELT * (friction - limit) {
        true => states[groove.displacement()],
        false => 0.0,
    }
}

/// Whether friction is elastic where the belt comes to rest.
fn holds(groove: &Groove, y: &[f64], rim_speed: f64, flow: f64) -> bool {
    let friction = Contact::new(groove, Regime::Elastic, y, rim_speed, flow).friction();
    limit_excess(groove, Regime::Slip, y, rim_speed, flow) < -RESTING * friction
}

/// Whether bristles are seen to hold the belt.
fn is_held(law: Law, share: f64) -> bool {
    match law {
        Law::Bristle { elastic, .. } => elastic.is_some() && share < HOLDING,
        Law::Normalised { .. } | Law::Sliding { .. } | Law::Vector { .. } => false,
    }
}

/// Leaves one place where bristles hold the belt: the first that begins where friction is elastic and the belt
/// sinks. Elsewhere they lag behind a belt that slides.
fn keep_first_stick(samples: &mut [Sample], loose: Loose) {
    let begins = |pair: &[Sample]| {
        let [before, after] = [pair[0], pair[1]];
        !before.sticks && after.sticks && after.limit < 0.0 && before.direction.cos() < SINKING
    };
    let first = samples.windows(2).position(begins).map(|before| before + 1);
    let first = first.unwrap_or(samples.len());
    let run = samples[first..].iter().take_while(|sample| sample.sticks);
    let count = match loose {
        Loose::Early => run
            .enumerate()
            .min_by(|(_, one), (_, other)| one.share.total_cmp(&other.share))
            .map_or(0, |(index, _)| index + 1),
        Loose::Late | Loose::Turning | Loose::Seen => run.count(),
        Loose::Never => 0,
    };
    let room = if loose == Loose::Turning { 0.0 } else { ROOM };
    let latest = match (turn(samples, 0.0), samples.last()) {
        (Some(turn), Some(last)) => turn - room * last.place,
        _ => f64::INFINITY,
    };
    for (index, sample) in samples.iter_mut().enumerate() {
        sample.sticks &= (first..first + count).contains(&index) && sample.place < latest;
    }
}

/// Whether the belt slows down and goes faster again under elastic friction in front of the turn: it might have come to rest in
/// between.
pub(super) fn passes_rest(samples: &[Sample], zones: &[Zone]) -> bool {
    let turn = zones.windows(2).position(is_cut).map(|before| before + 1);
    let is_elastic = |zone: &Zone| zone.regime.is_elastic();
    let mut runs = zones[..turn.unwrap_or(zones.len())]
        .chunk_by(|zone, next| is_elastic(zone) && is_elastic(next))
        .filter(|run| is_elastic(&run[0]));
    runs.any(|run| {
        let (from, to) = (run[0].from, run[run.len() - 1].to);
        let inside = samples
            .iter()
            .filter(|sample| (from..to).contains(&sample.place));
        // The largest slip so far, and the least one since that.
        let (mut largest, mut least) = (0.0, f64::INFINITY);
        inside.map(|sample| sample.slip).any(|slip| {
            if slip > largest {
                (largest, least) = (slip, slip);
            }
            least = least.min(slip);
            largest > FASTER * least && slip > FASTER * least
        })
    })
}

/// Whether the belt is seen to lock, at full friction or held by it.
pub(super) fn locks(samples: &[Sample]) -> bool {
    samples.iter().any(|sample| sample.slip < LeastSlip::LOCKED)
}

/// Where elastic friction begins to pull with the slip, if it does: in front of where it pulls most.
pub(super) fn pulled_from(samples: &[Sample]) -> Option<f64> {
    let gained = |index: &usize| samples[*index].gained;
    let most = (0..samples.len()).max_by(|one, other| gained(one).total_cmp(&gained(other)))?;
    let first = (0..=most)
        .rev()
        .take_while(|index| gained(index) > 0.0)
        .last();
    first.map(|index| samples[index].place)
}

/// The place of the turn, if the excess passes zero by more than `clear` there.
pub(super) fn turn(samples: &[Sample], clear: f64) -> Option<f64> {
    rise(samples, |sample| sample.turn, clear)
}

/// The place where the belt breaks away.
pub(super) fn breakaway(samples: &[Sample]) -> Option<f64> {
    let excess = |sample: &Sample| beyond_breakaway(sample.direction);
    rise(samples, excess, CLEAR_BREAKAWAY)
}

/// The last place at which a value rises through zero, if it is clearly below in front of it and clearly above
/// behind it. Where it is not it may touch zero and be lost at a neighbouring load, which looks like a limit of the
/// load if the place is a condition.
fn rise(samples: &[Sample], value: impl Fn(&Sample) -> f64, clear: f64) -> Option<f64> {
    let below = |sample: &&Sample| value(sample) < 0.0;
    let after = 1 + samples
        .windows(2)
        .rposition(|pair| below(&&pair[0]) && !below(&&pair[1]))?;
    let (in_front, behind) = samples.split_at(after);
    let lowest = in_front.iter().rev().take_while(below).map(&value);
    let highest = behind
        .iter()
        .take_while(|sample| !below(sample))
        .map(&value);
    let is_clear = lowest.fold(0.0, f64::min) < -clear && highest.fold(0.0, f64::max) > clear;
    let [before, after] = [samples[after - 1], samples[after]];
    is_clear.then(|| crossing(before.place, value(&before), after.place, value(&after)))
}

/// Where a value that changes its sign between two places is zero, linearly.
pub(super) fn crossing(from: f64, before: f64, to: f64, after: f64) -> f64 {
    from + (to - from) * before / (before - after)
}

/// The direction of the traction, up to whole turns.
fn direction(law: Law, y: &[f64], contact: &Contact<f64>) -> f64 {
    match law {
        Law::Sliding { .. } => y[LAW],
        Law::Bristle { .. } | Law::Vector { .. } => y[LAW].atan2(y[LAW + 1]),
        Law::Normalised { .. } => contact.slip[0].atan2(contact.slip[1]),
    }
}
