//! Whether two cores overlap where a step starts, in exact integers.
//!
//! A point `x` of a body at `c`, turned by `q`, is at `(|q|^2 c + M(q) x) / |q|^2`. Of two bodies all
//! places are taken times both squared lengths and a power of two: integers, and signs of volumes are
//! the same.

use nalgebra::{UnitQuaternion, Vector3};
use num_bigint::{BigInt, Sign};
use tunnelproof::query::Point;
use tunnelproof::rigid::{Pose, RigidMotion};

use super::core::{Core, ROUNDING, Surface};
use super::pairs::{are_apart, corners};

/// A point or a vector, times a number above 0.
type Exact = [BigInt; 3];

/// A body whose core is looked at.
#[derive(Clone, Copy)]
struct Body<'a> {
    surface: &'a Surface,
    pose: &'a Pose,
}

/// Whether two cores overlap: an edge of one goes through a face of the other, strictly inside both, or
/// a vertex of one is certainly inside the other. Surfaces that only touch do not.
pub(super) fn overlap(cores: [&Core; 2], poses: [&Pose; 2]) -> bool {
    let [at, other] = poses;
    match cores {
        [Core::Plane, Core::Plane] => false,
        [Core::Surface(surface), Core::Plane] => is_below(Body { surface, pose: at }, other),
        [Core::Plane, Core::Surface(surface)] => is_below(
            Body {
                surface,
                pose: other,
            },
            at,
        ),
        [Core::Surface(a), Core::Surface(b)] => {
            let (a, b) = (
                Body {
                    surface: a,
                    pose: at,
                },
                Body {
                    surface: b,
                    pose: other,
                },
            );
            holds(a, b) || holds(b, a) || goes_through(a, b) || goes_through(b, a)
        }
    }
}

/// Whether a vertex is below the plane of another body.
fn is_below(body: Body<'_>, plane: &Pose) -> bool {
    let vertices = corners(&body.surface.faces);
    let on_plane = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]];
    let on_plane = on_plane.map(|[x, y]| Point::new(x, y, 0.0));
    let mut below = vertices.iter().map(|vertex| {
        let space = Space::new([body.pose, plane], &[&[*vertex], &on_plane])?;
        let [o, x, y] = on_plane.map(|point| space.place(1, &point));
        Some(volume(&o, &x, &y, &space.place(0, vertex)) == Sign::Minus)
    });
    below.any(|is_below| is_below == Some(true))
}

/// Whether a body certainly has a vertex of another one inside.
fn holds(body: Body<'_>, other: Body<'_>) -> bool {
    let places = corners(&other.surface.faces).into_iter();
    let mut places = places.filter_map(|vertex| seen(other.pose, &vertex, body.pose));
    places.any(|place| body.surface.holds(&place))
}

/// A point of a body in the frame of another one, rounded.
fn seen(pose: &Pose, point: &Point, by: &Pose) -> Option<Vector3<f64>> {
    let motion = RigidMotion::new(*pose, *pose).ok()?;
    let turn = UnitQuaternion::new_normalize(by.quaternion);
    let arm = motion.position(point, 0.0) - by.centre;
    Some(turn.inverse_transform_vector(&arm))
}

/// Whether an edge of the first body goes through a face of the second one. Those that are apart by
/// more than what is rounded are left out before.
fn goes_through(first: Body<'_>, second: Body<'_>) -> bool {
    let size = [first, second].iter().fold(0.0, |size, body| {
        let extent = body.surface.low.amax().max(body.surface.high.amax());
        size + body.pose.centre.coords.amax() + extent
    });
    let margin = ROUNDING * size;
    let Surface { low, high, .. } = second.surface;
    let edges = first.surface.edges.iter().filter_map(|edge| {
        let [p, q] = edge
            .each_ref()
            .map(|end| seen(first.pose, end, second.pose));
        Some((edge, [p?, q?]))
    });
    let mut edges = edges.filter(|(_, [p, q])| {
        let meets = |axis: usize| {
            p[axis].min(q[axis]) <= high[axis] + margin
                && p[axis].max(q[axis]) >= low[axis] - margin
        };
        (0..3).all(meets)
    });
    edges.any(|(edge, ends)| {
        let is_near = |face: &&[Point; 3]| {
            let corners = face.map(|corner| corner.coords);
            !are_apart(&ends, &corners, margin)
        };
        let mut faces = second.surface.faces.iter().filter(is_near);
        faces.any(|face| {
            let space = Space::new([first.pose, second.pose], &[edge, face]);
            space.is_some_and(|space| {
                let ends = edge.map(|end| space.place(0, &end));
                pierces(&ends, &face.map(|corner| space.place(1, &corner)))
            })
        })
    })
}

/// Whether a piece of a line goes through a triangle, strictly inside both.
fn pierces([p, q]: &[Exact; 2], [b, c, d]: &[Exact; 3]) -> bool {
    let around = [volume(p, q, b, c), volume(p, q, c, d), volume(p, q, d, b)];
    let is_inside = around == [Sign::Plus; 3] || around == [Sign::Minus; 3];
    is_inside && volume(b, c, d, p) * volume(b, c, d, q) == Sign::Minus
}

/// The sign of the volume between four points.
fn volume(x: &Exact, y: &Exact, z: &Exact, w: &Exact) -> Sign {
    let [a, b, c] = [y, z, w].map(|to| -> Exact { std::array::from_fn(|k| &to[k] - &x[k]) });
    dot(&cross(&a, &b), &c).sign()
}

/// Two bodies in integers.
struct Space {
    /// w, x, y, z of each, and the square of its length.
    quaternions: [([BigInt; 4], BigInt); 2],
    centres: [Exact; 2],
    /// The power of two by which coordinates are multiplied.
    exponent: i32,
}

impl Space {
    /// For these points of both. None of numbers that are not finite.
    fn new(poses: [&Pose; 2], points: &[&[Point]; 2]) -> Option<Self> {
        let centres = poses.map(|pose| pose.centre);
        let all = points
            .iter()
            .flat_map(|points| points.iter())
            .chain(&centres);
        let coordinates: Vec<f64> = all.flat_map(|point| [point.x, point.y, point.z]).collect();
        let exponent = common_exponent(&coordinates)?;
        let of = |pose: &Pose| {
            let q = [
                pose.quaternion.w,
                pose.quaternion.i,
                pose.quaternion.j,
                pose.quaternion.k,
            ];
            let exponent = common_exponent(&q)?;
            let q = q.map(|x| integer(x, exponent));
            let square = q.iter().map(|x| x * x).sum();
            Some((q, square))
        };
        Some(Space {
            quaternions: [of(poses[0])?, of(poses[1])?],
            centres: centres.map(|centre| exact(&centre, exponent)),
            exponent,
        })
    }

    /// Where a point of a body is, times what all places are taken times.
    fn place(&self, body: usize, point: &Point) -> Exact {
        let (q, square) = &self.quaternions[body];
        let other = &self.quaternions[1 - body].1;
        let x = exact(point, self.exponent);
        let [w, i, j, k] = q;
        let v = [i.clone(), j.clone(), k.clone()];
        // |q|^2 R x = |q|^2 x + 2 (w (v x x) + v x (v x x)).
        let across = cross(&v, &x);
        let twice = cross(&v, &across);
        let centre = &self.centres[body];
        std::array::from_fn(|k| {
            let straight = square * (&x[k] + &centre[k]);
            other * (straight + (w * &across[k] + &twice[k]) * 2)
        })
    }
}

/// A power of two times which all of some numbers are integers. None if one is not finite.
fn common_exponent(numbers: &[f64]) -> Option<i32> {
    let exponent = |x: &f64| {
        let biased = (x.to_bits() >> 52 & 0x7ff) as i32;
        // Of 0 as well.
        1075 - biased.max(1)
    };
    let is_finite = numbers.iter().all(|x| x.is_finite());
    let not_zero = numbers.iter().filter(|x| **x != 0.0);
    is_finite.then(|| not_zero.map(exponent).max().unwrap_or(0))
}

/// `x` times a power of two with which it is an integer.
fn integer(x: f64, exponent: i32) -> BigInt {
    let biased = (x.to_bits() >> 52 & 0x7ff) as i32;
    let fraction = x.to_bits() & ((1 << 52) - 1);
    let mantissa = if biased > 0 {
        fraction | 1 << 52
    } else {
        fraction
    };
    let magnitude = BigInt::from(mantissa) << (exponent - 1075 + biased.max(1)).max(0);
    if x < 0.0 { -magnitude } else { magnitude }
}

fn exact(point: &Point, exponent: i32) -> Exact {
    [point.x, point.y, point.z].map(|x| integer(x, exponent))
}

fn cross(a: &Exact, b: &Exact) -> Exact {
    std::array::from_fn(|k| {
        let (l, m) = ((k + 1) % 3, (k + 2) % 3);
        &a[l] * &b[m] - &a[m] * &b[l]
    })
}

fn dot(a: &Exact, b: &Exact) -> BigInt {
    &a[0] * &b[0] + &a[1] * &b[1] + &a[2] * &b[2]
}

#[cfg(test)]
mod tests {
    use super::*;
    use tunnelproof::nalgebra::Quaternion;
    use tunnelproof::wire::Shape;

    fn cube() -> Core {
        Core::of(&Shape::Box {
            half: Vector3::repeat(8.0),
        })
    }

    fn pose(x: f64, y: f64) -> Pose {
        // A turn by 90 degrees about z, not of length 1.
        Pose::new(Point::new(x, y, 0.5), Quaternion::new(3.0, 0.0, 0.0, 3.0))
    }

    #[test]
    fn cores_overlap_if_they_do_and_not_where_they_only_touch() {
        // Cores are cubes from -7 to 7.
        let core = cube();
        let at_rest = Pose::new(Point::origin(), Quaternion::new(1.0, 0.0, 0.0, 0.0));
        let both = |x: f64, y: f64| overlap([&core, &core], [&at_rest, &pose(x, y)]);
        assert!(both(13.9, 1.0) && both(0.5, 0.25) && both(-13.9, 13.9));
        assert!(!both(14.0, 1.0) && !both(14.0, 14.0) && !both(14.1, 0.0));
        // By less than what is rounded.
        assert!(both(14f64.next_down(), 1.0) && !both(14f64.next_up(), 1.0));
    }

    #[test]
    fn cores_overlap_with_a_plane_that_they_go_below() {
        let (core, plane) = (cube(), Core::Plane);
        let rest = pose(0.0, 0.0);
        let at = |z: f64| Pose::new(Point::new(3.0, 0.0, z + 0.5), rest.quaternion);
        let below = |z: f64| overlap([&core, &plane], [&at(z), &rest]);
        assert!(below(6.9) && below(7f64.next_down()) && !below(7.0) && !below(7.1));
    }
}
