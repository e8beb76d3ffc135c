//! Surfaces from bytes.

use super::bytes::Bytes;
use nurbs_hausdorff::{Model, SurfaceArrays};

/// The lengths of knot spans; 0 repeats a knot.
const SPANS: [f64; 6] = [1.0, 0.5, 2.0, 0.0, 0.125, 3.0];

/// The highest degree, as the independent evaluator's recursion is exponential in it.
const MAX_DEGREE: usize = 4;

/// Arrays of any numbers; few are a valid surface.
pub fn any_arrays(bytes: &mut Bytes<'_>) -> SurfaceArrays {
    let degree = [0, 1].map(|_| bytes.below(18));
    let counts = [0, 1].map(|axis| (degree[axis] + bytes.below(4)).saturating_sub(bytes.below(2)));
    // One control point or one knot may be missing.
    let points = (counts[0] * counts[1]).saturating_sub(usize::from(bytes.byte() == 255));
    let missing = usize::from(bytes.byte() == 255);
    let knots = [0, 1].map(|axis| {
        let count = counts[axis] + degree[axis] + 1 - missing;
        let mut knots: Vec<f64> = match bytes.below(4) {
            // Clamped or not, of ordinary spans.
            0 => (0..count).map(|index| index.max(degree[axis]).min(counts[axis]) as f64).collect(),
            1 => (0..count).map(|index| index as f64).collect(),
            _ => (0..count).map(|_| bytes.number()).collect(),
        };
        if bytes.flag() {
            knots.sort_by(f64::total_cmp);
        }
        knots
    });
    let weighted = bytes.flag();
    let control_points = (0..points)
        .map(|_| {
            let [x, y, z] = [(); 3].map(|()| bytes.number());
            [x, y, z, if weighted { bytes.number() } else { 1.0 }]
        })
        .collect();
    SurfaceArrays { degree, knots, counts, control_points }
}

/// A valid knot vector of this degree, of one to three spans.
fn knots(bytes: &mut Bytes<'_>, degree: usize) -> Vec<f64> {
    let interior = bytes.below(3);
    let clamped = bytes.byte() < 192;
    let mut knots = vec![bytes.coordinate()];
    let push = |knots: &mut Vec<f64>, step: f64| knots.push(knots[knots.len() - 1] + step);
    // Unclamped, the steps before the domain may be 0 but no more often than the degree.
    for _ in 0..degree {
        let step = if clamped { 0.0 } else { bytes.choose(&SPANS) };
        push(&mut knots, step);
    }
    for _ in 0..interior {
        let step = bytes.choose(&SPANS).max(SPANS[4]);
        push(&mut knots, step);
        for _ in 0..bytes.below(degree) {
            push(&mut knots, 0.0);
        }
    }
    push(&mut knots, 1.0);
    for _ in 0..degree {
        let step = if clamped { 0.0 } else { bytes.choose(&SPANS) };
        push(&mut knots, step);
    }
    knots
}

/// A valid surface of degrees 1 to 4 with one to three spans along each axis,
/// coordinates of at most 10 in size and weights from 1/8 to 8.
pub fn tame_arrays(bytes: &mut Bytes<'_>) -> SurfaceArrays {
    let degree = [0, 1].map(|_| 1 + bytes.below(MAX_DEGREE));
    let knots = degree.map(|degree| knots(bytes, degree));
    let counts = [0, 1].map(|axis| knots[axis].len() - degree[axis] - 1);
    let weighted = bytes.flag();
    // A sheet over a grid with shifts, or any net, which may fold and degenerate.
    let sheet = bytes.byte() < 160;
    let mut control_points = Vec::with_capacity(counts[0] * counts[1]);
    for i in 0..counts[0] {
        for j in 0..counts[1] {
            let [x, y, z] = [(); 3].map(|()| bytes.coordinate());
            let at = |index: usize, count: usize| 4.0 * index as f64 / (count - 1) as f64 - 2.0;
            let [x, y] =
                if sheet { [at(i, counts[0]) + x / 8.0, at(j, counts[1]) + y / 8.0] } else { [x, y] };
            let weight = if weighted { 2.0_f64.powi(bytes.below(7) as i32 - 3) } else { 1.0 };
            control_points.push([x, y, z, weight]);
        }
    }
    SurfaceArrays { degree, knots, counts, control_points }
}

/// A model of one or two such surfaces; `None` where one is invalid.
pub fn tame_model(bytes: &mut Bytes<'_>) -> Option<Model> {
    let count = 1 + usize::from(bytes.byte() > 200);
    let surfaces = (0..count).map(|_| tame_arrays(bytes)).collect();
    Model::from_arrays(None, surfaces).ok()
}

/// The square `|x|, |y| <= half_width` in the plane z = 0, as a surface of
/// degrees 1 to 4 with any weights.
///
/// Every line of controls along an edge is in order, so the edges are mapped
/// onto the square's, and the whole domain therefore onto the whole square.
pub fn plane(bytes: &mut Bytes<'_>, half_width: f64) -> SurfaceArrays {
    let degree = [0, 1].map(|_| 1 + bytes.below(MAX_DEGREE));
    let weighted = bytes.flag();
    let knots = degree.map(|degree| [0.0, 1.0].map(|end| vec![end; degree + 1]).concat());
    let counts = degree.map(|degree| degree + 1);
    let at = |index: usize, degree: usize| half_width * (2.0 * index as f64 / degree as f64 - 1.0);
    let mut control_points = Vec::with_capacity(counts[0] * counts[1]);
    for i in 0..counts[0] {
        for j in 0..counts[1] {
            let weight = if weighted { 2.0_f64.powi(bytes.below(7) as i32 - 3) } else { 1.0 };
            control_points.push([at(i, degree[0]), at(j, degree[1]), 0.0, weight]);
        }
    }
    SurfaceArrays { degree, knots, counts, control_points }
}

/// The arrays with all coordinates multiplied by a power of two.
pub fn scaled(mut arrays: SurfaceArrays, exponent: i32) -> SurfaceArrays {
    for point in &mut arrays.control_points {
        for coordinate in &mut point[..3] {
            *coordinate *= 2.0_f64.powi(exponent);
        }
    }
    arrays
}
