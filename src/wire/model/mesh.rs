//! Closed triangle meshes.

use std::collections::BTreeMap;
use std::sync::Arc;

use nalgebra::Matrix3;

use super::ModelError;
use super::check::finite_point;
use super::shape::MassProperties;
use crate::query::Point;
use crate::wire::Vector;

/// A closed surface of triangles around its centre of mass. Copies share its vertices and triangles.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "Parts", into = "Parts"))]
pub struct Mesh {
    vertices: Arc<[Point]>,
    triangles: Arc<[[usize; 3]]>,
    centre: Point,
}

impl Mesh {
    /// A mesh whose triangles are counterclockwise seen from outside. The vertices are moved so
    /// that the centre of mass is their origin; [`centre`](Self::centre) tells where it was.
    ///
    /// # Errors
    ///
    /// A coordinate that is not finite, a corner that is not there, an edge without its neighbour,
    /// or a volume that is not above 0 (turned inside out).
    pub fn new(vertices: Vec<Point>, triangles: Vec<[usize; 3]>) -> Result<Self, ModelError> {
        let mesh = Mesh {
            vertices: vertices.into(),
            triangles: triangles.into(),
            centre: Point::origin(),
        };
        let (volume, moment) = mesh.check()?;
        let centre = Point::from(moment / volume);
        let around = mesh.vertices.iter().map(|vertex| vertex - centre.coords);
        Ok(Mesh {
            vertices: around.collect(),
            centre,
            ..mesh
        })
    }

    /// Whether it is a closed surface around a volume; returns its volume and first moment.
    fn check(&self) -> Result<(f64, Vector), ModelError> {
        for vertex in self.vertices.iter() {
            finite_point("vertex", vertex)?;
        }
        check_corners(&self.triangles, self.vertices.len())?;
        check_closed(&self.triangles)?;
        let (volume, moment) = self.volume_and_moment();
        let accepted = "finite and above 0: triangles are counterclockwise seen from outside";
        if !(volume.is_finite() && volume > 0.0) {
            return Err(ModelError::value("volume of the mesh", volume, accepted));
        }
        Ok((volume, moment))
    }

    /// Vertices relative to the centre of mass, in m.
    pub fn vertices(&self) -> &[Point] {
        &self.vertices
    }

    /// Corners of each triangle.
    pub fn triangles(&self) -> &[[usize; 3]] {
        &self.triangles
    }

    /// The centre of mass in the coordinates the mesh was made from, in m.
    pub fn centre(&self) -> Point {
        self.centre
    }

    /// Corners as vectors, and six times the signed volume of the tetrahedron with the origin.
    fn tetrahedra(&self) -> impl Iterator<Item = ([Vector; 3], f64)> {
        self.triangles.iter().map(|corners| {
            let [a, b, c] = corners.map(|i| self.vertices[i].coords);
            ([a, b, c], a.dot(&b.cross(&c)))
        })
    }

    fn volume_and_moment(&self) -> (f64, Vector) {
        let zero = (0.0, Vector::zeros());
        self.tetrahedra()
            .fold(zero, |(volume, moment), ([a, b, c], six)| {
                (volume + six / 6.0, moment + (a + b + c) * (six / 24.0))
            })
    }

    pub(super) fn mass_properties(&self, density: f64) -> MassProperties {
        let (volume, _) = self.volume_and_moment();
        // Of a tetrahedron with a corner at the origin: integral of x x^T
        // = V/20 ((a + b + c)(a + b + c)^T + a a^T + b b^T + c c^T).
        let mut second = Matrix3::zeros();
        for ([a, b, c], six) in self.tetrahedra() {
            let outer = |v: Vector| v * v.transpose();
            second += (outer(a + b + c) + outer(a) + outer(b) + outer(c)) * (six / 120.0);
        }
        MassProperties {
            mass: density * volume,
            inertia: (Matrix3::identity() * second.trace() - second) * density,
        }
    }
}

/// A mesh as it is stored: vertices are around the centre of mass already, to the bit.
#[cfg(feature = "serde")]
#[derive(serde::Serialize, serde::Deserialize)]
pub(in crate::wire) struct Parts {
    vertices: Vec<Point>,
    triangles: Vec<[usize; 3]>,
    centre: Point,
}

#[cfg(feature = "serde")]
impl From<&Mesh> for Parts {
    fn from(mesh: &Mesh) -> Self {
        Parts {
            vertices: mesh.vertices.to_vec(),
            triangles: mesh.triangles.to_vec(),
            centre: mesh.centre,
        }
    }
}

#[cfg(feature = "serde")]
impl From<Mesh> for Parts {
    fn from(mesh: Mesh) -> Self {
        Parts::from(&mesh)
    }
}

#[cfg(feature = "serde")]
impl TryFrom<Parts> for Mesh {
    type Error = ModelError;

    fn try_from(parts: Parts) -> Result<Self, ModelError> {
        let Parts {
            vertices,
            triangles,
            centre,
        } = parts;
        finite_point("centre", &centre)?;
        let mesh = Mesh {
            vertices: vertices.into(),
            triangles: triangles.into(),
            centre,
        };
        mesh.check()?;
        Ok(mesh)
    }
}

fn check_corners(triangles: &[[usize; 3]], count: usize) -> Result<(), ModelError> {
    for (triangle, corners) in triangles.iter().enumerate() {
        if let Some(&index) = corners.iter().find(|&&index| index >= count) {
            return Err(ModelError::Vertex {
                triangle,
                index,
                count,
            });
        }
    }
    Ok(())
}

fn check_closed(triangles: &[[usize; 3]]) -> Result<(), ModelError> {
    let mut directed = BTreeMap::new();
    for &[a, b, c] in triangles {
        for edge in [[a, b], [b, c], [c, a]] {
            *directed.entry(edge).or_insert(0_usize) += 1;
        }
    }
    for (&[a, b], &count) in &directed {
        if count != 1 || directed.get(&[b, a]) != Some(&1) {
            return Err(ModelError::OpenMesh { edge: [a, b] });
        }
    }
    Ok(())
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    /// A tetrahedron with corners at `at` and one unit along each axis from it.
    pub(crate) fn corner_at(at: Vector) -> (Vec<Point>, Vec<[usize; 3]>) {
        let tips = [Vector::zeros(), Vector::x(), Vector::y(), Vector::z()];
        let vertices = tips.map(|tip| Point::from(tip + at)).to_vec();
        let triangles = vec![[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];
        (vertices, triangles)
    }

    /// A box around a place, of two triangles for each face.
    pub(crate) fn box_mesh(half: Vector, at: Vector) -> Mesh {
        let corner = |i: usize| {
            let sign = |bit: usize| if i >> bit & 1 == 1 { 1.0 } else { -1.0 };
            let signs = Vector::new(sign(0), sign(1), sign(2));
            Point::from(half.component_mul(&signs) + at)
        };
        let faces = [
            [0, 2, 3, 1],
            [4, 5, 7, 6],
            [0, 1, 5, 4],
            [2, 6, 7, 3],
            [0, 4, 6, 2],
            [1, 3, 7, 5],
        ];
        let triangles = faces
            .iter()
            .flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]])
            .collect();
        Mesh::new((0..8).map(corner).collect(), triangles).unwrap()
    }

    #[test]
    fn mesh_centre_of_mass_is_the_mean_of_a_tetrahedrons_corners() {
        let at = Vector::new(3.0, -2.0, 5.0);
        let (vertices, triangles) = corner_at(at);
        let mesh = Mesh::new(vertices, triangles).unwrap();
        let centre = at + Vector::repeat(0.25);
        assert!((mesh.centre().coords - centre).norm() < 1e-14);
        assert!((mesh.mass_properties(6.0).mass - 1.0).abs() < 1e-13);
    }

    #[test]
    fn mesh_is_refused_open_inside_out_or_without_a_vertex() {
        let (vertices, triangles) = corner_at(Vector::zeros());
        let open = Mesh::new(vertices.clone(), triangles[..3].to_vec()).unwrap_err();
        assert_eq!(open, ModelError::OpenMesh { edge: [1, 3] });
        let inside_out = triangles.iter().map(|&[a, b, c]| [a, c, b]).collect();
        let text = Mesh::new(vertices.clone(), inside_out)
            .unwrap_err()
            .to_string();
        assert!(text.starts_with("volume of the mesh is -0.16666666666666666, it must be"));
        let missing = Mesh::new(vertices, vec![[0, 1, 9]])
            .unwrap_err()
            .to_string();
        assert_eq!(
            missing,
            "triangle 0 has corner 9: vertices are 0 to 4 (excluded)"
        );
    }
}
