//! The samples that a fit is of: all of A's, or those of chosen faces that are near to B.

use super::options::{BestFitOptions, invalid};
use super::{COMPARED_SAMPLES, MAX_SAMPLES};
use crate::alignment::{Loss, Samples};
use crate::engine::PreparedModel;
use crate::engine::prepared::PreparedTarget;
use crate::error::Result;

/// What counts in a fit.
pub(super) struct Selection {
    /// The samples of A, or of its chosen faces.
    pub(super) samples: Samples,
    /// Those by which the residuals of poses are compared.
    pub(super) compared: Samples,
    /// For each patch of B whether it is of a chosen face; none if all are.
    pub(super) patches: Option<Vec<bool>>,
    pub(super) loss: Loss,
}

impl Selection {
    /// Returns what the options choose; `held` are B's patches, and `all` the samples of all of A.
    ///
    /// # Errors
    /// [`Error::OptionInvalid`] for faces of a model without surfaces, and for an index of no face.
    pub(super) fn of(
        options: &BestFitOptions,
        [a, b]: [&PreparedModel; 2],
        held: Option<&PreparedTarget>,
        all: &Samples,
    ) -> Result<Self> {
        let BestFitOptions { faces_of_a, faces_of_b, samples, sampling, .. } = options;
        require_faces("A", a, faces_of_a)?;
        require_faces("B", b, faces_of_b)?;
        let of_a = |face: usize| faces_of_a.contains(&face);
        let samples = match faces_of_a.is_empty() {
            true => all.clone(),
            false => a.fit_samples_where(*samples, *sampling, of_a).thinned(MAX_SAMPLES),
        };
        let of_b = |surface: usize| faces_of_b.contains(&b.face_of(surface));
        let patches = held
            .filter(|_| !faces_of_b.is_empty())
            .map(|held| held.target.patches.iter().map(|patch| of_b(patch.surface)).collect());
        Ok(Self { compared: samples.thinned(COMPARED_SAMPLES), samples, patches, loss: options.last_loss() })
    }
}

/// Refuses faces that a model does not have.
fn require_faces(name: &str, model: &PreparedModel, faces: &[usize]) -> Result<()> {
    let Some(&largest) = faces.iter().max() else { return Ok(()) };
    if model.facets().is_some() {
        return Err(invalid(&format!("found faces of {name}, which has no surfaces, expected none")));
    }
    let count = model.face_count();
    if largest >= count {
        return Err(invalid(&format!(
            "found face {largest} of {name}, expected an index below {count}, the number of its faces"
        )));
    }
    Ok(())
}
