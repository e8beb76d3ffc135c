//! The region lies in the images of the maps, or near them, and is not empty.
//!
//! An image contains every point about which its boundary's winding number is not 0: a map of a
//! square that leaves the point out could be drawn together to a point without passing it.

use super::curve::Outline;
use super::map::Map;
use super::{Box2, Face, Finding};
use crate::proof::Verdict;
use crate::proof::interval::Interval;

/// The halvings of the region's box after which a part is given up.
const MAX_HALVINGS: u32 = 60;

/// The part of its box below which a region counts as nothing: far above rounding.
const NO_AREA: f64 = 1e-12;

/// A part of the parameter plane with the pieces whose images may meet it.
struct Part {
    parameters: [[f64; 2]; 2],
    pieces: Vec<usize>,
    halvings: u32,
}

/// Proves the statement.
pub(super) fn check(face: &Face, maps: &[&Map]) -> Finding {
    let outlines: Vec<Outline> = maps.iter().map(|map| map.outline()).collect();
    let parameters = face.loops.bounds().map(|bounds| [bounds.lo, bounds.hi]);
    let mut open = vec![Part { parameters, pieces: (0..maps.len()).collect(), halvings: 0 }];
    let (mut found, mut has_area) = (Finding::PROVED, false);
    while let Some(part) = open.pop() {
        let target = part.parameters.map(|[low, high]| Interval { lo: low, hi: high });
        let winding = face.loops.winding(&target);
        if winding == Some(0) {
            continue;
        }
        has_area |= winding.is_some();
        let (mut touching, mut is_covered) = (Vec::new(), false);
        for &piece in &part.pieces {
            match outlines[piece].winding(&target) {
                None => touching.push(piece),
                Some(0) => {}
                Some(_) => is_covered = true,
            }
        }
        // A point of an image in a small part is near all of it.
        if is_covered || (!touching.is_empty() && face.is_small(&target)) {
            continue;
        }
        let is_decided = winding.is_some() && touching.is_empty();
        if (is_decided || face.is_small(&target)) && !is_near(face, &outlines, &target) {
            let [u, v] = target.map(Interval::mid);
            return Finding::refuted(format!("no piece covers the face at ({u}, {v})"));
        }
        if face.is_small(&target) {
            continue;
        }
        if part.halvings == MAX_HALVINGS || face.is_late() {
            found = Finding::OPEN;
            continue;
        }
        // Pieces that do not touch the part do not touch its halves, but may touch what is near.
        open.extend(halves(face, &part, touching));
    }
    if has_area || found.verdict != Verdict::Proved {
        return found;
    }
    // No box is inside: the region is narrower than the limit, or nothing.
    let area = face.loops.area();
    let length = face.loops.bounds().iter().map(|bounds| bounds.hi - bounds.lo).fold(0.0, f64::max);
    if area.lo > 0.0 {
        found
    } else if area.hi <= NO_AREA * length * length {
        Finding::refuted("the loops are around nothing".to_owned())
    } else {
        Finding::OPEN
    }
}

/// Whether some image meets the box with what is near it.
fn is_near(face: &Face, outlines: &[Outline], target: &Box2) -> bool {
    let enlarged = face.enlarged(target);
    outlines.iter().any(|outline| outline.winding(&enlarged) != Some(0))
}

fn halves(face: &Face, part: &Part, pieces: Vec<usize>) -> [Part; 2] {
    let size = |axis: usize| (part.parameters[axis][1] - part.parameters[axis][0]) / face.small[axis];
    let axis = usize::from(size(1) > size(0));
    let [low, high] = part.parameters[axis];
    let middle = 0.5 * (low + high);
    [[low, middle], [middle, high]].map(|range| {
        let mut parameters = part.parameters;
        parameters[axis] = range;
        Part { parameters, pieces: pieces.clone(), halvings: part.halvings + 1 }
    })
}
