//! The faces of a model: a surface with what trims and names it.

use super::NurbsSurface;
use super::trim::{FaceArrays, Trim, TrimCurveArrays, extended_surface};
use crate::error::{Error, Result};
use crate::limits::is_in_range;
use crate::one_line::one_line;

/// The properties of a face beside its surface.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct FaceData {
    /// The loops as given, for writing, and as validated.
    pub(super) trim: Option<(Vec<Vec<TrimCurveArrays>>, Trim)>,
    pub(super) reversed: bool,
    pub(super) name: Option<String>,
    pub(super) kind: Option<String>,
    /// The gap of the surface alone.
    pub(super) gap: f64,
    pub(super) gap_measured: bool,
    pub(super) color: Option<[f64; 3]>,
    pub(super) shell: Option<u32>,
    pub(super) solid: Option<u32>,
}

/// One face of a model, borrowed.
#[derive(Debug, Clone, Copy)]
pub struct Face<'a> {
    surface: &'a NurbsSurface,
    data: &'a FaceData,
}

impl<'a> Face<'a> {
    pub(super) fn new(surface: &'a NurbsSurface, data: &'a FaceData) -> Self {
        Self { surface, data }
    }

    /// Returns the whole surface.
    #[must_use]
    pub fn surface(&self) -> &'a NurbsSurface {
        self.surface
    }

    /// Returns the trimmed region, or `None` for the whole surface.
    #[must_use]
    pub fn trim(&self) -> Option<&'a Trim> {
        self.data.trim.as_ref().map(|(_, trim)| trim)
    }

    /// Returns the name of the face in its source, if it has one, as [`crate::one_line`] shows it.
    #[must_use]
    pub fn name(&self) -> Option<&'a str> {
        self.data.name.as_deref()
    }

    /// Returns the kind of surface in the source, if it is stated: for example `cylinder`.
    #[must_use]
    pub fn kind(&self) -> Option<&'a str> {
        self.data.kind.as_deref()
    }

    /// Returns the face's colour in its source, if it has one: red, green and blue of sRGB, each from 0
    /// to 1.
    #[must_use]
    pub fn color(&self) -> Option<[f64; 3]> {
        self.data.color
    }

    /// Returns the number of the shell that the face belongs to in its source, if that has shells.
    #[must_use]
    pub fn shell(&self) -> Option<u32> {
        self.data.shell
    }

    /// Returns the number of the solid that the face bounds in its source, if that has solids.
    #[must_use]
    pub fn solid(&self) -> Option<u32> {
        self.data.solid
    }

    /// Returns whether the face's normal is opposite to the surface's.
    #[must_use]
    pub fn is_reversed(&self) -> bool {
        self.data.reversed
    }

    /// Returns the distance, in model units, between the face and its source as its reader
    /// states it: that of the surface and that of the trimming curves, which may be measured.
    #[must_use]
    pub fn gap(&self) -> f64 {
        self.data.gap + self.trim().map_or(0.0, Trim::gap)
    }

    /// Returns whether [`Self::gap`] is an upper bound, as far as the reader knows.
    #[must_use]
    pub fn is_gap_proven(&self) -> bool {
        !self.data.gap_measured
    }

    /// Returns the face as plain arrays; its loops are those that it was made of. O(size).
    #[must_use]
    pub fn to_arrays(&self) -> FaceArrays {
        FaceArrays {
            surface: self.surface.clone().into_arrays(),
            trim: self.data.trim.as_ref().map(|(arrays, _)| arrays.clone()),
            reversed: self.data.reversed,
            face_name: self.data.name.clone(),
            kind: self.data.kind.clone(),
            gap: self.data.gap,
            gap_measured: self.data.gap_measured,
            color: self.data.color,
            shell: self.data.shell,
            solid: self.data.solid,
        }
    }
}

/// The loops of a face, not validated.
pub(super) type Loops = Vec<Vec<TrimCurveArrays>>;

/// Validates the arrays of face number `index` but for its loops, which are returned.
///
/// # Errors
/// Those of [`NurbsSurface::new`], [`Error::GapInvalid`].
pub(super) fn untrimmed(index: usize, arrays: FaceArrays) -> Result<(NurbsSurface, FaceData, Option<Loops>)> {
    let FaceArrays { surface, trim, reversed, face_name: name, kind, gap, gap_measured, color, shell, solid } =
        arrays;
    let surface = NurbsSurface::new(index, surface)?;
    if !(gap >= 0.0 && is_in_range(gap)) {
        return Err(Error::GapInvalid { surface: index, found: gap });
    }
    if color.is_some_and(|color| !color.iter().all(|part| (0.0..=1.0).contains(part))) {
        let found = color.unwrap_or_default();
        return Err(Error::out_of_range("color", found, "red, green and blue from 0 to 1"));
    }
    let [name, kind] = [name, kind].map(|text| text.map(|text| one_line(&text)));
    Ok((surface, FaceData { trim: None, reversed, name, kind, gap, gap_measured, color, shell, solid }, trim))
}

/// Validates the loops of surface number `index`. A surface whose trimming curves leave its
/// domain by up to 5 % of the range is extended to them; else none is returned.
///
/// # Errors
/// [`Error::Trim`].
pub(super) fn trimmed(
    index: usize,
    surface: &NurbsSurface,
    loops: &[Vec<TrimCurveArrays>],
) -> Result<(Option<NurbsSurface>, Trim)> {
    let in_face = |fault| Error::Trim { surface: index, fault };
    let extended = extended_surface(surface, loops).map_err(in_face)?;
    let trim = Trim::validated(extended.as_ref().unwrap_or(surface), loops).map_err(in_face)?;
    Ok((extended, trim))
}

impl FaceData {
    /// Returns the same data for the image of the face under a map that lengthens no
    /// distance by more than `factor`, placed by an instance of this name.
    pub(super) fn placed(&self, factor: f64, reflected: bool, instance: Option<&str>) -> Self {
        let scaled = |curve: &TrimCurveArrays| TrimCurveArrays { gap: factor * curve.gap, ..curve.clone() };
        let trim = self.trim.as_ref().map(|(loops, trim)| {
            let loops = loops.iter().map(|curves| curves.iter().map(scaled).collect()).collect();
            (loops, trim.scaled(factor))
        });
        let name = match (instance, &self.name) {
            (Some(instance), Some(part)) => Some(format!("{instance} / {part}")),
            (Some(instance), None) => Some(instance.to_owned()),
            (None, part) => part.clone(),
        };
        Self {
            trim,
            reversed: self.reversed != reflected,
            name,
            kind: self.kind.clone(),
            gap: factor * self.gap,
            gap_measured: self.gap_measured,
            color: self.color,
            shell: self.shell,
            solid: self.solid,
        }
    }
}
