//! A wire that sags between two pins and swings.

use tunnelproof::query::Point;
use tunnelproof::wire::{Material, Settings, Stop, WirePlan, World};

/// The numbers of segments that are measured.
pub(crate) const SEGMENTS: [usize; 4] = [10, 100, 1000, 10_000];

/// A steel wire in segments of a quarter metre between two pins that sags as a parabola by a tenth
/// of its span and has swung for some steps. In so little gravity that a long wire is not tighter
/// than a short one.
pub(crate) fn world(segments: usize) -> World {
    const WARM_UP: usize = 5;
    let span = 0.24 * segments as f64;
    let stop = |i: usize| {
        let along = i as f64 / segments as f64;
        let sag = 0.4 * span * along * (1.0 - along);
        let point = Point::new(span * along, 0.3 * sag, -sag);
        if i == 0 || i == segments {
            Stop::Pinned(point)
        } else {
            Stop::Free(point)
        }
    };
    let mut settings = Settings::default();
    settings.gravity *= 10.0 / segments as f64;
    let mut world = World::new(settings).expect("settings");
    let plan = WirePlan::new(
        Material::steel(0.01),
        0.5,
        (0..=segments).map(stop).collect(),
    );
    world.add_wire(&plan).expect("a wire");
    assert_eq!(world.wires()[0].segments().len(), segments);
    for _ in 0..WARM_UP {
        world.step(&[]).expect("a step that can be done");
    }
    world
}
