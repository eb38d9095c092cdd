//! The certified path on arrays.

use numpy::{PyReadonlyArray2, PyReadonlyArray3};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use tunnelproof::certified::Kind;
use tunnelproof::contact::Place;
use tunnelproof::{
    Batch, ContactPoint, EdgeEdge, Hit, Normal, Point, Query, QueryKind, VertexFace,
};
use tunnelproof_float_env::with_default;

use crate::columns::{self, Columns};
use crate::interrupt::each;
use crate::queries::{self, Rows};

/// The columns of `Hits`.
#[pyfunction]
pub(crate) fn decide<'py>(
    py: Python<'py>,
    kind: &str,
    points: PyReadonlyArray3<'py, f64>,
    radii: PyReadonlyArray2<'py, f64>,
) -> PyResult<Bound<'py, PyDict>> {
    let kind = queries::kind(kind)?;
    let rows = Rows::new(&points, &radii)?;
    with_default(|| match kind {
        QueryKind::EdgeEdge => written::<EdgeEdge>(py, rows),
        QueryKind::VertexFace => written::<VertexFace>(py, rows),
    })
}

/// A kind of query.
trait Side: Kind {
    const KIND: QueryKind;

    fn of(query: &Query) -> Option<&Self>;
}

impl Side for EdgeEdge {
    const KIND: QueryKind = QueryKind::EdgeEdge;

    fn of(query: &Query) -> Option<&Self> {
        query.as_edge_edge()
    }
}

impl Side for VertexFace {
    const KIND: QueryKind = QueryKind::VertexFace;

    fn of(query: &Query) -> Option<&Self> {
        query.as_vertex_face()
    }
}

/// Weights of A, B, C and D, and the point on the first side.
type Contact = ([f64; 4], Point);

/// A hit with what is computed from it and its query.
#[derive(Clone)]
pub(crate) struct Row {
    pub(crate) hit: Hit<Place>,
    pub(crate) first: Contact,
    pub(crate) second: Option<Contact>,
    pub(crate) normal: Option<Normal>,
}

impl Row {
    pub(crate) fn new<K: Kind>(query: &K, hit: Hit<K::Place>) -> Self {
        let (first, second) = hit.points(query);
        let contact = |contact: ContactPoint| (contact.weights, contact.point);
        Row {
            first: contact(first),
            second: second.map(contact),
            normal: hit.normal(query),
            hit: hit.map_place(Into::into),
        }
    }

    /// The second point, which is the first where there is none.
    fn second(&self) -> Contact {
        self.second.unwrap_or(self.first)
    }

    fn direction(&self) -> [f64; 3] {
        self.normal.map_or([0.0; 3], |x| x.direction.into())
    }
}

fn written<K: Side>(py: Python<'_>, rows: Rows) -> PyResult<Bound<'_, PyDict>> {
    let queries = py.detach(|| rows.queries(K::KIND))?;
    let blocks: Vec<_> = queries.chunks(BLOCK).collect();
    let rows = each(py, &blocks, |block| decided::<K>(block))?;
    columns(py, &rows.concat())
}

/// How many queries are decided together.
const BLOCK: usize = 256;

/// The columns of `Hits`.
pub(crate) fn columns<'py>(py: Python<'py>, rows: &[Option<Row>]) -> PyResult<Bound<'py, PyDict>> {
    let mut columns = Columns::new(py, rows);
    columns.flags("hit", |_| true)?;
    columns.numbers("toi", |row: &Row| [row.hit.toi])?;
    columns.numbers("toi_above", |row| [row.hit.toi_above])?;
    columns.codes("kind", |row| columns::kind(row.hit.kind))?;
    columns.codes("side", |row| row.hit.side)?;
    columns.codes("case", |row| columns::case(row.hit.case))?;
    columns.flags("temporarily_parallel", |row| {
        row.hit.flags.temporarily_parallel
    })?;
    columns.flags("temporarily_point", |row| row.hit.flags.temporarily_point)?;
    columns.numbers("first_weights", |row| row.first.0)?;
    columns.numbers("first_point", |row| row.first.1.into())?;
    columns.flags("has_second", |row| row.second.is_some())?;
    columns.numbers("second_weights", |row| row.second().0)?;
    columns.numbers("second_point", |row| row.second().1.into())?;
    columns.numbers("place_error", |row| [row.hit.place.error()])?;
    columns.numbers("normal", Row::direction)?;
    columns.numbers("normal_error", |row| [row.normal.map_or(0.0, |x| x.error)])?;
    Ok(columns.dict)
}

/// What is decided of queries of a kind, each hit at the place of its query.
fn decided<K: Side>(queries: &[Query]) -> Vec<Option<Row>> {
    let queries: Vec<&K> = queries.iter().filter_map(K::of).collect();
    let mut batch = Batch::<K>::new();
    queries.iter().for_each(|&query| batch.push(query));
    let mut rows = vec![None; queries.len()];
    for (index, hit) in batch.decide() {
        rows[index] = Some(Row::new(queries[index], hit));
    }
    rows
}
