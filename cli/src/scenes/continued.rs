//! A scene that goes on from a state of its world.

use std::fmt::{self, Debug, Display};

use serde::Serialize;
use tunnelproof::query::Point;
use tunnelproof::wire::state::State;
use tunnelproof::wire::{
    Body, CollisionSettings, Collisions, NodeKind, ReelPhase, Settings, Wire, WireId, World,
};

use super::error::{Reason, SceneError};
use super::file::Scene;

/// Something that is set otherwise than it was until the state.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Difference {
    /// What: `settings.step`.
    pub what: String,
    /// As it was.
    pub was: String,
    /// As it is from now on.
    pub is: String,
}

impl Scene {
    /// Its world where a state has it, with the settings and resolutions of the scene, and what of
    /// these differs from the state. Without a difference, and with the same collisions, steps give
    /// the same bits as if there had been no stop.
    ///
    /// # Errors
    ///
    /// The scene cannot be built, or the state is of another one: bodies or wires are others, are
    /// made of something else, move by other scripts or are fixed elsewhere.
    pub fn continued(&self, state: &State) -> Result<(World, Vec<Difference>), SceneError> {
        let start = self.world()?;
        same_bodies(&start, &state.world)?;
        same_wires(&start, &state.world)?;
        let mut world = state.world.clone();
        let mut differences = of_settings(world.settings(), start.settings());
        let refused = |error| SceneError::new(&[&"settings"], Reason::Model(error));
        world
            .set_settings(start.settings().clone())
            .map_err(refused)?;
        for (k, (was, is)) in state.world.wires().iter().zip(start.wires()).enumerate() {
            let [was, is] = [was, is].map(Wire::resolution);
            differences.extend(difference(
                format!("wires[{k}].resolution"),
                &was.length,
                &is.length,
            ));
            differences.extend(difference(
                format!("wires[{k}].adaptive"),
                &was.adaptive,
                &is.adaptive,
            ));
            let refused = |error| SceneError::new(&[&"wires", &k], Reason::Model(error));
            world.set_resolution(WireId(k), is).map_err(refused)?;
            let [was, is] = [&state.world, &start].map(|world| world.wires()[k].reel());
            if was != is {
                differences.push(Difference {
                    what: format!("wires[{k}].reel"),
                    was: phases(was),
                    is: phases(is),
                });
            }
            world.set_reel(WireId(k), is.to_vec()).map_err(refused)?;
        }
        Ok((world, differences))
    }
}

impl Difference {
    /// What collisions do otherwise than until a state, with a narrow phase of some name.
    pub fn of_collisions(state: &State, collisions: &Collisions<'_>, narrow: &str) -> Vec<Self> {
        let (was, is): (CollisionSettings, _) = (state.settings, collisions.settings());
        [
            difference("narrow", &state.narrow.as_str(), &narrow),
            difference("mode", &was.mode, &is.mode),
            difference("friction", &was.friction, &is.friction),
            difference(
                "guarded_thickness",
                &was.guarded_thickness,
                &is.guarded_thickness,
            ),
            difference("bodies", &was.bodies, &is.bodies),
            difference("contact_nodes", &was.contact_nodes, &is.contact_nodes),
        ]
        .into_iter()
        .flatten()
        .collect()
    }
}

impl Display for Difference {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} is {}, it was {}", self.what, self.is, self.was)
    }
}

/// The phases of a reel.
fn phases(reel: &[ReelPhase]) -> String {
    let phase = |phase: &ReelPhase| format!("{} m/s from {} s", phase.speed, phase.from);
    match reel {
        [] => "none".to_owned(),
        _ => reel.iter().map(phase).collect::<Vec<_>>().join(", "),
    }
}

fn difference<T: Debug + PartialEq>(what: impl Display, was: &T, is: &T) -> Option<Difference> {
    let text = |value: &T| format!("{value:?}").to_lowercase();
    (was != is).then(|| Difference {
        what: what.to_string(),
        was: text(was),
        is: text(is),
    })
}

/// Field by field, as they are written.
fn of_settings(was: &Settings, is: &Settings) -> Vec<Difference> {
    let fields = |settings: &Settings| match serde_json::to_value(settings) {
        Ok(serde_json::Value::Object(fields)) => fields,
        // They are numbers and triples of numbers.
        _ => serde_json::Map::new(),
    };
    let (was, is) = (fields(was), fields(is));
    let both = was
        .iter()
        .filter_map(|(name, was)| Some((name, was, is.get(name)?)));
    let differing = both.filter(|(_, was, is)| was != is);
    differing
        .map(|(name, was, is)| Difference {
            what: format!("settings.{name}"),
            was: was.to_string(),
            is: is.to_string(),
        })
        .collect()
}

/// Refuses a state that has something else than the scene at a path.
fn otherwise(same: bool, path: &[&dyn Display], has: impl Display) -> Result<(), SceneError> {
    match same {
        true => Ok(()),
        false => Err(SceneError::new(path, Reason::State(has.to_string()))),
    }
}

fn same_count(list: &'static str, [expected, found]: [usize; 2]) -> Result<(), SceneError> {
    otherwise(expected == found, &[&list], found)
}

fn same_bodies(scene: &World, state: &World) -> Result<(), SceneError> {
    let [expected, found] = [scene, state].map(World::bodies);
    same_count("bodies", [expected.len(), found.len()])?;
    for (k, (expected, found)) in expected.iter().zip(found).enumerate() {
        let is = |same: bool, field: &'static str, has: &str| {
            otherwise(same, &[&"bodies", &k, &field], has)
        };
        is(expected.shape() == found.shape(), "shape", "another shape")?;
        let dynamic = [expected, found].map(Body::is_dynamic);
        let phases = [expected, found].map(Body::phases);
        is(dynamic[0] == dynamic[1], "drive", "another drive")?;
        is(phases[0] == phases[1], "drive", "other phases")?;
        is(expected.mass() == found.mass(), "drive", "another density")?;
    }
    Ok(())
}

fn same_wires(scene: &World, state: &World) -> Result<(), SceneError> {
    let [expected, found] = [scene, state].map(World::wires);
    same_count("wires", [expected.len(), found.len()])?;
    for (k, (expected, found)) in expected.iter().zip(found).enumerate() {
        let is = |same: bool, field: &'static str, has: String| {
            otherwise(same, &[&"wires", &k, &field], has)
        };
        let material = found.material();
        is(
            expected.material() == material,
            "material",
            format!("{material:?}"),
        )?;
        let length = found.length();
        // A reel changes it.
        let is_reeled = [expected, found].iter().any(|wire| !wire.reel().is_empty());
        let is_as_long = is_reeled || expected.length() == length;
        is(is_as_long, "length", format!("{length} m"))?;
        let mut fixed = [expected, found].map(fixed);
        if is_reeled {
            fixed
                .iter_mut()
                .flat_map(|all| all.last_mut())
                .for_each(|last| last.2 = 0.0);
        }
        is(
            fixed[0] == fixed[1],
            "route",
            "other fixed points".to_owned(),
        )?;
    }
    Ok(())
}

/// The points to which a wire is fixed, which no step changes: of the world and of bodies.
fn fixed(wire: &Wire) -> Vec<(NodeKind, Option<Point>, f64)> {
    let nodes = wire.nodes().iter();
    let fixed = nodes.filter_map(|node| match node.kind {
        NodeKind::Pinned => Some((node.kind, Some(node.position), node.arc)),
        NodeKind::Eye { .. } => Some((node.kind, None, node.arc)),
        _ => None,
    });
    fixed.collect()
}
