//! Scores of generated CAD: intervals that hold what formulas state, and that each trick lowers.
#![cfg(not(target_arch = "wasm32"))]
#![allow(clippy::unwrap_used, clippy::panic, reason = "a panic is how a test fails")]

#[path = "../facts/models.rs"]
#[allow(dead_code, reason = "shared with the tests of facts")]
mod models;
#[path = "../../examples/parts/plate.rs"]
#[allow(dead_code, reason = "shared with the example")]
mod plate;
#[path = "../support/writers/step.rs"]
#[allow(dead_code, unreachable_pub, reason = "the tests' writer has more entities than parts need")]
mod step;

mod alignments;
mod edges;
mod monotone;
mod normals;
mod requirements;
mod tricks;

use nurbs_hausdorff::{DVec3, Engine, Interval, PreparedModel, Score, ScoreOptions};

/// The lengths of the truth of most tests: a box with a corner at the origin.
const SIZE: [f64; 3] = [2.0, 3.0, 4.0];

/// The area of that box.
const AREA: f64 = 52.0;

fn score(candidate: &PreparedModel, truth: &PreparedModel, options: &ScoreOptions) -> Score {
    Engine::cpu().score(candidate, truth, options).wait().unwrap()
}

/// Options of narrow intervals, with thresholds in model units.
fn with_thresholds(thresholds: &[f64]) -> ScoreOptions {
    ScoreOptions {
        thresholds: thresholds.to_vec(),
        relative_tolerance: Some(1e-4),
        ..ScoreOptions::default()
    }
}

/// Checks that an interval holds a number and is as narrow as requested.
fn holds(found: Interval, value: f64, width: f64) {
    assert!(found.contains(value) && found.width() <= width, "{value} {found:?} {width}");
}

/// Checks the numbers of both directions: mean and mean square, and the Hausdorff distance.
fn are(found: &Score, forward: [f64; 3], reverse: [f64; 3]) {
    assert!(found.converged, "{found:?}");
    let hausdorff = found.hausdorff.unwrap();
    // The mean square is off by twice the root mean square times the width of that.
    let width = |mean_square: f64| 2.1 * mean_square.sqrt() * found.tolerance + found.tolerance.powi(2);
    for ([mean, square, most], surface, distance) in [
        (forward, found.forward.unwrap(), hausdorff.forward),
        (reverse, found.reverse.unwrap(), hausdorff.reverse),
    ] {
        holds(surface.mean, mean, found.tolerance);
        holds(surface.mean_square, square, width(square));
        holds(distance, most, found.tolerance * 1.01);
    }
    holds(found.chamfer.unwrap(), forward[0] + reverse[0], 2.0 * found.tolerance);
    let [one, other] = [forward[1], reverse[1]];
    holds(found.chamfer_squared.unwrap(), one + other, width(one) + width(other));
    holds(hausdorff.distance, forward[2].max(reverse[2]), found.tolerance * 1.01);
}

/// The box of these lengths with a corner here.
fn cuboid(corner: [f64; 3], size: [f64; 3]) -> nurbs_hausdorff::Model {
    let corner = DVec3::from_array(corner);
    models::box_of_faces(corner, corner + DVec3::from_array(size))
}

fn truth() -> PreparedModel {
    models::prepared(&cuboid([0.0; 3], SIZE))
}

/// Models together.
fn together(parts: &[&nurbs_hausdorff::Model]) -> PreparedModel {
    let parts: Vec<_> = parts.iter().map(|&part| (part, models::moved([0.0; 3]))).collect();
    models::prepared(&models::placed_all(&parts))
}

/// What a box whose depth is larger by h, at most 1, has: the distances there and back, in closed form.
///
/// There, the end is at h, and the strips of the sides at their heights above the old end. Back, the point of
/// the old end at r from its rim is at min(h, r), where a part (2 − 2t)(3 − 2t)/6 of it has r > t.
fn deeper(h: f64) -> ([f64; 3], [f64; 3]) {
    let area = AREA + 10.0 * h;
    let there = [(6.0 * h + 5.0 * h * h) / area, (6.0 * h * h + 10.0 / 3.0 * h.powi(3)) / area, h];
    let mean = 6.0 * h - 5.0 * h * h + 4.0 / 3.0 * h.powi(3);
    let square = 6.0 * h * h - 20.0 / 3.0 * h.powi(3) + 2.0 * h.powi(4);
    (there, [mean / AREA, square / AREA, h])
}

/// What a box beside the truth's at a gap g has, a cube of lengths s that lies within the shadow of an end.
fn speck(s: f64, g: f64) -> [f64; 3] {
    let area = AREA + 6.0 * s * s;
    let far = g + s;
    let sides = (far.powi(3) - g.powi(3)) / (3.0 * s);
    [6.0 * s * s * (g + s / 2.0) / area, s * s * (g * g + far * far + 4.0 * sides) / area, far]
}
