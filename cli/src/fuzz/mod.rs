//! Fuzz targets: two ways to the same answer, on whatever query some bytes make.
//!
//! A [`Target`] is a function of bytes that finds something or nothing, so that ordinary tests can
//! replay what a fuzzer has found. The programs for libFuzzer are in the folder `fuzz` of the
//! repository; they call these functions and nothing else. How bytes make a query is in [`input`].

use std::fmt;
use std::panic::{AssertUnwindSafe, catch_unwind};

use rand::Rng;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use tunnelproof::query::Query;

use tunnelproof_reference::certify::caller;
use tunnelproof_reference::corpus::Entry;
use tunnelproof_reference::corpus::jsonl::{self, Numbers};
use tunnelproof_reference::generate;
use tunnelproof_reference::registry;
use tunnelproof_reference::report::answer;
use tunnelproof_reference::shrink;

#[cfg(feature = "gmp")]
mod backends;
mod euclid;
pub mod input;
mod judges;
mod parsers;
mod poly;
mod step;
mod turning;

#[cfg(test)]
mod tests;

/// Two ways to the same answer.
#[derive(Debug)]
pub struct Target {
    /// Its name, on the command line and in the folder `fuzz`.
    pub name: &'static str,
    /// What is compared, in one line.
    pub description: &'static str,
    check: Check,
}

/// What bytes stand for, and what is wrong with it, in a line of text; `None` if nothing is.
#[derive(Debug)]
enum Check {
    Query(fn(&Query) -> Option<String>),
    /// Queries of edges without radius.
    Edges(fn(&Query) -> Option<String>),
    Bytes(fn(&[u8]) -> Option<String>),
}

/// Every target that this build has. Without the feature `gmp` there are no two backends to
/// compare.
pub const TARGETS: &[Target] = &[
    Target {
        name: "thesis_vs_shadow",
        description: "the thesis path against its exact shadow, where its thresholds excuse nothing",
        check: Check::Edges(judges::thesis_vs_shadow),
    },
    Target {
        name: "certified_vs_oracle",
        description: "the certified path against the oracle, in all that it promises, normals too",
        check: Check::Query(judges::certified_vs_oracle),
    },
    Target {
        name: "step_vs_oracle",
        description: "the motion to the positions of a certified step against the oracle",
        check: Check::Query(step::check),
    },
    Target {
        name: "oracle_vs_shadow",
        description: "the two exact judges of edges, in every field of the answer",
        check: Check::Edges(judges::oracle_vs_shadow),
    },
    Target {
        name: "oracle_vs_difference",
        description: "the two exact judges of all kinds of queries, in every field of the answer",
        check: Check::Query(judges::oracle_vs_difference),
    },
    Target {
        name: "turning_vs_oracle",
        description: "bodies that turn: the certified path, normals too, and the second judge against the oracle",
        check: Check::Bytes(turning::check),
    },
    #[cfg(feature = "gmp")]
    Target {
        name: "backends",
        description: "both judges on num-bigint against themselves on GMP",
        check: Check::Edges(backends::judges),
    },
    #[cfg(feature = "gmp")]
    Target {
        name: "integers",
        description: "every operation of num-bigint against that of GMP",
        check: Check::Bytes(backends::integers),
    },
    Target {
        name: "poly",
        description: "roots, divisors and signs at roots against Sturm chains and Euclid's algorithm",
        check: Check::Bytes(poly::check),
    },
    Target {
        name: "parsers",
        description: "the readers of queries on any bytes, and what they read written and read again",
        check: Check::Bytes(parsers::check),
    },
];

/// Something that must not be.
#[derive(Clone, Debug, PartialEq)]
pub struct Finding {
    /// The target that found it.
    pub target: &'static str,
    /// What is wrong.
    pub what: String,
    /// The query, for targets that make one of their bytes.
    pub query: Option<Box<Query>>,
}

impl Target {
    /// Runs it on the bytes of a fuzzer.
    ///
    /// # Errors
    ///
    /// [`Finding`] if the two ways differ.
    pub fn run(&self, bytes: &[u8]) -> Result<(), Finding> {
        let query = self.query(bytes).map(Box::new);
        let what = match (&self.check, &query) {
            (Check::Query(check) | Check::Edges(check), Some(query)) => guarded(|| check(query)),
            (Check::Bytes(check), _) => guarded(|| check(bytes)),
            (_, None) => None,
        };
        let finding = |what| Finding {
            target: self.name,
            what,
            query,
        };
        what.map_or(Ok(()), |what| Err(finding(what)))
    }
}

/// What is found; a panic is a finding. Where the fuzzer ends the program at any panic, replaying
/// its bytes comes here.
fn guarded(check: impl FnOnce() -> Option<String>) -> Option<String> {
    catch_unwind(AssertUnwindSafe(check)).unwrap_or_else(|_| Some("panics".to_owned()))
}

/// How many seeds of a corpus each kind of input has, if nothing else is said.
pub const SEEDS: u64 = 12;

impl Target {
    /// Bytes to start fuzzing with, always the same: `count` queries of every family, or that many
    /// times random bytes, or files for the readers.
    pub fn seeds(&self, count: u64) -> Vec<Vec<u8>> {
        match self.check {
            Check::Query(_) | Check::Edges(_) => (0..generate::all().count())
                .flat_map(|family| (0..count).map(move |seed| input::seed(family, &random(seed))))
                .collect(),
            Check::Bytes(_) if self.name == "parsers" => parsers::seeds(),
            Check::Bytes(_) => (0..count).map(random).collect(),
        }
    }

    /// The query that these bytes stand for, for targets that make one of them.
    pub fn query(&self, bytes: &[u8]) -> Option<Query> {
        match self.check {
            Check::Query(_) => Some(input::query(bytes)),
            Check::Edges(_) => Some(input::edges(bytes)),
            Check::Bytes(_) => None,
        }
    }
}

/// Enough random bytes for a query.
fn random(seed: u64) -> Vec<u8> {
    let mut bytes = vec![0; 1024];
    ChaCha8Rng::seed_from_u64(seed).fill_bytes(&mut bytes);
    bytes
}

/// The target of this name, if this build has it.
pub fn by_name(name: &str) -> Option<&'static Target> {
    TARGETS.iter().find(|target| target.name == name)
}

impl Finding {
    /// The query shrunk as long as the target finds the same, in words and with its command.
    fn shrunk(&self, query: &Query) -> Option<String> {
        let (Check::Query(check) | Check::Edges(check)) = by_name(self.target)?.check else {
            return None;
        };
        let is_same = |query: &Query| guarded(|| check(query)).as_ref() == Some(&self.what);
        Some(shrink::failure(query, is_same))
    }
}

impl fmt::Display for Finding {
    /// What is wrong and, of a query, the line, the verdicts, the smallest query that shows the
    /// same and the commands that explain both.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{}: {}", self.target, self.what)?;
        let Some(query) = &self.query else {
            return Ok(());
        };
        let entry = Entry::unlabelled(self.target, **query);
        writeln!(f, "{}", jsonl::write(&entry, Numbers::Decimal))?;
        for subject in registry::subjects() {
            let name = subject.name();
            match catch_unwind(AssertUnwindSafe(|| subject.answer(query))) {
                Ok(Ok(answer)) => writeln!(f, "  {}", answer::line(name, query.kind(), &answer))?,
                Ok(Err(reason)) => writeln!(f, "  {name}: {reason}")?,
                Err(_) => writeln!(f, "  {name} panics")?,
            }
        }
        writeln!(
            f,
            "{}",
            caller::explain_line(&entry.id, &entry.query.into())
        )?;
        if let Some(shrunk) = self.shrunk(query) {
            writeln!(f, "shrunk, {shrunk}")?;
        }
        Ok(())
    }
}

impl std::error::Error for Finding {}
