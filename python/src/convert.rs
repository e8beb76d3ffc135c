//! Options from Python and results to Python, by the names of the crate's serde.

use crate::failure;
use glam::{DQuat, DVec3};
use numpy::IntoPyArray;
use nurbs_hausdorff::result::FaceDeviations;
use nurbs_hausdorff::{ClosestPoints, DeviationField, Precision, RigidTransform, SignedDistances};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};
use pythonize::{depythonize, pythonize};
use serde::Serialize;
use serde::de::DeserializeOwned;

/// The quaternion x, y, z, w and the translation of a rigid motion.
pub(crate) type Motion = ([f64; 4], [f64; 3]);

/// # Errors
/// `OPTION_INVALID` for an unknown name or a wrong type.
pub(crate) fn options<T: DeserializeOwned>(options: &Bound<'_, PyDict>) -> PyResult<T> {
    depythonize(options).map_err(|error| {
        failure::exception(options.py(), "OPTION_INVALID", &format!("options: {error}"), None)
    })
}

/// # Errors
/// `TRANSFORM_NOT_RIGID`.
pub(crate) fn transform(py: Python<'_>, (rotation, translation): Motion) -> PyResult<RigidTransform> {
    RigidTransform::new(DQuat::from_array(rotation), DVec3::from_array(translation))
        .map_err(|error| failure::of_error(py, &error))
}

/// Returns a result as a dictionary, with the names of the command line's JSON.
///
/// # Errors
/// Those of Python, such as a lack of memory.
pub(crate) fn to_dict<'py>(py: Python<'py>, value: &impl Serialize) -> PyResult<Bound<'py, PyDict>> {
    Ok(pythonize(py, value)?.cast_into::<PyDict>()?)
}

/// Returns the fields as dictionaries of flat arrays.
///
/// # Errors
/// Those of Python, such as a lack of memory.
pub(crate) fn fields(py: Python<'_>, fields: Vec<FaceDeviations>) -> PyResult<Bound<'_, PyList>> {
    let list = PyList::empty(py);
    for field in fields {
        let dict = PyDict::new(py);
        dict.set_item("face", field.face)?;
        dict.set_item("counts", (field.counts[0], field.counts[1]))?;
        dict.set_item("points", field.points.into_pyarray(py))?;
        dict.set_item("feet", field.feet.into_pyarray(py))?;
        dict.set_item("distances", field.distances.into_pyarray(py))?;
        dict.set_item("signed", field.signed.into_pyarray(py))?;
        dict.set_item("signs", pythonize(py, &field.signs)?)?;
        dict.set_item("areas", field.areas.into_pyarray(py))?;
        dict.set_item("triangles", field.triangles.into_pyarray(py))?;
        list.append(dict)?;
    }
    Ok(list)
}

/// Returns a field as a dictionary, with one of flat arrays for each of its parts.
///
/// # Errors
/// Those of Python, such as a lack of memory.
pub(crate) fn field(py: Python<'_>, found: DeviationField) -> PyResult<Bound<'_, PyDict>> {
    let dict = PyDict::new(py);
    dict.set_item("diagonal", found.diagonal)?;
    let statistics = found.statistics.map(|statistics| to_dict(py, &statistics)).transpose()?;
    dict.set_item("statistics", statistics)?;
    dict.set_item("deviations", fields(py, found.deviations)?)?;
    Ok(dict)
}

/// Returns signed distances as a dictionary of flat arrays, x fastest.
///
/// # Errors
/// Those of Python, such as a lack of memory.
pub(crate) fn signed_distances(py: Python<'_>, found: SignedDistances) -> PyResult<Bound<'_, PyDict>> {
    let dict = PyDict::new(py);
    dict.set_item("origin", found.grid.origin.to_vec().into_pyarray(py))?;
    dict.set_item("spacing", found.grid.spacing)?;
    dict.set_item("counts", found.grid.counts.to_vec())?;
    dict.set_item("bound", found.bound)?;
    dict.set_item("band", found.band)?;
    let undecided: Vec<i64> = found.undecided.iter().map(|&index| index as i64).collect();
    dict.set_item("undecided", undecided.into_pyarray(py))?;
    dict.set_item("measured", found.measured)?;
    if found.precision == Precision::Float32 {
        // Values of that precision are numbers of float32.
        let values: Vec<f32> = found.values.iter().map(|&value| value as f32).collect();
        dict.set_item("values", values.into_pyarray(py))?;
    } else {
        dict.set_item("values", found.values.into_pyarray(py))?;
    }
    Ok(dict)
}

/// Returns closest points as a dictionary of flat arrays.
///
/// # Errors
/// Those of Python, such as a lack of memory.
pub(crate) fn closest_points(py: Python<'_>, found: ClosestPoints) -> PyResult<Bound<'_, PyDict>> {
    let dict = PyDict::new(py);
    dict.set_item("distances", found.distances.into_pyarray(py))?;
    dict.set_item("bounds", found.bounds.into_pyarray(py))?;
    dict.set_item("signed", found.signed.into_pyarray(py))?;
    dict.set_item("signs", pythonize(py, &found.signs)?)?;
    dict.set_item("feet", found.feet.into_pyarray(py))?;
    dict.set_item("faces", found.faces.into_pyarray(py))?;
    dict.set_item("parameters", found.parameters.into_pyarray(py))?;
    dict.set_item("decided_on_gpu", found.decided_on_gpu)?;
    Ok(dict)
}
