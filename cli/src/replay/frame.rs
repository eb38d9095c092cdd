//! An instant of a run, as the page and the pictures need it.

use serde::Serialize;
use tunnelproof::query::Point;
use tunnelproof::wire::{
    Body, BodyCrossingOutcome, BodyRecord, ContactRecord, ContactSite, CrossingOutcome, NodeKind,
    PairAnswer, PairRecord, Pose, StepRecord, Vector, Wire, WireRecord, World,
};

/// An instant. Lengths in 0.01 mm, forces in 0.01 N, rounded.
#[derive(Debug, Serialize)]
pub(super) struct Frame {
    /// In s.
    pub(super) time: f64,
    #[serde(skip)]
    pub(super) step: u64,
    /// Nodes of each wire: x, y, z one after the other.
    pub(super) wires: Vec<Vec<f64>>,
    /// Of each node: f free, p pinned, e eye, c contact.
    pub(super) kinds: Vec<String>,
    /// Tension of each segment in N.
    tensions: Vec<Vec<f64>>,
    /// Position and quaternion (x, y, z, w) of each body.
    pub(super) bodies: Vec<[f64; 7]>,
    /// Angular speed of each body in rad/s.
    spin: Vec<f64>,
    /// ContactSite, normal and force on A of each contact.
    pub(super) contacts: Vec<[f64; 9]>,
    /// Kinetic, potential, elastic, and the work of scripted bodies and reels so far, in J; none before the first step.
    energy: Option<[f64; 4]>,
    /// Pairs of segments that met on their way.
    met: usize,
    /// What happened since the last frame.
    pub(super) marks: Vec<Mark>,
}

/// Something that can happen, and how it is marked.
#[derive(Debug, Serialize)]
pub(super) struct MarkKind {
    /// Its name in a [`Mark`].
    pub(super) what: &'static str,
    /// What legends call it.
    pub(super) words: &'static str,
    /// Its colour on light paper.
    pub(super) light: &'static str,
    /// Its colour on dark paper.
    pub(super) dark: &'static str,
    /// Whether something got through something else, or may have.
    pub(super) is_bad: bool,
}

/// All that is marked.
pub(super) const MARKS: [MarkKind; 5] = [
    MarkKind {
        what: "missed",
        words: "missed",
        light: "#c62828",
        dark: "#ff6b6b",
        is_bad: true,
    },
    MarkKind {
        what: "jumped",
        words: "jumped",
        light: "#c62828",
        dark: "#ff6b6b",
        is_bad: true,
    },
    MarkKind {
        what: "tunnelled",
        words: "passed through",
        light: "#c62828",
        dark: "#ff6b6b",
        is_bad: true,
    },
    MarkKind {
        what: "returned",
        words: "came back",
        light: "#1f6feb",
        dark: "#6ea8fe",
        is_bad: false,
    },
    MarkKind {
        what: "prevented",
        words: "prevented",
        light: "#b26a00",
        dark: "#f0b23e",
        is_bad: false,
    },
];

/// Something that happened, marked where it did and on the time line.
#[derive(Clone, Copy, Debug, Serialize)]
pub(super) struct Mark {
    /// Of [`MARKS`].
    pub(super) what: &'static str,
    /// Where, if that is known.
    pub(super) at: Option<[f64; 3]>,
}

/// What happened in a step. What else is to be marked is chained to it.
pub(super) fn marks(record: &StepRecord) -> impl Iterator<Item = Mark> {
    let of_wires = record.collisions.crossings.iter().filter_map(|crossing| {
        let what = match crossing.outcome {
            CrossingOutcome::Prevented => "prevented",
            CrossingOutcome::Tunnelled => "tunnelled",
            CrossingOutcome::Returned => "returned",
            CrossingOutcome::Grazed => return None,
        };
        let site = crossing.sites[0];
        let (wire, arc) = (site.wire, site.arc);
        let at = place(record, &ContactSite::Wire { wire, arc });
        Some(Mark {
            what,
            at: at.as_ref().map(triple),
        })
    });
    let of_bodies = record.collisions.body_crossings.iter().map(|crossing| {
        let (wire, arc) = (crossing.segment.wire, crossing.arc);
        let at = place(record, &ContactSite::Wire { wire, arc });
        Mark {
            what: body_mark(crossing.outcome),
            at: at.as_ref().map(triple),
        }
    });
    let of_cores = record
        .collisions
        .core_crossings
        .iter()
        .map(|crossing| Mark {
            what: body_mark(crossing.outcome),
            at: Some(triple(&crossing.at)),
        });
    of_wires.chain(of_bodies).chain(of_cores)
}

fn body_mark(outcome: BodyCrossingOutcome) -> &'static str {
    match outcome {
        BodyCrossingOutcome::Prevented => "prevented",
        BodyCrossingOutcome::Passed => "tunnelled",
    }
}

impl Frame {
    /// Where a run starts, before any step.
    pub(super) fn start(world: &World) -> Self {
        let (wires, bodies) = (world.wires(), world.bodies());
        let nodes = |wire: &Wire| -> Vec<f64> {
            let nodes = wire.nodes().iter();
            nodes.flat_map(|node| triple(&node.position)).collect()
        };
        let kinds = |wire: &Wire| wire.nodes().iter().map(|node| letter(&node.kind)).collect();
        let rest = |body: &Body| {
            pose(&Pose {
                position: body.position(),
                orientation: body.orientation(),
            })
        };
        let tensions = wires.iter().map(|wire| vec![0.0; wire.segments().len()]);
        Frame {
            time: world.time(),
            step: 0,
            wires: wires.iter().map(nodes).collect(),
            kinds: wires.iter().map(kinds).collect(),
            tensions: tensions.collect(),
            bodies: bodies.iter().map(rest).collect(),
            spin: vec![0.0; bodies.len()],
            contacts: Vec::new(),
            energy: None,
            met: 0,
            marks: Vec::new(),
        }
    }

    /// Where a step starts.
    pub(super) fn before(record: &StepRecord, step: f64) -> Self {
        let rest = |body: &BodyRecord| BodyRecord {
            before: body.before,
            between: Vec::new(),
            after: body.before,
        };
        let mut start = record.clone();
        start.contacts.clear();
        start.collisions.pairs.clear();
        start.bodies = record.bodies.iter().map(rest).collect();
        for wire in &mut start.wires {
            wire.after.clone_from(&wire.before);
            wire.tensions.fill(0.0);
        }
        let mut frame = Frame::after(&start, step, Vec::new(), 0.0);
        (frame.time, frame.step, frame.energy) = (record.time - step, 0, None);
        frame
    }

    /// All nodes, each with the number of its wire.
    pub(super) fn nodes(&self) -> impl Iterator<Item = (usize, Point)> {
        let wires = self.wires.iter().enumerate();
        wires.flat_map(|(wire, flat)| {
            let nodes = flat.chunks_exact(3);
            nodes.map(move |at| (wire, Point::new(at[0], at[1], at[2])))
        })
    }

    /// Where a step ends, with the work in J that scripted bodies and reels have done until then.
    pub(super) fn after(record: &StepRecord, step: f64, marks: Vec<Mark>, work: f64) -> Self {
        let flat = |wire: &WireRecord| wire.after.iter().flat_map(triple).collect();
        let energy = &record.energy;
        let met = |said: &&PairRecord| matches!(said.answer, PairAnswer::Met { .. });
        Frame {
            time: record.time,
            step: record.step + 1,
            wires: record.wires.iter().map(flat).collect(),
            kinds: record.wires.iter().map(kinds).collect(),
            tensions: (record.wires.iter())
                .map(|wire| wire.tensions.iter().copied().map(cent).collect())
                .collect(),
            bodies: record.bodies.iter().map(|body| pose(&body.after)).collect(),
            spin: record.bodies.iter().map(|body| spin(body, step)).collect(),
            contacts: record
                .contacts
                .iter()
                .map(|contact| drawn(record, contact))
                .collect(),
            energy: Some([energy.kinetic, energy.potential, energy.elastic, work].map(cent)),
            met: record.collisions.pairs.iter().filter(met).count(),
            marks,
        }
    }
}

fn cent(number: f64) -> f64 {
    (number * 100.0).round() / 100.0
}

pub(super) fn triple(point: &Point) -> [f64; 3] {
    [point.x, point.y, point.z].map(|x| (x * 1e5).round() / 1e5)
}

fn kinds(wire: &WireRecord) -> String {
    wire.kinds.iter().map(letter).collect()
}

fn letter(kind: &NodeKind) -> char {
    match kind {
        NodeKind::Pinned => 'p',
        NodeKind::Eye { .. } => 'e',
        NodeKind::Contact { .. } => 'c',
        // Free, or a kind that the page has no colour for.
        _ => 'f',
    }
}

fn pose(pose: &Pose) -> [f64; 7] {
    let [x, y, z] = triple(&pose.position);
    let [i, j, k, w] = pose.orientation.coords.into();
    [x, y, z, i, j, k, w]
}

/// The angle of a step's turn over its time, which is how the stepper turns a body.
fn spin(body: &BodyRecord, step: f64) -> f64 {
    let (mut last, mut angle) = (body.before.orientation, 0.0);
    for pose in body.between.iter().chain([&body.after]) {
        angle += (pose.orientation * last.inverse()).angle();
        last = pose.orientation;
    }
    let spin = angle / step;
    (spin * 1e4).round() / 1e4
}

fn drawn(record: &StepRecord, ContactRecord { contact, force }: &ContactRecord) -> [f64; 9] {
    let at = place(record, &contact.a).or_else(|| place(record, &contact.b));
    let at = triple(&at.unwrap_or(Point::origin()));
    let parts = [
        at,
        contact.normal.into(),
        Vector::from(force.map(cent)).into(),
    ];
    let mut all = [0.0; 9];
    for (to, from) in all.iter_mut().zip(parts.as_flattened()) {
        *to = *from;
    }
    all
}

/// Where a place is after the motion of a step.
pub(crate) fn place(record: &StepRecord, place: &ContactSite) -> Option<Point> {
    match place {
        ContactSite::World => None,
        ContactSite::Body { body, local } => {
            let pose = &record.bodies.get(body.0)?.after;
            Some(pose.position + pose.orientation * local)
        }
        ContactSite::Wire { wire, arc } => {
            let wire = record.wires.get(wire.0)?;
            let next = wire.arcs.partition_point(|node| node <= arc);
            let next = next.clamp(1, wire.arcs.len().checked_sub(1)?);
            let [start, end] = [wire.arcs[next - 1], wire.arcs[next]];
            let share = ((arc - start) / (end - start)).clamp(0.0, 1.0);
            Some(wire.after[next - 1].lerp(&wire.after[next], share))
        }
    }
}
