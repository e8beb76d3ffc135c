//! The colours that a file gives to its faces and bodies.

use super::exchange::{Exchange, number};
use crate::topology::Color;
use std::collections::HashMap;

/// The entities between a style and the colour of a surface.
const STYLES: [&str; 8] = [
    "PRESENTATION_STYLE_ASSIGNMENT",
    "SURFACE_STYLE_USAGE",
    "SURFACE_SIDE_STYLE",
    "SURFACE_STYLE_FILL_AREA",
    "FILL_AREA_STYLE",
    "FILL_AREA_STYLE_COLOUR",
    "SURFACE_STYLE_RENDERING",
    "SURFACE_STYLE_RENDERING_WITH_PROPERTIES",
];

/// The colours that have a name (ISO 10303-46).
const NAMED: [(&str, Color); 8] = [
    ("red", [1.0, 0.0, 0.0]),
    ("green", [0.0, 1.0, 0.0]),
    ("blue", [0.0, 0.0, 1.0]),
    ("yellow", [1.0, 1.0, 0.0]),
    ("magenta", [1.0, 0.0, 1.0]),
    ("cyan", [0.0, 1.0, 1.0]),
    ("black", [0.0, 0.0, 0.0]),
    ("white", [1.0, 1.0, 1.0]),
];

/// The longest way from a style to its colour.
const MAX_NESTING: usize = 8;

/// Returns the colours of instances. A style that overrides another one wins; those that hold in a
/// context only are left out. O(instances and styles).
pub(super) fn colors(file: &Exchange<'_>) -> HashMap<u64, Color> {
    let mut known = HashMap::new();
    let mut found: HashMap<u64, Color> = HashMap::new();
    for wanted in ["STYLED_ITEM", "OVER_RIDING_STYLED_ITEM"] {
        for &styled in file.numbers.iter().filter(|&&instance| file.keyword(instance) == wanted) {
            let Ok(entity) = file.entity(styled) else { continue };
            let (Ok(styles), Ok(item)) = (entity.references(1), entity.reference(2)) else { continue };
            let color = styles.iter().find_map(|&style| color_of(file, style, 0, &mut known));
            found.extend(color.map(|color| (item, color)));
        }
    }
    found
}

/// Returns the colour that a style leads to.
fn color_of(
    file: &Exchange<'_>,
    style: u64,
    nesting: usize,
    known: &mut HashMap<u64, Option<Color>>,
) -> Option<Color> {
    if let Some(&color) = known.get(&style) {
        return color;
    }
    // Styles that lead to themselves have no colour.
    known.insert(style, None);
    let color = match file.keyword(style) {
        "COLOUR_RGB" => rgb(file, style),
        "DRAUGHTING_PRE_DEFINED_COLOUR" | "PRE_DEFINED_COLOUR" => {
            let name = file.entity(style).ok()?.name()?;
            NAMED.iter().find(|(known, _)| name.eq_ignore_ascii_case(known)).map(|&(_, color)| color)
        }
        kind if STYLES.contains(&kind) && nesting < MAX_NESTING => {
            let next = file.entity(style).ok()?.all_references();
            next.into_iter().find_map(|next| color_of(file, next, nesting + 1, known))
        }
        _ => None,
    };
    known.insert(style, color);
    color
}

/// Returns the colour of three parts from 0 to 1.
fn rgb(file: &Exchange<'_>, color: u64) -> Option<Color> {
    let entity = file.entity(color).ok()?;
    let part = |index: usize| number(entity.value(index)).filter(|part| (0.0..=1.0).contains(part));
    Some([part(1)?, part(2)?, part(3)?])
}
