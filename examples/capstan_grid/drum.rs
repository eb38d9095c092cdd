//! Two loads on one wire over a drum that does not turn: what holds, what slips, and how fast.
//!
//! `main.rs` prints the whole grid; `tests/capstan_grid.rs` holds a sample of it to its bounds.

use std::error::Error;
use std::f64::consts::{PI, TAU};

use nalgebra::UnitQuaternion;

use tunnelproof::query::Point;
use tunnelproof::wire::{
    BodyId, BodyPlan, Collisions, Material, Settings, Shape, StepError, Stop, Vector, WirePlan,
    World,
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
    /// The heavy load in kg.
    pub(crate) heavy: f64,
    pub(crate) mesh: Mesh,
    /// The ratio of the loads as a part of the limit, `e^(f theta)` for a wire without weight.
    pub(crate) part: f64,
}

/// How a wire and time are divided.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Mesh {
    /// How many nodes turn the wire by 180 degrees.
    pub(crate) corners: usize,
    /// The resolution in m.
    pub(crate) resolution: f64,
    pub(crate) adaptive: bool,
    /// Steps in a second.
    pub(crate) rate: u32,
}

impl Mesh {
    const fn new(corners: usize, resolution: f64, adaptive: bool, rate: u32) -> Self {
        Mesh {
            corners,
            resolution,
            adaptive,
            rate,
        }
    }

    fn step(&self) -> f64 {
        1.0 / f64::from(self.rate)
    }
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
const SETTLING: f64 = 4.0;
const PAUSE: f64 = 0.25;
/// It is halted before when the kinetic energy of its loads falls to this part of the most. That of the
/// wire falls at once where segments are short: it would halt the loads before they have moved.
const FALLEN: f64 = 0.5;
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

    /// The radius at which an arc is as long as the chord between two nodes.
    fn mean_radius(&self) -> f64 {
        let half = self.turn / self.nodes as f64 / 2.0;
        self.radius * libm::sin(half) / half
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

/// A speed in m/s at the end of each step.
#[derive(Default)]
struct Speeds(Vec<f64>);

impl Speeds {
    /// The slope of the straight line nearest to it, in m/s^2.
    fn acceleration(&self, step: f64) -> f64 {
        let middle = (self.0.len() - 1) as f64 / 2.0;
        let times = (0..self.0.len()).map(|i| (i as f64 - middle) * step);
        let sums = times
            .zip(&self.0)
            .map(|(time, speed)| [time * speed, time * time]);
        let [along, all] = sums.fold([0.0; 2], |sum, add| [sum[0] + add[0], sum[1] + add[1]]);
        along / all
    }
}

impl Drum {
    fn turn(&self) -> f64 {
        self.angle.to_radians()
    }

    /// How many nodes turn the wire.
    fn nodes(&self) -> usize {
        (self.mesh.corners * self.angle as usize / 180).max(1)
    }

    /// The wire's weight on the drum as a part of the light load's.
    fn weight(&self) -> f64 {
        let light = self.heavy / (self.part * self.limit());
        self.radius * self.turn() * self.material.mass_per_length() / light
    }

    /// Whether the lighter tension holds the wire on the drum, and there are nodes enough for its
    /// weight: they spread it with an error that grows as the square of their distance.
    fn is_resolved(&self) -> bool {
        let each = self.turn() / self.nodes() as f64;
        self.weight() < 0.5 && self.weight() * each * each < 0.05
    }

    /// `e^(f theta)`.
    pub(crate) fn limit(&self) -> f64 {
        libm::exp(self.friction * self.turn())
    }

    /// How far the loads hang below the axis of the drum, in m.
    fn depth(&self) -> f64 {
        2.0 + 2.0 * self.radius
    }

    /// Where nodes turn the wire: on the drum, or, where it is laid there, around it, so that its
    /// segments touch.
    fn turn_of_wire(&self) -> Turn {
        let turn = Turn {
            centre: Point::origin(),
            radius: self.radius,
            from: PI,
            turn: self.turn(),
            nodes: self.nodes(),
            friction: self.friction,
        };
        let laid = (self.radius + self.material.radius) * turn.radius / turn.aside();
        Turn {
            radius: if self.way == Way::Route {
                self.radius
            } else {
                laid
            },
            ..turn
        }
    }

    /// The world, with both loads, the light one first.
    fn world(&self, masses: [f64; 2]) -> Result<World, Box<dyn Error>> {
        let mut world = World::new(Settings::default().with_step(self.mesh.step()))?;
        let drum = self.turn_of_wire();
        let mut stops = if self.way == Way::Route {
            drum.contact_nodes(&mut world)?
        } else {
            drum.add(&mut world, self.radius)?;
            let at = |angle| Stop::Free(Point::from(direction(angle) * drum.radius));
            drum.angles().map(at).collect()
        };
        let long = self.depth();
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
        let mut plan = WirePlan::new(self.material, self.mesh.resolution, route);
        plan.resolution.adaptive = self.mesh.adaptive;
        world.add_wire(&plan)?;
        Ok(world)
    }

    /// What pulls at the heavy load when its wire is at the limit, in N: the solution of
    /// `dT/dx = f (T + w sin x) + w cos x + m a` along the drum, where `w` and `m` are the wire's
    /// weight and mass for an angle of 1, and the wire's own weight and mass beside the drum. The
    /// light load rises with an acceleration in m/s^2; `slid` of the wire in m has come over to the
    /// heavy one.
    fn pull(&self, world: &World, light: f64, slid: f64, acceleration: f64) -> f64 {
        let line = self.material.mass_per_length();
        let (f, turn, wire) = (self.friction, self.turn(), self.turn_of_wire());
        let radius = wire.mean_radius();
        let hangs = self.depth() - slid;
        let start = (light + line * hangs) * (G + acceleration);
        let on_drum = line * radius;
        let along = on_drum * G * (1.0 - f * f) / (1.0 + f * f);
        let pressed = -2.0 * on_drum * G * f / (1.0 + f * f);
        let moved = -on_drum * acceleration / f;
        let (sin, cos) = (libm::sin(turn), libm::cos(turn));
        let end = self.limit() * (start - pressed - moved) + along * sin + pressed * cos + moved;
        // From the drum to the load.
        let all = world.wires()[0].nodes().last().map_or(0.0, |node| node.arc);
        let beyond = all - hangs - radius * turn;
        let down = self.depth() + slid + wire.aside() * sin;
        end + line * (beyond * acceleration - down * G)
    }

    /// The acceleration with which the heavy load falls, 0 below the limit, once `slid` of the wire
    /// in m has come over to it.
    fn fall(&self, world: &World, [light, heavy]: [f64; 2], slid: f64) -> f64 {
        let [still, moving] =
            [0.0, 1.0].map(|acceleration| self.pull(world, light, slid, acceleration));
        ((heavy * G - still) / (heavy + moving - still)).max(0.0)
    }

    /// The mean acceleration by the formula from rest on, as [`Speeds`] has it.
    fn expected(&self, world: &World, masses: [f64; 2], mut slid: f64) -> f64 {
        let mut speeds = Speeds::default();
        let mut speed = 0.0;
        for _ in 0..(1.0 / self.mesh.step()).round() as usize {
            speed += self.fall(world, masses, slid) * self.mesh.step();
            slid += speed * self.mesh.step();
            speeds.0.push(speed);
        }
        speeds.acceleration(self.mesh.step())
    }

    /// The masses of the loads in kg that make the ratio wanted.
    fn masses(&self) -> Result<[f64; 2], Box<dyn Error>> {
        let world = self.world([1.0, 1.0])?;
        // The pull is linear in the light load.
        let [one, two] = [1.0, 2.0].map(|light| self.pull(&world, light, 0.0, 0.0));
        let light = 1.0 + (self.heavy * G / self.part - one) / (two - one);
        Ok([light, self.heavy])
    }

    /// Lets the wire take up its loads, and looks what it does in a second.
    pub(crate) fn run(&self) -> Result<Outcome, Box<dyn Error>> {
        self.run_with(self.friction)
    }

    /// The same, with a coefficient of friction that may be another than that of the formula.
    pub(crate) fn run_with(&self, friction: f64) -> Result<Outcome, Box<dyn Error>> {
        let masses = self.masses()?;
        let start = self.world(masses)?;
        let mut world = Drum { friction, ..*self }.world(masses)?;
        let mut outcome = Outcome::default();
        let collisions = Collisions::default().with_friction(friction)?;
        let mut collisions = match self.way {
            Way::ContactNodes => collisions,
            _ => collisions.without_contact_nodes(),
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
            (SETTLING / self.mesh.step()) as usize,
            (PAUSE / self.mesh.step()) as usize,
        );
        let (mut most, mut since) = (0.0, 0);
        for _ in 0..rest {
            step(&mut world)?;
            let speeds = loads.map(|body| world.bodies()[body].velocity().norm_squared());
            let kinetic = masses[0] * speeds[0] + masses[1] * speeds[1];
            since += 1;
            if kinetic < FALLEN * most || since >= pause {
                world.halt();
                (most, since) = (0.0, 0);
            } else {
                most = kinetic.max(most);
            }
        }
        world.halt();
        let heights = |world: &World| loads.map(|body| world.bodies()[body].position().z);
        let before = heights(&world);
        let unloaded = heights(&start);
        let slid = (before[0] - unloaded[0] + unloaded[1] - before[1]) / 2.0;
        outcome.expected = self.expected(&start, masses, slid);
        let mut mean = Speeds::default();
        for _ in 0..(1.0 / self.mesh.step()).round() as usize {
            outcome.residual = outcome.residual.max(step(&mut world)?);
            let speeds = loads.map(|body| world.bodies()[body].velocity());
            outcome.fastest = speeds.iter().fold(outcome.fastest, |a, v| a.max(v.norm()));
            mean.0.push((speeds[0].z - speeds[1].z) / 2.0);
        }
        outcome.acceleration = mean.acceleration(self.mesh.step());
        let after = heights(&world);
        outcome.ways = [before[0] - after[0], before[1] - after[1]];
        Ok(outcome)
    }
}

/// Every wire of the grid that gets around its drum in one way, at one part of its limit.
pub(crate) fn grid(way: Way, part: f64) -> Vec<Drum> {
    let turns: &[f64] = match way {
        Way::Route => &[90.0, 180.0, 360.0, 540.0],
        // What is laid there must not lie on itself.
        _ => &[90.0, 180.0],
    };
    let mut drums = Vec::new();
    for (stiffness, material, least) in MATERIALS {
        for radius in [0.05, 0.2, 1.0] {
            for friction in [0.1, 0.2, 0.5] {
                for &angle in turns {
                    let meshes = if way == Way::Route {
                        &MESHES[..]
                    } else {
                        &LAID[..]
                    };
                    let drums_of = meshes.iter().map(|&mesh| Drum {
                        way,
                        radius,
                        friction,
                        angle,
                        material: material(),
                        stiffness,
                        // Wire weighs little beside the light load.
                        heavy: (least * libm::exp(friction * angle.to_radians())).max(100.0),
                        mesh,
                        part,
                    });
                    drums.extend(drums_of.filter(Drum::is_resolved));
                }
            }
        }
    }
    drums
}

type Named = (&'static str, fn() -> Material, f64);

/// 4 mm of steel, and 8 mm of soft rope, and their least light load in kg. Neither resists bending: a bar lifts off where it leaves
/// the drum, and turns there without friction.
pub(crate) const MATERIALS: [Named; 2] = [
    ("steel", || Material::steel(0.002).chain(), 20.0),
    (
        "soft rope",
        || Material {
            density: 1000.0,
            stretch_modulus: 1e9,
            ..Material::steel(0.004).chain()
        },
        4.0,
    ),
];

/// How wires and time are divided.
pub(crate) const MESHES: [Mesh; 8] = [
    Mesh::new(2, 10.0, false, 60),
    Mesh::new(4, 0.25, false, 60),
    Mesh::new(12, 0.25, false, 240),
    Mesh::new(2, 10.0, true, 240),
    Mesh::new(4, 0.25, true, 60),
    Mesh::new(12, 0.02, true, 60),
    Mesh::new(24, 0.02, true, 240),
    Mesh::new(48, 0.25, true, 60),
];

/// The same for wires that are laid on the drum and adapt, nearly round at first, so that they do
/// not fall far before they are taut.
pub(crate) const LAID: [Mesh; 5] = [
    Mesh::new(48, 0.25, true, 60),
    Mesh::new(48, 0.25, true, 240),
    Mesh::new(48, 0.05, true, 60),
    Mesh::new(48, 0.02, true, 60),
    Mesh::new(48, 0.02, true, 240),
];

/// The ratio of the loads as parts of the limit.
pub(crate) const PARTS: [f64; 6] = [0.8, 0.9, 0.99, 1.01, 1.1, 1.2];

impl Outcome {
    /// Whether it held where it should, the light load to 2 mm in the second, or slipped as it should:
    /// within 5% of the acceleration; just above the limit, within a factor of 2.
    pub(crate) fn is_right(&self, drum: &Drum) -> bool {
        if drum.part < 1.0 {
            self.ways[0].abs() < 2e-3
        } else if drum.part < 1.05 {
            self.acceleration > self.expected / 2.0 && self.acceleration < 2.0 * self.expected
        } else {
            (self.acceleration / self.expected - 1.0).abs() < 0.05
        }
    }
}
