//! The proof that cells cover the region within arcs.

use super::Cell;
use super::order::constant;
use crate::untrim::boundary::Arc;
use std::collections::HashMap;

/// Checks that the cells' sides add up to the boundary (lemma T1 of docs/trimming.md): at every
/// v, the winding numbers of the cells that have an arc on their left, less those of the cells
/// that have it on their right, sum to the change of the winding number at that arc.
///
/// Then the cells around any point, each counted with its winding number, sum to the point's
/// winding number. Nothing is computed: levels are compared as the floats that cells and arcs
/// share, and lines of one constant u are one arc. O(cells log cells).
pub(in crate::untrim) fn balance(arcs: &[Arc], cells: &[&Cell]) -> Result<(), String> {
    let mut lines = HashMap::new();
    let arc_of: Vec<usize> = arcs
        .iter()
        .enumerate()
        .map(|(index, arc)| match constant(arc) {
            Some(u) => *lines.entry((u + 0.0).to_bits()).or_insert(index),
            None => index,
        })
        .collect();
    // The steps of the sum of each arc: its own change counts against the cells.
    let mut steps: Vec<(usize, f64, i32)> = Vec::new();
    let mut add = |arc: usize, [low, high]: [f64; 2], amount: i32| {
        steps.push((arc_of[arc], low, amount));
        steps.push((arc_of[arc], high, -amount));
    };
    for (index, arc) in arcs.iter().enumerate() {
        add(index, arc.v, -arc.change);
    }
    for cell in cells {
        add(cell.sides[0], cell.v, cell.winding);
        add(cell.sides[1], cell.v, -cell.winding);
    }
    steps.sort_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)));
    // The steps of one arc sum to 0, so that each arc begins with a sum of 0.
    let mut sum = 0;
    for level in steps.chunk_by(|a, b| a.0 == b.0 && a.1 == b.1) {
        sum += level.iter().map(|step| step.2).sum::<i32>();
        if sum != 0 {
            return Err(format!(
                "cells leave a winding number of {sum} beside an arc from v = {}",
                level[0].1
            ));
        }
    }
    Ok(())
}
