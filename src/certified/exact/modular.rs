//! Polynomials modulo numbers of 64 bits: quick proofs that two of them have no common root, and
//! their greatest common divisor there.

use smallvec::SmallVec;

use super::integer::Integer;
use super::modulus::Modulus;
use super::poly::Poly;

/// Coefficients modulo a number, the constant one first; of degree up to 7 without allocation.
pub(super) type Residues = SmallVec<[u64; 8]>;

/// Whether two polynomials that are not 0 have no common factor; `false` where one prime does not
/// tell.
pub(super) fn are_coprime<const N: usize>(p: &Poly<N>, q: &Poly<N>) -> bool {
    are_coprime_modulo(Modulus::MERSENNE, p, q)
}

fn are_coprime_modulo<const N: usize>(modulus: Modulus, p: &Poly<N>, q: &Poly<N>) -> bool {
    let (p, q) = (residues(modulus, p), residues(modulus, q));
    greatest_divisor(modulus, p, q).is_some_and(|divisor| divisor.len() == 1)
}

/// The greatest common divisor, with leading coefficient 1, of two polynomials that are not 0;
/// `None` where a leading coefficient on the way has no inverse.
///
/// Where all have one, so they have modulo each prime factor of the modulus, and the divisor is the
/// greatest one there. A common factor of the polynomials themselves keeps its degree, as their
/// leading coefficients are not 0 there, and divides both there too: the divisor has at least its
/// degree.
pub(super) fn greatest_divisor(
    modulus: Modulus,
    mut p: Residues,
    mut q: Residues,
) -> Option<Residues> {
    modulus.inverse(*p.last()?)?;
    // Euclid's algorithm. Ends: what is left of `p` is shorter than `q`.
    loop {
        let inverse = modulus.inverse(*q.last()?)?;
        for own in &mut q {
            *own = modulus.times(*own, inverse);
        }
        // Ends: the leading coefficient becomes 0 and is trimmed.
        while p.len() >= q.len() {
            let factor = p[p.len() - 1];
            let shift = p.len() - q.len();
            for (own, other) in p[shift..].iter_mut().zip(&q) {
                *own = modulus.minus(*own, modulus.times(factor, *other));
            }
            trim(&mut p);
        }
        if p.is_empty() {
            return Some(q);
        }
        std::mem::swap(&mut p, &mut q);
    }
}

/// The coefficients modulo a number.
pub(super) fn residues<const N: usize>(modulus: Modulus, p: &Poly<N>) -> Residues {
    let coefficients = p.coefficients().iter();
    coefficients.map(|c| residue(modulus, c)).collect()
}

/// An integer modulo a number.
pub(super) fn residue(modulus: Modulus, integer: &Integer) -> u64 {
    let magnitude = modulus.residue(integer.limbs());
    if integer.sign().is_lt() {
        modulus.minus(0, magnitude)
    } else {
        magnitude
    }
}

fn trim(p: &mut Residues) {
    let length = p.iter().rposition(|&c| c != 0).map_or(0, |at| at + 1);
    p.truncate(length);
}

#[cfg(test)]
pub(super) mod tests;
