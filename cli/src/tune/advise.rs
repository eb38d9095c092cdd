//! Which setting of the front to take, and which thresholds matter for it.

use serde::Serialize;
use tunnelproof::thesis::Threshold;

use crate::sweep::{Interrupted, Setting};

use super::front::Front;
use super::lattice::{Lattice, Place};
use super::search::{Aim, Cost, Judge, Member, search};

/// How bad a missed crossing is.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Penalty {
    /// As bad as so many false hits.
    pub false_hits: f64,
}

/// What a search found.
#[derive(Clone, Debug, PartialEq)]
pub struct Advice {
    /// Missed crossings against the number of false hits.
    pub by_count: Front<Member>,
    /// Missed crossings against the gaps of the false hits together.
    pub by_gap: Front<Member>,
    /// The setting of the first front with the least penalty.
    pub best: Member,
    /// The best of those with one relative threshold in the place of all.
    pub relative: Member,
    /// What each threshold matters for the best setting.
    pub influences: Vec<Influence>,
    /// Thresholds that can be 0 together, with a penalty no more than [`SLACK`] above the least.
    pub superfluous: Vec<Threshold>,
    /// The best setting with those 0.
    pub reduced: Member,
    /// How many settings were judged.
    pub judged: usize,
}

/// What a threshold matters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Influence {
    /// The threshold.
    pub threshold: Threshold,
    /// The best setting in which it is 0, the others at whatever is best then.
    pub at_zero: Member,
    /// Its least and its greatest value between which the best setting keeps its penalty, up to
    /// [`SLACK`], the others as they are.
    pub indifferent: [usize; 2],
}

/// What part of the penalty does not count.
pub const SLACK: f64 = 0.01;

impl Penalty {
    /// In false hits.
    pub fn of(&self, cost: &Cost) -> f64 {
        self.false_hits * cost.missed_crossings as f64 + cost.false_hits as f64
    }

    /// The member of least penalty, of equals the first.
    fn best<'a>(&self, members: impl IntoIterator<Item = &'a Member>) -> Option<Member> {
        let by_penalty = |a: &&Member, b: &&Member| self.of(&a.cost).total_cmp(&self.of(&b.cost));
        members.into_iter().min_by(by_penalty).copied()
    }

    /// Whether a cost is as good as another, up to [`SLACK`].
    fn is_as_good(&self, cost: &Cost, best: &Cost) -> bool {
        self.of(cost) <= self.of(best) * (1.0 + SLACK)
    }
}

/// Searches, and says what was found.
///
/// # Errors
///
/// [`Interrupted`] if the watch of the judge says so.
pub fn advise(judge: &mut Judge, penalty: Penalty) -> Result<Advice, Interrupted> {
    let without = Threshold::ALL.map(|threshold| best_without(judge, penalty, &[threshold]));
    let [dist, dist_1d, t, quadratic, cubic] = without;
    let without = [dist?, dist_1d?, t?, quadratic?, cubic?];
    // What is best without a threshold is a start, so that what is found with it is no worse.
    let mut starts = starts(judge.lattice());
    starts.extend(without.iter().map(|member| member.place));
    let all = [true; 5];
    let by_count = search(judge, Aim::Count, &starts, all)?;
    let by_gap = search(judge, Aim::Gap, &starts, all)?;
    let relative = best_relative(judge, penalty)?;
    let best = penalty.best(by_count.members()).unwrap_or(relative);
    let mut influences = Vec::new();
    for (threshold, at_zero) in Threshold::ALL.into_iter().zip(without) {
        influences.push(Influence {
            threshold,
            at_zero,
            indifferent: indifferent(judge, penalty, &best, threshold)?,
        });
    }
    let (superfluous, reduced) = superfluous(judge, penalty, best)?;
    Ok(Advice {
        by_count,
        by_gap,
        best,
        relative,
        influences,
        superfluous,
        reduced,
        judged: judge.judged(),
    })
}

/// Table 3.1 as nearly as the lattice has it, and every one relative threshold.
fn starts(lattice: &Lattice) -> Vec<Place> {
    let published = lattice.nearest(&Setting::published());
    let relative = (0..Lattice::VALUES).map(|value| [value; 5]);
    [published].into_iter().chain(relative).collect()
}

fn best_relative(judge: &mut Judge, penalty: Penalty) -> Result<Member, Interrupted> {
    let mut members = Vec::new();
    for value in 0..Lattice::VALUES {
        let place = [value; 5];
        let cost = judge.cost(place)?;
        members.push(Member { place, cost });
    }
    let zero = members[0];
    Ok(penalty.best(&members).unwrap_or(zero))
}

/// The best setting in which these thresholds are 0.
fn best_without(
    judge: &mut Judge,
    penalty: Penalty,
    gone: &[Threshold],
) -> Result<Member, Interrupted> {
    let mut free = [true; 5];
    let mut starts = starts(judge.lattice());
    for &threshold in gone {
        free[threshold as usize] = false;
        starts
            .iter_mut()
            .for_each(|place| place[threshold as usize] = 0);
    }
    let front = search(judge, Aim::Count, &starts, free)?;
    let zero = Member {
        place: Lattice::ZERO,
        cost: judge.cost(Lattice::ZERO)?,
    };
    Ok(penalty.best(front.members()).unwrap_or(zero))
}

/// Between which values of a threshold a setting keeps its penalty.
fn indifferent(
    judge: &mut Judge,
    penalty: Penalty,
    best: &Member,
    threshold: Threshold,
) -> Result<[usize; 2], Interrupted> {
    let own = best.place[threshold as usize];
    let mut ends = [own; 2];
    let below: Vec<_> = (0..own).rev().collect();
    let above: Vec<_> = (own + 1..Lattice::VALUES).collect();
    for (end, values) in ends.iter_mut().zip([below, above]) {
        for value in values {
            let mut place = best.place;
            place[threshold as usize] = value;
            if !penalty.is_as_good(&judge.cost(place)?, &best.cost) {
                break;
            }
            *end = value;
        }
    }
    Ok(ends)
}

/// Sets one threshold after the other to 0, always the one that matters least, as long as the
/// penalty stays what it is up to [`SLACK`].
fn superfluous(
    judge: &mut Judge,
    penalty: Penalty,
    best: Member,
) -> Result<(Vec<Threshold>, Member), Interrupted> {
    let (mut gone, mut reduced) = (Vec::new(), best);
    loop {
        let mut candidates = Vec::new();
        for threshold in Threshold::ALL {
            if !gone.contains(&threshold) {
                let without = [&gone[..], &[threshold]].concat();
                candidates.push((threshold, best_without(judge, penalty, &without)?));
            }
        }
        let least = candidates
            .into_iter()
            .min_by(|(_, a), (_, b)| penalty.of(&a.cost).total_cmp(&penalty.of(&b.cost)));
        match least {
            Some((threshold, member)) if penalty.is_as_good(&member.cost, &best.cost) => {
                gone.push(threshold);
                reduced = member;
            }
            _ => return Ok((gone, reduced)),
        }
    }
}
