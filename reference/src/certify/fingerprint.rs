//! A hash of the queries that were judged, to see that two results are of the same ones.

use std::fmt;
use std::str::FromStr;

use hmac_sha256::Hash;

use super::query::AnyQuery;

/// The sum, modulo 2^128, of the first half of the SHA-256 of each query with its place. So that of
/// the parts of a set of queries gives that of the whole, in any order.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Fingerprint(u128);

impl Fingerprint {
    /// That of the query at this place in its source, from 0.
    pub fn of(place: u64, query: &AnyQuery) -> Self {
        let mut hash = Hash::new();
        hash.update(place.to_le_bytes());
        let (kind, coordinates) = query.fields();
        hash.update(kind);
        for radius in query.radius().parts() {
            hash.update(radius.to_le_bytes());
        }
        for coordinate in coordinates {
            hash.update(coordinate.to_le_bytes());
        }
        let digest = hash.finalize();
        let half = digest.iter().take(16);
        let number = half.fold(0, |number, byte| number << 8 | u128::from(*byte));
        Fingerprint(number)
    }

    /// Adds the queries of another part.
    pub fn merge(&mut self, other: Fingerprint) {
        self.0 = self.0.wrapping_add(other.0);
    }
}

impl fmt::Display for Fingerprint {
    /// 32 hexadecimal digits.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:032x}", self.0)
    }
}

impl FromStr for Fingerprint {
    type Err = std::num::ParseIntError;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        u128::from_str_radix(text, 16).map(Fingerprint)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::generate;

    fn of(places: impl IntoIterator<Item = u64>) -> Fingerprint {
        let family = generate::by_name("uniform").unwrap();
        let mut fingerprint = Fingerprint::default();
        places.into_iter().for_each(|place| {
            fingerprint.merge(Fingerprint::of(place, &family.query(1, place).into()))
        });
        fingerprint
    }

    #[test]
    fn fingerprint_is_the_sum_of_its_parts() {
        let mut parts = of([3, 1]);
        parts.merge(of([0, 2]));
        assert_eq!(parts, of(0..4));
        assert_eq!(parts.to_string().parse(), Ok(parts));
    }

    #[test]
    fn fingerprint_tells_queries_places_and_counts_apart() {
        let family = generate::by_name("uniform").unwrap();
        let mut swapped = Fingerprint::default();
        for place in [0, 1] {
            swapped.merge(Fingerprint::of(place, &family.query(1, 1 - place).into()));
        }
        let all = [of(0..2), of(0..3), of(1..3), swapped];
        for (i, one) in all.iter().enumerate() {
            assert!(all[..i].iter().all(|other| other != one));
        }
    }
}
