//! The interval of a closest point contains the distance.

use super::support::bytes::Bytes;
use super::support::sampling::{Samples, span_at};
use super::support::surfaces::tame_model;
use crate::support::evaluator::{distance, evaluate_on_span};
use glam::DVec3;
use nurbs_hausdorff::Axis;
use nurbs_hausdorff::internals::bezier::extract;
use nurbs_hausdorff::internals::closest::{Closest, Target, closest};
use nurbs_hausdorff::internals::flatness::{Flatness, flatten};

/// An upper bound on the rounding of the independent evaluator.
const ROUNDING: f64 = 1e-9;

const STEPS: usize = 8;

pub fn check(bytes: &[u8]) {
    let mut bytes = Bytes::new(bytes);
    let flatness = bytes.choose(&[Flatness::None, Flatness::Loose]);
    let gap = bytes.choose(&[0.0, 1e-12, 1e-6, 0.1, f64::INFINITY]);
    let Some(model) = tame_model(&mut bytes) else { return };
    let target = Target::new(flatten(&extract(&model).patches, flatness).patches);
    let samples = Samples::new(&model, STEPS);
    for _ in 0..4 {
        // Some targets are on the model, where the distance is 0.
        let on_model = bytes.flag();
        let from = if on_model {
            samples.points[bytes.below(samples.points.len().min(256))]
        } else {
            [(); 3].map(|()| bytes.coordinate())
        };
        let found = closest(&target, DVec3::from_array(from), gap).unwrap();
        let Closest { lower, upper, parameters, patch, .. } = found;
        assert!(0.0 <= lower && lower <= upper && upper.is_finite(), "{found:?}");
        let sampled = samples.distance(from);
        assert!(lower <= sampled + ROUNDING, "{model:?}, {from:?}: {found:?}, sampled {sampled:?}");
        assert!(upper >= sampled - samples.radius - ROUNDING, "{model:?}, {from:?}: {found:?}");
        // The point returned has the distance returned, on the span that the patch is of.
        let patch = target.patches.patch(patch);
        let surface = &model.surfaces()[patch.surface];
        let span = Axis::BOTH.map(|axis| span_at(surface, axis, patch.domain.middle()[axis]));
        let [u, v] = patch.surface_parameters(parameters);
        let at = evaluate_on_span(surface, span, u, v, [0.0; 3]).point;
        assert!((distance(at, from) - upper).abs() <= ROUNDING, "{model:?}, {from:?}: {found:?}, {at:?}");
    }
}
