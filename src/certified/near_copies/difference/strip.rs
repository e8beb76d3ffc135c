//! Strips of pieces, which share the restriction of their nets along one axis.
//!
//! Restriction is separable: nets are restricted to a part along one axis once for all pieces of
//! the strip, then along the other axis for each of them. Matrices serve all patches that are cut at the
//! same parameters, and elevate the degree where differences need it.

use super::super::orientation::Orientation;
use super::net::{Net, elevated_degrees};
use super::piece::{Piece, SpanPart};
use crate::axis::Axis;
use crate::bezier::{Patch, Restriction};
use crate::certified::Pair;
use crate::certified::sheets::Chart;
use crate::rounding::upper_max;
use glam::{DVec4, Vec4Swizzles};

/// Patches of a surface of A that are compared with patches of a surface of B.
pub(in crate::certified::near_copies) struct Comparison<'a> {
    pair: &'a Pair<'a>,
    chart: &'a Chart<'a>,
    orientation: Orientation,
    /// The degrees of nets of A and of B by A's axes, and those to which they are elevated.
    degrees: [[usize; 2]; 2],
    elevated: [[usize; 2]; 2],
}

/// A part of a span with the restrictions of A and of B to it.
pub(in crate::certified::near_copies) struct RestrictedPart {
    part: SpanPart,
    axis: Axis,
    restrictions: [Restriction; 2],
}

impl<'a> Comparison<'a> {
    /// Takes one patch of A's surface, as all have the same degrees.
    pub(in crate::certified::near_copies) fn new(
        pair: &'a Pair<'a>,
        patch: Patch<'_>,
        chart: &'a Chart<'a>,
        orientation: Orientation,
    ) -> Self {
        let mut comparison =
            Self { pair, chart, orientation, degrees: Default::default(), elevated: Default::default() };
        let nets = [comparison.net_of_a(patch), comparison.net_of_b([0; 2])];
        comparison.degrees = [0, 1].map(|side| nets[side].degree);
        comparison.elevated = elevated_degrees(&nets[0], &nets[1]);
        comparison
    }

    /// The restrictions to a part along an axis of A.
    pub(in crate::certified::near_copies) fn restricted(&self, axis: Axis, part: SpanPart) -> RestrictedPart {
        let ranges = [part.range, part.image];
        let of =
            |side: usize| Restriction::new(self.degrees[side][axis], self.elevated[side][axis], ranges[side]);
        RestrictedPart { axis, restrictions: [of(0), of(1)], part }
    }

    /// The axis along which nets are to be restricted first, given the numbers of parts.
    ///
    /// A restriction takes as many products for each control as the order along its axis; the first is
    /// computed for each strip, the second for each piece.
    pub(in crate::certified::near_copies) fn first_axis(&self, counts: [usize; 2]) -> Axis {
        let products = |first: Axis| {
            let order = |axis: Axis| 1 + self.degrees[0][axis].max(self.degrees[1][axis]);
            counts[first] * order(first) + counts[0] * counts[1] * order(first.other())
        };
        if products(Axis::V) < products(Axis::U) { Axis::V } else { Axis::U }
    }

    /// The strip of the pieces of a part.
    pub(in crate::certified::near_copies) fn strip<'p>(&'p self, part: &'p RestrictedPart) -> Strip<'p> {
        Strip { comparison: self, part, of_b: None, rooms: Default::default() }
    }

    /// The piece of a patch of A over two parts, by A's axes.
    pub(in crate::certified::near_copies) fn piece(
        &'a self,
        patch: Patch<'a>,
        parts: [&'a SpanPart; 2],
    ) -> Piece<'a> {
        let Self { pair, chart, orientation, .. } = self;
        Piece::new(pair, patch, chart, *orientation, parts)
    }

    /// The moved net of a patch of A.
    pub(in crate::certified::near_copies) fn net_of_a(&self, patch: Patch<'_>) -> Net {
        let transform = &self.pair.transform;
        let moved = |control: &DVec4| transform.rotate(control.xyz()).extend(control.w);
        Net::whole(patch.degree, patch.controls.iter().map(moved).collect(), transform.apply(patch.center))
    }

    /// The net of the patch of B at an offset along A's axes, oriented by them.
    fn net_of_b(&self, offsets: [isize; 2]) -> Net {
        let patch = self.chart.neighbour(self.orientation.by_axes_of_b(offsets));
        let [p, q] = patch.degree;
        if self.orientation.swapped {
            let controls = (0..=q).flat_map(|j| (0..=p).map(move |i| patch.controls[i * (q + 1) + j]));
            Net::whole([q, p], controls.collect(), patch.center)
        } else {
            Net::whole([p, q], patch.controls.to_vec(), patch.center)
        }
    }
}

impl RestrictedPart {
    pub(in crate::certified::near_copies) fn part(&self) -> &SpanPart {
        &self.part
    }
}

/// The pieces of one part along one axis.
pub(in crate::certified::near_copies) struct Strip<'a> {
    comparison: &'a Comparison<'a>,
    part: &'a RestrictedPart,
    /// The last net of B that was restricted to the part, with its offset along the other axis.
    of_b: Option<(isize, Net)>,
    /// Room for the net of A over the strip, and for both nets over a piece.
    rooms: [Net; 3],
}

impl<'a> Strip<'a> {
    /// An upper bound on the distance of the strip's pieces of a patch of A, with its net, over parts along
    /// the other axis from their images, if it is at most the threshold. A `cautious` call looks at
    /// the middle of a piece first.
    pub(in crate::certified::near_copies) fn upper_bound(
        &mut self,
        patch: Patch<'a>,
        net: &Net,
        parts: &'a [RestrictedPart],
        threshold: f64,
        cautious: bool,
    ) -> Option<f64> {
        let Self { comparison, part, of_b, rooms: [strip_room, room_of_a, room_of_b] } = self;
        let of_a = restricted(net, part.axis, &part.restrictions[0], strip_room);
        let mut largest = 0.0_f64;
        for other in parts {
            let mut pair = [&part.part; 2];
            pair[other.axis] = &other.part;
            let piece = comparison.piece(patch, pair);
            if (cautious && !(piece.distance_of_middle(threshold) <= threshold)) || !piece.is_proper() {
                return None;
            }
            let known = of_b.take().filter(|(offset, _)| *offset == other.part.offset);
            let (_, of_b) = of_b.insert(known.unwrap_or_else(|| {
                let whole = comparison.net_of_b(pair.map(|part| part.offset));
                (other.part.offset, restrict(whole, part.axis, &part.restrictions[1]))
            }));
            let of_a = restricted(of_a, other.axis, &other.restrictions[0], room_of_a);
            let of_b = restricted(of_b, other.axis, &other.restrictions[1], room_of_b);
            let bound = piece.upper_bound([of_a, of_b], threshold)?;
            let is_decided = bound <= threshold;
            if !is_decided {
                return None;
            }
            largest = upper_max(largest, bound);
        }
        Some(largest)
    }
}

/// A net restricted along an axis.
fn restrict(net: Net, axis: Axis, restriction: &Restriction) -> Net {
    if restriction.is_identity() {
        return net;
    }
    let mut restricted = Net::default();
    restricted.restrict(&net, axis, restriction);
    restricted
}

/// The same of a net that stays, in the room given if it is another one.
fn restricted<'n>(net: &'n Net, axis: Axis, restriction: &Restriction, room: &'n mut Net) -> &'n Net {
    if restriction.is_identity() {
        return net;
    }
    room.restrict(net, axis, restriction);
    room
}
