//! Trimming curves that leave the domain of their surface.

use super::piece::{TrimPiece, homogeneous, point_of};
use crate::param_box::ParamBox;
use glam::DVec2;

/// The largest distance outside the domain, as a fraction of its range, at which control
/// points are moved to its edge: the rounding of writers of CAD files.
pub(super) const MAX_CLAMPED: f64 = 1e-9;

/// The largest number of halvings of a piece. The control polygon approaches the curve by
/// a factor of 4 a halving, so 24 narrow any polygon that a domain's size allows to
/// [`MAX_CLAMPED`].
const MAX_HALVINGS: u32 = 24;

/// Returns the distance outside the box, as a fraction of its range; 0 inside.
pub(super) fn excess(point: DVec2, domain: &ParamBox) -> f64 {
    let outside = |axis: usize| {
        let [low, high] = domain[axis];
        (low - point[axis]).max(point[axis] - high) / (high - low)
    };
    outside(0).max(outside(1)).max(0.0)
}

fn polygon_excess(piece: &TrimPiece, domain: &ParamBox) -> f64 {
    piece.points().map(|point| excess(point, domain)).fold(0.0, f64::max)
}

/// Returns pieces of the same curve, each with its image whose control points lie in the
/// domain, moved by [`MAX_CLAMPED`] of the range or less; or the fraction of the range by
/// which the curve leaves the domain.
pub(super) fn confined(piece: TrimPiece, domain: &ParamBox) -> Result<Vec<Confined>, f64> {
    let mut pieces = Vec::with_capacity(1);
    let mut stack = vec![(piece, 0)];
    while let Some((given, halvings)) = stack.pop() {
        let outside = polygon_excess(&given, domain);
        if outside <= MAX_CLAMPED {
            pieces.push(Confined { piece: clamped(&given, domain), given });
            continue;
        }
        let ends = excess(given.start(), domain).max(excess(given.end(), domain));
        if ends > MAX_CLAMPED || halvings == MAX_HALVINGS {
            return Err(outside);
        }
        let [low, high] = given.halves().map(|half| (half, halvings + 1));
        stack.extend([high, low]);
    }
    Ok(pieces)
}

/// A piece as given, and as moved into the domain.
pub(super) struct Confined {
    pub(super) given: TrimPiece,
    pub(super) piece: TrimPiece,
}

/// Returns the piece with its control points moved into the domain.
fn clamped(piece: &TrimPiece, domain: &ParamBox) -> TrimPiece {
    let mut clamped = piece.clone();
    let (low, high) = (DVec2::from(domain.low()), DVec2::from(domain.high()));
    for control in &mut clamped.controls {
        let point = point_of(*control);
        let inside = point.clamp(low, high);
        if inside != point {
            *control = homogeneous(inside, control.z);
        }
    }
    clamped
}

/// Returns a box that contains the domain and the pieces and exceeds the smallest such
/// box by at most [`MAX_CLAMPED`] of the domain's range. O(pieces) where control
/// points lie in the domain.
pub(super) fn extents<'a>(pieces: impl Iterator<Item = &'a TrimPiece>, domain: &ParamBox) -> ParamBox {
    let mut extents = *domain;
    let include = |extents: &mut ParamBox, point: DVec2| {
        for axis in 0..2 {
            let [low, high] = extents[axis];
            extents[axis] = [low.min(point[axis]), high.max(point[axis])];
        }
    };
    for piece in pieces {
        let mut stack = vec![(piece.clone(), 0)];
        while let Some((piece, halvings)) = stack.pop() {
            include(&mut extents, piece.start());
            include(&mut extents, piece.end());
            let outside = polygon_excess(&piece, &extents);
            if outside <= MAX_CLAMPED || halvings == MAX_HALVINGS {
                piece.points().for_each(|point| include(&mut extents, point));
            } else {
                stack.extend(piece.halves().map(|half| (half, halvings + 1)));
            }
        }
    }
    extents
}
