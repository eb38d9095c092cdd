//! The shape casts of parry as a program that tunnelproof judges: `cast-shapes` or `nonlinear`.

use parry3d_f64::math::{Pose, Vector};
use parry3d_f64::query::{NonlinearRigidMotion, ShapeCastOptions};
use parry3d_f64::query::{cast_shapes, cast_shapes_nonlinear};
use parry3d_f64::shape::{Ball, Capsule, Segment, Shape, Triangle};

#[path = "../../common/frames.rs"]
mod frames;

use frames::{Asked, Clock, Said, serve, skin};

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

fn place(asked: &Asked) -> Pose {
    match asked.is_face {
        true => Pose::from_translation(vector(asked.points[0])),
        false => Pose::IDENTITY,
    }
}

fn linear(asked: &Asked, clock: &mut Clock) -> Said {
    let [a, b] = bodies(asked);
    let (at, rest) = (place(asked), Pose::IDENTITY);
    let options = ShapeCastOptions {
        max_time_of_impact: 1.0,
        ..ShapeCastOptions::default()
    };
    let hit =
        clock.timed(|| cast_shapes(&at, a.step, &*a.shape, &rest, b.step, &*b.shape, options));
    said(hit.map(|hit| hit.map(|hit| hit.time_of_impact)))
}

fn nonlinear(asked: &Asked, clock: &mut Clock) -> Said {
    let [a, b] = bodies(asked);
    let still = Vector::ZERO;
    let motion = |at, step| NonlinearRigidMotion::new(at, still, step, still);
    let motions = [motion(place(asked), a.step), motion(Pose::IDENTITY, b.step)];
    let [first, second] = &motions;
    let hit =
        clock.timed(|| cast_shapes_nonlinear(first, &*a.shape, second, &*b.shape, 0.0, 1.0, true));
    said(hit.map(|hit| hit.map(|hit| hit.time_of_impact)))
}

fn said<E>(hit: Result<Option<f64>, E>) -> Said {
    match hit {
        Ok(Some(toi)) => Said::Hit(toi),
        Ok(None) => Said::Miss,
        Err(_) => Said::Unsupported,
    }
}

fn main() -> std::io::Result<()> {
    let method = std::env::args().nth(1).unwrap_or_default();
    match method.as_str() {
        "nonlinear" => serve(nonlinear),
        _ => serve(linear),
    }
}
