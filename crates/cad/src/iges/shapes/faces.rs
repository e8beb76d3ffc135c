//! Faces of trimmed, bounded and whole surfaces.

use super::boundaries::Boundaries;
use super::{Shapes, Sheet};
use crate::iges::file::{Entity, Entry, Found};
use crate::iges::geometry::placed;
use glam::DAffine3;

/// The types of surfaces.
pub(super) const SURFACES: [u32; 11] = [108, 114, 118, 120, 122, 128, 140, 190, 192, 194, 196];

/// Whether a type is that of a surface.
pub(super) fn is_surface(kind: u32) -> bool {
    SURFACES.contains(&kind) || kind == 198
}

impl Shapes<'_> {
    /// Appends the face of a trimmed, bounded or whole surface.
    pub(super) fn face(&mut self, entity: &Entity) -> Found<usize> {
        match entity.entry.kind {
            144 => self.trimmed(entity),
            143 => self.bounded(entity),
            108 if entity.entry.form != 0 => self.plane(entity),
            _ => {
                let sheet = self.sheet(entity.number())?;
                self.push_face(&entity.entry, &sheet, &DAffine3::IDENTITY, Boundaries::default())
            }
        }
    }

    /// Appends a trimmed surface, type 144: an outer boundary, or that of the surface, and holes.
    fn trimmed(&mut self, entity: &Entity) -> Found<usize> {
        let sheet = self.sheet(entity.reference(1)?)?;
        let above = placed(self.file, &entity.entry, self.scale)?;
        let holes = entity.items(3, 1)?;
        let mut found = Boundaries::default();
        if entity.count(2, 1)? == 1 {
            self.curve_on_surface(entity.reference(4)?, &sheet, &above, &mut found)?;
        } else if holes > 0 {
            self.whole_boundary(entity, &sheet, &above, &mut found)?;
        }
        for hole in 0..holes {
            self.curve_on_surface(entity.reference(5 + hole)?, &sheet, &above, &mut found)?;
        }
        self.push_face(&entity.entry, &sheet, &above, found)
    }

    /// Appends a bounded surface, type 143.
    fn bounded(&mut self, entity: &Entity) -> Found<usize> {
        let sheet = self.sheet(entity.reference(2)?)?;
        let above = placed(self.file, &entity.entry, self.scale)?;
        let mut found = Boundaries::default();
        for boundary in entity.references(3)? {
            self.listed_boundary(boundary, &sheet, &above, &mut found)?;
        }
        self.push_face(&entity.entry, &sheet, &above, found)
    }

    /// Appends a plane within a curve, type 108 of form 1.
    fn plane(&mut self, entity: &Entity) -> Found<usize> {
        if entity.entry.form != 1 {
            return Err(entity.unknown("a plane of form 0 or 1: the hole of form -1 is part of another one"));
        }
        let sheet = self.sheet(entity.number())?;
        let mut found = Boundaries::default();
        self.curve_in_plane(entity, entity.reference(5)?, &sheet, &mut found)?;
        self.push_face(&entity.entry, &sheet, &DAffine3::IDENTITY, found)
    }

    /// Appends a face within boundaries.
    fn push_face(
        &mut self,
        entry: &Entry,
        sheet: &Sheet,
        above: &DAffine3,
        boundaries: Boundaries,
    ) -> Found<usize> {
        let wires = boundaries.directed();
        self.push_face_of(entry, sheet, above, wires, boundaries.remarks)
    }
}
