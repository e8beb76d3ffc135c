//! The command `grid` and its files.

use crate::commands::{file, plane, printed, run, status};
use nurbs_hausdorff::shapes::shape;
use serde_json::Value;
use std::path::PathBuf;

/// The catalogue's sphere of radius 2 about the origin.
fn ball(test: &str) -> String {
    file(&format!("{test}.json"), &shape("sphere").unwrap().to_json().unwrap())
}

/// A path that has no file yet.
fn unwritten(name: &str) -> String {
    let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _ = std::fs::remove_file(&path);
    path.to_str().unwrap().to_owned()
}

/// The grid of these tests: 5 × 7 × 3 points from (-2, -3, -1), a unit apart.
const GRID: [&str; 6] = ["--origin=-2,-3,-1", "--spacing", "1", "--counts", "5,7,3", "--json"];

fn distance(i: usize, j: usize, k: usize) -> f64 {
    let [x, y, z] = [i as f64 - 2.0, j as f64 - 3.0, k as f64 - 1.0];
    x.hypot(y).hypot(z) - 2.0
}

/// Checks the numbers at the end of a file, x fastest.
fn assert_values(bytes: &[u8], size: usize, bound: f64, undecided: u64) {
    let mut on = 0;
    for k in 0..3 {
        for j in 0..7 {
            for i in 0..5 {
                let place = size * (i + 5 * (j + 7 * k));
                let value = match size {
                    4 => f64::from(f32::from_le_bytes(bytes[place..][..4].try_into().unwrap())),
                    _ => f64::from_le_bytes(bytes[place..][..8].try_into().unwrap()),
                };
                let expected = distance(i, j, k);
                assert!((value - expected).abs() <= bound + 1e-15, "{value} for {expected} at {i} {j} {k}");
                on += u64::from(expected == 0.0);
            }
        }
    }
    assert_eq!(on, undecided);
}

#[test]
fn distances_are_written_in_three_formats() {
    let model = ball("grid-formats");
    for (name, size, precision) in
        [("g.npy", 8, "float64"), ("g.nrrd", 4, "float32"), ("g.vti", 4, "float32")]
    {
        let path = unwritten(name);
        let mut arguments = vec!["grid", &model, "--output", &path, "--precision", precision];
        arguments.extend(GRID);
        let found: Value = printed(&run(&arguments));
        assert_eq!(found["command"], "grid");
        assert_eq!(found["counts"], serde_json::json!([5, 7, 3]));
        assert_eq!(found["precision"], precision);
        let (bound, undecided) = (found["bound"].as_f64().unwrap(), found["undecided"].as_u64().unwrap());
        let bytes = std::fs::read(&path).unwrap();
        let tail = if name == "g.vti" { "\n</AppendedData>\n</VTKFile>\n".len() } else { 0 };
        let start = bytes.len() - tail - 105 * size;
        let head = String::from_utf8_lossy(&bytes[..start]).into_owned();
        assert_values(&bytes[start..], size, bound, undecided);
        match name {
            "g.npy" => {
                assert!(
                    bytes.starts_with(b"\x93NUMPY\x01\x00")
                        && start.is_multiple_of(64)
                        && head.ends_with(" \n")
                );
                assert_eq!(usize::from(u16::from_le_bytes([bytes[8], bytes[9]])), start - 10);
                assert!(head.contains("{'descr': '<f8', 'fortran_order': True, 'shape': (5, 7, 3), }"));
            }
            "g.nrrd" => {
                assert!(head.starts_with("NRRD0005\n") && head.ends_with("encoding: raw\n\n"), "{head}");
                let lines = ["type: float\n", "sizes: 5 7 3\n", "space origin: (-2.0,-3.0,-1.0)\n"];
                assert!(lines.iter().all(|line| head.contains(line)), "{head}");
            }
            _ => {
                assert!(head.contains("Extent=\"0 4 0 6 0 2\" Origin=\"-2.0 -3.0 -1.0\""), "{head}");
                assert!(head.contains("type=\"Float32\""), "{head}");
                assert_eq!(&bytes[start - 8..start], 420_u64.to_le_bytes(), "the number of bytes");
                assert_eq!(bytes[start - 9], b'_');
            }
        }
    }
}

#[test]
fn a_band_is_written_with_its_sign() {
    let (model, path) = (ball("grid-band"), unwritten("band.npy"));
    let arguments = ["grid", &model, "--resolution", "48", "--band", "0.1", "-o", &path, "--json"];
    let found = printed(&run(&arguments));
    let band = f64::from(0.1_f32);
    assert_eq!(
        [&found["least"], &found["greatest"], &found["band"]].map(Value::as_f64),
        [-band, band, band].map(Some)
    );
    let total: u64 =
        found["counts"].as_array().unwrap().iter().map(|count| count.as_u64().unwrap()).product();
    assert!(found["measured"].as_u64().unwrap() < total);
    // The ball's part of the grid, up to half a layer.
    let inside = found["inside"].as_u64().unwrap() as f64 * found["spacing"].as_f64().unwrap().powi(3);
    assert!((inside - 33.5103).abs() < 0.5, "{inside}");
    let text = run(&["grid", &model, "--resolution", "9", "-o", &path, "--overwrite"]);
    let text = String::from_utf8(text.stdout).unwrap();
    assert!(text.starts_with("grid      14 x 14 x 14 points") && text.contains("undecided"), "{text}");
}

#[test]
fn what_cannot_be_written_is_refused() {
    let (model, path) = (ball("grid-refused"), unwritten("refused.npy"));
    let refused = |arguments: &[&str], code: &str| {
        let output = run(&[&["grid"], arguments].concat());
        let errors = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(status(&output), 2, "{errors}");
        assert!(errors.contains(code), "{errors}");
    };
    let open = file("grid-open.json", &plane(0.0).to_string());
    refused(&[&open, "-o", &path], "NOT_CLOSED");
    refused(&[&model, "-o", &unwritten("refused.csv")], "OPTION_OUT_OF_RANGE");
    refused(&[&model, "-o", &path, "--counts", "0,1,1"], "OPTION_OUT_OF_RANGE");
    refused(&[&model, "-o", &path, "--counts", "1,1"], "expected 3");
    assert!(!PathBuf::from(&path).exists());
    std::fs::write(&path, "kept").unwrap();
    refused(&[&model, "-o", &path], "OUTPUT_EXISTS");
    assert_eq!(std::fs::read(&path).unwrap(), b"kept");
}
