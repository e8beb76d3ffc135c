//! Damaged files: an error with a code, or a model whose report accounts for its faces.

use crate::faces::polygons::box_faces;
use crate::support::writers::step::{StepText, UnitsOf};
use nurbs_hausdorff_cad::from_step;
use proptest::prelude::*;

pub(crate) fn brick() -> String {
    let mut text = StepText::new();
    let faces = box_faces(&mut text, [1.0, 2.0, 4.0]);
    let solid = text.solid("brick", &faces);
    text.of(&[solid], UnitsOf::InchesAndDegrees)
}

#[test]
fn a_file_that_ends_early_is_refused() {
    let text = brick();
    let end = text.trim_end().len();
    for length in (0..end).step_by(7).chain(end - 40..end) {
        let error = from_step(&text.as_bytes()[..length]).unwrap_err();
        assert_eq!(error.code(), "STEP_SYNTAX", "{length} of {end} bytes");
    }
    assert!(from_step(&text.as_bytes()[..end]).is_ok());
}

#[test]
fn comments_and_line_breaks_stand_anywhere() {
    let text = brick();
    let (expected, _) = from_step(text.as_bytes()).unwrap();
    let commented = text.replace('=', " /* a ; ' */ =\r\n ").replace("),(", ")\n,/**/(");
    let (model, _) = from_step(commented.as_bytes()).unwrap();
    assert_eq!(model.to_json().unwrap(), expected.to_json().unwrap());
}

#[test]
fn an_error_names_the_line() {
    let text = brick().replacen("PLANE(", "PLANE[", 1);
    let line = 1 + text.lines().position(|line| line.contains("PLANE[")).unwrap();
    let error = from_step(text.as_bytes()).unwrap_err();
    assert!(error.to_string().starts_with(&format!("line {line}: found \"[")), "{error}");
}

/// Checks what the reader guarantees of any bytes.
fn check(bytes: &[u8]) {
    match from_step(bytes) {
        Ok((model, report)) => {
            assert!(report.faces > 0 && report.exact + report.fitted == report.trims);
            assert!(report.gap.is_finite());
            assert!(model.faces().len() > 0);
        }
        Err(error) => assert!(!error.to_string().is_empty() && !error.code().is_empty()),
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn changed_bytes_do_no_harm(changes in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..8)) {
        let mut bytes = brick().into_bytes();
        for (index, byte) in changes {
            let index = index.index(bytes.len());
            bytes[index] = byte;
        }
        check(&bytes);
    }

    #[test]
    fn changed_numbers_and_references_do_no_harm(
        changes in prop::collection::vec((any::<prop::sample::Index>(), 0_u8..10), 1..8),
    ) {
        let mut bytes = brick().into_bytes();
        let start = bytes.windows(5).position(|window| window == b"DATA;").unwrap();
        let digits: Vec<usize> = (start..bytes.len()).filter(|&index| bytes[index].is_ascii_digit()).collect();
        for (index, digit) in changes {
            bytes[digits[index.index(digits.len())]] = b'0' + digit;
        }
        check(&bytes);
    }

    #[test]
    fn lost_and_repeated_lines_do_no_harm(from in any::<prop::sample::Index>(), to in any::<prop::sample::Index>()) {
        let text = brick();
        let lines: Vec<&str> = text.lines().collect();
        let mut changed = lines.clone();
        changed.remove(from.index(lines.len()));
        changed.insert(from.index(lines.len()), lines[to.index(lines.len())]);
        check(changed.join("\n").as_bytes());
    }
}
