//! Queries as numbers that steps change.

use std::hash::Hash;

use tunnelproof::query::Query;

use super::{Complexity, steps};
use crate::certify::query::AnyQuery;
use crate::shape::Shape;

/// A query that can be shrunk.
pub trait Shrinkable: Copy + Into<AnyQuery> {
    /// Its numbers.
    type Form: Form<Query = Self>;

    /// Its numbers.
    fn form(&self) -> Self::Form;
}

/// The numbers of a query, compared bit for bit.
pub trait Form: Copy + Eq + Hash + 'static {
    /// What it is the form of.
    type Query;

    /// Every step, in the order in which they are taken.
    const STEPS: &'static [Step<Self>];

    /// How complex the query is.
    fn complexity(&self) -> Complexity;

    /// The query, if the numbers are those of one.
    fn query(&self) -> Option<Self::Query>;
}

/// Proposes queries in place of one.
pub type Step<F> = fn(&F) -> Box<dyn Iterator<Item = F>>;

impl Shrinkable for Query {
    type Form = Shape;

    fn form(&self) -> Shape {
        Shape::new(self)
    }
}

impl Form for Shape {
    type Query = Query;

    const STEPS: &'static [Step<Shape>] = steps::STEPS;

    fn complexity(&self) -> Complexity {
        Complexity::new(self)
    }

    fn query(&self) -> Option<Query> {
        Shape::query(self)
    }
}
