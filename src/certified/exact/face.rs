//! A moving vertex and a moving face, decided in integers.
//!
//! The four points are taken as the edges `BC` and `AD`: then `K = C - B`, `L = D - A`,
//! `M = A - B`, and `f = (K x L) . M` is six times the signed volume of the four points, as it is
//! of any order of them. So everything up to the roots of `f` is that of two edges. With
//! `E = D - B = L + M`, the normal of the face is `K x E = N - M x K`, and at a root of `f` the
//! weights of B, C and D times the normal are
//!
//! ```text
//! normal - M x E + M x K = N - M x L        M x E = M x L        K x M = -(M x K)
//! ```
//!
//! The bounds of [`super::width`] hold: the largest of the new coefficients are those of
//! `|D - C|^2`, sums of at most 27, 54 and 27 products, together at most `108 2^(2b)`; that is
//! below `2^(2b + 7)`.

use std::cmp::Ordering;

use super::confined::{first_contact, kind};
use super::curve::Curve;
use super::locus::{Parameter, nonzero_axis};
use super::motion::{End, Motion, Quadratic, add, negate, subtract, subtract_vector};
use super::roots::Roots;
use super::time::Time;
use super::width::{Number, Width};
use super::{PLACE_ERROR, Question, answer};
use crate::certified::motion::Positions;
use crate::contact::{Case, ContactKind, FacePlace, Flags, Hit};

/// The exact answer for a vertex A and a face BCD, given as B, C, A, D.
pub(in crate::certified) fn decide_face(as_edges: &Positions) -> Option<Hit<FacePlace>> {
    answer(VertexMeetsFace, as_edges)
}

/// The case of the motion of a vertex A and a face BCD, given as B, C, A, D.
pub(in crate::certified) fn case_of_face(as_edges: &Positions) -> Case {
    answer(FaceCase, as_edges)
}

struct FaceCase;

impl Question for FaceCase {
    type Answer = Case;

    fn answer<L: Width>(self, motion: Motion<L>) -> Case {
        Face::new(motion).case()
    }
}

/// Whether and when a vertex is in a face.
struct VertexMeetsFace;

impl Question for VertexMeetsFace {
    type Answer = Option<Hit<FacePlace>>;

    fn answer<L: Width>(self, motion: Motion<L>) -> Option<Hit<FacePlace>> {
        let face = Face::new(motion);
        if face.motion.is_confined() {
            face.decide_confined()
        } else {
            face.decide_general()
        }
    }
}

/// A vertex and a face.
pub(super) struct Face<L: Width> {
    pub(super) motion: Motion<L>,
    normal: [Quadratic<L>; 3],
}

/// Where the vertex is in the face at one time.
pub(super) struct Place<L: Width> {
    /// Of B, C and D.
    weights: [Parameter<L>; 3],
    flags: Flags,
}

impl<L: Width> Face<L> {
    pub(super) fn new(motion: Motion<L>) -> Self {
        let normal = subtract_vector::<L>(&motion.n, &motion.m.cross(&motion.k));
        Face { motion, normal }
    }

    /// Whether the face has no area for the whole step.
    fn is_degenerate(&self) -> bool {
        self.normal.iter().flatten().all(Number::is_zero)
    }

    pub(super) fn case(&self) -> Case {
        if self.is_degenerate() {
            Case::Degenerate
        } else if self.motion.is_confined() {
            Case::Coplanar
        } else {
            Case::General
        }
    }

    /// `f` is not identically 0: every contact time is a root of it.
    #[inline(never)]
    fn decide_general(&self) -> Option<Hit<FacePlace>> {
        let mut roots = Roots::none();
        roots.find(Curve::Cubic(self.motion.f.clone()));
        roots.iter().find_map(|(time, before, after)| {
            let place = self.place(&time)?;
            let swaps = before != after && time.is_inside();
            let kind = if swaps && place.is_interior() {
                ContactKind::Crossing
            } else {
                ContactKind::Graze
            };
            Some(self.hit(&time, &place, kind, before))
        })
    }

    /// `f` is identically 0. If the vertex were off all edges at a first contact after the start,
    /// it would be inside a face that is not a segment or a point, and so shortly before. The
    /// candidates are therefore 0 and the times at which it comes onto an edge.
    #[inline(never)]
    fn decide_confined(&self) -> Option<Hit<FacePlace>> {
        let start = Time::start();
        if let Some(place) = self.place(&start) {
            return Some(self.hit(&start, &place, ContactKind::Graze, Ordering::Equal));
        }
        let edges = self.edges();
        let mut roots = [Roots::none(), Roots::none(), Roots::none()];
        let toi = first_contact(&edges, &mut roots)?;
        let place = self.place(&toi)?;
        Some(self.hit(&toi, &place, kind(&edges, &toi, false), Ordering::Equal))
    }

    /// The vertex against the edges BC, CD and DB.
    pub(super) fn edges(&self) -> [End<L>; 3] {
        let Motion { k, l, m, n, .. } = &self.motion;
        let (ml_turn, ml) = (m.cross(l), m.dot(l));
        [
            End {
                turn: m.cross(k),
                between: subtract::<L>(&m.dot(m), &m.dot(k)),
            },
            End {
                turn: subtract_vector::<L>(n, &ml_turn),
                between: subtract::<L>(&k.dot(l), &ml),
            },
            End {
                turn: ml_turn,
                between: negate::<L>(&ml),
            },
        ]
    }

    /// Where the vertex is in the face at a time at which `f` is 0; `None` if it is not.
    pub(super) fn place(&self, time: &Time<L>) -> Option<Place<L>> {
        match nonzero_axis(&self.normal, time) {
            Some((axis, sign)) => self.place_on_plane(time, axis, sign),
            None => self.place_on_edge(time),
        }
    }

    /// The face has a plane; a component of its normal that is not 0 gives the weights.
    #[inline(never)]
    fn place_on_plane(&self, time: &Time<L>, axis: usize, sign: Ordering) -> Option<Place<L>> {
        let Motion { k, l, m, n, .. } = &self.motion;
        let c = m.cross_component(l, axis);
        let d = k.cross_component(m, axis);
        let b = subtract::<L>(&n[axis], &c);
        let normal = &self.normal[axis];
        let weights = [b, c, d];
        let signs = weights.each_ref().map(|weight| time.sign_of(weight));
        if signs.contains(&sign.reverse()) {
            return None;
        }
        // The weights sum up to 1.
        let is_corner = signs.iter().filter(|sign| sign.is_eq()).count() == 2;
        let mut signs = signs.into_iter();
        let weights = weights.map(|weight| match signs.next() {
            Some(Ordering::Equal) | None => Parameter::Start,
            Some(_) if is_corner => Parameter::End,
            Some(_) => Parameter::Quotient(weight, normal.clone()),
        });
        let flags = Flags::default();
        Some(Place { weights, flags })
    }

    /// The face is a segment or a point, and so its edges: the place at the first corner, else on
    /// the first edge, that the vertex is on.
    #[inline(never)]
    fn place_on_edge(&self, time: &Time<L>) -> Option<Place<L>> {
        let is_zero = |square: Quadratic<L>| time.sign_of(&square).is_eq();
        let [to_b, to_c, to_d] = self.distances();
        let corner = [to_b, to_c, to_d].into_iter().position(is_zero);
        let mut weights;
        if let Some(corner) = corner {
            weights = [Parameter::End, Parameter::Start, Parameter::Start];
            weights.rotate_right(corner);
        } else {
            let edge = self.edges().iter().position(|end| end.is_on_edge(time))?;
            let (n, length) = self.along(edge);
            let rest = subtract::<L>(&length, &n);
            // The edges are from B to C, from C to D and from D to B.
            weights = [
                Parameter::Quotient(rest, length.clone()),
                Parameter::Quotient(n, length),
                Parameter::Start,
            ];
            weights.rotate_right(edge);
        }
        let flags = self.flags_without_area(time);
        Some(Place { weights, flags })
    }

    /// The configuration at a time at which the face has no area.
    fn flags_without_area(&self, time: &Time<L>) -> Flags {
        let Motion { k, l, m, .. } = &self.motion;
        let bd = add::<L>(
            &add::<L>(&l.dot(l), &m.dot(l)),
            &add::<L>(&m.dot(l), &m.dot(m)),
        );
        let sides = [k.dot(k), bd];
        let is_point = sides.iter().all(|square| time.sign_of(square).is_eq());
        let is_always_point = sides.iter().flatten().all(Number::is_zero);
        Flags {
            temporarily_parallel: !is_point && !self.is_degenerate(),
            temporarily_point: is_point && !is_always_point,
        }
    }

    /// `|A - B|^2`, `|A - C|^2` and `|A - D|^2`.
    fn distances(&self) -> [Quadratic<L>; 3] {
        let Motion { k, l, m, .. } = &self.motion;
        let (mm, mk) = (m.dot(m), m.dot(k));
        let to_c = subtract::<L>(&add::<L>(&mm, &k.dot(k)), &add::<L>(&mk, &mk));
        [mm, to_c, l.dot(l)]
    }

    /// `(A - Y) . (Z - Y)` and `|Z - Y|^2` of an edge from `Y` to `Z`.
    fn along(&self, edge: usize) -> (Quadratic<L>, Quadratic<L>) {
        let Motion { k, l, m, .. } = &self.motion;
        let (mk, ml, kl) = (m.dot(k), m.dot(l), k.dot(l));
        // (L + M) . M, and with L itself.
        let (to_m, to_l) = (add::<L>(&m.dot(m), &ml), add::<L>(&ml, &l.dot(l)));
        match edge {
            0 => (mk, k.dot(k)),
            1 => {
                // Z - Y = L + M - K and A - Y = M - K, so that their difference is L.
                let n = subtract::<L>(&to_m, &add::<L>(&mk, &kl));
                let n = add::<L>(&n, &subtract::<L>(&k.dot(k), &mk));
                let length = add::<L>(&n, &subtract::<L>(&to_l, &kl));
                (n, length)
            }
            // A - Y = -L and Z - Y = -(L + M).
            _ => (to_l.clone(), add::<L>(&to_l, &to_m)),
        }
    }

    fn hit(
        &self,
        time: &Time<L>,
        place: &Place<L>,
        kind: ContactKind,
        side: Ordering,
    ) -> Hit<FacePlace> {
        Hit {
            toi: time.below,
            toi_above: time.above,
            kind,
            side: side as i8,
            case: self.case(),
            flags: place.flags,
            place: FacePlace {
                weights: place.weights.each_ref().map(|weight| weight.value(time)),
                error: PLACE_ERROR,
            },
        }
    }
}

impl<L: Width> Place<L> {
    /// Whether the vertex is strictly inside a face that has an area.
    pub(super) fn is_interior(&self) -> bool {
        self.weights.iter().all(Parameter::is_interior)
    }
}
