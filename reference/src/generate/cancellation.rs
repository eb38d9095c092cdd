//! Small motion far from the origin: a crane at UTM coordinates.
//!
//! Probes the loss of digits in differences of positions, and thresholds that are meant for metres.
//! Edges of some decimetres move by millimetres, `1e5` to `1e7` m off the origin along each axis.
//! Of 2 queries
//!
//! - in 1 they cross in numbers with all their bits, and the offset rounds them;
//! - in 1 they cross, all coordinates are exact, and so are time and place of contact; of 2 of
//!   these one grazes at an end of an edge.

use nalgebra::Vector3;
use rand::{Rng, RngExt};
use tunnelproof::query::Query;

use super::crossing::{crossing, moving};
use super::meeting::Meeting;
use super::motion::{Motion, in_units, mapped, real_vector};
use super::{Draw, Family, edge_edge};

pub(super) const FAMILY: Family = Family {
    name: "cancellation",
    description: "edges of decimetres moving by millimetres, 1e5 to 1e7 m off the origin",
    draw: Draw::Query(draw),
};

fn draw(rng: &mut dyn Rng) -> Query {
    let motion = if rng.random() {
        exact(rng)
    } else {
        let edges = [(); 2].map(|()| real_vector(rng, 0.5));
        let positions = crossing(rng, edges);
        moving(rng, positions, 4e-3)
    };
    let offset = Vector3::from_fn(|_, _| {
        let distance = f64::from(rng.random_range(100_000..=10_000_000));
        if rng.random() { distance } else { -distance }
    });
    edge_edge(motion.map(|points| points.map(|point| point + offset)))
}

/// Multiples of `2^-26` m, of which an offset leaves every bit: edges of up to a metre or so.
fn exact(rng: &mut dyn Rng) -> Motion<f64> {
    let mut meeting = Meeting::new(rng, 1 << 20, 1 << 10);
    if rng.random() {
        meeting.places[0] = 8 * rng.random_range(0..=1);
    }
    let motion = mapped(rng, meeting.motion());
    in_units(motion, 2f64.powi(-26))
}

#[cfg(test)]
mod tests {
    use rand_chacha::ChaCha8Rng;
    use rand_chacha::rand_core::SeedableRng;

    use super::*;

    #[test]
    fn cancellation_offset_leaves_every_bit_of_an_exact_motion() {
        let mut rng = ChaCha8Rng::seed_from_u64(1);
        for _ in 0..2000 {
            let [start, end] = exact(&mut rng);
            for (start, end) in start.iter().zip(&end) {
                for (x, y) in start.iter().zip(end) {
                    assert_eq!([x + 1e7 - 1e7, y - 1e7 + 1e7], [*x, *y]);
                    assert!(x.abs() < 16.0 && (x - y).abs() < 0.1, "{x} to {y}");
                }
            }
        }
    }
}
