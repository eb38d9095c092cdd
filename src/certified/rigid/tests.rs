use nalgebra::Quaternion;

use super::*;
use crate::rigid::Pose;

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
                    assert!(is_miss || !query.is_apart(), "{query:?}");
                    misses += usize::from(is_miss);
                    proved += usize::from(query.is_apart());
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
            let (start, end) = (query.start(), query.end());
            let moving =
                Moving::new(start, end, query.local(), query.motion(), Radius::ZERO).unwrap();
            for (from, to) in [(0.0, 1.0), (0.0, 0.25), (0.75, 1.0), (0.5, 0.625)] {
                let bound = moving.bend * (to - from) * (to - from) + moving.rest;
                let [start, end] = [from, to].map(|t| moving.places(t)[3]);
                for i in 0..=16 {
                    let share = f64::from(i) / 16.0;
                    let point = query
                        .motion()
                        .position(&query.local()[1], from + share * (to - from));
                    let chord = [0, 1, 2].map(|axis| between(start[axis], end[axis], share));
                    let stray = (point.coords - nalgebra::Vector3::from(chord)).norm();
                    assert!(stray <= bound, "{stray} {bound}");
                    largest = f64::max(largest, stray / bound);
                }
            }
        }
    }
    assert!(largest > 0.6, "{largest}");
}
