//! Several shapes as one.

use nurbs_hausdorff::workspace::{Assembled, IDENTITY, level};
use nurbs_hausdorff::{Error, FaceId, InstanceArrays, ModelArrays, Note, Result, Skipped, one_line};

/// Metres per unit of FreeCAD's shapes.
const FREECAD_UNIT: f64 = 1e-3;

/// The most control points and placed faces of all shapes: as many as one shape may have control points. A short
/// file may describe more than memory holds.
const MAX_SIZE: usize = 1 << 24;

/// The faces and placements of several shapes, with their own numbers of edges and shells. Faces are numbered
/// through all shapes.
#[derive(Default)]
pub(super) struct Joined {
    whole: Assembled,
    faces: usize,
    edges: u32,
    shells: u32,
    size: usize,
}

impl Joined {
    /// Appends a shape.
    ///
    /// # Errors
    /// [`Error::CadUnreadable`] for more than 2³² edges.
    pub(super) fn push(&mut self, name: &str, shape: Assembled) -> Result<()> {
        self.size = self.size.saturating_add(size(&shape.model));
        if self.size > MAX_SIZE {
            let why = format!("the shapes up to this one have more than {MAX_SIZE} control points and faces");
            self.leave_out(name, Some(("BREP_TOO_LARGE", why)));
            return Ok(());
        }
        let name = &one_line(name);
        let Assembled { model, counts, mut skipped, mut notes, .. } = shape;
        let first = self.faces;
        self.whole.shapes.push((first, name.to_owned()));
        for face in
            skipped.iter_mut().map(|one| &mut one.face).chain(notes.iter_mut().map(|one| &mut one.face))
        {
            if let FaceId::Number(number) = *face {
                self.faces = self.faces.max(first + number + 1);
                *face = self.whole.face_id(first + number);
            }
        }
        for mut count in counts {
            count.number += first;
            self.faces = self.faces.max(count.number + 1);
            self.whole.counts.push(count);
        }
        self.whole.skipped.append(&mut skipped);
        self.whole.notes.append(&mut notes);
        self.push_faces(name, model)
    }

    fn push_faces(&mut self, name: &str, shape: ModelArrays) -> Result<()> {
        let model = &mut self.whole.model;
        let (first, count) = (model.faces.len(), shape.faces.len());
        let placed = match shape.instances.is_empty() {
            true => {
                vec![InstanceArrays {
                    surfaces: (0..count).collect(),
                    transform: IDENTITY,
                    name: None,
                    solid: None,
                }]
            }
            false => shape.instances,
        };
        // Solids are numbered among the shells.
        let mut shells = self.shells;
        for mut instance in placed {
            instance.surfaces.iter_mut().for_each(|index| *index += first);
            instance.solid = instance.solid.map(|solid| solid.saturating_add(self.shells));
            shells = shells.max(instance.solid.map_or(0, |solid| solid.saturating_add(1)));
            model.instances.push(instance);
        }
        let mut end = self.edges;
        for mut face in shape.faces {
            let own = face.face_name.take().unwrap_or_default();
            face.face_name = Some(format!("{} / {own}", level(name)));
            let curves = face.trim.iter_mut().flatten().flatten();
            for edge in curves.filter_map(|curve| curve.edge.as_mut()) {
                let number = edge.checked_add(self.edges).filter(|&number| number < u32::MAX);
                let found = || Error::CadUnreadable { found: "more than 4294967295 edges".to_owned() };
                *edge = number.ok_or_else(found)?;
                end = end.max(*edge + 1);
            }
            for number in [&mut face.shell, &mut face.solid].into_iter().flatten() {
                *number = number.saturating_add(self.shells);
                shells = shells.max(number.saturating_add(1));
            }
            model.faces.push(face);
        }
        (self.edges, self.shells) = (end, shells);
        Ok(())
    }

    /// Lists an object that is not read, with the code and the reason, if it matters.
    pub(super) fn leave_out(&mut self, name: &str, reason: Option<(&'static str, String)>) {
        let skipped = |(code, why)| Skipped::new(FaceId::Name(one_line(name)), None, code, why);
        self.whole.skipped.extend(reason.map(skipped));
    }

    /// Says of an object why it is no part of the model.
    pub(super) fn note(&mut self, name: &str, code: &'static str, why: &str) {
        self.whole.notes.push(Note::new(FaceId::Name(one_line(name)), code, why.to_owned()));
    }

    /// Returns the whole.
    ///
    /// # Errors
    /// [`Error::EmptyDocument`] without a face.
    pub(super) fn into_assembled(self) -> Result<Assembled> {
        let mut whole = self.whole;
        whole.model.unit = Some(FREECAD_UNIT);
        if whole.model.instances.iter().all(|instance| instance.transform == IDENTITY) {
            whole.model.instances.clear();
        }
        if !whole.model.faces.is_empty() {
            return Ok(whole);
        }
        let named = |skipped: &Skipped| format!("; {}: {}", skipped.face, skipped.why);
        Err(Error::EmptyDocument { left_out: whole.skipped.iter().map(named).collect() })
    }
}

fn size(model: &ModelArrays) -> usize {
    let points: usize = model.faces.iter().map(|face| face.surface.control_points.len()).sum();
    let placed: usize = model.instances.iter().map(|instance| instance.surfaces.len()).sum();
    points.saturating_add(placed)
}
