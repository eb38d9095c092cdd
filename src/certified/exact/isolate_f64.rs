//! The roots of a polynomial isolated in floating point, where its error bound allows.
//!
//! The interval is halved a few times; a piece whose Bernstein coefficients are all beyond their
//! error bound has no root where they have one sign, and one, a simple one, where their signs
//! change once.

use smallvec::SmallVec;

use super::grid_time::GridTime;

/// An interval; `None` is the start or the end of the step.
pub(super) type Interval = (Option<GridTime>, Option<GridTime>);

/// How often the step is halved at most.
const DEPTH: u32 = 4;

/// Intervals around each of the roots in `(0, 1)`, which are simple and not at the ends of these;
/// `None` where floating point does not show that.
///
/// With `S` the sum of the magnitudes of the coefficients `c`, which have a relative error of
/// 2^-52: a Bernstein coefficient, such as `c0 + 2/3 c1 + 1/3 c2`, is a weighted sum of them with
/// weights up to 1 and takes at most 8 operations, and a halving averages three times for each of
/// the [`DEPTH`] levels. All values stay within `S`, so that their errors are at most
/// `(2 + 8 + 3 DEPTH) 2^-53 S`, below `2^-48 S`. Nothing underflows beside that: the coefficients
/// are integers.
pub(super) fn isolate_f64(c: &[f64; 4]) -> Option<SmallVec<[Interval; 3]>> {
    let error = c.iter().map(|c| c.abs()).sum::<f64>() / (1u64 << 48) as f64;
    let bernstein = [
        c[0],
        c[0] + c[1] / 3.0,
        c[0] + (2.0 * c[1] + c[2]) / 3.0,
        c[0] + c[1] + c[2] + c[3],
    ];
    let mut found = SmallVec::new();
    part_piece(&bernstein, error, 0, 0, &mut found)?;
    Some(found)
}

/// The same for the piece from `index / 2^depth` to `(index + 1) / 2^depth`.
fn part_piece(
    b: &[f64; 4],
    error: f64,
    index: u128,
    depth: u32,
    found: &mut SmallVec<[Interval; 3]>,
) -> Option<()> {
    if b.iter().all(|b| b.abs() > error) {
        let changes = b
            .windows(2)
            .filter(|b| (b[0] < 0.0) != (b[1] < 0.0))
            .count();
        if changes == 1 {
            found.push((grid_time(index, depth), grid_time(index + 1, depth)));
        }
        if changes < 2 {
            return Some(());
        }
    }
    // Ends: here at the latest.
    if depth == DEPTH {
        return None;
    }
    let (left, right) = halves(b);
    part_piece(&left, error, 2 * index, depth + 1, found)?;
    part_piece(&right, error, 2 * index + 1, depth + 1, found)
}

/// `index / 2^depth`, unless that is 0 or 1.
pub(super) fn grid_time(index: u128, depth: u32) -> Option<GridTime> {
    (index > 0 && index < 1 << depth).then(|| GridTime(index << (128 - depth)))
}

/// The Bernstein coefficients on both halves, by de Casteljau's algorithm.
fn halves(b: &[f64; 4]) -> ([f64; 4], [f64; 4]) {
    let middle = |x: f64, y: f64| 0.5 * (x + y);
    let [first, second, third] = [middle(b[0], b[1]), middle(b[1], b[2]), middle(b[2], b[3])];
    let (left, right) = (middle(first, second), middle(second, third));
    let centre = middle(left, right);
    ([b[0], first, left, centre], [centre, right, third, b[3]])
}

#[cfg(test)]
mod tests;
