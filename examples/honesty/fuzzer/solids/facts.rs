//! Facts of a solid against a second rule and against points.

use super::super::sheet::{Sheet, sheets};
use super::moments::{Estimate, Moments};
use glam::{DMat3, DVec2, DVec3};
use nurbs_hausdorff::internals::engine::PreparedModel;
use nurbs_hausdorff::{Interval, Model, Orientation};

/// The points along each parameter among which the farthest along an axis is looked for, and the steps from it.
const GRID: usize = 24;
const STEPS: usize = 60;

/// The best points of the grid that steps are taken from: a seam has each of its points twice, and a pole along a
/// whole side, of which only some lead on to the farthest point.
const STARTS: usize = 2 * (GRID + 1);

/// What the search for the farthest point may miss, relative to the size.
const MISSED: f64 = 1e-6;

/// Rounding of coordinates, relative to the largest.
const ROUNDING: f64 = 64.0 * f64::EPSILON;

/// Sweeps of Jacobi's method: it converges quadratically.
const SWEEPS: usize = 30;

/// Returns in words which facts of a model are not what is found.
pub(super) fn violations(prepared: &PreparedModel, model: &Model) -> Vec<String> {
    let facts = prepared.facts();
    let mut found = Vec::new();
    let mut compare = |what: &str, stated: Interval, by: Estimate| {
        if !by.error.is_finite() {
            return;
        }
        if stated.upper < by.value - by.error || by.value + by.error < stated.lower {
            found.push(format!("{what} {stated:?}, by the second rule {by:?}"));
        }
    };
    let moments = Moments::of(model);
    if let Some(area) = facts.area {
        compare("area", area, moments.area);
    }
    let bodies = prepared.bodies();
    let is_one = bodies.len() == 1
        && matches!(bodies[0].orientation, Some(Orientation::Consistent | Orientation::InsideOut));
    if let Some(volume) = facts.volume.filter(|_| is_one) {
        compare("volume", volume, moments.volume);
        let center = quotients(&moments);
        for axis in 0..3 {
            if let Some(centroid) = facts.centroid {
                compare("centroid", centroid[axis], center[axis]);
            }
        }
        let (tensor, error) = inertia(&moments);
        if let Some(inertia) = facts.inertia {
            for (i, row) in inertia.iter().enumerate() {
                for (j, entry) in row.iter().enumerate() {
                    compare("inertia", *entry, Estimate { value: tensor.col(j)[i], error });
                }
            }
        }
        for (principal, value) in facts.principal_moments.into_iter().flatten().zip(eigenvalues(tensor)) {
            // Eigenvalues differ by at most the norm of a symmetric matrix's change (Weyl).
            compare("principal moment", principal, Estimate { value, error: 3.0 * error });
        }
    }
    found.extend(extents(model, facts.min, facts.max));
    found
}

fn quotients(moments: &Moments) -> [Estimate; 3] {
    let volume = moments.volume;
    [0, 1, 2].map(|axis| {
        let value = moments.first[axis].value / volume.value;
        let error = (moments.first[axis].error + value.abs() * volume.error) / (volume.value - volume.error);
        let at = value + moments.origin[axis];
        Estimate { value: at, error: if error >= 0.0 { error + ROUNDING * at.abs() } else { f64::INFINITY } }
    })
}

/// The tensor about the centroid, and the error of its entries.
fn inertia(moments: &Moments) -> (DMat3, f64) {
    let volume = moments.volume.value;
    let first = DVec3::from_array(moments.first.map(|of| of.value));
    let error_of = |of: &Estimate| of.error;
    let of_second = moments.second.iter().flatten().map(error_of).fold(0.0, f64::max);
    let of_first = moments.first.iter().map(error_of).fold(0.0, f64::max);
    let center = first / volume;
    let value = |i: usize, j: usize| moments.second[i][j].value - first[i] * center[j];
    let trace: f64 = (0..3).map(|i| value(i, i)).sum();
    let column = |j: usize| DVec3::from_array([0, 1, 2].map(|i| f64::from(i == j) * trace - value(i, j)));
    let length = center.length();
    let error = 4.0 * (of_second + 2.0 * length * of_first + length * length * moments.volume.error);
    (DMat3::from_cols(column(0), column(1), column(2)), error)
}

/// The eigenvalues of a symmetric matrix, ascending, by Jacobi's method.
fn eigenvalues(mut of: DMat3) -> [f64; 3] {
    for sweep in 0..SWEEPS {
        let (i, j) = [(0, 1), (1, 2), (0, 2)][sweep % 3];
        let off = of.col(j)[i];
        if off == 0.0 {
            continue;
        }
        let angle = 0.5 * (2.0 * off).atan2(of.col(j)[j] - of.col(i)[i]);
        let (sin, cos) = angle.sin_cos();
        let mut turn = DMat3::IDENTITY;
        turn.col_mut(i)[i] = cos;
        turn.col_mut(j)[j] = cos;
        turn.col_mut(j)[i] = sin;
        turn.col_mut(i)[j] = -sin;
        of = turn.transpose() * of * turn;
    }
    let mut values = [0, 1, 2].map(|i| of.col(i)[i]);
    values.sort_by(f64::total_cmp);
    values
}

/// No point is beyond the ends that are stated, and there are points near them.
fn extents(model: &Model, min: [Interval; 3], max: [Interval; 3]) -> Vec<String> {
    let size = model.bounding_box().diagonal();
    let sheets = sheets(model, DVec3::ZERO);
    let mut found = Vec::new();
    for axis in 0..3 {
        for (sign, stated) in [(1.0, max[axis]), (-1.0, min[axis])] {
            let farthest =
                sheets.iter().map(|sheet| farthest(sheet, axis, sign)).fold(f64::NEG_INFINITY, f64::max);
            let [near, far] =
                if sign > 0.0 { [stated.lower, stated.upper] } else { [-stated.upper, -stated.lower] };
            if farthest > far + ROUNDING * far.abs() || farthest < near - MISSED * size {
                found.push(format!("extent {axis} {stated:?}, a point is at {}", sign * farthest));
            }
        }
    }
    found
}

/// The largest coordinate found on a surface, by a grid and steps from its best points that shrink.
fn farthest(sheet: &Sheet, axis: usize, sign: f64) -> f64 {
    let height = |at: DVec2| sign * sheet.point(sheet.clamp(at))[axis];
    let at = |k: usize| k as f64 / GRID as f64;
    let places = (0..(GRID + 1) * (GRID + 1)).map(|k| sheet.at([at(k / (GRID + 1)), at(k % (GRID + 1))]));
    let mut starts: Vec<(f64, DVec2)> = places.map(|place| (height(place), place)).collect();
    starts.sort_by(|one, other| other.0.total_cmp(&one.0));
    let climbed = starts.into_iter().take(STARTS).map(|start| climbed(sheet, &height, start));
    climbed.fold(f64::NEG_INFINITY, f64::max)
}

/// The height reached from a point by steps that rise, halved where none does.
fn climbed(sheet: &Sheet, height: &dyn Fn(DVec2) -> f64, (mut best, mut place): (f64, DVec2)) -> f64 {
    let mut step = sheet.extent() / GRID as f64;
    for _ in 0..STEPS {
        let around = [DVec2::X, DVec2::Y, -DVec2::X, -DVec2::Y, DVec2::ONE, -DVec2::ONE];
        let tried = around.map(|toward| place + toward * step).map(|at| (height(at), sheet.clamp(at)));
        match tried.into_iter().max_by(|one, other| one.0.total_cmp(&other.0)) {
            Some((higher, at)) if higher > best => (best, place) = (higher, at),
            _ => step *= 0.5,
        }
    }
    best
}
