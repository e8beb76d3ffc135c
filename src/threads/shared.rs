//! Values that are computed at first use and shared between threads.

use std::sync::{Mutex, MutexGuard, OnceLock, PoisonError};

/// Locks a value whose every state is valid, also one that a panic of another thread left.
///
/// No lock is held while work is done on the thread pool: a thread that waits for the pool
/// may be given work that wants the same lock.
pub(crate) fn locked<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Returns the value, computed unless it is there. Threads that come at once each compute
/// it, and the first one's is kept: none waits for another, for the reason in [`locked`].
pub(crate) fn computed<T>(cell: &OnceLock<T>, compute: impl FnOnce() -> T) -> &T {
    match cell.get() {
        Some(value) => value,
        None => {
            let value = compute();
            cell.get_or_init(|| value)
        }
    }
}
