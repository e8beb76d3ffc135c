//! Loops that cross each other or themselves.

use super::piece::TrimPiece;
use super::winding::Winding;
use crate::error::TrimFault;
use crate::sorting::sort_by_number;
use glam::DVec2;

/// The depth, as a fraction of the domain, up to which curves may overlap: that of ends
/// that miss each other.
pub(super) const MAX_OVERLAP: f64 = 1e-6;

/// The largest excess of a control polygon's length over its chord, relative to the
/// chord, of the arcs that the pieces are cut into: they do not cross themselves.
const MAX_EXCESS: f64 = 1e-3;

/// The largest number of halvings of a piece into arcs, and of an arc towards its chord; a
/// piece with a cusp never becomes straight.
const MAX_HALVINGS: u32 = 8;
const MAX_REFINEMENTS: u32 = 16;

/// The distance between an arc and its chord, as a fraction of the domain, at which the chord
/// stands for the arc: two such arcs that overlap by [`MAX_OVERLAP`] have chords that cross.
const MAX_SAGITTA: f64 = 0.25 * MAX_OVERLAP;

/// The largest number of pairs of parts of two arcs that are compared: those of arcs that run
/// along each other for all their length are a few thousand.
const MAX_COMPARISONS: usize = 1 << 16;

/// The largest number of crossings of two arcs at which winding numbers are computed.
const MAX_CROSSINGS: usize = 4;

/// The distances from a crossing at which winding numbers are computed: 2⁶ times the lengths
/// of the chords, divided by powers of 2, down to about [`MAX_OVERLAP`].
const LONGEST: f64 = 64.0;
const DISTANCES: i32 = 24;

/// The distances from the arc there: the first is a little more than [`MAX_OVERLAP`], each next
/// one this much larger.
const INSIDE_OVERLAP: f64 = 1.05;
const WIDENING: f64 = 2.5;

/// The halvings in the search for the point of an arc.
const BISECTIONS: usize = 40;
const DIRECTED: usize = 16;

/// A part of a piece, in fractions of the domain.
#[derive(Clone)]
struct CurveRange {
    piece: TrimPiece,
    low: DVec2,
    high: DVec2,
    /// An upper bound on the distance between the arc and its chord.
    sagitta: f64,
    refinements: u32,
    loop_index: usize,
}

/// The chord of an arc.
#[derive(Clone, Copy)]
struct Chord {
    ends: [DVec2; 2],
    loop_index: usize,
    curve: usize,
}

/// Returns the first crossing found that leaves a region, more than [`MAX_OVERLAP`] wide,
/// of winding number other than 0 and 1.
///
/// A fault is proven by the winding number of its point. Arcs whose boxes overlap are halved
/// until they are apart or within [`MAX_SAGITTA`] of their chords, so that every crossing of
/// two curves that overlap by [`MAX_OVERLAP`] is one of chords, however small its angle.
/// O(arcs log arcs + pairs whose boxes overlap).
pub(super) fn find(winding: &Winding) -> Option<TrimFault> {
    let mut arcs = Vec::new();
    for loop_index in 0..winding.loops() {
        for piece in winding.scaled_pieces(loop_index) {
            append_arcs(piece, loop_index, &mut arcs);
        }
    }
    sort_by_number(&mut arcs, |arc| arc.low.x);
    for (index, a) in arcs.iter().enumerate() {
        for b in arcs[index + 1..].iter().take_while(|b| b.low.x <= a.high.x) {
            let fault = fault(winding, a, b);
            if fault.is_some() {
                return fault;
            }
        }
    }
    None
}

fn append_arcs(piece: &TrimPiece, loop_index: usize, arcs: &mut Vec<CurveRange>) {
    let mut stack = vec![(piece.clone(), 0)];
    while let Some((piece, halvings)) = stack.pop() {
        let points: Vec<DVec2> = piece.points().collect();
        let length: f64 = points.windows(2).map(|pair| pair[0].distance(pair[1])).sum();
        let chord = piece.start().distance(piece.end());
        if halvings == MAX_HALVINGS || length <= (1.0 + MAX_EXCESS) * chord {
            arcs.push(CurveRange::new(piece, 0, loop_index));
        } else {
            stack.extend(piece.halves().map(|half| (half, halvings + 1)));
        }
    }
}

/// Returns a fault at a crossing of two arcs.
fn fault(winding: &Winding, whole: &CurveRange, other: &CurveRange) -> Option<TrimFault> {
    if !whole.is_near(other) {
        return None;
    }
    let mut pairs = vec![(whole.clone(), other.clone())];
    let (mut comparisons, mut crossings) = (0, 0);
    while let Some((a, b)) = pairs.pop() {
        if !a.is_near(&b) {
            continue;
        }
        comparisons += 1;
        let refines = |arc: &CurveRange| arc.sagitta > MAX_SAGITTA && arc.refinements < MAX_REFINEMENTS;
        if comparisons < MAX_COMPARISONS && (refines(&a) || refines(&b)) {
            if refines(&a) && (a.sagitta >= b.sagitta || !refines(&b)) {
                pairs.extend(a.halves().map(|half| (half, b.clone())));
            } else {
                pairs.extend(b.halves().map(|half| (a.clone(), half)));
            }
            continue;
        }
        let chords = [a.chord(), b.chord()];
        let Some(at) = chords[0].crossing(&chords[1]) else { continue };
        let fault = overlap(winding, whole, &chords, at);
        crossings += 1;
        if fault.is_some() || crossings == MAX_CROSSINGS {
            return fault;
        }
    }
    None
}

impl CurveRange {
    fn new(piece: TrimPiece, refinements: u32, loop_index: usize) -> Self {
        let (mut low, mut high) = (DVec2::INFINITY, DVec2::NEG_INFINITY);
        for point in piece.points() {
            (low, high) = (low.min(point), high.max(point));
        }
        let (start, along) = (piece.start(), piece.end() - piece.start());
        // The hull of the control points is as far from the chord as the farthest of them.
        let sagitta = piece.points().map(|point| {
            let fraction = (point - start).dot(along) / along.length_squared();
            let fraction = if fraction.is_nan() { 0.0 } else { fraction.clamp(0.0, 1.0) };
            point.distance(start + fraction * along)
        });
        let sagitta = sagitta.fold(0.0, f64::max);
        Self { piece, low, high, sagitta, refinements, loop_index }
    }

    fn is_near(&self, other: &Self) -> bool {
        self.low.cmple(other.high).all() && other.low.cmple(self.high).all()
    }

    fn halves(&self) -> [Self; 2] {
        self.piece.halves().map(|half| Self::new(half, self.refinements + 1, self.loop_index))
    }

    /// Returns the point of the arc that is next to a point along the chord, with the arc's normal
    /// there. The arc is so straight that it advances along its chord all the way.
    fn point_near(&self, point: DVec2) -> (DVec2, DVec2) {
        let along = self.piece.end() - self.piece.start();
        let (mut arc, mut direction) = (self.piece.clone(), along);
        for halving in 0..BISECTIONS {
            let [first, second] = arc.halves();
            let ahead = (point - first.end()).dot(along) > 0.0;
            arc = if ahead { second } else { first };
            // Later chords are too short to have a direction.
            if halving < DIRECTED {
                direction = arc.end() - arc.start();
            }
        }
        (arc.start(), direction.normalize_or_zero().perp())
    }

    fn chord(&self) -> Chord {
        let ends = [self.piece.start(), self.piece.end()];
        Chord { ends, loop_index: self.loop_index, curve: self.piece.curve as usize }
    }
}

impl Chord {
    fn direction(&self) -> DVec2 {
        self.ends[1] - self.ends[0]
    }

    /// Returns the point at which the chords cross, their ends included; `None` for
    /// chords that share an end or are parallel.
    fn crossing(&self, other: &Self) -> Option<DVec2> {
        if self.ends.iter().any(|end| other.ends.contains(end)) {
            return None;
        }
        let (d, e) = (self.direction(), other.direction());
        let between = other.ends[0] - self.ends[0];
        let determinant = d.perp_dot(e);
        let (s, t) = (between.perp_dot(e) / determinant, between.perp_dot(d) / determinant);
        let inside = (0.0..=1.0).contains(&s) && (0.0..=1.0).contains(&t);
        (inside && self.departs(other)).then(|| self.ends[0] + s * d)
    }

    /// Returns whether an end of one chord is farther from the other chord's line than chords
    /// of one curve are: curves that run along each other cross often, by rounding.
    fn departs(&self, other: &Self) -> bool {
        let pairs = [(self, other), (other, self)];
        pairs.into_iter().any(|(chord, from)| {
            let normal = from.direction().normalize_or_zero().perp();
            chord.ends.iter().any(|end| (*end - from.ends[0]).dot(normal).abs() > MAX_SAGITTA)
        })
    }
}

/// Returns the fault if the winding number beside an arc, near its crossing with another, is
/// other than 0 and 1 over a width of [`MAX_OVERLAP`].
///
/// A region between two crossings lies along either arc. At the distance s from a crossing under
/// the angle θ its width is about s sin θ, until the arcs bend towards each other.
fn overlap(winding: &Winding, arc: &CurveRange, chords: &[Chord; 2], at: DVec2) -> Option<TrimFault> {
    let [a, b] = chords;
    let (d, e) = (a.direction().normalize_or_zero(), b.direction().normalize_or_zero());
    let sine = d.perp_dot(e).abs();
    let length = a.direction().length().min(b.direction().length());
    for power in 0..DISTANCES {
        let distance = LONGEST * length * 0.5_f64.powi(power);
        if distance < MAX_OVERLAP {
            break;
        }
        for along in [distance, -distance] {
            let (point, normal) = arc.point_near(at + along * d);
            let mut beside = INSIDE_OVERLAP * MAX_OVERLAP;
            while beside <= WIDENING * distance * sine {
                for side in [beside, -beside] {
                    let point = point + side * normal;
                    if let Some(found) = excess_number(winding, point) {
                        return Some(TrimFault::LoopsCross {
                            loop_index: a.loop_index,
                            curve: a.curve,
                            other_loop: b.loop_index,
                            other_curve: b.curve,
                            at: winding.parameters(point),
                            found,
                        });
                    }
                }
                beside *= WIDENING;
            }
        }
    }
    None
}

/// Returns the winding number of a point if it is neither 0 nor 1, and the same
/// [`MAX_OVERLAP`] to each side.
fn excess_number(winding: &Winding, point: DVec2) -> Option<i32> {
    let number = |point: DVec2| winding.number(winding.parameters(point));
    let found = number(point).filter(|found| !(0..=1).contains(found))?;
    let sides = [DVec2::X, DVec2::NEG_X, DVec2::Y, DVec2::NEG_Y];
    sides.iter().all(|side| number(point + MAX_OVERLAP * side) == Some(found)).then_some(found)
}
