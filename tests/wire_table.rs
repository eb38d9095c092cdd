//! Every case with a known answer, within its tolerance.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod analytic;

use analytic::CASES;

/// One test for each case, so that they run side by side and fail one by one.
macro_rules! cases {
    ($($test:ident: $name:literal,)*) => {
        $(#[test]
        fn $test() {
            let case = CASES.iter().find(|case| case.name == $name).unwrap();
            let rows = (case.run)().unwrap();
            assert!(!rows.is_empty());
            for row in rows {
                assert!(row.holds(), "{} ({}): {row:?}, off by {:e}", case.name, case.formula, row.deviation());
            }
        })*

        #[test]
        fn table_has_a_test_for_every_case() {
            let tested = [$($name),*];
            assert!(CASES.iter().all(|case| tested.contains(&case.name)));
        }
    };
}

cases! {
    free_fall_is_exact_for_the_integrator: "free fall",
    stretch_is_hookes: "elastic stretch",
    pendulum_has_its_period: "pendulum",
    string_has_the_modes_of_its_segments: "string modes",
    load_that_sways_keeps_its_angle_at_any_step: "sway",
    light_load_keeps_its_angle_at_any_step: "light pendulum",
    taut_string_sounds_at_its_pitch_at_any_step: "taut string",
    chain_hangs_in_a_catenary: "catenary",
    cantilever_bends_as_a_beam: "cantilever",
    capstan_holds_the_ratio_of_tensions: "capstan",
    load_is_drawn_over_a_drum_by_its_weight_times_the_bound: "load drawn over a drum",
    loads_over_a_drum_fall_as_on_atwoods_machine: "Atwood's machine",
    block_that_turns_carries_the_same_in_both_legs: "block that turns",
    winch_moves_a_load_by_what_it_lets_out: "winch",
    pendulum_that_is_hauled_in_keeps_energy_over_frequency: "pendulum that is hauled in",
    incline_holds_up_to_the_coefficient_of_friction: "incline",
    crossing_wires_rest_on_each_other: "crossing wires at rest",
    twisted_wires_lift_and_turn_their_load: "four wires twisted",
    momentum_of_an_isolated_system_stays: "momentum",
    angular_momentum_of_an_isolated_chain_stays: "angular momentum",
    energy_never_rises_but_for_the_order_of_the_step: "energy",
    cantilever_bends_far_as_the_elastica: "cantilever, bent far",
    column_buckles_as_the_elastica: "column, buckled",
    column_bends_over_at_greenhills_height: "tallest column",
    rope_hangs_in_an_elastic_catenary: "elastic catenary",
    folded_chain_falls_ahead_of_free_fall: "folded chain",
    hanging_chain_swings_as_bernoulli_found: "hanging chain",
    sagging_cable_has_the_frequency_of_its_stretch: "sagging cable",
    torsion_pendulum_has_its_frequency: "torsion pendulum",
    turn_of_an_end_gives_its_torque: "prescribed turn",
    twisted_rod_buckles_as_greenhill_found: "twisted rod",
    twisted_ring_leaves_its_plane_as_michell_found: "twisted ring",
    knot_is_pulled_by_the_force_that_audoly_and_others_found: "overhand knot",
}
