//! Cores of bodies: what no wire's midline and no other core may cross.
//!
//! A core is a closed triangle mesh strictly inside its shape, so that whatever lies on the surface
//! does not touch it. It is smaller by an [`INSET`] of the shape's least half width. Only a plane
//! and a mesh, which have no width of their own, are their own cores.
//!
//! | shape | core |
//! | --- | --- |
//! | box | a box, each face moved inward by 1/8 of the least half edge |
//! | cylinder | a prism of eight sides, ends and circumcircle moved inward by 1/8 of the radius or of half the height, whichever is less |
//! | sphere | an icosahedron, its circumsphere 7/8 of the sphere |
//! | capsule | a prism of eight sides around the axis, circumcircle 7/8 of the radius, and its two tips at 7/8 of the caps |
//! | plane | itself |
//! | mesh | itself |

use std::collections::BTreeSet;
use std::f64::consts::FRAC_1_SQRT_2;

use super::Shape;
use crate::query::Point;
use crate::wire::Vector;

/// How far a core is inside its shape, as a part of the shape's least half width.
const INSET: f64 = 0.125;

/// What no midline may cross, in the body's frame.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::wire) enum Core {
    /// A closed surface.
    Surface(Surface),
    /// The half-space `z <= 0`.
    Plane,
}

/// A closed surface of triangles, counterclockwise seen from outside.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::wire) struct Surface {
    pub(in crate::wire) vertices: Vec<Point>,
    pub(in crate::wire) faces: Vec<[usize; 3]>,
    /// All edges but those inside a flat face of the core: what first touches a flat face with an
    /// edge touches it with a vertex, or at an edge around the face.
    pub(in crate::wire) edges: Vec<[usize; 2]>,
    /// How far it is inside the shape, in m.
    pub(in crate::wire) inset: f64,
}

impl Core {
    /// The core of a shape whose dimensions were checked.
    pub(in crate::wire) fn of(shape: &Shape) -> Self {
        Core::Surface(match shape {
            Shape::Plane => return Core::Plane,
            Shape::Box { half } => cuboid(half),
            Shape::Sphere { radius } => icosahedron(*radius),
            Shape::Cylinder {
                radius,
                half_height,
            } => {
                let inset = INSET * radius.min(*half_height);
                prism(radius - inset, half_height - inset, inset)
            }
            Shape::Capsule {
                radius,
                half_height,
            } => {
                let inset = INSET * radius;
                spindle(radius - inset, *half_height, inset)
            }
            Shape::Mesh(mesh) => {
                let (vertices, faces) = (mesh.vertices().to_vec(), mesh.triangles().to_vec());
                let edges = edges(&faces);
                Surface {
                    vertices,
                    faces,
                    edges,
                    inset: 0.0,
                }
            }
        })
    }

    /// The largest coordinate of its vertices, in m; 0 for a plane.
    pub(in crate::wire) fn size(&self) -> f64 {
        match self {
            Core::Surface(surface) => {
                let vertices = surface.vertices.iter();
                vertices.fold(0.0, |size, vertex| size.max(vertex.coords.amax()))
            }
            Core::Plane => 0.0,
        }
    }

    /// How far it is inside the shape, in m.
    pub(in crate::wire) fn inset(&self) -> f64 {
        match self {
            Core::Surface(surface) => surface.inset,
            Core::Plane => 0.0,
        }
    }
}

/// Every edge of some faces, once.
fn edges(faces: &[[usize; 3]]) -> Vec<[usize; 2]> {
    let all = faces.iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]);
    let sorted: BTreeSet<[usize; 2]> = all.map(|[a, b]| [a.min(b), a.max(b)]).collect();
    sorted.into_iter().collect()
}

fn cuboid(half: &Vector) -> Surface {
    let inset = INSET * half.min();
    let half = half.map(|edge| edge - inset);
    let corner = |i: usize| {
        let sign = |bit: usize| if i >> bit & 1 == 1 { 1.0 } else { -1.0 };
        Point::new(half.x * sign(0), half.y * sign(1), half.z * sign(2))
    };
    let faces = [
        [0, 2, 3, 1],
        [4, 5, 7, 6],
        [0, 1, 5, 4],
        [2, 6, 7, 3],
        [0, 4, 6, 2],
        [1, 3, 7, 5],
    ];
    let rims = (0..8usize).flat_map(|i| {
        let across = (0..3).map(move |bit| [i, i | 1 << bit]);
        across.filter(|[a, b]| a != b)
    });
    Surface {
        vertices: (0..8).map(corner).collect(),
        faces: faces.iter().flat_map(|face| fan(face)).collect(),
        edges: rims.collect(),
        inset,
    }
}

/// The triangles of a convex face.
fn fan(face: &[usize]) -> Vec<[usize; 3]> {
    let rest = face[1..].windows(2);
    rest.map(|pair| [face[0], pair[0], pair[1]]).collect()
}

/// The sides of a prism.
const SIDES: usize = 8;

/// A ring of points around z: the corners of an octagon.
fn ring(radius: f64, z: f64) -> impl Iterator<Item = Point> {
    const S: f64 = FRAC_1_SQRT_2;
    let quarter = [[1.0, 0.0], [S, S]];
    (0..SIDES).map(move |k| {
        let [x, y] = quarter[k % 2].map(|w| w * radius);
        match k / 2 {
            0 => Point::new(x, y, z),
            1 => Point::new(-y, x, z),
            2 => Point::new(-x, -y, z),
            _ => Point::new(y, -x, z),
        }
    })
}

/// The sides between a lower ring, vertices 0 to 7, and an upper one, vertices 8 to 15.
fn sides() -> (Vec<[usize; 3]>, Vec<[usize; 2]>) {
    let next = |k: usize| (k + 1) % SIDES;
    let quads = (0..SIDES).flat_map(|k| fan(&[k, next(k), SIDES + next(k), SIDES + k]));
    let rims =
        (0..SIDES).flat_map(|k| [[k, next(k)], [SIDES + k, SIDES + next(k)], [k, SIDES + k]]);
    (quads.collect(), rims.collect())
}

fn prism(radius: f64, half_height: f64, inset: f64) -> Surface {
    let (mut faces, edges) = sides();
    let down: Vec<usize> = (0..SIDES).rev().collect();
    let up: Vec<usize> = (SIDES..2 * SIDES).collect();
    faces.extend(fan(&down));
    faces.extend(fan(&up));
    Surface {
        vertices: ring(radius, -half_height)
            .chain(ring(radius, half_height))
            .collect(),
        faces,
        edges,
        inset,
    }
}

/// A prism with a tip on either end.
fn spindle(radius: f64, half_height: f64, inset: f64) -> Surface {
    let (mut faces, mut edges) = sides();
    let tips = [-1.0, 1.0].map(|sign| Point::new(0.0, 0.0, sign * (half_height + radius)));
    let [low, high] = [2 * SIDES, 2 * SIDES + 1];
    for k in 0..SIDES {
        let next = (k + 1) % SIDES;
        faces.push([low, next, k]);
        faces.push([high, SIDES + k, SIDES + next]);
        edges.push([k, low]);
        edges.push([SIDES + k, high]);
    }
    Surface {
        vertices: ring(radius, -half_height)
            .chain(ring(radius, half_height))
            .chain(tips)
            .collect(),
        faces,
        edges,
        inset,
    }
}

fn icosahedron(radius: f64) -> Surface {
    let inset = INSET * radius;
    // Corners (0, 1, golden ratio) in turn, at a distance of 1.9021.
    let golden = (1.0 + 5f64.sqrt()) / 2.0;
    let size = (radius - inset) / (1.0 + golden * golden).sqrt();
    let (a, b) = (size, golden * size);
    let vertices = [
        [-a, b, 0.0],
        [a, b, 0.0],
        [-a, -b, 0.0],
        [a, -b, 0.0],
        [0.0, -a, b],
        [0.0, a, b],
        [0.0, -a, -b],
        [0.0, a, -b],
        [b, 0.0, -a],
        [b, 0.0, a],
        [-b, 0.0, -a],
        [-b, 0.0, a],
    ];
    let faces = vec![
        [0, 11, 5],
        [0, 5, 1],
        [0, 1, 7],
        [0, 7, 10],
        [0, 10, 11],
        [1, 5, 9],
        [5, 11, 4],
        [11, 10, 2],
        [10, 7, 6],
        [7, 1, 8],
        [3, 9, 4],
        [3, 4, 2],
        [3, 2, 6],
        [3, 6, 8],
        [3, 8, 9],
        [4, 9, 5],
        [2, 4, 11],
        [6, 2, 10],
        [8, 6, 7],
        [9, 8, 1],
    ];
    Surface {
        vertices: vertices.map(Point::from).to_vec(),
        edges: edges(&faces),
        faces,
        inset,
    }
}

impl Surface {
    /// The least and the largest coordinates.
    pub(in crate::wire) fn bounds(&self) -> [Point; 2] {
        let corners = || self.vertices.iter().copied();
        let low = corners().reduce(|a, b| a.inf(&b));
        let high = corners().reduce(|a, b| a.sup(&b));
        [low, high].map(Option::unwrap_or_default)
    }

    /// Whether a point is inside. None so near the surface that rounding could deceive.
    pub(in crate::wire) fn holds(&self, point: &Point) -> Option<bool> {
        let doubt = self.doubt(point);
        let mut turns = 0.0;
        for face in &self.faces {
            let corners = face.map(|k| self.vertices[k] - point);
            if distance(&corners) <= doubt {
                return None;
            }
            turns += solid_angle(&corners);
        }
        Some(turns > 2.0 * std::f64::consts::PI)
    }

    /// How near the surface it is not certain whether a point is inside, in m.
    pub(in crate::wire) fn doubt(&self, point: &Point) -> f64 {
        const NEXT: f64 = 1e-9;
        let corners = self.vertices.iter();
        let size = corners.fold(0.0, |size: f64, vertex| size.max((vertex - point).amax()));
        NEXT * size
    }

    /// The outward normals, of any length, of the faces that are so near a point, in m.
    pub(in crate::wire) fn normals_near(&self, point: &Point, reach: f64) -> Vec<Vector> {
        let faces = self.faces.iter();
        let faces = faces.map(|face| face.map(|k| self.vertices[k] - point));
        let near = faces.filter(|corners| distance(corners) <= reach);
        near.map(|[a, b, c]| (b - a).cross(&(c - a))).collect()
    }
}

/// The solid angle of a triangle seen from the origin (van Oosterom and Strackee 1983).
fn solid_angle([a, b, c]: &[Vector; 3]) -> f64 {
    let [x, y, z] = [a, b, c].map(|corner| corner.norm());
    let volume = a.dot(&b.cross(c));
    let flat = x * y * z + a.dot(b) * z + b.dot(c) * x + c.dot(a) * y;
    2.0 * libm::atan2(volume, flat)
}

/// The distance of a triangle from the origin.
fn distance([a, b, c]: &[Vector; 3]) -> f64 {
    let normal = (b - a).cross(&(c - a));
    let inside = |from: &Vector, to: &Vector| (to - from).cross(&-from).dot(&normal) >= 0.0;
    if normal.norm() > 0.0 && inside(a, b) && inside(b, c) && inside(c, a) {
        return a.dot(&normal.normalize()).abs();
    }
    let edge = |from: &Vector, to: &Vector| {
        let along = to - from;
        let length = along.norm_squared();
        let at = if length > 0.0 {
            (-from.dot(&along) / length).clamp(0.0, 1.0)
        } else {
            0.0
        };
        (from + along * at).norm()
    };
    edge(a, b).min(edge(b, c)).min(edge(c, a))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::wire::model::Mesh;

    fn shapes() -> [Shape; 5] {
        [
            Shape::Box {
                half: Vector::new(0.5, 2.0, 0.01),
            },
            Shape::Cylinder {
                radius: 0.002,
                half_height: 1.5,
            },
            Shape::Cylinder {
                radius: 1.5,
                half_height: 0.1,
            },
            Shape::Sphere { radius: 0.3 },
            Shape::Capsule {
                radius: 0.05,
                half_height: 0.4,
            },
        ]
    }

    fn surface(shape: &Shape) -> Surface {
        match Core::of(shape) {
            Core::Surface(surface) => surface,
            Core::Plane => unreachable!(),
        }
    }

    /// How far a point is outside of a shape, below 0 inside.
    fn outside(shape: &Shape, point: &Point) -> f64 {
        let across = point.x.hypot(point.y);
        match shape {
            Shape::Box { half } => (point.coords.abs() - half).max(),
            Shape::Cylinder {
                radius,
                half_height,
            } => (across - radius).max(point.z.abs() - half_height),
            Shape::Sphere { radius } => point.coords.norm() - radius,
            Shape::Capsule {
                radius,
                half_height,
            } => across.hypot((point.z.abs() - half_height).max(0.0)) - radius,
            Shape::Plane | Shape::Mesh(_) => unreachable!(),
        }
    }

    #[test]
    fn cores_are_closed_and_strictly_inside_their_shapes() {
        for shape in shapes() {
            let core = surface(&shape);
            // A mesh is closed, and has a volume above 0.
            Mesh::new(core.vertices.clone(), core.faces.clone()).unwrap();
            for vertex in &core.vertices {
                // All of these shapes are convex.
                assert!(outside(&shape, vertex) < -0.99 * core.inset, "{shape:?}");
            }
            let known = edges(&core.faces);
            assert!(
                core.edges
                    .iter()
                    .all(|[a, b]| known.contains(&[*a.min(b), *a.max(b)]))
            );
            for face in &core.faces {
                let [a, b, c] = face.map(|k| core.vertices[k].coords);
                assert!((b - a).cross(&(c - a)).dot(&a) > 0.0, "{shape:?} {face:?}");
            }
        }
    }

    /// Edges that are left out are between triangles of one plane, exactly.
    #[test]
    fn core_edges_that_are_left_out_are_in_flat_faces() {
        for shape in shapes() {
            let core = surface(&shape);
            for edge in edges(&core.faces) {
                if core
                    .edges
                    .iter()
                    .any(|[a, b]| edge == [*a.min(b), *a.max(b)])
                {
                    continue;
                }
                let beside = core.faces.iter();
                let beside = beside.filter(|face| edge.iter().all(|k| face.contains(k)));
                let mut corners: Vec<usize> = beside.flatten().copied().collect();
                corners.sort_unstable();
                corners.dedup();
                let four = [0, 1, 2, 3].map(|k| core.vertices[corners[k]]);
                // In a plane across an axis; or upright, two above the other two.
                let level = (0..3).any(|axis| four.iter().all(|p| p[axis] == four[0][axis]));
                let is_above = |p: &Point| four.iter().filter(|q| p.xy() == q.xy()).count() == 2;
                let upright = four.iter().all(is_above);
                assert!(level || upright, "{shape:?}: {corners:?}");
            }
        }
    }

    #[test]
    fn cores_hold_what_is_inside_and_nothing_next_to_the_surface() {
        for shape in shapes() {
            let core = surface(&shape);
            assert_eq!(core.holds(&Point::origin()), Some(true));
            for vertex in &core.vertices {
                let holds = |times: f64| core.holds(&Point::from(vertex.coords * times));
                assert_eq!(holds(0.9), Some(true), "{shape:?}");
                assert_eq!([holds(1.0), holds(1.0 + 1e-12)], [None; 2]);
                assert_eq!(holds(1.1), Some(false));
            }
        }
    }
}
