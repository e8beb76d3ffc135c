//! Names of faces in assemblies: the names of all levels, from the outermost to the face's own, with
//! `" / "` between them.
//!
//! A word of slashes alone in a name of a level is written with one more, so that it is no separator:
//! `in / out` is written `in // out`, and `bolt M6/20` as it is.

/// The word between two levels.
const SEPARATOR: &str = "/";

/// Returns the name of one level as it stands in a joined name.
pub fn level(name: &str) -> String {
    let words = name.split(' ');
    let escaped = words.map(|word| if is_slashes(word) { format!("{word}/") } else { word.to_owned() });
    escaped.collect::<Vec<_>>().join(" ")
}

/// Returns the names of the levels in the name of a face, the face's own last.
#[must_use]
pub fn face_path(name: &str) -> Vec<String> {
    let mut levels: Vec<Vec<&str>> = vec![Vec::new()];
    for word in name.split(' ') {
        match levels.last_mut() {
            Some(words) if word != SEPARATOR => words.push(if is_slashes(word) { &word[1..] } else { word }),
            _ => levels.push(Vec::new()),
        }
    }
    levels.into_iter().map(|words| words.join(" ")).collect()
}

fn is_slashes(word: &str) -> bool {
    !word.is_empty() && word.bytes().all(|byte| byte == b'/')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn levels_come_back_from_their_joined_name() {
        let names = ["bolt M6/20", "in / out", "/", "a /", "/ b", " ", "", "// x // y", "é / ü", "a  /  b"];
        for first in names {
            for second in names {
                for third in names {
                    let joined = [first, second, third].map(level).join(" / ");
                    assert_eq!(face_path(&joined), [first, second, third], "{joined}");
                }
            }
        }
        assert_eq!([level("bolt M6/20"), level("in / out")], ["bolt M6/20", "in // out"]);
        assert_eq!(face_path("pump / in // out / face 3"), ["pump", "in / out", "face 3"]);
    }
}
