//! Reading and writing of the interchange JSON.

use super::{Model, NurbsSurface, SurfaceArrays};
use crate::axis::Axis;
use crate::error::{Error, Result};
use serde::{Deserialize, Serialize};

#[derive(Serialize, Deserialize)]
struct InterchangeModel {
    #[serde(default, skip_serializing_if = "Option::is_none")]
    name: Option<String>,
    surfaces: Vec<InterchangeSurface>,
}

#[derive(Serialize, Deserialize)]
struct InterchangeSurface {
    degree: [usize; 2],
    knots_u: Vec<f64>,
    knots_v: Vec<f64>,
    ctrl: Vec<Vec<[f64; 4]>>,
}

impl InterchangeSurface {
    fn into_arrays(self, surface: usize) -> Result<SurfaceArrays> {
        let columns = self.ctrl.first().map_or(0, Vec::len);
        if let Some((index, row)) = self.ctrl.iter().enumerate().find(|(_, row)| row.len() != columns) {
            return Err(Error::RaggedNet { surface, index, found: row.len(), expected: columns });
        }
        Ok(SurfaceArrays {
            degree: self.degree,
            knots: [self.knots_u, self.knots_v],
            counts: [self.ctrl.len(), columns],
            control_points: self.ctrl.into_iter().flatten().collect(),
        })
    }

    fn from_surface(surface: &NurbsSurface) -> Self {
        Self {
            degree: surface.degree(),
            knots_u: surface.knots(Axis::U).to_vec(),
            knots_v: surface.knots(Axis::V).to_vec(),
            ctrl: surface.control_points().chunks(surface.counts()[1]).map(<[_]>::to_vec).collect(),
        }
    }
}

/// Returns the error for a text that `serde_json` rejected, with the path to the
/// error, such as `surfaces[0].degree`. Tracking the path makes parsing slower by a
/// third, so only texts with an error are parsed with it.
fn shape_error(text: &str, error: &serde_json::Error) -> Error {
    let mut reader = serde_json::Deserializer::from_str(text);
    let located = serde_path_to_error::deserialize::<_, InterchangeModel>(&mut reader);
    // Text after the model has no path.
    Error::JsonShape { found: located.map_or_else(|located| located.to_string(), |_| error.to_string()) }
}

impl Model {
    /// The largest JSON text accepted, in bytes: 256 MiB, about 2.5 million control
    /// points. A 32-bit wasm memory could not hold a longer text and its model
    /// together.
    pub const MAX_JSON_BYTES: u64 = 256 << 20;

    /// Parses `{"name"?, "surfaces": [{"degree": [pu, pv], "knots_u", "knots_v",
    /// "ctrl": [[[x, y, z, w], …], …]}]}` with `ctrl[i][j]`, i along u, points
    /// not multiplied by w. Other keys are ignored. O(size).
    ///
    /// # Errors
    /// [`Error::FileTooLarge`] over [`Model::MAX_JSON_BYTES`], [`Error::JsonShape`]
    /// for text that is not of this shape, else the errors of [`NurbsSurface::new`].
    pub fn from_json(text: &str) -> Result<Self> {
        let found = text.len() as u64;
        if found > Self::MAX_JSON_BYTES {
            return Err(Error::FileTooLarge { found, expected: Self::MAX_JSON_BYTES });
        }
        let parsed: InterchangeModel =
            serde_json::from_str(text).map_err(|error| shape_error(text, &error))?;
        let surfaces = parsed
            .surfaces
            .into_iter()
            .enumerate()
            .map(|(index, surface)| surface.into_arrays(index))
            .collect::<Result<Vec<_>>>()?;
        Self::from_arrays(parsed.name, surfaces)
    }

    /// Returns the model as interchange JSON, with every number in full precision.
    ///
    /// # Errors
    /// [`Error::JsonShape`] if the writer fails, which it does not for valid models.
    pub fn to_json(&self) -> Result<String> {
        let model = InterchangeModel {
            name: self.name().map(str::to_owned),
            surfaces: self.surfaces().iter().map(InterchangeSurface::from_surface).collect(),
        };
        serde_json::to_string(&model).map_err(|error| Error::JsonShape { found: error.to_string() })
    }
}
