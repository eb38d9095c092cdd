//! The shadow: the thesis' Algorithms 1 to 20 in exact arithmetic, every threshold 0.
//!
//! Each algorithm is a function of its own name, as in `tunnelproof::thesis`, file for file:
//!
//! | algorithms | section | module |
//! | --- | --- | --- |
//! | 1 to 7: which case | 3.1.1 | `detect` |
//! | 8 to 14: parallel for the whole step | 3.1.2 | `parallel` |
//! | 15 to 18: coplanar for the whole step | 3.1.3 | `planar` |
//! | 19, 20: general, and all together | 3.1.4 | `general` |
//!
//! What the algorithms call without stating it is in `given` and `solve`. Which case a motion is,
//! Algorithms 1 to 8, is decided over the integers. Roots are real algebraic numbers, and what is
//! computed at a root `t_k` is computed in the field `Q(t_k)`, in `element`. The static algorithms
//! 9, 15 and 16 are written for any ordered field.
//!
//! Where the contact is and whether it is a crossing is not in the thesis: `polynomials`,
//! `configuration` and `kind` say that, by the definitions in [`answer`](crate::answer).

use tunnelproof::contact::ContactKind;
use tunnelproof::narrow::Unsupported;
use tunnelproof::query::{EdgeEdge, Query};
use tunnelproof::thesis::Repairs;

use crate::algebraic::Algebraic;
use crate::answer::{ExactAnswer, ExactHit};
use crate::field::{self, Integer};
use crate::scaled::Scaled;
use crate::subject::{Answer, NoAnswer, Subject};

mod configuration;
mod detect;
mod element;
mod general;
mod given;
mod kind;
mod motion;
mod parallel;
mod planar;
mod polynomials;
mod solve;
mod vector;

#[cfg(test)]
mod tests;

use configuration::Configuration;
use general::handle_general_case;
use kind::{Crossings, signs_around_root};
use motion::Motion;
use polynomials::Polynomials;

/// The thesis' algorithms in exact arithmetic as a subject: edge-edge with radius 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shadow {
    repairs: Repairs,
}

impl Shadow {
    /// With every erratum repaired: right on every query.
    pub const REPAIRED: Shadow = Shadow::new(Repairs::ALL);
    /// The text to the letter.
    pub const PUBLISHED: Shadow = Shadow::new(Repairs::NONE);

    /// With these errata repaired.
    pub const fn new(repairs: Repairs) -> Self {
        Shadow { repairs }
    }

    /// The answer to a query.
    ///
    /// # Errors
    ///
    /// [`Unsupported`] for any other than edge-edge queries of radius 0.
    pub fn decide(&self, query: &Query) -> Result<ExactAnswer, Unsupported> {
        let Query::EdgeEdge(query) = query else {
            return Err(Unsupported::Kind(query.kind()));
        };
        if !query.radius().is_zero() {
            return Err(Unsupported::Radius(query.radius()));
        }
        Ok(edge_edge::<field::Default>(query, self.repairs))
    }
}

impl Subject for Shadow {
    fn name(&self) -> &str {
        match self.repairs {
            Repairs::ALL => "shadow",
            Repairs::NONE => "shadow-published",
            Repairs::SLIPS => "shadow-as-meant",
            _ => "shadow-partly-repaired",
        }
    }

    fn answer(&self, query: &Query) -> Result<Answer, NoAnswer> {
        Ok(Answer::Exact(self.decide(query)?))
    }
}

/// The answer of Algorithms 1 to 20, in the arithmetic of the backend `Z`, to whether the midlines
/// of two edges touch; the radius of the query is not looked at.
pub fn edge_edge<Z: Integer>(query: &EdgeEdge, repairs: Repairs) -> ExactAnswer {
    let points = Motion::of_scaled(&Scaled::<Z>::new(&Query::EdgeEdge(*query)));
    let (case, toi) = handle_general_case(&points, repairs);
    ExactAnswer {
        case,
        hit: toi.map(|toi| describe(&points, &toi)),
    }
}

/// What is to be said of the first contact.
fn describe<Z: Integer>(points: &[Motion<Z>; 4], toi: &Algebraic<Z>) -> ExactHit {
    let pair = Polynomials::new(points);
    let edges = Configuration::new(&pair, toi);
    let (first, second) = edges.contact();
    let crossings = Crossings::new(points, &pair);
    let is_crossing = crossings.is_crossing(toi);
    let toi_enclosure = toi.enclosure();
    let side = if toi_enclosure.above == 0.0 {
        0
    } else {
        signs_around_root(&pair.f, toi).0 as i8
    };
    ExactHit {
        toi: toi_enclosure,
        kind: if is_crossing {
            ContactKind::Crossing
        } else {
            ContactKind::Graze
        },
        crosses: is_crossing || crossings.any(),
        side,
        features: first.features_of_edges(),
        first,
        second,
        flags: edges.flags(),
    }
}
