#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use tunnelproof::wire::Shape;

use super::*;

fn vector(rng: &mut ChaCha8Rng, size: f64) -> Vector {
    Vector::from_fn(|_, _| rng.random_range(-size..=size))
}

fn shapes() -> [Shape; 4] {
    [
        Shape::Box {
            half: Vector::new(0.001, 0.2, 0.5),
        },
        Shape::Cylinder {
            radius: 0.02,
            half_height: 0.5,
        },
        Shape::Capsule {
            radius: 0.1,
            half_height: 0.3,
        },
        Shape::Sphere { radius: 0.5 },
    ]
}

/// A segment that moves past the centre of a body that turns.
fn part(rng: &mut ChaCha8Rng) -> Part {
    let quaternion = |rng: &mut ChaCha8Rng, size: f64| {
        *UnitQuaternion::from_scaled_axis(vector(rng, size)).quaternion()
    };
    let from = Pose::new(Point::from(vector(rng, 0.1)), quaternion(rng, 2.0));
    let turned = from.quaternion * quaternion(rng, 0.2);
    let to = Pose::new(from.centre + vector(rng, 0.3), turned);
    let middle = Point::from(vector(rng, 0.4));
    let half = vector(rng, 0.4);
    let start = [middle - half, middle + half];
    Part {
        motion: RigidMotion::new(from, to).unwrap(),
        start,
        end: start.map(|node| node + vector(rng, 0.3)),
    }
}

/// The first contact of all features, none left out.
fn of_all(part: &Part, surface: &Surface) -> Option<Hit> {
    let mut hits = Vec::new();
    for face in &surface.faces {
        hits.extend([0, 1].map(|node| part.against_face(node, face).unwrap()));
    }
    for edge in &surface.edges {
        let query = EdgeTurningEdge::new(part.start, part.end, *edge, part.motion).unwrap();
        hits.push(hit(query));
    }
    first(hits)
}

#[test]
fn touch_of_a_part_is_that_of_all_features() {
    let rng = &mut ChaCha8Rng::seed_from_u64(29);
    for shape in shapes() {
        let core = Core::of(&shape);
        let Core::Surface(surface) = &core else {
            unreachable!("a surface");
        };
        let (mut hits, mut left_out) = (0, 0);
        for _ in 0..60 {
            let (part, mut asked) = (part(rng), 0);
            let found = part.touch(&core, &mut asked).unwrap();
            let time = |found: Option<Hit>| found.map(|(hit, _)| hit);
            assert_eq!(time(found), time(of_all(&part, surface)));
            hits += u32::from(found.is_some());
            left_out += u32::from(asked == 0);
        }
        println!("{shape:?}: {hits} hits, {left_out} left out whole");
        assert!(hits > 10, "{shape:?}: {hits}");
    }
}

/// What axes say is apart has no contact, and most of what has none is apart by axes.
#[test]
fn separated_features_have_no_contact() {
    let rng = &mut ChaCha8Rng::seed_from_u64(30);
    let [mut separated, mut missed] = [0; 2];
    for _ in 0..2000 {
        let mut part = part(rng);
        // At rest and not turned, so that space and the body's frame are the same.
        let rest = Pose::new(Point::origin(), Quaternion::identity());
        part.motion = RigidMotion::new(rest, rest).unwrap();
        let corners = [0; 3].map(|_| vector(rng, 0.5));
        let way = [part.start[0], part.start[1], part.end[0], part.end[1]].map(|p| p.coords);
        let edge = [corners[0], corners[1]];
        let stray = 10f64.powf(rng.random_range(-12.0..-1.0));
        let query = EdgeTurningEdge::new(part.start, part.end, edge.map(Point::from), part.motion);
        let edges = hit(query.unwrap());
        let face = part.against_face(0, &corners.map(Point::from)).unwrap();
        let apart = [
            (is_segment_apart(&way, &edge, stray), edges),
            (is_node_apart(&[way[0], way[2]], &corners, stray), face),
        ];
        for (apart, hit) in apart {
            assert!(!apart || hit.is_none());
            separated += u32::from(apart);
            missed += u32::from(hit.is_none());
        }
    }
    println!("{separated} of {missed} misses separated");
    assert!(4 * separated > 3 * missed);
}
