//! Wires that rest on a deck and on each other.

use tunnelproof::query::Point;
use tunnelproof::wire::{BodyPlan, Collisions, Material, Settings, Shape, Stop, WirePlan, World};

/// Segments of each wire that lies across, and of the long one between two of them.
const EACH: usize = 5;

/// So many steel wires of a quarter metre a segment lie along a deck and across it: half of the
/// segments are one long wire on the deck, the others are short ones that lie on it. All are at
/// rest, nearly.
pub(crate) fn world(segments: usize) -> (World, Collisions<'static>) {
    const WARM_UP: usize = 5;
    const LENGTH: f64 = 0.25;
    const RADIUS: f64 = 0.01;
    let mut world = World::new(Settings::default()).expect("settings");
    let deck = BodyPlan::fixed(Shape::Plane, Point::origin());
    world.add_body(deck).expect("a deck");
    let mut add = |from: Point, to: Point| {
        let route = vec![Stop::Free(from), Stop::Free(to)];
        let plan = WirePlan::new(Material::steel(RADIUS), LENGTH, route);
        world.add_wire(&plan).expect("a wire");
    };
    let across = segments / (2 * EACH);
    let along = (segments - across * EACH) as f64 * LENGTH;
    add(Point::new(0.0, 0.0, RADIUS), Point::new(along, 0.0, RADIUS));
    let half = EACH as f64 * LENGTH / 2.0;
    for k in 0..across {
        let x = (k as f64 + 0.5) * EACH as f64 * LENGTH;
        let z = 3.0 * RADIUS;
        add(Point::new(x, -half, z), Point::new(x, half, z));
    }
    let count = world.wires().iter().map(|wire| wire.segments().len());
    assert_eq!(count.sum::<usize>(), segments);
    let mut collisions = Collisions::default();
    for _ in 0..WARM_UP {
        let step = world.step_colliding(&mut collisions, &[]);
        step.expect("a step that can be done");
    }
    (world, collisions)
}
