//! The roots in `[0, 1]` of a polynomial of degree at most 3, each by itself in an interval.
//!
//! By Descartes' rule of signs the number of roots in `(0, 1)`, with multiplicity, is the number of
//! sign changes of the Bernstein coefficients or less by an even number. With more than one sign
//! change the discriminant says what follows:
//!
//! - 0: there is a double or a triple root. Then all roots are rational, and their linear factors
//!   are written down from the coefficients.
//! - below 0: there is one real root of a cubic, none of a quadratic; the parity of the sign
//!   changes tells whether it is in `(0, 1)`.
//! - above 0: all roots are real and simple, and halving the interval parts them in the end (two
//!   circles theorem). The sign changes of both halves together are not more than those of the
//!   whole, so that only one half at a time can still have more than one.

use std::cmp::Ordering;

use smallvec::SmallVec;

use super::bernstein::{Piece, bernstein, changes, first_sign};
use super::dyadic::Dyadic;
use super::grid_time::GridTime;
use super::integer::Integer;
use super::isolate_f64::Interval;
use super::poly::Poly;
use super::two_roots::{Found, two_or_none};

/// The distinct roots in `[0, 1]` of a polynomial, in ascending order.
#[derive(Debug)]
pub(super) struct Isolated {
    /// The polynomial, and where it has a multiple root the linear factors of both of its roots.
    polys: SmallVec<[Poly; 3]>,
    cells: SmallVec<[Cell; 3]>,
}

/// A root and the signs of the polynomial around it.
#[derive(Debug)]
pub(super) struct Cell {
    pub(super) place: Place,
    /// The sign of the polynomial just before the root; equal to 0 where the root is 0.
    pub(super) before: Ordering,
    /// The sign of the polynomial just after the root; equal to 0 where the root is 1.
    pub(super) after: Ordering,
}

/// Where a root is.
#[derive(Debug)]
pub(super) enum Place {
    /// It is this number.
    At(Dyadic),
    /// It is the only root strictly between these numbers of the polynomial with this index, and a
    /// simple one.
    Between {
        poly: usize,
        low: Dyadic,
        high: Dyadic,
        /// The sign of that polynomial just before the root.
        before: Ordering,
    },
}

/// The linear factors of the roots of a polynomial with a multiple root.
enum Factors {
    Triple(Poly),
    /// The double root, the other root if there is one, and whether the other one comes first.
    Double(Poly, Option<Poly>, bool),
}

impl Isolated {
    /// A place for roots; to find them there takes less of the stack than to move them there.
    pub(super) fn none() -> Self {
        Isolated {
            polys: SmallVec::new(),
            cells: SmallVec::new(),
        }
    }

    /// Puts the roots of a polynomial that is not identically 0 into an empty place.
    #[inline(never)]
    pub(super) fn find(&mut self, poly: Poly) {
        let bernstein = bernstein(&poly);
        // Just after 0; it is not 0 unless all coefficients are.
        let mut sign = first_sign(bernstein.iter());
        if bernstein[0].is_zero() {
            let place = Place::At(Dyadic::zero());
            self.push(place, Ordering::Equal, sign);
        }
        self.polys.push(poly);
        self.add_inside(&bernstein, &mut sign);
        if bernstein[self.polys[0].degree()].is_zero() {
            self.push(Place::At(Dyadic::one()), sign, Ordering::Equal);
        }
    }

    /// The roots.
    pub(super) fn cells(&self) -> &[Cell] {
        &self.cells
    }

    /// The interval of a simple root of the polynomial itself, if it is on the grid.
    pub(super) fn interval(&self, cell: &Cell) -> Option<Interval> {
        match &cell.place {
            Place::Between {
                poly: 0, low, high, ..
            } => {
                let end = |at| GridTime::from_dyadic(at).ok();
                Some((end(low)?, end(high)?))
            }
            _ => None,
        }
    }

    /// The polynomial that a [`Place`] names.
    pub(super) fn poly(&self, index: usize) -> &Poly {
        &self.polys[index]
    }

    fn push(&mut self, place: Place, before: Ordering, after: Ordering) {
        self.cells.push(Cell {
            place,
            before,
            after,
        });
    }

    /// Adds the roots strictly between 0 and 1. `sign` is the polynomial's sign just before them
    /// and becomes the one just after them.
    #[inline(never)]
    fn add_inside(&mut self, bernstein: &[Integer], sign: &mut Ordering) {
        let changes = changes(bernstein);
        if changes == 0 {
            return;
        }
        if changes > 1 {
            let hessian = Hessian::new(&self.polys[0]);
            match hessian.discriminant_sign() {
                Ordering::Equal => return self.add_factors(hessian.factors(&self.polys[0]), sign),
                Ordering::Less if changes == 2 => return,
                Ordering::Less => {}
                Ordering::Greater => return self.add_by_halving(bernstein, sign),
            }
        }
        self.add_between(unit(), *sign);
        *sign = sign.reverse();
    }

    /// Adds a simple root of the polynomial, which has the sign `before` just before it.
    fn add_between(&mut self, (low, high): (Dyadic, Dyadic), before: Ordering) {
        self.push(
            Place::Between {
                poly: 0,
                low,
                high,
                before,
            },
            before,
            before.reverse(),
        );
    }

    // Functions by themselves, so that the stack holds what only one of them needs at a time.
    #[inline(never)]
    fn add_factors(&mut self, factors: Factors, sign: &mut Ordering) {
        match factors {
            Factors::Triple(linear) => self.add_linear(linear, true, sign),
            Factors::Double(double, None, _) => self.add_linear(double, false, sign),
            Factors::Double(double, Some(other), true) => {
                self.add_linear(other, true, sign);
                self.add_linear(double, false, sign);
            }
            Factors::Double(double, Some(other), false) => {
                self.add_linear(double, false, sign);
                self.add_linear(other, true, sign);
            }
        }
    }

    /// Adds the root of a linear factor, if it is strictly between 0 and 1. `is_odd` says whether
    /// the polynomial changes its sign there.
    fn add_linear(&mut self, linear: Poly, is_odd: bool, sign: &mut Ordering) {
        let (at_start, at_end) = (
            linear.coefficient(0),
            Integer::sum(linear.coefficient(0), linear.coefficient(1)),
        );
        if at_start.sign().is_eq() || at_start.sign() != at_end.sign().reverse() {
            return;
        }
        let (low, high) = unit();
        let after = if is_odd { sign.reverse() } else { *sign };
        let place = Place::Between {
            poly: self.polys.len(),
            low,
            high,
            before: at_start.sign(),
        };
        self.push(place, *sign, after);
        self.polys.push(linear);
        *sign = after;
    }

    /// Adds all roots in `(0, 1)`, which are simple, by halving.
    #[inline(never)]
    fn add_by_halving(&mut self, bernstein: &[Integer], sign: &mut Ordering) {
        let mut current = Piece::unit(bernstein);
        let mut later: SmallVec<[Found; 3]> = SmallVec::new();
        // Ends: the roots are simple, by the discriminant, so that they part (two circles theorem);
        // all of it in integers.
        loop {
            if current.depth() >= MOST_HALVINGS && current.changes() == 2 && current.turns() == 1 {
                let poly = &self.polys[0];
                for found in two_or_none(poly, &poly.derivative(), &current) {
                    self.add_found(found, sign);
                }
                break;
            }
            current.zoom();
            let (left, right) = current.halves();
            let middle = right.starts_at_root().then(|| right.low());
            let (in_left, in_right) = (left.changes(), right.changes());
            if in_right == 1 {
                later.push(Found::Between(right.ends()));
            }
            if in_right < 2 {
                later.extend(middle.map(Found::At));
                if in_left == 1 {
                    later.push(Found::Between(left.ends()));
                }
                if in_left < 2 {
                    break;
                }
                current = left;
            } else {
                if in_left == 1 {
                    self.add_found(Found::Between(left.ends()), sign);
                }
                if let Some(middle) = middle {
                    self.add_found(Found::At(middle), sign);
                }
                current = right;
            }
        }
        for found in later.into_iter().rev() {
            self.add_found(found, sign);
        }
    }

    fn add_found(&mut self, found: Found, sign: &mut Ordering) {
        match found {
            Found::At(at) => self.push(Place::At(at), *sign, sign.reverse()),
            Found::Between(ends) => self.add_between(ends, *sign),
        }
        *sign = sign.reverse();
    }
}

/// How often the step is halved before two roots are parted by the turning point between them.
const MOST_HALVINGS: u64 = 128;

/// The interval from 0 to 1.
fn unit() -> (Dyadic, Dyadic) {
    (Dyadic::zero(), Dyadic::one())
}

/// The Hessian covariant of `a t^3 + b t^2 + c t + d`: the quadratic `p t^2 + q t + r` with
/// `p = b^2 - 3ac`, `q = bc - 9ad`, `r = c^2 - 3bd`. Its discriminant is -3 times that of the
/// cubic, and a double root of the cubic is a double root of it. With `a = 0` it still says all of
/// this of the quadratic, times `b^2`.
struct Hessian {
    p: Integer,
    q: Integer,
    r: Integer,
}

impl Hessian {
    #[inline(never)]
    fn new(poly: &Poly) -> Self {
        let [d, c, b, a] = [0, 1, 2, 3].map(|i| poly.coefficient(i));
        let minor = |x: &Integer, y: &Integer, factor: i64, z: &Integer, w: &Integer| {
            Integer::difference(
                &Integer::product(x, y),
                &Integer::product(z, w).times(factor),
            )
        };
        Hessian {
            p: minor(b, b, 3, a, c),
            q: minor(b, c, 9, a, d),
            r: minor(c, c, 3, b, d),
        }
    }

    /// The sign of the discriminant of the cubic, `(4pr - q^2) / 3`.
    #[inline(never)]
    fn discriminant_sign(&self) -> Ordering {
        Integer::product(&self.p, &self.r)
            .shifted(2)
            .cmp(&Integer::product(&self.q, &self.q))
    }

    /// The factors of a cubic or quadratic with discriminant 0.
    #[inline(never)]
    fn factors(&self, poly: &Poly) -> Factors {
        let [d, c, b, a] = [0, 1, 2, 3].map(|i| poly.coefficient(i));
        if self.p.is_zero() {
            return Factors::Triple(Poly::new(&[b.clone(), a.times(3)]));
        }
        let double = Poly::new(&[self.q.clone(), self.p.shifted(1)]);
        if a.is_zero() {
            return Factors::Double(double, None, false);
        }
        // The other root is (4abc - 9 a^2 d - b^3) / (ap), and it is above the double root by
        // (9abc - 27 a^2 d - 2b^3) / (2ap), where p > 0.
        let abc = Integer::product(&Integer::product(a, b), c);
        let aad = Integer::product(&Integer::product(a, a), d);
        let bbb = Integer::product(&Integer::product(b, b), b);
        let combine = |abc_by: i64, aad_by: i64, bbb_by: i64| {
            let mut sum = abc.times(abc_by);
            sum.sub_shifted(&aad.times(aad_by), 0);
            sum.sub_shifted(&bbb.times(bbb_by), 0);
            sum
        };
        let mut root = combine(4, 9, 1);
        root.negate();
        let other = Poly::new(&[root, Integer::product(a, &self.p)]);
        let other_is_below = combine(9, 27, 2).sign() == a.sign().reverse();
        Factors::Double(double, Some(other), other_is_below)
    }
}

#[cfg(test)]
pub(super) mod tests;
