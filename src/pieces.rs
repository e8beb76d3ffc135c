//! The faces of a model as untrimmed pieces, which every later stage measures.

use crate::bvh::Aabb;
use crate::certified::TrimmedFaces;
use crate::error::{Error, Result};
use crate::model::trim::Trim;
use crate::model::{Face, Model, NurbsSurface};
use crate::solid::SurfaceOrigin;
use crate::surface_point::SurfacePoint;
use crate::threads::parallel::{Watch, map_watched};
use crate::untrim::{ParameterMap, Piece, Untrimmed, untrim};
use glam::DVec3;
use std::borrow::Cow;
use std::ops::Range;
use std::sync::Arc;

/// The largest deviation of the pieces from the faces, relative to the diagonal of the
/// model: three digits below the default tolerance.
const MAX_DEVIATION: f64 = 1e-9;

/// The largest part of the sum of the areas' sizes at the rim of a piece that rounding may make of their own sum: parameters
/// are rounded to about 1e-16 of their size, and a piece may be as narrow as 1e-9 of it.
const TURNING_ROUNDING: f64 = 1e-6;

/// The points of each side of a piece whose polygon in the plane of parameters tells which way it turns.
const RIM_STEPS: u32 = 8;

/// The pieces of every face, in the order of the faces, and the way back to the faces.
///
/// An untrimmed face is one piece, itself. Later stages see the pieces as the surfaces of
/// an untrimmed model, and results are converted by [`FacePieces::surface_point`].
#[derive(Debug, Clone)]
pub(crate) struct FacePieces {
    /// The face of each piece, with the map to its parameters.
    origins: Arc<[(usize, ParameterMap)]>,
    /// The pieces of each face.
    faces: Vec<Range<usize>>,
    /// What is known of each face beside its surface.
    of_faces: Vec<FaceNotes>,
    /// An upper bound on the Hausdorff distance between each face and its pieces, the
    /// largest over all faces.
    deviation: f64,
}

/// What is known of a face beside its surface; of facets the name alone.
#[derive(Debug, Clone, Default)]
struct FaceNotes {
    name: Option<String>,
    /// Whether its normal is opposite to that of its surface.
    reversed: bool,
    color: Option<[f64; 3]>,
    /// Its shell and its solid in its source.
    shell: Option<u32>,
    solid: Option<u32>,
}

impl FaceNotes {
    fn of(face: &Face<'_>) -> Self {
        let (reversed, color) = (face.is_reversed(), face.color());
        let (shell, solid) = (face.shell(), face.solid());
        Self { name: face.name().map(str::to_owned), reversed, color, shell, solid }
    }

    fn of_all(model: &Model) -> Vec<Self> {
        model.faces().map(|face| Self::of(&face)).collect()
    }
}

/// The faces of a model that can be cut.
pub(crate) struct Cuttable {
    /// The model of these faces.
    pub(crate) model: Model,
    pub(crate) pieces: FacePieces,
    pub(crate) untrimmed: Model,
    /// The other faces.
    pub(crate) refused: Vec<(usize, Error)>,
}

impl FacePieces {
    /// Cuts the trimmed faces into pieces, on all cores; returns the pieces as an untrimmed
    /// model, which is `model` itself if no face is trimmed.
    ///
    /// # Errors
    /// [`crate::Error::FaceNotCut`].
    pub(crate) fn new(model: &Model) -> Result<(Self, Cow<'_, Model>)> {
        if !model.is_trimmed() {
            let count = model.surfaces().len();
            let pieces = Self {
                origins: (0..count).map(|face| (face, ParameterMap::Identity)).collect(),
                faces: (0..count).map(|face| face..face + 1).collect(),
                of_faces: FaceNotes::of_all(model),
                deviation: 0.0,
            };
            return Ok((pieces, Cow::Borrowed(model)));
        }
        let cuts = cuts(model, None).into_iter().collect::<Result<Vec<_>>>()?;
        let (pieces, untrimmed) = Self::of_cuts(model, cuts)?;
        Ok((pieces, Cow::Owned(untrimmed)))
    }

    /// Returns the pieces of a model of facets: a face of each of these names, without patches.
    pub(crate) fn of_facets(face_names: Vec<Option<String>>) -> Self {
        let faces = vec![0..0; face_names.len()];
        let of_faces = face_names.into_iter().map(|name| FaceNotes { name, ..FaceNotes::default() });
        Self { origins: Arc::new([]), faces, of_faces: of_faces.collect(), deviation: 0.0 }
    }

    /// Returns some of the pieces, which are those of these faces; both are in order, and numbered anew.
    pub(crate) fn some(&self, pieces: &[u32], faces: &[usize]) -> Self {
        let mut origins: Vec<(usize, ParameterMap)> = Vec::with_capacity(pieces.len());
        let mut ranges = Vec::with_capacity(faces.len());
        let mut rest = pieces.iter().map(|&piece| &self.origins[piece as usize]).peekable();
        for (face, &whole) in faces.iter().enumerate() {
            let first = origins.len();
            while let Some((_, map)) = rest.next_if(|(of, _)| *of == whole) {
                origins.push((face, map.clone()));
            }
            ranges.push(first..origins.len());
        }
        Self {
            origins: origins.into(),
            faces: ranges,
            of_faces: faces.iter().map(|&face| self.of_faces[face].clone()).collect(),
            deviation: self.deviation,
        }
    }

    /// As [`FacePieces::new`] for the model without its faces that cannot be cut; with that
    /// model, and the errors of those faces by their index in `model`. Calls the listener with each cut.
    ///
    /// # Errors
    /// [`crate::Error::FaceNotCut`] if no face can be cut.
    pub(crate) fn of_cuttable(model: Model, watch: Watch<'_, Result<Untrimmed>>) -> Result<Cuttable> {
        if !model.is_trimmed() {
            let (pieces, untrimmed) = Self::new(&model)?;
            let untrimmed = untrimmed.into_owned();
            return Ok(Cuttable { model, pieces, untrimmed, refused: Vec::new() });
        }
        let cuts = cuts(&model, watch);
        Self::without_failures(model, cuts)
    }

    /// Makes the pieces of the faces whose cutting did not fail.
    fn without_failures(model: Model, cuts: Vec<Result<Untrimmed>>) -> Result<Cuttable> {
        let (mut kept, mut refused) = (Vec::new(), Vec::new());
        for (face, cut) in cuts.into_iter().enumerate() {
            match cut {
                Ok(cut) => kept.push(cut),
                Err(error) => refused.push((face, error)),
            }
        }
        if kept.is_empty() && !refused.is_empty() {
            return Err(refused.swap_remove(0).1);
        }
        let model = if refused.is_empty() {
            model
        } else {
            model.without_faces(|face| refused.iter().any(|&(other, _)| other == face))?
        };
        let (pieces, untrimmed) = Self::of_cuts(&model, kept)?;
        Ok(Cuttable { model, pieces, untrimmed, refused })
    }

    /// Makes the pieces of all faces, with the untrimmed model.
    fn of_cuts(model: &Model, cuts: Vec<Untrimmed>) -> Result<(Self, Model)> {
        let (mut origins, mut faces, mut deviation) = (Vec::new(), Vec::new(), 0.0_f64);
        let mut surfaces: Vec<NurbsSurface> = Vec::new();
        for (face, untrimmed) in cuts.into_iter().enumerate() {
            deviation = deviation.max(untrimmed.deviation);
            let first = surfaces.len();
            for Piece { surface, map } in untrimmed.pieces {
                surfaces.push(surface);
                origins.push((face, map));
            }
            faces.push(first..surfaces.len());
        }
        let name = model.name().map(str::to_owned);
        let pieces = Self { origins: origins.into(), faces, of_faces: FaceNotes::of_all(model), deviation };
        Ok((pieces, Model::new(name, surfaces)?))
    }

    /// Returns the faces of `model`, which these are the pieces of, for bounds over whole faces.
    pub(crate) fn trimmed_faces(&self, model: &Model) -> TrimmedFaces {
        TrimmedFaces::new(model.clone(), Arc::clone(&self.origins))
    }

    /// Returns the number of faces.
    pub(crate) fn face_count(&self) -> usize {
        self.faces.len()
    }

    /// Returns the pieces of each face.
    pub(crate) fn faces(&self) -> &[Range<usize>] {
        &self.faces
    }

    /// Returns the face of a piece.
    pub(crate) fn face(&self, piece: usize) -> usize {
        self.origins[piece].0
    }

    /// Returns the colour of a face, if it has one.
    pub(crate) fn face_color(&self, face: usize) -> Option<[f64; 3]> {
        self.of_faces.get(face).and_then(|notes| notes.color)
    }

    /// Returns where a piece comes from.
    pub(crate) fn origin(&self, piece: usize) -> SurfaceOrigin {
        let face = self.face(piece);
        let (is_turned, is_reversed) = (self.turns_over(piece), self.is_turned(piece));
        // Faces of one solid are joined first where the source has no shells.
        let FaceNotes { shell, solid, .. } = self.of_faces[face];
        SurfaceOrigin { face, is_turned, is_reversed, shell: shell.or(solid) }
    }

    /// Returns the name of a face, if it has one.
    pub(crate) fn face_name(&self, face: usize) -> Option<&str> {
        self.of_faces[face].name.as_deref()
    }

    /// Returns, for each piece, the parts of the samples and cells along both parameters of
    /// a whole surface that it gets.
    ///
    /// The pieces of a face have as many together as a whole surface, about evenly spaced:
    /// a piece of size a x b, of a face whose pieces have the area S, gets a / √S and
    /// b / √S, at most 1. Sizes are mean lengths of control polygons. O(control points).
    pub(crate) fn shares(&self, surfaces: &[NurbsSurface]) -> Vec<[f64; 2]> {
        let mut shares = Vec::with_capacity(surfaces.len());
        for pieces in &self.faces {
            if pieces.len() == 1 {
                shares.push([1.0; 2]);
                continue;
            }
            let sizes: Vec<[f64; 2]> = surfaces[pieces.clone()].iter().map(size).collect();
            let side = sizes.iter().map(|[a, b]| a * b).sum::<f64>().sqrt();
            let share = |length: f64| if side > 0.0 { (length / side).min(1.0) } else { 1.0 };
            shares.extend(sizes.iter().map(|size| size.map(share)));
        }
        shares
    }

    /// Returns the upper bound on the Hausdorff distance between the faces and their pieces.
    pub(crate) fn deviation(&self) -> f64 {
        self.deviation
    }

    /// Returns the number of the solid that the face of a piece bounds in its source.
    pub(crate) fn solid(&self, piece: usize) -> Option<u32> {
        self.of_faces[self.face(piece)].solid
    }

    /// Returns whether the normal of a piece, that of its parameters, is opposite to its face's: the face may be
    /// reversed, and the map of a piece's parameters may turn the plane over.
    pub(crate) fn is_turned(&self, piece: usize) -> bool {
        self.of_faces[self.face(piece)].reversed != self.turns_over(piece).unwrap_or_default()
    }

    /// Returns whether the map of a piece's parameters turns the plane over; none of a piece so thin that rounding might
    /// decide it.
    fn turns_over(&self, piece: usize) -> Option<bool> {
        let (_, map @ ParameterMap::Ruled(_)) = &self.origins[piece] else { return Some(false) };
        let corner = |s: f64, t: f64| map.face_parameters([s, t]);
        let steps = || (0..RIM_STEPS).map(|step| f64::from(step) / f64::from(RIM_STEPS));
        let rim: Vec<[f64; 2]> = (steps().map(|s| corner(s, 0.0)))
            .chain(steps().map(|t| corner(1.0, t)))
            .chain(steps().map(|s| corner(1.0 - s, 1.0)))
            .chain(steps().map(|t| corner(0.0, 1.0 - t)))
            .collect();
        let next = rim.iter().skip(1).chain(rim.first());
        let [first_u, first_v] = rim[0];
        let corner_area = |([u, v], [to_u, to_v]): (&[f64; 2], &[f64; 2])| {
            (u - first_u) * (to_v - first_v) - (v - first_v) * (to_u - first_u)
        };
        let areas: Vec<f64> = rim.iter().zip(next).map(corner_area).collect();
        let largest = areas.iter().map(|area| area.abs()).sum::<f64>();
        let area = areas.iter().sum::<f64>();
        (area.abs() > TURNING_ROUNDING * largest).then_some(area < 0.0)
    }

    /// Returns the parameters of a face for those of one of its pieces.
    pub(crate) fn face_parameters(&self, piece: usize, parameters: [f64; 2]) -> [f64; 2] {
        self.origins[piece].1.face_parameters(parameters)
    }

    /// Returns a point of a piece as a point of its face.
    pub(crate) fn surface_point(&self, piece: usize, parameters: [f64; 2], point: DVec3) -> SurfacePoint {
        let [u, v] = self.face_parameters(piece, parameters);
        let surface = self.face(piece);
        let face_name = self.of_faces[surface].name.clone();
        SurfacePoint {
            face: surface,
            face_name,
            u,
            v,
            triangle: None,
            barycentric: None,
            index: None,
            point: point.to_array(),
        }
    }
}

/// Returns the mean lengths of a surface's control polygons along u and v.
fn size(surface: &NurbsSurface) -> [f64; 2] {
    let [rows, columns] = surface.counts();
    let point = |i: usize, j: usize| {
        let [x, y, z, _] = surface.control_points()[i * columns + j];
        DVec3::new(x, y, z)
    };
    let mut lengths = [0.0; 2];
    for i in 0..rows {
        for j in 0..columns {
            if i > 0 {
                lengths[0] += point(i, j).distance(point(i - 1, j)) / columns as f64;
            }
            if j > 0 {
                lengths[1] += point(i, j).distance(point(i, j - 1)) / rows as f64;
            }
        }
    }
    lengths
}

/// Returns the pieces of every face, or its error, on all cores; calls the listener with each result.
fn cuts(model: &Model, watch: Watch<'_, Result<Untrimmed>>) -> Vec<Result<Untrimmed>> {
    let max_deviation = MAX_DEVIATION * extent(model).diagonal();
    let faces: Vec<Face<'_>> = model.faces().collect();
    map_watched(faces.len(), |index| cut(index, &faces[index], max_deviation), watch)
}

/// Returns the pieces of a face and their deviation, with the rounding of the loops.
fn cut(index: usize, face: &Face<'_>, max_deviation: f64) -> Result<Untrimmed> {
    let Some(trim) = face.trim() else {
        let piece = Piece { surface: face.surface().clone(), map: ParameterMap::Identity };
        return Ok(Untrimmed { pieces: vec![piece], deviation: 0.0 });
    };
    let untrimmed = untrim(index, face.surface(), trim, max_deviation)?;
    Ok(Untrimmed { deviation: untrimmed.deviation + trim.rounding(), ..untrimmed })
}

/// Returns a box of about the model's size, that of points on its trimming curves and of
/// the control points of whole surfaces: those of a trimmed surface may be far from the face.
fn extent(model: &Model) -> Aabb {
    let of_trim = |face: &Face<'_>, trim: &Trim| {
        let ends = trim.loops().iter().flatten().map(|piece| piece.start().to_array());
        ends.map(|end| DVec3::from_array(face.surface().point(end))).fold(Aabb::EMPTY, Aabb::with)
    };
    model.faces().fold(Aabb::EMPTY, |aabb, face| {
        aabb.union(match face.trim() {
            Some(trim) => of_trim(&face, trim),
            None => face
                .surface()
                .control_points()
                .iter()
                .map(|&[x, y, z, _]| DVec3::new(x, y, z))
                .fold(Aabb::EMPTY, Aabb::with),
        })
    })
}

#[cfg(all(test, not(target_arch = "wasm32")))]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod tests {
    use super::*;
    use crate::model::ModelArrays;
    use crate::model::trim::{FaceArrays, TrimCurveArrays};
    use crate::read::ReadReport;
    use crate::shapes::figure5_plane;

    /// Faces of the plane, each trimmed by a triangle and named by its number.
    fn triangles(count: usize) -> Model {
        let plane = figure5_plane().unwrap().surfaces()[0].clone();
        let corners = [[0.1, 0.1], [0.9, 0.1], [0.1, 0.9]].map(|corner| plane.domain().at(corner));
        let side = |k: usize| TrimCurveArrays {
            degree: 1,
            knots: vec![0.0, 0.0, 1.0, 1.0],
            control_points: [corners[k], corners[(k + 1) % 3]].map(|[u, v]| [u, v, 1.0]).to_vec(),
            ..TrimCurveArrays::default()
        };
        let surface = plane.clone().into_arrays();
        let face = |number: usize| FaceArrays {
            face_name: Some(format!("face {number}")),
            ..FaceArrays::new(surface.clone(), Some(vec![(0..3).map(side).collect()]))
        };
        Model::from_faces(ModelArrays { faces: (0..count).map(face).collect(), ..ModelArrays::default() })
            .unwrap()
    }

    /// The cuts of the model's faces, with failures at these.
    fn failing(model: &Model, faces: &[usize]) -> Vec<Result<Untrimmed>> {
        let mut cuts = cuts(model, None);
        for &surface in faces {
            cuts[surface] = Err(Error::FaceNotCut { surface, found: "a test".to_owned() });
        }
        cuts
    }

    #[test]
    fn faces_that_cannot_be_cut_are_left_out_and_reported() {
        let model = triangles(3);
        let mut report = ReadReport::of_exact(&model);
        let cuts = failing(&model, &[1]);
        let Cuttable { model, pieces, untrimmed, refused } =
            FacePieces::without_failures(model, cuts).unwrap();
        let names: Vec<_> = model.faces().map(|face| face.name().unwrap().to_owned()).collect();
        assert_eq!(names, ["face 0", "face 2"]);
        assert_eq!((pieces.face_count(), pieces.face_name(1)), (2, Some("face 2")));
        assert_eq!(pieces.faces().last().unwrap().end, untrimmed.surfaces().len());
        report.leave_out(&refused);
        assert_eq!((report.faces, report.skipped.len()), (2, 1));
        let skipped = &report.skipped[0];
        assert_eq!((&skipped.face, skipped.code), (&1.into(), "FACE_NOT_CUT"));
        assert!(skipped.why.contains("surface 1: the trimmed face cannot be cut"), "{}", skipped.why);
    }

    #[test]
    fn a_model_of_which_no_face_can_be_cut_is_an_error() {
        let model = triangles(2);
        let cuts = failing(&model, &[0, 1]);
        let error = FacePieces::without_failures(model, cuts).err().unwrap();
        assert_eq!(error.code(), "FACE_NOT_CUT");
    }
}
