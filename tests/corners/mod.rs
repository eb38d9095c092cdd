//! Where four points are at both ends of a step, drawn for the tests of the certified path.

use proptest::prelude::*;

/// The four points at the start, then at the end.
pub(crate) type Corners = [[f64; 3]; 8];

/// Queries of a kind: as many as `TUNNELPROOF_CASES` says, or else `usual`, of which a fifth where
/// Rust checks its arithmetic (`cargo test` without `--release`).
pub(crate) fn cases(usual: u32) -> u32 {
    let asked = std::env::var("TUNNELPROOF_CASES").ok();
    let usual = if cfg!(debug_assertions) {
        usual / 5
    } else {
        usual
    };
    asked.map_or(usual, |text| {
        text.parse().expect("TUNNELPROOF_CASES is a number")
    })
}

/// Small integers, confined to a line or a plane as often as not, with points repeated.
pub(crate) fn lattice() -> impl Strategy<Value = Corners> {
    let point = prop::array::uniform3(-2i8..=2);
    let points = prop::array::uniform8(point);
    let merged = prop::option::of((0usize..8, 0usize..8));
    (points, 0u8..7, merged).prop_map(|(mut p, confinement, merged)| {
        if let Some((from, to)) = merged {
            p[to] = p[from];
        }
        let confined = p.map(|[x, y, z]| match confinement {
            0 => [x, y, 0],
            1 => [x, x, x],
            2 => [x, y, x],
            3 => [x, y, i8::from(z > 0)],
            4 => [x, 0, i8::from(z > 0)],
            _ => [x, y, z],
        });
        confined.map(|point| point.map(f64::from))
    })
}

/// A coordinate between -1 and 1.
pub(crate) fn number() -> impl Strategy<Value = f64> {
    -1.0f64..1.0
}

/// Coordinates between -1 and 1.
pub(crate) fn uniform() -> impl Strategy<Value = Corners> {
    prop::array::uniform8(prop::array::uniform3(number()))
}

/// Coordinates between 1e-6 and 1e6 in magnitude, with all their bits.
pub(crate) fn ordinary_scales() -> impl Strategy<Value = Corners> {
    let coordinate = (number(), -20i32..=19).prop_map(|(x, e)| x * 2f64.powi(e));
    prop::array::uniform8(prop::array::uniform3(coordinate))
}

/// Every exponent that there is, within a band of random width.
pub(crate) fn all_scales() -> impl Strategy<Value = Corners> {
    let band = (
        -1074i32..=1023,
        prop::sample::select(vec![0, 10, 60, 200, 2100]),
    );
    let coordinate = (1.0..2.0f64, any::<bool>(), any::<u16>(), 0u8..8);
    let points = prop::array::uniform8(prop::array::uniform3(coordinate));
    (points, band).prop_map(|(points, (lowest, width))| {
        points.map(|point| {
            point.map(|(mantissa, is_negative, offset, zero)| {
                let exponent = (lowest + i32::from(offset) % (width + 1)).min(1023);
                let (half, rest) = (exponent / 2, exponent - exponent / 2);
                let value = mantissa * 2f64.powi(half) * 2f64.powi(rest);
                match (zero, is_negative) {
                    (0, _) => 0.0,
                    (_, true) => -value,
                    (_, false) => value,
                }
            })
        })
    })
}

/// Degenerate motion, disturbed by units in the last place.
pub(crate) fn nearly_degenerate() -> impl Strategy<Value = Corners> {
    let step = prop::sample::select(vec![0i8, 0, 0, 0, -1, 1, 2]);
    let steps = prop::array::uniform8(prop::array::uniform3(step));
    let scale = prop::sample::select(vec![1.0, 0.1, 1.0 / 3.0]);
    (lattice(), steps, scale).prop_map(|(points, steps, scale)| {
        let mut corners = points.map(|point| point.map(|x| x * scale));
        for (value, step) in corners
            .as_flattened_mut()
            .iter_mut()
            .zip(steps.as_flattened())
        {
            *value *= 1.0 + f64::from(*step) * f64::EPSILON;
        }
        corners
    })
}
