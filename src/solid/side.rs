//! The shells of a solid's boundary that enclose a point, and its side.

use super::joining::ShellState;
use super::ray::Ray;
use super::winding::{Obstacle, is_clear, patch_winding};
use super::{Boundary, Enclosing};
use crate::closest::Target;
use crate::rounding::gamma;
use glam::DVec3;
use serde::Serialize;

/// The number of rays tried from a point: near an edge many meet its strip, in general position
/// one suffices.
const MAX_RAYS: u64 = 24;

/// The roundings of a coordinate along a ray, relative to the largest length (lemma S3 of
/// docs/solids.md).
const COORDINATE_ROUNDINGS: f64 = 64.0;

/// The side on which a point lies.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize)]
#[serde(rename_all = "kebab-case")]
#[non_exhaustive]
pub enum Side {
    /// Inside the solid.
    Inside,
    /// Outside the solid.
    Outside,
    /// Not decided: on the boundary, in a crack between faces, so near to an edge that no ray avoids
    /// it for certain, or within shells of which it is not known whether one is a void.
    Undecided,
}

impl Boundary {
    /// Returns the shells that enclose a point, by the parity with which a ray crosses each; `None`
    /// where that is not certain.
    ///
    /// Guarantee (lemma S2 of docs/solids.md): they are never wrong for the sets that the faces of each
    /// shell and the strips between its joined edges bound. `target` has the patches of the model that
    /// this is the boundary of. It holds for all points within `error` of the one given. O(√patches) a
    /// ray in general position.
    pub(crate) fn enclosing(&self, target: &Target, point: DVec3, error: f64) -> Option<Enclosing> {
        if self.is_closed() { self.enclosing_closed(target, point, error) } else { None }
    }

    /// Returns whether one shell encloses a point, where that is certain: the others may be open. `target` has the
    /// patches of that shell alone. As [`Boundary::enclosing`].
    pub(crate) fn encloses(&self, shell: u32, target: &Target, point: DVec3, error: f64) -> Option<bool> {
        if self.joined().of_shell[shell as usize].free > 0 {
            return None;
        }
        self.enclosing_closed(target, point, error).map(|around| around.has(shell))
    }

    /// Returns how often a shell winds about a point, by the sides of its first surface, where that is certain; `target`
    /// may have the patches of other shells too. As [`Boundary::enclosing`].
    ///
    /// Guarantee (lemma S7 of docs/solids.md): a closed surface that does not meet itself winds about all points with
    /// the numbers 0 and 1, or 0 and -1. Two rays must agree.
    pub(crate) fn winding(&self, shell: u32, target: &Target, point: DVec3, error: f64) -> Option<i32> {
        let ShellState { is_one_sided, free, .. } = self.joined().of_shell[shell as usize];
        if is_one_sided || free > 0 {
            return None;
        }
        let by_ray = |first: usize| {
            let crossings = self.crossings(target, point, error, (0..MAX_RAYS).skip(first).step_by(2))?;
            let of_shell = crossings.iter().filter(|crossing| crossing.0 == shell);
            Some(of_shell.map(|crossing| crossing.1).sum::<i32>())
        };
        by_ray(0).filter(|&winding| by_ray(1) == Some(winding))
    }

    /// As [`Boundary::enclosing`] for patches of shells that close.
    fn enclosing_closed(&self, target: &Target, point: DVec3, error: f64) -> Option<Enclosing> {
        self.crossings(target, point, error, 0..MAX_RAYS).map(|crossings| enclosing(&crossings))
    }

    /// Returns the crossings of the first of these rays from a point that meets no edge.
    fn crossings(
        &self,
        target: &Target,
        point: DVec3,
        error: f64,
        rays: impl Iterator<Item = u64>,
    ) -> Option<Vec<Crossing>> {
        if !point.is_finite() {
            return None;
        }
        let margin = self.margin_at(point) + error;
        // Beyond the box of all that a ray may meet, the ray away from it meets nothing.
        let all = target.tree.bounding_box().union(self.strip_tree.bounding_box());
        if all.grown(margin).min_distance_squared(point) > 0.0 {
            return Some(Vec::new());
        }
        for direction in rays.map(direction) {
            match self.crossed(target, &Ray::new(point, direction, margin)) {
                Ok(crossings) => return Some(crossings),
                Err(Obstacle::OnTheWay) => {}
                Err(Obstacle::AtTheEnd) => return None,
            }
        }
        None
    }

    /// Returns the shells that enclose a point as [`Boundary::enclosing`] does, from those of another
    /// one: by the faces that the segment between them crosses, or a ray where that may meet an edge.
    /// Of a segment along a face only a few patches are near.
    pub(crate) fn enclosing_beside(
        &self,
        target: &Target,
        point: DVec3,
        (other, shells): (DVec3, &Enclosing),
    ) -> Option<Enclosing> {
        let margin = self.margin_at(point) + self.margin_at(other);
        match self.crossed(target, &Ray::segment(point, other, margin)) {
            Ok(crossed) => Some(shells.clone().across(&enclosing(&crossed))),
            Err(_) => self.enclosing(target, point, 0.0),
        }
    }

    /// Returns true only if the segment between two points, each known up to `error`, certainly has no points of the
    /// patches and strips: all of its points lie on one side (lemma S4 of docs/solids.md).
    pub(crate) fn is_clear(&self, target: &Target, [start, end]: [DVec3; 2], error: f64) -> bool {
        let margin = self.margin_at(start) + self.margin_at(end) + error;
        let ray = Ray::segment(start, end, margin);
        ray.leaves(&self.strip_tree).into_iter().all(|strip| self.strips[strip as usize].is_avoided(&ray))
            && ray
                .leaves(&target.tree)
                .into_iter()
                .all(|patch| is_clear(&target.patches.patch(patch as usize), &ray))
    }

    /// Returns an upper bound on the error of a coordinate along a ray from a point.
    pub(crate) fn margin_at(&self, point: DVec3) -> f64 {
        self.margin + gamma(COORDINATE_ROUNDINGS) * point.length()
    }

    /// Returns the crossings of the ray with patches, if it certainly meets no strip and no edge of a patch.
    fn crossed(&self, target: &Target, ray: &Ray) -> Result<Vec<Crossing>, Obstacle> {
        let strips = ray.leaves(&self.strip_tree);
        if !strips.into_iter().all(|strip| self.strips[strip as usize].is_avoided(ray)) {
            return Err(Obstacle::OnTheWay);
        }
        let mut crossings = Vec::new();
        for patch in ray.leaves(&target.tree) {
            let patch = target.patches.patch(patch as usize);
            let winding = patch_winding(&patch, ray)?;
            if winding != 0 {
                let sign = if self.joined().turned[patch.surface] { -1 } else { 1 };
                crossings.push((self.shells()[patch.surface], sign * winding));
            }
        }
        Ok(crossings)
    }
}

/// A shell that a ray crosses, and how often along the normals of the shell's first surface less against them.
type Crossing = (u32, i32);

/// Returns the shells that are crossed an odd number of times.
fn enclosing(crossings: &[Crossing]) -> Enclosing {
    let mut shells = Enclosing::default();
    crossings.iter().filter(|(_, winding)| winding % 2 != 0).for_each(|&(shell, _)| shells.cross(shell));
    shells
}

/// Returns a direction of length 1, the same at every call: points of a Fibonacci spiral, turned so
/// that no axis of a model is near one.
fn direction(index: u64) -> DVec3 {
    // The multiples of these irrational numbers fill the unit square evenly (the plastic number).
    const STEPS: [f64; 2] = [0.754_877_666_246_692_8, 0.569_840_290_998_053_3];
    let [height, turn] = STEPS.map(|step| (0.5 + step * (index + 1) as f64).fract());
    let z = 2.0 * height - 1.0;
    let (sin, cos) = (std::f64::consts::TAU * turn).sin_cos();
    let radius = (1.0 - z * z).sqrt();
    DVec3::new(radius * cos, radius * sin, z).normalize()
}

#[cfg(all(test, not(target_arch = "wasm32")))]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod tests {
    use super::*;
    use crate::bezier::extract;
    use crate::model::{Model, SurfaceArrays};
    use crate::rounding::UNIT_ROUNDOFF;
    use crate::solid::{Edges, SurfaceOrigin};

    /// The first faces of the cube [-1, 1]³.
    fn cube(faces: usize) -> (Target, Boundary) {
        let face = |index: usize| {
            let end = [-1.0, 1.0][index % 2];
            let corner = |[a, b]: [f64; 2]| {
                let mut point = DVec3::new(end, a, b);
                (0..index / 2).for_each(|_| point = DVec3::new(point.z, point.x, point.y));
                [point.x, point.y, point.z, 1.0]
            };
            let knots = vec![0.0, 0.0, 1.0, 1.0];
            let control_points = [[-1.0, -1.0], [-1.0, 1.0], [1.0, -1.0], [1.0, 1.0]].map(corner).to_vec();
            SurfaceArrays { degree: [1, 1], knots: [knots.clone(), knots], counts: [2, 2], control_points }
        };
        let model = Model::from_arrays(None, (0..faces).map(face).collect()).unwrap();
        let (bezier, control_box) = (extract(&model), model.bounding_box());
        let edges = Edges::of_surfaces(&bezier, SurfaceOrigin::whole);
        let boundary = Boundary::new(edges, bezier.point_error, &control_box, 0.0, 1);
        (Target::new(bezier.patches), boundary)
    }

    /// The side of a point of a model with one shell.
    fn found_side(boundary: &Boundary, target: &Target, point: DVec3, error: f64) -> Side {
        let side = |shells: Enclosing| if shells.has(0) { Side::Inside } else { Side::Outside };
        boundary.enclosing(target, point, error).map_or(Side::Undecided, side)
    }

    /// A point that is known up to an error has a side only if all points as near have it. Heights
    /// above a face count beyond twice the margin.
    #[test]
    fn the_error_of_a_point_counts() {
        let (target, boundary) = cube(6);
        for (x, side) in [(1.001, Side::Outside), (0.999, Side::Inside)] {
            for (error, expected) in [(0.0, side), (0.45e-3, side), (1.1e-3, Side::Undecided)] {
                let found = found_side(&boundary, &target, DVec3::new(x, 0.2, -0.3), error);
                assert_eq!(found, expected, "{x} within {error}");
            }
        }
    }

    /// Beyond the box of the cube, grown by the margin and the error of the point, no ray is needed; within it one is.
    #[test]
    fn a_point_beyond_the_box_needs_no_ray() {
        let (target, boundary) = cube(6);
        let without_rays = |x: f64, error: f64| {
            let point = DVec3::new(x, 0.2, -0.3);
            boundary.crossings(&target, point, error, std::iter::empty()).map(|crossings| crossings.len())
        };
        for error in [0.0, 1e-3] {
            let reach = boundary.margin_at(DVec3::X) + error;
            for x in [1.0, -1.0] {
                assert_eq!(without_rays(x * (1.0 + 2.0 * reach), error), Some(0), "{x} within {error}");
                assert_eq!(without_rays(x * (1.0 + 0.5 * reach), error), None, "{x} within {error}");
            }
        }
        assert_eq!(without_rays(f64::INFINITY, 0.0), None);
    }

    /// All rays count the same, whichever way they go.
    #[test]
    fn a_cube_winds_about_points_inside_once() {
        let (target, boundary) = cube(6);
        let winding = |x: f64, y: f64, z: f64| boundary.winding(0, &target, DVec3::new(x, y, z), 0.0);
        let inside = winding(0.1, 0.2, 0.3).unwrap();
        assert_eq!(inside.abs(), 1);
        for k in 0..64 {
            let [x, y, z] = [0.37, 0.61, 0.83].map(|step| 1.9 * (step * f64::from(k)).fract() - 0.95);
            assert_eq!(winding(x, y, z), Some(inside), "{k}");
            assert_eq!(winding(x + 2.0, y, z), Some(0), "{k}");
        }
        assert_eq!(cube(5).1.winding(0, &cube(5).0, DVec3::ZERO, 0.0), None, "open");
    }

    #[test]
    fn a_model_that_is_open_has_no_sides() {
        let (target, boundary) = cube(5);
        assert_eq!(boundary.free_edges().len(), 4);
        assert_eq!(found_side(&boundary, &target, DVec3::ZERO, 0.0), Side::Undecided);
        let (target, boundary) = cube(6);
        assert_eq!(found_side(&boundary, &target, DVec3::ZERO, 0.0), Side::Inside);
    }

    /// The last term of m in lemma S3, that of the point's own length.
    #[test]
    fn the_margin_grows_with_the_distance_from_the_origin() {
        let (_, boundary) = cube(6);
        let found = boundary.margin_at(1e9 * DVec3::new(0.6, 0.0, 0.8)) - boundary.margin_at(DVec3::ZERO);
        let expected = UNIT_ROUNDOFF * 64.0 * 1e9;
        assert!(expected <= found && found <= 1.02 * expected, "{found:e}");
    }
}
