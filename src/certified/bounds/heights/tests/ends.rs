//! Cells beyond ends of surfaces, by any functions that follow their parameters.

use super::super::candidate::candidates;
use super::*;
use crate::certified::nearest::{Foot, NearestPoint};
use crate::certified::testing::{Surfaces, patch};
use crate::flatness::Flatness;
use crate::model::SurfaceArrays;
use crate::rounding::upper_min;
use glam::{DMat3, DVec4};

/// An arc of the unit circle between two angles: homogeneous controls.
fn arc([from, to]: [f64; 2]) -> [DVec3; 3] {
    let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
    let at = |angle: f64| DVec3::new(angle.cos(), angle.sin(), 1.0);
    [at(from), DVec3::new(middle.cos(), middle.sin(), half.cos()), at(to)]
}

/// The part of a torus about the z axis, or with the major radius 0 of the unit sphere, between longitudes, along s, and
/// latitudes, along t.
fn revolved(major: f64, longitudes: [f64; 2], latitudes: [f64; 2]) -> [DVec4; 9] {
    let (along, across) = (arc(longitudes), arc(latitudes));
    std::array::from_fn(|index| {
        let (u, v) = (along[index / 3], across[index % 3]);
        let radius = v.x + major * v.z;
        let weight = v.z * u.z;
        (DVec3::new(radius * u.x, radius * u.y, v.y * u.z) / weight).extend(weight)
    })
}

/// Surfaces of patches of degree 2.
fn surfaces(patches: &[[DVec4; 9]]) -> Surfaces {
    let knots = [0; 2].map(|_| vec![0.0, 0.0, 0.0, 1.0, 1.0, 1.0]);
    let of = |controls: &[DVec4; 9]| SurfaceArrays {
        degree: [2, 2],
        knots: knots.clone(),
        counts: [3, 3],
        control_points: controls.map(|control| control.to_array()).to_vec(),
    };
    Surfaces::new(patches.iter().map(of).collect(), Flatness::None)
}

/// However the functions bend, no point of a cell that goes beyond an end is farther than the
/// bound.
#[test]
fn no_point_is_farther_however_the_functions_bend() {
    let random = &mut fastrand::Rng::with_seed(317);
    let mut bounded = 0;
    for case in 0..400 {
        let b = surfaces(&[revolved([0.0, 2.0][case % 2], [-0.5, 0.5], [-0.6, 0.3])]);
        let operand = b.operand();
        let nearest = NearestPoint::new(operand);
        let beyond = 0.01 * random.f64();
        let a = revolved([0.0, 2.0][case % 2], [-0.1, 0.1], [0.1, 0.3 + beyond]);
        let a_surfaces = patch(a);
        let frame = Frame::new(Chart::new(b.sheets(), 0, [0.5, 0.8 + 0.2 * random.f64()])).unwrap();
        let of_a = a_surfaces.operand().patch(0);
        let whole = of_a.restricted([0.0, 1.0], [0.0, 1.0]);
        let a = Piece::new([2, 2], whole, frame.jet.point - of_a.center, 10.0);
        let Some((image, linear)) = frame.image(&a) else { continue };
        let mut functions = frame.closer_placement(&a, &image).functions;
        for function in &mut functions {
            let size = function.linear.length();
            let mut number = || 0.3 * size * (random.f64() - 0.5);
            function.form += DMat3::from_diagonal(DVec3::new(number(), number(), number()));
        }
        let placement = frame.placement(&a, &image, functions);
        let over = CellComparison { frame, face: None, a, image, linear };
        let mut found = f64::INFINITY;
        for candidate in candidates(&over.a, over.frame.normal, over.frame.tangents[0], 1.0) {
            found = upper_min(found, over.bound_by(&placement, &candidate));
        }
        if !found.is_finite() {
            continue;
        }
        bounded += 1;
        for place in [[0.0, 1.0], [0.5, 1.0], [1.0, 1.0], [0.3, 0.9]] {
            let target = of_a.point(place);
            let foot = nearest.nearest(target, Foot::start(0, [0.5; 2]), 0.0);
            let distance = nearest.certified(target, foot, 1e-9).distance();
            assert!(distance <= found + 1e-9, "{distance:e} {found:e} of case {case}");
        }
    }
    assert!(bounded > 100, "{bounded}");
}
