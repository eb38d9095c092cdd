//! What is written about every certified step: why it ends, and what is kept.

use tunnelproof::certified::Blocked;
use tunnelproof::query::Radius;

/// Why a step ends early, in a word.
pub fn blocked_name(blocked: Blocked) -> &'static str {
    match blocked {
        Blocked::Ahead => "ahead",
        Blocked::Rounding => "rounding",
        _ => "touching",
    }
}

/// The largest `f64` that is not above a radius, so that what is kept is above it, too.
pub fn rounded_down(radius: Radius) -> f64 {
    let [first, second] = radius.parts();
    let sum = first + second;
    if sum.is_infinite() {
        return f64::MAX;
    }
    // What the sum lost: exact, by the two-sum of Knuth.
    let back = sum - first;
    let lost = (first - (sum - back)) + (second - back);
    match lost < 0.0 {
        true => sum.next_down(),
        false => sum,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rounded_down_is_never_above_the_exact_sum() {
        assert_eq!(rounded_down([0.1, 0.2].into()), 0.3);
        assert_eq!(rounded_down([0.5, 0.25].into()), 0.75);
        let near_two = [1.0, 1.0 - f64::EPSILON / 2.0];
        assert_eq!(rounded_down(near_two.into()), 2f64.next_down());
        assert_eq!(rounded_down([1.0, f64::EPSILON / 4.0].into()), 1.0);
        assert_eq!(rounded_down([f64::MAX; 2].into()), f64::MAX);
        assert_eq!(rounded_down(Radius::ZERO), 0.0);
    }
}
