//! How large the scene is, and how precise its coordinates are.

use tunnelproof::query::{EdgeEdge, Point, QueryError};

/// What coordinates are rounded to before they are asked about. All arithmetic is in `f64`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Precision {
    /// As they are.
    F64,
    /// To single precision: born of an `f32` simulation or file.
    F32,
}

/// The size and precision of the coordinates of a sample.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Domain {
    exponent: i32,
    precision: Precision,
}

/// Why there is no such domain.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("--scale is {0}, not a number of metres from 1e-30 to 1e30")]
pub struct DomainError(f64);

impl Precision {
    /// Both.
    pub const ALL: [Precision; 2] = [Precision::F64, Precision::F32];

    /// The name used in files and on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Precision::F64 => "f64",
            Precision::F32 => "f32",
        }
    }

    /// The precision with this [`name`](Self::name), if any.
    pub fn from_name(name: &str) -> Option<Self> {
        let mut all = Precision::ALL.into_iter();
        all.find(|precision| precision.name() == name)
    }
}

impl Domain {
    /// A metre becomes `scale` metres, taken as the nearest power of two: so every degeneracy stays
    /// what it is, as do times of impact.
    ///
    /// # Errors
    ///
    /// [`DomainError`] for a scale that is not between 1e-30 and 1e30.
    pub fn new(scale: f64, precision: Precision) -> Result<Self, DomainError> {
        if !(1e-30..=1e30).contains(&scale) {
            return Err(DomainError(scale));
        }
        Ok(Domain {
            exponent: scale.log2().round() as i32,
            precision,
        })
    }

    /// What a metre becomes, in metres: a power of two.
    pub fn metres(&self) -> f64 {
        2f64.powi(self.exponent)
    }

    /// What coordinates are rounded to.
    pub fn precision(&self) -> Precision {
        self.precision
    }

    /// Whether queries stay as they are.
    pub fn is_usual(&self) -> bool {
        self.exponent == 0 && self.precision == Precision::F64
    }

    /// The query at this scale and in this precision.
    ///
    /// # Errors
    ///
    /// [`QueryError`] for a coordinate that is not finite any more.
    pub fn apply(&self, query: &EdgeEdge) -> Result<EdgeEdge, QueryError> {
        let points = |points: &[Point; 4]| points.map(|point| point.map(|x| self.coordinate(x)));
        let radius = query.radius().parts().map(|part| part * self.metres());
        EdgeEdge::new(points(query.start()), points(query.end()), radius)
    }

    fn coordinate(&self, x: f64) -> f64 {
        let scaled = x * self.metres();
        match self.precision {
            Precision::F64 => scaled,
            Precision::F32 => f64::from(scaled as f32),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn query(x: f64) -> EdgeEdge {
        let far = Point::new(x, 1.0, 0.1);
        EdgeEdge::new([Point::origin(); 4], [far; 4], 0.0).unwrap()
    }

    #[test]
    fn domain_scale_is_the_nearest_power_of_two() {
        for (scale, metres) in [(1.0, 1.0), (1e-3, 2f64.powi(-10)), (1e3, 1024.0)] {
            let domain = Domain::new(scale, Precision::F64).unwrap();
            assert_eq!(domain.metres(), metres);
            let scaled = domain.apply(&query(3.0)).unwrap();
            assert_eq!(scaled.end()[2], Point::new(3.0, 1.0, 0.1) * metres);
        }
    }

    #[test]
    fn domain_f32_rounds_coordinates_to_single_precision() {
        let domain = Domain::new(1.0, Precision::F32).unwrap();
        let rounded = domain.apply(&query(16_777_217.0)).unwrap();
        let expected = Point::new(16_777_216.0, 1.0, f64::from(0.1f32));
        assert_eq!(rounded.end()[0], expected);
    }

    #[test]
    fn domain_refuses_scales_and_coordinates_that_are_none() {
        for scale in [0.0, -1.0, f64::NAN, f64::INFINITY, 1e-31] {
            assert!(Domain::new(scale, Precision::F64).is_err(), "{scale}");
        }
        let huge = Domain::new(1e30, Precision::F64).unwrap();
        assert!(huge.apply(&query(1e300)).is_err());
        let single = Domain::new(1.0, Precision::F32).unwrap();
        assert!(single.apply(&query(1e39)).is_err());
    }
}
