//! Plain values of TOML and JSON as those of Python, and back.

use pyo3::prelude::*;
use pyo3::types::{PyBool, PyDict, PyFloat, PyInt, PyList, PyMapping, PyString};
use toml::Value;

use crate::errors;

/// Deepest nesting of tables and lists that is taken.
const DEPTH_MAX: usize = 32;

/// A mapping of Python as a TOML table. Arrays of numpy become lists; a field that is `None` is left out.
pub(crate) fn table(values: &Bound<'_, PyDict>) -> PyResult<toml::Table> {
    fields(values, "", 0)
}

fn fields(values: &Bound<'_, PyDict>, path: &str, depth: usize) -> PyResult<toml::Table> {
    let mut table = toml::Table::new();
    for (key, value) in values.iter() {
        let Ok(name) = key.extract::<String>() else {
            return Err(errors::scenario(format!(
                "a field of `{path}` is called {key}, allowed are strings"
            )));
        };
        let path = if path.is_empty() { name.clone() } else { format!("{path}.{name}") };
        if !value.is_none() {
            table.insert(name, to_toml(&value, &path, depth + 1)?);
        }
    }
    Ok(table)
}

fn to_toml(value: &Bound<'_, PyAny>, path: &str, depth: usize) -> PyResult<Value> {
    if depth > DEPTH_MAX {
        return Err(errors::scenario(format!("`{path}` is nested too deeply, allowed is {DEPTH_MAX}")));
    }
    if value.hasattr("tolist")? {
        // Arrays and scalars of numpy.
        return to_toml(&value.call_method0("tolist")?, path, depth + 1);
    }
    if let Ok(flag) = value.cast::<PyBool>() {
        return Ok(Value::Boolean(flag.is_true()));
    }
    if value.is_instance_of::<PyInt>() {
        let whole: PyResult<i64> = value.extract();
        let allowed = "allowed is a whole number of 64 bits with its sign";
        return whole
            .map(Value::Integer)
            .map_err(|_| errors::scenario(format!("`{path}` is {value}, {allowed}")));
    }
    if value.is_instance_of::<PyFloat>() {
        return Ok(Value::Float(value.extract()?));
    }
    if let Ok(text) = value.cast::<PyString>() {
        return Ok(Value::String(text.to_string()));
    }
    if let Ok(mapping) = value.cast::<PyMapping>() {
        let table = PyDict::new(value.py());
        table.update(mapping)?;
        return fields(&table, path, depth).map(Value::Table);
    }
    let Ok(items) = value.try_iter() else {
        let kind = value.get_type();
        let allowed = "allowed are numbers, strings, lists, arrays and dicts";
        return Err(errors::scenario(format!("`{path}` is a {}, {allowed}", kind.name()?)));
    };
    let items = items.map(|item| to_toml(&item?, path, depth + 1));
    Ok(Value::Array(items.collect::<PyResult<_>>()?))
}

/// A TOML value as one of Python; dates as text.
pub(crate) fn from_toml<'py>(py: Python<'py>, value: &Value) -> PyResult<Bound<'py, PyAny>> {
    Ok(match value {
        Value::String(text) => PyString::new(py, text).into_any(),
        Value::Integer(whole) => whole.into_pyobject(py)?.into_any(),
        Value::Float(number) => PyFloat::new(py, *number).into_any(),
        Value::Boolean(flag) => PyBool::new(py, *flag).to_owned().into_any(),
        Value::Datetime(time) => PyString::new(py, &time.to_string()).into_any(),
        Value::Array(items) => {
            let items = items.iter().map(|item| from_toml(py, item)).collect::<PyResult<Vec<_>>>()?;
            PyList::new(py, items)?.into_any()
        }
        Value::Table(table) => {
            let dict = PyDict::new(py);
            for (name, value) in table {
                dict.set_item(name, from_toml(py, value)?)?;
            }
            dict.into_any()
        }
    })
}

/// A JSON value as one of Python.
pub(crate) fn from_json<'py>(py: Python<'py>, value: &serde_json::Value) -> PyResult<Bound<'py, PyAny>> {
    use serde_json::Value;
    Ok(match value {
        Value::Null => py.None().into_bound(py),
        Value::Bool(flag) => PyBool::new(py, *flag).to_owned().into_any(),
        Value::Number(number) => match (number.as_i64(), number.as_u64()) {
            (Some(whole), _) => whole.into_pyobject(py)?.into_any(),
            (None, Some(whole)) => whole.into_pyobject(py)?.into_any(),
            _ => PyFloat::new(py, number.as_f64().unwrap_or(f64::NAN)).into_any(),
        },
        Value::String(text) => PyString::new(py, text).into_any(),
        Value::Array(items) => {
            let items = items.iter().map(|item| from_json(py, item)).collect::<PyResult<Vec<_>>>()?;
            PyList::new(py, items)?.into_any()
        }
        Value::Object(table) => {
            let dict = PyDict::new(py);
            for (name, value) in table {
                dict.set_item(name, from_json(py, value)?)?;
            }
            dict.into_any()
        }
    })
}
