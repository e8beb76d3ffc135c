//! The two rules, which share a criterion and differ in the parameter of the cut.

use glam::DVec3;
use nurbs_hausdorff::Axis;
use nurbs_hausdorff::internals::bezier::{Jet, Patch, PatchSet};

/// The number of samples of normals along each axis of a patch.
const SAMPLES: usize = 9;

/// The largest number of cuts of one patch along both axes together.
const MAX_CUTS: u32 = 8;

/// The smallest fraction of a patch that a cut leaves, so that pieces shrink.
const MIN_FRACTION: f64 = 0.15;

/// A tangent shorter than the patch's longest by this factor belongs to a degenerate
/// edge, and its direction is rounding.
const DEGENERATE_RATIO: f64 = 1e-6;

/// The unit normals at the samples, where they exist.
type Normals = [[Option<DVec3>; SAMPLES]; SAMPLES];
/// Returns the parameter at which to cut along an axis.
pub(super) type Cut = fn(&Normals, Axis) -> f64;

/// The rules, each with its name.
pub(super) const CUTS: [(&str, Cut); 2] =
    [("cut in the middle", |_, _| 0.5), ("cut at half of the rotation", halves_turning)];

/// Returns the patches, cut until the normals of each differ by at most `degrees`.
pub(super) fn cut_all(patches: &PatchSet, degrees: f64, cut: Cut) -> PatchSet {
    let mut pieces = PatchSet::default();
    for patch in patches.iter() {
        cut_one(&mut pieces, patch, degrees.to_radians(), cut, MAX_CUTS);
    }
    pieces
}

fn cut_one(pieces: &mut PatchSet, patch: Patch<'_>, angle: f64, cut: Cut, left: u32) {
    let normals = normals(&patch);
    if left == 0 || span(normals.iter().flatten()) <= angle {
        pieces.push(patch);
        return;
    }
    let spans = Axis::BOTH.map(|axis| {
        let across = |fixed| span((0..SAMPLES).map(|moving| along(&normals, axis, fixed, moving)));
        (0..SAMPLES).map(across).fold(0.0, f64::max)
    });
    let axis = Axis::of_larger(spans);
    let parameter = cut(&normals, axis).clamp(MIN_FRACTION, 1.0 - MIN_FRACTION);
    for range in [[0.0, parameter], [parameter, 1.0]] {
        let ranges = if axis == Axis::U { [range, [0.0, 1.0]] } else { [[0.0, 1.0], range] };
        let controls = patch.restricted(ranges[0], ranges[1]);
        let mut domain = patch.domain;
        let [start, end] = patch.domain[axis];
        domain[axis] = range.map(|part| (1.0 - part) * start + part * end);
        cut_one(pieces, Patch { controls: &controls, domain, ..patch }, angle, cut, left - 1);
    }
}

/// Returns the normals at the samples, without those of degenerate edges.
fn normals(patch: &Patch<'_>) -> Normals {
    let jets: [[Jet; SAMPLES]; SAMPLES] =
        std::array::from_fn(|i| std::array::from_fn(|j| patch.jet([at(i), at(j)])));
    let longest = |tangent: fn(&Jet) -> DVec3| {
        jets.iter().flatten().map(|jet| tangent(jet).length()).fold(0.0, f64::max)
    };
    let thresholds = [longest(|jet| jet.s), longest(|jet| jet.t)].map(|longest| DEGENERATE_RATIO * longest);
    jets.map(|line| {
        line.map(|jet| {
            let regular = jet.s.length() > thresholds[0] && jet.t.length() > thresholds[1];
            if regular { jet.normal() } else { None }
        })
    })
}

/// Returns the parameter at which the normals have turned by half of their total
/// turning along the axis, summed over the lines across, which is the integral of
/// the normal curvature.
fn halves_turning(normals: &Normals, axis: Axis) -> f64 {
    let mut turned = [0.0; SAMPLES];
    for moving in 1..SAMPLES {
        let step = |fixed| span([moving - 1, moving].into_iter().map(|k| along(normals, axis, fixed, k)));
        turned[moving] = turned[moving - 1] + (0..SAMPLES).map(step).sum::<f64>();
    }
    let half = 0.5 * turned[SAMPLES - 1];
    let next = turned.partition_point(|&turned| turned < half).clamp(1, SAMPLES - 1);
    let (low, high) = (turned[next - 1], turned[next]);
    let fraction = if high > low { (half - low) / (high - low) } else { 0.5 };
    at(next - 1) + fraction * (at(next) - at(next - 1))
}

fn at(index: usize) -> f64 {
    index as f64 / (SAMPLES - 1) as f64
}

fn along(normals: &Normals, axis: Axis, fixed: usize, moving: usize) -> &Option<DVec3> {
    if axis == Axis::U { &normals[moving][fixed] } else { &normals[fixed][moving] }
}

/// Returns the largest angle between two of the normals.
fn span<'a>(normals: impl Iterator<Item = &'a Option<DVec3>>) -> f64 {
    let normals: Vec<DVec3> = normals.flatten().copied().collect();
    let pairs = normals
        .iter()
        .enumerate()
        .flat_map(|(k, first)| normals[k + 1..].iter().map(move |second| first.dot(*second)));
    pairs.fold(1.0, f64::min).clamp(-1.0, 1.0).acos()
}
