//! The shape casts of parry as a program that tunnelproof judges: `cast-shapes` or `nonlinear`.

use parry3d_f64::math::{Pose, Rotation, Vector};
use parry3d_f64::query::{NonlinearRigidMotion, ShapeCastOptions};
use parry3d_f64::query::{cast_shapes, cast_shapes_nonlinear};
use parry3d_f64::shape::{Ball, Capsule, ConvexPolyhedron, Cuboid, Segment, Shape, Triangle};

#[path = "../../common/frames.rs"]
mod frames;

use frames::{Asked, Clock, Convex, Engine, Form, Said, Turning, serve, skin};

/// A shape with its points where they are at the start, and its translation.
struct Body {
    shape: Box<dyn Shape>,
    step: Vector,
}

fn vector([x, y, z]: [f64; 3]) -> Vector {
    Vector::new(x, y, z)
}

fn edge(asked: &Asked, first: usize, radius: f64) -> Box<dyn Shape> {
    let [a, b] = [first, first + 1].map(|i| vector(asked.points[i]));
    match radius > 0.0 {
        true => Box::new(Capsule::new(a, b, radius)),
        false => Box::new(Segment::new(a, b)),
    }
}

fn bodies(asked: &Asked) -> [Body; 2] {
    let step = |i: usize| vector(asked.points[i + 4]) - vector(asked.points[i]);
    let [first, second] = asked.radii;
    let body = |shape, point| Body {
        shape,
        step: step(point),
    };
    if !asked.is_face {
        let shapes = [edge(asked, 0, first + skin()), edge(asked, 2, second)];
        let [a, b] = shapes;
        return [body(a, 0), body(b, 2)];
    }
    let [b, c, d] = [1, 2, 3].map(|i| vector(asked.points[i]));
    // A ball has its centre in the origin: its place is that of the vertex.
    let ball = Box::new(Ball::new(first + second + skin()));
    [body(ball, 0), body(Box::new(Triangle::new(b, c, d)), 1)]
}

/// A body of a cast of a box, and its place: a box along the axes is a cuboid, another the hull of its
/// corners. `None` if the engine refuses it.
fn convex(from: &Convex) -> Option<(Body, Pose)> {
    let [a, b, c, _] = from.points.map(vector);
    let (shape, place): (Box<dyn Shape>, Pose) = match (from.form, from.aligned()) {
        (Form::Box, Some([centre, half])) => {
            let place = Pose::from_translation(vector(centre));
            (Box::new(Cuboid::new(vector(half))), place)
        }
        (Form::Box, None) => {
            let corners = from.corners().map(|corner| vector(corner) - a);
            let hull = ConvexPolyhedron::from_convex_mesh(corners.to_vec(), &faces(&corners))?;
            (Box::new(hull), Pose::from_translation(a))
        }
        (Form::Triangle, _) => (Box::new(Triangle::new(a, b, c)), Pose::IDENTITY),
        (Form::Sphere, _) => (Box::new(Ball::new(from.radius)), Pose::from_translation(a)),
        (Form::Edge, _) if from.radius > 0.0 => {
            (Box::new(Capsule::new(a, b, from.radius)), Pose::IDENTITY)
        }
        (Form::Edge, _) => (Box::new(Segment::new(a, b)), Pose::IDENTITY),
    };
    let step = vector(from.step);
    Some((Body { shape, step }, place))
}

/// Two triangles for each face of a box, counterclockwise from outside.
fn faces(corners: &[Vector; 8]) -> Vec<[u32; 3]> {
    let quads = [
        [0, 2, 3, 1],
        [4, 5, 7, 6],
        [0, 1, 5, 4],
        [2, 6, 7, 3],
        [0, 4, 6, 2],
        [1, 3, 7, 5],
    ];
    let [x, y, z] = [1, 2, 4].map(|corner| corners[corner] - corners[0]);
    let is_right = x.cross(y).dot(z) > 0.0;
    let triangles = quads
        .iter()
        .flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]);
    triangles
        .map(|[a, b, c]| if is_right { [a, b, c] } else { [a, c, b] })
        .collect()
}

type Placed = [(Body, Pose); 2];

fn placed(asked: &Asked) -> Placed {
    let place = match asked.is_face {
        true => Pose::from_translation(vector(asked.points[0])),
        false => Pose::IDENTITY,
    };
    let [a, b] = bodies(asked);
    [(a, place), (b, Pose::IDENTITY)]
}

fn linear([(a, at), (b, rest)]: &Placed, clock: &mut Clock) -> Said {
    let options = ShapeCastOptions {
        max_time_of_impact: 1.0,
        ..ShapeCastOptions::default()
    };
    let hit = clock.timed(|| cast_shapes(at, a.step, &*a.shape, rest, b.step, &*b.shape, options));
    said(hit.map(|hit| hit.map(|hit| hit.time_of_impact)))
}

fn nonlinear([(a, at), (b, rest)]: &Placed, clock: &mut Clock) -> Said {
    let still = Vector::ZERO;
    let motion = |at: &Pose, step| NonlinearRigidMotion::new(*at, still, step, still);
    let [first, second] = [motion(at, a.step), motion(rest, b.step)];
    let hit = clock
        .timed(|| cast_shapes_nonlinear(&first, &*a.shape, &second, &*b.shape, 0.0, 1.0, true));
    said(hit.map(|hit| hit.map(|hit| hit.time_of_impact)))
}

fn said<E>(hit: Result<Option<f64>, E>) -> Said {
    match hit {
        Ok(Some(toi)) => Said::Hit(toi),
        Ok(None) => Said::Miss,
        Err(_) => Said::Unsupported,
    }
}

/// A body that turns at a constant rate, by its shape and motion.
fn turning(asked: &Turning) -> [(Box<dyn Shape>, NonlinearRigidMotion); 2] {
    let local = asked.local.map(vector);
    let [first, second] = asked.radii;
    let edge = |a, b, radius| -> Box<dyn Shape> {
        match radius > 0.0 {
            true => Box::new(Capsule::new(a, b, radius)),
            false => Box::new(Segment::new(a, b)),
        }
    };
    let [a, b, c, d] = local;
    let [start, other_start] = asked.poses.map(|[start, _]| pose(start));
    let (shape, other, centre): (Box<dyn Shape>, Box<dyn Shape>, Vector) = match asked.is_face {
        // A ball has its centre in the origin of its frame: the body turns about another point.
        true => (
            Box::new(Ball::new(first + second + skin())),
            Box::new(Triangle::new(b, c, d)),
            -a,
        ),
        false => (edge(a, b, first + skin()), edge(c, d, second), Vector::ZERO),
    };
    let start = Pose::from_parts(start.translation - start.rotation * centre, start.rotation);
    let motion = |start, centre, [from, to]: [[f64; 7]; 2]| {
        let step = pose(to).translation - pose(from).translation;
        NonlinearRigidMotion::new(start, centre, step, rate([from, to]))
    };
    let [poses, other_poses] = asked.poses;
    [
        (shape, motion(start, centre, poses)),
        (other, motion(other_start, Vector::ZERO, other_poses)),
    ]
}

fn pose([x, y, z, w, i, j, k]: [f64; 7]) -> Pose {
    Pose::from_parts(
        Vector::new(x, y, z),
        Rotation::from_xyzw(i, j, k, w).normalize(),
    )
}

/// The turn from one pose to the other by the shorter way, about its axis and as long as its angle.
fn rate([from, to]: [[f64; 7]; 2]) -> Vector {
    let turn = pose(to).rotation * pose(from).rotation.inverse();
    let turn = if turn.w < 0.0 { -turn } else { turn };
    turn.to_scaled_axis()
}

struct Linear;

impl Engine for Linear {
    fn answer(&self, asked: &Asked, clock: &mut Clock) -> Said {
        linear(&placed(asked), clock)
    }

    fn cast(&self, bodies: &[Convex; 2], clock: &mut Clock) -> Said {
        boxes(bodies).map_or(Said::Unsupported, |placed| linear(&placed, clock))
    }
}

struct Nonlinear;

impl Engine for Nonlinear {
    fn answer(&self, asked: &Asked, clock: &mut Clock) -> Said {
        nonlinear(&placed(asked), clock)
    }

    fn cast(&self, bodies: &[Convex; 2], clock: &mut Clock) -> Said {
        boxes(bodies).map_or(Said::Unsupported, |placed| nonlinear(&placed, clock))
    }

    fn turning(&self, asked: &Turning, clock: &mut Clock) -> Said {
        let [(shape, motion), (other, other_motion)] = turning(asked);
        let hit = clock.timed(|| {
            cast_shapes_nonlinear(&motion, &*shape, &other_motion, &*other, 0.0, 1.0, true)
        });
        said(hit.map(|hit| hit.map(|hit| hit.time_of_impact)))
    }
}

fn boxes([first, second]: &[Convex; 2]) -> Option<Placed> {
    Some([convex(first)?, convex(second)?])
}

fn main() -> std::io::Result<()> {
    match std::env::args().nth(1).as_deref() {
        Some("nonlinear") => serve(Nonlinear),
        _ => serve(Linear),
    }
}
