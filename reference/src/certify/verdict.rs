//! What one answer is worth, against the exact one.

use tunnelproof::contact::{Case, EdgePlace, EdgePoint, FacePlace, Hit, Place};

use crate::answer::{Enclosure, ExactAnswer, ExactHit, Parameters};
use crate::subject::{Answer, Said};

/// Hit and miss, right or wrong.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Verdict {
    /// A hit where there is one, or a miss where there is none.
    Right,
    /// A miss, but the edges swap sides: they get through each other unnoticed.
    Tunnel,
    /// A miss, but the edges touch, without swapping sides.
    MissedGraze,
    /// A hit, but the edges never touch.
    FalseHit,
    /// A false hit with a gap within the distance that the subject declares of itself.
    NearHit,
    /// No answer to a query that can be answered, or numbers that mean nothing.
    NoAnswer,
}

/// How an answer compares with the exact one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Judgement {
    /// Hit and miss.
    pub verdict: Verdict,
    /// Whether the subject reports a hit.
    pub is_hit: bool,
    /// Whether the subject states a case and it is not the exact one.
    pub wrong_case: bool,
    /// For an exact subject: whether the answer is not the exact one in every field. For the
    /// certified path: whether it is wrong in anything that it promises.
    pub differs: bool,
    /// How much later than the exact time of impact, at most; 0 if it is not later. Of bounds, how
    /// much later the lower one is.
    pub late: f64,
    /// How much earlier than the exact time of impact, at most; 0 if it is not earlier. Of bounds,
    /// how much earlier the upper one is.
    pub early: f64,
}

impl Verdict {
    /// The word used in tables and files.
    pub fn name(self) -> &'static str {
        match self {
            Verdict::Right => "right",
            Verdict::Tunnel => "tunnel",
            Verdict::MissedGraze => "missed graze",
            Verdict::FalseHit => "false hit",
            Verdict::NearHit => "near hit",
            Verdict::NoAnswer => "no answer",
        }
    }
}

impl Judgement {
    const NO_ANSWER: Judgement = Judgement {
        verdict: Verdict::NoAnswer,
        is_hit: false,
        wrong_case: false,
        differs: false,
        late: 0.0,
        early: 0.0,
    };

    /// Whether the subject reports a miss; no answer is none.
    pub fn is_miss(&self) -> bool {
        !self.is_hit && self.verdict != Verdict::NoAnswer
    }
}

/// What of an exact answer the verdicts depend on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outline {
    /// The case of the motion.
    pub case: Case,
    /// The first contact; `None` for a miss.
    pub hit: Option<OutlineHit>,
}

/// What of the first contact the verdicts depend on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OutlineHit {
    /// Time of impact.
    pub toi: Enclosure,
    /// Whether any contact of the step is a crossing.
    pub crosses: bool,
    /// How far the time and the place of the contact are from the ends of the step and of the
    /// edges: 0 if each is at an end, 1 if each is in the middle.
    pub centrality: f64,
}

impl From<&ExactAnswer> for Outline {
    fn from(answer: &ExactAnswer) -> Self {
        Outline {
            case: answer.case,
            hit: answer.hit.as_ref().map(|hit| OutlineHit {
                toi: hit.toi,
                crosses: hit.crosses,
                centrality: centrality(hit),
            }),
        }
    }
}

fn centrality(hit: &ExactHit) -> f64 {
    let from_ends = |number: Enclosure| number.below.min(1.0 - number.above);
    let sum = [hit.toi, hit.first.u, hit.first.v]
        .map(from_ends)
        .iter()
        .sum::<f64>();
    sum * 2.0 / 3.0
}

/// Compares an answer, `None` for no answer, with the exact one.
///
/// `is_near` decides whether the gap of a false hit is within the distance that the subject
/// declares; it is asked for false hits alone, since it is dear.
pub fn judge(
    truth: &ExactAnswer,
    answer: Option<&Answer>,
    is_near: impl FnOnce() -> bool,
) -> Judgement {
    let Some(answer) = answer else {
        return Judgement::NO_ANSWER;
    };
    let said = Said {
        toi: answer.toi(),
        case: answer.case(),
    };
    Judgement {
        differs: match answer {
            Answer::Exact(exact) => exact != truth,
            Answer::Certified(hit) => !keeps_promise(hit.as_ref(), truth),
            Answer::Engine(_) | Answer::Said(_) => false,
        },
        ..judge_outline(&truth.into(), &said, is_near)
    }
}

/// Compares what a subject says with the exact answer, as [`judge`]; that an exact subject differs
/// is not seen here.
pub fn judge_outline(truth: &Outline, said: &Said, is_near: impl FnOnce() -> bool) -> Judgement {
    let &Said { toi, case } = said;
    if !toi.is_none_or(is_time_of_step) {
        return Judgement::NO_ANSWER;
    }
    let (late, early) = match (toi, truth.hit) {
        (Some(toi), Some(hit)) => lateness(toi, hit.toi),
        _ => (0.0, 0.0),
    };
    Judgement {
        verdict: match (toi, truth.hit) {
            (None, None) | (Some(_), Some(_)) => Verdict::Right,
            (None, Some(OutlineHit { crosses: true, .. })) => Verdict::Tunnel,
            (None, Some(_)) => Verdict::MissedGraze,
            (Some(_), None) if is_near() => Verdict::NearHit,
            (Some(_), None) => Verdict::FalseHit,
        },
        is_hit: toi.is_some(),
        wrong_case: case.is_some_and(|case| case != truth.case),
        differs: false,
        late,
        early,
    }
}

/// Whether the certified path is right in all that it promises: everything exact, the place within
/// its stated error.
fn keeps_promise(hit: Option<&Hit<Place>>, truth: &ExactAnswer) -> bool {
    let (Some(hit), Some(exact)) = (hit, &truth.hit) else {
        return hit.is_none() && truth.hit.is_none();
    };
    let toi = Enclosure {
        below: hit.toi,
        above: hit.toi_above,
    };
    (toi, hit.kind, hit.side, hit.flags, hit.case)
        == (exact.toi, exact.kind, exact.side, exact.flags, truth.case)
        && is_at(&hit.place, exact)
}

/// Whether a place is that of the exact contact, within its stated error.
fn is_at(place: &Place, exact: &ExactHit) -> bool {
    let is_near = |value: f64, exact: Enclosure, error: f64| {
        value >= exact.below - error && value <= exact.above + error
    };
    match place {
        Place::Edges(EdgePlace {
            first,
            second,
            error,
        }) => {
            let agree = |ours: &EdgePoint, exact: &Parameters| {
                is_near(ours.u, exact.u, *error) && is_near(ours.v, exact.v, *error)
            };
            let seconds_agree = match (second, &exact.second) {
                (None, None) => true,
                (Some(ours), Some(exact)) => agree(ours, exact),
                _ => false,
            };
            agree(first, &exact.first) && seconds_agree
        }
        Place::Face(FacePlace { weights, error }) => {
            let [_, c, d] = *weights;
            let Parameters { u, v } = exact.first;
            is_near(c, u, *error) && is_near(d, v, *error) && exact.second.is_none()
        }
    }
}

/// Whether a time of impact is a time of the step.
fn is_time_of_step(toi: Enclosure) -> bool {
    let step = 0.0..=1.0;
    step.contains(&toi.below) && step.contains(&toi.above)
}

/// How much later and how much earlier a time is than the exact one; both 0 if that is between the
/// bounds which are claimed, however far these are apart.
///
/// The lower bound is compared with the exact time rounded down, the upper one with it rounded up.
/// Differences are correctly rounded.
fn lateness(claimed: Enclosure, exact: Enclosure) -> (f64, f64) {
    let late = claimed.below - exact.below;
    let early = exact.above - claimed.above;
    (late.max(0.0), early.max(0.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lateness_of_bounds_around_the_exact_time_is_none_however_wide_they_are() {
        let third = Enclosure {
            below: 1.0_f64 / 3.0,
            above: (1.0_f64 / 3.0).next_up(),
        };
        let Enclosure { below, above } = third;
        let ulp = above - below;
        for exact in [third, Enclosure::exactly(below)] {
            for (below, above) in [
                (exact.below, exact.above),
                (exact.below.next_down(), exact.above.next_up()),
                (exact.below, exact.above.next_up()),
                (0.0, 1.0),
            ] {
                let claimed = Enclosure { below, above };
                assert_eq!(lateness(claimed, exact), (0.0, 0.0), "{claimed:?}");
            }
        }
        for (claimed, expected) in [
            // One number, rounded down and rounded up.
            (Enclosure::exactly(below), (0.0, ulp)),
            (Enclosure::exactly(above), (ulp, 0.0)),
            // Bounds beyond the exact time on either side.
            (
                Enclosure {
                    below: above,
                    above: 1.0,
                },
                (ulp, 0.0),
            ),
            (
                Enclosure {
                    below: 0.0,
                    above: below,
                },
                (0.0, ulp),
            ),
        ] {
            assert_eq!(lateness(claimed, third), expected, "{claimed:?}");
        }
    }
}
