//! What stands in each other where a run starts.

use std::fmt;

use serde::Serialize;
use tunnelproof::wire::{ContactSite, StepRecord, World};

use crate::scenes::Scene;

/// The part of a wire's radius by which it may stand in something.
const OF_RADIUS: f64 = 0.1;

/// How far two bodies may stand in each other, in m.
const OF_BODIES: f64 = 1e-3;

/// Two wires or bodies whose surfaces are in each other at the start: contacts push them apart, and that takes and gives
/// energy.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Overlap {
    /// Their names in the scene, and where on a wire.
    pub between: [String; 2],
    /// How deep, in m.
    pub depth: f64,
}

/// Adds those of a step if it is the first of a scene, or of wires in wires if it is the second, to which their contacts are
/// known: the deepest of every two, and the deepest first.
pub(super) fn add(list: &mut Vec<Overlap>, record: &StepRecord, world: &World, scene: &Scene) {
    if record.step > 1 {
        return;
    }
    let is_of_wires = |sites: &[ContactSite; 2]| {
        let mut sites = sites.iter();
        sites.all(|site| matches!(site, ContactSite::Wire { .. }))
    };
    let mut deepest: Vec<([usize; 2], Overlap)> = Vec::new();
    for contact in &record.contacts {
        let sites = [contact.contact.a, contact.contact.b];
        let depth = -contact.contact.gap;
        if depth <= allowed(sites, world) || is_of_wires(&sites) != (record.step == 1) {
            continue;
        }
        let mut pair = sites.map(|site| number(site, world));
        pair.sort_unstable();
        let between = sites.map(|site| name(site, scene));
        let overlap = Overlap { between, depth };
        match deepest.iter_mut().find(|(of, _)| *of == pair) {
            None => deepest.push((pair, overlap)),
            Some((_, known)) if depth > known.depth => *known = overlap,
            Some(_) => {}
        }
    }
    list.extend(deepest.into_iter().map(|(_, overlap)| overlap));
    list.sort_by(|a, b| b.depth.total_cmp(&a.depth));
}

/// How deep two may stand in each other without a word: a contact holds its load by a little of that.
fn allowed(sites: [ContactSite; 2], world: &World) -> f64 {
    let radii = sites.into_iter().filter_map(|site| match site {
        ContactSite::Wire { wire, .. } => Some(world.wires()[wire.0].material().radius),
        _ => None,
    });
    let thinnest = radii.reduce(f64::min);
    thinnest.map_or(OF_BODIES, |radius| OF_RADIUS * radius)
}

/// Wires first, then bodies, then the world.
fn number(site: ContactSite, world: &World) -> usize {
    match site {
        ContactSite::Wire { wire, .. } => wire.0,
        ContactSite::Body { body, .. } => world.wires().len() + body.0,
        ContactSite::World => usize::MAX,
    }
}

fn name(site: ContactSite, scene: &Scene) -> String {
    match site {
        ContactSite::Wire { wire, arc } => format!("{} at {arc:.3} m", scene.wires[wire.0].name),
        ContactSite::Body { body, .. } => scene.bodies[body.0].name.clone(),
        ContactSite::World => "the world".to_owned(),
    }
}

impl fmt::Display for Overlap {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [one, other] = &self.between;
        write!(f, "{one} and {other}: {:.3} mm", 1e3 * self.depth)
    }
}

#[cfg(test)]
mod tests {
    use crate::scenes::Scene;
    use crate::simulate::Summary;

    /// What is said of a rope that starts so high over a box, and of a ball that starts so high over it.
    fn said(rope: f64, ball: f64) -> Vec<String> {
        let text = format!(
            "title = \"laid\"\nduration = 0.1\n\
             [[bodies]]\nname = \"box\"\nshape = {{ box = {{ half = [1, 1, 0.5] }} }}\nposition = [0, 0, -0.5]\n\
             [[bodies]]\nname = \"ball\"\nshape = {{ sphere = {{ radius = 0.1 }} }}\nposition = [0.7, 0.7, {ball}]\n\
             drive = {{ dynamic = {{ density = 1000 }} }}\n\
             [[wires]]\nname = \"rope\"\nresolution = 0.25\nmaterial = {{ radius = 0.01, bend_modulus = 3e8 }}\n\
             route = [{{ free = [-0.5, 0, {rope}] }}, {{ free = [0.5, 0, {rope}] }}]\n"
        );
        let scene = Scene::from_toml(&text).unwrap();
        let summary = Summary::of_guarded(&scene).unwrap();
        summary.overlaps.iter().map(ToString::to_string).collect()
    }

    #[test]
    fn what_stands_in_a_body_at_the_start_is_named_the_deepest_first() {
        assert!(said(0.01, 0.1).is_empty());
        assert!(said(0.0095, 0.0995).is_empty());
        let [rope, ball] = &said(0.004, 0.097)[..] else {
            panic!("two overlaps");
        };
        assert!(rope.starts_with("rope at ") && rope.ends_with(" m and box: 6.000 mm"));
        assert!(["box and ball: 3.000 mm", "ball and box: 3.000 mm"].contains(&ball.as_str()));
    }

    #[test]
    fn wires_that_stand_in_each_other_at_the_start_are_named() {
        let text = "title = \"crossed\"\nduration = 0.1\nsettings = { gravity = [0, 0, 0] }\n\
             [[wires]]\nname = \"one\"\nresolution = 0.5\nmaterial = { radius = 0.01, bend_modulus = 3e8 }\n\
             route = [{ pinned = [-1, 0, 0] }, { pinned = [1, 0, 0] }]\n\
             [[wires]]\nname = \"other\"\nresolution = 0.5\nmaterial = { radius = 0.01, bend_modulus = 3e8 }\n\
             route = [{ pinned = [0.1, -1, HEIGHT] }, { pinned = [0.1, 1, HEIGHT] }]\n";
        let said = |height: &str| {
            let scene = Scene::from_toml(&text.replace("HEIGHT", height)).unwrap();
            Summary::of_guarded(&scene).unwrap().overlaps
        };
        assert!(said("0.0199").is_empty());
        let [overlap] = &said("0.005")[..] else {
            panic!("one overlap");
        };
        assert!((overlap.depth - 0.015).abs() < 1e-3, "{overlap}");
        assert!(overlap.to_string().contains("other at "), "{overlap}");
    }
}
