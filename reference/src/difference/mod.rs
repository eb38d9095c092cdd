//! The second judge of all kinds of queries: the difference of the two sides.
//!
//! The vectors from a point of one side to a point of the other fill a polygon: of two edges the
//! parallelogram with the corners `C - A`, `D - A`, `C - B` and `D - B`, of a vertex and a face the
//! triangle with the corners `B - A`, `C - A` and `D - A`. The distance of the two sides is that of
//! the origin from this polygon, so that one method does for both kinds and for every radius.
//!
//! It differs from the [`oracle`](crate::oracle) throughout: everything is made of scalar products,
//! by Gram determinants; contact is evaluated at every time at which any sign changes, from the
//! start on, without an argument for which of them matter; what is so before and after a time is
//! seen at fractions before and after it, not by derivatives. The two know nothing of each other.

use tunnelproof::contact::{Case, ContactKind, Flags};
use tunnelproof::query::{Query, QueryKind, Radius};
use tunnelproof::rigid::RigidQuery;

use crate::algebraic::Algebraic;
use crate::answer::{ExactAnswer, ExactHit};
use crate::field::{self, Integer};
use crate::poly::Poly;
use crate::scaled::Scaled;
use crate::subject::{Answer, NoAnswer, Subject};

mod crossing;
mod part;
mod polygon;
mod rigid;

use part::Distance;
use polygon::Polygon;
pub use rigid::decide_rigid;

/// The second judge as a subject; it takes every query.
#[derive(Clone, Copy, Debug, Default)]
pub struct Difference;

impl Subject for Difference {
    fn name(&self) -> &str {
        "difference"
    }

    fn answer(&self, query: &Query) -> Result<Answer, NoAnswer> {
        Ok(Answer::Exact(decide::<field::Default>(query)))
    }

    fn turning_answer(&self, query: &RigidQuery) -> Result<Answer, NoAnswer> {
        Ok(Answer::Exact(decide_rigid::<field::Default>(query)))
    }
}

/// The exact answer to a query.
pub fn decide<Z: Integer>(query: &Query) -> ExactAnswer {
    let points = Scaled::<Z>::new(query);
    let polygon = Polygon::new(query.kind(), &points);
    decide_polygon(&polygon, query.radius(), points.exponent)
}

fn decide_polygon<Z: Integer>(polygon: &Polygon<Z>, radius: Radius, unit: i64) -> ExactAnswer {
    let distance = Distance::new(polygon, radius, unit);
    let hit = distance.first_contact().map(|toi| {
        let crossings = polygon.crossings();
        let is_crossing = match radius.is_zero() {
            true => crossings.iter().any(|time| time.compare(&toi).is_eq()),
            false => !crossings.is_empty(),
        };
        let (features, first, second) = distance.nearest(&toi);
        ExactHit {
            toi: toi.enclosure(),
            kind: match is_crossing {
                true => ContactKind::Crossing,
                false => ContactKind::Graze,
            },
            crosses: !crossings.is_empty(),
            side: polygon.side_before(&toi) as i8,
            features,
            first,
            second,
            flags: flags(polygon, &toi),
        }
    });
    ExactAnswer {
        case: case(polygon),
        hit,
    }
}

fn case<Z: Integer>(polygon: &Polygon<Z>) -> Case {
    let ([p2, q2], area2) = (polygon.lengths(), polygon.area());
    let is_flat = polygon.volume().is_zero();
    match polygon.kind {
        QueryKind::VertexFace if area2.is_zero() => Case::Degenerate,
        QueryKind::EdgeEdge if p2.is_zero() || q2.is_zero() => Case::Degenerate,
        QueryKind::EdgeEdge if polygon.dot(0, 0).is_zero() => Case::SharedStart,
        QueryKind::EdgeEdge if area2.is_zero() => match polygon.is_on_line() {
            true => Case::Collinear,
            false => Case::Parallel,
        },
        _ if is_flat => Case::Coplanar,
        _ => Case::General,
    }
}

fn flags<Z: Integer>(polygon: &Polygon<Z>, time: &Algebraic<Z>) -> Flags {
    let vanishes = |poly: &Poly<Z>| time.sign_of(poly).is_eq();
    let (lengths, area) = (polygon.lengths(), polygon.area());
    let are_points = lengths.each_ref().map(vanishes);
    let (is_point, is_always_point) = match polygon.kind {
        QueryKind::EdgeEdge => {
            let newly = |i: usize| are_points[i] && !lengths[i].is_zero();
            (are_points[0] || are_points[1], !newly(0) && !newly(1))
        }
        QueryKind::VertexFace => (
            are_points[0] && are_points[1],
            lengths.iter().all(Poly::is_zero),
        ),
    };
    Flags {
        temporarily_parallel: vanishes(&area) && !is_point && !area.is_zero(),
        temporarily_point: is_point && !is_always_point,
    }
}
