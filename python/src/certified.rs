//! The certified path on arrays.

use numpy::{PyReadonlyArray2, PyReadonlyArray3};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use tunnelproof::certified::{Batch, FaceBatch, FaceHit, Hit};
use tunnelproof::contact::ContactKind;
use tunnelproof::query::{Query, QueryKind};

use crate::columns::Columns;
use crate::queries::{Refused, Rows};

/// The columns of `EdgeContacts`.
#[pyfunction]
pub(crate) fn edge_edge<'py>(
    py: Python<'py>,
    points: PyReadonlyArray3<'py, f64>,
    radii: PyReadonlyArray2<'py, f64>,
) -> PyResult<Bound<'py, PyDict>> {
    let rows = Rows::new(&points, &radii)?;
    let hits = hits(py, rows, QueryKind::EdgeEdge, |queries| {
        let mut batch = Batch::new();
        let edges = queries.iter().filter_map(Query::as_edge_edge);
        edges.for_each(|query| batch.push(query));
        batch.par_hits()
    })?;
    let mut columns = Columns::new(py, &hits);
    columns.numbers("toi", |hit: &Hit| [hit.toi])?;
    columns.numbers("toi_above", |hit| [hit.toi_above])?;
    columns.numbers("first", |hit| [hit.first.u, hit.first.v])?;
    columns.numbers("second", |hit| {
        hit.second
            .map_or([f64::NAN; 2], |second| [second.u, second.v])
    })?;
    columns.numbers("parameter_error", |hit| [hit.parameter_error])?;
    columns.flags("crosses", |hit| hit.kind == ContactKind::Crossing)?;
    columns.sides(|hit| hit.side)?;
    Ok(columns.dict)
}

/// The columns of `FaceContacts`.
#[pyfunction]
pub(crate) fn vertex_face<'py>(
    py: Python<'py>,
    points: PyReadonlyArray3<'py, f64>,
    radii: PyReadonlyArray2<'py, f64>,
) -> PyResult<Bound<'py, PyDict>> {
    let rows = Rows::new(&points, &radii)?;
    let hits = hits(py, rows, QueryKind::VertexFace, |queries| {
        let mut batch = FaceBatch::new();
        let faces = queries.iter().filter_map(Query::as_vertex_face);
        faces.for_each(|query| batch.push(query));
        batch.par_hits()
    })?;
    let mut columns = Columns::new(py, &hits);
    columns.numbers("toi", |hit: &FaceHit| [hit.toi])?;
    columns.numbers("toi_above", |hit| [hit.toi_above])?;
    columns.numbers("weights", |hit| hit.weights)?;
    columns.numbers("weight_error", |hit| [hit.weight_error])?;
    columns.flags("crosses", |hit| hit.kind == ContactKind::Crossing)?;
    columns.sides(|hit| hit.side)?;
    Ok(columns.dict)
}

/// What is decided of queries of a kind, each hit at the place of its query. Python can run meanwhile.
fn hits<H: Clone + Send>(
    py: Python<'_>,
    rows: Rows,
    kind: QueryKind,
    decide: impl FnOnce(&[Query]) -> Vec<(usize, H)> + Send,
) -> Result<Vec<Option<H>>, Refused> {
    py.detach(|| {
        let queries = rows.queries(kind)?;
        let mut hits = vec![None; queries.len()];
        for (index, hit) in decide(&queries) {
            hits[index] = Some(hit);
        }
        Ok(hits)
    })
}
