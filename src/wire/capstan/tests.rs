use super::*;
use crate::query::Point;
use crate::wire::{BodyPlan, Material, Settings, Shape, Stop, WirePlan};

/// A chain over one contact node on top of a sphere, its ends `down` below it at both sides.
fn over_a_node(friction: f64, down: f64) -> World {
    let mut world = World::new(Settings {
        gravity: Vector::zeros(),
        ..Settings::default()
    })
    .unwrap();
    let sphere = BodyPlan::fixed(Shape::Sphere { radius: 1.0 }, Point::new(0.0, 0.0, -1.0));
    let body = world.add_body(sphere).unwrap();
    let route = vec![
        Stop::Pinned(Point::new(-2.0, 0.0, -down)),
        Stop::Contact {
            body,
            local: Vector::z(),
            normal: Vector::z(),
            friction,
        },
        Stop::Pinned(Point::new(2.0, 0.0, -down)),
    ];
    let plan = WirePlan::new(Material::steel(0.02).chain(), 10.0, route);
    world.add_wire(&plan).unwrap();
    world
}

/// Moves an end so that its side is longer by `by`.
fn pull(world: &mut World, by: f64) {
    let node = &mut world.wires[0].nodes[2];
    let along = node.position.coords.normalize();
    node.position += along * by;
}

#[test]
fn capstan_bound_is_the_node_formula_and_tends_to_the_exponential() {
    for (degrees, tolerance) in [(15.0_f64, 1e-3), (1.0, 1e-5)] {
        let angle = degrees.to_radians();
        let turned = Vector::new(angle.cos(), angle.sin(), 0.0);
        let bound = capstan_bound(&Vector::x(), &turned, 0.3);
        let half = 0.3 * (angle / 2.0).tan();
        assert!((bound - (1.0 + half) / (1.0 - half)).abs() < 1e-14);
        assert!((bound / (0.3 * angle).exp() - 1.0).abs() < tolerance);
    }
    let back = Vector::new(-1.0, 1e-3, 0.0).normalize();
    assert_eq!(capstan_bound(&Vector::x(), &back, 0.3), f64::INFINITY);
}

#[test]
fn wire_slides_until_the_bound_holds_and_conserves_its_length() {
    let mut world = over_a_node(0.3, 1.0);
    pull(&mut world, 1e-3);
    let length = world.wires[0].nodes[2].arc;
    let slides = slide(&mut world);
    assert!(slides.len() == 1 && slides[0].distance < 0.0 && !slides[0].left);
    let wire = &world.wires[0];
    assert_eq!(wire.nodes[2].arc, length);
    let strain = [0, 1].map(|i| wire.span(i).norm() / wire.rest_length(i) - 1.0);
    let [before, after] = directions(wire, 1);
    let bound = capstan_bound(&before, &after, 0.3);
    assert!((strain[1] / strain[0] / bound - 1.0).abs() < 1e-9);
    // Within the bound it sticks.
    assert!(slide(&mut world).is_empty());
}

#[test]
fn wire_that_may_not_slide_sticks_and_one_step_slides_at_most_the_limit() {
    let mut sticky = over_a_node(1e6, 1.0);
    pull(&mut sticky, 1e-3);
    assert!(slide(&mut sticky).is_empty());
    let mut slippery = over_a_node(0.0, 1.0);
    slippery.settings.slide_limit = 1e-5;
    pull(&mut slippery, 1e-3);
    let slides = slide(&mut slippery);
    assert!((slides[0].distance + 1e-5).abs() < 1e-15, "{slides:?}");
}

#[test]
fn contact_node_leaves_where_the_wire_turns_away_from_the_body() {
    let mut world = over_a_node(0.3, -1.0);
    let slides = slide(&mut world);
    assert!(slides.len() == 1 && slides[0].left);
    assert_eq!(world.wires[0].nodes[1].kind, NodeKind::Free);
    let mut stays = over_a_node(0.3, 1.0);
    assert!(slide(&mut stays).is_empty());
}
