//! Models whose faces close.

use super::PreparedModel;
use crate::flatness::Flatness;
use crate::solid::Side;
use glam::DVec3;
use serde::Serialize;
use std::collections::HashSet;

/// Whether a model's faces close, and where not.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
#[non_exhaustive]
pub struct Solid {
    /// Whether every edge of a face has a partner, so that points lie inside or outside.
    pub closed: bool,
    /// The sets of faces that joined edges connect, voids of solids among them.
    pub shells: Vec<Shell>,
    /// The edges without a partner, or the parts of edges; none for a solid.
    pub free_edges: Vec<FreeEdge>,
}

/// A set of faces that joined edges connect.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
#[non_exhaustive]
pub struct Shell {
    /// The indices of its faces, in order.
    pub faces: Vec<usize>,
    /// Whether no face of it has a free edge.
    pub closed: bool,
}

/// An edge of a face that no other edge joins, or a part of it.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
#[non_exhaustive]
pub struct FreeEdge {
    /// The index of the face.
    pub face: usize,
    /// The face's name in its source, if it has one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub face_name: Option<String>,
    /// Its start.
    pub start: [f64; 3],
    /// A point between.
    pub middle: [f64; 3],
    /// Its end.
    pub end: [f64; 3],
}

impl PreparedModel {
    /// Returns whether the faces close within their gaps, with the shells, and the free edges
    /// where they do not.
    ///
    /// Edges are joined where they lie side by side, within the model's gap or 1e-5 of its
    /// diagonal, whichever is larger. Computed at first use. O(edges log edges).
    ///
    /// Of a mesh, faces are its triangles. A cloud of points, and a mesh of more than 250,000
    /// triangles, is reported as not closed, without shells.
    #[must_use]
    pub fn solid(&self) -> Solid {
        let boundary = self.boundary();
        let face_of = |surface: usize| match self.facets() {
            Some(facets) => facets.target.index(surface as u32),
            None => self.pieces().face(surface),
        };
        let free_edges: Vec<FreeEdge> = boundary
            .free_edges()
            .iter()
            .map(|edge| {
                let face = face_of(edge.surface);
                let named = self.facets().is_none().then_some(face);
                let face_name = named.and_then(|face| self.face_name(face)).map(str::to_owned);
                let [start, middle, end] = edge.points.map(|point| point.to_array());
                FreeEdge { face, face_name, start, middle, end }
            })
            .collect();
        let open: HashSet<usize> = free_edges.iter().map(|edge| edge.face).collect();
        let mut shells: Vec<Shell> = Vec::new();
        for (surface, &shell) in boundary.shells().iter().enumerate() {
            let face = face_of(surface);
            if shell as usize == shells.len() {
                shells.push(Shell { faces: Vec::new(), closed: true });
            }
            let shell = &mut shells[shell as usize];
            if shell.faces.last() != Some(&face) {
                shell.faces.push(face);
            }
            shell.closed &= !open.contains(&face);
        }
        Solid { closed: boundary.is_closed(), shells, free_edges }
    }

    /// Returns the side of a point, for a model that [`Self::solid`] states to be closed.
    ///
    /// Guarantee: [`Side::Inside`] and [`Side::Outside`] are never wrong for the solids that the
    /// shells bound, whichever way they are oriented. A point is inside a shell if every ray crosses
    /// its faces an odd number of times, and inside the model if it is inside a body: in its outer shell
    /// and in none of its voids, as [`Self::bodies`] finds them.
    /// [`Side::Undecided`] for points on the boundary or within its gaps, for coordinates that are not
    /// finite, within two shells if one may be a void of the other, and for models that are not closed.
    #[must_use]
    pub fn side(&self, point: [f64; 3]) -> Side {
        self.side_within(DVec3::from_array(point), 0.0)
    }

    /// Returns the side of all points within `error` of this one.
    pub(super) fn side_within(&self, point: DVec3, error: f64) -> Side {
        if !point.is_finite() || !self.boundary().is_closed() {
            return Side::Undecided;
        }
        let enclosing = self.boundary().enclosing(&self.target(Flatness::None).target, point, error);
        enclosing.map_or(Side::Undecided, |enclosing| self.sides().side(&enclosing))
    }

    /// Returns true only if all points between two points, each known up to `error`, certainly have one side.
    pub(super) fn is_clear_between(&self, points: [DVec3; 2], error: f64) -> bool {
        self.boundary().is_clear(&self.target(Flatness::None).target, points, error)
    }

    /// Returns points of the model, one at least of each connected part of its faces.
    pub(super) fn points_of_shells(&self) -> Vec<DVec3> {
        let bezier = self.bezier();
        let mut is_seen = vec![false; self.boundary().shells().len()];
        let mut points = Vec::new();
        if self.facets().is_some() {
            for (triangle, &shell) in self.boundary().shells().iter().enumerate() {
                if !std::mem::replace(&mut is_seen[shell as usize], true) {
                    points.push(bezier.patches.patch(triangle).point([0.5; 2]));
                }
            }
            return points;
        }
        for (grid, &shell) in bezier.grids.iter().zip(self.boundary().shells()) {
            let middle = |index: usize| bezier.patches.patch(grid.first + index).point([0.5; 2]);
            if grid.is_continuous(bezier.patches.patch(grid.first).degree) {
                if !std::mem::replace(&mut is_seen[shell as usize], true) {
                    points.push(middle(0));
                }
            } else {
                points.extend((0..grid.counts().iter().product()).map(middle));
            }
        }
        points
    }
}
