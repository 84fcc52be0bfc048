//! The first guess where a belt sticks, slips and sticks again.
//!
//! With three zones on the driven pulley a slip zone of no length, with elastic friction above its limit
//! around it, satisfies every condition too, and a rough guess of lengths is as close to it as to the
//! steady state. A coarse solution that does not tell zones apart has no such twin. Such a belt has soft
//! bristles and thus no thin layers.

use super::super::{DRIVEN, DRIVER};
use super::Failure;
use super::formulation::{DISPLACEMENT, EXCESS, Formulation, LENGTHS};
use super::start::{Line, Start};
use crate::ZoneKind;
use bvp::{Control, Options, Scheme, Solution};

/// Tolerance of the coarse solution.
const TOLERANCE: f64 = 1e-2;
/// Places of a pulley at which slip is looked for.
const PLACES: usize = 100;

/// The first guess of a problem, by a coarse solution where it has three zones on a pulley.
pub(super) fn first_guess(problem: &Formulation) -> Result<Start, Failure> {
    let has_three = |pulley: usize| problem.zones(pulley).len() > 2;
    if !has_three(DRIVEN) && !has_three(DRIVER) {
        return Ok(Start::new(problem));
    }
    let unzoned = problem.unzoned();
    let options = Options {
        tolerance: TOLERANCE,
        scheme: Some(Scheme::Gauss { stages: 2 }),
        control: Control::Defect,
        ..Options::default()
    };
    let coarse = bvp::solve(&unzoned, &Start::new(&unzoned), &options)?;
    let p = coarse.parameters();
    let mut start = Start {
        zones: Vec::new(),
        parameters: p[..LENGTHS].to_vec(),
        mesh: None,
    };
    for pulley in [DRIVEN, DRIVER] {
        let borders = borders(&unzoned, &coarse, pulley);
        if borders.len() != problem.zones(pulley).len() + 1 {
            return Err(Failure::OtherZones);
        }
        for (segment, ends) in problem.zones(pulley).zip(borders.windows(2)) {
            let kind = problem.kind(segment);
            let ratio = |unit: &dyn Fn(ZoneKind) -> f64| unit(ZoneKind::Elastic) / unit(kind);
            let excess = ratio(&|kind| problem.units.excess(pulley, kind));
            let displacement = ratio(&|kind| problem.units.displacement(pulley, kind));
            let state = |place: f64| {
                let mut y = [0.0; 3];
                coarse.state(pulley, place, &mut y);
                y[EXCESS] *= excess;
                y[DISPLACEMENT] *= displacement;
                y
            };
            start.zones.push(Line {
                from: state(ends[0]),
                to: state(ends[1]),
                rate: 0.0,
                length: p[LENGTHS + pulley] * (ends[1] - ends[0]),
            });
        }
    }
    let lengths = start.zones.iter().map(|zone| zone.length);
    start.parameters.extend(lengths);
    Ok(start)
}

/// Where zones of a pulley begin and end in a solution that does not tell them apart, from 0 to 1.
fn borders(unzoned: &Formulation, coarse: &Solution, pulley: usize) -> Vec<f64> {
    let place = |i: usize| i as f64 / PLACES as f64;
    let slips = |i: usize| {
        let mut y = [0.0; 3];
        coarse.state(pulley, place(i), &mut y);
        let elastic = y[DISPLACEMENT] * unzoned.friction_coefficient;
        let limit = unzoned.friction(pulley, ZoneKind::Slip, &y, coarse.parameters());
        elastic.abs() > limit.abs()
    };
    let changes = (0..PLACES).filter(|&i| slips(i) != slips(i + 1));
    let mut borders = vec![0.0];
    borders.extend(changes.map(|i| place(i) + 0.5 * place(1)));
    borders.push(1.0);
    borders
}
