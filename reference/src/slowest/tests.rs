use std::collections::HashSet;

use super::*;
use crate::generate::by_name;
use crate::registry::by_name as subject;

/// The bits of the coordinates that are set.
fn bits(query: &Query) -> Option<u32> {
    let shape = Shape::new(query);
    Some(shape.numbers.iter().map(|x| x.to_bits().count_ones()).sum())
}

fn families() -> [&'static Family; 2] {
    ["uniform", "thick_uniform"].map(|name| by_name(name).unwrap())
}

fn found(seed: u64, turns: u32) -> Vec<Costly<u32>> {
    let families = families();
    let mut search = Search::new(&families, seed, 4, bits);
    (0..turns).for_each(|_| search.turn());
    assert!(search.asked() > u64::from(turns / 2) && search.asked() <= u64::from(turns));
    search.costliest()
}

#[test]
fn search_climbs_and_gives_the_costliest_first() {
    let (drawn, climbed) = (found(1, 4 * DRAWN), found(1, 12_000));
    assert_eq!((drawn.len(), climbed.len()), (4, 4));
    for found in [&drawn, &climbed] {
        assert!(found.windows(2).all(|pair| pair[0].cost >= pair[1].cost));
        assert!(
            found
                .iter()
                .all(|costly| bits(&costly.query) == Some(costly.cost))
        );
    }
    // Of 24 times 64; the draws have half of the bits.
    assert!(drawn[0].cost < 900, "{}", drawn[0].cost);
    assert!(climbed[3].cost > 1000, "{}", climbed[3].cost);
}

#[test]
fn search_depends_on_the_seed_alone_where_costs_do_not_vary() {
    assert_eq!(found(2, 800), found(2, 800));
    assert_ne!(found(2, 800), found(3, 800));
}

#[test]
fn a_climb_that_gets_no_further_makes_room_and_is_not_lost() {
    let families = families();
    // Each costs less than all before it.
    let mut cost = 1_000_000;
    let mut search = Search::new(&families, 1, 1, |_| {
        cost -= 1;
        Some(cost)
    });
    (0..DRAWN + PATIENCE).for_each(|_| search.turn());
    assert_eq!(search.climbs[0].drawn, 0);
    (0..DRAWN + 10).for_each(|_| search.turn());
    assert_eq!(search.climbs[0].in_vain, 10);
    // The first one drawn, as it was measured the last time.
    let [costly] = search.costliest().try_into().unwrap();
    assert_eq!(costly.cost, 1_000_000 - 1 - REPEATS);
}

#[test]
fn a_measurement_counts_if_it_is_seen_again() {
    let families = families();
    let mut asked = 0;
    // Every fourth takes a thousand times as long, whatever is asked.
    let mut search = Search::new(&families, 1, 2, |_| {
        asked += 1;
        Some(if asked % 4 == 0 { 1000 } else { 1 })
    });
    (0..1000).for_each(|_| search.turn());
    assert!(search.costliest().iter().all(|costly| costly.cost == 1));
}

#[test]
fn queries_that_a_subject_does_not_take_are_passed_over() {
    let families = families();
    let thesis = subject("thesis").unwrap();
    let mut search = Search::new(&families, 1, 3, |query| time(thesis, query).ok());
    (0..200).for_each(|_| search.turn());
    let found = search.costliest();
    assert_eq!(found.len(), 3);
    assert!(
        found
            .iter()
            .all(|costly| costly.query.radius().parts() == [0.0; 2])
    );
    let none = [by_name("thick_uniform").unwrap()];
    let mut search = Search::new(&none, 1, 3, |query| time(thesis, query).ok());
    (0..200).for_each(|_| search.turn());
    assert!(search.costliest().is_empty());
}

#[test]
fn changes_reach_coincidences_and_all_exponents() {
    let mut rng = stream("changes", 1, 0);
    let start = Shape::new(&by_name("thick_uniform").unwrap().query(1, 0));
    let (mut exponents, mut coincidences, mut radii) = (HashSet::new(), 0, HashSet::new());
    for _ in 0..20_000 {
        let mut shape = start;
        change::change(&mut shape, &mut rng);
        if shape.query().is_none() {
            continue;
        }
        let changed = shape.numbers.iter().zip(start.numbers);
        exponents.extend(
            changed
                .filter(|(own, before)| *own != before)
                .map(|(own, _)| own.to_bits() >> 52 & 0x7ff),
        );
        let positions: HashSet<_> = (0..8)
            .map(|i| shape.position(i).map(f64::to_bits))
            .collect();
        coincidences += u32::from(positions.len() < 8);
        radii.insert(shape.radii[0].to_bits());
    }
    assert!(exponents.len() > 800, "{}", exponents.len());
    assert!(exponents.contains(&0) && exponents.iter().any(|at| *at > 2000));
    assert!(
        coincidences > 1000 && radii.len() > 500,
        "{coincidences} {}",
        radii.len()
    );
}
