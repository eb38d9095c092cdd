//! A program judged on boxes that are cast.

use std::collections::btree_map::Entry;
use std::collections::{BTreeMap, BTreeSet};

use hmac_sha256::Hash;
use num_rational::BigRational;
use num_traits::{One, ToPrimitive};
use rayon::prelude::*;
use tunnelproof::contact::Case;
use tunnelproof::narrow::Tolerance;
use tunnelproof::query::Point;

use super::judged::no_time;
use super::strict::{counts, refused_of_taken, took_none, words};
use super::table::{SURPLUS, many};
use super::tally::Fault;
use super::verdict::{Judgement, Outline, OutlineHit, judge_outline};
use crate::boxes::{
    Body, BoxAnswer, BoxCast, BoxFamily, BoxId, Shape, comes_within, decide, least_square,
};
use crate::program::{Program, frames};
use crate::subject::{Answer, Lapse, LapseKind, NoAnswer, Said, Subject};

/// How many casts a program is asked in one go.
const CHUNK: u64 = 64;

/// What was found of one program on one family.
#[derive(Clone, Debug)]
pub struct Judged {
    /// The name of the family.
    pub name: &'static str,
    /// A hash of the casts.
    pub fingerprint: String,
    /// How many casts there were.
    pub queries: u64,
    /// How many of them are hits.
    pub hits: u64,
    /// In how many of them the bodies pass into each other.
    pub crossings: u64,
    /// How many the program does not take, by their sort.
    pub refused: BTreeMap<BoxSort, u64>,
    /// The sorts that it takes.
    pub taken: BTreeSet<BoxSort>,
    /// In which other ways it gives no answer, and how often.
    pub lapses: BTreeMap<LapseKind, u64>,
    /// What was wrong with its answers.
    pub faults: BTreeMap<Fault, BoxFinding>,
}

/// What a program may take or not as a whole.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct BoxSort {
    shapes: [Shape; 2],
    /// Whether the bodies have a radius above 0.
    have_radius: [bool; 2],
    /// Whether all boxes are along the axes.
    is_aligned: bool,
}

impl BoxSort {
    fn of(cast: &BoxCast) -> Self {
        let bodies = cast.bodies();
        BoxSort {
            shapes: bodies.each_ref().map(Body::shape),
            have_radius: bodies.each_ref().map(|body| body.radius() > 0.0),
            is_aligned: bodies.iter().all(is_aligned),
        }
    }
}

fn is_aligned(body: &Body) -> bool {
    let [corner, beside @ ..] = body.points();
    let is_along_an_axis =
        |point: &Point| (point - corner).iter().filter(|x| **x != 0.0).count() <= 1;
    body.shape() != Shape::Box || beside.iter().all(is_along_an_axis)
}

/// How often something was found, and its worst witness.
#[derive(Clone, Debug)]
pub struct BoxFinding {
    /// How often.
    pub count: u64,
    /// The worst witness, of equals the first.
    pub worst: BoxWitness,
}

/// A cast that shows a fault.
#[derive(Clone, Debug)]
pub struct BoxWitness {
    /// How bad it is, by the measure of its [`Fault`].
    pub severity: f64,
    /// The name of the cast.
    pub id: BoxId,
    /// The exact answer.
    pub truth: BoxAnswer,
    /// What the program says; `None` for no answer.
    pub said: Option<Said>,
    /// How it fails, if it does.
    pub lapse: Option<Lapse>,
}

/// Judges a program on the first casts of a family.
pub fn judge_family(
    program: &Program,
    family: &'static BoxFamily,
    seed: u64,
    count: u64,
) -> Judged {
    let mut judged = Judged {
        name: family.name(),
        fingerprint: String::new(),
        queries: 0,
        hits: 0,
        crossings: 0,
        refused: BTreeMap::new(),
        taken: BTreeSet::new(),
        lapses: BTreeMap::new(),
        faults: BTreeMap::new(),
    };
    let mut hash = Hash::new();
    for first in (0..count).step_by(CHUNK as usize) {
        let ids = (first..count.min(first + CHUNK)).map(|index| BoxId {
            family,
            seed,
            index,
        });
        let casts: Vec<(BoxId, BoxCast)> = ids.map(|id| (id, id.cast())).collect();
        let asked: Vec<BoxCast> = casts.iter().map(|(_, cast)| *cast).collect();
        for (cast, place) in asked.iter().zip(first..) {
            hash.update(frames::of_cast(place, cast));
        }
        let answers = program.cast_answers(&asked);
        let truths: Vec<BoxAnswer> = asked.par_iter().map(decide).collect();
        for (((id, cast), answer), truth) in casts.into_iter().zip(answers).zip(truths) {
            judged.add(id, &cast, answer, truth, program.tolerance().near);
        }
    }
    let digest = hash.finalize();
    judged.fingerprint = digest[..16].iter().map(|b| format!("{b:02x}")).collect();
    judged
}

/// What was found of all families together, by faults.
pub fn faults(found: &[Judged]) -> BTreeMap<Fault, BoxFinding> {
    let mut all: BTreeMap<Fault, BoxFinding> = BTreeMap::new();
    for (fault, finding) in found.iter().flat_map(|judged| &judged.faults) {
        add(&mut all, *fault, finding.clone());
    }
    all
}

/// Adds what was found after all that is counted; of equal witnesses the first is kept.
fn add(all: &mut BTreeMap<Fault, BoxFinding>, fault: Fault, later: BoxFinding) {
    match all.entry(fault) {
        Entry::Vacant(entry) => {
            entry.insert(later);
        }
        Entry::Occupied(mut entry) => {
            let own = entry.get_mut();
            own.count += later.count;
            if later.worst.severity > own.worst.severity {
                own.worst = later.worst;
            }
        }
    }
}

/// What a program fails by within this tolerance, of all families together; none if it passes. `surplus` is
/// the number of its answers to nothing.
pub fn failures(found: &[Judged], tolerance: Tolerance, surplus: u64) -> Vec<String> {
    let all = faults(found);
    let counted = all
        .iter()
        .filter(|(fault, finding)| counts(tolerance, **fault, finding.worst.severity));
    let counted = counted.map(|(fault, finding)| many(finding.count, words(tolerance, *fault)));
    let queries: u64 = found.iter().map(|judged| judged.queries).sum();
    let refused: u64 = found.iter().map(Judged::refused).sum();
    let none = (queries == refused).then(|| took_none(queries));
    let taken: BTreeSet<_> = found.iter().flat_map(|judged| &judged.taken).collect();
    let by_sort = found.iter().flat_map(|judged| &judged.refused);
    let chosen = by_sort.filter(|(sort, _)| taken.contains(sort));
    let chosen: u64 = chosen.map(|(_, count)| count).sum();
    let chosen = (chosen > 0).then(|| refused_of_taken(chosen));
    let surplus = (surplus > 0).then(|| many(surplus, SURPLUS));
    counted.chain(none).chain(chosen).chain(surplus).collect()
}

impl Judged {
    /// How many the program does not take.
    pub fn refused(&self) -> u64 {
        self.refused.values().sum()
    }

    fn add(
        &mut self,
        id: BoxId,
        cast: &BoxCast,
        answer: Result<Answer, NoAnswer>,
        truth: BoxAnswer,
        near: f64,
    ) {
        self.queries += 1;
        self.hits += u64::from(truth.toi.is_some());
        self.crossings += u64::from(truth.overlaps);
        let sort = BoxSort::of(cast);
        let (said, lapse) = match answer {
            Ok(Answer::Said(said)) => (Some(said), None),
            // Programs say nothing else.
            Ok(_) => (None, None),
            Err(NoAnswer::Lapse(lapse)) if lapse.kind != LapseKind::Refused => (None, Some(lapse)),
            Err(_) => return *self.refused.entry(sort).or_default() += 1,
        };
        if said.is_some() {
            self.taken.insert(sort);
        }
        let judgement = said.map(|said| compare(cast, &truth, &said, near));
        let faults = match &judgement {
            None => vec![(Fault::NoAnswer, 0.0)],
            Some(judgement) => judgement.faults(&outline(&truth), || gap(cast)),
        };
        let toi = said.and_then(|said| said.toi);
        let of_time = |judgement: &Judgement| no_time(judgement.verdict, toi);
        let lapse = lapse.or_else(|| judgement.as_ref().and_then(of_time));
        if let Some(lapse) = &lapse {
            *self.lapses.entry(lapse.kind).or_default() += 1;
        }
        for (fault, severity) in faults {
            let worst = BoxWitness {
                severity,
                id,
                truth,
                said,
                lapse: lapse.clone(),
            };
            add(&mut self.faults, fault, BoxFinding { count: 1, worst });
        }
    }
}

fn compare(cast: &BoxCast, truth: &BoxAnswer, said: &Said, near: f64) -> Judgement {
    judge_outline(&outline(truth), said, || {
        near > 0.0 && comes_within(cast, near, &BigRational::one())
    })
}

/// What verdicts depend on. Central is a contact in the middle of the step.
fn outline(truth: &BoxAnswer) -> Outline {
    Outline {
        case: Case::General,
        hit: truth.toi.map(|toi| OutlineHit {
            toi,
            crosses: truth.overlaps,
            centrality: 2.0 * toi.below.min(1.0 - toi.above),
        }),
    }
}

/// About the least distance during the step beyond the radii.
fn gap(cast: &BoxCast) -> f64 {
    let [first, second] = cast.bodies();
    let square = least_square(cast, &BigRational::one());
    square.to_f64().unwrap_or(f64::INFINITY).sqrt() - first.radius() - second.radius()
}
