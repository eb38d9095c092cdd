//! Where a step takes everything, before anything is moved.

use nalgebra::UnitQuaternion;

use super::capstan::is_held;
use super::carrier::{Carrier, Layout};
use super::islands::Island;
use super::spin::turn;
use super::stages::{Mover, is_followed, slowed, stages};
use crate::query::Point;
use crate::wire::Vector;
use crate::wire::error::Part;
use crate::wire::model::{BodyId, WireId};
use crate::wire::record::Pose;
use crate::wire::world::World;

/// The velocities of a solution, as they are before any is scaled.
pub(super) struct Velocities {
    /// Of each node, by wire.
    wires: Vec<Vec<Vector>>,
    /// Velocity and angular velocity of each body.
    bodies: Vec<[Vector; 2]>,
    /// Every contact node, and every reel.
    slides: Vec<SlideRate>,
}

/// Positions and velocities at the end of a step.
pub(in crate::wire) struct ProposedMotion {
    bodies: Vec<BodyMotion>,
    /// Position and velocity of each node, by wire.
    pub(in crate::wire) wires: Vec<Vec<(Point, Vector)>>,
    /// Every contact node and every reel, by wire and node.
    pub(super) slides: Vec<SlideRate>,
}

/// How fast a wire slides over a contact node, or is let out at its last one.
#[derive(Clone, Copy)]
pub(super) struct SlideRate {
    pub(super) wire: usize,
    pub(super) node: usize,
    /// How fast the node's arc length grows, in m/s.
    pub(super) speed: f64,
    /// Whether what is left of a segment holds the wire.
    pub(super) held: bool,
}

/// Where a body ends, and how fast it is there.
pub(in crate::wire) struct BodyMotion {
    pub(in crate::wire) position: Point,
    pub(in crate::wire) orientation: UnitQuaternion<f64>,
    pub(in crate::wire) velocity: Vector,
    pub(in crate::wire) angular_velocity: Vector,
    /// Poses on the way, from stage to stage; none if it stays where it is.
    pub(in crate::wire) between: Vec<Pose>,
    /// Whether it turns so little that stages follow its way.
    pub(in crate::wire) is_followed: bool,
}

/// The factor on the motion of each node, by wire, and of each body, from 0 to 1. A node that a
/// body carries moves with the body; its own factor is that of its sliding.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::wire) struct MotionScales {
    pub(in crate::wire) nodes: Vec<Vec<f64>>,
    pub(in crate::wire) bodies: Vec<f64>,
}

impl MotionScales {
    /// Everything moves as solved.
    pub(in crate::wire) fn all(world: &World) -> Self {
        MotionScales {
            nodes: (world.wires.iter())
                .map(|wire| vec![1.0; wire.nodes.len()])
                .collect(),
            bodies: vec![1.0; world.bodies.len()],
        }
    }

    /// The factor on a node: its body's, or its own.
    pub(in crate::wire) fn of(&self, world: &World, wire: usize, node: usize) -> f64 {
        let carrier = world.wires[wire].nodes[node].kind.carrier();
        carrier.map_or(self.nodes[wire][node], |(body, _)| self.bodies[body.0])
    }

    /// The same, to be changed.
    pub(in crate::wire) fn part(&mut self, world: &World, wire: usize, node: usize) -> &mut f64 {
        match world.wires[wire].nodes[node].kind.carrier() {
            Some((body, _)) => &mut self.bodies[body.0],
            None => &mut self.nodes[wire][node],
        }
    }
}

impl SlideRate {
    /// Whether wire is let out at the node, which is the last one then.
    pub(super) fn is_reel(&self, world: &World) -> bool {
        self.node + 1 == world.wires[self.wire].nodes.len()
    }

    /// Moves arc length over the node.
    pub(super) fn apply(&self, world: &mut World) {
        let node = &mut world.wires[self.wire].nodes[self.node];
        node.slide = self.speed;
        node.arc += self.speed * world.settings.step;
    }
}

impl Velocities {
    /// Those that are prescribed; of wires none yet.
    pub(super) fn prescribed(world: &World) -> Self {
        let (time, step) = (world.time(), world.settings.step);
        let bodies = world.bodies.iter().map(|body| match body.dynamic {
            true => [Vector::zeros(); 2],
            false => body.prescribed(time, step).into(),
        });
        Velocities {
            wires: vec![Vec::new(); world.wires.len()],
            bodies: bodies.collect(),
            slides: Vec::new(),
        }
    }

    /// Takes those of an island, from its solution `x`.
    pub(super) fn take(&mut self, world: &World, island: &Island, layout: &Layout, x: &[f64]) {
        for (&body, first) in island.bodies.iter().zip(&layout.bodies) {
            if let Some(first) = *first {
                self.bodies[body] = [first, first + 3].map(|at| Carrier::Free(at).velocity(x));
            }
        }
        for (&wire, &first) in island.wires.iter().zip(&layout.first_node) {
            let nodes = first..first + world.wires[wire].nodes.len();
            let carriers = layout.nodes[nodes.clone()].iter();
            self.wires[wire] = carriers.map(|carrier| carrier.velocity(x)).collect();
            let (reeled, last) = (&world.wires[wire], nodes.len() - 1);
            if !reeled.reel.is_empty() || reeled.nodes[last].slide != 0.0 {
                let speed = reeled.reel_speed(world.time(), world.settings.step);
                self.slides.push(SlideRate {
                    wire,
                    node: last,
                    speed,
                    held: false,
                });
            }
            for (node, column) in layout.slides[nodes].iter().enumerate() {
                if let Some(column) = *column {
                    let speed = x[column];
                    let held = is_held(world, wire, node, speed);
                    self.slides.push(SlideRate {
                        wire,
                        node,
                        speed,
                        held,
                    });
                }
            }
        }
    }
}

impl World {
    /// The motion that the velocities of a solution lead to, scaled: `v = scale v+`, `x+ = x +
    /// h v`. What has a scale of 0 stays where it is, to the bit.
    pub(super) fn motion(
        &self,
        solved: &Velocities,
        motion_scales: &MotionScales,
    ) -> ProposedMotion {
        let step = self.settings.step;
        let mut moved = ProposedMotion {
            bodies: Vec::with_capacity(self.bodies.len()),
            wires: Vec::with_capacity(self.wires.len()),
            slides: Vec::with_capacity(solved.slides.len()),
        };
        let bodies = self.bodies.iter().zip(&solved.bodies);
        for ((body, &[velocity, spin]), &scale) in bodies.zip(&motion_scales.bodies) {
            let spin = spin * scale;
            let angular_velocity = match body.dynamic {
                true => slowed(spin, step),
                false => spin,
            };
            let velocity = velocity * scale;
            moved.bodies.push(BodyMotion {
                between: Vec::new(),
                is_followed: is_followed(&angular_velocity, step),
                position: body.position + velocity * step,
                // Turning by nothing normalises, which may change bits.
                orientation: if scale > 0.0 {
                    turn(&body.orientation, &angular_velocity, step)
                } else {
                    body.orientation
                },
                velocity,
                angular_velocity,
            });
        }
        self.add_poses_between(&mut moved.bodies);
        let wires = self.wires.iter().zip(&solved.wires);
        for ((wire, velocities), scales) in wires.zip(&motion_scales.nodes) {
            let nodes = wire.nodes.iter().zip(velocities).zip(scales);
            let nodes = nodes.map(|((node, velocity), &scale)| {
                let velocity = velocity * scale;
                let position = match node.kind.carrier() {
                    Some((body, local)) => moved.bodies[body.0].point(&local),
                    None => node.position + velocity * step,
                };
                (position, velocity)
            });
            moved.wires.push(nodes.collect());
        }
        for &slid in &solved.slides {
            let speed = slid.speed * motion_scales.nodes[slid.wire][slid.node];
            moved.slides.push(SlideRate { speed, ..slid });
        }
        moved.slides.sort_by_key(|slid| (slid.wire, slid.node));
        moved
    }

    /// Adds the poses at the ends of stages.
    fn add_poses_between(&self, ends: &mut [BodyMotion]) {
        let bodies = self.bodies.iter().enumerate();
        let moving = bodies.filter(|(body, start)| ends[*body].pose() != Pose::of(start));
        let movers = moving.map(|(body, _)| Mover {
            body,
            end: ends[body].position,
            angular_velocity: ends[body].angular_velocity,
        });
        let movers: Vec<Mover> = movers.collect();
        for (mover, stages) in movers.iter().zip(stages(self, &movers)) {
            let (from, to) = (&self.bodies[mover.body], &mut ends[mover.body]);
            if !to.is_followed {
                continue;
            }
            let on_way = (1..stages).map(|stage| {
                let time = self.settings.step * (f64::from(stage) / f64::from(stages));
                Pose {
                    position: from.position + to.velocity * time,
                    orientation: turn(&from.orientation, &to.angular_velocity, time),
                }
            });
            to.between = on_way.collect();
        }
    }
}

impl BodyMotion {
    fn point(&self, local: &Vector) -> Point {
        self.position + self.orientation * local
    }

    pub(in crate::wire) fn pose(&self) -> Pose {
        Pose {
            position: self.position,
            orientation: self.orientation,
        }
    }
}

impl ProposedMotion {
    /// The first part of which a number is not finite.
    pub(super) fn not_finite(&self) -> Option<Part> {
        let is_finite = |v: &Vector| v.iter().all(|x| x.is_finite());
        let bodies = self.bodies.iter().enumerate().map(|(at, body)| {
            let turned = body.orientation.coords.iter().all(|x| x.is_finite());
            let vectors = [
                &body.position.coords,
                &body.velocity,
                &body.angular_velocity,
            ];
            let is_finite = turned && vectors.into_iter().all(is_finite);
            (Part::Body(BodyId(at)), is_finite)
        });
        let part = |wire: usize, node: usize| Part::Node {
            wire: WireId(wire),
            node,
        };
        let nodes = self.wires.iter().enumerate().flat_map(|(wire, nodes)| {
            let nodes = nodes.iter().enumerate();
            nodes.map(move |(node, (position, velocity))| {
                let is_finite = is_finite(&position.coords) && is_finite(velocity);
                (part(wire, node), is_finite)
            })
        });
        let slides = self.slides.iter();
        let slides = slides.map(|slid| (part(slid.wire, slid.node), slid.speed.is_finite()));
        let mut parts = bodies.chain(nodes).chain(slides);
        parts.find_map(|(part, is_finite)| (!is_finite).then_some(part))
    }

    /// How a body ends.
    pub(in crate::wire) fn body(&self, body: BodyId) -> &BodyMotion {
        &self.bodies[body.0]
    }

    /// The poses of a body of `world` from the start to the end, at the ends of stages; two if it
    /// stays where it is. From one to the next it turns by 45 degrees at most.
    pub(in crate::wire) fn poses(&self, world: &World, body: BodyId) -> Vec<Pose> {
        let to = self.body(body);
        let mut poses = Vec::with_capacity(to.between.len() + 2);
        poses.push(Pose::of(&world.bodies[body.0]));
        poses.extend(&to.between);
        poses.push(to.pose());
        poses
    }

    /// How fast the arc length of a node grows, in m/s.
    pub(super) fn speed(&self, wire: usize, node: usize) -> f64 {
        let of = |slid: &SlideRate| (slid.wire, slid.node);
        let slid = self.slides.binary_search_by_key(&(wire, node), of);
        slid.map_or(0.0, |at| self.slides[at].speed)
    }

    /// Moves a world, but for what reels let out. Returns how wires slid.
    pub(super) fn apply(self, world: &mut World) -> Vec<SlideRate> {
        for (body, to) in world.bodies.iter_mut().zip(self.bodies) {
            (body.position, body.orientation) = (to.position, to.orientation);
            (body.velocity, body.angular_velocity) = (to.velocity, to.angular_velocity);
        }
        for (wire, to) in world.wires.iter_mut().zip(self.wires) {
            for (node, to) in wire.nodes.iter_mut().zip(to) {
                (node.position, node.velocity) = to;
            }
        }
        for slid in &self.slides {
            if !slid.is_reel(world) {
                slid.apply(world);
            }
        }
        self.slides
    }
}
