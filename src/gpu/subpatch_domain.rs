//! The part of a patch that a subpatch is.

/// The rectangle of a patch's parameters that a subpatch covers. All numbers
/// are dyadic, so that they are exact: (s, t) in [0, 1]² on the subpatch are
/// the patch's `low + (s, t) width`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct SubpatchDomain {
    pub(crate) patch: u32,
    pub(crate) low: [f64; 2],
    pub(crate) width: [f64; 2],
}

impl SubpatchDomain {
    /// The domain of a whole patch.
    pub(crate) fn whole(patch: u32) -> Self {
        Self { patch, low: [0.0; 2], width: [1.0; 2] }
    }

    /// The patch's parameters of (s, t) on the subpatch.
    pub(crate) fn patch_parameters(&self, parameters: [f64; 2]) -> [f64; 2] {
        [0, 1].map(|axis| self.low[axis] + parameters[axis] * self.width[axis])
    }

    /// The patch's parameters of (σ, τ) in [-1, 1]² on the subpatch.
    pub(crate) fn of_symmetric(&self, parameters: [f64; 2]) -> [f64; 2] {
        self.patch_parameters(parameters.map(|parameter| 0.5 * (1.0 + parameter)))
    }

    /// σ (axis 0) or τ (axis 1) of a parameter of the patch.
    pub(crate) fn subpatch_parameter(&self, axis: usize, parameter: f64) -> f64 {
        2.0 * (parameter - self.low[axis]) / self.width[axis] - 1.0
    }

    pub(crate) fn half(&self, axis: usize, upper: bool) -> Self {
        let mut half = *self;
        half.width[axis] *= 0.5;
        if upper {
            half.low[axis] += half.width[axis];
        }
        half
    }
}
