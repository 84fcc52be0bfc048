//! Kinks and jumps at known places, where segments meet.

use crate::exact::Exact;
use crate::order::{COUNTS, errors, on_uniform_mesh, slope};
use bvp::{Constant, Ends, Options, Problem, Real, Scheme, Segment, solve};
use proptest::prelude::*;

/// A string pulled by a force that sets in at s = 1/3: y″ = w² (max(s − 1/3, 0) − y), y(0) = 0, y′(0) = w. In one segment or in two.
struct Pulled {
    w: f64,
    segments: Vec<Segment>,
}

/// Where the force sets in.
const KINK: f64 = 1.0 / 3.0;

impl Problem for Pulled {
    fn segments(&self) -> Vec<Segment> {
        self.segments.to_vec()
    }

    fn rhs<T: Real>(&self, _: usize, s: T, y: &[T], _p: &[T], dy: &mut [T]) {
        dy[0] = y[1];
        dy[1] = ((s - KINK).max(T::from(0.0)) - y[0]) * (self.w * self.w);
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, _p: &[T], r: &mut [T]) {
        r[0] = at.start(0)[0];
        r[1] = at.start(0)[1] - self.w;
        if self.segments.len() == 2 {
            r[2] = at.end(0)[0] - at.start(1)[0];
            r[3] = at.end(0)[1] - at.start(1)[1];
        }
    }
}

fn pulled(w: f64, joined: bool) -> Exact {
    let segments = if joined {
        vec![Segment::on(2, 0.0, KINK), Segment::on(2, KINK, 1.0)]
    } else {
        vec![Segment::new(2)]
    };
    Exact {
        name: "pulled string",
        equations: Box::new(Pulled { w, segments }),
        states: |w, s, y| {
            let beyond = (s - KINK).max(0.0);
            y[0] = (w * s).sin() + beyond - (w * beyond).sin() / w;
            y[1] = w * (w * s).cos() + 1.0 - (w * beyond).cos();
        },
        w,
        parameters: vec![],
    }
}

#[test]
fn a_junction_at_a_kink_keeps_the_order_and_the_mesh() {
    let order = |problem: Exact| {
        let scheme = Scheme::Gauss { stages: 4 };
        // All with the kink at one third of an interval.
        let counts = COUNTS.iter().filter(|&n| n % 3 == 1);
        let of_mesh = |&n: &usize| {
            let solution = on_uniform_mesh(&problem, scheme, n)?;
            Some((n, errors(&problem, &solution)[0]))
        };
        slope(&counts.filter_map(of_mesh).collect::<Vec<_>>())
    };
    let (joined, single) = (order(pulled(10.0, true)), order(pulled(10.0, false)));
    assert!((joined - 8.0).abs() < 0.2, "{joined}");
    assert!((single - 2.0).abs() < 0.2, "{single}");

    let solved = |problem: Exact| {
        let guess = Constant {
            states: vec![vec![0.0; 2]; problem.equations.shape().segments.len()],
            parameters: vec![],
        };
        solve(&*problem.equations, &guess, &Options::to(1e-9)).unwrap()
    };
    let (joined, single) = (solved(pulled(10.0, true)), solved(pulled(10.0, false)));
    assert_eq!(joined.stats().meshes, 2);
    assert!(single.stats().rhs_evaluations > joined.stats().rhs_evaluations);
}

/// A beam E I u⁗ = 0 of length 1 on two supports, u = u″ = 0, under the force F at s = a, where the shear
/// E I u‴ jumps by F.
struct Beam {
    segments: [Segment; 2],
    force: f64,
}

impl Problem for Beam {
    fn segments(&self) -> Vec<Segment> {
        self.segments.to_vec()
    }

    fn rhs<T: Real>(&self, _: usize, _s: T, y: &[T], _p: &[T], dy: &mut [T]) {
        dy[..3].copy_from_slice(&y[1..]);
        dy[3] = T::from(0.0);
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, _p: &[T], r: &mut [T]) {
        let (left, right) = (at.start(0), at.end(1));
        r[..4].copy_from_slice(&[left[0], left[2], right[0], right[2]]);
        for i in 0..4 {
            r[4 + i] = at.start(1)[i] - at.end(0)[i];
        }
        r[7] -= T::from(self.force);
    }
}

proptest! {
    #[test]
    fn a_beam_bends_under_a_point_load_as_in_the_books(a in 0.05..0.95f64, force in 0.1..10.0f64) {
        let segments = [Segment::on(4, 0.0, a), Segment::on(4, a, 1.0)];
        let guess = Constant { states: vec![vec![0.0; 4]; 2], parameters: vec![] };
        let solution = solve(&Beam { segments, force }, &guess, &Options::default()).unwrap();
        let exact = force * (a * (1.0 - a)).powi(2) / 3.0;
        prop_assert!((solution.end(0)[0] - exact).abs() < 1e-12 * force);
    }
}
