//! The faces of a model: a surface with what trims and names it.

use super::NurbsSurface;
use super::trim::{FaceArrays, Trim, TrimCurveArrays, surface_for};
use crate::error::{Error, Result};
use crate::limits::is_in_range;

/// What a face has beside its surface.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct FaceData {
    /// The loops as given, for writing, and as validated.
    pub(super) trim: Option<(Vec<Vec<TrimCurveArrays>>, Trim)>,
    pub(super) reversed: bool,
    pub(super) part: Option<String>,
    pub(super) kind: Option<String>,
    /// The gap of the surface alone.
    pub(super) gap: f64,
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

    /// Returns the name of the face in its source, if it has one.
    #[must_use]
    pub fn part(&self) -> Option<&'a str> {
        self.data.part.as_deref()
    }

    /// Returns the kind of surface in the source, such as `cylinder`, if it is stated.
    #[must_use]
    pub fn kind(&self) -> Option<&'a str> {
        self.data.kind.as_deref()
    }

    /// Returns whether the face's normal is opposite to the surface's.
    #[must_use]
    pub fn is_reversed(&self) -> bool {
        self.data.reversed
    }

    /// Returns the upper bound, in model units, on the distance between the face and its
    /// source: that of the surface and that of the trimming curves.
    #[must_use]
    pub fn gap(&self) -> f64 {
        self.data.gap + self.trim().map_or(0.0, Trim::gap)
    }

    /// Returns the face as plain arrays; its loops are those that it was made of. O(size).
    #[must_use]
    pub fn to_arrays(&self) -> FaceArrays {
        FaceArrays {
            surface: self.surface.clone().into_arrays(),
            trim: self.data.trim.as_ref().map(|(arrays, _)| arrays.clone()),
            reversed: self.data.reversed,
            part: self.data.part.clone(),
            kind: self.data.kind.clone(),
            gap: self.data.gap,
        }
    }
}

/// Validates the arrays of face number `index`. A surface whose trimming curves leave its
/// domain by up to 5 % of the range is extended to them.
///
/// # Errors
/// Those of [`NurbsSurface::new`], [`Error::GapInvalid`], [`Error::Trim`].
pub(super) fn validated(index: usize, arrays: FaceArrays) -> Result<(NurbsSurface, FaceData)> {
    let FaceArrays { surface, trim, reversed, part, kind, gap } = arrays;
    let mut surface = NurbsSurface::new(index, surface)?;
    if !(gap >= 0.0 && is_in_range(gap)) {
        return Err(Error::GapInvalid { surface: index, found: gap });
    }
    let trim = match trim {
        None => None,
        Some(loops) => {
            surface = surface_for(surface, &loops).map_err(|fault| Error::Trim { surface: index, fault })?;
            let trim = Trim::new(index, &surface, loops.clone())?;
            Some((loops, trim))
        }
    };
    Ok((surface, FaceData { trim, reversed, part, kind, gap }))
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
        let part = match (instance, &self.part) {
            (Some(instance), Some(part)) => Some(format!("{instance} / {part}")),
            (Some(instance), None) => Some(instance.to_owned()),
            (None, part) => part.clone(),
        };
        Self {
            trim,
            reversed: self.reversed != reflected,
            part,
            kind: self.kind.clone(),
            gap: factor * self.gap,
        }
    }
}
