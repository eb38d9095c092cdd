//! Arithmetic modulo numbers below `2^62`.

/// What numbers are taken modulo: a prime, or a number without small factors.
#[derive(Clone, Copy, Debug)]
pub(super) struct Modulus {
    modulus: u64,
    /// `2^64` modulo the number, below `2^32`: so little that two turns reduce a number of 128 bits to
    /// one of 64.
    fold: u64,
}

/// Factors that no [modulus below `2^62`](Modulus::below_2_62) has: by a small one, residues are 0 too
/// often.
const SMALL: [u64; 11] = [3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37];

impl Modulus {
    /// The prime `2^61 - 1`.
    pub(super) const MERSENNE: Modulus = Modulus::new((1 << 61) - 1);

    /// Numbers without small factors, the largest first, as far as they are near enough to `2^62`:
    /// a hundred million.
    pub(super) fn below_2_62() -> impl Iterator<Item = Modulus> {
        let odd = (1..1 << 29).map(|i| (1 << 62) + 1 - 2 * i);
        let moduli = odd.filter(|n: &u64| !SMALL.iter().any(|&factor| n.is_multiple_of(factor)));
        moduli.map(Modulus::new)
    }

    /// A number from 2 to `2^62` whose multiple `2^64` exceeds by less than `2^32`.
    pub(super) const fn new(modulus: u64) -> Modulus {
        let fold = ((1 << 64) % (modulus as u128)) as u64;
        assert!(1 < modulus && modulus < 1 << 62 && fold < 1 << 32);
        Modulus { modulus, fold }
    }

    /// The number itself.
    pub(super) fn get(self) -> u64 {
        self.modulus
    }

    /// A number of these limbs, the least significant one first.
    pub(super) fn residue(self, limbs: &[u64]) -> u64 {
        let join = |rest: u64, &limb: &u64| {
            self.folded(u128::from(rest) * u128::from(self.fold) + u128::from(limb))
        };
        limbs.iter().rev().fold(0, join) % self.modulus
    }

    /// A number of 64 bits that is the same modulo the number as one below `2^96 + 2^64`.
    fn folded(self, value: u128) -> u64 {
        // The upper limb is at most 2^32 and the factor below that, so the first turn leaves less
        // than 2^65; the second one less than 2^64 + 2^32; and what is left of that, if it is 2^64 or
        // more, is below 2^32.
        let twice = self.fold_once(self.fold_once(value));
        twice as u64 + (twice >> 64) as u64 * self.fold
    }

    /// The lower limb and what the upper one is modulo the number.
    fn fold_once(self, value: u128) -> u128 {
        u128::from((value >> 64) as u64) * u128::from(self.fold) + u128::from(value as u64)
    }

    /// `a - b`.
    pub(super) fn minus(self, a: u64, b: u64) -> u64 {
        (a + self.modulus - b) % self.modulus
    }

    /// `a b`.
    pub(super) fn times(self, a: u64, b: u64) -> u64 {
        // Below 2^60 2^32 + 2^64.
        let once = self.fold_once(u128::from(a) * u128::from(b));
        self.folded(once) % self.modulus
    }

    /// The number `x` for which `a x` is 1; `None` if `a` has a factor of the modulus.
    pub(super) fn inverse(self, a: u64) -> Option<u64> {
        // Each remainder is a multiple of the modulus and the multiple of `a` by its factor; the
        // factors are below the modulus.
        let (mut last, mut rest) = (self.modulus, a);
        let (mut last_factor, mut factor) = (0i64, 1i64);
        // Ends: the remainders decrease.
        while rest != 0 {
            let quotient = last / rest;
            (last, rest) = (rest, last % rest);
            (last_factor, factor) = (factor, last_factor - quotient as i64 * factor);
        }
        let inverse = last_factor.rem_euclid(self.modulus as i64);
        (last == 1).then_some(inverse.unsigned_abs() % self.modulus)
    }
}

#[cfg(test)]
mod tests;
