//! cargo run --manifest-path peers/parry/Cargo.toml --example nonlinear_passes_through

use parry3d_f64::math::{Pose, Vector};
use parry3d_f64::query::{NonlinearRigidMotion, ShapeCastOptions};
use parry3d_f64::query::{cast_shapes, cast_shapes_nonlinear};
use parry3d_f64::shape::Segment;

fn main() {
    // Two segments, each carried by one translation. At 4/9 both have the point (2/3, -2/3, -1/9).
    let first = Segment::new(Vector::new(2.0, -1.0, 0.0), Vector::new(2.0, 1.0, 2.0));
    let second = Segment::new(Vector::new(2.0, -2.0, 3.0), Vector::new(-2.0, -2.0, -1.0));
    let steps = [Vector::new(-3.0, -1.0, -2.0), Vector::new(1.0, 3.0, -3.0)];
    let rest = Pose::IDENTITY;
    let options = ShapeCastOptions::with_max_time_of_impact(1.0);
    let linear = cast_shapes(&rest, steps[0], &first, &rest, steps[1], &second, options);
    println!(
        "cast_shapes: {:?}",
        linear.map(|hit| hit.map(|hit| hit.time_of_impact))
    );
    let still = Vector::ZERO;
    let [a, b] = steps.map(|step| NonlinearRigidMotion::new(rest, still, step, still));
    let nonlinear = cast_shapes_nonlinear(&a, &first, &b, &second, 0.0, 1.0, true);
    println!(
        "cast_shapes_nonlinear: {:?}",
        nonlinear.map(|hit| hit.map(|hit| hit.time_of_impact))
    );
}
