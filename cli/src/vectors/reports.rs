//! Situations from public bug reports, each rebuilt as a query of its own: what is reported is the
//! situation, the numbers are chosen here.

use tunnelproof::query::{EdgeEdge, Point, Query};

use super::Source;
use super::flag::Flag;
use super::vector::{Described, Wire};

/// About 1e-6, and exactly representable.
const NUDGE: f64 = 1.0 / (1 << 20) as f64;
/// About 1e-9.
const TINY: f64 = 1.0 / (1 << 30) as f64;

/// Four points at one time.
type Positions = [[f64; 3]; 4];

struct Report {
    /// Repository and number.
    place: &'static str,
    /// Tells the queries of one report apart.
    name: &'static str,
    situation: &'static str,
    start: Positions,
    end: Positions,
}

/// AB from -1 to 1 on the x axis.
const A: [f64; 3] = [-1.0, 0.0, 0.0];
const B: [f64; 3] = [1.0, 0.0, 0.0];

const REPORTS: &[Report] = &[
    Report {
        place: "dimforge/parry#180",
        name: "end-on-segment",
        situation: "a segment comes end first onto another in its plane, and no time of impact is found until a point is nudged",
        start: [A, B, [0.0, 1.0, 0.0], [0.0, 2.0, 0.0]],
        end: [A, B, [0.0, -1.0, 0.0], [0.0, 0.0, 0.0]],
    },
    Report {
        place: "dimforge/parry#180",
        name: "nudged",
        situation: "the same with a point nudged by 2^-20",
        start: [A, B, [0.0, 1.0, 0.0], [NUDGE, 2.0, 0.0]],
        end: [A, B, [0.0, -1.0, 0.0], [NUDGE, 0.0, 0.0]],
    },
    Report {
        place: "dimforge/parry#317",
        name: "middle",
        situation: "an obvious hit that is missed: the middle of one edge goes through the middle of the other at a right angle",
        start: [A, B, [0.0, -1.0, 1.0], [0.0, 1.0, 1.0]],
        end: [A, B, [0.0, -1.0, -1.0], [0.0, 1.0, -1.0]],
    },
    Report {
        place: "dimforge/parry#429",
        name: "extent-5",
        situation: "a time of impact whose error grows with the extent of the target, here an edge of 10 m",
        start: [
            [-5.0, 0.0, 0.0],
            [5.0, 1.0, 0.0],
            [1.0, -1.0, 1.0],
            [0.0, 1.0, 2.0],
        ],
        end: [
            [-5.0, 0.0, 0.0],
            [5.0, 1.0, 0.0],
            [1.0, -1.0, -2.0],
            [0.0, 1.0, -1.0],
        ],
    },
    Report {
        place: "dimforge/parry#429",
        name: "extent-500",
        situation: "the same with an edge of 1000 m",
        start: [
            [-500.0, 0.0, 0.0],
            [500.0, 1.0, 0.0],
            [1.0, -1.0, 1.0],
            [0.0, 1.0, 2.0],
        ],
        end: [
            [-500.0, 0.0, 0.0],
            [500.0, 1.0, 0.0],
            [1.0, -1.0, -2.0],
            [0.0, 1.0, -1.0],
        ],
    },
    Report {
        place: "dimforge/parry#429",
        name: "extent-1048576",
        situation: "the same with an edge of 2^21 m",
        start: [
            [-1048576.0, 0.0, 0.0],
            [1048576.0, 1.0, 0.0],
            [1.0, -1.0, 1.0],
            [0.0, 1.0, 2.0],
        ],
        end: [
            [-1048576.0, 0.0, 0.0],
            [1048576.0, 1.0, 0.0],
            [1.0, -1.0, -2.0],
            [0.0, 1.0, -1.0],
        ],
    },
    Report {
        place: "Continuous-Collision-Detection/Tight-Inclusion#1",
        name: "leaving",
        situation: "a time of impact of 0 where there is no contact: edges that start 2^-20 apart and leave each other",
        start: [A, B, [0.0, -1.0, NUDGE], [0.0, 1.0, NUDGE]],
        end: [A, B, [0.0, -1.0, 1.0], [0.0, 1.0, 1.0]],
    },
    Report {
        place: "Continuous-Collision-Detection/Tight-Inclusion#1",
        name: "sliding",
        situation: "edges that stay 2^-20 apart while one slides along the other",
        start: [A, B, [-1.0, -1.0, NUDGE], [-1.0, 1.0, NUDGE]],
        end: [A, B, [1.0, -1.0, NUDGE], [1.0, 1.0, NUDGE]],
    },
    Report {
        place: "ipc-sim/ipc-toolkit#39",
        name: "nearly-parallel",
        situation: "a query that takes seconds: nearly parallel edges pass closely along each other",
        start: [A, B, [-3.0, 0.0, NUDGE], [-1.0, 0.0, NUDGE + TINY]],
        end: [A, B, [1.0, 0.0, NUDGE + TINY], [3.0, 0.0, NUDGE]],
    },
    Report {
        place: "ipc-sim/ipc-toolkit#225",
        name: "apart",
        situation: "coplanar, nearly collinear edges that do not overlap and are taken to be at distance 0",
        start: [A, B, [2.0, 0.0, 0.0], [3.0, NUDGE, 0.0]],
        end: [A, B, [2.0, 0.0, 0.0], [3.0, NUDGE, 0.0]],
    },
    Report {
        place: "ipc-sim/ipc-toolkit#225",
        name: "meeting",
        situation: "the same edges, which meet end to end",
        start: [A, B, [2.0, 0.0, 0.0], [3.0, NUDGE, 0.0]],
        end: [A, B, [0.0, 0.0, 0.0], [1.0, NUDGE, 0.0]],
    },
    Report {
        place: "dartsim/dart#2700",
        name: "coplanar",
        situation: "coplanar edges that touch neither at the start nor at the end and cross in between: the cubic is identically 0",
        start: [A, B, [0.0, 1.0, 0.0], [0.0, 2.0, 0.0]],
        end: [A, B, [0.0, -2.0, 0.0], [0.0, -1.0, 0.0]],
    },
    Report {
        place: "johannesdagerbrant/TautRopeSim#20",
        name: "flat",
        situation: "a rope slides flat over an edge in the plane of a face: the determinant is exactly 0",
        start: [
            [-2.0, 0.0, 0.0],
            [2.0, 0.0, 0.0],
            [0.0, 1.0, 0.0],
            [1.0, 3.0, 0.0],
        ],
        end: [
            [-2.0, 2.0, 0.0],
            [2.0, 2.0, 0.0],
            [0.0, 1.0, 0.0],
            [1.0, 3.0, 0.0],
        ],
    },
    Report {
        place: "johannesdagerbrant/TautRopeSim#20",
        name: "nearly-flat",
        situation: "the same with an end of the edge 2^-30 out of the plane: the determinant is nearly 0",
        start: [
            [-2.0, 0.0, 0.0],
            [2.0, 0.0, 0.0],
            [0.0, 1.0, -TINY],
            [1.0, 3.0, TINY],
        ],
        end: [
            [-2.0, 2.0, 0.0],
            [2.0, 3.0, 0.0],
            [0.0, 1.0, -TINY],
            [1.0, 3.0, TINY],
        ],
    },
    Report {
        place: "bulletphysics/bullet3#2228",
        name: "small",
        situation: "thresholds tuned by hand fail at another scale, here 2^-30",
        start: [
            [-TINY, 0.0, 0.0],
            [TINY, 0.0, 0.0],
            [0.0, -TINY, TINY],
            [0.0, TINY, TINY],
        ],
        end: [
            [-TINY, 0.0, 0.0],
            [TINY, 0.0, 0.0],
            [0.0, -TINY, -TINY],
            [0.0, TINY, -TINY],
        ],
    },
    Report {
        place: "bulletphysics/bullet3#2228",
        name: "large",
        situation: "thresholds tuned by hand fail at another scale, here 2^30",
        start: [
            [-1073741824.0, 0.0, 0.0],
            [1073741824.0, 0.0, 0.0],
            [0.0, -1073741824.0, 1073741824.0],
            [0.0, 1073741824.0, 1073741824.0],
        ],
        end: [
            [-1073741824.0, 0.0, 0.0],
            [1073741824.0, 0.0, 0.0],
            [0.0, -1073741824.0, -1073741824.0],
            [0.0, 1073741824.0, -1073741824.0],
        ],
    },
    Report {
        place: "NVIDIA-Omniverse/PhysX#505",
        name: "second-root",
        situation: "a test applied after the smallest time is chosen: the lines meet first outside of the edges, later inside",
        start: [A, B, [0.0, 2.0, 0.5], [0.0, 2.5, 4.0]],
        end: [A, B, [0.0, -2.0, 2.5], [0.0, 0.5, -4.0]],
    },
    Report {
        place: "google-deepmind/mujoco#511",
        name: "rope-through-edge",
        situation: "a rope passes through an edge of a body",
        start: [A, B, [-1.0, 1.0, 2.0], [1.0, 0.0, 1.0]],
        end: [A, B, [-1.0, 0.0, -1.0], [1.0, -1.0, -2.0]],
    },
    Report {
        place: "google-deepmind/mujoco#513",
        name: "rope-through-rope",
        situation: "ropes pass through each other, both moving",
        start: [
            [-1.0, 0.0, -1.0],
            [1.0, 0.0, 0.0],
            [0.0, -1.0, 1.0],
            [0.0, 1.0, 0.0],
        ],
        end: [
            [-1.0, 0.0, 1.0],
            [1.0, 0.0, 1.0],
            [0.0, -1.0, -1.0],
            [0.0, 1.0, 0.0],
        ],
    },
    Report {
        place: "dimforge/rapier#984",
        name: "fast",
        situation: "a rope passes through another within a small part of the step",
        start: [A, B, [0.0, -1.0, 1000.0], [0.0, 1.0, 1000.0]],
        end: [A, B, [0.0, -1.0, -24.0], [0.0, 1.0, -24.0]],
    },
];

/// A rope that passes through another at a node: the segments before and after it.
const NODE: [Report; 2] = [
    Report {
        place: "newton-physics/newton#4280",
        name: "node/0",
        situation: "a rope passes through another at a node, here the segment before it",
        start: [
            [-1.0, 1.0, 0.0],
            [0.0, 0.0, 0.0],
            [0.0, -1.0, 1.0],
            [0.0, 1.0, 1.0],
        ],
        end: [
            [-1.0, 1.0, 0.0],
            [0.0, 0.0, 0.0],
            [0.0, -1.0, -2.0],
            [0.0, 1.0, -2.0],
        ],
    },
    Report {
        place: "newton-physics/newton#4280",
        name: "node/1",
        situation: "a rope passes through another at a node, here the segment after it",
        start: [
            [0.0, 0.0, 0.0],
            [1.0, 1.0, 0.0],
            [0.0, -1.0, 1.0],
            [0.0, 1.0, 1.0],
        ],
        end: [
            [0.0, 0.0, 0.0],
            [1.0, 1.0, 0.0],
            [0.0, -1.0, -2.0],
            [0.0, 1.0, -2.0],
        ],
    },
];

pub(super) fn reports() -> Source {
    let node = NODE.iter().enumerate().map(|(segment, report)| Described {
        flags: vec![Flag::PublicReport, Flag::WireJoint],
        wire: Some(Wire {
            id: format!("{}/node", report.place),
            segment,
        }),
        ..report.described()
    });
    Source {
        name: "reports".to_owned(),
        description: "situations from public bug reports, rebuilt".to_owned(),
        queries: REPORTS.iter().map(Report::described).chain(node).collect(),
    }
}

impl Report {
    fn described(&self) -> Described {
        let [start, end] = [self.start, self.end].map(|points| points.map(Point::from));
        let query = EdgeEdge::new(start, end, 0.0).expect("coordinates are finite");
        Described {
            id: format!("{}/{}", self.place, self.name),
            comment: format!("{}: {}", self.place, self.situation),
            flags: vec![Flag::PublicReport],
            wire: None,
            query: Query::EdgeEdge(query),
        }
    }
}
