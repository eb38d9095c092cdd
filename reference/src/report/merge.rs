//! Results read from files, and parts of one certification put together.

use tunnelproof::narrow::{Tolerance, Unsupported};
use tunnelproof::query::Query;

use crate::certify::block::{Agreement, Block};
use crate::certify::findings::{Findings, Settings};
use crate::certify::judged::Judged;
use crate::certify::named::Named;
use crate::certify::query::{AnyKind, AnyQuery};
use crate::certify::run::Panel;
use crate::certify::shard::Shard;
use crate::certify::tally::{Explained, Fault, Finding, Sort, Statement, Tally, Witness};
use crate::program::Conduct;
use crate::subject::{Answer, Lapse, LapseKind, NoAnswer, Subject};

use super::results::{
    AgreementRow, FindingRow, LapseRow, Results, SortRow, SourceRow, SubjectRow, WitnessRow,
};

/// Results that were read, or put together of several.
pub struct Kept {
    subjects: Vec<Absent>,
    second_judges: Vec<Absent>,
    settings: Settings,
    blocks: Vec<Block>,
    programs: Vec<(String, Conduct)>,
}

/// A subject of which only results are left: it answers nothing.
struct Absent {
    name: String,
    tolerance: Tolerance,
}

/// Results that cannot be read, or are not of one certification.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum MergeError {
    /// It is not JSON of this form.
    #[error("not a result of this version of certify: {0}")]
    Json(#[from] serde_json::Error),
    /// A value in it has no meaning.
    #[error("{what} is {value:?}")]
    Value {
        /// Which value.
        what: &'static str,
        /// What it is.
        value: String,
    },
    /// Its query cannot be read.
    #[error("the query of witness {id}: {problem}")]
    Witness {
        /// The identifier of the witness.
        id: String,
        /// What is wrong with its query.
        problem: String,
    },
    /// It is not of the same certification as the first.
    #[error("is of another {0} than the first")]
    Other(&'static str),
    /// It is the same part as one before.
    #[error("shard {0} is there twice")]
    Twice(Shard),
    /// There is no result of a part.
    #[error("shard {0} is missing")]
    Missing(String),
}

impl Results {
    /// Reads a result.
    ///
    /// # Errors
    ///
    /// [`MergeError`] unless it is one that this version writes.
    pub fn read(text: &str) -> Result<Self, MergeError> {
        let results: Results = serde_json::from_str(text)?;
        match results.version == env!("CARGO_PKG_VERSION") {
            true => Ok(results),
            false => Err(MergeError::Value {
                what: "version",
                value: results.version,
            }),
        }
    }
}

impl Kept {
    /// What is written in a result.
    ///
    /// # Errors
    ///
    /// [`MergeError`] if a value in it has no meaning.
    pub fn new(results: &Results) -> Result<Self, MergeError> {
        let declared = || results.tolerances.iter().map(|row| &row.subject);
        for source in &results.sources {
            let names = || source.subjects.iter().map(|row| &row.subject);
            if names().ne(declared()) {
                let names: Vec<_> = names().map(String::as_str).collect();
                return Err(MergeError::Value {
                    what: "the list of subjects, which is not that of tolerances,",
                    value: names.join(", "),
                });
            }
        }
        let judges = results.second_judges.iter();
        let programs = results.programs.iter().map(|row| {
            let conduct = Conduct {
                starts: row.starts,
                surplus: row.surplus,
                stderr: row.stderr.clone(),
            };
            (row.subject.clone(), conduct)
        });
        Ok(Kept {
            subjects: (results.tolerances.iter())
                .map(|row| Absent {
                    name: row.subject.clone(),
                    tolerance: Tolerance {
                        near: row.near,
                        late: row.late,
                    },
                })
                .collect(),
            second_judges: judges
                .map(|name| Absent {
                    name: name.clone(),
                    tolerance: Tolerance::NONE,
                })
                .collect(),
            settings: Settings {
                command: results.command.clone(),
                caller: results.caller.clone(),
                seed: results.seed,
                count: results.count,
                shard: word("shard", &results.shard, |text| text.parse().ok())?,
            },
            blocks: (results.sources.iter())
                .map(|source| block(source, &results.second_judges))
                .collect::<Result<_, _>>()?,
            programs: programs.collect(),
        })
    }

    /// Adds another part of the same certification.
    ///
    /// # Errors
    ///
    /// [`MergeError::Other`] if it is of another one.
    pub fn join(&mut self, other: Kept) -> Result<(), MergeError> {
        let names = |absent: &[Absent]| absent.iter().map(|a| a.name.clone()).collect::<Vec<_>>();
        let tolerances = |absent: &[Absent]| absent.iter().map(|a| a.tolerance).collect::<Vec<_>>();
        let sources = |kept: &Kept| {
            kept.blocks
                .iter()
                .map(|b| b.name.clone())
                .collect::<Vec<_>>()
        };
        for (what, is_same) in [
            (
                "number of shards",
                self.settings.shard.of() == other.settings.shard.of(),
            ),
            // Before the command, which may tell it too.
            (
                "tolerance",
                names(&self.subjects) != names(&other.subjects)
                    || tolerances(&self.subjects) == tolerances(&other.subjects),
            ),
            (
                "command",
                self.settings.are_of_same_certification(&other.settings),
            ),
            (
                "list of subjects",
                names(&self.subjects) == names(&other.subjects),
            ),
            (
                "list of judges",
                names(&self.second_judges) == names(&other.second_judges),
            ),
            ("list of sources", sources(self) == sources(&other)),
        ] {
            if !is_same {
                return Err(MergeError::Other(what));
            }
        }
        for (block, other) in self.blocks.iter_mut().zip(other.blocks) {
            block.join(other);
        }
        for (name, later) in other.programs {
            match self.programs.iter_mut().find(|(own, _)| *own == name) {
                Some((_, conduct)) => conduct.add(later),
                None => self.programs.push((name, later)),
            }
        }
        Ok(())
    }

    /// What was found on each source, of those judged so far, in their order.
    pub fn blocks(&self) -> &[Block] {
        &self.blocks
    }

    /// The same as found by these settings, such as of a program that was started otherwise.
    pub fn with_settings(self, settings: Settings) -> Self {
        Kept { settings, ..self }
    }

    /// What was judged.
    pub fn settings(&self) -> &Settings {
        &self.settings
    }

    /// What was found.
    pub fn findings(&self) -> Findings<'_> {
        let panel = Panel {
            second_judges: self
                .second_judges
                .iter()
                .map(|judge| judge as &dyn Subject)
                .collect(),
            subjects: (self.subjects.iter())
                .map(|subject| Judged {
                    subject,
                    explain: None,
                })
                .collect(),
        };
        let (settings, programs) = (self.settings.clone(), self.programs.clone());
        Findings::new(panel, settings, self.blocks.clone(), programs)
    }
}

/// All parts of one certification, each with what it is called, put together.
///
/// # Errors
///
/// What is called so, and [`MergeError`], if one is of another certification, twice there, or
/// missing.
pub fn merge<'a>(
    parts: impl IntoIterator<Item = (&'a str, Kept)>,
) -> Result<Kept, (&'a str, MergeError)> {
    let mut merged: Option<Kept> = None;
    let mut seen = Vec::new();
    let mut last = "";
    for (name, part) in parts {
        let shard = part.settings.shard;
        if seen.contains(&shard.index()) {
            return Err((name, MergeError::Twice(shard)));
        }
        seen.push(shard.index());
        match &mut merged {
            None => merged = Some(part),
            Some(merged) => merged.join(part).map_err(|error| (name, error))?,
        }
        last = name;
    }
    let missing = |shard: String| (last, MergeError::Missing(shard));
    let mut merged = merged.ok_or_else(|| missing("1/1".to_owned()))?;
    let of = merged.settings.shard.of();
    if let Some(index) = (0..of).find(|index| !seen.contains(index)) {
        return Err(missing(format!("{}/{of}", index + 1)));
    }
    merged.settings.shard = Shard::WHOLE;
    Ok(merged)
}

impl Subject for Absent {
    fn name(&self) -> &str {
        &self.name
    }

    fn answer(&self, query: &Query) -> Result<Answer, NoAnswer> {
        Err(Unsupported::Kind(query.kind()).into())
    }

    fn tolerance(&self) -> Tolerance {
        self.tolerance
    }
}

fn block(row: &SourceRow, judges: &[String]) -> Result<Block, MergeError> {
    let agreements = judges.iter().map(|judge| match row.agreements.get(judge) {
        Some(agreement) => self::agreement(agreement),
        None => Ok(Agreement::default()),
    });
    Ok(Block {
        name: row.name.clone(),
        fingerprint: word("fingerprint", &row.fingerprint, |text| text.parse().ok())?,
        queries: row.queries,
        hits: row.hits,
        crossings: row.crossings,
        joints: row.joints,
        labels: row.labels,
        wrong_labels: finding(&row.wrong_labels)?,
        wrong_label_names: Named::new(
            (row.wrong_label_names.iter())
                .map(|row| (row.place, row.id.clone()))
                .collect(),
        ),
        agreements: agreements.collect::<Result<_, _>>()?,
        tallies: row.subjects.iter().map(tally).collect::<Result<_, _>>()?,
    })
}

fn agreement(row: &AgreementRow) -> Result<Agreement, MergeError> {
    Ok(Agreement {
        queries: row.queries,
        disagreements: finding(&row.disagreements)?,
    })
}

fn tally(row: &SubjectRow) -> Result<Tally, MergeError> {
    let mut tally = Tally {
        hits: row.hits,
        taken: row.taken.iter().map(sort).collect::<Result<_, _>>()?,
        ..Tally::default()
    };
    for refused in &row.refused {
        tally.refused.insert(sort(&refused.sort)?, refused.queries);
    }
    for (kind, count) in &row.lapses {
        tally.lapses.insert(lapse_kind(kind)?, *count);
    }
    for (name, row) in row.faults.iter().filter(|(_, row)| row.count > 0) {
        let named = |name: &str| Fault::ALL.into_iter().find(|fault| fault.name() == name);
        tally
            .faults
            .insert(word("fault", name, named)?, finding(row)?);
    }
    for (erratum, row) in &row.errata {
        let explained = Explained {
            alone: finding(&row.alone)?,
            with_others: finding(&row.with_others)?,
        };
        tally.errata.insert(erratum.clone(), explained);
    }
    Ok(tally)
}

fn sort(row: &SortRow) -> Result<Sort, MergeError> {
    Ok(Sort {
        kind: word("kind", &row.kind, AnyKind::from_name)?,
        has_radius: row.has_radius,
    })
}

fn finding(row: &FindingRow) -> Result<Finding, MergeError> {
    Ok(Finding {
        count: row.count,
        worst: row.worst.as_ref().map(witness).transpose()?,
    })
}

/// The exact answer is found anew.
fn witness(row: &WitnessRow) -> Result<Witness, MergeError> {
    let unreadable = |problem: String| MergeError::Witness {
        id: row.id.clone(),
        problem,
    };
    let query = AnyQuery::parse(&row.query_hexadecimal.to_string()).map_err(unreadable)?;
    let truth = query.decide();
    Ok(Witness {
        severity: row.severity,
        rank: row.rank,
        place: row.place,
        id: row.id.clone(),
        query,
        truth,
        answer: row.answer.clone().map(Statement::Written),
        lapse: row.lapse.as_ref().map(lapse).transpose()?,
    })
}

fn lapse(row: &LapseRow) -> Result<Lapse, MergeError> {
    Ok(Lapse::new(lapse_kind(&row.kind)?, row.detail.clone()))
}

fn lapse_kind(name: &str) -> Result<LapseKind, MergeError> {
    word("lapse", name, |name| {
        LapseKind::ALL.into_iter().find(|kind| kind.name() == name)
    })
}

fn word<T>(
    what: &'static str,
    text: &str,
    read: impl Fn(&str) -> Option<T>,
) -> Result<T, MergeError> {
    read(text).ok_or_else(|| MergeError::Value {
        what,
        value: text.to_owned(),
    })
}
