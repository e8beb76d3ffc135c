//! Writes the two parts that the README measures: a plate with two bores, and its revision.
//!
//! `cargo run --release --example parts -- FOLDER` writes `a.step` and `b.step`. They are kept in `examples/parts`,
//! and a test compares them with what this program writes.

#[path = "../../tests/support/writers/step.rs"]
#[allow(dead_code, unreachable_pub, reason = "the tests' writer has more entities than parts need")]
mod step;

mod plate;

use plate::Plate;
use std::path::PathBuf;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let folder = PathBuf::from(std::env::args().nth(1).ok_or("expected a folder")?);
    for (name, part) in [("a.step", Plate::FIRST), ("b.step", Plate::REVISED)] {
        std::fs::write(folder.join(name), part.step())?;
    }
    Ok(())
}
