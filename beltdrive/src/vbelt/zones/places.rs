//! Places on a pulley, in scaled arc length from its entry, and the segments of a solution.

use super::kinds::Zone;
use crate::vbelt::path::Solved;
use crate::vbelt::{BeltProblem, Regime};

/// A place where segments of a solution meet.
struct Junction {
    /// The kinds of friction in front of it and behind it.
    kinds: [Regime; 2],
    place: f64,
}

impl Junction {
    /// Whether zones of these kinds that are seen may meet there: of the same kinds, of one where elastic friction is not told
    /// from slip, or where the belt comes to rest or breaks loose, whatever is in front of that or behind it.
    fn is_between(&self, seen: [Regime; 2]) -> bool {
        let sticks = |kinds: [Regime; 2]| kinds.map(|kind| kind == Regime::Stick);
        match sticks(seen) {
            [false, false] => {
                self.kinds == seen || (self.kinds == [Regime::Either; 2] && seen[0] == seen[1])
            }
            ends => sticks(self.kinds) == ends,
        }
    }
}

/// The junctions on a pulley.
fn junctions<P: BeltProblem>(solved: &Solved<P>, pulley: usize) -> impl Iterator<Item = Junction> {
    let (problem, p) = (&solved.problem, solved.solution.parameters());
    let segments = problem.zones(pulley);
    let in_front = segments.start..segments.end - 1;
    in_front.scan(0.0, move |place, segment| {
        *place += problem.length(segment, p);
        Some(Junction {
            kinds: [segment, segment + 1].map(|segment| problem.regime(segment)),
            place: *place,
        })
    })
}

/// The places where the segments of a pulley meet.
pub(super) fn ends<P: BeltProblem>(solved: &Solved<P>, pulley: usize) -> impl Iterator<Item = f64> {
    junctions(solved, pulley).map(|junction| junction.place)
}

/// Moves the ends of zones to the junctions of the same kinds that are nearer than `near`: what is seen of them is
/// less accurate. Where the direction jumps at a junction Newton's method failed from zones that end beside it.
pub(super) fn keep_junctions<P: BeltProblem>(
    zones: &mut [Zone],
    (solved, pulley): (&Solved<P>, usize),
    near: f64,
) {
    for index in 1..zones.len() {
        let [in_front, behind] = [zones[index - 1], zones[index]];
        let kinds = [in_front.regime, behind.regime];
        let distance = |place: f64| (place - behind.from).abs();
        let known = junctions(solved, pulley)
            .filter(|junction| junction.is_between(kinds))
            .filter(|junction| kinds.contains(&Regime::Stick) || distance(junction.place) <= near)
            .map(|junction| junction.place)
            .filter(|&place| in_front.from < place && place < behind.to)
            .min_by(|&one, &other| distance(one).total_cmp(&distance(other)));
        if let Some(place) = known {
            zones[index - 1].to = place;
            zones[index].from = place;
        }
    }
}

/// The segment of a solution with a place on a pulley, and s there.
pub(super) fn locate<P: BeltProblem>(
    solved: &Solved<P>,
    pulley: usize,
    place: f64,
) -> (usize, f64) {
    let (problem, p) = (&solved.problem, solved.solution.parameters());
    let length = |segment| problem.length(segment, p);
    let segments = problem.zones(pulley);
    let (mut segment, mut before) = (segments.start, 0.0);
    while segment + 1 < segments.end && place > before + length(segment) {
        before += length(segment);
        segment += 1;
    }
    (segment, (place - before) / length(segment))
}
