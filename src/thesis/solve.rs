//! `Solve`: the distinct real roots in `[0, 1]` of polynomials of degree 3 or less (thesis 2.5.2).
//!
//! The roots of the derivative and the ends of `[0, 1]` cut it into intervals on which the
//! polynomial is monotone, and which hold at most one root each. Newton's method refines it, kept
//! inside the interval by bisection. The recursion ends at degree 1.
//!
//! # Roots of even multiplicity
//!
//! There the polynomial does not change sign, and the root is a root of the derivative, a border
//! between two intervals. The text says no more than that a multiple root counts once. Read here: a
//! border is a root if the value there is 0 as far as its rounding shows, that is, within the error
//! bound of its evaluation. The bound covers the evaluation only, not what rounded before in the
//! coefficients; so double roots are found for coefficients that are exact or nearly so, and may
//! be lost or doubled otherwise.

/// The most roots that [`solve`] returns: three, and one more where rounding splits a multiple
/// root.
const MAX_ROOTS: usize = 4;

/// Steps after which refining ends, wherever it is. Newton's method takes fewer than ten as a rule;
/// in the worst case each second step halves the interval.
const MAX_STEPS: usize = 128;

/// Roots in `[0, 1]`, strictly ascending.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Roots {
    values: [f64; MAX_ROOTS],
    len: usize,
}

impl Roots {
    /// The roots in ascending order.
    pub fn as_slice(&self) -> &[f64] {
        &self.values[..self.len]
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.len == 0
    }

    /// The roots for which `keep` holds.
    pub fn filter(&self, keep: impl Fn(f64) -> bool) -> Roots {
        let mut kept = Roots::default();
        for &root in self.as_slice().iter().filter(|&&root| keep(root)) {
            kept.push(root);
        }
        kept
    }

    /// Appends a root above those already there; one that is not above is the same root again.
    fn push(&mut self, root: f64) {
        let is_new = self.as_slice().last().is_none_or(|&last| root > last);
        if is_new && self.len < MAX_ROOTS {
            // Adding 0 turns -0 into 0.
            self.values[self.len] = root + 0.0;
            self.len += 1;
        }
    }
}

/// The real roots in `[0, 1]` of the polynomial with these coefficients, that of the highest power
/// first, as Algorithms 3 and 6 number them.
///
/// Leading coefficients may be 0. A constant has no roots; neither does the polynomial that is 0,
/// of which the text says nothing, nor one with a coefficient that is not finite.
pub fn solve<const N: usize>(coefficients: [f64; N]) -> Roots {
    const {
        assert!(N <= 4, "the degree is at most 3");
    }
    if coefficients.iter().any(|c| !c.is_finite()) {
        return Roots::default();
    }
    let coefficients = rescaled(coefficients);
    let leading = coefficients.iter().position(|&c| c != 0.0).unwrap_or(N);
    roots_in_unit_interval(&coefficients[leading..])
}

/// The coefficients times a power of two, where their own size would overflow or underflow later.
fn rescaled<const N: usize>(coefficients: [f64; N]) -> [f64; N] {
    let largest = coefficients.iter().fold(0.0, |m: f64, c| m.max(c.abs()));
    let factor = if largest > power_of_two(900) {
        power_of_two(-200)
    } else if largest < power_of_two(-400) {
        power_of_two(500)
    } else {
        return coefficients;
    };
    coefficients.map(|c| c * factor)
}

/// `2^exponent`, for exponents of normal numbers.
const fn power_of_two(exponent: i64) -> f64 {
    f64::from_bits(((exponent + 1023) as u64) << 52)
}

/// The roots of a polynomial whose leading coefficient is not 0.
fn roots_in_unit_interval(polynomial: &[f64]) -> Roots {
    match *polynomial {
        [] | [_] => Roots::default(),
        [a, b] => {
            let mut roots = Roots::default();
            let root = -b / a;
            if (0.0..=1.0).contains(&root) {
                roots.push(root);
            }
            roots
        }
        _ => {
            let degree = polynomial.len() - 1;
            let mut derivative = [0.0; 3];
            for (power, slot) in (1..=degree).rev().zip(&mut derivative) {
                *slot = power as f64 * polynomial[degree - power];
            }
            let extrema = roots_in_unit_interval(&derivative[..degree]);
            roots_between(polynomial, extrema.as_slice())
        }
    }
}

/// The roots of a polynomial that is monotone between 0, the `extrema` and 1.
fn roots_between(polynomial: &[f64], extrema: &[f64]) -> Roots {
    let mut roots = Roots::default();
    let mut left = 0.0;
    let mut sign_left = evaluate(polynomial, left).sign();
    if sign_left == 0 {
        roots.push(left);
    }
    for &right in extrema
        .iter()
        .filter(|&&t| t > 0.0 && t < 1.0)
        .chain([&1.0])
    {
        let sign_right = evaluate(polynomial, right).sign();
        if sign_right == 0 {
            roots.push(right);
        } else if sign_left == -sign_right {
            roots.push(refine(polynomial, left, right, sign_right));
        }
        (left, sign_left) = (right, sign_right);
    }
    roots
}

/// A polynomial at a point.
struct Evaluation {
    value: f64,
    slope: f64,
    /// `value` differs from the polynomial by no more than this.
    error_bound: f64,
}

impl Evaluation {
    /// -1 or 1; 0 where rounding hides the sign.
    fn sign(&self) -> i8 {
        if self.value > self.error_bound {
            1
        } else if self.value < -self.error_bound {
            -1
        } else {
            0
        }
    }
}

/// Evaluates by Horner's rule at `t` in `[0, 1]`.
fn evaluate(polynomial: &[f64], t: f64) -> Evaluation {
    let (mut value, mut slope, mut magnitude) = (0.0, 0.0, 0.0);
    for &coefficient in polynomial {
        slope = slope * t + value;
        value = value * t + coefficient;
        magnitude = magnitude * t + coefficient.abs();
    }
    // Horner's rule in degree n errs by at most g = 2n u / (1 - 2n u) times sum |c_i| t^i, where
    // u = EPSILON / 2 (Higham, Accuracy and Stability of Numerical Algorithms, 5.1); `magnitude` is
    // that sum to a relative error of g. With n <= 3 the product is below 8 u.
    Evaluation {
        value,
        slope,
        error_bound: 4.0 * f64::EPSILON * magnitude,
    }
}

/// The root between `left` and `right`, where the signs are `-sign_right` and `sign_right`.
///
/// Newton's method; bisection where its step would leave the interval or is not down to half of the
/// step before. Once rounding hides the sign of the value, only its magnitude is made smaller.
fn refine(polynomial: &[f64], mut left: f64, mut right: f64, sign_right: i8) -> f64 {
    let mut last_step = right - left;
    let mut t = left + 0.5 * last_step;
    for _ in 0..MAX_STEPS {
        let here = evaluate(polynomial, t);
        if here.sign() == 0 {
            return polish(polynomial, left, right, t, here);
        }
        let step = here.value / here.slope;
        let newton = t - step;
        if here.sign() == sign_right {
            right = t;
        } else {
            left = t;
        }
        if left < newton && newton < right && step.abs() <= 0.5 * last_step {
            last_step = step.abs();
            t = newton;
        } else {
            last_step = 0.5 * (right - left);
            t = left + last_step;
        }
        if t <= left || t >= right {
            return t;
        }
    }
    t
}

/// Newton's method from `t` as long as it stays inside the interval and the value shrinks.
fn polish(polynomial: &[f64], left: f64, right: f64, mut t: f64, mut here: Evaluation) -> f64 {
    for _ in 0..MAX_STEPS {
        let newton = t - here.value / here.slope;
        if !(left < newton && newton < right) {
            break;
        }
        let next = evaluate(polynomial, newton);
        if next.value.abs() >= here.value.abs() {
            break;
        }
        (t, here) = (newton, next);
    }
    t
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use proptest::test_runner::{Config, RngSeed};

    use super::*;

    fn seeded() -> Config {
        Config {
            rng_seed: RngSeed::Fixed(2),
            cases: 4096,
            failure_persistence: None,
            ..Config::default()
        }
    }

    /// `(t - a) (t - b) (t - c)`.
    fn cubic(a: f64, b: f64, c: f64) -> [f64; 4] {
        [1.0, -(a + b + c), a * b + b * c + c * a, -a * b * c]
    }

    #[test]
    fn solve_finds_dyadic_roots_exactly() {
        assert_eq!(solve(cubic(0.25, 0.5, 0.75)).as_slice(), [0.25, 0.5, 0.75]);
        assert_eq!(solve(cubic(0.0, 0.5, 1.0)).as_slice(), [0.0, 0.5, 1.0]);
        assert_eq!(solve([8.0, -6.0, 1.0]).as_slice(), [0.25, 0.5]);
        assert_eq!(solve([16.0, -9.0]).as_slice(), [0.5625]);
    }

    #[test]
    fn solve_leaves_out_roots_outside_the_unit_interval() {
        assert_eq!(solve(cubic(-0.5, 0.5, 1.5)).as_slice(), [0.5]);
        assert!(solve(cubic(-1.0, -0.25, 2.0)).is_empty());
        assert!(solve([1.0, 0.0, 1.0]).is_empty());
        assert!(solve([1.0, 1.0]).is_empty());
    }

    #[test]
    fn solve_counts_a_multiple_root_once() {
        assert_eq!(solve(cubic(0.5, 0.5, 0.5)).as_slice(), [0.5]);
        let roots = solve(cubic(0.25, 0.25, 0.75));
        assert_eq!(roots.as_slice().len(), 2);
        assert_eq!(roots.as_slice()[0], 0.25);
        assert!((roots.as_slice()[1] - 0.75).abs() < 1e-15);
        assert_eq!(solve(cubic(0.0, 0.0, 1.0)).as_slice(), [0.0, 1.0]);
        assert_eq!(solve([1.0, -1.0, 0.25]).as_slice(), [0.5]);
        assert_eq!(solve([1.0, 0.0, 0.0]).as_slice(), [0.0]);
    }

    #[test]
    fn solve_drops_leading_zeros() {
        assert_eq!(solve([0.0, 0.0, 4.0, -1.0]).as_slice(), [0.25]);
        assert_eq!(solve([0.0, 8.0, -6.0, 1.0]).as_slice(), [0.25, 0.5]);
        assert_eq!(solve([0.0, 0.0, -3.0]).as_slice(), [] as [f64; 0]);
        assert!(solve([0.0; 4]).is_empty());
        assert!(solve([0.0; 3]).is_empty());
    }

    #[test]
    fn solve_is_not_misled_by_a_tiny_leading_coefficient() {
        for tiny in [1e-16, 1e-100, 5e-324, -1e-30] {
            assert_eq!(solve([tiny, 0.0, 4.0, -1.0]).as_slice(), [0.25], "{tiny:e}");
            assert_eq!(solve([tiny, 4.0, -1.0]).as_slice(), [0.25], "{tiny:e}");
        }
    }

    #[test]
    fn solve_takes_huge_and_tiny_coefficients() {
        let plain = cubic(0.25, 0.5, 0.75);
        for scale in [1023, 900, -400, -1000] {
            let scaled = plain.map(|c| c * power_of_two(scale));
            let roots = solve(scaled);
            let overflows = scaled.iter().any(|c| c.is_infinite());
            let expected: &[f64] = if overflows { &[] } else { &[0.25, 0.5, 0.75] };
            assert_eq!(roots.as_slice(), expected, "2^{scale}");
        }
        assert_eq!(solve([f64::MAX, -f64::MAX / 2.0]).as_slice(), [0.5]);
        assert_eq!(solve([f64::MAX, 0.0, 0.0, -f64::MAX]).as_slice(), [1.0]);
        assert_eq!(solve([1e-320, 0.0, 0.0, -1e-320]).as_slice(), [1.0]);
    }

    #[test]
    fn solve_finds_roots_next_to_the_border() {
        assert_eq!(solve([1.0, 0.0, 1.0, -1e-20]).as_slice(), [1e-20]);
        let root = 1.0 - f64::EPSILON / 2.0;
        assert_eq!(solve([1.0, -root]).as_slice(), [root]);
    }

    #[test]
    fn solve_refuses_coefficients_that_are_not_finite() {
        for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            assert!(solve([bad, 1.0, -0.5]).is_empty());
            assert!(solve([1.0, 0.0, 0.0, bad]).is_empty());
        }
    }

    proptest! {
        #![proptest_config(seeded())]

        #[test]
        fn solve_finds_every_separate_root(
            mut all in prop::array::uniform3(-1.0..2.0_f64),
            scale in -1e3..1e3_f64,
        ) {
            all.sort_by(f64::total_cmp);
            let [a, b, c] = all;
            prop_assume!(b - a > 1e-3 && c - b > 1e-3 && scale.abs() > 1e-3);
            prop_assume!(all.iter().all(|x| x.abs() > 1e-9 && (x - 1.0).abs() > 1e-9));
            let roots = solve(cubic(a, b, c).map(|x| scale * x));
            let expected: Vec<f64> = all.into_iter().filter(|x| (0.0..=1.0).contains(x)).collect();
            prop_assert_eq!(roots.as_slice().len(), expected.len());
            for (root, expected) in roots.as_slice().iter().zip(expected) {
                prop_assert!((root - expected).abs() < 1e-9, "{} {}", root, expected);
            }
        }

        #[test]
        fn solve_returns_ascending_roots_in_the_unit_interval(
            coefficients in prop::array::uniform4(any::<f64>()),
        ) {
            let roots = solve(coefficients);
            prop_assert!(roots.as_slice().iter().all(|t| (0.0..=1.0).contains(t)));
            prop_assert!(roots.as_slice().is_sorted_by(|a, b| a < b));
        }

        #[test]
        fn solve_finds_a_root_wherever_the_ends_differ_in_sign(
            coefficients in prop::array::uniform4(-1.0..1.0_f64),
        ) {
            let at_end: f64 = coefficients.iter().sum();
            prop_assume!(coefficients[3].abs() > 1e-12 && at_end.abs() > 1e-12);
            if (coefficients[3] < 0.0) != (at_end < 0.0) {
                let roots = solve(coefficients);
                prop_assert!(!roots.is_empty());
                for &root in roots.as_slice() {
                    let value = evaluate(&coefficients, root).value;
                    prop_assert!(value.abs() < 1e-14, "{}: {}", root, value);
                }
            }
        }
    }
}
