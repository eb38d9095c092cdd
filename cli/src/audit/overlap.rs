//! Whether two cores overlap where a step starts, in exact rationals.

use nalgebra::Vector3;
use num_rational::BigRational;
use num_traits::{Signed, Zero};
use tunnelproof::query::Point;
use tunnelproof::rigid::{Pose, RigidMotion};

use super::core::{Core, ROUNDING, Surface};
use super::pairs::corners;

/// A point or a vector, exactly.
type Exact = [BigRational; 3];

/// Whether two cores overlap: an edge of one goes through a face of the other, strictly inside both, or
/// a vertex of one is certainly inside the other. Surfaces that only touch do not.
pub(super) fn overlap(cores: [&Core; 2], poses: [&Pose; 2]) -> bool {
    let [a, b] = cores;
    let [at, other] = poses;
    match (a, b) {
        (Core::Plane, Core::Plane) => false,
        (Core::Surface(a), Core::Plane) => is_below(a, at, other),
        (Core::Plane, Core::Surface(b)) => is_below(b, other, at),
        (Core::Surface(a), Core::Surface(b)) => {
            holds(b, other, a, at)
                || holds(a, at, b, other)
                || goes_through(a, at, b, other)
                || goes_through(b, other, a, at)
        }
    }
}

fn is_below(surface: &Surface, at: &Pose, plane: &Pose) -> bool {
    let normal = turned(plane, &Point::new(0.0, 0.0, 1.0));
    let centre = exact(&plane.centre);
    let is_below = |vertex: &Point| {
        let height = dot(&normal, &difference(&placed(at, vertex), &centre));
        height.is_some_and(|height| height.is_negative())
    };
    corners(&surface.faces).iter().any(is_below)
}

/// Whether a surface certainly has a vertex of another one inside.
fn holds(surface: &Surface, pose: &Pose, other: &Surface, at: &Pose) -> bool {
    let places = corners(&other.faces).into_iter();
    let mut places = places.filter_map(|vertex| seen(at, &vertex, pose));
    places.any(|place| surface.holds(&place))
}

/// A point of a body in the frame of another one, rounded.
fn seen(at: &Pose, point: &Point, by: &Pose) -> Option<Vector3<f64>> {
    let motion = RigidMotion::new(*at, *at).ok()?;
    let turn = nalgebra::UnitQuaternion::new_normalize(by.quaternion);
    let arm = motion.position(point, 0.0) - by.centre;
    Some(turn.inverse_transform_vector(&arm))
}

/// Whether an edge of the first surface goes through a face of the second one.
fn goes_through(first: &Surface, at: &Pose, second: &Surface, other: &Pose) -> bool {
    let size = at.centre.coords.amax() + other.centre.coords.amax();
    let size = [first, second].iter().fold(size, |size, surface| {
        size + surface.low.amax().max(surface.high.amax())
    });
    let margin = ROUNDING * size;
    let mut edges = first.edges.iter().filter_map(|edge| {
        let [p, q] = edge.each_ref().map(|end| seen(at, end, other));
        Some((edge, [p?, q?]))
    });
    edges.any(|(edge, [p, q])| {
        let is_near = |face: &&[Point; 3]| {
            let [b, c, d] = face.map(|corner| corner.coords);
            let normal = (c - b).cross(&(d - b)).normalize();
            let heights = [p, q].map(|end| normal.dot(&(end - b)));
            let across =
                heights[0].min(heights[1]) <= margin && heights[0].max(heights[1]) >= -margin;
            let (low, high) = (p.inf(&q), p.sup(&q));
            let (face_low, face_high) = (b.inf(&c).inf(&d), b.sup(&c).sup(&d));
            let meets = |axis: usize| {
                low[axis] <= face_high[axis] + margin && high[axis] >= face_low[axis] - margin
            };
            across && (0..3).all(meets)
        };
        let mut faces = second.faces.iter().filter(is_near);
        faces.any(|face| {
            pierces(
                &edge.map(|end| placed(at, &end)),
                &face.map(|c| placed(other, &c)),
            )
        })
    })
}

/// Whether a piece of a line goes through a triangle, strictly inside both.
fn pierces([p, q]: &[Option<Exact>; 2], [b, c, d]: &[Option<Exact>; 3]) -> bool {
    let sign = |x: &Option<Exact>, y: &Option<Exact>, z: &Option<Exact>, w: &Option<Exact>| {
        let [to_y, to_z, to_w] = [y, z, w].map(|to| difference(to, x));
        let volume = dot(&cross(&to_y, &to_z), &to_w);
        volume.map_or(0, |volume| {
            i32::from(volume.is_positive()) - i32::from(volume.is_negative())
        })
    };
    let ends = [sign(b, c, d, p), sign(b, c, d, q)];
    let around = [sign(p, q, b, c), sign(p, q, c, d), sign(p, q, d, b)];
    ends[0] * ends[1] < 0 && (around == [1; 3] || around == [-1; 3])
}

/// Where a point of a body is.
fn placed(pose: &Pose, point: &Point) -> Option<Exact> {
    let centre = exact(&pose.centre)?;
    let arm = turned(pose, point)?;
    Some(std::array::from_fn(|k| &centre[k] + &arm[k]))
}

/// A vector of a body's frame in space: `x + 2 (w (v x x) + v x (v x x)) / |q|^2`.
fn turned(pose: &Pose, vector: &Point) -> Option<Exact> {
    let q = pose.quaternion;
    let [w, i, j, k] = [q.w, q.i, q.j, q.k].map(BigRational::from_float);
    let (w, v) = (w?, Some([i?, j?, k?]));
    let x = exact(vector)?;
    let across = cross(&v, &Some(x.clone()))?;
    let twice = cross(&v, &Some(across.clone()))?;
    let norm = &w * &w + dot(&v, &v)?;
    if norm.is_zero() {
        return None;
    }
    let two = BigRational::from_integer(2.into());
    Some(std::array::from_fn(|k| {
        &x[k] + &two * (&w * &across[k] + &twice[k]) / &norm
    }))
}

fn exact(point: &Point) -> Option<Exact> {
    let [x, y, z] = [point.x, point.y, point.z].map(BigRational::from_float);
    Some([x?, y?, z?])
}

fn difference(to: &Option<Exact>, from: &Option<Exact>) -> Option<Exact> {
    let (to, from) = (to.as_ref()?, from.as_ref()?);
    Some(std::array::from_fn(|k| &to[k] - &from[k]))
}

fn cross(a: &Option<Exact>, b: &Option<Exact>) -> Option<Exact> {
    let (a, b) = (a.as_ref()?, b.as_ref()?);
    Some(std::array::from_fn(|k| {
        let (l, m) = ((k + 1) % 3, (k + 2) % 3);
        &a[l] * &b[m] - &a[m] * &b[l]
    }))
}

fn dot(a: &Option<Exact>, b: &Option<Exact>) -> Option<BigRational> {
    let (a, b) = (a.as_ref()?, b.as_ref()?);
    Some(&a[0] * &b[0] + &a[1] * &b[1] + &a[2] * &b[2])
}
