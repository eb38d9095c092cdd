//! A wire that sags between two pins and swings.

use tunnelproof::query::Point;
use tunnelproof::wire::{Material, Settings, Stop, WirePlan, World};

/// The numbers of segments that are measured.
pub(crate) const SEGMENTS: [usize; 4] = [10, 100, 1000, 10_000];

/// The materials that are measured, by name.
pub(crate) fn materials() -> [(&'static str, Material); 2] {
    let steel = Material::steel(0.01);
    [("steel", steel), ("chain", steel.chain())]
}

/// Segments of a quarter metre between two pins, as a shallow V that has swung for some steps.
pub(crate) fn world(material: Material, segments: usize) -> World {
    let (length, each) = (segments as f64 / 4.0, 0.25);
    let (half, sag) = (0.48 * length, 0.14 * length);
    let stops = [
        Stop::Pinned(Point::new(-half, 0.0, 0.0)),
        Stop::Free(Point::new(0.0, 0.1 * sag, -sag)),
        Stop::Pinned(Point::new(half, 0.0, 0.0)),
    ];
    let mut world = World::new(Settings::default()).expect("settings");
    let plan = WirePlan::new(material, each, stops.to_vec());
    world.add_wire(&plan).expect("a wire");
    for _ in 0..WARM_UP {
        world.step(&[]).expect("a step that can be done");
    }
    world
}

const WARM_UP: usize = 5;
