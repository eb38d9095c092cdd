//! Two edges at one instant against exact rational arithmetic.
//!
//! `TUNNELPROOF_CASES` sets the number of queries of a kind.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use proptest::prelude::*;
use tunnelproof::certified::{Proximity, decide_discrete};
use tunnelproof::query::{EdgeEdge, Point, Radius};
use tunnelproof_reference::instant::{Instant, is_along, wrongs};

use corners::{Corners, all_scales, cases, lattice, nearly_degenerate, ordinary_scales, uniform};

mod corners;

fn decide_at(points: [Point; 4], radius: impl Into<Radius>) -> Result<Proximity, String> {
    let query = EdgeEdge::at_rest(points, radius).map_err(|error| error.to_string())?;
    Ok(decide_discrete(&query))
}

/// What is wrong about the answer for the points at the start, for several radii.
fn check(corners: Corners, radius: f64) -> Result<(), String> {
    let points = [0, 1, 2, 3].map(|i| Point::from(corners[i]));
    let at_radius_0 = decide_at(points, 0.0)?;
    let (low, high) = (at_radius_0.distance_low, at_radius_0.distance_high);
    let [above, high] = [low.next_up(), high].map(|x| x.min(f64::MAX));
    // At the bounds of the distance and next to them, and as a sum.
    let radii = [
        [0.0, 0.0],
        [radius, 0.0],
        [radius, radius],
        [low, 0.0],
        [above, 0.0],
        [high, 0.0],
        [0.5 * low + 0.5 * high, 0.0],
        [low, f64::from_bits(1)],
        [0.25 * low, 0.75 * low],
    ];
    for radii in radii {
        let query = EdgeEdge::at_rest(points, radii).map_err(|error| error.to_string())?;
        let found = decide_discrete(&query);
        let wrongs = wrongs(&query, &found);
        if !wrongs.is_empty() {
            return Err(format!("{wrongs:?}: {found:?} for {points:?}, {radii:?}"));
        }
    }
    Ok(())
}

/// What is said at a scale of 2^`exponent`, brought back to that of 1, against what is said there.
fn check_scale(corners: Corners, radius: f64, exponent: i32) -> Result<(), String> {
    let points = [0, 1, 2, 3].map(|i| Point::from(corners[i]));
    let scale = 2f64.powi(exponent);
    let own = decide_at(points, radius)?;
    let there = decide_at(points.map(|point| point * scale), radius * scale)?;
    let back = Proximity {
        distance_low: there.distance_low / scale,
        distance_high: there.distance_high / scale,
        points: there.points.map(|point| point / scale),
        depth: there.depth / scale,
        ..there
    };
    match back == own {
        true => Ok(()),
        false => Err(format!("{own:?} and {back:?} for {points:?}, 2^{exponent}")),
    }
}

fn radius() -> impl Strategy<Value = f64> {
    let whole = (0u8..6).prop_map(f64::from);
    prop_oneof![whole, 0.0..1.0f64, Just(f64::MAX), Just(f64::from_bits(1))]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(cases(500)))]

    #[test]
    fn discrete_is_exact_on_lattice(corners in lattice(), radius in radius()) {
        prop_assert_eq!(check(corners, radius), Ok(()));
    }

    #[test]
    fn discrete_is_exact_on_uniform(corners in uniform(), radius in radius()) {
        prop_assert_eq!(check(corners, radius), Ok(()));
    }

    #[test]
    fn discrete_is_exact_on_nearly_degenerate(corners in nearly_degenerate(), radius in radius()) {
        prop_assert_eq!(check(corners, radius), Ok(()));
    }

    #[test]
    fn discrete_is_exact_on_ordinary_scales(corners in ordinary_scales(), radius in radius()) {
        prop_assert_eq!(check(corners, radius), Ok(()));
    }

    #[test]
    fn discrete_is_exact_on_all_scales(corners in all_scales(), radius in radius()) {
        prop_assert_eq!(check(corners, radius), Ok(()));
    }

    #[test]
    fn discrete_is_the_same_at_every_scale(
        corners in prop_oneof![uniform(), lattice(), nearly_degenerate()],
        radius in 0.0..2.0f64,
        exponent in -900i32..=1000,
    ) {
        prop_assert_eq!(check_scale(corners, radius, exponent), Ok(()));
    }

    #[test]
    fn discrete_bounds_are_near_each_other(corners in uniform()) {
        let points = [0, 1, 2, 3].map(|i| Point::from(corners[i]));
        let found = decide_at(points, 0.0).unwrap();
        prop_assert!(found.distance_high - found.distance_low < 1e-7);
    }
}

#[test]
fn discrete_wires_side_by_side_touch_at_their_radii() {
    let at = |y: f64| [[0., 0., 0.], [4., 0., 0.], [1., y, 0.], [9., y, 0.]].map(Point::from);
    // The sum in f64 is 0.3 and one unit in the last place: above the exact one.
    let rounded = 0.1 + 0.2;
    assert_eq!(rounded, 0.3f64.next_up());
    for (y, touches) in [(0.3, true), (rounded, false)] {
        let found = decide_at(at(y), [0.1, 0.2]).unwrap();
        assert_eq!(found.touches, touches, "{y}");
    }
    let found = decide_at(at(0.5), [0.5, 0.25]).unwrap();
    let error = found.distance_high - found.distance_low;
    assert!(found.touches && (found.depth - 0.25).abs() <= error && error < 1e-13);
    assert_eq!(found.normal.unwrap().as_slice(), [0.0, 1.0, 0.0]);
    assert!(decide_at(at(f64::NAN), 0.0).is_err());
    assert!(decide_at(at(1.0), -1.0).is_err());
}

/// What the answers at a scale are like.
#[derive(Debug, Default)]
struct Figures {
    /// The largest width of the bounds on the distance, of the size of the query.
    width: f64,
    without_normal: u32,
    /// Normals that make no acute angle with the exact shortest vector, where that is not 0.
    opposed: u32,
}

/// Whether the normal and the exact shortest vector make no acute angle, where that is not 0.
fn is_opposed(points: &[Point; 4], found: &Proximity) -> bool {
    let exact = Instant::new(points);
    let is_apart = exact.way.iter().any(|x| *x.numer() != 0.into());
    let is_acute = |normal: [f64; 3]| is_along(&normal, &exact.way, RIGHT_ANGLE);
    let normal = found.normal.map(|normal| normal.into());
    is_apart && normal.is_some_and(|normal| !is_acute(normal))
}

/// The distance of two unit vectors at almost a right angle.
const RIGHT_ANGLE: f64 = 1.414;

fn figures(queries: &[[Point; 4]], exponent: i32) -> Figures {
    let scale = 2f64.powi(exponent);
    let mut figures = Figures::default();
    for points in queries {
        let points = points.map(|point| point * scale);
        let found = decide_at(points, 0.0).unwrap();
        let coordinates = points.iter().flat_map(|point| point.coords.as_slice());
        let size = coordinates.fold(0.0f64, |size, x| size.max(x.abs()));
        let width = (found.distance_high - found.distance_low) / size;
        figures.width = figures.width.max(width);
        figures.without_normal += u32::from(found.normal.is_none());
        figures.opposed += u32::from(is_opposed(&points, &found));
    }
    figures
}

/// Prints the figures at several scales: 2,000 random queries and 2,000 in small integers.
#[test]
#[ignore = "prints figures"]
fn discrete_figures_by_scale() {
    use proptest::strategy::ValueTree;
    use proptest::test_runner::TestRunner;

    fn queries(strategy: impl Strategy<Value = Corners>) -> Vec<[Point; 4]> {
        let mut runner = TestRunner::deterministic();
        let query = |_| strategy.new_tree(&mut runner).unwrap().current();
        let corners = (0..2_000).map(query);
        let points = corners.map(|corners| [0, 1, 2, 3].map(|i| Point::from(corners[i])));
        // All in one point: there is no size.
        points
            .filter(|points| points.iter().any(|point| *point != Point::origin()))
            .collect()
    }
    let (random, lattice) = (queries(uniform()), queries(lattice()));
    for exponent in [0, 300, 600, 1000, -300, -1000] {
        for (name, queries) in [("random", &random), ("lattice", &lattice)] {
            let found = figures(queries, exponent);
            println!("2^{exponent} {name} {}: {found:?}", queries.len());
        }
    }
}
