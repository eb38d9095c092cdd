//! Which families a subject is judged on if nobody names any.

use std::collections::BTreeMap;

use super::reply::{Reply, ask};
use super::tally::Sort;
use crate::generate::{FAMILIES, Family, OTHER_KINDS};
use crate::subject::Subject;

/// Every family of edges without radius, if one of the subjects takes such queries; else those of
/// the sorts of query that one of them takes, vertices and faces first of all.
///
/// Each subject is asked a query of each sort until it takes one. Of subjects that take none, the
/// families are those of edges.
pub fn families(subjects: &[&dyn Subject]) -> Vec<&'static Family> {
    let mut known = BTreeMap::new();
    let mut is_taken = |family: &Family| {
        let query = family.query(1, 0).into();
        let takes = |subject: &&dyn Subject| ask(*subject, &query) != Reply::NotAsked;
        let taken = known.entry(Sort::of(&query));
        *taken.or_insert_with(|| subjects.iter().any(takes))
    };
    let edges = FAMILIES.iter().collect();
    if FAMILIES.first().is_some_and(&mut is_taken) {
        return edges;
    }
    let others: Vec<_> = OTHER_KINDS
        .iter()
        .filter(|family| is_taken(family))
        .collect();
    match others.is_empty() {
        true => edges,
        false => others,
    }
}

#[cfg(test)]
mod tests {
    use tunnelproof::narrow::{NarrowPhase, Report, Unsupported};
    use tunnelproof::query::{EdgeEdge, QueryKind, VertexFace};

    use super::*;
    use crate::subject::{Certified, Engine};

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

    #[test]
    fn families_are_those_that_a_subject_takes() {
        let names = |subjects: &[&dyn Subject]| {
            let families = families(subjects).into_iter();
            families.map(Family::name).collect::<Vec<_>>()
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
    }
}
