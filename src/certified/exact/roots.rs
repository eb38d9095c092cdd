//! The times at which a polynomial of the motion is 0.
//!
//! One sign change of the Bernstein coefficients means one root, a simple one. More of them are
//! isolated in floating point ([`super::isolate_f64`]), or exactly: by values of alternating signs
//! between them, or by halving ([`super::isolate_bisect`]). The rest is left to [`super::isolate`].

use std::borrow::{Borrow, BorrowMut};
use std::cell::OnceCell;
use std::cmp::Ordering;

use smallvec::SmallVec;

use super::bracket::Bracket;
use super::curve::Curve;
use super::dyadic::Dyadic;
use super::estimate;
use super::fraction::Fraction;
use super::grid_time::GridTime;
use super::isolate::Isolated;
use super::isolate_bisect::isolate_bisect;
use super::isolate_f64::{Interval, isolate_f64};
use super::motion::Quadratic;
use super::poly::Poly;
use super::time::Time;
use super::width::{Number, Width};

/// The distinct roots in `[0, 1]` of a polynomial that is not identically 0, in ascending order.
pub(super) struct Roots<L: Width> {
    /// The polynomial, or its derivative in place of one with a double root.
    curve: Option<Curve<L>>,
    cells: SmallVec<[Cell; 4]>,
    isolated: Option<L::Isolated>,
    /// The polynomial in integers of any size, once it is needed.
    poly: OnceCell<L::Poly>,
}

/// A root and the signs of the polynomial around it.
struct Cell {
    place: Place,
    before: Ordering,
    after: Ordering,
}

/// Where a root is.
enum Place {
    Start,
    End,
    /// The only root of the curve strictly between these times, a simple one, and the sign of the
    /// curve before it; `None` is the start or the end of the step.
    Between(Option<GridTime>, Option<GridTime>, Ordering),
    /// The isolated root with this index.
    Isolated(usize),
}

impl<L: Width> Roots<L> {
    /// A place for roots; to find them there is cheaper than to move them there.
    #[inline]
    pub(super) fn none() -> Self {
        Roots {
            curve: None,
            cells: SmallVec::new(),
            isolated: None,
            poly: OnceCell::new(),
        }
    }

    /// Puts the roots of a polynomial into an empty place.
    pub(super) fn find(&mut self, curve: Curve<L>) {
        let signs = curve.bernstein_signs();
        let curve = self.curve.insert(curve);
        let mut others = signs.iter().copied().filter(|sign| sign.is_ne());
        // Just after the start.
        let Some(first) = others.next() else {
            return;
        };
        let (mut last, mut changes) = (first, 0);
        for sign in others {
            changes += u32::from(sign != last);
            last = sign;
        }
        if changes == 2 {
            match curve.discriminant_sign() {
                Some(Ordering::Less) => changes = 0,
                Some(Ordering::Equal) => {
                    // The double root is the root of the derivative, which is -first before it.
                    self.curve = curve.derivative();
                    let place = Place::Between(None, None, first.reverse());
                    return self.push(place, first, first);
                }
                Some(Ordering::Greater) | None => {}
            }
        }
        let Some(inside) = intervals(curve, first, changes) else {
            return self.isolate();
        };
        if signs[0].is_eq() {
            self.push(Place::Start, Ordering::Equal, first);
        }
        let mut sign = first;
        for (low, high) in inside {
            let place = Place::Between(low, high, sign);
            self.push(place, sign, sign.reverse());
            sign = sign.reverse();
        }
        if signs.last().is_some_and(|sign| sign.is_eq()) {
            self.push(Place::End, sign, Ordering::Equal);
        }
    }

    /// Takes the roots from [`Isolated`], on the grid where that is possible.
    #[inline(never)]
    fn isolate(&mut self) {
        let Some(curve) = &self.curve else {
            return;
        };
        self.isolated = Some(place_for_isolated::<L>());
        let Some(isolated) = &mut self.isolated else {
            return;
        };
        let isolated: &mut Isolated = isolated.borrow_mut();
        isolated.find(curve.to_poly());
        for (index, cell) in isolated.cells().iter().enumerate() {
            let proved = |at: &Option<GridTime>, sign: Ordering| {
                at.is_none_or(|at| curve.sample(at).0 == sign)
            };
            let place = match isolated.interval(cell) {
                Some((low, high)) if proved(&low, cell.before) && proved(&high, cell.after) => {
                    Place::Between(low, high, cell.before)
                }
                _ => Place::Isolated(index),
            };
            self.cells.push(Cell {
                place,
                before: cell.before,
                after: cell.after,
            });
        }
    }

    fn push(&mut self, place: Place, before: Ordering, after: Ordering) {
        self.cells.push(Cell {
            place,
            before,
            after,
        });
    }

    /// The roots, each with the sign of the polynomial just before it (equal to 0 at the start of
    /// the step) and just after it (equal to 0 at the end).
    pub(super) fn iter(&self) -> impl Iterator<Item = (Time<'_, L>, Ordering, Ordering)> {
        self.cells.iter().filter_map(|cell| {
            let time = match cell.place {
                Place::Start => Time::start(),
                Place::End => Time::end(),
                Place::Between(low, high, before) => {
                    let of = Source::new(self.curve.as_ref()?, &self.poly);
                    Time::of_root(of, before, low, high)
                }
                Place::Isolated(index) => {
                    Time::of_isolated(self.isolated.as_ref()?.borrow(), index)
                }
            };
            Some((time, cell.before, cell.after))
        })
    }
}

/// A place for isolated roots. A function by itself, so that the stack does not hold a second one.
#[inline(never)]
fn place_for_isolated<L: Width>() -> L::Isolated {
    Isolated::none().into()
}

/// A polynomial of which a time is a root.
pub(super) struct Source<'a, L: Width> {
    pub(super) curve: &'a Curve<L>,
    /// The same in integers of any size, once it is needed.
    poly: &'a OnceCell<L::Poly>,
}

impl<L: Width> Clone for Source<'_, L> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<L: Width> Copy for Source<'_, L> {}

impl<'a, L: Width> Source<'a, L> {
    /// A polynomial, with a place for the same in integers of any size.
    pub(super) fn new(curve: &'a Curve<L>, poly: &'a OnceCell<L::Poly>) -> Self {
        Source { curve, poly }
    }

    /// The polynomial in integers of any size.
    pub(super) fn poly(self) -> &'a Poly {
        let poly = self.poly.get_or_init(|| self.curve.to_poly().into());
        poly.borrow()
    }

    /// The root between two times (`None` is the start or the end of the step), in integers of any
    /// size.
    pub(super) fn unproved(
        self,
        before: Ordering,
        low: Option<GridTime>,
        high: Option<GridTime>,
    ) -> Bracket<'a> {
        let low = low.map_or(Dyadic::zero(), GridTime::to_dyadic);
        let high = high.map_or(Dyadic::one(), GridTime::to_dyadic);
        Bracket::new(self.poly(), low, high, before)
    }

    /// The same between two times neither of which is a root.
    pub(super) fn bracket(self, before: Ordering, low: GridTime, high: GridTime) -> Bracket<'a> {
        Bracket::proved(self.poly(), low.to_dyadic(), high.to_dyadic(), before)
    }

    /// Whether `q` is a multiple of the polynomial, which has degree 2.
    pub(super) fn is_multiple(self, q: &Quadratic<L>) -> bool {
        match self.curve {
            Curve::Quadratic(c) => are_multiples::<L>(c, q),
            Curve::Cubic(_) => false,
        }
    }
}

/// Intervals around each of the roots strictly inside the step, given the sign just after the start
/// and the number of sign changes of the Bernstein coefficients; `None` where it is not plain.
fn intervals<L: Width>(
    curve: &Curve<L>,
    first: Ordering,
    changes: u32,
) -> Option<SmallVec<[Interval; 3]>> {
    match changes {
        0 => return Some(SmallVec::new()),
        1 => return Some(SmallVec::from_iter([(None, None)])),
        _ => {}
    }
    let coefficients = curve.approximate();
    let plain =
        isolate_f64(&coefficients).or_else(|| cut_between(curve, first, changes, &coefficients));
    plain.or_else(|| match curve {
        Curve::Quadratic(_) => None,
        Curve::Cubic(c) => {
            // A multiple root is never isolated.
            let multiple = estimate::multiple_roots(&coefficients).map(Fraction::near);
            let is_multiple = multiple.into_iter().flatten().any(|at| curve.is_root(at));
            if is_multiple {
                None
            } else {
                isolate_bisect::<L>(c)
            }
        }
    })
}

/// Intervals around as many roots as there are sign changes, two or three, cut at the turning
/// points between them, if a estimate finds these: with alternating signs there, every interval has
/// a root, and there are no more.
fn cut_between<L: Width>(
    curve: &Curve<L>,
    first: Ordering,
    changes: u32,
    coefficients: &[f64; 4],
) -> Option<SmallVec<[Interval; 3]>> {
    let cuts: SmallVec<[f64; 2]> = if changes == 2 {
        SmallVec::from_iter([estimate::turning_point(coefficients, first)?])
    } else {
        let [s, t] = estimate::turning_points(coefficients);
        SmallVec::from_buf([s.min(t), s.max(t)])
    };
    let mut found = SmallVec::new();
    let (mut low, mut sign) = (None, first);
    for cut in cuts {
        let cut = GridTime::from_f64(cut)?;
        sign = sign.reverse();
        if curve.sample(cut).0 != sign {
            return None;
        }
        found.push((low, Some(cut)));
        low = Some(cut);
    }
    found.push((low, None));
    Some(found)
}

/// Whether two polynomials that are not identically 0 are multiples of each other.
fn are_multiples<L: Width>(p: &Quadratic<L>, q: &Quadratic<L>) -> bool {
    [(0, 1), (0, 2), (1, 2)].into_iter().all(|(i, j)| {
        let (a, b) = (
            L::times_quadratics(&p[i], &q[j]),
            L::times_quadratics(&p[j], &q[i]),
        );
        a.sub(&b).is_zero()
    })
}
