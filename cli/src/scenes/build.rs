//! From a scene to its world.

use std::fmt::Display;

use nalgebra::{Quaternion, UnitQuaternion};

use super::check;
use super::error::{Reason, SceneError};
use super::file::{Body, Drive, Material, ReelPhase, Scene, Shape, Stop, Turn, Wire};
use super::hang::{NoCatenary, hang};
use tunnelproof::broad::Method;
use tunnelproof::narrow::NarrowPhase;
use tunnelproof::query::Point;
use tunnelproof::wire::{
    self, BodyId, BodyPlan, Collisions, Mesh, Mode, ModelError, WirePlan, World,
};

/// The most parts of a catenary; where a wire is resolved more finely, they are straight.
const MOST_PARTS: f64 = 1e4;

impl Scene {
    /// The world as it starts. Bodies and wires have the order of the file.
    ///
    /// # Errors
    ///
    /// The value that is refused, and where it is. None for a scene as it was read.
    pub fn world(&self) -> Result<World, SceneError> {
        check::positive("duration", self.duration)
            .and_then(|()| check::not_negative("friction", self.friction))
            .and_then(|()| check::share("guarded_thickness", self.guarded_thickness))
            .map_err(|error| refused(&[], error))?;
        let settings = self.settings.clone();
        let mut world = World::new(settings).map_err(|error| refused(&[&"settings"], error))?;
        once("bodies", self.bodies.iter().map(|body| &body.name))?;
        once("wires", self.wires.iter().map(|wire| &wire.name))?;
        for (k, body) in self.bodies.iter().enumerate() {
            let add = |plan| world.add_body(plan);
            body.plan()
                .and_then(add)
                .map_err(|error| refused(&[&"bodies", &k], error))?;
        }
        for (k, wire) in self.wires.iter().enumerate() {
            let (plan, entries) = self.plan(&world, k, wire)?;
            world
                .add_wire(&plan)
                .map_err(|error| on_route(k, &entries, error))?;
        }
        Ok(world)
    }

    /// How its wires and bodies collide.
    ///
    /// # Errors
    ///
    /// A friction or a share of the thickness that is refused. None for a scene as it was read.
    pub fn collisions<'n>(
        &self,
        mode: Mode,
        narrow: &'n dyn NarrowPhase,
    ) -> Result<Collisions<'n>, SceneError> {
        let collisions = Collisions::new(mode, Method::default(), narrow);
        let collisions = collisions.with_friction(self.friction);
        let collisions = collisions
            .and_then(|collisions| collisions.with_guarded_thickness(self.guarded_thickness))
            .map_err(|error| refused(&[], error))?;
        Ok(if self.contact_nodes {
            collisions
        } else {
            collisions.without_contact_nodes()
        })
    }

    /// The plan of a wire, and of each stop of its route the entry of the file.
    fn plan(
        &self,
        world: &World,
        k: usize,
        wire: &Wire,
    ) -> Result<(WirePlan, Vec<usize>), SceneError> {
        let mut route = Vec::new();
        let mut entries = Vec::new();
        let wrong = |at: usize, name: &str, reason| {
            SceneError::new(&[&"wires", &k, &"route", &at, &name], reason)
        };
        // Where a wire hangs, the stop after it has to be there too.
        let stops = wire.route.iter().enumerate().map(|(at, stop)| {
            self.stop(stop).map_err(|name| {
                let bodies = self.bodies.iter().map(|body| body.name.clone()).collect();
                wrong(at, "body", Reason::NoBody { name, bodies })
            })
        });
        let stops: Vec<_> = stops.collect::<Result<_, _>>()?;
        for (at, (stop, entry)) in stops.into_iter().zip(&wire.route).enumerate() {
            match (stop, entry) {
                (Some(stop), _) => {
                    route.push(stop);
                    entries.push(at);
                }
                (None, &Stop::Hang(length)) => {
                    let points = self
                        .hanging(world, wire, at, length)
                        .map_err(|why| wrong(at, "hang", Reason::Hang { length, why }))?;
                    entries.extend(points.iter().map(|_| at));
                    route.extend(points.into_iter().map(wire::Stop::Free));
                }
                (None, _) => {}
            }
        }
        let material = wire.material.plan();
        let material = material.map_err(|(field, reason)| {
            SceneError::new(&[&"wires", &k, &"material", &field], reason)
        })?;
        let mut plan = WirePlan::new(material, wire.resolution, route);
        plan.resolution.adaptive = wire.adaptive;
        plan.length = wire.length;
        plan.velocity = wire.velocity.into();
        plan.twist = wire.twist;
        let phase = |phase: &ReelPhase| wire::ReelPhase {
            from: phase.from,
            speed: phase.speed,
        };
        plan.reel = wire.reel.iter().map(phase).collect();
        Ok((plan, entries))
    }

    /// A stop of a route, none where the wire hangs; or the body that is not there.
    fn stop(&self, stop: &Stop) -> Result<Option<wire::Stop>, String> {
        let body = |name: &String| {
            let found = self.bodies.iter().position(|body| body.name == *name);
            found.map(BodyId).ok_or_else(|| name.clone())
        };
        Ok(Some(match stop {
            Stop::Free(at) => wire::Stop::Free((*at).into()),
            Stop::Pinned(at) => wire::Stop::Pinned((*at).into()),
            Stop::Eye { body: name, local } => wire::Stop::Eye {
                body: body(name)?,
                local: (*local).into(),
            },
            Stop::Contact {
                body: name,
                local,
                normal,
                friction,
            } => wire::Stop::Contact {
                body: body(name)?,
                local: (*local).into(),
                normal: (*normal).into(),
                friction: *friction,
            },
            Stop::Hang(_) => return Ok(None),
        }))
    }

    /// Free nodes between the stops before and after a place of a route.
    fn hanging(
        &self,
        world: &World,
        wire: &Wire,
        at: usize,
        length: f64,
    ) -> Result<Vec<Point>, NoCatenary> {
        let point = |stop: Option<&Stop>| match self.stop(stop?).ok()?? {
            wire::Stop::Free(at) | wire::Stop::Pinned(at) => Some(at),
            wire::Stop::Eye { body, local } | wire::Stop::Contact { body, local, .. } => {
                Some(world.bodies().get(body.0)?.point(&local))
            }
        };
        let beside = [at.checked_sub(1), Some(at + 1)];
        let [Some(from), Some(to)] = beside.map(|at| point(wire.route.get(at?))) else {
            return Err(NoCatenary::AtEnd);
        };
        let count = (length / wire.resolution).clamp(1.0, MOST_PARTS) as usize;
        hang([from, to], length, &self.settings.gravity, count)
    }
}

impl Body {
    fn plan(&self) -> Result<BodyPlan, ModelError> {
        let fixed = BodyPlan::fixed(self.shape.plan()?, self.position.into());
        Ok(BodyPlan {
            drive: self.drive.plan(),
            orientation: self
                .turn
                .map_or(Ok(fixed.orientation), |turn| turn.plan())?,
            ..fixed
        })
    }
}

impl Turn {
    fn plan(&self) -> Result<UnitQuaternion<f64>, ModelError> {
        check::finite("degrees", self.degrees)?;
        let half = self.degrees.to_radians() / 2.0;
        let axis = check::direction("axis", &self.axis.into())?;
        let quaternion = Quaternion::from_parts(libm::cos(half), axis * libm::sin(half));
        Ok(UnitQuaternion::new_normalize(quaternion))
    }
}

impl Shape {
    fn plan(&self) -> Result<wire::Shape, ModelError> {
        Ok(match *self {
            Shape::Box { half } => wire::Shape::Box { half: half.into() },
            Shape::Cylinder {
                radius,
                half_height,
            } => wire::Shape::Cylinder {
                radius,
                half_height,
            },
            Shape::Sphere { radius } => wire::Shape::Sphere { radius },
            Shape::Capsule {
                radius,
                half_height,
            } => wire::Shape::Capsule {
                radius,
                half_height,
            },
            Shape::Plane => wire::Shape::Plane,
            Shape::Mesh {
                ref vertices,
                ref triangles,
            } => {
                let vertices = vertices.iter().map(|&vertex| vertex.into()).collect();
                wire::Shape::Mesh(Mesh::new(vertices, triangles.clone())?)
            }
        })
    }
}

impl Drive {
    fn plan(&self) -> wire::Drive {
        match self {
            Drive::Static => wire::Drive::Static,
            Drive::Kinematic(phases) => {
                let phases = phases.iter().map(|phase| wire::Phase {
                    from: phase.from,
                    velocity: phase.velocity.into(),
                    angular_velocity: phase.angular_velocity.into(),
                });
                wire::Drive::Kinematic(phases.collect())
            }
            Drive::Dynamic(start) => wire::Drive::Dynamic {
                density: start.density,
                velocity: start.velocity.into(),
                angular_velocity: start.angular_velocity.into(),
            },
        }
    }
}

impl Material {
    /// As the model has it, or a field and what is wrong with it.
    fn plan(&self) -> Result<wire::Material, (&'static str, Reason)> {
        let steel = wire::Material::steel(self.radius);
        let (area, second_moment) = (steel.area(), steel.second_moment());
        let is_chain = [self.bend_modulus, self.bend_stiffness].contains(&Some(0.0));
        if let Some(value) = self
            .twist_stiffness
            .filter(|&value| is_chain && value > 0.0)
        {
            let (field, accepted) = ("twist_stiffness", "0 for a chain");
            let error = ModelError::Value {
                field,
                value,
                accepted,
            };
            return Err((field, Reason::Model(error)));
        }
        let density = self.modulus(
            ["density", "mass_per_length"],
            [self.density, self.mass_per_length],
            area,
            check::positive,
        )?;
        let stretch = self.modulus(
            ["stretch_modulus", "stretch_stiffness"],
            [self.stretch_modulus, self.stretch_stiffness],
            area,
            check::positive,
        )?;
        let bend = self.modulus(
            ["bend_modulus", "bend_stiffness"],
            [self.bend_modulus, self.bend_stiffness],
            second_moment,
            check::not_negative,
        )?;
        let twist = self.modulus(
            ["twist_modulus", "twist_stiffness"],
            [self.twist_modulus, self.twist_stiffness],
            2.0 * second_moment,
            check::not_negative,
        )?;
        Ok(wire::Material {
            density: density.unwrap_or(steel.density),
            radius: steel.radius,
            stretch_modulus: stretch.unwrap_or(steel.stretch_modulus),
            bend_modulus: bend.unwrap_or(steel.bend_modulus),
            twist_modulus: twist.unwrap_or(steel.twist_modulus),
            stretch_damping: self.stretch_damping.unwrap_or(steel.stretch_damping),
            bend_damping: self.bend_damping.unwrap_or(steel.bend_damping),
            twist_damping: self.twist_damping.unwrap_or(steel.twist_damping),
        })
    }

    /// A modulus, from the field that has it or from the one that has the stiffness of the whole wire,
    /// `factor` times as much, which has to be `accepted`.
    fn modulus(
        &self,
        [of_material, of_wire]: [&'static str; 2],
        [modulus, stiffness]: [Option<f64>; 2],
        factor: f64,
        accepted: fn(&'static str, f64) -> Result<(), ModelError>,
    ) -> Result<Option<f64>, (&'static str, Reason)> {
        let refused = |field| move |error| (field, Reason::Model(error));
        let Some(stiffness) = stiffness else {
            modulus
                .map_or(Ok(()), |modulus| accepted(of_material, modulus))
                .map_err(refused(of_material))?;
            return Ok(modulus);
        };
        if modulus.is_some() {
            return Err((of_wire, Reason::Both(of_material)));
        }
        check::positive("radius", self.radius).map_err(refused("radius"))?;
        accepted(of_wire, stiffness).map_err(refused(of_wire))?;
        Ok(Some(stiffness / factor))
    }
}

/// No name is there twice.
fn once<'a>(list: &'static str, names: impl Iterator<Item = &'a String>) -> Result<(), SceneError> {
    let mut seen = std::collections::BTreeSet::new();
    for (k, name) in names.enumerate() {
        if !seen.insert(name) {
            let reason = Reason::Twice(name.clone());
            return Err(SceneError::new(&[&list, &k, &"name"], reason));
        }
    }
    Ok(())
}

/// An error of the model at a path, with the field that it names.
fn refused(path: &[&dyn Display], error: ModelError) -> SceneError {
    let mut path = path.to_vec();
    let field = match error {
        // What the model calls otherwise than the file.
        ModelError::Value { field, .. } => match field {
            "half edge" => Some("half"),
            "vertex" | "volume of the mesh" => Some("vertices"),
            "mass" | "inertia" => Some("shape"),
            "length of the route" => Some("route"),
            field => Some(field),
        },
        ModelError::Vertex { .. } | ModelError::OpenMesh { .. } => Some("triangles"),
        ModelError::Massless { .. } => Some("shape"),
        ModelError::PhaseOrder { .. } => Some("kinematic"),
        ModelError::ShortRoute { .. } => Some("route"),
        ModelError::ReelOrder { .. } | ModelError::ReelAtFreeEnd | ModelError::ReelAtClamp => {
            Some("reel")
        }
        _ => None,
    };
    path.extend(field.iter().map(|field| field as &dyn Display));
    SceneError::new(&path, Reason::Model(error))
}

/// An error of the model in a wire; its stops are counted as in the file.
fn on_route(k: usize, entries: &[usize], error: ModelError) -> SceneError {
    match error {
        ModelError::ZeroLength { stop } | ModelError::ContactAtEnd { stop } => {
            let entry = entries.get(stop).copied().unwrap_or(stop);
            let error = match error {
                ModelError::ZeroLength { .. } => ModelError::ZeroLength { stop: entry },
                _ => ModelError::ContactAtEnd { stop: entry },
            };
            let path: [&dyn Display; 4] = [&"wires", &k, &"route", &entry];
            SceneError::new(&path, Reason::Model(error))
        }
        error => refused(&[&"wires", &k], error),
    }
}
