//! Things of which none is better than another in both of two numbers.

/// The things of which none dominates another: is at least as good in both numbers, and better in
/// one. Small numbers are good.
#[derive(Clone, Debug, PartialEq)]
pub struct Front<T> {
    members: Vec<([f64; 2], T)>,
}

impl<T> Default for Front<T> {
    fn default() -> Self {
        Front {
            members: Vec::new(),
        }
    }
}

impl<T> Front<T> {
    /// The members, those with the least first number first.
    pub fn members(&self) -> impl ExactSizeIterator<Item = &T> {
        self.members.iter().map(|(_, member)| member)
    }

    /// Their numbers, in the same order.
    pub fn numbers(&self) -> impl ExactSizeIterator<Item = [f64; 2]> {
        self.members.iter().map(|(numbers, _)| *numbers)
    }

    /// Takes something that no member is as good as, in place of those that it dominates.
    pub fn offer(&mut self, numbers: [f64; 2], offered: T) {
        let [first, second] = numbers;
        if self.numbers().any(|[a, b]| a <= first && b <= second) {
            return;
        }
        self.members.retain(|([a, b], _)| *a < first || *b < second);
        let at = self.members.partition_point(|([a, _], _)| *a < first);
        self.members.insert(at, (numbers, offered));
    }
}

#[cfg(test)]
mod tests {
    use rand::{RngExt, SeedableRng};
    use rand_chacha::ChaCha8Rng;

    use super::*;

    #[test]
    fn front_holds_exactly_what_nothing_dominates() {
        let mut rng = ChaCha8Rng::seed_from_u64(1);
        for _ in 0..200 {
            let all: Vec<_> = (0..30)
                .map(|_| [(); 2].map(|()| f64::from(rng.random_range(0..12))))
                .collect();
            let mut front = Front::default();
            all.iter().for_each(|numbers| front.offer(*numbers, ()));
            let is_dominated = |[a, b]: &[f64; 2]| {
                all.iter()
                    .any(|[c, d]| c <= a && d <= b && [c, d] != [a, b])
            };
            let mut expected: Vec<_> = all.iter().copied().filter(|x| !is_dominated(x)).collect();
            expected.sort_by(|a, b| a[0].total_cmp(&b[0]));
            expected.dedup();
            assert_eq!(front.numbers().collect::<Vec<_>>(), expected);
        }
    }

    #[test]
    fn front_of_equals_holds_the_first() {
        let mut front = Front::default();
        front.offer([1.0, 2.0], 7);
        front.offer([1.0, 2.0], 8);
        assert_eq!(front.members().collect::<Vec<_>>(), [&7]);
    }
}
