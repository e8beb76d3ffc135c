//! Minorants: functions of the motions of a cell that bound the distance of a point from B from below. Each has a value,
//! slopes, a quadratic form and a remainder. A weighted sum of minorants bounds the largest distance, and the forms of
//! several points may cancel in it. Lemmas Z1 and Z2 of docs/alignment.md.

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

/// A ball without points of B: its centre lies at least `clear` from B. `image` is the image of a point of A in the middle
/// of the cell, within `error`.
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
        for (k, row) in form.iter_mut().enumerate().take(freedoms.count()).skip(axes) {
            row[k] = -0.5 / radius;
        }
        let Middle { angle, shift, .. } = *middle;
        let moment = arm.cross(direction).length();
        let third = moment * angle.powi(3) / 6.0 + shift * turned * angle / (2.0 * radius);
        let fourth = far * turned * angle.powi(3) / (24.0 * radius);
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

#[cfg(all(test, not(target_arch = "wasm32")))]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod tests {
    use super::super::chart::Chart;
    use super::*;
    use crate::model::RigidTransform;

    /// A ball about `center`, 1 away from B, and the image of a point in the middle of a cell about the origin.
    #[derive(Clone, Copy)]
    struct Case {
        cell: Cell,
        center: DVec3,
        image: DVec3,
    }

    impl Case {
        fn chart() -> Chart {
            let base = RigidTransform::IDENTITY;
            Chart { base, freedoms: Freedoms::all(), center: DVec3::ZERO, radius: 1.0 }
        }

        fn minorant(&self, error: f64) -> Minorant {
            let middle = Self::chart().middle(&self.cell);
            let ball = Ball { center: self.center, clear: 1.0, image: self.image, error };
            Minorant::of_ball(&ball, &middle, &Freedoms::all()).unwrap()
        }

        /// What the minorant is below: 1 less the distance from the centre, under the motion of coordinates from the
        /// middle.
        fn bound(&self, y: &Coordinates) -> f64 {
            let chart = Self::chart();
            let at = std::array::from_fn(|k| self.cell.middle[k] + y[k]);
            let own = chart.motion(&self.cell.middle).apply_inverse(self.image);
            1.0 - (self.center - chart.motion(&at).apply(own)).length()
        }
    }

    /// The value of a minorant without what is left out.
    fn at(minorant: &Minorant, y: &Coordinates) -> f64 {
        let dot = |a: &Coordinates, b: &Coordinates| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        let bent: f64 = minorant.form.iter().zip(y).map(|(row, side)| side * dot(row, y)).sum();
        minorant.value + dot(&minorant.slope, y) + bent
    }

    fn drawn(random: &mut fastrand::Rng, size: f64) -> DVec3 {
        size * (2.0 * DVec3::from_array([0; 3].map(|_| random.f64())) - 1.0)
    }

    #[test]
    fn a_minorant_is_nowhere_above_the_distance_that_a_ball_leaves() {
        let random = &mut fastrand::Rng::with_seed(7);
        for _ in 0..400 {
            let size = 10.0_f64.powf(-3.0 * random.f64());
            let half: Coordinates = std::array::from_fn(|_| size * random.f64());
            let middle = std::array::from_fn(|_| random.f64() - 0.5);
            let cell = Cell { middle, half };
            let image = drawn(random, 2.0);
            let case = Case { cell, center: image + drawn(random, 3.0), image };
            let minorant = case.minorant(0.0);
            for _ in 0..20 {
                // Corners, and points within.
                let y: Coordinates = std::array::from_fn(|k| {
                    let part = 2.0 * random.f64() - 1.0;
                    half[k] * if random.bool() { part.signum() } else { part }
                });
                let (found, bound) = (at(&minorant, &y) - minorant.rest, case.bound(&y));
                assert!(found <= bound + 1e-13, "{found} {bound} {y:?}");
            }
        }
    }

    /// The minorant without its remainder exceeds the distance by at least the stated share of the remainder.
    #[test]
    fn what_is_left_out_is_attained() {
        let small = 1e-9;
        let assert_attained = |name: &str, case: &Case, y: Coordinates, share: f64| {
            let minorant = case.minorant(0.0);
            let above = at(&minorant, &y) - case.bound(&y);
            let rest = minorant.rest;
            assert!(above <= rest && above >= share * rest, "{name}: {above} of {rest}");
        };
        let cell = |half: Coordinates| Cell { middle: [0.0; COORDINATES], half };
        // The sine of a turn about z, which moves the point along y, towards a far centre.
        let half = [small, small, 0.1, small, small, small];
        let case = Case { cell: cell(half), center: DVec3::new(1.0, 1e6, 0.0), image: DVec3::X };
        assert_attained("sine", &case, [0.0, 0.0, 0.1, 0.0, 0.0, 0.0], 0.9);
        // The cosine, of a centre just beyond the origin, whose distance is nearly the mean of squares.
        let case = Case { cell: cell(half), center: -0.05 * DVec3::X, image: DVec3::X };
        assert_attained("cosine", &case, [0.0, 0.0, 0.1, 0.0, 0.0, 0.0], 0.8);
        // A shift inwards of a point that is turned about the centre.
        let half = [small, small, 0.1, 1e-4, small, small];
        let case = Case { cell: cell(half), center: DVec3::ZERO, image: DVec3::X };
        assert_attained("shift", &case, [0.0, 0.0, 0.1, -1e-4, 0.0, 0.0], 0.9);
        // The turn of the middle about x, and that of the cell about y: exact but for e to the turn of the middle.
        let middle = [0.1, 0.0, 0.0, 0.0, 0.0, 0.0];
        let half = [small, 1e-4, small, small, small, small];
        let turned = Cell { middle, half };
        let case = Case { cell: turned, center: -DVec3::Z, image: DVec3::Y };
        assert_attained("twist", &case, [0.0, 1e-4, 0.0, 0.0, 0.0, 0.0], 0.5);
    }

    /// An image that is off by its error in the worst direction is as near as stated.
    #[test]
    fn the_error_of_an_image_is_taken_off() {
        let cell = Cell { middle: [0.0; COORDINATES], half: [0.0; COORDINATES] };
        let case = Case { cell, center: DVec3::new(1.0, 5.0, 0.0), image: DVec3::X };
        let off = Case { image: DVec3::X - 0.01 * DVec3::Y, ..case };
        let minorant = case.minorant(0.01);
        let [found, bound] = [minorant.value - minorant.rest, off.bound(&[0.0; COORDINATES])];
        assert!(found <= bound && found >= bound - 1e-12, "{found} {bound}");
    }

    /// No motion of a cell is below what weights prove, and one corner attains it where one product of two coordinates
    /// bends the sum.
    #[test]
    fn weights_prove_the_least_of_a_sum() {
        let random = &mut fastrand::Rng::with_seed(9);
        let mut attained = 0;
        for trial in 0..300 {
            let minorants: Vec<Minorant> = (0..3)
                .map(|_| {
                    let mut minorant = Minorant::constant(random.f64() - 0.5);
                    minorant.slope = [0; COORDINATES].map(|_| random.f64() - 0.5);
                    let (j, k) = (random.usize(0..COORDINATES), random.usize(0..COORDINATES));
                    minorant.form[j.min(k)][j.max(k)] = random.f64() - 0.5;
                    minorant
                })
                .collect();
            let minorants = if trial % 2 == 0 { minorants[..1].to_vec() } else { minorants };
            let weights: Vec<(usize, f64)> = (0..minorants.len()).map(|k| (k, 0.1 + random.f64())).collect();
            let cell = Cell { middle: [0.0; COORDINATES], half: [0; COORDINATES].map(|_| random.f64()) };
            let found = proven(&minorants, &weights, &cell).lower;
            let total: f64 = weights.iter().map(|(_, weight)| weight).sum();
            let mean = |y: &Coordinates| {
                weights.iter().map(|&(k, weight)| weight / total * at(&minorants[k], y)).sum::<f64>()
            };
            let least = (0..1_usize << COORDINATES)
                .map(|signs| {
                    mean(&std::array::from_fn(|k| {
                        if (signs >> k) & 1 == 0 { cell.half[k] } else { -cell.half[k] }
                    }))
                })
                .fold(f64::INFINITY, f64::min);
            assert!(found <= least, "{found} of {least}");
            attained += usize::from(found >= least - 1e-12);
        }
        assert!(attained > 20, "{attained}");
    }
}
