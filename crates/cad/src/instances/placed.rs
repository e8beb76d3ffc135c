//! Faces where an assembly places them.

use crate::levels::LevelId;
use crate::topology::{Color, FaceLabel, ShapeKind, Topology};
use glam::DAffine3;
use nurbs_hausdorff::workspace::level;

/// A face where an assembly places it.
pub(crate) struct Placed {
    pub(crate) shape: usize,
    pub(crate) reversed: bool,
    pub(crate) location: DAffine3,
    /// The innermost level with a name that the face stands in.
    pub(crate) part: LevelId,
    /// The face's own colour, else that of the innermost shape with one that it stands in.
    pub(crate) color: Option<Color>,
    /// The number of the innermost set of shapes that it stands in, a shell if the file has shells.
    pub(crate) shell: Option<u32>,
    /// The number of the solid that it bounds, among the sets of shapes.
    pub(crate) solid: Option<u32>,
    pub(crate) owner: Owner,
}

/// Key of a face in its model: the shape of the face, the shape of its solid, and whether its normal is reversed. A prism
/// may use one shape as its base and, reversed, as its top.
pub(crate) type FaceKey = (usize, Option<usize>, bool);

/// What a face belongs to.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Hash)]
pub(crate) struct Owner {
    /// The innermost occurrence of a product, by its number among those visited.
    pub(crate) occurrence: Option<usize>,
    /// The shape of the solid.
    pub(crate) solid: Option<usize>,
}

impl Placed {
    /// Returns the key of the face. Placements with equal keys are one face of the model.
    pub(crate) fn key(&self) -> FaceKey {
        (self.shape, self.owner.solid, self.reversed)
    }

    pub(crate) fn label<'a>(&self, file: &'a Topology) -> Option<&'a FaceLabel> {
        match &file.shapes[self.shape].kind {
            ShapeKind::Face(face) => Some(&face.label),
            ShapeKind::Mesh(mesh) => Some(&mesh.label),
            _ => None,
        }
    }

    /// Returns the number by which the file calls the face.
    pub(crate) fn entity(&self, file: &Topology) -> Option<u64> {
        self.label(file).and_then(|label| label.entity)
    }

    /// Returns the name of the face: that of the file, or its number.
    pub(crate) fn name(&self, file: &Topology, number: usize) -> String {
        let own = self.label(file).and_then(|label| label.name.clone());
        own.map_or_else(|| format!("face {number}"), |name| level(&name))
    }
}

/// Returns the row-major 3x4 matrix of an affine map.
pub(crate) fn matrix(map: &DAffine3) -> [f64; 12] {
    let rows = map.matrix3.transpose();
    let [x, y, z] = [rows.x_axis, rows.y_axis, rows.z_axis];
    let t = map.translation;
    // Adding 0 makes zeros of either sign equal.
    [x.x, x.y, x.z, t.x, y.x, y.y, y.z, t.y, z.x, z.y, z.z, t.z].map(|entry| entry + 0.0)
}
