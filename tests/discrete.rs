//! Two edges at one instant against exact rational arithmetic.
//!
//! `TUNNELPROOF_CASES` sets the number of queries of a kind.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use num_bigint::BigInt;
use num_rational::BigRational;
use proptest::prelude::*;
use tunnelproof::certified::{Proximity, decide_discrete};
use tunnelproof::query::{EdgeEdge, Point, Radius};

use corners::{Corners, all_scales, cases, lattice, nearly_degenerate, ordinary_scales, uniform};

mod corners;

type Vector = [BigRational; 3];

fn exact(x: f64) -> BigRational {
    BigRational::from_float(x).unwrap()
}

fn zero() -> BigRational {
    BigRational::from_integer(BigInt::ZERO)
}

fn one() -> BigRational {
    BigRational::from_integer(BigInt::from(1))
}

fn dot(x: &Vector, y: &Vector) -> BigRational {
    (0..3).map(|i| &x[i] * &y[i]).sum()
}

/// Two edges: `B - A`, `D - C`, `C - A`.
struct Edges([Vector; 3]);

impl Edges {
    fn new(points: &[Point; 4]) -> Self {
        let difference = |to: usize, from: usize| {
            [0, 1, 2].map(|i| exact(points[to][i]) - exact(points[from][i]))
        };
        Edges([difference(1, 0), difference(3, 2), difference(2, 0)])
    }

    /// The squared distance of two points.
    fn squared(&self, u: &BigRational, v: &BigRational) -> BigRational {
        let Edges([k, l, m]) = self;
        let way = [0, 1, 2].map(|i| &m[i] + v * &l[i] - u * &k[i]);
        dot(&way, &way)
    }

    /// The least squared distance: at inner points of both, or at an end and what is nearest to it.
    fn least_squared(&self) -> BigRational {
        let Edges([k, l, m]) = self;
        let (kk, ll, kl) = (dot(k, k), dot(l, l), dot(k, l));
        let (mk, ml) = (dot(m, k), dot(m, l));
        let share = |n: BigRational, d: &BigRational| {
            if *d == zero() {
                zero()
            } else {
                (n / d).clamp(zero(), one())
            }
        };
        let mut places = vec![
            (zero(), share(-&ml, &ll)),
            (one(), share(&kl - &ml, &ll)),
            (share(mk.clone(), &kk), zero()),
            (share(&mk + &kl, &kk), one()),
        ];
        let determinant = &kk * &ll - &kl * &kl;
        if determinant != zero() {
            let u = (&mk * &ll - &ml * &kl) / &determinant;
            let v = (&mk * &kl - &ml * &kk) / &determinant;
            if u >= zero() && u <= one() && v >= zero() && v <= one() {
                places.push((u, v));
            }
        }
        let squares = places.iter().map(|(u, v)| self.squared(u, v));
        squares.min().unwrap()
    }
}

fn decide_at(points: [Point; 4], radius: impl Into<Radius>) -> Result<Proximity, String> {
    let query = EdgeEdge::at_rest(points, radius).map_err(|error| error.to_string())?;
    Ok(decide_discrete(&query))
}

/// What is wrong about the answer for the points at the start, for several radii.
fn check(corners: Corners, radius: f64) -> Result<(), String> {
    let points = [0, 1, 2, 3].map(|i| Point::from(corners[i]));
    let edges = Edges::new(&points);
    let least = edges.least_squared();
    let at_radius_0 = decide_at(points, 0.0)?;
    let (low, high) = (at_radius_0.distance_low, at_radius_0.distance_high);
    // At the bounds of the distance and next to them, and as a sum.
    let radii = [
        [0.0, 0.0],
        [radius, 0.0],
        [radius, radius],
        [low, 0.0],
        [low.next_up(), 0.0],
        [high.min(f64::MAX), 0.0],
        [0.5 * low + 0.5 * high.min(f64::MAX), 0.0],
        [low, f64::from_bits(1)],
        [0.25 * low, 0.75 * low],
    ];
    for radii in radii {
        let found = decide_at(points, radii)?;
        let sum = exact(radii[0]) + exact(radii[1]);
        let touches = least <= &sum * &sum;
        let is_enclosed = exact(found.distance_low).pow(2) <= least
            && (high.is_infinite() || least <= exact(high).pow(2));
        let squared = edges.squared(&exact(found.nearest.u), &exact(found.nearest.v));
        let is_near = high.is_infinite() || squared <= exact(high).pow(2);
        let is_depth = touches || found.depth == 0.0;
        if found.touches != touches || !is_enclosed || !is_near || !is_depth {
            return Err(format!("{found:?} for {points:?}, {radii:?}"));
        }
    }
    Ok(())
}

fn radius() -> impl Strategy<Value = f64> {
    let whole = (0u8..6).prop_map(f64::from);
    prop_oneof![whole, 0.0..1.0f64, Just(f64::MAX), Just(f64::from_bits(1))]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(cases(1_000)))]

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
