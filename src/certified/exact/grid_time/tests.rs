use proptest::prelude::*;

use super::*;

proptest! {
    #[test]
    fn grid_time_is_between_the_same_neighbours_as_its_dyadic(bits: u128, shift in 0u32..128) {
        let grid_time = GridTime((bits >> shift).max(1));
        let dyadic = grid_time.to_dyadic();
        prop_assert_eq!((grid_time.below(), grid_time.above()), (dyadic.below(), dyadic.above()));
        prop_assert_eq!(GridTime::from_dyadic(&dyadic), Ok(Some(grid_time)));
    }

    #[test]
    fn grid_time_of_f64_is_that_f64_or_too_fine(value in prop_oneof![0.0..1.0f64, 0.0..1e-20f64]) {
        match GridTime::from_f64(value) {
            Some(grid_time) => prop_assert_eq!((grid_time.below(), grid_time.above()), (value, value)),
            None => prop_assert!(value < 2f64.powi(-75)),
        }
    }

    #[test]
    fn grid_time_distance_is_not_below_the_exact_one(a: u128, b: u128) {
        let (low, high) = (GridTime(a.min(b)), GridTime(a.max(b)));
        let distance = low.distance(high);
        prop_assert!(distance >= 2f64.powi(127) || distance as u128 >= high.0 - low.0);
    }
}

#[test]
fn grid_time_refuses_what_is_not_inside_the_step() {
    for value in [0.0, 1.0, -0.5, 2.0, f64::NAN, f64::INFINITY] {
        assert_eq!(GridTime::from_f64(value), None, "{value}");
    }
    assert_eq!(GridTime::from_dyadic(&Dyadic::zero()), Ok(None));
    assert_eq!(GridTime::from_dyadic(&Dyadic::one()), Ok(None));
}

/// Exhaustive in what decides: every length, every end of what a `f64` keeps, and every beginning
/// and end of what it drops.
#[test]
fn grid_time_of_every_length_is_between_its_neighbours() {
    for length in 1..=128u32 {
        let kept = length.min(53);
        let dropped = length - kept;
        for kept_end in 0..16u128 {
            for (dropped_begin, dropped_end) in
                (0..4u128).flat_map(|b| (0..4u128).map(move |e| (b, e)))
            {
                for middle in [0, u128::MAX] {
                    let leading = 1u128 << (kept - 1);
                    let middle = middle >> (128 - kept) >> 1;
                    let whole = leading | (middle & !15) | (kept_end & (leading | (leading - 1)));
                    let rest = if dropped == 0 {
                        0
                    } else {
                        let mask = u128::MAX >> (128 - dropped);
                        let begin = if dropped >= 2 {
                            dropped_begin << (dropped - 2)
                        } else {
                            0
                        };
                        (begin | dropped_end) & mask
                    };
                    let grid_time = GridTime(whole << dropped | rest);
                    // Exact: 53 bits, and a power of two.
                    let below = whole as f64 * 2f64.powi(dropped as i32 - 128);
                    let above = if rest == 0 {
                        below
                    } else {
                        (whole + 1) as f64 * 2f64.powi(dropped as i32 - 128)
                    };
                    assert_eq!(
                        (grid_time.below(), grid_time.above()),
                        (below, above),
                        "{grid_time:x?}"
                    );
                    let rounded = grid_time.to_f64();
                    assert!(rounded == below || rounded == above, "{grid_time:x?}");
                    let found = GridTime::from_f64(below);
                    let is_in_step = below > 0.0 && below < 1.0;
                    assert_eq!(
                        found,
                        is_in_step.then_some(GridTime(whole << dropped)),
                        "{grid_time:x?}"
                    );
                }
            }
        }
    }
}
