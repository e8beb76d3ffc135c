//! Meshes and clouds with what is computed from them once.

use super::patches::{patches, point_error};
use super::{Facet, FacetTarget, Facets, MeshGroup, TriangleMesh};
use crate::area::Area;
use crate::bezier::{BezierModel, PointError};
use crate::rounding::{VANISHING_LENGTH, gamma};
use crate::solid::Joined;
use crate::threads::computed;
use glam::DVec3;
use std::ops::Range;
use std::sync::{Arc, OnceLock};

/// The largest number of triangles whose edges are joined: a million take gigabytes.
const MAX_JOINED_TRIANGLES: usize = 250_000;

/// The facets of a model.
#[derive(Debug)]
pub(crate) struct PreparedFacets {
    pub(crate) target: FacetTarget,
    /// The distance of the coordinates from the exact ones: 0 unless they were scaled.
    pub(crate) error: f64,
    /// The groups, at least one: a cloud is one group.
    groups: Arc<[Group]>,
    /// The triangles as patches, made at their first use.
    bezier: OnceLock<BezierModel>,
    /// The trees of the groups if there are several, made at their first use.
    targets: OnceLock<Vec<FacetTarget>>,
}

/// Facets that follow each other in their model.
#[derive(Debug)]
pub(crate) struct Group {
    pub(crate) name: Option<String>,
    pub(crate) facets: Range<usize>,
}

impl PreparedFacets {
    pub(crate) fn new(facets: &Facets) -> Self {
        let (target, groups) = match facets {
            Facets::Mesh(mesh) => (FacetTarget::of_mesh(mesh), groups(mesh)),
            Facets::Cloud(cloud) => {
                let facets = 0..cloud.points().len();
                (FacetTarget::of_cloud(cloud), vec![Group { name: None, facets }])
            }
        };
        Self::with(target, 0.0, groups.into())
    }

    fn with(target: FacetTarget, error: f64, groups: Arc<[Group]>) -> Self {
        Self { target, error, groups, bezier: OnceLock::new(), targets: OnceLock::new() }
    }

    /// Returns the facets in coordinates that are `factor` times as large, with their rounding.
    pub(crate) fn scaled(&self, factor: f64) -> Self {
        let target = self.target.scaled(factor);
        let error = factor * self.error + gamma(2.0) * target.bounding_box().farthest_from_origin();
        Self::with(target, error + VANISHING_LENGTH, Arc::clone(&self.groups))
    }

    /// Returns the groups, which are the faces of the model.
    pub(crate) fn groups(&self) -> &[Group] {
        &self.groups
    }

    /// Returns the group of a facet, by its index in the model. O(log groups).
    pub(crate) fn group(&self, index: usize) -> usize {
        self.groups.partition_point(|group| group.facets.end <= index)
    }

    /// Returns the facets of each group with a tree of their own; the index of a facet there is that
    /// in the model less the group's first. O(n log n) at first use.
    pub(crate) fn targets(&self) -> &[FacetTarget] {
        if self.groups.len() == 1 {
            return std::slice::from_ref(&self.target);
        }
        computed::<Vec<FacetTarget>>(&self.targets, || self.target.of_groups(&self.groups))
    }

    pub(crate) fn bezier(&self) -> &BezierModel {
        self.bezier.get_or_init(|| BezierModel {
            patches: patches(&self.target),
            grids: Vec::new(),
            point_error: self.point_error(),
        })
    }

    /// Returns the error of points of the triangles' patches.
    pub(crate) fn point_error(&self) -> PointError {
        let mut point_error = point_error(&self.target);
        point_error.include_deviation(self.error);
        point_error
    }

    /// Returns whether these are triangles, not too many to be joined.
    pub(crate) fn may_close(&self) -> bool {
        !self.target.is_cloud() && self.target.len() <= MAX_JOINED_TRIANGLES
    }

    /// Returns the corners of the triangles in the order of their file, with the places of their
    /// patches; none if they are too many to be joined.
    pub(crate) fn joined_triangles(&self) -> impl Iterator<Item = (usize, [DVec3; 3])> + '_ {
        let places = if self.may_close() { self.target.places() } else { Vec::new() };
        places.into_iter().filter_map(|place| match self.target.facet(place) {
            Facet::Triangle(corners) => Some((place as usize, corners)),
            Facet::Point(_) => None,
        })
    }

    /// Returns the triangles that share edges of the same two vertices, by their places; none of a cloud. O(n).
    pub(crate) fn joined_exactly(&self) -> Joined {
        self.target.joined()
    }

    /// Returns the area of all triangles of each group; a triangle that lies on others counts as often.
    pub(crate) fn areas(&self) -> Vec<Area> {
        let mut areas = vec![Area::default(); self.groups.len()];
        for place in 0..self.target.len() as u32 {
            let group = &mut areas[self.group(self.target.index(place))];
            *group = *group + self.target.area(place);
        }
        areas
    }
}

fn groups(mesh: &TriangleMesh) -> Vec<Group> {
    let mut start = 0;
    let group = |MeshGroup { name, triangles }: &MeshGroup| {
        let facets = start..start + triangles;
        start = facets.end;
        Group { name: name.clone(), facets }
    };
    mesh.groups().iter().map(group).collect()
}

#[cfg(all(test, not(target_arch = "wasm32")))]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod tests {
    use super::*;
    use crate::facets::PointCloud;
    use crate::rounding::UNIT_ROUNDOFF;
    use num_rational::BigRational;
    use num_traits::{Signed, ToPrimitive};

    fn exact(number: f64) -> BigRational {
        BigRational::from_float(number).unwrap()
    }

    fn on_axis(x: f64) -> PreparedFacets {
        PreparedFacets::new(&Facets::Cloud(PointCloud::new(vec![DVec3::X * x]).unwrap()))
    }

    /// The factor is a rounded quotient of units, and each coordinate a rounded product; where both
    /// rounding errors have one sign the error exceeds a single one.
    #[test]
    fn scaled_coordinates_are_within_their_error_of_the_exact_ones() {
        let random = &mut fastrand::Rng::with_seed(71);
        let mut largest = 0.0_f64;
        for round in 0..4000 {
            let [a, b] = [0; 2].map(|_| 1.0 + random.f64());
            // Coordinates so small that a product underflows are rounded by more than their part.
            let x = if round % 10 == 0 { 3e-320 * random.f64() } else { 1.0 + random.f64() };
            let facets = on_axis(x).scaled(b / a);
            let Facet::Point(point) = facets.target.facet(0) else { panic!("a cloud has points") };
            let off = (exact(point.x) - exact(b) / exact(a) * exact(x)).abs();
            assert!(off <= exact(facets.error), "{x:e} {b} / {a}");
            if round % 10 > 0 {
                largest = largest.max(off.to_f64().unwrap() / (UNIT_ROUNDOFF * point.x));
            }
        }
        assert!(largest > 1.1, "{largest}");
    }

    /// An error before is scaled too, and is added.
    #[test]
    fn errors_are_scaled_with_their_coordinates() {
        for factor in [0.25, 3.0] {
            let facets = on_axis(1.0);
            let erring = PreparedFacets::with(facets.target.clone(), 0.5, Arc::clone(&facets.groups));
            let error = erring.scaled(factor).error;
            let expected = 0.5 * factor + 2.0 * UNIT_ROUNDOFF * factor;
            assert!(error >= expected && error <= expected * (1.0 + 1e-15), "{error} {expected}");
            // Points of patches are as far off as the coordinates that they are made of.
            let of_patches = erring.point_error().after(0) - facets.point_error().after(0);
            assert!((of_patches - 0.5).abs() <= 1e-15, "{of_patches}");
        }
    }

    /// The boxes of a scaled tree are those of its facets.
    #[test]
    fn queries_of_scaled_facets_are_those_of_the_scaled_points() {
        let points: Vec<DVec3> = (0..100).map(|k| DVec3::X * f64::from(k)).collect();
        let facets = PreparedFacets::new(&Facets::Cloud(PointCloud::new(points).unwrap())).scaled(4.0);
        assert_eq!(facets.target.bounding_box().max, DVec3::X * 396.0);
        let (foot, _, lower) = facets.target.certified(DVec3::new(200.0, 1.0, 0.0), 0);
        assert_eq!((facets.target.index(foot.facet), lower), (50, 1.0));
    }
}
