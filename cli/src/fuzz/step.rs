//! Certified steps against the oracle.

use tunnelproof::certified::{Advance, Clearance, Kind, Precision, advance_in, interpolate_in};
use tunnelproof::mesh::{Feature, Mesh, Pair};
use tunnelproof::query::{Coordinate, EdgeEdge, Point, Query, QueryKind, Radius, VertexFace};
use tunnelproof_reference::oracle::decide_query;
use tunnelproof_reference::shape::Shape;

use super::judges::is_ordinary;

/// What a pair of sides keeps if it advances, with each sort of clearance and stored in `f64` and in
/// `f32`, and what a mesh of the two does.
pub(super) fn check(query: &Query) -> Option<String> {
    // Radii of another size than the coordinates leave long integers alone, which take seconds.
    if !is_ordinary(query) {
        return None;
    }
    let coordinates = query.start().iter().flat_map(|point| point.iter());
    let size = coordinates.fold(0.0, |size: f64, x| size.max(x.abs()));
    let clearances = [
        Clearance::None,
        Clearance::Distance(0.01 * size),
        Clearance::Share(0.1),
    ];
    let doubles = clearances.map(|clearance| (*query, clearance, Precision::F64));
    let singles = clearances.map(|clearance| (in_single(query), clearance, Precision::F32));
    let mut all = doubles.into_iter().chain(singles);
    let wrong = all.find_map(|(query, clearance, precision)| match &query {
        Query::EdgeEdge(pair) => wrong(&query, pair, clearance, precision),
        Query::VertexFace(pair) => wrong(&query, pair, clearance, precision),
    });
    let wrong = wrong.or_else(|| wrong_of_mesh(query, |x| x));
    let single = |x: f64| x.clamp(f32::MIN.into(), f32::MAX.into()) as f32;
    wrong.or_else(|| wrong_of_mesh(query, single))
}

/// The query with the coordinates rounded to `f32` that are not too large.
fn in_single(query: &Query) -> Query {
    let mut shape = Shape::new(query);
    for number in &mut shape.numbers {
        let single = f64::from(*number as f32);
        if single.is_finite() {
            *number = single;
        }
    }
    shape.query().unwrap_or(*query)
}

/// What is wrong with the advance of a pair.
fn wrong<K: Kind>(
    query: &Query,
    pair: &K,
    clearance: Clearance,
    precision: Precision,
) -> Option<String> {
    let moved = match advance_in(pair, clearance, precision) {
        Ok(moved) => moved,
        Err(error) => return Some(error.to_string()),
    };
    let Advance {
        step,
        points,
        kept,
        blocked,
        ..
    } = moved;
    let stored = |i: usize| interpolate_in(&query.start()[i], &query.end()[i], step, precision);
    if !(0.0..=1.0).contains(&step) || points != [0, 1, 2, 3].map(stored) {
        return Some("points are not those of the step".to_owned());
    }
    if blocked.is_none() && step < 1.0 {
        return Some("a part of the step, and nothing that blocks it".to_owned());
    }
    match kept {
        Some(kept) => touches(query.kind(), *query.start(), points, kept)
            .then(|| "stored motion touches".to_owned()),
        None => (step > 0.0).then(|| "a step keeps nothing".to_owned()),
    }
}

/// The same of the two sides as a mesh, of positions that are stored as `stored` says.
fn wrong_of_mesh<C: Coordinate>(query: &Query, stored: impl Fn(f64) -> C) -> Option<String> {
    let (mesh, pair) = match query.kind() {
        QueryKind::EdgeEdge => (
            Mesh::new(4, &[[0, 1], [2, 3]], &[]),
            [Feature::Edge(0), Feature::Edge(1)],
        ),
        QueryKind::VertexFace => (
            Mesh::new(4, &[], &[[1, 2, 3]]),
            [Feature::Vertex(0), Feature::Face(0)],
        ),
    };
    let [first, second] = pair;
    let pair = Pair { first, second };
    let thickness = query.radius().rounded();
    let stored = |point: Point| <[f64; 3]>::from(point).map(&stored);
    let [start, end] = [query.start(), query.end()].map(|points| points.map(stored));
    let step = mesh.and_then(|mesh| mesh.step(&start, &end, thickness));
    let step = match step {
        Ok(step) => step,
        Err(error) => return Some(error.to_string()),
    };
    if step.step == 0.0 {
        return step
            .limits
            .is_empty()
            .then(|| "a mesh stays for no reason".to_owned());
    }
    let near = step.near.iter().find(|(near, _)| *near == pair);
    let kept = near.map_or(thickness.into(), |(_, kept)| *kept);
    let in_f64 = |position: [C; 3]| Point::from(position.map(Into::into));
    let points = <[[C; 3]; 4]>::try_from(step.positions).ok()?.map(in_f64);
    let is_near = touches(query.kind(), start.map(in_f64), points, kept);
    is_near.then(|| "stored motion of a mesh touches".to_owned())
}

/// Whether the oracle finds a contact in the motion from some points to others.
fn touches(kind: QueryKind, start: [Point; 4], points: [Point; 4], radius: Radius) -> bool {
    let motion = match kind {
        QueryKind::EdgeEdge => EdgeEdge::new(start, points, radius).map(Query::EdgeEdge),
        QueryKind::VertexFace => VertexFace::new(start, points, radius).map(Query::VertexFace),
    };
    motion.is_ok_and(|motion| decide_query(&motion).hit.is_some())
}
