//! The judges on the figure cases of the thesis: case, time of impact, configuration and number of
//! contact points are what the captions state, exactly.

use num_bigint::BigInt;
use tunnelproof::query::{Query, QueryKind};
use tunnelproof_reference::field::{self, Integer, Ratio};
use tunnelproof_reference::figures::FIGURES;
use tunnelproof_reference::{difference, oracle};

fn oracle_confirms_every_figure<Z: Integer>() {
    for figure in FIGURES {
        let decision = oracle::decide::<Z>(&Query::EdgeEdge(figure.query()));
        let (name, answer) = (figure.name, decision.written());
        assert_eq!(answer.case, figure.case, "figure {name}");
        let Some(contact) = figure.contact else {
            assert_eq!(answer.hit, None, "figure {name}");
            continue;
        };
        let hit = answer.hit.expect("a figure with contact is a hit");
        let integer = |n: u32| Z::from_i64(n.into());
        let expected = Z::Ratio::new(
            integer(contact.toi.numerator),
            integer(contact.toi.denominator),
        );
        assert_eq!(
            decision.toi().and_then(|toi| toi.rational()),
            Some(expected),
            "figure {name}"
        );
        assert_eq!(hit.flags, contact.flags, "figure {name}");
        assert_eq!(
            1 + usize::from(hit.second.is_some()),
            contact.points,
            "figure {name}"
        );
    }
}

#[test]
fn oracle_confirms_every_figure_num_bigint() {
    oracle_confirms_every_figure::<BigInt>();
}

#[test]
fn oracle_confirms_every_figure_default_backend() {
    oracle_confirms_every_figure::<field::Default>();
}

/// Figure 4.7 with a radius: the wires touch though their midlines pass beside each other.
#[test]
fn oracle_finds_figure_4_7_in_contact_at_the_exact_time_with_a_radius() {
    let figure = FIGURES.iter().find(|figure| figure.name == "4.7");
    let midlines = figure.expect("the figure is there").query();
    let thick = |radius: [f64; 2]| {
        Query::new(
            QueryKind::EdgeEdge,
            *midlines.start(),
            *midlines.end(),
            radius,
        )
        .expect("a radius above 0")
    };
    // B and C are 2 - 6 t apart along x and 1/64 across: at the distance 5/256 with 3/256 along x.
    let query = thick([1.0 / 64.0, 1.0 / 256.0]);
    let decision = oracle::decide::<BigInt>(&query);
    let toi = decision.toi().and_then(|toi| toi.rational());
    let ratio = <BigInt as Integer>::Ratio::new(BigInt::from(509), BigInt::from(1536));
    assert_eq!(toi, Some(ratio));
    let hit = decision.written().hit.expect("contact");
    assert_eq!(hit.features.map(|feature| feature.to_string()), ["B", "C"]);
    assert!(!hit.crosses && !hit.is_initial());
    assert_eq!(decision.written(), difference::decide::<BigInt>(&query));
    // The midlines are 1/64 apart where they are nearest: a little less is a miss.
    let just_less = (1.0f64 / 64.0).next_down();
    assert_eq!(
        oracle::decide::<BigInt>(&thick([just_less, 0.0]))
            .written()
            .hit,
        None
    );
    let just = oracle::decide::<BigInt>(&thick([1.0 / 64.0, 0.0])).written();
    assert!(just.hit.is_some_and(|hit| hit.second.is_none()));
}
