//! Work on other threads, without Python's lock, while the calling thread looks for Ctrl-C and tells progress.

use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::thread;
use std::time::Duration;

use pyo3::prelude::*;
use pyo3::types::PyDict;
use rayon::iter::{IndexedParallelIterator as _, IntoParallelIterator as _, ParallelIterator as _};
use serde::Serialize;
use vinesink::executor::Executor;

use crate::errors::{InternalError, refused};

/// Time between two looks for Ctrl-C and two calls of `progress`.
const LOOK: Duration = Duration::from_millis(100);

/// How far work is, and whether it is to go on.
#[derive(Default)]
pub struct WorkState {
    steps: AtomicU64,
    done: AtomicU64,
    stopped: AtomicBool,
}

/// What unwinds work that is to stop.
struct Stopped;

impl WorkState {
    /// Announces so many steps.
    pub fn expect(&self, steps: u64) {
        self.steps.fetch_add(steps, Ordering::Relaxed);
    }

    /// Some steps more are done; see [`WorkState::goes_on`].
    pub fn advance(&self, steps: u64) {
        self.done.fetch_add(steps, Ordering::Relaxed);
        self.goes_on();
    }

    /// Does not return from work that is to stop. Each piece of many begins with it: what one of them unwinds does not
    /// keep the others from being begun.
    pub fn goes_on(&self) {
        if self.stopped.load(Ordering::Relaxed) {
            resume_unwind(Box::new(Stopped));
        }
    }

    fn look(&self, py: Python<'_>, progress: Option<&Py<PyAny>>) -> PyResult<()> {
        py.check_signals()?;
        let steps = self.steps.load(Ordering::Relaxed);
        match progress {
            Some(progress) if steps > 0 => {
                let done = self.done.load(Ordering::Relaxed).min(steps);
                progress.call1(py, (done, steps)).map(drop)
            }
            _ => Ok(()),
        }
    }
}

/// On all processors.
impl Executor for WorkState {
    fn each(&self, what: &str, count: usize, f: &(dyn Fn(usize) + Sync)) {
        let named = !what.is_empty();
        if named {
            self.expect(count as u64);
        }
        (0..count).into_par_iter().with_max_len(1).for_each(|k| {
            WorkState::goes_on(self);
            f(k);
            if named {
                self.advance(1);
            }
        });
    }

    fn goes_on(&self) {
        WorkState::goes_on(self);
    }

    fn expect(&self, steps: u64) {
        WorkState::expect(self, steps);
    }

    fn advance(&self, steps: u64) {
        WorkState::advance(self, steps);
    }
}

/// Does some work. `progress`, if there is one, is called now and then with steps done and all steps, and once at the
/// end; an exception that it raises ends the work as Ctrl-C does.
///
/// # Errors
/// Those of the work, of `progress` and of Python's signal handlers; [`InternalError`] where the work panics.
pub fn done<T: Send>(
    py: Python<'_>,
    progress: Option<Py<PyAny>>,
    work: impl FnOnce(&WorkState) -> PyResult<T> + Send,
) -> PyResult<T> {
    let shared = WorkState::default();
    let watch = || {
        thread::scope(|scope| {
            let (tell, told) = channel();
            scope.spawn(|| {
                // Whatever it leaves half done is dropped with it.
                let result = catch_unwind(AssertUnwindSafe(|| work(&shared)));
                let _ = tell.send(result);
                drop(tell);
            });
            let mut ended = Ok(());
            let result = loop {
                match told.recv_timeout(LOOK) {
                    Ok(result) => break result,
                    Err(RecvTimeoutError::Timeout) if ended.is_ok() => {
                        ended = Python::attach(|py| shared.look(py, progress.as_ref()));
                        shared.stopped.store(ended.is_err(), Ordering::Relaxed);
                    }
                    Err(RecvTimeoutError::Timeout) => {}
                    Err(RecvTimeoutError::Disconnected) => break Err(Box::new(Stopped) as _),
                }
            };
            ended.and_then(|()| result.unwrap_or_else(|panic| Err(fault(&*panic))))
        })
    };
    let result = py.detach(watch)?;
    shared.look(py, progress.as_ref())?;
    Ok(result)
}

fn fault(panic: &(dyn Any + Send)) -> PyErr {
    let text = panic.downcast_ref::<&str>().map(|text| (*text).to_owned());
    let text = text.or_else(|| panic.downcast_ref::<String>().cloned()).unwrap_or_default();
    InternalError::new_err(format!(
        "{text}; this is a fault in vinesink: please report it with the case"
    ))
}

/// Columns of a table, by name.
pub type Columns<'py> = Bound<'py, PyDict>;

/// A document as the program prints it.
pub fn json(document: &impl Serialize) -> PyResult<String> {
    serde_json::to_string(document).map_err(refused)
}

/// For tests: panics as a fault in the physics would.
#[pyfunction]
#[pyo3(name = "_fail")]
pub fn fail(py: Python<'_>, message: String) -> PyResult<()> {
    done(py, None, |_| panic!("{message}"))
}
