//! The certified path on arrays.

use numpy::{PyReadonlyArray2, PyReadonlyArray3};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use rayon::prelude::*;
use tunnelproof::certified::Kind;
use tunnelproof::{
    Batch, ContactPoint, EdgeEdge, EdgePlace, FacePlace, Hit, Normal, Query, QueryKind, VertexFace,
};
use tunnelproof_float_env::with_default;

use crate::columns::{self, Columns};
use crate::queries::{self, Refused, Rows};

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

    /// The error of a place.
    fn error(place: &Self::Place) -> f64;
}

impl Side for EdgeEdge {
    const KIND: QueryKind = QueryKind::EdgeEdge;

    fn of(query: &Query) -> Option<&Self> {
        query.as_edge_edge()
    }

    fn error(place: &EdgePlace) -> f64 {
        place.error
    }
}

impl Side for VertexFace {
    const KIND: QueryKind = QueryKind::VertexFace;

    fn of(query: &Query) -> Option<&Self> {
        query.as_vertex_face()
    }

    fn error(place: &FacePlace) -> f64 {
        place.error
    }
}

/// A hit with what is computed from it and its query.
#[derive(Clone)]
struct Row<P> {
    hit: Hit<P>,
    first: ContactPoint,
    second: Option<ContactPoint>,
    normal: Option<Normal>,
}

impl<P: Copy> Row<P> {
    fn new<K: Kind<Place = P>>(query: &K, hit: Hit<P>) -> Self {
        let (first, second) = hit.points(query);
        Row {
            hit,
            first,
            second,
            normal: hit.normal(query),
        }
    }

    /// The second point, which is the first where there is none.
    fn second(&self) -> ContactPoint {
        self.second.unwrap_or(self.first)
    }

    fn direction(&self) -> [f64; 3] {
        self.normal.map_or([0.0; 3], |x| x.direction.into())
    }
}

fn written<K: Side>(py: Python<'_>, rows: Rows) -> PyResult<Bound<'_, PyDict>> {
    let rows = py.detach(|| decided::<K>(rows))?;
    let mut columns = Columns::new(py, &rows);
    columns.flags("hit", |_| true)?;
    columns.numbers("toi", |row: &Row<K::Place>| [row.hit.toi])?;
    columns.numbers("toi_above", |row| [row.hit.toi_above])?;
    columns.codes("kind", |row| columns::kind(row.hit.kind))?;
    columns.codes("side", |row| row.hit.side)?;
    columns.codes("case", |row| columns::case(row.hit.case))?;
    columns.flags("temporarily_parallel", |row| {
        row.hit.flags.temporarily_parallel
    })?;
    columns.flags("temporarily_point", |row| row.hit.flags.temporarily_point)?;
    columns.numbers("first_weights", |row| row.first.weights)?;
    columns.numbers("first_point", |row| row.first.point.into())?;
    columns.flags("has_second", |row| row.second.is_some())?;
    columns.numbers("second_weights", |row| row.second().weights)?;
    columns.numbers("second_point", |row| row.second().point.into())?;
    columns.numbers("place_error", |row| [K::error(&row.hit.place)])?;
    columns.numbers("normal", Row::direction)?;
    columns.numbers("normal_error", |row| [row.normal.map_or(0.0, |x| x.error)])?;
    Ok(columns.dict)
}

/// What is decided of queries of a kind, each hit at the place of its query.
fn decided<K: Side>(rows: Rows) -> Result<Vec<Option<Row<K::Place>>>, Refused> {
    let queries = rows.queries(K::KIND)?;
    let queries: Vec<&K> = queries.iter().filter_map(K::of).collect();
    let mut batch = Batch::<K>::new();
    queries.iter().for_each(|&query| batch.push(query));
    let hits = batch.par_decide().into_par_iter();
    let hits = hits.map(|(index, hit)| (index, Row::new(queries[index], hit)));
    let hits: Vec<_> = hits.collect();
    let mut rows = vec![None; queries.len()];
    for (index, row) in hits {
        rows[index] = Some(row);
    }
    Ok(rows)
}
