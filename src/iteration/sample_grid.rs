//! The samples of one surface.

/// The tensor grid of samples of one surface.
#[derive(Debug, Clone, PartialEq)]
pub struct SampleGrid {
    /// The parameters in u and v, rising, including the ends of the domain.
    pub parameters: [Vec<f64>; 2],
    /// For every parameter, the index of the patch along its axis and the patch
    /// parameter in [0, 1].
    pub locations: [Vec<(usize, f64)>; 2],
    /// The index of the surface's first sample; v runs fastest.
    pub first: usize,
}

impl SampleGrid {
    /// Returns the numbers of samples along u and v.
    #[must_use]
    pub fn counts(&self) -> [usize; 2] {
        [self.parameters[0].len(), self.parameters[1].len()]
    }

    /// Returns the number of samples.
    #[must_use]
    pub fn len(&self) -> usize {
        self.parameters[0].len() * self.parameters[1].len()
    }

    /// Returns whether there are no samples.
    #[cfg(feature = "internals")]
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Returns the indices along u and v of the model's sample `index`.
    #[must_use]
    pub fn row_and_column(&self, index: usize) -> (usize, usize) {
        let columns = self.parameters[1].len();
        ((index - self.first) / columns, (index - self.first) % columns)
    }
}
