//! Contact points of the certified path against the exact places, and faults that are seen.

use nalgebra::Vector3;
use tunnelproof::certified::decide;
use tunnelproof::contact::{Contact, Place};
use tunnelproof::query::{EdgeEdge, VertexFace};

use super::*;
use crate::generate;
use crate::oracle;

/// The contact that the certified path says, and the bound on a coordinate that it states.
fn contact(query: &Query) -> Option<(Contact, f64)> {
    let (contact, error, toi) = match query {
        Query::EdgeEdge(query) => {
            let hit = decide(query)?;
            let toi = [hit.toi, hit.toi_above];
            (hit.contact(query), Place::from(hit.place).error(), toi)
        }
        Query::VertexFace(query) => {
            let hit = decide(query)?;
            let toi = [hit.toi, hit.toi_above];
            (hit.contact(query), Place::from(hit.place).error(), toi)
        }
    };
    let on_first = match query {
        Query::EdgeEdge(_) => 2,
        Query::VertexFace(_) => 1,
    };
    let points = query.start()[..on_first]
        .iter()
        .chain(&query.end()[..on_first]);
    let size = points.fold(0.0f64, |size, point| size.max(point.coords.amax()));
    let share = 4.0 * f64::EPSILON + 2.0 * error + 2.0 * (toi[1] - toi[0]);
    Some((contact, share * size + f64::from_bits(4)))
}

#[test]
fn places_of_every_family_are_where_the_certified_path_has_them() {
    let mut stretches = 0;
    for family in generate::all() {
        for index in 0..60 {
            let query = family.query(11, index);
            let truth = oracle::decide_query(&query);
            let (Some(hit), Some((contact, bound))) = (truth.hit, contact(&query)) else {
                continue;
            };
            let places = Places::new(&query, &hit);
            let points = [Some(contact.first), contact.second];
            let points: Vec<_> = points.iter().flatten().map(|at| at.point).collect();
            // Of three axes, and what the last step of this sum rounds.
            let bound = 1.75 * bound;
            for point in &points {
                let name = family.name();
                assert!(places.may_be_within(point, bound), "{name} {index} {point}");
                // A point that is off by more, in any direction of which one leads away from it.
                let width = places.width.to_f64().unwrap();
                let off = 4.0 * (bound + width);
                let away =
                    [-1.0, 1.0].map(|sign| point + Vector3::new(1.0, -1.0, 2.0) * sign * off);
                let is_seen = away.iter().any(|point| !places.may_be_within(point, bound));
                let is_stretch = hit.second.is_some();
                assert!(is_seen || is_stretch, "{name} {index} {point}");
            }
            if let [first, second] = points[..] {
                stretches += 1;
                let middle = nalgebra::center(&first, &second);
                assert!(places.may_be_within(&middle, 2.0 * bound), "{index}");
            }
        }
    }
    assert!(stretches > 20, "{stretches}");
}

/// AB from 0 to 4 on the x axis, and CD from 1 to 9 beside it, which comes down.
fn parallel() -> Query {
    let at = |y: f64| [[0., 0., 0.], [4., 0., 0.], [1., y, 0.], [9., y, 0.]].map(Point::from);
    Query::EdgeEdge(EdgeEdge::new(at(1.0), at(-1.0), 0.0).unwrap())
}

#[test]
fn places_of_parallel_edges_are_all_that_they_share_and_no_more() {
    let query = parallel();
    let hit = oracle::decide_query(&query).hit.unwrap();
    let places = Places::new(&query, &hit);
    for (x, y, off) in [
        (1.0, 0.0, 0.0),
        (2.3, 0.0, 0.0),
        (4.0, 0.0, 0.0),
        (0.5, 0.0, 0.5),
        (5.0, 0.0, 1.0),
        (2.0, 0.25, 0.25),
    ] {
        let point = Point::new(x, y, 0.0);
        assert_eq!(places.distance(&point), off, "{x} {y}");
        assert!(places.may_be_within(&point, off));
        assert!(off == 0.0 || !places.may_be_within(&point, off * 0.999));
    }
    let nowhere = Point::new(f64::NAN, 0.0, 0.0);
    assert!(!places.may_be_within(&nowhere, f64::MAX));
    assert_eq!(places.distance(&nowhere), f64::INFINITY);
}

#[test]
fn place_of_a_vertex_is_the_vertex() {
    let face = [[0., 0., 0.], [4., 0., 0.], [0., 4., 0.]].map(Point::from);
    let at = |z: f64| [Point::new(1.0, 1.0, z), face[0], face[1], face[2]];
    let query = Query::VertexFace(VertexFace::new(at(1.0), at(-1.0), 0.0).unwrap());
    let hit = oracle::decide_query(&query).hit.unwrap();
    let places = Places::new(&query, &hit);
    assert_eq!(places.distance(&Point::new(1.0, 1.0, 0.0)), 0.0);
    assert!(!places.may_be_within(&Point::new(1.0, 1.0, 1e-9), 0.9e-9));
    assert!(places.may_be_within(&Point::new(1.0, 1.0, 1e-9), 1.1e-9));
}
