//! From a query that shows something to the smallest one that still shows it.
//!
//! [`shrink()`] knows nothing of what is shown: a predicate says whether a query is still
//! interesting. It is greedy. Each step (`steps`) proposes queries, the first one that is simpler
//! by [`Complexity`] and still interesting takes the place of the query, and so on until no step
//! gets any further. [`Disagreement`] is the predicate for a subject that is wrong.

use std::collections::HashSet;
use std::fmt;

use tunnelproof::query::Query;

use crate::certify::caller;
use crate::certify::query::AnyQuery;
use crate::corpus::jsonl::Numbers;

mod complexity;
mod disagreement;
mod form;
mod steps;
mod turning;

#[cfg(test)]
mod tests;

pub use complexity::Complexity;
pub use disagreement::{Disagreement, Truth};
pub use form::{Form, Shrinkable, Step};
pub use turning::TurningForm;

/// How often the predicate is asked where nothing else is said. Some thousand times are enough for
/// most queries; the truth takes some ten microseconds each.
pub const MOST_CALLS: u64 = 20_000;

/// What [`shrink()`] found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shrunk<Q = Query> {
    /// The simplest query found; the one that was given, if there is none simpler.
    pub query: Q,
    /// How complex the given query is.
    pub before: Complexity,
    /// How complex the query found is: less than `before`, or the same for the same query.
    pub after: Complexity,
    /// How often the predicate was asked.
    pub calls: u64,
    /// Whether no step gets any further; `false` if the calls were used up before that is known.
    pub is_minimal: bool,
}

/// The smallest query that steps lead to from `query`, all of them interesting.
///
/// `query` itself is taken to be interesting. A result that is minimal is returned as it is if it
/// is shrunk again. The result depends on nothing but the query, the limit and the predicate, which
/// has to be the same for equal queries; it is asked at most `most_calls` times.
pub fn shrink<Q: Shrinkable>(
    query: &Q,
    most_calls: u64,
    mut is_interesting: impl FnMut(&Q) -> bool,
) -> Shrunk<Q> {
    let start = query.form();
    let before = start.complexity();
    let mut search = Search {
        best: start,
        complexity: before,
        refused: HashSet::new(),
        calls: 0,
        most_calls,
    };
    let is_minimal = search.run(&mut is_interesting);
    Shrunk {
        query: search.best.query().unwrap_or(*query),
        before,
        after: search.complexity,
        calls: search.calls,
        is_minimal,
    }
}

/// The calls are used up.
struct UsedUp;

struct Search<F> {
    best: F,
    complexity: Complexity,
    /// What the predicate has refused.
    refused: HashSet<F>,
    calls: u64,
    most_calls: u64,
}

impl<F: Form> Search<F> {
    /// Whether it ends because no step gets any further.
    fn run(&mut self, is_interesting: &mut dyn FnMut(&F::Query) -> bool) -> bool {
        loop {
            let round = self.complexity;
            for step in F::STEPS {
                if self.exhaust(*step, is_interesting).is_err() {
                    return false;
                }
            }
            if self.complexity == round {
                return true;
            }
        }
    }

    /// Takes one step as long as it gets further.
    fn exhaust(
        &mut self,
        step: Step<F>,
        is_interesting: &mut dyn FnMut(&F::Query) -> bool,
    ) -> Result<(), UsedUp> {
        loop {
            let mut has_improved = false;
            for form in step(&self.best) {
                if self.accepts(form, is_interesting)? {
                    has_improved = true;
                    break;
                }
            }
            if !has_improved {
                return Ok(());
            }
        }
    }

    fn accepts(
        &mut self,
        form: F,
        is_interesting: &mut dyn FnMut(&F::Query) -> bool,
    ) -> Result<bool, UsedUp> {
        let complexity = form.complexity();
        if complexity >= self.complexity || self.refused.contains(&form) {
            return Ok(false);
        }
        let Some(query) = form.query() else {
            return Ok(false);
        };
        if self.calls == self.most_calls {
            return Err(UsedUp);
        }
        self.calls += 1;
        if is_interesting(&query) {
            (self.best, self.complexity) = (form, complexity);
            return Ok(true);
        }
        self.refused.insert(form);
        Ok(false)
    }
}

impl<Q: Copy + Into<AnyQuery>> Shrunk<Q> {
    /// The query as a line of JSON that every command reads.
    pub fn line(&self, id: &str) -> String {
        self.query.into().line(id, Numbers::Decimal)
    }

    /// The command that explains the query, ready to paste into a shell.
    pub fn command(&self, id: &str) -> String {
        caller::explain_line(id, &self.query.into())
    }
}

impl<Q> fmt::Display for Shrunk<Q> {
    /// Sizes and calls, in a few words.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (before, after) = (self.before.bits(), self.after.bits());
        write!(
            f,
            "{before} bits before, {after} after, {} calls",
            self.calls
        )?;
        if !self.is_minimal {
            f.write_str(", not yet the smallest")?;
        }
        Ok(())
    }
}

/// For a test that fails on a query: the shrunk query and the command that explains it, to be put
/// into the message of the failure. `is_failure` is asked a few thousand times.
pub fn failure(query: &Query, is_failure: impl Fn(&Query) -> bool) -> String {
    let shrunk = shrink(query, MOST_CALLS, |query| is_failure(query));
    let (line, command) = (shrunk.line("shrunk"), shrunk.command("shrunk"));
    format!("{shrunk}\n{line}\n{command}")
}
