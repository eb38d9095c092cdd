//! The sign of a polynomial at a root of another one, exactly and without iteration.
//!
//! By Sturm's theorem for rational functions (Basu, Pollack, Roy, "Algorithms in Real Algebraic
//! Geometry", theorem 2.58): let `p, q, -rem(p, q), ...` be the signed remainder sequence, and
//! `V(t)` the number of sign changes in it at `t`, zeros left out. If `p(a)` and `p(b)` are not 0,
//! `V(a) - V(b)` is the Cauchy index of `q / p` on `(a, b)`: the number of its jumps from minus to
//! plus infinity less the number of jumps the other way. If `p` has one root in `(a, b)` and that
//! is simple, there is one jump, of the sign of `p'(root) q(root)`, or none if `q(root) = 0`. The
//! sign of `p'(root)` is that of `p(b)`, so that the index tells the sign of `q(root)`, 0 included.
//!
//! Remainders may be multiplied by positive numbers, so that they stay integers
//! ([`super::remainders`]). With `p` a cubic of `3b + 8` bits and `q` a quadratic of `2b + 6` bits,
//! the first remainder has `3b + 8 + 2 (2b + 7)` = `7b + 22` bits and the second
//! `2b + 6 + 2 (7b + 23)` = `16b + 52` bits.

use std::cmp::Ordering;

use super::dyadic::Dyadic;
use super::poly::Poly;
use super::remainders::Remainders;

/// The sign of `q` at the root of `p` between `low` and `high`.
///
/// It must be the only root of `p` there, a simple one; neither `low` nor `high` is a root.
/// `before` is the sign of `p` at `low`.
pub(super) fn sign_at_root<const N: usize>(
    p: &Poly<N>,
    q: Poly<N>,
    before: Ordering,
    low: &Dyadic,
    high: &Dyadic,
) -> Ordering {
    // At the root, q is a positive multiple of its remainder.
    let q = if q.degree() >= p.degree() {
        q.remainder(p)
    } else {
        q
    };
    if q.degree() == 0 {
        return q.coefficient(0).sign();
    }
    let mut last = (before, before.reverse());
    let mut index = 0;
    for poly in Remainders::new(p.clone(), q) {
        let signs = (poly.sign_at(low), poly.sign_at(high));
        index += change(&mut last.0, signs.0) - change(&mut last.1, signs.1);
    }
    if before.is_lt() {
        index.cmp(&0)
    } else {
        0.cmp(&index)
    }
}

/// 1 if a sign is the opposite of the last one that was not 0, else 0.
fn change(last: &mut Ordering, sign: Ordering) -> i32 {
    if sign.is_eq() {
        return 0;
    }
    let changes = *last != sign;
    *last = sign;
    i32::from(changes)
}

#[cfg(test)]
mod tests;
