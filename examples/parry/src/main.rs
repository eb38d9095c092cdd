//! The motion test of parry (`cast_shapes`), judged where it answers the same question: two edges
//! that move without turning, each by one translation.

use parry3d_f64::math::{Pose, Vector};
use parry3d_f64::query::{ShapeCastOptions, cast_shapes};
use parry3d_f64::shape::Segment;
use tunnelproof::contact::{Contact, ContactPoint, Flags, Verdict};
use tunnelproof::narrow::{NarrowPhase, Report, Unsupported};
use tunnelproof::query::{EdgeEdge, Point, Query, QueryKind};
use tunnelproof_reference::certify::run::RunError;
use tunnelproof_reference::generate;

/// `parry3d_f64::query::cast_shapes` on two segments.
struct Parry;

impl NarrowPhase for Parry {
    fn name(&self) -> &str {
        "parry"
    }

    /// The motion of A and of C is taken for that of their edges.
    fn edge_edge(&self, query: &EdgeEdge) -> Result<Report, Unsupported> {
        let [a, b, c, d] = query.start().map(vector);
        let [a1, _, c1, _] = query.end().map(vector);
        let options = ShapeCastOptions {
            max_time_of_impact: 1.0,
            ..ShapeCastOptions::default()
        };
        let hit = cast_shapes(
            &Pose::IDENTITY,
            a1 - a,
            &Segment::new(a, b),
            &Pose::IDENTITY,
            c1 - c,
            &Segment::new(c, d),
            options,
        );
        let hit = hit.map_err(|_| Unsupported::Kind(QueryKind::EdgeEdge))?;
        Ok(Report {
            verdict: hit.map_or(Verdict::Miss, |hit| contact(hit.time_of_impact)),
            case: None,
            flags: Flags::default(),
        })
    }
}

fn vector(point: Point) -> Vector {
    Vector::new(point.x, point.y, point.z)
}

/// A hit at this time; the place is not judged.
fn contact(toi: f64) -> Verdict {
    let first = ContactPoint {
        point: Point::origin(),
        weights: [1.0, 0.0, 1.0, 0.0],
        relative_velocity: None,
    };
    Verdict::Hit(Contact {
        toi,
        first,
        second: None,
        normal: None,
    })
}

/// A query in small integers in which each edge moves as its first end does: exactly a translation,
/// since sums of small integers are not rounded.
fn translated(query: &Query) -> Query {
    let [a, b, c, d] = *query.start();
    let [a1, _, c1, _] = *query.end();
    let end = [a1, b + (a1 - a), c1, d + (c1 - c)];
    Query::new(QueryKind::EdgeEdge, [a, b, c, d], end, 0.0).expect("small integers are finite")
}

fn main() -> Result<(), RunError> {
    let lattice = generate::by_name("lattice").expect("the family is there");
    let queries = (0..20_000).map(|index| translated(&lattice.query(1, index)));
    let trial = tunnelproof_reference::certify(Parry).families([""; 0]);
    let outcome = trial.queries("translations", queries).run()?;
    println!("{}", outcome.text);
    outcome
        .failures
        .iter()
        .for_each(|failure| println!("{failure}"));
    Ok(())
}
