//! The stages of the cascade, and what a stage says of a query.

/// The stage of the cascade that decided a query.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[non_exhaustive]
pub enum Stage {
    /// The swept boxes are disjoint.
    Boxes,
    /// A direction separates the two sides for the whole step.
    Direction,
    /// The Bernstein coefficients of the cubic have one sign.
    Signs,
    /// The roots of the cubic, bounded in `f64`.
    Roots,
    /// A separating direction, found by search.
    Search,
    /// With a radius: planes that separate, each for a part of the step, up to its end or the
    /// contact.
    Planes,
    /// Integers.
    Exact,
}

impl Stage {
    /// Every stage, in the order in which they are tried.
    pub const ALL: [Stage; 7] = [
        Stage::Boxes,
        Stage::Direction,
        Stage::Signs,
        Stage::Roots,
        Stage::Search,
        Stage::Planes,
        Stage::Exact,
    ];

    /// The name used in tables.
    pub fn name(self) -> &'static str {
        match self {
            Stage::Boxes => "boxes",
            Stage::Direction => "direction",
            Stage::Signs => "signs",
            Stage::Roots => "roots",
            Stage::Search => "search",
            Stage::Planes => "planes",
            Stage::Exact => "exact",
        }
    }
}

/// What a stage has proved of a query.
#[derive(Clone, Copy, Debug)]
pub(super) enum Finding<H> {
    /// The two sides touch.
    Hit(H),
    /// They do not touch.
    Miss,
    /// Neither is proved.
    Undecided,
}

impl<H> Finding<H> {
    /// What follows from the hit, if it is one.
    pub(super) fn and_then<T>(self, next: impl FnOnce(H) -> Finding<T>) -> Finding<T> {
        match self {
            Finding::Hit(hit) => next(hit),
            Finding::Miss => Finding::Miss,
            Finding::Undecided => Finding::Undecided,
        }
    }

    /// The same with another form of the hit.
    pub(super) fn map<T>(self, form: impl FnOnce(H) -> T) -> Finding<T> {
        self.and_then(|hit| Finding::Hit(form(hit)))
    }

    /// The hit or the miss that is proved.
    pub(super) fn decided(self) -> Option<Option<H>> {
        match self {
            Finding::Hit(hit) => Some(Some(hit)),
            Finding::Miss => Some(None),
            Finding::Undecided => None,
        }
    }

    /// A hit if it is certain.
    pub(super) fn of_certain(hit: Option<H>) -> Self {
        hit.map_or(Finding::Undecided, Finding::Hit)
    }
}
