//! Maps from the parameters of pieces to those of their face.

use super::curve::{Node, Outline};
use super::{Box2, Controls};
use crate::proof::interval::Interval;

/// A map from a piece's parameters (s, t) to the face's (u, v).
pub(crate) enum Map {
    /// The piece's parameters are the face's; those of the piece are this box.
    Identity { domain: [[f64; 2]; 2] },
    /// `(1 - s) left(t) + s right(t)`, then from [0, 1]² to the domain.
    Ruled(Ruled),
}

/// A ruled map.
pub(crate) struct Ruled {
    /// Left and right in the domain of the face's surface.
    sides: [Node; 2],
    /// Whether s and t have changed places.
    transposed: bool,
}

impl Ruled {
    /// The map between two sides in the unit square, from there to the domain of the face's surface; `transposed`
    /// is whether s and t, and u and v, change places.
    pub(crate) fn new(sides: [Controls; 2], domain: [[f64; 2]; 2], transposed: bool) -> Self {
        let place = |[x, y, w]: [f64; 3]| {
            let weight = Interval::point(w);
            let unit = exchanged([x, y].map(|value| Interval::point(value) / weight), transposed);
            let [u, v] = std::array::from_fn(|axis| {
                let [start, end] = domain[axis].map(Interval::point);
                start + unit[axis] * (end - start)
            });
            [u * weight, v * weight, weight]
        };
        let side = |side: Controls| Node::side(side.into_iter().map(place).collect());
        Self { sides: sides.map(side), transposed }
    }

    fn outline(&self) -> Outline {
        let [left, right] = self.sides.each_ref().map(Node::controls);
        let bottom = vec![left[0], right[0]];
        let top = vec![right[right.len() - 1], left[left.len() - 1]];
        let back = left.iter().rev().copied().collect();
        Outline::of_intervals(std::iter::once(vec![bottom, right.to_vec(), top, back]))
    }

    /// The sides over a part of the piece, and its ends across.
    pub(super) fn over(&self, part: [[f64; 2]; 2]) -> ([&Node; 2], [f64; 2]) {
        let [s, t] = exchanged(part, self.transposed);
        (self.sides.each_ref().map(|side| side.over(t)), s)
    }

    /// The axis of the piece along the sides.
    pub(super) fn along(&self) -> usize {
        usize::from(!self.transposed)
    }
}

/// The points at these parts of all segments from one interval to the other.
fn blends(parts: [f64; 2], [from, to]: [Interval; 2]) -> Interval {
    let [low, high] = parts.map(|part| {
        let part = Interval::point(part);
        (Interval::ONE - part) * from + part * to
    });
    low.hull(high)
}

fn exchanged<T>(pair: [T; 2], transposed: bool) -> [T; 2] {
    let [a, b] = pair;
    if transposed { [b, a] } else { [a, b] }
}

impl Map {
    /// The values of a linear function in the image of a part of the piece, which halvings make: exact
    /// to second order in t, and in s.
    pub(super) fn values(&self, part: [[f64; 2]; 2], function: impl Fn(&Box2) -> Interval) -> Interval {
        let hull = |points: &mut dyn Iterator<Item = Box2>| {
            points.map(|point| function(&point)).reduce(Interval::hull).unwrap_or(Interval::ENTIRE)
        };
        match self {
            Self::Identity { .. } => {
                let corners = [[0, 0], [0, 1], [1, 0], [1, 1]];
                hull(&mut corners.into_iter().map(|ends| [0, 1].map(|k| Interval::point(part[k][ends[k]]))))
            }
            Self::Ruled(ruled) => {
                let (sides, s) = ruled.over(part);
                blends(s, sides.map(|side| hull(&mut side.points())))
            }
        }
    }

    /// The box of the image of a part of the piece, which halvings make.
    pub(super) fn hull(&self, part: [[f64; 2]; 2]) -> Box2 {
        [0, 1].map(|axis| self.values(part, |point| point[axis]))
    }

    /// The images of the corners of a part, which halvings make: of the starts of both parameters, of the
    /// start and the end, of the end and the start, of the ends.
    pub(super) fn corners(&self, part: [[f64; 2]; 2]) -> [Box2; 4] {
        [[0, 0], [0, 1], [1, 0], [1, 1]].map(|ends| match self {
            Self::Identity { .. } => [0, 1].map(|axis| Interval::point(part[axis][ends[axis]])),
            Self::Ruled(ruled) => {
                let (sides, s) = ruled.over(part);
                let [across, along] = exchanged(ends, ruled.transposed);
                let points = sides.map(|side| side.end(along));
                [0, 1].map(|axis| blends([s[across]; 2], points.map(|point| point[axis])))
            }
        })
    }

    /// About the lengths of the image of a part along both parameters, by the size of vectors (u, v).
    pub(super) fn lengths(&self, part: [[f64; 2]; 2], size: impl Fn([f64; 2]) -> f64) -> [f64; 2] {
        match self {
            Self::Identity { .. } => {
                let [u, v] = part.map(|[low, high]| high - low);
                [size([u, 0.0]), size([0.0, v])]
            }
            Self::Ruled(ruled) => {
                let ([left, right], s) = ruled.over(part);
                let along = |side: &Node| size(side.hull.map(|hull| hull.hi - hull.lo));
                let across = |end: usize| {
                    size([0, 1].map(|k| (s[1] - s[0]) * (right.ends[end][k] - left.ends[end][k])))
                };
                let lengths = [across(0).max(across(1)), along(left).max(along(right))];
                exchanged(lengths, ruled.transposed)
            }
        }
    }

    /// The box of the piece's own parameters.
    pub(super) fn parameters(&self) -> [[f64; 2]; 2] {
        match self {
            Self::Identity { domain } => *domain,
            Self::Ruled(_) => [[0.0, 1.0]; 2],
        }
    }

    /// The image of the boundary of the piece, once around.
    pub(super) fn outline(&self) -> Outline {
        match self {
            Self::Identity { domain: [[u0, u1], [v0, v1]] } => {
                let corners = [[*u0, *v0], [*u1, *v0], [*u1, *v1], [*u0, *v1]];
                let side = |k: usize| [corners[k], corners[(k + 1) % 4]].map(|[u, v]| [u, v, 1.0]).to_vec();
                Outline::new(std::iter::once((0..4).map(side).collect()))
            }
            Self::Ruled(ruled) => ruled.outline(),
        }
    }
}
