//! The judges on the figure cases of the thesis: case, time of impact, configuration and number of
//! contact points are what the captions state, exactly.

use num_bigint::BigInt;
use tunnelproof::scenario::figures::FIGURES;
use tunnelproof_reference::field::{self, Integer, Ratio};
use tunnelproof_reference::oracle;

fn oracle_confirms_every_figure<Z: Integer>() {
    for figure in FIGURES {
        let decision = oracle::decide::<Z>(&figure.query()).expect("a figure has radius 0");
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
