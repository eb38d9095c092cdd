//! The same with a share of the thickness guarded, by the exact oracle: no two segments ever come
//! within it that were apart, and none come nearer that were not.
//!
//! How far two segments are apart at the start is decided by rational arithmetic, the motion by the
//! oracle with a radius. A plane that leaves a wide margin between the two saves the question.

use std::f64::consts::FRAC_2_PI;

use num_rational::BigRational;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use tunnelproof::certified::Certified;
use tunnelproof::decide_discrete;
use tunnelproof::narrow::{NarrowPhase, Report, Unsupported};
use tunnelproof::query::{EdgeEdge, Point, Query};
use tunnelproof::wire::{
    Collisions, Material, Mode, Remesh, RemeshKind, StepRecord, Stop, WirePlan, World,
};
use tunnelproof_reference::instant::Instant;
use tunnelproof_reference::oracle::decide_query;

use super::{STEPS, collisions, is_touching, scene, scenes, vector, wires};

/// A segment where a motion starts and where it ends.
#[derive(Clone, Copy)]
struct Moving {
    wire: usize,
    segment: usize,
    arcs: [f64; 2],
    radius: f64,
    start: [Point; 2],
    end: [Point; 2],
}

/// What happened in some scenes.
#[derive(Debug, Default)]
struct Tally {
    steps: usize,
    refused_steps: usize,
    prevented: usize,
    held: usize,
    remeshed: usize,
    refused: usize,
    /// Pairs near enough to ask about, those that started within the guarded thickness among them,
    /// and those of one wire.
    pairs: [usize; 3],
    /// Pairs that came within the guarded thickness, and pairs that were within and came nearer.
    nearer: [usize; 2],
    /// The same of changes of resolution.
    nearer_remeshing: [usize; 2],
}

/// A scene with a thick chain in it, crumpled, whose segments are shorter than it is thick.
fn thick_scene(seed: u64) -> World {
    let mut world = scene(seed);
    let rng = &mut ChaCha8Rng::seed_from_u64(!seed);
    let radius = rng.random_range(0.01..0.05);
    let mut point = Point::from(vector(rng, 1.0));
    let mut route = vec![Stop::Free(point)];
    for _ in 0..rng.random_range(5..20) {
        point += vector(rng, 2.0 * radius);
        route.push(Stop::Free(point));
    }
    let mut plan = WirePlan::new(Material::steel(radius).chain(), 4.0 * radius, route);
    let speed = [0.0, 1.0, 30.0][rng.random_range(0..3)];
    plan.velocity = vector(rng, speed);
    plan.resolution.adaptive = rng.random_bool(0.5);
    world.add_wire(&plan).unwrap();
    world
}

fn moving(record: &StepRecord) -> Vec<Moving> {
    let segments = |(wire, of): (usize, &tunnelproof::wire::WireRecord)| {
        let two = |points: &[Point], k: usize| [points[k], points[k + 1]];
        let all = (0..of.tensions.len()).map(|segment| Moving {
            wire,
            segment,
            arcs: [of.arcs[segment], of.arcs[segment + 1]],
            radius: of.radius,
            start: two(&of.before, segment),
            end: two(&of.after, segment),
        });
        all.collect::<Vec<_>>()
    };
    record.wires.iter().enumerate().flat_map(segments).collect()
}

fn exact(x: f64) -> BigRational {
    BigRational::from_float(x).unwrap()
}

/// The radii of step `j` of 64 of a share of two radii.
fn radii(kappa: f64, radii: [f64; 2], j: u32) -> [f64; 2] {
    radii.map(|radius| kappa * (f64::from(j) / 64.0) * radius)
}

/// How many steps there are with such a length of wire between the two.
fn steps_with(two: [f64; 2], stretch: Option<f64>) -> u32 {
    let share = stretch.map_or(1.0, |length| FRAC_2_PI * length / (two[0] + two[1]));
    (share.min(1.0) * 64.0) as u32
}

/// The last step that two segments are beyond.
fn beyond(kappa: f64, two: [f64; 2], points: &[Point; 4], most: u32) -> u32 {
    let squared = Instant::new(points).squared;
    let is_beyond = |j: &u32| {
        let [r, s] = radii(kappa, two, *j).map(exact);
        let sum = r + s;
        &sum * &sum < squared
    };
    (1..=most).rev().find(is_beyond).unwrap_or(0)
}

/// Whether a motion comes within a distance.
fn comes_within(start: [Point; 4], end: [Point; 4], radii: [f64; 2]) -> bool {
    const WIDE: f64 = 1e-9;
    let apart = |points: &[Point; 4]| {
        let query = EdgeEdge::at_rest(*points, 0.0).unwrap();
        let Some(normal) = decide_discrete(&query).normal else {
            return false;
        };
        let along = |[a, b, c, d]: &[Point; 4]| {
            let ways = [c - a, c - b, d - a, d - b];
            let along = ways.iter().map(|way| way.dot(&normal));
            along.fold(f64::INFINITY, f64::min)
        };
        along(&start).min(along(&end)) > radii[0] + radii[1] + WIDE
    };
    let query = EdgeEdge::new(start, end, radii).unwrap();
    !apart(&start) && decide_query(&Query::EdgeEdge(query)).hit.is_some()
}

/// Whether boxes around four points, two and two, come within a distance.
fn boxes_meet(first: &[Point], second: &[Point], distance: f64) -> bool {
    (0..3).all(|axis| {
        let range = |points: &[Point]| {
            let of = points.iter().map(|point| point[axis]);
            let low = of.clone().fold(f64::INFINITY, f64::min);
            (low, of.fold(f64::NEG_INFINITY, f64::max))
        };
        let ((low, high), (other_low, other_high)) = (range(first), range(second));
        low <= other_high + distance && other_low <= high + distance
    })
}

impl Tally {
    fn motions(&mut self, record: &StepRecord, kappa: f64) {
        let segments = moving(record);
        for (k, b) in segments.iter().enumerate() {
            for a in &segments[..k] {
                let one_wire = a.wire == b.wire;
                let boxes = [a, b].map(|s| [s.start, s.end].concat());
                if one_wire && b.segment - a.segment <= 1
                    || !boxes_meet(&boxes[0], &boxes[1], a.radius + b.radius)
                {
                    continue;
                }
                let two = [a.radius, b.radius];
                let most = steps_with(two, one_wire.then(|| b.arcs[0] - a.arcs[1]));
                let four = |a: [Point; 2], b: [Point; 2]| [a[0], a[1], b[0], b[1]];
                let [start, end] = [four(a.start, b.start), four(a.end, b.end)];
                let step = beyond(kappa, two, &start, most);
                self.pairs[0] += 1;
                self.pairs[1] += usize::from(step < most);
                self.pairs[2] += usize::from(one_wire);
                if comes_within(start, end, radii(kappa, two, step)) {
                    self.nearer[usize::from(step < most)] += 1;
                }
            }
        }
    }

    /// Changes of resolution one by one, swept around the middle of the triangle.
    fn remeshes(&mut self, record: &StepRecord, kappa: f64) {
        let mut wires: Vec<Vec<(f64, Point)>> = (record.wires.iter())
            .map(|wire| wire.arcs.iter().copied().zip(wire.after.iter().copied()))
            .map(Iterator::collect)
            .collect();
        for slide in &record.slides {
            wires[slide.wire.0][slide.node].0 += slide.distance;
        }
        for change in &record.remeshes {
            self.remesh(record, &mut wires, change, kappa);
        }
    }

    fn remesh(
        &mut self,
        record: &StepRecord,
        wires: &mut [Vec<(f64, Point)>],
        change: &Remesh,
        kappa: f64,
    ) {
        let [a, b, c] = change.triangle;
        let [from, middle, to] = change.arcs;
        let own = match change.kind {
            RemeshKind::Merge => vec![[a, b], [b, c]],
            RemeshKind::Split => vec![[a, c]],
        };
        for (w, wire) in wires.iter().enumerate() {
            for nodes in wire.windows(2) {
                let one_wire = w == change.wire.0;
                let [p, q] = [nodes[0].1, nodes[1].1];
                let two = [change.wire.0, w].map(|w| record.wires[w].radius);
                let stretch = (nodes[0].0 - to).max(from - nodes[1].0);
                if one_wire && stretch <= 0.0 || !boxes_meet(&[a, b, c], &[p, q], two[0] + two[1]) {
                    continue;
                }
                let most = steps_with(two, one_wire.then_some(stretch));
                let steps = own
                    .iter()
                    .map(|[a, b]| beyond(kappa, two, &[*a, *b, p, q], most));
                let step = steps.min().unwrap();
                if comes_within([a, b, p, q], [c, b, p, q], radii(kappa, two, step)) {
                    self.nearer_remeshing[usize::from(step < most)] += 1;
                }
            }
        }
        let wire = &mut wires[change.wire.0];
        let at = wire.partition_point(|(arc, _)| *arc < middle);
        match change.kind {
            RemeshKind::Merge => drop(wire.remove(at)),
            RemeshKind::Split => wire.insert(at, (middle, b)),
        }
    }

    fn scene(&mut self, seed: u64, kappa: f64, collisions: Collisions<'_>) -> World {
        let mut collisions = collisions.with_guarded_thickness(kappa).unwrap();
        let mut world = thick_scene(seed);
        for _ in 0..STEPS {
            let before = wires(&world);
            match world.step_colliding(&mut collisions, &[]) {
                Ok(record) => {
                    self.steps += 1;
                    self.prevented += record.collisions.crossings.len();
                    self.held += record.collisions.scaled_islands.len();
                    self.remeshed += record.remeshes.len();
                    self.refused += record.collisions.refused_remeshes;
                    self.motions(&record, kappa);
                    self.remeshes(&record, kappa);
                }
                Err(error) => {
                    println!("seed {seed}: {error}");
                    assert_eq!(before, wires(&world));
                    assert!(!is_touching(&error.reason), "seed {seed}: {error}");
                    self.refused_steps += 1;
                    return world;
                }
            }
        }
        world
    }
}

/// A share of the thickness for each scene.
fn kappa(seed: u64) -> f64 {
    [0.5, 0.25, 0.9, 0.5][seed as usize % 4]
}

#[test]
fn guard_keeps_a_share_of_the_thickness() {
    let scenes = scenes(20);
    let mut tally = Tally::default();
    for seed in scenes.clone() {
        tally.scene(seed, kappa(seed), collisions(seed));
        let nearer = [tally.nearer, tally.nearer_remeshing];
        assert_eq!(nearer, [[0; 2]; 2], "scene of seed {seed}: {tally:?}");
    }
    println!("scenes {scenes:?} with thickness: {tally:?}");
    assert_eq!(tally.refused_steps, 0);
    // All parts of guard mode took part.
    assert!(tally.prevented > 0 && tally.held > 0 && tally.remeshed > 0 && tally.refused > 0);
    assert!(tally.pairs.iter().all(|count| *count > 0), "{tally:?}");
}

/// A tangle of chains in which most steps are cut short. Once a wire slid farther over a contact
/// node than there was wire for and was stretched, and so on with ever more energy until a system
/// could not be factored.
#[test]
fn guard_does_every_step_of_a_thick_scene_that_was_hard() {
    const SEED: u64 = 4499;
    let mut tally = Tally::default();
    let world = tally.scene(SEED, kappa(SEED), collisions(SEED));
    assert_eq!(tally.steps, STEPS, "{tally:?}");
    let points = wires(&world).into_iter().flatten();
    let farthest = points.fold(0.0, |most: f64, (_, point)| most.max(point.coords.amax()));
    assert!(farthest < 20.0, "{farthest} m");
}

/// The certified path with half of the radius.
struct Half;

impl NarrowPhase for Half {
    fn name(&self) -> &str {
        "half"
    }

    fn edge_edge(&self, query: &EdgeEdge) -> Result<Report, Unsupported> {
        let parts = query.radius().parts().map(|part| part / 2.0);
        let half = EdgeEdge::new(*query.start(), *query.end(), parts).unwrap();
        Certified.edge_edge(&half)
    }
}

#[test]
fn soak_finds_a_guard_of_half_the_thickness() {
    let mut tally = Tally::default();
    for seed in 0..20 {
        let collisions = Collisions::new(Mode::Guard, Default::default(), &Half);
        tally.scene(seed, kappa(seed), collisions);
    }
    // Of those that were apart, and of those that were not.
    assert!(tally.nearer.iter().all(|count| *count > 0), "{tally:?}");
}
