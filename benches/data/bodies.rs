//! Pairs of a scene of wires and bodies that turn: segments of wires and edges of boxes whose swept
//! boxes overlap.

use rand::{Rng, RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use tunnelproof::Point;
use tunnelproof::nalgebra::{Quaternion, Unit, UnitQuaternion, Vector3};
use tunnelproof::rigid::{EdgeTurningEdge, Pose, RigidMotion};

use super::boxes::{bounds, overlap};

/// How many bodies there are in a room of 1 m, and how many wires of 64 segments of 1 cm.
const BODIES: usize = 40;
const WIRES: usize = 60;

/// Candidate pairs in which the bodies, of 2 to 20 cm, turn by up to so many degrees in a step.
pub(crate) fn pairs(degrees: f64) -> Vec<EdgeTurningEdge> {
    let mut rng = ChaCha8Rng::seed_from_u64(2033);
    let segments: Vec<_> = (0..WIRES).flat_map(|_| wire(&mut rng)).collect();
    let mut pairs = Vec::new();
    for _ in 0..BODIES {
        let motion = motion(&mut rng, degrees);
        for local in edges(&mut rng) {
            // The places at nine times, and what an arc between two of them may be beside these.
            let times = (0..=8).map(|i| f64::from(i) / 8.0);
            let places = times.flat_map(|t| local.map(|p| (p, t)));
            let swept = bounds(places.map(|(p, t)| motion.position(&p, t)), 1e-3);
            for [start, end] in &segments {
                if overlap(&swept, &bounds(start.iter().chain(end).copied(), 0.0)) {
                    let query = EdgeTurningEdge::new(*start, *end, local, motion);
                    pairs.push(query.expect("finite"));
                }
            }
        }
    }
    pairs
}

fn vector(rng: &mut impl Rng, reach: f64) -> Vector3<f64> {
    Vector3::from_fn(|_, _| rng.random_range(-reach..=reach))
}

/// The segments of a wire that moves by up to 1 cm, at both ends of the step.
fn wire(rng: &mut impl Rng) -> Vec<[[Point; 2]; 2]> {
    let mut points = vec![Point::origin() + vector(rng, 0.5)];
    let mut way = vector(rng, 1.0).normalize();
    for _ in 0..64 {
        way = (way + vector(rng, 0.2)).normalize();
        points.push(points[points.len() - 1] + way * 0.01);
    }
    let speed = vector(rng, 0.01);
    let moved: Vec<_> = points
        .iter()
        .map(|p| p + speed + vector(rng, 1e-3))
        .collect();
    let ends = points.windows(2).zip(moved.windows(2));
    ends.map(|(a, b)| [[a[0], a[1]], [b[0], b[1]]]).collect()
}

fn motion(rng: &mut impl Rng, degrees: f64) -> RigidMotion {
    let centre = Point::origin() + vector(rng, 0.5);
    let first = UnitQuaternion::from_scaled_axis(vector(rng, 3.0));
    let axis = Unit::new_normalize(vector(rng, 1.0));
    let angle = rng.random_range(0.0..degrees).to_radians();
    let second = UnitQuaternion::from_axis_angle(&axis, angle) * first;
    let pose =
        |centre, q: UnitQuaternion<f64>| Pose::new(centre, Quaternion::new(q.w, q.i, q.j, q.k));
    let end = centre + vector(rng, 0.02);
    RigidMotion::new(pose(centre, first), pose(end, second)).expect("a small turn")
}

/// The edges of a box about its centre.
fn edges(rng: &mut impl Rng) -> Vec<[Point; 2]> {
    let half = Vector3::from_fn(|_, _| rng.random_range(0.01..0.1));
    let corner = |i: usize| {
        let sign = |axis: usize| if i >> axis & 1 == 0 { -1.0 } else { 1.0 };
        Point::from(Vector3::from_fn(|axis, _| sign(axis) * half[axis]))
    };
    let from = (0..8).flat_map(|i| (0..3).map(move |axis| (i, i | 1 << axis)));
    let edges = from.filter(|(i, j)| i != j);
    edges.map(|(i, j)| [corner(i), corner(j)]).collect()
}
