//! Facets: the triangles of meshes and the points of scans, as either side of a distance.
//!
//! A facet is convex, and so is the distance to it. Its largest value over the convex hull of
//! points is therefore that at one of them, which is all that the upper bounds here need: no
//! derivatives and no rational arithmetic. `docs/meshes.md` has the proofs.

mod facet;
mod patches;
mod point_cloud;
mod prepared;
mod rounding;
mod samples;
mod search;
mod sign;
mod target;
mod triangle_mesh;

pub(crate) use facet::{Facet, Nearest};
pub(crate) use patches::weights;
pub use point_cloud::PointCloud;
pub(crate) use prepared::{Group, PreparedFacets};
pub(crate) use rounding::facet_rounding;
pub(crate) use samples::FacetSamples;
#[cfg(feature = "internals")]
pub use search::{Audit, audit_facet_searches};
pub(crate) use search::{
    Certified, Domain, End, FacetSearch, Measured, PartOf, Parts, Source, Spread, Start, Weighted,
    WeightedPart,
};
use target::NONE;
pub(crate) use target::{FacetFoot, FacetTarget};
pub use triangle_mesh::{MeshGroup, MeshReport, TriangleMesh};

/// A mesh or a cloud of points.
#[derive(Debug, Clone, PartialEq)]
pub enum Facets {
    /// A mesh.
    Mesh(TriangleMesh),
    /// A cloud of points.
    Cloud(PointCloud),
}
