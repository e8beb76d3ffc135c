//! Any loops on a surface are either refused, by their validation or as not cut, or cut into
//! pieces that lie on the surface, and whose distances are intervals.

use super::support::bytes::Bytes;
use super::support::results::{assert_numbers, distance};
use super::support::sampling::span_at;
use super::support::surfaces::{plane, tame_arrays};
use crate::support::evaluator;
use nurbs_hausdorff::internals::model::ModelArrays;
use nurbs_hausdorff::internals::model::trim::{FaceArrays, Trim, TrimCurveArrays};
use nurbs_hausdorff::internals::untrim::untrim;
use nurbs_hausdorff::options::Audit;
use nurbs_hausdorff::{
    Axis, CertifiedOptions, DistanceOptions, Error, Method, Model, NurbsSurface, PreparedModel,
};

/// The deviations permitted, as fractions of the model's diagonal, which is at most 20.
const DEVIATIONS: [f64; 3] = [1e-9, 1e-6, 1e-3];
const SIZE: f64 = 20.0;

/// An upper bound on the rounding of the evaluations compared.
const ROUNDING: f64 = 1e-9;

/// The pieces whose distance is computed at most, and the cells for them.
const MAX_PIECES: usize = 64;
const MAX_CELLS: usize = 32;

const STEPS: usize = 3;

pub fn check(bytes: &[u8]) {
    let mut bytes = Bytes::new(bytes);
    let deviation = SIZE * bytes.choose(&DEVIATIONS);
    let flat = bytes.flag();
    let arrays = if flat { plane(&mut bytes, 4.0) } else { tame_arrays(&mut bytes) };
    let Ok(surface) = NurbsSurface::new(0, arrays.clone()) else { return };
    let loops: Vec<_> = (0..1 + bytes.below(3)).map(|_| trim_loop(&mut bytes, &surface)).collect();
    let Ok(trim) = Trim::new(0, &surface, loops.clone()) else { return };
    match untrim(0, &surface, &trim, deviation) {
        Ok(untrimmed) => {
            assert!(!untrimmed.pieces.is_empty() && untrimmed.deviation.is_finite());
            for piece in &untrimmed.pieces {
                let domain = piece.surface.domain();
                for index in 0..(STEPS + 1) * (STEPS + 1) {
                    let part = |index: usize| index as f64 / STEPS as f64;
                    let at = domain.at([part(index / (STEPS + 1)), part(index % (STEPS + 1))]);
                    let found = piece.surface.point(at);
                    let [u, v] = piece.map.face_parameters(at);
                    let expected = point(&surface, [u, v]);
                    let error = evaluator::distance(found, expected);
                    let context = || format!("{surface:?}, {loops:?}: {error} at {at:?}");
                    assert!(error <= untrimmed.deviation + ROUNDING, "{}", context());
                }
            }
            if untrimmed.pieces.len() > MAX_PIECES {
                return;
            }
        }
        Err(Error::FaceNotCut { .. }) => {}
        Err(error) => panic!("{error}: {surface:?}, {loops:?}"),
    }
    let face = FaceArrays::new(arrays, Some(loops));
    let model = Model::from_faces(ModelArrays { faces: vec![face], ..ModelArrays::default() }).unwrap();
    let text = model.to_json().unwrap();
    assert_eq!(Model::from_json(&text).unwrap().to_json().unwrap(), text);
    let other = Model::from_arrays(None, vec![plane(&mut bytes, 4.0)]).unwrap();
    let options = DistanceOptions {
        method: Method::Certified(CertifiedOptions {
            max_cells: Some(MAX_CELLS),
            audit: Audit::All,
            ..Default::default()
        }),
        symmetric: true,
        ..DistanceOptions::default()
    };
    if PreparedModel::new(&model).is_ok() {
        assert_numbers(&distance(&model, &other, &options).unwrap());
    }
}

/// A loop of curves: corners of a rectangle or any corners, between which curves bulge by
/// any or no control points; ends rarely miss each other.
fn trim_loop(bytes: &mut Bytes<'_>, surface: &NurbsSurface) -> Vec<TrimCurveArrays> {
    let domain = surface.domain();
    let place = |bytes: &mut Bytes<'_>| domain.at([bytes.unit(), bytes.unit()]);
    let corners: Vec<[f64; 2]> = if bytes.flag() {
        let ([u0, v0], [u1, v1]) = (place(bytes), place(bytes));
        let corners = [[u0, v0], [u1, v0], [u1, v1], [u0, v1]];
        // Counterclockwise about a face, clockwise about a hole.
        if bytes.flag() { corners.to_vec() } else { corners.into_iter().rev().collect() }
    } else {
        (0..1 + bytes.below(5)).map(|_| place(bytes)).collect()
    };
    let curve = |k: usize| {
        let degree = 1 + [0, 0, 1, 2, 3][bytes.below(5)];
        let weighted = bytes.flag();
        let mut control_points = Vec::with_capacity(degree + 1);
        for index in 0..=degree {
            let [u, v] = match index {
                0 => corners[k],
                _ if index == degree => corners[(k + 1) % corners.len()],
                _ => place(bytes),
            };
            let weight = if weighted { 2.0_f64.powi(bytes.below(7) as i32 - 3) } else { 1.0 };
            control_points.push([u, v, weight]);
        }
        let gap = if bytes.byte() > 250 { bytes.unit() } else { 0.0 };
        if bytes.byte() > 250 {
            control_points[0][0] += bytes.choose(&[1e-12, 1e-8, 1e-5, -1e-9]);
        }
        let knots = [vec![0.0; degree + 1], vec![1.0; degree + 1]].concat();
        TrimCurveArrays { degree, knots, control_points, gap, edge: None }
    };
    (0..corners.len()).map(curve).collect()
}

/// The point at parameters by the independent evaluator.
fn point(surface: &NurbsSurface, parameters: [f64; 2]) -> evaluator::Vector {
    let span = Axis::BOTH.map(|axis| span_at(surface, axis, parameters[axis]));
    evaluator::evaluate_on_span(surface, span, parameters[0], parameters[1], [0.0; 3]).point
}
