//! Work that is shared among threads.

/// The results of so many pieces of work, in their order, by several threads at a time.
#[cfg(feature = "parallel")]
pub(super) fn each<T: Send>(count: usize, work: impl Fn(usize) -> T + Send + Sync) -> Vec<T> {
    use rayon::iter::{IntoParallelIterator, ParallelIterator};
    (0..count).into_par_iter().map(work).collect()
}

/// The results of so many pieces of work, in their order.
#[cfg(not(feature = "parallel"))]
pub(super) fn each<T>(count: usize, work: impl Fn(usize) -> T) -> Vec<T> {
    (0..count).map(work).collect()
}
