//! Scenes as files: bodies, wires, settings and duration in [TOML](https://toml.io), and the four
//! scenes of the thesis (4.2) in this form.
//!
//! The fields are those of [`Scene`] and of what it holds; [`Scene::schema`] has them as JSON
//! schema for editors. Every error names the line.
//!
//! ```
//! use tunnelproof_cli::scenes::Scene;
//!
//! let scene = Scene::from_toml(r#"
//! title = "A wire that holds a ball"
//! duration = 2.0
//!
//! [[bodies]]
//! name = "ball"
//! shape = { sphere = { radius = 0.1 } }
//! position = [0, 0, -2.1]
//! drive = { dynamic = { density = 1000 } }
//!
//! [[wires]]
//! name = "rope"
//! material = { radius = 0.01, bend_modulus = 0 }
//! resolution = 0.25
//! route = [{ pinned = [0, 0, 0] }, { eye = { body = "ball", local = [0, 0, 0.1] } }]
//! "#)?;
//! let mut world = scene.world()?;
//! for _ in 0..scene.steps() {
//!     world.step(&[])?;
//! }
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod build;
mod check;
mod continued;
mod error;
mod file;
mod hang;
mod kinds;
mod settings;

#[cfg(test)]
mod tests;

pub use continued::Difference;
pub use error::{Reason, SceneError};
pub use file::{Body, Drive, Dynamic, Material, Phase, ReelPhase, Scene, Shape, Stop, Turn, Wire};
pub use hang::NoCatenary;

use tunnelproof::wire::World;

/// The scenes of the thesis (4.2), in its order: name and file.
pub const EMBEDDED: [(&str, &str); 4] = [
    (
        "basic-collision",
        include_str!("../../scenes/basic-collision.toml"),
    ),
    (
        "pulling-anchor",
        include_str!("../../scenes/pulling-anchor.toml"),
    ),
    (
        "twisting-under-load",
        include_str!("../../scenes/twisting-under-load.toml"),
    ),
    (
        "chains-on-deck",
        include_str!("../../scenes/chains-on-deck.toml"),
    ),
];

impl Scene {
    /// A scene of the thesis by its name in [`EMBEDDED`].
    ///
    /// # Errors
    ///
    /// [`Reason::Unknown`] for any other name.
    pub fn embedded(name: &str) -> Result<Self, SceneError> {
        match EMBEDDED.iter().find(|(known, _)| *known == name) {
            Some((_, text)) => Scene::from_toml(text),
            None => Err(SceneError::new(&[], Reason::Unknown(name.to_owned()))),
        }
    }

    /// Reads a scene file, and sees to it that [`world`](Self::world) will build.
    ///
    /// # Errors
    ///
    /// What is wrong, with its line: TOML that cannot be read, a field that is missing, unknown or of
    /// another kind, or a value that the model refuses.
    pub fn from_toml(text: &str) -> Result<Self, SceneError> {
        kinds::check(text)?;
        let scene: Scene = toml::from_str(text)?;
        match scene.world() {
            Ok(_) => Ok(scene),
            Err(error) => Err(error.in_file(text)),
        }
    }

    /// The JSON schema of scene files.
    pub fn schema() -> serde_json::Value {
        schemars::schema_for!(Scene).to_value()
    }

    /// How many steps its duration is.
    pub fn steps(&self) -> u64 {
        (self.duration / self.settings.step).round() as u64
    }

    /// How many of these are left, of the time of a world.
    pub fn steps_from(&self, world: &World) -> u64 {
        let done = (world.time() / self.settings.step).round() as u64;
        self.steps().saturating_sub(done)
    }
}
