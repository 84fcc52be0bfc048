//! Orders of convergence on uniform meshes, with the zones as segments and with the kink of friction
//! inside a segment.

use super::super::*;
use super::drive;
use crate::SpanTension::Belt;
use bvp::{Control, Guess, Problem};
use start::Start;

/// Numbers of intervals a segment, doubling: of the table, and where zones are segments also of the fit.
const DOUBLING: [usize; 6] = [2, 4, 8, 16, 32, 64];
/// Numbers of intervals of the fit where the kink is inside a segment: errors jump with its place among
/// the nodes, so that doubled meshes alone say little.
const MANY: [usize; 15] = [8, 10, 12, 14, 17, 20, 24, 29, 35, 42, 50, 60, 72, 86, 103];
/// Errors below are rounding.
const SMALLEST: f64 = 2e-13;

/// The solution on so many equal intervals per segment. The loosest tolerance and no room for another
/// mesh keep the mesh; the second call polishes what so loose a tolerance leaves of Newton's iteration.
fn on_uniform_mesh(
    problem: &Formulation,
    guess: &dyn Guess,
    scheme: Scheme,
    intervals: usize,
) -> Option<Solution> {
    let options = Options {
        tolerance: 1e-1,
        scheme: Some(scheme),
        initial_intervals: intervals,
        max_intervals: intervals * problem.segments().len(),
        control: Control::Defect,
        retries: 0,
        ..Options::default()
    };
    let mut found = bvp::solve(problem, guess, &options).ok()?;
    for _ in 0..2 {
        found = bvp::solve(problem, &found, &options).ok()?;
    }
    (found.stats().meshes == 1).then_some(found)
}

/// The error at the nodes, root mean square, of tension and displacement, and that of the parameters.
fn error(problem: &Formulation, found: Solution, exact: &ClosedForm) -> f64 {
    let found = BoundaryValue {
        formulation: problem.clone(),
        solution: found,
    };
    let (mut squares, mut count) = (0.0, 0);
    for pulley in [DRIVEN, DRIVER] {
        let contact = &exact.contact[pulley];
        let last = contact.end(&contact.zones[contact.zones.len() - 1]);
        for (segment, zone) in found.formulation.zones(pulley).zip(found.bordered(pulley)) {
            let nodes = found.solution.mesh(segment);
            for node in 0..nodes.len() {
                let y = found.solution.node(segment, node);
                let place = found.place(segment, y);
                // The same share of the zone, or, where zones are not told apart, the same place.
                let index = segment - found.formulation.zones(pulley).start;
                let zoned = found.bordered(pulley).len() == contact.zones.len();
                let s = place.arc_length;
                let expected = match zoned {
                    true => contact.at(
                        &contact.zones[index],
                        (s - zone.from) / (zone.to - zone.from),
                    ),
                    false => {
                        let zone = contact.zones.iter().find(|zone| s <= zone.end + 1e-12);
                        let zone = zone.unwrap();
                        let from = zone.start.arc_length;
                        contact.at(zone, (s - from) / (zone.end - from))
                    }
                };
                let tension = contact.arc.belt.tension(expected.traction);
                squares += ((place.tension - tension) / tension).powi(2);
                let u = place.displacement.abs() - expected.displacement;
                squares += (u / last.displacement).powi(2);
                count += 2;
            }
        }
        let reference = contact.arc.belt.tension(contact.reference());
        squares += (found.reference(pulley) / reference - 1.0).powi(2) * f64::from(count);
    }
    (squares / f64::from(count)).sqrt()
}

/// The errors on meshes.
fn errors(
    problem: &Formulation,
    scheme: Scheme,
    exact: &ClosedForm,
    meshes: &[usize],
) -> Vec<(usize, f64)> {
    let start = Start::new(problem);
    let on = |&n: &usize| {
        let found = on_uniform_mesh(problem, &start, scheme, n)?;
        Some((n, error(problem, found, exact)))
    };
    meshes.iter().filter_map(on).collect()
}

/// The slope of ln error over ln h by least squares, over the errors that are not rounding.
fn slope(errors: &[(usize, f64)]) -> f64 {
    let useful = errors.iter().filter(|(_, error)| *error > SMALLEST);
    let points: Vec<_> = useful.map(|&(n, e)| (-(n as f64).ln(), e.ln())).collect();
    let count = points.len() as f64;
    assert!(count > 2.0, "{errors:?}");
    let mean = |f: fn(&(f64, f64)) -> f64| points.iter().map(f).sum::<f64>() / count;
    let (x, y) = (mean(|p| p.0), mean(|p| p.1));
    let covariance: f64 = points.iter().map(|p| (p.0 - x) * (p.1 - y)).sum();
    covariance / points.iter().map(|p| (p.0 - x).powi(2)).sum::<f64>()
}

#[test]
fn zones_as_segments_keep_the_order_that_a_kink_inside_a_segment_destroys() {
    let law = FrictionLaw::Epp { stiffness: 1e8 };
    let drive = drive(law, NormalForce::Inertia, Belt(156.2), Belt(2500.0));
    let exact = ClosedForm::find(&drive).unwrap();
    let zoned = formulation_of(&drive).unwrap();
    assert!([DRIVEN, DRIVER].map(|pulley| zoned.zones(pulley).len()) == [2, 2]);
    let columns = DOUBLING.map(|n| format!("{n:7}")).join(" ");
    println!("{:28} order {columns} intervals", "");
    for scheme in [
        Scheme::LobattoIIIA { stages: 3 },
        Scheme::Gauss { stages: 3 },
        Scheme::Gauss { stages: 4 },
    ] {
        for problem in [&zoned, &zoned.unzoned()] {
            let is_zoned = problem.segments().len() == 4;
            let doubling = errors(problem, scheme, &exact, &DOUBLING);
            let order = match is_zoned {
                true => slope(&doubling),
                false => slope(&errors(problem, scheme, &exact, &MANY)),
            };
            let cell = |n| {
                let found = doubling.iter().find(|(intervals, _)| *intervals == n);
                found.map_or(format!("{:>7}", "-"), |(_, error)| format!("{error:7.1e}"))
            };
            let kind = if is_zoned { "zones" } else { "kink" };
            let (name, stages) = (format!("{scheme:?}"), scheme.stages());
            let family = name.split(' ').next().unwrap_or_default();
            let cells = DOUBLING.map(cell).join(" ");
            println!(
                "{family:11} {stages} order {} {kind:5} {order:6.2} {cells}",
                scheme.order()
            );
            match is_zoned {
                true => assert!((order - scheme.order() as f64).abs() < 0.2, "{order}"),
                false => assert!((1.0..2.5).contains(&order), "{order}"),
            }
        }
    }
}
