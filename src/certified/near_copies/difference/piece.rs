//! A rectangle of a patch of A that is mapped to a rectangle of a patch of B.

use super::super::orientation::Orientation;
use super::super::sliding::Sliding;
use super::net::Net;
use crate::bezier::Patch;
use crate::certified::Pair;
use crate::certified::sheets::Chart;
use std::cell::OnceCell;

/// A part of the range of a parameter of A's patch, and the patch of B, by its offset,
/// with the range of its parameter that the part is mapped to.
pub(in crate::certified::near_copies) struct SpanPart {
    pub(in crate::certified::near_copies) range: [f64; 2],
    pub(in crate::certified::near_copies) offset: isize,
    pub(in crate::certified::near_copies) image: [f64; 2],
}

/// A rectangle of a patch of A with its image.
pub(in crate::certified::near_copies) struct Piece<'a> {
    pair: &'a Pair<'a>,
    /// A's patch, not moved.
    patch: Patch<'a>,
    chart: &'a Chart<'a>,
    orientation: Orientation,
    /// The parts of A's two ranges.
    parts: [&'a SpanPart; 2],
    /// Feet that slide from the image.
    sliding: OnceCell<Sliding<'a>>,
}

impl<'a> Piece<'a> {
    pub(in crate::certified::near_copies) fn new(
        pair: &'a Pair<'a>,
        patch: Patch<'a>,
        chart: &'a Chart<'a>,
        orientation: Orientation,
        parts: [&'a SpanPart; 2],
    ) -> Self {
        Self { pair, patch, chart, orientation, parts, sliding: OnceCell::new() }
    }

    /// The patch of B.
    fn image_patch(&self) -> Patch<'_> {
        self.chart.neighbour(self.orientation.by_axes_of_b(self.parts.map(|part| part.offset)))
    }

    /// Whether the piece is mapped to more than a line.
    pub(in crate::certified::near_copies) fn is_proper(&self) -> bool {
        self.parts.iter().all(|part| part.image[0] != part.image[1])
    }

    fn sliding(&self) -> &Sliding<'a> {
        self.sliding.get_or_init(|| {
            let offsets = self.orientation.by_axes_of_b(self.parts.map(|part| part.offset));
            let ends = self.orientation.by_axes_of_b(self.parts.map(|part| part.image));
            Sliding::new(self.chart, offsets, ends, self.orientation)
        })
    }

    /// The parameters of the piece's middle on A's patch, and of its image on B's.
    fn middle(&self) -> [[f64; 2]; 2] {
        let middle = |[low, high]: [f64; 2]| 0.5 * (low + high);
        let from = self.parts.map(|part| middle(part.range));
        [from, self.orientation.by_axes_of_b(self.parts.map(|part| middle(part.image)))]
    }

    /// The piece's middle on A's patch, and its image: on a flat patch of B, if the image is in one.
    pub(in crate::certified::near_copies) fn middle_with_image(&self) -> ([f64; 2], Option<(u32, [f64; 2])>) {
        let [from, to] = self.middle();
        let offsets = self.orientation.by_axes_of_b(self.parts.map(|part| part.offset));
        (from, self.chart.flat_place(offsets, to))
    }

    /// The distance of the piece's middle from its image, or where that exceeds the threshold
    /// the part of it that no slide removes.
    pub(in crate::certified::near_copies) fn distance_of_middle(&self, threshold: f64) -> f64 {
        let [from, to] = self.middle();
        let difference = self.pair.transform.apply(self.patch.point(from)) - self.image_patch().point(to);
        let distance = difference.length();
        if distance <= threshold { distance } else { self.sliding().residual(difference).length() }
    }

    /// An upper bound on the distance of the piece's points from their images, given the nets of A and
    /// of B over the piece by A's axes.
    pub(in crate::certified::near_copies) fn upper_bound(
        &self,
        [of_a, of_b]: [&Net; 2],
        threshold: f64,
    ) -> Option<f64> {
        of_a.max_distance(of_b, threshold, || Some(self.sliding()))
    }
}
