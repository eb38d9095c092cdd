use tunnelproof::query::Point;

use super::*;
use crate::field::{self, Integer};

/// The one message that a csv gives whose third row this is, without `a.csv:3: `.
fn row_error(row: &str) -> String {
    let said = read_text("a.csv", csv_with(row), EDGE_EDGE);
    assert_eq!(said.len(), 1, "{row}: {said:?}");
    let message = said[0].strip_prefix("a.csv:3: ").expect(&said[0]);
    message.to_owned()
}

#[test]
fn csv_read_values_exactly() {
    let last = "6,4,-3,-6,-12345678901234567890123456789,-12345678901234567890123456789,1";
    let rows = [
        "0,1,-0,5,+1,+2,1",
        " 1 , 2 , -3 , 4 , 5 , 8 , 1 ",
        "1,9223372036854775808,1,18446744073709551616,7,-2,1",
        "6000,1000,0,-3,9007199254740992,1,1",
        last,
        last,
        last,
        last,
    ];
    let text = rows[..3].join("\n") + "\n" + &rows[3..].join("\r\n") + "\r\n\r\n";
    let read = entries("set/edge-edge/a.csv", text, ReadOptions::default());
    assert_eq!(read[0].id, "set/edge-edge/a.csv#0");
    let start = read[0].query.start();
    assert_eq!(read[0].label, Some(true));
    assert_eq!(start[0], Point::new(0.0, 0.0, 0.5));
    assert!(start[0].y.is_sign_positive());
    assert_eq!(start[1], Point::new(0.5, -0.75, 0.625));
    assert_eq!(start[2], Point::new(2f64.powi(-63), 2f64.powi(-64), -3.5));
    assert_eq!(start[3], Point::new(6.0, 0.0, 9007199254740992.0));
    assert_eq!(read[0].query.end()[0], Point::new(1.5, 0.5, 1.0));
}

#[test]
fn csv_errors_name_the_column() {
    let two = |bits: u64| field::Default::one().shl(bits).to_string();
    let huge = format!("0,1,{},1,0,1,0", two(1024));
    let odd = field::Default::one().shl(1024).add(&field::Default::one());
    let huge_and_odd = format!("0,1,0,1,{odd},1,0");
    let many_bits = format!("0,1,{odd},{},0,1,0", two(1024));
    let fine = format!("0,1,0,1,3,-{},0", two(1075));
    for (row, message) in [
        (
            "1,2,3,4,5,8",
            "6 columns, not the 7 of x_num,x_den,y_num,y_den,z_num,z_den,label, or on all rows of a \
             query the 6 without label",
        ),
        (
            "1,2,3,4,5,8,0,",
            "8 columns, not the 7 of x_num,x_den,y_num,y_den,z_num,z_den,label, or on all rows of a \
             query the 6 without label",
        ),
        ("1,2,3,four,5,8,0", "y_den is \"four\", not an integer"),
        ("1.5,1,3,4,5,8,0", "x_num is \"1.5\", not an integer"),
        ("1,2,3,4,,8,0", "z_num is \"\", not an integer"),
        ("0x1,2,3,4,5,8,0", "x_num is \"0x1\", not an integer"),
        ("1,2,nan,4,5,8,0", "y_num is \"nan\", not an integer"),
        ("1,2,3,4,5,0,0", "z_den is 0"),
        ("0,0,3,4,5,8,0", "x_den is 0"),
        ("1,-0,3,4,5,8,0", "x_den is 0"),
        (
            "1,3,3,4,5,8,0",
            "x is not an f64: its denominator is not a power of two",
        ),
        (
            "1,2,3,4,10,-12,0",
            "z is not an f64: its denominator is not a power of two",
        ),
        (
            "9007199254740993,1,3,4,5,8,0",
            "x is not an f64: it has 54 significant bits, an f64 has 53",
        ),
        (
            &many_bits,
            "y is not an f64: it has 1025 significant bits, an f64 has 53",
        ),
        (&huge, "y is not an f64: its magnitude is 2^1024 or more"),
        (
            &huge_and_odd,
            "z is not an f64: its magnitude is 2^1024 or more",
        ),
        (&fine, "z is not an f64: it is not a multiple of 2^-1074"),
        ("1,2,3,4,5,8,2", "label is \"2\", neither 0 nor 1"),
        ("1,2,3,4,5,8,", "label is \"\", neither 0 nor 1"),
        (
            "1,2,3,4,5,8,1",
            "label is 1, but 0 on line 1, where the query starts",
        ),
        (
            "xxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxx,2,3,4,5,8,0",
            "x_num is \"xxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxx...\", not an integer",
        ),
    ] {
        assert_eq!(row_error(row), message, "{row}");
    }
}

#[test]
fn csv_error_has_its_line_and_ends_the_corpus() {
    let good = csv_with(ROW);
    let text = format!("{good}\n{}{good}", csv_with("1,2,3,4,5,b,0"));
    assert_eq!(
        read_text("a.csv", text, EDGE_EDGE),
        [
            "Some(1) a.csv#0",
            "a.csv:12: z_den is \"b\", not an integer"
        ]
    );
    let text = format!("{good}{}\n\n", [ROW; 5].join("\n"));
    assert_eq!(
        read_text("a.csv", text, EDGE_EDGE),
        [
            "Some(1) a.csv#0",
            "a.csv:13: ends after 5 of the 8 rows of query 1"
        ]
    );
    let text = format!(
        "{good}{good}{}",
        csv_with("1,2,3,4,5,8,1").replace(",0\n", ",1\n")
    );
    assert_eq!(
        read_text("a.csv", text, EDGE_EDGE),
        ["Some(1) a.csv#0", "Some(9) a.csv#1", "Some(17) a.csv#2"]
    );
}

#[test]
fn csv_integers_are_read_up_to_a_length() {
    // 10^n / 10^n, which is 1.
    let row = |zeros: usize| {
        let power = format!("1{}", "0".repeat(zeros));
        csv_with(&format!("{power},{power},2,1,3,1,0"))
    };
    let longest = super::super::csv::LONGEST_INTEGER;
    assert_eq!(
        read_text("a.csv", row(longest - 1), EDGE_EDGE),
        ["Some(1) a.csv#0"]
    );
    for zeros in [longest, 500_000] {
        let read = read_text("a.csv", row(zeros), EDGE_EDGE);
        let error = format!("x_num is longer than {longest} characters");
        assert!(read[0].contains(&error), "{read:?}");
    }
}

#[test]
fn csv_kind_in_path_nearest_component_decides() {
    for (path, kind) in [
        ("edge-edge/a.csv", Some(QueryKind::EdgeEdge)),
        ("/x/my-vertex-face-set/y/a.csv", Some(QueryKind::VertexFace)),
        ("edge-edge/vertex-face/a.csv", Some(QueryKind::VertexFace)),
        ("vertex-face/a.edge-edge.csv", Some(QueryKind::EdgeEdge)),
        (
            "edge-edge/edge-edge-and-vertex-face.csv",
            Some(QueryKind::EdgeEdge),
        ),
        ("edge/edge.csv", None),
        ("edge-edge/../a.csv", Some(QueryKind::EdgeEdge)),
        ("a.csv", None),
    ] {
        assert_eq!(csv::kind_in_path(path), kind, "{path}");
    }
}

#[test]
fn csv_kind_missing_or_contradictory_is_an_error() {
    assert_eq!(
        read_text("a.csv", csv_with(ROW), ReadOptions::default()),
        ["a.csv: states no kind; pass --kind edge-edge or --kind vertex-face"]
    );
    assert_eq!(
        read_text("vertex-face/a.csv", csv_with(ROW), EDGE_EDGE),
        ["vertex-face/a.csv: is of kind vertex-face, but --kind says edge-edge"]
    );
}

#[test]
fn csv_radius_option_is_checked() {
    let options = ReadOptions {
        radius: Some([0.5, -1.0].into()),
        ..EDGE_EDGE
    };
    assert_eq!(
        read_text("a.csv", csv_with(ROW), options),
        ["a.csv:1: the radius is 0.5 + -1; both have to be finite, and 0 or more"]
    );
}
