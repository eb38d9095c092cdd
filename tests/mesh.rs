//! Meshes against all their pairs, one by one, and against the oracle.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use tunnelproof::mesh::{Feature, Mesh, MeshError, MeshStep, Pair, Thickness};
use tunnelproof::query::{EdgeEdge, Point, Query, QueryKind, Radius, VertexFace};
use tunnelproof::{
    Blocked, Clearance, Coordinate, ListedPair, Pairs, Precision, advance_pairs, decide_exactly,
    interpolate_in,
};
use tunnelproof_reference::oracle::decide_query;

type Position = [f64; 3];

/// How many meshes: fewer where Rust checks its arithmetic.
const COUNT: u64 = if cfg!(debug_assertions) { 36 } else { 300 };

/// A mesh at both ends of a step.
struct Scene {
    mesh: Mesh,
    style: u32,
    groups: Vec<u32>,
    left_out: Vec<[u32; 2]>,
    start: Vec<Position>,
    end: Vec<Position>,
    thickness: Vec<f64>,
}

/// Vertices, edges and faces at random: soups, sheets, wires and points, in numbers of any kind.
fn scene(seed: u64) -> Scene {
    let rng = &mut ChaCha8Rng::seed_from_u64(seed);
    let vertices = rng.random_range(0..28u32);
    let mut index = |count: u32| -> Vec<u32> {
        match vertices {
            0 => Vec::new(),
            _ => (0..count).map(|_| rng.random_range(0..vertices)).collect(),
        }
    };
    let edges: Vec<[u32; 2]> = index(8).chunks_exact(2).map(|c| [c[0], c[1]]).collect();
    let faces: Vec<[u32; 3]> = index(24)
        .chunks_exact(3)
        .map(|c| [c[0], c[1], c[2]])
        .collect();
    let (edges, faces) = match rng.random_range(0..4) {
        0 => (edges, Vec::new()),
        1 => (Vec::new(), faces),
        _ => (edges, faces),
    };
    let style = rng.random_range(0..5);
    let scale = 10f64.powi(rng.random_range(-3..=3));
    let mut coordinate = || match style {
        0 => f64::from(rng.random_range(-3..=3)),
        1 => rng.random_range(-1.0..1.0) * scale,
        // Beside large numbers, the small ones share a cell of any grid.
        2 if rng.random_range(0..40) == 0 => rng.random_range(-1e300..1e300),
        2 => rng.random_range(-1e-3..1e-3),
        3 => 1e6 + rng.random_range(-1.0..1.0),
        _ => rng.random_range(-2.0..2.0),
    };
    let mut position = || [coordinate(), coordinate(), coordinate()];
    let start: Vec<Position> = (0..vertices).map(|_| position()).collect();
    let mut end: Vec<Position> = (0..vertices).map(|_| position()).collect();
    if style == 4 {
        for (end, start) in end.iter_mut().zip(&start) {
            *end = [0, 1, 2].map(|i| start[i] + 0.2 * end[i]);
        }
    }
    let count = rng.random_range(1..=3u32);
    let groups: Vec<u32> = (0..vertices).map(|_| rng.random_range(0..count)).collect();
    let count = groups.iter().max().map_or(1, |group| group + 1);
    let mut left_out = Vec::new();
    for first in 0..count {
        for second in first..count {
            if rng.random_range(0..4) == 0 {
                left_out.push([first, second]);
            }
        }
    }
    let is_thick = rng.random_range(0..2) == 0;
    let largest = if style == 1 { scale } else { 1.0 };
    let thickness = (0..count)
        .map(|_| match is_thick {
            true => rng.random_range(0.0..0.1) * largest,
            false => 0.0,
        })
        .collect();
    let mut mesh = Mesh::new(vertices as usize, &edges, &faces).unwrap();
    mesh.set_groups(&groups).unwrap();
    for &[first, second] in &left_out {
        mesh.leave_out(second, first).unwrap();
    }
    Scene {
        mesh,
        style,
        groups,
        left_out,
        start,
        end,
        thickness,
    }
}

impl Scene {
    /// All pairs of the mesh with their vertices, by the definition.
    fn pairs(&self) -> Vec<(Pair, [u32; 4])> {
        let mesh = &self.mesh;
        let in_edge: Vec<u32> = mesh.edges().iter().flatten().copied().collect();
        let mut segments: Vec<(Feature, [u32; 2])> = (0..)
            .zip(mesh.edges())
            .map(|(index, edge)| (Feature::Edge(index), *edge))
            .collect();
        let points = (0..mesh.vertex_count() as u32).filter(|vertex| !in_edge.contains(vertex));
        segments.extend(points.map(|vertex| (Feature::Vertex(vertex), [vertex; 2])));
        let mut pairs = Vec::new();
        for (i, &(first, [a, b])) in segments.iter().enumerate() {
            for &(second, [c, d]) in &segments[i + 1..] {
                let shared = [a, b].iter().any(|v| [c, d].contains(v));
                if !shared && !self.is_left_out(&[a, b], &[c, d]) {
                    pairs.push((Pair { first, second }, [a, b, c, d]));
                }
            }
        }
        for vertex in 0..mesh.vertex_count() as u32 {
            for (index, face) in (0..).zip(mesh.faces()) {
                if !face.contains(&vertex) && !self.is_left_out(&[vertex], face) {
                    let (first, second) = (Feature::Vertex(vertex), Feature::Face(index));
                    let [b, c, d] = *face;
                    pairs.push((Pair { first, second }, [vertex, b, c, d]));
                }
            }
        }
        pairs
    }

    fn is_left_out(&self, first: &[u32], second: &[u32]) -> bool {
        let group = |&vertex: &u32| self.groups[vertex as usize];
        first.iter().map(group).all(|g| {
            let mut others = second.iter().map(group);
            others.all(|h| self.left_out.contains(&[g.min(h), g.max(h)]))
        })
    }

    fn radius(&self, pair: Pair, vertices: &[u32; 4]) -> Radius {
        let of = |vertices: &[u32]| {
            let each = vertices
                .iter()
                .map(|&v| self.thickness[self.groups[v as usize] as usize]);
            each.fold(0.0, f64::max)
        };
        let (first, second) = vertices.split_at(match pair.second {
            Feature::Face(_) => 1,
            _ => 2,
        });
        let (first, second) = (of(first), of(second));
        if first == second {
            return first.into();
        }
        [first / 2.0, second / 2.0].into()
    }

    fn thickness(&self) -> Thickness<'_> {
        self.thickness[..].into()
    }
}

/// The query of a pair.
fn query(
    pair: Pair,
    vertices: &[u32; 4],
    start: &[Position],
    end: &[Position],
    radius: Radius,
) -> Query {
    let of = |all: &[Position]| vertices.map(|v| Point::from(all[v as usize]));
    match pair.second {
        Feature::Face(_) => Query::VertexFace(VertexFace::new(of(start), of(end), radius).unwrap()),
        _ => Query::EdgeEdge(EdgeEdge::new(of(start), of(end), radius).unwrap()),
    }
}

/// Positions rounded to `f32`, and to the largest where they are beyond it.
fn in_f32(positions: &[Position]) -> Vec<[f32; 3]> {
    let of = |x: f64| x.clamp(f32::MIN.into(), f32::MAX.into()) as f32;
    positions.iter().map(|position| position.map(of)).collect()
}

/// The same numbers in `f64`.
fn in_f64<C: Coordinate>(positions: &[[C; 3]]) -> Vec<Position> {
    let of = |position: &[C; 3]| position.map(Into::into);
    positions.iter().map(of).collect()
}

/// The time of impact of a query, by integers alone.
fn toi(query: &Query) -> Option<[f64; 2]> {
    match query {
        Query::EdgeEdge(query) => decide_exactly(query).map(|hit| [hit.toi, hit.toi_above]),
        Query::VertexFace(query) => decide_exactly(query).map(|hit| [hit.toi, hit.toi_above]),
    }
}

#[test]
fn mesh_contacts_are_those_of_all_its_pairs() {
    let (mut contacts, mut free) = (0, 0);
    for seed in 0..COUNT {
        let scene = scene(seed);
        let Scene {
            mesh, start, end, ..
        } = &scene;
        let expected: Vec<(Pair, [f64; 2])> = scene
            .pairs()
            .iter()
            .filter_map(|(pair, vertices)| {
                let radius = scene.radius(*pair, vertices);
                toi(&query(*pair, vertices, start, end, radius)).map(|toi| (*pair, toi))
            })
            .collect();
        let found = mesh.all_contacts(start, end, scene.thickness()).unwrap();
        let found: Vec<_> = found
            .iter()
            .map(|contact| (contact.pair, [contact.toi, contact.toi_above]))
            .collect();
        assert_eq!(found, expected, "seed {seed}");
        let first = mesh.first_contact(start, end, scene.thickness()).unwrap();
        let least = expected.iter().map(|(_, [toi, _])| *toi).reduce(f64::min);
        assert_eq!(first.map(|contact| contact.toi), least, "seed {seed}");
        if let Some(first) = first {
            let below = first.toi_f32();
            let [below, above] = [below, below.next_up()].map(f64::from);
            assert!(below <= first.toi && first.toi < above, "seed {seed}");
            let pair = expected.iter().find(|(_, [toi, _])| Some(*toi) == least);
            assert_eq!(first.pair, pair.unwrap().0, "seed {seed}");
        }
        let is_free = mesh.is_free(start, end, scene.thickness()).unwrap();
        assert_eq!(is_free, expected.is_empty(), "seed {seed}");
        contacts += expected.len();
        free += u64::from(is_free);
        compare_with_f32(&scene, seed);
    }
    println!("{contacts} contacts, {free} of {COUNT} meshes free");
    assert!(contacts > 5 * COUNT as usize && free > COUNT / 20);
}

/// Contacts of positions in `f32` are those of the same numbers in `f64`.
fn compare_with_f32(scene: &Scene, seed: u64) {
    let mesh = &scene.mesh;
    let [start, end] = [&scene.start, &scene.end].map(|all| in_f32(all));
    let [same_start, same_end] = [&start, &end].map(|all| in_f64(all));
    let all = mesh.all_contacts(&start, &end, scene.thickness());
    let expected = mesh.all_contacts(&same_start, &same_end, scene.thickness());
    assert_eq!(all, expected, "seed {seed}");
    let first = mesh.first_contact(&start, &end, scene.thickness());
    let expected = mesh.first_contact(&same_start, &same_end, scene.thickness());
    assert_eq!(first, expected, "seed {seed}");
    let is_free = mesh.is_free(&start, &end, scene.thickness());
    assert_eq!(is_free, all.map(|all| all.is_empty()), "seed {seed}");
    if let Some(first) = first.unwrap() {
        let query = mesh.query(first.pair, &start, &end, scene.thickness());
        let expected = mesh.query(first.pair, &same_start, &same_end, scene.thickness());
        assert_eq!(query, expected, "seed {seed}");
    }
}

/// Positions at both ends of a step, and how they are stored.
struct Ends<C> {
    start: Vec<[C; 3]>,
    end: Vec<[C; 3]>,
    precision: Precision,
}

/// What a step says is what the oracle says of the motion to its positions.
fn judge<C: Coordinate>(
    scene: &Scene,
    ends: &Ends<C>,
    step: &MeshStep<C>,
    clearance: Clearance,
    seed: u64,
) {
    let [start, end] = [&ends.start, &ends.end].map(|all| in_f64(all));
    let positions = in_f64(&step.positions);
    for (i, position) in positions.iter().enumerate() {
        let (start, end) = (&start[i].into(), &end[i].into());
        let expected = interpolate_in(start, end, step.step, ends.precision);
        assert_eq!(Point::from(*position), expected, "seed {seed}");
    }
    assert_eq!(
        step.limits.is_empty(),
        step.step == 1.0,
        "seed {seed}: {step:?}"
    );
    if step.step == 0.0 {
        return;
    }
    let beyond = match clearance {
        Clearance::Distance(distance) => distance,
        _ => 0.0,
    };
    for (pair, vertices) in scene.pairs() {
        let radius = scene.radius(pair, &vertices);
        let [first, second] = radius.parts();
        let near = step.near.iter().find(|(near, _)| *near == pair);
        let kept = match near {
            Some((_, kept)) => *kept,
            None if beyond == 0.0 => radius,
            None => [(first + second).next_down().max(0.0), beyond].into(),
        };
        let stored = query(pair, &vertices, &start, &positions, kept);
        assert!(
            decide_query(&stored).hit.is_none(),
            "seed {seed}: {pair:?} {step:?}"
        );
    }
}

/// The step of all pairs by their indices is that of the mesh, which asks those alone that its trees
/// find.
fn compare_with_pairs<C: Coordinate>(
    scene: &Scene,
    ends: &Ends<C>,
    step: &MeshStep<C>,
    clearance: Clearance,
    seed: u64,
) {
    let Ends { start, end, .. } = ends;
    let pairs = scene.pairs();
    let is_face = |pair: Pair| matches!(pair.second, Feature::Face(_));
    let list = |faces: bool| -> (Vec<Pair>, Vec<[u32; 4]>, Vec<Radius>) {
        let of_kind = pairs.iter().filter(|(pair, _)| is_face(*pair) == faces);
        let rows = of_kind.map(|(pair, all)| (*pair, *all, scene.radius(*pair, all)));
        rows.collect()
    };
    let [edges, faces] = [list(false), list(true)];
    let of_edges = Pairs::with_radii(start, end, &edges.1, &edges.2).unwrap();
    let of_faces = Pairs::with_radii(start, end, &faces.1, &faces.2).unwrap();
    let found = advance_pairs(&of_edges, &of_faces, clearance).unwrap();
    assert_eq!(
        (found.step, &found.positions),
        (step.step, &step.positions),
        "seed {seed}"
    );
    let pair = |listed: ListedPair| match listed.kind {
        QueryKind::EdgeEdge => edges.0[listed.index],
        QueryKind::VertexFace => faces.0[listed.index],
    };
    let limits = found.limits.iter();
    let limits: Vec<_> = limits
        .map(|limit| (pair(limit.pair), limit.blocked))
        .collect();
    let expected = step.limits.iter();
    let expected: Vec<_> = expected.map(|limit| (limit.pair, limit.blocked)).collect();
    assert_eq!(limits, expected, "seed {seed}");
    let near = found
        .near
        .iter()
        .map(|(listed, kept)| (pair(*listed), *kept));
    assert_eq!(near.collect::<Vec<_>>(), step.near, "seed {seed}");
}

/// How many steps of each sort there were.
#[derive(Debug, Default)]
struct Steps {
    whole: usize,
    part: usize,
    touching: usize,
    near: usize,
}

#[test]
fn mesh_steps_store_positions_that_are_apart() {
    let mut counts = [Steps::default(), Steps::default()];
    for seed in 0..COUNT / 3 {
        let scene = scene(seed);
        let Scene { start, end, .. } = &scene;
        let double = Ends {
            start: start.clone(),
            end: end.clone(),
            precision: Precision::F64,
        };
        let single = Ends {
            start: in_f32(start),
            end: in_f32(end),
            precision: Precision::F32,
        };
        let [of_double, of_single] = &mut counts;
        walk(&scene, double, 1e-6, seed, of_double);
        walk(&scene, single, 1e-3, seed, of_single);
    }
    println!("{counts:?}");
    for Steps {
        whole,
        part,
        touching,
        near,
    } in counts
    {
        assert!(whole > 0 && part > 0 && touching > 0 && near > 0);
    }
}

/// Steps from what comes of the one before. Where the time of impact is above what rounding may lose,
/// that part of it is lost at most.
fn walk<C: Coordinate>(scene: &Scene, mut ends: Ends<C>, lost: f64, seed: u64, counts: &mut Steps) {
    let mesh = &scene.mesh;
    for turn in 0..4 {
        let clearance = match seed % 3 {
            0 => Clearance::None,
            1 => Clearance::Distance(1e-3),
            _ => Clearance::Share(0.25),
        };
        let Ends { start, end, .. } = &ends;
        let step = mesh
            .step_with_clearance(start, end, scene.thickness(), clearance)
            .unwrap();
        judge(scene, &ends, &step, clearance, seed);
        compare_with_pairs(scene, &ends, &step, clearance, seed);
        counts.near += step.near.len();
        match step.step {
            0.0 => {
                counts.touching += 1;
                for limit in &step.limits {
                    assert_ne!(limit.blocked, Blocked::Ahead, "seed {seed}");
                }
            }
            1.0 => counts.whole += 1,
            _ => counts.part += 1,
        }
        // As large as rounding lets it be.
        let first = mesh.first_contact(start, end, scene.thickness()).unwrap();
        if clearance == Clearance::None && step.near.is_empty() {
            let toi = first.map_or(1.0, |contact| contact.toi);
            assert!(step.step <= toi, "seed {seed}");
            // Where the room for rounding is small beside what is moved.
            let is_ordinary = turn == 0 && matches!(scene.style, 1 | 4) && toi > lost;
            assert!(
                !is_ordinary || step.step >= (1.0 - lost) * toi,
                "seed {seed}: {toi} {step:?}"
            );
        }
        ends.start = step.positions;
    }
}

/// A closed box, and a wire, a sheet and points inside: they stay inside, exactly.
#[test]
fn mesh_in_a_box_stays_inside() {
    let rng = &mut ChaCha8Rng::seed_from_u64(7);
    let corners: Vec<Position> = (0..8)
        .map(|i| [0, 1, 2].map(|axis| if i >> axis & 1 == 1 { 1.0 } else { -1.0 }))
        .collect();
    let box_faces: Vec<[u32; 3]> = [
        [0, 1, 3, 2],
        [4, 6, 7, 5],
        [0, 4, 5, 1],
        [2, 3, 7, 6],
        [0, 2, 6, 4],
        [1, 5, 7, 3],
    ]
    .into_iter()
    .flat_map(|[a, b, c, d]: [u32; 4]| [[a, b, c], [a, c, d]])
    .collect();
    // A wire of four, a triangle, and two points.
    let edges = [[8, 9], [9, 10], [10, 11]];
    let mut faces = box_faces;
    faces.push([12, 13, 14]);
    let mesh = Mesh::new(17, &edges, &faces).unwrap();
    let mut start = corners;
    for i in 0..9 {
        let at = f64::from(i) / 10.0 - 0.4;
        start.push([at, at * at - 0.1, if i % 2 == 0 { 0.3 } else { -0.2 }]);
    }
    assert!(mesh.is_free(&start, &start, 0.0).unwrap());
    let steps = if cfg!(debug_assertions) { 300 } else { 3_000 };
    let (mut stopped, mut moved) = (0, 0);
    for step in 0..steps {
        let mut end = start.clone();
        for (i, position) in end.iter_mut().enumerate() {
            let reach = if i < 8 { 0.05 } else { 3.0 };
            // The box breathes about where it is, and what is inside flies out.
            for (axis, x) in position.iter_mut().enumerate() {
                let middle = if i < 8 {
                    if i >> axis & 1 == 1 { 1.0 } else { -1.0 }
                } else {
                    *x
                };
                *x = middle + rng.random_range(-reach..reach);
            }
        }
        let made = mesh.step(&start, &end, 0.0).unwrap();
        stopped += u32::from(made.step < 1.0);
        moved += u32::from(made.step > 0.0);
        start = made.positions;
        // Nothing touches, by the exact judge, and all that is inside stays there.
        assert!(mesh.is_free(&start, &start, 0.0).unwrap(), "step {step}");
        for i in 8..17 {
            assert!(
                is_inside(&start, &faces[..12], start[i]),
                "step {step}, vertex {i}"
            );
        }
    }
    println!("{stopped} of {steps} steps cut short, {moved} not 0");
    assert!(stopped > steps / 2 && moved > steps / 2);
}

/// Whether a point is inside a closed surface: the faces that a segment to a far point crosses are
/// odd in number. The oracle decides each.
fn is_inside(positions: &[Position], faces: &[[u32; 3]], point: Position) -> bool {
    let far = Point::new(16.37, 27.11, 41.93);
    let crossed = faces.iter().filter(|face| {
        let corners = face.map(|v| Point::from(positions[v as usize]));
        let [b, c, d] = corners;
        let start = [Point::from(point), b, c, d];
        let query = VertexFace::new(start, [far, b, c, d], 0.0).unwrap();
        decide_query(&Query::VertexFace(query)).hit.is_some()
    });
    crossed.count() % 2 == 1
}

/// A sheet that is pulled through itself, without thickness and with one, also stored in `f32`.
#[test]
fn mesh_folded_through_itself_never_passes() {
    for thickness in [0.0, 0.01] {
        fold(thickness, |x| x);
    }
    fold(0.01, |x| x as f32);
}

/// The oracle finds no contact in any stored motion, and afterwards no edge that goes through a face.
/// As many steps as `TUNNELPROOF_STEPS` says.
fn fold<C: Coordinate>(thickness: f64, of: impl Fn(f64) -> C) {
    const SIDE: u32 = 9;
    let usual = if cfg!(debug_assertions) { 30 } else { 300 };
    let steps = std::env::var("TUNNELPROOF_STEPS").map_or(usual, |steps| steps.parse().unwrap());
    let vertex = |i: u32, j: u32| i * SIDE + j;
    let quads = (0..SIDE - 1).flat_map(|i| (0..SIDE - 1).map(move |j| (i, j)));
    let faces: Vec<[u32; 3]> = quads
        .flat_map(|(i, j)| {
            let [a, b] = [vertex(i, j), vertex(i + 1, j)];
            [[a, b, a + 1], [b, b + 1, a + 1]]
        })
        .collect();
    let mesh = Mesh::new((SIDE * SIDE) as usize, &[], &faces).unwrap();
    let rng = &mut ChaCha8Rng::seed_from_u64(3);
    let flat: Vec<Position> = (0..SIDE * SIDE)
        .map(|k| [f64::from(k / SIDE) - 4.0, f64::from(k % SIDE) - 4.0, 0.0])
        .collect();
    let mut start = flat.clone();
    let (mut stopped, mut moved, mut asked) = (0, 0.0, 0);
    for step in 0..steps {
        // Its halves change places about one axis after another, each for a while; neighbours
        // hold together, and all trembles.
        let axis = (step / 40) % 2;
        let mut end = start.clone();
        for (k, position) in end.iter_mut().enumerate() {
            let (i, j) = (k as u32 / SIDE, k as u32 % SIDE);
            let rest = [
                [i.wrapping_sub(1), j],
                [i + 1, j],
                [i, j.wrapping_sub(1)],
                [i, j + 1],
            ];
            let around: Vec<Position> = rest
                .iter()
                .filter(|[i, j]| *i < SIDE && *j < SIDE)
                .map(|[i, j]| start[vertex(*i, *j) as usize])
                .collect();
            for x in 0..3 {
                let mean = around.iter().map(|p| p[x]).sum::<f64>() / around.len() as f64;
                position[x] += 0.05 * (mean - position[x]) + rng.random_range(-0.02..0.02);
            }
            let [wanted, height] = [-flat[k][axis], flat[k][axis].abs() - 2.0];
            position[axis] += 0.05 * (wanted - position[axis]);
            position[2] += 0.05 * (height - position[2]);
        }
        let [from, to] =
            [&start, &end].map(|all| all.iter().map(|x| x.map(&of)).collect::<Vec<_>>());
        let made = mesh.step(&from, &to, thickness).unwrap();
        let positions = in_f64(&made.positions);
        stopped += usize::from(made.step < 1.0);
        moved += made.step;
        let pairs = near_pairs(&mesh, &start, &positions, thickness);
        for (pair, vertices) in &pairs {
            let near = made.near.iter().find(|(near, _)| near == pair);
            let kept = near.map_or(Radius::from(thickness), |(_, kept)| *kept);
            let stored = query(*pair, vertices, &start, &positions, kept);
            let is_apart = decide_query(&stored).hit.is_none();
            assert!(made.step == 0.0 || is_apart, "step {step}: {pair:?}");
        }
        asked += pairs.len();
        start = positions;
        assert_eq!(pierced(&mesh, &start), None, "step {step}");
    }
    println!("{stopped} of {steps} steps cut short, {moved:.1} in all, {asked} pairs asked");
    assert!(stopped > steps / 2 && moved > 1.0);
}

/// The pairs of a mesh that share no vertex and whose swept boxes come within a distance, found one
/// by one.
fn near_pairs(
    mesh: &Mesh,
    start: &[Position],
    end: &[Position],
    distance: f64,
) -> Vec<(Pair, [u32; 4])> {
    let bounds = |vertices: &[u32]| {
        [0, 1, 2].map(|x| {
            let ends = vertices
                .iter()
                .flat_map(|&v| [start[v as usize][x], end[v as usize][x]]);
            ends.fold([f64::MAX, f64::MIN], |[low, high], x| {
                [low.min(x), high.max(x)]
            })
        })
    };
    let room = distance * 1.01;
    let meet = |first: &[u32], second: &[u32]| {
        let [first, second] = [bounds(first), bounds(second)];
        first
            .iter()
            .zip(second)
            .all(|(a, b)| a[0] <= b[1] + room && b[0] <= a[1] + room)
    };
    let mut pairs = Vec::new();
    let mut add = |first: Feature, second: Feature| {
        let pair = Pair { first, second };
        let vertices = mesh.vertices_of(pair).unwrap();
        let count = if matches!(second, Feature::Face(_)) {
            1
        } else {
            2
        };
        let (a, b) = vertices.split_at(count);
        if !a.iter().any(|vertex| b.contains(vertex)) && meet(a, b) {
            pairs.push((pair, vertices));
        }
    };
    let edges = mesh.edges().len() as u32;
    for first in 0..edges {
        for second in first + 1..edges {
            add(Feature::Edge(first), Feature::Edge(second));
        }
    }
    for vertex in 0..start.len() as u32 {
        for face in 0..mesh.faces().len() as u32 {
            add(Feature::Vertex(vertex), Feature::Face(face));
        }
    }
    pairs
}

/// An edge that goes through a face without a vertex of it, by the oracle: the first end moves to
/// the second.
fn pierced(mesh: &Mesh, positions: &[Position]) -> Option<([u32; 2], [u32; 3])> {
    let at = |vertex: u32| Point::from(positions[vertex as usize]);
    let is_through = |[a, b]: [u32; 2], face: [u32; 3]| {
        let apart = (0..3).any(|x| {
            let [low, high] = [f64::min, f64::max].map(|pick| pick(at(a)[x], at(b)[x]));
            face.iter().all(|&v| at(v)[x] < low) || face.iter().all(|&v| at(v)[x] > high)
        });
        if apart || face.contains(&a) || face.contains(&b) {
            return false;
        }
        let [c, d, e] = face.map(at);
        let query = VertexFace::new([at(a), c, d, e], [at(b), c, d, e], 0.0).unwrap();
        decide_query(&Query::VertexFace(query)).hit.is_some()
    };
    let mut pairs =
        (mesh.edges().iter()).flat_map(|edge| mesh.faces().iter().map(move |face| (*edge, *face)));
    pairs.find(|(edge, face)| is_through(*edge, *face))
}

#[test]
fn mesh_errors_name_the_array_the_index_and_the_value() {
    let text = |error: MeshError| error.to_string();
    let error = Mesh::new(3, &[[0, 1], [1, 3]], &[]).unwrap_err();
    assert_eq!(
        text(error),
        "edges[1][1] is vertex 3, and there are 3 vertices"
    );
    let error = Mesh::new(3, &[], &[[0, 1, 2], [7, 0, 1]]).unwrap_err();
    assert_eq!(
        text(error),
        "faces[1][0] is vertex 7, and there are 3 vertices"
    );
    let mut mesh = Mesh::new(3, &[], &[[0, 1, 2]]).unwrap();
    let zero = [[0.0; 3]; 3];
    let mut nan = zero;
    nan[2][1] = f64::NAN;
    let error = mesh.step(&zero, &nan, 0.0).unwrap_err();
    assert_eq!(text(error), "end[2][1] is NaN, not a finite number");
    let error = mesh.first_contact(&zero[..2], &zero, 0.0).unwrap_err();
    assert_eq!(text(error), "start has 2 entries, and there are 3 vertices");
    let error = mesh.is_free(&zero, &zero, -1.0).unwrap_err();
    assert_eq!(
        text(error),
        "the thickness is -1; it has to be finite, and 0 or more"
    );
    let error = mesh.set_groups(&[0]).unwrap_err();
    assert_eq!(text(error), "groups has 1 entry, and there are 3 vertices");
    mesh.set_groups(&[0, 1, 1]).unwrap();
    let error = mesh.leave_out(0, 2).unwrap_err();
    assert_eq!(text(error), "there is no group 2; the largest is 1");
    let error = mesh.all_contacts(&zero, &zero, &[0.1][..]).unwrap_err();
    assert_eq!(text(error), "thickness has 1 entry, and there are 2 groups");
    let error = mesh.is_free(&zero, &zero, &vec![0.1; 3]).unwrap_err();
    assert_eq!(
        text(error),
        "thickness has 3 entries, and there are 2 groups"
    );
    let error = mesh
        .all_contacts(&zero, &zero, &[0.1, f64::INFINITY])
        .unwrap_err();
    assert_eq!(
        text(error),
        "thickness[1] is inf; it has to be finite, and 0 or more"
    );
    let error = Mesh::new(usize::MAX, &[], &[]).unwrap_err();
    assert_eq!(
        text(error),
        format!(
            "there are {} vertices, more than indices of 32 bits can name",
            usize::MAX
        )
    );
    let error = mesh
        .step_with_clearance(&zero, &zero, 0.0, Clearance::Share(1.0))
        .unwrap_err();
    assert_eq!(
        text(error),
        "the share is 1; it has to be 0 or more, and below 1"
    );
}

/// The smallest thickness there is: two parts that are that far apart touch.
#[test]
fn mesh_contacts_at_the_smallest_distance_are_found() {
    let tiny = f64::from_bits(1);
    // Points, an edge above an edge, a vertex above a face.
    let parts: [(Mesh, Vec<Position>); 3] = [
        (
            Mesh::new(2, &[], &[]).unwrap(),
            vec![[0.0; 3], [tiny, 0.0, 0.0]],
        ),
        (
            Mesh::new(4, &[[0, 1], [2, 3]], &[]).unwrap(),
            vec![
                [-1.0, 0.0, 0.0],
                [1.0, 0.0, 0.0],
                [0.0, -1.0, tiny],
                [0.0, 1.0, tiny],
            ],
        ),
        (
            Mesh::new(4, &[], &[[0, 1, 2]]).unwrap(),
            vec![
                [-1.0, -1.0, 0.0],
                [2.0, -1.0, 0.0],
                [-1.0, 2.0, 0.0],
                [0.0, 0.0, tiny],
            ],
        ),
    ];
    for (mut mesh, positions) in parts {
        let last = positions.len() - 1;
        let groups: Vec<u32> = (0..=last).map(|vertex| u32::from(vertex == last)).collect();
        mesh.set_groups(&groups).unwrap();
        let touches =
            |thickness: Thickness| !mesh.is_free(&positions, &positions, thickness).unwrap();
        assert!(touches(tiny.into()));
        assert!(touches(Thickness::PerGroup(&[tiny, 0.0])));
        assert!(!touches(0.0.into()));
        let step = mesh.step(&positions, &positions, tiny).unwrap();
        assert_eq!(
            step.near.len(),
            mesh.all_contacts(&positions, &positions, tiny)
                .unwrap()
                .len()
        );
        assert!(!step.near.is_empty());
    }
}

/// Two zeros are one position, and the end is stored as it is given.
#[test]
fn mesh_whole_steps_store_the_end_bit_for_bit() {
    let mesh = Mesh::new(1, &[], &[]).unwrap();
    let (start, end) = ([[0.0, -0.0, 1.0]], [[-0.0, 0.0, 1.0]]);
    let step = mesh.step(&start, &end, 0.0).unwrap();
    assert_eq!(step.step, 1.0);
    assert_eq!(
        step.positions[0].map(f64::to_bits),
        end[0].map(f64::to_bits)
    );
}

/// Many points that start within the thickness of each other: the first contact is at the start, and
/// no step is blocked for what parts.
#[test]
fn mesh_of_crowded_points_is_decided_quickly() {
    let mut random = ChaCha8Rng::seed_from_u64(5);
    let count = 300;
    let start: Vec<Position> = (0..count)
        .map(|_| [0; 3].map(|_| random.random_range(-1.0..1.0)))
        .collect();
    let end: Vec<Position> = start.iter().map(|p| p.map(|x| 2.0 * x)).collect();
    let mesh = Mesh::new(count, &[], &[]).unwrap();
    let first = mesh.first_contact(&start, &end, 10.0).unwrap().unwrap();
    assert_eq!(first.toi, 0.0);
    assert_eq!(first.pair.first, Feature::Vertex(0));
    assert_eq!(first.pair.second, Feature::Vertex(1));
    let step = mesh.step(&start, &end, 10.0).unwrap();
    assert_eq!(step.step, 1.0);
    assert_eq!(step.near.len(), count * (count - 1) / 2);
}
