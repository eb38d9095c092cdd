//! Where a capsule and a shape touch, against distance functions.

use proptest::prelude::*;

use super::*;
use crate::wire::model::box_mesh;

/// Distance from a point to a shape, below 0 inside of it.
fn distance(shape: &Shape, p: &Vector) -> f64 {
    let outside = |q: Vector| q.sup(&Vector::zeros()).norm() + q.max().min(0.0);
    let radial = libm::hypot(p.x, p.y);
    match shape {
        Shape::Box { half } => outside(p.abs() - half),
        Shape::Cylinder {
            radius,
            half_height,
        } => outside(Vector::new(
            radial - radius,
            p.z.abs() - half_height,
            f64::NEG_INFINITY,
        )),
        Shape::Sphere { radius } => p.norm() - radius,
        Shape::Capsule {
            radius,
            half_height,
        } => libm::hypot(radial, (p.z.abs() - half_height).max(0.0)) - radius,
        Shape::Plane => p.z,
        Shape::Mesh(_) => unreachable!("a mesh is compared with a box"),
    }
}

/// The least value from 0 to 1 of a convex function.
fn minimum(rounds: usize, at: impl Fn(f64) -> f64) -> f64 {
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..rounds {
        let third = (high - low) / 3.0;
        if at(low + third) < at(high - third) {
            high -= third;
        } else {
            low += third;
        }
    }
    at(low)
}

/// The least distance on a segment: it is convex along it.
fn least(shape: &Shape, [a, b]: &[Point; 2]) -> f64 {
    minimum(200, |parameter| {
        distance(shape, &a.coords.lerp(&b.coords, parameter))
    })
}

/// The least distance on a triangle, whose second corner is `b`: of pieces between its sides from
/// there.
fn least_on_triangle(shape: &Shape, [a, b, c]: &[Point; 3]) -> f64 {
    let piece =
        |parameter: f64| [a, c].map(|end| Point::from(b.coords.lerp(&end.coords, parameter)));
    minimum(60, |parameter| least(shape, &piece(parameter)))
}

fn shapes() -> [Shape; 5] {
    let (radius, half_height) = (0.4, 0.7);
    [
        Shape::Box {
            half: Vector::new(0.3, 0.5, 0.7),
        },
        Shape::Cylinder {
            radius,
            half_height,
        },
        Shape::Sphere { radius },
        Shape::Capsule {
            radius,
            half_height,
        },
        Shape::Plane,
    ]
}

const RADIUS: f64 = 0.05;

/// Where a segment touches a shape at the origin.
fn touches(shape: &Shape, ends: &[Point; 2], reach: f64) -> Vec<ManifoldPoint> {
    let (body, wire) = (
        CollisionShape::of_body(shape).unwrap(),
        CollisionShape::of_segment(ends, RADIUS),
    );
    let middle = nalgebra::center(&ends[0], &ends[1]);
    let turned = UnitQuaternion::identity();
    wire.at(&middle, &turned)
        .touches(&body.at(&Point::origin(), &turned), reach)
}

fn deepest(spots: &[ManifoldPoint]) -> f64 {
    spots
        .iter()
        .fold(f64::INFINITY, |gap, spot| gap.min(spot.gap))
}

fn point() -> impl Strategy<Value = Point> {
    prop::array::uniform3(-1.2..1.2).prop_map(Point::from)
}

#[test]
fn centre_of_a_shape_is_as_deep_as_its_distance_says() {
    for shape in shapes() {
        let body = CollisionShape::of_body(&shape).unwrap();
        let placed = body.at(&Point::origin(), &UnitQuaternion::identity());
        let off = placed.distance(&Point::origin()) - distance(&shape, &Vector::zeros());
        assert!(off.abs() < 1e-15, "{shape:?}: {off:e}");
    }
}

proptest! {
    #[test]
    fn distance_of_a_point_is_that_of_every_shape(point in point()) {
        for shape in shapes() {
            let body = CollisionShape::of_body(&shape).unwrap();
            let placed = body.at(&Point::origin(), &UnitQuaternion::identity());
            let off = placed.distance(&point) - distance(&shape, &point.coords);
            prop_assert!(off.abs() < 1e-14, "{shape:?}: {off:e}");
        }
    }

    #[test]
    fn segment_touches_every_shape_where_its_distance_says(a in point(), b in point()) {
        let ends = [a, b];
        for shape in shapes() {
            let exact = least(&shape, &ends) - RADIUS;
            let spots = touches(&shape, &ends, 0.3);
            // Apart and in touch with the surface; what is deep inside has no one nearest place.
            if exact > 0.31 {
                prop_assert!(spots.is_empty(), "{shape:?} {exact}");
            } else if exact > -RADIUS && exact < 0.29 {
                let gap = deepest(&spots);
                prop_assert!((gap - exact).abs() < 1e-5, "{shape:?} {gap} {exact}");
                for spot in &spots {
                    let way = (spot.points[0] - spot.points[1]).dot(&spot.normal);
                    prop_assert!((way - spot.gap).abs() < 1e-6);
                    prop_assert!(distance(&shape, &spot.points[1].coords).abs() < 1e-5);
                }
            }
        }
    }

    #[test]
    fn triangle_sweeps_a_shape_that_it_meets_and_its_two_pieces_do_not(
        a in point(), b in point(), c in point(),
    ) {
        let pieces = [[a, b], [b, c]];
        for shape in shapes() {
            let swept = least_on_triangle(&shape, &[a, b, c]);
            let before = pieces.map(|piece| least(&shape, &piece));
            let before = before[0].min(before[1]);
            if swept.abs().min(before.abs()) < 1e-4 {
                continue;
            }
            let body = CollisionShape::of_body(&shape).unwrap();
            let body = body.at(&Point::origin(), &UnitQuaternion::identity());
            let expected = swept < 0.0 && before > 0.0;
            let found = body.is_swept(&[a, b, c]);
            prop_assert_eq!(found, expected, "{:?} {} {}", shape, swept, before);
        }
        // Of a mesh there is a surface only.
        let half = Vector::new(0.3, 0.5, 0.7);
        let shape = Shape::Box { half };
        let before = pieces.map(|piece| least(&shape, &piece));
        if before[0].min(before[1]) > 1e-4 {
            let body = |shape: &Shape| {
                let body = CollisionShape::of_body(shape).unwrap();
                let (at, turned) = (Point::new(0.1, 0.0, 0.0), UnitQuaternion::identity());
                body.at(&at, &turned).is_swept(&[a, b, c])
            };
            let mesh = Shape::Mesh(box_mesh(half, Vector::zeros()));
            prop_assert_eq!(body(&mesh), body(&shape));
        }
    }

    #[test]
    fn segment_touches_a_mesh_where_it_touches_the_same_box(a in point(), b in point()) {
        let half = Vector::new(0.3, 0.5, 0.7);
        let ends = [a, b];
        let exact = least(&Shape::Box { half }, &ends) - RADIUS;
        if exact > -RADIUS && exact < 0.29 {
            let mesh = Shape::Mesh(box_mesh(half, Vector::zeros()));
            let gap = deepest(&touches(&mesh, &ends, 0.3));
            prop_assert!((gap - exact).abs() < 1e-5, "{gap} {exact}");
        }
    }
}
