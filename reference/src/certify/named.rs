//! The first of some queries by name.

/// The most names that are kept.
pub const MOST: usize = 100;

/// The names of the first queries that something holds of, with their places in their source.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Named(Vec<(u64, String)>);

impl Named {
    /// These, of which the first are kept.
    pub fn new(mut names: Vec<(u64, String)>) -> Self {
        names.truncate(MOST);
        Named(names)
    }

    /// The places and names, in order.
    pub fn all(&self) -> &[(u64, String)] {
        &self.0
    }

    /// The names, in order.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.0.iter().map(|(_, name)| name.as_str())
    }

    /// Adds a later query.
    pub(super) fn add(&mut self, place: u64, name: &str) {
        if self.0.len() < MOST {
            self.0.push((place, name.to_owned()));
        }
    }

    /// Adds those of a later source.
    pub(super) fn merge(&mut self, later: Named) {
        self.0.extend(later.0);
        self.0.truncate(MOST);
    }

    /// Adds those of another part of the same source, whichever was first.
    pub(super) fn join(&mut self, other: Named) {
        self.0.extend(other.0);
        self.0.sort_by_key(|(place, _)| *place);
        self.0.truncate(MOST);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn named_parts_joined_are_the_first_of_the_whole() {
        let all = 0..3 * MOST as u64;
        let of = |places: Vec<u64>| {
            let mut named = Named::default();
            places
                .iter()
                .for_each(|&place| named.add(place, &place.to_string()));
            named
        };
        let whole = of(all.clone().collect());
        let [mut even, odd] =
            [0, 1].map(|rest| of(all.clone().filter(|n| n % 2 == rest).collect()));
        even.join(odd);
        assert_eq!(even, whole);
        let mut first = of(vec![7]);
        first.merge(of(vec![3]));
        assert_eq!(first.names().collect::<Vec<_>>(), ["7", "3"]);
    }
}
