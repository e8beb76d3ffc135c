//! Where the farthest point of method `certified` is as far from several
//! patches, or known beforehand: its place found at once, its bound narrow soon.

use crate::support::cpu::measure;
use glam::{DQuat, DVec3};
use nurbs_hausdorff::internals::engine::{DistanceOptions, DistanceResult};
use nurbs_hausdorff::shapes::operations::reduce_degree;
use nurbs_hausdorff::shapes::{shape, torus};
use nurbs_hausdorff::{Axis, CertifiedOptions, Method, Model, RigidTransform, SurfaceArrays};

const ROUNDING: f64 = 1e-12;

fn measured(a: &Model, b: &Model, options: &DistanceOptions) -> (DistanceResult, usize) {
    let result = measure(a, b, options);
    let cells = result.certified().unwrap().cells;
    (result, cells)
}

/// A flat sheet about a point, from one corner along two directions, of as
/// many pieces along each.
fn sheet(middle: DVec3, [s, t]: [DVec3; 2], pieces: usize) -> SurfaceArrays {
    let place = |k: usize| 2.0 * k as f64 / pieces as f64 - 1.0;
    let knots: Vec<f64> = std::iter::once(0.0)
        .chain((0..=pieces).map(|k| k as f64))
        .chain(std::iter::once(pieces as f64))
        .collect();
    let points = (0..=pieces).flat_map(|i| (0..=pieces).map(move |j| [i, j]));
    SurfaceArrays {
        degree: [1, 1],
        knots: [knots.clone(), knots],
        counts: [pieces + 1; 2],
        control_points: points
            .map(|[i, j]| {
                let point = middle + place(i) * s + place(j) * t;
                [point.x, point.y, point.z, 1.0]
            })
            .collect(),
    }
}

/// The most cells that a tolerance a millionth as large takes more. A cell's
/// quarters have bounds too large by a quarter, so that is ten levels, of the
/// few cells around the maximum each: twelve.
const MAX_MORE: usize = 120;

/// A square sheet across a channel of three flat walls: the farthest point has
/// the same distance d to all walls. With the walls' unit normals n_k away from
/// the axis and offsets c_k, `d = c_k - n_k·x`, and as the normals' sum is zero
/// d is the offsets' mean. Weighted means of the squares are of second order
/// there, those of single walls of first.
#[test]
fn a_point_as_far_from_three_walls() {
    let offsets = [2.0, 2.1, 2.3];
    let normal = |k: usize| DQuat::from_rotation_z(0.3 + k as f64 * std::f64::consts::TAU / 3.0) * DVec3::X;
    let wall = |k: usize, pieces| {
        let along = DVec3::Z.cross(normal(k));
        sheet(offsets[k] * normal(k), [20.0 * along, 20.0 * DVec3::Z], pieces)
    };
    let turn = DQuat::from_axis_angle(DVec3::new(1.0, 2.0, -0.5).normalize(), 0.8);
    let transform = RigidTransform::new(turn, DVec3::new(0.3, -1.0, 2.0)).unwrap();
    let truth = offsets.iter().sum::<f64>() / 3.0;
    for pieces in [1, 7] {
        let walls = Model::from_arrays(None, (0..3).map(|k| wall(k, pieces)).collect()).unwrap();
        let across =
            Model::from_arrays(None, vec![sheet(DVec3::ZERO, [DVec3::X, DVec3::Y], pieces)]).unwrap();
        let walls = nurbs_hausdorff::shapes::operations::transformed(&walls, &transform).unwrap();
        let mut counts = Vec::new();
        for tolerance in [1e-4, 1e-7, 1e-10] {
            let (result, cells) = measured(
                &across,
                &walls,
                &DistanceOptions {
                    relative_tolerance: Some(tolerance),
                    transform,
                    ..DistanceOptions::default()
                },
            );
            assert!(result.converged && result.lower <= truth + ROUNDING && truth - ROUNDING <= result.upper);
            assert!((result.computed - truth).abs() <= tolerance * result.diagonal);
            counts.push(cells);
        }
        println!("{pieces}: {counts:?}");
        assert!(counts[2] - counts[0] <= MAX_MORE, "{counts:?}");
    }
}

/// A chord of a torus' circles crosses the middle of its tube, where the distance is the tube's
/// radius and a whole circle of points of the torus is as near: the witness's certificate must be
/// far narrower than the tolerance nevertheless, or the search cannot end.
#[test]
fn a_point_as_far_from_a_circle_of_points() {
    const RADIUS: f64 = 0.8;
    let ring = torus(2.0, RADIUS).unwrap();
    let chords = Model::new(None, vec![reduce_degree(&ring.surfaces()[0], Axis::U).unwrap()]).unwrap();
    for tolerance in [1e-6, 1e-8, 1e-10] {
        let options = DistanceOptions {
            method: Method::Certified(CertifiedOptions { max_cells: Some(6000), ..Default::default() }),
            relative_tolerance: Some(tolerance),
            ..DistanceOptions::default()
        };
        let (result, cells) = measured(&chords, &ring, &options);
        println!("{tolerance:e}: {cells} cells");
        assert!(result.converged, "{result:?}");
        assert!(result.lower <= RADIUS + ROUNDING && RADIUS - ROUNDING <= result.upper, "{result:?}");
    }
}

/// No point of a copy moved by t is farther than |t|, and the one farthest
/// along t is that far, as the model lies on one side of a plane through it.
#[test]
fn a_moved_copy_is_as_far_as_it_was_moved() {
    for name in ["bottle", "torus", "wavy-sheet", "naca-wing", "cylinder", "glass", "net-6x6"] {
        let model = shape(name).unwrap();
        let size = model.bounding_box().diagonal();
        for way in [DVec3::new(0.3, 0.1, 0.2), DVec3::new(-0.02, 0.01, 0.005), DVec3::new(0.0, 0.0, 1.5)] {
            let way = size * way;
            let transform = RigidTransform::translation(way).unwrap();
            let (result, cells) =
                measured(&model, &model, &DistanceOptions { transform, ..DistanceOptions::default() });
            let DistanceResult { lower, upper, .. } = result;
            let truth = way.length();
            assert!(result.converged, "{name}");
            assert!(lower <= truth + ROUNDING * size && truth - ROUNDING * size <= upper, "{name} {way}");
            assert!(cells <= MAX_CELLS, "{name} {way}: {cells}");
        }
    }
}

/// Cells for a moved copy, at most: its farthest point is looked for at once,
/// and the bound needs none.
const MAX_CELLS: usize = 100;
