//! Flatness by the angle between sampled normals, the 2012 paper's criterion.

use super::SAMPLES;
use crate::bezier::{GridBasis, Patch, normal};
use glam::{DVec3, Vec4Swizzles};

/// A tangent shorter than the patch's longest by this factor belongs to a
/// degenerate edge, such as a pole: its direction, and so the normal's, is rounding.
const DEGENERATE_RATIO: f64 = 1e-6;

/// Returns the largest angles between two normals of one s-line and of one
/// t-line, if any two normals of the patch are more than `tolerance` radians apart.
///
/// Points without a normal are left out. `basis` is of the patch's degrees at
/// the sample parameters.
pub(super) fn excess(patch: &Patch<'_>, basis: &GridBasis<SAMPLES>, tolerance: f64) -> Option<[f64; 2]> {
    if has_narrow_cones(patch, tolerance) {
        return None;
    }
    let tangents = patch.tangents(basis);
    let thresholds = [0, 1].map(|axis| {
        let lengths = tangents.iter().map(|tangents| tangents[axis].length_squared());
        DEGENERATE_RATIO * DEGENERATE_RATIO * lengths.fold(0.0, f64::max)
    });
    let normals: Vec<_> = tangents
        .iter()
        .map(|&[s, t]| {
            let regular = s.length_squared() > thresholds[0] && t.length_squared() > thresholds[1];
            if regular { normal(s, t) } else { None }
        })
        .collect();
    if is_within_half(&normals, tolerance) || min_cosine(&normals, 1) >= tolerance.cos() {
        return None;
    }
    let (mut along_s, mut along_t) = (1.0_f64, 1.0_f64);
    for line in 0..SAMPLES {
        along_s = along_s.min(min_cosine(&normals[line..], SAMPLES));
        along_t = along_t.min(min_cosine(&normals[line * SAMPLES..][..SAMPLES], 1));
    }
    Some([along_s.acos(), along_t.acos()])
}

/// Returns whether the legs of the control net show that any two normals are within the
/// tolerance, without evaluating any. Only nets with equal weights can show it. O(p q).
///
/// The tangents by s are convex combinations of the legs along s, so that they lie in a cone
/// about a unit vector x, within an angle α < 90°, if the legs do; those by t in one about y. For unit vectors
/// x', y' in the cones, `|x' × y' - x × y| <= |x' - x| + |y' - y| <= 4 sin(α/2)`, so the normals
/// are within half the tolerance τ of that of x and y if `4 sin(α/2) <= |x × y| sin(τ/2)`.
fn has_narrow_cones(patch: &Patch<'_>, tolerance: f64) -> bool {
    if patch.rational {
        return false;
    }
    let columns = patch.degree[1] + 1;
    let controls = patch.controls;
    let leg = |from: usize, to: usize| (controls[to] - controls[from]).xyz();
    let count = controls.len();
    let (mut along_s, mut along_t) = (DVec3::ZERO, DVec3::ZERO);
    for column in 0..columns {
        along_s += leg(column, count - columns + column);
    }
    for row in (0..count).step_by(columns) {
        along_t += leg(row, row + columns - 1);
    }
    let (Some(x), Some(y)) = (along_s.try_normalize(), along_t.try_normalize()) else { return false };
    let half_sine = 0.25 * x.cross(y).length() * (0.5 * tolerance).sin();
    let least = 1.0 - 2.0 * half_sine * half_sine;
    let is_within = |leg: DVec3, middle: DVec3| {
        let along = leg.dot(middle);
        along >= 0.0 && along * along >= least * least * leg.length_squared()
    };
    (columns..count).all(|index| is_within(leg(index - columns, index), x))
        && (0..count)
            .step_by(columns)
            .all(|row| (row + 1..row + columns).all(|index| is_within(leg(index - 1, index), y)))
}

/// Returns whether all normals are within half the tolerance of one of them, so that
/// any two are within the tolerance; one comparison for each instead of one for each pair.
fn is_within_half(normals: &[Option<DVec3>], tolerance: f64) -> bool {
    let Some(middle) = normals[normals.len() / 2 + 1] else { return false };
    let least = (0.5 * tolerance).cos();
    normals.iter().flatten().all(|normal| normal.dot(middle) >= least)
}

/// Returns the smallest cosine between any two of every `step`-th normal, undefined ones left out.
fn min_cosine(normals: &[Option<DVec3>], step: usize) -> f64 {
    let mut least = 1.0_f64;
    for (index, first) in normals.iter().enumerate().step_by(step) {
        let Some(first) = first else { continue };
        for second in normals[index..].iter().step_by(step).flatten() {
            least = least.min(first.dot(*second));
        }
    }
    least.max(-1.0)
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;
    use glam::DVec4;

    /// Of nets about a skewed plane with ever larger deviations: where the legs show that normals
    /// are within the tolerance, no two of a grid are farther apart, and narrow ones are shown.
    #[test]
    fn legs_within_narrow_cones_have_normals_within_the_tolerance() {
        let random = &mut fastrand::Rng::with_seed(23);
        let tolerance = 45.0_f64.to_radians();
        let mut shown = [0; 2];
        for case in 0..2000 {
            let degree = [random.usize(1..5), random.usize(1..5)];
            let (skew, size) = (random.f64(), if case % 2 == 0 { 0.02 } else { 0.5 * random.f64() });
            let mut controls = Vec::new();
            for i in 0..=degree[0] {
                for j in 0..=degree[1] {
                    let [x, y, z] = [0; 3].map(|_| size * (random.f64() - 0.5));
                    let (i, j) = (i as f64, j as f64);
                    controls.push(DVec4::new(i + skew * j + x, j + y, z, 1.0));
                }
            }
            let patch = Patch::whole(degree, DVec3::ZERO, &controls);
            if !has_narrow_cones(&patch, tolerance) {
                continue;
            }
            shown[case % 2] += 1;
            let places = (0..6).flat_map(|i| (0..6).map(move |j| [f64::from(i) / 5.0, f64::from(j) / 5.0]));
            let normals: Vec<_> = places.map(|place| patch.jet(place).normal()).collect();
            assert!(
                normals.iter().all(Option::is_some) && min_cosine(&normals, 1) >= tolerance.cos() - 1e-12
            );
        }
        assert!(shown[0] == 1000 && (100..900).contains(&shown[1]), "{shown:?}");
        let weighted = [1.0, 2.0, 1.0, 1.0].map(|w| DVec4::new(0.0, 0.0, 0.0, w));
        let patch = Patch::whole([1, 1], DVec3::ZERO, &weighted);
        assert!(!has_narrow_cones(&patch, tolerance));
    }
}
