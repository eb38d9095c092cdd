//! A triple root of the cubic inside the step, and no other.
//!
//! Probes the solver: near its root the cubic is as flat as one can be, and a rounding of its
//! coefficients moves the root by the cube root of that. With `p`, `q`, `a`, `b` and `w` of
//! [`Meeting`], `det(p + s a, q + s b, w)` has to be `s^2` times a constant. Of 4 queries
//!
//! - in 1 the edges cross, at an angle: `w = x p + y q` and `det(p, x a + y b, q) = 0`;
//! - in 1 they are parallel at that time: `p = g d`, `q = h d` and `w = x d + y (g b - h a)`;
//! - in 1 AB is a point: `p = 0` and `w = x a + y q`;
//! - in 1 both are points: `p = q = 0`.
//!
//! Half of the queries are exact, half nudged by 0 to `2^20` ulp.

use nalgebra::Vector3;
use rand::{Rng, RngExt};
use tunnelproof::query::Query;

use super::meeting::Meeting;
use super::motion::{not_zero, power_of_two};
use super::nudge::nudged_if;
use super::{Draw, Family, edge_edge};

pub(super) const FAMILY: Family = Family {
    name: "triple_root",
    description: "a triple root of the cubic inside the step, exactly or nearly",
    draw: Draw::Query(draw),
};

fn draw(rng: &mut dyn Rng) -> Query {
    let motion = exact(rng).anywhere(rng);
    let is_exact: bool = rng.random();
    edge_edge(nudged_if(!is_exact, rng, motion))
}

/// Edges with a cubic that has a triple root at the time of the meeting.
pub(super) fn exact(rng: &mut dyn Rng) -> Meeting {
    let reach = power_of_two(rng, 1..=4);
    let mut meeting = Meeting::new(rng, reach, reach);
    let independent = independent(rng, reach);
    let [x, y] = [(); 2].map(|()| not_zero(rng, 2));
    match rng.random_range(0..4) {
        0 => return crossing(rng, meeting, reach),
        1 => {
            let [direction, a, b] = independent;
            let [g, h] = [(); 2].map(|()| not_zero(rng, 4));
            meeting.edges = [direction * g, direction * h];
            meeting.turns = [a, b];
            meeting.passing = direction * x + (b * g - a * h) * y;
        }
        2 => {
            let [a, b, q] = independent;
            meeting.edges = [Vector3::zeros(), q];
            meeting.turns = [a, b];
            meeting.passing = a * x + q * y;
        }
        _ => {
            let [a, b, w] = independent;
            meeting.edges = [Vector3::zeros(); 2];
            meeting.turns = [a, b];
            meeting.passing = w;
        }
    }
    meeting
}

/// Three vectors with a determinant that is not 0.
fn independent(rng: &mut dyn Rng, reach: i32) -> [Vector3<i32>; 3] {
    let mut free = || rng.random_range(-reach..=reach);
    let (y, z, zz) = (free(), free(), free());
    let [xx, yy, last] = [(); 3].map(|()| not_zero(rng, reach));
    [
        Vector3::new(xx, y, z),
        Vector3::new(0, yy, zz),
        Vector3::new(0, 0, last),
    ]
}

/// With `p` and `q` in the plane `z = 0` and `w = x p + y q`, the determinant is `s^2 det(a, b, w)`
/// if `x a + y b` is in the plane too; it is not 0 if that is not along `w`.
fn crossing(rng: &mut dyn Rng, mut meeting: Meeting, reach: i32) -> Meeting {
    let [p, q] = &mut meeting.edges;
    *p = Vector3::new(not_zero(rng, reach), p.y, 0);
    *q = Vector3::new(0, not_zero(rng, reach), 0);
    let x = if rng.random() { 1 } else { -1 };
    let y = rng.random_range(-2..=2);
    let w = *p * x + *q * y;
    let across = Vector3::new(-w.y, w.x, 0) + w * rng.random_range(-1..=1);
    let slope = not_zero(rng, reach);
    let [a, b] = &mut meeting.turns;
    b.z = -slope * x;
    *a = (across - *b * y) * x;
    a.z = slope * y;
    meeting.passing = w;
    meeting
}
