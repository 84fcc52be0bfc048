//! A banded system: 999 points of Bratu's problem, followed round the limit point at the cost of a few
//! sparse eliminations per step.

mod bratu;

use bratu::bratu;
use continuation::{Branch, Direction, Error, Kind, Options};

const POINTS: usize = 999;

fn main() -> Result<(), Error> {
    let mut system = bratu(POINTS);
    let options = Options {
        targets: vec![1.0],
        ..Options::within(0.0, 4.0)
    };
    let start = [0.0; POINTS + 1];
    let branch = Branch::new(&mut system, &start, Direction::Increasing, &options)?
        .event(|_, point| point.z[POINTS / 2] - 6.0);

    println!("{:>10} {:>18} {:>14}", "arclength", "lambda", "u(1/2)");
    let mut labelled = Vec::new();
    for point in branch {
        let (lambda, middle) = (point.lambda(), point.x()[POINTS / 2]);
        println!(
            "{:10.4} {lambda:18.12} {middle:14.9}  {:?}",
            point.arclength, point.kind
        );
        if point.kind != Kind::Regular {
            labelled.push((point.kind, lambda, middle));
        }
        if matches!(point.kind, Kind::Event(_)) {
            break;
        }
    }

    // The differential equation: λ = 1 at 0.14053921… and 4.09146724…, limit point at
    // 3.51383071913; its differences are off by O(h²).
    let expected = [
        (Kind::Start, 0.0, 0.0),
        (Kind::Target, 1.0, 0.140_539_214_400_5),
        (Kind::LimitPoint, 3.513_830_719_125, 1.186_842_168_634),
        (Kind::Target, 1.0, 4.091_467_246_189_3),
    ];
    for ((kind, lambda, middle), expected) in labelled.iter().zip(expected) {
        assert_eq!(*kind, expected.0);
        assert!((lambda - expected.1).abs() < 2e-6 && (middle - expected.2).abs() < 2e-5);
    }
    assert_eq!(labelled.len(), 5);
    Ok(())
}
