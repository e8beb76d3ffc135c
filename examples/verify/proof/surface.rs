//! NURBS models as their definition has them: knots and control points as given.

use serde::Deserialize;

/// A model of the interchange JSON, parsed without the library.
#[derive(Debug, Clone, Deserialize)]
pub(crate) struct Model {
    pub(crate) surfaces: Vec<Surface>,
}

/// A NURBS surface; `ctrl[i][j]` is `[x, y, z, w]`, i along u, not multiplied by w.
#[derive(Debug, Clone, Deserialize)]
pub(crate) struct Surface {
    pub(crate) degree: [usize; 2],
    pub(crate) knots_u: Vec<f64>,
    pub(crate) knots_v: Vec<f64>,
    pub(crate) ctrl: Vec<Vec<[f64; 4]>>,
    /// The loops of a trimmed face, which are not read.
    #[serde(default)]
    pub(crate) trim: Option<serde::de::IgnoredAny>,
}

impl Model {
    /// Parses interchange JSON.
    ///
    /// # Errors
    /// A sentence if the text is not of that form or a surface is none: what the extraction
    /// relies on is checked here.
    pub(crate) fn from_json(text: &str) -> Result<Self, String> {
        let model: Self = serde_json::from_str(text).map_err(|error| error.to_string())?;
        if model.surfaces.is_empty() {
            return Err("the model has no surface".to_owned());
        }
        for (index, surface) in model.surfaces.iter().enumerate() {
            surface.check().map_err(|reason| format!("surface {index}: {reason}"))?;
        }
        Ok(model)
    }

    /// Whether a surface has loops.
    pub(crate) fn is_trimmed(&self) -> bool {
        self.surfaces.iter().any(|surface| surface.trim.is_some())
    }

    /// The control points of all surfaces.
    pub(crate) fn points(&self) -> impl Iterator<Item = [f64; 3]> {
        self.surfaces.iter().flat_map(|surface| surface.ctrl.iter().flatten().map(|&[x, y, z, _]| [x, y, z]))
    }
}

impl Surface {
    /// The knots along u (`axis` 0) or v.
    pub(crate) fn knots(&self, axis: usize) -> &[f64] {
        if axis == 0 { &self.knots_u } else { &self.knots_v }
    }

    /// The number of control points along an axis.
    pub(crate) fn count(&self, axis: usize) -> usize {
        if axis == 0 { self.ctrl.len() } else { self.ctrl[0].len() }
    }

    /// The non-empty knot spans of the domain along an axis: indices k with `knots[k] < knots[k + 1]`.
    pub(crate) fn spans(&self, axis: usize) -> Vec<usize> {
        let knots = self.knots(axis);
        (self.degree[axis]..self.count(axis)).filter(|&k| knots[k] < knots[k + 1]).collect()
    }

    fn check(&self) -> Result<(), String> {
        let columns = self.ctrl.first().map_or(0, Vec::len);
        if self.ctrl.iter().any(|row| row.len() != columns) {
            return Err("rows of control points differ in length".to_owned());
        }
        for axis in 0..2 {
            let (degree, knots) = (self.degree[axis], self.knots(axis));
            let count = if axis == 0 { self.ctrl.len() } else { columns };
            if degree == 0 || count <= degree || knots.len() != count + degree + 1 {
                return Err(format!("{count} control points, {} knots, degree {degree}", knots.len()));
            }
            let ordered = knots.windows(2).all(|pair| pair[0] <= pair[1]);
            if !ordered || !knots.iter().all(|knot| knot.is_finite()) || knots[degree] >= knots[count] {
                return Err("knots that fall, are not finite or span no domain".to_owned());
            }
        }
        let valid = |point: &[f64; 4]| point.iter().all(|value| value.is_finite()) && point[3] > 0.0;
        if self.ctrl.iter().flatten().all(valid) {
            Ok(())
        } else {
            Err("a control point is not finite or its weight not positive".to_owned())
        }
    }
}
