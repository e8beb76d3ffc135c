//! Sides that patches have in common.

use super::{Piece, Side};
use crate::rounding::{upper_max, upper_min};
use crate::solid::{Arc, Curve, edge_width};

/// A side that two patches have in common, or two sides of one patch.
#[derive(Debug)]
pub(in crate::embedded) struct SharedEdge {
    /// The side of each.
    pub(in crate::embedded) sides: [Side; 2],
    /// The arcs of two faces that were joined, in one direction; none of neighbours in a surface, which have the same
    /// parameters there.
    pub(super) arcs: Option<[Arc; 2]>,
}

impl SharedEdge {
    /// Returns the part of the other patch's side that corresponds to that of a piece, which has this one of both sides,
    /// and an upper bound on the distance of points that correspond; none if the piece's side is not within its arc.
    pub(in crate::embedded) fn image_of(
        &self,
        piece: &Piece,
        own: usize,
        narrow: f64,
    ) -> Option<([f64; 2], f64)> {
        let arcs = self.arcs.as_ref()?;
        image(&arcs[own], piece.range[self.sides[own].axis.other()], &arcs[1 - own], narrow)
    }

    /// Returns whether the side of a piece, which has this one of both sides, is within its arc.
    pub(in crate::embedded) fn has_side(&self, piece: &Piece, own: usize) -> bool {
        let Some(arcs) = &self.arcs else { return true };
        let [[low, high], [from, to]] = [piece.range[self.sides[own].axis.other()], arcs[own].range];
        if from < to { from <= low && high <= to } else { to <= low && high <= from }
    }

    /// Returns an upper bound on the distance of each point of one piece's side from a point of the other one's such that
    /// both and those of the edge between them follow each other, and whether the sides run against each other; none if
    /// the pieces have no parts of the edge that meet. `first` is the number of the piece whose side is within its arc.
    ///
    /// Where the parts of the edge only end at the same point, that is the distance of both ends.
    pub(in crate::embedded) fn width(
        &self,
        pieces: [&Piece; 2],
        first: usize,
        narrow: f64,
    ) -> Option<(f64, bool)> {
        let interval = |k: usize| pieces[k].range[self.sides[k].axis.other()];
        let Some(arcs) = &self.arcs else {
            let [a, b] = [interval(0), interval(1)];
            return (a[0] <= b[1] && b[0] <= a[1]).then_some((0.0, false));
        };
        let second = 1 - first;
        let [inner, outer] = [&arcs[first], &arcs[second]];
        let is_reversed = (inner.range[0] > inner.range[1]) != (outer.range[0] > outer.range[1]);
        let (image, width) = image(inner, interval(first), outer, narrow)?;
        let own = interval(second);
        if own[0] <= image[1] && image[0] <= own[1] {
            return Some((width, is_reversed));
        }
        // Next to each other but for rounding: the ends that are nearest.
        let is_before = own[1] < image[0];
        let apart = if is_before { image[0] - own[1] } else { own[0] - image[1] };
        let corner = |k: usize, high: bool| {
            let Side { axis, end } = self.sides[k];
            let mut ends = [usize::from(high); 2];
            ends[axis] = end;
            pieces[k].corner(ends)
        };
        let ends = [corner(second, is_before), corner(first, is_before == is_reversed)];
        (apart < MAX_APART).then(|| (ends[0].distance(ends[1]), is_reversed))
    }
}

/// The distance of parameters up to which two parts of an edge that were found to end beside each other may end at the
/// same point: that distance is measured.
const MAX_APART: f64 = 1e-3;

/// Returns the part of an arc's side that corresponds to a part of its partner's, and an upper bound on the distance of
/// points that correspond (lemma S5 of docs/solids.md). A bound of at most `narrow` is not improved. Returns none if that
/// part is not within the partner.
pub(super) fn image(inner: &Arc, interval: [f64; 2], outer: &Arc, narrow: f64) -> Option<([f64; 2], f64)> {
    let [from, to] = inner.range;
    let local = |t: f64| (t - from) / (to - from);
    let mut ends = interval.map(local);
    if from > to {
        ends.reverse();
    }
    let [low, high] = ends;
    if !(0.0 <= low && low < high && high <= 1.0) {
        return None;
    }
    let image_of =
        |t: f64| if t == 0.0 || t == 1.0 { t } else { outer.curve.closest(inner.curve.point(t)).0 };
    let found = [low, high].map(image_of);
    let width = width_of([&inner.curve, &outer.curve], [[low, high], found], (narrow, MAX_WIDTH_DIVISIONS))?;
    let [from, to] = outer.range;
    let mut image = found.map(|t| if t == 1.0 { to } else { from + t * (to - from) });
    if from > to {
        image.reverse();
    }
    Some((image, width))
}

/// The largest number of times that a part is divided for a smaller bound on the width. Each division leaves an eighth of
/// the bound.
const MAX_WIDTH_DIVISIONS: u32 = 4;

/// Returns an upper bound on the distance of points that correspond on parts of two curves, divided at points of the second
/// one that are closest to the middles of the first; none if these do not follow each other.
fn width_of(
    curves: [&Curve; 2],
    [one, other]: [[f64; 2]; 2],
    (narrow, divisions): (f64, u32),
) -> Option<f64> {
    if other[0].partial_cmp(&other[1]) != Some(std::cmp::Ordering::Less) {
        return None;
    }
    let width = edge_width([curves[1].part(other), curves[0].part(one)]);
    if width <= narrow || divisions == 0 {
        return Some(width);
    }
    let middle = 0.5 * (one[0] + one[1]);
    let image = curves[1].closest(curves[0].point(middle)).0;
    let halves = [[[one[0], middle], [other[0], image]], [[middle, one[1]], [image, other[1]]]];
    let widths = halves.map(|half| width_of(curves, half, (narrow, divisions - 1)));
    match widths {
        [Some(low), Some(high)] => Some(upper_min(width, upper_max(low, high))),
        _ => Some(width),
    }
}

impl Curve {
    /// Returns the part over an interval of positive length in [0, 1].
    fn part(&self, [low, high]: [f64; 2]) -> Self {
        let mut part = self.clone();
        if high < 1.0 {
            [part, _] = part.split(high);
        }
        if low > 0.0 {
            [_, part] = part.split(low / high);
        }
        part
    }
}
