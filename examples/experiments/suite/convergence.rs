//! The share of feet that the iterations miss, by distance times curvature, for the
//! tangent-plane step of the 2012 paper and for the damped Newton step.

use super::chart::{Axis, Panel, Series, Style};
use super::{Anyhow, Setup, Table};
use fastrand::Rng;
use glam::DVec3;
use nurbs_hausdorff::internals::bezier::{Jet, Patch, PatchSet, extract};
use nurbs_hausdorff::internals::closest::{Foot, nearest_control, newton, tangent_plane};
use nurbs_hausdorff::internals::flatness::{Flatness, flatten};
use nurbs_hausdorff::shapes::shape;

/// The number of intervals of d times kappa, the start of the first, and their width.
const BINS: usize = 20;
const FIRST: f64 = -1.0;
const WIDTH: f64 = 0.25;

/// The smallest distance of drawn feet from the patch's edges, in its parameters.
const INSIDE: f64 = 0.2;

/// The smallest eigenvalue of the distance's Hessian, in the metric of the surface,
/// at which a foot is accepted as a clear minimum.
const MIN_EIGENVALUE: f64 = 0.1;

/// A foot is missed if the distance found exceeds its distance by this fraction of
/// the patch's diagonal.
const MISSED: f64 = 1e-4;

/// The paper's number of steps, and a number beyond which more do not help.
const STEPS: [u32; 2] = [5, 100];

/// A step tolerance so small that no iteration ends before its last step.
const NO_CHANGE: f64 = 1e-15;

const SEED: u64 = 2012;

const COLUMNS: [&str; 7] = [
    "d_kappa",
    "draws",
    "tangent_plane_5_missed",
    "tangent_plane_100_missed",
    "newton_5_missed",
    "newton_100_missed",
    "shapes",
];

/// `convergence`: the share of feet missed on loosely flat patches.
pub(crate) fn run(setup: &Setup) -> Anyhow<()> {
    let shapes = ["bottle", "naca-wing", "torus", "wavy-sheet"];
    let mut patches = PatchSet::default();
    for name in shapes {
        patches.append(&flatten(&extract(&shape(name)?).patches, Flatness::Loose).patches);
    }
    let mut rng = Rng::with_seed(SEED);
    let max_draws = setup.choose(2000, 40);
    let mut table = Table::new(&COLUMNS);
    let mut curves: [Vec<Option<[f64; 2]>>; 4] = Default::default();
    for bin in 0..BINS {
        let (mut draws, mut missed) = (0, [0_usize; 4]);
        // Few points of few patches admit a value below 0; most admit one above.
        for _ in 0..20 * max_draws {
            if draws == max_draws {
                break;
            }
            let d_kappa = FIRST + WIDTH * (bin as f64 + rng.f64());
            let patch = patches.patch(rng.usize(..patches.len()));
            let Some((target, distance)) = draw(&patch, d_kappa, &mut rng) else { continue };
            draws += 1;
            let threshold = distance + MISSED * patch.bounding_box().diagonal();
            for (count, foot) in missed.iter_mut().zip(feet(&patch, target)) {
                *count += usize::from(foot.distance_squared.sqrt() > threshold);
            }
        }
        let middle = FIRST + WIDTH * (bin as f64 + 0.5);
        let shares = missed.map(|count| (draws > 0).then(|| count as f64 / draws as f64));
        for (curve, share) in curves.iter_mut().zip(shares) {
            curve.push(share.map(|share| [middle, PERCENT * share]));
        }
        let mut row = vec![middle.into(), draws.into()];
        row.extend(shares.map(Into::into));
        row.push(shapes.join(" ").as_str().into());
        table.rows.push(row);
    }
    let names = [
        "tangent plane: 5 steps",
        "tangent plane: 100 steps",
        "damped Newton: 5 steps",
        "damped Newton: 100 steps",
    ];
    let colors = [1, 1, 0, 0];
    let styles = [Style::Dashed, Style::Marked, Style::Dashed, Style::Marked];
    let series = curves
        .into_iter()
        .enumerate()
        .map(|(index, curve)| Series::new(names[index], colors[index], styles[index], curve))
        .collect();
    let panel = Panel {
        title: "Feet missed, from the nearest control point".to_owned(),
        x: Axis::linear("distance times curvature; above 0 on the convex side"),
        y: Axis::linear("missed, percent"),
        series,
    };
    setup.save("convergence", &table, &[panel])
}

const PERCENT: f64 = 100.0;

/// Returns the results of the four iterations.
fn feet(patch: &Patch<'_>, target: DVec3) -> [Foot; 4] {
    let start = nearest_control(patch, target);
    let [published, converged] = STEPS;
    [
        tangent_plane(patch, target, start, published, NO_CHANGE),
        tangent_plane(patch, target, start, converged, NO_CHANGE),
        newton(patch, target, start, published),
        newton(patch, target, start, converged),
    ]
}

/// Returns a target with a foot on the patch such that its distance times the
/// largest curvature is `d_kappa`, and that distance.
fn draw(patch: &Patch<'_>, d_kappa: f64, rng: &mut Rng) -> Option<(DVec3, f64)> {
    let at = [0, 1].map(|_| INSIDE + (1.0 - 2.0 * INSIDE) * rng.f64());
    let jet = patch.jet(at);
    let normal = if rng.bool() { jet.normal()? } else { -jet.normal()? };
    let curvatures = curvatures(&jet, normal)?;
    let largest = if curvatures[0].abs() > curvatures[1].abs() { curvatures[0] } else { curvatures[1] };
    // Towards the centre of curvature is the concave side.
    let distance = -d_kappa / largest;
    let least =
        curvatures.map(|curvature| 1.0 - distance * curvature).into_iter().fold(f64::INFINITY, f64::min);
    (distance > 0.0 && distance.is_finite() && least > MIN_EIGENVALUE)
        .then(|| (jet.point + distance * normal, distance))
}

/// Returns the principal curvatures, positive where the surface bends towards `normal`
/// (do Carmo, *Differential Geometry of Curves and Surfaces*, section 3.3).
fn curvatures(jet: &Jet, normal: DVec3) -> Option<[f64; 2]> {
    let [e, f, g] = [jet.s.dot(jet.s), jet.s.dot(jet.t), jet.t.dot(jet.t)];
    let [l, m, n] = [jet.ss.dot(normal), jet.st.dot(normal), jet.tt.dot(normal)];
    let area = e * g - f * f;
    let mean = 0.5 * (e * n - 2.0 * f * m + g * l) / area;
    let gauss = (l * n - m * m) / area;
    let root = (mean * mean - gauss).max(0.0).sqrt();
    (area > 0.0).then_some([mean - root, mean + root])
}
