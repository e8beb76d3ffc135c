//! The engine: the choice of the backend, and recovery from lost devices.

use super::direction::{DirectedRun, Direction};
use super::query::Opened;
use super::{Backend, Computation, DistanceOptions, DistanceResult, Method, MethodName, PreparedModel};
use crate::error::{Error, Result};
use crate::gpu::Gpu;
use crate::progress::Monitor;
use crate::progress::Progress;
use crate::threads::locked;
use std::sync::atomic::{AtomicU32, Ordering};
use std::sync::{Arc, Mutex};
use web_time::Instant;

/// The number of lost devices after which the CPU takes over; a second loss is
/// unlikely to be an accident.
const MAX_LOSSES: u32 = 2;

/// The notice about a relative tolerance of models without a size.
const NO_DIAGONAL: &str = "both models are single points, so that a tolerance relative to their diagonal is 0: the \
interval is as narrow as float64 allows; a tolerance in model units can be reached";

/// The notice about a pair that the kernels do not measure.
const BEYOND_FLOAT32: &str = "one model is a point, or far smaller than the other or than their distance, beyond what \
float32 holds; computed on the CPU";

/// Computes distances on one GPU, or on the CPU.
#[derive(Debug)]
pub struct Engine {
    gpu: Mutex<Option<Arc<Gpu>>>,
    losses: AtomicU32,
    /// Held while a lost device is replaced, for which other threads wait.
    replacing: async_lock::Mutex<()>,
    /// The reason for which there is no GPU although one was requested.
    missing: Mutex<Option<Error>>,
}

impl Engine {
    /// Makes an engine, with a GPU if there is one, unless `backend` is [`Backend::Cpu`].
    ///
    /// # Errors
    /// [`Error::NoAdapter`] if `backend` is [`Backend::Gpu`] and there is no adapter.
    pub async fn new(backend: Backend) -> Result<Self> {
        let engine = Self::cpu();
        if backend != Backend::Cpu {
            match Gpu::new().await {
                Ok(gpu) => *locked(&engine.gpu) = Some(Arc::new(gpu)),
                Err(error) if backend == Backend::Gpu => return Err(error),
                Err(error) => *locked(&engine.missing) = Some(error),
            }
        }
        Ok(engine)
    }

    /// As [`Self::new`], on this thread, which waits for the GPU.
    ///
    /// # Errors
    /// Those of [`Self::new`].
    #[cfg(not(target_arch = "wasm32"))]
    pub fn new_blocking(backend: Backend) -> Result<Self> {
        pollster::block_on(Self::new(backend))
    }

    /// Returns an engine without a GPU.
    #[must_use]
    pub fn cpu() -> Self {
        Self {
            gpu: Mutex::default(),
            losses: AtomicU32::new(0),
            replacing: async_lock::Mutex::default(),
            missing: Mutex::default(),
        }
    }

    /// Returns the name of the GPU, if there is a GPU and it has a name.
    #[must_use]
    pub fn adapter(&self) -> Option<String> {
        locked(&self.gpu).as_ref().and_then(|gpu| gpu.adapter())
    }

    /// Returns whether the engine has a GPU.
    #[must_use]
    pub fn has_gpu(&self) -> bool {
        locked(&self.gpu).is_some()
    }

    /// Returns the reason for which there is no GPU although one was requested.
    #[must_use]
    pub fn notice(&self) -> Option<String> {
        locked(&self.missing).as_ref().map(|error| format!("{error}; computed on the CPU"))
    }

    /// Returns the directed Hausdorff distance from A, moved by the options'
    /// transform, to B, or with `symmetric` the larger of both directions. With
    /// `scale_units` B is scaled to A's unit.
    ///
    /// Guarantee: `lower <= distance <= upper`. If the device is lost, the
    /// computation starts again on a new one, and after a second loss on the CPU.
    ///
    /// # Errors
    /// [`Error::OptionOutOfRange`]; [`Error::UnitsDiffer`]; [`Error::NoAdapter`] or
    /// [`Error::DeviceLost`] with [`Backend::Gpu`] only; [`Error::GpuFailed`];
    /// [`Error::PairBudgetExceeded`] with [`Method::Hierarchy`];
    /// [`Error::Cancelled`].
    pub fn distance<'a>(
        &'a self,
        a: &'a PreparedModel,
        b: &'a PreparedModel,
        options: &'a DistanceOptions,
    ) -> Computation<'a, DistanceResult> {
        Computation::new(move |mut watched| {
            Box::pin(async move { self.distance_of(a, b, options, watched.monitor()).await })
        })
    }

    pub(super) async fn distance_of(
        &self,
        a: &PreparedModel,
        b: &PreparedModel,
        options: &DistanceOptions,
        monitor: &mut dyn Monitor,
    ) -> Result<DistanceResult> {
        let opened = Opened::new([a, b], options)?;
        let hint = opened.hint();
        let mut progress = Progress::new(monitor, options.symmetric);
        let forward = self.directed(&opened.forward(), options, &mut progress).await?.into_forward();
        if !options.symmetric {
            progress.finish();
            return Ok(DistanceResult { hint, ..forward });
        }
        progress.second_half();
        let reverse = self.directed(&opened.reverse(), options, &mut progress).await?.into_reverse(options);
        progress.finish();
        Ok(DistanceResult { hint, ..DistanceResult::symmetric(forward, reverse) })
    }

    /// Runs one direction, and samples the field if the options request it; method
    /// `iteration` samples its own.
    async fn directed(
        &self,
        direction: &Direction<'_>,
        options: &DistanceOptions,
        progress: &mut Progress<'_>,
    ) -> Result<DirectedRun> {
        let mut run = self.run(direction, options, progress).await?;
        if options.deviations && options.method.name() != MethodName::Iteration && !run.is_cancelled() {
            let started = Instant::now();
            run.result.deviations = direction.deviations(options.samples, options.sampling, progress).await?;
            run.seconds.solve += started.elapsed().as_secs_f64();
        }
        Ok(run)
    }

    /// Returns the GPU for a requested backend, or `None` for the CPU.
    pub(super) fn gpu_for(&self, backend: Backend) -> Result<Option<Arc<Gpu>>> {
        let gpu = locked(&self.gpu).clone().filter(|_| backend != Backend::Cpu);
        if gpu.is_none() && backend == Backend::Gpu {
            return Err(match &*locked(&self.missing) {
                Some(Error::DeviceLost { found }) => Error::DeviceLost { found: found.clone() },
                Some(Error::NoAdapter { found }) => Error::NoAdapter { found: found.clone() },
                _ => Error::NoAdapter { found: "the engine was made without one".to_owned() },
            });
        }
        Ok(gpu)
    }

    /// Runs one direction by one method, again if the device is lost.
    async fn run(
        &self,
        direction: &Direction<'_>,
        options: &DistanceOptions,
        progress: &mut Progress<'_>,
    ) -> Result<DirectedRun> {
        let method = options.method.name();
        let in_range = direction.is_in_float32_range();
        if method != MethodName::Certified {
            direction.require_surfaces("a method other than certified")?;
        }
        loop {
            let device = self.gpu_for(options.backend)?;
            let gpu = device.as_ref().filter(|_| in_range);
            let run = {
                // Method certified asks for its turn when its cells are many enough.
                let _turn = match gpu.filter(|_| method != MethodName::Certified) {
                    Some(gpu) => Some(gpu.turn().await),
                    None => None,
                };
                match &options.method {
                    Method::Certified(budgets) if direction.is_of_facets() => {
                        direction.between_facets(options, budgets, progress).await
                    }
                    Method::Certified(budgets) => {
                        // A software adapter is about as fast as float64, which needs no set-up.
                        let helps = |gpu: &&Arc<Gpu>| options.backend == Backend::Gpu || !gpu.is_software();
                        direction.certified(gpu.filter(helps), options, budgets, progress).await
                    }
                    Method::Iteration(own) => direction.iteration(gpu, options, own, progress).await,
                    Method::Hierarchy(own) => direction.hierarchy(gpu, options, own, progress).await,
                }
            };
            match run {
                Err(Error::DeviceLost { found }) => match &device {
                    Some(lost) => self.replace(lost, &found, options.backend).await?,
                    None => return Err(Error::DeviceLost { found }),
                },
                Ok(mut run) => {
                    if method != MethodName::Certified && device.is_none() && options.backend != Backend::Cpu
                    {
                        run.notice = self.notice();
                    }
                    if method != MethodName::Certified && device.is_some() && !in_range {
                        run.add_notice(BEYOND_FLOAT32);
                    }
                    let relative = method != MethodName::Iteration && options.tolerance.is_none();
                    if relative && run.diagonal == 0.0 {
                        run.add_notice(NO_DIAGONAL);
                    }
                    return Ok(run);
                }
                other => return other,
            }
        }
    }

    /// Replaces a lost device by a new one, or by the CPU if it was not the first. Another
    /// thread that lost it as well may have done so already.
    pub(super) async fn replace(&self, lost: &Arc<Gpu>, found: &str, backend: Backend) -> Result<()> {
        let _turn = self.replacing.lock().await;
        if !locked(&self.gpu).as_ref().is_some_and(|gpu| Arc::ptr_eq(gpu, lost)) {
            return self.gpu_for(backend).map(drop);
        }
        *locked(&self.gpu) = None;
        let losses = self.losses.fetch_add(1, Ordering::Relaxed) + 1;
        let error = if losses < MAX_LOSSES {
            match Gpu::new().await {
                Ok(gpu) => {
                    *locked(&self.gpu) = Some(Arc::new(gpu));
                    return Ok(());
                }
                Err(error) => error,
            }
        } else {
            Error::DeviceLost { found: format!("{MAX_LOSSES} times, the last time: {found}") }
        };
        *locked(&self.missing) = Some(error);
        self.gpu_for(backend).map(drop)
    }
}

#[cfg(all(test, not(target_arch = "wasm32")))]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod tests {
    use super::*;
    use crate::engine::Processor;

    use crate::shapes::{shape, sphere_parts};

    /// Returns an engine on a GPU, or `None` and a visible line if the environment allows it.
    fn engine(test: &str) -> Option<Engine> {
        let engine = Engine::new_blocking(Backend::Auto).unwrap();
        if engine.has_gpu() {
            return Some(engine);
        }
        assert!(std::env::var_os("NURBS_HAUSDORFF_ALLOW_NO_GPU").is_some(), "{:?}", engine.notice());
        // Written directly, as libtest hides what a passing test prints by macro.
        let line = format!("\nSKIPPED {test}: no adapter\n");
        std::io::Write::write_all(&mut std::io::stderr(), line.as_bytes()).unwrap();
        None
    }

    #[test]
    fn a_lost_device_is_replaced_once_and_then_the_cpu_takes_over() {
        let test = "a_lost_device_is_replaced_once_and_then_the_cpu_takes_over";
        let Some(engine) = engine(test) else { return };
        let [a, b] =
            ["sphere", "sphere-larger"].map(|name| PreparedModel::new(&shape(name).unwrap()).unwrap());
        let options = DistanceOptions {
            method: MethodName::Iteration.into(),
            samples: 16,
            ..DistanceOptions::default()
        };
        let run = || engine.distance(&a, &b, &options).wait().unwrap();
        let lose = || locked(&engine.gpu).as_ref().unwrap().destroy();
        assert_eq!(run().backend, Processor::Gpu);
        lose();
        let second = run();
        assert_eq!((second.backend, second.notice), (Processor::Gpu, None));
        lose();
        let third = run();
        assert_eq!(third.backend, Processor::Cpu);
        assert!(third.notice.unwrap().contains("lost: 2 times"));
        assert!((third.computed - second.computed).abs() < 1e-9);
        assert!(!engine.has_gpu());
    }

    /// The rounding error of a distance between models of size 1.
    const ROUNDING: f64 = 1e-12;

    #[test]
    fn with_auto_float64_goes_on_when_the_gpu_fails_and_says_so() {
        let Some(engine) = engine("with_auto_float64_goes_on_when_the_gpu_fails_and_says_so") else { return };
        // Pretends to be hardware, as `auto` does not use the kernels of a software adapter.
        let gpu = Arc::into_inner(locked(&engine.gpu).take().unwrap()).unwrap().pretend_hardware();
        *locked(&engine.gpu) = Some(Arc::new(gpu));
        // All of A is equally far from B, and no bound on whole patches shows it: many cells.
        let [a, b] = sphere_parts([1.0, 1.1]).unwrap().map(|model| PreparedModel::new(&model).unwrap());
        let run = |backend| {
            let options = DistanceOptions { backend, ..DistanceOptions::default() };
            engine.distance(&a, &b, &options).wait()
        };
        let provoke_error = || locked(&engine.gpu).as_ref().unwrap().provoke_validation_error();
        let sound = run(Backend::Gpu).unwrap();
        let details = sound.certified().unwrap();
        assert!(details.cpu_cells < details.cells, "nothing to fail at");
        assert_eq!(sound.notice, None);

        provoke_error();
        let failed = run(Backend::Auto).unwrap();
        let details = failed.certified().unwrap();
        assert_eq!((failed.backend, failed.adapter), (Processor::Cpu, None));
        assert_eq!(details.cpu_cells, details.cells);
        assert!(failed.converged && failed.lower < 0.1 + ROUNDING && 0.1 - ROUNDING < failed.upper);
        let notice = failed.notice.unwrap();
        assert!(
            notice.contains("deliberate validation error")
                && notice.ends_with("; the rest was computed on the CPU"),
            "{notice}"
        );

        // A request for the GPU alone fails with an error.
        provoke_error();
        assert_eq!(run(Backend::Gpu).unwrap_err().code(), "GPU_FAILED");
        // The failure was reported once, and the device is still there.
        assert_eq!(run(Backend::Gpu).unwrap().notice, None);
    }
}
