//! What a subject says when it is asked.

use std::slice;

use tunnelproof::narrow::Unsupported;
use tunnelproof::query::Query;
use tunnelproof::rigid::RigidQuery;

use super::query::{AnyKind, AnyQuery};
use crate::subject::{Answer, Lapse, LapseKind, NoAnswer, Subject};

/// What comes of asking a subject.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Reply {
    Answer(Answer),
    /// It does not take such queries.
    NotAsked,
    /// It takes them and fails.
    Nothing(Lapse),
}

impl Reply {
    pub(super) fn answer(&self) -> Option<Answer> {
        match self {
            Reply::Answer(answer) => Some(*answer),
            Reply::NotAsked | Reply::Nothing(_) => None,
        }
    }
}

pub(super) fn ask(subject: &dyn Subject, query: &AnyQuery) -> Reply {
    let mut replies = ask_all(subject, slice::from_ref(query));
    replies.remove(0)
}

pub(super) fn ask_all(subject: &dyn Subject, queries: &[AnyQuery]) -> Vec<Reply> {
    let answers = answers(subject, queries);
    assert_eq!(
        answers.len(),
        queries.len(),
        "{} answers each query once",
        subject.name()
    );
    let replies = answers.into_iter().zip(queries);
    replies
        .map(|(answer, query)| match answer {
            Ok(answer) => Reply::Answer(answer),
            Err(NoAnswer::Lapse(lapse)) => Reply::Nothing(lapse),
            Err(NoAnswer::Unsupported(reason)) if is_of_sort(reason, query) => Reply::NotAsked,
            Err(NoAnswer::Unsupported(reason)) => {
                Reply::Nothing(Lapse::new(LapseKind::Refused, reason.to_string()))
            }
        })
        .collect()
}

/// The answers to queries of which some may be of bodies that turn.
fn answers(subject: &dyn Subject, queries: &[AnyQuery]) -> Vec<Result<Answer, NoAnswer>> {
    let runs = queries.chunk_by(|a, b| a.turns() == b.turns());
    let answers = runs.flat_map(|run| {
        let linear = run.iter().filter_map(AnyQuery::linear);
        let turning = run.iter().filter_map(AnyQuery::turning);
        match run.first().is_some_and(AnyQuery::turns) {
            false => subject.answers(&linear.copied().collect::<Vec<Query>>()),
            true => subject.turning_answers(&turning.copied().collect::<Vec<RigidQuery>>()),
        }
    });
    answers.collect()
}

/// Whether what a subject says it does not take is what the query is.
fn is_of_sort(refusal: Unsupported, query: &AnyQuery) -> bool {
    match refusal {
        Unsupported::Kind(kind) => query.kind() == AnyKind::Linear(kind),
        Unsupported::Turning(kind) => query.kind() == AnyKind::Turning(kind),
        Unsupported::Radius(radius) => !radius.is_zero() && radius == query.radius(),
        _ => false,
    }
}
