//! Maps of deviations.

use numpy::IntoPyArray;
use nurbs_hausdorff::{DeviationMap, DeviationMaps};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use pythonize::pythonize;

/// Returns maps as dictionaries of flat arrays.
pub(crate) fn arrays(py: Python<'_>, maps: DeviationMaps) -> PyResult<Bound<'_, PyDict>> {
    let dict = PyDict::new(py);
    dict.set_item("diagonal", maps.diagonal)?;
    for (name, map) in [("a", maps.a), ("b", maps.b)] {
        dict.set_item(name, map.map(|map| arrays_of(py, map)).transpose()?)?;
    }
    Ok(dict)
}

/// Returns a map as flat arrays, with the vertices in float64.
fn arrays_of(py: Python<'_>, map: DeviationMap) -> PyResult<Bound<'_, PyDict>> {
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
