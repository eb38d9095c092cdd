//! Scenes with known outcomes.

use super::segment::Closest;
use super::thickness::Thickness;
use super::wire_contacts::WireContacts;
use super::*;
use crate::broad::Method;
use crate::certified::Certified;
use crate::query::Point;
use crate::wire::error::CollisionError;
use crate::wire::record::CrossingOutcome;
use crate::wire::site::SegmentId;
use crate::wire::{
    BodyId, BodyPlan, Drive, Material, Phase, Reason, Remesh, RemeshKind, Settings, Shape, Stop,
    Vector, WireId, WirePlan,
};

/// Scene 1 of the thesis (4.2.1.1): a wire falls on two others at 10 m/s.
fn basic_collision() -> World {
    let mut world = World::new(Settings::default()).unwrap();
    for x in [-0.5, 0.5] {
        let fixed = straight([x, -1.0, 0.0], [x, 1.0, 0.0], Stop::Pinned);
        world.add_wire(&fixed).unwrap();
    }
    let mut falling = straight([-1.0, 0.0, 0.1], [1.0, 0.0, 0.1], Stop::Free);
    falling.velocity = Vector::new(0.0, 0.0, -10.0);
    world.add_wire(&falling).unwrap();
    world
}

fn weightless() -> World {
    let gravity = Vector::zeros();
    World::new(Settings {
        gravity,
        ..Settings::default()
    })
    .unwrap()
}

fn straight(from: [f64; 3], to: [f64; 3], stop: fn(Point) -> Stop) -> WirePlan {
    let route = [from, to].map(|point| stop(point.into()));
    WirePlan::new(Material::steel(0.02), 0.25, route.to_vec())
}

/// `cli/src/rows` has how many of each; here is their order.
#[test]
fn basic_collision_in_thesis_mode_tunnels_twice_and_is_pushed_back_twice() {
    let mut world = basic_collision();
    let mut collisions = Collisions::new(Mode::Thesis, Method::default(), &Certified);
    let mut all = Vec::new();
    for _ in 0..300 {
        let record = world.step_colliding(&mut collisions, &[]).unwrap();
        let crossings = record.collisions.crossings.iter();
        all.extend(crossings.map(|crossing| crossing.outcome));
    }
    use CrossingOutcome::{Returned, Tunnelled};
    assert_eq!(all, [Tunnelled, Tunnelled, Returned, Returned]);
}

#[test]
fn broad_phases_lead_to_the_same_bits() {
    let run = |method| {
        let mut world = basic_collision();
        let mut collisions = Collisions::new(Mode::Guard, method, &Certified);
        let step = |_| world.step_colliding(&mut collisions, &[]).unwrap();
        let records: Vec<StepRecord> = (0..60).map(step).collect();
        let wires = records
            .into_iter()
            .map(|record| (record.wires, record.collisions));
        wires.collect::<Vec<_>>()
    };
    let [sweep, grid, brute] = [
        Method::SweepAndPrune,
        Method::HierarchicalGrid,
        Method::BruteForce,
    ]
    .map(run);
    assert!(sweep == grid && grid == brute);
}

#[test]
fn wire_does_not_pass_through_itself() {
    // A chain in the form of an alpha; its free end is thrown at the other one, which is fixed.
    let mut world = weightless();
    let points = [
        [0.0, 0.0, 0.0],
        [2.0, 0.0, 0.0],
        [2.0, 1.0, 0.2],
        [0.9, 1.0, 0.2],
        [0.9, -0.5, 0.2],
    ];
    let mut route = points.map(|point| Stop::Free(point.into()));
    for fixed in [0, 1] {
        route[fixed] = Stop::Pinned(points[fixed].into());
    }
    let mut plan = WirePlan::new(Material::steel(0.02).chain(), 3.0, route.to_vec());
    plan.velocity = Vector::new(0.0, 0.0, -20.0);
    world.add_wire(&plan).unwrap();
    let mut collisions = Collisions::default();
    let mut prevented = 0;
    for _ in 0..3 {
        let record = world.step_colliding(&mut collisions, &[]).unwrap();
        prevented += record.collisions.crossings.len();
        let [from, to] = [3, 4].map(|node| world.wires()[0].nodes()[node].position);
        let over = from.lerp(&to, from.y / (from.y - to.y));
        assert!(over.z > 0.039, "{over}");
    }
    assert!(prevented > 0);
}

/// A taut wire between two scripted balls that go down through a fixed taut wire.
fn forced(world: &mut World) {
    // One segment each: nothing gives way.
    let fixed = [-1.0, 1.0].map(|y| Stop::Pinned(Point::new(0.0, y, 0.0)));
    let wire = |route: [Stop; 2]| WirePlan::new(Material::steel(0.02), 3.0, route.to_vec());
    world.add_wire(&wire(fixed)).unwrap();
    let route = [-1.0, 1.0].map(|x| {
        let down = Phase {
            from: 0.0,
            velocity: Vector::new(0.0, 0.0, -400.0),
            angular_velocity: Vector::zeros(),
        };
        let body = world.add_body(BodyPlan {
            drive: Drive::Kinematic(vec![down]),
            ..BodyPlan::fixed(Shape::Sphere { radius: 0.1 }, Point::new(x, 0.0, 0.5))
        });
        let local = Vector::zeros();
        Stop::Eye {
            body: body.unwrap(),
            local,
        }
    });
    world.add_wire(&wire(route)).unwrap();
}

#[test]
fn scripted_bodies_that_force_a_crossing_are_held_and_named() {
    let mut world = weightless();
    forced(&mut world);
    let mut collisions = Collisions::default();
    let mut held = Vec::new();
    for _ in 0..5 {
        let record = world.step_colliding(&mut collisions, &[]).unwrap();
        held.extend(record.collisions.scaled_islands);
        assert!(
            world.wires()[1]
                .nodes()
                .iter()
                .all(|node| node.position.z > 0.0)
        );
    }
    let first = held.first().expect("the script is not followed");
    assert_eq!(first.behind, [BodyId(0), BodyId(1)]);
    assert!(
        first.motion_scale > 0.0 && first.motion_scale < 0.1,
        "{}",
        first.motion_scale
    );
}

#[test]
fn midlines_that_touch_at_first_are_an_error_that_names_them() {
    let mut world = weightless();
    world
        .add_wire(&straight([0.0, -1.0, 0.0], [0.0, 1.0, 0.0], Stop::Pinned))
        .unwrap();
    world
        .add_wire(&straight([-1.0, 0.1, 0.0], [1.0, 0.1, 0.0], Stop::Free))
        .unwrap();
    let before = world.clone();
    let error = world
        .step_colliding(&mut Collisions::default(), &[])
        .unwrap_err();
    assert!(matches!(
        error.reason,
        Reason::Collision(CollisionError::Touching { .. })
    ));
    assert_eq!(before.wires(), world.wires());
    assert_eq!(
        error.to_string(),
        "step 0: wires cannot be kept apart: the midlines of wire 0 at 1.1 m and wire 1 at 1 m \
        touch before the step"
    );
}

#[test]
fn wires_at_one_eye_are_not_tested_against_each_other_there() {
    let mut world = weightless();
    let body = world.add_body(BodyPlan::fixed(
        Shape::Sphere { radius: 0.1 },
        Point::origin(),
    ));
    let eye = Stop::Eye {
        body: body.unwrap(),
        local: Vector::zeros(),
    };
    for x in [-1.0, 1.0] {
        let route = vec![eye, Stop::Free(Point::new(x, 0.0, 1.0))];
        world
            .add_wire(&WirePlan::new(Material::steel(0.02), 0.25, route))
            .unwrap();
    }
    let record = world
        .step_colliding(&mut Collisions::default(), &[])
        .unwrap();
    assert!(record.collisions.crossings.is_empty());
}

#[test]
fn change_of_resolution_is_refused_exactly_where_its_triangle_meets_a_segment() {
    let mut world = weightless();
    world
        .add_wire(&straight([0.0, 0.0, 0.0], [2.0, 0.0, 0.0], Stop::Free))
        .unwrap();
    for (x, z) in [(1.0, 0.0), (-0.1, 0.0), (1.0, 0.31)] {
        let from = [x, 0.1, z - 0.3];
        world
            .add_wire(&straight(from, [x, 0.1, z + 0.3], Stop::Free))
            .unwrap();
    }
    let change = Remesh {
        wire: WireId(0),
        kind: RemeshKind::Merge,
        triangle: [[0.0, 0.0, 0.0], [1.0, 0.3, 0.0], [2.0, 0.0, 0.0]].map(Point::from),
        arcs: [0.0, 1.0, 2.0],
    };
    let met = |only: usize| {
        let filter = |_: SegmentId, b: SegmentId| b.wire.0 == only;
        remesh::meets(&world, &change, Some(&filter), Thickness::default()).unwrap()
    };
    assert_eq!([1, 2, 3].map(met), [true, false, false]);
}

#[test]
fn contact_slides_along_the_material_over_nodes_and_keeps_its_key() {
    let mut world = weightless();
    world
        .add_wire(&straight([0.0, -1.0, 0.0], [0.0, 1.0, 0.0], Stop::Pinned))
        .unwrap();
    let mut plan = straight([-0.9, -0.6, 0.03], [1.1, -0.6, 0.03], Stop::Free);
    plan.velocity = Vector::new(0.0, 3.0, 0.0);
    world.add_wire(&plan).unwrap();
    let mut collisions = Collisions::default().with_friction(0.0).unwrap();
    let mut keys = Vec::new();
    let mut arcs = Vec::new();
    for _ in 0..20 {
        let record = world.step_colliding(&mut collisions, &[]).unwrap();
        keys.extend(record.contacts.iter().map(|c| c.contact.key));
        arcs.extend(fixed_arcs(&record));
    }
    keys.dedup();
    assert_eq!(keys.len(), 1);
    // From 0.45 m to 1.35 m, over three nodes.
    assert!(arcs.windows(2).all(|two| two[0] < two[1]), "{arcs:?}");
    assert!(arcs[arcs.len() - 1] - arcs[0] > 0.75, "{arcs:?}");
}

fn fixed_arcs(record: &StepRecord) -> impl Iterator<Item = f64> {
    record
        .contacts
        .iter()
        .filter_map(|record| match record.contact.a {
            crate::wire::ContactSite::Wire {
                wire: WireId(0),
                arc,
            } => Some(arc),
            _ => None,
        })
}

#[test]
fn side_is_counted_and_not_read_from_positions() {
    let mut world = weightless();
    world
        .add_wire(&straight([0.0, -1.0, 0.0], [0.0, 1.0, 0.0], Stop::Pinned))
        .unwrap();
    world
        .add_wire(&straight([-1.0, 0.1, 0.01], [1.0, 0.1, 0.01], Stop::Free))
        .unwrap();
    let first = SegmentId {
        wire: WireId(0),
        segment: 4,
    };
    let second = SegmentId {
        wire: WireId(1),
        segment: 3,
    };
    let sites = [first.site(&world, 0.4), second.site(&world, 1.0)];
    let mut touches = WireContacts::default();
    for (wrong, z, gap) in [(false, -1.0, -0.03), (true, 1.0, -0.05)] {
        let mut touch = touches.make(sites, Vector::z());
        touch.wrong = wrong;
        let mut one = WireContacts::default();
        one.add(&world, Thickness::default(), [touch]);
        one.refresh(&world, Thickness::default());
        let contact = one.contacts(0.5).next().unwrap();
        assert!((contact.normal - Vector::z() * z).norm() < 1e-12);
        assert!((contact.gap - gap).abs() < 1e-12);
    }
    let closest = Closest::of(&world, [first, second]);
    assert!((closest.distance() - 0.01).abs() < 1e-15);
}

#[test]
fn passage_at_the_border_of_two_steps_is_a_tunnel() {
    // Nothing gives way, so nothing is pushed back: three eyes of a scripted body and three pins.
    let step = 0.0625;
    let mut world = World::new(Settings {
        gravity: Vector::zeros(),
        step,
        ..Settings::default()
    })
    .unwrap();
    let places = [-1.0, 0.0, 1.0];
    let wire = |route: [Stop; 3]| WirePlan::new(Material::steel(0.02), 3.0, route.to_vec());
    let fixed = places.map(|y| Stop::Pinned(Point::new(0.0, y, 0.0)));
    world.add_wire(&wire(fixed)).unwrap();
    let down = Phase {
        from: 0.0,
        velocity: Vector::new(0.0, 0.0, -0.5 / step),
        angular_velocity: Vector::zeros(),
    };
    let body = world
        .add_body(BodyPlan {
            drive: Drive::Kinematic(vec![down]),
            ..BodyPlan::fixed(Shape::Sphere { radius: 0.1 }, Point::new(0.0, 0.0, 0.5))
        })
        .unwrap();
    let eyes = places.map(|x| Stop::Eye {
        body,
        local: Vector::new(x, 0.0, 0.0),
    });
    world.add_wire(&wire(eyes)).unwrap();
    let mut collisions =
        Collisions::new(Mode::Thesis, Method::default(), &Certified).without_bodies();
    let mut outcomes = Vec::new();
    for expected in [0.0, -0.5, -1.0] {
        let record = world.step_colliding(&mut collisions, &[]).unwrap();
        assert_eq!(record.wires[1].after[1].z, expected);
        let crossings = record.collisions.crossings.iter();
        outcomes.push(crossings.map(|c| c.outcome).collect::<Vec<_>>());
    }
    use CrossingOutcome::{Grazed, Tunnelled};
    assert_eq!(outcomes, [vec![Grazed], vec![Tunnelled], vec![]]);
}

/// A wire over another one that has two crests, so far apart.
fn crests(apart: f64) -> (World, [[f64; 2]; 2]) {
    let mut world = weightless();
    let route = [-1.0, 1.0].map(|x| Stop::Free(Point::new(x, 0.0, 0.045)));
    let mut plan = WirePlan::new(Material::steel(0.02).chain(), 10.0, route.to_vec());
    plan.resolution.adaptive = false;
    world.add_wire(&plan).unwrap();
    let at = apart / 2.0;
    let under = [
        [-1.0, -1.0],
        [-at, 0.0],
        [0.0, -0.001],
        [at, 0.0],
        [1.0, -1.0],
    ];
    plan.route = under
        .map(|[x, z]| Stop::Free(Point::new(x, 0.0, z)))
        .to_vec();
    world.add_wire(&plan).unwrap();
    let arc = |node: usize| world.wires()[1].nodes()[node].arc;
    let places = [[1.0 - at, arc(1)], [1.0 + at, arc(3)]];
    (world, places)
}

#[test]
fn contacts_become_one_only_when_they_are_far_nearer_than_new_ones_may_be() {
    let spacing = 0.04;
    let mut seen = Vec::new();
    for (apart, stay, may_come) in [
        (0.3, 1, false),
        (0.45, 1, false),
        (0.9, 2, false),
        (1.2, 2, true),
    ] {
        let (world, places) = crests(apart * spacing);
        let sites = places.map(|arcs| {
            let site = |wire: usize| crate::wire::site::WireSite {
                wire: WireId(wire),
                arc: arcs[wire],
            };
            [site(0), site(1)]
        });
        let mut contacts = WireContacts::default();
        let [first, second] = sites.map(|sites| contacts.make(sites, Vector::z()));
        contacts.list = vec![first.clone(), second.clone()];
        contacts.refresh(&world, Thickness::default());
        seen.push(contacts.list.len());
        assert_eq!(contacts.list.len(), stay, "{apart}: {:?}", contacts.list);
        contacts.list = vec![first];
        contacts.add(&world, Thickness::default(), [second]);
        assert_eq!(contacts.list.len() == 2, may_come, "{apart}");
    }
    assert_eq!(seen, [1, 1, 2, 2]);
}

/// More contacts than the Schur complement is formed for: wires side by side on a floor, and as many across.
#[test]
fn many_contacts_come_to_rest() {
    const COUNT: usize = 16;
    let mut world = World::new(Settings::default()).unwrap();
    world
        .add_body(BodyPlan::fixed(Shape::Plane, Point::origin()))
        .unwrap();
    let length = 0.05 * COUNT as f64;
    for k in 0..COUNT {
        let at = 0.05 * (k as f64 + 0.5);
        for [from, to] in [
            [[0.0, at, 0.0051], [length, at, 0.0051]],
            [[at, 0.0, 0.0153], [at, length, 0.0153]],
        ] {
            let route = [from, to].map(|point| Stop::Free(point.into())).to_vec();
            let mut plan = WirePlan::new(Material::steel(0.005), 0.05, route);
            plan.resolution.adaptive = false;
            world.add_wire(&plan).unwrap();
        }
    }
    let mut collisions = Collisions::default();
    let mut last = None;
    for _ in 0..40 {
        last = Some(world.step_colliding(&mut collisions, &[]).unwrap());
    }
    let record = last.unwrap();
    assert!(record.contacts.len() > 256 && record.solver.sweeps == 0);
    assert!(record.solver.contact_residual < 1e-5, "{:?}", record.solver);
    let wires = world.wires().iter().flat_map(|wire| wire.nodes());
    let fastest = wires.map(|node| node.velocity.norm()).fold(0.0, f64::max);
    assert!(fastest < 1e-5, "{fastest}");
    let weight = world
        .wires()
        .iter()
        .map(|wire| wire.material.mass_per_length() * length * 9.80665);
    let weight: f64 = weight.sum();
    let carried = record
        .contacts
        .iter()
        .filter(|contact| matches!(contact.contact.b, crate::wire::ContactSite::Body { .. }));
    let carried: f64 = carried.map(|contact| contact.force.z).sum();
    assert!((carried / weight - 1.0).abs() < 1e-4, "{carried} {weight}");
}
