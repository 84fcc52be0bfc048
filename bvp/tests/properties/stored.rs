//! Solutions and options that were written and read are what they were.

use bvp::{Constant, Control, Error, Options, Real, Scheme, Segment, Solution, TwoPoint, solve};

fn bratu(span: [f64; 2]) -> impl bvp::Equations {
    TwoPoint::new(
        [2, 1],
        span,
        |_s, y, p, dy| dy.copy_from_slice(&[y[1], -p[0] * y[0].exp()]),
        |start, end, p, r| r.copy_from_slice(&[start[0], end[0], p[0] - 1.0]),
    )
}

fn guess() -> Constant {
    Constant {
        parameters: vec![0.5],
        ..Constant::new([0.0, 0.0])
    }
}

fn written_and_read(solution: &Solution) -> Solution {
    let text = serde_json::to_string(solution).unwrap();
    serde_json::from_str(&text).unwrap()
}

#[test]
fn a_solution_is_the_same_after_writing_and_reading() {
    for span in [[0.0, 1.0], [1.0 / 3.0, -2.0 / 7.0]] {
        let problem = bratu(span);
        for scheme in [
            None,
            Some(Scheme::LobattoIIIA { stages: 4 }),
            Some(Scheme::Gauss { stages: 3 }),
        ] {
            let options = Options {
                scheme,
                ..Options::to(1e-7)
            };
            let solution = solve(&problem, &guess(), &options).unwrap();
            let read = written_and_read(&solution);
            assert_eq!(read.mesh(0), solution.mesh(0));
            assert_eq!(read.segments(), solution.segments());
            assert_eq!(read.scheme(), solution.scheme());
            assert_eq!(read.parameters(), solution.parameters());
            assert_eq!(read.stats(), solution.stats());
            assert_eq!(read.state_errors(0), solution.state_errors(0));
            assert_eq!(read.defects(0), solution.defects(0));
            assert_eq!(read.report().to_string(), solution.report().to_string());
            let [mut a, mut b] = [[0.0; 2]; 2];
            for i in 0..=100 {
                let s = span[0] + 0.01 * f64::from(i) * (span[1] - span[0]);
                solution.state(0, s, &mut a);
                read.state(0, s, &mut b);
                assert_eq!(a, b);
                solution.derivative(0, s, &mut a);
                read.derivative(0, s, &mut b);
                assert_eq!(a, b);
            }
            // It is a guess like the other.
            let [a, b] = [&solution, &read].map(|guess| solve(&problem, guess, &options).unwrap());
            assert_eq!(a.end(0), b.end(0));
        }
    }
}

/// Nothing is known of the accuracy of an iterate that did not converge, and infinity is no number of
/// every format.
#[test]
fn an_iterate_that_did_not_converge_is_written_and_read() {
    let problem = TwoPoint::new(
        [2, 0],
        [0.0, 1.0],
        |_s, y, _p, dy| dy.copy_from_slice(&[y[1], -5.0 * y[0].exp()]),
        |start, end, _p, r| r.copy_from_slice(&[start[0], end[0]]),
    );
    let options = Options {
        retries: 0,
        ..Options::default()
    };
    let error = solve(&problem, &Constant::new([0.0, 0.0]), &options).unwrap_err();
    let best = error.best().expect("a numerical failure");
    let read = written_and_read(best);
    assert_eq!(
        (read.defect(), read.error_estimate()),
        (f64::INFINITY, None)
    );
    assert_eq!(read.end(0), best.end(0));
}

#[test]
fn numbers_that_are_no_solution_are_refused() {
    let solution = solve(&bratu([0.0, 1.0]), &guess(), &Options::default()).unwrap();
    let good = serde_json::to_value(&solution).unwrap();
    let refused = |place: &str, value: serde_json::Value| {
        let mut bad = good.clone();
        *bad.pointer_mut(place).expect(place) = value;
        let read: Result<Solution, _> = serde_json::from_value(bad);
        assert!(read.is_err(), "{place}");
    };
    refused("/nodes/0/0", 0.5.into());
    refused("/nodes/0", vec![0.0, 0.7, 0.3, 1.0].into());
    refused("/states/0", vec![1.0].into());
    refused("/slopes/0", vec![1.0].into());
    refused("/slopes", serde_json::json!([]));
    refused("/segments", serde_json::json!([]));
    refused("/segments/0/states", 3.into());
    refused("/segments/0/states", 0.into());
    refused("/scheme", serde_json::json!({ "Gauss": { "stages": 40 } }));
    refused("/defects/1/0", vec![1.0].into());
    let read: Result<Solution, _> = serde_json::from_value(good);
    assert!(read.is_ok());
}

#[test]
fn options_are_the_same_after_writing_and_reading_and_have_defaults() {
    let options = Options {
        scheme: Some(Scheme::Gauss { stages: 5 }),
        control: Control::Both,
        initial_intervals: 17,
        ..Options::to(1e-11)
    };
    let text = serde_json::to_string(&options).unwrap();
    assert_eq!(serde_json::from_str::<Options>(&text).unwrap(), options);
    let partial: Options = serde_json::from_str(r#"{ "tolerance": 1e-9 }"#).unwrap();
    assert_eq!(partial, Options::to(1e-9));
    assert!(serde_json::from_str::<Options>(r#"{ "tolerence": 1e-9 }"#).is_err());
    let invalid: Options = serde_json::from_str(r#"{ "tolerance": 1.0 }"#).unwrap();
    assert!(matches!(invalid.validate(), Err(Error::Tolerance { .. })));
}

#[test]
fn segments_are_written_with_their_joined_points() {
    let segment = Segment::on(2, 1.0, -1.0).joined(&[0.25]);
    let text = serde_json::to_string(&segment).unwrap();
    assert_eq!(serde_json::from_str::<Segment>(&text).unwrap(), segment);
}
