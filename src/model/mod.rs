//! The input: NURBS surfaces and rigid transforms, validated once.

mod affine_map;
mod arrays;
mod evaluate;
mod extension;
mod face;
mod face_path;
mod json;
mod knots;
mod lipschitz;
mod rigid_transform;
mod surface;
pub mod trim;

pub use arrays::{IDENTITY, InstanceArrays, ModelArrays};
pub use face::Face;
pub use face_path::face_path;
pub use face_path::level;
pub use knots::blossom;
pub(crate) use knots::{Span, blossom_coefficients, breaks, multiplicities, spans};
pub use rigid_transform::RigidTransform;
pub use surface::{NurbsSurface, SurfaceArrays};

use crate::bvh::Aabb;
use crate::error::{Error, Result};
use crate::one_line::one_line;
use crate::threads::parallel::map;
use affine_map::AffineMap;
use face::FaceData;
use glam::DVec3;
use std::collections::HashMap;
use trim::FaceArrays;

/// A non-empty list of NURBS surfaces, each whole or trimmed, measured as one set of points.
#[derive(Debug, Clone, PartialEq)]
pub struct Model {
    name: Option<String>,
    unit: Option<f64>,
    surfaces: Vec<NurbsSurface>,
    /// One entry a surface.
    faces: Vec<FaceData>,
}

/// The units accepted, in metres per coordinate unit: their ratios are in range.
const UNITS: std::ops::RangeInclusive<f64> = 1e-30..=1e30;

/// The largest number of faces of a model after the placement of its instances.
pub const MAX_FACES: usize = 1 << 20;

/// Returns whether a number of metres is a unit that a model may have.
pub(crate) fn is_unit(metres: f64) -> bool {
    UNITS.contains(&metres)
}

impl Model {
    /// Makes a model of these surfaces, untrimmed and without unit.
    ///
    /// # Errors
    /// [`Error::EmptyModel`] without surfaces.
    pub fn new(name: Option<String>, surfaces: Vec<NurbsSurface>) -> Result<Self> {
        let faces = vec![FaceData::default(); surfaces.len()];
        Self::of_faces(name, None, surfaces, faces)
    }

    fn of_faces(
        name: Option<String>,
        unit: Option<f64>,
        surfaces: Vec<NurbsSurface>,
        faces: Vec<FaceData>,
    ) -> Result<Self> {
        if surfaces.is_empty() {
            return Err(Error::EmptyModel);
        }
        if let Some(found) = unit.filter(|unit| !UNITS.contains(unit)) {
            return Err(Error::UnitInvalid { found });
        }
        let name = name.map(|name| one_line(&name));
        Ok(Self { name, unit, surfaces, faces })
    }

    /// Makes a model of surfaces given as plain arrays, which it validates.
    ///
    /// # Errors
    /// Those of [`NurbsSurface::new`] and [`Model::new`].
    pub fn from_arrays(name: Option<String>, surfaces: Vec<SurfaceArrays>) -> Result<Self> {
        let surfaces = surfaces
            .into_iter()
            .enumerate()
            .map(|(index, arrays)| NurbsSurface::new(index, arrays))
            .collect::<Result<_>>()?;
        Self::new(name, surfaces)
    }

    /// Makes a model of trimmed faces and their placements, which it validates.
    ///
    /// With instances the model has, in order, the faces of each instance, their
    /// control points mapped by its transform, and named `instance / part`. Faces are
    /// validated on all cores.
    ///
    /// # Errors
    /// Those of [`NurbsSurface::new`] and [`Model::new`], [`Error::Trim`],
    /// [`Error::GapInvalid`], [`Error::UnitInvalid`], [`Error::InstanceSurface`],
    /// [`Error::InstanceTransform`], [`Error::TooManyFaces`].
    pub fn from_faces(arrays: ModelArrays) -> Result<Self> {
        let ModelArrays { name, unit, faces, instances } = arrays;
        let faces = validated(faces)?;
        let (surfaces, faces) =
            if instances.is_empty() { faces } else { placed(&faces, &instances)? }.into_iter().unzip();
        Self::of_faces(name, unit, surfaces, faces)
    }

    /// Returns the model with other control points on the same knots of one surface.
    ///
    /// # Errors
    /// [`Error::OptionOutOfRange`] if there is no such surface, [`Error::ModelTrimmed`] if
    /// it is trimmed, those of [`NurbsSurface::new`].
    pub fn with_control_points(&self, surface: usize, control_points: Vec<[f64; 4]>) -> Result<Self> {
        let mut model = self.clone();
        let Some(changed) = model.surfaces.get_mut(surface) else {
            let expected = "the index of a surface";
            return Err(Error::OptionOutOfRange { option: "surface", found: surface.to_string(), expected });
        };
        if self.faces[surface].trim.is_some() {
            return Err(Error::ModelTrimmed { surface });
        }
        *changed =
            NurbsSurface::new(surface, SurfaceArrays { control_points, ..changed.clone().into_arrays() })?;
        Ok(model)
    }

    /// Returns the model without the faces of these indices.
    ///
    /// # Errors
    /// [`Error::EmptyModel`] if none is left.
    pub(crate) fn without_faces(&self, leaves_out: impl Fn(usize) -> bool) -> Result<Self> {
        let kept = |index: &usize| !leaves_out(*index);
        let indices = || (0..self.surfaces.len()).filter(kept);
        let surfaces = indices().map(|index| self.surfaces[index].clone()).collect();
        let faces = indices().map(|index| self.faces[index].clone()).collect();
        Self::of_faces(self.name.clone(), self.unit, surfaces, faces)
    }

    /// Returns the name of the model, if it has one.
    #[must_use]
    pub fn name(&self) -> Option<&str> {
        self.name.as_deref()
    }

    /// Returns the metres per coordinate unit, if they are known.
    #[must_use]
    pub fn unit(&self) -> Option<f64> {
        self.unit
    }

    /// Returns the model with coordinates in units of this many metres, whatever it stated. Nothing is scaled.
    ///
    /// # Errors
    /// [`Error::UnitInvalid`].
    pub fn with_unit(self, metres: f64) -> Result<Self> {
        if !is_unit(metres) {
            return Err(Error::UnitInvalid { found: metres });
        }
        Ok(Self { unit: Some(metres), ..self })
    }

    /// Returns the surfaces, at least one, each whole; [`Model::faces`] have their trims.
    #[must_use]
    pub fn surfaces(&self) -> &[NurbsSurface] {
        &self.surfaces
    }

    /// Returns the faces, one a surface. Those of a BREP text are in the order of OpenCASCADE's
    /// `TopExp_Explorer`, each once at its place, without those that were skipped.
    pub fn faces(&self) -> impl ExactSizeIterator<Item = Face<'_>> {
        self.surfaces.iter().zip(&self.faces).map(|(surface, data)| Face::new(surface, data))
    }

    /// Returns whether a face is trimmed.
    #[must_use]
    pub fn is_trimmed(&self) -> bool {
        self.faces.iter().any(|face| face.trim.is_some())
    }

    /// Returns the distance, in model units, between the model and its source as its reader
    /// states it: the largest gap of a face.
    #[must_use]
    pub fn gap(&self) -> f64 {
        self.faces().map(|face| face.gap()).fold(0.0, f64::max)
    }

    /// Returns whether [`Self::gap`] is an upper bound, as far as the reader knows: no face's
    /// was measured at points.
    #[must_use]
    pub fn is_gap_proven(&self) -> bool {
        self.faces().all(|face| face.is_gap_proven())
    }

    /// Returns the model with its surfaces, in order, replaced by images under a map that
    /// lengthens no distance by more than `stretch` and keeps their parameters.
    pub(crate) fn with_images(&self, images: Vec<NurbsSurface>, stretch: f64, unit: Option<f64>) -> Self {
        let faces = self.faces.iter().map(|face| face.placed(stretch, false, None)).collect();
        Self { name: self.name.clone(), unit, surfaces: images, faces }
    }

    /// Returns the model in a unit of this many metres; unchanged if it has none.
    ///
    /// # Errors
    /// [`Error::UnitInvalid`], and [`Error::NumberTooLarge`] for scaled coordinates.
    pub fn scaled_to_unit(&self, unit: f64) -> Result<Self> {
        let Some(own) = self.unit.filter(|&own| own != unit) else { return Ok(self.clone()) };
        if !UNITS.contains(&unit) {
            return Err(Error::UnitInvalid { found: unit });
        }
        self.scaled(own / unit, Some(unit))
    }

    /// Returns the model with all coordinates times a positive factor, in this unit.
    ///
    /// # Errors
    /// [`Error::NumberTooLarge`] for scaled coordinates.
    pub(crate) fn scaled(&self, factor: f64, unit: Option<f64>) -> Result<Self> {
        let map = AffineMap::scaling(factor);
        let images = self.surfaces.iter().enumerate().map(|(index, surface)| map.apply(index, surface));
        Ok(self.with_images(images.collect::<Result<_>>()?, map.stretch(), unit))
    }

    /// Returns the box of all control points, which contains the model. O(control points).
    #[must_use]
    pub fn bounding_box(&self) -> Aabb {
        self.surfaces
            .iter()
            .flat_map(NurbsSurface::control_points)
            .fold(Aabb::EMPTY, |aabb, &[x, y, z, _]| aabb.with(DVec3::new(x, y, z)))
    }
}

/// Returns the validated faces.
fn validated(faces: Vec<FaceArrays>) -> Result<Vec<(NurbsSurface, FaceData)>> {
    let faces = faces.into_iter().enumerate().map(|(index, arrays)| face::untrimmed(index, arrays));
    let faces = faces.collect::<Result<Vec<_>>>()?;
    let trims = map(faces.len(), |index| {
        let (surface, _, loops) = &faces[index];
        loops.as_ref().map(|loops| face::trimmed(index, surface, loops)).transpose()
    });
    let mut joined = Vec::with_capacity(faces.len());
    for ((surface, data, loops), trim) in faces.into_iter().zip(trims) {
        joined.push(match trim?.zip(loops) {
            Some(((extended, trim), loops)) => {
                (extended.unwrap_or(surface), FaceData { trim: Some((loops, trim)), ..data })
            }
            None => (surface, data),
        });
    }
    Ok(joined)
}

/// What a placed face is of: a solid that instances state, or an instance that states none.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
enum Use {
    Solid(u32),
    Instance(usize),
}

/// Returns the faces of each instance, placed by its transform.
fn placed(
    faces: &[(NurbsSurface, FaceData)],
    instances: &[InstanceArrays],
) -> Result<Vec<(NurbsSurface, FaceData)>> {
    let found = instances.iter().map(|instance| instance.surfaces.len()).sum();
    if found > MAX_FACES {
        return Err(Error::TooManyFaces { found, expected: MAX_FACES });
    }
    let mut all = Vec::with_capacity(found);
    // Each use of a shell or a solid is one of its own.
    let [mut shells, mut solids] = [HashMap::new(), HashMap::new()];
    for (instance, arrays) in instances.iter().enumerate() {
        let map = AffineMap::new(instance, &arrays.transform)?;
        let name = arrays.name.as_deref().map(one_line);
        let stretch = if arrays.transform == IDENTITY { 1.0 } else { map.stretch() };
        for &found in &arrays.surfaces {
            let expected = faces.len();
            let (surface, data) =
                faces.get(found).ok_or(Error::InstanceSurface { instance, found, expected })?;
            let mut data = data.placed(stretch, map.reflects(), name.as_deref());
            let of = arrays.solid.map_or(Use::Instance(instance), Use::Solid);
            data.solid = arrays.solid.or(data.solid);
            for (number, known) in [(&mut data.shell, &mut shells), (&mut data.solid, &mut solids)] {
                *number = number.map(|number| {
                    let next = known.len() as u32;
                    *known.entry((of, number)).or_insert(next)
                });
            }
            all.push((map.apply(found, surface)?, data));
        }
    }
    Ok(all)
}
