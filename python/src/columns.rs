//! Answers as NumPy arrays with a row for each query.

use numpy::{Element, PyArray1, PyArrayMethods};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use tunnelproof::{Case, ContactKind};

/// Columns by name, a row for each query. Where there is no hit they have NaN, false or 0.
pub(crate) struct Columns<'a, 'py, H> {
    hits: &'a [Option<H>],
    pub(crate) dict: Bound<'py, PyDict>,
    py: Python<'py>,
}

impl<'a, 'py, H> Columns<'a, 'py, H> {
    pub(crate) fn new(py: Python<'py>, hits: &'a [Option<H>]) -> Self {
        let dict = PyDict::new(py);
        Columns { hits, dict, py }
    }

    /// More columns of the same rows.
    pub(crate) fn of<G>(self, hits: &'a [Option<G>]) -> Columns<'a, 'py, G> {
        let Columns { dict, py, .. } = self;
        Columns { hits, dict, py }
    }

    /// `N` numbers of each hit: an array of shape `(n,)` if `N` is 1, else `(n, N)`.
    pub(crate) fn numbers<const N: usize>(
        &mut self,
        name: &str,
        of: impl Fn(&H) -> [f64; N],
    ) -> PyResult<()> {
        self.rows(name, [f64::NAN; N], of)
    }

    /// A place in a list of each hit, 0 where there is none.
    pub(crate) fn places(&mut self, name: &str, of: impl Fn(&H) -> usize) -> PyResult<()> {
        self.rows(name, [0], |hit| [of(hit).cast_signed()])
    }

    /// `N` indices of each hit, 0 where there is none; shaped as numbers are.
    pub(crate) fn indices<const N: usize>(
        &mut self,
        name: &str,
        of: impl Fn(&H) -> [u32; N],
    ) -> PyResult<()> {
        self.rows(name, [0; N], of)
    }

    fn rows<T: Copy + Element, const N: usize>(
        &mut self,
        name: &str,
        nothing: [T; N],
        of: impl Fn(&H) -> [T; N],
    ) -> PyResult<()> {
        let rows = self.hits.iter();
        let rows = rows.map(|hit| hit.as_ref().map_or(nothing, &of));
        let array = PyArray1::from_vec(self.py, rows.collect::<Vec<_>>().into_flattened());
        match N {
            1 => self.dict.set_item(name, array),
            _ => self
                .dict
                .set_item(name, array.reshape([self.hits.len(), N])?),
        }
    }

    /// Whether something is so of each hit.
    pub(crate) fn flags(&mut self, name: &str, of: impl Fn(&H) -> bool) -> PyResult<()> {
        let flags = self.hits.iter().map(|hit| hit.as_ref().is_some_and(&of));
        self.dict
            .set_item(name, PyArray1::from_iter(self.py, flags))
    }

    /// A small number of each hit, 0 where there is none.
    pub(crate) fn codes(&mut self, name: &str, of: impl Fn(&H) -> i8) -> PyResult<()> {
        let codes = self.hits.iter().map(|hit| hit.as_ref().map_or(0, &of));
        self.dict
            .set_item(name, PyArray1::from_iter(self.py, codes))
    }
}

/// The value of `ContactKind` in Python.
pub(crate) fn kind(kind: ContactKind) -> i8 {
    match kind {
        ContactKind::Crossing => 1,
        ContactKind::Graze => 2,
    }
}

/// The value of `Case` in Python.
pub(crate) fn case(case: Case) -> i8 {
    match case {
        Case::General => 1,
        Case::Coplanar => 2,
        Case::Parallel => 3,
        Case::Collinear => 4,
        Case::SharedStart => 5,
        Case::Degenerate => 6,
    }
}
