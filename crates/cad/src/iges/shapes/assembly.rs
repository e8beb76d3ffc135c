//! Bodies and where groups, subfigures and instances place them.

use super::colors::color_of;
use super::faces::is_surface;
use super::{Shapes, used};
use crate::iges::file::{Entity, File, Found};
use crate::iges::geometry::{matrix, placed};
use crate::report::FaceFault;
use crate::topology::{ShapeKind, Topology, Use};
use glam::{DAffine3, DMat3};
use std::collections::HashSet;

/// The deepest nesting of groups and subfigures.
const MAX_NESTING: usize = 64;

/// The forms of associativities, type 402, that are groups.
const GROUPS: [i64; 4] = [1, 7, 14, 15];

/// The types of bodies that are not read: primitives, swept solids, Boolean trees, arrays of
/// subfigures and references to other files.
const OTHER_BODIES: [u32; 14] = [150, 152, 154, 156, 158, 160, 162, 164, 168, 180, 182, 412, 414, 416];

/// Reads the bodies of a file where they are placed.
///
/// # Errors
/// `IGES_UNIT`, and `IGES_TOO_LARGE`.
pub(in crate::iges) fn read(file: &File<'_>) -> Found<Topology> {
    let unit = file.global.unit;
    let unit = unit.ok_or_else(|| FaceFault::new("IGES_UNIT", "the global section states no known unit"))?;
    let mut shapes = Shapes::new(file, unit);
    let (referred, defined) = shapes.references();
    let mut uses = Vec::new();
    for entry in file.entries() {
        if is_body(entry.kind, entry.form) && !referred.contains(&entry.number) {
            if is_surface(entry.kind) && entry.is_dependent {
                let why = format!("no entity that is read refers to the surface {}", entry.number);
                let shape = shapes.unreadable(entry.number, FaceFault::new("IGES_LOOSE", why))?;
                uses.push(used(shape, true));
            } else {
                uses.push(shapes.placed_body(entry.number)?);
            }
        }
    }
    // Bodies that stand only in each other, or in a subfigure that is never placed.
    for entry in file.entries() {
        let is_part = is_body(entry.kind, entry.form) && !is_surface(entry.kind);
        if !is_part || shapes.reached.contains_key(&entry.number) {
            continue;
        }
        if defined.contains(&entry.number) {
            let why = format!("entity {} stands in a subfigure that is never placed", entry.number);
            let shape = shapes.unreadable(entry.number, FaceFault::new("IGES_LOOSE", why))?;
            uses.push(used(shape, true));
        } else {
            uses.push(shapes.placed_body(entry.number)?);
        }
    }
    let root = shapes.push(ShapeKind::Group(None), uses)?;
    shapes.topology.root = used(root, true);
    Ok(shapes.topology)
}

/// Whether an entity is a face, a body or a group of them.
fn is_body(kind: u32, form: i64) -> bool {
    match kind {
        402 => GROUPS.contains(&form),
        143 | 144 | 184 | 186 | 408 | 430 | 510 | 514 => true,
        _ => is_surface(kind) || OTHER_BODIES.contains(&kind),
    }
}

impl Shapes<'_> {
    /// Returns the entities that others refer to, and those of them that stand in subfigures.
    fn references(&self) -> (HashSet<u64>, HashSet<u64>) {
        let (mut referred, mut defined) = (HashSet::new(), HashSet::new());
        for entry in self.file.entries() {
            let is_group = entry.kind == 402 && GROUPS.contains(&entry.form);
            let refers = matches!(entry.kind, 140 | 143 | 144 | 184 | 186 | 308 | 430 | 510 | 514);
            if !is_group && !refers {
                continue;
            }
            let Ok(entity) = self.file.entity(entry.number) else { continue };
            let found = match entry.kind {
                140 => entity.reference(5).map(|surface| vec![surface]),
                143 => entity.reference(2).map(|surface| vec![surface]),
                144 | 430 | 510 => entity.reference(1).map(|surface| vec![surface]),
                186 => pairs(&entity, 3, 2).map(|mut shells| {
                    shells.extend(entity.reference(1));
                    shells
                }),
                184 => entity
                    .items(1, 2)
                    .and_then(|count| (2..2 + count).map(|at| entity.reference(at)).collect()),
                308 => entity.references(3),
                514 => pairs(&entity, 1, 2),
                _ => entity.references(1),
            };
            let Ok(found) = found else { continue };
            if entry.kind == 308 {
                defined.extend(&found);
            }
            referred.extend(found);
        }
        (referred, defined)
    }

    /// Returns the use of a body with the place of an instance.
    fn placed_body(&mut self, number: u64) -> Found<Use> {
        Ok(used(self.body(number)?, true))
    }

    /// Returns the shape of a face, a body or a group. One that cannot be read is a face with
    /// the reason.
    ///
    /// # Errors
    /// If the file has too many shapes.
    pub(super) fn body(&mut self, number: u64) -> Found<usize> {
        if let Some(&known) = self.reached.get(&number) {
            return Ok(known);
        }
        let found = if self.open.len() >= MAX_NESTING || !self.open.insert(number) {
            let why = format!("entity {number} contains itself, or has more than {MAX_NESTING} levels");
            Err(FaceFault::new("IGES_NESTING", why))
        } else {
            let found = self.new_body(number);
            self.open.remove(&number);
            found
        };
        let shape = match found {
            Ok(shape) => shape,
            Err(fault) => self.unreadable(number, fault)?,
        };
        self.reached.insert(number, shape);
        let color = self.file.entry(number).ok().and_then(|entry| color_of(self.file, entry));
        self.topology.colors.extend(color.map(|color| (shape, color)));
        Ok(shape)
    }

    fn new_body(&mut self, number: u64) -> Found<usize> {
        let entity = self.file.entity(number)?;
        let entry = entity.entry;
        let mut name = entry.name();
        let children = match entry.kind {
            143 | 144 => return self.face(&entity),
            510 => return self.face_of_loops(number),
            514 => self.shell_faces(number)?,
            186 => self.moved(&entity, |shapes| shapes.shells(number))?,
            402 if GROUPS.contains(&entry.form) => self.bodies(&entity.references(1)?)?,
            408 => {
                let definition = self.file.entity(entity.reference(1)?)?;
                if definition.entry.kind != 308 {
                    return Err(definition.unknown("a subfigure, type 308"));
                }
                name = definition.text(2).map(|text| text.trim().to_owned()).filter(|text| !text.is_empty());
                let location = self.instance(&entity)?;
                let bodies = self.bodies(&definition.references(3)?)?;
                bodies.into_iter().map(|body| Use { location: location * body.location, ..body }).collect()
            }
            430 => {
                let body = entity.reference(1)?;
                self.moved(&entity, |shapes| shapes.bodies(&[body]))?
            }
            184 => self.collection(&entity)?,
            kind if is_surface(kind) => return self.face(&entity),
            _ => return Err(entity.unknown("a face, a body or a group of them")),
        };
        self.push(if entry.kind == 186 { ShapeKind::Solid(name) } else { ShapeKind::Group(name) }, children)
    }

    /// Returns those of some entities that are faces, bodies or groups: curves and points are none.
    fn bodies(&mut self, numbers: &[u64]) -> Found<Vec<Use>> {
        let mut bodies = Vec::with_capacity(numbers.len());
        for &number in numbers {
            let is_known = self.file.entry(number).map(|entry| is_body(entry.kind, entry.form));
            match is_known {
                Ok(true) => bodies.push(used(self.body(number)?, true)),
                Ok(false) => {}
                Err(fault) => bodies.push(used(self.unreadable(number, fault)?, true)),
            }
        }
        Ok(bodies)
    }

    /// Returns shapes moved by the matrix of an entity.
    fn moved(&mut self, entity: &Entity, read: impl FnOnce(&mut Self) -> Found<Vec<Use>>) -> Found<Vec<Use>> {
        let location = placed(self.file, &entity.entry, self.scale)?;
        Ok(read(self)?.into_iter().map(|one| Use { location: location * one.location, ..one }).collect())
    }

    /// Returns the place of an instance of a subfigure, type 408: scaled, moved, and placed by its
    /// matrix.
    fn instance(&self, entity: &Entity) -> Found<DAffine3> {
        let factor = match entity.optional_real(5)? {
            Some(factor) if factor != 0.0 => factor,
            Some(_) => return Err(entity.fault(5, "a factor other than 0")),
            None => 1.0,
        };
        let translation = self.scale.0 * entity.point(2)?;
        let own = DAffine3 { matrix3: DMat3::from_diagonal(glam::DVec3::splat(factor)), translation };
        Ok(placed(self.file, &entity.entry, self.scale)? * own)
    }

    /// Returns the bodies of a collection, type 184, each moved by its matrix.
    fn collection(&mut self, entity: &Entity) -> Found<Vec<Use>> {
        let count = entity.items(1, 2)?;
        let mut uses = Vec::with_capacity(count);
        for index in 0..count {
            let location = match entity.pointer(2 + count + index)? {
                0 => DAffine3::IDENTITY,
                number => matrix(&self.file.entity(number)?, self.scale)?,
            };
            let bodies = self.bodies(&[entity.reference(2 + index)?])?;
            uses.extend(bodies.into_iter().map(|body| Use { location, ..body }));
        }
        let location = placed(self.file, &entity.entry, self.scale)?;
        Ok(uses.into_iter().map(|one| Use { location: location * one.location, ..one }).collect())
    }
}

/// Returns the references that stand in every second place behind a count.
fn pairs(entity: &Entity, index: usize, size: usize) -> Found<Vec<u64>> {
    let count = entity.items(index, size)?;
    (0..count).map(|at| entity.reference(index + 1 + size * at)).collect()
}
