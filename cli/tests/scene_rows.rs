//! The scenes of the thesis (4.2): what comes out is what the thesis says, as far as each row of
//! `tunnelproof_cli::rows` accepts.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use tunnelproof_cli::rows::SCENES;
use tunnelproof_cli::scenes::EMBEDDED;

/// One test for each scene, so that they run side by side and fail one by one.
macro_rules! scenes {
    ($($test:ident: $name:literal,)*) => {
        $(#[test]
        fn $test() {
            let scene = SCENES.iter().find(|scene| scene.scene == $name).unwrap();
            let rows = (scene.run)().unwrap();
            assert!(!rows.is_empty());
            let differ: Vec<_> = rows.iter().filter(|row| !row.holds()).collect();
            assert!(differ.is_empty(), "{differ:#?}");
        })*

        #[test]
        fn rows_have_a_test_for_every_scene_of_the_thesis() {
            assert_eq!(SCENES.map(|scene| scene.scene), EMBEDDED.map(|(name, _)| name));
            assert_eq!(SCENES.map(|scene| scene.scene), [$($name),*]);
        }
    };
}

scenes! {
    basic_collision_tunnels_twice_or_not_at_all_and_comes_to_rest_on_both: "basic-collision",
    pulling_anchor_collides_slips_and_catches_the_cylinder: "pulling-anchor",
    twisting_under_load_winds_its_wires_up: "twisting-under-load",
    chains_on_deck_meet_and_are_pulled_twice: "chains-on-deck",
}
