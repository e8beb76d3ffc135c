//! Computations that have not begun: awaited, or waited for, with a monitor or without.

use crate::error::Result;
use crate::progress::{Monitor, NoMonitor};
use std::fmt::{Debug, Formatter};
use std::pin::Pin;

/// A computation, which begins when it is awaited or waited for.
///
/// ```
/// use nurbs_hausdorff::{Engine, DistanceOptions, PreparedModel, shapes::shape};
///
/// let engine = Engine::cpu();
/// let a = PreparedModel::new(&shape("sphere")?)?;
/// let b = PreparedModel::new(&shape("sphere-larger")?)?;
/// let result = engine.distance(&a, &b, &DistanceOptions::default()).wait()?;
/// assert!(result.upper - result.lower <= 1e-5);
/// # Ok::<(), nurbs_hausdorff::Error>(())
/// ```
#[must_use = "a computation begins when it is awaited or waited for"]
pub struct Computation<'a, T> {
    start: Start<'a, T>,
    monitor: Watched<'a>,
}

/// Begins a computation.
#[cfg(not(target_arch = "wasm32"))]
type Start<'a, T> = Box<dyn FnOnce(Watched<'a>) -> Running<'a, T> + Send + 'a>;
#[cfg(target_arch = "wasm32")]
type Start<'a, T> = Box<dyn FnOnce(Watched<'a>) -> Running<'a, T> + 'a>;

/// A computation that has begun, which may move between threads natively.
#[cfg(not(target_arch = "wasm32"))]
pub(crate) type Running<'a, T> = Pin<Box<dyn Future<Output = Result<T>> + Send + 'a>>;
#[cfg(target_arch = "wasm32")]
pub(crate) type Running<'a, T> = Pin<Box<dyn Future<Output = Result<T>> + 'a>>;

impl<'a, T> Computation<'a, T> {
    #[cfg(not(target_arch = "wasm32"))]
    pub(super) fn new(start: impl FnOnce(Watched<'a>) -> Running<'a, T> + Send + 'a) -> Self {
        Self { start: Box::new(start), monitor: Watched::Nobody(NoMonitor) }
    }

    #[cfg(target_arch = "wasm32")]
    pub(super) fn new(start: impl FnOnce(Watched<'a>) -> Running<'a, T> + 'a) -> Self {
        Self { start: Box::new(start), monitor: Watched::Nobody(NoMonitor) }
    }

    /// Reports progress to a monitor, which may cancel the computation.
    pub fn monitored(self, monitor: &'a mut dyn Monitor) -> Self {
        Self { monitor: Watched::By(monitor), ..self }
    }

    /// Computes on this thread and those of the pool, and returns when that is done.
    ///
    /// # Errors
    /// Those of the method that made the computation.
    #[cfg(not(target_arch = "wasm32"))]
    pub fn wait(self) -> Result<T> {
        pollster::block_on(self.into_future())
    }
}

impl<'a, T> IntoFuture for Computation<'a, T> {
    type Output = Result<T>;
    type IntoFuture = Running<'a, T>;

    fn into_future(self) -> Running<'a, T> {
        (self.start)(self.monitor)
    }
}

impl<T> Debug for Computation<'_, T> {
    fn fmt(&self, formatter: &mut Formatter<'_>) -> std::fmt::Result {
        formatter.debug_struct("Computation").finish_non_exhaustive()
    }
}

/// The monitor of a computation, if it has one.
pub(super) enum Watched<'a> {
    Nobody(NoMonitor),
    By(&'a mut dyn Monitor),
}

impl<'a> Watched<'a> {
    pub(super) fn monitor(&mut self) -> &mut (dyn Monitor + 'a) {
        match self {
            Self::Nobody(none) => none,
            Self::By(monitor) => *monitor,
        }
    }
}
