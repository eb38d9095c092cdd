//! The certified path for a radius above 0: the distance of two edges, or of a vertex and a face.
//!
//! 1. The swept boxes are farther apart than the radius (`separate`).
//! 2. The direction from middle to middle separates them by more than the radius for the whole step (`advance`).
//! 3. A plane that stays does so, between the points that are nearest where that direction fails; or others, which turn with the
//!    two (`turning`), do so for one part of the step after the other, up to its end
//!    or to the contact (`advance`). There the squared distance of the points that are nearest, in double-double
//!    arithmetic, and a bound on how far these move (`nearness`) hold the time of impact between neighbours in `f64`
//!    (`settle`). Points that are near at the start are a contact there. The rest of the answer is bounded in
//!    `f64` too (`contact`).
//! 4. Integers decide what is left (`exact::thick`): edges that are or may be parallel where they touch, a time of impact that
//!    is a number in `f64`, grazes.
//!
//! The proofs need no case distinction: a plane between two sides bounds their distance from below, two points
//! bound it from above, wherever they come from.

mod advance;
mod contact;
mod instant;
mod nearness;
mod settle;
mod shape;
#[cfg(test)]
mod testing;
mod turning;

use wide::f64x2;

use super::cascade::Stage;
use super::cubic::Cubic;
use super::exact::{self, Approach, Passage};
use super::face::{self, FaceHit};
use super::locate::Place;
use super::motion::{Motion, Positions, dot};
use super::root::Bracket;
use super::separate::U;
use super::verdict::{Hit, Parameters};
use crate::contact::Flags;
use crate::query::Radius;
use advance::{Advance, Moving, rounded_up};
use contact::{Contact, contact};
use instant::Instant;
use settle::{Settled, settle};
pub(super) use shape::{Edges, Face};
use shape::{Shape, Spot};

/// The first contact of two edges, by integers alone, and the case of the motion.
pub(super) fn decide_edges_exactly(positions: &Positions, radius: Radius) -> exact::Decision {
    let Passage { case, kind } = exact::passage_of_edges(positions);
    let hit = exact::approach_of_edges(positions, radius.parts()).map(|approach| {
        let parameters = |[u, v]: [f64; 2]| Parameters { u, v };
        Hit {
            toi: approach.toi[0],
            toi_above: approach.toi[1],
            kind,
            side: approach.side,
            first: parameters(approach.first),
            second: approach.second.map(parameters),
            parameter_error: exact::PARAMETER_ERROR,
            case,
            flags: approach.flags,
        }
    });
    exact::Decision { case, hit }
}

/// The first contact of a vertex and a face, by integers alone.
pub(super) fn decide_face_exactly(positions: &Positions, radius: Radius) -> Option<FaceHit> {
    let Approach {
        toi: [toi, toi_above],
        side,
        first,
        second: _,
        flags,
    } = exact::approach_of_face(positions, radius.parts())?;
    let Passage { case, kind } = exact::passage_of_face(&face::as_edges(positions));
    Some(FaceHit {
        toi,
        toi_above,
        kind,
        side,
        weights: first,
        weight_error: exact::PARAMETER_ERROR,
        case,
        flags,
    })
}

/// A kind of query.
pub(super) trait Kind: Shape {
    type Hit;

    /// Where the midlines, or the vertex and the face, are at a root of `f`.
    fn crosses_at(points: &[[f64x2; 3]; 4], cubic: &Cubic, bracket: &Bracket) -> Option<bool>;

    /// What integers say of the midlines.
    fn passage(positions: &Positions) -> Passage;

    fn hit(contact: &Contact) -> Self::Hit;

    fn decide_exactly(positions: &Positions, radius: Radius) -> Option<Self::Hit>;
}

/// The first contact within a radius above 0, by all stages.
#[inline(always)]
pub(super) fn decide<K: Kind>(
    positions: impl Fn() -> Positions,
    radius: Radius,
    observe: &mut impl FnMut(Stage),
) -> Option<K::Hit> {
    let moving = Moving::new::<K>(&positions().points::<f64x2>(), rounded_up(radius));
    if moving.boxes.are_disjoint {
        observe(Stage::Boxes);
        return None;
    }
    let proved = moving.stays_apart_by_centres::<K>();
    if proved >= 1.0 {
        observe(Stage::Direction);
        return None;
    }
    decide_open::<K>(&positions, &moving, radius, proved, observe)
}

/// What the first two stages leave open; not inlined, so that these stay small.
#[inline(never)]
fn decide_open<K: Kind>(
    positions: &impl Fn() -> Positions,
    moving: &Moving<f64x2>,
    radius: Radius,
    proved: f64,
    observe: &mut impl FnMut(Stage),
) -> Option<K::Hit> {
    if let Some(contact) = decide_by_planes::<K>(positions, moving, radius, proved) {
        observe(Stage::Planes);
        return contact.map(|contact| K::hit(&contact));
    }
    observe(Stage::Exact);
    K::decide_exactly(&positions(), radius)
}

/// The contact, if any; `None` if something is not certain.
fn decide_by_planes<K: Kind>(
    positions: &impl Fn() -> Positions,
    moving: &Moving<f64x2>,
    radius: Radius,
    proved: f64,
) -> Option<Option<Contact>> {
    let contact = match moving.advance::<K>(proved) {
        Advance::Apart => return Some(None),
        _ if !moving.is_ordinary() => None,
        Advance::Near => {
            let start = moving.near_start::<K>(radius)?;
            contact::<K>(&positions(), moving, &start)
        }
        Advance::Until(proved) => {
            let positions = &positions();
            match settle::<K>(positions, moving, radius, proved)? {
                None => return Some(None),
                Some(settled) => contact::<K>(positions, moving, &settled),
            }
        }
    };
    contact.map(Some)
}

impl Moving<f64x2> {
    /// Whether squares, and their errors in double-double arithmetic, neither over- nor underflow.
    fn is_ordinary(&self) -> bool {
        self.radius > SMALLEST && self.radius < LARGEST && self.boxes.size() < LARGEST
    }

    /// The nearest place at the start, if two points are certainly within the radius of each other there.
    ///
    /// With the size `e` of the box around all points, a component of the way is within `12 u e` of the exact one;
    /// its length then within `12 u |e|`, and computed with a relative error below `4 u`.
    fn near_start<S: Shape>(&self, radius: Radius) -> Option<Settled> {
        let start = Instant::new::<S, _>(self, 0.0);
        let length = dot(&start.way, &start.way).sqrt();
        let high = (length + 16.0 * U * self.boxes.size()) * (1.0 + 16.0 * U) + f64::MIN_POSITIVE;
        let is_near = length.is_finite() && high <= radius.rounded().next_down();
        let nearness = self.nearness(&start, 0.0).filter(|_| is_near)?;
        Settled::new(0.0, start.spot, &nearness)
    }
}

/// 2^-200.
const SMALLEST: f64 = f64::from_bits((1023 - 200) << 52);

/// 2^180.
const LARGEST: f64 = f64::from_bits((1023 + 180) << 52);

impl Kind for Edges {
    type Hit = Hit;

    fn crosses_at(points: &[[f64x2; 3]; 4], cubic: &Cubic, bracket: &Bracket) -> Option<bool> {
        match Motion::new(points).meeting(cubic, bracket).place() {
            Place::Apart => Some(false),
            Place::Inside { .. } => Some(true),
            Place::Unclear => None,
        }
    }

    fn passage(positions: &Positions) -> Passage {
        exact::passage_of_edges(positions)
    }

    fn hit(contact: &Contact) -> Hit {
        let Spot { u, v, .. } = contact.spot;
        let Passage { case, kind } = contact.passage;
        Hit {
            toi: contact.toi[0],
            toi_above: contact.toi[1],
            kind,
            side: contact.side,
            first: Parameters { u, v },
            second: None,
            parameter_error: contact.error,
            case,
            flags: Flags::default(),
        }
    }

    fn decide_exactly(positions: &Positions, radius: Radius) -> Option<Hit> {
        decide_edges_exactly(positions, radius).hit
    }
}

impl Kind for Face {
    type Hit = FaceHit;

    fn crosses_at(points: &[[f64x2; 3]; 4], cubic: &Cubic, bracket: &Bracket) -> Option<bool> {
        face::is_inside_at(points, cubic, bracket)
    }

    fn passage(positions: &Positions) -> Passage {
        exact::passage_of_face(&face::as_edges(positions))
    }

    /// The weight of B is what the others leave of 1, rounded twice.
    fn hit(contact: &Contact) -> FaceHit {
        let Spot { u, v, .. } = contact.spot;
        let Passage { case, kind } = contact.passage;
        FaceHit {
            toi: contact.toi[0],
            toi_above: contact.toi[1],
            kind,
            side: contact.side,
            weights: [(1.0 - u - v).max(0.0), u, v],
            weight_error: 2.0 * contact.error + 4.0 * U,
            case,
            flags: Flags::default(),
        }
    }

    fn decide_exactly(positions: &Positions, radius: Radius) -> Option<FaceHit> {
        decide_face_exactly(positions, radius)
    }
}
