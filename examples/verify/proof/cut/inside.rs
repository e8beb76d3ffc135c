//! The images of the maps lie in the region, or near it.

use super::map::Map;
use super::strip::{Side, Strip};
use super::{Box2, Face, Finding};
use crate::proof::interval::Interval;

/// The halvings of a piece's parameters after which a part is given up.
const MAX_HALVINGS: u32 = 60;

/// Proves the statement for all pieces.
pub(super) fn check(face: &Face<'_>, maps: &[&Map]) -> Finding {
    let mut found = Finding::PROVED;
    for (index, map) in maps.iter().enumerate() {
        found = found.and(|| piece(face, map, index));
    }
    found
}

fn piece(face: &Face<'_>, map: &Map, index: usize) -> Finding {
    let mut found = Finding::PROVED;
    let mut open: Vec<([[f64; 2]; 2], u32)> = vec![(map.parameters(), 0)];
    while let Some((part, halvings)) = open.pop() {
        let image = map.hull(part);
        let enlarged = face.enlarged(&image);
        match face.loops.winding(&enlarged) {
            Some(0) => {
                let [u, v] = image.map(Interval::mid);
                return Finding::refuted(format!(
                    "piece {index} leaves the face: at ({u}, {v}) it is outside"
                ));
            }
            Some(_) => continue,
            // Near a loop, all of it as the part is small.
            None if face.is_small(&image) => continue,
            None if is_inside_beside_strip(face, map, part, &enlarged) => continue,
            None => {}
        }
        // Along the longer one of the image's sides.
        let [along_s, along_t] = map.lengths(part, |vector| face.size(vector));
        let axis = usize::from(along_t > along_s);
        let [low, high] = part[axis];
        let middle = 0.5 * (low + high);
        let is_divisible = low < middle && middle < high;
        if halvings == MAX_HALVINGS || !is_divisible || face.is_late() {
            found = Finding::OPEN;
            continue;
        }
        for range in [[low, middle], [middle, high]] {
            let mut half = part;
            half[axis] = range;
            open.push((half, halvings + 1));
        }
    }
    found
}

/// Whether the loops near the image of a part lie in a strip, and the image on sides of it that are
/// within them, or near those.
fn is_inside_beside_strip(face: &Face<'_>, map: &Map, part: [[f64; 2]; 2], enlarged: &Box2) -> bool {
    let Some(strip) = Strip::around(face, &[&face.loops], enlarged) else { return false };
    let Some(sides) = strip.sides(enlarged) else { return false };
    let is_within = |side: &&Side| face.loops.winding(&side.corner).is_some_and(|winding| winding != 0);
    let within: Vec<&Side> = sides.iter().filter(is_within).collect();
    match within.as_slice() {
        [] => false,
        [side] if sides.len() > 1 => strip.is_beside(side, map.values(part, |point| strip.values(point))),
        _ => true,
    }
}
