//! Which of two queries is the simpler one.

use tunnelproof::query::Query;

use super::turning::MOST;
use crate::algebraic::decompose;
use crate::shape::Shape;

/// How complex a query is, totally ordered: the smaller, the simpler.
///
/// In this order:
///
/// 1. the bits of all coordinates and radii. 0 takes none, an odd integer times `2^e` the bits of
///    the integer, and `e` more if `e` is above 0, `-2 e` more if it is below: an integer takes as
///    many as it has binary digits, and small integers are simpler than fractions;
/// 2. how many different positions the points take;
/// 3. how many numbers are below 0;
/// 4. the numbers themselves, as a list of magnitudes and then of signs.
///
/// Two queries of the same kind are equally complex only if all their numbers are the same.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Complexity {
    bits: u64,
    positions: usize,
    negative: usize,
    magnitudes: [u64; NUMBERS],
    signs: u64,
}

/// The most numbers of any query: 40 of two bodies that turn, and two radii.
const NUMBERS: usize = MOST + 2;

impl Complexity {
    /// How complex this query is.
    pub fn of(query: &Query) -> Self {
        Self::new(&Shape::new(query))
    }

    /// The bits of all numbers, as counted above.
    pub fn bits(&self) -> u64 {
        self.bits
    }

    pub(super) fn new(shape: &Shape) -> Self {
        let positions = (0..8).map(|index| shape.position(index));
        Self::of_numbers(&shape.numbers, shape.radii, positions.collect())
    }

    /// Of numbers that are, besides others, these positions.
    pub(super) fn of_numbers(own: &[f64], radii: [f64; 2], positions: Vec<[f64; 3]>) -> Self {
        let mut numbers = [0.0; NUMBERS];
        let all = own.iter().chain(&radii);
        numbers
            .iter_mut()
            .zip(all)
            .for_each(|(place, number)| *place = *number);
        let signs = numbers.iter().fold(0, |signs, number| {
            signs << 1 | u64::from(number.is_sign_negative())
        });
        Complexity {
            bits: numbers.iter().map(|&number| bits(number)).sum(),
            positions: different(positions),
            negative: signs.count_ones() as usize,
            magnitudes: numbers.map(|number| number.abs().to_bits()),
            signs,
        }
    }
}

fn bits(number: f64) -> u64 {
    let (mantissa, exponent) = decompose(number);
    let own = u64::from(i64::BITS - mantissa.abs().leading_zeros());
    own + match exponent {
        0.. => exponent.unsigned_abs(),
        _ => 2 * exponent.unsigned_abs(),
    }
}

fn different(mut positions: Vec<[f64; 3]>) -> usize {
    positions.sort_by(|a, b| a.partial_cmp(b).unwrap_or(std::cmp::Ordering::Equal));
    positions.dedup();
    positions.len()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bits_of_an_integer_are_its_digits_and_fractions_take_more() {
        for (number, expected) in [
            (0.0, 0),
            (1.0, 1),
            (-2.0, 2),
            (3.0, 2),
            (4.0, 3),
            (-5.0, 3),
            (0.5, 3),
            (1.5, 4),
            (0.1, 52 + 2 * 55),
            (f64::MIN_POSITIVE, 1 + 2 * 1022),
        ] {
            assert_eq!(bits(number), expected, "{number}");
        }
    }
}
