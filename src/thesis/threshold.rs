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
        Thresholds::named(Threshold::ALL.map(Threshold::published))
    }
}

impl Thresholds {
    /// Every threshold 0: the exact questions, asked in rounded arithmetic.
    pub const ZERO: Thresholds = Thresholds::named([0.0; 5]);

    /// The thresholds of table 3.1 with these values, in the order of [`Threshold::ALL`], and for
    /// what it does not name the readings above.
    pub const fn named(
        [dist, dist_1d, t, coefficients_quadratic, coefficients_cubic]: [f64; 5],
    ) -> Thresholds {
        Thresholds {
            dist,
            dist_1d,
            t,
            coefficients_quadratic,
            coefficients_cubic,
            same_root: t,
            segment: 0.0,
            direction: dist,
            parallel: coefficients_quadratic,
            colinear: dist,
        }
    }
}

/// A threshold that table 3.1 names.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Threshold {
    /// [`Thresholds::dist`].
    Dist,
    /// [`Thresholds::dist_1d`].
    Dist1d,
    /// [`Thresholds::t`].
    T,
    /// [`Thresholds::coefficients_quadratic`].
    CoefficientsQuadratic,
    /// [`Thresholds::coefficients_cubic`].
    CoefficientsCubic,
}

impl Threshold {
    /// Every threshold of table 3.1, in its order.
    pub const ALL: [Threshold; 5] = [
        Threshold::Dist,
        Threshold::Dist1d,
        Threshold::T,
        Threshold::CoefficientsQuadratic,
        Threshold::CoefficientsCubic,
    ];

    /// The name used in files and on the command line: that of the field of [`Thresholds`].
    pub fn name(self) -> &'static str {
        match self {
            Threshold::Dist => "dist",
            Threshold::Dist1d => "dist_1d",
            Threshold::T => "t",
            Threshold::CoefficientsQuadratic => "coefficients_quadratic",
            Threshold::CoefficientsCubic => "coefficients_cubic",
        }
    }

    /// The threshold with this [`name`](Self::name), if any.
    pub fn from_name(name: &str) -> Option<Self> {
        let mut all = Threshold::ALL.into_iter();
        all.find(|threshold| threshold.name() == name)
    }

    /// The power of a length that it is compared with: in metres to this power.
    pub fn dimension(self) -> i32 {
        match self {
            Threshold::T => 0,
            Threshold::Dist | Threshold::Dist1d => 1,
            Threshold::CoefficientsQuadratic => 2,
            Threshold::CoefficientsCubic => 3,
        }
    }

    /// Its value in table 3.1.
    pub fn published(self) -> f64 {
        match self {
            Threshold::Dist | Threshold::Dist1d => 1e-6,
            Threshold::T => 1e-9,
            Threshold::CoefficientsQuadratic | Threshold::CoefficientsCubic => COEFFICIENTS,
        }
    }
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

    #[test]
    fn thresholds_have_names_that_find_them() {
        for threshold in Threshold::ALL {
            assert_eq!(Threshold::from_name(threshold.name()), Some(threshold));
        }
        assert_eq!(Threshold::from_name("epsilon"), None);
    }

    #[test]
    fn thresholds_not_named_follow_those_they_are_read_as() {
        let thresholds = Thresholds::named([1.0, 2.0, 3.0, 4.0, 5.0]);
        assert_eq!([thresholds.direction, thresholds.colinear], [1.0; 2]);
        assert_eq!(thresholds.dist_1d, 2.0);
        assert_eq!(thresholds.same_root, 3.0);
        assert_eq!(thresholds.parallel, 4.0);
        assert_eq!(thresholds.coefficients_cubic, 5.0);
        assert_eq!(thresholds.segment, 0.0);
    }
}
