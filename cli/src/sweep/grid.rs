//! Which settings are judged.

use tunnelproof::thesis::Threshold;

use super::domain::Domain;
use super::setting::Setting;

/// The values of one threshold, ascending.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// The threshold.
    pub threshold: Threshold,
    /// Its values.
    pub values: Vec<f64>,
}

/// Why there is no such axis.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum AxisError {
    /// An end of it is not a number that has a logarithm.
    #[error("--threshold {threshold}: --{end} is {value}, not a finite number above 0")]
    Value {
        /// The name of the threshold.
        threshold: &'static str,
        /// Which end: `from` or `to`.
        end: &'static str,
        /// The value refused.
        value: f64,
    },
    /// It would descend.
    #[error("--threshold {threshold}: --from {from:e} is above --to {to:e}")]
    Order {
        /// The name of the threshold.
        threshold: &'static str,
        /// The first value.
        from: f64,
        /// The last value.
        to: f64,
    },
    /// It has no value, or more than a sweep ends with.
    #[error("--threshold {threshold}: --steps is {steps}, not a number from 1 to {MOST_STEPS}")]
    Steps {
        /// The name of the threshold.
        threshold: &'static str,
        /// The number refused.
        steps: usize,
    },
    /// The product has more settings than a sweep ends with.
    #[error("the grid has {0} settings; at most {MOST_SETTINGS} are swept at once")]
    Settings(u128),
    /// Two axes are of the same threshold.
    #[error("--threshold {0} is there twice")]
    Twice(&'static str),
}

const MOST_STEPS: usize = 10_000;
const MOST_SETTINGS: u128 = 100_000;

/// How many values an axis has by default.
pub const STEPS: usize = 30;

impl Axis {
    /// `steps` values from `from` to `to`, each the same factor above the one before.
    ///
    /// # Errors
    ///
    /// [`AxisError`] names the value that is not taken.
    pub fn new(threshold: Threshold, from: f64, to: f64, steps: usize) -> Result<Self, AxisError> {
        let name = threshold.name();
        for (end, value) in [("from", from), ("to", to)] {
            if !(value > 0.0 && value.is_finite()) {
                return Err(AxisError::Value {
                    threshold: name,
                    end,
                    value,
                });
            }
        }
        if from > to {
            return Err(AxisError::Order {
                threshold: name,
                from,
                to,
            });
        }
        if !(1..=MOST_STEPS).contains(&steps) {
            return Err(AxisError::Steps {
                threshold: name,
                steps,
            });
        }
        Ok(Axis {
            threshold,
            values: (0..steps).map(|step| at(from, to, step, steps)).collect(),
        })
    }

    /// The ends of the values that are swept by default: half decades, from below what rounding
    /// hides to the size of what is compared, for edges of the size of the domain.
    pub fn usual_ends(threshold: Threshold, domain: &Domain) -> [f64; 2] {
        let exponents = match threshold {
            Threshold::Dist | Threshold::Dist1d | Threshold::T => [-15.0, -0.5],
            Threshold::CoefficientsQuadratic | Threshold::CoefficientsCubic => [-18.0, -3.5],
        };
        let unit = domain.metres().powi(threshold.dimension());
        exponents.map(|exponent: f64| 10f64.powf(exponent) * unit)
    }
}

/// Value number `step` of `steps`.
fn at(from: f64, to: f64, step: usize, steps: usize) -> f64 {
    if step + 1 == steps && step > 0 {
        return to;
    }
    let part = step as f64 / (steps - 1).max(1) as f64;
    from * (to / from).powf(part)
}

/// Settings that are swept: table 3.1 but for the thresholds of the axes.
#[derive(Clone, Debug, PartialEq)]
pub struct Grid {
    /// The thresholds that change.
    pub axes: Vec<Axis>,
    /// Whether every value of one axis goes with every value of the others; else each axis is swept
    /// alone.
    pub is_product: bool,
}

impl Grid {
    /// Every combination of the values of these axes.
    ///
    /// # Errors
    ///
    /// [`AxisError`] for two axes of one threshold, or too many settings.
    pub fn product(axes: Vec<Axis>) -> Result<Self, AxisError> {
        for (index, axis) in axes.iter().enumerate() {
            let before = &axes[..index];
            if before.iter().any(|other| other.threshold == axis.threshold) {
                return Err(AxisError::Twice(axis.threshold.name()));
            }
        }
        let settings = axes.iter().map(|axis| axis.values.len() as u128).product();
        if settings > MOST_SETTINGS {
            return Err(AxisError::Settings(settings));
        }
        Ok(Grid {
            axes,
            is_product: true,
        })
    }

    /// Each axis alone.
    pub fn alone(axes: Vec<Axis>) -> Self {
        Grid {
            axes,
            is_product: false,
        }
    }

    /// The settings, those of the last axis next to each other.
    pub fn settings(&self) -> Vec<Setting> {
        let start = vec![Setting::published()];
        let spread = |settings: Vec<Setting>, axis: &Axis| {
            let each = settings.iter().flat_map(|setting| {
                let values = axis.values.iter();
                values.map(|&value| setting.with(axis.threshold, value))
            });
            each.collect()
        };
        if self.is_product {
            self.axes.iter().fold(start, spread)
        } else {
            let axes = self.axes.iter();
            axes.flat_map(|axis| spread(start.clone(), axis)).collect()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn axis(threshold: Threshold, steps: usize) -> Axis {
        Axis::new(threshold, 1e-6, 1e-2, steps).unwrap()
    }

    #[test]
    fn axis_values_grow_by_one_factor_and_hold_both_ends() {
        let values = axis(Threshold::Dist, 5).values;
        assert_eq!((values[0], values[4]), (1e-6, 1e-2));
        for pair in values.windows(2) {
            assert!((pair[1] / pair[0] - 10.0).abs() < 1e-9, "{values:?}");
        }
        assert_eq!(axis(Threshold::Dist, 1).values, [1e-6]);
    }

    #[test]
    fn axis_refuses_what_it_cannot_span() {
        let refused = |from, to, steps| {
            let error = Axis::new(Threshold::T, from, to, steps).unwrap_err();
            error.to_string()
        };
        assert!(refused(f64::NAN, 1.0, 3).contains("--from is NaN"));
        assert!(refused(1.0, f64::INFINITY, 3).contains("--to is inf"));
        assert!(refused(-1.0, 1.0, 3).contains("--from is -1"));
        assert!(refused(0.0, 1.0, 3).contains("--from is 0"));
        assert!(refused(2.0, 1.0, 3).contains("--from 2e0 is above --to 1e0"));
        assert!(refused(1.0, 2.0, 0).contains("--steps is 0"));
    }

    #[test]
    fn grid_alone_has_a_setting_for_each_value() {
        let axes = vec![axis(Threshold::Dist, 3), axis(Threshold::T, 2)];
        let settings = Grid::alone(axes).settings();
        assert_eq!(settings.len(), 5);
        assert_eq!(
            settings[0],
            Setting::published().with(Threshold::Dist, 1e-6)
        );
        assert_eq!(settings[4], Setting::published().with(Threshold::T, 1e-2));
    }

    #[test]
    fn grid_product_has_every_combination_once() {
        let axes = vec![axis(Threshold::Dist, 3), axis(Threshold::T, 2)];
        let settings = Grid::product(axes).unwrap().settings();
        let distinct: std::collections::BTreeSet<_> = settings.iter().map(Setting::bits).collect();
        assert_eq!((settings.len(), distinct.len()), (6, 6));
    }

    #[test]
    fn grid_product_refuses_too_much_and_the_same_twice() {
        let many = vec![axis(Threshold::Dist, 1000), axis(Threshold::T, 1000)];
        assert_eq!(Grid::product(many), Err(AxisError::Settings(1_000_000)));
        let twice = vec![axis(Threshold::T, 2), axis(Threshold::T, 3)];
        assert_eq!(Grid::product(twice), Err(AxisError::Twice("t")));
    }
}
