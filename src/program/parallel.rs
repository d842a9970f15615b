//! Independent evaluations on all processors.

use crate::executor::Executor;
use rayon::iter::{IndexedParallelIterator as _, IntoParallelIterator as _, ParallelIterator as _};

use super::progress::Progress;

/// On all processors, with progress where the work has a name.
pub struct Parallel;

impl Executor for Parallel {
    fn each(&self, what: &str, count: usize, f: &(dyn Fn(usize) + Sync)) {
        // Of a single piece nobody can say how far it is.
        let told = !what.is_empty() && count > 1;
        let progress = told.then(|| Progress::new(what, count as u64));
        (0..count).into_par_iter().with_max_len(1).for_each(|k| {
            f(k);
            if let Some(progress) = &progress {
                progress.advance(1);
            }
        });
    }
}
