use super::*;
use crate::query::Point;
use crate::wire::{
    BodyPlan, Collisions, Material, Settings, Shape, StepRecord, Stop, Vector, WirePlan,
};

/// What is put into a world, `x` aside.
#[derive(Clone, Copy, Debug)]
enum Thing {
    /// A floor of its own.
    Floor,
    /// Four wires across four, above a floor.
    Net,
    /// A chain of which a ball hangs, from a pin.
    Pendulum,
    /// Two balls, one of which falls on the other.
    Balls,
    /// A chain that falls across a wire between pins.
    Crossed,
}

const THINGS: [Thing; 4] = [Thing::Net, Thing::Pendulum, Thing::Balls, Thing::Crossed];

fn ball(world: &mut World, x: f64, z: f64) -> BodyId {
    let shape = Shape::Sphere { radius: 0.1 };
    let plan = BodyPlan::dynamic(shape, 800.0, Point::new(x, 0.0, z));
    world.add_body(plan).unwrap()
}

fn wire(world: &mut World, material: Material, resolution: f64, route: Vec<Stop>) {
    world
        .add_wire(&WirePlan::new(material, resolution, route))
        .unwrap();
}

impl Thing {
    fn add(self, world: &mut World, x: f64) {
        let at = |dx: f64, y: f64, z: f64| Point::new(x + dx, y, z);
        match self {
            Thing::Floor => {
                let plan = BodyPlan::fixed(Shape::Plane, at(0.0, 0.0, 0.0));
                world.add_body(plan).unwrap();
            }
            Thing::Net => {
                for k in 0..4 {
                    let aside = 0.1 * f64::from(k) + 0.05;
                    for (from, to) in [
                        (at(0.0, aside, 0.01), at(0.4, aside, 0.01)),
                        (at(aside, 0.0, 0.03), at(aside, 0.4, 0.03)),
                    ] {
                        let route = vec![Stop::Free(from), Stop::Free(to)];
                        wire(world, Material::steel(0.005), 0.1, route);
                    }
                }
            }
            Thing::Pendulum => {
                let body = ball(world, x + 0.5, 2.0);
                let local = Vector::zeros();
                let route = vec![Stop::Pinned(at(0.0, 0.0, 2.0)), Stop::Eye { body, local }];
                wire(world, Material::steel(0.002).chain(), 0.1, route);
            }
            Thing::Balls => {
                ball(world, x, 0.11);
                ball(world, x + 0.01, 0.4);
            }
            Thing::Crossed => {
                let ends = [-0.5, 0.5].map(|y| Stop::Pinned(at(0.0, y, 1.0)));
                wire(world, Material::steel(0.003), 0.1, ends.to_vec());
                let ends = [-0.5, 0.5].map(|dx| Stop::Free(at(dx, 0.01, 1.05)));
                wire(world, Material::steel(0.003).chain(), 0.1, ends.to_vec());
            }
        }
    }
}

fn world_of(things: &[(Thing, f64)]) -> World {
    let mut world = World::new(Settings::default()).unwrap();
    Thing::Floor.add(&mut world, 0.0);
    for (thing, x) in things {
        thing.add(&mut world, *x);
    }
    world
}

fn run(world: &mut World, steps: usize) -> Vec<StepRecord> {
    let mut collisions = Collisions::default();
    (0..steps)
        .map(|_| world.step_colliding(&mut collisions, &[]).unwrap())
        .collect()
}

#[test]
fn wires_bodies_and_contacts_that_nothing_ties_are_islands() {
    let mut world = world_of(&THINGS.map(|thing| (thing, 0.0)));
    let list = |contacts: &[ContactConstraint]| -> Vec<(Vec<usize>, Vec<usize>, Vec<usize>)> {
        let islands = islands(&world, contacts).into_iter();
        islands
            .map(|island| (island.wires, island.bodies, island.contacts))
            .collect()
    };
    // Each wire of the net, the pendulum with its ball, two more wires, two balls.
    let alone = list(&[]);
    assert_eq!(alone.len(), 8 + 1 + 2 + 2);
    assert_eq!(alone[8], (vec![8], vec![1], vec![]));
    assert_eq!(alone[12], (vec![], vec![3], vec![]));
    let body = |at: usize| ContactSite::Body {
        body: BodyId(at),
        local: Vector::zeros(),
    };
    let on = |wire: usize| ContactSite::Wire {
        wire: WireId(wire),
        arc: 0.1,
    };
    let contact = |a, b| ContactConstraint {
        key: 1,
        a,
        b,
        normal: Vector::z(),
        gap: 0.0,
        friction: 0.5,
    };
    // The floor ties nothing together, the ball of the pendulum does, and nothing moves a floor.
    let tied = list(&[
        contact(on(0), body(0)),
        contact(on(3), body(0)),
        contact(body(0), ContactSite::World),
        contact(body(3), on(8)),
        contact(on(0), on(7)),
    ]);
    assert_eq!(tied.len(), alone.len() - 2);
    assert_eq!(tied[0], (vec![0, 7], vec![0], vec![0, 4]));
    assert_eq!(tied[3], (vec![3], vec![0], vec![1]));
    assert_eq!(tied[7], (vec![8], vec![1, 3], vec![3]));
    world.wires.truncate(1);
    world.bodies.truncate(1);
    let one = islands(&world, &[contact(body(0), ContactSite::World)]);
    assert_eq!(one.len(), 1);
    assert!(one[0].is_whole && one[0].contacts == [0]);
}

#[test]
fn islands_do_not_change_each_other() {
    // Powers of two beside each other, so that places differ by no rounding.
    let places: Vec<f64> = (0..4).map(|k| 8.0 * f64::from(k)).collect();
    let all: Vec<_> = THINGS.into_iter().zip(places).collect();
    let mut together = world_of(&all);
    let records = run(&mut together, 60);
    assert!(records.iter().all(|record| record.solver.residual < 1e-10));
    let touching = records.iter().filter(|record| record.contacts.len() > 16);
    assert!(touching.count() > 20);
    let (mut wires, mut bodies) = (together.wires.iter(), together.bodies.iter().skip(1));
    for one in all {
        let mut alone = world_of(&[one]);
        run(&mut alone, 60);
        for own in &alone.wires {
            assert_eq!(wires.next().unwrap().nodes, own.nodes, "{one:?}");
        }
        for own in &alone.bodies[1..] {
            let other = bodies.next().unwrap();
            assert_eq!(other.position, own.position, "{one:?}");
            assert_eq!(other.velocity, own.velocity, "{one:?}");
        }
    }
    assert!(wires.next().is_none() && bodies.next().is_none());
}

#[test]
fn islands_share_what_a_step_may_spend() {
    let mut world = world_of(&[(Thing::Net, 0.0), (Thing::Balls, 8.0)]);
    run(&mut world, 30);
    let mut spent = world.clone();
    spent.settings.work = 0;
    let records = run(&mut spent, 10);
    assert!(records.iter().all(|record| record.solver.cut_short));
    let records = run(&mut world, 10);
    assert!(!records.iter().any(|record| record.solver.cut_short));
}
