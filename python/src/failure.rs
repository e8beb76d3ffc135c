//! The package's one class of exceptions.

use nurbs_hausdorff::Error;
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::PyType;

/// The class, which the Python half defines.
static CLASS: PyOnceLock<Py<PyType>> = PyOnceLock::new();

/// Returns the exception with a code, a message and, of a cancelled computation, the interval
/// that it had reached.
pub(crate) fn exception(py: Python<'_>, code: &str, message: &str, interval: Option<[f64; 2]>) -> PyErr {
    match CLASS.import(py, "nurbs_hausdorff._errors", "NurbsHausdorffError") {
        Ok(class) => {
            let interval = interval.map(|[lower, upper]| (lower, upper));
            PyErr::from_type(class.clone(), (code.to_owned(), message.to_owned(), interval))
        }
        Err(error) => error,
    }
}

/// Returns the exception for an error of the crate.
pub(crate) fn of_error(py: Python<'_>, error: &Error) -> PyErr {
    exception(py, error.code(), &error.to_string(), None)
}
