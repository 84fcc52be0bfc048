//! Small motions about a state: the rates linearised, with the cells held in which the belt slips.
//!
//! Where the belt slips, the displacement of the bristles is at its largest, μ n λ/`k_f`, and follows stretch and
//! speed of the belt; where it sticks, it is an unknown. The edge between the two does not move: what it would add is
//! of second order, since friction is continuous there.

use super::bristle::weights;
use super::rates::Rates;
use faer::Mat;

/// The linearised rates y′ = A y, and what the unknowns are.
///
/// The unknowns are scaled so that half the square of each is an energy: the strain energy of a cell and of its
/// bristles, the kinetic energy of a face and of a pulley.
pub(crate) struct Linearised {
    /// The matrix A, 1/s.
    pub(crate) matrix: Mat<f64>,
    /// Of each unknown, the scale by which it is divided: what one has of the energy 1/2 J.
    pub(crate) scales: Vec<f64>,
    /// Where the unknowns of velocity at the faces begin, one for each; those of density in the cells stand before.
    pub(crate) velocity: usize,
    /// The unknown of the speed of each pulley; none where it is given.
    pub(crate) speed: Vec<Option<usize>>,
}

/// Entries of a row: unknowns and derivatives.
type Row = Vec<(usize, f64)>;

/// Linearises the rates about the last state for which they were computed. `slips` says of the cells of all arcs
/// whether the belt slips there. The belt runs forward.
pub(crate) fn linearised(rates: &Rates<'_>, state: &[f64], slips: &[bool]) -> Linearised {
    let system = rates.system;
    let (mesh, parts) = (&system.mesh, &system.parts);
    let cells = mesh.cells();
    let density = &state[parts.density.clone()];
    let velocity = &state[parts.velocity.clone()];
    let bristles = &state[parts.bristle.clone()];
    let speeds = &state[parts.speed.clone()];
    let mut unknowns = 2 * cells;
    let mut next = |is_unknown: bool| {
        let place = unknowns;
        unknowns += usize::from(is_unknown);
        is_unknown.then_some(place)
    };
    let of_bristle: Vec<_> = slips.iter().map(|slips| next(!slips)).collect();
    let wheels = system.wheels.iter().zip(speeds);
    let slopes: Vec<_> = { wheels }
        .map(|(wheel, &speed)| wheel.axle.slope(speed))
        .collect();
    let speed: Vec<_> = slopes.iter().map(|slope| next(slope.is_some())).collect();
    let of_velocity = |face: usize| cells + face % cells;
    // Stretch, its rate and the velocity in the middle of a cell.
    let stretch = |cell: usize| rates.stretch[cell + 1];
    let before = |cell: usize| (cell + cells - 1) % cells;

    let mut rows: Vec<Row> = vec![vec![]; unknowns];
    // Displacement of the bristles in the cells of all arcs, and the friction q h of all cells.
    let mut displaced: Vec<Row> = vec![vec![]; slips.len()];
    let mut friction: Vec<Row> = vec![vec![]; cells];
    for (pulley, wheel) in system.wheels.iter().enumerate() {
        let per_cap = wheel.friction_coefficient / (wheel.radius * system.friction_stiffness);
        for (cell, bristle) in mesh.arcs[pulley].clone().zip(mesh.bristles[pulley].clone()) {
            displaced[bristle] = match of_bristle[bristle] {
                Some(unknown) => vec![(unknown, 1.0)],
                None if rates.caps[bristle] > 0.0 => {
                    let per_cap = per_cap * bristles[bristle].signum();
                    let stretch = stretch(cell);
                    let per_density =
                        system.axial_stiffness * (1.0 - 2.0 * stretch) * stretch * stretch;
                    let per_speed = -per_cap * system.mass * rates.middle[cell];
                    vec![
                        (cell, per_cap * per_density),
                        (of_velocity(cell), per_speed),
                        (of_velocity(cell + 1), per_speed),
                    ]
                }
                None => vec![],
            };
            let stiffness = system.friction_stiffness * mesh.lengths[cell];
            friction[cell] = times(&displaced[bristle], stiffness);
        }
    }
    for face in 0..cells {
        let [behind, ahead] = [before(face), face];
        // Density: the flow through the face leaves one cell and enters the other.
        let [share_behind, share_ahead] = rates.shares[face];
        let on_face = share_behind * density[face] + share_ahead * density[face + 1];
        let flux = [
            (of_velocity(face), on_face),
            (behind, velocity[face] * share_behind),
            (ahead, velocity[face] * share_ahead),
        ];
        rows[ahead].extend(times(&flux, rates.per_cell[ahead]));
        rows[behind].extend(times(&flux, -rates.per_cell[behind]));
        // Momentum.
        let row = of_velocity(face);
        let per_mass = rates.per_mass[face];
        let damping = 0.5 * system.axial_damping;
        let both = stretch(behind) + stretch(ahead);
        let relative = rates.stretching[face + 1] - rates.stretching[face];
        for (cell, sign) in [(behind, -1.0), (ahead, 1.0)] {
            let stretch = stretch(cell);
            let per_stretch = -stretch * stretch;
            let elastic = system.axial_stiffness * stretch;
            let stretching = rates.stretching[cell + 1];
            // The rate of stretch λ Δv/h in proportion to λ and to Δv.
            let damped = damping * (relative + sign * both * stretching / stretch);
            rows[row].push((cell, per_mass * per_stretch * (sign * elastic + damped)));
            let inertia = -0.5 * system.mass * rates.middle[cell];
            let rate = damping * both * stretch * rates.per_cell[cell];
            rows[row].push((of_velocity(cell), per_mass * sign * (inertia - rate)));
            rows[row].push((of_velocity(cell + 1), per_mass * sign * (inertia + rate)));
            rows[row].extend(times(&friction[cell], -0.5 * per_mass));
        }
    }
    for pulley in 0..mesh.arcs.len() {
        let radius = system.wheels[pulley].radius;
        let (arc, bristle) = (&mesh.arcs[pulley], &mesh.bristles[pulley]);
        let rim = speed[pulley];
        for index in 0..arc.len() {
            let Some(row) = of_bristle[bristle.start + index] else {
                continue;
            };
            let cell = arc.start + index;
            let (first, weights) = weights(index, arc.len());
            let per_six = rates.per_cell[cell] / 6.0;
            let mut difference = 0.0;
            for (at, weight) in weights.into_iter().enumerate() {
                let weight = weight * per_six;
                let near = bristle.start + first + at;
                difference += weight * bristles[near];
                let carried = -rates.middle[cell] * weight;
                rows[row].extend(times(&displaced[near], carried));
            }
            for face in [cell, cell + 1] {
                rows[row].push((of_velocity(face), 0.5 * (1.0 - difference)));
            }
            rows[row].extend(rim.map(|rim| (rim, -radius)));
        }
        if let (Some(row), Some(slope)) = (rim, slopes[pulley]) {
            let per_inertia = system.wheels[pulley].axle.inertia.recip();
            for (cell, bristle) in arc.clone().zip(bristle.clone()) {
                let force = system.friction_stiffness * bristles[bristle] * mesh.lengths[cell];
                rows[row].push((cell, radius * per_inertia * force));
                let at_rim = radius * per_inertia * density[cell + 1];
                rows[row].extend(times(&friction[cell], at_rim));
            }
            rows[row].push((row, slope * per_inertia));
        }
    }

    let mut energies = vec![0.0; unknowns];
    for (cell, length) in mesh.lengths.iter().enumerate() {
        energies[cell] = system.axial_stiffness * length;
        energies[of_velocity(cell)] = rates.per_mass[cell].recip();
    }
    let all = (0..mesh.arcs.len())
        .flat_map(|pulley| mesh.arcs[pulley].clone().zip(mesh.bristles[pulley].clone()));
    for (cell, bristle) in all {
        if let Some(unknown) = of_bristle[bristle] {
            energies[unknown] = system.friction_stiffness * mesh.lengths[cell];
        }
    }
    for (unknown, wheel) in speed.iter().zip(&system.wheels) {
        if let Some(unknown) = unknown {
            energies[*unknown] = wheel.axle.inertia;
        }
    }
    let scales: Vec<_> = { energies.iter() }
        .map(|energy: &f64| energy.sqrt().recip())
        .collect();
    let mut matrix = Mat::zeros(unknowns, unknowns);
    for (row, entries) in rows.iter().enumerate() {
        for &(column, entry) in entries {
            matrix[(row, column)] += entry * scales[column] / scales[row];
        }
    }
    Linearised {
        matrix,
        scales,
        velocity: cells,
        speed,
    }
}

fn times(row: &[(usize, f64)], factor: f64) -> Row {
    row.iter()
        .map(|&(unknown, entry)| (unknown, factor * entry))
        .collect()
}
