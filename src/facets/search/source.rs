//! The two sides of a search.

use super::super::FacetTarget;
use super::super::rounding::facet_rounding;
use crate::bezier::PatchSet;
use crate::bvh::Aabb;
use crate::closest::{Target, closest_above};
use glam::DVec3;

/// Model A, whose points are measured.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Source<'a> {
    /// A mesh or a cloud, of coordinates that are within `error` of the exact ones.
    Facets {
        /// The facets with their tree.
        facets: &'a FacetTarget,
        /// The distance of the coordinates from the exact ones.
        error: f64,
    },
    /// Bézier patches; their computed points are within `error` of the exact ones.
    Patches {
        /// The patches.
        patches: &'a PatchSet,
        /// The distance of computed points from the exact ones.
        error: f64,
        /// A box around the control points.
        control_box: Aabb,
    },
}

/// Model B, which distances are measured to.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Measured<'a> {
    /// A mesh or a cloud, of coordinates that are within `error` of the exact ones.
    Facets {
        /// The facets with their tree.
        facets: &'a FacetTarget,
        /// The distance of the coordinates from the exact ones.
        error: f64,
    },
    /// Bézier patches, for a cloud as A.
    Patches {
        /// The patches with their tree.
        target: &'a Target,
        /// The distance of computed points from the exact ones.
        error: f64,
    },
}

/// A place on B where a search for the nearest point starts: a facet, or a patch and parameters.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Start {
    pub(crate) piece: u32,
    pub(crate) parameters: [f64; 2],
}

/// A point of B near one of A, with bounds on the distance of that one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Certified {
    pub(crate) start: Start,
    /// The point of B.
    pub(crate) point: DVec3,
    /// The weights of the corners of a facet.
    pub(crate) weights: [f64; 3],
    /// A lower bound on the distance to B.
    pub(crate) lower: f64,
    /// The distance of the point of B.
    pub(crate) upper: f64,
}

impl Source<'_> {
    pub(super) fn bounding_box(&self) -> Aabb {
        match self {
            Self::Facets { facets, .. } => facets.bounding_box(),
            Self::Patches { control_box, .. } => *control_box,
        }
    }

    /// Returns the distance of computed points from the exact ones, before they are moved.
    pub(crate) fn error(&self) -> f64 {
        match self {
            Self::Facets { error, .. } | Self::Patches { error, .. } => *error,
        }
    }
}

impl Measured<'_> {
    pub(super) fn bounding_box(&self) -> Aabb {
        match self {
            Self::Facets { facets, .. } => facets.bounding_box(),
            Self::Patches { target, .. } => target.tree.bounding_box(),
        }
    }

    pub(super) fn error(&self) -> f64 {
        match self {
            Self::Facets { error, .. } | Self::Patches { error, .. } => *error,
        }
    }

    /// Returns the distance of a point of B that is nearest up to `gap` and rounding, or of the
    /// first found within `sufficient`; with the place of that point.
    pub(super) fn nearest(&self, point: DVec3, start: Start, gap: f64, sufficient: f64) -> (f64, Start) {
        match self {
            Self::Facets { facets, .. } => {
                let foot = facets.nearest(point, start.piece, sufficient);
                (foot.distance_squared.sqrt(), Start { piece: foot.facet, ..start })
            }
            Self::Patches { target, .. } => {
                let known = Some((start.piece, start.parameters));
                match closest_above(target, point, gap, known, sufficient, None) {
                    Some(found) => {
                        let start = Start { piece: found.patch as u32, parameters: found.parameters };
                        (found.upper, start)
                    }
                    None => (f64::INFINITY, start),
                }
            }
        }
    }

    /// Returns the nearest point with certified bounds on the distance of a point that is at most
    /// `length` from the origin; `None` for a B without pieces.
    pub(crate) fn certified(&self, point: DVec3, start: Start, gap: f64, length: f64) -> Option<Certified> {
        match self {
            Self::Facets { facets, .. } => {
                let (foot, nearest, lower) = facets.certified(point, start.piece);
                let lower = lower - facet_rounding(length);
                Some(Certified {
                    start: Start { piece: foot.facet, ..start },
                    point: facets.facet(foot.facet).point(nearest.weights),
                    weights: nearest.weights,
                    lower: if lower > 0.0 { lower } else { 0.0 },
                    upper: foot.distance_squared.sqrt(),
                })
            }
            Self::Patches { target, .. } => {
                let known = Some((start.piece, start.parameters));
                let found = closest_above(target, point, gap, known, 0.0, None)?;
                Some(Certified {
                    start: Start { piece: found.patch as u32, parameters: found.parameters },
                    point: found.point,
                    weights: [0.0; 3],
                    lower: found.lower,
                    upper: found.upper,
                })
            }
        }
    }
}
