//! The region lies in the images of the maps, or near them, and is not empty.
//!
//! An image contains every point about which its boundary's winding number is not 0: a map of a
//! square that leaves the point out could be drawn together to a point without passing it.

use super::curve::Outline;
use super::map::Map;
use super::strip::{Side, Strip};
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
pub(super) fn check(face: &Face<'_>, maps: &[&Map]) -> Finding {
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
        let enlarged = face.enlarged(&target);
        let (mut touching, mut is_covered) = (Vec::new(), false);
        for &piece in &part.pieces {
            match outlines[piece].winding(&enlarged) {
                None => touching.push(piece),
                Some(0) => {}
                Some(_) => is_covered = true,
            }
        }
        if is_covered {
            continue;
        }
        let is_small = face.is_small(&target);
        if touching.is_empty() && (winding.is_some() || is_small) {
            let [u, v] = target.map(Interval::mid);
            return Finding::refuted(format!("no piece covers the face at ({u}, {v})"));
        }
        // A point of an image in a small part is near all of it.
        if is_small || is_covered_beside_strip(face, &outlines, &touching, &enlarged) {
            continue;
        }
        if part.halvings == MAX_HALVINGS || face.is_late() {
            found = Finding::OPEN;
            continue;
        }
        // Pieces that do not touch the part with what is near do not touch that of its halves.
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

/// Whether a strip contains all curves near a box, and pieces cover the region on both sides of it.
///
/// On a side of the strip no winding number changes. The strip's points are near a side that is covered.
fn is_covered_beside_strip(
    face: &Face<'_>,
    outlines: &[Outline],
    touching: &[usize],
    enlarged: &Box2,
) -> bool {
    let curves: Vec<&Outline> = touching.iter().map(|&piece| &outlines[piece]).chain([&face.loops]).collect();
    let Some(strip) = Strip::around(face, &curves, enlarged) else { return false };
    let Some(sides) = strip.sides(enlarged) else { return false };
    let mut some_covered = false;
    for Side { corner, .. } in &sides {
        if touching.iter().any(|&piece| outlines[piece].winding(corner).is_some_and(|winding| winding != 0)) {
            some_covered = true;
        } else if face.loops.winding(corner) != Some(0) {
            return false;
        }
    }
    some_covered
}

fn halves(face: &Face<'_>, part: &Part, pieces: Vec<usize>) -> [Part; 2] {
    let size = |axis: usize| {
        let mut vector = [0.0; 2];
        vector[axis] = part.parameters[axis][1] - part.parameters[axis][0];
        face.size(vector)
    };
    let axis = usize::from(size(1) > size(0));
    let [low, high] = part.parameters[axis];
    let middle = 0.5 * (low + high);
    [[low, middle], [middle, high]].map(|range| {
        let mut parameters = part.parameters;
        parameters[axis] = range;
        Part { parameters, pieces: pieces.clone(), halvings: part.halvings + 1 }
    })
}
