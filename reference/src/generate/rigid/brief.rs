//! A contact at a radius that lasts for a tiny part of the step only, and often another one later, of
//! other parts of the two sides, or just no such contact. A search that guesses when they touch steps
//! over the first one.

use nalgebra::Vector3;
use rand::{Rng, RngExt};
use tunnelproof::rigid::RigidQuery;

use super::{RigidFamily, bodies, one};

pub(super) const FAMILY: RigidFamily = RigidFamily {
    name: "turning_thick_brief",
    description: "with a radius: a contact that is over soon, and often another one later",
    draw: brief,
};

const SAMPLES: usize = 192;
/// How often a motion with a second contact is looked for.
const TRIES: usize = 40;
/// The step of the search for the least distance shrinks by a third as often as this.
const THIRDS: usize = 90;

fn brief(rng: &mut dyn Rng) -> RigidQuery {
    let draw = match rng.random() {
        true => one::uniform,
        false => bodies::uniform,
    };
    let mut found = None;
    for _ in 0..TRIES {
        let query = draw(rng);
        let Some(first) = first_minimum(&query) else {
            continue;
        };
        let has_another = first.later < first.distance;
        found = Some((query, first));
        if has_another {
            break;
        }
    }
    let Some((query, first)) = found else {
        return draw(rng);
    };
    let more = 2f64.powi(-rng.random_range(8..=48));
    // One of eight is just too short.
    let factor = match rng.random_range(0..8) {
        0 => 1.0 - more,
        _ => 1.0 + more,
    };
    RigidQuery::new(query.sides(), first.distance * factor).unwrap_or(query)
}

/// The first time at which two sides are as near as never before, and go again.
struct Minimum {
    distance: f64,
    /// The least distance afterwards.
    later: f64,
}

fn first_minimum(query: &RigidQuery) -> Option<Minimum> {
    let time = |i: usize| i as f64 / SAMPLES as f64;
    let distances: Vec<f64> = (0..=SAMPLES).map(|i| distance(query, time(i))).collect();
    let rises = |i: &usize| distances[i + 1] > distances[*i] && distances[*i] < distances[i - 1];
    let first = (1..SAMPLES).find(rises)?;
    let [mut from, mut to] = [time(first - 1), time(first + 1)];
    for _ in 0..THIRDS {
        let third = (to - from) / 3.0;
        match distance(query, from + third) < distance(query, to - third) {
            true => to -= third,
            false => from += third,
        }
    }
    let later = distances[first + 1..].iter().copied();
    let distance = distance(query, from);
    (distance > 1e-3 && distances[0] > distance).then(|| Minimum {
        distance,
        later: later.fold(f64::INFINITY, f64::min),
    })
}

/// How far the two sides are apart at a time, rounded: how far the polygon of the differences of their
/// points is from 0.
fn distance(query: &RigidQuery, t: f64) -> f64 {
    let [a, b, c, d] = query.positions(t).map(|point| point.coords);
    match query.sides()[0].number_of_points() {
        1 => to_polygon(&[b - a, c - a, d - a]),
        _ => to_polygon(&[c - a, d - a, d - b, c - b]),
    }
}

fn to_polygon(corners: &[Vector3<f64>]) -> f64 {
    let normal = (corners[1] - corners[0]).cross(&(corners[2] - corners[0]));
    let next = |i: usize| corners[(i + 1) % corners.len()];
    let sides = corners
        .iter()
        .enumerate()
        .map(|(i, from)| (from, next(i) - from));
    let is_inside =
        |(from, way): (&Vector3<f64>, Vector3<f64>)| way.cross(&-from).dot(&normal) > 0.0;
    if sides.clone().all(is_inside) {
        return (corners[0].dot(&normal) / normal.norm()).abs();
    }
    let to_side = |(from, way): (&Vector3<f64>, Vector3<f64>)| {
        let share = (-from.dot(&way) / way.norm_squared()).clamp(0.0, 1.0);
        (from + way * share).norm()
    };
    sides.map(to_side).fold(f64::INFINITY, f64::min)
}
