#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use nalgebra::UnitQuaternion;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::*;
use crate::wire::Shape;

/// Places are multiples of this, so that they are representable 2^40 m from the origin, too.
const GRID: f64 = 1.0 / 4096.0;

/// Two bodies that nearly touch where the step starts, moved by what rounds no place.
#[test]
fn bodies_overlap_wherever_they_are_if_they_do_anywhere() {
    let rng = &mut ChaCha8Rng::seed_from_u64(43);
    let core = Core::of(&Shape::Box {
        half: Vector::new(0.01, 0.004, 0.002),
    });
    let mut overlapping = 0;
    for _ in 0..3000 {
        let mut on_grid = |size: f64| {
            Vector::from_fn(|_, _| (rng.random_range(-size..=size) / GRID).round() * GRID)
        };
        let (centre, apart) = (on_grid(1.0), on_grid(0.01));
        let turns = [0; 2].map(|_| *UnitQuaternion::from_scaled_axis(on_grid(2.0)).quaternion());
        let is_at = |offset: Vector| {
            let at = Pose::new((centre + offset).into(), turns[0]);
            let other = Pose::new((centre + apart + offset).into(), turns[1]);
            is_certain([&core, &core], [&at, &other]).unwrap()
        };
        let near = is_at(Vector::zeros());
        overlapping += u32::from(near);
        for axis in 0..3 {
            let far = Vector::ith(axis, (1u64 << 40) as f64);
            assert_eq!(is_at(far), near, "{apart:?} {turns:?}");
        }
    }
    assert!((300..2700).contains(&overlapping), "{overlapping}");
}
