//! Roots of one variable.

/// Where, between 0 and `most`, a condition that holds at first stops to hold, to a relative
/// resolution; 0 is to the bit.
pub(in crate::wire) fn bisect(most: f64, resolution: f64, holds: impl Fn(f64) -> bool) -> f64 {
    let (mut low, mut high) = (0.0, most);
    loop {
        let middle = (low + high) / 2.0;
        if middle <= low || middle >= high || high - low <= resolution * high {
            return high;
        }
        if holds(middle) {
            low = middle;
        } else {
            high = middle;
        }
    }
}
