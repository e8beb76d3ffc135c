//! Damaged files: an error with a code, or a model whose report accounts for its faces.

use crate::boundaries_text;
use nurbs_hausdorff_cad::from_iges;
use proptest::prelude::*;

/// Replaces a line, counted from 0.
fn with_line(text: &str, index: usize, line: &str) -> String {
    let mut lines: Vec<&str> = text.lines().collect();
    lines[index] = line;
    lines.join("\n")
}

#[test]
fn a_file_that_ends_early_is_refused() {
    let text = boundaries_text();
    let end = text.trim_end().len();
    for length in (0..end).step_by(37).chain(end - 80..end) {
        let error = from_iges(&text.as_bytes()[..length]).unwrap_err();
        assert_eq!(error.code(), "IGES_SYNTAX", "{length} of {end} bytes");
    }
    assert!(from_iges(&text.as_bytes()[..end]).is_ok());
}

#[test]
fn lost_and_exchanged_lines_are_refused() {
    let text = boundaries_text();
    let lines: Vec<&str> = text.lines().collect();
    for index in 0..lines.len() {
        let mut lost = lines.clone();
        lost.remove(index);
        let error = from_iges(lost.join("\n").as_bytes()).unwrap_err();
        assert_eq!(error.code(), "IGES_SYNTAX", "line {index}");
        let mut exchanged = lines.clone();
        exchanged.swap(index, (index + 1) % lines.len());
        let error = from_iges(exchanged.join("\n").as_bytes()).unwrap_err();
        assert_eq!(error.code(), "IGES_SYNTAX", "line {index}");
    }
}

#[test]
fn an_error_names_the_line() {
    let text = boundaries_text();
    let index = text.lines().position(|line| line.contains("D      5")).unwrap();
    let line = text.lines().nth(index).unwrap();
    for (changed, expected) in [
        (line.replace("D      5", "D      7"), "expected line 5 of the section"),
        (line.replace("D      5", "X      5"), "expected one of the sections"),
        (line[..60].to_owned(), "expected 80 columns"),
        (format!("{}       x{}", &line[..8], &line[16..]), "integers in columns"),
    ] {
        let error = from_iges(with_line(&text, index, &changed).as_bytes()).err().unwrap();
        assert_eq!(error.code(), "IGES_SYNTAX");
        let message = error.to_string();
        assert!(message.contains(&format!("line {}", index + 1)) && message.contains(expected), "{message}");
    }
}

/// The last line counts the lines of each section.
#[test]
fn wrong_totals_are_refused() {
    let text = boundaries_text();
    let last = text.lines().last().unwrap();
    let changed = text.replace(last, &last.replacen('1', "2", 1));
    assert_eq!(from_iges(changed.as_bytes()).unwrap_err().code(), "IGES_SYNTAX");
}

/// Checks what the reader guarantees of any bytes.
fn check(bytes: &[u8]) {
    match from_iges(bytes) {
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
        let mut bytes = boundaries_text().into_bytes();
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
        let mut bytes = boundaries_text().into_bytes();
        // Columns of directory and parameters before the numbers of lines.
        let is_content = |index: usize| index % 81 < 64;
        let digits: Vec<usize> =
            (0..bytes.len()).filter(|&index| is_content(index) && bytes[index].is_ascii_digit()).collect();
        for (index, digit) in changes {
            bytes[digits[index.index(digits.len())]] = b'0' + digit;
        }
        check(&bytes);
    }

    #[test]
    fn exchanged_parameters_do_no_harm(from in any::<prop::sample::Index>(), to in any::<prop::sample::Index>()) {
        let text = boundaries_text();
        let lines: Vec<&str> = text.lines().collect();
        let (from, to) = (from.index(lines.len()), to.index(lines.len()));
        // The content of one line on the place of another.
        let changed = format!("{}{}", &lines[from][..64], &lines[to][64..]);
        check(with_line(&text, to, &changed).as_bytes());
    }
}
