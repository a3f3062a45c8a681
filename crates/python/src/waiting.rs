//! Work on another thread, while this one looks after Ctrl-C and whoever watches.

use illuminant_radiosity::Cancel;
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use std::sync::mpsc::{Receiver, RecvTimeoutError, channel};
use std::sync::{Mutex, PoisonError};
use std::time::Duration;

/// Does work on another thread, and cancels it when Ctrl-C comes, which is then raised.
pub(crate) fn interruptible<T: Send>(
    py: Python<'_>,
    cancel: &Cancel,
    work: impl FnOnce() -> T + Send,
) -> PyResult<T> {
    watched(py, &|| cancel.cancel(), || Ok(true), work)
}

/// Does work on another thread, and cancels it when Ctrl-C comes or `goes_on`, asked ten times a second, says no or fails. What the work
/// gives comes back even then, unless there is an error to raise.
pub(crate) fn watched<T: Send>(
    py: Python<'_>,
    cancel: &dyn Fn(),
    goes_on: impl Fn() -> PyResult<bool>,
    work: impl FnOnce() -> T + Send,
) -> PyResult<T> {
    let (sender, receiver) = channel();
    // Behind a lock, since the interpreter wants to see only what threads may share.
    let receiver = Mutex::new(receiver);
    std::thread::scope(|scope| {
        let worker = scope.spawn(move || {
            let result = work();
            let _ = sender.send(());
            result
        });
        let mut raised = None;
        while !py.detach(|| wait(&receiver)) {
            if raised.is_some() {
                continue;
            }
            match py.check_signals().and_then(|()| goes_on()) {
                Ok(true) => {}
                Ok(false) => cancel(),
                Err(error) => {
                    cancel();
                    raised = Some(error);
                }
            }
        }
        let result = worker.join().map_err(|_| PyRuntimeError::new_err("a thread of the core died"))?;
        raised.map_or(Ok(result), Err)
    })
}

/// Waits for the end of the work, a tenth of a second at most; whether it came.
fn wait(receiver: &Mutex<Receiver<()>>) -> bool {
    let receiver = receiver.lock().unwrap_or_else(PoisonError::into_inner);
    receiver.recv_timeout(Duration::from_millis(100)) != Err(RecvTimeoutError::Timeout)
}
