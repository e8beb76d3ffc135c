//! The points of A whose distances bound the largest one: those that linear programs about a pose weigh.

use super::program::{Row, solve};
use crate::alignment::freedoms::{COORDINATES, Coordinates};

/// The sizes of boxes, relative to the whole, in whose middle and beside it points are looked for.
const SIZES: [f64; 4] = [1.0, 0.25, 0.0625, 0.015_625];

/// The size of a box beside the pose, as a part of its distance in each coordinate.
const BESIDE: f64 = 0.5;

/// Returns the indices of rows that have weight in the programs of boxes about a pose and beside it, of the sizes of
/// `half` and smaller ones: each once, those about the pose first.
pub(crate) fn contacts(rows: &[Row], half: &Coordinates) -> Vec<usize> {
    let mut found = Vec::new();
    let mut add = |middle: &Coordinates, half: &Coordinates| {
        let moved = |row: &Row| -> f64 { row.slope.iter().zip(middle).map(|(a, b)| a * b).sum() };
        let shifted: Vec<Row> =
            rows.iter().map(|row| Row { value: row.value + moved(row), ..*row }).collect();
        let weights = solve(&shifted, half).map_or_else(Vec::new, |solution| solution.weights);
        for (index, _) in weights {
            if !found.contains(&index) {
                found.push(index);
            }
        }
    };
    let halves = SIZES.map(|size| half.map(|side| size * side));
    halves.iter().for_each(|half| add(&[0.0; COORDINATES], half));
    for half in &halves {
        // Boxes beside the pose, without it: there other points decide.
        let beside_it = half.map(|side| BESIDE * side);
        places(half).iter().for_each(|middle| add(middle, &beside_it));
    }
    found
}

/// Returns the middles of the sides of a box, then its corners.
fn places(half: &Coordinates) -> Vec<Coordinates> {
    let axes: Vec<usize> = (0..COORDINATES).filter(|&axis| half[axis] > 0.0).collect();
    let sides = axes.iter().flat_map(|&axis| {
        [1.0, -1.0].map(|sign| {
            let mut middle = [0.0; COORDINATES];
            middle[axis] = sign * half[axis];
            middle
        })
    });
    let corners = (0..1_usize << axes.len()).map(|signs| {
        let mut corner = [0.0; COORDINATES];
        for (bit, &axis) in axes.iter().enumerate() {
            corner[axis] = if (signs >> bit) & 1 == 0 { half[axis] } else { -half[axis] };
        }
        corner
    });
    sides.chain(corners).collect()
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;

    /// Of heights along x only the ends and the highest count.
    #[test]
    fn points_that_decide_are_found() {
        let slope = [1.0, 0.0, 0.0, 0.0, 0.0, 0.0];
        let rows: Vec<Row> =
            [0.5, 0.2, -0.1].iter().flat_map(|&value| [Row { value, slope }, row(-value)]).collect();
        fn row(value: f64) -> Row {
            Row { value, slope: [-1.0, 0.0, 0.0, 0.0, 0.0, 0.0] }
        }
        let mut half = [0.0; COORDINATES];
        half[0] = 1.0;
        let found = contacts(&rows, &half);
        assert_eq!(places(&half), [half, half.map(|side| -side), half, half.map(|side| -side)]);
        assert!(found.contains(&0) && found.contains(&5) && !found.contains(&2), "{found:?}");
    }
}
