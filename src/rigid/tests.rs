use nalgebra::{Quaternion, Vector3};

use super::*;
use crate::query::{Point, QueryKind};

fn pose(quaternion: [f64; 4]) -> Pose {
    let [w, x, y, z] = quaternion;
    Pose::new(Point::new(1.0, 2.0, 3.0), Quaternion::new(w, x, y, z))
}

fn error(start: Pose, end: Pose) -> String {
    RigidMotion::new(start, end).unwrap_err().to_string()
}

#[test]
fn rigid_motion_new_names_what_is_no_pose() {
    let still = pose([1.0, 0.0, 0.0, 0.0]);
    assert_eq!(
        error(still, pose([0.0, -0.0, 0.0, 0.0])),
        "the quaternion at t = 1 is 0; it needs a length"
    );
    assert_eq!(
        error(pose([0.0, 1.0, f64::NAN, 0.0]), still),
        "y of the quaternion at t = 0 is NaN, not a finite number"
    );
    let mut away = still;
    away.centre.z = f64::INFINITY;
    assert_eq!(
        error(still, away),
        "z of the centre at t = 1 is inf, not a finite number"
    );
}

#[test]
fn rigid_motion_new_refuses_more_than_a_quarter_turn() {
    let still = pose([1.0, 0.0, 0.0, 0.0]);
    let turned = |degrees: f64, size: f64| {
        let (sin, cos) = (degrees / 2.0).to_radians().sin_cos();
        pose([size * cos, 0.0, size * sin, 0.0])
    };
    let least = f64::from_bits(1) * 4096.0;
    for size in [1.0, -1.0, 1e300, -1e-300, least] {
        let degrees = if size == least { 89.0 } else { 89.999_999 };
        assert!(RigidMotion::new(still, turned(degrees, size)).is_ok());
        assert!(RigidMotion::new(turned(degrees, size), still).is_ok());
        assert!(RigidMotion::new(still, turned(91.0, size)).is_err());
        assert!(RigidMotion::new(still, turned(180.0, size)).is_err());
    }
    assert_eq!(
        error(still, turned(120.0, 1.0)),
        "the body turns by 120.000 degrees in the step; divide the step so that it turns by at \
         most 90"
    );
    let right = pose([1.0, 1.0, 0.0, 0.0]);
    assert!(RigidMotion::new(still, right).is_ok());
}

#[test]
fn quaternions_have_the_nearer_sign() {
    let motion = RigidMotion::new(pose([1.0, 0.0, 0.0, 0.0]), pose([-1.0, 0.0, 0.0, -0.5]));
    assert_eq!(
        motion.unwrap().quaternions(),
        [[1.0, 0.0, 0.0, 0.0], [1.0, -0.0, -0.0, 0.5]]
    );
}

#[test]
fn position_passes_through_both_poses_and_turns_the_shorter_way() {
    for size in [1.0, -3.0, 1e-310, 1e300] {
        let start = pose([size, 0.0, 0.0, 0.0]);
        let end = pose([-size, 0.0, 0.0, -size]);
        let motion = RigidMotion::new(start, end).unwrap();
        let at =
            |t: f64| motion.position(&Point::new(1.0, 0.0, 4.0), t).coords - start.centre.coords;
        assert!((at(0.0) - Vector3::new(1.0, 0.0, 4.0)).norm() < 1e-14);
        assert!((at(1.0) - Vector3::new(0.0, 1.0, 4.0)).norm() < 1e-14);
        let half = 0.5f64.atan() * 2.0;
        assert!((at(0.5) - Vector3::new(half.cos(), half.sin(), 4.0)).norm() < 1e-14);
    }
}

#[test]
fn query_new_names_the_point() {
    let still = pose([1.0, 0.0, 0.0, 0.0]);
    let motion = RigidMotion::new(still, still).unwrap();
    let (zero, mut bad) = (Point::origin(), Point::origin());
    bad.y = f64::NEG_INFINITY;
    let error = EdgeTurningEdge::new([zero; 2], [zero, bad], [zero; 2], motion).unwrap_err();
    assert_eq!(
        error.to_string(),
        "y of point B at t = 1 is -inf, not a finite number"
    );
    let error = VertexTurningFace::new([zero], [zero], [zero, zero, bad], motion).unwrap_err();
    assert_eq!(
        error.to_string(),
        "y of point D in the body's frame is -inf, not a finite number"
    );
}

#[test]
fn point_is_that_of_the_linear_query_where_the_body_does_not_turn() {
    use crate::contact::Place;
    use crate::{EdgeEdge, decide, decide_rigid};

    let p = Point::new;
    let (start, end) = (
        [p(0.1, 0.2, -1.3), p(1.4, 1.7, 1.0)],
        [p(0.1, 0.0, -1.3), p(1.6, 1.7, 0.9)],
    );
    let rod = [p(1.0, 0.0, 0.0), p(0.0, 1.0, 0.0)];
    let still = Quaternion::new(1.0, 0.0, 0.0, 0.0);
    let away = p(1.0, 1.0, 0.0);
    let motion =
        RigidMotion::new(Pose::new(Point::origin(), still), Pose::new(away, still)).unwrap();
    let turning = EdgeTurningEdge::new(start, end, rod, motion).unwrap();
    let [c, d] = rod.map(|corner| corner + away.coords);
    let linear = EdgeEdge::new(
        [start[0], start[1], rod[0], rod[1]],
        [end[0], end[1], c, d],
        0.0,
    )
    .unwrap();

    let hit = decide_rigid(&turning).expect("the rod meets the wire");
    let (first, second) = Place::from(hit.place).weights();
    let (expected, none) = decide(&linear).unwrap().points(&linear);
    assert_eq!((second, none), (None, None));
    let at = turning.point(&first, hit.toi);
    assert!((at - expected.point).norm() < 1e-14, "{at}");
    // On the rod as well.
    let [_, _, c, d] = turning.positions(hit.toi);
    let other = c.coords * first[2] + d.coords * first[3];
    assert!((at.coords - other).norm() < 1e-14, "{at}");
}

#[test]
fn point_of_a_vertex_is_the_vertex() {
    let p = Point::new;
    let still = Pose::new(Point::origin(), Quaternion::new(1.0, 0.0, 0.0, 0.0));
    let motion = RigidMotion::new(still, still).unwrap();
    let corners = [p(0.0, 0.0, 0.0), p(4.0, 0.0, 0.0), p(0.0, 4.0, 0.0)];
    let query =
        VertexTurningFace::new([p(1.0, 1.0, 1.0)], [p(1.0, 1.0, -1.0)], corners, motion).unwrap();
    let hit = crate::decide_rigid(&query).expect("the vertex falls through the face");
    let place: crate::contact::Place = hit.place.into();
    assert_eq!(place.weights(), ([1.0, 0.5, 0.25, 0.25], None));
    assert_eq!(query.point(&place.weights().0, hit.toi), p(1.0, 1.0, 0.0));
}

#[test]
fn rigid_query_new_takes_sides_of_two_and_two_or_one_and_three_points() {
    let still = pose([1.0, 0.0, 0.0, 0.0]);
    let motion = RigidMotion::new(still, still).unwrap();
    let points = [Point::origin(); 4];
    let straight = |count: usize| Side::Straight {
        start: &points[..count],
        end: &points[..count],
    };
    let turning = |count: usize| Side::Turning {
        local: &points[..count],
        motion: &motion,
    };
    for (sides, kind) in [
        ([straight(2), turning(2)], "edge-turning-edge"),
        ([straight(1), turning(3)], "vertex-turning-face"),
        ([turning(2), turning(2)], "turning-edge-turning-edge"),
        ([turning(1), turning(3)], "turning-vertex-turning-face"),
    ] {
        let query = RigidQuery::new(sides, [0.5, 0.25]).unwrap();
        assert_eq!(query.kind().name(), kind);
        assert_eq!(query.sides(), sides);
        assert_eq!(query.radius().parts(), [0.5, 0.25]);
    }
    let error = |sides| RigidQuery::new(sides, 0.0).unwrap_err().to_string();
    for sides in [[turning(3), turning(1)], [straight(2), turning(3)]] {
        assert!(error(sides).ends_with("two edges have 2 and 2, a vertex and a face 1 and 3"));
    }
    assert_eq!(
        error([turning(2), straight(2)]),
        "the second side has to be of a body that turns"
    );
    let mut bad = [Point::origin(); 2];
    bad[1].x = f64::NAN;
    let second = Side::Turning {
        local: &bad,
        motion: &motion,
    };
    assert_eq!(
        error([turning(2), second]),
        "x of point D in the body's frame is NaN, not a finite number"
    );
}

#[test]
fn rigid_query_from_lists_takes_what_the_kind_has() {
    let pose = pose([1.0, 0.0, 0.0, 0.0]);
    let points = [Point::origin(); 6];
    let of = |kind,
              Lengths {
                  points: in_space,
                  local,
                  poses,
              }| {
        let (in_space, local) = (&points[..in_space], &points[..local]);
        RigidQuery::from_lists(kind, in_space, local, &[pose; 6][..poses], 0.0)
    };
    for kind in RigidQueryKind::ALL {
        let query = of(kind, kind.lengths()).unwrap();
        assert_eq!(query.kind(), kind);
        assert_eq!(RigidQueryKind::from_name(kind.name()), Some(kind));
        let [first, second] = query.sides().map(|side| side.number_of_points());
        let counts = match kind.linear() {
            QueryKind::EdgeEdge => (2, 2),
            QueryKind::VertexFace => (1, 3),
        };
        assert_eq!((first, second), counts);
        for change in [[1, 0, 0], [0, 1, 0], [0, 0, 1], [0, 0, 2]] {
            let Lengths {
                points,
                local,
                poses,
            } = kind.lengths();
            let lengths = Lengths {
                points: points + change[0],
                local: local + change[1],
                poses: poses + change[2],
            };
            assert_eq!(
                of(kind, lengths),
                Err(RigidError::Lengths { kind, lengths })
            );
        }
    }
    let lengths = Lengths {
        points: 4,
        local: 3,
        poses: 2,
    };
    assert_eq!(
        of(RigidQueryKind::EdgeTurningEdge, lengths)
            .unwrap_err()
            .to_string(),
        "there are 4 points in space, 3 of bodies and 2 poses; edge-turning-edge has 4 points in \
         space, 2 of bodies and 2 poses"
    );
}

#[test]
fn degrees_are_those_of_the_turn() {
    for (size, degrees) in [(1.0, 30.0), (-2.5, 60.0), (1e300, 89.0), (1e-310, 10.0)] {
        let (sin, cos) = f64::to_radians(degrees / 2.0).sin_cos();
        let end = pose([cos * size, 0.0, sin * size, 0.0]);
        let motion = RigidMotion::new(pose([1.0, 0.0, 0.0, 0.0]), end).unwrap();
        let error = (motion.degrees() - degrees).abs();
        assert!(error < 1e-6, "{error}");
    }
}
