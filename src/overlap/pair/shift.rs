//! The vector by which planes that lie on each other are moved apart: lemma O4 of docs/facts.md.

use super::shared::Partners;
use crate::overlap::piece::{Patches, Whole};
use crate::overlap::separation::{heights, normal};
use crate::rounding::upper_max;
use glam::DVec3;

/// The part of the margin within which a patch counts as plane, and two as parallel.
const FLATNESS: f64 = 0.125;

/// The distance of planes, in margins, from which on no vector moves them onto each other.
const MAX_OFFSET: f64 = 128.0;

/// The distance of planes, in margins, that tells them apart with their flatness.
const MIN_OFFSET: f64 = 1.0 + 2.0 * FLATNESS;

/// The distance of curved patches that a motion parts, relative to its length: it is less along most of their normals.
const COINCIDENCE: f64 = 0.25;

/// The largest distance of a patch from its quadric, as a part of a motion's length, with which the motion separates the
/// patch from one like it. Only small pieces separate patches with larger distances: with a quarter in place of this, and
/// with 8, a search takes five times as many pieces.
const QUADRIC_PART: f64 = 0.0625;

/// The length of the shortest vectors that are tried, in margins: they serve planes across their direction.
const LENGTH: f64 = 2.0;

/// The lengths of the others, relative to it: the longest ones serve planes at a few degrees to their direction.
const LENGTHS: [f64; 6] = [1.0, 2.0, 4.0, 8.0, 16.0, 32.0];

/// The number of directions that are tried.
const DIRECTIONS: usize = 32;

/// The turn from one direction to the next, the golden angle, by which they are spread evenly.
const TURN: f64 = 2.399_963_229_728_653;

/// Two plane patches of different solids in one plane or nearly so.
struct Flush {
    normal: DVec3,
    /// The height of that of the second solid over that of the first one.
    offset: f64,
    size: f64,
}

/// Returns the vector by which the second solid is to be moved for its plane patches to be farther than `margin` from
/// those of the first one, the shortest of those that are tried, which have at least the length `least`; 0 where they
/// are, and `least` is 0.
/// O(n log n) in general position.
pub(super) fn shift([a, b]: [&Patches; 2], margin: f64, least: f64) -> DVec3 {
    let mut flush = Vec::new();
    for whole in a.faces() {
        let Some(normal) = plane(whole, margin) else { continue };
        for other in b.near(&whole.root.aabb, MAX_OFFSET * margin) {
            let Some(other) = b.wholes.get(other as usize).filter(|whole| !whole.is_strip) else { continue };
            let other = &other.root;
            let [low, high] = heights(other, normal, whole.root.middle);
            let offset = 0.5 * (low + high);
            if high - low <= FLATNESS * margin && offset.abs() <= MAX_OFFSET * margin {
                flush.push(Flush { normal, offset, size: whole.root.radius * other.radius });
            }
        }
    }
    let left = |vector: DVec3| {
        let near = |pair: &&Flush| {
            let offset: f64 = pair.offset + pair.normal.dot(vector);
            offset.abs() <= MIN_OFFSET * margin
        };
        flush.iter().filter(near).map(|pair| pair.size).sum::<f64>()
    };
    let (mut best, mut fewest) = (DVec3::ZERO, if least > 0.0 { f64::INFINITY } else { left(DVec3::ZERO) });
    let shortest = upper_max(LENGTH * margin, least);
    for length in LENGTHS {
        for direction in (0..DIRECTIONS).map(direction) {
            let vector = length * shortest * direction;
            let left = left(vector);
            if left < fewest {
                (best, fewest) = (vector, left);
            }
        }
    }
    best
}

/// Returns whether a curved patch of the first solid lies on one of the second one that is not its partner, or within a
/// part of a length of it. O(n log n) in general position.
pub(super) fn lie_on_each_other([a, b]: [&Patches; 2], partners: &Partners, length: f64) -> bool {
    let reach = COINCIDENCE * length;
    a.faces().enumerate().filter(|&(index, _)| partners.of(0, index).is_none()).any(|(_, whole)| {
        let near = b.near(&whole.root.aabb, reach);
        if near.is_empty() || plane(whole, reach).is_some() {
            return false;
        }
        let Some(fitted) = whole.carrier(&whole.root).filter(|fitted| fitted.reach <= reach) else {
            return false;
        };
        let near = near.into_iter().filter_map(|index| b.wholes.get(index as usize));
        near.filter(|other| !other.is_strip).any(|other| fitted.is_within(other, &other.root, reach))
    })
}

/// Returns whether a motion of this length parts a patch from one like it. Patches that lie on a quadric, but for a part of
/// the length, cross along curves then, and carriers tell them apart elsewhere; one without a width has no area.
pub(super) fn is_parted_by(whole: &Whole, length: f64) -> bool {
    let is_on_quadric =
        || whole.carrier(&whole.root).is_some_and(|fitted| fitted.reach <= QUADRIC_PART * length);
    normal((whole, &whole.root)) == DVec3::ZERO || is_on_quadric()
}

/// Returns the unit normal of a patch that is plane, if it is.
pub(super) fn plane(whole: &Whole, margin: f64) -> Option<DVec3> {
    let normal = normal((whole, &whole.root));
    let [low, high] = heights(&whole.root, normal, whole.root.middle);
    (normal != DVec3::ZERO && high - low <= FLATNESS * margin).then_some(normal)
}

/// Returns one of the directions, spread over the sphere's upper half.
fn direction(index: usize) -> DVec3 {
    let z = (index as f64 + 0.5) / DIRECTIONS as f64;
    let (sine, cosine) = (TURN * index as f64).sin_cos();
    let radius = (1.0 - z * z).sqrt();
    DVec3::new(radius * cosine, radius * sine, z)
}
