//! What is known of one query, as bytes.
//!
//! | bytes | what |
//! | --- | --- |
//! | 1 | bits 0 to 2: the case, in the order of [`Case::ALL`]; then whether it is a hit, whether it crosses, whether `toi` is an `f64`, and whether all of this is known |
//! | 8 | the `f64` next below `toi` |
//! | 8 | how central the contact is |
//! | 8 | the estimate of the gap; NaN if there is none |
//! | 8 | the gap; NaN if it was not measured |

use tunnelproof::contact::Case;

use tunnelproof_reference::answer::Enclosure;
use tunnelproof_reference::certify::verdict::{Outline, OutlineHit};

/// How many bytes a record has.
pub(super) const SIZE: usize = 33;

const CASE: u8 = 0b111;
const HIT: u8 = 1 << 3;
const CROSSES: u8 = 1 << 4;
const IS_EXACT: u8 = 1 << 5;
const IS_KNOWN: u8 = 1 << 6;

/// What is known of one query.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub(super) struct Record {
    /// What the verdicts need of the exact answer.
    pub(super) outline: Option<Outline>,
    /// The least distance during the step in metres, in floating point.
    pub(super) estimate: Option<f64>,
    /// The least distance during the step in metres, exactly enough.
    pub(super) gap: Option<f64>,
}

impl Record {
    /// The bytes of the record.
    pub(super) fn to_bytes(self) -> [u8; SIZE] {
        let mut flags = 0;
        let (mut toi, mut centrality) = (0.0, 0.0);
        if let Some(outline) = self.outline {
            flags |= IS_KNOWN | case_number(outline.case);
            if let Some(hit) = outline.hit {
                flags |= HIT;
                flags |= if hit.crosses { CROSSES } else { 0 };
                flags |= if hit.toi.is_exact() { IS_EXACT } else { 0 };
                (toi, centrality) = (hit.toi.below, hit.centrality);
            }
        }
        let [estimate, gap] = [self.estimate, self.gap].map(|gap| gap.unwrap_or(f64::NAN));
        let mut bytes = [flags; SIZE];
        let numbers = [toi, centrality, estimate, gap];
        for (slot, number) in bytes[1..].chunks_exact_mut(8).zip(numbers) {
            slot.copy_from_slice(&number.to_le_bytes());
        }
        bytes
    }

    /// The record with these bytes; `None` if there is none.
    pub(super) fn from_bytes(bytes: &[u8; SIZE]) -> Option<Self> {
        let flags = bytes[0];
        let mut numbers = [0.0; 4];
        for (number, slot) in numbers.iter_mut().zip(bytes[1..].as_chunks().0) {
            *number = f64::from_le_bytes(*slot);
        }
        let [below, centrality, estimate, gap] = numbers;
        let is_gap = |gap: &f64| *gap >= 0.0;
        let gaps = [estimate, gap].map(|gap| Some(gap).filter(is_gap));
        let toi = Enclosure {
            below,
            above: if flags & IS_EXACT != 0 {
                below
            } else {
                below.next_up()
            },
        };
        let hit = OutlineHit {
            toi,
            crosses: flags & CROSSES != 0,
            centrality,
        };
        let is_hit = flags & HIT != 0;
        if is_hit && !(toi.below >= 0.0 && toi.above <= 1.0 && (0.0..=1.0).contains(&centrality)) {
            return None;
        }
        let outline = Outline {
            case: *Case::ALL.get(usize::from(flags & CASE))?,
            hit: is_hit.then_some(hit),
        };
        Some(Record {
            outline: (flags & IS_KNOWN != 0).then_some(outline),
            estimate: gaps[0],
            gap: gaps[1],
        })
    }
}

fn case_number(case: Case) -> u8 {
    let number = Case::ALL.iter().position(|other| *other == case);
    number.unwrap_or(0) as u8
}

#[cfg(test)]
mod tests {
    use super::*;
    use tunnelproof_reference::generate::FAMILIES;
    use tunnelproof_reference::oracle::decide_query;

    #[test]
    fn record_survives_its_bytes_for_every_kind_of_answer() {
        for (family, index) in FAMILIES.iter().flat_map(|f| (0..40).map(move |i| (f, i))) {
            let answer = decide_query(&family.query(1, index));
            let record = Record {
                outline: Some((&answer).into()),
                estimate: (index % 2 == 0).then_some(0.25),
                gap: (index % 3 == 0).then_some(0.0),
            };
            assert_eq!(Record::from_bytes(&record.to_bytes()), Some(record));
        }
        let empty = Record::default();
        assert_eq!(Record::from_bytes(&empty.to_bytes()), Some(empty));
    }

    #[test]
    fn record_refuses_bytes_that_are_never_written() {
        let mut bytes = Record::default().to_bytes();
        bytes[0] = IS_KNOWN | 7;
        assert_eq!(Record::from_bytes(&bytes), None);
        bytes[0] = IS_KNOWN | HIT;
        bytes[1..9].copy_from_slice(&2f64.to_le_bytes());
        assert_eq!(Record::from_bytes(&bytes), None);
    }
}
