//! What the thesis says of its scenes beside what comes out, row by row.

use crate::rows::{Row, SCENES};

/// The rows of all scenes, and whether all of them hold.
pub fn rows() -> (String, bool) {
    let mut text = String::new();
    let mut hold = true;
    for scene in SCENES {
        text += &line(scene.scene, "thesis", "ours", "accepted");
        match (scene.run)() {
            Ok(rows) => {
                hold &= rows.iter().all(Row::holds);
                text.extend(rows.iter().map(written));
            }
            Err(error) => {
                hold = false;
                text += &format!("stopped: {error}\n");
            }
        }
        text += "\n";
    }
    (text, hold)
}

fn line(what: &str, thesis: &str, ours: &str, accepted: &str) -> String {
    format!("{what:<57}{thesis:>20}{ours:>9}  {accepted}\n")
}

fn written(row: &Row) -> String {
    let accepted = match row.accepted.map(rounded) {
        [least, largest] if least == largest => least.to_string(),
        [least, f64::INFINITY] => format!("at least {least}"),
        [0.0, largest] => format!("at most {largest}"),
        [least, largest] => format!("{least} to {largest}"),
    };
    let differs = if row.holds() { "" } else { ", differs" };
    let ours = rounded(row.ours).to_string();
    line(row.what, &row.thesis, &ours, &(accepted + differs))
}

/// A number to three places.
fn rounded(number: f64) -> f64 {
    (number * 1000.0).round() / 1000.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn row_says_what_is_accepted_and_that_it_differs() {
        let row = |ours, accepted| Row {
            what: "slips",
            thesis: "2".to_owned(),
            ours,
            accepted,
        };
        let end = |ours, accepted| {
            let text = written(&row(ours, accepted));
            text[57..].split_whitespace().collect::<Vec<_>>().join(" ")
        };
        assert_eq!(end(1.23456, [1.0, 3.0]), "2 1.235 1 to 3");
        assert_eq!(end(3.5, [1.0, 3.0]), "2 3.5 1 to 3, differs");
        assert_eq!(end(f64::NAN, [1.0, 3.0]), "2 NaN 1 to 3, differs");
        assert_eq!(end(2.0, [2.0, 2.0]), "2 2 2");
        assert_eq!(end(2.0, [0.0, 1.5]), "2 2 at most 1.5, differs");
        assert_eq!(end(2.0, [2.0, f64::INFINITY]), "2 2 at least 2");
    }
}
