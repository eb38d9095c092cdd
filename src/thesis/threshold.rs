//! Every threshold of the thesis path.

/// The thresholds of table 3.1, and those that the text uses without naming them.
///
/// A value counts as zero if its magnitude is not above the threshold, so that a threshold of 0
/// asks for zero itself.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Thresholds {
    /// Points no farther apart are identical; velocities likewise. In metres, and metres per step.
    /// Table 3.1: 1e-6.
    pub dist: f64,
    /// The same in one coordinate (Algorithms 10, 15 and 16). Algorithm 15 also compares line
    /// parameters with it, which have no unit. Table 3.1: 1e-6.
    pub dist_1d: f64,
    /// Times no farther apart are the same, in steps (Algorithm 10). Table 3.1: 1e-9.
    pub t: f64,
    /// Coefficients of a cross product of two edges no larger are zero, in square metres
    /// (Algorithms 4 and 12). Table 3.1: 100 `DBL_EPSILON`.
    pub coefficients_quadratic: f64,
    /// Coefficients of the triple product of equation 3.9 no larger are zero, in cubic metres
    /// (Algorithm 7). Table 3.1: 100 `DBL_EPSILON`.
    pub coefficients_cubic: f64,

    /// Algorithm 12, `solutions ∩ tmpSolutions`: roots no farther apart are the same root, in
    /// steps. Not stated. Roots of different equations round differently, so equality of bits would
    /// lose nearly all; read as [`t`](Self::t), by which Algorithm 10 asks the same question.
    pub same_root: f64,
    /// Algorithm 15, `S == 0`: a segment no longer is a point, in metres. Written without a
    /// threshold, so read as 0. A larger value changes little: a coordinate of `S` up to
    /// [`dist_1d`](Self::dist_1d) is passed over anyway.
    pub segment: f64,
    /// Algorithm 16, `StaticEquality(R, 0)` and `StaticEquality(S, 0)`: a segment no longer is a
    /// point, in metres. Not stated; read as [`dist`](Self::dist), as in every other call of
    /// `StaticEquality` with points.
    pub direction: f64,
    /// Algorithm 16, `StaticEquality(S × R, 0)`: directions whose cross product is no larger are
    /// parallel, in square metres. Not stated; read as
    /// [`coefficients_quadratic`](Self::coefficients_quadratic), by which Algorithm 4 asks the same
    /// of moving directions. Read as [`dist`](Self::dist) it would call any two segments of a
    /// millimetre parallel, whatever their angle.
    pub parallel: f64,
    /// Algorithm 16, `LineSegmentsCoLinear`: parallel lines no farther apart are the same line, in
    /// metres. Not stated; read as [`dist`](Self::dist), "the lowest distance below which points
    /// can be considered identical" (3.1.1.3).
    pub colinear: f64,
}

/// 100 `DBL_EPSILON`; table 3.1 writes 2.2204460492503131e-14.
const COEFFICIENTS: f64 = 100.0 * f64::EPSILON;

impl Default for Thresholds {
    /// Table 3.1, and for what it does not name the readings above.
    fn default() -> Self {
        let dist = 1e-6;
        let t = 1e-9;
        Thresholds {
            dist,
            dist_1d: 1e-6,
            t,
            coefficients_quadratic: COEFFICIENTS,
            coefficients_cubic: COEFFICIENTS,
            same_root: t,
            segment: 0.0,
            direction: dist,
            parallel: COEFFICIENTS,
            colinear: dist,
        }
    }
}

impl Thresholds {
    /// Every threshold 0: the exact questions, asked in rounded arithmetic.
    pub const ZERO: Thresholds = Thresholds {
        dist: 0.0,
        dist_1d: 0.0,
        t: 0.0,
        coefficients_quadratic: 0.0,
        coefficients_cubic: 0.0,
        same_root: 0.0,
        segment: 0.0,
        direction: 0.0,
        parallel: 0.0,
        colinear: 0.0,
    };
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn thresholds_default_is_table_3_1() {
        let thresholds = Thresholds::default();
        assert_eq!(thresholds.dist, 1.0e-6);
        assert_eq!(thresholds.dist_1d, 1.0e-6);
        assert_eq!(thresholds.t, 1.0e-9);
        let printed: f64 = "2.2204460492503131e-14".parse().unwrap();
        assert_eq!(thresholds.coefficients_quadratic, printed);
        assert_eq!(thresholds.coefficients_cubic, printed);
    }
}
