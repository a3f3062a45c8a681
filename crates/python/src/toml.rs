//! Scene files: TOML read once, with the line of every key.

use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList, PyTuple};
use toml_edit::{Document, Item, Value};

pyo3::create_exception!(_core, TomlError, PyValueError, "Text that is no TOML: (message, line, column).");

/// Where in the text a byte stands: line and column, both from 1.
fn place(text: &str, byte: usize) -> (usize, usize) {
    let before = &text.as_bytes()[..byte.min(text.len())];
    let line = before.iter().filter(|&&b| b == b'\n').count() + 1;
    let start = before.iter().rposition(|&b| b == b'\n').map_or(0, |i| i + 1);
    (line, before.len() - start + 1)
}

struct Reader<'py> {
    py: Python<'py>,
    /// Where the lines end, so that the line of a byte is found by halving.
    ends: Vec<usize>,
    lines: Bound<'py, PyDict>,
}

impl<'py> Reader<'py> {
    fn note(&self, path: &[Py<PyAny>], span: Option<std::ops::Range<usize>>) -> PyResult<()> {
        if let Some(span) = span {
            let key = PyTuple::new(self.py, path)?;
            if !self.lines.contains(&key)? {
                let line = self.ends.partition_point(|&end| end < span.start) + 1;
                self.lines.set_item(key, line)?;
            }
        }
        Ok(())
    }

    fn table(&self, table: &dyn toml_edit::TableLike, path: &mut Vec<Py<PyAny>>) -> PyResult<Py<PyAny>> {
        let result = PyDict::new(self.py);
        for (name, item) in table.iter() {
            path.push(name.into_pyobject(self.py)?.into_any().unbind());
            let key_span = table.key(name).and_then(toml_edit::Key::span);
            self.note(path, key_span.or_else(|| item.span()))?;
            result.set_item(name, self.item(item, path)?)?;
            path.pop();
        }
        Ok(result.into_any().unbind())
    }

    fn item(&self, item: &Item, path: &mut Vec<Py<PyAny>>) -> PyResult<Py<PyAny>> {
        match item {
            Item::None => Ok(self.py.None()),
            Item::Value(value) => self.value(value, path),
            Item::Table(table) => self.table(table, path),
            Item::ArrayOfTables(tables) => {
                let list = PyList::empty(self.py);
                for (i, table) in tables.iter().enumerate() {
                    path.push(i.into_pyobject(self.py)?.into_any().unbind());
                    self.note(path, table.span())?;
                    list.append(self.table(table, path)?)?;
                    path.pop();
                }
                Ok(list.into_any().unbind())
            }
        }
    }

    fn value(&self, value: &Value, path: &mut Vec<Py<PyAny>>) -> PyResult<Py<PyAny>> {
        let py = self.py;
        Ok(match value {
            Value::String(s) => s.value().into_pyobject(py)?.into_any().unbind(),
            Value::Integer(i) => i.value().into_pyobject(py)?.into_any().unbind(),
            Value::Float(f) => f.value().into_pyobject(py)?.into_any().unbind(),
            Value::Boolean(b) => b.value().into_pyobject(py)?.to_owned().into_any().unbind(),
            Value::Datetime(d) => d.value().to_string().into_pyobject(py)?.into_any().unbind(),
            Value::InlineTable(table) => self.table(table, path)?,
            Value::Array(array) => {
                let list = PyList::empty(py);
                for (i, element) in array.iter().enumerate() {
                    path.push(i.into_pyobject(py)?.into_any().unbind());
                    self.note(path, element.span())?;
                    list.append(self.value(element, path)?)?;
                    path.pop();
                }
                list.into_any().unbind()
            }
        })
    }
}

/// parse_toml(text) -> (data, lines): the data, and for the path of each key the line where it stands, from 1.
#[pyfunction]
fn parse_toml<'py>(py: Python<'py>, text: &str) -> PyResult<(Py<PyAny>, Bound<'py, PyDict>)> {
    let document = Document::parse(text).map_err(|error| {
        let (line, column) = place(text, error.span().map_or(0, |span| span.start));
        TomlError::new_err((error.message().trim().replace('\n', "; "), line, column))
    })?;
    let ends = text.bytes().enumerate().filter(|(_, byte)| *byte == b'\n').map(|(at, _)| at).collect();
    let reader = Reader { py, ends, lines: PyDict::new(py) };
    let data = reader.table(document.as_table(), &mut Vec::new())?;
    Ok((data, reader.lines))
}

pub(crate) fn register(m: &Bound<'_, PyModule>) -> PyResult<()> {
    m.add("TomlError", m.py().get_type::<TomlError>())?;
    m.add_function(wrap_pyfunction!(parse_toml, m)?)
}
