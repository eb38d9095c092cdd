//! How far two sides are kept apart during a step, and the numbers that positions are stored in.

use clap::Args;
use clap::builder::{PossibleValuesParser, TypedValueParser};
use tunnelproof::certified::{Clearance, Precision};

use super::not_negative;

/// How far two sides are kept apart beyond their radius.
#[derive(Args)]
pub(super) struct Keep {
    /// Keep so many metres beyond the radius
    #[arg(long, value_name = "METRES", value_parser = not_negative, allow_negative_numbers = true)]
    clearance: Option<f64>,
    /// Where the two would come within the radius, keep this share of what they have beyond it at
    /// the start: from 0 to below 1
    #[arg(long, value_name = "S", value_parser = share, allow_negative_numbers = true, conflicts_with = "clearance")]
    share: Option<f64>,
}

impl Keep {
    pub(super) fn clearance(&self) -> Clearance {
        match (self.clearance, self.share) {
            (Some(distance), _) => Clearance::Distance(distance),
            (None, Some(share)) => Clearance::Share(share),
            (None, None) => Clearance::None,
        }
    }
}

/// Reads a precision by its name.
pub(super) fn precision() -> impl TypedValueParser<Value = Precision> {
    PossibleValuesParser::new(["f64", "f32"]).map(|name| match name.as_str() {
        "f32" => Precision::F32,
        _ => Precision::F64,
    })
}

fn share(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(share) if (0.0..1.0).contains(&share) => Ok(share),
        _ => Err("it has to be a number from 0 to below 1".to_owned()),
    }
}
