//! Coordinates from 5e-324 to 1e300, of one magnitude or of many.
//!
//! Probes overflow, underflow, subnormal numbers and thresholds with a unit. Of 8 queries
//!
//! - 2 are edges that cross, all coordinates times one power of two, `2^-996` to `2^996`;
//! - 2 are the same with a power of two for each axis, which changes neither time nor place of
//!   contact;
//! - 1 is a crossing in integers times 5e-324, so that every coordinate is subnormal;
//! - 1 has one coordinate as large as `2^996` times the others;
//! - 2 have an exponent of their own for each coordinate, from a band of 8 to 1992.

use nalgebra::Vector3;
use rand::{Rng, RngExt};
use tunnelproof::query::Query;

use super::crossing::{crossing, moving};
use super::meeting::Meeting;
use super::motion::{Motion, in_units, placed, real_vector};
use super::{Draw, Family, edge_edge};

pub(super) const FAMILY: Family = Family {
    name: "scales",
    description: "coordinates from 5e-324 to 1e300, of one magnitude or of many",
    draw: Draw::Query(draw),
};

/// The largest exponent of a factor; `2^996` is 6.7e299.
const EXPONENT: i32 = 996;

fn draw(rng: &mut dyn Rng) -> Query {
    let kind = rng.random_range(0..8);
    if kind == 0 {
        let motion = Meeting::steady(rng).motion();
        let motion = placed(rng, motion);
        return edge_edge(in_units(motion, f64::from_bits(1)));
    }
    let edges = [(); 2].map(|()| real_vector(rng, 1.0));
    let positions = crossing(rng, edges);
    let mut motion = moving(rng, positions, 1.0);
    match kind {
        1..3 => {
            let factor = factor(rng, -EXPONENT, EXPONENT);
            scale(&mut motion, || Vector3::repeat(factor));
        }
        3..5 => {
            let factors = Vector3::from_fn(|_, _| factor(rng, -EXPONENT, EXPONENT));
            scale(&mut motion, || factors);
        }
        5 => {
            let [end, point, axis] = [2, 4, 3].map(|count| rng.random_range(0..count));
            motion[end][point][axis] *= factor(rng, 0, EXPONENT);
        }
        _ => {
            let half = 1 << rng.random_range(2..=9);
            let middle = rng.random_range(half - EXPONENT..=EXPONENT - half);
            scale(&mut motion, || {
                Vector3::from_fn(|_, _| factor(rng, middle - half, middle + half))
            });
        }
    }
    edge_edge(motion)
}

fn factor(rng: &mut dyn Rng, lowest: i32, highest: i32) -> f64 {
    2f64.powi(rng.random_range(lowest..=highest))
}

/// Multiplies each point by factors for its coordinates.
fn scale(motion: &mut Motion<f64>, mut factors: impl FnMut() -> Vector3<f64>) {
    for point in motion.as_flattened_mut() {
        point.component_mul_assign(&factors());
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scales_reach_from_the_smallest_numbers_to_1e300() {
        let mut magnitudes = Vec::new();
        let mut most = 0.0f64;
        for index in 0..2000 {
            let query = FAMILY.query(1, index);
            let points = query.start().iter().chain(query.end());
            let numbers: Vec<_> = points.flat_map(|p| p.iter()).map(|x| x.abs()).collect();
            let largest = numbers.iter().copied().fold(0.0, f64::max);
            let smallest = numbers
                .iter()
                .filter(|x| **x > 0.0)
                .copied()
                .fold(f64::MAX, f64::min);
            most = most.max(largest.log10() - smallest.log10());
            magnitudes.push(largest);
        }
        magnitudes.sort_by(f64::total_cmp);
        let (first, last) = (magnitudes[0], magnitudes[magnitudes.len() - 1]);
        assert!(
            first < 1e-310 && last > 1e298 && last < 1e301,
            "{first} to {last}"
        );
        assert!(most > 580.0, "10^{most} within one query");
    }
}
