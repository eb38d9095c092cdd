//! Prints what the wire stepper makes of cases with known answers, beside the formulas.
//!
//! ```text
//! cargo run --release --example wire_table
//! cargo run --release --example wire_table -- picture > docs/pictures/known-answers.svg
//! ```

use std::error::Error;

#[path = "../../tests/analytic/mod.rs"]
mod analytic;
mod picture;

use analytic::CASES;

fn main() -> Result<(), Box<dyn Error>> {
    if std::env::args().nth(1).as_deref() == Some("picture") {
        println!("{}", picture::draw()?);
        return Ok(());
    }
    println!("| case | formula | what | expected | measured | deviation | tolerance |");
    println!("| --- | --- | --- | --- | --- | --- | --- |");
    let mut missed = 0;
    for case in CASES {
        for row in (case.run)()? {
            println!(
                "| {} | {} | {} | {:.6e} | {:.6e} | {:.1e} | {:.0e} |{}",
                case.name,
                case.formula,
                row.what,
                row.expected,
                row.measured,
                row.deviation(),
                row.tolerance,
                if row.holds() { "" } else { " missed" }
            );
            missed += usize::from(!row.holds());
        }
    }
    match missed {
        0 => Ok(()),
        count => Err(format!("{count} rows are out of tolerance").into()),
    }
}
