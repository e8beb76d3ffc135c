//! The linear program of one step: the least t, over a box of motions, that no row exceeds.

use crate::alignment::freedoms::{COORDINATES, Coordinates};
use crate::rounding::upper_max;

/// The rows of a basis: the weights' sum, and one a coordinate.
const ROWS: usize = COORDINATES + 1;

/// The largest number of exchanges. A few dozen suffice; where rows are equally high the simplex method may
/// cycle, and any basis that it has reached gives weights.
const MAX_EXCHANGES: usize = 400;

/// The part of the largest value by which a row has to exceed t to enter: above the rounding of a basis.
const LEAST_EXCESS: f64 = 1e-12;

/// The least pivot of a ratio: below it the quotient is rounding.
const LEAST_PIVOT: f64 = 1e-11;

/// The square of the part of the longest slope below which the rest of another one is rounding.
const IDLE_SQUARED: f64 = 1e-16;

/// A row: value + slope · x is at most t.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Row {
    pub(crate) value: f64,
    pub(crate) slope: Coordinates,
}

/// The solution, with its proof.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Solution {
    /// The motion.
    pub(crate) step: Coordinates,
    /// The least t, up to rounding.
    pub(crate) value: f64,
    /// Weights of rows, not negative, whose sum is 1 up to rounding.
    pub(crate) weights: Vec<(usize, f64)>,
}

/// A column of the dual program.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Column {
    Row(usize),
    /// A side of the box, with its sign.
    Side(usize, f64),
}

/// Returns the least t with value + slope · x <= t for all rows, over |x_j| <= half_j, by the simplex method on
/// its dual: the most of Σ λ_i value_i − Σ_j half_j |Σ_i λ_i slope_ij| over weights λ of sum 1. `None` without
/// rows. O(rows) an exchange.
pub(crate) fn solve(rows: &[Row], half: &Coordinates) -> Option<Solution> {
    let highest =
        (0..rows.len()).reduce(|best, k| if rows[k].value > rows[best].value { k } else { best })?;
    let program = Program { rows, half };
    let mut basis = [Column::Row(highest); ROWS];
    for (axis, column) in basis.iter_mut().skip(1).enumerate() {
        *column = Column::Side(axis, if rows[highest].slope[axis] > 0.0 { -1.0 } else { 1.0 });
    }
    let scale = rows.iter().map(|row| row.value.abs()).fold(0.0, upper_max);
    let mut solved = program.at(&basis)?;
    for _ in 0..MAX_EXCHANGES {
        let Some(entering) = program.entering(&solved, LEAST_EXCESS * scale) else { break };
        let Some(leaving) = program.leaving(&basis, &solved, entering) else { break };
        let before = basis[leaving];
        basis[leaving] = entering;
        match program.at(&basis) {
            Some(next) => solved = next,
            None => {
                basis[leaving] = before;
                break;
            }
        }
    }
    let weights = basis.iter().zip(solved.amounts).filter_map(|(column, amount)| match column {
        Column::Row(index) if amount > 0.0 => Some((*index, amount)),
        _ => None,
    });
    Some(Solution { step: solved.step, value: solved.value, weights: weights.collect() })
}

/// Returns a step without the part that moves no row: its projection on the span of the slopes. The simplex method leaves
/// that part at a corner of the box: turns of a plane about its normal. O(rows).
pub(crate) fn without_idle(rows: &[Row], step: Coordinates) -> Coordinates {
    let dot = |a: &Coordinates, b: &Coordinates| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let mut rests: Vec<Coordinates> = rows.iter().map(|row| row.slope).collect();
    let mut kept = [0.0; COORDINATES];
    let mut least = f64::MIN_POSITIVE;
    for _ in 0..COORDINATES {
        let lengths = rests.iter().map(|rest| dot(rest, rest));
        let longest = lengths.enumerate().max_by(|one, other| one.1.total_cmp(&other.1));
        let Some((index, squared)) = longest.filter(|&(_, squared)| squared > least) else { break };
        least = upper_max(least, IDLE_SQUARED * squared);
        let axis = rests[index].map(|value| value / squared.sqrt());
        let along = dot(&axis, &step);
        kept.iter_mut().zip(axis).for_each(|(kept, axis)| *kept += along * axis);
        for rest in &mut rests {
            let part = dot(&axis, rest);
            rest.iter_mut().zip(axis).for_each(|(rest, axis)| *rest -= part * axis);
        }
    }
    kept
}

struct Program<'a> {
    rows: &'a [Row],
    half: &'a Coordinates,
}

/// A basis with the amounts of its columns, and the point that its rows determine.
struct Solved {
    inverse: [[f64; ROWS]; ROWS],
    amounts: [f64; ROWS],
    value: f64,
    step: Coordinates,
}

impl Program<'_> {
    fn column(&self, column: Column) -> ([f64; ROWS], f64) {
        let mut entries = [0.0; ROWS];
        match column {
            Column::Row(index) => {
                entries[0] = 1.0;
                entries[1..].copy_from_slice(&self.rows[index].slope);
                (entries, self.rows[index].value)
            }
            Column::Side(axis, sign) => {
                entries[axis + 1] = sign;
                (entries, -self.half[axis])
            }
        }
    }

    /// Solves for a basis; `None` for one that is singular.
    fn at(&self, basis: &[Column; ROWS]) -> Option<Solved> {
        let mut matrix = [[0.0; ROWS]; ROWS];
        let mut costs = [0.0; ROWS];
        for (index, &column) in basis.iter().enumerate() {
            let (entries, cost) = self.column(column);
            costs[index] = cost;
            matrix.iter_mut().zip(entries).for_each(|(row, entry)| row[index] = entry);
        }
        let inverse = inverse(matrix)?;
        // The weights' sum is 1, and the sums of slopes are 0.
        let amounts = inverse.map(|row| row[0]);
        let prices: [f64; ROWS] =
            std::array::from_fn(|k| costs.iter().zip(&inverse).map(|(cost, row)| cost * row[k]).sum());
        let step = std::array::from_fn(|axis| -prices[axis + 1]);
        Some(Solved { inverse, amounts, value: prices[0], step })
    }

    /// Returns the column that exceeds its price most.
    fn entering(&self, solved: &Solved, least: f64) -> Option<Column> {
        let mut best = (least, None);
        for (index, row) in self.rows.iter().enumerate() {
            let moved: f64 = row.slope.iter().zip(solved.step).map(|(slope, step)| slope * step).sum();
            let excess = row.value + moved - solved.value;
            if excess > best.0 {
                best = (excess, Some(Column::Row(index)));
            }
        }
        for (axis, (&half, &step)) in self.half.iter().zip(&solved.step).enumerate() {
            let excess = step.abs() - half;
            if excess > best.0 {
                best = (excess, Some(Column::Side(axis, step.signum())));
            }
        }
        best.1
    }

    /// Returns the place in the basis whose amount falls to 0 first.
    fn leaving(&self, basis: &[Column; ROWS], solved: &Solved, entering: Column) -> Option<usize> {
        let (entries, _) = self.column(entering);
        let mut best: Option<(f64, usize)> = None;
        for (index, row) in solved.inverse.iter().enumerate() {
            let change: f64 = row.iter().zip(entries).map(|(a, b)| a * b).sum();
            if change > LEAST_PIVOT && basis[index] != entering {
                let ratio = solved.amounts[index] / change;
                if best.is_none_or(|(least, _)| ratio < least) {
                    best = Some((ratio, index));
                }
            }
        }
        best.map(|(_, index)| index)
    }
}

/// Returns the inverse, by elimination with pivots of rows; `None` where a pivot vanishes.
fn inverse(mut matrix: [[f64; ROWS]; ROWS]) -> Option<[[f64; ROWS]; ROWS]> {
    let mut inverse: [[f64; ROWS]; ROWS] =
        std::array::from_fn(|i| std::array::from_fn(|j| f64::from(u8::from(i == j))));
    for k in 0..ROWS {
        let pivot =
            (k..ROWS).fold(k, |best, i| if matrix[i][k].abs() > matrix[best][k].abs() { i } else { best });
        matrix.swap(k, pivot);
        inverse.swap(k, pivot);
        let head = matrix[k][k];
        if !(head.abs() > f64::MIN_POSITIVE) {
            return None;
        }
        matrix[k].iter_mut().for_each(|entry| *entry /= head);
        inverse[k].iter_mut().for_each(|entry| *entry /= head);
        let (of_matrix, of_inverse) = (matrix[k], inverse[k]);
        for i in (0..ROWS).filter(|&i| i != k) {
            let factor = matrix[i][k];
            matrix[i].iter_mut().zip(of_matrix).for_each(|(entry, other)| *entry -= factor * other);
            inverse[i].iter_mut().zip(of_inverse).for_each(|(entry, other)| *entry -= factor * other);
        }
    }
    Some(inverse)
}

#[cfg(all(test, not(target_arch = "wasm32")))]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod tests {
    use super::*;

    fn row(value: f64, slope: &[f64]) -> Row {
        let mut all = [0.0; COORDINATES];
        all[..slope.len()].copy_from_slice(slope);
        Row { value, slope: all }
    }

    /// The line of least largest distance from 0, 1, 0 at -1, 0, 1 is 1/2.
    #[test]
    fn a_line_through_three_points_is_chebyshevs() {
        let rows: Vec<Row> = [(-1.0, 0.0), (0.0, 1.0), (1.0, 0.0)]
            .iter()
            .flat_map(|&(x, y)| [row(y, &[-1.0, -x]), row(-y, &[1.0, x])])
            .collect();
        let found = solve(&rows, &[10.0; COORDINATES]).unwrap();
        assert!((found.value - 0.5).abs() < 1e-12 && (found.step[0] - 0.5).abs() < 1e-12, "{found:?}");
        assert!((found.weights.iter().map(|(_, weight)| weight).sum::<f64>() - 1.0).abs() < 1e-12);
        // The box ends the step.
        let found = solve(&rows, &[0.2; COORDINATES]).unwrap();
        assert!((found.value - 0.8).abs() < 1e-12, "{found:?}");
    }

    /// Two of the coordinates move no row, and a third one only together with a fourth.
    #[test]
    fn what_moves_no_row_stays() {
        let slopes = [[1.0, 0.0, 2.0, 2.0], [-1.0, 0.0, 1.0, 1.0], [0.0, 0.0, -3.0, -3.0]];
        let rows: Vec<Row> = slopes.iter().map(|slope| row(1.0, slope)).collect();
        let found = solve(&rows, &[0.5; COORDINATES]).unwrap();
        let step = without_idle(&rows, found.step);
        assert_eq!((step[1], step[4], step[5]), (0.0, 0.0, 0.0));
        assert!((step[2] - step[3]).abs() < 1e-12, "{step:?}");
        let height = |row: &Row| row.value + row.slope.iter().zip(step).map(|(a, b)| a * b).sum::<f64>();
        assert!(rows.iter().all(|row| height(row) <= found.value + 1e-12), "{found:?} {step:?}");
    }

    /// No step in the box is better than the one found, and weights prove it: checked on random rows.
    #[test]
    fn weights_prove_the_value() {
        let random = &mut fastrand::Rng::with_seed(5);
        for _ in 0..200 {
            let rows: Vec<Row> = (0..60)
                .map(|_| Row { value: random.f64(), slope: [0; COORDINATES].map(|_| random.f64() - 0.5) })
                .collect();
            let half = [0; COORDINATES].map(|_| 2.0 * random.f64());
            let found = solve(&rows, &half).unwrap();
            let height = |step: &Coordinates| {
                let at = |row: &Row| row.value + row.slope.iter().zip(step).map(|(a, b)| a * b).sum::<f64>();
                rows.iter().map(at).fold(f64::NEG_INFINITY, f64::max)
            };
            assert!(found.step.iter().zip(half).all(|(step, half)| step.abs() <= half + 1e-9));
            assert!((height(&found.step) - found.value).abs() < 1e-9, "{found:?}");
            let proof: f64 = found.weights.iter().map(|&(k, weight)| weight * rows[k].value).sum::<f64>()
                - (0..COORDINATES)
                    .map(|j| {
                        let sum: f64 =
                            found.weights.iter().map(|&(k, weight)| weight * rows[k].slope[j]).sum();
                        half[j] * sum.abs()
                    })
                    .sum::<f64>();
            assert!((proof - found.value).abs() < 1e-9, "{proof} {found:?}");
        }
        assert_eq!(solve(&[], &[1.0; COORDINATES]), None);
    }
}
