//! Values of the five thresholds of table 3.1.

use serde::{Deserialize, Serialize};
use tunnelproof::query::EdgeEdge;
use tunnelproof::thesis::general::handle_general_case;
use tunnelproof::thesis::{Motion, Options, Threshold, Thresholds};

use tunnelproof_reference::answer::Enclosure;
use tunnelproof_reference::subject::Said;

/// A value for each threshold of table 3.1, in the order of [`Threshold::ALL`].
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(from = "Fields", into = "Fields")]
pub struct Setting(pub [f64; 5]);

impl Setting {
    /// Every threshold 0.
    pub const ZERO: Setting = Setting([0.0; 5]);

    /// Table 3.1.
    pub fn published() -> Self {
        Setting(Threshold::ALL.map(Threshold::published))
    }

    /// One number without unit in the place of all: times `length` in metres to the power that each
    /// threshold is compared with.
    pub fn relative(threshold: f64, length: f64) -> Self {
        Setting(Threshold::ALL.map(|own| threshold * length.powi(own.dimension())))
    }

    /// The value of a threshold.
    pub fn get(&self, threshold: Threshold) -> f64 {
        self.0[threshold as usize]
    }

    /// The same with another value for one threshold.
    #[must_use]
    pub fn with(mut self, threshold: Threshold, value: f64) -> Self {
        self.0[threshold as usize] = value;
        self
    }

    /// The thesis path with these thresholds, otherwise as by default.
    pub fn options(&self) -> Options {
        Options {
            thresholds: Thresholds::named(self.0),
            ..Options::default()
        }
    }

    /// What the thesis path says with these thresholds.
    pub fn answer(&self, query: &EdgeEdge) -> Said {
        let (case, toi) = handle_general_case(&Motion::of_query(query), &self.options());
        Said {
            toi: toi.map(Enclosure::exactly),
            case: Some(case),
        }
    }

    /// What tells it from every other.
    pub fn bits(&self) -> [u64; 5] {
        self.0.map(f64::to_bits)
    }
}

/// A setting as it is written.
#[derive(Serialize, Deserialize)]
struct Fields {
    dist: f64,
    dist_1d: f64,
    t: f64,
    coefficients_quadratic: f64,
    coefficients_cubic: f64,
}

impl From<Setting> for Fields {
    fn from(Setting(values): Setting) -> Self {
        let [dist, dist_1d, t, coefficients_quadratic, coefficients_cubic] = values;
        Fields {
            dist,
            dist_1d,
            t,
            coefficients_quadratic,
            coefficients_cubic,
        }
    }
}

impl From<Fields> for Setting {
    fn from(fields: Fields) -> Self {
        Setting([
            fields.dist,
            fields.dist_1d,
            fields.t,
            fields.coefficients_quadratic,
            fields.coefficients_cubic,
        ])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn setting_published_is_the_default_of_the_thesis_path() {
        assert_eq!(Setting::published().options(), Options::default());
    }

    #[test]
    fn setting_is_written_by_the_names_of_the_thresholds() {
        let setting = Setting([1.0, 2.0, 3.0, 4.0, 5.0]);
        let json = serde_json::to_value(setting).unwrap();
        for (threshold, value) in Threshold::ALL.into_iter().zip(setting.0) {
            assert_eq!(json[threshold.name()], value);
            assert_eq!(setting.get(threshold), value);
            assert_eq!(Setting::ZERO.with(threshold, value).get(threshold), value);
        }
        assert_eq!(serde_json::from_value::<Setting>(json).unwrap(), setting);
    }

    #[test]
    fn setting_relative_has_the_unit_of_each_threshold() {
        let setting = Setting::relative(0.5, 4.0);
        assert_eq!(setting.0, [2.0, 2.0, 0.5, 8.0, 32.0]);
    }
}
