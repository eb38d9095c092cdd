//! What stands in each other where a run starts.

use std::f64::consts::PI;
use std::fmt;

use serde::Serialize;
use tunnelproof::broad::{Aabb, BroadPhase, Method};
use tunnelproof::wire::{ContactSite, Node, NodeKind, StepRecord, WireId, World};
use tunnelproof::{EdgeEdge, decide_discrete};

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

/// Two that are in each other, by the numbers of [`number`].
type Found = ([usize; 2], Overlap);

/// Adds those of bodies, and of wires in bodies, of the first step of a scene: the deepest first.
pub(super) fn add(list: &mut Vec<Overlap>, record: &StepRecord, world: &World, scene: &Scene) {
    if record.step > 0 {
        return;
    }
    let mut deepest = Vec::new();
    for contact in &record.contacts {
        let sites = [contact.contact.a, contact.contact.b];
        let depth = -contact.contact.gap;
        let is_of_wires = sites
            .iter()
            .all(|site| matches!(site, ContactSite::Wire { .. }));
        if depth > allowed(sites, world) && !is_of_wires {
            keep_deepest(&mut deepest, sites, depth, world, scene);
        }
    }
    append(list, deepest);
}

/// Adds those of wires where a scene starts, by the distances of their segments: their contacts are known after the first step
/// only.
pub(super) fn add_wires(list: &mut Vec<Overlap>, world: &World, scene: &Scene) {
    let mut broad = BroadPhase::new(Method::SweepAndPrune);
    let mut segments = Vec::new();
    for (wire, it) in world.wires().iter().enumerate() {
        for ends in it.nodes().windows(2) {
            let points = [ends[0].position, ends[1].position];
            if let Ok(swept) = Aabb::swept(&points, &points, it.material().radius) {
                broad.insert(swept);
                segments.push((WireId(wire), &ends[0], &ends[1]));
            }
        }
    }
    let mut deepest = Vec::new();
    for pair in broad.pairs(|_| true) {
        let of = [pair.first(), pair.second()].map(|item| segments[item.index()]);
        let [(one, a, b), (other, c, d)] = of;
        let is_joined = [a, b]
            .iter()
            .any(|x| [c, d].iter().any(|y| are_joined(x, y)));
        let radii = [one, other].map(|wire| world.wires()[wire.0].material().radius);
        let points = [a, b, c, d].map(|node| node.position);
        let Ok(query) = EdgeEdge::at_rest(points, radii) else {
            continue;
        };
        let near = decide_discrete(&query);
        let arc = |start: &Node, end: &Node, u: f64| start.arc + u * (end.arc - start.arc);
        let arcs = [arc(a, b, near.nearest.u), arc(c, d, near.nearest.v)];
        let sites = [(one, arcs[0]), (other, arcs[1])];
        let sites = sites.map(|(wire, arc)| ContactSite::Wire { wire, arc });
        // A wire that turns back on itself takes this length along it.
        let is_bend = one == other && (arcs[1] - arcs[0]).abs() <= PI * radii[0];
        if near.depth > allowed(sites, world) && !is_bend && !is_joined {
            keep_deepest(&mut deepest, sites, near.depth, world, scene);
        }
    }
    append(list, deepest);
}

/// Whether two nodes are fixed at one place, as of two wires in one eye.
fn are_joined(x: &Node, y: &Node) -> bool {
    let is_fixed = |node: &Node| !matches!(node.kind, NodeKind::Free);
    x.position == y.position && is_fixed(x) && is_fixed(y)
}

fn keep_deepest(
    deepest: &mut Vec<Found>,
    sites: [ContactSite; 2],
    depth: f64,
    world: &World,
    scene: &Scene,
) {
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

fn append(list: &mut Vec<Overlap>, deepest: Vec<Found>) {
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
        assert!((overlap.depth - 0.015).abs() < 1e-9, "{overlap}");
        assert_eq!(overlap.between, ["one at 1.100 m", "other at 1.000 m"]);
    }

    #[test]
    fn wires_of_one_eye_and_the_bends_of_a_wire_are_no_overlap() {
        let text = "title = \"bridle\"\nduration = 0.1\nsettings = { gravity = [0, 0, 0] }\n\
             [[wires]]\nname = \"one\"\nresolution = 0.5\nmaterial = { radius = 0.01, bend_modulus = 0 }\n\
             route = [{ pinned = [0, 0, 0] }, { free = [1, 0.1, 0] }]\n\
             [[wires]]\nname = \"other\"\nresolution = 0.5\nmaterial = { radius = 0.01, bend_modulus = 0 }\n\
             route = [{ pinned = [0, 0, 0] }, { free = [1, -0.1, 0] }]\n\
             [[wires]]\nname = \"bent\"\nresolution = 0.01\nmaterial = { radius = 0.01, bend_modulus = 0 }\n\
             route = [{ pinned = [0, 5, 0] }, { free = [0.1, 5, 0] }, { free = [0.1, 5.01, 0] }]\n\
             [[wires]]\nname = \"folded\"\nresolution = 0.1\nmaterial = { radius = 0.01, bend_modulus = 0 }\n\
             route = [{ pinned = [0, 8, 0] }, { free = [1, 8, 0] }, { free = [1, 8.1, 0] }, { free = [0.05, 8.01, 0] }]\n";
        let scene = Scene::from_toml(text).unwrap();
        let overlaps = Summary::of_guarded(&scene).unwrap().overlaps;
        let [overlap] = &overlaps[..] else {
            panic!("{overlaps:?}");
        };
        assert!(
            overlap
                .between
                .iter()
                .all(|name| name.starts_with("folded at ")),
            "{overlap}"
        );
    }
}
