//! Exact Jacobians of a [`Problem`] by dual numbers.

use crate::kernels::specialise::specialise;
use crate::problem::dual::Dual;
use crate::problem::equations::{Equations, Shape};
use crate::problem::problem::{Ends, Problem};
use crate::problem::real::{LeftOf, Real};

/// The widest dual number: more directions are carried in several passes.
const WIDEST: usize = 24;

/// The most arguments of which only some have a direction. Setting 24 dual numbers of width 10 to zero, more than 2 kB, was
/// left to a slower routine and took 5 % of the instructions of a map of V-belts.
const MOST: usize = 20;

impl<P: Problem> Equations for P {
    fn shape(&self) -> Shape {
        Shape {
            segments: self.segments(),
            parameters: self.parameters(),
            conditions: self.condition_count(),
        }
    }

    fn evaluate_rhs(&self, segment: usize, s: f64, y: &[f64], p: &[f64], dy: &mut [f64]) {
        self.rhs(segment, s, y, p, dy);
    }

    fn rhs_jacobian(
        &self,
        segment: usize,
        s: f64,
        y: &[f64],
        p: &[f64],
        dy: &mut [f64],
        jacobian: &mut [f64],
    ) {
        let rhs = RhsAt {
            problem: self,
            segment,
            s,
        };
        let (states, all) = (y.len(), y.len() + p.len());
        if all <= MOST {
            let (mut used, mut count) = ([0; MOST], 0);
            for parameter in (0..p.len()).filter(|&parameter| self.depends(segment, parameter)) {
                used[count] = parameter;
                count += 1;
            }
            if width(states + count) < width(all) {
                return differentiate_by_some(&rhs, y, (p, &used[..count]), dy, jacobian);
            }
        }
        differentiate(&rhs, y, p, dy, jacobian);
    }

    fn evaluate_conditions(&self, at: Ends<'_, f64>, p: &[f64], r: &mut [f64]) {
        self.conditions(at, p, r);
    }

    fn conditions_jacobian(
        &self,
        at: Ends<'_, f64>,
        p: &[f64],
        r: &mut [f64],
        jacobian: &mut [f64],
    ) {
        let conditions = Conditions { problem: self, at };
        differentiate(&conditions, at.values(), p, r, jacobian);
    }
}

/// A function of (z, p) that can be evaluated with any scalar.
trait Differentiable {
    fn evaluate<T: Real>(&self, z: &[T], p: &[T], value: &mut [T])
    where
        f64: LeftOf<T>;
}

/// The right-hand side of a problem at one s.
struct RhsAt<'a, P> {
    problem: &'a P,
    segment: usize,
    s: f64,
}

impl<P: Problem> Differentiable for RhsAt<'_, P> {
    fn evaluate<T: Real>(&self, y: &[T], p: &[T], dy: &mut [T])
    where
        f64: LeftOf<T>,
    {
        let s = T::from_f64(self.s);
        self.problem.rhs(self.segment, s, y, p, dy);
    }
}

/// The conditions of a problem, with the ends that they are asked at.
struct Conditions<'a, P> {
    problem: &'a P,
    at: Ends<'a, f64>,
}

impl<P: Problem> Differentiable for Conditions<'_, P> {
    fn evaluate<T: Real>(&self, ends: &[T], p: &[T], r: &mut [T])
    where
        f64: LeftOf<T>,
    {
        self.problem.conditions(self.at.with(ends), p, r);
    }
}

/// Value and Jacobian of a function with at most as many values as arguments. The Jacobian is
/// row-major, its columns z and then p.
fn differentiate(
    function: &impl Differentiable,
    z: &[f64],
    p: &[f64],
    value: &mut [f64],
    jacobian: &mut [f64],
) {
    match width(z.len() + p.len()) {
        2 => one_pass::<2>(|z, p, v| function.evaluate(z, p, v), z, p, value, jacobian),
        4 => one_pass::<4>(|z, p, v| function.evaluate(z, p, v), z, p, value, jacobian),
        6 => one_pass::<6>(|z, p, v| function.evaluate(z, p, v), z, p, value, jacobian),
        10 => one_pass::<10>(|z, p, v| function.evaluate(z, p, v), z, p, value, jacobian),
        16 => one_pass::<16>(|z, p, v| function.evaluate(z, p, v), z, p, value, jacobian),
        _ => {
            differentiate_by::<WIDEST>(|z, p, v| function.evaluate(z, p, v), z, p, value, jacobian);
        }
    }
}

/// The smallest of a few widths that carries this many directions in one pass, or the widest.
#[inline(always)]
fn width(directions: usize) -> usize {
    match directions {
        0..=2 => 2,
        3..=4 => 4,
        5..=6 => 6,
        7..=10 => 10,
        11..=16 => 16,
        _ => WIDEST,
    }
}

/// The same as [`differentiate`] where the function depends on some of the parameters only, in one pass.
fn differentiate_by_some(
    function: &impl Differentiable,
    z: &[f64],
    p: (&[f64], &[usize]),
    value: &mut [f64],
    jacobian: &mut [f64],
) {
    match width(z.len() + p.1.len()) {
        2 => some_directions::<2>(|z, p, v| function.evaluate(z, p, v), z, p, value, jacobian),
        4 => some_directions::<4>(|z, p, v| function.evaluate(z, p, v), z, p, value, jacobian),
        6 => some_directions::<6>(|z, p, v| function.evaluate(z, p, v), z, p, value, jacobian),
        10 => some_directions::<10>(|z, p, v| function.evaluate(z, p, v), z, p, value, jacobian),
        _ => some_directions::<16>(|z, p, v| function.evaluate(z, p, v), z, p, value, jacobian),
    }
}

/// The same of a function of dual numbers of one width.
pub(crate) fn differentiate_by<const W: usize>(
    function: impl Fn(&[Dual<W>], &[Dual<W>], &mut [Dual<W>]),
    z: &[f64],
    p: &[f64],
    value: &mut [f64],
    jacobian: &mut [f64],
) {
    if z.len() + p.len() <= W {
        one_pass(function, z, p, value, jacobian);
    } else {
        in_passes(function, z, p, value, jacobian);
    }
}

/// The value of a function of dual numbers with at most as many values as arguments.
pub(crate) fn value_by<const W: usize>(
    function: impl Fn(&[Dual<W>], &[Dual<W>], &mut [Dual<W>]),
    z: &[f64],
    p: &[f64],
    value: &mut [f64],
) {
    let count = z.len() + p.len();
    let constants = || z.iter().chain(p).map(|&x| Dual::constant(x));
    let unwritten = Dual::constant(f64::NAN);
    let mut evaluate = |arguments: &[Dual<W>], values: &mut [Dual<W>]| {
        let (zs, ps) = arguments.split_at(z.len());
        let values = &mut values[..value.len()];
        function(zs, ps, values);
        for (value, dual) in value.iter_mut().zip(values) {
            *value = dual.value;
        }
    };
    if count <= W {
        let (mut arguments, mut values) = ([unwritten; W], [unwritten; W]);
        arguments
            .iter_mut()
            .zip(constants())
            .for_each(|(to, x)| *to = x);
        evaluate(&arguments[..count], &mut values);
    } else {
        evaluate(
            &constants().collect::<Vec<_>>(),
            &mut vec![unwritten; count],
        );
    }
}

/// All directions at once, on the stack.
fn one_pass<const W: usize>(
    function: impl Fn(&[Dual<W>], &[Dual<W>], &mut [Dual<W>]),
    z: &[f64],
    p: &[f64],
    value: &mut [f64],
    jacobian: &mut [f64],
) {
    let columns = z.len() + p.len();
    let mut arguments = Dual::<W>::VARIABLES;
    for (argument, &x) in arguments.iter_mut().zip(z.iter().chain(p)) {
        argument.value = x;
    }
    let mut values = [Dual::<W>::constant(f64::NAN); W];
    let (zs, ps) = arguments[..columns].split_at(z.len());
    function(zs, ps, &mut values[..value.len()]);
    specialise!(columns in [1, 2, 3, 4, 5, 6] => write(&values, value, jacobian, columns));
}

/// The directions of z and of those parameters that are `used`; derivatives by the others are zero. There are at most
/// [`MOST`] arguments.
fn some_directions<const W: usize>(
    function: impl Fn(&[Dual<W>], &[Dual<W>], &mut [Dual<W>]),
    z: &[f64],
    (p, used): (&[f64], &[usize]),
    value: &mut [f64],
    jacobian: &mut [f64],
) {
    let columns = z.len() + p.len();
    let mut arguments = [Dual::<W>::constant(0.0); MOST];
    for (argument, &x) in arguments.iter_mut().zip(z.iter().chain(p)) {
        argument.value = x;
    }
    for (direction, argument) in arguments[..z.len()].iter_mut().enumerate() {
        argument.gradient[direction] = 1.0;
    }
    for (place, parameter) in used.iter().enumerate() {
        arguments[z.len() + parameter].gradient[z.len() + place] = 1.0;
    }
    let mut values = [Dual::<W>::constant(f64::NAN); W];
    let (zs, ps) = arguments[..columns].split_at(z.len());
    function(zs, ps, &mut values[..value.len()]);
    let rows = values.iter().zip(value);
    for ((dual, value), row) in rows.zip(jacobian.chunks_exact_mut(columns)) {
        *value = dual.value;
        let (by_z, by_p) = row.split_at_mut(z.len());
        by_z.copy_from_slice(&dual.gradient[..z.len()]);
        by_p.fill(0.0);
        for (parameter, derivative) in used.iter().zip(&dual.gradient[z.len()..]) {
            by_p[*parameter] = *derivative;
        }
    }
}

/// Writes values, and gradients with `columns` columns.
#[inline(always)]
fn write<const W: usize>(
    from: &[Dual<W>; W],
    value: &mut [f64],
    jacobian: &mut [f64],
    columns: usize,
) {
    let rows = from.iter().zip(value);
    for ((dual, value), row) in rows.zip(jacobian.chunks_exact_mut(columns)) {
        *value = dual.value;
        row.copy_from_slice(&dual.gradient[..columns]);
    }
}

/// W directions per pass. Allocates two buffers, whose cost is negligible with this many arguments.
fn in_passes<const W: usize>(
    function: impl Fn(&[Dual<W>], &[Dual<W>], &mut [Dual<W>]),
    z: &[f64],
    p: &[f64],
    value: &mut [f64],
    jacobian: &mut [f64],
) {
    let columns = z.len() + p.len();
    let mut arguments: Vec<Dual<W>> = z.iter().chain(p).map(|&x| Dual::constant(x)).collect();
    let mut values = vec![Dual::constant(f64::NAN); value.len()];
    for first in (0..columns).step_by(W) {
        let width = W.min(columns - first);
        for direction in 0..width {
            arguments[first + direction].gradient[direction] = 1.0;
        }
        let (zs, ps) = arguments.split_at(z.len());
        function(zs, ps, &mut values);
        for (i, dual) in values.iter().enumerate() {
            value[i] = dual.value;
            let row = &mut jacobian[i * columns + first..][..width];
            row.copy_from_slice(&dual.gradient[..width]);
        }
        for argument in &mut arguments[first..first + width] {
            argument.gradient = [0.0; W];
        }
    }
}
