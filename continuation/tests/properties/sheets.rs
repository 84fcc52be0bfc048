//! Sheets of solutions that lie close together: a trace must stay on its own.

use continuation::{Branch, DenseSystem, Direction, Kind, Options, Stop};

/// Curves x = f(λ) on −1 ≤ λ ≤ 1: value and slope.
const SHAPES: [fn(f64) -> [f64; 2]; 7] = [
    |l| [(3.0 * l).sin(), 3.0 * (3.0 * l).cos()],
    |l| {
        let step = (10.0 * l).tanh();
        [step, 10.0 * (1.0 - step * step)]
    },
    |l| {
        let bump = 1.0 / (1.0 + 25.0 * l * l);
        [bump, -50.0 * l * bump * bump]
    },
    |l| [0.5 * (8.0 * l).sin(), 4.0 * (8.0 * l).cos()],
    |l| [2.0 * l.powi(3), 6.0 * l * l],
    |l| [0.3 * (2.0 * l).exp(), 0.6 * (2.0 * l).exp()],
    |l| {
        let bump = 1.0 / (1.0 + 4.0 * l * l);
        let (sine, cosine) = (20.0 * l).sin_cos();
        let slope = 10.0 * cosine * bump - 4.0 * l * sine * bump * bump;
        [0.5 * sine * bump, slope]
    },
];
/// Distances of the sheets.
const GAPS: [f64; 7] = [1e-1, 3e-2, 1e-2, 3e-3, 1e-3, 3e-4, 1e-4];

/// How a trace is known to be right.
type Own = Box<dyn Fn(&[f64]) -> bool>;

/// A system with several sheets, a point of one of them, and what tells its points from those of the
/// others.
struct Case {
    name: String,
    system: DenseSystem,
    start: Vec<f64>,
    own: Own,
    options: Options,
    /// Kinds of the labelled points.
    labels: Vec<Kind>,
}

/// What became of a trace.
#[derive(PartialEq)]
enum Outcome {
    Right,
    /// Ended with a reason before the end of its sheet.
    Stopped,
    /// On another sheet, or with other labels, and no word about it.
    Wrong,
}

impl Case {
    fn between_bounds(name: String, system: DenseSystem, start: Vec<f64>, own: Own) -> Self {
        Self {
            name,
            system,
            start,
            own,
            options: Options::within(-1.0, 1.0),
            labels: vec![Kind::Start, Kind::Bound],
        }
    }

    /// The outcome and the number of points.
    fn run(mut self) -> (Outcome, usize) {
        let direction = Direction::Increasing;
        let branch = Branch::new(&mut self.system, &self.start, direction, &self.options);
        let mut branch = branch.unwrap();
        let (mut count, mut labels, mut off) = (0, Vec::new(), false);
        for point in branch.by_ref() {
            count += 1;
            off |= !(self.own)(&point.z);
            if point.kind != Kind::Regular {
                labels.push(point.kind);
            }
        }
        let stop = branch.into_stop().unwrap();
        let outcome = if off {
            Outcome::Wrong
        } else if matches!(stop, Stop::StepTooSmall { .. } | Stop::Steps { .. }) {
            Outcome::Stopped
        } else if labels == self.labels {
            Outcome::Right
        } else {
            Outcome::Wrong
        };
        if outcome != Outcome::Right {
            println!("{}: {labels:?}, off {off}, {stop}", self.name);
        }
        (outcome, count)
    }
}

/// Two sheets, one of them of which is followed, and the middle one of three.
fn parallel(shape: usize, gap: f64) -> Vec<Case> {
    let f = SHAPES[shape];
    let own = move |offset: f64| -> Own {
        Box::new(move |z| (z[0] - f(z[z.len() - 1])[0] - offset).abs() < 0.2 * gap.min(1e-2))
    };
    let two = [0.0, gap].map(|offset| {
        let system = DenseSystem::new(1, &[0.0], 0, move |x, p, g| {
            let a = x[0] - f(p[0])[0];
            g[0] = a * (a - gap);
        })
        .with_jacobian(move |x, p, j| {
            let [value, slope] = f(p[0]);
            j[0] = 2.0 * (x[0] - value) - gap;
            j[1] = -slope * j[0];
        });
        let start = vec![f(-1.0)[0] + offset, -1.0];
        let name = format!("two sheets {gap} apart, shape {shape}");
        Case::between_bounds(name, system, start, own(offset))
    });
    let system = DenseSystem::new(1, &[0.0], 0, move |x, p, g| {
        let a = x[0] - f(p[0])[0];
        g[0] = a * (a - gap) * (a + gap);
    })
    .with_jacobian(move |x, p, j| {
        let [value, slope] = f(p[0]);
        j[0] = 3.0 * (x[0] - value).powi(2) - gap * gap;
        j[1] = -slope * j[0];
    });
    let name = format!("three sheets {gap} apart, shape {shape}");
    let three = Case::between_bounds(name, system, vec![f(-1.0)[0], -1.0], own(0.0));
    two.into_iter().chain([three]).collect()
}

/// Two sheets that the orientation of the null vector cannot tell apart: the real and the imaginary
/// part of (w − f)(w − f − gap).
fn complex(shape: usize, gap: f64) -> Case {
    let f = SHAPES[shape];
    let system = DenseSystem::new(2, &[0.0], 0, move |x, p, g| {
        let (a, y) = (x[0] - f(p[0])[0], x[1]);
        g[0] = a * (a - gap) - y * y;
        g[1] = y * (2.0 * a - gap);
    })
    .with_jacobian(move |x, p, j| {
        let [value, slope] = f(p[0]);
        let (sum, y) = (2.0 * (x[0] - value) - gap, 2.0 * x[1]);
        j.copy_from_slice(&[sum, -y, -slope * sum, y, sum, -y * slope]);
    });
    let name = format!("complex sheets {gap} apart, shape {shape}");
    let own = move |z: &[f64]| (z[0] - f(z[2])[0]).hypot(z[1]) < 0.2 * gap.min(1e-2);
    Case::between_bounds(name, system, vec![f(-1.0)[0], 0.0, -1.0], Box::new(own))
}

/// The hyperbola (x − m λ)(x + λ) = ± gap²/4: a transcritical bifurcation that is missed.
fn hyperbola(m: f64, sign: f64, gap: f64) -> Case {
    let level = 0.25 * sign * gap * gap;
    let system = DenseSystem::new(1, &[0.0], 0, move |x, p, g| {
        g[0] = (x[0] - m * p[0]) * (x[0] + p[0]) - level;
    })
    .with_jacobian(move |x, p, j| {
        let [a, b] = [x[0] - m * p[0], x[0] + p[0]];
        j.copy_from_slice(&[a + b, a - m * b]);
    });
    // With a = x + m, b = a − 1 − m at λ = −1.
    let a = 0.5 * (1.0 + m) - (0.25 * (1.0 + m).powi(2) + level).sqrt();
    let own = move |z: &[f64]| (z[0] - m * z[1]) * a > 0.0;
    let name = format!("hyperbola {m} {sign}, gap {gap}");
    let case = Case::between_bounds(name, system, vec![a - m, -1.0], Box::new(own));
    if sign > 0.0 {
        return case;
    }
    // It turns back.
    let labels = vec![Kind::Start, Kind::LimitPoint, Kind::Bound];
    Case { labels, ..case }
}

/// x (λ − x²) = ± gap^1.5: a pitchfork that is missed.
fn pitchfork(sign: f64, gap: f64) -> Case {
    let level = sign * gap.powf(1.5);
    let system = DenseSystem::new(1, &[0.0], 0, move |x, p, g| {
        g[0] = x[0] * (p[0] - x[0] * x[0]) - level;
    })
    .with_jacobian(|x, p, j| j.copy_from_slice(&[p[0] - 3.0 * x[0] * x[0], x[0]]));
    let own = move |z: &[f64]| z[1] < 0.0 || z[0] * sign < 0.0;
    let name = format!("pitchfork {sign}, gap {gap}");
    Case::between_bounds(name, system, vec![-level, -1.0], Box::new(own))
}

/// One of two circles.
fn circle(inner: bool, gap: f64) -> Case {
    let squares = [1.0, (1.0 + gap).powi(2)];
    let system = DenseSystem::new(1, &[0.0], 0, move |x, p, g| {
        let square = x[0] * x[0] + p[0] * p[0];
        g[0] = (square - squares[0]) * (square - squares[1]);
    })
    .with_jacobian(move |x, p, j| {
        let square = x[0] * x[0] + p[0] * p[0];
        let slope = 2.0 * (2.0 * square - squares[0] - squares[1]);
        j.copy_from_slice(&[slope * x[0], slope * p[0]]);
    });
    let radius = if inner { 1.0 } else { 1.0 + gap };
    Case {
        name: format!("circle {inner}, gap {gap}"),
        system,
        start: vec![radius, 0.0],
        own: Box::new(move |z| (z[0].hypot(z[1]) - radius).abs() < 0.2 * gap.min(1e-2)),
        options: Options::within(-2.0, 2.0),
        labels: vec![
            Kind::Start,
            Kind::LimitPoint,
            Kind::LimitPoint,
            Kind::Closed,
        ],
    }
}

/// λ = 1 − (x / width)²: two arms that meet in a tip.
fn hairpin(width: f64) -> Case {
    let system = DenseSystem::new(1, &[0.0], 0, move |x, p, g| {
        g[0] = p[0] - 1.0 + (x[0] / width).powi(2);
    })
    .with_jacobian(move |x, _, j| j.copy_from_slice(&[2.0 * x[0] / width.powi(2), 1.0]));
    Case {
        name: format!("hairpin of width {width}"),
        system,
        start: vec![-width, 0.0],
        own: Box::new(|_| true),
        options: Options {
            weights: Some(vec![1.0, 1.0]),
            ..Options::within(-0.5, 2.0)
        },
        labels: vec![Kind::Start, Kind::LimitPoint, Kind::Bound],
    }
}

/// Forty traces for each gap.
fn survey(gaps: &[f64]) -> (Vec<Outcome>, usize) {
    let (mut outcomes, mut points) = (Vec::new(), 0);
    for &gap in gaps {
        let mut cases = Vec::new();
        for shape in 0..SHAPES.len() {
            cases.extend(parallel(shape, gap));
            cases.push(complex(shape, gap));
        }
        for m in [0.3, 1.0, 0.1] {
            cases.extend([1.0, -1.0].map(|sign| hyperbola(m, sign, gap)));
        }
        cases.extend([1.0, -1.0].map(|sign| pitchfork(sign, gap)));
        cases.extend([true, false].map(|inner| circle(inner, gap)));
        cases.extend([1.0, 0.5].map(|share| hairpin(share * gap)));
        for case in cases {
            let (outcome, count) = case.run();
            outcomes.push(outcome);
            points += count;
        }
    }
    (outcomes, points)
}

fn count(outcomes: &[Outcome], which: &Outcome) -> usize {
    outcomes.iter().filter(|outcome| *outcome == which).count()
}

#[test]
fn sheets_a_tenth_to_a_hundredth_apart_are_told_apart() {
    let (outcomes, points) = survey(&[7e-2, 2e-2]);
    assert_eq!(outcomes.len(), 80);
    assert_eq!(count(&outcomes, &Outcome::Wrong), 0);
    assert_eq!(count(&outcomes, &Outcome::Stopped), 0);
    assert!(points < 10_000, "{points} points");
}

/// Measured: none of 280 wrong, 4 stopped (hairpins whose tip is sharper than the shortest step), with
/// 33 300 points. Before the second vector and the orientation were compared on every step, 46 were wrong
/// and 7 stopped, with 37 000 points.
#[test]
#[ignore = "280 traces, for the record in the documentation"]
fn few_traces_of_the_whole_survey_are_wrong() {
    let (outcomes, points) = survey(&GAPS);
    let (wrong, stopped) = (
        count(&outcomes, &Outcome::Wrong),
        count(&outcomes, &Outcome::Stopped),
    );
    println!(
        "{} traces: {wrong} wrong, {stopped} stopped, {points} points",
        outcomes.len()
    );
    assert!(wrong <= 3 && stopped <= 8);
}
