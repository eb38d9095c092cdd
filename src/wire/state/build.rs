//! From what a file holds to a state, or to what is wrong with it.

use std::collections::BTreeSet;
use std::fmt::Display;

use super::State;
use super::content::{
    BodyContent, CollisionSettingsContent, Content, MemoryContent, ModeContent, NodeContent,
    SegmentContent, ShapeContent, WireContactContent, WireContent, WorldContent,
};
use crate::broad::{Placed, SlowPairs};
use crate::certified::decide_discrete;
use crate::query::EdgeEdge;
use crate::wire::collide::{BODY_KEYS, KnownContacts, WIRE_KEYS, WireContact, WireContacts};
use crate::wire::file::Fault;
use crate::wire::model::check::{finite, finite_point, finite_vector, not_negative, unit};
use crate::wire::model::wire::TENSION_HISTORY;
use crate::wire::model::{Body, Mesh, ModelError, Node, Phase, Segment, Shape, Wire};
use crate::wire::solver_cache::{SolverCache, WarmStart};
use crate::wire::world::{Epoch, World};
use crate::wire::{CollisionMemory, CollisionSettings, Mode};

/// So many steps, as a number in `f64` is exact; more than 4 million years at 1/60 s.
const MOST_STEPS: u64 = 1 << 53;

/// So many keys of contacts, of the 2^62 that there are of each kind.
const MOST_KEYS: u64 = 1 << 61;

/// A fault at a place.
fn at(path: impl Display) -> impl FnOnce(ModelError) -> Fault {
    let path = path.to_string();
    move |error| Fault::Value { path, error }
}

/// A whole number is not what is accepted.
fn number(field: &'static str, value: u64, accepted: &'static str) -> ModelError {
    ModelError::value(field, value as f64, accepted)
}

impl Content {
    pub(super) fn build(self) -> Result<State, Fault> {
        let world = self.world.build()?;
        let settings = CollisionSettings::from(self.settings);
        settings.check().map_err(at("collisions"))?;
        let memory = self.memory.build(&world)?;
        Ok(State {
            world,
            narrow: self.narrow,
            settings,
            memory,
        })
    }
}

impl WorldContent {
    fn build(self) -> Result<World, Fault> {
        self.settings.check().map_err(at("settings"))?;
        let (since, time) = self.epoch;
        if self.steps > MOST_STEPS {
            return Err(at("")(number("steps", self.steps, "at most 2^53")));
        }
        if since > self.steps {
            let error = number("steps", since, "at most the steps done");
            return Err(at("epoch")(error));
        }
        not_negative("time", time).map_err(at("epoch"))?;
        let mut world = World {
            settings: self.settings,
            bodies: Vec::new(),
            wires: Vec::new(),
            steps: self.steps,
            epoch: Epoch { steps: since, time },
            cache: SolverCache::default(),
        };
        finite("time", world.time()).map_err(at(""))?;
        for (k, body) in self.bodies.into_iter().enumerate() {
            let built = body.build().map_err(at(format_args!("bodies[{k}]")))?;
            world.bodies.push(built);
        }
        for (k, wire) in self.wires.into_iter().enumerate() {
            let wire = Wire::from(wire);
            let path = |node: Option<usize>| match node {
                Some(node) => format!("wires[{k}].nodes[{node}]"),
                None => format!("wires[{k}]"),
            };
            let wrong = |(node, error)| at(path(node))(error);
            wire.check(&world.bodies).map_err(wrong)?;
            let latest = world.steps + TENSION_HISTORY as u64;
            for (node, Node { remesh_from, .. }) in wire.nodes.iter().enumerate() {
                if *remesh_from > latest {
                    let accepted = "at most 10 above the steps done";
                    let error = number("remesh_from", *remesh_from, accepted);
                    return Err(at(path(Some(node)))(error));
                }
            }
            world.wires.push(wire);
        }
        for (k, (_, impulse)) in self.warm_start.iter().enumerate() {
            let path = format_args!("warm_start[{k}]");
            finite_vector("impulse", impulse).map_err(at(path))?;
        }
        world.cache.warm_start = WarmStart::new(self.warm_start.into_iter());
        Ok(world)
    }
}

impl BodyContent {
    fn build(self) -> Result<Body, ModelError> {
        let phases = self.phases.into_iter();
        let phases = phases.map(|(from, velocity, angular_velocity)| Phase {
            from,
            velocity,
            angular_velocity,
        });
        let body = Body {
            shape: self.shape.build()?,
            dynamic: self.dynamic,
            phases: phases.collect(),
            mass: self.mass,
            inertia: self.inertia,
            position: self.position,
            orientation: self.orientation,
            velocity: self.velocity,
            angular_velocity: self.angular_velocity,
        };
        body.check()?;
        Ok(body)
    }
}

impl ShapeContent {
    fn build(self) -> Result<Shape, ModelError> {
        Ok(match self {
            ShapeContent::Box { half } => Shape::Box { half },
            ShapeContent::Cylinder {
                radius,
                half_height,
            } => Shape::Cylinder {
                radius,
                half_height,
            },
            ShapeContent::Sphere { radius } => Shape::Sphere { radius },
            ShapeContent::Capsule {
                radius,
                half_height,
            } => Shape::Capsule {
                radius,
                half_height,
            },
            ShapeContent::Plane => Shape::Plane,
            ShapeContent::Mesh(parts) => Shape::Mesh(Mesh::try_from(parts)?),
        })
    }
}

impl From<WireContent> for Wire {
    fn from(wire: WireContent) -> Self {
        let node = |node: NodeContent| Node {
            position: node.position,
            velocity: node.velocity,
            arc: node.arc,
            kind: node.kind,
            slide: node.slide,
            remesh_from: node.remesh_from,
        };
        let segment = |segment: SegmentContent| Segment {
            tension: segment.tension,
            tension_history: segment.tension_history,
        };
        Wire {
            material: wire.material,
            resolution: wire.resolution,
            nodes: wire.nodes.into_iter().map(node).collect(),
            segments: wire.segments.into_iter().map(segment).collect(),
            twist: wire.twist,
            reel: wire.reel,
        }
    }
}

impl From<CollisionSettingsContent> for CollisionSettings {
    fn from(settings: CollisionSettingsContent) -> Self {
        CollisionSettings {
            mode: match settings.mode {
                ModeContent::Guard => Mode::Guard,
                ModeContent::Thesis => Mode::Thesis,
            },
            friction: settings.friction,
            guarded_thickness: settings.guarded_thickness,
            bodies: settings.bodies,
            contact_nodes: settings.contact_nodes,
        }
    }
}

impl MemoryContent {
    fn build(self, world: &World) -> Result<CollisionMemory, Fault> {
        check_slow(&self.placed, &self.excluded)?;
        let mut keys = Keys::new(WIRE_KEYS, self.made).map_err(at("collisions"))?;
        let mut list = Vec::with_capacity(self.between_wires.len());
        for (k, contact) in self.between_wires.into_iter().enumerate() {
            let path = || format!("collisions.between_wires[{k}]");
            keys.take(contact.key).map_err(at(path()))?;
            list.push(contact.build(world).map_err(at(path()))?);
        }
        let mut keys = Keys::new(BODY_KEYS, self.given).map_err(at("collisions"))?;
        for (k, contact) in self.with_bodies.iter().enumerate() {
            let path = || format!("collisions.with_bodies[{k}]");
            keys.take(contact.key).map_err(at(path()))?;
            contact.check(world).map_err(at(path()))?;
        }
        for (k, site) in self.pushed.iter().enumerate() {
            let path = format_args!("collisions.pushed[{k}]");
            site.check(world).map_err(at(path))?;
        }
        Ok(CollisionMemory {
            slow: SlowPairs::between_steps(self.placed, self.excluded),
            between_wires: WireContacts {
                list,
                made: self.made,
            },
            with_bodies: KnownContacts {
                last: self.with_bodies,
                given: self.given,
                pushed: self.pushed,
            },
        })
    }
}

impl WireContactContent {
    fn build(self, world: &World) -> Result<WireContact, ModelError> {
        for site in &self.sites {
            site.check(world)?;
        }
        finite_vector("normal", &self.normal)?;
        unit("length of the normal", self.normal.norm())?;
        finite("gap", self.gap)?;
        Ok(WireContact {
            key: self.key,
            sites: self.sites,
            wrong: self.wrong,
            normal: self.normal,
            gap: self.gap,
            pushing: self.pushing,
            at_node: self.at_node,
        })
    }
}

/// Keys that were given, each of which one contact may have.
struct Keys {
    before: u64,
    last: u64,
    taken: BTreeSet<u64>,
}

impl Keys {
    fn new(before: u64, given: u64) -> Result<Self, ModelError> {
        if given > MOST_KEYS {
            return Err(number("keys given", given, "at most 2^61"));
        }
        Ok(Keys {
            before,
            last: before + given,
            taken: BTreeSet::new(),
        })
    }

    fn take(&mut self, key: u64) -> Result<(), ModelError> {
        let is_given = key > self.before && key <= self.last;
        if is_given && self.taken.insert(key) {
            return Ok(());
        }
        let accepted = "one that was given, to no other contact";
        Err(number("key", key, accepted))
    }
}

/// Pairs that are left out of a step are not tested, so what is said of them has to be so: each is
/// farther apart than its radii and the slack. Decided exactly, with the sum of the radii rounded
/// down, which refuses nothing that [`SlowPairs`] has proved.
fn check_slow(placed: &[Option<Placed>], excluded: &[([usize; 2], f64)]) -> Result<(), Fault> {
    for (k, (radius, ends)) in placed
        .iter()
        .enumerate()
        .filter_map(|(k, p)| Some((k, p.as_ref()?)))
    {
        let path = || format!("collisions.placed[{k}]");
        not_negative("radius", *radius).map_err(at(path()))?;
        for end in ends {
            finite_point("end", end).map_err(at(path()))?;
        }
    }
    let mut before = None;
    for (k, &([a, b], slack)) in excluded.iter().enumerate() {
        let path = || format!("collisions.excluded[{k}]");
        let wrong = |index: usize, accepted| {
            let error = number("segment", index as u64, accepted);
            Err(at(path())(error))
        };
        if a >= b || before >= Some([a, b]) {
            return wrong(b, "one of a pair in ascending order");
        }
        before = Some([a, b]);
        let segment = |index: usize| placed.get(index).copied().flatten();
        let Some((first, second)) = segment(a).zip(segment(b)) else {
            return wrong(b, "one that is placed");
        };
        if !are_apart(first, second, slack) {
            let accepted = "above 0, and less than the two are apart beside their radii";
            let error = ModelError::value("slack", slack, accepted);
            return Err(at(path())(error));
        }
    }
    Ok(())
}

fn are_apart((radius, [a, b]): Placed, (other, [c, d]): Placed, slack: f64) -> bool {
    let radii = (radius + other).next_down().max(0.0);
    let at_rest = EdgeEdge::at_rest([a, b, c, d], [slack, radii]);
    slack > 0.0 && at_rest.is_ok_and(|query| !decide_discrete(&query).touches)
}
