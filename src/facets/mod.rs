//! Facets: the triangles of meshes and the points of scans, as either side of a distance.
//!
//! A facet is convex, and so is the distance to it. Its largest value over the convex hull of
//! points is therefore that at one of them, which is all that the upper bounds here need: no
//! derivatives and no rational arithmetic. `docs/meshes.md` has the proofs.

mod facet;
mod point_cloud;
mod rounding;
mod search;
mod target;
mod triangle_mesh;

pub(crate) use facet::Facet;
pub use point_cloud::PointCloud;
pub(crate) use search::{Certified, Domain, End, FacetSearch, Measured, Source, Start, Witness};
pub(crate) use target::{FacetFoot, FacetTarget};
pub use triangle_mesh::{MeshReport, TriangleMesh};
