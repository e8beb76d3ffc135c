//! Pieces that the other boundary crosses near a plane: lemma O3 of docs/facts.md.

mod half_square;

use super::density::Slopes;
use super::piece::{Piece, Weight, Whole};
use super::separation::{heights, normal};
use crate::facts::Interval;
use crate::rounding::{gamma, upper_max};
use glam::DVec3;
use half_square::Affine;

/// The least length of the mean of normals that counts as one.
const MIN_AGREEMENT: f64 = 0.7;

/// The roundings of a sum of four products, relative to it.
const HEIGHT_ROUNDINGS: f64 = 16.0;

/// A slab that contains all of the other boundary that is near a piece.
#[derive(Debug, Clone, Copy)]
pub(super) struct Slab {
    normal: DVec3,
    middle: DVec3,
    /// Half of its thickness, with the margin within which the boundary counts as near.
    half: f64,
    /// Whether the points of the piece's hull above and below it are inside the other solid, where that is known.
    pub(super) is_inside: [Option<bool>; 2],
}

impl Slab {
    /// Returns the slab about the mean plane of pieces that contains all of them; `None` where they have none.
    pub(super) fn around(near: &[(&Whole, &Piece)], margin: f64, middle: DVec3) -> Option<Self> {
        let mut sum = DVec3::ZERO;
        let mut sizes = 0.0;
        for &piece in near {
            // A strip has hardly a normal.
            let size = if piece.0.is_strip { 0.0 } else { piece.1.radius * piece.1.radius };
            let normal = normal(piece) * size;
            sum += if normal.dot(sum) < 0.0 { -normal } else { normal };
            sizes += size;
        }
        if !(sum.length() >= MIN_AGREEMENT * sizes && sizes > 0.0) {
            return None;
        }
        let normal = sum.normalize();
        let [low, high] = near.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], piece| {
            let [least, most] = heights(piece.1, normal, middle);
            [if least >= low { low } else { least }, if most <= high { high } else { most }]
        });
        let half = 0.5 * (high - low) + margin;
        let at = middle + 0.5 * (low + high) * normal;
        half.is_finite().then_some(Self { normal, middle: at, half, is_inside: [None; 2] })
    }

    /// Returns the height of a point above the slab's middle.
    pub(super) fn height(&self, point: DVec3) -> f64 {
        self.normal.dot(point - self.middle)
    }

    /// Returns the control points of a piece that are farthest above and below the slab, where any are.
    pub(super) fn beyond(&self, piece: &Piece) -> [Option<DVec3>; 2] {
        [1.0, -1.0].map(|sign| {
            let farthest = piece
                .points
                .iter()
                .copied()
                .max_by(|&a, &b| (sign * self.height(a)).total_cmp(&(sign * self.height(b))));
            farthest.filter(|&point| sign * self.height(point) > self.half)
        })
    }

    /// Returns whether a point of the piece's hull, for which the slab was made, is inside the other solid, where that
    /// is known.
    pub(super) fn side(&self, point: DVec3) -> Option<bool> {
        let height = self.height(point);
        if height > self.half {
            self.is_inside[0]
        } else if height < -self.half {
            self.is_inside[1]
        } else {
            None
        }
    }

    /// Returns the interval of ⅓ ∫ b (x − origin)·n over a piece, b being 1 inside the other solid, 0 outside and
    /// anything between on its boundary. `cone` is the integral without b for the computed piece, and exact points are
    /// off from its own by at most `moved`.
    pub(super) fn inner(
        &self,
        (whole, piece): (&Whole, &Piece),
        slopes: &Slopes,
        weight: &Weight,
        cone: Interval,
        moved: f64,
    ) -> Interval {
        let (height, error) = self.affine(whole.degree(), piece);
        let reach = self.half + error;
        let above = height.part_above(reach);
        let one = Interval::exactly(1.0);
        let below = one - height.part_above(-reach);
        let between = (one - above - below).not_negative();
        let variation = slopes.variation(weight.radius);
        let density = cone + Interval::about(0.0, variation);
        // Any part of a region, up to the region.
        let any = |part: Interval| {
            let all = density * part;
            Interval {
                lower: if all.lower < 0.0 { all.lower } else { 0.0 },
                upper: if all.upper > 0.0 { all.upper } else { 0.0 },
            }
        };
        let side = |is_inside: Option<bool>, part: Interval| match is_inside {
            Some(false) => Interval::exactly(0.0),
            Some(true) => {
                // The densities of a part and of the rest are off by the same sum.
                let smaller = part.smaller(one - part).upper;
                cone * part + Interval::about(0.0, variation * smaller)
            }
            None => any(part.not_negative()),
        };
        let [inside_above, inside_below] = self.is_inside;
        let sum = side(inside_above, above) + side(inside_below, below) + any(between);
        sum + Interval::about(0.0, 3.0 * weight.displacement(moved, slopes.border()))
    }

    /// Returns an affine function of a piece's parameters, and an upper bound on its distance from the height.
    fn affine(&self, [p, q]: [usize; 2], piece: &Piece) -> (Affine, f64) {
        let columns = q + 1;
        let heights: Vec<f64> = piece.points.iter().map(|&point| self.height(point)).collect();
        let [one, two, three, four] = [0, q, p * columns, p * columns + q].map(|place| heights[place]);
        let function = Affine {
            middle: 0.25 * (one + two + three + four),
            slopes: [0.5 * ((three + four) - (one + two)), 0.5 * ((two + four) - (one + three))],
        };
        let place = |index: usize| [(index / columns) as f64 / p as f64, (index % columns) as f64 / q as f64];
        let off =
            heights.iter().enumerate().map(|(index, height)| (height - function.at(place(index))).abs());
        let off = off.fold(0.0, upper_max);
        // Other weights change the mean of the values at control points by their ratio less 1 at most.
        let weights = piece.controls.iter().map(|control| control.w);
        let (least, most) = weights.fold((f64::INFINITY, 0.0), |(least, most): (f64, f64), weight| {
            (if weight < least { weight } else { least }, upper_max(most, weight))
        });
        let spread = 0.5 * (function.slopes[0].abs() + function.slopes[1].abs());
        let of_weights = (most / least - 1.0) * spread;
        (
            function,
            (off + of_weights) * (1.0 + gamma(HEIGHT_ROUNDINGS)) + gamma(HEIGHT_ROUNDINGS) * function.size(),
        )
    }
}
