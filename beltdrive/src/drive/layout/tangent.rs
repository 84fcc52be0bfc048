//! The line that is tangent to two circles.

use bvp::Real;

/// Length and direction (rad, counter-clockwise from x) of the common tangent from one circle to another
/// whose centre is at `between` from that of the first. The radii σ R are positive where the belt turns
/// counter-clockwise round the circle.
pub(crate) fn tangent<T: Real>(between: [T; 2], leaves: T, arrives: T) -> [T; 2] {
    let [x, y] = between;
    let distance = (x * x + y * y).sqrt();
    let across = arrives - leaves;
    let length = ((distance - across) * (distance + across)).sqrt();
    [length, y.atan2(x) - across.atan2(length)]
}
