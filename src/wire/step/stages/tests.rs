use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::*;
use crate::wire::model::{BodyPlan, Drive, Phase, Shape};
use crate::wire::settings::Settings;

fn vector(rng: &mut ChaCha8Rng, size: f64) -> Vector {
    Vector::from_fn(|_, _| rng.random_range(-size..=size))
}

/// Rods of 1 m, about half of them scripted, and how each moves in a step.
fn rods(rng: &mut ChaCha8Rng) -> (World, Vec<Mover>) {
    let mut world = World::new(Settings::default()).unwrap();
    let half = Vector::new(0.5, 0.01, 0.01);
    let movers = (0..6).map(|body| {
        let at = Point::from(vector(rng, 3.0));
        let plan = match rng.random_bool(0.5) {
            true => BodyPlan::dynamic(Shape::Box { half }, 1000.0, at),
            false => BodyPlan {
                drive: Drive::Kinematic(vec![Phase {
                    from: 0.0,
                    velocity: Vector::zeros(),
                    angular_velocity: Vector::zeros(),
                }]),
                ..BodyPlan::fixed(Shape::Box { half }, at)
            },
        };
        world.add_body(plan).unwrap();
        let spin = [0.0, 30.0, 300.0, 1000.0][rng.random_range(0..4)];
        Mover {
            body,
            end: at + vector(rng, 1.0),
            angular_velocity: Vector::z() * spin,
        }
    });
    let movers = movers.collect();
    (world, movers)
}

/// Whether the balls around two bodies meet at one of many times, made larger by a factor.
fn meet(world: &World, movers: [&Mover; 2], factor: f64) -> bool {
    let place = |mover: &Mover, t: f64| {
        let from = world.bodies[mover.body].position;
        from + (mover.end - from) * t
    };
    let reach = 2.0 * (0.25f64 + 2e-4).sqrt() * factor;
    (0..=500).map(|k| f64::from(k) / 500.0).any(|t| {
        let [a, b] = movers.map(|mover| place(mover, t));
        (a - b).norm() <= reach
    })
}

/// The same as [`stages`] by looking at many times: what meets, and what those meet.
fn by_looking(world: &World, movers: &[Mover], factor: f64) -> Vec<u32> {
    let own = |mover: &Mover| stages(world, std::slice::from_ref(mover))[0];
    let moved = |mover: &Mover| world.bodies[mover.body].dynamic;
    let is_near = |a: usize, b: usize| {
        let two = [&movers[a], &movers[b]];
        two.iter().any(|mover| moved(mover)) && meet(world, two, factor)
    };
    let together = |a: usize| {
        let mut found = vec![a];
        let mut at = 0;
        while at < found.len() {
            let new = (0..movers.len()).filter(|b| !found.contains(b) && is_near(found[at], *b));
            let new: Vec<usize> = new.collect();
            found.extend(new);
            at += 1;
        }
        found
    };
    let most = |a: usize| together(a).into_iter().map(|b| own(&movers[b])).max();
    (0..movers.len()).filter_map(most).collect()
}

#[test]
fn bodies_that_may_meet_have_the_same_stages_and_others_their_own() {
    let rng = &mut ChaCha8Rng::seed_from_u64(61);
    let (mut shared, mut apart) = (0, 0);
    for _ in 0..300 {
        let (world, movers) = rods(rng);
        let found = stages(&world, &movers);
        // A little nearer and a little farther than the slack.
        let bounds = [0.999, 1.01].map(|factor| by_looking(&world, &movers, factor));
        for (body, count) in found.iter().enumerate() {
            assert!(bounds[0][body] <= *count && *count <= bounds[1][body]);
        }
        let own = movers
            .iter()
            .map(|m| stages(&world, std::slice::from_ref(m))[0]);
        let own: Vec<u32> = own.collect();
        let all = own.iter().max();
        shared += found.iter().zip(&own).filter(|(a, b)| a > b).count();
        apart += found.iter().filter(|count| Some(*count) < all).count();
    }
    assert!(shared > 40 && apart > 400, "{shared} {apart}");
}

#[test]
fn planes_and_what_is_not_finite_are_near_everything() {
    let mut world = World::new(Settings::default()).unwrap();
    let at = Point::origin();
    let ball = Shape::Sphere { radius: 0.1 };
    world
        .add_body(BodyPlan::dynamic(ball.clone(), 1000.0, at))
        .unwrap();
    world.add_body(BodyPlan::fixed(Shape::Plane, at)).unwrap();
    let far = Point::new(1e9, 0.0, 0.0);
    world
        .add_body(BodyPlan::dynamic(ball, 1000.0, far))
        .unwrap();
    let mover = |body: usize, end: Point, spin: f64| Mover {
        body,
        end,
        angular_velocity: Vector::x() * spin,
    };
    let step = world.settings.step;
    let spinning = mover(0, at, 3.0 * TURN / step);
    let stages = |other: Mover| stages(&world, &[mover(0, at, spinning.angular_velocity.x), other]);
    assert_eq!(stages(mover(1, at, 0.0)), [3, 3]);
    assert_eq!(stages(mover(2, far, 0.0)), [3, 1]);
    assert_eq!(
        stages(mover(2, Point::new(f64::NAN, 0.0, 0.0), 0.0)),
        [3, 3]
    );
    // What turns too much for stages asks for none.
    assert_eq!(stages(mover(1, at, 1e3 * f64::from(MOST_STAGES))), [3, 3]);
}
