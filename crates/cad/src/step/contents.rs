//! What a file without faces has instead.

use super::exchange::Exchange;
use super::relations::{Relations, items};
use std::collections::HashMap;

/// The most kinds of entities that are named.
const NAMED: usize = 4;

/// Returns the kinds of the items of the file's representations of shapes, the most frequent first; of a file
/// without such items those of its instances. O(length).
pub(super) fn contents(file: &Exchange<'_>) -> String {
    let relations = Relations::of(file);
    let of_representations =
        || relations.representations.iter().filter_map(items).flat_map(|(items, _)| items);
    let held = kinds(of_representations().map(|item| file.keyword(item)));
    if !held.is_empty() {
        return format!("its representations of shapes hold {held}");
    }
    let all = kinds(file.numbers.iter().map(|&number| file.keyword(number)));
    if all.is_empty() {
        "it has no instances".to_owned()
    } else {
        format!("no shape is represented by its {all}")
    }
}

/// Returns the most frequent words, each with its number.
fn kinds<'a>(words: impl Iterator<Item = &'a str>) -> String {
    let mut counts: HashMap<&str, usize> = HashMap::new();
    for word in words {
        *counts.entry(word).or_default() += 1;
    }
    let mut counts: Vec<(&str, usize)> = counts.into_iter().collect();
    counts.sort_by(|(a, count), (b, other)| other.cmp(count).then(a.cmp(b)));
    let more = if counts.len() > NAMED { " and others" } else { "" };
    let named = counts.iter().take(NAMED).map(|(kind, count)| match *kind {
        "" => format!("{count} instances that are not defined"),
        kind => format!("{count} {kind}"),
    });
    let named: Vec<String> = named.collect();
    if named.is_empty() { String::new() } else { format!("{}{more}", named.join(", ")) }
}
