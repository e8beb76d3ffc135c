//! The lines of Rust in the README, on the files that ship.
#![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]

use std::path::Path;

/// A bore of radius 9 is moved by 0.3, so that the far side of its wall is 0.3 from where it was.
#[test]
fn the_lines_of_the_readme_find_the_bore_that_moved() -> nurbs_hausdorff::Result<()> {
    std::env::set_current_dir(Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")).unwrap();
    let readme = std::fs::read_to_string("README.md").unwrap();
    let (_, block) = readme.split_once("```rust\n").unwrap();
    let (block, _) = block.split_once("```").unwrap();
    let here: Vec<&str> = include_str!("readme.rs").lines().map(str::trim).collect();
    for line in block.lines().map(str::trim) {
        assert!(here.contains(&line), "this test does not run: {line}");
    }

    use nurbs_hausdorff::{DistanceOptions, Engine};
    use nurbs_hausdorff_files::open;

    let [a, b] = [open("examples/parts/a.step")?, open("examples/parts/b.step")?];
    let options = DistanceOptions { symmetric: true, ..DistanceOptions::default() };
    let result = Engine::cpu().distance(&a.prepared, &b.prepared, &options).wait()?;
    println!("between {} and {}", result.lower, result.upper);

    assert!(result.lower <= 0.3 && 0.3 <= result.upper && result.upper - result.lower < 1e-3, "{result:?}");
    Ok(())
}
