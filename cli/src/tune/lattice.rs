//! The settings that are searched: every threshold at 0 or at a power of ten of its unit.

use tunnelproof::thesis::Threshold;

use crate::sweep::Setting;

/// A setting by the numbers of its values.
pub type Place = [usize; 5];

/// Settings for scenes of one size: each threshold is 0, or from 1e-18 to 0.1 times the size to the
/// power that its unit asks, one value a decade.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lattice {
    /// The size of the scene in metres.
    pub length: f64,
}

impl Lattice {
    /// How many values each threshold has.
    pub const VALUES: usize = 19;

    /// Every threshold 0.
    pub const ZERO: Place = [0; 5];

    /// The threshold without unit at a number.
    pub fn relative(value: usize) -> f64 {
        match value {
            0 => 0.0,
            value => 10f64.powi(value as i32 - Self::VALUES as i32),
        }
    }

    /// The setting at a place.
    pub fn setting(&self, place: Place) -> Setting {
        Setting(Threshold::ALL.map(|threshold| {
            let value = Self::relative(place[threshold as usize]);
            Setting::relative(value, self.length).get(threshold)
        }))
    }

    /// The place whose values are nearest to those of a setting, by their logarithms.
    pub fn nearest(&self, setting: &Setting) -> Place {
        Threshold::ALL.map(|threshold| {
            let unit = self.length.powi(threshold.dimension());
            let decade = (setting.get(threshold) / unit).log10().round();
            let number = decade + Self::VALUES as f64;
            number.clamp(0.0, (Self::VALUES - 1) as f64) as usize
        })
    }

    /// The places that differ from one in one threshold of those that are `free`.
    pub fn neighbours(place: Place, free: [bool; 5]) -> impl Iterator<Item = Place> {
        let axes = (0..5).filter(move |&axis| free[axis]);
        let lines = axes.flat_map(|axis| (0..Self::VALUES).map(move |value| (axis, value)));
        lines.filter_map(move |(axis, value)| {
            let mut other = place;
            other[axis] = value;
            (other != place).then_some(other)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lattice_values_are_zero_and_powers_of_ten_in_the_unit_of_each() {
        let lattice = Lattice { length: 4.0 };
        assert_eq!(lattice.setting(Lattice::ZERO), Setting::ZERO);
        let setting = lattice.setting([18, 17, 1, 18, 9]);
        let expected = [0.4, 0.04, 1e-18, 1.6, 6.4e-9];
        for (value, expected) in setting.0.into_iter().zip(expected) {
            assert!((value / expected - 1.0).abs() < 1e-12, "{setting:?}");
        }
    }

    #[test]
    fn lattice_nearest_finds_every_place_again() {
        let lattice = Lattice { length: 1e-3 };
        for place in [[0, 1, 2, 3, 18], [18, 17, 16, 0, 9], Lattice::ZERO] {
            assert_eq!(lattice.nearest(&lattice.setting(place)), place);
        }
        let published = Lattice { length: 1.0 }.nearest(&Setting::published());
        assert_eq!(
            published.map(Lattice::relative),
            [1e-6, 1e-6, 1e-9, 1e-14, 1e-14]
        );
    }

    #[test]
    fn lattice_neighbours_change_one_free_threshold_each() {
        let place = [1, 2, 3, 4, 5];
        let all: Vec<_> = Lattice::neighbours(place, [true; 5]).collect();
        assert_eq!(all.len(), 5 * (Lattice::VALUES - 1));
        let some: Vec<_> = Lattice::neighbours(place, [false, true, false, false, true]).collect();
        assert_eq!(some.len(), 2 * (Lattice::VALUES - 1));
        for other in some {
            let changed = (0..5).filter(|&axis| other[axis] != place[axis]);
            assert!(matches!(changed.collect::<Vec<_>>()[..], [1] | [4]));
        }
    }
}
