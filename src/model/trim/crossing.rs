//! Loops that cross each other or themselves.

use super::fault::TrimFault;
use super::piece::TrimPiece;
use super::winding::Winding;
use glam::DVec2;

/// The depth, as a fraction of the domain, up to which curves may overlap: that of ends
/// that miss each other.
pub(super) const MAX_OVERLAP: f64 = 1e-6;

/// The largest excess of a control polygon's length over its chord, relative to the
/// chord, at which a chord stands for the piece in the search for crossings.
const FLATNESS: f64 = 1e-3;

/// The largest number of halvings in the search for crossings; a piece with a cusp never
/// becomes flat.
const MAX_HALVINGS: u32 = 8;

/// The distances from a crossing at which the winding number is computed: the lengths of
/// the chords divided by powers of 4, down to about [`MAX_OVERLAP`].
const DISTANCES: i32 = 10;

/// A chord of a piece, in fractions of the domain.
#[derive(Clone, Copy)]
struct Chord {
    ends: [DVec2; 2],
    loop_index: usize,
    curve: usize,
}

/// Returns the first crossing found that leaves a region, more than [`MAX_OVERLAP`] wide,
/// of winding number other than 0 and 1.
///
/// A fault is proven by the winding number of its point. Crossings are searched among
/// chords: curves whose chords do not cross overlap by less than the chords' distance
/// from the curves. O(chords log chords + pairs whose boxes overlap).
pub(super) fn find(winding: &Winding) -> Option<TrimFault> {
    let mut chords = Vec::new();
    for loop_index in 0..winding.loops() {
        for piece in winding.scaled_pieces(loop_index) {
            append_chords(piece, loop_index, &mut chords);
        }
    }
    let low = |chord: &Chord| chord.ends[0].x.min(chord.ends[1].x);
    let high = |chord: &Chord| chord.ends[0].x.max(chord.ends[1].x);
    chords.sort_by(|a, b| low(a).total_cmp(&low(b)));
    for (index, a) in chords.iter().enumerate() {
        for b in chords[index + 1..].iter().take_while(|b| low(b) <= high(a)) {
            let fault = a.crossing(b).and_then(|at| overlap(winding, [a, b], at));
            if fault.is_some() {
                return fault;
            }
        }
    }
    None
}

fn append_chords(piece: &TrimPiece, loop_index: usize, chords: &mut Vec<Chord>) {
    let mut stack = vec![(piece.clone(), 0)];
    while let Some((piece, halvings)) = stack.pop() {
        let ends = [piece.start(), piece.end()];
        let points: Vec<DVec2> = piece.points().collect();
        let length: f64 = points.windows(2).map(|pair| pair[0].distance(pair[1])).sum();
        if halvings == MAX_HALVINGS || length <= (1.0 + FLATNESS) * ends[0].distance(ends[1]) {
            chords.push(Chord { ends, loop_index, curve: piece.curve as usize });
        } else {
            stack.extend(piece.halves().map(|half| (half, halvings + 1)));
        }
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
        inside.then(|| self.ends[0] + s * d)
    }
}

/// Returns the fault if the winding number in one of the four quadrants at a crossing is
/// other than 0 and 1 over a width of [`MAX_OVERLAP`].
fn overlap(winding: &Winding, [a, b]: [&Chord; 2], at: DVec2) -> Option<TrimFault> {
    let (d, e) = (a.direction().normalize_or_zero(), b.direction().normalize_or_zero());
    let length = a.direction().length().min(b.direction().length());
    for power in 0..DISTANCES {
        let distance = length * 0.25_f64.powi(power);
        if distance < MAX_OVERLAP {
            break;
        }
        for bisector in [d + e, d - e] {
            for side in [distance, -distance] {
                let point = at + side * bisector.normalize_or_zero();
                if let Some(found) = steady_number(winding, point)
                    && !(0..=1).contains(&found)
                {
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
        }
    }
    None
}

/// Returns the winding number of a point if it is the same [`MAX_OVERLAP`] to each side.
fn steady_number(winding: &Winding, point: DVec2) -> Option<i32> {
    let found = winding.number(winding.parameters(point))?;
    let sides = [DVec2::X, DVec2::NEG_X, DVec2::Y, DVec2::NEG_Y];
    let steady = sides
        .iter()
        .all(|side| winding.number(winding.parameters(point + MAX_OVERLAP * side)) == Some(found));
    steady.then_some(found)
}
