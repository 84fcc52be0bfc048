//! The arc on which the belt slips.

/// What bristles of a displacement are short of their largest one, m; they slip where it is not positive.
fn margin(bristle: f64, cap: f64) -> f64 {
    cap - bristle.abs()
}

/// Whether bristles of a displacement slip whose largest one is a cap.
pub(crate) fn slips(bristle: f64, cap: f64) -> bool {
    margin(bristle, cap) <= 0.0
}

/// Length of the part of an arc on which the bristles are at their largest displacement, in cells.
///
/// The margin between the two is continued from the cells that stick through a parabola, to where it is used up.
pub(crate) fn slipping(bristles: &[f64], caps: &[f64]) -> f64 {
    let margin = |cell: usize| margin(bristles[cell], caps[cell]);
    let sticks = |cell: usize, offset: isize| {
        let other = cell
            .checked_add_signed(offset)
            .filter(|&other| other < caps.len());
        other.map(margin).filter(|margin| *margin > 0.0)
    };
    let mut slipping = 0.0;
    for cell in 0..caps.len() {
        if margin(cell) > 0.0 {
            continue;
        }
        slipping += 1.0;
        for side in [-1, 1] {
            let Some(near) = sticks(cell, side) else {
                continue;
            };
            let [next, last] = [2, 3].map(|far| sticks(cell, far * side));
            // The margin near − b x + c x² at x cells from the last cell that sticks towards this one.
            let (b, c) = match (next, last) {
                (None, _) => (0.0, 0.0),
                (Some(next), None) => (next - near, 0.0),
                (Some(next), Some(last)) => {
                    let c = 0.5 * (last - 2.0 * next + near);
                    (next - near - c, c)
                }
            };
            // This cell begins half a cell from the middle of that one.
            slipping += 0.5 - root(near, b, c).clamp(0.0, 1.0);
        }
    }
    slipping
}

/// The smaller positive root x of a − b x + c x² with a > 0; where there is none, 1/2.
fn root(a: f64, b: f64, c: f64) -> f64 {
    let square = b * b - 4.0 * a * c;
    match b > 0.0 && square >= 0.0 {
        true => 2.0 * a / (b + square.sqrt()),
        false => 0.5,
    }
}

#[cfg(test)]
mod tests {
    use super::slipping;

    #[test]
    fn the_arc_ends_between_cells_where_the_margin_is_used_up() {
        // Elastic up to 6.3 cells with a margin that is a parabola, then slip.
        for turned in [false, true] {
            let caps = [1.0; 12];
            let margin = |cell: usize| {
                let left: f64 = 6.3 - (cell as f64 + 0.5);
                left.max(0.0) * (0.1 + 0.01 * left)
            };
            let mut bristles: Vec<f64> = (0..12).map(|cell| -(1.0 - margin(cell))).collect();
            if turned {
                bristles.reverse();
            }
            assert!((slipping(&bristles, &caps) - 5.7).abs() < 1e-12);
        }
        assert_eq!(slipping(&[1.0; 5], &[1.0; 5]), 5.0);
        assert_eq!(slipping(&[0.5; 5], &[1.0; 5]), 0.0);
    }
}
