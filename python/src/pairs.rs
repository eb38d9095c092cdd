//! Pairs by the indices of their points.

use numpy::{Element, PyArray1, PyReadonlyArray2};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use tunnelproof::certified::Kind;
use tunnelproof::{
    Clearance, Coordinate, EdgeEdge, Hit, ListedPair, Pairs, PairsError, PairsStep, QueryKind,
    Radius, VertexFace, advance_pairs as engine_advance_pairs,
};
use tunnelproof_float_env::with_default;

use crate::advance;
use crate::certified::{Row, columns};
use crate::columns::Columns;
use crate::interrupt::each;
use crate::queries::{self, Ends, Refused, of_either, rows};

/// Which of the pairs touch, and the columns of `Hits` for these.
#[pyfunction]
pub(crate) fn decide_pairs<'py>(
    py: Python<'py>,
    kind: &str,
    ends: Ends<'py>,
    indices: PyReadonlyArray2<'py, u32>,
    radii: PyReadonlyArray2<'py, f64>,
) -> PyResult<Found<'py>> {
    let kind = queries::kind(kind)?;
    of_either!(&ends, (start, end) => {
        let list = List::new(start, end, &indices, &radii)?;
        with_default(|| match kind {
            QueryKind::EdgeEdge => found::<EdgeEdge, _>(py, &list),
            QueryKind::VertexFace => found::<VertexFace, _>(py, &list),
        })
    })
}

/// The fields of `PairsStep`.
#[pyfunction]
#[expect(clippy::too_many_arguments, reason = "those of Python")]
pub(crate) fn advance_pairs<'py>(
    py: Python<'py>,
    ends: Ends<'py>,
    edges: PyReadonlyArray2<'py, u32>,
    faces: PyReadonlyArray2<'py, u32>,
    edge_radii: PyReadonlyArray2<'py, f64>,
    face_radii: PyReadonlyArray2<'py, f64>,
    clearance: f64,
    share: Option<f64>,
) -> PyResult<Bound<'py, PyDict>> {
    let clearance = with_default(|| advance::clearance(clearance, share))?;
    of_either!(&ends, (start, end) => {
        let edges = List::new(start, end, &edges, &edge_radii)?;
        let faces = List::new(start, end, &faces, &face_radii)?;
        advanced(py, &edges, &faces, clearance)
    })
}

fn advanced<'py, C: Coordinate + Element>(
    py: Python<'py>,
    edges: &List<'_, C>,
    faces: &List<'_, C>,
    clearance: Clearance,
) -> PyResult<Bound<'py, PyDict>> {
    let step = || {
        let edges = edges.pairs().map_err(|error| refused("edges", error))?;
        let faces = faces.pairs().map_err(|error| refused("faces", error))?;
        let step = engine_advance_pairs(&edges, &faces, clearance);
        step.map_err(|error| Refused::new(&error))
    };
    let PairsStep {
        step,
        positions,
        limits,
        near,
        ..
    } = py.detach(|| with_default(step))?;
    let limits = limits.iter().map(|limit| (limit.pair, limit.blocked));
    let listed = |columns: &mut Columns<'_, 'py, ListedPair>| {
        columns.codes("kind", |pair| match pair.kind {
            QueryKind::EdgeEdge => 0,
            QueryKind::VertexFace => 1,
        })?;
        columns.places("index", |pair| pair.index)
    };
    advance::together(py, step, positions, limits, near, listed)
}

/// What is wrong with one of two lists of the same positions.
fn refused(list: &str, error: PairsError) -> Refused {
    match error {
        PairsError::Index { .. } | PairsError::Radius { .. } => {
            Refused::new(&format_args!("{list}: {error}"))
        }
        _ => Refused::new(&error),
    }
}

/// Pairs by their places, and the columns of `Hits`.
type Found<'py> = (Bound<'py, PyArray1<isize>>, Bound<'py, PyDict>);

/// A list of pairs, of which nothing is copied but the radii.
struct List<'a, C> {
    start: &'a [[C; 3]],
    end: &'a [[C; 3]],
    indices: &'a [[u32; 4]],
    radii: Vec<Radius>,
}

impl<'a, C: Coordinate + Element> List<'a, C> {
    fn new(
        start: &'a PyReadonlyArray2<'_, C>,
        end: &'a PyReadonlyArray2<'_, C>,
        indices: &'a PyReadonlyArray2<'_, u32>,
        radii: &PyReadonlyArray2<'_, f64>,
    ) -> PyResult<Self> {
        let radii = rows("radii", radii)?.iter();
        Ok(List {
            start: rows("start", start)?,
            end: rows("end", end)?,
            indices: rows("indices", indices)?,
            radii: radii.map(|&parts: &[f64; 2]| parts.into()).collect(),
        })
    }

    fn pairs<K: Kind>(&self) -> Result<Pairs<'_, K, C>, PairsError> {
        let (start, end, indices) = (self.start, self.end, self.indices);
        // One radius for all saves to look at those of each.
        match *self.radii {
            [radius] => Pairs::new(start, end, indices, radius),
            _ => Pairs::with_radii(start, end, indices, &self.radii),
        }
    }
}

fn found<'py, K: Kind, C: Coordinate + Element>(
    py: Python<'py>,
    list: &List<'_, C>,
) -> PyResult<Found<'py>> {
    let pairs = list.pairs::<K>().map_err(|error| Refused::new(&error))?;
    let firsts: Vec<usize> = (0..pairs.len()).step_by(PART).collect();
    let hits = each(py, &firsts, |&first| {
        let part = pairs.part(first..pairs.len().min(first + PART));
        let hits = part.map_or(Vec::new(), |part| part.decide());
        let whole = |(place, hit): (usize, Hit<K::Place>)| {
            let query = pairs.get(first + place)?;
            Some(((first + place).cast_signed(), Some(Row::new(&query, hit))))
        };
        hits.into_iter().filter_map(whole).collect::<Vec<_>>()
    })?;
    let (places, rows): (Vec<_>, Vec<_>) = hits.into_iter().flatten().unzip();
    Ok((PyArray1::from_vec(py, places), columns(py, &rows)?))
}

/// How many pairs a thread takes at a time.
const PART: usize = 4096;
