//! The numeric core drops no NaN where it takes the largest or the smallest of
//! bounds.
//!
//! `f64::min` and `f64::max` return the other argument where one is NaN, so a fold by
//! them loses the bound that is not known. Maxima of upper bounds go through
//! `rounding::upper_max` and minima of lower bounds through `rounding::lower_min`.

use std::path::{Path, PathBuf};

/// The folders of code that forms bounds.
const FOLDERS: [&str; 14] = [
    "src/alignment/largest",
    "src/bezier",
    "src/certified",
    "src/clearance",
    "src/closest",
    "src/facets",
    "src/facts",
    "src/features",
    "src/hierarchy",
    "src/iteration",
    "src/normals",
    "src/overlap",
    "src/solid",
    "src/symmetry",
];

/// Folds that may drop NaN: the file, a part of the line, and the reason.
const ALLOWED: &[(&str, &str, &str)] = &[
    ("clearance/piece.rs", "self.deepest.max(level)", "whole numbers"),
    ("clearance/piece.rs", "along_u = along_u.max(", "decides only which axis is halved"),
    ("clearance/piece.rs", "along_v = along_v.max(", "decides only which axis is halved"),
    ("clearance/piece.rs", "twist = twist.max(", "decides only which axis is halved"),
    (
        "bezier/extraction/extract.rs",
        "radius.max(local.length())",
        "coordinates of a valid surface are numbers",
    ),
    ("bezier/bounds/oriented_box.rs", "low.min(coordinates)", "vectors, of finite coordinates"),
    ("bezier/patch/subdivide.rs", "longest.max(", "chooses the axis to halve"),
    ("bezier/bounds/point_error.rs", "self.", "formed from finite radii and centres"),
    ("certified/bounds/bilinear.rs", "foot.parameters[axis]", "parameters of feet are in [0, 1]"),
    (
        "certified/bounds/bilinear.rs",
        "foot.distance_squared",
        "rejects early; the bound itself is compared again",
    ),
    ("certified/bounds/boxes.rs", "largest.max(bound)", "NaN returns before"),
    ("certified/bounds/boxes.rs", "fold(0.0, f64::max)", "squared distances of finite corners"),
    (
        "certified/near_copies/difference/aligned_map.rs",
        "along[axis].abs()",
        "chooses a map; any map is valid",
    ),
    ("certified/near_copies/difference/net/mod.rs", "control.w", "weights of finite nets"),
    ("certified/bounds/same_net.rs", "from.distance_squared(to)", "squared distances of finite points"),
    ("certified/rounding.rs", "weights.fold", "weights of finite nets"),
    ("certified/search", "node.upper", "an evaluation replaces NaN by the parent's bound"),
    ("certified/search", "self.work.levels", "integers"),
    ("certified/search", "upper.min(bounds::with_", "the smaller of two upper bounds: NaN is no bound"),
    ("certified/search/incumbent.rs", "self.pruned_upper_bound", "bounds of nodes"),
    ("closest", "leg[", "chooses the axis to halve"),
    ("features/piece.rs", "one.min - other.max", "vectors, of finite coordinates; 0 is the lower bound"),
    ("normals/target.rs", "one.min - other.max", "vectors, of finite coordinates; 0 is the lower bound"),
    ("facets/facet.rs", "bound = bound.max", "the larger of two lower bounds: NaN is no bound"),
    ("facets/facet.rs", "fraction.min(1.0)", "a weight; any is valid"),
    ("facets/search", "levels", "integers"),
    ("facets/search/tests.rs", "fold(", "brute force over finite points"),
    ("facets/search/patch_cell.rs", "bends[axis]", "chooses the axis to halve"),
    ("facets/search/patch_cell.rs", "lengths[", "chooses the axis to halve"),
    ("facets/search/patch_cell.rs", "range(&mut", "chooses the axis to halve"),
    ("hierarchy/traversal.rs", "distances.near", "the largest of lower bounds: NaN is no bound"),
    ("certified/nearest/feet.rs", "self.count", "integers"),
    ("closest/critical_point.rs", "control.w", "weights of finite nets"),
    ("closest/tangent_plane.rs", "change / previous", "an observed contraction, which bounds nothing"),
    ("closest/branch_and_bound.rs", "gap.max(rounding)", "a requested width, which is a number"),
    (
        "closest/branch_and_bound.rs",
        "lower_bound.max(form",
        "the larger of two lower bounds: NaN is no bound",
    ),
    ("iteration/covering_radius.rs", "self.published", "the published radius is no bound"),
    ("iteration/covering_radius.rs", "map(farthest)", "the smallest of upper bounds: NaN is no bound"),
];

/// The Rust files below a folder.
fn sources(folder: &Path, files: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            sources(&path, files);
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            files.push(path);
        }
    }
}

/// Whether the line folds by `f64::min` or `f64::max`, or assigns to a place its
/// minimum or maximum with something else.
fn may_drop_nan(line: &str) -> bool {
    let picks = ["f64::min", "f64::max", ".min(", ".max("];
    if let Some((_, arguments)) = line.split_once("fold(") {
        let mut depth = 1;
        let mut is_inside = |character: char| {
            depth += i32::from(character == '(') - i32::from(character == ')');
            depth > 0
        };
        let arguments: String = arguments.chars().take_while(|&character| is_inside(character)).collect();
        if picks.iter().any(|pick| arguments.contains(pick)) {
            return true;
        }
    }
    let Some((place, value)) = line.split_once(" = ") else { return false };
    let places = place.trim().trim_start_matches("let ").trim_matches(['(', ')']).split(", ");
    places.filter(|place| !place.is_empty()).any(|place| {
        [".min(", ".max("].iter().any(|pick| {
            let call = format!("{place}{pick}");
            value.match_indices(&call).any(|(at, _)| {
                let before = value[..at].chars().next_back();
                !before.is_some_and(|character| character.is_alphanumeric() || "_.".contains(character))
            })
        })
    })
}

#[test]
fn folds_of_bounds_keep_nan() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut files = Vec::new();
    for folder in FOLDERS {
        sources(&root.join(folder), &mut files);
    }
    let mut found = Vec::new();
    for path in files {
        let text = std::fs::read_to_string(&path).unwrap();
        let name = path.strip_prefix(root.join("src")).unwrap().to_string_lossy().replace('\\', "/");
        // Tests end a file.
        for (index, line) in text.lines().take_while(|line| !line.starts_with("mod tests")).enumerate() {
            let is_allowed =
                ALLOWED.iter().any(|(file, part, _)| name.starts_with(file) && line.contains(part));
            if may_drop_nan(line) && !is_allowed {
                found.push(format!("{name}:{}: {}", index + 1, line.trim()));
            }
        }
    }
    assert!(found.is_empty(), "use rounding::upper_max or lower_min:\n{}", found.join("\n"));
}

#[test]
fn folds_are_found() {
    for line in [
        "let largest = bounds.iter().fold(0.0, f64::max);",
        "let least = bounds.iter().fold(f64::INFINITY, |least, bound| least.min(bound));",
        "    largest = largest.max(bound);",
        "(low, high) = (low.min(value), high.max(value));",
        "leg[0] = leg[0].max(length);",
    ] {
        assert!(may_drop_nan(line), "{line}");
    }
    for line in [
        "let gap = other.gap.max(rounding);",
        "let least = bounds.fold(f64::INFINITY, lower_min).max(0.0);",
        "x.max(y)",
    ] {
        assert!(!may_drop_nan(line), "{line}");
    }
}
