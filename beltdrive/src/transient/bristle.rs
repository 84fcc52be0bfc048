//! The bristles of an arc, which the belt carries along.
//!
//! ∂b/∂t + v ∂b/∂σ = `v_s` in the middles of the cells, with b = 0 where the belt enters. The slope is third order and
//! upwind: with second order the transport damps torsional vibration four times as much as friction does at 120
//! cells, with bristles at faces the entry loses half a cell of friction.

/// The rates of the bristles of an arc in m/s, from their displacements in m, the velocity of the belt and that of
/// the rim in m/s, and the length of a cell in m.
#[inline(always)]
pub(crate) fn transport(
    rates: &mut [f64],
    bristles: &[f64],
    velocity: &[f64],
    rim: f64,
    cell: f64,
) {
    let last = bristles.len() - 1;
    let per_six = 1.0 / (6.0 * cell);
    match velocity[0] + velocity[last] >= 0.0 {
        true => along(rates, bristles, velocity, rim, per_six),
        false => against(rates, bristles, velocity, rim, per_six),
    }
}

/// Six times the difference in a cell of an arc with a belt that runs forward: the first of four cells, and their
/// weights.
pub(crate) fn weights(cell: usize, cells: usize) -> (usize, [f64; 4]) {
    let unit = |place: usize| {
        let mut unit = [0.0; 4];
        unit[place] = 1.0;
        unit
    };
    let of = |difference: &dyn Fn([f64; 4]) -> f64| [0, 1, 2, 3].map(|at| difference(unit(at)));
    match cell {
        0 | 1 => (
            0,
            of(&|[first, second, third, _]| at_entry([first, second, third])[cell]),
        ),
        cell if cell + 1 == cells => (cell - 3, of(&at_exit)),
        cell => (cell - 2, of(&inside)),
    }
}

/// Six times the differences at the entry: in the first and in the second cell, from the first three.
#[inline(always)]
fn at_entry(b: [f64; 3]) -> [f64; 2] {
    let before = -2.0 * b[0] + b[1] / 3.0;
    [
        6.0 * b[0] + 2.0 * b[1],
        2.0 * b[2] + 3.0 * b[1] - 6.0 * b[0] + before,
    ]
}

/// Six times the difference inside, of the cell with one behind it and two before it.
#[inline(always)]
fn inside(b: [f64; 4]) -> f64 {
    2.0 * b[3] + 3.0 * b[2] - 6.0 * b[1] + b[0]
}

/// Six times the difference in the last cell.
#[inline(always)]
fn at_exit(b: [f64; 4]) -> f64 {
    11.0 * b[3] - 18.0 * b[2] + 9.0 * b[1] - 2.0 * b[0]
}

#[inline(always)]
fn along(rates: &mut [f64], b: &[f64], velocity: &[f64], rim: f64, per_six: f64) {
    let last = b.len() - 1;
    let [first, second] = at_entry([b[0], b[1], b[2]]);
    let rate = |v: f64, difference: f64| v - rim - v * (difference * per_six);
    rates[0] = rate(velocity[0], first);
    rates[1] = rate(velocity[1], second);
    let inner = rates[2..last].iter_mut().zip(&velocity[2..last]);
    for ((to, &v), b) in inner.zip(b.windows(4)) {
        *to = rate(v, inside([b[0], b[1], b[2], b[3]]));
    }
    rates[last] = rate(
        velocity[last],
        at_exit([b[last - 3], b[last - 2], b[last - 1], b[last]]),
    );
}

/// As [`along`] where the belt runs backwards and enters at the other end.
fn against(rates: &mut [f64], bristles: &[f64], velocity: &[f64], rim: f64, per_six: f64) {
    let last = bristles.len() - 1;
    differences(
        last,
        |cell| bristles[last - cell],
        |cell, difference| {
            let v = velocity[last - cell];
            rates[last - cell] = v - rim + v * (difference * per_six);
        },
    );
}

/// Tells six times the difference in each cell from where the belt enters on, from what its bristles are.
fn differences(last: usize, b: impl Fn(usize) -> f64, mut tell: impl FnMut(usize, f64)) {
    let [first, second] = at_entry([b(0), b(1), b(2)]);
    tell(0, first);
    tell(1, second);
    for cell in 2..last {
        tell(
            cell,
            inside([b(cell - 2), b(cell - 1), b(cell), b(cell + 1)]),
        );
    }
    tell(
        last,
        at_exit([b(last - 3), b(last - 2), b(last - 1), b(last)]),
    );
}

/// The slope of bristles along an arc, with a belt that runs forward on it or backwards, from the length of a cell in m.
pub(crate) fn slopes(slopes: &mut [f64], bristles: &[f64], is_forward: bool, cell: f64) {
    let last = bristles.len() - 1;
    let per_six = 1.0 / (6.0 * cell);
    let slopes = &mut slopes[..=last];
    match is_forward {
        true => differences(
            last,
            |cell| bristles[cell],
            |cell, difference| {
                slopes[cell] = difference * per_six;
            },
        ),
        false => differences(
            last,
            |cell| bristles[last - cell],
            |cell, difference| {
                slopes[last - cell] = -difference * per_six;
            },
        ),
    }
}
