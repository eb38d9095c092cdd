//! Work that signals end, such as that of Ctrl-C. Python sees to them in its main thread alone, so that thread does not
//! work but waits, and looks for them.

use std::sync::OnceLock;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;
use std::time::Duration;

use pyo3::exceptions::PyKeyboardInterrupt;
use pyo3::prelude::*;
use rayon::prelude::*;
use tunnelproof_float_env::{with_default, with_restored};

/// How often signals are looked for.
const PAUSE: Duration = Duration::from_millis(50);

/// Of so few items nobody waits for the end, and to start a thread would take longer than they do.
const FEW: usize = 16;

/// What `work` gives, done in a thread of its own. What a handler of a signal raises meanwhile goes to `end`, which has
/// to see that the work ends soon.
pub(crate) fn watched<T: Send>(
    py: Python<'_>,
    work: impl FnOnce() -> T + Send,
    end: impl Fn(PyErr),
) -> T {
    let waiting = thread::current();
    let is_done = AtomicBool::new(false);
    thread::scope(|scope| {
        let working = scope.spawn(|| {
            let result = with_default(work);
            // Said before it is woken: the thread ends a little later.
            is_done.store(true, Ordering::Release);
            waiting.unpark();
            result
        });
        // A panic says nothing.
        while !is_done.load(Ordering::Acquire) && !working.is_finished() {
            py.detach(|| thread::park_timeout(PAUSE));
            if let Err(error) = with_restored(|| py.check_signals()) {
                end(error);
            }
        }
        working
            .join()
            .unwrap_or_else(|panic| std::panic::resume_unwind(panic))
    })
}

/// What `work` gives of each of these, by all threads. Python can run meanwhile, and what a handler of a signal raises
/// ends it after the items that are being worked on.
pub(crate) fn each<I: Sync, T: Send>(
    py: Python<'_>,
    items: &[I],
    work: impl Fn(&I) -> T + Sync,
) -> PyResult<Vec<T>> {
    // A thread of the pool must not wait for the pool. It asks for a method that is judged, whose judge is watched.
    if items.len() < FEW || rayon::current_thread_index().is_some() {
        return Ok(py.detach(|| items.par_iter().map(&work).collect()));
    }
    let ending = OnceLock::new();
    let done: Option<Vec<T>> = watched(
        py,
        || {
            let one = |item| ending.get().is_none().then(|| work(item));
            items.par_iter().map(one).collect()
        },
        |error: PyErr| {
            // The first is raised.
            let _ = ending.set(error);
        },
    );
    match (done, ending.into_inner()) {
        (Some(all), None) => Ok(all),
        (_, error) => Err(error.unwrap_or_else(|| PyKeyboardInterrupt::new_err(()))),
    }
}
