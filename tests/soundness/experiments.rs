//! The experiments run, and what they write is what geometry says it must be.

use crate::suite::{self, Setup};
use nurbs_hausdorff::Model;
use nurbs_hausdorff::shapes::shape;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// Room for rounding in what was written as decimal numbers.
const ROUNDING: f64 = 1e-12;

/// A row by column.
type Row = BTreeMap<String, String>;

/// Runs the quick form of one experiment and reads its tables.
fn quick(only: &str) -> BTreeMap<String, Vec<Row>> {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(format!("experiments-{only}"));
    let _ = std::fs::remove_dir_all(&folder);
    suite::run(&Setup::new(folder.clone(), true, only.to_owned()).unwrap()).unwrap();
    let mut tables = BTreeMap::new();
    for entry in std::fs::read_dir(&folder).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_some_and(|extension| extension == "csv") {
            let svg = std::fs::read_to_string(path.with_extension("svg")).unwrap();
            assert!(svg.starts_with("<svg") && svg.trim_end().ends_with("</svg>"), "{}", path.display());
            tables.insert(path.file_stem().unwrap().to_string_lossy().into_owned(), read(&path));
        }
    }
    assert!(!tables.is_empty());
    tables
}

fn read(path: &Path) -> Vec<Row> {
    let text = std::fs::read_to_string(path).unwrap();
    let mut lines = text.lines();
    let columns: Vec<&str> = lines.next().unwrap().split(',').collect();
    lines
        .map(|line| {
            let cells: Vec<&str> = line.split(',').collect();
            assert_eq!(cells.len(), columns.len(), "{line}");
            columns.iter().zip(cells).map(|(&column, cell)| (column.to_owned(), cell.to_owned())).collect()
        })
        .collect()
}

fn number(row: &Row, column: &str) -> f64 {
    row[column].parse().unwrap_or_else(|_| panic!("{column} of {row:?}"))
}

fn having<'a>(rows: &'a [Row], column: &str, text: &str) -> Vec<&'a Row> {
    rows.iter().filter(|row| row[column] == text).collect()
}

#[test]
fn intervals_of_all_methods_overlap_the_certified_at_every_position() {
    let tables = quick("sweep");
    let rows = &tables["sweep-small"];
    let certified = having(rows, "method", "certified");
    assert_eq!(certified.len(), 5);
    let mut methods: Vec<&String> = rows.iter().map(|row| &row["method"]).collect();
    methods.sort();
    methods.dedup();
    assert_eq!(methods.len(), 7, "{methods:?}");
    assert_eq!(rows.len(), 5 * methods.len());
    for row in rows {
        assert_eq!(row["failure"], "", "{row:?}");
        let truth = certified.iter().find(|other| other["position"] == row["position"]).unwrap();
        assert!(number(row, "lower") <= number(truth, "upper") + ROUNDING, "{row:?}");
        assert!(number(row, "upper") >= number(truth, "lower") - ROUNDING, "{row:?}");
        if row["method"] == "iteration" {
            assert!(number(row, "computed") <= number(truth, "upper") + ROUNDING, "{row:?}");
        }
    }
    // Parted sheets on either side are farther apart than sheets that cross.
    let distance = |index: usize| number(certified[index], "lower");
    assert!(distance(0) > distance(2) && distance(4) > distance(2));
}

#[test]
fn figure_5_has_its_published_numbers() {
    let tables = quick("figure5");
    let rows = &tables["figure5"];
    let published = having(rows, "samples", "41.0");
    assert_eq!(published.len(), 1);
    assert!((number(published[0], "computed") - 310.42).abs() < 1e-3);
    // Half the diagonal of a cell with sides of 16.
    assert!((number(published[0], "k_a") - 8.0 * 2_f64.sqrt()).abs() < 1e-6);
    let certified = having(rows, "method", "certified");
    assert!(number(certified[0], "lower") <= 320.0 && number(certified[0], "upper") >= 320.0);
}

#[test]
fn newton_finds_feet_that_the_tangent_plane_misses_beyond_curvature() {
    let tables = quick("convergence");
    for row in &tables["convergence"] {
        let d_kappa = number(row, "d_kappa");
        let missed = [number(row, "tangent_plane_100_missed"), number(row, "newton_100_missed")];
        if d_kappa.abs() < 0.5 {
            // Contraction below a half: a hundred steps leave nothing.
            assert!(missed[0] <= 0.05 && missed[1] <= 0.05, "{row:?}");
        } else if d_kappa > 1.25 {
            // Contraction above 1: the step leads away from the foot.
            assert!(missed[0] >= 0.5 && missed[1] <= 0.05, "{row:?}");
        }
    }
}

#[test]
fn cutting_finer_misses_fewer_samples() {
    let tables = quick("split-rule");
    for rule in ["cut in the middle", "cut at half of the rotation"] {
        let rows = having(&tables["split-rule"], "rule", rule);
        let (first, last) = (rows[0], rows[rows.len() - 1]);
        assert!(number(last, "patches") > number(first, "patches"));
        assert!(number(last, "missed_percent") < number(first, "missed_percent"));
    }
}

#[test]
fn samples_never_find_more_than_the_distance_nor_miss_more_than_the_bound() {
    let tables = quick("sampling-rule");
    let rows = &tables["sampling-rule"];
    assert_eq!(rows.len(), 6);
    for row in rows {
        // The certified interval is 1e-6 of the diagonal wide.
        let certificate = 1e-5;
        assert!(number(row, "error") >= -certificate, "{row:?}");
        assert!(number(row, "error") <= number(row, "k_a_rigorous") + certificate, "{row:?}");
    }
}

#[test]
fn cells_on_exact_offsets_follow_the_tolerance_and_the_interval_holds_the_truth() {
    let tables = quick("order");
    let rows = &tables["order"];
    let spheres = having(rows, "pair", "parts of spheres: radius 1 and 1.1");
    assert_eq!(spheres.len(), 5);
    for row in &spheres {
        assert!(number(row, "lower") <= 0.1 && number(row, "upper") >= 0.1, "{row:?}");
    }
    let (first, last) = (spheres[0], spheres[spheres.len() - 1]);
    let slope = (number(last, "cells") / number(first, "cells")).ln()
        / (number(last, "tolerance") / number(first, "tolerance")).ln();
    // -2/3 in the long run; cells are halved in whole levels, so a short run strays.
    assert!((-0.85..=-0.4).contains(&slope), "{slope}");
    let sheets = having(rows, "pair", "wavy sheets");
    let growth = number(sheets[4], "cells") / number(sheets[0], "cells");
    assert!(growth < 2.0, "{growth}");
}

#[test]
fn more_of_the_survey_changes_neither_the_distance_nor_much_of_the_work() {
    let tables = quick("patch-count");
    let rows = &tables["patch-count"];
    assert_eq!(rows.len(), 3);
    assert!(number(&rows[2], "patches_of_b") > 8.0 * number(&rows[0], "patches_of_b"));
    for row in rows {
        assert!(
            number(row, "lower") <= number(&rows[0], "upper")
                && number(row, "upper") >= number(&rows[0], "lower")
        );
    }
}

#[test]
fn both_evaluations_project_alike_where_there_is_one_patch() {
    let tables = quick("nurbs-evaluation");
    let rows = &tables["nurbs-evaluation"];
    let single: Vec<&Row> = having(rows, "patches", "1.0");
    let projected: Vec<&&Row> = single.iter().filter(|row| !row["missed_percent"].is_empty()).collect();
    assert_eq!(projected.len(), 3);
    // One patch is the surface: the same control points, the same start, the same steps.
    assert!(projected.iter().all(|row| row["missed_percent"] == projected[0]["missed_percent"]));
}

#[test]
fn the_pairs_have_the_sizes_of_the_paper_also_where_shapes_stand_in() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/experiments/sweep.json");
    let plan: serde_json::Value = serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap();
    let of = |name: &str| {
        let pair = plan["pairs"].as_array().unwrap().iter().find(|pair| pair["name"] == name).unwrap();
        ["a", "b"].map(|side| shape(pair[side]["shape"].as_str().unwrap()).unwrap())
    };
    let counts = |model: &Model| model.surfaces()[0].counts();
    // The 2012 paper's Table 1.
    assert_eq!(of("small").each_ref().map(counts), [[6, 6], [6, 6]]);
    assert_eq!(of("large").each_ref().map(counts), [[298, 313], [595, 97]]);
    assert_eq!(of("several").each_ref().map(|model| model.surfaces().len()), [3, 4]);
    let [one, other] = of("body");
    assert_eq!((one.surfaces().len(), &one), (1, &other));
    // The ball and the hollow sphere about the origin.
    let widths = of("nested").map(|model| model.bounding_box().extent().x);
    assert!((widths[0] - 0.4).abs() < ROUNDING && (widths[1] - 4.0).abs() < ROUNDING, "{widths:?}");
}
