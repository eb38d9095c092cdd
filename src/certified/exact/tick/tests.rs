use proptest::prelude::*;

use super::*;

proptest! {
    #[test]
    fn tick_is_between_the_same_neighbours_as_its_dyadic(bits: u128, shift in 0u32..128) {
        let tick = Tick((bits >> shift).max(1));
        let dyadic = tick.to_dyadic();
        prop_assert_eq!((tick.below(), tick.above()), (dyadic.below(), dyadic.above()));
        prop_assert_eq!(Tick::from_dyadic(&dyadic), Some(Some(tick)));
    }

    #[test]
    fn tick_of_f64_is_that_f64_or_too_fine(value in prop_oneof![0.0..1.0f64, 0.0..1e-20f64]) {
        match Tick::from_f64(value) {
            Some(tick) => prop_assert_eq!((tick.below(), tick.above()), (value, value)),
            None => prop_assert!(value < 2f64.powi(-75)),
        }
    }

    #[test]
    fn tick_distance_is_not_below_the_exact_one(a: u128, b: u128) {
        let (low, high) = (Tick(a.min(b)), Tick(a.max(b)));
        let distance = low.distance(high);
        prop_assert!(distance >= 2f64.powi(127) || distance as u128 >= high.0 - low.0);
    }
}

#[test]
fn tick_refuses_what_is_not_inside_the_step() {
    for value in [0.0, 1.0, -0.5, 2.0, f64::NAN, f64::INFINITY] {
        assert_eq!(Tick::from_f64(value), None, "{value}");
    }
    assert_eq!(Tick::from_dyadic(&Dyadic::zero()), Some(None));
    assert_eq!(Tick::from_dyadic(&Dyadic::one()), Some(None));
}
