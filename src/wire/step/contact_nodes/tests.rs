use super::*;
use crate::wire::resolution::Permit;
use crate::wire::{BodyPlan, Material, Settings, Shape, Stop, WirePlan};

const RADIUS: f64 = 0.01;

/// Two wires over a ball of 1 m, so far apart; the first one has a contact node at the top.
fn beside_each_other(apart: f64) -> (World, ContactNodeInsertion) {
    let mut world = World::new(Settings::default()).unwrap();
    let ball = BodyPlan::fixed(Shape::Sphere { radius: 1.0 }, Point::origin());
    let body = world.add_body(ball).unwrap();
    let height = 1.0 + RADIUS;
    let free = |x: f64, y: f64, z: f64| Stop::Free(Point::new(x, y, z));
    let top = Stop::Contact {
        body,
        local: Vector::new(0.0, 0.0, height),
        normal: Vector::z(),
        friction: 0.5,
    };
    let mut add = |y: f64, stops: Vec<Stop>| {
        let route = [vec![free(-1.0, y, 0.9)], stops, vec![free(1.0, y, 0.9)]].concat();
        let plan = WirePlan::new(Material::steel(RADIUS), 2.0, route);
        world.add_wire(&plan).unwrap()
    };
    add(0.0, vec![top]);
    let wire = add(apart, vec![]);
    let insertion = ContactNodeInsertion {
        wire,
        arc: 1.0,
        body,
        place: Point::new(0.0, apart, height),
        normal: Vector::z(),
        friction: 0.5,
        aside: Vector::y(),
    };
    (world, insertion)
}

#[test]
fn wire_gets_no_contact_node_inside_of_another_wire_at_one() {
    for (apart, is_put_in) in [
        (0.2, false),
        (0.7, false),
        (0.8, true),
        (1.0, true),
        (3.0, true),
    ] {
        let (mut world, insertion) = beside_each_other(2.0 * RADIUS * apart);
        let changes = insert(&mut world, &[insertion], &mut Permit);
        assert_eq!(changes.len() == 1, is_put_in, "{apart}");
        let is_contact = |node: &Node| matches!(node.kind, NodeKind::Contact { .. });
        let count = world.wires[1].nodes.iter().filter(|node| is_contact(node));
        assert_eq!(count.count() == 1, is_put_in, "{apart}");
    }
}

#[test]
fn of_two_places_that_overlap_in_a_step_the_first_gets_a_contact_node() {
    let (mut world, insertion) = beside_each_other(RADIUS / 2.0);
    let nodes = &mut world.wires[0].nodes;
    nodes[1].kind = NodeKind::Free;
    let first = ContactNodeInsertion {
        wire: WireId(0),
        arc: nodes[1].arc,
        place: nodes[1].position,
        ..insertion
    };
    insert(&mut world, &[first, insertion], &mut Permit);
    let counts = [0, 1].map(|wire| contact_nodes(&world.wires[wire]).len());
    assert_eq!(counts, [1, 0]);
}
