//! Feet of the nodes of a grid around a model: residuals of points by a look-up, for the many poses
//! of a search. The feet are those of the nearest nodes, so that residuals are approximate; a fit by
//! exact feet follows.

use super::field::{Field, Place, Residual};
use crate::bvh::Aabb;
use crate::threads::parallel::map_ranges;
use glam::DVec3;

/// The number of cells along the longest side. The grid resolves details of a tenth of that side, and
/// is computed in some tenths of a second.
const CELLS: f64 = 28.0;

/// The margin around the model as a part of its diagonal: poses that are tried leave it by about that.
const MARGIN: f64 = 0.15;

/// One node.
#[derive(Debug, Clone, Copy)]
struct Node {
    foot: DVec3,
    direction: Option<DVec3>,
}

/// The feet of all nodes.
#[derive(Debug)]
pub(super) struct FootGrid {
    origin: DVec3,
    spacing: f64,
    counts: [usize; 3],
    nodes: Vec<Node>,
}

impl FootGrid {
    /// Computes the feet of all nodes; `None` for a model without points. O(nodes) feet, on all cores.
    pub(super) fn new(field: &impl Field, of_model: Aabb) -> Option<Self> {
        let around = of_model.grown(MARGIN * of_model.diagonal());
        let longest = around.extent().max_element();
        let spacing = if longest > 0.0 { longest / CELLS } else { 1.0 };
        let counts = around.extent().to_array().map(|side| (side / spacing).ceil() as usize + 1);
        let [_, rows, columns] = counts;
        let parts = map_ranges(counts.iter().product(), |range| {
            let mut place: Place = None;
            let of = |index: usize| {
                let node = [index / (rows * columns), index / columns % rows, index % columns];
                let at = around.min + spacing * DVec3::from_array(node.map(|count| count as f64));
                let residual = field.residual(at, &mut place)?;
                Some(Node { foot: at - residual.offset, direction: residual.direction })
            };
            range.map(of).collect::<Option<Vec<_>>>()
        });
        let nodes = parts.into_iter().collect::<Option<Vec<_>>>()?.concat();
        Some(Self { origin: around.min, spacing, counts, nodes })
    }
}

impl Field for &FootGrid {
    /// Returns the offset from the foot of the nearest node, along the direction of that node; beside
    /// the grid towards the foot itself.
    fn residual(&self, point: DVec3, _place: &mut Place) -> Option<Residual> {
        let at = (point - self.origin) / self.spacing;
        let mut index = 0;
        let mut is_inside = true;
        for (&count, coordinate) in self.counts.iter().zip(at.to_array()) {
            let last = (count - 1) as f64;
            let nearest = coordinate.round();
            is_inside &= (0.0..=last).contains(&nearest);
            // A number out of range, and NaN, becomes an end of the range.
            index = index * count + nearest.clamp(0.0, last) as usize;
        }
        let Node { foot, direction } = *self.nodes.get(index)?;
        let offset = point - foot;
        let Some(direction) = direction.filter(|_| is_inside) else {
            let direction = direction.map(|_| offset.normalize_or_zero());
            return Some(Residual { point, offset, direction });
        };
        Some(Residual { point, offset: offset.dot(direction) * direction, direction: Some(direction) })
    }
}
