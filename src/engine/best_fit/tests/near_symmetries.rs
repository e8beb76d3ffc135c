//! Parts with a near symmetry: few samples lie on the feature that breaks it.

use super::*;
use crate::model::{Model, SurfaceArrays};
use std::f64::consts::TAU;

fn plane(points: [DVec3; 4]) -> SurfaceArrays {
    SurfaceArrays {
        degree: [1, 1],
        knots: [vec![0.0, 0.0, 1.0, 1.0], vec![0.0, 0.0, 1.0, 1.0]],
        counts: [2, 2],
        control_points: points.map(|point| point.extend(1.0).to_array()).to_vec(),
    }
}

/// The faces of a box but for its bottom.
fn block(middle: DVec3, half: DVec3) -> Vec<SurfaceArrays> {
    let corner = |x: f64, y: f64, z: f64| middle + half * DVec3::new(x, y, z);
    let around = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
    let side = |k: usize| {
        let [[x, y], [to_x, to_y]] = [around[k], around[(k + 1) % 4]];
        plane([corner(x, y, -1.0), corner(x, y, 1.0), corner(to_x, to_y, -1.0), corner(to_x, to_y, 1.0)])
    };
    let top =
        [corner(-1.0, -1.0, 1.0), corner(-1.0, 1.0, 1.0), corner(1.0, -1.0, 1.0), corner(1.0, 1.0, 1.0)];
    (0..4).map(side).chain([plane(top)]).collect()
}

fn of(surfaces: Vec<SurfaceArrays>) -> PreparedModel {
    PreparedModel::new(&Model::from_arrays(None, surfaces).unwrap()).unwrap()
}

fn moved(surfaces: &[SurfaceArrays], motion: &RigidTransform) -> PreparedModel {
    let of_surface = |surface: &SurfaceArrays| {
        let control_points = surface.control_points.iter().map(|&[x, y, z, w]| {
            let point = motion.apply(DVec3::new(x, y, z));
            [point.x, point.y, point.z, w]
        });
        SurfaceArrays { control_points: control_points.collect(), ..surface.clone() }
    };
    of(surfaces.iter().map(of_surface).collect())
}

/// A cube of side 10 has a block of 0.4 by 0.6 by 0.8 on its top, off the middle. Without the block 24 poses would be equal.
#[test]
fn a_small_block_on_a_cube_tells_its_poses_apart() {
    let mut surfaces = block(DVec3::ZERO, DVec3::splat(5.0));
    let bottom = [[-1.0, -1.0], [1.0, -1.0], [-1.0, 1.0], [1.0, 1.0]];
    surfaces.push(plane(bottom.map(|[x, y]| DVec3::new(5.0 * x, 5.0 * y, -5.0))));
    surfaces.extend(block(DVec3::new(3.0, 1.5, 5.4), DVec3::new(0.2, 0.3, 0.4)));
    let b = of(surfaces.clone());
    for (index, degrees) in [40.0, 95.0, 130.0, 175.0].into_iter().enumerate() {
        let motion = pose(degrees, index);
        let found = fit(&moved(&surfaces, &motion), &b, &BestFitOptions::default());
        assert!(found.converged && found.rms < 1e-6, "{degrees}: {found:?}");
        // No other pose has the block where it is.
        assert!(found.ambiguous.is_empty(), "{degrees}: {found:?}");
        let off = found.transform.apply(motion.apply(DVec3::new(3.0, 1.5, 5.8)));
        assert!(off.distance(DVec3::new(3.0, 1.5, 5.8)) < 1e-5, "{degrees}: {off}");
    }
}

/// A prism with 48 sides approximates a round plate. Only a small block on its top determines the rotation about its axis.
#[test]
fn a_small_block_on_a_round_plate_tells_its_turn() {
    let at = |k: usize, radius: f64, z: f64| {
        let (sine, cosine) = (TAU * k as f64 / 48.0).sin_cos();
        DVec3::new(radius * cosine, radius * sine, z)
    };
    let mut surfaces = Vec::new();
    for k in 0..48 {
        surfaces.push(plane([
            at(k, 20.0, 0.0),
            at(k, 20.0, 2.0),
            at(k + 1, 20.0, 0.0),
            at(k + 1, 20.0, 2.0),
        ]));
        for z in [0.0, 2.0] {
            surfaces.push(plane([at(k, 0.0, z), at(k, 20.0, z), at(k + 1, 0.0, z), at(k + 1, 20.0, z)]));
        }
    }
    surfaces.extend(block(DVec3::new(14.0, 0.0, 3.0), DVec3::new(0.5, 0.7, 1.0)));
    let b = of(surfaces.clone());
    for (index, degrees) in [60.0, 110.0].into_iter().enumerate() {
        let motion = pose(degrees, index);
        let found = fit(&moved(&surfaces, &motion), &b, &BestFitOptions::default());
        let off = found.transform.apply(motion.apply(DVec3::new(14.0, 0.0, 4.0)));
        assert!(
            off.distance(DVec3::new(14.0, 0.0, 4.0)) < 1e-4 && found.rms < 1e-5,
            "{degrees}: {off} {found:?}"
        );
    }
}
