//! The lines of the README, on the files that ship.

use crate::commands::{run, status};
use std::fs;

#[path = "../../../../examples/parts/plate.rs"]
mod plate;
use crate::support::root;
use crate::support::writers::step;

use plate::Plate;

fn root(path: &str) -> String {
    format!("{}/{path}", root::root().display())
}

/// The program that writes the parts is the one that wrote them.
#[test]
fn the_parts_that_ship_are_those_of_the_example() {
    for (name, part) in [("a.step", Plate::FIRST), ("b.step", Plate::REVISED)] {
        let kept = fs::read_to_string(root(&format!("examples/parts/{name}"))).unwrap();
        assert_eq!(kept, part.step(), "{name}");
    }
}

/// A bore of radius 9 is moved by 0.3, so that the far side of its wall is 0.3 from where it was.
#[test]
fn the_commands_of_the_readme_find_the_bore_that_moved() {
    let readme = fs::read_to_string(root("README.md")).unwrap();
    let lines: Vec<&str> = readme.lines().filter_map(|line| line.strip_prefix("nurbs-hausdorff ")).collect();
    assert!(lines.len() >= 2, "{lines:?}");
    for line in lines {
        let words = line.split_whitespace();
        let arguments: Vec<String> =
            words.map(|word| if word.ends_with(".step") { root(word) } else { word.to_owned() }).collect();
        let output = run(&arguments.iter().map(String::as_str).collect::<Vec<_>>());
        let text = String::from_utf8(output.stdout.clone()).unwrap();
        assert_eq!(status(&output), 1, "{line}: {text}");
        let first = text.lines().next().unwrap();
        assert!(first.contains(" 0.1: 0.3 (") && first.contains("bore right"), "{line}: {first}");
    }
    let shown = readme.lines().find(|line| line.starts_with("BEYOND 0.1: ")).unwrap();
    let output = run(&[
        "distance",
        &root("examples/parts/a.step"),
        &root("examples/parts/b.step"),
        "--symmetric",
        "--limit",
        "0.1",
    ]);
    assert_eq!(String::from_utf8(output.stdout).unwrap().lines().next(), Some(shown));
}
