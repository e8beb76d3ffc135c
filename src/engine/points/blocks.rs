//! Blocks of points, and layers of grids, that workers measure beside each other: WebAssembly has one thread a module.

use super::bricks::SIDE;
use super::closest_points::{ClosestPointOptions, ClosestPoints, closest_points_along, require_in_range};
use super::order::along_curve;
use super::signed_distances::{Layers, SignedDistanceOptions, layers};
use crate::engine::{Computation, Engine, PreparedModel};
use crate::error::Result;
use crate::threads::parallel::RANGE_LENGTH;
use std::ops::Range;

/// The number of points of a block: some tens of milliseconds of work, to which a message is nothing, and few enough
/// that workers end at nearly the same time.
pub(crate) const BLOCK: usize = 2 * RANGE_LENGTH;

/// Returns the order in which [`Engine::closest_points`] measures points, x, y, z each.
///
/// # Errors
/// [`crate::Error::PointOutOfRange`].
pub(crate) fn measuring_order(points: &[f64]) -> Result<Vec<u32>> {
    require_in_range(points)?;
    Ok(along_curve(points))
}

/// Returns the number of layers of bricks along z of a grid about a model.
///
/// # Errors
/// [`crate::Error::OptionOutOfRange`]; [`crate::Error::OptionInvalid`].
pub(crate) fn layers_of_grid(model: &PreparedModel, options: &SignedDistanceOptions) -> Result<usize> {
    Ok(options.grid_about(&model.bounding_box())?.counts[2].div_ceil(SIDE))
}

impl Engine {
    /// Returns the closest points of a model to `points`, measured in the order in which they are given.
    ///
    /// Guarantee: of [`BLOCK`] points, or the rest, that follow each other in [`measuring_order`] from a multiple of
    /// [`BLOCK`] on, the results are those of [`Engine::closest_points`] of all points, bit for bit: there too no
    /// range of [`RANGE_LENGTH`] points knows another one.
    ///
    /// # Errors
    /// Those of [`Engine::closest_points`].
    pub(crate) fn closest_points_of_block<'a>(
        &'a self,
        model: &'a PreparedModel,
        points: &'a [f64],
        options: &'a ClosestPointOptions,
    ) -> Computation<'a, ClosestPoints> {
        Computation::new(move |mut watched| {
            Box::pin(async move {
                let order: Vec<u32> = (0..(points.len() / 3) as u32).collect();
                closest_points_along(model, points, &order, options, None, watched.monitor()).await
            })
        })
    }

    /// Returns the signed distances of a range of the layers of bricks of a grid.
    ///
    /// Guarantee: those of [`Engine::signed_distances`], bit for bit, whose bound is the largest of all layers and the
    /// largest rounding: no brick knows another one.
    ///
    /// # Errors
    /// Those of [`Engine::signed_distances`].
    pub(crate) fn signed_distances_of_layers<'a>(
        &'a self,
        model: &'a PreparedModel,
        options: &'a SignedDistanceOptions,
        range: Range<usize>,
    ) -> Computation<'a, Layers> {
        Computation::new(move |mut watched| {
            Box::pin(async move { layers(model, options, range, watched.monitor()).await })
        })
    }
}

#[cfg(all(test, feature = "shapes", not(target_arch = "wasm32")))]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod tests {
    use super::*;
    use crate::engine::points::grid::GridOptions;
    use crate::engine::points::signed_distances::Precision;
    use crate::shapes::{shape, sphere};
    use glam::DVec3;

    /// Points spread by multiples of irrational numbers over the box [-1, 1]³, in no order.
    fn spread(count: usize) -> Vec<f64> {
        const STEPS: [f64; 3] = [0.754_877_666_246_692_7, 0.569_840_290_998_053_3, 0.381_966_011_250_105];
        let coordinate = |index: usize, step: f64| 2.0 * (index as f64 * step).fract() - 1.0;
        (0..count).flat_map(|index| STEPS.map(|step| coordinate(index, step))).collect()
    }

    #[test]
    fn blocks_have_the_results_of_the_whole() {
        let engine = Engine::cpu();
        let model = PreparedModel::new(&shape("torus").unwrap()).unwrap();
        let options = ClosestPointOptions::default();
        let points = spread(2 * BLOCK + 100);
        let whole = engine.closest_points(&model, &points, &options).wait().unwrap();
        let order = measuring_order(&points).unwrap();
        assert_eq!(order.len(), 2 * BLOCK + 100);
        for indices in order.chunks(BLOCK) {
            let block: Vec<f64> =
                indices.iter().flat_map(|&index| points[3 * index as usize..][..3].to_vec()).collect();
            let part = engine.closest_points_of_block(&model, &block, &options).wait().unwrap();
            assert_eq!(part.signs, whole.signs);
            for (place, &index) in indices.iter().enumerate() {
                let index = index as usize;
                assert_eq!(part.distances[place].to_bits(), whole.distances[index].to_bits());
                assert_eq!(part.bounds[place].to_bits(), whole.bounds[index].to_bits());
                assert_eq!(part.signed[place].to_bits(), whole.signed[index].to_bits());
                assert_eq!(part.feet[3 * place..][..3], whole.feet[3 * index..][..3]);
                assert_eq!(part.faces[place], whole.faces[index]);
                assert_eq!(part.parameters[2 * place..][..2], whole.parameters[2 * index..][..2]);
            }
        }
        // Points are refused before they are shared out, by their own index.
        let wrong = [0.0, 0.0, 0.0, 0.0, f64::NAN, 0.0];
        assert!(matches!(measuring_order(&wrong), Err(crate::Error::PointOutOfRange { index: 1, .. })));
    }

    #[test]
    fn layers_have_the_results_of_the_whole() {
        let engine = Engine::cpu();
        let model = PreparedModel::new(&sphere(DVec3::ZERO, 1.0).unwrap()).unwrap();
        let grid = GridOptions { spacing: Some(0.25), counts: Some([3, 9, 18]), ..GridOptions::default() };
        let precision = Precision::Float32;
        let options =
            SignedDistanceOptions { grid, band: Some(1.0), precision, ..SignedDistanceOptions::default() };
        let whole = engine.signed_distances(&model, &options).wait().unwrap();
        let count = layers_of_grid(&model, &options).unwrap();
        // 18 points in layers of 8.
        assert_eq!(count, 3);
        let (mut values, mut undecided) = (Vec::new(), Vec::new());
        let (mut bound, mut rounding, mut measured) = (0.0_f64, 0.0_f64, 0);
        for layer in 0..count {
            let range = layer..layer + 1;
            let Layers { found, rounding: own } =
                engine.signed_distances_of_layers(&model, &options, range).wait().unwrap();
            values.extend(found.values);
            undecided.extend(found.undecided);
            bound = crate::rounding::upper_max(bound, found.bound);
            rounding = crate::rounding::upper_max(rounding, own);
            measured += found.measured;
        }
        assert_eq!(values, whole.values);
        assert_eq!(undecided, whole.undecided);
        assert_eq!((bound + rounding).to_bits(), whole.bound.to_bits());
        assert_eq!(measured, whole.measured);
    }
}
