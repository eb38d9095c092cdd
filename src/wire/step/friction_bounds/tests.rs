use super::*;
use crate::query::Point;
use crate::wire::step::active_set::find_active_set;
use crate::wire::step::order::by_wires;
use crate::wire::world::World;
use crate::wire::{BodyPlan, Material, Settings, Shape, Stop, Vector, WirePlan};

/// A chain half around a fixed drum, with a load at each end.
fn over_a_drum(friction: f64, masses: [f64; 2]) -> World {
    const NODES: u32 = 9;
    let mut world = World::new(Settings::default()).unwrap();
    let shape = Shape::Sphere { radius: 0.5 };
    let drum = world
        .add_body(BodyPlan::fixed(shape, Point::origin()))
        .unwrap();
    let stops = (0..NODES).map(|i| {
        let angle = std::f64::consts::PI * (f64::from(i) + 0.5) / f64::from(NODES);
        let normal = Vector::new(-libm::cos(angle), 0.0, libm::sin(angle));
        Stop::Contact {
            body: drum,
            local: normal * 0.5,
            normal,
            friction,
        }
    });
    let mut route: Vec<Stop> = stops.collect();
    for (mass, x) in masses.into_iter().zip([-0.49, 0.49]) {
        let shape = Shape::Box {
            half: Vector::repeat(0.5),
        };
        let plan = BodyPlan::dynamic(shape, mass, Point::new(x, 0.0, -3.0));
        let body = world.add_body(plan).unwrap();
        let local = Vector::zeros();
        let at = if x < 0.0 { 0 } else { route.len() };
        route.insert(at, Stop::Eye { body, local });
    }
    let plan = WirePlan::new(Material::steel(0.005).chain(), 10.0, route);
    world.add_wire(&plan).unwrap();
    world
}

/// The bounds of friction after the first steps, found by `update` for given bounds.
fn bounds(world: &World, mut update: impl FnMut(&mut System, &[f64])) -> (Vec<f64>, usize) {
    let mut system = System::new(world, &by_wires(world), None);
    system.factor().unwrap();
    let mut x = system.start(world);
    for updates in 0..2000 {
        x = find_active_set(&mut system, &[], x).unwrap().x;
        if !capstan::bounds_differ(&system.rows, &x) {
            let found = system.rows.iter().filter_map(|row| row.law.bounds(&x));
            return (found.map(|[bound, _]| bound).collect(), updates);
        }
        update(&mut system, &x);
    }
    panic!("{}", capstan::bound_residual(&system.rows, &x));
}

#[test]
fn bounds_are_those_that_follow_from_tensions_again_and_again() {
    for friction in [0.1, 0.3] {
        let mut world = over_a_drum(friction, [20.0, 30.0 + 100.0 * friction]);
        for _ in 0..20 {
            world.step(&[]).unwrap();
        }
        let (found, _) = bounds(&world, |system, x| update(system, x, false));
        let (expected, _) = bounds(&world, |system, x| {
            capstan::update_bounds(&mut system.rows, x);
        });
        assert!(found.len() == 9 && found.iter().all(|&bound| bound > 0.0));
        for (found, expected) in found.iter().zip(&expected) {
            assert!((found / expected - 1.0).abs() < 1e-7, "{found} {expected}");
        }
    }
}

#[test]
fn elimination_solves_and_tells_what_is_singular() {
    let matrix = vec![
        vec![0.0, 2.0, 1.0],
        vec![1.0, 0.0, -1.0],
        vec![3.0, 1.0, 0.0],
    ];
    assert_eq!(
        solve(matrix, vec![7.0, -2.0, 5.0]),
        Some(vec![1.0, 2.0, 3.0])
    );
    assert_eq!(
        solve(vec![vec![1.0, 2.0], vec![2.0, 4.0]], vec![1.0, 1.0]),
        None
    );
}
