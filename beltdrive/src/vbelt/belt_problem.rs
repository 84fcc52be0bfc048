//! What the way to a steady state knows of a belt round pulleys.

use super::groove::{ANGLE, INCLINATION, LAW, LEAD, PENETRATION};
use super::vector::Yielding;
use super::{
    Contact, Groove, Law, Over, Regime, Units, breakaway_excess, hold_excess, limit_excess,
};
use bvp::{Ends, Problem, Real, Solution};
use std::ops::Range;

/// Which segments of a problem are the zones of which pulley.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Zoning {
    regimes: Vec<Regime>,
    /// Pulley of each segment.
    pulley_of: Vec<usize>,
    /// First segment of each pulley, and the number of segments.
    first: Vec<usize>,
}

impl Zoning {
    /// With these zones on every pulley.
    pub(super) fn new(zones: &[Vec<Regime>]) -> Self {
        let mut zoning = Self::default();
        for (pulley, zones) in zones.iter().enumerate() {
            zoning.first.push(zoning.regimes.len());
            zoning.pulley_of.extend(zones.iter().map(|_| pulley));
            zoning.regimes.extend(zones);
        }
        zoning.first.push(zoning.regimes.len());
        zoning
    }

    /// Number of segments.
    pub(super) fn count(&self) -> usize {
        self.regimes.len()
    }
}

/// A belt round pulleys as a boundary value problem: every zone of friction on a pulley is a segment. Among the
/// parameters are the scaled lengths of all segments, one behind the other.
pub(crate) trait BeltProblem: Problem + Clone {
    /// The zones of all pulleys.
    fn zoning(&self) -> &Zoning;

    /// The constants of the belt on a pulley; `None` unless it lies in a groove with friction.
    fn in_groove(&self, pulley: usize) -> Option<&Groove>;

    /// The states of the law of friction on a segment.
    fn law_states(&self, segment: usize) -> Range<usize> {
        let groove = self.in_groove(self.pulley(segment));
        LAW..groove.map_or(LAW, Groove::states)
    }

    /// Speed ν of the pitch circle of a pulley over that of the unstretched belt.
    fn rim_speed<T: Real>(&self, pulley: usize, p: &[T]) -> T;

    /// The sense of friction along a pulley: 1 where the belt drives it, −1 where it drives the belt, 0 where it
    /// idles.
    fn sense(&self, pulley: usize) -> f64;

    /// Scaled mass flow, and speed of the unstretched belt.
    fn flow<T: Real>(&self, p: &[T]) -> T;

    /// Scaled angular speed of a pulley.
    fn omega<T: Real>(&self, pulley: usize, p: &[T]) -> T {
        self.rim_speed(pulley, p) * self.flow(p)
    }

    /// Index of the length of the first segment among the parameters.
    fn first_length(&self) -> usize;

    /// A parameter that stands behind the lengths, from a solution of the problem with or without it.
    fn behind_lengths(&self, solution: &Solution) -> f64;

    /// The constants that an engineer reads: speeds, mass flow, wraps. Pure numbers of order one.
    fn constants(&self, solution: &Solution) -> Vec<f64>;

    /// Pitch radius of a pulley, m.
    fn pitch_radius(&self, pulley: usize) -> f64;

    /// The units that all pulleys share.
    fn units(&self) -> Units;

    /// The same belt with other zones on every pulley.
    fn with_zones(self, zones: &[Vec<Regime>]) -> Self;

    /// The same belt, and the same zones, with other laws of friction, from the law on a pulley and its radius, m.
    fn with_laws(self, change: impl Fn(Law, f64) -> Law) -> Self;

    /// Number of pulleys.
    fn pulleys(&self) -> usize {
        self.zoning().first.len() - 1
    }

    /// The segments of a pulley, from its entry to its exit.
    fn zones(&self, pulley: usize) -> Range<usize> {
        let first = &self.zoning().first;
        first[pulley]..first[pulley + 1]
    }

    /// The pulley of a segment.
    fn pulley(&self, segment: usize) -> usize {
        self.zoning().pulley_of[segment]
    }

    /// The friction regime of a segment.
    fn regime(&self, segment: usize) -> Regime {
        self.zoning().regimes[segment]
    }

    /// Whether friction on a segment is of the same kind as on the one in front of it on the same pulley.
    fn is_cut(&self, segment: usize) -> bool {
        let zones = self.zones(self.pulley(segment));
        segment > zones.start && self.regime(segment - 1) == self.regime(segment)
    }

    /// The friction regimes along every pulley.
    fn regimes(&self) -> Vec<Vec<Regime>> {
        let zones = (0..self.pulleys()).map(|pulley| self.zones(pulley));
        zones
            .map(|zones| self.zoning().regimes[zones].to_vec())
            .collect()
    }

    /// Scaled length of a segment.
    fn length<T: Real>(&self, segment: usize, p: &[T]) -> T {
        p[self.first_length() + segment]
    }

    /// Scaled length of the contact with a pulley.
    fn contact_length<T: Real>(&self, pulley: usize, p: &[T]) -> T {
        let zones = self.zones(pulley);
        zones.map(|segment| self.length(segment, p)).sum()
    }

    /// The law in the grooves.
    fn law(&self) -> Law {
        let mut grooves = (0..self.pulleys()).filter_map(|pulley| self.in_groove(pulley));
        let groove = grooves.next();
        groove
            .expect("a belt that turns once has a pulley inside")
            .law
    }

    /// The length ℓ/R over which the direction follows the slip, or the normalisation ε; zero for bristles.
    fn smoothing(&self) -> f64 {
        self.law().smoothing()
    }

    /// Whether the direction of the traction is a state.
    fn has_direction(&self) -> bool {
        matches!(self.law(), Law::Sliding { .. })
    }

    /// Whether the law of friction has elastic and slip zones.
    fn has_zones(&self) -> bool {
        let law = self.law();
        law.elastic().is_some() || matches!(law, Law::Vector { .. })
    }

    /// Whether those zones are segments.
    fn is_split(&self) -> bool {
        let mut grooves = (0..self.pulleys()).filter(|&pulley| self.in_groove(pulley).is_some());
        let blurred = |segment| self.regime(segment) == Regime::Either;
        self.has_zones() && !grooves.any(|pulley| self.zones(pulley).any(blurred))
    }

    /// Whether the belt sticks on a pulley.
    fn sticks(&self) -> bool {
        self.zoning().regimes.contains(&Regime::Stick)
    }

    /// Whether elastic friction is reversed on a pulley right in front of the place at which the belt comes to rest, and is not
    /// reversed back behind it.
    fn stays_reversed(&self) -> bool {
        (0..self.pulleys()).any(|pulley| {
            let zones = &self.zoning().regimes[self.zones(pulley)];
            let last = zones.iter().rposition(|&zone| zone == Regime::Reversed);
            last.is_some_and(|last| zones.get(last + 1) == Some(&Regime::Stick))
        })
    }

    /// The segment at whose end the belt breaks away on a pulley, if it does: the turn lies behind it.
    fn breakaway(&self, pulley: usize) -> Option<usize> {
        let mut cuts = self.zones(pulley).filter(|&segment| self.is_cut(segment));
        let first = cuts.next()?;
        cuts.next().map(|_| first - 1)
    }

    /// Whether the belt sticks on a pulley or breaks away there, so that it hardly slips in front of a place.
    fn is_locked(&self) -> bool {
        self.sticks() || (0..self.pulleys()).any(|pulley| self.breakaway(pulley).is_some())
    }

    /// Whether its segments meet where something happens to friction that a solution shows.
    fn has_junctions(&self) -> bool {
        self.is_split() || (self.has_direction() && !self.has_zones())
    }

    /// The same belt with another ℓ/R or ε. Bristles stay as they are.
    fn with_smoothing(self, smoothing: f64) -> Self {
        self.with_laws(|law, _| law.with_smoothing(smoothing))
    }

    /// The same belt with friction whose direction is a state, or that of the slip normalised by ε. Other laws
    /// stay as they are.
    fn with_direction(self, is_state: bool) -> Self {
        self.with_laws(|law, _| law.with_direction(is_state))
    }

    /// The same belt with EPP friction blended into Coulomb friction by `share` in \[0, 1\]. Coulomb and bristle
    /// friction stay as they are.
    fn with_epp_weight(self, share: f64) -> Self {
        self.with_laws(|mut law, _| {
            if let Some(elastic) = law.elastic_mut() {
                elastic.weight = share;
            }
            law
        })
    }

    /// The same belt with the traction following the slip, with a lead or without.
    fn led(self, is_led: bool) -> Self {
        self.with_laws(|mut law, _| {
            if let Law::Sliding { lead, .. } = &mut law {
                *lead = if is_led { LEAD } else { 0.0 };
            }
            law
        })
    }

    /// The same belt with bristles of the stiffness κ, 1/m.
    fn with_bristles(self, stiffness: f64) -> Self {
        self.with_laws(|law, radius| Law::Bristle {
            stiffness: stiffness * radius,
            elastic: law.elastic(),
        })
    }

    /// The same belt with bristles this many times as stiff. Other laws stay as they are.
    fn with_stiffer_bristles(self, times: f64) -> Self {
        self.with_laws(|mut law, _| {
            if let Law::Bristle { stiffness, .. } = &mut law {
                *stiffness *= times;
            }
            law
        })
    }
}

/// The conditions on the belt in a groove that do not depend on what is around the pulley, each given to `zero`.
///
/// ```text
/// conditions with z zones and n states                                          number
///   x = 0                                        at entry and exit              2
///   φ = 0, γ along the slip, u = 0 or B = 0, …   at entry                       n − 3
///   every state continuous, and the junction     at each junction of zones    (z − 1)(n + 1)
/// ```
///
/// A junction is where `k_f` |u| = μ p if elastic and slipping friction meet there, and where u = 0 if it changes its sign
/// there. Where the belt begins to stick it has no slip, and friction straight up the groove just holds it; it breaks
/// loose in a direction of its own. Else the last junction lies in the middle of the turn of the traction that lifts the belt (see
/// `Contact::turn_excess`), and one in front of that where the belt breaks away (see `breakaway_excess`).
pub(super) fn in_groove<S: Real, T: Over<S>>(
    problem: &impl BeltProblem,
    (pulley, groove): (usize, &Groove<S>),
    at: &Ends<'_, T>,
    p: &[T],
    mut zero: impl FnMut(T),
) {
    let (rim_speed, flow) = (problem.rim_speed(pulley, p), problem.flow(p));
    let contact = |segment, y: &[T]| {
        let regime = problem.regime(segment);
        Contact::new(groove, regime, y, rim_speed, flow)
    };
    let zones = problem.zones(pulley);
    let (entry, exit) = (at.start(zones.start), at.end(zones.end - 1));
    zero(entry[PENETRATION]);
    zero(exit[PENETRATION]);
    zero(entry[ANGLE]);
    let law = match groove.law {
        Law::Sliding { .. } => {
            zero(contact(zones.start, entry).misalignment());
            &entry[LAW + 1..]
        }
        Law::Vector { .. } => {
            let contact = contact(zones.start, entry);
            let yielding = Yielding::new(&contact, groove, entry);
            let entering = yielding.map(|yielding| yielding.entering());
            entering.into_iter().flatten().for_each(&mut zero);
            &entry[LAW + 2..]
        }
        _ => &entry[LAW..],
    };
    for &state in law {
        zero(state);
    }
    for next in zones.start + 1..zones.end {
        let (y, after) = (at.end(next - 1), at.start(next));
        let [before, behind] = [next - 1, next].map(|segment| problem.regime(segment));
        for (index, (&y, &after)) in y.iter().zip(after).enumerate() {
            if before != Regime::Stick || index != LAW {
                zero(after - y);
            }
        }
        if behind == Regime::Stick {
            let [along, across] = contact(next, after).slip;
            zero(along);
            zero(across);
        }
        match (before, behind) {
            (Regime::Stick, _) => {}
            (before, Regime::Stick) => zero(hold_excess(groove, before, y, rim_speed, flow)),
            _ if problem.is_cut(next) => zero(
                match (next + 1..zones.end).any(|next| problem.is_cut(next)) {
                    true => breakaway_excess(y[LAW]),
                    false => contact(next, y).turn_excess(groove),
                },
            ),
            // The scaled friction: the displacement itself is small where friction is stiff.
            (before, behind) if before.is_elastic() && behind.is_elastic() => {
                if let Some(elastic) = groove.elastic() {
                    zero(y[groove.displacement()] * elastic.stiffness);
                }
            }
            // An elastic zone without length would meet it, too, and twice.
            (Regime::Elastic, _) if matches!(groove.law, Law::Vector { .. }) => {
                let length = problem.length(next - 1, p);
                zero(limit_excess(groove, before, y, rim_speed, flow) / (length * length));
            }
            _ => zero(limit_excess(groove, before, y, rim_speed, flow)),
        }
    }
}

/// Inclinations at the ends of a contact in a groove.
pub(super) fn end_angles<T: Real>(
    problem: &impl BeltProblem,
    pulley: usize,
    at: &Ends<'_, T>,
) -> super::EndAngles<T> {
    let zones = problem.zones(pulley);
    super::EndAngles {
        entry: at.start(zones.start)[INCLINATION],
        exit: at.end(zones.end - 1)[INCLINATION],
    }
}

#[cfg(test)]
pub(super) mod tests {
    use bvp::Problem;

    /// Checks that a segment depends on few of these parameters, and that the others change no right-hand side.
    pub(in crate::vbelt) fn assert_dependences(problem: &impl Problem, p: &[f64]) {
        for (index, segment) in problem.segments().iter().enumerate() {
            let y = vec![0.1; segment.states];
            let rates = |p: &[f64]| {
                let mut dy = vec![f64::NAN; segment.states];
                problem.rhs(index, 0.0, &y, p, &mut dy);
                dy
            };
            let here = rates(p);
            let (on, others): (Vec<usize>, Vec<usize>) =
                (0..p.len()).partition(|&parameter| problem.depends(index, parameter));
            assert!((2..=4).contains(&on.len()), "{on:?}");
            for parameter in others {
                let mut moved = p.to_vec();
                moved[parameter] *= 1.25;
                assert_eq!(
                    rates(&moved),
                    here,
                    "parameter {parameter} of segment {index}"
                );
            }
        }
    }
}
