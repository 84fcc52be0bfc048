//! The tensioner: its equilibrium, its stiffness and how well it holds the tension.

use crate::drive::layout::Layout;
use crate::mechanics::root::{bracketed, near_with_slope};
use crate::{Drive, Guide, SolveError, Tensioner};
use nalgebra::Vector2;
use std::f64::consts::TAU;

/// Largest step of the search for an equilibrium: half a radius of the idler, at most this angle in rad.
/// Two equilibria within one step are missed.
const LARGEST_ANGLE: f64 = 0.05;

/// The first step is the largest one divided by this; steps are doubled.
const FIRST_STEP: f64 = 16.0;

/// The same where the slope points the way, beyond the largest step.
const FIRST_AHEAD: f64 = 4.0;

/// The last step of the secant method, relative to the largest step. Its error is about this times the step
/// before.
const NEAR: f64 = 1e-9;

/// Belt and tensioner are in equilibrium if their forces differ by no more than this, relative: a hundredth of what
/// the state is checked to.
pub(crate) const BALANCED: f64 = 1e-11;

/// A step towards an equilibrium leaves no more than this of the force, or half of it is tried: half a step of Newton's
/// method leaves half.
const SHARPER: f64 = 0.75;

/// Most steps of a search: 500 radii of an idler on a straight guide.
const STEPS: usize = 1000;

/// Which way a search begins.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Towards {
    /// Where the idler is pushed: the length of the belt is given and its tension follows.
    Force,
    /// Where the equilibrium lies by Newton's method: the tension is given and the length follows.
    Newton,
}

/// First and second derivative of the length of the loop with the coordinate of the tensioner.
pub(crate) fn length_derivatives(
    layout: &Layout,
    pulley: usize,
    guide: &Guide,
    coordinate: f64,
) -> [f64; 2] {
    let [_, velocity, acceleration] = guide.centre(coordinate).map(Vector2::from);
    let gradient = Vector2::from(layout.length_gradient(pulley));
    let turning = layout.spans_of(pulley).map(|span| {
        let across = span.normal().dot(&velocity);
        across * across / span.length
    });
    [
        gradient.dot(&velocity),
        turning[0] + turning[1] + gradient.dot(&acceleration),
    ]
}

/// The largest step of a search for the coordinate of a tensioner on a pulley with a radius in m; rad or m.
pub(crate) fn largest_step(radius: f64, guide: &Guide) -> f64 {
    match guide {
        Guide::Rotary { arm_length, .. } => (0.5 * radius / arm_length).min(LARGEST_ANGLE),
        Guide::Translating { .. } => 0.5 * radius,
    }
}

/// How well doubles tell where an idler is against the other pulleys of a belt, m: its centre, a difference of
/// centres, its norm and a difference of radii are a dozen roundings of half the machine precision each.
pub(crate) fn resolution(layout: &Layout, guide: &Guide) -> f64 {
    let reach = match *guide {
        Guide::Rotary { arm_length, .. } => arm_length,
        Guide::Translating { origin, .. } => Vector2::from(origin).norm(),
    };
    let pulleys = layout.pulleys().iter();
    let extents = pulleys.map(|pulley| Vector2::from(pulley.centre).norm() + pulley.radius);
    6.0 * f64::EPSILON * extents.fold(reach, f64::max)
}

/// The coordinate nearest to `start`, in the direction in which the idler goes from there, at which the
/// load Q(q) of the tensioner and the belt are in equilibrium: Q − `F_t` dL/dq = 0; and the belt there.
/// `layout` is the belt at `start`.
/// `tractive` gives `F_t` in N, and about how fast it grows with the length of the loop, N/m.
pub(crate) fn equilibrium(
    drive: &Drive,
    (start, mut layout): (f64, Layout),
    towards: Towards,
    which: &'static str,
    tractive: impl FnMut(&Layout) -> Result<[f64; 2], SolveError>,
) -> Result<(f64, Layout), SolveError> {
    let Some(carried) = drive.tensioner() else {
        return Ok((start, layout));
    };
    let search = Search {
        drive,
        carried,
        towards,
        which,
    };
    let coordinate = search.coordinate(start, &mut layout, tractive)?;
    search.move_to(&mut layout, coordinate)?;
    Ok((coordinate, layout))
}

/// The search for an equilibrium.
struct Search<'l> {
    drive: &'l Drive,
    /// The index of the pulley on the tensioner, and that.
    carried: (usize, &'l Tensioner),
    towards: Towards,
    which: &'static str,
}

impl Search<'_> {
    fn move_to(&self, layout: &mut Layout, coordinate: f64) -> Result<(), SolveError> {
        let (pulley, tensioner) = self.carried;
        let [centre, ..] = tensioner.guide.centre(coordinate);
        Ok(layout.move_pulley(pulley, centre)?)
    }

    fn coordinate(
        &self,
        start: f64,
        layout: &mut Layout,
        mut tractive: impl FnMut(&Layout) -> Result<[f64; 2], SolveError>,
    ) -> Result<f64, SolveError> {
        let Self {
            drive,
            towards,
            which,
            ..
        } = *self;
        let (pulley, tensioner) = self.carried;
        let name = || drive.pulleys[pulley].name.clone();
        let guide = &tensioner.guide;
        // Smaller steps tell no more of where the belt can no longer be laid round the pulleys.
        let [_, velocity, _] = guide.centre(start).map(Vector2::from);
        let smallest = resolution(layout, guide) / velocity.norm();
        // Force along the coordinate, and about its slope.
        let mut force = |coordinate: f64| -> Result<[f64; 2], SolveError> {
            self.move_to(layout, coordinate)?;
            let [slope, curvature] = length_derivatives(layout, pulley, guide, coordinate);
            let [tension, per_length] = tractive(layout)?;
            let [load, load_slope] = tensioner.load_at(coordinate);
            Ok([
                load - tension * slope,
                load_slope - tension * curvature - per_length * slope * slope,
            ])
        };
        let largest = largest_step(drive.pulleys[pulley].radius, guide);
        let longest = match guide {
            Guide::Rotary { .. } => TAU,
            Guide::Translating { .. } => f64::INFINITY,
        };
        let [at_start, slope] = force(start)?;
        if at_start == 0.0 {
            return Ok(start);
        }
        let direction = match towards {
            Towards::Newton if slope > 0.0 => -at_start.signum(),
            _ => at_start.signum(),
        };
        let first = match -at_start / slope * direction > 0.0 {
            true => largest / FIRST_AHEAD,
            false => largest / FIRST_STEP,
        };
        let (mut step, mut here, mut slope) = (first, (start, at_start), slope);
        for _ in 0..STEPS {
            // At once, if it lies within one step.
            let ends =
                [-NEAR * largest, (1.0 + NEAR) * largest].map(|way| here.0 + direction * way);
            let ends = [ends[0].min(ends[1]), ends[0].max(ends[1])];
            let (start, precision) = (here.0, NEAR * largest);
            let at = |coordinate: f64| match coordinate == here.0 {
                true => Some(here.1),
                false => force(coordinate).ok().map(|[force, _]| force),
            };
            if let Some(found) = near_with_slope(at, start, slope, ends, precision) {
                let load = |coordinate: f64| tensioner.load_at(coordinate)[0];
                return sharpened(&mut force, load, found, smallest);
            }
            let next = here.0 + direction * step;
            match force(next) {
                Err(error) => {
                    step *= 0.5;
                    if step < smallest {
                        within_travel(drive, here.0)?;
                        return Err(error);
                    }
                }
                Ok([at_next, _]) if (at_next > 0.0) != (at_start > 0.0) => {
                    let at = |coordinate| force(coordinate).map_or(f64::NAN, |[force, _]| force);
                    if let Some(found) = bracketed(at, [here.0, next], [here.1, at_next]) {
                        return Ok(found);
                    }
                    // Between the two the belt cannot be laid round the pulleys.
                    step *= 0.5;
                    if step < smallest {
                        return Err(SolveError::NotFound {
                            what: "coordinate of the tensioner",
                        });
                    }
                }
                Ok([at_next, slope_next]) => {
                    (here, slope) = ((next, at_next), slope_next);
                    step = (2.0 * step).min(largest);
                }
            }
            if (here.0 - start).abs() > longest {
                break;
            }
        }
        within_travel(drive, here.0)?;
        Err(SolveError::NoEquilibrium {
            pulley: name(),
            which,
        })
    }
}

/// A coordinate near an equilibrium, or one where the force vanishes against the load of the tensioner, as far as
/// steps above the smallest lead: where a span at the idler is short, the force changes so fast that a precise
/// coordinate is not enough.
fn sharpened(
    mut force: impl FnMut(f64) -> Result<[f64; 2], SolveError>,
    load: impl Fn(f64) -> f64,
    near: f64,
    smallest: f64,
) -> Result<f64, SolveError> {
    let mut coordinate = near;
    let [mut off, mut slope] = force(near)?;
    let mut step = -off / slope;
    while off.abs() > BALANCED * load(coordinate).abs() && step.abs() > smallest {
        match force(coordinate + step) {
            Ok([off_next, slope_next]) if off_next.abs() < SHARPER * off.abs() => {
                coordinate += step;
                (off, slope) = (off_next, slope_next);
                step = -off / slope;
            }
            // Too far, perhaps beyond where the belt can be laid: the force changes like the length of a span, which
            // is the square root of the way to there.
            _ => step *= 0.5,
        }
    }
    Ok(coordinate)
}

/// Whether the tensioner is between its stops.
pub(crate) fn within_travel(drive: &Drive, coordinate: f64) -> Result<(), SolveError> {
    match drive.tensioner() {
        Some((
            pulley,
            Tensioner {
                travel: Some(travel),
                ..
            },
        )) if coordinate < travel[0] || coordinate > travel[1] => {
            Err(SolveError::TensionerBeyondTravel {
                pulley: drive.pulleys[pulley].name.clone(),
                coordinate,
                travel: *travel,
            })
        }
        _ => Ok(()),
    }
}

/// The tensioner held at a coordinate by a belt of uniform tension.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Held {
    /// dL/dq and d²L/dq².
    pub(crate) length_derivatives: [f64; 2],
    /// K = k + `F_t` d²L/dq² + (EA/`L_0`) (dL/dq)², against a slow displacement, with k = −dQ/dq of the load
    /// Q of the tensioner; N·m/rad or N/m.
    pub(crate) stiffness: f64,
    /// η = 1/(1 + (k + `F_t` d²L/dq²) `L_0`/(EA (dL/dq)²)) (Beikmann, Perkins and Ulsoy 1996).
    pub(crate) constant: f64,
}

impl Held {
    /// With the tractive tension `F_t` of the idler, N, and the length `L_0` of the unstretched belt, m.
    pub(crate) fn new(
        drive: &Drive,
        (pulley, tensioner): (usize, &Tensioner),
        layout: &Layout,
        coordinate: f64,
        tractive: f64,
        unstretched: f64,
    ) -> Self {
        let derivatives = length_derivatives(layout, pulley, &tensioner.guide, coordinate);
        let [_, load_slope] = tensioner.load_at(coordinate);
        let stiffness = drive.belt.axial_stiffness / unstretched;
        Self::by(derivatives, load_slope, tractive, stiffness)
    }

    /// With dL/dq and d²L/dq², the derivative of the load of the tensioner, the tractive tension of the
    /// idler in N, and the tension of the belt per length that is taken up, N/m: EA/`L_0`.
    pub(crate) fn by(
        derivatives: [f64; 2],
        load_slope: f64,
        tractive: f64,
        stiffness: f64,
    ) -> Self {
        let [slope, curvature] = derivatives;
        let by_spring = tractive * curvature - load_slope;
        let by_belt = stiffness * slope * slope;
        Self {
            length_derivatives: derivatives,
            stiffness: by_spring + by_belt,
            constant: by_belt / (by_belt + by_spring),
        }
    }
}
