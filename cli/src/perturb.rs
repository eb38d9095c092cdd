//! Scenes that start a little elsewhere: what holds of a scene should not hang on its last
//! millimetre.

use crate::scenes::{Scene, Stop};
use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;

/// How far each coordinate is moved at most if nothing else is said, in m.
pub const USUAL: f64 = 0.001;

/// The scene with every body, and every free and every pinned point of a wire, moved along each
/// axis by up to so many metres. The same seed gives the same scene. Eyes move with their bodies;
/// lengths of wires stay what the file says, and what it leaves out follows the points.
pub fn perturbed(scene: &Scene, seed: u64, most: f64) -> Scene {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let mut scene = scene.clone();
    let bodies = scene.bodies.iter_mut().map(|body| &mut body.position);
    let stops = scene.wires.iter_mut().flat_map(|wire| &mut wire.route);
    let points = stops.filter_map(|stop| match stop {
        Stop::Free(point) | Stop::Pinned(point) => Some(point),
        Stop::Eye { .. } | Stop::Contact { .. } | Stop::Hang(_) => None,
    });
    for coordinate in bodies.chain(points).flatten() {
        *coordinate += most * rng.random_range(-1.0..=1.0);
    }
    scene
}

#[cfg(test)]
mod tests {
    use crate::scenes::EMBEDDED;

    use super::*;

    #[test]
    fn perturbed_scenes_build_and_differ_from_seed_to_seed() {
        for (name, _) in EMBEDDED {
            let scene = Scene::embedded(name).unwrap();
            assert_eq!(perturbed(&scene, 1, 0.0), scene);
            let others = [1, 2, 3].map(|seed| perturbed(&scene, seed, USUAL));
            assert_eq!(others[0], perturbed(&scene, 1, USUAL));
            for (i, other) in others.iter().enumerate() {
                assert!(others[..i].iter().all(|earlier| earlier != other), "{name}");
                other.world().expect(name);
            }
        }
    }

    #[test]
    fn perturbed_moves_nothing_farther_than_asked() {
        let scene = Scene::embedded("chains-on-deck").unwrap();
        let other = perturbed(&scene, 7, 0.01);
        for (a, b) in scene.bodies.iter().zip(&other.bodies) {
            let moves: Vec<_> = (a.position.iter().zip(b.position))
                .map(|(a, b)| (a - b).abs())
                .collect();
            assert!(moves.iter().all(|&by| by > 0.0 && by <= 0.01 + 1e-15));
        }
        assert_eq!(scene.wires[0].length, other.wires[0].length);
    }
}
