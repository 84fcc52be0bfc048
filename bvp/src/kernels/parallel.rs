//! Work on the intervals of a segment, shared among threads where this saves time.
//!
//! Nearly all work of a Newton step is done interval by interval: right-hand sides and Jacobians at the
//! stages, the condensation and the recovery of the stages, and then the defects. With the feature
//! `parallel` a long run of intervals is halved until its parts are too short to be shared, and idle
//! threads of rayon's pool take parts of it. The work on an interval does not depend on its thread, and
//! nothing is summed over intervals, so that the results are the same to the last bit for any number of
//! threads, and without the feature.
//!
//! The elimination of the nodes, each of which needs the previous one, stays on one thread.

#[cfg(feature = "parallel")]
use rayon::join;
use std::ops::Range;

/// The least cost, in multiplications, of each half for a run to be halved. Linear problems of four
/// states on two threads: no gain at 200 intervals, a third less time at 400.
const WORTH_SHARING: usize = 100_000;

/// Results for consecutive intervals, of the same size for each interval.
pub(crate) trait Written: Send + Sized {
    /// The results for the first `some` of `all` intervals, and for the others.
    fn split(self, some: usize, all: usize) -> (Self, Self);
}

impl<T: Send> Written for &mut [T] {
    fn split(self, some: usize, all: usize) -> (Self, Self) {
        let each = self.len() / all;
        self.split_at_mut(some * each)
    }
}

impl<A: Written, B: Written> Written for (A, B) {
    fn split(self, some: usize, all: usize) -> (Self, Self) {
        let (a, b) = (self.0.split(some, all), self.1.split(some, all));
        ((a.0, b.0), (a.1, b.1))
    }
}

/// Scratch space for the work on a run; every thread has a copy.
pub(crate) trait Buffers: Clone + Send {
    /// Adds what a copy has observed. Buffers that are only scratch space have nothing to add.
    fn merge(&mut self, _copy: Self) {}
}

impl Buffers for () {}

/// Does `work` on a run of intervals, or on parts of it by several threads. An interval takes about
/// `cost` multiplications.
///
/// # Errors
/// The error of the first interval that fails, if `work` stops at the first one of its run that fails.
pub(crate) fn for_each_run<W: Written, B: Buffers, E: Send>(
    run: Range<usize>,
    cost: usize,
    written: W,
    buffers: &mut B,
    work: &(impl Fn(Range<usize>, W, &mut B) -> Result<(), E> + Sync),
) -> Result<(), E> {
    let (all, half) = (run.len(), run.len() / 2);
    if cfg!(feature = "parallel") && half * cost >= WORTH_SHARING {
        let (before, after) = (run.start..run.start + half, run.start + half..run.end);
        let (first, second) = written.split(half, all);
        let mut copy = buffers.clone();
        let (one, other) = join(
            || for_each_run(before, cost, first, buffers, work),
            || for_each_run(after, cost, second, &mut copy, work),
        );
        buffers.merge(copy);
        return one.and(other);
    }
    work(run, written, buffers)
}

/// One after the other.
#[cfg(not(feature = "parallel"))]
fn join<A, B>(one: impl FnOnce() -> A, other: impl FnOnce() -> B) -> (A, B) {
    (one(), other())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The largest index of an interval that was worked on.
    #[derive(Clone)]
    struct Largest(usize);

    impl Buffers for Largest {
        fn merge(&mut self, copy: Self) {
            self.0 = self.0.max(copy.0);
        }
    }

    /// Adds the index of every interval to a first number and to two others; fails at some.
    fn fill(
        run: Range<usize>,
        (once, twice): (&mut [usize], &mut [usize]),
        largest: &mut Largest,
        failing: &[usize],
    ) -> Result<(), usize> {
        for ((i, once), twice) in run.zip(once).zip(twice.chunks_exact_mut(2)) {
            *once += i;
            twice.iter_mut().for_each(|x| *x += i);
            largest.0 = largest.0.max(i);
            if failing.contains(&i) {
                return Err(i);
            }
        }
        Ok(())
    }

    #[test]
    fn every_interval_is_worked_on_once_and_the_first_failure_is_told() {
        for all in [1, 2, 7, 1000] {
            for cost in [1, WORTH_SHARING / 100, WORTH_SHARING] {
                let (mut once, mut twice) = (vec![0; all], vec![0; 2 * all]);
                let mut largest = Largest(0);
                let mut outcome = |failing: &[usize]| {
                    let written = (&mut once[..], &mut twice[..]);
                    let work = |run: Range<usize>, written: (&mut [_], &mut [_]), b: &mut _| {
                        fill(run, written, b, failing)
                    };
                    for_each_run(0..all, cost, written, &mut largest, &work)
                };
                assert_eq!(outcome(&[]), Ok(()));
                let failing = [all - 1, all / 2, all / 3];
                assert_eq!(outcome(&failing), Err(all / 3));
                assert_eq!(largest.0, all - 1);
                for i in 0..=all / 3 {
                    assert_eq!([once[i], twice[2 * i], twice[2 * i + 1]], [2 * i; 3]);
                }
                for i in all / 3 + 1..all {
                    assert!([i, 2 * i].contains(&once[i]));
                    assert_eq!(twice[2 * i..][..2], [once[i]; 2]);
                }
            }
        }
    }
}
