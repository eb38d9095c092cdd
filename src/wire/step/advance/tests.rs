use super::*;
use crate::query::Point;
use crate::wire::model::wire::Segment;
use crate::wire::{
    BodyId, BodyPlan, ContactSite, Drive, Material, ModelError, Part, Phase, Settings, Shape, Stop,
    Vector, WireId, WirePlan,
};

fn world() -> World {
    World::new(Settings::default()).unwrap()
}

fn at(x: f64, y: f64, z: f64) -> Point {
    Point::new(x, y, z)
}

fn pinned_and(end: Stop) -> Vec<Stop> {
    vec![Stop::Pinned(at(0.0, 0.0, 0.0)), end]
}

fn is_finite(world: &World) -> bool {
    let nodes = world.wires.iter().flat_map(|wire| &wire.nodes);
    let nodes = nodes.map(|node| node.position.coords.sum() + node.velocity.sum());
    let bodies = world.bodies.iter();
    let bodies = bodies.map(|body| body.position.coords.sum() + body.angular_velocity.sum());
    nodes.chain(bodies).all(f64::is_finite)
}

/// A body of some kilograms hung on a wire of short segments.
fn hung(mass: f64, resolution: f64) -> World {
    let mut world = world();
    let shape = Shape::Sphere { radius: 0.5 };
    let density = mass / shape.mass_properties(1.0).unwrap().mass;
    let body = BodyPlan::dynamic(shape, density, at(0.3, 0.0, -3.0));
    let body = world.add_body(body).unwrap();
    let local = Vector::zeros();
    let route = pinned_and(Stop::Eye { body, local });
    let plan = WirePlan::new(Material::steel(0.02), resolution, route);
    world.add_wire(&plan).unwrap();
    world
}

#[test]
fn short_segments_hold_a_million_newtons_at_a_mass_ratio_of_1e5() {
    // Segments 30 times shorter than waves travel in a step: what resists across them holds them.
    let mut world = hung(1e5, 0.1);
    for _ in 0..600 {
        world.step(&[]).unwrap();
    }
    let swing = world.bodies[0].position.coords.xy().norm();
    assert!(is_finite(&world) && swing < 0.35, "{swing}");
    let wire = &world.wires[0];
    let tension = wire.segments[0].tension;
    assert!(
        (tension - 1e5 * 9.80665).abs() < 0.05 * tension,
        "{tension}"
    );
    // Straight, but for the swing.
    let chord = wire.nodes[wire.nodes.len() - 1].position.coords.normalize();
    let bow = wire
        .nodes
        .iter()
        .map(|n| n.position.coords.cross(&chord).norm());
    assert!(bow.fold(0.0, f64::max) < 0.02);
}

#[test]
fn without_inertia_the_same_wire_would_not_hold() {
    // The fault is planted in the data: tension forgotten before every step.
    let mut world = hung(1e5, 0.1);
    let mut bow: f64 = 0.0;
    for _ in 0..200 {
        for segment in &mut world.wires[0].segments {
            *segment = Segment::NEW;
        }
        if world.step(&[]).is_err() {
            return;
        }
        let nodes = world.wires[0].nodes.iter();
        bow = nodes
            .map(|n| n.position.coords.xy().norm())
            .fold(bow, f64::max);
    }
    assert!(bow > 0.2, "{bow}");
}

#[test]
fn chain_goes_from_slack_to_taut_and_never_pushes() {
    let mut world = world();
    let body = BodyPlan::dynamic(Shape::Sphere { radius: 0.2 }, 1000.0, at(0.0, 0.0, -1.0));
    let body = world.add_body(body).unwrap();
    let local = Vector::zeros();
    let route = pinned_and(Stop::Eye { body, local });
    let mut plan = WirePlan::new(Material::steel(0.01).chain(), 0.5, route);
    plan.length = Some(3.0);
    world.add_wire(&plan).unwrap();
    for n in 1..=300 {
        let record = world.step(&[]).unwrap();
        let least = record.wires[0]
            .tensions
            .iter()
            .fold(0.0, |a: f64, &b| a.min(b));
        assert!(least >= -1e-6, "{n}: {least}");
        assert!(is_finite(&world));
        if n == 30 {
            // It falls 2 m in 0.64 s; until then nothing holds it.
            let h = world.settings.step;
            let fallen = 9.80665 * h * h * f64::from(n * (n + 1)) / 2.0;
            let z = world.bodies[0].position.z;
            assert!((z + 1.0 + fallen).abs() < 1e-9, "{z} {fallen}");
        }
    }
    let z = world.bodies[0].position.z;
    assert!((z + 3.0).abs() < 1e-2, "{z}");
}

#[test]
fn coincident_nodes_and_fast_bodies_stay_finite() {
    let mut world = world();
    let plan = BodyPlan {
        drive: Drive::Dynamic {
            density: 7850.0,
            velocity: Vector::new(100.0, 0.0, 0.0),
            angular_velocity: Vector::new(50.0, 80.0, 3.0),
        },
        ..BodyPlan::dynamic(
            Shape::Box {
                half: Vector::new(0.1, 0.2, 0.3),
            },
            7850.0,
            at(0.0, 0.0, -2.0),
        )
    };
    let body = world.add_body(plan).unwrap();
    let local = Vector::new(0.1, 0.2, 0.3);
    for material in [Material::steel(0.01), Material::steel(0.01).chain()] {
        let plan = WirePlan::new(material, 0.25, pinned_and(Stop::Eye { body, local }));
        world.add_wire(&plan.adaptive()).unwrap();
    }
    for wire in &mut world.wires {
        wire.nodes[2].position = wire.nodes[1].position;
        wire.nodes[3].position = wire.nodes[1].position;
    }
    for _ in 0..300 {
        world.step(&[]).unwrap();
        assert!(is_finite(&world));
    }
}

#[test]
fn failed_step_leaves_the_world_as_it_was() {
    let mut world = hung(100.0, 0.5);
    world.step(&[]).unwrap();
    let contact = ContactConstraint {
        key: 0,
        a: ContactSite::Body {
            body: BodyId(7),
            local: Vector::zeros(),
        },
        b: ContactSite::World,
        normal: Vector::z(),
        gap: 0.0,
        friction: 0.5,
    };
    let before = (world.wires.clone(), world.bodies.clone(), world.steps);
    let error = world.step(&[contact]).unwrap_err();
    assert_eq!(
        error.to_string(),
        "step 1: contact 0 is refused: there is no body 7: bodies are 0 to 1 (excluded)"
    );
    // A velocity that overflows in the system: no pivot or solution can be trusted. The second wire is an island of its own.
    let mut two = world.clone();
    let route = pinned_and(Stop::Free(at(0.0, 5.0, 0.0)));
    let other = WirePlan::new(Material::steel(0.02), 0.5, route);
    two.add_wire(&other).unwrap();
    for wire in [WireId(0), WireId(1)] {
        let mut broken = two.clone();
        broken.wires[wire.0].nodes[2].velocity.x = f64::MAX;
        let state = (broken.wires.clone(), broken.bodies.clone(), broken.steps);
        let error = broken.step(&[]).unwrap_err();
        let part = Part::Node { wire, node: 2 };
        assert!(
            matches!(error.reason, Reason::Residual { part: at, .. } if at == part),
            "{error}"
        );
        assert_eq!(error.involved(), (vec![wire], vec![]));
        assert_eq!((broken.wires, broken.bodies, broken.steps), state);
    }
    assert_eq!(
        (world.wires.clone(), world.bodies.clone(), world.steps),
        before
    );
    world.step(&[]).unwrap();
}

#[test]
fn step_that_would_end_beyond_the_numbers_is_refused() {
    let break_it: [fn(&mut World); 2] = [
        |world| {
            world.bodies[0].position.x = f64::MAX;
            world.bodies[0].velocity.x = 1e300;
        },
        |world| world.bodies[0].angular_velocity.x = 1e200,
    ];
    for break_it in break_it {
        let mut world = world();
        let body = BodyPlan::dynamic(Shape::Sphere { radius: 0.2 }, 1000.0, at(0.0, 0.0, 0.0));
        let body = world.add_body(body).unwrap();
        break_it(&mut world);
        let state = (world.bodies.clone(), world.steps);
        let error = world.step(&[]).unwrap_err();
        let part = Part::Body(body);
        assert_eq!(error.reason, Reason::NotFinite { part });
        assert_eq!((world.bodies, world.steps), state);
    }
}

#[test]
fn contacts_are_refused_by_what_is_wrong_with_them() {
    let mut world = hung(100.0, 0.5);
    let good = ContactConstraint {
        key: 0,
        a: ContactSite::Wire {
            wire: WireId(0),
            arc: 1.0,
        },
        b: ContactSite::World,
        normal: Vector::z(),
        gap: 1.0,
        friction: 0.5,
    };
    let mut refusal = |change: fn(&mut ContactConstraint)| {
        let mut contact = good;
        change(&mut contact);
        match world.step(&[contact]).unwrap_err().reason {
            Reason::Contact { error, .. } => error,
            other => panic!("{other:?}"),
        }
    };
    let texts = [
        refusal(|c| c.normal = Vector::z() * 2.0),
        refusal(|c| c.gap = f64::NAN),
        refusal(|c| c.friction = -0.5),
        refusal(|c| {
            c.a = ContactSite::Wire {
                wire: WireId(0),
                arc: 9.0,
            }
        }),
        refusal(|c| {
            c.a = ContactSite::Wire {
                wire: WireId(2),
                arc: 0.0,
            }
        }),
    ];
    let texts = texts.map(|error: ModelError| error.to_string());
    assert_eq!(
        texts,
        [
            "length of the normal is 2, it must be 1 within 1e-9",
            "gap is NaN, it must be finite",
            "friction is -0.5, it must be finite and at least 0",
            "arc is 9, it must be at most the length of the wire",
            "there is no wire 2: wires are 0 to 1 (excluded)",
        ]
    );
}

/// Boxes of 1 m on a plane, one on the other: four corners of each against what is below it.
fn stack(world: &World) -> Vec<ContactConstraint> {
    let mut contacts = Vec::new();
    for (i, body) in world.bodies.iter().enumerate() {
        for (corner, [x, y]) in [[0.5, 0.5], [0.5, -0.5], [-0.5, 0.5], [-0.5, -0.5]]
            .into_iter()
            .enumerate()
        {
            let local = Vector::new(x, y, -0.5);
            let point = body.point(&local);
            let (b, floor) = match i.checked_sub(1) {
                None => (ContactSite::World, 0.0),
                Some(below) => {
                    let local = Vector::new(x, y, 0.5);
                    let top = world.bodies[below].point(&local).z;
                    let body = BodyId(below);
                    (ContactSite::Body { body, local }, top)
                }
            };
            contacts.push(ContactConstraint {
                key: (4 * i + corner) as u64,
                a: ContactSite::Body {
                    body: BodyId(i),
                    local,
                },
                b,
                normal: Vector::z(),
                gap: point.z - floor,
                friction: 0.5,
            });
        }
    }
    contacts
}

#[test]
fn stack_of_boxes_rests_on_the_sum_of_its_weights() {
    let mut world = world();
    for i in 0..4 {
        let half = Vector::repeat(0.5);
        let centre = at(0.0, 0.0, f64::from(i) + 0.5);
        let plan = BodyPlan::dynamic(Shape::Box { half }, 1000.0, centre);
        world.add_body(plan).unwrap();
    }
    let mut last = None;
    for _ in 0..300 {
        let contacts = stack(&world);
        last = Some(world.step(&contacts).unwrap());
    }
    let record = last.unwrap();
    assert!(
        record.solver.contact_residual <= 1e-8,
        "{:?}",
        record.solver
    );
    for i in 0..4 {
        let normals = record.contacts[4 * i..4 * i + 4].iter();
        let sum: f64 = normals.map(|c| c.normal_force()).sum();
        let weight = (4 - i) as f64 * 1000.0 * 9.80665;
        assert!((sum / weight - 1.0).abs() < 1e-4, "{i}: {sum} {weight}");
        assert!(world.bodies[i].velocity.norm() < 1e-6);
        assert!((world.bodies[i].position.z - i as f64 - 0.5).abs() < 1e-2);
    }
}

#[test]
fn kinematic_body_follows_its_phases_and_drags_its_wire() {
    let mut world = world();
    let phase = |from, x| Phase {
        from,
        velocity: Vector::x() * x,
        angular_velocity: Vector::z() * x,
    };
    let plan = BodyPlan {
        drive: Drive::Kinematic(vec![phase(0.5, 2.0), phase(1.0, 0.0)]),
        ..BodyPlan::fixed(Shape::Sphere { radius: 0.1 }, at(0.0, 0.0, 0.0))
    };
    let body = world.add_body(plan).unwrap();
    let local = Vector::y();
    let stop = Stop::Free(at(0.0, 1.0, -2.0));
    let route = vec![Stop::Eye { body, local }, stop];
    world
        .add_wire(&WirePlan::new(Material::steel(0.02), 0.5, route))
        .unwrap();
    for _ in 0..120 {
        world.step(&[]).unwrap();
    }
    assert!((world.bodies[0].position.x - 1.0).abs() < 1e-12);
    let eye = world.wires[0].nodes[0].position;
    let exact = at(1.0 - libm::sin(1.0), libm::cos(1.0), 0.0);
    assert!((eye - exact).norm() < 1e-12);
    assert!(world.wires[0].nodes[4].position.x > 0.1);
}

#[test]
fn structure_of_the_system_is_used_again_while_it_stands() {
    let mut world = hung(100.0, 0.5);
    let mut last = world.step(&[]).unwrap();
    for _ in 0..20 {
        // The second way to the same step: nothing remembered.
        let mut fresh = world.clone();
        fresh.cache.structures.clear();
        let afresh = fresh.step(&[]).unwrap();
        last = world.step(&[]).unwrap();
        assert_eq!(last.wires, afresh.wires);
    }
    assert!(last.solver.residual < 1e-12 && last.solver.factorisations == 1);
}

#[test]
fn contact_between_things_that_nothing_moves_pushes_nothing() {
    let mut world = World::new(Settings::default()).unwrap();
    let shape = Shape::Sphere { radius: 0.1 };
    let body = BodyPlan::fixed(shape, Point::origin());
    let body = world.add_body(body).unwrap();
    let route = [0.0, 1.0].map(|x| Stop::Free(Point::new(x, 0.0, 0.0)));
    let plan = WirePlan::new(Material::steel(0.02), 0.25, route.to_vec());
    world.add_wire(&plan).unwrap();
    let contact = ContactConstraint {
        key: 1,
        a: ContactSite::Body {
            body,
            local: Vector::zeros(),
        },
        b: ContactSite::World,
        normal: Vector::z(),
        gap: -0.01,
        friction: 0.5,
    };
    let record = world.step(&[contact]).unwrap();
    assert_eq!(record.contacts[0].force, Vector::zeros());
}
