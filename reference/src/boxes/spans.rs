//! The times at which no plane separates two bodies without radius, in rational numbers.
//!
//! The difference of a box and another convex body has an inside, and each of its faces has for its
//! normal that of a face of either, or the vector product of an edge of each. The bodies share a
//! point where along every such normal their spans do. Each span moves steadily, so that along one
//! normal they share points from one rational time to another; the bodies from the latest of the
//! first to the earliest of the second.

use num_rational::BigRational;
use num_traits::{One, Zero};

use crate::vector::{cross, dot, sub};

use super::body::{Body, BoxCast, Shape, Vector, vector};

/// When the bodies share a point, without their radii.
#[derive(Clone, Debug, PartialEq)]
pub struct Span {
    /// The first time of the step.
    pub from: BigRational,
    /// Whether their insides share one at any time of the step: then they pass into each other.
    pub overlaps: bool,
}

/// When two bodies share a point during the step, without their radii; `None` for never.
pub fn span(cast: &BoxCast) -> Option<Span> {
    let [first, second] = cast.bodies();
    let passing = sub(&vector(&second.step()), &vector(&first.step()));
    let [p, q] = [first, second].map(corners);
    let [mut from, mut to] = [BigRational::zero(), BigRational::one()];
    let mut is_inside = true;
    for normal in normals(first, second) {
        let [low, high] = ends(&p, &normal);
        let [other_low, other_high] = ends(&q, &normal);
        let speed = dot(&passing, &normal);
        // The second body's span, `other + speed t`, reaches the first one's where
        // `speed t >= low - other_high` and `speed t <= high - other_low`.
        let [least, most] = [low - other_high, high - other_low];
        if speed.is_zero() {
            let zero = BigRational::zero();
            if least > zero || most < zero {
                return None;
            }
            is_inside &= least < zero && most > zero;
            continue;
        }
        let mut times = [least / &speed, most / &speed];
        times.sort();
        let [enter, leave] = times;
        from = from.max(enter);
        to = to.min(leave);
    }
    let overlaps = is_inside && from < to;
    (from <= to).then_some(Span { from, overlaps })
}

fn corners(body: &Body) -> Vec<Vector> {
    let corners = body.corners().into_iter();
    corners.map(|corner| vector(&corner.coords)).collect()
}

fn ends(corners: &[Vector], normal: &Vector) -> [BigRational; 2] {
    let along = || corners.iter().map(|corner| dot(corner, normal));
    [along().min(), along().max()].map(Option::unwrap_or_default)
}

/// The directions of the edges of a body, and the normals of its faces.
fn directions(body: &Body) -> [Vec<Vector>; 2] {
    let [a, b, c, d] = body.points().map(|point| vector(&point.coords));
    match body.shape() {
        Shape::Sphere => [Vec::new(), Vec::new()],
        Shape::Edge => [vec![sub(&b, &a)], Vec::new()],
        Shape::Triangle => {
            let edges = [sub(&b, &a), sub(&c, &b), sub(&a, &c)];
            let normal = cross(&edges[0], &edges[1]);
            [edges.to_vec(), vec![normal]]
        }
        Shape::Box => {
            let sides = [sub(&b, &a), sub(&c, &a), sub(&d, &a)];
            [sides.to_vec(), sides.to_vec()]
        }
    }
}

fn normals(first: &Body, second: &Body) -> Vec<Vector> {
    let [edges, mut normals] = directions(first);
    let [others, own] = directions(second);
    normals.extend(own);
    for edge in &edges {
        normals.extend(others.iter().map(|other| cross(edge, other)));
    }
    normals.retain(|normal| !normal.iter().all(Zero::is_zero));
    normals
}
