//! Faults are planted, and found; where there are none, nothing is found.

use std::cell::Cell;
use std::sync::atomic::{AtomicU64, Ordering};

use crate::scenes::Scene;
use tunnelproof::broad::Method;
use tunnelproof::certified::Certified;
use tunnelproof::contact::{Contact, Verdict};
use tunnelproof::narrow::{self, NarrowPhase, Unsupported};
use tunnelproof::wire::recording::BodySummary;
use tunnelproof::wire::{
    BodyCrossing, BodyCrossingOutcome, BodyId, BodyRecord, Collisions, Material, Mode, NodeKind,
    Pose, Remesh, RemeshKind, Shape, Stop, Vector, WireId, WirePlan, WireRecord, World,
};

use super::*;
use tunnelproof_reference::certify::caller::Caller;

/// A chain in the form of an alpha, whose free end is thrown at the other one, which is fixed.
const ALPHA: &str = r#"
title = "alpha"
duration = 1
settings = { gravity = [0, 0, 0] }
[[wires]]
name = "chain"
material = { radius = 0.02, bend_modulus = 0 }
resolution = 3
adaptive = false
velocity = [0, 0, -20]
route = [{ pinned = [0, 0, 0] }, { pinned = [2, 0, 0] }, { free = [2, 1, 0.2] }, { free = [0.9, 1, 0.2] }, { free = [0.9, -0.5, 0.2] }]
"#;

/// A chain that slides over the edge of a cube, and two that fall on it, across it and over the edge.
const EDGE: &str = r#"
title = "edge"
duration = 2
friction = 0.1
[[bodies]]
name = "cube"
shape = { box = { half = [0.5, 0.5, 0.5] } }
position = [0, 0, -0.5]
[[wires]]
name = "over the edge"
material = { radius = 0.005, bend_modulus = 0 }
resolution = 0.2
route = [{ free = [0, 0, 0.005] }, { free = [0.505, 0, 0.005] }, { free = [0.505, 0, -1.5] }]
[[wires]]
name = "across"
material = { radius = 0.005, bend_modulus = 0 }
resolution = 0.2
velocity = [0.1, 0, -5]
route = [{ free = [0.1, -0.8, 0.06] }, { free = [0.1, 0.8, 0.06] }]
[[wires]]
name = "askew"
material = { radius = 0.005 }
resolution = 0.2
velocity = [0, 0, -10]
route = [{ free = [-0.5, -0.3, 0.1] }, { free = [1, 0.3, 0.1] }]
"#;

fn basic_collision() -> World {
    Scene::embedded("basic-collision").unwrap().world().unwrap()
}

fn records(mut world: World, mut collisions: Collisions<'_>, steps: usize) -> Vec<StepRecord> {
    (0..steps)
        .map(|_| world.step_colliding(&mut collisions, &[]).unwrap())
        .collect()
}

fn audited(records: &[StepRecord]) -> Report {
    audited_with(&[], records)
}

fn audited_with(shapes: &[Shape], records: &[StepRecord]) -> Report {
    let of = |shape: &Shape| BodySummary {
        shape: shape.clone(),
        dynamic: true,
        mass: 1.0,
    };
    let bodies: Vec<BodySummary> = shapes.iter().map(of).collect();
    let mut audit = Audit::new(&bodies);
    records.iter().for_each(|record| audit.step(record));
    audit.finish()
}

fn in_thesis_mode(narrow: &dyn NarrowPhase) -> Collisions<'_> {
    Collisions::new(Mode::Thesis, Method::default(), narrow)
}

#[test]
fn audit_of_guard_mode_finds_nothing_and_every_time_exact() {
    let report = audited(&records(basic_collision(), Collisions::default(), 60));
    assert!(report.is_exact(), "{report:?}");
    assert_eq!(report.contacts, 0);
    assert!(report.prevented > 0 && report.steps == 60);
}

#[test]
fn audit_of_contact_nodes_that_come_and_go_finds_nothing() {
    let scene = Scene::from_toml(EDGE).unwrap();
    let mut collisions = scene.collisions(Mode::Guard, &Certified).unwrap();
    let mut world = scene.world().unwrap();
    let records: Vec<StepRecord> = (0..scene.steps())
        .map(|_| world.step_colliding(&mut collisions, &[]).unwrap())
        .collect();
    let shapes: Vec<Shape> = world.bodies().iter().map(|b| b.shape().clone()).collect();
    let report = audited_with(&shapes, &records);
    assert!(report.is_exact() && report.prevented > 0, "{report:?}");
    let over = |kind: &&NodeKind| matches!(kind, NodeKind::Contact { .. });
    let rode = |record: &StepRecord| {
        let kinds = record.wires.iter().flat_map(|wire| &wire.kinds);
        kinds.filter(over).count()
    };
    let left = |record: &StepRecord| record.slides.iter().filter(|slide| slide.left).count();
    let [rode, left] = [
        records.iter().map(rode).sum::<usize>(),
        records.iter().map(left).sum(),
    ];
    assert!(rode > 50 && left > 0, "{rode} {left}");
}

#[test]
fn audit_of_thesis_mode_counts_passages_at_nodes_once_and_back_again() {
    let records = records(basic_collision(), in_thesis_mode(&Certified), 30);
    let whole = audited(&records);
    assert!(whole.is_exact(), "{whole:?}");
    assert!(whole.contacts >= 4, "{whole:?}");
    // The first step ends on the wrong sides of both.
    let first = audited(&records[..1]);
    let wires: Vec<_> = first
        .standing
        .iter()
        .map(|(wires, sum)| (*wires, sum.abs()))
        .collect();
    assert_eq!(wires, [([0, 2], 1), ([1, 2], 1)]);
    assert!(!first.is_clean());
}

#[test]
fn audit_finds_the_passage_of_a_wire_through_itself() {
    let world = Scene::from_toml(ALPHA).unwrap().world().unwrap();
    let report = audited(&records(
        world,
        in_thesis_mode(&crate::simulate::Discrete),
        1,
    ));
    assert_eq!(report.missed, [0, 0, 1]);
    assert_eq!(report.missed_crossings, 1);
    assert_eq!(report.standing.len(), 1);
    assert_eq!(report.standing[0].0, [0, 0]);
    let [finding] = report.findings.as_slice() else {
        unreachable!("one finding")
    };
    assert_eq!(finding.segments.len(), 2);
    assert!(
        finding
            .command(&Caller::Test)
            .unwrap()
            .contains("explain -")
    );
}

#[test]
fn audit_finds_a_broad_phase_that_drops_pairs() {
    let asked = Cell::new(0);
    let drops = |_, _| {
        asked.set(asked.get() + 1);
        asked.get() % 3 != 0
    };
    let collisions = in_thesis_mode(&Certified).with_filter(&drops);
    let report = audited(&records(basic_collision(), collisions, 30));
    assert!(report.missed[0] > 0, "{report:?}");
    assert_eq!(report.missed[1..], [0, 0]);
    assert!(!report.is_clean());
}

#[test]
fn audit_finds_an_exclusion_that_is_too_bold() {
    let mut records = records(basic_collision(), in_thesis_mode(&Certified), 1);
    let said = &mut records[0].collisions.pairs;
    let met = said
        .iter_mut()
        .find(|said| matches!(said.answer, PairAnswer::Met { .. }));
    met.unwrap().answer = PairAnswer::Excluded;
    assert_eq!(audited(&records).missed, [0, 1, 0]);
}

/// The certified path, but one hit of all is a miss, or all are late.
struct Faulty {
    missed: Option<u64>,
    late: f64,
    hits: AtomicU64,
}

impl NarrowPhase for Faulty {
    fn name(&self) -> &str {
        "faulty"
    }

    fn edge_edge(&self, query: &EdgeEdge) -> Result<narrow::Report, Unsupported> {
        let mut report = Certified.edge_edge(query)?;
        if let Verdict::Hit(contact) = report.verdict {
            let hit = self.hits.fetch_add(1, Ordering::Relaxed);
            let toi = contact.toi + self.late;
            report.verdict = match self.missed {
                Some(missed) if missed == hit => Verdict::Miss,
                _ => Verdict::Hit(Contact { toi, ..contact }),
            };
        }
        Ok(report)
    }
}

fn faulty(missed: Option<u64>, late: f64) -> Faulty {
    let hits = AtomicU64::new(0);
    Faulty { missed, late, hits }
}

#[test]
fn audit_finds_a_narrow_phase_that_misses_once() {
    let narrow = faulty(Some(1), 0.0);
    let report = audited(&records(basic_collision(), in_thesis_mode(&narrow), 1));
    assert_eq!(report.missed, [0, 0, 1]);
}

#[test]
fn audit_finds_times_of_impact_late_and_early_also_of_what_was_prevented() {
    for mode in [Mode::Guard, Mode::Thesis] {
        let of = |late| {
            let narrow = faulty(None, late);
            let collisions = Collisions::new(mode, Method::default(), &narrow);
            audited(&records(basic_collision(), collisions, 1))
        };
        let (late, early) = (of(1e-9), of(-1e-9));
        assert!(late.late.0 > 0 && late.early.0 == 0, "{late:?}");
        assert!((late.late.1 - 1e-9).abs() < 1e-15);
        assert!(early.early.0 > 0 && early.late.0 == 0, "{early:?}");
        assert!(!late.is_exact() && !early.is_exact());
        assert_eq!(late.missed, [0; 3]);
    }
}

#[test]
fn audit_finds_contacts_made_up() {
    let mut records = records(basic_collision(), Collisions::default(), 1);
    let apart = records[0].collisions.pairs.iter_mut();
    let mut apart = apart.filter(|said| said.answer == PairAnswer::Apart);
    apart.next().unwrap().answer = PairAnswer::Met { toi: 0.5 };
    records[0].collisions.crossings[0].end = records[0].collisions.crossings[0].start;
    let report = audited(&records);
    assert_eq!(report.false_hits, 2);
    assert!(report.is_clean() && !report.is_exact());
}

#[test]
fn audit_finds_a_step_that_nobody_saw() {
    let mut records = records(basic_collision(), Collisions::default(), 3);
    records.remove(1);
    let report = audited(&records);
    // All of them, as the ones that are fixed sag; and the step's number.
    assert_eq!(report.jumps, 4);
    assert_eq!(report.findings[1].what, What::Jump { wire: 0 });
    records[0].wires[1].after[0].x = f64::NAN;
    let unsound = What::Unsound {
        wire: 1,
        field: Field::After,
        at: Some(0),
    };
    assert!(audited(&records).findings.iter().any(|f| f.what == unsound));
}

fn remeshed(x: f64, kind: RemeshKind) -> Report {
    audited(&remesh_records([x, 0.1], kind))
}

/// A wire with a corner and a wire that stands at `x` and `y`, both still; and then the corner is taken out or put in.
fn remesh_records([x, y]: [f64; 2], kind: RemeshKind) -> [StepRecord; 2] {
    let triangle = [[0.0, 0.0, 0.0], [1.0, 0.3, 0.0], [2.0, 0.0, 0.0]].map(Point::from);
    let wire = |arcs: &[f64], points: &[Point]| WireRecord {
        radius: 0.01,
        arcs: arcs.to_vec(),
        kinds: vec![NodeKind::Free; arcs.len()],
        before: points.to_vec(),
        after: points.to_vec(),
        tensions: vec![0.0; arcs.len() - 1],
        ..WireRecord::default()
    };
    let (arcs, straight) = ([0.0, 1.0, 2.0], [triangle[0], triangle[2]]);
    let bent = wire(&arcs, &triangle);
    let straight = wire(&[0.0, 2.0], &straight);
    let standing = [[x, y, -0.3], [x, y, 0.4]].map(Point::from);
    let standing = wire(&[0.0, 0.7], &standing);
    let (before, after) = match kind {
        RemeshKind::Merge => (bent, straight),
        RemeshKind::Split => (straight, bent),
    };
    let [mut first, mut second] = [(), ()].map(|()| StepRecord::default());
    first.wires = vec![before, standing.clone()];
    first.remeshes = vec![Remesh {
        wire: WireId(0),
        kind,
        triangle,
        arcs,
    }];
    (second.step, second.time) = (1, 1.0);
    second.wires = vec![after, standing];
    [first, second]
}

#[test]
fn audit_finds_a_change_of_resolution_that_jumps_through() {
    for kind in [RemeshKind::Merge, RemeshKind::Split] {
        let through = remeshed(1.0, kind);
        assert_eq!(
            (through.remeshes_through, through.jumps),
            (1, 0),
            "{through:?}"
        );
        assert_eq!(through.standing.len(), 1);
        let beside = remeshed(-0.1, kind);
        assert!(beside.is_exact() && beside.remeshes == 1, "{beside:?}");
    }
    let sum = |kind| remeshed(1.0, kind).standing[0].1;
    assert_eq!(sum(RemeshKind::Merge), -sum(RemeshKind::Split));
}

#[test]
fn audit_finds_a_change_of_resolution_that_cannot_be_made() {
    let jumps = |kind, fault: fn(&mut Remesh, &mut Vec<NodeKind>)| {
        let mut records = remesh_records([-0.1, 0.1], kind);
        let [first, _] = &mut records;
        fault(&mut first.remeshes[0], &mut first.wires[0].kinds);
        audited(&records).jumps
    };
    for kind in [RemeshKind::Merge, RemeshKind::Split] {
        assert_eq!(jumps(kind, |_, _| ()), 0);
        assert!(jumps(kind, |change, _| change.arcs[0] = -1.0) > 0);
        assert!(jumps(kind, |change, _| change.arcs[1] = 2.5) > 0);
        assert!(jumps(kind, |change, _| change.arcs[1] = f64::NAN) > 0);
    }
    // What is pinned is not taken out.
    assert!(jumps(RemeshKind::Merge, |_, kinds| kinds[1] = NodeKind::Pinned) > 0);
}

/// A corner of a wire that is taken out or put in, and a thin body that lies in the triangle.
fn remeshed_beside_a_body(x: f64, kind: RemeshKind) -> Report {
    let triangle = [[0.0, 0.0, 0.0], [1.0, 0.3, 0.0], [2.0, 0.0, 0.0]].map(Point::from);
    let arcs = [0.0, 1.0, 2.0];
    let (places, arcs_before): (Vec<Point>, Vec<f64>) = match kind {
        RemeshKind::Merge => (triangle.to_vec(), arcs.to_vec()),
        RemeshKind::Split => (vec![triangle[0], triangle[2]], vec![0.0, 2.0]),
    };
    let pose = Pose {
        position: Point::new(x, 0.1, 0.0),
        orientation: Default::default(),
    };
    let mut record = StepRecord::default();
    record.bodies = vec![BodyRecord {
        before: pose,
        between: Vec::new(),
        after: pose,
    }];
    record.wires = vec![WireRecord {
        radius: 0.01,
        kinds: vec![NodeKind::Free; places.len()],
        tensions: vec![0.0; places.len() - 1],
        arcs: arcs_before,
        before: places.clone(),
        after: places,
        ..WireRecord::default()
    }];
    record.remeshes = vec![Remesh {
        wire: WireId(0),
        kind,
        triangle,
        arcs,
    }];
    let rod = Shape::Cylinder {
        radius: 0.002,
        half_height: 0.5,
    };
    audited_with(&[rod], &[record])
}

#[test]
fn audit_finds_a_change_of_resolution_that_jumps_through_a_body() {
    for kind in [RemeshKind::Merge, RemeshKind::Split] {
        let through = remeshed_beside_a_body(1.0, kind);
        assert_eq!(through.body_remeshes_through, 1, "{through:?}");
        assert!(!through.is_clean() && through.body_missed == 0);
        let beside = remeshed_beside_a_body(-0.1, kind);
        assert!(beside.is_exact(), "{beside:?}");
    }
}

/// A ball at the end of a wire whose eye is in its centre; and a ball that was put on a wire.
#[test]
fn audit_tells_the_end_of_a_wire_in_its_body_from_a_wire_in_a_body() {
    let text = |ball: &str, route: &str| {
        format!(
            "title = \"ball\"\nduration = 0.5\n[[bodies]]\nname = \"ball\"\n\
             shape = {{ sphere = {{ radius = 0.1 }} }}\nposition = {ball}\n\
             drive = {{ dynamic = {{ density = 1000 }} }}\n[[wires]]\nname = \"wire\"\n\
             material = {{ radius = 0.01, bend_modulus = 0 }}\nresolution = 0.05\nroute = {route}\n"
        )
    };
    let report = |ball: &str, route: &str, steps: usize| {
        let scene = Scene::from_toml(&text(ball, route)).unwrap();
        let world = scene.world().unwrap();
        let shapes: Vec<Shape> = world.bodies().iter().map(|b| b.shape().clone()).collect();
        audited_with(&shapes, &records(world, Collisions::default(), steps))
    };
    let tied = "[{ pinned = [0, 0, 0] }, { eye = { body = \"ball\", local = [0, 0, 0] } }]";
    let tied = report("[0, 0, -1]", tied, 12);
    assert!(tied.is_exact() && tied.steps == 12, "{tied:?}");
    let through = "[{ pinned = [-1, 0, 0] }, { pinned = [1, 0, 0] }]";
    // Contacts push it out in time.
    let through = report("[0, 0, 0]", through, 1);
    assert_eq!(through.body_standing, [[0, 0]], "{through:?}");
    assert_eq!((through.body_missed, through.is_clean()), (0, false));
}

/// A wire at `from` that goes to `to` in a step, above one that stands across it or along it. Each
/// is 4 cm thick.
fn passing(from: [f64; 2], to: [f64; 2], across: bool) -> World {
    let settings = tunnelproof::wire::Settings::default();
    let mut world = World::new(settings.with_gravity(Vector::zeros())).unwrap();
    let mut wire = |ends: [[f64; 3]; 2], stop: fn(Point) -> Stop, velocity| {
        let route = ends.map(|point| stop(point.into())).to_vec();
        let mut plan = WirePlan::new(Material::steel(0.02), 1.0, route);
        plan.velocity = velocity;
        world.add_wire(&plan).unwrap();
    };
    let ends = match across {
        true => [[0.0, -1.0, 0.0], [0.0, 1.0, 0.0]],
        false => [[-1.0, 0.0, 0.0], [1.0, 0.0, 0.0]],
    };
    wire(ends, Stop::Pinned, Vector::zeros());
    let velocity = Vector::new(0.0, to[0] - from[0], to[1] - from[1]) * 60.0;
    wire(
        [-0.9, 0.9].map(|x| [x, from[0], from[1]]),
        Stop::Free,
        velocity,
    );
    world
}

fn thick<'n>(kappa: f64, narrow: &'n dyn NarrowPhase) -> Collisions<'n> {
    let collisions = Collisions::new(Mode::Guard, Method::default(), narrow);
    collisions.with_guarded_thickness(kappa).unwrap()
}

#[test]
fn audit_finds_a_guard_of_half_the_thickness() {
    // It passes at three eighths of the thickness.
    let run = |kappa| {
        let world = passing([-0.1, 0.015], [0.1, 0.015], false);
        let mut records = records(world, thick(kappa, &Certified), 1);
        for record in &mut records {
            record.collisions.guarded_thickness = 0.5;
        }
        audited(&records)
    };
    let whole = run(0.5);
    assert!(whole.is_exact() && whole.prevented > 0, "{whole:?}");
    assert_eq!(whole.guarded_thickness, 0.5);
    let half = run(0.25);
    assert!(half.nearer[0] > 0 && half.nearer[1] == 0, "{half:?}");
    assert!(half.thick_pairs > 0);
    assert_eq!(half.missed, [0; 3]);
    assert!(!half.is_clean());
    let finding = half.findings[0].clone();
    let by = Culprit::Narrow;
    let were_near = false;
    assert_eq!(finding.what, What::Nearer { by, were_near });
    assert!(
        finding
            .command(&Caller::Test)
            .unwrap()
            .contains("explain -")
    );
}

/// The certified path, but a distance below the whole of what is guarded is forgotten.
struct Forgetful {
    whole: f64,
}

impl NarrowPhase for Forgetful {
    fn name(&self) -> &str {
        "forgetful"
    }

    fn edge_edge(&self, query: &EdgeEdge) -> Result<narrow::Report, Unsupported> {
        if query.radius().rounded() < self.whole * (1.0 - 1e-9) {
            let midlines = EdgeEdge::new(*query.start(), *query.end(), 0.0).unwrap();
            return Certified.edge_edge(&midlines);
        }
        Certified.edge_edge(query)
    }
}

#[test]
fn audit_finds_a_guard_that_forgets_what_was_near() {
    let run = |narrow: &dyn NarrowPhase, from, to| {
        let world = passing([0.0, from], [0.0, to], true);
        audited(&records(world, thick(0.5, narrow), 1))
    };
    let forgetful = Forgetful { whole: 0.02 };
    let kept = run(&Certified, 0.016, 0.008);
    assert!(kept.is_exact() && kept.prevented > 0, "{kept:?}");
    let forgotten = run(&forgetful, 0.016, 0.008);
    assert!(
        forgotten.nearer[0] == 0 && forgotten.nearer[1] > 0,
        "{forgotten:?}"
    );
    assert!(!forgotten.is_clean());
    // What was apart it knows.
    assert!(run(&forgetful, 0.03, 0.008).is_exact());
}

#[test]
fn audit_finds_a_guard_that_skips_a_wire_with_itself() {
    let run = |filter: tunnelproof::wire::PairFilter<'_>| {
        let world = Scene::from_toml(ALPHA).unwrap().world().unwrap();
        let collisions = thick(0.5, &Certified).with_filter(filter);
        audited(&records(world, collisions, 1))
    };
    let kept = run(&|_, _| true);
    assert!(kept.is_exact() && kept.prevented > 0, "{kept:?}");
    let skipped = run(&|a, b| a.wire != b.wire);
    let (by, were_near) = (Culprit::Broad, false);
    let nearer = What::Nearer { by, were_near };
    assert!(
        skipped.findings.iter().any(|f| f.what == nearer),
        "{skipped:?}"
    );
}

/// Two wires of 1 cm radius across each other, so far apart before and after a step.
fn pressed(before: f64, after: f64) -> Report {
    let wire = |before: [[f64; 3]; 2], after: [[f64; 3]; 2]| WireRecord {
        radius: 0.01,
        arcs: vec![0.0, 2.0],
        kinds: vec![NodeKind::Free; 2],
        before: before.map(Point::from).to_vec(),
        after: after.map(Point::from).to_vec(),
        tensions: vec![0.0],
        ..WireRecord::default()
    };
    let below = [[-1.0, 0.0, 0.0], [1.0, 0.0, 0.0]];
    let above = |z: f64| [[0.0, -1.0, z], [0.0, 1.0, z]];
    let mut record = StepRecord::default();
    record.wires = vec![wire(below, below), wire(above(before), above(after))];
    record.collisions.guarded_thickness = 0.5;
    audited(&[record])
}

#[test]
fn audit_knows_to_a_64th_what_came_nearer() {
    // 1 cm is guarded.
    for (before, after, expected) in [
        (0.02, 0.011, [0, 0]),
        (0.02, 0.009, [1, 0]),
        (0.02, 0.01f64.next_up(), [0, 0]),
        (0.02, 0.01, [1, 0]),
        (0.01, 0.01, [0, 0]),
        // It is beyond 51 steps of 64.
        (0.008, 0.00797, [0, 0]),
        (0.008, 0.00796, [0, 1]),
        (0.001, 0.02, [0, 0]),
    ] {
        let report = pressed(before, after);
        assert_eq!(report.nearer, expected, "{before} to {after}: {report:?}");
        assert_eq!(report.is_clean(), expected == [0, 0]);
    }
}

#[test]
fn audit_tells_the_largest_penetration() {
    let report = pressed(0.02, 0.015);
    for found in [report.deepest, report.standing_penetration] {
        let Penetration {
            low, high, step, ..
        } = found.unwrap();
        assert!(
            low <= 0.25 && 0.25 <= high && high - low < 1e-9,
            "{found:?}"
        );
        assert_eq!(step, 0);
    }
    assert_eq!(pressed(0.02, 0.0201).deepest, None);
}

#[test]
fn audit_finds_a_change_of_resolution_that_comes_near() {
    // The corner is taken out, and the wire comes down to one that stands 5 mm below, or 15.
    for (below, expected) in [(0.005, [1, 0]), (0.015, [0, 0])] {
        let mut records = remesh_records([1.0, -below], RemeshKind::Merge);
        records[0].collisions.guarded_thickness = 0.5;
        let report = audited(&records);
        assert_eq!(report.remeshes_nearer, expected, "{report:?}");
        assert_eq!(report.remeshes_through, 0);
        assert_eq!(report.is_clean(), expected == [0, 0]);
    }
}

/// A box at rest above a wire that is pinned at both ends.
const BOX: &str = r#"
title = "box"
duration = 0.1
settings = { gravity = [0, 0, 0] }
[[bodies]]
name = "box"
shape = { box = { half = [0.05, 0.05, 0.05] } }
position = [0, 0, 1]
drive = { kinematic = [{ from = 0, velocity = [0, 0, 0] }] }
[[wires]]
name = "wire"
material = { radius = 0.005, bend_modulus = 0 }
resolution = 1
adaptive = false
route = [{ pinned = [-1, 0, 0] }, { free = [0.3, 0, 0] }, { pinned = [1, 0, 0] }]
"#;

/// A run of a scene, with a fault.
fn tampered(scene: &str, fault: impl FnOnce(&mut Vec<StepRecord>)) -> Report {
    let scene = Scene::from_toml(scene).unwrap();
    let world = scene.world().unwrap();
    let mut audit = Audit::of_world(&world);
    let collisions = scene.collisions(Mode::Guard, &Certified).unwrap();
    let mut records = records(world, collisions, scene.steps() as usize);
    fault(&mut records);
    records.iter().for_each(|record| audit.step(record));
    audit.finish()
}

fn found(report: &Report) -> Vec<What> {
    report.findings.iter().map(|finding| finding.what).collect()
}

/// The box goes through the wire in step 2.
fn go_through(records: &mut [StepRecord]) {
    for (step, record) in records.iter_mut().enumerate().skip(2) {
        record.bodies[0].after.position.z = -1.0;
        if step > 2 {
            record.bodies[0].before.position.z = -1.0;
        }
    }
}

/// Nodes at these places of the body.
fn eyes() -> Vec<NodeKind> {
    let eye = |x: f64| NodeKind::Eye {
        body: BodyId(0),
        local: Vector::new(x, 0.0, -1.0),
    };
    [-1.0, 0.3, 1.0].map(eye).to_vec()
}

#[test]
fn audit_finds_a_body_that_goes_through_a_wire_that_is_said_to_ride_it() {
    assert!(tampered(BOX, |_| ()).is_exact());
    let honest = tampered(BOX, |records| go_through(records));
    assert!(honest.body_missed > 0 && honest.astray == 0);
    let in_one_step = tampered(BOX, |records| {
        go_through(records);
        records[2].wires[0].kinds = eyes();
    });
    let in_every_step = tampered(BOX, |records| {
        go_through(records);
        for record in &mut *records {
            record.wires[0].kinds = eyes();
        }
    });
    for report in [&in_one_step, &in_every_step] {
        assert!(report.astray >= 3 && !report.is_clean(), "{report:?}");
        // They are taken for free nodes.
        assert_eq!(report.body_missed, honest.body_missed);
    }
    let what = found(&in_one_step);
    assert!(what.contains(&What::Astray {
        wire: 0,
        node: 1,
        body: Some(0),
        at_end: true,
    }));
    let altered = |at| What::Altered {
        wire: 0,
        field: Field::Kinds,
        at: Some(at),
    };
    assert_eq!(what.iter().filter(|&what| *what == altered(0)).count(), 2);
    // There is no such body.
    let of_nothing = tampered(BOX, |records| {
        for record in records {
            record.wires[0].kinds[1] = NodeKind::Eye {
                body: BodyId(7),
                local: Vector::zeros(),
            };
        }
    });
    assert_eq!(of_nothing.astray, of_nothing.steps);
}

#[test]
fn audit_finds_a_pin_that_moves() {
    let report = tampered(BOX, |records| {
        records[1].wires[0].after[0].y = 1e-300;
        for record in &mut records[2..] {
            let wire = &mut record.wires[0];
            for points in [&mut wire.before, &mut wire.after] {
                points[0].y = 1e-300;
            }
        }
    });
    let astray = What::Astray {
        wire: 0,
        node: 0,
        body: None,
        at_end: true,
    };
    assert_eq!(found(&report), [astray]);
    assert!(!report.is_clean());
}

/// A drum that turns by a radian, and lifts a ball.
const DRUM: &str = r#"
title = "drum"
duration = 1
bodies = [
  { name = "drum", shape = { cylinder = { radius = 0.3, half_height = 0.5 } }, position = [0, 0, 0], turn = { axis = [1, 0, 0], degrees = 90 }, drive = { kinematic = [{ from = 0, velocity = [0, 0, 0], angular_velocity = [0, -1, 0] }] } },
  { name = "ball", shape = { sphere = { radius = 0.1 } }, position = [0.31, 0, -2.1], drive = { dynamic = { density = 1000 } } },
]

[[wires]]
name = "rope"
material = { radius = 0.01, bend_modulus = 0 }
resolution = 0.1
route = [{ eye = { body = "drum", local = [0.31, 0, 0] } }, { eye = { body = "ball", local = [0, 0, 0.1] } }]
"#;

#[test]
fn audit_takes_wire_that_comes_onto_a_drum() {
    let is_contact = |kind: &NodeKind| matches!(kind, NodeKind::Contact { .. });
    let honest = tampered(DRUM, |records| {
        let count = |record: &StepRecord| {
            record.wires[0]
                .kinds
                .iter()
                .filter(|kind| is_contact(kind))
                .count()
        };
        assert!(records.iter().map(count).max().unwrap() > 3);
        assert!(records.iter().all(|record| {
            record
                .contacts
                .iter()
                .all(|contact| contact.normal_force() == 0.0)
        }));
    });
    assert!(honest.is_exact() && honest.is_clean());
    // Not where the body carries no neighbour.
    let forged = tampered(DRUM, |records| {
        for record in records {
            let kinds = &mut record.wires[0].kinds;
            let last = kinds.iter().rposition(is_contact);
            if let Some(last) = last.filter(|last| last + 3 < kinds.len()) {
                kinds[last + 2] = kinds[last];
            }
        }
    });
    let altered = |what: &What| {
        matches!(
            what,
            What::Altered {
                field: Field::Kinds,
                ..
            }
        )
    };
    assert!(found(&forged).iter().any(altered));
}

#[test]
fn audit_lets_a_contact_node_go_only_where_its_body_carries_another_one() {
    let is_contact = |kind: &NodeKind| matches!(kind, NodeKind::Contact { .. });
    let jumps = |report: &Report| {
        let is_jump = |what: &What| matches!(what, What::Jump { .. });
        found(report).iter().filter(|what| is_jump(what)).count()
    };
    // The contact node of the first wire goes after a step, and the next step starts without it.
    let gone = |neighbour: bool| {
        tampered(EDGE, |records| {
            let at = records.iter().position(|record| {
                let kinds = &record.wires[0].kinds;
                kinds.iter().any(is_contact) && record.remeshes.is_empty()
            });
            let at = at.unwrap();
            records.truncate(at + 2);
            let [record, next] = &mut records[at..] else {
                unreachable!()
            };
            record.slides.retain(|slide| slide.wire.0 != 0);
            next.slides.clear();
            next.remeshes.clear();
            next.contacts.clear();
            let wire = &record.wires[0];
            let node = wire.kinds.iter().position(is_contact).unwrap();
            let corners = [node - 1, node, node + 1];
            record.remeshes.push(Remesh {
                wire: WireId(0),
                kind: RemeshKind::Merge,
                triangle: corners.map(|k| wire.after[k]),
                arcs: corners.map(|k| wire.arcs[k]),
            });
            let (kind, radius) = (wire.kinds[node], wire.radius);
            let mut nodes: Vec<_> = wire.after.iter().zip(&wire.arcs).zip(&wire.kinds).collect();
            nodes.remove(node);
            let places: Vec<_> = nodes.iter().map(|((at, _), _)| **at).collect();
            let own = WireRecord {
                radius,
                arcs: nodes.iter().map(|((_, arc), _)| **arc).collect(),
                kinds: nodes.iter().map(|(_, kind)| **kind).collect(),
                before: places.clone(),
                after: places,
                tensions: vec![0.0; nodes.len() - 1],
                ..WireRecord::default()
            };
            next.wires[0] = own;
            if neighbour {
                next.wires[0].kinds[node] = kind;
            }
        })
    };
    let (without, with) = (gone(false), gone(true));
    assert_eq!((jumps(&without), jumps(&with)), (1, 0));
    let is_altered = |what: &What| matches!(what, What::Altered { .. });
    assert!(!found(&with).iter().any(is_altered));
}

#[test]
fn audit_finds_contact_nodes_that_come_and_go_without_a_reason() {
    let is_contact = |kind: &NodeKind| matches!(kind, NodeKind::Contact { .. });
    let kinds = |report: &Report| {
        let is_kind = |what: &What| {
            matches!(
                what,
                What::Altered {
                    field: Field::Kinds,
                    ..
                }
            )
        };
        report.findings.iter().filter(|f| is_kind(&f.what)).count()
    };
    assert!(tampered(EDGE, |_| ()).is_exact());
    // The contacts that pushed are not there; it comes from somewhere.
    let unpushed = tampered(EDGE, |records| {
        records
            .iter_mut()
            .for_each(|record| record.contacts.clear());
    });
    assert!(kinds(&unpushed) > 0 && !unpushed.is_clean());
    let kept = tampered(EDGE, |records| {
        for record in records {
            record.slides.retain(|slide| !slide.left);
        }
    });
    assert!(kinds(&kept) > 0);
    let freed = |quarter: usize| {
        let report = tampered(EDGE, |records| {
            let has_contact = |record: &&mut StepRecord| {
                let mut kinds = record.wires.iter().flat_map(|wire| &wire.kinds);
                kinds.any(is_contact)
            };
            let mut with: Vec<_> = records.iter_mut().filter(has_contact).collect();
            let at = with.len() * quarter / 4;
            for wire in &mut with[at].wires {
                let contacts = wire.kinds.iter_mut().filter(|kind| is_contact(kind));
                contacts.for_each(|kind| *kind = NodeKind::Free);
            }
        });
        kinds(&report)
    };
    // One that goes is found, and one that comes back, unless a contact pushed there.
    let freed = [1, 2, 3].map(freed);
    assert!(
        freed.iter().all(|count| *count >= 1) && freed.iter().any(|count| *count >= 2),
        "{freed:?}"
    );
    let unslid = tampered(EDGE, |records| {
        let slides = records.iter_mut().flat_map(|record| &mut record.slides);
        let slide = slides.max_by(|a, b| a.distance.total_cmp(&b.distance));
        slide.unwrap().distance *= 0.5;
    });
    let is_arc = |what: &What| {
        matches!(
            what,
            What::Altered {
                field: Field::Arcs,
                ..
            }
        )
    };
    assert_eq!(unslid.jumps, 1, "{:?}", unslid.findings);
    assert!(is_arc(&unslid.findings[0].what));
    let moved = tampered(EDGE, |records| {
        let middle = records.len() / 2;
        let kinds = records[middle].wires.iter_mut().flat_map(|w| &mut w.kinds);
        for kind in kinds {
            if let NodeKind::Contact { local, .. } = kind {
                local.x += 1e-9;
            }
        }
    });
    assert!(moved.astray > 0);
}

#[test]
fn audit_finds_steps_that_do_not_follow_each_other() {
    let field = |fault: fn(&mut Vec<StepRecord>)| {
        let report = tampered(BOX, fault);
        assert_eq!(report.jumps, report.findings.len() as u64);
        assert!(!report.is_clean());
        found(&report)
    };
    use StepField::{GuardedThickness, Number, Time};
    let of = |field| What::StepUnsound { field };
    let swapped = field(|records| records.swap(3, 4));
    assert_eq!(swapped, [Number, Number, Time, Number].map(of));
    assert_eq!(field(|records| drop(records.remove(3))), [of(Number)]);
    let twice = field(|records| records.insert(3, records[3].clone()));
    assert_eq!(twice, [Number, Time].map(of));
    for time in [f64::NAN, f64::INFINITY] {
        let what = match time.is_nan() {
            true => field(|records| records[2].time = f64::NAN),
            false => field(|records| records[2].time = f64::INFINITY),
        };
        // No time is after it.
        assert_eq!(what, [Time, Time].map(of), "{time}");
    }
    let huge = field(|records| records[2].time = 1.7e308);
    assert_eq!(huge, [of(Time)]);
    let share = field(|records| records[2].collisions.guarded_thickness = -0.5);
    assert_eq!(share, [of(GuardedThickness)]);
}

#[test]
fn audit_names_numbers_that_are_none_of_a_wire() {
    let report = |set: &dyn Fn(&mut WireRecord)| {
        let report = tampered(BOX, |records| set(&mut records[2].wires[0]));
        assert!(!report.is_clean());
        found(&report)
    };
    let unsound = |field, at| What::Unsound { wire: 0, field, at };
    let altered = |field, at| What::Altered { wire: 0, field, at };
    for wrong in [f64::NAN, f64::INFINITY, -1.0, 0.0] {
        let radius = report(&|wire| wire.radius = wrong);
        assert!(radius.contains(&unsound(Field::Radius, None)), "{wrong}");
        let arc = report(&|wire| wire.arcs[1] = wrong);
        assert!(arc.contains(&unsound(Field::Arcs, Some(1))), "{wrong}");
    }
    for wrong in [f64::NAN, f64::INFINITY] {
        let tension = report(&|wire| wire.tensions[1] = wrong);
        assert_eq!(tension, [unsound(Field::Tensions, Some(1))]);
        let torque = report(&|wire| wire.torque = wrong);
        assert_eq!(torque, [unsound(Field::Torque, None)]);
        let twist = report(&|wire| wire.twist = wrong);
        assert_eq!(twist, [unsound(Field::Twist, None)]);
        let place = report(&|wire| wire.after[2].y = wrong);
        assert!(place.contains(&unsound(Field::After, Some(2))));
    }
    let huge = report(&|wire| wire.radius = 1.7e308);
    assert!(huge.contains(&altered(Field::Radius, None)));
    let huge = report(&|wire| wire.arcs[2] = 1.7e308);
    assert_eq!(huge, [altered(Field::Arcs, Some(2)); 2]);
    let few = report(&|wire| wire.tensions.truncate(1));
    assert_eq!(few, [unsound(Field::Tensions, None)]);
    let gone = tampered(BOX, |records| {
        records.iter_mut().for_each(|record| record.wires.clear());
    });
    assert_eq!(gone.jumps, gone.steps);
    let few = report(&|wire| wire.kinds.truncate(2));
    assert!(few.contains(&unsound(Field::Kinds, None)));
    // Thinner from the start on.
    let thinner = tampered(BOX, |records| {
        for wire in records.iter_mut().flat_map(|record| &mut record.wires) {
            wire.radius /= 2.0;
        }
    });
    assert_eq!(thinner.jumps, thinner.steps);
}

#[test]
fn audit_finds_an_orientation_of_another_length() {
    let report = tampered(BOX, |records| {
        let turn = &mut records[2].bodies[0].after.orientation;
        let twice = turn.into_inner() * 2.0;
        *turn = nalgebra::UnitQuaternion::new_unchecked(twice);
    });
    assert!(found(&report).contains(&What::BodyUnsound { body: 0 }));
}

#[test]
fn findings_of_bodies_say_where_and_are_explained() {
    let report = tampered(BOX, |records| go_through(records));
    let missed = &report.findings[0];
    assert!(matches!(missed.what, What::BodyMissed { .. }));
    assert_eq!(missed.segments.len(), 1);
    let command = missed.command(&Caller::Test).unwrap();
    assert!(command.contains("explain --turning -"), "{command}");
    assert!(missed.place().is_some());
    let segment = SegmentId {
        wire: WireId(0),
        segment: 1,
    };
    let made_up = tampered(BOX, |records| {
        let crossings = &mut records[1].collisions.body_crossings;
        crossings.push(BodyCrossing {
            body: BodyId(0),
            segment,
            arc: 1.5,
            toi: 0.5,
            outcome: BodyCrossingOutcome::Passed,
        });
    });
    assert_eq!(made_up.false_hits, 1);
    assert_eq!(
        made_up.findings[0].to_string(),
        "step 1: reported to meet, and do not: wire 0 segment 1 and body 0"
    );
    for kind in [RemeshKind::Merge, RemeshKind::Split] {
        let report = remeshed_beside_a_body(1.0, kind);
        let finding = &report.findings[0];
        assert_eq!(finding.what, What::BodyRemesh { body: 0, arc: 1.0 });
        assert_eq!(
            finding.to_string(),
            "step 0: a change of resolution at 1 m passes through body 0: wire 0 segment 0"
        );
        let command = finding.command(&Caller::Test).unwrap();
        assert!(command.contains("explain --turning -"), "{command}");
        let between_wires = remeshed(1.0, kind);
        assert_eq!(between_wires.findings[0].segments.len(), 2);
    }
}
