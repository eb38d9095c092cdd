//! A query of any kind, as both the `f64` path and the integers see it.

use crate::query::{Point, Radius};
use crate::rigid::{
    EdgeTurningEdge, RigidMotion, TurningEdgeTurningEdge, TurningVertexTurningFace,
    VertexTurningFace,
};

/// Two sides with so many points; the second one turns.
#[derive(Clone, Copy)]
pub(in crate::certified) struct Turning<'a, const FIRST: usize, const SECOND: usize> {
    pub(in crate::certified) first: First<'a, FIRST>,
    pub(in crate::certified) second: Body<'a, SECOND>,
    pub(in crate::certified) radius: Radius,
}

/// How the first side moves.
#[derive(Clone, Copy)]
pub(in crate::certified) enum First<'a, const N: usize> {
    /// On straight lines.
    Straight {
        start: &'a [Point; N],
        end: &'a [Point; N],
    },
    /// With a body of its own.
    Turning(Body<'a, N>),
}

/// Points of a body, in its frame.
#[derive(Clone, Copy)]
pub(in crate::certified) struct Body<'a, const N: usize> {
    pub(in crate::certified) local: &'a [Point; N],
    pub(in crate::certified) motion: &'a RigidMotion,
}

macro_rules! one_body {
    ($kind:ident, $first:literal, $second:literal) => {
        impl $kind {
            pub(super) fn turning(&self) -> Turning<'_, $first, $second> {
                Turning {
                    first: First::Straight {
                        start: self.start(),
                        end: self.end(),
                    },
                    second: Body {
                        local: self.local(),
                        motion: self.motion(),
                    },
                    radius: self.radius(),
                }
            }
        }
    };
}

macro_rules! two_bodies {
    ($kind:ident, $first:literal, $second:literal) => {
        impl $kind {
            pub(super) fn turning(&self) -> Turning<'_, $first, $second> {
                let [of_first, of_second] = self.motions();
                Turning {
                    first: First::Turning(Body {
                        local: self.first(),
                        motion: of_first,
                    }),
                    second: Body {
                        local: self.second(),
                        motion: of_second,
                    },
                    radius: self.radius(),
                }
            }
        }
    };
}

one_body!(EdgeTurningEdge, 2, 2);
one_body!(VertexTurningFace, 1, 3);
two_bodies!(TurningEdgeTurningEdge, 2, 2);
two_bodies!(TurningVertexTurningFace, 1, 3);
