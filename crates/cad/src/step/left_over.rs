//! What a file has and no representation of a shape reaches.

use super::assembly::Assembly;
use super::relations::referred;
use super::shapes::{Shapes, is_body, is_face, is_triangles, used};
use super::units::Units;
use crate::report::{FaceFault, Remark};
use crate::topology::Use;
use std::collections::HashSet;

impl Assembly<'_> {
    /// Returns, as faces that cannot be read, the relationships that place nothing, and the faces, bodies and
    /// mapped items that no representation contains. Parts of others of these are named with them.
    ///
    /// # Errors
    /// If the file has too many shapes.
    pub(super) fn left_over(&mut self) -> Result<Vec<Use>, FaceFault> {
        let mut left = Vec::new();
        for (relationship, fault) in std::mem::take(&mut self.faults) {
            left.push(used(self.shapes.unreadable(relationship, fault)?, true));
        }
        let has_shapes = self.shapes.has_shapes();
        for number in loose(&self.shapes).into_iter().chain(self.loose_mapped()) {
            let kind = self.shapes.file.keyword(number);
            let why = format!("no representation of a shape contains #{number}, {kind}");
            if !has_shapes && is_triangles(kind) {
                left.extend(self.loose_triangles(number, why)?);
                continue;
            }
            let fault = FaceFault::new("STEP_LOOSE", why);
            left.push(used(self.shapes.unreadable(number, fault)?, true));
        }
        Ok(left)
    }

    /// Reads triangles that are all that a file has, where they stand, in the unit on which its contexts agree.
    fn loose_triangles(&mut self, number: u64, why: String) -> Result<Option<Use>, FaceFault> {
        let units = Units::of_file(self.shapes.file);
        self.shapes.set_units(units);
        self.unit_missing |= units.length.is_none();
        let why = format!("{why}: it is read as it stands, as the file has nothing else");
        self.shapes.topology.remarks.push(Remark::new("STEP_LOOSE", why));
        self.shapes.item(number)
    }

    /// Returns the mapped items of representations that have faces, which stand in none themselves. Those of drawings
    /// and presentations show what stands elsewhere.
    fn loose_mapped(&self) -> Vec<u64> {
        let file = self.shapes.file;
        let is_loose = |&number: &u64| {
            let map = referred(file, number, "MAPPED_ITEM", 1);
            let source = map.and_then(|map| referred(file, map, "REPRESENTATION_MAP", 1));
            let group = source.and_then(|source| self.group_of.get(&source));
            let has_faces = group.and_then(|group| self.built.get(group)).is_some_and(Option::is_some);
            has_faces && !self.met.contains(&number)
        };
        let items = file.numbers.iter().copied().filter(|&number| file.keyword(number) == "MAPPED_ITEM");
        let mut loose: Vec<u64> = items.filter(is_loose).collect();
        if !loose.is_empty() {
            let shown = shown(&self.shapes);
            loose.retain(|number| !shown.contains(number));
        }
        loose
    }
}

/// Returns what drawings and presentations refer to.
fn shown(shapes: &Shapes<'_>) -> HashSet<u64> {
    let file = shapes.file;
    let shows = |kind: &str| kind == "DRAUGHTING_MODEL" || kind.contains("PRESENTATION");
    let all = file.numbers.iter().copied().filter(|&number| shows(file.keyword(number)));
    all.filter_map(|number| file.entity(number).ok()).flat_map(|entity| entity.all_references()).collect()
}

/// Returns the faces and bodies that were not reached, without those that are parts of other bodies, of what was
/// reached or refused, and of annotations.
fn loose(shapes: &Shapes<'_>) -> Vec<u64> {
    let file = shapes.file;
    let mut candidates = Vec::new();
    let mut parts: HashSet<u64> = HashSet::new();
    for &number in &file.numbers {
        let kind = file.keyword(number);
        let (is_face, is_body) = (is_face(kind), is_body(file, number));
        let (was_refused, was_reached) = (shapes.was_refused(number), shapes.was_reached(number));
        if (is_face || is_body) && !was_refused && !was_reached {
            candidates.push(number);
        }
        if (is_body || was_refused || was_reached || kind == "ORIENTED_FACE" || kind.contains("ANNOTATION"))
            && let Ok(entity) = file.entity(number)
        {
            parts.extend(entity.all_references());
        }
    }
    candidates.retain(|number| !parts.contains(number));
    candidates
}
