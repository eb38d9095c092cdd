//! What was found: counts, and the worst witness of each kind.

use std::cmp::Reverse;
use std::collections::{BTreeMap, BTreeSet};

use serde_json::Value;

use crate::answer::ExactAnswer;
use crate::subject::{Answer, Lapse, LapseKind};

use super::query::{AnyKind, AnyQuery};
use super::verdict::{Judgement, Outline, Verdict};

/// What can be wrong with an answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Fault {
    /// [`Verdict::Tunnel`]. Worst: `toi`, `u` and `v` farthest from 0 and 1,
    /// together.
    Tunnel,
    /// Misses of every segment of a wire that is passed, together one fault. Worst: as for a
    /// tunnel, and of the segments the one with that contact.
    JointTunnel,
    /// [`Verdict::MissedGraze`]. Worst: as for a tunnel.
    MissedGraze,
    /// [`Verdict::FalseHit`]. Worst: the largest gap in metres.
    FalseHit,
    /// [`Verdict::NearHit`]. Worst: the first.
    NearHit,
    /// [`Verdict::NoAnswer`]. Worst: the first.
    NoAnswer,
    /// [`Judgement::wrong_case`]. Worst: the first with a wrong verdict, else the first.
    WrongCase,
    /// [`Judgement::differs`]. Worst: the first.
    Differs,
    /// [`Judgement::late`]. Worst: the latest.
    Late,
    /// [`Judgement::early`]. Worst: the earliest.
    Early,
}

/// What a subject says of a witness.
#[derive(Clone, Debug)]
pub enum Statement {
    /// The answer.
    Answer(Answer),
    /// The answer as results have it that were read from a file.
    Written(Value),
}

/// A query that shows a fault.
#[derive(Clone, Debug)]
pub struct Witness {
    /// How bad it is, by the measure of its [`Fault`].
    pub severity: f64,
    /// What it was chosen by among those of its source: the severity, or an estimate of it.
    pub rank: f64,
    /// The place of the query in its source, from 0.
    pub place: u64,
    /// The identifier of the query.
    pub id: String,
    /// The query.
    pub query: AnyQuery,
    /// The exact answer.
    pub truth: ExactAnswer,
    /// What the subject says; `None` for no answer.
    pub answer: Option<Statement>,
    /// How the subject fails, if it does.
    pub lapse: Option<Lapse>,
}

/// How often something was found, and its worst witness.
#[derive(Clone, Debug, Default)]
pub struct Finding {
    /// How often.
    pub count: u64,
    /// The worst witness, of equals the first.
    pub worst: Option<Witness>,
}

/// What a subject may take or not as a whole: queries of a kind, with a radius or without.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Sort {
    /// Their kind.
    pub kind: AnyKind,
    /// Whether they have a radius above 0.
    pub has_radius: bool,
}

impl Sort {
    /// The sort of a query.
    pub fn of(query: &AnyQuery) -> Self {
        Sort {
            kind: query.kind(),
            has_radius: !query.radius().is_zero(),
        }
    }
}

/// What was found of one subject.
#[derive(Clone, Debug, Default)]
pub struct Tally {
    /// How many queries it does not take, by their sort.
    pub refused: BTreeMap<Sort, u64>,
    /// The sorts of query that it takes.
    pub taken: BTreeSet<Sort>,
    /// How many hits it reports.
    pub hits: u64,
    /// In which ways it gives no answer, and how often.
    pub lapses: BTreeMap<LapseKind, u64>,
    /// Answers at the end though nothing was asked any more.
    pub surplus: u64,
    /// What was wrong with its answers.
    pub faults: BTreeMap<Fault, Finding>,
    /// For a subject with known errata: its answers that differ from the exact one, by the erratum
    /// that explains them.
    pub errata: BTreeMap<String, Explained>,
}

/// The answers that one erratum explains.
#[derive(Clone, Debug, Default)]
pub struct Explained {
    /// It alone.
    pub alone: Finding,
    /// It together with others; such an answer stands under each of them.
    pub with_others: Finding,
}

impl Fault {
    /// Every fault, in the order of tables.
    pub const ALL: [Fault; 10] = [
        Fault::Tunnel,
        Fault::JointTunnel,
        Fault::MissedGraze,
        Fault::FalseHit,
        Fault::NearHit,
        Fault::NoAnswer,
        Fault::WrongCase,
        Fault::Differs,
        Fault::Late,
        Fault::Early,
    ];

    /// Those that are told by their number; the others by how bad the worst is.
    pub const COUNTED: &[Fault] = Fault::ALL.split_at(8).0;

    /// The words used in tables.
    pub fn name(self) -> &'static str {
        match self {
            Fault::Tunnel => Verdict::Tunnel.name(),
            Fault::JointTunnel => "joint tunnel",
            Fault::MissedGraze => Verdict::MissedGraze.name(),
            Fault::FalseHit => Verdict::FalseHit.name(),
            Fault::NearHit => Verdict::NearHit.name(),
            Fault::NoAnswer => Verdict::NoAnswer.name(),
            Fault::WrongCase => "wrong case",
            Fault::Differs => "differs",
            Fault::Late => "late",
            Fault::Early => "early",
        }
    }
}

impl Fault {
    /// What it counts, in a line.
    pub const fn meaning(self) -> &'static str {
        match self {
            Fault::Tunnel => {
                "contacts in which the two pass through each other, and which are missed"
            }
            Fault::JointTunnel => {
                "passages through a wire at a node, missed by both segments there"
            }
            Fault::MissedGraze => {
                "contacts in which the two touch and do not pass, and which are missed"
            }
            Fault::FalseHit => "hits of two that never touch in the step",
            Fault::NearHit => "false hits within the distance that the subject declares of itself",
            Fault::NoAnswer => {
                "queries that it takes and does not answer: a crash, a hang, garbage, no time"
            }
            Fault::WrongCase => {
                "cases, such as parallel, that are not the exact one; this fails nobody"
            }
            Fault::Differs => {
                "answers of an exact subject, or of the certified path, wrong in any field"
            }
            Fault::Late => {
                "times of impact after the exact one: positions then are past the contact"
            }
            Fault::Early => "times of impact before the exact one: safe; this fails nobody",
        }
    }
}

impl Judgement {
    /// What is wrong with the answer, each with its severity. `gap` is asked for a false hit alone.
    pub fn faults(&self, truth: &Outline, gap: impl FnOnce() -> f64) -> Vec<(Fault, f64)> {
        let centrality = truth.hit.map_or(0.0, |hit| hit.centrality);
        let mut faults = Vec::new();
        match self.verdict {
            Verdict::Right => {}
            Verdict::Tunnel => faults.push((Fault::Tunnel, centrality)),
            Verdict::MissedGraze => faults.push((Fault::MissedGraze, centrality)),
            Verdict::FalseHit => faults.push((Fault::FalseHit, gap())),
            Verdict::NearHit => faults.push((Fault::NearHit, 0.0)),
            Verdict::NoAnswer => faults.push((Fault::NoAnswer, 0.0)),
        }
        if self.wrong_case {
            let is_decisive = self.verdict != Verdict::Right;
            faults.push((Fault::WrongCase, f64::from(u8::from(is_decisive))));
        }
        if self.differs {
            faults.push((Fault::Differs, 0.0));
        }
        let times = [(Fault::Late, self.late), (Fault::Early, self.early)];
        faults.extend(times.into_iter().filter(|(_, by)| *by > 0.0));
        faults
    }
}

impl Finding {
    /// Adds one more, which comes after all that are counted.
    pub fn add(&mut self, witness: Witness) {
        self.merge(Finding {
            count: 1,
            worst: Some(witness),
        });
    }

    /// Adds what was found after all that is counted.
    pub fn merge(&mut self, later: Finding) {
        self.count += later.count;
        let worst = self.worst.as_ref().map(|witness| witness.severity);
        if let Some(witness) = later.worst
            && worst.is_none_or(|worst| witness.severity > worst)
        {
            self.worst = Some(witness);
        }
    }
}

impl Finding {
    /// Adds what was found on another part of the same source, whichever was first.
    pub fn join(&mut self, other: Finding) {
        self.count += other.count;
        let key = |witness: &Witness| (witness.rank, Reverse(witness.place));
        let worst = self.worst.as_ref().map(key);
        if let Some(witness) = other.worst
            && worst.is_none_or(|worst| key(&witness) > worst)
        {
            self.worst = Some(witness);
        }
    }
}

impl Tally {
    /// How often this fault was found.
    pub fn count(&self, fault: Fault) -> u64 {
        self.faults.get(&fault).map_or(0, |finding| finding.count)
    }

    /// The severity of the worst witness of this fault; 0 if it was not found.
    pub fn worst(&self, fault: Fault) -> f64 {
        let finding = self.faults.get(&fault);
        finding
            .and_then(|finding| finding.worst.as_ref())
            .map_or(0.0, |witness| witness.severity)
    }

    /// How many queries it does not take.
    pub fn not_asked(&self) -> u64 {
        self.refused.values().sum()
    }

    /// How many of them are of a sort that it takes.
    pub fn refused_of_taken(&self) -> u64 {
        let refused = self.refused.iter();
        let of_taken = refused.filter(|(sort, _)| self.taken.contains(sort));
        of_taken.map(|(_, count)| count).sum()
    }

    /// Adds what was found on a later source.
    pub fn merge(&mut self, later: Tally) {
        self.add(later, Finding::merge);
    }

    /// Adds what was found on another part of the same source, whichever was first.
    pub fn join(&mut self, other: Tally) {
        self.add(other, Finding::join);
    }

    fn add(&mut self, later: Tally, add: fn(&mut Finding, Finding)) {
        for (sort, count) in later.refused {
            *self.refused.entry(sort).or_default() += count;
        }
        self.taken.extend(later.taken);
        self.hits += later.hits;
        self.surplus += later.surplus;
        for (kind, count) in later.lapses {
            *self.lapses.entry(kind).or_default() += count;
        }
        for (fault, finding) in later.faults {
            add(self.faults.entry(fault).or_default(), finding);
        }
        for (erratum, finding) in later.errata {
            let explained = self.errata.entry(erratum).or_default();
            add(&mut explained.alone, finding.alone);
            add(&mut explained.with_others, finding.with_others);
        }
    }
}
