//! The judge of one instant: what the engine says of every family at every scale keeps its
//! promises, and each broken promise is seen.

use nalgebra::{Rotation3, Vector3};
use tunnelproof::decide_discrete;

use super::*;
use crate::generate::FAMILIES;

/// The points of a query times a power of two.
fn at_scale(points: &[Point; 4], exponent: i32) -> [Point; 4] {
    let (half, rest) = (exponent / 2, exponent - exponent / 2);
    points.map(|point| point * 2f64.powi(half) * 2f64.powi(rest))
}

fn is_finite(points: &[Point; 4]) -> bool {
    points.iter().flat_map(Point::iter).all(|x| x.is_finite())
}

#[test]
fn instant_of_every_family_keeps_its_promises_at_every_scale() {
    for family in FAMILIES {
        let edges = (0..30).filter_map(|index| family.query(5, index).as_edge_edge().copied());
        for (index, query) in edges.enumerate() {
            for exponent in [-1074, -1000, -600, -300, 0, 300, 600, 1000] {
                let points = at_scale(query.start(), exponent);
                if !is_finite(&points) {
                    continue;
                }
                let low = decide_discrete(&EdgeEdge::at_rest(points, 0.0).unwrap()).distance_low;
                for radii in [[0.0, 0.0], [low, low.min(0.5 * f64::MAX)]] {
                    let query = EdgeEdge::at_rest(points, radii).unwrap();
                    let found = decide_discrete(&query);
                    let wrongs = wrongs(&query, &found);
                    let name = family.name();
                    assert_eq!(
                        wrongs,
                        [],
                        "{name} {index} 2^{exponent} {query:?} {found:?}"
                    );
                }
            }
        }
    }
}

/// Two edges a distance of 3 apart, that nothing rounds, with a radius of 4.
fn apart() -> (EdgeEdge, Proximity) {
    let points = [[-1., 0., 0.], [1., 0., 0.], [0., -1., 3.], [0., 1., 3.]].map(Point::from);
    let query = EdgeEdge::at_rest(points, 4.0).unwrap();
    let found = decide_discrete(&query);
    assert_eq!(wrongs(&query, &found), []);
    (query, found)
}

#[test]
fn instant_that_breaks_a_promise_is_seen() {
    let (query, right) = apart();
    type Break = fn(&mut Proximity);
    let breaks: [(Wrong, Break); 9] = [
        (Wrong::Touches, |p| p.touches = false),
        (Wrong::Low, |p| p.distance_low = 3.0f64.next_up()),
        (Wrong::High, |p| p.distance_high = 3.0f64.next_down()),
        (Wrong::Nearest, |p| p.nearest.u += 1e-6),
        (Wrong::Points, |p| p.points[0].x += 1e-14),
        (Wrong::Points, |p| p.points[1].z = 3.0f64.next_up()),
        (Wrong::Normal, |p| p.normal = p.normal.map(|n| -n)),
        (Wrong::Normal, |p| p.normal = None),
        (Wrong::Depth, |p| p.depth = 1.1),
    ];
    for (what, fault) in breaks {
        let mut found = right;
        fault(&mut found);
        let wrongs = wrongs(&query, &found);
        assert!(wrongs.contains(&what), "{what}: {wrongs:?}");
    }
}

#[test]
fn instant_normal_that_is_turned_by_more_than_is_stated_is_seen() {
    let (query, right) = apart();
    for (angle, is_wrong) in [
        (deviation(&right) * 0.9, false),
        (deviation(&right) * 1.1, true),
    ] {
        let turned = Rotation3::from_axis_angle(&Vector3::x_axis(), angle);
        let normal = right.normal.map(|normal| turned * normal);
        let found = Proximity { normal, ..right };
        let expected = if is_wrong { &[Wrong::Normal][..] } else { &[] };
        assert_eq!(wrongs(&query, &found), expected, "{angle:e}");
    }
}

/// What the fault of other scales was: the bounds hold and say nothing, and the normal points
/// anywhere.
#[test]
fn instant_with_a_normal_opposite_to_the_way_is_seen_with_wide_bounds() {
    let (query, right) = apart();
    let found = Proximity {
        distance_low: 0.0,
        normal: right.normal.map(|normal| -normal),
        ..right
    };
    assert_eq!(wrongs(&query, &found), [Wrong::Normal]);
}

#[test]
fn instant_of_crossing_edges_has_the_perpendicular_and_of_parallel_ones_none() {
    let crossing = [[-1., 0., 0.], [1., 0., 0.], [0., -1., 0.], [0., 1., 0.]].map(Point::from);
    let overlapping = [[-1., 0., 0.], [1., 0., 0.], [0., 0., 0.], [5., 0., 0.]].map(Point::from);
    for (points, has_normal) in [(crossing, true), (overlapping, false)] {
        let query = EdgeEdge::at_rest(points, 0.0).unwrap();
        let found = decide_discrete(&query);
        assert_eq!(found.normal.is_some(), has_normal);
        assert_eq!(wrongs(&query, &found), []);
        let normal = if has_normal { None } else { Some(Vector3::z()) };
        let fault = Proximity { normal, ..found };
        assert_eq!(wrongs(&query, &fault), [Wrong::Normal]);
    }
}
