use proptest::prelude::*;
use tunnelproof::query::Point;

use super::jsonl::Numbers;
use super::*;
use crate::field::{self, Integer};

fn finite() -> impl Strategy<Value = f64> {
    prop_oneof![
        any::<u64>().prop_map(f64::from_bits),
        (0u64..1 << 53).prop_map(f64::from_bits),
        prop_oneof![
            Just(0.0),
            Just(-0.0),
            Just(f64::MAX),
            Just(1e308),
            Just(-5e-324)
        ],
    ]
    .prop_map(|value| if value.is_finite() { value } else { 0.1 })
}

fn eight_points() -> impl Strategy<Value = [Point; 8]> {
    proptest::array::uniform8(proptest::array::uniform3(finite()))
        .prop_map(|points| points.map(Point::from))
}

fn query(kind: QueryKind, points: [Point; 8], radius: [f64; 2]) -> Query {
    let [a, b, c, d, a1, b1, c1, d1] = points;
    Query::new(kind, [a, b, c, d], [a1, b1, c1, d1], radius).unwrap()
}

fn bits(query: &Query) -> Vec<u64> {
    let points = query.start().iter().chain(query.end());
    let coordinates = points.flat_map(|point| [point.x, point.y, point.z]);
    coordinates
        .chain(query.radius().parts())
        .map(f64::to_bits)
        .collect()
}

/// A finite `f64` as the fraction of two integers.
fn fraction(value: f64) -> [field::Default; 2] {
    let magnitude = value.abs().to_bits();
    let (mantissa, exponent) = match magnitude >> 52 {
        0 => (magnitude, -1074),
        biased => (magnitude & ((1 << 52) - 1) | 1 << 52, biased as i64 - 1075),
    };
    let mantissa = field::Default::from_i64(if value < 0.0 {
        -(mantissa as i64)
    } else {
        mantissa as i64
    });
    let power = |bits: i64| field::Default::one().shl(bits.max(0) as u64);
    [mantissa.mul(&power(exponent)), power(-exponent)]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(500))]

    #[test]
    fn jsonl_write_then_read_gives_the_same_bits(
        id: String,
        is_vertex_face: bool,
        points in eight_points(),
        radii in [finite(), finite()],
        label: Option<bool>,
        is_hexadecimal: bool,
    ) {
        let kind = if is_vertex_face { QueryKind::VertexFace } else { QueryKind::EdgeEdge };
        let query = query(kind, points, radii.map(f64::abs));
        let entry = Entry { id, query, label, line: Some(1) };
        let numbers = if is_hexadecimal { Numbers::Hexadecimal } else { Numbers::Decimal };
        let line = jsonl::write(&entry, numbers);
        prop_assert!(!line.contains('\n'));
        let read = entries("a.jsonl", line, ReadOptions::default());
        prop_assert_eq!(bits(&read[0].query), bits(&entry.query));
        prop_assert_eq!(&read, &[entry]);
    }

    /// Every `f64` as a fraction, with the same factor in numerator and denominator.
    #[test]
    fn csv_read_fractions_gives_the_same_bits(
        points in eight_points(),
        factor in prop_oneof![Just(1), any::<i64>().prop_filter("not 0", |factor| *factor != 0)],
        label: bool,
    ) {
        let factor = field::Default::from_i64(factor);
        let mut text = String::new();
        for point in &points {
            for &value in point.iter() {
                let [numerator, denominator] = fraction(value).map(|part| part.mul(&factor));
                text += &format!("{numerator},{denominator},");
            }
            text += &format!("{}\n", u8::from(label));
        }
        // A fraction has no zero with a sign.
        let points = points.map(|point| Point::from(point.coords.map(|value| value + 0.0)));
        let read = entries("a.csv", text, EDGE_EDGE);
        prop_assert_eq!(bits(&read[0].query), bits(&query(QueryKind::EdgeEdge, points, [0.0; 2])));
        prop_assert_eq!(read[0].label, Some(label));
    }

    #[test]
    fn corpus_read_never_panics_on_bytes(text: Vec<u8>) {
        for path in ["a.jsonl", "a.csv", "-"] {
            for said in read_text(path, text.clone(), EDGE_EDGE) {
                prop_assert!(!said.contains('\n'));
            }
        }
    }

    /// Texts that come close to a query.
    #[test]
    fn corpus_read_never_panics_on_broken_queries(
        cut in 0usize..400,
        put in "[-0-9a-z\\[\\]{},:\"\\.\n]{0,6}",
    ) {
        let json = format!(r#"{{"id": "a", "kind": "edge-edge", "label": 1, "points": {EIGHT}}}"#);
        for (path, text) in [("a.jsonl", json), ("a.csv", csv_with(ROW).repeat(2))] {
            let cut = cut % text.len();
            let text = format!("{}{put}{}", &text[..cut], &text[cut + 1..]);
            for said in read_text(path, text, EDGE_EDGE) {
                prop_assert!(!said.contains('\n'));
            }
        }
    }
}
