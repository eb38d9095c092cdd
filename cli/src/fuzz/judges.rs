//! Subjects against judges.

use tunnelproof::certified::{Normal, decide};
use tunnelproof::narrow::Unsupported;
use tunnelproof::query::Query;
use tunnelproof::thesis::{Erratum, Repairs, Thesis};

use tunnelproof_reference::certify::margin::excuses;
use tunnelproof_reference::certify::query::AnyQuery;
use tunnelproof_reference::difference::Difference;
use tunnelproof_reference::normal::ExactNormal;
use tunnelproof_reference::registry::SECOND_JUDGE;
use tunnelproof_reference::shadow::Shadow;
use tunnelproof_reference::shrink::Disagreement;
use tunnelproof_reference::subject::{Certified, Engine, Subject};

/// The thesis path as it is by default, in exact arithmetic. With a threshold of 0 the published
/// comparison of Algorithm 12 would pass over no equation; with that of the thesis it passes over
/// those that are 0, which is what its repair does.
pub(super) const EXACT_THESIS: Shadow = Shadow::new(Repairs::SLIPS.with(Erratum::StrictSkip));

/// The fault by name.
fn fault(disagreement: &Disagreement, query: &Query) -> Option<String> {
    // A query that the truth does not take shows nothing.
    let fault = disagreement.fault(query).ok().flatten()?;
    Some(fault.name().to_owned())
}

pub(super) fn oracle_vs_shadow(query: &Query) -> Option<String> {
    let disagreement = Disagreement::with_oracle(&SECOND_JUDGE);
    fault(&disagreement, query)
}

pub(super) fn oracle_vs_difference(query: &Query) -> Option<String> {
    let disagreement = Disagreement::with_oracle(&Difference);
    fault(&disagreement, query)
}

/// With a radius only where the numbers are within a factor of `2^200` of each other: beyond, the
/// certified path has nothing but long integers, and takes seconds.
pub(super) fn certified_vs_oracle(query: &Query) -> Option<String> {
    if !query.radius().is_zero() && !is_ordinary(query) {
        return None;
    }
    let disagreement = Disagreement::with_oracle(&Certified);
    fault(&disagreement, query).or_else(|| normal_fault(query))
}

/// What is wrong with the certified path's normal of a hit.
fn normal_fault(query: &Query) -> Option<String> {
    let found = match query {
        Query::EdgeEdge(query) => decide(query)?.normal(query),
        Query::VertexFace(query) => decide(query)?.normal(query),
    };
    wrong_normal(ExactNormal::of(query), found)
}

/// What is wrong with the normal of a hit.
pub(super) fn wrong_normal(exact: Option<ExactNormal>, found: Option<Normal>) -> Option<String> {
    match exact {
        Some(exact) => exact.judge(found.as_ref()).err(),
        None => Some("a hit where the oracle has none".to_owned()),
    }
}

/// Whether the coordinates and radii other than 0 are within a factor of `2^200` of each other.
pub(super) fn is_ordinary(query: &Query) -> bool {
    let points = query.start().iter().chain(query.end());
    let coordinates = points.flat_map(|point| point.iter().copied());
    let numbers = coordinates.chain(query.radius().parts());
    let sizes: Vec<f64> = numbers.map(f64::abs).filter(|&size| size > 0.0).collect();
    let least = sizes.iter().copied().fold(f64::INFINITY, f64::min);
    sizes.iter().all(|size| size / least <= 2f64.powi(200))
}

pub(super) fn thesis_vs_shadow(query: &Query) -> Option<String> {
    engine_vs_shadow(&Engine(Thesis::default()), query)
}

/// The thesis path, or one with a planted fault.
pub(super) fn engine_vs_shadow(subject: &dyn Subject, query: &Query) -> Option<String> {
    let disagreement = Disagreement {
        subject,
        truth: |query| match query {
            AnyQuery::Linear(query) => EXACT_THESIS.decide(query),
            AnyQuery::Turning(query) => Err(Unsupported::Turning(query.kind())),
        },
    };
    let fault = fault(&disagreement, query)?;
    (!excuses(query)).then_some(fault)
}
