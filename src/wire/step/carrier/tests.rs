use super::*;
use crate::query::Point;
use crate::wire::step::order::by_wires;
use crate::wire::{BodyPlan, Material, Settings, Shape, Stop, WireId, WirePlan};

/// A ball, a chain from one free node to another, and a stiff wire that holds twist: from the ball over a drum to a free node.
fn world() -> World {
    let mut world = World::new(Settings::default()).unwrap();
    let add = |world: &mut World, plan: BodyPlan| world.add_body(plan).unwrap();
    let ball = Shape::Sphere { radius: 0.1 };
    let ball = add(
        &mut world,
        BodyPlan::dynamic(ball, 1000.0, Point::new(-1.0, 0.0, -1.0)),
    );
    let drum = Shape::Sphere { radius: 0.2 };
    let drum = add(&mut world, BodyPlan::fixed(drum, Point::origin()));
    let free = |x: f64, z: f64| Stop::Free(Point::new(x, 0.0, z));
    let chain = Material::steel(0.01).chain();
    let plan = WirePlan::new(chain, 0.5, vec![free(3.0, 0.0), free(4.0, 0.0)]);
    world.add_wire(&plan).unwrap();
    let mut stiff = Material::steel(0.01);
    stiff.twist_modulus = 8e10;
    let eye = Stop::Eye {
        body: ball,
        local: Vector::zeros(),
    };
    let over = Stop::Contact {
        body: drum,
        local: Vector::new(0.0, 0.0, 0.2),
        normal: Vector::z(),
        friction: 0.2,
    };
    let plan = WirePlan::new(stiff, 0.3, vec![eye, over, free(1.0, -1.0)]);
    world.add_wire(&plan).unwrap();
    world
}

#[test]
fn every_unknown_belongs_to_the_node_or_the_body_that_has_it() {
    let world = world();
    let linearisation = Linearisation::at_start(&world);
    let steep = [SteepNode {
        wire: 1,
        node: 2,
        followed: 1.0,
        needed: 1.0,
    }];
    let layout = Layout::new(&world, &linearisation, &by_wires(&world), &steep);
    let mut left = vec![None; layout.size];
    let mut put = |first: Option<usize>, count: usize, part: Part| {
        for at in first.into_iter().flat_map(|first| first..first + count) {
            assert_eq!(left[at].replace(part), None);
        }
    };
    put(layout.bodies[0], 6, Part::Body(BodyId(0)));
    for (w, wire) in world.wires.iter().enumerate() {
        let first = layout.first_node[w];
        for node in 0..wire.nodes.len() {
            let at = first + node;
            let part = Part::Node {
                wire: WireId(w),
                node,
            };
            let own = match layout.nodes[at] {
                Carrier::Free(first) => Some(first),
                _ => None,
            };
            put(own, 3, part);
            put(layout.steep[at], 3, part);
            put(layout.bend[at], 3, part);
            put(layout.slides[at], 2, part);
            if node < wire.segments.len() {
                put(Some(layout.stretch[at - w]), 1, part);
            }
            if node == 0 {
                put(layout.twist[w], 1, part);
            }
        }
    }
    for (unknown, part) in left.into_iter().enumerate() {
        assert_eq!(Some(layout.part(unknown)), part, "unknown {unknown}");
    }
}
