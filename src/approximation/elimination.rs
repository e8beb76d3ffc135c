//! Linear systems of totally positive matrices.

use super::bernstein::Linear;
use std::ops::{Div, Sub};

/// Returns the solution of a square system by Gaussian elimination without pivoting, which a totally
/// positive matrix, such as one of values of B-splines, does not need (C. de Boor, A. Pinkus, *Backward
/// error analysis for totally positive linear systems*, Numerische Mathematik 27 (1977)).
///
/// O(n³), or O(n²) with a fixed number of diagonals: entries that are 0 are passed over.
pub(crate) fn eliminated<T>(mut rows: Vec<Vec<f64>>, mut right: Vec<T>) -> Vec<T>
where
    T: Linear + Sub<Output = T> + Div<f64, Output = T>,
{
    let count = right.len();
    for pivot in 0..count {
        let (done, below) = rows.split_at_mut(pivot + 1);
        let (pivot_row, known) = (&done[pivot], right[pivot]);
        for (row, value) in below.iter_mut().zip(&mut right[pivot + 1..]) {
            let factor = row[pivot] / pivot_row[pivot];
            if factor == 0.0 {
                continue;
            }
            row.iter_mut().zip(pivot_row).skip(pivot).for_each(|(entry, above)| *entry -= factor * above);
            *value = *value - known * factor;
        }
    }
    for index in (0..count).rev() {
        let known = (index + 1..count).fold(T::ZERO, |sum, column| sum + right[column] * rows[index][column]);
        right[index] = (right[index] - known) / rows[index][index];
    }
    right
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;

    /// The matrix of binomials is totally positive, and its inverse has the same entries with alternating
    /// signs.
    #[test]
    fn the_system_of_pascals_triangle_is_solved() {
        let rows = vec![
            vec![1.0, 0.0, 0.0, 0.0],
            vec![1.0, 1.0, 0.0, 0.0],
            vec![1.0, 2.0, 1.0, 0.0],
            vec![1.0, 3.0, 3.0, 1.0],
        ];
        assert_eq!(eliminated(rows, vec![1.0, 0.0, 0.0, 0.0]), [1.0, -1.0, 1.0, -1.0]);
        let hilbert_like = vec![vec![2.0, 1.0], vec![1.0, 2.0]];
        assert_eq!(eliminated(hilbert_like, vec![4.0, 5.0]), [1.0, 2.0]);
    }
}
