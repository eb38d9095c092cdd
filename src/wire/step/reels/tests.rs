use crate::query::Point;
use crate::wire::model::wire::LEAST;
use crate::wire::{
    BodyPlan, Material, ModelError, ReelPhase, Settings, Shape, Stop, Vector, WireId, WirePlan,
    World,
};

/// A ball of 50 kg that hangs on 2 m of wire, whose upper end is on a reel.
fn hanging(phases: Vec<ReelPhase>) -> World {
    let mut world = World::new(Settings::default()).unwrap();
    let shape = Shape::Sphere { radius: 0.1 };
    let density = 50.0 / shape.mass_properties(1.0).unwrap().mass;
    let start = Point::new(0.0, 0.0, -2.0);
    let body = world
        .add_body(BodyPlan::dynamic(shape, density, start))
        .unwrap();
    let local = Vector::zeros();
    let route = vec![Stop::Eye { body, local }, Stop::Pinned(Point::origin())];
    let plan = WirePlan::new(Material::steel(0.002), 0.25, route).reeled(phases);
    world.add_wire(&plan).unwrap();
    world
}

fn always(speed: f64) -> Vec<ReelPhase> {
    vec![ReelPhase { from: 0.0, speed }]
}

/// The resolution goes with it: no segment is longer than twice the resolution and what is let out
/// until it may change again, nor shorter than half.
#[test]
fn segments_are_put_in_and_taken_out_at_a_reel() {
    for (speed, length) in [(0.5, 3.5), (-0.5, 0.5)] {
        let mut world = hanging(always(speed));
        for _ in 0..180 {
            world.step(&[]).unwrap();
            let wire = &world.wires()[0];
            for segment in 0..wire.segments().len() {
                let rest = wire.rest_length(segment);
                assert!(rest > 0.11 && rest < 0.8, "{rest} of {segment}");
            }
        }
        let wire = &world.wires()[0];
        assert!((wire.length() - length).abs() < 1e-9, "{}", wire.length());
        assert_eq!(wire.nodes().last().unwrap().slide, speed);
        assert!((world.bodies()[0].position().z + length).abs() < 0.01);
        world.set_reel(WireId(0), Vec::new()).unwrap();
        world.step(&[]).unwrap();
        assert_eq!(world.wires()[0].nodes().last().unwrap().slide, 0.0);
        assert!((world.wires()[0].length() - length).abs() < 1e-9);
    }
}

/// A reel that hauls in for ever waits where there is no node left to be taken out.
#[test]
fn what_is_hauled_in_whole_waits() {
    let mut world = hanging(always(-1.0));
    for _ in 0..400 {
        world.step(&[]).unwrap();
    }
    let wire = &world.wires()[0];
    assert_eq!(wire.segments().len(), 1);
    let least = LEAST * wire.resolution().length;
    assert!(wire.length() >= least * (1.0 - 1e-9) && wire.length() < 1.01 * least);
    assert!(world.bodies()[0].velocity().norm() < 0.05);
    // Let out again.
    world.set_reel(WireId(0), always(1.0)).unwrap();
    let start = world.wires()[0].length();
    for _ in 0..60 {
        world.step(&[]).unwrap();
    }
    assert!((world.wires()[0].length() - start - 1.0).abs() < 1e-9);
}

/// A phase takes effect with the step that starts nearest to it.
#[test]
fn phases_of_a_reel_follow_each_other() {
    let step = Settings::default().step;
    let phase = |steps: f64, speed| ReelPhase {
        from: steps * step,
        speed,
    };
    let mut world = hanging(vec![phase(2.4, 0.5), phase(5.0, -0.25), phase(7.0, 0.0)]);
    let mut speeds = Vec::new();
    for _ in 0..9 {
        let before = world.wires()[0].length();
        world.step(&[]).unwrap();
        speeds.push(((world.wires()[0].length() - before) / step * 1e6).round() / 1e6);
    }
    assert_eq!(speeds, [0.0, 0.0, 0.5, 0.5, 0.5, -0.25, -0.25, 0.0, 0.0]);
}

/// Two bodies in empty space, and a reel on one of them: both come to the middle.
#[test]
fn a_reel_on_a_body_draws_both() {
    let settings = Settings::default().with_gravity(Vector::zeros());
    let mut world = World::new(settings).unwrap();
    let shape = Shape::Sphere { radius: 0.1 };
    let density = 10.0 / shape.mass_properties(1.0).unwrap().mass;
    let mut eye = |x: f64| {
        let start = Point::new(x, 0.0, 0.0);
        let plan = BodyPlan::dynamic(shape.clone(), density, start);
        let body = world.add_body(plan).unwrap();
        Stop::Eye {
            body,
            local: Vector::zeros(),
        }
    };
    let route = vec![eye(-2.0), eye(2.0)];
    let plan = WirePlan::new(Material::steel(0.001), 0.25, route).reeled(always(-0.5));
    world.add_wire(&plan).unwrap();
    for _ in 0..120 {
        world.step(&[]).unwrap();
    }
    let [left, right] = [0, 1].map(|body| world.bodies()[body].position().x);
    assert!((right - left - 3.0).abs() < 0.01, "{left} {right}");
    // 0.1 kg of wire go with one of them, beside 20 kg.
    assert!((left + right).abs() < 0.05, "{left} {right}");
}

#[test]
fn reels_are_refused_that_mean_nothing() {
    let mut world = hanging(Vec::new());
    let mut said = |phases: Vec<ReelPhase>| {
        let before = world.wires().to_vec();
        let error = world.set_reel(WireId(0), phases).unwrap_err();
        assert_eq!(world.wires(), before);
        error.to_string()
    };
    let phase = |from, speed| ReelPhase { from, speed };
    assert_eq!(
        said(vec![phase(1.0, 0.5), phase(1.0, 0.0)]),
        "phase 2 of the reel starts at 1 s, it must start after phase 1, which starts at 1 s"
    );
    assert_eq!(said(always(f64::NAN)), "speed is NaN, it must be finite");
    assert_eq!(
        said(vec![phase(f64::INFINITY, 0.0)]),
        "from is inf, it must be finite"
    );
    assert_eq!(
        said(always(-1001.0)),
        "speed is -1001, it must be at most 1000 m/s either way"
    );
    let missing = world.set_reel(WireId(1), always(1.0));
    assert_eq!(missing, Err(ModelError::Wire { index: 1, count: 1 }));
    let at = |x: f64| Point::new(x, 0.0, 0.0);
    let free = vec![Stop::Pinned(at(0.0)), Stop::Free(at(1.0))];
    let plan = WirePlan::new(Material::steel(0.002), 0.25, free).reeled(always(1.0));
    assert_eq!(world.add_wire(&plan), Err(ModelError::ReelAtFreeEnd));
    let clamped = [0.0, 1.0, 1.25].map(|x| Stop::Pinned(at(x)));
    let plan = WirePlan::new(Material::steel(0.002), 0.25, clamped.to_vec()).reeled(always(1.0));
    assert_eq!(world.add_wire(&plan), Err(ModelError::ReelAtClamp));
}
