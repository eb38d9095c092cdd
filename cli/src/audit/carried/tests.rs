#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use nalgebra::{Quaternion, UnitQuaternion};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use tunnelproof::wire::Vector;

use super::*;

/// Bodies near and far from the origin, places near and far from their centres, and orientations whose
/// lengths are 1 as they come or as sloppy as the stepper takes them.
fn cases(count: usize) -> Vec<(Pose, Vector)> {
    let mut rng = ChaCha8Rng::seed_from_u64(31);
    let mut vector = |sizes: std::ops::Range<f64>| {
        let size = 10f64.powf(rng.random_range(sizes));
        Vector::from_fn(|_, _| rng.random_range(-size..=size))
    };
    let mut all = Vec::new();
    for k in 0..count {
        let turn = UnitQuaternion::from_scaled_axis(vector(-3.0..0.6));
        let length = 1.0 + [0.0, 1e-9, -1e-9][k % 3];
        let pose = Pose {
            position: Point::from(vector(-6.0..9.0)),
            orientation: UnitQuaternion::new_unchecked(turn.into_inner() * length),
        };
        all.push((pose, vector(-6.0..6.0)));
    }
    all
}

#[test]
fn places_as_the_stepper_rounds_them_are_there() {
    for (pose, local) in cases(30_000) {
        let eye = pose.position + pose.orientation * local;
        assert!(
            is_unit(&pose) && is_there(&eye, &local, &pose),
            "{pose:?} {local}"
        );
        let node = pose.position + local;
        let put_on = pose
            .orientation
            .inverse_transform_vector(&(node - pose.position));
        assert!(is_there(&node, &put_on, &pose), "{pose:?} {put_on}");
    }
}

#[test]
fn places_off_by_little_more_are_not_there() {
    for (pose, local) in cases(3000).into_iter().step_by(3) {
        let eye = pose.position + pose.orientation * local;
        let size = local.amax() + pose.position.coords.amax();
        for axis in 0..3 {
            let mut off = eye;
            off[axis] += 1e-13 * size;
            assert!(!is_there(&off, &local, &pose), "{pose:?} {local}");
        }
    }
}

#[test]
fn no_number_is_anywhere() {
    let pose = Pose {
        position: Point::origin(),
        orientation: UnitQuaternion::identity(),
    };
    for wrong in [f64::NAN, f64::INFINITY, 1.7e308] {
        let far = Vector::new(wrong, 0.0, 0.0);
        assert!(!is_there(&Point::origin(), &far, &pose));
        assert!(!is_there(&Point::from(far), &Vector::zeros(), &pose));
        let mut beyond = pose;
        beyond.position.x = wrong;
        assert!(!is_there(&Point::origin(), &Vector::zeros(), &beyond));
        let quaternion = Quaternion::new(wrong, 0.0, 0.0, 0.0);
        beyond.orientation = UnitQuaternion::new_unchecked(quaternion);
        assert!(!is_unit(&beyond));
    }
}
