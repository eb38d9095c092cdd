//! Which values of the thesis' thresholds are best, and what the best are worth.
//!
//! Two things are wanted at once, few crossings that get through and few false hits, and what helps
//! one harms the other. So there is no best setting but a [`Front`] of them: settings of which none
//! is better than another in both. [`search`] finds it by Pareto local search. [`advise`] takes
//! from it the setting of least [`Penalty`], and tells which thresholds matter for it. [`validate`]
//! judges settings on queries that the search has not seen.

mod advise;
mod front;
mod lattice;
mod search;
#[cfg(test)]
mod tests;
mod validate;

pub use advise::{Advice, Influence, Penalty, SLACK, advise};
pub use front::Front;
pub use lattice::{Lattice, Place};
pub use search::{Aim, Cost, Judge, Member, search};
pub use validate::{CANDIDATES, Validated, certified, validate};
