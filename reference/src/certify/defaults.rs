//! Which families a subject is judged on if nobody names any.

use std::collections::BTreeSet;

use super::query::AnyQuery;
use super::reply::{Reply, ask};
use super::source::AnyFamily;
use super::tally::Sort;
use crate::generate::{FAMILIES, OTHER_KINDS, RIGID_FAMILIES};
use crate::subject::Subject;

/// Queries of a family that subjects are asked to see whether they take some: those of bodies that
/// turn are of several kinds.
const PROBE: u64 = 16;

/// Every family of edges without radius, if one of the subjects takes such queries; else all others
/// of which one of them takes some.
///
/// Each subject is asked queries of each sort until it takes one. Of subjects that take none, the
/// families are those of edges. A family with radii has some of 0, which do not count.
pub fn families(subjects: &[&dyn Subject]) -> Vec<AnyFamily> {
    let mut taken = BTreeSet::new();
    let mut is_taken = |family: &AnyFamily| {
        let queries: Vec<_> = (0..PROBE).map(|index| family.query(1, index)).collect();
        let has_radius = |query: &AnyQuery| !query.radius().is_zero();
        let is_thick = queries.iter().any(has_radius);
        let mut queries = queries.iter().filter(|query| has_radius(query) == is_thick);
        queries.any(|query| {
            let takes = |subject: &&dyn Subject| ask(*subject, query) != Reply::NotAsked;
            let sort = Sort::of(query);
            let is_taken = taken.contains(&sort) || subjects.iter().any(takes);
            if is_taken {
                taken.insert(sort);
            }
            is_taken
        })
    };
    let edges: Vec<_> = FAMILIES.iter().map(AnyFamily::Linear).collect();
    if edges.first().is_some_and(&mut is_taken) {
        return edges;
    }
    let others = OTHER_KINDS.iter().map(AnyFamily::Linear);
    let turning = RIGID_FAMILIES.iter().map(AnyFamily::Turning);
    let others: Vec<_> = others.chain(turning).filter(is_taken).collect();
    match others.is_empty() {
        true => edges,
        false => others,
    }
}

#[cfg(test)]
mod tests {
    use std::sync::atomic::{AtomicBool, Ordering};

    use tunnelproof::narrow::{NarrowPhase, Report, Unsupported};
    use tunnelproof::query::{EdgeEdge, Query, QueryKind, VertexFace};
    use tunnelproof::rigid::{RigidQuery, RigidQueryKind};

    use super::*;
    use crate::generate::Family;
    use crate::subject::{Answer, Certified, Engine, NoAnswer};

    struct Faces;
    impl NarrowPhase for Faces {
        fn name(&self) -> &str {
            "faces"
        }
        fn edge_edge(&self, _: &EdgeEdge) -> Result<Report, Unsupported> {
            Err(Unsupported::Kind(QueryKind::EdgeEdge))
        }
        fn vertex_face(&self, query: &VertexFace) -> Result<Report, Unsupported> {
            match query.radius().is_zero() {
                true => Ok(Report::miss()),
                false => Err(Unsupported::Radius(query.radius())),
            }
        }
    }

    /// Edges of bodies that turn against those that do not, and nothing else.
    struct Blades;
    impl Subject for Blades {
        fn name(&self) -> &str {
            "blades"
        }
        fn answer(&self, query: &Query) -> Result<Answer, NoAnswer> {
            Err(Unsupported::Kind(query.kind()).into())
        }
        fn turning_answer(&self, query: &RigidQuery) -> Result<Answer, NoAnswer> {
            match query.kind() {
                RigidQueryKind::EdgeTurningEdge => Certified.turning_answer(query),
                kind => Err(Unsupported::Turning(kind).into()),
            }
        }
    }

    /// Edges, but for the first query that it is asked.
    #[derive(Default)]
    struct Late(AtomicBool);
    impl Subject for Late {
        fn name(&self) -> &str {
            "late"
        }
        fn answer(&self, query: &Query) -> Result<Answer, NoAnswer> {
            match self.0.swap(true, Ordering::Relaxed) {
                true => Certified.answer(query),
                false => Err(Unsupported::Kind(query.kind()).into()),
            }
        }
    }

    #[test]
    fn families_are_those_that_a_subject_takes() {
        let names = |subjects: &[&dyn Subject]| {
            let families = families(subjects).into_iter();
            families.map(|family| family.name()).collect::<Vec<_>>()
        };
        let faces = names(&[&Engine(Faces)]);
        assert!(
            faces.iter().all(|name| name.starts_with("face_")),
            "{faces:?}"
        );
        assert!(faces.len() > 5, "{faces:?}");
        let edges: Vec<_> = FAMILIES.iter().map(Family::name).collect();
        assert_eq!(names(&[&Engine(Faces), &Certified]), edges);
        assert_eq!(names(&[]), edges);
        let turning = names(&[&Blades]);
        assert!(
            turning.iter().all(|name| name.starts_with("turning_")),
            "{turning:?}"
        );
        assert!(turning.len() > 5, "{turning:?}");
        assert_eq!(names(&[&Blades, &Certified]), edges);
        // Of several subjects, and of one that takes both, all that they take.
        assert_eq!(names(&[&Engine(Faces), &Blades]), [faces, turning].concat());
        assert_eq!(names(&[&Late::default()]), edges);
    }
}
