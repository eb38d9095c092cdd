//! Casts of boxes, and what was found on them, as JSON.

use serde_json::{Map, Value, json};
use tunnelproof::narrow::Tolerance;

use crate::answer::Enclosure;
use crate::boxes::{Body, BoxAnswer, BoxCast, BoxId};
use crate::certify::boxes::{BoxWitness, Judged};
use crate::certify::tally::Fault;
use crate::program::Conduct;

/// A generated cast and its exact answer, as text.
pub fn explain(id: &BoxId, truth: &BoxAnswer) -> String {
    let cast = id.cast();
    let contact = match truth.toi {
        None => "no contact".to_owned(),
        Some(toi) => format!("contact at {toi} of the step"),
    };
    let passing = match truth.overlaps {
        true => "pass",
        false => "do not pass",
    };
    let family = id.family.description();
    let line = query_line(&id.to_string(), &cast);
    format!(
        "{id}: {family}\n\n{line:#}\n\n{contact}; without their radii they {passing} into each other\n"
    )
}

/// A cast as JSON: of each body its shape, points, translation and radius.
fn query_line(id: &str, cast: &BoxCast) -> Value {
    let body = |body: &Body| {
        let points = &body.points()[..body.shape().count()];
        let points: Vec<[f64; 3]> = points.iter().map(|point| (*point).into()).collect();
        json!({
            "shape": body.shape().name(),
            "points": points,
            "step": <[f64; 3]>::from(body.step()),
            "radius": body.radius(),
        })
    };
    let [first, second] = cast.bodies();
    json!({"id": id, "kind": "box-cast", "bodies": [body(first), body(second)]})
}

/// What was found of a program on families, in the form of the results of `certify`.
pub fn report(subject: &str, tolerance: Tolerance, found: &[Judged], conduct: &Conduct) -> Value {
    json!({
        "version": env!("CARGO_PKG_VERSION"),
        "tolerances": [{"subject": subject, "near": tolerance.near, "late": tolerance.late}],
        "sources": found.iter().map(|judged| source(subject, judged)).collect::<Vec<_>>(),
        "programs": [{
            "subject": subject,
            "starts": conduct.starts,
            "surplus": conduct.surplus,
            "stderr": conduct.stderr,
        }],
    })
}

fn source(subject: &str, judged: &Judged) -> Value {
    let faults = Fault::ALL.into_iter().map(|fault| {
        let found = judged.faults.get(&fault);
        let row = json!({
            "count": found.map_or(0, |found| found.count),
            "worst": found.map(|found| witness(&found.worst)),
        });
        (fault.name().to_owned(), row)
    });
    let lapses = judged.lapses.iter();
    let lapses = lapses.map(|(kind, count)| (kind.name().to_owned(), json!(count)));
    json!({
        "name": judged.name,
        "fingerprint": judged.fingerprint,
        "queries": judged.queries,
        "hits": judged.hits,
        "crossings": judged.crossings,
        "subjects": [{
            "subject": subject,
            "refused": [{"kind": "box-cast", "queries": judged.refused()}],
            "lapses": lapses.collect::<Map<_, _>>(),
            "faults": faults.collect::<Map<_, _>>(),
        }],
    })
}

fn witness(witness: &BoxWitness) -> Value {
    let id = witness.id.to_string();
    let said = |toi: Option<Enclosure>| json!({"hit": toi.is_some(), "toi": toi.map(enclosure)});
    json!({
        "severity": witness.severity,
        "query": query_line(&id, &witness.id.cast()),
        "id": id,
        "truth": said(witness.truth.toi),
        "answer": witness.said.map(|answer| json!({
            "hit": answer.toi.is_some(),
            "toi": answer.toi.map(|toi| toi.below),
        })),
        "lapse": witness.lapse.as_ref().map(|lapse| json!({
            "kind": lapse.kind.name(),
            "detail": lapse.detail,
        })),
    })
}

fn enclosure(toi: Enclosure) -> Value {
    json!({"below": toi.below, "above": toi.above})
}
