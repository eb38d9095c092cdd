use super::*;

fn basic_collision(duration: f64) -> Vec<OfThesis> {
    scenes(duration, Some("basic-collision")).unwrap()
}

#[test]
fn scene_of_a_name_keeps_its_figures() {
    let scenes = scenes(0.1, Some("chains-on-deck")).unwrap();
    assert_eq!(scenes.len(), 1);
    let text = cases(&scenes).unwrap();
    assert!(text.lines().nth(1).unwrap().ends_with("Chains on deck"));
    assert!(text.contains(" 26,958 / "), "{text}");
    let unknown = super::scenes(0.1, Some("bridge")).unwrap_err();
    assert!(unknown.to_string().contains("bridge"), "{unknown}");
}

#[test]
fn chances_of_tunnelling_in_scene_1_rise_from_nothing_below_the_step_in_which_it_falls_through_its_thickness()
 {
    let text = chances(&basic_collision(0.1), 20).unwrap();
    let count = |step: &str| -> u64 {
        let row = text.lines().find(|line| line.starts_with(step)).unwrap();
        row[NAME..].trim().parse().unwrap()
    };
    // At 10 m/s it falls through 40 mm, both radii, in 4 ms.
    assert_eq!(["1 ms", "2 ms", "3 ms"].map(count), [0; 3], "{text}");
    let [some, more] = ["5 ms", "16 ms"].map(count);
    assert!(0 < some && some < more, "{text}");
}

#[test]
fn table_4_1_counts_two_tunnels_in_scene_1() {
    let text = cases(&basic_collision(0.5)).unwrap();
    let row = text
        .lines()
        .find(|line| line.starts_with("Tunneled"))
        .unwrap();
    assert!(row.ends_with("2 / 2"), "{row}");
    let row = text
        .lines()
        .find(|line| line.starts_with("Case 4"))
        .unwrap();
    assert!(row.ends_with("0 / 0"), "{row}");
}

#[test]
fn table_of_missed_tunnels_has_discrete_detection_miss_and_the_certified_path_not() {
    let text = missed(&basic_collision(0.1)).unwrap();
    let last = |name: &str| {
        let row = text.lines().find(|line| line.starts_with(name)).unwrap();
        row[NAME..].trim().to_owned()
    };
    // Midlines meet in eight pairs, at two nodes. Nothing pushes the wires back.
    assert_eq!(last("discrete"), "8, 0 / 8; 2");
    // With either set of thresholds half of the pairs at a node are missed.
    assert_eq!([last("thesis"), last("tuned")], ["4, 0 / 10; 0"; 2]);
    assert!(last("certified").starts_with("0, 0 / "), "{text}");
    assert!(last("certified").ends_with("; 0"), "{text}");
}

#[test]
fn largest_discrete_step_of_scene_1_does_not_tunnel_and_the_next_does() {
    let scene = &basic_collision(0.1)[0].scene;
    let step = largest_discrete_step(scene).unwrap().unwrap();
    let report = |step| discrete::run(scene, 0, 0.0, step).unwrap().report;
    assert!(report(step).is_clean());
    // That of the thesis.
    assert_eq!(step, 0.004);
    assert_eq!(report(0.005).standing.len(), 2);
}

#[test]
fn safe_discrete_step_holds_from_other_starts_as_well() {
    let scene = &basic_collision(0.1)[0].scene;
    let safe = |longest, count| safe_discrete_step(scene, longest, count, 1e-3).unwrap();
    // At 6 ms a step happens to end where the wires overlap; from the third start it does not, and
    // at 5 ms from none.
    assert_eq!(safe(0.006, 0), Some(0.006));
    assert_eq!(safe(0.005, 0), Some(0.004));
    assert_eq!(safe(0.006, 2), Some(0.006));
    assert_eq!(safe(0.006, 3), Some(0.004));
    let run = discrete::run(scene, 3, 1e-3, 0.006).unwrap();
    assert!(!run.report.is_clean());
}

#[test]
fn table_of_starts_has_a_clean_row_for_each_start_of_scene_1() {
    let text = starts(&basic_collision(0.1), 3, 0.001).unwrap();
    let rows: Vec<_> = text.lines().skip(3).collect();
    assert_eq!(rows.len(), 4, "{text}");
    for (row, name) in rows.iter().zip(["as it is", "seed 1", "seed 2", "seed 3"]) {
        let cells: Vec<_> = row[NAME..].split_whitespace().collect();
        assert!(row.starts_with(name), "{text}");
        assert_eq!((cells[0], &cells[2..]), ("6", &["0"; 4][..]), "{text}");
        assert_ne!(cells[1], "0", "{text}");
    }
}

#[test]
fn table_4_2_has_the_figures_of_the_thesis_and_its_own_beside_them() {
    let text = times(&basic_collision(0.1), 1).unwrap();
    let cell = |name: &str| {
        let row = text.lines().find(|line| line.starts_with(name)).unwrap();
        let (thesis, ours) = row[NAME..].split_once(" / ").unwrap();
        (thesis.trim().to_owned(), ours.to_owned())
    };
    let steps = cell("Factor time steps (discrete / CCD)");
    assert_eq!(steps, ("4.167".to_owned(), "4.167".to_owned()), "{text}");
    assert_eq!(cell("Factor run time (discrete / CCD)").0, "4.144");
    assert_eq!(cell("Total run time change").0, "-75.87 %");
    assert_eq!(cell("Time step, s (2 starts)").1, "0.004");
    for row in ["  tests (CCD at 1/60 s)", "  per test, ns (discrete)"] {
        let number: f64 = cell(row).1.replace(',', "").parse().unwrap();
        assert!(number > 0.0, "{text}");
    }
}

#[test]
fn table_of_speeds_says_what_is_ambiguous() {
    let text = speeds(0.02).unwrap();
    let rows: Vec<_> = text.lines().skip(1).collect();
    assert_eq!(rows[0].matches("ambiguous").count(), 2, "{text}");
    assert_eq!(rows.len(), 9, "{text}");
    for row in &rows[1..] {
        assert_eq!(row[NAME..].split_whitespace().count(), 6, "{text}");
    }
}
