//! Texts of files as they can be shown: one line, in the order of its characters.

/// The character that stands for one that is not shown.
const REPLACEMENT: char = '\u{fffd}';

/// Returns a text with every character replaced by U+FFFD that would do more than stand in a line: control
/// characters, which move the cursor of a terminal or end the line, separators of lines and paragraphs, and marks
/// that show what follows in another order (U+202A to U+202E and U+2066 to U+2069). O(length).
#[must_use]
pub fn one_line(text: &str) -> String {
    text.chars().map(|character| if is_shown(character) { character } else { REPLACEMENT }).collect()
}

/// Whether a character stands in a line and leaves the others where they are.
fn is_shown(character: char) -> bool {
    let breaks_line = character.is_control() || matches!(character, '\u{2028}' | '\u{2029}');
    let reorders = matches!(character, '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}');
    !breaks_line && !reorders
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_breaks_or_reorders_a_line_is_replaced_and_nothing_else() {
        for whole in ["", "bolt M6/20", "Fläche 3", "面", "שלום", "a\u{200d}b", "tab or space", "\u{fffd}"]
        {
            assert_eq!(one_line(whole), whole);
        }
        for broken in
            "\n\r\t\u{0}\u{1b}\u{7f}\u{85}\u{9b}\u{2028}\u{2029}\u{202a}\u{202e}\u{2066}\u{2069}".chars()
        {
            assert_eq!(one_line(&format!("a{broken}b")), "a\u{fffd}b", "{broken:?}");
        }
        assert_eq!(one_line("up\u{1b}[2Jerror[X]: \n"), "up\u{fffd}[2Jerror[X]: \u{fffd}");
    }
}
