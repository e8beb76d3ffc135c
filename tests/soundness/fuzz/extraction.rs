//! Patches agree with the definition of the NURBS surface.

use super::support::bytes::Bytes;
use super::support::sampling::{ends, spans};
use super::support::surfaces::tame_model;
use crate::support::evaluator::{distance, evaluate_on_span};
use nurbs_hausdorff::Axis;
use nurbs_hausdorff::internals::bezier::extract;

/// A bound on the difference for coordinates of at most 10 and weights from 1/8
/// to 8: some hundred roundings of 2^-53, times the ratio of the weights, times
/// the ratio of neighbouring knot spans, which is at most 100.
const TOLERANCE: f64 = 1e-9;

pub fn check(bytes: &[u8]) {
    let mut bytes = Bytes::new(bytes);
    let Some(model) = tame_model(&mut bytes) else { return };
    let extracted = extract(&model);
    for (surface, grid) in model.surfaces().iter().zip(&extracted.grids) {
        let [us, vs] = Axis::BOTH.map(|axis| spans(surface, axis));
        assert_eq!(grid.counts(), [us.len(), vs.len()]);
        let [x, y] = [(); 2].map(|()| bytes.unit());
        for (index, span) in us.iter().flat_map(|&u| vs.iter().map(move |&v| [u, v])).enumerate() {
            let patch = extracted.patches.patch(grid.first + index);
            for parameters in [[0.0, 0.0], [1.0, 1.0], [0.5, 0.0], [x, y]] {
                let [u, v] = [0, 1].map(|axis| {
                    let [low, high] = ends(surface, Axis::BOTH[axis], span[axis]);
                    (1.0 - parameters[axis]) * low + parameters[axis] * high
                });
                let expected = evaluate_on_span(surface, span, u, v, [0.0; 3]).point;
                let found = patch.point(parameters).to_array();
                assert!(distance(found, expected) <= TOLERANCE, "{model:?}: {found:?}, not {expected:?}");
            }
        }
    }
}
