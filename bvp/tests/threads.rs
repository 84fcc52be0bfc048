//! Solutions by several threads.

use bvp::{
    Control, Ends, Equations, Error, Family, Options, Problem, Real, Segment, Solution, Table,
    solve,
};

/// y'' = (3/2) y², y(0) = 4, y(1) = 1 on both segments, on the second beside u' = p u, u(0) = 1 and
/// u(1) given.
struct Power {
    end: f64,
}

impl Problem for Power {
    fn segments(&self) -> Vec<Segment> {
        vec![Segment::new(2), Segment::new(3)]
    }

    fn parameters(&self) -> usize {
        1
    }

    fn rhs<T: Real>(&self, _: usize, _s: T, y: &[T], p: &[T], dy: &mut [T]) {
        dy[0] = y[1];
        dy[1] = y[0] * y[0] * 1.5;
        if let Some(du) = dy.get_mut(2) {
            *du = y[2] * p[0];
        }
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, _p: &[T], r: &mut [T]) {
        for i in 0..2 {
            r[2 * i] = at.start(i)[0] - 4.0;
            r[2 * i + 1] = at.end(i)[0] - 1.0;
        }
        r[4] = at.start(1)[2] - 1.0;
        r[5] = at.end(1)[2] - self.end;
    }
}

/// The solution from a constant guess on so many intervals on each segment.
fn solution(equations: &dyn Equations, intervals: usize) -> Result<Solution, Error> {
    let nodes: Vec<f64> = (0..=intervals)
        .map(|i| i as f64 / intervals as f64)
        .collect();
    let guess = Table {
        states: [2, 3].map(|n| vec![1.0; n * nodes.len()]).to_vec(),
        nodes: vec![nodes; 2],
        parameters: vec![1.0],
    };
    let options = Options {
        control: Control::Defect,
        retries: 0,
        ..Options::default()
    };
    solve(equations, &guess, &options)
}

/// All that a solution consists of, to the last bit.
fn bits(solution: &Solution) -> Vec<u64> {
    let mut values = solution.parameters().to_vec();
    for (segment, states) in [2, 3].into_iter().enumerate() {
        let mut y = vec![0.0; states];
        for pair in solution.mesh(segment).windows(2) {
            for theta in [0.0, 0.3, 1.0] {
                solution.state(segment, pair[0] + theta * (pair[1] - pair[0]), &mut y);
                values.extend(&y);
            }
        }
        values.extend(solution.defects(segment));
    }
    values.into_iter().map(f64::to_bits).collect()
}

#[test]
fn what_is_passed_between_threads_can_be() {
    fn passes<T: Send + Sync>() {}
    passes::<Options>();
    passes::<Solution>();
    passes::<Error>();
    passes::<Family<'_>>();
}

#[test]
fn threads_that_solve_at_once_do_not_disturb_each_other() {
    let problems: Vec<Power> = (1..=24).map(|i| Power { end: f64::from(i) }).collect();
    let alone = |problem: &Power| bits(&solution(problem, 20).unwrap());
    let expected: Vec<_> = problems.iter().map(alone).collect();
    let found: Vec<_> = std::thread::scope(|scope| {
        let threads: Vec<_> = problems
            .chunks(3)
            .map(|some| scope.spawn(move || some.iter().map(alone).collect::<Vec<_>>()))
            .collect();
        let joined = threads.into_iter().map(|thread| thread.join().unwrap());
        joined.flatten().collect()
    });
    assert_eq!(found, expected);
}

#[cfg(feature = "parallel")]
mod parallel {
    use super::*;
    use bvp::LeftOf;
    use std::collections::HashSet;
    use std::sync::Mutex;
    use std::thread::{ThreadId, current};

    /// The same, with the threads that evaluate; not a number beyond a place.
    struct Watched {
        threads: Mutex<HashSet<ThreadId>>,
        beyond: f64,
    }

    impl Watched {
        fn new(beyond: f64) -> Self {
            let threads = Mutex::default();
            Self { threads, beyond }
        }
    }

    impl Problem for Watched {
        fn segments(&self) -> Vec<Segment> {
            Problem::segments(&Power { end: 2.0 })
        }

        fn parameters(&self) -> usize {
            1
        }

        fn rhs<T: Real>(&self, segment: usize, s: T, y: &[T], p: &[T], dy: &mut [T])
        where
            f64: LeftOf<T>,
        {
            self.threads.lock().unwrap().insert(current().id());
            Problem::rhs(&Power { end: 2.0 }, segment, s, y, p, dy);
            if segment == 1 && s.value() > self.beyond {
                dy[2] = T::from_f64(f64::NAN);
            }
        }

        fn conditions<T: Real>(&self, at: Ends<'_, T>, p: &[T], r: &mut [T])
        where
            f64: LeftOf<T>,
        {
            Problem::conditions(&Power { end: 2.0 }, at, p, r);
        }
    }

    /// What `work` gives in a pool of so many threads.
    fn with_threads<T: Send>(count: usize, work: impl FnOnce() -> T + Send) -> T {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(count).build();
        pool.unwrap().install(work)
    }

    #[test]
    fn the_number_of_threads_does_not_change_a_bit() {
        let problem = Power { end: 2.0 };
        let large = || bits(&solution(&problem, 4000).unwrap());
        let expected = with_threads(1, large);
        for count in [2, 3, 8] {
            assert!(with_threads(count, large) == expected, "{count} threads");
        }
    }

    #[test]
    fn small_problems_are_evaluated_on_the_thread_of_the_caller() {
        let small = Watched::new(2.0);
        solution(&small, 50).unwrap();
        let threads = small.threads.into_inner().unwrap();
        assert_eq!(threads, HashSet::from([current().id()]));
        let large = Watched::new(2.0);
        with_threads(1, || solution(&large, 4000).unwrap());
        assert!(
            !large
                .threads
                .into_inner()
                .unwrap()
                .contains(&current().id())
        );
    }

    #[test]
    fn the_first_failure_is_reported() {
        for count in [1, 2, 4] {
            let failing = Watched::new(0.3);
            let error = with_threads(count, || solution(&failing, 4000).unwrap_err());
            let Error::NonFiniteRhs { segment, s, .. } = error else {
                panic!("{error}");
            };
            assert_eq!(segment, 1);
            assert!(s > 0.3 && s < 0.3 + 1.0 / 4000.0, "{s}");
        }
    }
}
