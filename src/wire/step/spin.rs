//! Turning of rigid bodies: without torque, and over a step.

use nalgebra::{Matrix3, Quaternion, UnitQuaternion};

use crate::wire::Vector;

/// The angular velocity after a step without torque, in the body's frame, in rad/s.
///
/// Euler's equations `I w' = -w x I w` by the implicit midpoint rule, which keeps the energy `w . I
/// w` and the magnitude of the angular momentum `I w` (both are quadratic) whatever the step is.
/// Newton's method solves it; the step is divided so that the body turns at most 1/2 rad in a part,
/// where it converges.
pub(super) fn spin_freely(inertia: &Matrix3<f64>, start: &Vector, step: f64) -> Vector {
    const MOST_PARTS: f64 = 1000.0;
    let parts = (2.0 * start.norm() * step).ceil().clamp(1.0, MOST_PARTS);
    let mut spin = *start;
    for _ in 0..parts as usize {
        spin = midpoint(inertia, &spin, step / parts);
    }
    spin
}

fn midpoint(inertia: &Matrix3<f64>, start: &Vector, step: f64) -> Vector {
    const ITERATIONS: usize = 8;
    let mut end = *start;
    for _ in 0..ITERATIONS {
        let mean = (start + end) / 2.0;
        let momentum = inertia * mean;
        let residual = inertia * (end - start) + mean.cross(&momentum) * step;
        // Derivative of mean x I mean by end: half of [mean]x I - [I mean]x.
        let gyroscopic = mean.cross_matrix() * inertia - momentum.cross_matrix();
        let jacobian = inertia + gyroscopic * (step / 2.0);
        match jacobian.try_inverse() {
            Some(inverse) => end -= inverse * residual,
            None => return end,
        }
    }
    end
}

/// The orientation after turning with an angular velocity in the world's frame for a step: exactly
/// by `|w| h`. Sine and cosine are those of the `libm` crate, so they do not depend on the
/// platform.
pub(super) fn turn(
    orientation: &UnitQuaternion<f64>,
    angular_velocity: &Vector,
    step: f64,
) -> UnitQuaternion<f64> {
    let half = angular_velocity * (step / 2.0);
    let angle = half.norm();
    // sin(a)/a; below 1e-4 the next term of its series is less than half a unit in the last place.
    let over_angle = if angle < 1e-4 {
        1.0 - angle * angle / 6.0
    } else {
        libm::sin(angle) / angle
    };
    let rotation = Quaternion::from_parts(libm::cos(angle), half * over_angle);
    UnitQuaternion::new_normalize(rotation * orientation.quaternion())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn free_spin_keeps_energy_and_momentum_of_a_tumbling_body() {
        let inertia = Matrix3::from_diagonal(&Vector::new(1.0, 2.0, 3.0));
        for speed in [0.1, 10.0, 400.0] {
            // Nearly about the middle axis, where the body tumbles.
            let start = Vector::new(0.01, 1.0, 0.01) * speed;
            let mut spin = start;
            let mut least = spin.y;
            for _ in 0..2000 {
                spin = spin_freely(&inertia, &spin, 1.0 / 60.0);
                least = least.min(spin.y);
            }
            let energy = |w: &Vector| w.dot(&(inertia * w));
            assert!((energy(&spin) / energy(&start) - 1.0).abs() < 1e-11);
            let momentum = |w: &Vector| (inertia * w).norm();
            assert!((momentum(&spin) / momentum(&start) - 1.0).abs() < 1e-11);
            assert!(speed < 1.0 || least < -0.9 * speed, "it never tumbled");
        }
    }

    #[test]
    fn free_spin_of_a_symmetric_body_precesses_as_euler_says() {
        let inertia = Matrix3::from_diagonal(&Vector::new(1.0, 1.0, 3.0));
        let mut spin = Vector::new(0.3, 0.0, 2.0);
        let (step, steps) = (1e-3, 1000);
        for _ in 0..steps {
            spin = spin_freely(&inertia, &spin, step);
        }
        // w_x + i w_y turns at (I3 - I1)/I1 w_z = 4 rad/s.
        let exact = Vector::new(0.3 * libm::cos(4.0), 0.3 * libm::sin(4.0), 2.0);
        // The midpoint rule lags by (w h)^2 / 12 of the angle: 5.3e-6 rad at a radius of 0.3.
        assert!((spin - exact).norm() < 2e-6);
    }

    #[test]
    fn turning_is_by_the_whole_angle_and_continuous_where_the_series_ends() {
        let identity = UnitQuaternion::identity();
        for angle in [1e-9, 1.99e-4, 2.01e-4, 0.2, 3.0] {
            let turned = turn(&identity, &(Vector::z() * angle), 1.0);
            assert!((turned.angle() - angle).abs() <= 4e-16 * angle.max(1.0));
            let image = turned * Vector::x();
            let exact = Vector::new(libm::cos(angle), libm::sin(angle), 0.0);
            assert!((image - exact).norm() < 1e-15);
        }
    }
}
