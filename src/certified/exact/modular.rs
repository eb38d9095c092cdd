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
    are_coprime_modulo::<PRIME, N>(p, q)
}

/// The same by a prime below `2^62`.
fn are_coprime_modulo<const P: u64, const N: usize>(p: &Poly<N>, q: &Poly<N>) -> bool {
    let (mut p, mut q) = (residues::<P, N>(p), residues::<P, N>(q));
    let keep_degree = |r: &[u64]| r.last().is_some_and(|leading| *leading != 0);
    if !keep_degree(&p) || !keep_degree(&q) {
        return false;
    }
    // Euclid's algorithm. Ends: what is left of `p` is shorter than `q`.
    while q.len() > 1 {
        let inverse = power::<P>(q[q.len() - 1], P - 2);
        // Ends: the leading coefficient becomes 0 and is trimmed.
        while p.len() >= q.len() {
            let factor = times::<P>(p[p.len() - 1], inverse);
            let shift = p.len() - q.len();
            for (own, other) in p[shift..].iter_mut().zip(&q) {
                *own = plus::<P>(*own, P - times::<P>(factor, *other));
            }
            trim(&mut p);
        }
        std::mem::swap(&mut p, &mut q);
    }
    q.len() == 1
}

fn residues<const P: u64, const N: usize>(p: &Poly<N>) -> Residues {
    let coefficients = p.coefficients().iter();
    coefficients.map(residue::<P>).collect()
}

fn residue<const P: u64>(integer: &Integer) -> u64 {
    let magnitude = integer.residue(P);
    if integer.sign().is_lt() {
        plus::<P>(0, P - magnitude)
    } else {
        magnitude
    }
}

fn trim(p: &mut Residues) {
    let length = p.iter().rposition(|&c| c != 0).map_or(0, |at| at + 1);
    p.truncate(length);
}

fn plus<const P: u64>(a: u64, b: u64) -> u64 {
    (a + b) % P
}

fn times<const P: u64>(a: u64, b: u64) -> u64 {
    (u128::from(a) * u128::from(b) % u128::from(P)) as u64
}

fn power<const P: u64>(mut base: u64, mut exponent: u64) -> u64 {
    let mut power = 1;
    // Ends: after 64 turns at most.
    while exponent > 0 {
        if exponent & 1 == 1 {
            power = times::<P>(power, base);
        }
        base = times::<P>(base, base);
        exponent >>= 1;
    }
    power
}

#[cfg(test)]
mod tests;
