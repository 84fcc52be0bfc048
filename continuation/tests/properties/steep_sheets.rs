//! Steep sheets of solutions with equal orientations and second vectors: only the tangent tells of a jump.

use continuation::{Branch, DenseSystem, Direction, Kind, Options};

/// The sine x = A sin(k λ) on −1 ≤ λ ≤ 1.
#[derive(Clone, Copy)]
struct Sine {
    amplitude: f64,
    rate: f64,
}

impl Sine {
    /// One of many.
    fn number(i: u32) -> Self {
        let [a, k] = [0.618_034, 0.754_878].map(|share: f64| (share * f64::from(i)).fract());
        let (amplitude, rate) = (0.1 + 1.9 * a, 1.0 + 14.0 * k);
        Self { amplitude, rate }
    }

    fn at(self, lambda: f64) -> f64 {
        self.amplitude * (self.rate * lambda).sin()
    }
}

/// An unknown coupled to the first one: size and rates along x and λ.
type Coupled = [f64; 3];

fn coupled([size, along, with]: Coupled, x: f64, lambda: f64) -> f64 {
    size * (along * x + with * lambda).sin()
}

/// Whether the upper or lower one of three sheets of x, this far apart, is followed from bound to bound; also how many
/// points that takes.
fn followed(sine: Sine, gap: f64, offset: f64, others: &'static [Coupled]) -> (bool, usize) {
    let mut system = DenseSystem::new(1 + others.len(), &[0.0], 0, move |x, p, g| {
        let a = x[0] - sine.at(p[0]);
        g[0] = a * (a - gap) * (a + gap);
        for (i, &other) in others.iter().enumerate() {
            g[1 + i] = x[1 + i] - coupled(other, x[0], p[0]);
        }
    });
    let first = sine.at(-1.0) + offset;
    let mut start = vec![first];
    start.extend(others.iter().map(|&other| coupled(other, first, -1.0)));
    start.push(-1.0);
    let options = Options::within(-1.0, 1.0);
    let branch = Branch::new(&mut system, &start, Direction::Increasing, &options);
    let (mut count, mut own, mut kinds) = (0, true, Vec::new());
    for point in branch.unwrap() {
        count += 1;
        own &= (point.z[0] - sine.at(point.lambda()) - offset).abs() < 0.2 * gap;
        kinds.extend(Some(point.kind).filter(|kind| *kind != Kind::Regular));
        own &= point.kind != Kind::Bound || point.lambda() == 1.0;
    }
    (own && kinds == [Kind::Start, Kind::Bound], count)
}

/// How many of the outer sheets of 40 sines are followed, and in how many points altogether.
fn survey(gap: f64, others: &'static [Coupled]) -> (usize, usize) {
    let runs = (0..40).flat_map(|i| [gap, -gap].map(|offset| (Sine::number(i), offset)));
    let runs: Vec<(bool, usize)> = runs
        .map(|(sine, offset)| followed(sine, gap, offset, others))
        .collect();
    let right = runs.iter().filter(|(right, _)| *right).count();
    (right, runs.iter().map(|(_, count)| count).sum())
}

const NONE: &[Coupled] = &[];
const FOUR: &[Coupled] = &[
    [3.0, 1.9, -0.7],
    [0.3, -1.3, 1.8],
    [1.0, 0.6, 1.1],
    [0.1, -2.0, -1.7],
];

#[test]
fn a_first_step_leads_to_no_other_sheet() {
    for gap in [1e-2, 1e-3] {
        let (right, points) = survey(gap, NONE);
        println!("gap {gap}: {right} of 80 in {points} points");
        assert_eq!(right, 80, "gap {gap}");
    }
}

#[test]
fn a_first_step_does_not_end_on_the_bound_where_it_began() {
    let sine = Sine {
        amplitude: 0.366_873_838_615_174_1,
        rate: 4.864_573_480_505_478,
    };
    assert!(followed(sine, 1e-2, 1e-2, NONE).0);
}

/// Measured: 80 and 78; 46 for the first gap where only orientation, second vectors and angles are compared.
#[test]
fn unknowns_with_larger_errors_of_the_prediction_hide_no_sheets() {
    for (gap, least) in [(1e-2, 80), (1e-3, 78)] {
        let (right, points) = survey(gap, FOUR);
        println!("gap {gap}: {right} of 80 in {points} points");
        assert!(right >= least, "gap {gap}: {right} of 80");
    }
}
