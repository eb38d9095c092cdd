use super::*;
use crate::perturb::perturbed;

fn basic_collision(duration: f64) -> Vec<Scene> {
    let mut scenes = scenes(duration).unwrap();
    scenes.truncate(1);
    scenes
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
    assert!(last("certified").starts_with("0, 0 / "), "{text}");
    assert!(last("certified").ends_with("; 0"), "{text}");
}

#[test]
fn largest_discrete_step_of_scene_1_does_not_tunnel_and_the_next_does() {
    let scene = &basic_collision(0.1)[0];
    let (step, run) = largest_discrete_step(scene).unwrap().unwrap();
    assert!(run.report.is_clean());
    // That of the thesis.
    assert_eq!(step, 0.004);
    let mut longer = scene.clone();
    longer.settings.step = 0.005;
    let longer = audited(&longer, Narrow::Discrete, Mode::Thesis).unwrap();
    assert_eq!(longer.report.standing.len(), 2);
}

#[test]
fn safe_discrete_step_holds_from_other_starts_as_well() {
    let scene = &basic_collision(0.1)[0];
    let safe = |longest, count| safe_discrete_step(scene, longest, count, 1e-3).unwrap();
    // At 6 ms a step happens to end where the wires overlap; from the third start it does not, and at 5 ms from none.
    assert_eq!(safe(0.006, 0), Some(0.006));
    assert_eq!(safe(0.005, 0), Some(0.004));
    assert_eq!(safe(0.006, 2), Some(0.006));
    assert_eq!(safe(0.006, 3), Some(0.004));
    let mut start = perturbed(scene, 3, 1e-3);
    start.settings.step = 0.006;
    let run = audited(&start, Narrow::Discrete, Mode::Thesis).unwrap();
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
        assert_eq!((cells[0], &cells[2..]), ("6", &["0"; 3][..]), "{text}");
        assert_ne!(cells[1], "0", "{text}");
    }
}
