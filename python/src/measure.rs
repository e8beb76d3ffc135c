//! The measurements.

use crate::convert::{self, Motion, to_dict};
use crate::failure;
use crate::model::Model;
use crate::running::{Caller, on_live_threads, run};
use numpy::PyReadonlyArray1;
use nurbs_hausdorff::result::Stop;
use nurbs_hausdorff::{
    Backend, BestFitOptions, CheckOptions, ClearanceOptions, ClosestPointOptions, DiffOptions,
    DistanceOptions, DistanceResult, Engine, FieldOptions, GapOptions, MethodName, NamedModel, NamedOptions,
    OverlapOptions, ScoreOptions, SignedDistanceOptions, StatisticsOptions,
};
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::PyDict;

/// The engine of everything that needs no GPU.
static CPU: PyOnceLock<Engine> = PyOnceLock::new();
/// The engine with the GPU, if there is one.
static GPU: PyOnceLock<Engine> = PyOnceLock::new();

/// Returns the engine of everything that needs no GPU.
pub(crate) fn cpu(py: Python<'_>) -> &Engine {
    CPU.get_or_init(py, Engine::cpu)
}

/// Returns the engine for a distance: method `certified` usually ends in float64 before a GPU
/// could be initialised.
fn engine_for<'py>(py: Python<'py>, options: &DistanceOptions) -> PyResult<&'py Engine> {
    let staged = options.method.name() != MethodName::Certified || options.deviations;
    if !(options.backend == Backend::Gpu || staged && options.backend == Backend::Auto) {
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

#[pyfunction]
pub(crate) fn distance<'py>(
    py: Python<'py>,
    a: &Model,
    b: &Model,
    options: &Bound<'py, PyDict>,
    motion: Motion,
    report: Option<Py<PyAny>>,
) -> PyResult<Bound<'py, PyDict>> {
    let mut named: NamedOptions = convert::options(options)?;
    named.transform = convert::transform(py, motion)?;
    let options = DistanceOptions::try_from(named).map_err(|error| failure::of_error(py, &error))?;
    let engine = engine_for(py, &options)?;
    let compute =
        |caller: &mut Caller| engine.distance(a.prepared(), b.prepared(), &options).monitored(caller).wait();
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

#[pyfunction]
pub(crate) fn diff<'py>(
    py: Python<'py>,
    a: &Model,
    b: &Model,
    options: &Bound<'py, PyDict>,
    motion: Motion,
    report: Option<Py<PyAny>>,
) -> PyResult<Bound<'py, PyDict>> {
    let mut options: DiffOptions = convert::options(options)?;
    options.transform = convert::transform(py, motion)?;
    let engine = cpu(py);
    let compute =
        |caller: &mut Caller| engine.diff(a.prepared(), b.prepared(), &options).monitored(caller).wait();
    let result = run(py, report, compute, |_| false)?;
    let dict = to_dict(py, &result)?;
    dict.set_item("partsSummary", result.parts_summary())?;
    Ok(dict)
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
pub(crate) fn clearance<'py>(
    py: Python<'py>,
    a: &Model,
    b: &Model,
    options: &Bound<'py, PyDict>,
    motion: Motion,
    report: Option<Py<PyAny>>,
) -> PyResult<Bound<'py, PyDict>> {
    let mut options: ClearanceOptions = convert::options(options)?;
    options.transform = convert::transform(py, motion)?;
    let engine = cpu(py);
    let compute =
        |caller: &mut Caller| engine.clearance(a.prepared(), b.prepared(), &options).monitored(caller).wait();
    to_dict(py, &run(py, report, compute, |result| result.stop == Stop::Cancelled)?)
}

#[pyfunction]
pub(crate) fn overlap<'py>(
    py: Python<'py>,
    a: &Model,
    b: &Model,
    options: &Bound<'py, PyDict>,
    motion: Motion,
    report: Option<Py<PyAny>>,
) -> PyResult<Bound<'py, PyDict>> {
    let mut options: OverlapOptions = convert::options(options)?;
    options.transform = convert::transform(py, motion)?;
    let engine = cpu(py);
    let compute =
        |caller: &mut Caller| engine.overlap(a.prepared(), b.prepared(), &options).monitored(caller).wait();
    to_dict(py, &run(py, report, compute, |result| result.stop == Stop::Cancelled)?)
}

#[pyfunction]
pub(crate) fn statistics<'py>(
    py: Python<'py>,
    a: &Model,
    b: &Model,
    options: &Bound<'py, PyDict>,
    motion: Motion,
    report: Option<Py<PyAny>>,
) -> PyResult<Bound<'py, PyDict>> {
    let mut options: StatisticsOptions = convert::options(options)?;
    options.transform = convert::transform(py, motion)?;
    let engine = cpu(py);
    let compute = |caller: &mut Caller| {
        engine.statistics(a.prepared(), b.prepared(), &options).monitored(caller).wait()
    };
    to_dict(py, &run(py, report, compute, |_| false)?)
}

#[pyfunction]
pub(crate) fn score<'py>(
    py: Python<'py>,
    a: &Model,
    b: &Model,
    options: &Bound<'py, PyDict>,
    motion: Motion,
    report: Option<Py<PyAny>>,
) -> PyResult<Bound<'py, PyDict>> {
    let mut options: ScoreOptions = convert::options(options)?;
    options.transform = convert::transform(py, motion)?;
    let engine = cpu(py);
    let compute =
        |caller: &mut Caller| engine.score(a.prepared(), b.prepared(), &options).monitored(caller).wait();
    to_dict(py, &run(py, report, compute, |_| false)?)
}

#[pyfunction]
pub(crate) fn best_fit<'py>(
    py: Python<'py>,
    a: &Model,
    b: &Model,
    options: &Bound<'py, PyDict>,
    motion: Motion,
    report: Option<Py<PyAny>>,
) -> PyResult<Bound<'py, PyDict>> {
    let mut options: BestFitOptions = convert::options(options)?;
    options.transform = convert::transform(py, motion)?;
    let engine = cpu(py);
    let compute =
        |caller: &mut Caller| engine.best_fit(a.prepared(), b.prepared(), &options).monitored(caller).wait();
    to_dict(py, &run(py, report, compute, |_| false)?)
}

#[pyfunction]
pub(crate) fn gaps<'py>(
    py: Python<'py>,
    a: &Model,
    b: &Model,
    options: &Bound<'py, PyDict>,
    motion: Motion,
    report: Option<Py<PyAny>>,
) -> PyResult<Bound<'py, PyDict>> {
    let mut options: GapOptions = convert::options(options)?;
    options.transform = convert::transform(py, motion)?;
    let engine = cpu(py);
    let compute =
        |caller: &mut Caller| engine.gaps(a.prepared(), b.prepared(), &options).monitored(caller).wait();
    to_dict(py, &run(py, report, compute, |_| false)?)
}

#[pyfunction]
pub(crate) fn field<'py>(
    py: Python<'py>,
    a: &Model,
    b: &Model,
    options: &Bound<'py, PyDict>,
    motion: Motion,
    report: Option<Py<PyAny>>,
) -> PyResult<Bound<'py, PyDict>> {
    let mut options: FieldOptions = convert::options(options)?;
    options.transform = convert::transform(py, motion)?;
    let engine = cpu(py);
    let compute =
        |caller: &mut Caller| engine.field(a.prepared(), b.prepared(), &options).monitored(caller).wait();
    let result = run(py, report, compute, |_| false)?;
    let dict = PyDict::new(py);
    dict.set_item("diagonal", result.diagonal)?;
    let statistics = result.statistics.map(|statistics| to_dict(py, &statistics)).transpose()?;
    dict.set_item("statistics", statistics)?;
    dict.set_item("deviations", convert::fields(py, result.deviations)?)?;
    Ok(dict)
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
    let engine = cpu(py);
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
