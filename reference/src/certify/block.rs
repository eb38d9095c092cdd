//! What was found on one source, added up.

use crate::answer::ExactAnswer;
use crate::subject::Answer;

use super::fingerprint::Fingerprint;
use super::judged::Found;
use super::named::Named;
use super::query::AnyQuery;
use super::reply::Reply;
use super::tally::{Fault, Finding, Sort, Statement, Tally, Witness};
use super::verdict::Outline;

/// What was found on one source.
#[derive(Clone, Debug, Default)]
pub struct Block {
    /// The name of the source.
    pub name: String,
    /// A hash of the queries.
    pub fingerprint: Fingerprint,
    /// How many queries there were.
    pub queries: u64,
    /// How many of them are hits.
    pub hits: u64,
    /// How many of them are crossed.
    pub crossings: u64,
    /// How many whole groups there were of segments of a wire that is passed.
    pub joints: u64,
    /// How many of them are labelled.
    pub labels: u64,
    /// Labels that are not what the oracle says.
    pub wrong_labels: Finding,
    /// The first of these queries by name.
    pub wrong_label_names: Named,
    /// What each second judge was asked, in the order of the panel.
    pub agreements: Vec<Agreement>,
    /// What was found of each subject, in the order of the panel.
    pub tallies: Vec<Tally>,
}

/// What a second judge says of the oracle's answers.
#[derive(Clone, Debug, Default)]
pub struct Agreement {
    /// How many queries it was asked.
    pub queries: u64,
    /// Queries on which it does not say what the oracle says.
    pub disagreements: Finding,
}

/// A query and all that was said and found about it.
pub(super) struct Judgements {
    pub(super) id: String,
    pub(super) place: u64,
    pub(super) query: AnyQuery,
    pub(super) fingerprint: Fingerprint,
    pub(super) label: Option<bool>,
    pub(super) truth: ExactAnswer,
    /// The number of the second judge that takes the query, if any, and what it says.
    pub(super) second: Option<(usize, Reply)>,
    pub(super) subjects: Vec<Found>,
}

impl Judgements {
    fn witness(&self, severity: f64) -> Witness {
        Witness {
            severity,
            rank: severity,
            place: self.place,
            id: self.id.clone(),
            query: self.query,
            truth: self.truth,
            answer: None,
            lapse: None,
        }
    }

    fn witness_of(&self, found: &Found, severity: f64) -> Witness {
        Witness {
            answer: found.answer.map(Statement::Answer),
            lapse: found.lapse.clone(),
            ..self.witness(severity)
        }
    }

    /// How central the contact is; 0 for a miss.
    fn centrality(&self) -> f64 {
        let outline = Outline::from(&self.truth);
        outline.hit.map_or(0.0, |hit| hit.centrality)
    }
}

impl Block {
    pub(super) fn add(&mut self, case: Judgements) {
        let hit = case.truth.hit;
        self.queries += 1;
        self.fingerprint.merge(case.fingerprint);
        self.hits += u64::from(hit.is_some());
        self.crossings += u64::from(hit.is_some_and(|hit| hit.crosses));
        self.labels += u64::from(case.label.is_some());
        if case.label.is_some_and(|label| label != hit.is_some()) {
            self.wrong_labels.add(case.witness(0.0));
            self.wrong_label_names.add(case.place, &case.id);
        }
        if let Some((judge, reply)) = &case.second {
            let agreement = &mut self.agreements[*judge];
            agreement.queries += 1;
            if *reply != Reply::Answer(Answer::Exact(case.truth)) {
                agreement.disagreements.add(Witness {
                    answer: reply.answer().map(Statement::Answer),
                    ..case.witness(0.0)
                });
            }
        }
        for (tally, found) in self.tallies.iter_mut().zip(&case.subjects) {
            let sort = Sort::of(&case.query);
            if found.is_asked {
                tally.taken.insert(sort);
            } else {
                *tally.refused.entry(sort).or_default() += 1;
            }
            tally.hits += u64::from(found.is_hit);
            if let Some(lapse) = &found.lapse {
                *tally.lapses.entry(lapse.kind).or_default() += 1;
            }
            for &(fault, severity) in &found.faults {
                let finding = tally.faults.entry(fault).or_default();
                finding.add(case.witness_of(found, severity));
            }
            for erratum in &found.errata {
                let explained = tally.errata.entry((*erratum).to_owned()).or_default();
                let finding = match found.errata.len() {
                    1 => &mut explained.alone,
                    _ => &mut explained.with_others,
                };
                finding.add(case.witness_of(found, 0.0));
            }
        }
    }

    /// Counts the joint tunnels of a group: the wire is passed, so that a hit is due in one of its
    /// members.
    pub(super) fn add_joint(&mut self, members: &[Judgements]) {
        self.joints += 1;
        let more_central =
            |a: &&Judgements, b: &&Judgements| a.centrality().total_cmp(&b.centrality());
        let Some(shown) = members.iter().max_by(more_central) else {
            return;
        };
        for (i, tally) in self.tallies.iter_mut().enumerate() {
            if members.iter().all(|member| member.subjects[i].is_miss) {
                let witness = shown.witness_of(&shown.subjects[i], shown.centrality());
                tally
                    .faults
                    .entry(Fault::JointTunnel)
                    .or_default()
                    .add(witness);
            }
        }
    }

    /// Adds what was found on a later source.
    pub fn merge(&mut self, later: Block) {
        self.add_block(later, Finding::merge, Named::merge, Tally::merge);
    }

    /// Adds what was found on another part of the same source, whichever was first.
    pub fn join(&mut self, other: Block) {
        self.add_block(other, Finding::join, Named::join, Tally::join);
    }

    fn add_block(
        &mut self,
        later: Block,
        add: fn(&mut Finding, Finding),
        add_names: fn(&mut Named, Named),
        add_tally: fn(&mut Tally, Tally),
    ) {
        self.fingerprint.merge(later.fingerprint);
        self.queries += later.queries;
        self.hits += later.hits;
        self.crossings += later.crossings;
        self.joints += later.joints;
        self.labels += later.labels;
        add(&mut self.wrong_labels, later.wrong_labels);
        add_names(&mut self.wrong_label_names, later.wrong_label_names);
        self.agreements
            .resize_with(later.agreements.len(), Agreement::default);
        for (agreement, later) in self.agreements.iter_mut().zip(later.agreements) {
            agreement.queries += later.queries;
            add(&mut agreement.disagreements, later.disagreements);
        }
        self.tallies
            .resize_with(later.tallies.len(), Tally::default);
        for (tally, later) in self.tallies.iter_mut().zip(later.tallies) {
            add_tally(tally, later);
        }
    }
}

/// Puts the exact gap of the worst false hit in the place of the estimate that it was chosen by.
pub(super) fn measure_gap(tally: &mut Tally) {
    let worst = tally
        .faults
        .get_mut(&Fault::FalseHit)
        .and_then(|finding| finding.worst.as_mut());
    if let Some(witness) = worst {
        witness.severity = witness.query.exact_gap();
    }
}
