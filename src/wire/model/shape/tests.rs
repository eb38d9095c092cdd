use super::*;
use crate::wire::model::box_mesh;

/// Mass and inertia again: midpoints of small cubes that are inside.
fn by_cubes(inside: impl Fn(&Vector) -> bool, reach: f64, density: f64) -> MassProperties {
    const N: usize = 80;
    let edge = 2.0 * reach / N as f64;
    let at = |i: usize| (i as f64 + 0.5) * edge - reach;
    let mut sum = MassProperties {
        mass: 0.0,
        inertia: Matrix3::zeros(),
    };
    for index in 0..N * N * N {
        let p = Vector::new(at(index / N / N), at(index / N % N), at(index % N));
        if inside(&p) {
            let mass = density * edge * edge * edge;
            sum.mass += mass;
            sum.inertia += (Matrix3::identity() * p.norm_squared() - p * p.transpose()) * mass;
        }
    }
    sum
}

fn assert_close(shape: &Shape, inside: impl Fn(&Vector) -> bool) {
    let (closed, cubes) = (
        shape.mass_properties(7.0).unwrap(),
        by_cubes(inside, 2.0, 7.0),
    );
    assert!(
        (closed.mass / cubes.mass - 1.0).abs() < 0.01,
        "{shape:?} {closed:?} {cubes:?}"
    );
    let difference = (closed.inertia - cubes.inertia).norm() / cubes.inertia.norm();
    assert!(difference < 0.02, "{shape:?} {closed:?} {cubes:?}");
}

#[test]
fn mass_properties_are_those_of_a_sum_of_small_cubes() {
    let half = Vector::new(0.5, 1.0, 1.5);
    assert_close(&Shape::Box { half }, |p| p.abs() <= half);
    let (radius, half_height) = (0.8, 1.1);
    let around = |p: &Vector| p.xy().norm() <= radius;
    let cylinder = Shape::Cylinder {
        radius,
        half_height,
    };
    assert_close(&cylinder, |p| around(p) && p.z.abs() <= half_height);
    let capsule = Shape::Capsule {
        radius,
        half_height,
    };
    assert_close(&capsule, |p| {
        let z = p.z.clamp(-half_height, half_height);
        (p - Vector::new(0.0, 0.0, z)).norm() <= radius
    });
    let sphere = Shape::Sphere { radius: 1.7 };
    assert_close(&sphere, |p| p.norm() <= 1.7);
}

#[test]
fn mass_properties_of_a_mesh_are_those_of_the_box_it_bounds() {
    let half = Vector::new(0.5, 1.0, 1.5);
    let mesh = box_mesh(half, Vector::new(9.0, 8.0, 7.0));
    let of_mesh = Shape::Mesh(mesh).mass_properties(3.0).unwrap();
    let of_box = Shape::Box { half }.mass_properties(3.0).unwrap();
    assert!((of_mesh.mass - of_box.mass).abs() < 1e-12 * of_box.mass);
    assert!((of_mesh.inertia - of_box.inertia).norm() < 1e-11 * of_box.inertia.norm());
}

#[test]
fn mass_properties_are_refused_where_a_dimension_is_not_above_zero() {
    let flat = Shape::Box {
        half: Vector::new(1.0, 0.0, 1.0),
    };
    let text = flat.mass_properties(1.0).unwrap_err().to_string();
    assert_eq!(text, "half edge is 0, it must be finite and above 0");
    let sphere = Shape::Sphere { radius: -2.0 };
    let text = sphere.mass_properties(1.0).unwrap_err().to_string();
    assert_eq!(text, "radius is -2, it must be finite and above 0");
    let long = Shape::Capsule {
        radius: 1.0,
        half_height: f64::INFINITY,
    };
    let text = long.mass_properties(1.0).unwrap_err().to_string();
    assert_eq!(text, "half_height is inf, it must be finite and above 0");
    let text = Shape::Plane.mass_properties(1.0).unwrap_err().to_string();
    assert_eq!(
        text,
        "a plane has no mass, a body of this shape must be static or kinematic"
    );
}
