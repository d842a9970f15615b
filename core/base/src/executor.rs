//! Many independent evaluations: one after the other, or side by side with the same results. The library
//! starts no threads; a program passes in an [`Executor`] that does.

use std::sync::OnceLock;

/// Carries out independent evaluations.
pub trait Executor: Sync {
    /// Calls `f` once with each number below `count`, in any order. `what` names the work to a user, who
    /// is told nothing where it is empty.
    fn each(&self, what: &str, count: usize, f: &(dyn Fn(usize) + Sync));

    /// Called now and then within a long evaluation. It does not return where the work is to stop.
    fn goes_on(&self) {}

    /// A single evaluation has so many steps, which [`Executor::advance`] counts.
    fn expect(&self, _steps: u64) {}

    /// Some steps more of it are done.
    fn advance(&self, _steps: u64) {}
}

/// What `f` returns for each number below `count`, in their order.
pub fn map<T: Send + Sync>(
    executor: &dyn Executor,
    what: &str,
    count: usize,
    f: impl Fn(usize) -> T + Sync,
) -> Vec<T> {
    let results: Vec<OnceLock<T>> = (0..count).map(|_| OnceLock::new()).collect();
    executor.each(what, count, &|k| {
        // Each number comes once, so that the place is empty.
        let _ = results[k].set(f(k));
    });
    results.into_iter().filter_map(OnceLock::into_inner).collect()
}

/// One after the other, in the caller's thread.
#[derive(Debug, Clone, Copy, Default)]
pub struct Serial;

impl Executor for Serial {
    fn each(&self, _: &str, count: usize, f: &(dyn Fn(usize) + Sync)) {
        (0..count).for_each(f);
    }
}
