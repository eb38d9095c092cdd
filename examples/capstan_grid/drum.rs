//! Two loads on one wire over a drum that does not turn: what holds, what slips, and how fast.

use std::error::Error;
use std::f64::consts::{PI, TAU};

use nalgebra::UnitQuaternion;

use tunnelproof::query::Point;
use tunnelproof::wire::{
    BodyId, BodyPlan, Collisions, Material, NodeKind, Settings, Shape, StepError, Stop, Vector,
    WirePlan, World,
};

/// How a wire gets around its drum.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Way {
    /// Its route has contact nodes.
    Route,
    /// It is laid there, and gets contact nodes by itself.
    ContactNodes,
    /// It is laid there, and has contacts alone.
    Contacts,
}

/// A wire over a drum with a load at each end.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Drum {
    pub(crate) way: Way,
    /// In m.
    pub(crate) radius: f64,
    pub(crate) friction: f64,
    /// By how much the wire turns on the drum, in degrees.
    pub(crate) angle: f64,
    pub(crate) material: Material,
    /// What the material is called.
    pub(crate) stiffness: &'static str,
    /// The heavy load in kg, wire included.
    pub(crate) heavy: f64,
    /// How many nodes turn the wire.
    pub(crate) nodes: usize,
    /// The resolution in m.
    pub(crate) resolution: f64,
    pub(crate) adaptive: bool,
    /// The time step in s.
    pub(crate) step: f64,
    /// The ratio of the loads as a part of `e^(f theta)`.
    pub(crate) part: f64,
}

/// What became of it.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Outcome {
    /// The mean acceleration with which the heavy load falls, in m/s^2.
    pub(crate) acceleration: f64,
    /// That by the formula.
    pub(crate) expected: f64,
    /// How far each load moved in the last second, downwards, in m.
    pub(crate) ways: [f64; 2],
    /// The fastest that either load moved, in m/s.
    pub(crate) fastest: f64,
    /// The largest residual of a bound of friction.
    pub(crate) residual: f64,
}

const G: f64 = 9.80665;
/// How long a wire may take to come to rest, and how long it moves at most until it is halted, in
/// s.
const SETTLING: f64 = 2.0;
const PAUSE: f64 = 0.1;
/// Radius of a load in m.
const BALL: f64 = 0.02;

fn direction(angle: f64) -> Vector {
    Vector::new(libm::cos(angle), 0.0, libm::sin(angle))
}

/// Nodes on a fixed drum along y, from one angle down by a turn.
#[derive(Clone, Copy)]
struct Turn {
    centre: Point,
    radius: f64,
    from: f64,
    turn: f64,
    nodes: usize,
    friction: f64,
}

impl Turn {
    fn angles(&self) -> impl Iterator<Item = f64> {
        let Turn {
            from, turn, nodes, ..
        } = *self;
        let each = turn / nodes as f64;
        (0..nodes).map(move |i| from - (i as f64 + 0.5) * each)
    }

    /// How far the legs run beside the axis.
    fn aside(&self) -> f64 {
        self.radius * libm::cos(self.turn / self.nodes as f64 / 2.0)
    }

    fn add(&self, world: &mut World, radius: f64) -> Result<BodyId, Box<dyn Error>> {
        let shape = Shape::Cylinder {
            radius,
            half_height: 1.0,
        };
        let mut plan = BodyPlan::fixed(shape, self.centre);
        let axis = UnitQuaternion::rotation_between(&Vector::z(), &Vector::y());
        plan.orientation = axis.ok_or("z and y are not opposite")?;
        Ok(world.add_body(plan)?)
    }

    /// Contact nodes on a drum that the wire itself does not touch.
    fn contact_nodes(&self, world: &mut World) -> Result<Vec<Stop>, Box<dyn Error>> {
        let body = self.add(world, self.radius / 2.0)?;
        let to_drum = world.body(body)?.orientation().inverse();
        let stop = |angle: f64| {
            let normal = to_drum * direction(angle);
            let local = normal * self.radius;
            let friction = self.friction;
            Stop::Contact {
                body,
                local,
                normal,
                friction,
            }
        };
        Ok(self.angles().map(stop).collect())
    }
}

fn load(world: &mut World, mass: f64, at: Point) -> Result<Stop, Box<dyn Error>> {
    let radius = BALL;
    let density = mass / (4.0 / 3.0 * PI * radius * radius * radius);
    let body = world.add_body(BodyPlan::dynamic(Shape::Sphere { radius }, density, at))?;
    let local = Vector::zeros();
    Ok(Stop::Eye { body, local })
}

impl Drum {
    fn turn(&self) -> f64 {
        self.angle.to_radians()
    }

    /// Whether the lighter tension bends the wire to the drum: by four times what a bar takes.
    fn lies_on_drum(&self) -> bool {
        let light = self.heavy * G / (self.part * self.limit());
        light * self.radius * self.radius >= 4.0 * self.material.bend_stiffness()
    }

    /// `e^(f theta)`.
    pub(crate) fn limit(&self) -> f64 {
        libm::exp(self.friction * self.turn())
    }

    /// The world, with both loads, the light one first.
    fn world(&self, masses: [f64; 2]) -> Result<World, Box<dyn Error>> {
        let mut world = World::new(Settings::default().with_step(self.step))?;
        let mut drum = Turn {
            centre: Point::origin(),
            radius: self.radius,
            from: PI,
            turn: self.turn(),
            nodes: self.nodes,
            friction: self.friction,
        };
        let mut stops;
        if self.way == Way::Route {
            stops = drum.contact_nodes(&mut world)?;
        } else {
            drum.add(&mut world, self.radius)?;
            // Segments that touch the drum.
            drum.radius = (self.radius + self.material.radius) / (drum.aside() / drum.radius);
            let angles = drum.angles();
            stops = angles
                .map(|angle| Stop::Free(Point::from(direction(angle) * drum.radius)))
                .collect();
        }
        let long = 2.0 + 2.0 * self.radius;
        let left = Point::new(-drum.aside(), 0.0, -long);
        let leaves = PI - self.turn();
        let rest = leaves.rem_euclid(TAU);
        let mut right = Point::new(drum.aside(), 0.0, -long);
        if rest > 0.01 && rest < TAU - 0.01 {
            // A pulley without friction turns the rest down.
            let mut pulley = Turn {
                radius: 0.1,
                from: rest,
                turn: rest,
                nodes: (rest / PI * 8.0).round() as usize,
                friction: 0.0,
                ..drum
            };
            let along = Vector::new(libm::sin(leaves), 0.0, -libm::cos(leaves));
            pulley.centre += along * (3.0 * self.radius + 1.0)
                + direction(leaves) * (drum.aside() - pulley.aside());
            right.x = pulley.centre.x + pulley.aside();
            stops.extend(pulley.contact_nodes(&mut world)?);
        }
        let mut route = vec![load(&mut world, masses[0], left)?];
        route.extend(stops);
        route.push(load(&mut world, masses[1], right)?);
        let mut plan = WirePlan::new(self.material, self.resolution, route);
        plan.resolution.adaptive = self.adaptive;
        world.add_wire(&plan)?;
        Ok(world)
    }

    /// The acceleration of the heavy load by the capstan's ratio and the wire's mass.
    fn expected(&self, world: &World) -> f64 {
        let wire = &world.wires()[0];
        let [light, heavy] = self.sides(world);
        // The tension along the wire is `a + b w` for an acceleration `w`.
        let (mut a, mut b) = (light * G, light);
        let on = self.on_drum(world);
        let each = libm::pow(self.limit(), 1.0 / on.len() as f64);
        for node in on.clone() {
            let mass = wire.node_mass(node);
            a *= each;
            b = b * each + mass * (1.0 + each) / 2.0;
        }
        let pulley = on.end..wire.nodes().len();
        let on_pulley =
            pulley.filter(|&node| matches!(wire.nodes()[node].kind, NodeKind::Contact { .. }));
        b += on_pulley.map(|node| wire.node_mass(node)).sum::<f64>();
        ((heavy * G - a) / (heavy + b)).max(0.0)
    }

    fn on_drum(&self, world: &World) -> std::ops::Range<usize> {
        let near = |node: &tunnelproof::wire::Node| {
            let away = Vector::new(node.position.x, 0.0, node.position.z).norm();
            away < (self.radius + 2.0 * self.material.radius)
                / libm::cos(self.turn() / self.nodes as f64 / 2.0)
                * 1.001
        };
        let nodes = world.wires()[0].nodes();
        let first = nodes.iter().position(near).unwrap_or(0);
        let last = nodes.iter().rposition(near).unwrap_or(0);
        first..last + 1
    }

    /// The masses that hang on both sides, wire included.
    fn sides(&self, world: &World) -> [f64; 2] {
        let wire = &world.wires()[0];
        let on = self.on_drum(world);
        let is_off = |&node: &usize| !matches!(wire.nodes()[node].kind, NodeKind::Contact { .. });
        let mass = |nodes: std::ops::Range<usize>| {
            nodes
                .filter(is_off)
                .map(|node| wire.node_mass(node))
                .sum::<f64>()
        };
        let count = world.bodies().len();
        [
            world.bodies()[count - 2].mass() + mass(0..on.start),
            world.bodies()[count - 1].mass() + mass(on.end..wire.nodes().len()),
        ]
    }

    /// Lays the wire with loads whose weights, wire included, have the ratio wanted.
    fn loaded(&self) -> Result<World, Box<dyn Error>> {
        let light = self.heavy / (self.part * self.limit());
        let bare = self.sides(&self.world([1.0, 1.0])?).map(|side| side - 1.0);
        self.world([light - bare[0], self.heavy - bare[1]])
    }

    /// Lets the wire take up its loads, and looks what it does in a second.
    pub(crate) fn run(&self) -> Result<Outcome, Box<dyn Error>> {
        let mut world = self.loaded()?;
        let mut outcome = Outcome {
            expected: self.expected(&world),
            ..Outcome::default()
        };
        let collisions = Collisions::default().with_friction(self.friction)?;
        let mut collisions = match self.way {
            Way::ContactNodes => collisions.with_contact_nodes(),
            _ => collisions,
        };
        let way = self.way;
        let mut step = |world: &mut World| -> Result<f64, StepError> {
            let record = match way {
                Way::Route => world.step(&[])?,
                _ => world.step_colliding(&mut collisions, &[])?,
            };
            Ok(record.solver.slide_residual)
        };
        let count = world.bodies().len();
        let loads = [count - 2, count - 1];
        // To rest, or as near to it as what slips comes.
        let (rest, pause) = (
            (SETTLING / self.step) as usize,
            (PAUSE / self.step) as usize,
        );
        let (mut last, mut since) = (0.0, 0);
        for _ in 0..rest {
            step(&mut world)?;
            let kinetic = world.energy().kinetic;
            since += 1;
            if kinetic < last || since >= pause {
                world.halt();
                (last, since) = (0.0, 0);
            } else {
                last = kinetic;
            }
        }
        world.halt();
        let heights = |world: &World| loads.map(|body| world.bodies()[body].position().z);
        let before = heights(&world);
        let steps = (1.0 / self.step).round() as usize;
        let (mut sums, mut weights) = (0.0, 0.0);
        for i in 0..steps {
            outcome.residual = outcome.residual.max(step(&mut world)?);
            let speeds = loads.map(|body| world.bodies()[body].velocity());
            outcome.fastest = speeds.iter().fold(outcome.fastest, |a, v| a.max(v.norm()));
            // The slope of the mean speed of both loads.
            let time = ((i as f64 + 0.5) - steps as f64 / 2.0) * self.step;
            sums += time * (speeds[0].z - speeds[1].z) / 2.0;
            weights += time * time;
        }
        outcome.acceleration = sums / weights;
        let after = heights(&world);
        outcome.ways = [before[0] - after[0], before[1] - after[1]];
        Ok(outcome)
    }
}

/// Every wire of the grid that gets around its drum in one way, at one part of its limit.
pub(crate) fn grid(way: Way, part: f64) -> Vec<Drum> {
    let mut drums = Vec::new();
    let turns: &[f64] = match way {
        Way::Route => &[90.0, 180.0, 360.0, 540.0],
        // What is laid there must not lie on itself.
        _ => &[90.0, 180.0],
    };
    for (stiffness, material) in MATERIALS {
        for radius in [0.05, 0.2, 1.0] {
            for friction in [0.1, 0.2, 0.5] {
                for &angle in turns {
                    for corners in [2, 4, 12, 48] {
                        for (resolution, adaptive) in RESOLUTIONS {
                            for step in [1.0 / 60.0, 1.0 / 240.0] {
                                let drum = Drum {
                                    way,
                                    radius,
                                    friction,
                                    angle,
                                    material: material(),
                                    stiffness,
                                    heavy: 100.0,
                                    nodes: (corners * angle as usize / 180).max(1),
                                    resolution,
                                    adaptive,
                                    step,
                                    part,
                                };
                                if drum.lies_on_drum() {
                                    drums.push(drum);
                                }
                            }
                        }
                    }
                }
            }
        }
    }
    drums
}

type Named = (&'static str, fn() -> Material);

/// 4 mm of steel as a cable and as a bar, and 8 mm of soft rope.
pub(crate) const MATERIALS: [Named; 3] = [
    ("steel cable", || Material::steel(0.002).chain()),
    ("steel bar", || Material::steel(0.002)),
    ("soft rope", || Material {
        density: 1000.0,
        stretch_modulus: 1e9,
        ..Material::steel(0.004).chain()
    }),
];

/// Resolutions in m, and whether tension changes them.
pub(crate) const RESOLUTIONS: [(f64, bool); 4] =
    [(10.0, false), (0.25, false), (0.25, true), (0.02, true)];

/// The ratio of the loads as parts of the limit.
pub(crate) const PARTS: [f64; 6] = [0.8, 0.9, 0.99, 1.01, 1.1, 1.2];

impl Outcome {
    /// Whether it held where it should, or slipped as it should: within 5% of the acceleration,
    /// except just above the limit, where slipping is enough.
    pub(crate) fn is_right(&self, drum: &Drum) -> bool {
        if drum.part < 1.0 {
            self.ways.iter().all(|way| way.abs() < 1e-3)
        } else if drum.part < 1.05 {
            self.acceleration > self.expected / 2.0 && self.acceleration < 2.0 * self.expected
        } else {
            (self.acceleration / self.expected - 1.0).abs() < 0.05
        }
    }
}
