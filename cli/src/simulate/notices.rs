//! What a run does that its author may not have meant: wires stretched at the start, wires that leave bodies of their
//! routes, and sliding as far as a step lets it.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt;

use serde::Serialize;
use tunnelproof::wire::{NodeKind, StepRecord, Wire, World};
use tunnelproof_reference::certify::table::grouped;

use crate::scenes::Scene;

/// The part of its length by which a wire may be stretched at the start without a word.
const STRETCHED: f64 = 0.05;

/// How many times as far from a body's centre as any point of its surface an eye or a contact node may be without a word.
const FAR: f64 = 2.0;

/// An eye or a contact node that is far from the body that carries it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Far {
    /// The wire's name in the scene.
    pub wire: String,
    /// The body's name.
    pub body: String,
    /// How far it is from the centre of mass, in m.
    pub distance: f64,
    /// How far the farthest point of the body's surface is, in m.
    pub reach: f64,
}

/// A wire that starts far longer than it is unstretched.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Stretched {
    /// Its name in the scene.
    pub wire: String,
    /// By how much, as a part of its length.
    pub strain: f64,
}

/// A wire that has no contact node of its route on a body any more.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Left {
    /// Its name in the scene.
    pub wire: String,
    /// The body's name.
    pub body: String,
    /// The time at the end of the step after which there was none, in s.
    pub time: f64,
}

/// Steps in which wire would have slid farther over a contact node than its segments let it.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct HeldSlides {
    /// How many.
    pub steps: u64,
    /// The time at the end of the first one, in s.
    pub first_at: Option<f64>,
}

/// What is watched in a run.
pub(super) struct Watch {
    /// By numbers: wires with a contact node on a body.
    riding: BTreeSet<(usize, usize)>,
}

impl Watch {
    pub(super) fn of(world: &World) -> Self {
        Watch {
            riding: riding(world),
        }
    }

    /// The wires that ride on a body no longer after a step.
    pub(super) fn left(&mut self, record: &StepRecord, world: &World, scene: &Scene) -> Vec<Left> {
        let now = riding(world);
        let left: Vec<(usize, usize)> = self.riding.difference(&now).copied().collect();
        self.riding = self.riding.intersection(&now).copied().collect();
        let shown = left.into_iter().map(|(wire, body)| Left {
            wire: scene.wires[wire].name.clone(),
            body: scene.bodies[body].name.clone(),
            time: record.time,
        });
        shown.collect()
    }
}

fn riding(world: &World) -> BTreeSet<(usize, usize)> {
    let wires = world.wires().iter().enumerate();
    wires
        .flat_map(|(at, wire)| {
            let nodes = wire.nodes().iter();
            nodes.filter_map(move |node| match node.kind {
                NodeKind::Contact { body, .. } => Some((at, body.0)),
                _ => None,
            })
        })
        .collect()
}

/// The wires that are stretched where a scene starts.
pub(super) fn stretched(world: &World, scene: &Scene) -> Vec<Stretched> {
    let wires = world.wires().iter().zip(&scene.wires);
    let strained = wires.filter_map(|(wire, plan)| {
        let strain = strain(wire);
        (strain > STRETCHED).then(|| Stretched {
            wire: plan.name.clone(),
            strain,
        })
    });
    strained.collect()
}

/// The eyes and contact nodes that are far from their bodies, of each wire and body the farthest.
pub(super) fn far(world: &World, scene: &Scene) -> Vec<Far> {
    let mut farthest = BTreeMap::new();
    for (wire, of_wire) in world.wires().iter().enumerate() {
        for node in of_wire.nodes() {
            let (NodeKind::Eye { body, local } | NodeKind::Contact { body, local, .. }) = node.kind
            else {
                continue;
            };
            let reach = world.bodies()[body.0].shape().reach();
            let distance = local.norm();
            if distance > FAR * reach {
                let most = farthest.entry((wire, body.0)).or_insert((distance, reach));
                most.0 = distance.max(most.0);
            }
        }
    }
    let farthest = farthest.into_iter();
    let shown = farthest.map(|((wire, body), (distance, reach))| Far {
        wire: scene.wires[wire].name.clone(),
        body: scene.bodies[body].name.clone(),
        distance,
        reach,
    });
    shown.collect()
}

/// By how much a wire is longer than unstretched, as a part of that.
fn strain(wire: &Wire) -> f64 {
    let spans = (0..wire.segments().len()).map(|segment| wire.span(segment).norm());
    spans.sum::<f64>() / wire.length() - 1.0
}

impl HeldSlides {
    pub(super) fn add(&mut self, record: &StepRecord) {
        if record.slides.iter().any(|slide| slide.held) {
            self.steps += 1;
            self.first_at.get_or_insert(record.time);
        }
    }
}

impl fmt::Display for Stretched {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Stretched { wire, strain } = self;
        write!(f, "{wire} by {:.0}% of its length", 100.0 * strain)
    }
}

impl fmt::Display for Far {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Far {
            wire,
            body,
            distance,
            reach,
        } = self;
        write!(
            f,
            "{wire} is carried {distance:.3} m from the centre of {body}, whose surface is {reach:.3} m from it at most"
        )
    }
}

impl fmt::Display for Left {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Left { wire, body, time } = self;
        write!(f, "{wire} left {body} at {time:.3} s")
    }
}

impl fmt::Display for HeldSlides {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let times = if self.steps == 1 { "step" } else { "steps" };
        let steps = grouped(self.steps);
        write!(f, "as far as segments let it in {steps} {times}")?;
        match self.first_at {
            Some(time) => write!(f, ", first at {time:.3} s"),
            None => Ok(()),
        }
    }
}

#[cfg(test)]
mod tests {
    use tunnelproof::certified::Certified;
    use tunnelproof::wire::Mode;

    use crate::scenes::Scene;
    use crate::simulate::Summary;

    /// A bead of 20 kg on a rope between two points, which may be far apart for its length, slides down.
    fn run(more: &str, settings: &str) -> Summary {
        let text = format!(
            "title = \"bead\"\nduration = 2\nfriction = 0\n[settings]\n{settings}\n\
             [[bodies]]\nname = \"bead\"\nshape = {{ sphere = {{ radius = 0.05 }} }}\nposition = [2, 0, 8.9]\n\
             drive = {{ dynamic = {{ density = 38000 }} }}\n\
             [[wires]]\nname = \"rope\"\nresolution = 1\n{more}\
             material = {{ radius = 0.005, mass_per_length = 0.1, stretch_stiffness = 1e6, bend_stiffness = 0 }}\n\
             route = [{{ pinned = [0, 0, 10] }}, \
             {{ contact = {{ body = \"bead\", local = [0, 0, 0.05], normal = [0, 0, -1], friction = 0 }} }}, \
             {{ pinned = [20, 0, 0] }}]\n"
        );
        Summary::of_guarded(&Scene::from_toml(&text).unwrap()).unwrap()
    }

    #[test]
    fn wires_that_start_far_longer_than_they_are_are_named() {
        let usual = run("", "step = 0.01");
        assert!(usual.stretched.is_empty() && usual.left.is_empty());
        assert_eq!(usual.held_slides.steps, 0, "{}", usual.held_slides);
        let stretched = run("length = 15\n", "step = 0.01").stretched;
        let [rope] = &stretched[..] else {
            panic!("one wire")
        };
        assert_eq!(rope.to_string(), "rope by 49% of its length");
    }

    #[test]
    fn places_that_are_far_from_their_body_are_named() {
        let text = |z: f64| {
            format!(
                "title = \"far\"\nduration = 0.02\n\
                 [[bodies]]\nname = \"ball\"\nshape = {{ sphere = {{ radius = 0.1 }} }}\nposition = [0, 0, 0]\n\
                 drive = {{ dynamic = {{ density = 1000 }} }}\n\
                 [[wires]]\nname = \"rope\"\nresolution = 1\nmaterial = {{ radius = 0.005 }}\n\
                 route = [{{ pinned = [0, 0, 9] }}, {{ eye = {{ body = \"ball\", local = [0, 0, {z}] }} }}]\n"
            )
        };
        let far = |z: f64| {
            let summary = Summary::of_guarded(&Scene::from_toml(&text(z)).unwrap()).unwrap();
            summary
                .far
                .iter()
                .map(ToString::to_string)
                .collect::<Vec<_>>()
        };
        assert_eq!(far(0.15), [""; 0]);
        assert_eq!(
            far(5.0),
            [
                "rope is carried 5.000 m from the centre of ball, whose surface is 0.100 m from it at most"
            ]
        );
    }

    /// Two loads on a rope over a pulley, which start at a speed; how fast they are at the end.
    fn atwood(rate: f64, resolution: f64, masses: [f64; 2], speed: f64) -> ([f64; 2], Summary) {
        const RADIUS: f64 = 0.505;
        let turn: Vec<String> = (0..=6_i32)
            .map(|k| {
                let (y, x) = (f64::from(k) * std::f64::consts::PI / 6.0).sin_cos();
                format!(
                    "{{ contact = {{ body = \"pulley\", local = [{}, {}, 0], normal = [{x}, {y}, 0], friction = 0 }} }}",
                    RADIUS * x,
                    RADIUS * y
                )
            })
            .collect();
        let load = |name: &str, x: f64, z: f64, mass: f64, speed: f64| {
            format!(
                "[[bodies]]\nname = \"{name}\"\nshape = {{ box = {{ half = [0.1, 0.1, 0.1] }} }}\nposition = [{x}, 0, {z}]\n\
                 drive = {{ dynamic = {{ density = {}, velocity = [0, 0, {speed}] }} }}\n",
                mass / 0.008
            )
        };
        let text = format!(
            "title = \"pulley\"\nduration = 1\n[settings]\nstep = {}\n\
             [[bodies]]\nname = \"pulley\"\nshape = {{ cylinder = {{ radius = 0.5, half_height = 0.03 }} }}\n\
             position = [0, 0, 0]\nturn = {{ axis = [1, 0, 0], degrees = 90 }}\n{}{}\
             [[wires]]\nname = \"rope\"\nresolution = {resolution}\n\
             material = {{ radius = 0.005, mass_per_length = 0.001, stretch_stiffness = 1e6, bend_stiffness = 0 }}\n\
             route = [{{ eye = {{ body = \"heavy\", local = [0, 0, 0.1] }} }}, {}, {{ eye = {{ body = \"light\", local = [0, 0, 0.1] }} }}]\n",
            1.0 / rate,
            load("heavy", RADIUS, -5.1, masses[0], -speed),
            load("light", -RADIUS, -60.1, masses[1], speed),
            turn.join(", ")
        );
        let scene = Scene::from_toml(&text).unwrap();
        let mut world = scene.world().unwrap();
        let mut collisions = scene.collisions(Mode::Guard, &Certified).unwrap();
        for _ in 0..scene.steps() {
            world.step_colliding(&mut collisions, &[]).unwrap();
        }
        let speeds = [1, 2].map(|body| world.bodies()[body].velocity().z.abs());
        (speeds, Summary::of_guarded(&scene).unwrap())
    }

    #[test]
    fn rope_runs_as_fast_over_a_pulley_as_its_loads_fall() {
        // Atwood's machine, the rope without weight.
        for (rate, resolution, masses, speed) in [
            (60.0, 0.25, [120.0, 100.0], 0.0),
            (60.0, 0.25, [120.0, 100.0], 6.0),
            (60.0, 1.0, [120.0, 100.0], 12.0),
            (60.0, 1.0, [120.0, 100.0], 20.0),
            (240.0, 0.25, [120.0, 100.0], 12.0),
            (240.0, 1.0, [120.0, 100.0], 40.0),
            // By itself a rope gets as fast as it likes: more than half of its resolution in a step.
            (60.0, 0.25, [1000.0, 10.0], 0.0),
        ] {
            let (ends, summary) = atwood(rate, resolution, masses, speed);
            let [heavy, light] = masses;
            let expected = speed + (heavy - light) / (heavy + light) * 9.80665;
            for end in ends {
                assert!(
                    (end - expected).abs() < 0.02,
                    "{rate} {resolution} {speed}: {end}"
                );
            }
            assert_eq!(summary.held_slides.steps, 0, "{rate} {resolution} {speed}");
        }
    }

    #[test]
    fn rope_that_starts_too_fast_for_its_resolution_is_braked_and_that_is_named() {
        let (ends, summary) = atwood(60.0, 0.25, [120.0, 100.0], 20.0);
        assert!(ends.iter().all(|end| *end < 15.0), "{ends:?}");
        let said = summary.held_slides.to_string();
        assert!(said.starts_with("as far as segments let it in "), "{said}");
        assert!(said.ends_with(", first at 0.017 s"), "{said}");
        assert!(summary.to_string().contains("slid"), "{summary}");
    }
}
