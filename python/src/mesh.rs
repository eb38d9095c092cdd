//! Whole meshes on arrays.

use numpy::{Element, PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray1, PyReadonlyArray2};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use tunnelproof::Coordinate;
use tunnelproof::mesh::{Feature, MeshContact, MeshError, MeshStep, Pair, Thickness};
use tunnelproof_float_env::with_default;

use crate::advance;
use crate::columns::{self, Columns};
use crate::queries::{Ends, of_either, rows};

/// Vertices, edges and faces by their indices, and what is asked about them.
#[pyclass(frozen, module = "tunnelproof._tunnelproof")]
pub(crate) struct Mesh(tunnelproof::Mesh);

fn refused(error: MeshError) -> PyErr {
    PyValueError::new_err(error.to_string())
}

/// A thickness for all, or one for each group.
#[derive(FromPyObject)]
pub(crate) enum Thicknesses<'py> {
    PerGroup(PyReadonlyArray1<'py, f64>),
    Uniform(f64),
}

impl Thicknesses<'_> {
    fn get(&self) -> PyResult<Thickness<'_>> {
        Ok(match self {
            Thicknesses::Uniform(thickness) => (*thickness).into(),
            Thicknesses::PerGroup(thickness) => thickness.as_slice()?.into(),
        })
    }
}

/// The positions at both ends of a step, and the thickness: where they are, without a copy.
struct Question<'a, C> {
    start: &'a [[C; 3]],
    end: &'a [[C; 3]],
    thickness: Thickness<'a>,
}

impl<'a, C: Coordinate + Element> Question<'a, C> {
    fn new(
        start: &'a PyReadonlyArray2<'_, C>,
        end: &'a PyReadonlyArray2<'_, C>,
        thickness: &'a Thicknesses<'_>,
    ) -> PyResult<Self> {
        Ok(Question {
            start: rows("start", start)?,
            end: rows("end", end)?,
            thickness: thickness.get()?,
        })
    }
}

#[pymethods]
impl Mesh {
    #[new]
    fn new(
        vertices: usize,
        edges: PyReadonlyArray2<'_, u32>,
        faces: PyReadonlyArray2<'_, u32>,
        groups: Option<PyReadonlyArray1<'_, u32>>,
        left_out: Vec<(u32, u32)>,
    ) -> PyResult<Self> {
        let (edges, faces) = (rows("edges", &edges)?, rows("faces", &faces)?);
        let mut mesh = tunnelproof::Mesh::new(vertices, edges, faces).map_err(refused)?;
        if let Some(groups) = groups {
            mesh.set_groups(groups.as_slice()?).map_err(refused)?;
        }
        for (first, second) in left_out {
            mesh.leave_out(first, second).map_err(refused)?;
        }
        Ok(Mesh(mesh))
    }

    #[getter]
    fn vertex_count(&self) -> usize {
        self.0.vertex_count()
    }

    #[getter]
    fn group_count(&self) -> usize {
        self.0.group_count()
    }

    #[getter]
    fn edges<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<u32>>> {
        indices(py, self.0.edges())
    }

    #[getter]
    fn faces<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<u32>>> {
        indices(py, self.0.faces())
    }

    /// The columns of `MeshContacts`, with a row at most.
    fn first_contact<'py>(
        &self,
        py: Python<'py>,
        ends: Ends<'py>,
        thickness: Thicknesses<'py>,
    ) -> PyResult<Bound<'py, PyDict>> {
        let first = of_either!(&ends, (start, end) => {
            let asked = Question::new(start, end, &thickness)?;
            let first = || self.0.first_contact(asked.start, asked.end, asked.thickness);
            py.detach(|| with_default(first))
        });
        self.written(py, first.map_err(refused)?.into_iter().collect())
    }

    /// The columns of `MeshContacts`.
    fn all_contacts<'py>(
        &self,
        py: Python<'py>,
        ends: Ends<'py>,
        thickness: Thicknesses<'py>,
    ) -> PyResult<Bound<'py, PyDict>> {
        let all = of_either!(&ends, (start, end) => {
            let asked = Question::new(start, end, &thickness)?;
            let all = || self.0.all_contacts(asked.start, asked.end, asked.thickness);
            py.detach(|| with_default(all))
        });
        self.written(py, all.map_err(refused)?)
    }

    fn is_free<'py>(
        &self,
        py: Python<'py>,
        ends: Ends<'py>,
        thickness: Thicknesses<'py>,
    ) -> PyResult<bool> {
        let is_free = of_either!(&ends, (start, end) => {
            let asked = Question::new(start, end, &thickness)?;
            let is_free = || self.0.is_free(asked.start, asked.end, asked.thickness);
            py.detach(|| with_default(is_free))
        });
        is_free.map_err(refused)
    }

    /// The fields of `MeshStep`.
    fn step<'py>(
        &self,
        py: Python<'py>,
        ends: Ends<'py>,
        thickness: Thicknesses<'py>,
        clearance: f64,
        share: Option<f64>,
    ) -> PyResult<Bound<'py, PyDict>> {
        of_either!(&ends, (start, end) => {
            let asked = Question::new(start, end, &thickness)?;
            self.stepped(py, &asked, clearance, share)
        })
    }
}

impl Mesh {
    fn stepped<'py, C: Coordinate + Element>(
        &self,
        py: Python<'py>,
        asked: &Question<'_, C>,
        clearance: f64,
        share: Option<f64>,
    ) -> PyResult<Bound<'py, PyDict>> {
        let &Question {
            start,
            end,
            thickness,
        } = asked;
        let clearance = with_default(|| advance::clearance(clearance, share))?;
        let step = || self.0.step_with_clearance(start, end, thickness, clearance);
        let step = py.detach(|| with_default(step));
        let MeshStep {
            step,
            positions,
            limits,
            near,
            candidates,
            ..
        } = step.map_err(refused)?;
        let limits = limits.iter().map(|limit| (limit.pair, limit.blocked));
        let pair = |columns: &mut Columns<'_, 'py, Pair>| self.pairs(columns, |pair| *pair);
        let fields = advance::together(py, step, positions, limits, near, pair)?;
        fields.set_item("candidates", (candidates[0], candidates[1]))?;
        Ok(fields)
    }

    fn written<'py>(
        &self,
        py: Python<'py>,
        contacts: Vec<MeshContact>,
    ) -> PyResult<Bound<'py, PyDict>> {
        let contacts: Vec<_> = contacts.into_iter().map(Some).collect();
        let mut columns = Columns::new(py, &contacts);
        self.pairs(&mut columns, |contact: &MeshContact| contact.pair)?;
        columns.numbers("toi", |contact| [contact.toi])?;
        columns.numbers("toi_above", |contact| [contact.toi_above])?;
        columns.codes("kind", |contact| columns::kind(contact.kind))?;
        columns.numbers("weights", |contact| contact.contact.first.weights)?;
        columns.numbers("point", |contact| contact.contact.first.point.into())?;
        columns.numbers("normal", |contact| {
            contact.contact.normal.map_or([0.0; 3], Into::into)
        })?;
        Ok(columns.dict)
    }

    /// The columns of `Pairs`.
    fn pairs<H>(&self, columns: &mut Columns<'_, '_, H>, of: impl Fn(&H) -> Pair) -> PyResult<()> {
        columns.codes("first_feature", |row| feature(of(row).first).0)?;
        columns.indices("first", |row| [feature(of(row).first).1])?;
        columns.codes("second_feature", |row| feature(of(row).second).0)?;
        columns.indices("second", |row| [feature(of(row).second).1])?;
        // Each pair is one of this mesh.
        columns.indices("vertices", |row| {
            self.0.vertices_of(of(row)).unwrap_or_default()
        })
    }
}

/// The value of `Feature` in Python, and the index.
fn feature(feature: Feature) -> (i8, u32) {
    match feature {
        Feature::Vertex(index) => (1, index),
        Feature::Edge(index) => (2, index),
        Feature::Face(index) => (3, index),
    }
}

fn indices<'py, const N: usize>(
    py: Python<'py>,
    rows: &[[u32; N]],
) -> PyResult<Bound<'py, PyArray2<u32>>> {
    let array = PyArray1::from_slice(py, rows.as_flattened());
    array.reshape([rows.len(), N])
}
