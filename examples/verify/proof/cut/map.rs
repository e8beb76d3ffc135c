//! Maps from the parameters of pieces to those of their face.

use super::curve::{Outline, Point};
use super::{Box2, Controls};
use crate::proof::bezier::Net;
use crate::proof::interval::Interval;
use crate::proof::vector::Vector;
use std::cell::RefCell;
use std::collections::HashMap;

/// A map from a piece's parameters (s, t) to the face's (u, v).
pub(crate) enum Map {
    /// The piece's parameters are the face's; those of the piece are this box.
    Identity { domain: [[f64; 2]; 2] },
    /// `(1 - s) left(t) + s right(t)`, then from [0, 1]² to the domain.
    Ruled(Ruled),
}

/// A ruled map.
pub(crate) struct Ruled {
    /// Left and right in the unit square, as patches that do not depend on their first parameter.
    pub(super) sides: [Net; 2],
    /// The domain of the face's surface.
    pub(super) domain: [[f64; 2]; 2],
    /// Whether s and t, and u and v, change places.
    pub(super) transposed: bool,
    /// The boxes of both sides over parts of t, as halving s asks for them again and again.
    hulls: RefCell<HashMap<[u64; 2], [Vector; 2]>>,
}

impl Ruled {
    pub(crate) fn new(sides: [Controls; 2], domain: [[f64; 2]; 2], transposed: bool) -> Self {
        let net = |side: Controls| {
            let point = |[x, y, w]: [f64; 3]| [x, y, 0.0, w].map(Interval::point);
            Net { degree: [0, side.len() - 1], points: side.into_iter().map(point).collect() }
        };
        Self { sides: sides.map(net), domain, transposed, hulls: RefCell::default() }
    }

    /// The image of a box by the hulls of the sides' control points over its t, which are exact
    /// where a side is a parameter line.
    fn image(&self, parameters: Box2) -> Box2 {
        let [s, t] = exchanged(parameters, self.transposed);
        let hulls = *self.hulls.borrow_mut().entry([t.lo, t.hi].map(f64::to_bits)).or_insert_with(|| {
            self.sides.each_ref().map(|side| side.restrict(1, [t.lo, t.hi]).bounding_box())
        });
        let unit = std::array::from_fn(|axis| {
            let [left, right] = [hulls[0][axis], hulls[1][axis]];
            let at = |s: f64| {
                let s = Interval::point(s);
                (Interval::ONE - s) * left + s * right
            };
            at(s.lo).hull(at(s.hi))
        });
        placed(exchanged(unit, self.transposed), &self.domain)
    }

    /// The homogeneous control points of a side in the domain.
    fn side(&self, index: usize) -> Vec<Point> {
        let place = |&[x, y, _, w]: &[Interval; 4]| {
            let [u, v] = placed(exchanged([x / w, y / w], self.transposed), &self.domain);
            [u * w, v * w, w]
        };
        self.sides[index].points.iter().map(place).collect()
    }

    fn outline(&self) -> Outline {
        let [left, right] = [0, 1].map(|index| self.side(index));
        let bottom = vec![left[0], right[0]];
        let top = vec![right[right.len() - 1], left[left.len() - 1]];
        let back = left.iter().rev().copied().collect();
        Outline::of_intervals(std::iter::once(vec![bottom, right, top, back]))
    }
}

fn exchanged<T>(pair: [T; 2], transposed: bool) -> [T; 2] {
    let [a, b] = pair;
    if transposed { [b, a] } else { [a, b] }
}

/// The point of the domain at these parts of it.
fn placed(unit: Box2, domain: &[[f64; 2]; 2]) -> Box2 {
    std::array::from_fn(|axis| {
        let [start, end] = domain[axis].map(Interval::point);
        start + unit[axis] * (end - start)
    })
}

impl Map {
    /// The face's parameters over a box of the piece's, both in the units of their domains.
    pub(super) fn image(&self, parameters: Box2) -> Box2 {
        match self {
            Self::Identity { .. } => parameters,
            Self::Ruled(ruled) => ruled.image(parameters),
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
