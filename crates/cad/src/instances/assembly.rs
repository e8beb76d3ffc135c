//! The faces of a file and their placements.

use crate::edges::EdgeUses;
use crate::faces::{Converted, convert};
use crate::levels::{LevelId, Levels, placed_name};
use crate::outline::outline;
use crate::placed::{FaceKey, Owner, Placed, matrix};
use crate::report::{FaceFault, Remark};
use crate::topology::{Color, Face, Mesh, Orientation, ShapeKind, Topology};
use glam::{DAffine3, DVec3};
use nurbs_hausdorff::workspace::{Assembled, FaceCounts, IDENTITY, MAX_FACES, Watch, map_watched};
use nurbs_hausdorff::{Error, FaceId, InstanceArrays, ModelArrays, Note, Result, Skipped};
use std::cell::LazyCell;
use std::collections::{HashMap, HashSet};

/// The most faces and groups of faces visited from the root. A shape can stand in several others, so that
/// a short file may describe more placements than memory holds.
const MAX_VISITS: usize = 1 << 22;

/// The most control points of the surfaces of all faces, half a gibibyte. Each face has a
/// copy of its surface, so that a short file may describe more than memory holds.
const MAX_POLES: usize = 1 << 24;

/// A listener to reading: the part of the faces that is read, and ends of segments along the
/// edges of the face that was read last.
pub(crate) type OnFace<'a> = &'a mut dyn FnMut(f64, &[DVec3]);

/// Converts every face below the root once, and lists its placements if any is moved.
pub(crate) fn assemble(file: &Topology, on_face: Option<OnFace<'_>>) -> Result<Assembled> {
    let (placed, levels) = placed_faces(file)?;
    let mut seen = HashSet::new();
    let distinct: Vec<(usize, &Placed)> =
        placed.iter().enumerate().filter(|(_, placed)| seen.insert(placed.key())).collect();
    let sizes = sizes(file, &distinct);
    let work = |index: usize| {
        if let ShapeKind::Mesh(mesh) = &file.shapes[distinct[index].1.shape].kind {
            return Err(beside_faces(mesh));
        }
        if sizes[index] > MAX_POLES {
            let why = "the faces up to this one have more than 16777216 control points";
            return Err(FaceFault::new("BREP_TOO_LARGE", why));
        }
        convert(file, distinct[index].1.shape)
    };
    let converted = match on_face {
        None => map_watched(distinct.len(), work, None),
        Some(on_face) => {
            let mut tell = |index: usize, _: &_| {
                let part = (index + 1) as f64 / distinct.len() as f64;
                on_face(part, &outline(file, distinct[index].1));
            };
            let watch: Watch<'_, _> = Some(&mut tell);
            map_watched(distinct.len(), work, watch)
        }
    };
    let mut read = Assembled {
        model: ModelArrays { unit: file.unit, ..ModelArrays::default() },
        counts: Vec::new(),
        skipped: Vec::new(),
        notes: notes(file, &placed, &distinct, &converted),
        shapes: Vec::new(),
    };
    // The index of each face among those read.
    let mut faces: HashMap<FaceKey, usize> = HashMap::new();
    for ((number, placed), converted) in distinct.into_iter().zip(converted) {
        match converted {
            Ok(mut converted) => {
                let Converted { exact, fitted, .. } = converted;
                let entity = placed.entity(file);
                read.counts.push(FaceCounts { number, entity, exact, fitted });
                converted.face.reversed = placed.reversed;
                converted.face.face_name = Some(placed.name(file, number));
                converted.face.color = placed.color;
                (converted.face.shell, converted.face.solid) = (placed.shell, placed.solid);
                faces.insert(placed.key(), read.model.faces.len());
                read.model.faces.push(converted.face);
            }
            Err(FaceFault { code, why }) => {
                let entity = placed.entity(file);
                read.skipped.push(Skipped::new(number.into(), entity, code, why));
            }
        }
    }
    read.model.instances = instances(&levels, &placed, &faces);
    let uses: usize = read.model.instances.iter().map(|instance| instance.surfaces.len()).sum();
    let is_moved = read.model.instances.iter().any(|instance| instance.transform != IDENTITY);
    if !is_moved && uses == read.model.faces.len() {
        name_parts(&mut read.model);
    }
    match read.skipped.first() {
        Some(_) if read.model.faces.is_empty() && is_of_triangles(file, &placed) => {
            Err(Error::StepTriangles { found: triangles(file, &placed) })
        }
        Some(Skipped { face: FaceId::Number(face), why, .. }) if read.model.faces.is_empty() => {
            Err(Error::BrepUnreadable { face: *face, found: why.clone(), faces: read.skipped.len() })
        }
        _ if read.model.faces.is_empty() => Err(Error::EmptyModel),
        _ => Ok(read),
    }
}

/// The code of triangles that stand beside faces.
const TRIANGLES: &str = "STEP_TRIANGLES";

/// Returns the reason for which triangles that are no picture of faces are not measured with these.
fn beside_faces(mesh: &Mesh) -> FaceFault {
    let (entity, count) = (mesh.label.entity.unwrap_or_default(), mesh.triangles.len());
    let why = format!("#{entity}, {}, is {count} triangles, which are not measured beside faces", mesh.kind);
    FaceFault::new(TRIANGLES, why)
}

/// Returns whether a file has triangles, and no face that could be measured beside them.
fn is_of_triangles(file: &Topology, placed: &[Placed]) -> bool {
    let kinds = || placed.iter().map(|placed| &file.shapes[placed.shape].kind);
    let is_readable = |kind: &ShapeKind| matches!(kind, ShapeKind::Face(Face { surface: Ok(_), .. }));
    kinds().any(|kind| matches!(kind, ShapeKind::Mesh(_))) && !kinds().any(is_readable)
}

/// Returns the number of triangles of all meshes where they are placed.
fn triangles(file: &Topology, placed: &[Placed]) -> usize {
    let count = |placed: &Placed| match &file.shapes[placed.shape].kind {
        ShapeKind::Mesh(mesh) => mesh.triangles.len(),
        _ => 0,
    };
    placed.iter().map(count).fold(0, usize::saturating_add)
}

/// Returns the numbers of control points of the surfaces of all faces up to each.
fn sizes(file: &Topology, distinct: &[(usize, &Placed)]) -> Vec<usize> {
    let mut total = 0_usize;
    let size = |(_, placed): &(usize, &Placed)| match &file.shapes[placed.shape].kind {
        ShapeKind::Face(Face { surface: Ok(surface), .. }) => file.surfaces[*surface].pole_count(),
        _ => 0,
    };
    let sums = distinct.iter().map(|face| {
        total = total.saturating_add(size(face));
        total
    });
    sums.collect()
}

/// Returns the placements of faces, in the order of the file: those that follow each other in one
/// part, place and solid together.
fn instances(levels: &Levels<'_>, placed: &[Placed], faces: &HashMap<FaceKey, usize>) -> Vec<InstanceArrays> {
    let mut instances: Vec<InstanceArrays> = Vec::new();
    let mut last = None;
    for placed in placed {
        let Some(&index) = faces.get(&placed.key()) else { continue };
        let transform = matrix(&placed.location);
        let solid = placed.solid;
        match instances.last_mut() {
            Some(instance) if instance.transform == transform && last == Some((placed.part, solid)) => {
                instance.surfaces.push(index);
            }
            _ => {
                let name = levels.path(placed.part);
                instances.push(InstanceArrays { surfaces: vec![index], transform, name, solid });
            }
        }
        last = Some((placed.part, solid));
    }
    instances
}

/// Replaces instances that are all where their faces are by the names of their parts before
/// those of the faces.
fn name_parts(model: &mut ModelArrays) {
    for InstanceArrays { surfaces, name, .. } in std::mem::take(&mut model.instances) {
        let Some(part) = name else { continue };
        for index in surfaces {
            let own = model.faces[index].face_name.take().unwrap_or_default();
            model.faces[index].face_name = Some(format!("{part} / {own}"));
        }
    }
}

/// Returns the remarks on faces, and the faces whose side of the loops follows from the
/// loops' directions alone.
fn notes(
    file: &Topology,
    placed: &[Placed],
    distinct: &[(usize, &Placed)],
    converted: &[std::result::Result<Converted, FaceFault>],
) -> Vec<Note> {
    let uses = LazyCell::new(|| EdgeUses::of(file, placed));
    let of_file = |Remark { code, why }: Remark| Note::new(0.into(), code, why);
    let mut notes: Vec<Note> = file.remarks.iter().cloned().map(of_file).collect();
    for (&(face, placed), converted) in distinct.iter().zip(converted) {
        let Ok(converted) = converted else { continue };
        let open = converted.complement_fits && !uses.confirm(file, placed);
        let why = "the rest of the closed surface has the same edges: the face is the side on the left \
                   of its edges' directions, which no seam and no neighbours confirm";
        let complement = open.then(|| Remark::new("BREP_COMPLEMENT", why));
        let remarks = converted.remarks.iter().cloned().chain(complement);
        notes.extend(remarks.map(|Remark { code, why }| Note::new(face.into(), code, why)));
    }
    notes
}

/// Returns the faces, and the meshes that are no pictures of them, below the root in the order of OpenCASCADE's
/// `TopExp_Explorer`, in which each shape is followed by its children; a face that is met again at its place is listed
/// once, as by `TopExp::MapShapes`, unless it is of another solid or another occurrence of its product: solids that share
/// a face have it each.
///
/// # Errors
/// [`Error::TooManyFaces`] before any is placed.
pub(crate) fn placed_faces(file: &Topology) -> Result<(Vec<Placed>, Levels<'_>)> {
    let counts = counts(file);
    let Counts { faces, visits } = counts[file.root.shape];
    for (found, expected) in [(faces, MAX_FACES), (visits, MAX_VISITS)] {
        let found = usize::try_from(found).unwrap_or(usize::MAX);
        if found > expected {
            return Err(Error::TooManyFaces { found, expected });
        }
    }
    let mut placed = Vec::new();
    let mut levels = Levels::default();
    let mut met = Met::default();
    let (mut occurrences, mut groups) = (0, 0);
    // Uses still to be visited, the next one last, each with what it stands in.
    let mut pending = vec![(file.root, Surroundings::default())];
    while let Some((shape_use, above)) = pending.pop() {
        let location = above.location * shape_use.location;
        let reversed = above.reversed ^ (shape_use.orientation == Orientation::Reversed);
        let color = file.colors.get(&shape_use.shape).copied().or(above.color);
        let shape = &file.shapes[shape_use.shape];
        let mut own = Surroundings { location, reversed, color, ..above };
        let children = || shape.children.iter().filter(|child| counts[child.shape].faces > 0);
        match &shape.kind {
            ShapeKind::Face(_) | ShapeKind::Mesh(Mesh { is_picture: false, .. })
                if met.is_first(shape_use.shape, &location, above.owner) =>
            {
                let Surroundings { level: part, group: shell, solid, owner, .. } = above;
                let shape = shape_use.shape;
                placed.push(Placed { shape, reversed, location, part, color, shell, solid, owner });
            }
            ShapeKind::Place { name, is_occurrence } => {
                own.place = name.as_deref().or(own.place);
                if *is_occurrence {
                    occurrences += 1;
                    own.owner.occurrence = Some(occurrences);
                }
                pending.extend(children().map(|&child| (child, own)));
            }
            kind @ (ShapeKind::Group(name) | ShapeKind::Solid(name)) => {
                own.group = Some(groups);
                if matches!(kind, ShapeKind::Solid(_)) {
                    (own.solid, own.owner.solid) = (Some(groups), Some(shape_use.shape));
                }
                groups += 1;
                own.enter(name.as_deref(), shape.children.len() == 1, &mut levels);
                pending.extend(children().rev().map(|&child| (child, own)));
            }
            // Faces met again are counted, and loose wires, edges and vertices are no surfaces.
            _ => {}
        }
    }
    placed.retain(|face| !met.is_also_of_solid(face));
    Ok((placed, levels))
}

/// The numbers of faces, and of these and their groups, that a shape stands for with all its uses.
#[derive(Clone, Copy, Default)]
struct Counts {
    faces: u64,
    visits: u64,
}

/// Returns the counts of all shapes, without going through their uses: every shape follows its children. O(shapes).
fn counts(file: &Topology) -> Vec<Counts> {
    let mut counts: Vec<Counts> = Vec::with_capacity(file.shapes.len());
    for shape in &file.shapes {
        counts.push(match &shape.kind {
            ShapeKind::Face(_) | ShapeKind::Mesh(Mesh { is_picture: false, .. }) => {
                Counts { faces: 1, visits: 1 }
            }
            ShapeKind::Group(_) | ShapeKind::Solid(_) | ShapeKind::Place { .. } => {
                let with_faces = shape.children.iter().map(|child| counts[child.shape]);
                let sum =
                    with_faces.filter(|child| child.faces > 0).fold(Counts::default(), |sum, child| Counts {
                        faces: sum.faces.saturating_add(child.faces),
                        visits: sum.visits.saturating_add(child.visits),
                    });
                Counts { visits: sum.visits.saturating_add(1), ..sum }
            }
            _ => Counts::default(),
        });
    }
    counts
}

/// What a use stands in.
#[derive(Clone, Copy, Default)]
struct Surroundings<'a> {
    location: DAffine3,
    reversed: bool,
    color: Option<Color>,
    level: LevelId,
    /// The name of the part that the level is, whatever its place is called.
    part: Option<&'a str>,
    /// Whether nothing else stands in the level.
    is_alone: bool,
    /// The name of the place that the use is.
    place: Option<&'a str>,
    owner: Owner,
    /// The innermost set of shapes that it is in, by its number among those visited.
    group: Option<u32>,
    /// The solid that it bounds, by its number among the sets of shapes visited.
    solid: Option<u32>,
}

/// The faces met, with what they were met in.
#[derive(Default)]
struct Met(HashMap<(usize, [u64; 12]), HashSet<Owner>>);

impl Met {
    /// Returns whether a face that is placed outside solids is placed as a face of a solid, too, at the same place.
    fn is_also_of_solid(&self, face: &Placed) -> bool {
        let met = self.0.get(&(face.shape, matrix(&face.location).map(f64::to_bits)));
        let is_alike = |met: &Owner| met.occurrence == face.owner.occurrence && met.solid.is_some();
        face.owner.solid.is_none() && met.is_some_and(|met| met.iter().any(is_alike))
    }

    /// Returns whether a face was not met at this place, but in other occurrences of products or other solids: what a
    /// file states twice without these is one face.
    fn is_first(&mut self, shape: usize, location: &DAffine3, owner: Owner) -> bool {
        let met = self.0.entry((shape, matrix(location).map(f64::to_bits))).or_default();
        let of_another = |met: &Owner| {
            if owner.occurrence == met.occurrence {
                owner.solid.is_some() && owner.solid != met.solid
            } else {
                owner.occurrence.is_some() && met.occurrence.is_some()
            }
        };
        let is_first = met.iter().all(of_another);
        met.insert(owner) && is_first
    }
}

impl<'a> Surroundings<'a> {
    /// Enters a group. A body of its product's name that is alone in it is no level of its own.
    fn enter(&mut self, name: Option<&'a str>, has_one: bool, levels: &mut Levels<'a>) {
        let place = self.place.take();
        let is_known = name.is_none() || (self.is_alone && name == self.part);
        match placed_name(place, name) {
            Some(full) if place.is_some() || !is_known => {
                self.level = Some(levels.push(self.level, full));
                (self.part, self.is_alone) = (name, has_one);
            }
            _ => self.is_alone &= has_one,
        }
    }
}
