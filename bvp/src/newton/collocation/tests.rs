use super::*;
use crate::discretisation::scheme::Scheme;
use crate::problem::problem::Problem;
use crate::problem::real::Real;

/// Two derivative states of the third, and one free state beside it.
struct ThirdOrder;

impl Problem for ThirdOrder {
    fn segments(&self) -> Vec<Segment> {
        vec![Segment::new(4)]
    }

    fn parameters(&self) -> usize {
        1
    }

    fn rhs<T: Real>(&self, _: usize, s: T, y: &[T], p: &[T], dy: &mut [T]) {
        dy[0] = y[1];
        dy[1] = y[2];
        dy[2] = -p[0] * y[1] + (y[3] * s).sin();
        dy[3] = y[0] * y[3];
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, p: &[T], r: &mut [T]) {
        r[..4].copy_from_slice(at.start(0));
        r[4] = p[0] - 1.0;
    }
}

/// An iterate without a pattern, as it is from interval `first` of a longer segment on.
fn iterate(collocation: &Collocation<'_>, first: usize) -> Iterate {
    let noise = |i: usize| (i as f64 * 0.754_877_666_246_692_8).fract();
    let mut x = collocation.zeros();
    x.p[0] = 2.0;
    let SegmentIterate { nodes, stages } = &mut x.segments[0];
    let m = collocation.tableau.stages;
    let places = nodes.iter_mut().enumerate();
    places.for_each(|(i, y)| *y = noise(4 * first + i));
    let places = stages.iter_mut().enumerate();
    places.for_each(|(i, slope)| *slope = noise(4 * m * first + i + 5));
    x
}

/// Short parts are never shared among threads.
#[test]
fn a_long_segment_gives_the_numbers_of_its_parts() {
    let tableau = Arc::new(Tableau::new(Scheme::Gauss { stages: 5 }));
    let (intervals, part) = (3000, 10);
    let mesh: Vec<f64> = (0..=intervals).map(|i| f64::from(i) / 300.0).collect();
    let on = |nodes: &[f64]| {
        let equations = Held::none(&ThirdOrder);
        Collocation::new(equations, Arc::clone(&tableau), vec![nodes.to_vec()])
    };
    let stats = &mut Stats::default();
    let mut long = on(&mesh);
    let x = iterate(&long, 0);
    let (mut r, mut dx) = (long.residual_buffer(), long.zeros());
    long.residual(&x, &mut r, stats).unwrap();
    let stages = r.equations[0].stages.clone();
    long.linearise(&x, &mut r, stats).unwrap();
    assert_eq!(stages, r.equations[0].stages);
    long.correction(&r, &mut dx);
    let mut loads = long.zeros();
    long.stages[0].reduce(&r.equations[0], &mut loads.segments[0].nodes);
    let (n, size) = (4, 5 * 4);
    for first in (0..intervals as usize).step_by(part) {
        let mut short = on(&mesh[first..=first + part]);
        let x = iterate(&short, first);
        let (mut own, mut correction) = (short.residual_buffer(), short.zeros());
        short.linearise(&x, &mut own, stats).unwrap();
        let nodes = (first + 1) * n..(first + part + 1) * n;
        let stages = first * size..(first + part) * size;
        let all = &r.equations[0];
        assert_eq!(own.equations[0].stages, all.stages[stages.clone()]);
        assert_eq!(own.equations[0].nodes[n..], all.nodes[nodes.clone()]);
        let to = &mut correction.segments[0].nodes;
        short.stages[0].reduce(&own.equations[0], to);
        assert_eq!(to[n..], loads.segments[0].nodes[nodes.clone()]);
        to.copy_from_slice(&dx.segments[0].nodes[nodes.start - n..nodes.end]);
        correction.p.clone_from(&dx.p);
        short.stage_correction(&own, &mut correction);
        let found = &correction.segments[0].stages;
        assert_eq!(*found, dx.segments[0].stages[stages]);
    }
}
