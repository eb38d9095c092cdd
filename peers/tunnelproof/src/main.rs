//! This project's own methods as a program, timed as the peers are: `certified`, `additive`,
//! `thesis`, or `tuned`, the thesis path with other thresholds.

use tunnelproof::additive::Additive;
use tunnelproof::nalgebra::Quaternion;
use tunnelproof::narrow::{NarrowPhase, Report, Unsupported};
use tunnelproof::query::{Point, Query, QueryKind};
use tunnelproof::rigid::{Pose, RigidMotion, RigidQuery, Side};
use tunnelproof::thesis::{Options, Thesis, Thresholds};
use tunnelproof::{decide, decide_rigid};

mod boxes;
#[path = "../../common/frames.rs"]
mod frames;

use frames::{Asked, Clock, Convex, Engine, Said, Turning, serve, skin};

fn query(asked: &Asked) -> Option<Query> {
    let kind = match asked.is_face {
        true => QueryKind::VertexFace,
        false => QueryKind::EdgeEdge,
    };
    let points = |first: usize| [0, 1, 2, 3].map(|i| Point::from(asked.points[first + i]));
    let [first, second] = asked.radii;
    Query::new(kind, points(0), points(4), [first + skin(), second]).ok()
}

fn certified(asked: &Asked, clock: &mut Clock) -> Said {
    let toi = match query(asked) {
        Some(Query::EdgeEdge(query)) => clock.timed(|| decide(&query)).map(|hit| hit.toi),
        Some(Query::VertexFace(query)) => clock.timed(|| decide(&query)).map(|hit| hit.toi),
        None => return Said::Unsupported,
    };
    toi.map_or(Said::Miss, Said::Hit)
}

fn narrow(engine: &impl NarrowPhase, asked: &Asked, clock: &mut Clock) -> Said {
    let report: Result<Report, Unsupported> = match query(asked) {
        Some(Query::EdgeEdge(query)) => clock.timed(|| engine.edge_edge(&query)),
        Some(Query::VertexFace(query)) => clock.timed(|| engine.vertex_face(&query)),
        None => return Said::Unsupported,
    };
    match report {
        Ok(report) => match report.verdict.contact() {
            Some(contact) => Said::Hit(contact.toi),
            None => Said::Miss,
        },
        Err(_) => Said::Unsupported,
    }
}

/// What `tune` recommends for scenes of a metre (docs/thresholds.md).
const TUNED: Thresholds = Thresholds::named([1e-4, 1e-4, 1e-15, 1e-5, 1e-12]);

fn tuned() -> Thesis {
    let options = Options {
        thresholds: TUNED,
        ..Options::default()
    };
    Thesis { options }
}

fn rigid_query(asked: &Turning) -> Option<RigidQuery> {
    let pose = |[x, y, z, w, i, j, k]: [f64; 7]| {
        Pose::new(Point::new(x, y, z), Quaternion::new(w, i, j, k))
    };
    let points = asked.local.map(Point::from);
    let (first, second) = points.split_at(if asked.is_face { 1 } else { 2 });
    let motion = |[start, end]: [[f64; 7]; 2]| RigidMotion::new(pose(start), pose(end)).ok();
    let motions = [motion(asked.poses[0])?, motion(asked.poses[1])?];
    let sides = [(first, &motions[0]), (second, &motions[1])];
    let sides = sides.map(|(local, motion)| Side::Turning { local, motion });
    let [radius, other] = asked.radii;
    RigidQuery::new(sides, [radius + skin(), other]).ok()
}

/// The certified path.
struct Certified;

impl Engine for Certified {
    fn answer(&self, asked: &Asked, clock: &mut Clock) -> Said {
        certified(asked, clock)
    }

    fn cast(&self, bodies: &[Convex; 2], clock: &mut Clock) -> Said {
        boxes::certified(bodies, clock)
    }

    fn turning(&self, asked: &Turning, clock: &mut Clock) -> Said {
        let Some(query) = rigid_query(asked) else {
            return Said::Unsupported;
        };
        let hit = clock.timed(|| decide_rigid(&query));
        hit.map_or(Said::Miss, |hit| Said::Hit(hit.toi))
    }
}

/// A method that answers queries alone.
struct Narrow<N>(N);

impl<N: NarrowPhase> Engine for Narrow<N> {
    fn answer(&self, asked: &Asked, clock: &mut Clock) -> Said {
        narrow(&self.0, asked, clock)
    }
}

fn main() -> std::io::Result<()> {
    let method = std::env::args().nth(1).unwrap_or_default();
    match method.as_str() {
        "additive" => serve(Narrow(Additive::default())),
        "thesis" => serve(Narrow(Thesis::default())),
        "tuned" => serve(Narrow(tuned())),
        _ => serve(Certified),
    }
}
