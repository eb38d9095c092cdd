//! A method in Python as a subject.

use std::sync::OnceLock;

use numpy::{PyArray1, PyArrayMethods, PyReadonlyArray1};
use pyo3::exceptions::{PyException, PyValueError};
use pyo3::prelude::*;
use tunnelproof::narrow::{Tolerance, Unsupported};
use tunnelproof::query::{Query, QueryKind};
use tunnelproof_float_env::with_restored;
use tunnelproof_reference::answer::Enclosure;
use tunnelproof_reference::subject::{Answer, Lapse, LapseKind, NoAnswer, Said, Subject};

use crate::interrupt::watched;
use crate::queries::row;

/// A callable that is asked `(kind, points, radii)` and answers `(hit, toi)`, or `None` for what it does not take.
pub(crate) struct Method {
    pub(crate) name: String,
    call: Py<PyAny>,
    pub(crate) tolerance: Tolerance,
    /// What ends the program, or a cell of a notebook, such as `KeyboardInterrupt`. It is no answer.
    ending: OnceLock<PyErr>,
}

type Answers = Vec<Result<Answer, NoAnswer>>;

impl Subject for Method {
    fn name(&self) -> &str {
        &self.name
    }

    fn answer(&self, query: &Query) -> Result<Answer, NoAnswer> {
        match self.ask(query.kind(), &[*query]) {
            Ok(mut answers) if answers.len() == 1 => answers.remove(0),
            Ok(_) => Err(raised("as many answers as queries are due")),
            Err(error) => Err(raised(&error.to_string())),
        }
    }

    /// All queries of a kind in one call. If that fails, one by one, to see which of them it fails on.
    fn answers(&self, queries: &[Query]) -> Answers {
        let mut answers = Vec::with_capacity(queries.len());
        for queries in queries.chunk_by(|a, b| a.kind() == b.kind()) {
            match self.ask(queries[0].kind(), queries) {
                Ok(together) => answers.extend(together),
                Err(_) => answers.extend(queries.iter().map(|query| self.answer(query))),
            }
        }
        answers
    }

    fn tolerance(&self) -> Tolerance {
        self.tolerance
    }
}

/// An exception, in one line.
fn raised(detail: &str) -> NoAnswer {
    Lapse::new(LapseKind::Raised, detail.lines().next().unwrap_or("")).into()
}

/// The tolerance that a method declares.
pub(crate) fn tolerance(near: f64, late: f64) -> PyResult<Tolerance> {
    for (name, value) in [("near", near), ("late", late)] {
        if !(value >= 0.0 && value.is_finite()) {
            let message = format!("{name} is {value}, not a number from 0");
            return Err(PyValueError::new_err(message));
        }
    }
    Ok(Tolerance { near, late })
}

impl Method {
    pub(crate) fn new(name: String, call: Py<PyAny>, tolerance: Tolerance) -> Self {
        Method {
            name,
            call,
            tolerance,
            ending: OnceLock::new(),
        }
    }

    /// What `work` gives, which asks this method. After a signal such as that of Ctrl-C the method is asked no more,
    /// and the work ends soon.
    pub(crate) fn watched<T: Send>(&self, py: Python<'_>, work: impl FnOnce() -> T + Send) -> T {
        watched(py, work, |error| {
            // It may have ended before.
            let _ = self.ending.set(error);
        })
    }

    /// What was not for the method to raise.
    pub(crate) fn ending(&self, py: Python<'_>) -> Option<PyErr> {
        self.ending.get().map(|error| error.clone_ref(py))
    }

    /// After the last question: raises what was not for the method to raise.
    pub(crate) fn finish(self) -> PyResult<()> {
        self.ending.into_inner().map_or(Ok(()), Err)
    }

    /// Asks, unless it is to end. Of exceptions, those that are no `Exception` end it.
    fn ask(&self, kind: QueryKind, queries: &[Query]) -> PyResult<Answers> {
        if self.ending.get().is_some() {
            return Err(PyException::new_err("interrupted"));
        }
        self.call(kind, queries).inspect_err(|error| {
            let is_ending = Python::attach(|py| {
                (!error.is_instance_of::<PyException>(py)).then(|| error.clone_ref(py))
            });
            if let Some(error) = is_ending {
                // Another thread may have been first.
                let _ = self.ending.set(error);
            }
        })
    }

    fn call(&self, kind: QueryKind, queries: &[Query]) -> PyResult<Answers> {
        Python::attach(|py| {
            let (points, radii): (Vec<_>, Vec<_>) = queries.iter().map(row).unzip();
            let points = PyArray1::from_vec(py, points.into_flattened().into_flattened());
            let points = points.reshape([queries.len(), 8, 3])?;
            let radii = PyArray1::from_vec(py, radii.into_flattened());
            let radii = radii.reshape([queries.len(), 2])?;
            // What it imports may change the floating-point environment of this thread.
            let call = || self.call.bind(py).call1((kind.name(), points, radii));
            let answer = with_restored(call)?;
            if answer.is_none() {
                let refused = queries.iter().map(|query| Err(not_taken(query).into()));
                return Ok(refused.collect());
            }
            let (hit, toi): (PyReadonlyArray1<'_, bool>, PyReadonlyArray1<'_, f64>) =
                answer.extract()?;
            let answers = hit.as_array().into_iter().zip(toi.as_array());
            Ok(answers.map(|(&hit, &toi)| Ok(said(hit, toi))).collect())
        })
    }
}

fn not_taken(query: &Query) -> Unsupported {
    match query.radius().is_zero() {
        true => Unsupported::Kind(query.kind()),
        false => Unsupported::Radius(query.radius()),
    }
}

fn said(hit: bool, toi: f64) -> Answer {
    let at = Enclosure {
        below: toi,
        above: toi,
    };
    Answer::Said(Said {
        toi: hit.then_some(at),
        case: None,
    })
}
