//! The measurements.

use crate::convert::{self, Motion, to_dict};
use crate::failure;
use crate::maps;
use crate::model::Model;
use crate::running::{Caller, on_live_threads, run};
use numpy::PyReadonlyArray1;
use nurbs_hausdorff::result::Stop;
use nurbs_hausdorff::{
    Backend, BestFitOptions, CheckOptions, ClearanceOptions, ClosestPointOptions, DeviationMapOptions,
    DiffOptions, DistanceOptions, DistanceResult, Engine, FieldOptions, GapOptions, NamedModel, NamedOptions,
    OverlapOptions, PreparedModel, Query, ScoreOptions, SignedDistanceOptions, StatisticsOptions,
};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::PyDict;
use serde::de::DeserializeOwned;

/// The engine of everything that needs no GPU.
static CPU: PyOnceLock<Engine> = PyOnceLock::new();
/// The engine with the GPU, if there is one.
static GPU: PyOnceLock<Engine> = PyOnceLock::new();

/// Returns the engine of everything that needs no GPU.
fn cpu(py: Python<'_>) -> &Engine {
    CPU.get_or_init(py, Engine::cpu)
}

/// Returns the engine of a question.
fn engine_for(py: Python<'_>, may_use_gpu: bool) -> PyResult<&Engine> {
    if !may_use_gpu {
        return Ok(cpu(py));
    }
    GPU.get_or_try_init(py, || {
        let engine = py.detach(|| on_live_threads(|| Engine::new_blocking(Backend::Auto)))?;
        engine.map_err(|error| failure::of_error(py, &error))
    })
}

/// Whether a direction was cancelled.
fn is_cancelled(result: &DistanceResult) -> bool {
    result.certified().is_some_and(|details| details.stop == Stop::Cancelled)
        || [&result.forward, &result.reverse].into_iter().flatten().any(|direction| is_cancelled(direction))
}

/// Returns the answer to the question of a distance.
fn distance<'py>(py: Python<'py>, asked: Asked<'_, 'py>) -> PyResult<Bound<'py, PyDict>> {
    let Asked { models, options, motion, report } = asked;
    let mut named: NamedOptions = convert::options(options)?;
    named.transform = convert::transform(py, motion)?;
    let options = DistanceOptions::try_from(named).map_err(|error| failure::of_error(py, &error))?;
    let engine = engine_for(py, options.may_use_gpu())?;
    let compute = |caller: &mut Caller| options.ask(engine, models).monitored(caller).wait();
    let result = run(py, report, compute, is_cancelled)?;
    let dict = to_dict(py, &result)?;
    for (name, direction) in [("forward", result.forward), ("reverse", result.reverse)] {
        if let Some(direction) = direction {
            let fields = convert::fields(py, direction.deviations)?;
            dict.as_any().get_item(name)?.set_item("deviations", fields)?;
        }
    }
    dict.set_item("deviations", convert::fields(py, result.deviations)?)?;
    Ok(dict)
}

/// Answers a question about two models by its name; the options and the dictionary returned have the crate's own names.
#[pyfunction]
pub(crate) fn ask<'py>(
    py: Python<'py>,
    query: &str,
    a: &Model,
    b: &Model,
    options: &Bound<'py, PyDict>,
    motion: Motion,
    report: Option<Py<PyAny>>,
) -> PyResult<Bound<'py, PyDict>> {
    let asked = Asked { models: [a.prepared(), b.prepared()], options, motion, report };
    match query {
        "best_fit" => to_dict(py, &asked.answer::<BestFitOptions>(py, |_| false)?),
        "clearance" => to_dict(py, &asked.answer::<ClearanceOptions>(py, |found| is_stopped(found.stop))?),
        "deviation_maps" => maps::arrays(py, asked.answer::<DeviationMapOptions>(py, |_| false)?),
        "diff" => {
            let result = asked.answer::<DiffOptions>(py, |_| false)?;
            let dict = to_dict(py, &result)?;
            dict.set_item("partsSummary", result.parts_summary())?;
            Ok(dict)
        }
        "distance" => distance(py, asked),
        "field" => convert::field(py, asked.answer::<FieldOptions>(py, |_| false)?),
        "gaps" => to_dict(py, &asked.answer::<GapOptions>(py, |_| false)?),
        "overlap" => to_dict(py, &asked.answer::<OverlapOptions>(py, |found| is_stopped(found.stop))?),
        "score" => to_dict(py, &asked.answer::<ScoreOptions>(py, |_| false)?),
        "statistics" => to_dict(py, &asked.answer::<StatisticsOptions>(py, |_| false)?),
        other => Err(PyValueError::new_err(format!("there is no question {other:?}"))),
    }
}

/// Whether a search was cancelled, which returned what it had.
fn is_stopped(stop: Stop) -> bool {
    stop == Stop::Cancelled
}

/// A question about two models, as Python asks it.
struct Asked<'a, 'py> {
    models: [&'a PreparedModel; 2],
    options: &'a Bound<'py, PyDict>,
    motion: Motion,
    report: Option<Py<PyAny>>,
}

impl<'py> Asked<'_, 'py> {
    /// Returns the answer. `is_cancelled` is true for one that a cancelled computation returned.
    fn answer<Q: Query<Answer: Send> + DeserializeOwned + Sync>(
        self,
        py: Python<'py>,
        is_cancelled: impl FnOnce(&Q::Answer) -> bool,
    ) -> PyResult<Q::Answer> {
        let Self { models, options, motion, report } = self;
        let question = convert::options::<Q>(options)?.moved(convert::transform(py, motion)?);
        let engine = cpu(py);
        let compute = |caller: &mut Caller| question.ask(engine, models).monitored(caller).wait();
        run(py, report, compute, is_cancelled)
    }
}

#[pyfunction]
pub(crate) fn check<'py>(
    py: Python<'py>,
    models: Vec<(Option<String>, PyRef<'py, Model>)>,
    options: &Bound<'py, PyDict>,
    report: Option<Py<PyAny>>,
) -> PyResult<Bound<'py, PyDict>> {
    let options: CheckOptions = convert::options(options)?;
    let named =
        models.iter().map(|(name, model)| NamedModel { name: name.as_deref(), model: model.prepared() });
    let models: Vec<NamedModel<'_>> = named.collect();
    let engine = cpu(py);
    let compute = |caller: &mut Caller| engine.check(&models, &options).monitored(caller).wait();
    to_dict(py, &run(py, report, compute, |_| false)?)
}

#[pyfunction]
pub(crate) fn closest_points<'py>(
    py: Python<'py>,
    model: &Model,
    points: PyReadonlyArray1<'py, f64>,
    options: &Bound<'py, PyDict>,
    motion: Motion,
    report: Option<Py<PyAny>>,
) -> PyResult<Bound<'py, PyDict>> {
    let mut options: ClosestPointOptions = convert::options(options)?;
    options.transform = convert::transform(py, motion)?;
    // Copied, because other threads may write to the array meanwhile.
    let points = points.as_array().to_vec();
    let engine = engine_for(py, options.backend != Backend::Cpu)?;
    let compute = |caller: &mut Caller| {
        engine.closest_points(model.prepared(), &points, &options).monitored(caller).wait()
    };
    convert::closest_points(py, run(py, report, compute, |_| false)?)
}

#[pyfunction]
pub(crate) fn signed_distances<'py>(
    py: Python<'py>,
    model: &Model,
    options: &Bound<'py, PyDict>,
    report: Option<Py<PyAny>>,
) -> PyResult<Bound<'py, PyDict>> {
    let options: SignedDistanceOptions = convert::options(options)?;
    let engine = cpu(py);
    let compute =
        |caller: &mut Caller| engine.signed_distances(model.prepared(), &options).monitored(caller).wait();
    convert::signed_distances(py, run(py, report, compute, |_| false)?)
}
