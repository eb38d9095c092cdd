//! Cores of bodies, made from the list of their corners (docs/wires-and-bodies.md) and from nothing else of the
//! stepper: faces are found as those of the convex hull.

use nalgebra::Vector3;
use tunnelproof::query::Point;
use tunnelproof::wire::Shape;

type Vector = Vector3<f64>;

/// More than all roundings of a place, as a part of its coordinates.
pub(super) const ROUNDING: f64 = 1e-12;

/// Directions in which it is counted how often a surface is crossed.
pub(super) const RAYS: [[f64; 3]; 4] = [
    [0.91, 0.31, 0.27],
    [-0.22, 0.87, -0.44],
    [0.13, -0.41, 0.9],
    [-0.7, -0.51, -0.5],
];

/// What no midline may cross, in the body's frame.
#[derive(Clone, Debug)]
pub(super) enum Core {
    /// The half-space `z <= 0`.
    Plane,
    Surface(Surface),
}

/// A closed surface.
#[derive(Clone, Debug)]
pub(super) struct Surface {
    pub(super) faces: Vec<[Point; 3]>,
    pub(super) edges: Vec<[Point; 2]>,
    /// Outward unit normals of all faces, if it is convex.
    normals: Option<Vec<Vector>>,
    pub(super) low: Vector,
    pub(super) high: Vector,
}

impl Core {
    pub(super) fn of(shape: &Shape) -> Self {
        let corners = match shape {
            Shape::Plane => return Core::Plane,
            Shape::Mesh(mesh) => {
                let corner = |&k: &usize| mesh.vertices()[k];
                let faces = mesh.triangles().iter();
                let faces = faces.map(|[a, b, c]| [a, b, c].map(corner)).collect();
                return Core::Surface(Surface::new(faces, None));
            }
            Shape::Box { half } => {
                let half = half.map(|edge| edge - half.min() / 8.0);
                signs(3)
                    .map(|s| Vector::new(half.x * s[0], half.y * s[1], half.z * s[2]))
                    .collect()
            }
            Shape::Sphere { radius } => {
                let golden = (1.0 + 5f64.sqrt()) / 2.0;
                let size = (radius - radius / 8.0) / (1.0 + golden * golden).sqrt();
                let long = golden * size;
                let corners = signs(2).flat_map(|s| {
                    let (a, b) = (size * s[0], long * s[1]);
                    [[0.0, a, b], [a, b, 0.0], [b, 0.0, a]]
                });
                corners.map(Vector::from).collect()
            }
            Shape::Cylinder {
                radius,
                half_height,
            } => {
                let inset = radius.min(*half_height) / 8.0;
                let ends = [-1.0, 1.0].map(|s| s * (half_height - inset));
                octagons(radius - inset, &ends)
            }
            Shape::Capsule {
                radius,
                half_height,
            } => {
                let across = radius - radius / 8.0;
                let mut corners = octagons(across, &[-half_height, *half_height]);
                corners.extend([-1.0, 1.0].map(|s| Vector::z() * (s * (half_height + across))));
                corners
            }
        };
        let (faces, normals) = hull(&corners);
        Core::Surface(Surface::new(faces, Some(normals)))
    }
}

/// All lists of so many signs.
fn signs(count: u32) -> impl Iterator<Item = Vec<f64>> {
    (0..1u32 << count).map(move |i| {
        let sign = |k| if i >> k & 1 == 0 { 1.0 } else { -1.0 };
        (0..count).map(sign).collect()
    })
}

/// The corners of octagons around z with two on each of the axes x and y.
fn octagons(radius: f64, heights: &[f64]) -> Vec<Vector> {
    let slant = std::f64::consts::FRAC_1_SQRT_2 * radius;
    let on_axes = [[radius, 0.0], [-radius, 0.0], [0.0, radius], [0.0, -radius]];
    let slanted = signs(2).map(|s| [slant * s[0], slant * s[1]]);
    let around: Vec<[f64; 2]> = on_axes.into_iter().chain(slanted).collect();
    let at = |&z: &f64| {
        around
            .iter()
            .map(move |&[x, y]| Vector::new(x, y, z))
            .collect::<Vec<_>>()
    };
    heights.iter().flat_map(at).collect()
}

/// Every triangle of corners that has all others on one side or in its plane, with its normal.
fn hull(corners: &[Vector]) -> (Vec<[Point; 3]>, Vec<Vector>) {
    let size = corners
        .iter()
        .fold(0.0, |a: f64, corner| a.max(corner.amax()));
    let (mut faces, mut normals) = (Vec::new(), Vec::new());
    for (i, a) in corners.iter().enumerate() {
        for (j, b) in corners.iter().enumerate().skip(i + 1) {
            for c in &corners[j + 1..] {
                let normal = (b - a).cross(&(c - a)).normalize();
                // The origin is inside.
                let normal = if normal.dot(a) < 0.0 { -normal } else { normal };
                if corners
                    .iter()
                    .all(|d| normal.dot(&(d - a)) <= ROUNDING * size)
                {
                    faces.push([a, b, c].map(|corner| Point::from(*corner)));
                    normals.push(normal);
                }
            }
        }
    }
    (faces, normals)
}

impl Surface {
    fn new(faces: Vec<[Point; 3]>, normals: Option<Vec<Vector>>) -> Self {
        let order = |a: &Point, b: &Point| {
            let by_axis = (0..3).map(|axis| a[axis].total_cmp(&b[axis]));
            by_axis.fold(std::cmp::Ordering::Equal, std::cmp::Ordering::then)
        };
        let sides = faces.iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]);
        let mut edges: Vec<[Point; 2]> = sides
            .map(|[a, b]| {
                if order(&a, &b).is_lt() {
                    [a, b]
                } else {
                    [b, a]
                }
            })
            .collect();
        edges.sort_by(|x, y| order(&x[0], &y[0]).then(order(&x[1], &y[1])));
        edges.dedup();
        let corners = || faces.as_flattened().iter().map(|corner| corner.coords);
        let low = corners().reduce(|a, b| a.inf(&b)).unwrap_or_default();
        let high = corners().reduce(|a, b| a.sup(&b)).unwrap_or_default();
        Surface {
            edges,
            normals,
            low,
            high,
            faces,
        }
    }

    /// Whether some points are beyond one of the planes of a convex surface by more than `margin`.
    pub(super) fn is_beyond(&self, points: &[Vector], margin: f64) -> bool {
        let Some(normals) = &self.normals else {
            return false;
        };
        let mut planes = normals.iter().zip(&self.faces);
        planes.any(|(normal, face)| {
            let beyond = |point: &Vector| normal.dot(&(point - face[0].coords)) > margin;
            points.iter().all(beyond)
        })
    }

    /// The largest coordinate of its corners.
    pub(super) fn extent(&self) -> f64 {
        self.low.amax().max(self.high.amax())
    }

    /// Whether it is convex, with the origin inside.
    pub(super) fn is_convex(&self) -> bool {
        self.normals.is_some()
    }

    /// Whether a point that is rounded by less than `margin` is inside; `None` where that leaves it in
    /// doubt.
    pub(super) fn holds(&self, point: &Vector, margin: f64) -> Option<bool> {
        let Some(normals) = &self.normals else {
            return self.is_around(point, margin);
        };
        let planes = normals.iter().zip(&self.faces);
        let heights = planes.map(|(normal, face)| normal.dot(&(point - face[0].coords)));
        let highest = heights.fold(f64::NEG_INFINITY, f64::max);
        (highest.abs() > margin).then_some(highest < 0.0)
    }

    /// Whether rays from a point, which is not next to a face, leave the surface more often than they
    /// enter it; `None` if rays in several directions do not agree.
    fn is_around(&self, point: &Vector, margin: f64) -> Option<bool> {
        let is_next = |face: &[Point; 3]| {
            let [a, b, c] = face.map(|corner| corner.coords);
            let normal = (b - a).cross(&(c - a)).normalize();
            let (low, high) = (a.inf(&b).inf(&c), a.sup(&b).sup(&c));
            let inside = |axis: usize| {
                point[axis] >= low[axis] - margin && point[axis] <= high[axis] + margin
            };
            // Also where a face has no normal.
            let beside = normal.dot(&(point - a)).abs() > margin;
            !beside && (0..3).all(inside)
        };
        let leaves = |ray: [f64; 3]| {
            let ray = Vector::from(ray);
            let crossed = self.faces.iter().map(|face| crosses(face, point, &ray));
            crossed.sum::<i32>()
        };
        let times = RAYS.map(leaves);
        let agree = times.iter().all(|count| *count == times[0]);
        (agree && !self.faces.iter().any(is_next)).then_some(times[0] > 0)
    }
}

/// 1 where a ray from a point leaves through a face, -1 where it enters (Moeller and Trumbore 1997).
fn crosses(face: &[Point; 3], from: &Vector, ray: &Vector) -> i32 {
    let [a, b, c] = face.map(|corner| corner.coords);
    let (e1, e2) = (b - a, c - a);
    let across = ray.cross(&e2);
    let volume = e1.dot(&across);
    let along = from - a;
    let u = along.dot(&across) / volume;
    let turned = along.cross(&e1);
    let v = ray.dot(&turned) / volume;
    let distance = e2.dot(&turned) / volume;
    let hits = u >= 0.0 && v >= 0.0 && u + v <= 1.0 && distance > 0.0;
    match (hits, volume < 0.0) {
        (false, _) => 0,
        (true, true) => 1,
        (true, false) => -1,
    }
}
