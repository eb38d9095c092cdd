//! What a setting costs: what was wrong with the answers that it gives.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use tunnelproof::narrow::NarrowPhase;
use tunnelproof::thesis::Thesis;
use tunnelproof_reference::certify::tally::Fault;
use tunnelproof_reference::certify::verdict::{Judgement, Outline};

use super::sample::Sample;

const FAULTS: usize = Fault::ALL.len();

/// What was wrong on some queries, before gaps are measured.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Counts {
    /// How many hits are reported.
    pub hits: u64,
    counts: [u64; FAULTS],
    /// The largest severity of each fault, and the first query that has it.
    worst: [Option<(f64, usize)>; FAULTS],
    /// The queries that are false hits.
    pub false_hits: Vec<usize>,
}

/// What a setting costs on a sample.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Price {
    /// Hits that are reported.
    pub hits: u64,
    /// Crossings that are missed.
    pub tunnels: u64,
    /// Wires passed at a node, missed by both of the segments there.
    pub joint_tunnels: u64,
    /// Other contacts that are missed.
    pub missed_grazes: u64,
    /// Hits without contact.
    pub false_hits: u64,
    /// The gaps of the false hits; `None` if there is none.
    pub gaps: Option<Gaps>,
    /// Queries without a meaningful answer.
    pub no_answers: u64,
    /// Cases that are not the exact ones.
    pub wrong_cases: u64,
    /// Times of impact later than the exact ones by more than the thesis' threshold for time.
    pub late: u64,
    /// Times of impact earlier than the exact ones by more than that.
    pub early: u64,
    /// The worst witness of each fault, by its name.
    pub worst: BTreeMap<String, Worst>,
}

/// How far from each other edges are that are called touching, in metres.
///
/// False hits are put in order by an estimate of their gap in floating point. The gaps of the
/// middle one and of the last one are then measured exactly.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Gaps {
    /// Of half of the false hits the gap is not larger.
    pub median: f64,
    /// The largest.
    pub max: f64,
    /// How many there are in each decade, by the estimate: at `n` those from `10^n` to
    /// `10^(n + 1)`, and at -24 all that are smaller.
    pub decades: BTreeMap<i32, u64>,
}

/// The worst witness of a fault.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Worst {
    /// How bad it is, by the measure of its [`Fault`].
    pub severity: f64,
    /// Which query of the sample.
    pub index: usize,
    /// Its identifier.
    pub id: String,
}

impl Counts {
    /// Adds the answer to one query, which comes after all that are counted.
    pub(super) fn add(&mut self, index: usize, truth: &Outline, judgement: &Judgement) {
        self.hits += u64::from(judgement.is_hit);
        let tolerance = Thesis::default().tolerance();
        for (fault, severity) in judgement.faults(truth, || 0.0) {
            match fault {
                Fault::Late | Fault::Early if tolerance.permits_late(severity) => {}
                Fault::FalseHit => self.false_hits.push(index),
                _ => self.add_fault(fault, severity, index),
            }
        }
    }

    /// Adds one fault, which comes after all that are counted.
    pub(super) fn add_fault(&mut self, fault: Fault, severity: f64, index: usize) {
        let fault = fault as usize;
        self.counts[fault] += 1;
        raise(&mut self.worst[fault], (severity, index));
    }

    /// Adds what was counted on later queries.
    pub(super) fn merge(&mut self, later: Counts) {
        self.hits += later.hits;
        self.false_hits.extend(later.false_hits);
        for fault in 0..FAULTS {
            self.counts[fault] += later.counts[fault];
            if let Some(worst) = later.worst[fault] {
                raise(&mut self.worst[fault], worst);
            }
        }
    }

    /// How often a fault was found.
    pub fn count(&self, fault: Fault) -> u64 {
        match fault {
            Fault::FalseHit => self.false_hits.len() as u64,
            _ => self.counts[fault as usize],
        }
    }

    /// Crossings that get through: of an edge, or of a wire at a node.
    pub fn missed_crossings(&self) -> u64 {
        self.count(Fault::Tunnel) + self.count(Fault::JointTunnel)
    }

    /// The gaps of the false hits together, in metres, by their estimates.
    pub fn total_gap(&self, sample: &Sample) -> f64 {
        // The sum of none would be -0.
        let gaps = sample.estimate_gaps(&self.false_hits);
        gaps.iter().fold(0.0, |total, gap| total + gap)
    }

    /// What it costs, with the gaps of the false hits measured.
    pub fn price(&self, sample: &Sample) -> Price {
        let (gaps, largest) = measure_gaps(&self.false_hits, sample).unzip();
        let mut worst = BTreeMap::new();
        for fault in Fault::ALL {
            let found = match fault {
                Fault::FalseHit => largest,
                _ => self.worst[fault as usize],
            };
            if let Some((severity, index)) = found {
                let id = sample.ids()[index].clone();
                let witness = Worst {
                    severity,
                    index,
                    id,
                };
                worst.insert(fault.name().to_owned(), witness);
            }
        }
        Price {
            hits: self.hits,
            tunnels: self.count(Fault::Tunnel),
            joint_tunnels: self.count(Fault::JointTunnel),
            missed_grazes: self.count(Fault::MissedGraze),
            false_hits: self.count(Fault::FalseHit),
            gaps,
            no_answers: self.count(Fault::NoAnswer),
            wrong_cases: self.count(Fault::WrongCase),
            late: self.count(Fault::Late),
            early: self.count(Fault::Early),
            worst,
        }
    }
}

impl Price {
    /// Crossings that get through: of an edge, or of a wire at a node.
    pub fn missed_crossings(&self) -> u64 {
        self.tunnels + self.joint_tunnels
    }
}

/// Keeps the worse one, of equals the one that was there.
fn raise(worst: &mut Option<(f64, usize)>, later: (f64, usize)) {
    if worst.is_none_or(|(severity, _)| later.0 > severity) {
        *worst = Some(later);
    }
}

/// The gaps of some queries, and the largest with the query that has it.
fn measure_gaps(queries: &[usize], sample: &Sample) -> Option<(Gaps, (f64, usize))> {
    let estimates = sample.estimate_gaps(queries);
    let ranked = estimates.into_iter().zip(queries.iter().copied());
    gaps_of(ranked.collect(), |index| sample.gap(index))
}

/// The same of queries with their estimates. The median and the largest are found by these and then
/// measured; if the measured one of the median is above the other, that is the largest.
fn gaps_of(
    mut ranked: Vec<(f64, usize)>,
    gap: impl Fn(usize) -> f64,
) -> Option<(Gaps, (f64, usize))> {
    // Of equal gaps the first query is the last in order: it is the witness.
    ranked.sort_by(|(a, i), (b, j)| a.total_cmp(b).then(j.cmp(i)));
    let &(_, last) = ranked.last()?;
    let (_, middle) = ranked[(ranked.len() - 1) / 2];
    let mut decades = BTreeMap::new();
    for (estimate, _) in &ranked {
        *decades.entry(decade(*estimate)).or_default() += 1;
    }
    let [median, largest] = [middle, last].map(|index| (gap(index), index));
    let largest = match largest.0 < median.0 {
        true => median,
        false => largest,
    };
    let gaps = Gaps {
        median: median.0,
        max: largest.0,
        decades,
    };
    Some((gaps, largest))
}

/// Smaller estimates count as this: they are rounding.
const LEAST_GAP: f64 = 1e-24;

/// The exponent of the power of ten that is not above a gap.
fn decade(gap: f64) -> i32 {
    gap.max(LEAST_GAP).log10().floor() as i32
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn decade_is_the_power_of_ten_not_above() {
        for (gap, exponent) in [
            (1.0, 0),
            (9.9, 0),
            (0.1, -1),
            (0.02, -2),
            (0.0, -24),
            (1e-30, -24),
        ] {
            assert_eq!(decade(gap), exponent, "{gap}");
        }
    }

    #[test]
    fn largest_gap_is_never_below_the_median() {
        // The estimates of 7 and 8 are off: the one that is taken for the median is larger.
        let ranked = vec![(1.0, 8), (1.0, 7), (0.5, 9)];
        let (gaps, largest) = gaps_of(ranked, |index| [1.25, 1.5, 0.5][index - 7]).unwrap();
        assert_eq!((gaps.median, gaps.max, largest), (1.5, 1.5, (1.5, 8)));
        let (gaps, largest) = gaps_of(vec![(1.0, 0), (2.0, 1)], |index| index as f64).unwrap();
        assert_eq!((gaps.median, gaps.max, largest), (0.0, 1.0, (1.0, 1)));
    }

    #[test]
    fn raise_keeps_the_first_of_equals() {
        let mut worst = None;
        for later in [(0.5, 3), (0.5, 4), (0.75, 5), (0.25, 6)] {
            raise(&mut worst, later);
        }
        assert_eq!(worst, Some((0.75, 5)));
    }
}
