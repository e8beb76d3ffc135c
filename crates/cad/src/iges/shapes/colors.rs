//! The colours that the directory gives to entities.

use crate::iges::file::{Entry, File};
use crate::topology::Color;

/// The type of an entity that defines a colour.
const DEFINITION: u32 = 314;

/// Parts of a defined colour are per cent.
const WHOLE: f64 = 100.0;

/// The colours that have a number, from 1.
const NUMBERED: [Color; 8] = [
    [0.0, 0.0, 0.0],
    [1.0, 0.0, 0.0],
    [0.0, 1.0, 0.0],
    [0.0, 0.0, 1.0],
    [1.0, 1.0, 0.0],
    [1.0, 0.0, 1.0],
    [0.0, 1.0, 1.0],
    [1.0, 1.0, 1.0],
];

/// Returns the colour of an entity, if the file gives it one that can be read.
pub(super) fn color_of(file: &File<'_>, entry: &Entry) -> Option<Color> {
    if let Ok(number) = usize::try_from(entry.color) {
        return NUMBERED.get(number.checked_sub(1)?).copied();
    }
    let definition = file.entity(entry.color.unsigned_abs()).ok()?;
    let part = |index| {
        let part = definition.real(index).ok()? / WHOLE;
        (0.0..=1.0).contains(&part).then_some(part)
    };
    (definition.entry.kind == DEFINITION).then_some(())?;
    Some([part(1)?, part(2)?, part(3)?])
}
