use nalgebra::Quaternion;

use super::*;
use crate::contact::Place;
use crate::rigid::{EdgeTurningEdge, Pose, RigidMotion, VertexTurningFace};

/// A rod of length 2 about its middle, which turns by so many degrees about z while it moves by
/// `away` along x, and a wire along z at `(x, y)`.
fn rod(degrees: f64, away: f64, x: f64, y: f64) -> EdgeTurningEdge {
    let (sin, cos) = (degrees / 2.0).to_radians().sin_cos();
    let start = Pose::new(Point::origin(), Quaternion::new(1.0, 0.0, 0.0, 0.0));
    let end = Pose::new(
        Point::new(away, 0.0, 0.0),
        Quaternion::new(cos, 0.0, 0.0, sin),
    );
    let wire = [Point::new(x, y, -1.0), Point::new(x, y, 1.0)];
    let rod = [Point::new(-1.0, 0.0, 0.0), Point::new(1.0, 0.0, 0.0)];
    let motion = RigidMotion::new(start, end).unwrap();
    EdgeTurningEdge::new(wire, wire, rod, motion).unwrap()
}

fn is_miss_in_f64(query: &EdgeTurningEdge) -> bool {
    matches!(query.decide_in_f64(), Finding::Miss)
}

#[test]
fn filter_proves_most_misses_and_no_hit() {
    let (mut proved, mut misses) = (0, 0);
    for degrees in [0.0, 1.0, 10.0, 45.0, 90.0] {
        for away in [0.0, 0.125, 1.0] {
            for x in 0..24 {
                for y in 0..24 {
                    let (x, y) = (f64::from(x - 12) / 8.0, f64::from(y - 12) / 8.0);
                    let query = rod(degrees, away, x, y);
                    let is_miss = decide_rigid_exactly(&query).is_none();
                    assert!(is_miss || !is_miss_in_f64(&query), "{query:?}");
                    misses += usize::from(is_miss);
                    proved += usize::from(is_miss_in_f64(&query));
                }
            }
        }
    }
    assert!(100 * proved > 95 * misses, "{proved} of {misses}");
}

/// The stray of points from their chords is below the bound, and not much below it.
#[test]
fn stray_is_bounded() {
    let mut largest = 0.0;
    for degrees in [1.0, 30.0, 90.0] {
        for length in [1.0, 0.3, 5.0] {
            let query = {
                let query = rod(degrees, 0.5, 3.0, 3.0);
                let mut end = *query.motion().end();
                end.quaternion *= length;
                let motion = RigidMotion::new(*query.motion().start(), end).unwrap();
                EdgeTurningEdge::new(*query.start(), *query.end(), *query.local(), motion).unwrap()
            };
            let moving = Moving::new(&query.turning()).unwrap();
            for (from, to) in [(0.0, 1.0), (0.0, 0.25), (0.75, 1.0), (0.5, 0.625)] {
                let bound = moving.stray(to - from) + moving.rest;
                let [start, end] = [from, to].map(|t| moving.places_at(t)[3]);
                for i in 0..=16 {
                    let share = f64::from(i) / 16.0;
                    let point = query
                        .motion()
                        .position(&query.local()[1], from + share * (to - from));
                    let chord =
                        [0, 1, 2].map(|axis| (1.0 - share) * start[axis] + share * end[axis]);
                    let stray = (point.coords - nalgebra::Vector3::from(chord)).norm();
                    assert!(stray <= bound, "{stray} {bound}");
                    largest = f64::max(largest, stray / bound);
                }
            }
        }
    }
    assert!(largest > 0.6, "{largest}");
}

/// Hits in `f64` are those of integers, to the last bit, and few are left to these.
#[test]
fn contacts_are_those_of_integers() {
    let (mut decided, mut hits) = (0, 0);
    for degrees in [3.0, 20.0, 80.0] {
        for (away, radius) in [(0.3, 0.0), (-0.7, 0.0), (0.3, 0.01), (0.1, 0.2)] {
            for x in 0..13 {
                for y in 0..13 {
                    let (x, y) = (f64::from(x) * 0.1671 - 1.0, f64::from(y) * 0.0523 - 0.3);
                    let query = rod(degrees, away, x, y);
                    let (start, end, local) = (*query.start(), *query.end(), *query.local());
                    let motion = *query.motion();
                    let edges = EdgeTurningEdge::with_radius(start, end, local, motion, radius);
                    let face = [local[0], local[1], Point::new(0.3, 0.1, 1.5)];
                    let face =
                        VertexTurningFace::with_radius([start[0]], [end[1]], face, motion, radius);
                    let (edges, face) = (edges.unwrap(), face.unwrap());
                    let counts = [agreement(&edges), agreement(&face)];
                    decided += counts.iter().filter(|(is_decided, _)| *is_decided).count();
                    hits += counts.iter().filter(|(_, is_hit)| *is_hit).count();
                }
            }
        }
    }
    assert!(
        hits > 500 && 20 * decided > 19 * hits,
        "{decided} of {hits}"
    );
}

/// Whether `f64` finds a hit, and whether there is one.
fn agreement<K: RigidKind + std::fmt::Debug>(query: &K) -> (bool, bool)
where
    K::Place: Into<Place>,
{
    let exact = decide_rigid_exactly(query);
    match query.decide_in_f64() {
        Finding::Hit(hit) => {
            let exact = exact.expect("a hit");
            let place = |hit: Hit<K::Place>| -> Place { hit.place.into() };
            let shares = |place: Place| match place {
                Place::Edges(place) => vec![place.first.u, place.first.v],
                Place::Face(place) => place.weights.to_vec(),
            };
            let (ours, other) = (place(hit), place(exact));
            let error = ours.error() + other.error();
            let pairs = shares(ours).into_iter().zip(shares(other));
            assert!(ours.error() <= 2f64.powi(-50));
            for (x, y) in pairs {
                assert!(
                    (x - y).abs() <= error,
                    "{x} {y} {error:e} {query:?} {ours:?} {other:?} {}",
                    hit.toi
                );
            }
            let rest = |hit: Hit<K::Place>| hit.map_place(|_| ());
            assert_eq!(rest(hit), rest(exact));
            (true, true)
        }
        Finding::Miss => {
            assert!(exact.is_none());
            (false, false)
        }
        Finding::Undecided => (false, exact.is_some()),
    }
}
