//! What a step may spend on what pulls, pushes, sticks and slides, in multiplications.
//!
//! Time would give other results on another machine. Multiplications of the factor, of solves with
//! it and of sweeps are what takes the time, and their number is known beforehand.

use crate::wire::contact::ContactConstraint;
use crate::wire::world::World;

/// What every step may spend, as if there were so many more segments.
const AT_LEAST: usize = 6000;

/// What is left to spend. Whoever spends looks first whether anything is left, and may then spend
/// more than that, once.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Budget {
    left: i64,
}

impl Budget {
    /// That of a step.
    pub(super) fn of_step(world: &World, contacts: &[ContactConstraint]) -> Self {
        let segments = world.wires.iter().map(|wire| wire.segments.len());
        let things = AT_LEAST + segments.sum::<usize>() + contacts.len();
        Budget::new(world.settings.work.saturating_mul(things))
    }

    /// So many multiplications.
    pub(super) fn new(left: usize) -> Self {
        Budget {
            left: i64::try_from(left).unwrap_or(i64::MAX),
        }
    }

    /// One part of it in so many.
    pub(super) fn share(&self, one_in: usize) -> usize {
        usize::try_from(self.left).unwrap_or(0) / one_in.max(1)
    }

    /// Takes such a part out.
    pub(super) fn part(&mut self, one_in: usize) -> Self {
        let part = Budget::new(self.share(one_in));
        self.left -= part.left;
        part
    }

    /// Takes such a part out and divides it by weights. If all of them are 0, nothing is taken.
    pub(super) fn parts(&mut self, one_in: usize, weights: &[usize]) -> Vec<Self> {
        let all = weights.iter().map(|&weight| weight as u128).sum::<u128>();
        let share = self.share(one_in) as u128;
        let part = |&weight: &usize| {
            let part = (share * weight as u128).checked_div(all).unwrap_or(0);
            // Not more than the share.
            Budget::new(usize::try_from(part).unwrap_or(usize::MAX))
        };
        let parts: Vec<Budget> = weights.iter().map(part).collect();
        self.left -= parts.iter().map(|part| part.left).sum::<i64>();
        parts
    }

    /// Takes back what is left of a part, or what it spent too much.
    pub(super) fn take_back(&mut self, part: Budget) {
        self.left = self.left.saturating_add(part.left);
    }

    pub(super) fn spend(&mut self, multiplications: usize) {
        let spent = i64::try_from(multiplications).unwrap_or(i64::MAX);
        self.left = self.left.saturating_sub(spent);
    }

    pub(super) fn is_spent(&self) -> bool {
        self.left <= 0
    }

    /// How often something that costs so much may be done.
    pub(super) fn times(&self, cost: usize) -> usize {
        self.share(cost)
    }

    /// What was spent since it was another one.
    pub(super) fn spent_since(&self, before: Budget) -> usize {
        usize::try_from(before.left.saturating_sub(self.left)).unwrap_or(0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_part_does_not_spend_or_spends_too_much_counts_for_the_whole() {
        let mut budget = Budget::new(100);
        let whole = budget;
        let mut part = budget.part(4);
        assert_eq!([budget.share(1), part.share(1)], [75, 25]);
        part.spend(10);
        budget.take_back(part);
        assert_eq!((budget.share(1), budget.spent_since(whole)), (90, 10));
        let mut part = budget.part(2);
        part.spend(200);
        assert!(part.is_spent() && !budget.is_spent());
        budget.take_back(part);
        assert!(budget.is_spent());
        assert_eq!((budget.times(3), budget.spent_since(whole)), (0, 210));
        assert_eq!(budget.part(2).share(1), 0);
        let mut budget = Budget::new(100);
        let mut parts = |weights: &[usize]| {
            let parts = budget.parts(2, weights).into_iter();
            let shares: Vec<usize> = parts.map(|part| part.share(1)).collect();
            (shares, budget.share(1))
        };
        assert_eq!(parts(&[3, 0, 4]), (vec![21, 0, 28], 51));
        assert_eq!(parts(&[0, 0]), (vec![0, 0], 51));
        assert_eq!(parts(&[7]), (vec![25], 26));
        let mut endless = Budget::new(usize::MAX);
        endless.spend(usize::MAX);
        assert!(endless.is_spent());
    }
}
