//! Boxes that are cast along lines: whether and when one touches another convex body.
//!
//! Such a cast is no [query](tunnelproof::query) of the engine but many, of which the earliest counts.
//! It is decided by [pairs of features](decide_pairs), each by the oracle. Two other ways share
//! nothing with that: the [times at which no plane separates the bodies](span), and the
//! [nearest point of their difference](least_square). Boxes are here to judge the casts of
//! physics engines ([`certify::boxes`](crate::certify::boxes), `peers/`), as the families `cast_...` of other bodies are.

mod body;
mod decide;
mod draws;
mod families;
mod nearest;
mod pairs;
mod spans;
#[cfg(test)]
mod tests;

pub use body::{Body, BodyError, BoxCast, Shape};
pub use decide::{BoxAnswer, decide};
pub use families::{BOX_FAMILIES, BoxFamily, BoxId, box_family};
pub use nearest::{comes_within, least_square};
pub use pairs::{decide_pairs, pairs};
pub use spans::{Span, span};
