//! The levels of an assembly: its groups that have a name, each where it stands.

use std::borrow::Cow;
use std::collections::{HashMap, HashSet};

use nurbs_hausdorff::workspace::level;

/// A level by its index; `None` is the file itself.
pub(crate) type LevelId = Option<usize>;

/// Levels in the order in which they are met.
#[derive(Default)]
pub(crate) struct Levels<'a> {
    /// The level above each, its own name, and the number among those of the same name there, from 1.
    levels: Vec<(LevelId, Cow<'a, str>, usize)>,
    /// The names in use below each level, with their numbers.
    taken: HashSet<(LevelId, String)>,
    /// The number of the last level of a name below another.
    last: HashMap<(LevelId, Cow<'a, str>), usize>,
}

impl<'a> Levels<'a> {
    /// Appends a level: from the second of the same name on they are numbered.
    pub(crate) fn push(&mut self, above: LevelId, name: Cow<'a, str>) -> usize {
        let last = self.last.entry((above, name.clone())).or_insert(0);
        loop {
            *last += 1;
            // Another level may be called by this number itself.
            if self.taken.insert((above, numbered(&name, *last))) {
                break;
            }
        }
        self.levels.push((above, name, *last));
        self.levels.len() - 1
    }

    /// Returns the names of a level and of all above it, joined.
    pub(crate) fn path(&self, mut id: LevelId) -> Option<String> {
        let mut names = Vec::new();
        while let Some(index) = id {
            let (above, name, number) = &self.levels[index];
            names.push(level(&numbered(name, *number)));
            id = *above;
        }
        names.reverse();
        (!names.is_empty()).then(|| names.join(" / "))
    }
}

fn numbered(name: &str, number: usize) -> String {
    if number == 1 { name.to_owned() } else { format!("{name} ({number})") }
}

/// Returns the name of a place of a part: that of the place, with the part's if it says more.
pub(crate) fn placed_name<'a>(place: Option<&'a str>, part: Option<&'a str>) -> Option<Cow<'a, str>> {
    match (place, part) {
        (Some(place), Some(part)) if !place.contains(part) => Some(format!("{part} ({place})").into()),
        (place, part) => place.or(part).map(Cow::Borrowed),
    }
}
