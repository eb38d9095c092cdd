//! This project's own methods as a program, timed as the peers are: `certified`, `additive`,
//! `thesis`, or `tuned`, the thesis path with other thresholds.

use tunnelproof::additive::Additive;
use tunnelproof::decide;
use tunnelproof::narrow::{NarrowPhase, Report, Unsupported};
use tunnelproof::query::{Point, Query, QueryKind};
use tunnelproof::thesis::{Options, Thesis, Thresholds};

mod boxes;
#[path = "../../common/frames.rs"]
mod frames;

use frames::{Asked, Clock, Convex, Said, serve, skin};

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

fn narrow(engine: impl NarrowPhase, asked: &Asked, clock: &mut Clock) -> Said {
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

fn no_box(_: &[Convex; 2], _: &mut Clock) -> Said {
    Said::Unsupported
}

fn main() -> std::io::Result<()> {
    let method = std::env::args().nth(1).unwrap_or_default();
    match method.as_str() {
        "additive" => serve(
            |asked, clock| narrow(Additive::default(), asked, clock),
            no_box,
        ),
        "thesis" => serve(
            |asked, clock| narrow(Thesis::default(), asked, clock),
            no_box,
        ),
        "tuned" => serve(|asked, clock| narrow(tuned(), asked, clock), no_box),
        _ => serve(certified, boxes::certified),
    }
}
