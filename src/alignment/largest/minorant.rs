//! Functions of the motions of a cell that the distance of a point from B never falls below: a value, slopes, a
//! quadratic form and a remainder. Their weighted sums bound the largest distance; in sums forms of several points
//! cancel. Lemmas Z1 and Z2 of docs/alignment.md.

use super::chart::{Cell, Middle};
use super::program::Row;
use crate::alignment::freedoms::{COORDINATES, Coordinates, Freedoms};
use crate::rounding::gamma;
use glam::DVec3;

/// The roundings of a minorant, relative to the lengths that enter.
const ROUNDINGS: f64 = 512.0;

/// The roundings of a sum of minorants for each of them and for each entry of a form.
const SUM_ROUNDINGS: f64 = 4.0;

/// What is added to the mean slope of points that are weighed: other points may move in a direction in which
/// these do not.
const LEAST_SLOPE: f64 = 0.125;

/// A ball without points of B, about a point that lies `clear` from B at least; q is the image of a point of A
/// in the middle of the cell, known within `error`.
#[derive(Debug, Clone, Copy)]
pub(super) struct Ball {
    pub(super) center: DVec3,
    pub(super) clear: f64,
    pub(super) image: DVec3,
    pub(super) error: f64,
}

/// value + Σ slope_j y_j + Σ_{j ≤ k} form_jk y_j y_k − rest for coordinates y from the middle of a cell.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Minorant {
    value: f64,
    slope: Coordinates,
    form: [Coordinates; COORDINATES],
    rest: f64,
}

impl Minorant {
    /// The constant.
    pub(super) fn constant(value: f64) -> Self {
        Self { value, ..Self::default() }
    }

    /// The minorant of the distance of a point by a ball (lemma Z2). `None` for a ball about the point itself.
    pub(super) fn of_ball(ball: &Ball, middle: &Middle, freedoms: &Freedoms) -> Option<Self> {
        let to_center = ball.center - ball.image;
        let radius = to_center.length();
        let direction = to_center / radius;
        if !direction.is_finite() {
            return None;
        }
        let (from_turn, arm) = (ball.center - middle.center, ball.image - middle.center);
        let (turned, far) = (middle.angle * arm.length(), from_turn.length());
        let mut form = [[0.0; COORDINATES]; COORDINATES];
        let axes = middle.turns.len();
        for (j, &turn) in middle.turns.iter().enumerate() {
            for (k, &other) in middle.turns.iter().enumerate().skip(j) {
                let both = 0.5
                    * (from_turn.dot(turn) * arm.dot(other) + arm.dot(turn) * from_turn.dot(other))
                    - from_turn.dot(arm) * turn.dot(other);
                form[j][k] = if j == k { 0.5 * both } else { both } / radius;
            }
            let moved = turn.cross(arm);
            for (k, &shift) in freedoms.shifts.iter().enumerate() {
                form[j][axes + k] = -shift.dot(moved) / radius;
            }
        }
        for k in axes..freedoms.count() {
            form[k][k] = -0.5 / radius;
        }
        let Middle { angle, shift, .. } = *middle;
        let moment = arm.cross(direction).length();
        let third = moment * angle.powi(3) / 6.0 + shift * turned * angle / (2.0 * radius);
        let fourth = far * turned * angle.powi(3) / (12.0 * radius);
        let twisted = (far + shift) * arm.length() * middle.twist / radius;
        let lengths =
            radius + ball.clear.abs() + ball.image.length() + middle.center.length() + shift + turned;
        let curved = (shift * shift + turned * (shift + far * angle)) / radius;
        let above = 1.0 + gamma(ROUNDINGS);
        let rest = (third + fourth + twisted) * above + ball.error + gamma(ROUNDINGS) * (lengths + curved);
        let slope = middle.slopes(freedoms, ball.image, direction);
        Some(Self { value: ball.clear - radius, slope, form, rest })
    }

    /// Returns what the form takes off over a cell.
    fn bent(&self, half: &Coordinates) -> f64 {
        let mut bent = 0.0;
        for (j, row) in self.form.iter().enumerate() {
            for (k, &entry) in row.iter().enumerate().skip(j) {
                // A square has one sign.
                let most = if j == k && entry > 0.0 { 0.0 } else { entry.abs() };
                bent += most * half[j] * half[k];
            }
        }
        bent
    }

    /// Returns what the slopes take off over a cell.
    fn moved(&self, half: &Coordinates) -> f64 {
        self.slope.iter().zip(half).map(|(slope, half)| slope.abs() * half).sum()
    }

    /// Returns the row of a linear program whose solution weighs minorants: the form is bounded over the cell.
    pub(super) fn row(&self, cell: &Cell) -> Row {
        Row { value: self.value - self.bent(&cell.half) - self.rest, slope: self.slope }
    }

    fn add(&mut self, weight: f64, other: &Self) {
        self.value += weight * other.value;
        self.rest += weight * other.rest;
        let pairs = self.slope.iter_mut().zip(&other.slope);
        let forms = self.form.iter_mut().flatten().zip(other.form.iter().flatten());
        pairs.chain(forms).for_each(|(sum, entry)| *sum += weight * entry);
    }

    /// Returns an upper bound on the sum of the lengths that are added up over a cell.
    fn size(&self, cell: &Cell) -> f64 {
        let form = self.form.iter().zip(cell.half).map(|(row, side)| {
            let along = row.iter().zip(cell.half).map(|(entry, half)| entry.abs() * half).sum::<f64>();
            along * side
        });
        self.value.abs() + self.moved(&cell.half) + form.sum::<f64>() + self.rest
    }
}

/// What weights prove of a cell.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Proven {
    pub(super) lower: f64,
    /// The coordinate over whose range the distances change most.
    pub(super) widest: usize,
}

/// Returns a lower bound, over a cell, on the largest of functions that are not below these minorants: the least of
/// their mean with weights that are not negative (theorem Z). Any weights prove one.
pub(super) fn proven(minorants: &[Minorant], weights: &[(usize, f64)], cell: &Cell) -> Proven {
    let (mut sum, mut total, mut size) = (Minorant::default(), 0.0, 0.0);
    for &(index, weight) in weights {
        sum.add(weight, &minorants[index]);
        total += weight;
        size += weight * minorants[index].size(cell);
    }
    let rounding = gamma(SUM_ROUNDINGS * (weights.len() + COORDINATES * COORDINATES) as f64);
    let least = sum.value - sum.rest - sum.bent(&cell.half) - sum.moved(&cell.half) - rounding * size;
    let mean = least / total;
    let bound = mean - (rounding + gamma(4.0)) * mean.abs();
    let lower = if bound.is_finite() { bound } else { f64::NEG_INFINITY };
    let spread = |k: usize| {
        let slopes: f64 =
            weights.iter().map(|&(index, weight)| weight * minorants[index].slope[k].abs()).sum();
        (slopes + LEAST_SLOPE) * cell.half[k]
    };
    let widest = (1..COORDINATES).fold(0, |best, k| if spread(k) > spread(best) { k } else { best });
    Proven { lower, widest }
}
