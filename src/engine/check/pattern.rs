//! Patterns of the names of bodies.

use crate::error::{Error, Result};
use crate::model::face_path;

/// The level of a pattern that stands for any number of levels.
const ANY_LEVELS: &str = "**";

/// A pattern of the names of a body's levels: `*` is any text within one level, `?` any character, and a level
/// `**` any number of levels.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Pattern {
    levels: Vec<String>,
}

impl Pattern {
    /// Levels stand between slashes, with blanks about them as in names, or all without.
    ///
    /// # Errors
    /// [`Error::OptionInvalid`] for an empty pattern.
    pub(super) fn new(text: &str) -> Result<Self> {
        if text.trim().is_empty() {
            return Err(Error::OptionInvalid { found: "a rule has an empty pattern of names".to_owned() });
        }
        Ok(Self { levels: face_path(&spaced(text)) })
    }

    /// Returns whether it is a pattern of this joined name. O(levels² length²).
    pub(super) fn is_of(&self, name: &str) -> bool {
        levels_match(&self.levels, &face_path(name))
    }
}

/// Returns the pattern with blanks about the slashes between levels; of several slashes in a row, none is between
/// levels.
fn spaced(text: &str) -> String {
    if text.contains(" / ") {
        return text.to_owned();
    }
    let characters: Vec<char> = text.chars().collect();
    let is_slash = |index: Option<usize>| index.and_then(|index| characters.get(index)) == Some(&'/');
    let mut spaced = String::new();
    for (index, &character) in characters.iter().enumerate() {
        let is_level = character == '/' && !is_slash(index.checked_sub(1)) && !is_slash(Some(index + 1));
        if is_level { spaced.push_str(" / ") } else { spaced.push(character) }
    }
    spaced
}

fn levels_match(pattern: &[String], levels: &[String]) -> bool {
    match pattern.split_first() {
        None => levels.is_empty(),
        Some((first, rest)) if first == ANY_LEVELS => {
            (0..=levels.len()).any(|skipped| levels_match(rest, &levels[skipped..]))
        }
        Some((first, rest)) => levels.split_first().is_some_and(|(level, others)| {
            let [first, level] = [first, level].map(|text| text.chars().collect::<Vec<char>>());
            text_matches(&first, &level) && levels_match(rest, others)
        }),
    }
}

/// Matches one level: after each `*` the shortest text is taken first, and a longer one where the rest fails.
fn text_matches(pattern: &[char], text: &[char]) -> bool {
    let (mut at, mut of, mut star) = (0, 0, None);
    while at < text.len() {
        match pattern.get(of) {
            Some('*') => {
                star = Some((of, at));
                of += 1;
            }
            Some(&one) if one == '?' || one == text[at] => {
                at += 1;
                of += 1;
            }
            _ => match star {
                Some((place, taken)) => {
                    star = Some((place, taken + 1));
                    (of, at) = (place + 1, taken + 1);
                }
                None => return false,
            },
        }
    }
    pattern[of..].iter().all(|&one| one == '*')
}

#[cfg(all(test, not(target_arch = "wasm32")))]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod tests {
    use super::*;

    #[test]
    fn patterns_match_levels_and_parts_of_them() {
        for (pattern, name, expected) in [
            ("shaft", "shaft", true),
            ("shaft", "pump / shaft", false),
            ("*/shaft", "pump / shaft", true),
            ("**/shaft", "shaft", true),
            ("**/shaft", "a / b / shaft", true),
            ("pump/**", "pump / a / b", true),
            ("pump / *", "pump / a / b", false),
            ("bolt *", "bolt 12", true),
            ("bolt ?", "bolt 12", false),
            ("b*l*t", "bottle bolt", true),
            ("b*l*t", "bottle bold", false),
            ("in // out", "in // out", true),
            ("* // out/*", "in // out / body 1", true),
            ("**", "anything / at all", true),
            ("*", "", true),
        ] {
            assert_eq!(Pattern::new(pattern).unwrap().is_of(name), expected, "{pattern} of {name}");
        }
        assert!(Pattern::new(" ").is_err());
    }
}
