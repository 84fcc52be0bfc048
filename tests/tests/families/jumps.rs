//! Jumps and kinks of the right-hand side at places that no segment ends at.

use crate::draw::Draw;
use crate::trial::{Formula, OnSegment, Trial, Truth, known, some_guess};
use bvp::Real;

pub(crate) fn draw(draw: &mut Draw) -> Trial {
    match draw.below(8) {
        0 => loads("one jump", draw, |draw| {
            vec![(draw.between(0.001, 0.999), strength(draw))]
        }),
        1 => loads("narrow load", draw, |draw| {
            let (width, strength) = (draw.log_between(1e-4, 0.1), strength(draw));
            let strength = if draw.chance(0.5) {
                strength
            } else {
                strength.signum() / width
            };
            let from = draw.between(0.0, 1.0 - width);
            vec![(from, strength), (from + width, -strength)]
        }),
        2 => loads("several jumps", draw, |draw| {
            let count = 2 + draw.below(5);
            (0..count)
                .map(|_| (draw.between(0.0, 1.0), strength(draw)))
                .collect()
        }),
        3 => kinks(draw),
        4 => first_order(draw),
        5 => system(draw),
        6 => switch(draw),
        _ => conductivity(draw),
    }
}

fn strength(draw: &mut Draw) -> f64 {
    draw.sign() * draw.log_between(0.1, 1e3)
}

/// 1 where x is beyond a, else 0.
fn step(x: f64, a: f64) -> f64 {
    f64::from(u8::from(x > a))
}

/// y″ = −Σ c [x > a] with given ends.
struct Loads {
    jumps: Vec<(f64, f64)>,
    ends: [f64; 2],
}

impl Formula for Loads {
    fn slope<T: Real>(&self, x: f64, y: &[T], _p: &[T], dy: &mut [T]) {
        dy[0] = y[1];
        dy[1] = T::from_f64(-self.jumps.iter().map(|(a, c)| c * step(x, *a)).sum::<f64>());
    }

    fn residual<T: Real>(&self, a: &[T], b: &[T], _p: &[T], r: &mut [T]) {
        r[0] = a[0] - self.ends[0];
        r[1] = b[0] - self.ends[1];
    }
}

fn loads(
    kind: &'static str,
    draw: &mut Draw,
    jumps: impl Fn(&mut Draw) -> Vec<(f64, f64)>,
) -> Trial {
    let jumps = jumps(draw);
    let ends = if draw.chance(0.5) {
        [0.0; 2]
    } else {
        [draw.between(-1.0, 1.0), draw.between(-1.0, 1.0)]
    };
    let numbers = format!("y'' = -sum c [x > a], (a, c) = {jumps:?}, ends {ends:?}");
    let places = jumps.iter().map(|(a, _)| *a).collect();
    let (all, [left, right]) = (jumps.clone(), ends);
    let bent = |x: f64, all: &[(f64, f64)]| -> f64 {
        all.iter()
            .map(|(a, c)| 0.5 * c * (x - a).max(0.0).powi(2))
            .sum()
    };
    let slope = right - left + bent(1.0, &all);
    let exact = move |x: f64| {
        let turned: f64 = all.iter().map(|(a, c)| c * (x - a).max(0.0)).sum();
        [left + slope * x - bent(x, &all), slope - turned]
    };
    Trial {
        kind,
        numbers,
        equations: OnSegment::new(Loads { jumps, ends }, 2, 0.0, 1.0, 0),
        guess: some_guess(draw, 1.0, exact.clone()),
        truth: Truth::Only(vec![known(exact)]),
        places,
    }
}

/// y″ = −Σ c |x − a| with zero ends.
struct Kinks(Vec<(f64, f64)>);

impl Formula for Kinks {
    fn slope<T: Real>(&self, x: f64, y: &[T], _p: &[T], dy: &mut [T]) {
        dy[0] = y[1];
        dy[1] = T::from_f64(-self.0.iter().map(|(a, c)| c * (x - a).abs()).sum::<f64>());
    }

    fn residual<T: Real>(&self, a: &[T], b: &[T], _p: &[T], r: &mut [T]) {
        r[0] = a[0];
        r[1] = b[0];
    }
}

fn kinks(draw: &mut Draw) -> Trial {
    let count = 1 + draw.below(3);
    let kinks: Vec<_> = (0..count)
        .map(|_| (draw.between(0.001, 0.999), strength(draw)))
        .collect();
    let all = kinks.clone();
    let cubic = |x: f64, all: &[(f64, f64)]| -> f64 {
        all.iter()
            .map(|(a, c)| c * (x - a).abs().powi(3) / 6.0)
            .sum()
    };
    let (left, right) = (cubic(0.0, &all), cubic(1.0, &all));
    let exact = move |x: f64| {
        let slope: f64 = all
            .iter()
            .map(|(a, c)| 0.5 * c * (x - a) * (x - a).abs())
            .sum();
        [
            left + (right - left) * x - cubic(x, &all),
            right - left - slope,
        ]
    };
    Trial {
        kind: "kinks",
        numbers: format!("y'' = -sum c |x - a|, (a, c) = {kinks:?}, zero ends"),
        places: kinks.iter().map(|(a, _)| *a).collect(),
        equations: OnSegment::new(Kinks(kinks), 2, 0.0, 1.0, 0),
        guess: some_guess(draw, 1.0, exact.clone()),
        truth: Truth::Only(vec![known(exact)]),
    }
}

/// Modes z′ = λ z + c [x > a], zero at the end where they are largest, seen as y = M z with
/// M = I − 2 h hᵀ.
struct Modes<const N: usize> {
    rates: [f64; N],
    jumps: [(f64, f64); N],
    normal: [f64; N],
}

impl<const N: usize> Modes<N> {
    fn draw(draw: &mut Draw) -> Self {
        let mut normal: [f64; N] = std::array::from_fn(|_| draw.between(-1.0, 1.0));
        let length = normal.iter().map(|h| h * h).sum::<f64>().sqrt();
        normal.iter_mut().for_each(|h| *h /= length);
        if N == 1 {
            normal = [0.0; N];
        }
        Self {
            rates: std::array::from_fn(|_| draw.sign() * draw.log_between(0.1, 30.0)),
            jumps: std::array::from_fn(|_| (draw.between(0.001, 0.999), strength(draw))),
            normal,
        }
    }

    fn mix<T: Real>(&self, z: &mut [T]) {
        let mut product = T::from_f64(0.0);
        for (z, h) in z.iter().zip(&self.normal) {
            product += *z * *h;
        }
        for (z, h) in z.iter_mut().zip(&self.normal) {
            *z -= product * (2.0 * h);
        }
    }

    fn exact(&self, x: f64) -> [f64; N] {
        let mut z = std::array::from_fn(|i| {
            let (rate, (a, c)) = (self.rates[i], self.jumps[i]);
            // Zero at x = 0 for decay, at x = 1 for growth.
            if rate < 0.0 {
                c * (rate * (x - a).max(0.0)).exp_m1() / rate
            } else {
                let late = (rate * (x - 1.0)).exp_m1();
                let early = (rate * (x.max(a) - 1.0)).exp_m1();
                let behind = c * early / rate;
                if x > a {
                    c * late / rate
                } else {
                    behind * (rate * (x - a)).exp()
                }
            }
        });
        self.mix(&mut z);
        z
    }
}

impl<const N: usize> Formula for Modes<N> {
    fn slope<T: Real>(&self, x: f64, y: &[T], _p: &[T], dy: &mut [T]) {
        let mut z = y.to_vec();
        self.mix(&mut z);
        for (i, dy) in dy.iter_mut().enumerate() {
            let (a, c) = self.jumps[i];
            *dy = z[i] * self.rates[i] + c * step(x, a);
        }
        self.mix(dy);
    }

    fn residual<T: Real>(&self, a: &[T], b: &[T], _p: &[T], r: &mut [T]) {
        let (mut a, mut b) = (a.to_vec(), b.to_vec());
        self.mix(&mut a);
        self.mix(&mut b);
        for (i, r) in r.iter_mut().enumerate() {
            *r = if self.rates[i] < 0.0 { a[i] } else { b[i] };
        }
    }
}

fn modes<const N: usize>(kind: &'static str, draw: &mut Draw) -> Trial {
    let modes = Modes::<N>::draw(draw);
    let Modes {
        rates,
        jumps,
        normal,
    } = &modes;
    let again = Modes {
        rates: *rates,
        jumps: *jumps,
        normal: *normal,
    };
    let numbers =
        format!("z' = rate z + c [x > a], rates {rates:?}, (a, c) = {jumps:?}, h = {normal:?}");
    let places = jumps.iter().map(|(a, _)| *a).collect();
    let exact = std::sync::Arc::new(again);
    let seen = std::sync::Arc::clone(&exact);
    Trial {
        kind,
        numbers,
        places,
        equations: OnSegment::new(modes, N, 0.0, 1.0, 0),
        guess: some_guess(draw, 1.0, move |x| seen.exact(x)),
        truth: Truth::Only(vec![known(move |x| exact.exact(x))]),
    }
}

fn first_order(draw: &mut Draw) -> Trial {
    modes::<1>("first order", draw)
}

fn system(draw: &mut Draw) -> Trial {
    match draw.below(3) {
        0 => modes::<2>("system", draw),
        1 => modes::<4>("system", draw),
        _ => modes::<6>("system", draw),
    }
}

/// y′ = 1 + c [y > θ], y(0) = 0.
struct Switch {
    threshold: f64,
    jump: f64,
}

impl Formula for Switch {
    fn slope<T: Real>(&self, _x: f64, y: &[T], _p: &[T], dy: &mut [T]) {
        dy[0] = T::from_f64(1.0 + self.jump * step(y[0].value(), self.threshold));
    }

    fn residual<T: Real>(&self, a: &[T], _b: &[T], _p: &[T], r: &mut [T]) {
        r[0] = a[0];
    }
}

fn switch(draw: &mut Draw) -> Trial {
    let (threshold, jump) = (draw.between(0.01, 0.99), draw.log_between(0.1, 100.0));
    let exact = move |x: f64| [x + jump * (x - threshold).max(0.0)];
    Trial {
        kind: "switch by a state",
        numbers: format!("y' = 1 + {jump} [y > {threshold}], y(0) = 0"),
        equations: OnSegment::new(Switch { threshold, jump }, 1, 0.0, 1.0, 0),
        guess: some_guess(draw, 1.0, exact),
        truth: Truth::Only(vec![known(exact)]),
        places: vec![threshold],
    }
}

/// y′ = q / k, q′ = 0, the conductivity k jumping from 1; y(0) = 0, y(1) = 1.
struct Conductivity {
    place: f64,
    beyond: f64,
}

impl Formula for Conductivity {
    fn slope<T: Real>(&self, x: f64, y: &[T], _p: &[T], dy: &mut [T]) {
        dy[0] = y[1] / if x > self.place { self.beyond } else { 1.0 };
        dy[1] = T::from_f64(0.0);
    }

    fn residual<T: Real>(&self, a: &[T], b: &[T], _p: &[T], r: &mut [T]) {
        r[0] = a[0];
        r[1] = b[0] - 1.0;
    }
}

fn conductivity(draw: &mut Draw) -> Trial {
    let (place, beyond) = (draw.between(0.001, 0.999), draw.log_between(1e-3, 1e3));
    let flux = 1.0 / (place + (1.0 - place) / beyond);
    let exact = move |x: f64| [flux * (x.min(place) + (x - place).max(0.0) / beyond), flux];
    Trial {
        kind: "jump of a coefficient",
        numbers: format!(
            "y' = q / k, q' = 0, k = 1 up to {place}, then {beyond}; y = 0, 1 at the ends"
        ),
        equations: OnSegment::new(Conductivity { place, beyond }, 2, 0.0, 1.0, 0),
        guess: some_guess(draw, 1.0, exact),
        truth: Truth::Only(vec![known(exact)]),
        places: vec![place],
    }
}
