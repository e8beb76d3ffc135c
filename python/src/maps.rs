//! Maps of deviations.

use crate::convert::{self, Motion};
use crate::measure::cpu;
use crate::model::Model;
use crate::running::{Caller, run};
use numpy::IntoPyArray;
use nurbs_hausdorff::{DeviationMap, DeviationMapOptions};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use pythonize::pythonize;

#[pyfunction]
pub(crate) fn deviation_maps<'py>(
    py: Python<'py>,
    a: &Model,
    b: &Model,
    options: &Bound<'py, PyDict>,
    motion: Motion,
    report: Option<Py<PyAny>>,
) -> PyResult<Bound<'py, PyDict>> {
    let mut options: DeviationMapOptions = convert::options(options)?;
    options.transform = convert::transform(py, motion)?;
    let engine = cpu(py);
    let compute = |caller: &mut Caller| {
        engine.deviation_maps(a.prepared(), b.prepared(), &options).monitored(caller).wait()
    };
    let result = run(py, report, compute, |_| false)?;
    let dict = PyDict::new(py);
    dict.set_item("diagonal", result.diagonal)?;
    for (name, map) in [("a", result.a), ("b", result.b)] {
        dict.set_item(name, map.map(|map| arrays(py, map)).transpose()?)?;
    }
    Ok(dict)
}

/// Returns a map as flat arrays, with the vertices in float64.
fn arrays(py: Python<'_>, map: DeviationMap) -> PyResult<Bound<'_, PyDict>> {
    let origin = map.origin.to_array();
    let positions = map.positions.as_chunks::<3>().0.iter();
    let vertices: Vec<f64> =
        positions.flat_map(|at| [0, 1, 2].map(|axis| f64::from(at[axis]) + origin[axis])).collect();
    let dict = PyDict::new(py);
    dict.set_item("vertices", vertices.into_pyarray(py))?;
    dict.set_item("normals", map.normals.into_pyarray(py))?;
    dict.set_item("triangles", map.indices.into_pyarray(py))?;
    dict.set_item("faces", map.faces.into_pyarray(py))?;
    dict.set_item("points", map.points.into_pyarray(py))?;
    dict.set_item("slacks", map.slacks.into_pyarray(py))?;
    dict.set_item("distances", map.distances.into_pyarray(py))?;
    dict.set_item("signed", map.signed.into_pyarray(py))?;
    dict.set_item("feet", map.feet.into_pyarray(py))?;
    dict.set_item("signs", pythonize(py, &map.signs)?)?;
    Ok(dict)
}
