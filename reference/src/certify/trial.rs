//! Certification from a test of one's own.

use std::sync::Arc;

use tunnelproof::narrow::NarrowPhase;
use tunnelproof::query::Query;

use crate::generate::{self, Family};
use crate::subject::{Engine, Subject};

use super::caller::Caller;
use super::defaults;
use super::findings::{Findings, Settings};
use super::judged::Judged;
use super::run::{Panel, RunError};
use super::shard::Shard;
use super::source::{AnyFamily, AnySource, Source};
use super::strict::{exact_failures, failures};
use super::table::{self, Shown};

/// Judges an engine against the exact answer: a thousand queries of seed 1 of every family of edges
/// without radius, or, for an engine that does not take these, of the [families](defaults::families)
/// that it takes, unless something else is asked for.
///
/// ```
/// use tunnelproof::certified::Certified;
///
/// tunnelproof_reference::certify(Certified).count(100).assert_passes();
/// ```
///
/// An engine of one's own implements [`NarrowPhase`], which has an example.
pub fn certify<N: NarrowPhase>(engine: N) -> Trial<N> {
    Trial {
        engine,
        sources: Vec::new(),
        families: None,
        count: 1000,
        seed: 1,
    }
}

/// An engine that is to be judged, and on what.
pub struct Trial<N> {
    engine: N,
    sources: Vec<Source>,
    /// Names; by default what suits the engine.
    families: Option<Vec<String>>,
    count: u64,
    seed: u64,
}

/// What came of a trial.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Outcome {
    /// What the engine fails by within its [tolerance](NarrowPhase::tolerance); empty if it passes.
    /// [`failures`] says what fails.
    pub failures: Vec<String>,
    /// What it would fail by without a tolerance.
    pub exact_failures: Vec<String>,
    /// What was found, as `certify` prints it, with the worst witness of each fault.
    pub text: String,
    /// The same with every family, as `certify --details` prints it.
    pub details: String,
}

fn by_name(name: &str) -> Result<&'static Family, RunError> {
    generate::by_name(name).ok_or_else(|| RunError::Family(name.to_owned()))
}

/// The expression that judges again.
fn command(families: Option<&[String]>, count: u64, seed: u64) -> String {
    let families = families.map_or(String::new(), |names| format!(".families({names:?})"));
    format!("tunnelproof_reference::certify(engine){families}.count({count}).seed({seed})")
}

impl<N: NarrowPhase> Trial<N> {
    /// Judges so many queries of each family.
    pub fn count(mut self, count: u64) -> Self {
        self.count = count;
        self
    }

    /// Judges the queries of this seed.
    pub fn seed(mut self, seed: u64) -> Self {
        self.seed = seed;
        self
    }

    /// Judges the families of these names alone, such as `lattice`, `face_lattice` for vertices and
    /// faces, or `thick_lattice` for radii. `docs/families.md` has all.
    pub fn families<S: AsRef<str>>(mut self, names: impl IntoIterator<Item = S>) -> Self {
        let names = names.into_iter();
        self.families = Some(names.map(|name| name.as_ref().to_owned()).collect());
        self
    }

    /// Judges these queries as well, under this name.
    pub fn queries(mut self, name: &str, queries: impl IntoIterator<Item = Query>) -> Self {
        self.sources.push(Source::Queries {
            name: name.to_owned(),
            queries: queries.into_iter().collect::<Arc<[_]>>(),
        });
        self
    }

    /// Judges the engine.
    ///
    /// # Errors
    ///
    /// [`RunError`] for a name that is no family's, and for the first query that the oracle does not
    /// take.
    pub fn run(self) -> Result<Outcome, RunError> {
        let subject = Engine(self.engine);
        let panel = Panel {
            second_judges: Vec::new(),
            subjects: vec![Judged {
                subject: &subject,
                explain: None,
            }],
        };
        let (seed, count) = (self.seed, self.count);
        let families = match &self.families {
            None => defaults::families(&[&subject]),
            Some(names) => names
                .iter()
                .map(|name| by_name(name).map(AnyFamily::Linear))
                .collect::<Result<_, _>>()?,
        };
        let command = command(self.families.as_deref(), count, seed);
        let families = families.into_iter().map(|family| family.first(seed, count));
        let sources = families.chain(self.sources.into_iter().map(AnySource::from));
        let blocks = sources.map(|source| panel.run(&source, |_| {}));
        let blocks = blocks.collect::<Result<_, _>>()?;
        let settings = Settings {
            command,
            caller: Caller::Test,
            seed,
            count,
            shard: Shard::WHOLE,
        };
        let findings = Findings::new(panel, settings, blocks, Vec::new());
        let none = (findings.total.queries == 0)
            .then(|| format!("{}: no query is judged", subject.name()));
        let failures = failures(&findings.panel, &findings.total);
        let exact = exact_failures(&findings.panel, &findings.total);
        Ok(Outcome {
            failures: failures.into_iter().chain(none.clone()).collect(),
            exact_failures: exact.into_iter().chain(none).collect(),
            text: table::text(&findings, Shown::SUMMARY),
            details: table::text(&findings, Shown::EVERYTHING),
        })
    }

    /// Judges the engine, and panics with all that was found unless it passes.
    ///
    /// # Panics
    ///
    /// If it does not pass.
    #[allow(clippy::panic, reason = "it is an assertion")]
    pub fn assert_passes(self) {
        let outcome = self.run().unwrap_or_else(|error| panic!("{error}"));
        let failures = outcome.failures.join("\n");
        assert!(failures.is_empty(), "{}\n{failures}", outcome.text);
    }
}

#[cfg(test)]
mod tests {
    use tunnelproof::additive::Additive;
    use tunnelproof::certified::{Certified, decide};
    use tunnelproof::narrow::{Report, Tolerance, Unsupported};
    use tunnelproof::query::EdgeEdge;

    use super::*;
    use crate::generate::{Family, by_name};

    fn slow() -> &'static Family {
        by_name("slow").unwrap()
    }

    #[test]
    fn trial_of_an_engine_that_is_right_passes() {
        let trial = certify(Certified).families(["slow"]).count(50).seed(3);
        let queries = (0..7).map(|index| slow().query(9, index));
        let outcome = trial.queries("mine", queries).run().unwrap();
        assert_eq!(outcome.failures, [""; 0]);
        assert!(
            outcome.details.contains("\nmine: 7 queries, "),
            "{}",
            outcome.details
        );
        assert!(
            outcome.text.contains("\n57 queries of 2 sources: "),
            "{}",
            outcome.text
        );
    }

    #[test]
    fn trial_without_a_query_fails() {
        for trial in [
            certify(Certified).families([""; 0]),
            certify(Certified).count(0),
        ] {
            let failures = trial.run().unwrap().failures;
            assert_eq!(failures, ["certified: no query is judged"]);
        }
    }

    #[test]
    fn trial_of_a_family_that_does_not_exist_names_it() {
        let error = certify(Certified).families(["no such"]).run().unwrap_err();
        let text = error.to_string();
        assert!(
            text.starts_with("no family is called no such; there are uniform,"),
            "{text}"
        );
    }

    #[test]
    fn trial_permits_what_an_engine_declares() {
        struct Late(f64);
        impl NarrowPhase for Late {
            fn name(&self) -> &str {
                "thesis"
            }
            fn edge_edge(&self, query: &EdgeEdge) -> Result<Report, Unsupported> {
                let toi = decide(query).map(|hit| (hit.toi + 1e-10).min(1.0));
                Ok(toi.map_or(Report::miss(), Report::hit))
            }
            fn tolerance(&self) -> Tolerance {
                let late = self.0;
                Tolerance { near: 0.0, late }
            }
        }
        let outcome = |late| certify(Late(late)).families(["uniform"]).run().unwrap();
        for late in [0.0, 0.99e-10, f64::NAN] {
            let failures = outcome(late).failures;
            assert!(failures[0].contains("late times of impact"), "{failures:?}");
        }
        let within = outcome(1.01e-10);
        assert_eq!(within.failures, [""; 0]);
        assert_eq!(within.exact_failures, outcome(0.0).failures);
    }

    #[test]
    fn trial_of_an_engine_that_is_wrong_fails() {
        let trial = || certify(Additive::default()).families(["slow"]).count(50);
        let outcome = trial().run().unwrap();
        let [failure] = &outcome.failures[..] else {
            panic!("{:?}", outcome.failures)
        };
        assert!(failure.starts_with("additive: ") && failure.contains(" tunnels"));
        assert!(
            outcome.text.contains("    tunnelproof explain slow:1:"),
            "{}",
            outcome.text
        );
        let panic = std::panic::catch_unwind(|| trial().assert_passes()).unwrap_err();
        assert!(
            panic
                .downcast_ref::<String>()
                .unwrap()
                .contains(failure.as_str())
        );
    }
}
