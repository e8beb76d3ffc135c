//! The images of the maps lie in the region, or near it.

use super::map::Map;
use super::{Box2, Face, Finding};
use crate::proof::interval::Interval;

/// The halvings of a piece's parameters after which a part is given up.
const MAX_HALVINGS: u32 = 60;

/// Proves the statement for all pieces.
pub(super) fn check(face: &Face, maps: &[&Map]) -> Finding {
    let mut found = Finding::PROVED;
    for (index, map) in maps.iter().enumerate() {
        found = found.and(|| piece(face, map, index));
    }
    found
}

fn piece(face: &Face, map: &Map, index: usize) -> Finding {
    let mut found = Finding::PROVED;
    let mut open: Vec<([[f64; 2]; 2], u32)> = vec![(map.parameters(), 0)];
    while let Some((part, halvings)) = open.pop() {
        let parameters = part.map(|[low, high]| Interval { lo: low, hi: high });
        let image = map.image(parameters);
        match face.loops.winding(&image) {
            Some(winding) if winding != 0 => continue,
            Some(_) if face.loops.winding(&face.enlarged(&image)).is_some() => {
                let [u, v] = image.map(Interval::mid);
                return Finding::refuted(format!(
                    "piece {index} leaves the face: at ({u}, {v}) it is outside"
                ));
            }
            // Near a loop, all of it as the part is small.
            _ if face.is_small(&image) => continue,
            _ => {}
        }
        if halvings == MAX_HALVINGS || face.is_late() {
            found = Finding::OPEN;
            continue;
        }
        let axis = longer(map, part, face);
        let [low, high] = part[axis];
        let middle = 0.5 * (low + high);
        for range in [[low, middle], [middle, high]] {
            let mut half = part;
            half[axis] = range;
            open.push((half, halvings + 1));
        }
    }
    found
}

/// The parameter along which the image of a part is longer, in units of the small size.
fn longer(map: &Map, part: [[f64; 2]; 2], face: &Face) -> usize {
    let middle = part.map(|[low, high]| Interval::point(0.5 * (low + high)));
    let size = |axis: usize| {
        let mut line: Box2 = middle;
        line[axis] = Interval { lo: part[axis][0], hi: part[axis][1] };
        let image = map.image(line);
        (0..2).map(|k| (image[k].hi - image[k].lo) / face.small[k]).fold(0.0, f64::max)
    };
    usize::from(size(1) > size(0))
}
