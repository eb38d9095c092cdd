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
