use super::super::{assert_contains, budgeted, measure};
use nurbs_hausdorff::internals::engine::DistanceOptions;
use nurbs_hausdorff::shapes::lateral;
use nurbs_hausdorff::trim::{FaceArrays, TrimCurveArrays};
use nurbs_hausdorff::{Model, ModelArrays, SurfaceArrays};
use std::f64::consts::{FRAC_1_SQRT_2, TAU};

/// The corners of the wedge along v, and those at its wider end before and after the seam along u.
const START: f64 = 0.466_079_722_626_204_06;
const END: f64 = 0.645_352_414_026_997_7;
const BEFORE: f64 = 0.935_893_618_103_145_9;
const AFTER: f64 = 0.005_426_334_353_743_591;

/// The strip's range along u and v.
const STRIP: [[f64; 2]; 2] =
    [[0.999_782_069_444_343_3, 0.999_809_075_641_660_2], [0.382_253_193_511_773_1, 0.617_286_611_726_157_6]];

/// The points of each side of the wedge from which the distance is taken.
const SAMPLES: u32 = 200_000;

/// The point of the cylinder of radius 1 and height 2π, by arcs of a quarter each.
fn point([u, v]: [f64; 2]) -> [f64; 3] {
    let quarter = (4.0 * u).floor().min(3.0);
    let t = 4.0 * u - quarter;
    let [b0, b1, b2] = [(1.0 - t) * (1.0 - t), 2.0 * FRAC_1_SQRT_2 * t * (1.0 - t), t * t];
    let (x, y, w) = (b0 + b1, b1 + b2, b0 + b1 + b2);
    let (sin, cos) = (0.25 * TAU * quarter).sin_cos();
    [(cos * x - sin * y) / w, (sin * x + cos * y) / w, TAU * v]
}

/// The cylinder within a loop of lines.
fn face(corners: &[[f64; 2]]) -> FaceArrays {
    let line = |k: usize| TrimCurveArrays {
        degree: 1,
        knots: vec![0.0, 0.0, 1.0, 1.0],
        control_points: [corners[k], corners[(k + 1) % corners.len()]].map(|[u, v]| [u, v, 1.0]).to_vec(),
        ..TrimCurveArrays::default()
    };
    plain(lateral([1.0; 2], [0.0, TAU]).unwrap().into_arrays(), Some((0..corners.len()).map(line).collect()))
}

fn plain(surface: SurfaceArrays, trim: Option<Vec<TrimCurveArrays>>) -> FaceArrays {
    FaceArrays::new(surface, trim.map(|curves| vec![curves]))
}

/// A square of side 1e-4 at (0, 3), moved along x.
fn square(shift: f64) -> FaceArrays {
    let corner = |x: f64, y: f64| [3.0 + shift, 1e-4 * x, 1e-4 * y, 1.0];
    let knots = vec![0.0, 0.0, 1.0, 1.0];
    let surface = SurfaceArrays {
        degree: [1, 1],
        knots: [knots.clone(), knots],
        counts: [2, 2],
        control_points: vec![corner(0.0, 0.0), corner(0.0, 1.0), corner(1.0, 0.0), corner(1.0, 1.0)],
    };
    plain(surface, None)
}

/// A narrow strip of a cylinder within a wedge-shaped hole over its seam. The rim of the hole was looked for about
/// the foot at the end of the domain, and its box lay beyond it: the conic was evaluated one period off.
///
/// The truth is the least distance of the strip's farthest corner from points of the wedge's sides; the strip is
/// within the hole there, and a square that deviates by half as much hides nothing.
pub(crate) async fn rim_beyond_a_seam() {
    let [[u0, u1], [v0, v1]] = STRIP;
    let rest = [
        [0.0, 0.0],
        [1.0, 0.0],
        [1.0, START],
        [BEFORE, END],
        [1.0, END],
        [1.0, 1.0],
        [0.0, 1.0],
        [0.0, END],
        [AFTER, END],
        [0.0, START],
    ];
    let side = |[wide, seam]: [f64; 2], k: u32| {
        let share = f64::from(k) / f64::from(SAMPLES);
        point([seam + (wide - seam) * share, START + (END - START) * share])
    };
    let corner = point([u0, v1]);
    let to = |place: [f64; 3]| (0..3).map(|axis| (place[axis] - corner[axis]).powi(2)).sum::<f64>().sqrt();
    let truth = [[BEFORE, 1.0], [AFTER, 0.0]]
        .into_iter()
        .flat_map(|ends| (0..=SAMPLES).map(move |k| side(ends, k)))
        .map(to)
        .fold(f64::INFINITY, f64::min);
    let model =
        |faces: Vec<FaceArrays>| Model::from_faces(ModelArrays { faces, ..ModelArrays::default() }).unwrap();
    let strip = face(&[[u0, v0], [u1, v0], [u1, v1], [u0, v1]]);
    let a = model(vec![strip, square(0.5 * truth)]);
    let b = model(vec![face(&rest), square(0.0)]);
    let result = measure(&a, &b, &budgeted()).await;
    assert_contains(&result, truth, "rim_beyond_a_seam");
    assert!(result.converged, "[{:e}, {:e}]", result.lower, result.upper);
    assert!(result.certified().unwrap().audit.struck.is_empty(), "{:?}", result.notice);
    let limit = Some(0.75 * truth);
    let decided = measure(&a, &b, &DistanceOptions { limit, ..budgeted() }).await;
    assert_eq!(decided.certified().unwrap().within, Some(false));
}
