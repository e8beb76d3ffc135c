//! Tessellated items: triangles, alone or as a picture of faces (ISO 10303-42, tessellated geometry).

use super::Shapes;
use super::items::{MAX_NESTING, has_no_surface};
use crate::report::FaceFault;
use crate::step::exchange::{Entity, Value, count, numbers_of, reference};
use crate::step::geometry::operator;
use crate::topology::{FaceLabel, Mesh, ShapeKind};
use glam::DVec3;
use std::collections::HashMap;
use std::rc::Rc;

/// The items that are made of other tessellated ones.
pub(in crate::step) const TESSELLATED: [&str; 3] =
    ["TESSELLATED_SOLID", "TESSELLATED_SHELL", "TESSELLATED_GEOMETRIC_SET"];

/// The items of triangles: the attribute from which on their indices stand, and whether the next two are strips and
/// fans, where otherwise one lists triangles.
pub(in crate::step) const TRIANGULATED: [(&str, usize, bool); 4] = [
    ("TRIANGULATED_FACE", 5, false),
    ("COMPLEX_TRIANGULATED_FACE", 5, true),
    ("TRIANGULATED_SURFACE_SET", 4, false),
    ("COMPLEX_TRIANGULATED_SURFACE_SET", 4, true),
];

/// The attribute of a face of triangles that is the face which they are a picture of.
const FACE_LINK: usize = 4;

/// The same of solids and shells.
const BODY_LINK: usize = 2;

/// The points of a list of coordinates.
pub(super) type Coordinates = Rc<Vec<DVec3>>;

impl Shapes<'_> {
    /// Returns the mesh that a tessellated item is; `None` for other items.
    ///
    /// # Errors
    /// Those of entities; `STEP_ENTITY` for a part that is not read, as curved triangles.
    pub(super) fn tessellated(&mut self, entity: &Entity<'_>) -> Result<Option<usize>, FaceFault> {
        let kind = entity.kind.as_str();
        if !TESSELLATED.contains(&kind) && !TRIANGULATED.iter().any(|(known, ..)| *known == kind) {
            return Ok(None);
        }
        let label = FaceLabel { entity: Some(entity.number), name: entity.name() };
        let mut mesh = Mesh { label, kind: kind.to_owned(), ..Mesh::default() };
        let mut links = Vec::new();
        self.collect(entity, &mut mesh, &mut links, 0)?;
        let shape = self.push(ShapeKind::Mesh(mesh), Vec::new())?;
        self.pictures.push((shape, links));
        Ok(Some(shape))
    }

    /// States which meshes are pictures: each part of them names a face or body that was read.
    pub(in crate::step) fn mark_pictures(&mut self) {
        for (shape, links) in std::mem::take(&mut self.pictures) {
            let is_read = |link: &Option<u64>| link.is_some_and(|link| self.was_reached(link));
            let is_picture = !links.is_empty() && links.iter().all(is_read);
            if let ShapeKind::Mesh(mesh) = &mut self.topology.shapes[shape].kind {
                mesh.is_picture = is_picture;
            }
        }
    }

    /// Appends the triangles of an item where it places them, and for each part the face or body that it is a picture of.
    fn collect(
        &mut self,
        entity: &Entity<'_>,
        mesh: &mut Mesh,
        links: &mut Vec<Option<u64>>,
        nesting: usize,
    ) -> Result<(), FaceFault> {
        let before = mesh.vertices.len();
        self.collect_parts(entity, mesh, links, nesting)?;
        if let Some(location) = &entity.location {
            let location = reference(location).ok_or_else(|| entity.unknown("a placement of its own"))?;
            let map = operator(self.file, location, &self.scale())?;
            mesh.vertices[before..].iter_mut().for_each(|point| *point = map.transform_point3(*point));
        }
        Ok(())
    }

    fn collect_parts(
        &mut self,
        entity: &Entity<'_>,
        mesh: &mut Mesh,
        links: &mut Vec<Option<u64>>,
        nesting: usize,
    ) -> Result<(), FaceFault> {
        let kind = entity.kind.as_str();
        if let Some(&(_, first, is_complex)) = TRIANGULATED.iter().find(|(known, ..)| *known == kind) {
            links.push(if first > FACE_LINK { entity.reference(FACE_LINK).ok() } else { None });
            return self.append(entity, first, is_complex, mesh);
        }
        if nesting == MAX_NESTING || !TESSELLATED.contains(&kind) {
            return Err(entity.unknown("flat triangles"));
        }
        let own = entity.reference(BODY_LINK).ok();
        let mut of_parts = Vec::new();
        for part in entity.references(1)? {
            let part = self.file.entity(part)?;
            if !has_no_surface(&part.kind) {
                self.collect(&part, mesh, &mut of_parts, nesting + 1)?;
            }
        }
        if own.is_none() && of_parts.is_empty() {
            return Err(entity.fault(1, "a list of at least one part with triangles"));
        }
        // The picture of a whole body is one of its faces.
        if own.is_some() {
            links.push(own)
        } else {
            links.append(&mut of_parts)
        }
        Ok(())
    }

    /// Appends the triangles of one face or set.
    fn append(
        &mut self,
        entity: &Entity<'_>,
        first: usize,
        is_complex: bool,
        mesh: &mut Mesh,
    ) -> Result<(), FaceFault> {
        let points = self.coordinates(entity.reference(1)?)?;
        // Indices go through this list if there is one.
        let through = indices(entity, first, entity.value(first), usize::MAX)?;
        let highest = if through.is_empty() { points.len() } else { through.len() };
        let mut triangles: Vec<[usize; 3]> = Vec::new();
        for corners in lists(entity, first + 1, highest)? {
            match corners.as_slice() {
                _ if is_complex => triangles.extend(strip(&corners)),
                &[a, b, c] => triangles.push([a, b, c]),
                _ => return Err(entity.fault(first + 1, "a list of triangles")),
            }
        }
        if is_complex {
            for corners in lists(entity, first + 2, highest)? {
                triangles.extend(corners.windows(2).skip(1).map(|pair| [corners[0], pair[0], pair[1]]));
            }
        }
        let mut used: HashMap<usize, u32> = HashMap::new();
        // A triangle with equal corners joins strips and has no area.
        for triangle in triangles.into_iter().filter(|[a, b, c]| a != b && b != c && c != a) {
            let mut corners = [0; 3];
            for (corner, index) in corners.iter_mut().zip(triangle) {
                let index = if through.is_empty() { index } else { through[index - 1] };
                let point = index.checked_sub(1).and_then(|index| points.get(index));
                let point =
                    *point.ok_or_else(|| entity.fault(first, "indices of points of its coordinates"))?;
                *corner = match used.get(&index) {
                    Some(&known) => known,
                    None => {
                        let vertex = u32::try_from(mesh.vertices.len())
                            .map_err(|_| entity.fault(1, "coordinates of fewer points"))?;
                        mesh.vertices.push(point);
                        used.insert(index, vertex);
                        vertex
                    }
                };
            }
            mesh.triangles.push(corners);
        }
        Ok(())
    }

    /// Returns the points of a list of coordinates, which many faces may share.
    fn coordinates(&mut self, instance: u64) -> Result<Coordinates, FaceFault> {
        if let Some(known) = self.coordinates.get(&instance) {
            return Ok(known.clone());
        }
        let entity = self.file.entity(instance)?;
        if entity.kind != "COORDINATES_LIST" {
            return Err(entity.unknown("a list of coordinates"));
        }
        let scale = self.units.millimetres();
        let point = |value: &Value<'_>| match numbers_of(value).as_deref() {
            Some(&[x, y, z]) => Some(scale * DVec3::new(x, y, z)),
            _ => None,
        };
        let points: Option<Vec<DVec3>> = entity.list(2)?.iter().map(point).collect();
        let points = Rc::new(points.ok_or_else(|| entity.fault(2, "a list of points"))?);
        self.coordinates.insert(instance, points.clone());
        Ok(points)
    }
}

/// Returns the triangles of a strip, all of one side.
fn strip(corners: &[usize]) -> impl Iterator<Item = [usize; 3]> {
    corners.windows(3).enumerate().map(|(index, corners)| match corners {
        &[a, b, c] if index % 2 == 0 => [a, b, c],
        corners => [corners[1], corners[0], corners[2]],
    })
}

/// Returns the indices, from 1, in a list.
fn indices(
    entity: &Entity<'_>,
    attribute: usize,
    value: &Value<'_>,
    highest: usize,
) -> Result<Vec<usize>, FaceFault> {
    let Value::List(values) = value else { return Err(entity.fault(attribute, "a list of indices")) };
    let index = |value: &Value<'_>| count(value, highest).filter(|&index| index > 0);
    let found: Option<Vec<usize>> = values.iter().map(index).collect();
    found.ok_or_else(|| entity.fault(attribute, &format!("a list of indices, 1 to {highest}")))
}

/// Returns the lists of indices in a list.
fn lists(entity: &Entity<'_>, attribute: usize, highest: usize) -> Result<Vec<Vec<usize>>, FaceFault> {
    entity.list(attribute)?.iter().map(|value| indices(entity, attribute, value, highest)).collect()
}
