//! The bound by bilinear interpolation: cells whose nearest patch changes inside.
//!
//! Lemma (3.9 of docs/method.md). Let the vertices x_k of a convex polygon of a cell have feet b_k on
//! one and the same patch P. Then every point of the polygon is within
//! `max |a_k - b_k| + δ_A + δ_B` of P, with
//! `δ = ⅛ (Δ_u² M_uu + 2 Δ_u Δ_v M_uv + Δ_v² M_vv)` over the cell, and over the
//! (u, v) box of the feet.
//!
//! A cell whose corners prefer two patches is cut into two polygons along the
//! bisector of the patches. That is of second order for any kind of join, with
//! no knowledge of how the patches meet.

use super::super::nearest::Foot;
use super::super::rounding::UNIT_ROUNDOFF;
use crate::bezier::DerivativeBounds;
use crate::certified::audit::Lemma;
use crate::certified::cell_context::{CellContext, UpperBound};
use glam::DVec3;

/// Distance of the centre's foot, in radii of the cell, up to which the bound is
/// tried: farther away the convex combination is as close and costs less.
const MAX_DISTANCE_IN_RADII: f64 = 0.5;

/// Bound on the secant steps towards the bisector. Wherever they stop is valid.
const MAX_SECANT_STEPS: usize = 6;

/// Difference of two distances, relative to δ_A, at which more steps are of no use.
const CROSSING_TOLERANCE: f64 = 0.05;

/// The least part of the bracket that a secant step takes, so that the bracket shrinks.
const MIN_FRACTION: f64 = 1e-3;

/// Width of the slivers between two polygons, as the crossings are rounded, in
/// units of the cell's radius (lemma R14).
const SLIVER_ROUNDINGS: f64 = 4.0;

/// The cell's corners in [-1, 1]^2, around it.
const CORNERS: [[f64; 2]; 4] = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];

/// A place of a polygon's vertex in [-1, 1]^2, with feet on both patches.
type Vertex = ([f64; 2], [Foot; 2]);

/// The bound by the corners of the cell.
pub(super) struct Bilinear;

impl UpperBound for Bilinear {
    fn lemma(&self) -> Lemma {
        Lemma::Bilinear
    }

    fn evaluate(&self, context: &mut CellContext<'_>, threshold: f64) -> Option<f64> {
        let foot = context.foot();
        if foot.distance() > MAX_DISTANCE_IN_RADII * context.radius {
            return None;
        }
        let cell_error = cell_error(context.local_bounds(), context.cell.half, context.radius);
        let mut corners = Corners { context, cell_error };
        corners.upper_bound(&foot, threshold)
    }
}

/// The corners of a cell of A against B.
struct Corners<'a, 'c> {
    context: &'a mut CellContext<'c>,
    /// δ_A of the whole cell.
    cell_error: f64,
}

impl Corners<'_, '_> {
    /// Whether the bound can reach the threshold, which it cannot below the
    /// distance of a corner's foot plus δ_A.
    fn may_suffice(&self, foot: &Foot, threshold: f64) -> bool {
        foot.distance() + self.cell_error <= threshold
    }

    /// The lemma's bound; `None` where the corners prefer more than two patches
    /// or one of them is too far for the threshold.
    ///
    /// Feet are valid on any patch, so none is searched for while a known one
    /// is near enough.
    fn upper_bound(&mut self, center: &Foot, threshold: f64) -> Option<f64> {
        let mut own = CORNERS.map(|corner| self.foot(corner, center));
        let mut other: Option<Foot> = None;
        for (&corner, own) in CORNERS.iter().zip(&mut own) {
            let mut foot = other.map_or(*own, |other| nearer(*own, self.foot(corner, &other)));
            if !self.may_suffice(&foot, threshold) {
                foot = self.context.nearest.nearest(self.point(corner), foot, 0.0);
            }
            self.observe(corner, foot);
            if !self.may_suffice(&foot, threshold) {
                return None;
            }
            if foot.patch == own.patch {
                *own = foot;
            } else if other.is_some_and(|other| other.patch != foot.patch) {
                return None;
            } else {
                other = Some(foot);
            }
        }
        let Some(other) = other else { return Some(self.polygon(&own)) };
        self.two_polygons(own, CORNERS.map(|corner| self.foot(corner, &other)), threshold)
    }

    /// The bound by two patches, each for the corners that are nearer to it.
    fn two_polygons(&mut self, own: [Foot; 4], others: [Foot; 4], threshold: f64) -> Option<f64> {
        let vertex = |index: usize| (CORNERS[index], [own[index], others[index]]);
        let side = |[own, other]: &[Foot; 2]| usize::from(own.distance_squared > other.distance_squared);
        let mut polygons: [Vec<Foot>; 2] = [Vec::with_capacity(6), Vec::with_capacity(6)];
        let mut crossings = 0;
        for index in 0..CORNERS.len() {
            let (here, next) = (vertex(index), vertex((index + 1) % CORNERS.len()));
            let [from, to] = [side(&here.1), side(&next.1)];
            polygons[from].push(here.1[from]);
            if from != to {
                crossings += 1;
                let (place, feet) = self.crossing(here, next);
                let near = nearer(feet[0], feet[1]);
                self.observe(place, near);
                if !self.may_suffice(&near, threshold) {
                    return None;
                }
                for (polygon, foot) in polygons.iter_mut().zip(feet) {
                    polygon.push(foot);
                }
            }
        }
        // More crossings do not leave two convex polygons.
        (crossings <= 2).then(|| self.polygon(&polygons[0]).max(self.polygon(&polygons[1])))
    }

    /// The foot of a place on a patch, from a foot on it nearby.
    fn foot(&self, place: [f64; 2], near: &Foot) -> Foot {
        self.context.nearest.on_patch(self.point(place), near.patch, near.parameters)
    }

    fn point(&self, place: [f64; 2]) -> DVec3 {
        let cell = &self.context.cell;
        self.context.pair.point_of_a(cell.patch, cell.at(place))
    }

    fn observe(&mut self, place: [f64; 2], foot: Foot) {
        let parameters = self.context.cell.at(place);
        self.context.observe(parameters, foot);
    }

    /// The place between two corners, each nearer to another of two
    /// patches, where both are about equally far: by a safeguarded secant method
    /// on the difference of the distances.
    fn crossing(&self, from: Vertex, to: Vertex) -> Vertex {
        let at = |x: f64| [0, 1].map(|axis| (1.0 - x) * from.0[axis] + x * to.0[axis]);
        // Distances, not their squares: on overlapping sheets these grow linearly from the join.
        let difference = |[own, other]: &[Foot; 2]| own.distance() - other.distance();
        let (mut low, mut high) = (0.0, 1.0);
        let (mut at_low, mut at_high) = (difference(&from.1), difference(&to.1));
        let mut vertex = to;
        for _ in 0..MAX_SECANT_STEPS {
            let fraction = at_low / (at_low - at_high);
            let inside =
                if fraction.is_finite() { fraction.clamp(MIN_FRACTION, 1.0 - MIN_FRACTION) } else { 0.5 };
            let x = low + inside * (high - low);
            let place = at(x);
            vertex = (place, vertex.1.map(|foot| self.foot(place, &foot)));
            let difference = difference(&vertex.1);
            if difference.abs() <= CROSSING_TOLERANCE * self.cell_error {
                break;
            }
            if (difference < 0.0) == (at_low < 0.0) {
                (low, at_low) = (x, difference);
            } else {
                (high, at_high) = (x, difference);
            }
        }
        vertex
    }

    /// The lemma's bound for one polygon, 0 for an empty one.
    fn polygon(&self, feet: &[Foot]) -> f64 {
        let Some(Foot { patch, .. }) = feet.first() else { return 0.0 };
        let mut farthest = 0.0_f64;
        let (mut low, mut high) = ([1.0_f64; 2], [0.0_f64; 2]);
        for foot in feet {
            farthest = farthest.max(foot.distance_squared);
            for axis in 0..2 {
                low[axis] = low[axis].min(foot.parameters[axis]);
                high[axis] = high[axis].max(foot.parameters[axis]);
            }
        }
        let extent = [0, 1].map(|axis| (high[axis] - low[axis]).max(0.0));
        let bounds = self.context.pair.b.bounds(*patch, low, high);
        farthest.sqrt() + self.cell_error + interpolation_error(&bounds, extent)
    }
}

fn nearer(one: Foot, other: Foot) -> Foot {
    if other.distance_squared < one.distance_squared { other } else { one }
}

/// δ_A over a cell of these half-widths and this radius, with the width of the slivers between two
/// polygons.
fn cell_error(bounds: &DerivativeBounds, half: [f64; 2], radius: f64) -> f64 {
    SLIVER_ROUNDINGS * UNIT_ROUNDOFF * radius + interpolation_error(bounds, half.map(|half| 2.0 * half))
}

/// δ of the lemma over a box of this extent in the parameters.
fn interpolation_error(bounds: &DerivativeBounds, [u, v]: [f64; 2]) -> f64 {
    let [uu, uv, vv] = bounds.second;
    (u * u * uu + 2.0 * u * v * uv + v * v * vv) / 8.0
}

#[cfg(all(test, not(target_arch = "wasm32")))]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod tests {
    use super::*;
    use crate::certified::Cell;
    use crate::certified::testing::{Net, PatchModel, assert_attained, evaluate, graph, plane, point};

    /// Linear interpolation over a triangle of the unit square is off by 1/4 at
    /// the middle of an edge for s² and t², and in the middle of the diagonal for s t.
    #[test]
    fn the_error_of_interpolation_is_attained() {
        for (second, error) in [
            ([2.0, 0.0, 0.0], 0.25),
            ([0.0, 1.0, 0.0], 0.25),
            ([0.0, 0.0, 2.0], 0.25),
            ([2.0, 1.0, 2.0], 0.75),
        ] {
            let bounds = DerivativeBounds { second, ..DerivativeBounds::default() };
            assert_eq!(interpolation_error(&bounds, [1.0, 1.0]), error);
        }
        let bounds = DerivativeBounds { second: [2.0, 1.0, 2.0], ..DerivativeBounds::default() };
        // Over [0, 2] x [0, 1/2] s² is off by 1, s t by 1/4 and t² by 1/16.
        assert_eq!(interpolation_error(&bounds, [2.0, 0.5]), 1.3125);
    }

    /// Lemma R14: the slivers are four roundings of the cell's radius wide.
    #[test]
    fn the_error_of_a_cell_adds_the_slivers() {
        let flat = DerivativeBounds::default();
        let bent = DerivativeBounds { second: [2.0, 0.0, 0.0], ..flat };
        for radius in [0.25, 8.0] {
            assert_eq!(cell_error(&flat, [0.5; 2], radius), 4.0 * UNIT_ROUNDOFF * radius);
            assert_eq!(cell_error(&bent, [0.5; 2], radius), 0.25 + 4.0 * UNIT_ROUNDOFF * radius);
        }
    }

    /// A square between two points, each nearer to two of its corners: the farthest
    /// points are corners of one of the polygons, or those where both are equally near.
    #[test]
    fn two_polygons_are_bounded_by_their_vertices() {
        let a = PatchModel::new(&[graph(0.0, 0.0, [1, 1])]);
        for [first, second] in [[0.25, 0.8], [0.4, 0.9], [0.1, 0.6]] {
            let middle: f64 = 0.5 * (first + second);
            let distance = [first, middle - first, 1.0 - second].into_iter().fold(0.0, f64::max).hypot(0.5);
            for points in [[first, second], [second, first]] {
                let [along_s, along_t] =
                    [points.map(|s| point([s, 0.5, 0.0])), points.map(|t| point([0.5, t, 0.0]))];
                for b in [along_s, along_t] {
                    let threshold = distance * (1.0 + 1e-3);
                    let bound = evaluate(&Bilinear, &a, &PatchModel::new(&b), Cell::whole(0), threshold);
                    assert_attained(bound.unwrap(), distance, 1e-3);
                }
            }
        }
    }

    /// An arch over a plane, with its corners at the least height: `δ_A` is the
    /// height of the arch. Then the plane over an arch, with `δ_B`.
    #[test]
    fn bilinear_over_and_under_an_arch() {
        let arch = |axis: usize, height: f64, rise: f64| -> Net {
            let (mut net, z) = (graph(height, 0.0, [2, 2]), [height, height + 2.0 * rise, height]);
            for (index, control) in net.1.iter_mut().enumerate() {
                control.z = z[[index / 3, index % 3][axis]];
            }
            net
        };
        for axis in [0, 1] {
            let a = PatchModel::new(&[arch(axis, 0.1, 0.1)]);
            let b = PatchModel::new(&[plane([-2.0, 3.0])]);
            assert_attained(evaluate(&Bilinear, &a, &b, Cell::whole(0), 0.35).unwrap(), 0.2, 1e-9);
            // Two patches that join across s; where the arch is along s, the places
            // at which its edges cross the join are near its top; along t, they are off
            // the join by the tolerance of the secant steps.
            let b = PatchModel::new(&[plane([-2.0, 0.4]), plane([0.4, 3.0])]);
            let bound = evaluate(&Bilinear, &a, &b, Cell::whole(0), 0.35).unwrap();
            assert_attained(bound, 0.2, [0.5, 0.02][axis]);
            let flat = PatchModel::new(&[graph(0.0, 0.0, [1, 1])]);
            let b = PatchModel::new(&[arch(axis, 1e-5, 1e-4)]);
            let bound = evaluate(&Bilinear, &flat, &b, Cell::whole(0), 1.0).unwrap();
            assert_attained(bound * (1.0 + 1e-6), 1.1e-4, 1e-3);
        }
    }
}
