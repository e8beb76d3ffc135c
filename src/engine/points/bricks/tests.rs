//! Bricks whose values, signs and bounds follow from formulas (lemma P1).

use super::super::query::Measured;
use super::*;
use crate::engine::PreparedModel;
use crate::model::{Model, RigidTransform};
use crate::param_box::ParamBox;
use crate::shapes::operations::{part, transformed};
use crate::shapes::sphere;

/// The values of a grid that is one brick.
fn filled(model: &Model, grid: &Grid, band: f64) -> Filled {
    let model = PreparedModel::new(model).unwrap();
    let measured = Measured::new(&model, 0.0, 0.0);
    let bricks = bricks(grid);
    assert_eq!(bricks.len(), 1);
    bricks[0].fill(&measured.query().unwrap(), grid, band).unwrap()
}

fn points(grid: &Grid) -> Vec<DVec3> {
    bricks(grid)[0].indices().map(|index| grid.point(index)).collect()
}

/// The bound of a grid is on the errors of its values: far from the origin those of a unit ball about whole
/// coordinates are of the size of the last place of these.
#[test]
fn the_bound_is_on_the_errors_of_values() {
    let far = f64::from(1 << 20);
    let center = DVec3::new(far, -far, far);
    let model =
        transformed(&sphere(DVec3::ZERO, 1.0).unwrap(), &RigidTransform::translation(center).unwrap());
    let origin = (center + DVec3::new(0.25, 0.125, -0.375)).to_array();
    let grid = Grid { origin, spacing: 0.5_f64.powi(5), counts: [4; 3] };
    let found = filled(&model.unwrap(), &grid, 2.0);
    let errors = points(&grid)
        .into_iter()
        .zip(&found.values)
        .map(|(point, value)| (value.abs() - (1.0 - (point - center).length())).abs());
    let largest = errors.fold(0.0, f64::max);
    assert!(largest > 1e-12 && largest <= found.bound, "{largest} {}", found.bound);
}

/// P1 (b): in the crack between two halves of a ball, which the strip closes as a cylinder, no face is near, and
/// points on both sides of the strip have their own sides.
#[test]
fn sides_differ_across_a_strip_that_is_nearer_than_the_faces() {
    let (whole, half_width) = (sphere(DVec3::ZERO, 1.0).unwrap(), 1e-5);
    let mut surfaces = Vec::new();
    for (along, height) in [([0.0, 0.5], -half_width), ([0.5, 1.0], half_width)] {
        let half = part(&whole.surfaces()[0], ParamBox::new([0.0, 1.0], along)).unwrap();
        let moved = RigidTransform::translation(DVec3::new(0.0, 0.0, height)).unwrap();
        let half = transformed(&Model::new(None, vec![half]).unwrap(), &moved).unwrap();
        surfaces.extend(half.surfaces().iter().cloned());
    }
    let model = Model::new(None, surfaces).unwrap();
    let spacing = 0.02 * half_width;
    // The middle of the brick is inside, by a spacing.
    let first = -4.0 * spacing;
    let origin = [1.0 - 0.5 * spacing + first, first, first];
    let grid = Grid { origin, spacing, counts: [SIDE; 3] };
    let found = filled(&model, &grid, 0.1 * half_width);
    let mut decided = [0; 2];
    for (place, (point, value)) in points(&grid).into_iter().zip(&found.values).enumerate() {
        if !found.undecided.contains(&place) {
            let is_inside = point.x.hypot(point.y) < 1.0;
            assert_eq!(*value < 0.0, is_inside, "{point} {value}");
            decided[usize::from(is_inside)] += 1;
        }
    }
    assert!(decided[0] > 50 && decided[1] > 50, "{decided:?}");
}

/// The cells of a brick have each of its points once.
#[test]
fn cells_have_each_point_once() {
    for counts in [[8, 5, 3], [8, 8, 8], [1, 4, 6]] {
        let brick = Brick { first: [16, 8, 24], counts };
        let cells: Vec<Brick> = brick.divided(CELL_SIDE).collect();
        assert_eq!(cells.len(), counts.iter().map(|count| count.div_ceil(CELL_SIDE)).product::<usize>());
        let mut places: Vec<usize> =
            cells.iter().flat_map(|cell| cell.indices()).map(|index| brick.place(index)).collect();
        let of_brick: Vec<usize> = brick.indices().map(|index| brick.place(index)).collect();
        assert!(of_brick.into_iter().eq(0..counts.iter().product()), "x is fastest");
        places.sort_unstable();
        assert!(places.into_iter().eq(0..counts.iter().product()), "{counts:?}");
    }
}
