//! The result of certification as text.

use std::fmt::{self, Write as _};

use super::run::{Block, Panel};
use super::tally::{Fault, Tally, Witness};

/// Columns after the subject: two lines of heading, and what stands in the column.
const COLUMNS: [([&str; 2], fn(&Tally, bool) -> String); 11] = [
    (["", "hits"], |tally, _| grouped(tally.hits)),
    (["", "tunnels"], |tally, _| count(tally, Fault::Tunnel)),
    (["missed", "grazes"], |tally, _| count(tally, Fault::MissedGraze)),
    (["false", "hits"], |tally, _| count(tally, Fault::FalseHit)),
    (["near", "hits"], |tally, _| count(tally, Fault::NearHit)),
    (["wrong", "cases"], |tally, _| count(tally, Fault::WrongCase)),
    (["worst", "late"], |tally, _| time(tally, Fault::Late)),
    (["worst", "early"], |tally, _| time(tally, Fault::Early)),
    (["no", "answer"], |tally, _| count(tally, Fault::NoAnswer)),
    (["", "differs"], |tally, is_exact| match is_exact {
        true => count(tally, Fault::Differs),
        false => "-".to_owned(),
    }),
    (["", ""], |_, _| String::new()),
];
