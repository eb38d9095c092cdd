//! Where the published text is wrong, as data.
//!
//! A **slip** contradicts the text's own prose or names, which say what was meant. A **flaw** is
//! meant as it is written, and wrong. `docs/errata.md` has a section for each.

use std::fmt;

/// An error in Algorithms 1 to 20.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Erratum {
    /// Algorithm 12 passes over an equation by another comparison than Algorithm 4.
    StrictSkip,
    /// Algorithm 13 takes an edge that is a point at the root for a line.
    CollapsedLine,
    /// Algorithm 16 mixes the ends of the two segments.
    OverlapArguments,
    /// Algorithm 16 solves a singular system for parallel segments on two lines.
    SingularSystem,
    /// Algorithm 17 passes an end point where a direction is due.
    SegmentDirection,
    /// Algorithm 17 leaves out the case that 3.1.3.2 describes.
    PermanentPointOnLine,
    /// Algorithm 18 passes points and directions in the wrong order.
    InitialArguments,
    /// Algorithm 20 gives no contact for an edge that is a point for the whole step.
    PointForWholeStep,
}

/// Whether the text contradicts itself.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ErratumKind {
    /// The text itself says elsewhere what was meant.
    Slip,
    /// The text is definite, and wrong.
    Flaw,
}

impl Erratum {
    /// Every erratum, in the order of the algorithms.
    pub const ALL: [Erratum; 8] = [
        Erratum::StrictSkip,
        Erratum::CollapsedLine,
        Erratum::OverlapArguments,
        Erratum::SingularSystem,
        Erratum::SegmentDirection,
        Erratum::PermanentPointOnLine,
        Erratum::InitialArguments,
        Erratum::PointForWholeStep,
    ];

    /// The name used in files and on the command line.
    pub const fn name(self) -> &'static str {
        match self {
            Erratum::StrictSkip => "strict-skip",
            Erratum::CollapsedLine => "collapsed-line",
            Erratum::OverlapArguments => "overlap-arguments",
            Erratum::SingularSystem => "singular-system",
            Erratum::SegmentDirection => "segment-direction",
            Erratum::PermanentPointOnLine => "permanent-point-on-line",
            Erratum::InitialArguments => "initial-arguments",
            Erratum::PointForWholeStep => "point-for-whole-step",
        }
    }

    /// The erratum with this [`name`](Self::name), if any.
    pub fn from_name(name: &str) -> Option<Self> {
        Erratum::ALL
            .into_iter()
            .find(|erratum| erratum.name() == name)
    }

    /// Slip or flaw.
    pub const fn kind(self) -> ErratumKind {
        match self {
            Erratum::OverlapArguments
            | Erratum::SingularSystem
            | Erratum::SegmentDirection
            | Erratum::PermanentPointOnLine
            | Erratum::InitialArguments => ErratumKind::Slip,
            Erratum::StrictSkip | Erratum::CollapsedLine | Erratum::PointForWholeStep => {
                ErratumKind::Flaw
            }
        }
    }

    /// The number of the algorithm that is wrong.
    pub const fn algorithm(self) -> u8 {
        match self {
            Erratum::StrictSkip => 12,
            Erratum::CollapsedLine => 13,
            Erratum::OverlapArguments | Erratum::SingularSystem => 16,
            Erratum::SegmentDirection | Erratum::PermanentPointOnLine => 17,
            Erratum::InitialArguments => 18,
            Erratum::PointForWholeStep => 20,
        }
    }

    /// What is wrong, in one sentence.
    pub const fn description(self) -> &'static str {
        match self {
            Erratum::StrictSkip => {
                "An equation is passed over if its coefficients are below the threshold, though \
                 Algorithm 4 takes one at the threshold for zero, so that with threshold 0 an \
                 equation 0 = 0 is solved."
            }
            Erratum::CollapsedLine => {
                "Where AB is a point at a root, CD is taken as the common line and A only projected \
                 on it, so that A beside CD counts as contact."
            }
            Erratum::OverlapArguments => {
                "Static overlap is asked of the segments from P to Q and from P+R to Q+S instead of \
                 those from P to P+R and from Q to Q+S."
            }
            Erratum::SingularSystem => {
                "Parallel segments on two lines go on to a 2x2 system that is singular, though \
                 3.1.3.1 says that they do not overlap."
            }
            Erratum::SegmentDirection => {
                "The end point P1 + V1 t is passed as the direction of the segment from P0 + V0 t."
            }
            Erratum::PermanentPointOnLine => {
                "The test for a point that is on the line for the whole step is missing, so that \
                 every equation is passed over and no root is found."
            }
            Erratum::InitialArguments => {
                "The segments at t = 0 are passed as P0, P1-P0, P2, P3-P2, though Algorithm 16 takes \
                 both points first and then both directions."
            }
            Erratum::PointForWholeStep => {
                "An edge that is a point for the whole step is answered with no contact, wherever \
                 the point goes."
            }
        }
    }
}

impl fmt::Display for Erratum {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// A set of errata: those that are repaired.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
pub struct Repairs(u8);

impl Repairs {
    /// None: the text to the letter.
    pub const NONE: Repairs = Repairs(0);

    /// Every slip, no flaw: the text as it was meant.
    pub const SLIPS: Repairs = {
        let mut repairs = Repairs::NONE;
        let mut index = 0;
        while index < Erratum::ALL.len() {
            if let ErratumKind::Slip = Erratum::ALL[index].kind() {
                repairs = repairs.with(Erratum::ALL[index]);
            }
            index += 1;
        }
        repairs
    };

    /// Every slip and every flaw.
    pub const ALL: Repairs = Repairs::SLIPS
        .with(Erratum::StrictSkip)
        .with(Erratum::CollapsedLine)
        .with(Erratum::PointForWholeStep);

    /// This set and `erratum`.
    pub const fn with(self, erratum: Erratum) -> Self {
        Repairs(self.0 | 1 << erratum as u8)
    }

    /// This set but `erratum`.
    pub const fn without(self, erratum: Erratum) -> Self {
        Repairs(self.0 & !(1 << erratum as u8))
    }

    /// Whether `erratum` is repaired.
    pub const fn contains(self, erratum: Erratum) -> bool {
        self.0 & 1 << erratum as u8 != 0
    }

    /// The errata that are repaired, in the order of [`Erratum::ALL`].
    pub fn iter(self) -> impl Iterator<Item = Erratum> {
        Erratum::ALL
            .into_iter()
            .filter(move |&erratum| self.contains(erratum))
    }
}

impl Default for Repairs {
    /// [`Repairs::SLIPS`].
    fn default() -> Self {
        Repairs::SLIPS
    }
}

impl fmt::Debug for Repairs {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_set().entries(self.iter()).finish()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn repairs_all_holds_every_erratum_and_none_holds_none() {
        assert!(Repairs::ALL.iter().eq(Erratum::ALL));
        assert_eq!(Repairs::NONE.iter().count(), 0);
    }

    #[test]
    fn repairs_slips_holds_exactly_the_slips() {
        for erratum in Erratum::ALL {
            assert_eq!(
                Repairs::SLIPS.contains(erratum),
                erratum.kind() == ErratumKind::Slip,
                "{erratum}"
            );
        }
        assert_eq!(Repairs::default(), Repairs::SLIPS);
    }

    #[test]
    fn repairs_with_and_without_change_one_erratum() {
        for erratum in Erratum::ALL {
            let only = Repairs::NONE.with(erratum);
            assert!(only.iter().eq([erratum]));
            let all_but = Repairs::ALL.without(erratum);
            assert_eq!(all_but.iter().count(), Erratum::ALL.len() - 1);
            assert!(!all_but.contains(erratum));
        }
    }

    #[test]
    fn erratum_from_name_finds_every_name_and_nothing_else() {
        for erratum in Erratum::ALL {
            assert_eq!(Erratum::from_name(erratum.name()), Some(erratum));
        }
        assert_eq!(Erratum::from_name("StrictSkip"), None);
    }
}
