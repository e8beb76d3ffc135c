//! The polynomial difference over the patches of a block of A.
//!
//! One map of all of A's knot lines to parameter lines of B serves all patches, which are decided one
//! by one: their pieces are compared with the patches of B that they are mapped to.

use super::super::difference::{Comparison, RestrictedPart, SpanPart};
use super::BlockUpperBound;
use super::context::BlockContext;
use super::knot_line_map::parts;
use crate::axis::Axis;
use crate::certified::audit::Lemma;
use crate::certified::nearest::{Foot, Sample};
use crate::rounding::upper_max;

/// The largest number of pieces of one patch of A.
const MAX_PIECES: usize = 256;

/// The bound by a map of A's knot lines. O(patches p² q²) for patches of B as large as A's.
pub(in crate::certified) struct DifferenceByPieces;

impl BlockUpperBound for DifferenceByPieces {
    fn lemma(&self) -> Lemma {
        Lemma::DifferenceByPieces
    }

    fn evaluate(
        &self,
        context: &BlockContext<'_>,
        threshold: f64,
        bounds: &mut [Option<f64>],
    ) -> Option<Sample> {
        let orientation = context.linearization.orientation;
        let (chart, patch) = (&context.chart, context.patch(context.middle));
        let comparison = Comparison::new(context.pair, patch, chart, orientation);
        let parts = Axis::BOTH.map(|axis| {
            let spans = parts(chart, &orientation, axis, &context.images(axis));
            let restricted = |part| comparison.restricted(axis, part);
            spans.into_iter().map(|span| span.into_iter().map(restricted).collect()).collect()
        });
        let pieces = Pieces { context, comparison, parts };
        pieces.decide(threshold, bounds);
        pieces.farthest_middle(bounds)
    }
}

/// The pieces of a block's patches.
struct Pieces<'a> {
    context: &'a BlockContext<'a>,
    comparison: Comparison<'a>,
    /// The parts of each span along either axis.
    parts: [Vec<Vec<RestrictedPart>>; 2],
}

impl Pieces<'_> {
    /// Bounds the patches that have no bound, strip by strip.
    fn decide(&self, threshold: f64, bounds: &mut [Option<f64>]) {
        let Self { context, comparison, parts } = self;
        let first = comparison.first_axis(parts.each_ref().map(|spans| spans.iter().map(Vec::len).sum()));
        let columns = parts[1].len();
        let is_open: Vec<bool> = bounds.iter().map(Option::is_none).collect();
        for (index, bound) in bounds.iter_mut().enumerate() {
            let count = parts[0][index / columns].len() * parts[1][index % columns].len();
            *bound = bound.or_else(|| (1..=MAX_PIECES).contains(&count).then_some(0.0));
        }
        let mut was_decided = true;
        for (index, span) in parts[first].iter().enumerate() {
            for part in span {
                let mut strip = comparison.strip(part);
                for (other_index, others) in parts[first.other()].iter().enumerate() {
                    let mut place = [index; 2];
                    place[first.other()] = other_index;
                    let index = place[0] * columns + place[1];
                    if !is_open[index] {
                        continue;
                    }
                    let Some(largest) = bounds[index] else { continue };
                    let patch = context.patch(context.indices(place));
                    let net = comparison.net_of_a(patch);
                    let bound = strip.upper_bound(patch, &net, others, threshold, !was_decided);
                    bounds[index] = bound.map(|bound| upper_max(largest, bound));
                    was_decided = bounds[index].is_some();
                }
            }
        }
    }

    /// Of the middles of pieces in the middle of undecided patches about the farthest, with its image.
    fn farthest_middle(&self, bounds: &[Option<f64>]) -> Option<Sample> {
        let Self { context, comparison, parts } = self;
        let columns = parts[1].len();
        let mut farthest = (0.0, None);
        for (index, _) in bounds.iter().enumerate().filter(|(_, bound)| bound.is_none()) {
            let places = [index / columns, index % columns];
            let at = context.indices(places);
            if let [Some(s), Some(t)] = Axis::BOTH.map(|axis| middle_part(&parts[axis][places[axis]]))
                && let piece = comparison.piece(context.patch(at), [s, t])
                && let distance = piece.distance_of_middle(0.0)
                && distance > farthest.0
                && let (from, Some(image)) = piece.middle_with_image()
                && let Some((patch, parameters)) = context.flat_place(at, from)
            {
                let foot = Foot::start(image.0, image.1);
                farthest = (distance, Some(Sample { patch, parameters, foot }));
            }
        }
        farthest.1
    }
}

/// The part in the middle of those of a span.
fn middle_part(parts: &[RestrictedPart]) -> Option<&SpanPart> {
    parts.get(parts.len() / 2).map(RestrictedPart::part)
}
