use super::*;
use crate::certified::testing::Random;

fn of_edges(points: [[Vector; 4]; 2], radius: f64, at: &At, place: [f64; 2]) -> Normal {
    normal_of_edges(&points[0], &points[1], radius.into(), at, place, None).unwrap()
}

fn at(toi: f64, side: i8, error: f64) -> At {
    At {
        toi,
        toi_above: toi,
        side,
        error,
    }
}

/// AB along x from -1 to 1, and CD through (s, y, z) with the direction (0, 1, 0), both 2 long; CD moves down from z.
fn falling(s: f64, y: f64, z: [f64; 2]) -> [[Vector; 4]; 2] {
    z.map(|z| {
        [
            [-1.0, 0.0, 0.0],
            [1.0, 0.0, 0.0],
            [s, y - 1.0, z],
            [s, y + 1.0, z],
        ]
    })
}

#[test]
fn normal_inside_both_edges_is_their_perpendicular_from_the_side_before() {
    // K x L = (0, 0, 4), M . (K x L) > 0 before
    let normal = of_edges(
        falling(0.0, 0.0, [1.0, -1.0]),
        0.0,
        &at(0.5, 1, 1e-15),
        [0.5; 2],
    );
    assert_eq!(normal.direction, Vector3::z());
    assert!(normal.error < 1e-14, "{normal:?}");
    let normal = of_edges(
        falling(0.0, 0.0, [-1.0, 1.0]),
        0.0,
        &at(0.5, -1, 1e-15),
        [0.5; 2],
    );
    assert_eq!(normal.direction, -Vector3::z());
}

#[test]
fn normal_at_an_end_follows_from_the_motion_before() {
    // D comes down onto the middle of AB, and sideways from beyond it or from within: only from beyond
    // it is nearest.
    for (sideways, expected) in [(1.0, [0.0, -1.0, 1.0]), (-1.0, [0.0, 0.0, 1.0])] {
        let [mut start, mut end] = falling(0.0, -1.0, [1.0, -1.0]);
        for i in [2, 3] {
            start[i][1] -= sideways;
            end[i][1] += sideways;
        }
        let normal = of_edges([start, end], 0.0, &at(0.5, 1, 1e-15), [0.5, 1.0]);
        let expected = Vector3::from(expected).normalize();
        assert!(
            (normal.direction - expected).norm() <= normal.error,
            "{normal:?}"
        );
    }
}

/// A and B are at the origin, where the middle of CD is at t = 1/2, along x.
#[test]
fn normal_where_the_velocity_vanishes_is_of_the_second_order() {
    // The middle moves by (2, 0, 3): the part across the edge counts.
    let start = [[0.0; 3], [0.0; 3], [-2.0, 0.0, -1.0], [0.0, 0.0, -2.0]];
    let end = [[0.0; 3], [0.0; 3], [0.0, 0.0, 1.0], [2.0, 0.0, 2.0]];
    let points = [start, end];
    let normal = of_edges(points, 0.0, &at(0.5, 0, 1e-15), [0.0, 0.5]);
    assert!(
        (normal.direction + Vector3::z()).norm() <= normal.error,
        "{normal:?}"
    );
    // The middle moves along the edge, which turns.
    let start = [[0.0; 3], [0.0; 3], [-2.0, 0.0, 1.0], [0.0, 0.0, -1.0]];
    let end = [[0.0; 3], [0.0; 3], [0.0, 0.0, -1.0], [2.0, 0.0, 1.0]];
    let normal = of_edges([start, end], 0.0, &at(0.5, 0, 1e-15), [0.0, 0.5]);
    // At t = 1/2 - h: C = (-1 - 2h, 0, 2h), D = (1 - 2h, 0, -2h); at x = 0 it has z = -4 h^2.
    assert!(
        (normal.direction + Vector3::z()).norm() <= normal.error,
        "{normal:?}"
    );
}

#[test]
fn normal_does_not_overflow_or_underflow() {
    for factor in [1e308, 1e-308, 5e-324] {
        let points = falling(0.0, 0.0, [1.0, -1.0]).map(|p| p.map(|p| p.map(|x| factor * x)));
        for radius in [0.0, 0.25 * factor] {
            let toi = 0.5 * (1.0 - radius / factor);
            let normal = of_edges(points, radius, &at(toi, 1, 1e-15), [0.5; 2]);
            assert!(
                (normal.direction - Vector3::z()).norm() <= normal.error,
                "{normal:?}"
            );
        }
    }
}

/// Bit for bit, where `f64` decides.
#[test]
fn normal_is_reversed_bit_for_bit_when_the_edges_are_swapped() {
    let mut random = Random::new(1);
    for _ in 0..2000 {
        let mut point = || [0, 1, 2].map(|_| 2.0 * random.unit() - 1.0);
        let points = [(); 2].map(|()| [point(), point(), point(), point()]);
        let place = [0.1 + 0.8 * random.unit(), 0.1 + 0.8 * random.unit()];
        let swapped = points.map(|[a, b, c, d]| [c, d, a, b]);
        for radius in [0.0, 0.5] {
            let known = at(random.unit(), 1, 1e-14);
            let normal = of_edges(points, radius, &known, place);
            let other = of_edges(swapped, radius, &known, [place[1], place[0]]);
            assert_eq!(normal.direction, -other.direction);
            assert_eq!(normal.error, other.error);
        }
    }
}
