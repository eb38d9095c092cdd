//! Two sides that are nearer than the radius at the start, where several of their parts are nearest, or
//! nearly: edges that are parallel but for rounding or a little more, a vertex above the border of a
//! face. Contact is at the start; its place is what is asked.

use nalgebra::Vector3;
use rand::{Rng, RngExt};
use tunnelproof::query::Point;
use tunnelproof::rigid::{RigidQuery, Side};

use super::super::motion::real_vector;
use super::{RigidFamily, one};

pub(super) const FAMILY: RigidFamily = RigidFamily {
    name: "turning_thick_beside",
    description: "with a radius: nearer than it at the start, parallel or above a border, or nearly",
    draw: beside,
};

fn beside(rng: &mut dyn Rng) -> RigidQuery {
    let query = one::uniform(rng);
    let [Side::Straight { start, end }, body] = query.sides() else {
        return query;
    };
    let points = query.positions(0.0).map(|point| point.coords);
    // The edge CD of the body, or the border from B to C of the face.
    let (from, way) = match start.len() {
        2 => (points[2], points[3] - points[2]),
        _ => (points[1], points[2] - points[1]),
    };
    let aside = way.cross(&real_vector(rng, 1.0)) * 0.25;
    let off = 2f64.powi(-rng.random_range(16..=60));
    let mut shares = [-0.5, 1.5].map(|share: f64| share + rng.random_range(-0.5..0.5));
    if start.len() == 1 {
        shares[0] = rng.random_range(0.0..1.0);
    }
    let mut at = |share: f64| from + way * share + aside + real_vector(rng, off);
    let places: Vec<Vector3<f64>> = shares[..start.len()].iter().map(|s| at(*s)).collect();
    let places: Vec<Point> = places.into_iter().map(Point::from).collect();
    let radius = aside.norm() * rng.random_range(1.001..2.0);
    let first = Side::Straight {
        start: &places,
        end,
    };
    RigidQuery::new([first, body], radius).unwrap_or(query)
}
