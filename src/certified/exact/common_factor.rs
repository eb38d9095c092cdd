//! What two polynomials have in common, and polynomials without their multiple roots.
//!
//! The greatest common divisor is the last of the [`Remainders`]; but their coefficients grow to
//! many times the length of the polynomials' own. So for long ones it is found modulo numbers of 62
//! bits (Brown, "On Euclid's algorithm and the computation of polynomial greatest common divisors",
//! 1971): times the leading coefficient of one polynomial it has integers as coefficients (Gauss's
//! lemma), and these follow from their residues by enough numbers without a common factor (the
//! Chinese remainder theorem). How many are enough need not be known beforehand. The degree modulo a
//! number is at least that of the greatest common divisor, so what divides both polynomials, and has
//! the degree found, is the greatest: to divide proves it. Primes are not needed: where Euclid's
//! algorithm meets a number without inverse, the next modulus is tried.

use smallvec::SmallVec;

use super::integer::Integer;
use super::modular::{Residues, are_coprime, greatest_divisor, residue, residues};
use super::modulus::Modulus;
use super::poly::Poly;
use super::remainders::Remainders;

/// From so many bits of the leading coefficient on, this is faster than remainders.
const LONG: u64 = 4096;

/// The greatest common divisor of two polynomials, and what is left of the first.
pub(super) struct Common<const N: usize> {
    /// A multiple of it.
    pub(super) divisor: Poly<N>,
    /// A multiple of the first polynomial divided by it.
    quotient: Poly<N>,
}

/// What two polynomials have in common, if they are long, and not 0.
pub(super) fn common_factor<const N: usize>(p: &Poly<N>, q: &Poly<N>) -> Option<Common<N>> {
    if q.is_zero() || p.coefficients().last()?.bits() < LONG {
        return None;
    }
    by_moduli(p, q, Modulus::below_2_62())
}

/// A multiple, of either sign, of the polynomial divided by its greatest common divisor with its
/// derivative: the same roots, each of them simple.
pub(super) fn square_free<const N: usize>(poly: Poly<N>) -> Poly<N> {
    let derivative = poly.derivative();
    if derivative.is_zero() || are_coprime(&poly, &derivative) {
        return poly;
    }
    match common_factor(&poly, &derivative) {
        Some(common) => common.quotient,
        None => by_remainders(poly, derivative),
    }
}

fn by_remainders<const N: usize>(poly: Poly<N>, derivative: Poly<N>) -> Poly<N> {
    match Remainders::new(poly.clone(), derivative).last() {
        Some(divisor) if divisor.degree() > 0 => poly.quotient(&divisor),
        _ => poly,
    }
}

/// What they have in common, by these moduli; `None` if they are too few.
fn by_moduli<const N: usize>(
    p: &Poly<N>,
    q: &Poly<N>,
    moduli: impl Iterator<Item = Modulus>,
) -> Option<Common<N>> {
    let leading = p.coefficients().last()?;
    let mut lifted: Option<Lifted> = None;
    // Ends: the moduli do. Those that are primes have no factor in common, there are millions, and all
    // but finitely many leave the degree as it is. Soon the coefficients are those of the divisor.
    for modulus in moduli {
        let [own, other] = [p, q].map(|poly| residues(modulus, poly));
        let factor = own.last().copied()?;
        let Some(mut divisor) = greatest_divisor(modulus, own, other) else {
            continue;
        };
        if divisor.len() == 1 {
            return Some(Common {
                divisor: Poly::new(&[Integer::from(1)]),
                quotient: p.clone(),
            });
        }
        // All but the leading one, which is known.
        divisor.pop();
        for own in &mut divisor {
            *own = modulus.times(*own, factor);
        }
        match &mut lifted {
            Some(lifted) if lifted.coefficients.len() < divisor.len() => {}
            Some(lifted) if lifted.coefficients.len() == divisor.len() => {
                if lifted.stays(modulus, &divisor) == Some(true)
                    && let Some(common) = lifted.common(p, q, leading)
                {
                    return Some(common);
                }
            }
            _ => lifted = Some(Lifted::new(modulus, &divisor)),
        }
    }
    None
}

/// Integers that are known modulo a product: those of least magnitude.
struct Lifted {
    coefficients: SmallVec<[Integer; 6]>,
    product: Integer,
}

impl Lifted {
    fn new(modulus: Modulus, residues: &Residues) -> Self {
        let own = residues.iter().map(|&r| balanced(modulus, r));
        Lifted {
            coefficients: own.collect(),
            product: Integer::from(i128::from(modulus.get())),
        }
    }

    /// Takes in one more modulus. Whether all stay as they are; `None`, and nothing is changed, if
    /// the modulus has a factor in common with those before it.
    fn stays(&mut self, modulus: Modulus, residues: &Residues) -> Option<bool> {
        let inverse = modulus.inverse(residue(modulus, &self.product))?;
        let mut stays = true;
        for (own, &wanted) in self.coefficients.iter_mut().zip(residues) {
            let missing = modulus.minus(wanted, residue(modulus, own));
            let digit = balanced(modulus, modulus.times(missing, inverse));
            stays &= digit.is_zero();
            own.add_shifted(&Integer::product(&self.product, &digit), 0);
        }
        let modulus = Integer::from(i128::from(modulus.get()));
        self.product.mul_assign(&modulus);
        Some(stays)
    }

    /// The polynomial with these coefficients and this leading one, that of `p`; `None` if it does
    /// not divide both.
    fn common<const N: usize>(
        &self,
        p: &Poly<N>,
        q: &Poly<N>,
        leading: &Integer,
    ) -> Option<Common<N>> {
        let own = self.coefficients.iter().chain([leading]);
        let divisor = Poly::new(&own.cloned().collect::<SmallVec<[Integer; 7]>>());
        q.divided(&divisor)?;
        let quotient = p.divided(&divisor)?;
        Some(Common { divisor, quotient })
    }
}

/// The number of least magnitude with this residue.
fn balanced(modulus: Modulus, residue: u64) -> Integer {
    let number = i128::from(residue);
    if residue > modulus.get() / 2 {
        Integer::from(number - i128::from(modulus.get()))
    } else {
        Integer::from(number)
    }
}

#[cfg(test)]
mod tests;
