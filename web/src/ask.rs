//! One question and its answer.

use std::io::Cursor;

use serde::Deserialize;
use serde_json::{Value, json};
use tunnelproof::additive::Additive;
use tunnelproof::query::Query;
use tunnelproof::thesis::{Options, Thesis, Threshold, Thresholds};
use tunnelproof_reference::certify::judged::Judged;
use tunnelproof_reference::corpus::{self, CorpusError, Entry, Format, ReadOptions};
use tunnelproof_reference::oracle::Oracle;
use tunnelproof_reference::report;
use tunnelproof_reference::report::explanation::Explanation;
use tunnelproof_reference::subject::{Certified, Engine, Subject};

use crate::search::{Found, Search, Shrink};

/// What is asked. Queries are objects as lines of a corpus have them.
#[derive(Deserialize)]
#[serde(tag = "ask", rename_all = "kebab-case", deny_unknown_fields)]
enum Question {
    /// Everything about a query.
    Explain { query: Value, thresholds: [f64; 5] },
    /// The line that `eval --subject certified` writes about a query.
    Certified { query: Value },
    /// A query of a family on which the thesis' method fails.
    Search {
        search: Search,
        thresholds: [f64; 5],
    },
    /// A smaller query on which it fails in the same way.
    Shrink {
        shrink: Shrink,
        thresholds: [f64; 5],
    },
}

/// Why there is no answer.
#[derive(Debug, thiserror::Error)]
pub enum AskError {
    /// The question is not one.
    #[error("the question cannot be read: {0}")]
    Question(#[from] serde_json::Error),
    /// The query is refused.
    #[error("{0}")]
    Query(#[from] CorpusError),
    /// There is no query.
    #[error("there is no query")]
    NoQuery,
    /// A threshold means nothing.
    #[error("the threshold {name} is {value}; it has to be a finite number from 0")]
    Threshold {
        /// The name of the threshold.
        name: &'static str,
        /// Its value.
        value: f64,
    },
    /// A search among families that there are not.
    #[error("there is no family {0} of edges without a radius")]
    Family(String),
    /// A search for something that no method does.
    #[error("there is no fault {0}")]
    Fault(String),
}

/// The answer to a question, both JSON: `{"ok": ...}`, or `{"error": "..."}` in words.
pub fn answer(question: &str) -> String {
    match ask(question) {
        Ok(value) => json!({ "ok": value }).to_string(),
        Err(error) => json!({ "error": error.to_string() }).to_string(),
    }
}

fn ask(question: &str) -> Result<Value, AskError> {
    match serde_json::from_str(question)? {
        Question::Explain { query, thresholds } => explain(&query, thresholds),
        Question::Certified { query } => certified(&query),
        Question::Search { search, thresholds } => written(search.run(&thesis(thresholds)?)?),
        Question::Shrink { shrink, thresholds } => written(shrink.run(&thesis(thresholds)?)?),
    }
}

fn explain(query: &Value, thresholds: [f64; 5]) -> Result<Value, AskError> {
    let Entry { query, .. } = entry(query)?;
    let (thesis, additive) = (thesis(thresholds)?, Engine(Additive::default()));
    let subjects: [&dyn Subject; 4] = [&Certified, &Oracle, &thesis, &additive];
    let judged = subjects.map(|subject| Judged {
        subject,
        explain: None,
    });
    Ok(serde_json::to_value(Explanation::new(&query, &judged))?)
}

fn certified(query: &Value) -> Result<Value, AskError> {
    let Entry { id, query, .. } = entry(query)?;
    let line = match Certified.answer(&query) {
        Ok(answer) => report::answer::line(&id, query.kind(), &answer),
        Err(reason) => json!({ "id": id, "error": reason.to_string() }).to_string(),
    };
    Ok(Value::String(line))
}

fn written(found: Option<Found>) -> Result<Value, AskError> {
    Ok(serde_json::to_value(found)?)
}

/// The method of the thesis with these thresholds, in the order of table 3.1.
pub(crate) fn thesis(thresholds: [f64; 5]) -> Result<Engine<Thesis>, AskError> {
    for (threshold, value) in Threshold::ALL.into_iter().zip(thresholds) {
        if !(value.is_finite() && value >= 0.0) {
            let name = threshold.name();
            return Err(AskError::Threshold { name, value });
        }
    }
    Ok(Engine(Thesis {
        options: Options {
            thresholds: Thresholds::named(thresholds),
            ..Options::default()
        },
    }))
}

/// The entry that this object is, read as a line of a corpus is.
pub(crate) fn entry(query: &Value) -> Result<Entry, AskError> {
    let text = Cursor::new(query.to_string());
    let mut entries = corpus::read(text, "query", Some(Format::Jsonl), ReadOptions::default())?;
    Ok(entries.next().ok_or(AskError::NoQuery)??)
}

/// A query as such an object.
pub(crate) fn object(id: &str, query: &Query) -> Result<Value, AskError> {
    let entry = Entry::unlabelled(id, *query);
    let line = corpus::jsonl::write(&entry, corpus::jsonl::Numbers::Decimal);
    Ok(serde_json::from_str(&line)?)
}

#[cfg(test)]
mod tests {
    use super::*;

    const CROSSING: &str = r#"{"kind": "edge-edge", "points": [[-1, 0, 0], [1, 0, 0], [0, -1, 1], [0, 1, 1],
        [-1, 0, 0], [1, 0, 0], [0, -1, -2], [0, 1, -2]]}"#;

    const PUBLISHED: &str = "[1e-6, 1e-6, 1e-9, 2.220446049250313e-14, 2.220446049250313e-14]";

    fn ok(question: &str) -> Value {
        let answer: Value = serde_json::from_str(&answer(question)).expect("an answer is JSON");
        assert_eq!(answer["error"], Value::Null, "{question}");
        answer["ok"].clone()
    }

    #[test]
    fn explain_says_everything_of_a_crossing() {
        let question =
            format!(r#"{{"ask": "explain", "query": {CROSSING}, "thresholds": {PUBLISHED}}}"#);
        let said = ok(&question);
        assert_eq!(said["impact"]["fraction"], "1/3");
        assert_eq!(said["impact"]["kind"], "crossing");
        assert_eq!(said["case"]["name"], "general");
        let names: Vec<_> = (said["subjects"].as_array().into_iter().flatten())
            .map(|subject| subject["name"].as_str().unwrap_or_default())
            .collect();
        assert_eq!(names, ["certified", "oracle", "thesis", "additive"]);
    }

    #[test]
    fn thresholds_reach_the_method_of_the_thesis() {
        let question = format!(
            r#"{{"ask": "explain", "query": {CROSSING}, "thresholds": [0, 0, 0, 1e9, 1e9]}}"#
        );
        let thesis = ok(&question)["subjects"][2].clone();
        assert_ne!(thesis["case"], "general", "{thesis}");
    }

    #[test]
    fn search_finds_a_tunnel_and_shrinks_it() {
        let families = r#"["near_coplanar", "lattice"]"#;
        let search = format!(
            r#"{{"ask": "search", "thresholds": {PUBLISHED}, "search": {{"families": {families}, "seed": 1, "start": 0, "count": 20000, "fault": "tunnel"}}}}"#
        );
        let found = ok(&search);
        assert_eq!(found["fault"], "tunnel", "{found}");
        let query = &found["query"];
        let shrink = format!(
            r#"{{"ask": "shrink", "thresholds": {PUBLISHED}, "shrink": {{"query": {query}, "fault": "tunnel", "calls": 2000}}}}"#
        );
        let shrunk = ok(&shrink);
        assert!(shrunk["bits"].as_u64() < found["bits"].as_u64(), "{shrunk}");
        let question = format!(
            r#"{{"ask": "explain", "query": {}, "thresholds": {PUBLISHED}}}"#,
            shrunk["query"]
        );
        assert_eq!(ok(&question)["subjects"][2]["faults"][0], "tunnel");
    }

    #[test]
    fn nonsense_is_refused_in_words() {
        for (question, words) in [
            ("", "cannot be read"),
            (r#"{"ask": "nothing"}"#, "cannot be read"),
            (r#"{"ask": "certified", "query": {}}"#, "points"),
            (
                r#"{"ask": "explain", "query": 1, "thresholds": [0, 0, 0, 0, 0]}"#,
                "object",
            ),
        ] {
            let answer = answer(question);
            assert!(
                answer.starts_with(r#"{"error":"#) && answer.contains(words),
                "{answer}"
            );
        }
        let question =
            format!(r#"{{"ask": "explain", "query": {CROSSING}, "thresholds": [0, -1, 0, 0, 0]}}"#);
        assert!(answer(&question).contains("dist_1d"));
    }

    #[test]
    fn zeros_keep_their_sign() {
        let entry = entry(&json!({ "kind": "edge-edge", "points": vec![[-0.0; 3]; 8] }));
        let query = entry.expect("a query").query;
        let text = object("q", &query).expect("an object").to_string();
        assert!(text.contains("-0.0,-0.0,-0.0"), "{text}");
    }
}
