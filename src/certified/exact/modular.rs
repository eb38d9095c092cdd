//! Polynomials modulo a prime: a quick proof that two of them have no common root.

use smallvec::SmallVec;

use super::integer::Integer;
use super::poly::Poly;

/// `2^61 - 1`.
const PRIME: u64 = (1 << 61) - 1;

/// Coefficients modulo the prime, the constant one first; of degree up to 7 without allocation.
type Residues = SmallVec<[u64; 8]>;

/// Whether two polynomials that are not 0 have no common factor; `false` where the prime does not
/// tell.
///
/// If the prime divides neither leading coefficient, a common factor has the same degree modulo the
/// prime, and divides both there too.
pub(super) fn are_coprime<const N: usize>(p: &Poly<N>, q: &Poly<N>) -> bool {
    let (mut p, mut q) = (residues(p), residues(q));
    let keep_degree = |r: &[u64]| r.last().is_some_and(|leading| *leading != 0);
    if !keep_degree(&p) || !keep_degree(&q) {
        return false;
    }
    // Euclid's algorithm. Ends: what is left of `p` is shorter than `q`.
    while q.len() > 1 {
        let inverse = power(q[q.len() - 1], PRIME - 2);
        // Ends: the leading coefficient becomes 0 and is trimmed.
        while p.len() >= q.len() {
            let factor = times(p[p.len() - 1], inverse);
            let shift = p.len() - q.len();
            for (own, other) in p[shift..].iter_mut().zip(&q) {
                *own = plus(*own, PRIME - times(factor, *other));
            }
            trim(&mut p);
        }
        std::mem::swap(&mut p, &mut q);
    }
    q.len() == 1
}

fn residues<const N: usize>(p: &Poly<N>) -> Residues {
    let coefficients = p.coefficients().iter();
    coefficients.map(residue).collect()
}

fn residue(integer: &Integer) -> u64 {
    let magnitude = integer.residue(PRIME);
    if integer.sign().is_lt() {
        plus(0, PRIME - magnitude)
    } else {
        magnitude
    }
}

fn trim(p: &mut Residues) {
    let length = p.iter().rposition(|&c| c != 0).map_or(0, |at| at + 1);
    p.truncate(length);
}

fn plus(a: u64, b: u64) -> u64 {
    (a + b) % PRIME
}

fn times(a: u64, b: u64) -> u64 {
    (u128::from(a) * u128::from(b) % u128::from(PRIME)) as u64
}

fn power(mut base: u64, mut exponent: u64) -> u64 {
    let mut power = 1;
    // Ends: after 64 turns at most.
    while exponent > 0 {
        if exponent & 1 == 1 {
            power = times(power, base);
        }
        base = times(base, base);
        exponent >>= 1;
    }
    power
}

#[cfg(test)]
mod tests;
