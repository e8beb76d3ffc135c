//! Proves that the pieces of a trimmed face are that face, to a limit.
//!
//! Given are the surface, the loops and, of each piece, its surface and the map to the face's
//! parameters. Three statements together say that the pieces and the face are within the limit
//! of each other, both ways:
//!
//! - each piece's map leads into the region within the loops, or near it (`inside`);
//! - each point of that region is in the image of some map, or near one (`covered`);
//! - each point of a piece is near the surface's point at the map's parameters (`values`).

mod covered;
mod curve;
mod inside;
mod map;
mod region;
mod same;
mod strip;
mod values;

use super::deadline::Deadline;
use super::frame::{Frame, Motion};
use super::interval::Interval;
use super::surface::{Model, Surface};
use super::{Verdict, bezier};
use bezier::{Patch, SecondDerivatives};
use curve::Outline;
pub(crate) use map::{Map, Ruled};
use region::Region;

/// The homogeneous controls (w u, w v, w) of a rational Bézier curve of parameters.
pub(crate) type Controls = Vec<[f64; 3]>;

/// A face that was cut.
pub(crate) struct Cut {
    pub(crate) surface: Surface,
    /// Closed loops, head to tail.
    pub(crate) loops: Vec<Vec<Controls>>,
    pub(crate) pieces: Vec<Piece>,
    /// The distance between the face and its pieces that is stated.
    pub(crate) deviation: f64,
}

/// A piece and its place in the face.
pub(crate) struct Piece {
    pub(crate) surface: Surface,
    pub(crate) map: Map,
}

/// A verdict with a sentence on what refutes it.
#[derive(Debug, Clone)]
pub(crate) struct Finding {
    pub(crate) verdict: Verdict,
    pub(crate) note: Option<String>,
}

impl Finding {
    const PROVED: Self = Self { verdict: Verdict::Proved, note: None };
    const OPEN: Self = Self { verdict: Verdict::NotProved, note: None };

    fn refuted(note: String) -> Self {
        Self { verdict: Verdict::Refuted, note: Some(note) }
    }

    /// The same, with the statement if that is not proved.
    fn of(self, statement: &str) -> Self {
        match self.verdict {
            Verdict::NotProved => Self { note: Some(statement.to_owned()), ..self },
            _ => self,
        }
    }

    /// The worse of two: refuted, then not proved.
    fn and(self, other: impl FnOnce() -> Self) -> Self {
        match self.verdict {
            Verdict::Refuted => self,
            Verdict::Proved => other(),
            Verdict::NotProved => {
                let other = other();
                if other.verdict == Verdict::Refuted { other } else { self }
            }
        }
    }
}

/// What the three statements need of a face.
struct Face<'a> {
    /// The surface's patches, in the frame, and their derivatives' bounds.
    patches: Vec<Patch>,
    bends: Vec<SecondDerivatives>,
    /// Those bounds over parts of the patches.
    regions: Vec<Region>,
    frame: Frame,
    /// Half of the limit, in the frame: what a piece may be off the surface by, and what a place on
    /// the surface may be off the region by.
    limit: f64,
    /// Sizes in u and v of boxes in which no two points are farther than half of that from each
    /// other on the surface: such a box, and one about it that is larger by as much on each side.
    small: [f64; 2],
    loops: Outline,
    /// The size of the loops' box.
    extents: [f64; 2],
    deadline: &'a Deadline,
}

/// Proves that face and pieces are within `deviation + slack` times the diagonal of each other.
pub(crate) fn check(cut: &Cut, slack: f64, deadline: &Deadline) -> Finding {
    if cut.pieces.is_empty() {
        return Finding::refuted("the face has no pieces".to_owned());
    }
    let model = Model { surfaces: vec![cut.surface.clone()] };
    let pieces = Model { surfaces: cut.pieces.iter().map(|piece| piece.surface.clone()).collect() };
    // The pieces have the size of the face, the surface may be much larger.
    let frame = Frame::new(&pieces, &Motion::IDENTITY, &pieces);
    let patches = bezier::patches(&model, &frame, &Motion::IDENTITY);
    let limit = 0.5 * (cut.deviation + slack * frame.diagonal) * frame.scale;
    let bends: Vec<SecondDerivatives> =
        patches.iter().map(|patch| SecondDerivatives::of(&patch.net)).collect();
    let Some(slopes) = slopes(&patches, &bends) else { return Finding::OPEN };
    let loops = Outline::new(cut.loops.iter().cloned());
    let bounds = loops.bounds();
    let extents = bounds.map(|bounds| bounds.hi - bounds.lo);
    // What is small is small beside the loops, too, where the surface hardly moves with a parameter. Loops as
    // narrow as rounding enclose nothing, and need no smaller boxes.
    let small = std::array::from_fn(|axis| {
        let moves = 0.25 * limit / slopes[axis].max(f64::MIN_POSITIVE);
        let is_wide = extents[axis] > ROUNDED * bounds[axis].magnitude();
        if is_wide { moves.min(MAX_SMALL * extents[axis]) } else { moves }
    });
    let regions = patches.iter().map(|patch| Region::whole(&patch.net)).collect();
    let face = Face { patches, bends, regions, frame, limit, small, loops, extents, deadline };
    let maps: Vec<&Map> = cut.pieces.iter().map(|piece| &piece.map).collect();
    inside::check(&face, &maps)
        .of("that pieces lie in the face")
        .and(|| covered::check(&face, &maps).of("that pieces cover the face"))
        .and(|| values::check(&face, &pieces, &maps).of("that pieces lie on the surface"))
}

/// Bounds of the surface's first derivatives by u and v; `None` where a weight may be 0.
fn slopes(patches: &[Patch], bends: &[SecondDerivatives]) -> Option<[f64; 2]> {
    let mut slopes = [0.0_f64; 2];
    for (patch, SecondDerivatives { first, .. }) in patches.iter().zip(bends) {
        for axis in 0..2 {
            let [start, end] = patch.ranges[axis];
            let slope = Interval::point(first[axis]) / (Interval::point(end) - Interval::point(start));
            slopes[axis] = slopes[axis].max(slope.hi);
        }
    }
    slopes.iter().all(|slope| slope.is_finite()).then_some(slopes)
}

/// The part of parameters that is far above their rounding.
const ROUNDED: f64 = 1e-9;

/// The largest part of the loops' box that is called small.
const MAX_SMALL: f64 = 1.0 / 64.0;

/// A box of parameters (u, v).
type Box2 = [Interval; 2];

impl Face<'_> {
    /// Whether two points of the box are always near on the surface.
    fn is_small(&self, parameters: &Box2) -> bool {
        (0..2).all(|axis| parameters[axis].hi - parameters[axis].lo <= self.small[axis])
    }

    /// The box with all points near it.
    fn enlarged(&self, parameters: &Box2) -> Box2 {
        std::array::from_fn(|axis| {
            let margin = Interval { lo: -self.small[axis], hi: self.small[axis] };
            parameters[axis] + margin
        })
    }

    /// Returns the size of a vector of parameters, relative to the loops' box: 0 where it is small.
    ///
    /// It decides what is halved. Small sizes may be far apart in u and v where one knot rectangle of many is
    /// narrow, and boundaries are not.
    fn size(&self, vector: [f64; 2]) -> f64 {
        let sizes = (0..2).filter(|&axis| vector[axis].abs() > self.small[axis]);
        sizes.map(|axis| vector[axis].abs() / self.extents[axis]).fold(0.0, f64::max)
    }

    fn is_late(&self) -> bool {
        self.deadline.is_over()
    }
}
