use proptest::prelude::*;

use super::super::cubic::Cubic;
use super::super::motion::Motion;
use super::super::root::Bracket;
use super::super::testing::{Random, layout, points};
use super::*;
use crate::certified::kind::Stages;
use crate::query::EdgeEdge;

/// Any number that is not NaN, those at the borders of the format as often as not.
fn number() -> impl Strategy<Value = f64> {
    let borders = vec![
        0.0,
        -0.0,
        1.0,
        -1.0,
        f64::from_bits(1),
        -f64::from_bits(1),
        f64::MIN_POSITIVE,
        f64::MIN_POSITIVE.next_down(),
        f64::MAX,
        f64::MIN,
        f64::INFINITY,
        f64::NEG_INFINITY,
    ];
    prop_oneof![
        prop::sample::select(borders),
        any::<u64>()
            .prop_map(f64::from_bits)
            .prop_filter("not NaN", |x| !x.is_nan()),
        -1.0..1.0,
    ]
}

/// The bits of both ends; all NaN are one, as nobody looks at which it is.
fn bits(x: impl Ends) -> [u64; 2] {
    [x.start(), x.end()].map(|x| {
        if x.is_nan() {
            f64::NAN.to_bits()
        } else {
            x.to_bits()
        }
    })
}

/// Everything that can be done with two numbers.
fn all_of<E: Ends>([a, b, c, d]: [f64; 4]) -> (Vec<[u64; 2]>, [bool; 2]) {
    let (x, y) = (E::new(a, b), E::new(c, d));
    let [p, q] = x.transposed(y);
    let numbers = [
        x + y,
        x - y,
        x * y,
        x.abs(),
        x.larger(y),
        x.smaller(y),
        x.swapped(),
        p,
        q,
        E::both(a),
        E::new(x.largest(), x.least()),
        E::both(x.sum()),
    ];
    (numbers.map(bits).to_vec(), x.is_above(y))
}

/// Everything that the stages compute of edges, as text: two texts are the same if all bits are.
fn stages<E: Ends + std::fmt::Debug>(coordinates: &[f64], [low, high]: [f64; 2]) -> String {
    let points = layout(coordinates).points::<E>();
    let motion = Motion::new(&points);
    let differences = [motion.k, motion.l, motion.m].map(|x| x.map(bits));
    let boxes = EdgeEdge::boxes(&points, 0.0);
    let cubic = Cubic::unchecked(&motion);
    let bracket = Bracket {
        low,
        high,
        is_rising: true,
    };
    let meeting = motion.meeting(&cubic, &bracket);
    let is_separated = motion.is_separated_by_centres(&boxes);
    let by_search = motion.is_separated_by_search(&boxes);
    format!("{differences:?} {boxes:?} {is_separated} {by_search} {cubic:?} {meeting:?}")
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(50_000))]

    #[test]
    fn ends_agree_in_every_operation(numbers in prop::array::uniform4(number())) {
        prop_assert_eq!(all_of::<f64x2>(numbers), all_of::<Plain>(numbers));
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(10_000))]

    #[test]
    fn ends_agree_in_every_stage_on_any_numbers(
        coordinates in prop::array::uniform24(number().prop_filter("finite", |x| x.is_finite())),
        bracket in prop::array::uniform2(0.0..=1.0),
    ) {
        prop_assert_eq!(stages::<f64x2>(&coordinates, bracket), stages::<Plain>(&coordinates, bracket));
    }

    #[test]
    fn ends_agree_in_every_stage_on_edges(seed: u64, bracket in prop::array::uniform2(0.0..=1.0)) {
        let coordinates = points(&mut Random::new(seed), (-1074, 1020));
        prop_assert_eq!(stages::<f64x2>(&coordinates, bracket), stages::<Plain>(&coordinates, bracket));
    }
}
