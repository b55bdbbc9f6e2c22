//! Errors of Rust as exceptions of Python, with the same words.

use core::fmt::Display;

use pyo3::create_exception;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

create_exception!(
    closeranks,
    Error,
    PyValueError,
    "What closeranks refuses. All its exceptions are of this kind."
);
create_exception!(
    closeranks,
    ScenarioError,
    Error,
    "A scenario that cannot be run, with every mistake underlined."
);
create_exception!(
    closeranks,
    RobotError,
    Error,
    "A robot that cannot be made, or a call that it does not take."
);
create_exception!(
    closeranks,
    MessageError,
    RobotError,
    "Bytes that are no message, or a message that is not taken."
);
create_exception!(closeranks, GraphError, Error, "What is no graph, or no graph of that name.");

/// Adds the exceptions to the module.
pub(crate) fn add(module: &Bound<'_, PyModule>) -> PyResult<()> {
    let py = module.py();
    module.add("Error", py.get_type::<Error>())?;
    module.add("ScenarioError", py.get_type::<ScenarioError>())?;
    module.add("RobotError", py.get_type::<RobotError>())?;
    module.add("MessageError", py.get_type::<MessageError>())?;
    module.add("GraphError", py.get_type::<GraphError>())
}

/// An [`Error`] with the words of `error`.
pub(crate) fn refused(error: impl Display) -> PyErr {
    Error::new_err(error.to_string())
}

/// A [`ScenarioError`] with the words of `error`.
pub(crate) fn scenario(error: impl Display) -> PyErr {
    ScenarioError::new_err(error.to_string())
}

/// A [`RobotError`] with the words of `error`.
pub(crate) fn robot(error: impl Display) -> PyErr {
    RobotError::new_err(error.to_string())
}

/// A [`MessageError`] with the words of `error`.
pub(crate) fn message(error: impl Display) -> PyErr {
    MessageError::new_err(error.to_string())
}

/// A [`GraphError`] with the words of `error`.
pub(crate) fn graph(error: impl Display) -> PyErr {
    GraphError::new_err(error.to_string())
}
