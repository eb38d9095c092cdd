//! The kinds of queries of bodies that turn: what is asked of them.

use crate::certified::exact;
use crate::certified::kind::Sealed;
use crate::certified::normal::{HasNormal, Normal};
use crate::certified::stage::Finding;
use crate::contact::{EdgePlace, FacePlace, Hit, Place};
use crate::environment;
use crate::query::{EdgeEdge, Radius, VertexFace};
use crate::rigid::{
    EdgeTurningEdge, RigidQuery, TurningEdgeTurningEdge, TurningVertexTurningFace,
    VertexTurningFace,
};

/// A kind of query about bodies that turn: [`EdgeTurningEdge`], [`VertexTurningFace`],
/// [`TurningEdgeTurningEdge`], [`TurningVertexTurningFace`], or any of them as a [`RigidQuery`].
///
/// The trait is sealed: no other type can be one.
pub trait RigidKind:
    Sealed + HasNormal<<Self as RigidKind>::Place> + Copy + Send + Sync + 'static
{
    /// Where the two sides touch.
    type Place: Copy + std::fmt::Debug + PartialEq + Send + Sync + Into<Place> + 'static;

    #[doc(hidden)]
    #[allow(private_interfaces, reason = "only this module uses it")]
    fn decide_in_f64(&self) -> Finding<Hit<Self::Place>>;

    #[doc(hidden)]
    fn decide_in_integers(&self) -> Option<Hit<Self::Place>>;
}

/// Whether and when an edge or a vertex, of space or of another body, touches an edge or a face of a
/// body that turns: certified, without thresholds.
///
/// The query is of any [`RigidKind`]. The answer is as that of
/// [`decide`](crate::decide): no hit is false, no contact is missed, [`toi`](Hit::toi) is the exact
/// time of impact rounded down, and the place has an error of at most `2^-50`. The contact normal is
/// computed where [`Hit::normal`] asks for it.
///
/// # Panics
///
/// In debug builds, if the floating-point environment is not the one that the proofs assume.
pub fn decide_rigid<K: RigidKind>(query: &K) -> Option<Hit<K::Place>> {
    debug_assert_eq!(environment::check(), Ok(()));
    match query.decide_in_f64() {
        Finding::Hit(hit) => Some(hit),
        Finding::Miss => None,
        Finding::Undecided => query.decide_in_integers(),
    }
}

/// As [`decide_rigid`], by integer arithmetic alone.
pub fn decide_rigid_exactly<K: RigidKind>(query: &K) -> Option<Hit<K::Place>> {
    query.decide_in_integers()
}

macro_rules! kind {
    ($kind:ident, $linear:ident, $place:ident, $decide:ident, $passage:ident, $normal:ident) => {
        impl Sealed for $kind {}

        impl HasNormal<$place> for $kind {
            fn contact_radius(&self) -> Radius {
                self.radius()
            }

            fn normal_of(&self, hit: &Hit<$place>) -> Option<Normal> {
                let turning = self.turning();
                let exactly = |toi| exact::$normal(&turning, toi);
                turning.normal::<$linear>(hit, hit.place.error, exactly)
            }
        }

        impl RigidKind for $kind {
            type Place = $place;

            #[allow(private_interfaces, reason = "only this module uses it")]
            fn decide_in_f64(&self) -> Finding<Hit<$place>> {
                let turning = self.turning();
                turning.decide::<$linear>(|| exact::$passage(&turning))
            }

            fn decide_in_integers(&self) -> Option<Hit<$place>> {
                exact::$decide(&self.turning())
            }
        }
    };
}

kind!(
    EdgeTurningEdge,
    EdgeEdge,
    EdgePlace,
    decide_turning_edges,
    passage_of_turning_edges,
    normal_of_turning_edges
);
kind!(
    VertexTurningFace,
    VertexFace,
    FacePlace,
    decide_turning_face,
    passage_of_turning_face,
    normal_of_turning_face
);
kind!(
    TurningEdgeTurningEdge,
    EdgeEdge,
    EdgePlace,
    decide_turning_edges,
    passage_of_turning_edges,
    normal_of_turning_edges
);
kind!(
    TurningVertexTurningFace,
    VertexFace,
    FacePlace,
    decide_turning_face,
    passage_of_turning_face,
    normal_of_turning_face
);

impl Sealed for RigidQuery {}

/// Does the same for a query of any kind.
macro_rules! of_any_kind {
    ($query:expr, $of:ident => $answer:expr) => {
        match $query {
            RigidQuery::EdgeTurningEdge($of) => $answer,
            RigidQuery::VertexTurningFace($of) => $answer,
            RigidQuery::TurningEdgeTurningEdge($of) => $answer,
            RigidQuery::TurningVertexTurningFace($of) => $answer,
        }
    };
}

impl HasNormal<Place> for RigidQuery {
    fn contact_radius(&self) -> Radius {
        self.radius()
    }

    /// `None` also for the place of the other kind.
    fn normal_of(&self, hit: &Hit<Place>) -> Option<Normal> {
        match hit.place {
            Place::Edges(place) => {
                let hit = hit.map_place(|_| place);
                match self {
                    RigidQuery::EdgeTurningEdge(query) => query.normal_of(&hit),
                    RigidQuery::TurningEdgeTurningEdge(query) => query.normal_of(&hit),
                    _ => None,
                }
            }
            Place::Face(place) => {
                let hit = hit.map_place(|_| place);
                match self {
                    RigidQuery::VertexTurningFace(query) => query.normal_of(&hit),
                    RigidQuery::TurningVertexTurningFace(query) => query.normal_of(&hit),
                    _ => None,
                }
            }
        }
    }
}

impl RigidKind for RigidQuery {
    type Place = Place;

    #[allow(private_interfaces, reason = "only this module uses it")]
    fn decide_in_f64(&self) -> Finding<Hit<Place>> {
        of_any_kind!(self, query => query.decide_in_f64().map(|hit| hit.map_place(Into::into)))
    }

    fn decide_in_integers(&self) -> Option<Hit<Place>> {
        of_any_kind!(self, query => query.decide_in_integers().map(|hit| hit.map_place(Into::into)))
    }
}
