//! Reads BREP texts and prints a table of what was read: `cargo bench --bench brep --
//! FILE…`, with texts that OpenCASCADE wrote, such as of the STEP and IGES files beside
//! the project.
#![allow(clippy::unwrap_used, reason = "a panic is how a benchmark fails")]

use nurbs_hausdorff_cad::from_brep;
use std::path::PathBuf;
use std::time::Instant;

/// The number of rounds; the fastest counts.
const ROUNDS: usize = 3;

fn main() {
    println!("| file | kB | faces | loops | curves | exact | fitted | largest gap | skipped | ms |");
    println!("|---|---|---|---|---|---|---|---|---|---|");
    // Cargo adds `--bench`.
    for path in std::env::args().skip(1).filter(|argument| argument != "--bench").map(PathBuf::from) {
        let text = std::fs::read_to_string(&path).unwrap();
        let name = path.file_stem().unwrap().to_string_lossy();
        let mut fastest = f64::INFINITY;
        let mut read = None;
        for _ in 0..ROUNDS {
            let start = Instant::now();
            read = Some(from_brep(&text));
            fastest = fastest.min(1e3 * start.elapsed().as_secs_f64());
        }
        let size = text.len() / 1000;
        match read {
            Some(Ok((model, report))) => {
                let loops: usize = model.faces().filter_map(|face| Some(face.trim()?.loops().len())).sum();
                println!(
                    "| {name} | {size} | {} | {loops} | {} | {} | {} | {:.1e} | {} | {fastest:.1} |",
                    report.faces,
                    report.trims,
                    report.exact,
                    report.fitted,
                    report.gap,
                    report.skipped.len(),
                );
                for skipped in report.skipped {
                    println!("  face {}: {}, {}", skipped.face, skipped.code, skipped.why);
                }
            }
            Some(Err(error)) => println!("| {name} | {size} | {}: {error} |", error.code()),
            None => {}
        }
    }
}
