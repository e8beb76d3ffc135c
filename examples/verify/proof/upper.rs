//! The proof that no point of A is farther than a limit from B.

use super::closest::Foot;

use super::bezier::{Net, Patch, SecondDerivatives};
use super::interval::Interval;

use super::target::{Comparison, Target, distance, lengths};
use super::vector::{Vector, middle};
use rayon::prelude::*;
use std::time::Instant;

/// The patches of B that a cell is compared with.
const CANDIDATES: usize = 4;

/// The cells that the threads share between two looks at the clock.
const ROUND: usize = 64;

/// The halvings after which a cell is given up: float64 no longer separates its corners.
const MAX_LEVEL: u32 = 90;

/// How many times longer than wide a cell may become by cuts across the direction that bends more. Feet
/// of corners that lie on two sides of a fold of B bend by as much on every smaller cell.
const MAX_ASPECT: f64 = 64.0;

/// On cells whose level is a multiple, B is searched for points nearer than those found, as Newton's
/// method may end at a local minimum, and cells on which that one crosses the limit are cut without
/// end.
const SEARCH_LEVELS: u32 = 6;

/// How much nearer such points are to be than those found, and these than the limit where they are
/// looked for: small cells with nearer ones are proved by what is known.
const NEARER: f64 = 0.8;

const NEAR_LIMIT: f64 = 0.5;

/// The same on cells of this level and below: so small ones are left only where the distance of what
/// was found crosses the limit, and a point hardly nearer decides them.
const DEEP_LEVEL: u32 = 24;
const DEEP_NEARER: f64 = 0.9999;

/// The pieces of B that such a search looks at.
const MAX_SEARCHED_PIECES: usize = 2000;

/// The pieces of B that a comparison looks at before it is given up: a point whose distance is the
/// limit itself would be looked at without end.
const MAX_COMPARED_PIECES: usize = 100_000;

/// Parts along each axis of a patch of A between places at which a point beyond the limit is looked
/// for first, and the number of places on all patches from which on there are fewer.
const MAX_PARTS: usize = 5;
const MAX_SAMPLES: f64 = 200_000.0;

/// The points, farthest first, that are then compared with all of B.
const SUSPECTS: usize = 8;

/// The time that looking for such points may take, of the time given: a fourth.
const SAMPLING_SHARE: u32 = 4;

/// What became of a limit.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Finding {
    /// Every point of A is within the limit.
    Within,
    /// This point of A is proved farther than the limit from all of B.
    Beyond(Witness),
    /// Neither was proved in the time given.
    Open,
}

/// A point of A: its surface, and the parameters in it, rounded.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Witness {
    pub(crate) surface: usize,
    pub(crate) u: f64,
    pub(crate) v: f64,
}

/// A part of a patch of A, over a rectangle of the patch's parameters.
struct Cell {
    patch: usize,
    net: Net,
    /// The start and the length along each axis, exact: dyadic numbers.
    start: [f64; 2],
    length: [f64; 2],
    level: u32,
    /// Near points of B that were found for cells that contain this one.
    known: Vec<Foot>,
}

/// What one look at a cell gave.
enum Outcome {
    Within,
    Beyond(Witness),
    Halves([Cell; 2]),
    GivenUp,
}

/// The cells that were looked at, and what came of it.
pub(crate) struct Search {
    pub(crate) finding: Finding,
    pub(crate) cells: usize,
}

/// Proves or refutes that every point of A's patches is within `limit` of B.
///
/// A is subdivided, and a cell is left when [`within`] proves it; a point of A that is proved
/// beyond ends the search. The cells proved and the cells left always cover A.
pub(crate) fn prove(a: &[Patch], target: &Target, limit: f64, deadline: Instant) -> Search {
    let mut search = Search { finding: Finding::Open, cells: 0 };
    let start = Instant::now();
    if start >= deadline {
        return search;
    }
    if let Some(witness) = sampled(a, target, limit, start + (deadline - start) / SAMPLING_SHARE) {
        search.finding = Finding::Beyond(witness);
        return search;
    }
    let mut given_up = false;
    // The last are taken first, so that the cells in memory stay few.
    let mut cells: Vec<Cell> = (0..a.len()).rev().map(|patch| Cell::whole(a, patch)).collect();
    while !cells.is_empty() {
        if Instant::now() >= deadline {
            return search;
        }
        let round = cells.split_off(cells.len().saturating_sub(ROUND));
        search.cells += round.len();
        let outcomes: Vec<Outcome> =
            round.into_par_iter().map(|cell| cell.examine(a, target, limit, deadline)).collect();
        for outcome in outcomes {
            match outcome {
                Outcome::Within => {}
                Outcome::Halves(halves) => cells.extend(halves),
                Outcome::GivenUp => given_up = true,
                Outcome::Beyond(witness) => {
                    search.finding = Finding::Beyond(witness);
                    return search;
                }
            }
        }
    }
    if !given_up {
        search.finding = Finding::Within;
    }
    search
}

/// A point of A on a grid that is proved beyond the limit, if the farthest of them are.
fn sampled(a: &[Patch], target: &Target, limit: f64, deadline: Instant) -> Option<Witness> {
    let affordable = (MAX_SAMPLES / a.len() as f64).sqrt() as usize;
    let parts = affordable.saturating_sub(1).clamp(1, MAX_PARTS);
    let places = (0..=parts).flat_map(|i| (0..=parts).map(move |j| [i, j]));
    let places: Vec<[f64; 2]> = places.map(|place| place.map(|index| index as f64 / parts as f64)).collect();
    let mut suspects: Vec<(f64, usize, [f64; 2])> = (0..a.len())
        .into_par_iter()
        .flat_map_iter(|patch| {
            let sample = move |&at: &[f64; 2]| {
                if Instant::now() >= deadline {
                    return None;
                }
                let point = middle(&a[patch].net.evaluate(at.map(Interval::point)));
                let foot = *target.finder.nearest(point, 1).first()?;
                (foot.distance > limit).then_some((foot.distance, patch, at))
            };
            places.iter().filter_map(sample)
        })
        .collect();
    suspects.sort_by(|(a, ..), (b, ..)| b.total_cmp(a));
    let beyond = |&&(_, patch, at): &&(f64, usize, [f64; 2])| {
        let point = a[patch].net.evaluate(at.map(Interval::point));
        matches!(target.compare(&point, limit, MAX_COMPARED_PIECES, deadline), Comparison::Farther)
    };
    let &(_, patch, at) = suspects.iter().take(SUSPECTS).find(beyond)?;
    Some(Witness::new(&a[patch], at))
}

impl Witness {
    fn new(patch: &Patch, at: [f64; 2]) -> Self {
        let [u, v] = patch.parameters(at);
        Self { surface: patch.surface, u, v }
    }
}

impl Cell {
    fn whole(a: &[Patch], patch: usize) -> Self {
        Self {
            patch,
            net: a[patch].net.clone(),
            start: [0.0; 2],
            length: [1.0; 2],
            level: 0,
            known: Vec::new(),
        }
    }

    fn examine(mut self, a: &[Patch], target: &Target, limit: f64, deadline: Instant) -> Outcome {
        let center = self.net.evaluate([Interval::point(0.5); 2]);
        let mut feet = target.finder.nearest(middle(&center), CANDIDATES);
        feet.extend(
            self.known.iter().map(|foot| target.finder.project(foot.patch, middle(&center), foot.at)),
        );
        feet.sort_by(|a, b| a.distance.total_cmp(&b.distance));
        let nearest = feet.first().map_or(f64::INFINITY, |foot| foot.distance);
        let part = if self.level < DEEP_LEVEL { NEARER } else { DEEP_NEARER };
        let searched = self.level > 0 && self.level.is_multiple_of(SEARCH_LEVELS);
        if searched
            && nearest > NEAR_LIMIT * limit
            && nearest <= limit
            && let Comparison::Nearer(foot) =
                target.compare(&center, part * nearest, MAX_SEARCHED_PIECES, deadline)
        {
            feet.insert(0, foot);
            self.known.push(foot);
        }
        if nearest > limit || nearest.is_nan() {
            match target.compare(&center, limit, MAX_COMPARED_PIECES, deadline) {
                Comparison::Farther => {
                    let at = [0, 1].map(|axis| self.start[axis] + 0.5 * self.length[axis]);
                    return Outcome::Beyond(Witness::new(&a[self.patch], at));
                }
                Comparison::Nearer(foot) => {
                    feet.insert(0, foot);
                    self.known.push(foot);
                }
                Comparison::Open => {}
            }
        }
        if feet.first().is_some_and(|foot| is_in_ball(&self.net, foot, target, limit)) {
            return Outcome::Within;
        }
        let own = SecondDerivatives::of(&self.net);
        let corners = self.net.corners();
        // Where corners are near enough, the cell is cut along the direction that bends more.
        let mut bends = None;
        for foot in &feet {
            match within(&corners, own, foot, target, limit) {
                Attempt::Proved => return Outcome::Within,
                Attempt::TooBent(along) => bends = bends.or(Some(along)),
                Attempt::TooFar => {}
            }
        }
        if self.level == MAX_LEVEL {
            return Outcome::GivenUp;
        }
        let lengths = lengths(&self.net);
        let longer = usize::from(lengths[1] > lengths[0]);
        let is_slender = lengths[longer] > MAX_ASPECT * lengths[1 - longer];
        let axis = match bends {
            Some([along_s, along_t]) if along_s != along_t && !is_slender => usize::from(along_t > along_s),
            _ => longer,
        };
        Outcome::Halves(self.halves(axis))
    }

    fn halves(self, axis: usize) -> [Self; 2] {
        let [first, second] = self.net.split(axis);
        let mut length = self.length;
        length[axis] *= 0.5;
        let mut start = self.start;
        start[axis] += length[axis];
        let level = self.level + 1;
        let known = self.known.clone();
        [
            Self { net: first, length, level, ..self },
            Self { patch: self.patch, net: second, start, length, level, known },
        ]
    }
}

/// Whether a cell was proved within the limit by way of one patch of B.
enum Attempt {
    Proved,
    /// A corner is beyond the limit from the points it was compared with.
    TooFar,
    /// The corners are within it, but the second derivatives along s and t are too large together.
    TooBent([f64; 2]),
}

/// Whether all control points of a cell are within the limit of one point of B, and by convexity all
/// of the cell. Where weights crowd a patch into a sliver of its domain, the rest of it is nearly a
/// point with large derivatives.
fn is_in_ball(net: &Net, foot: &Foot, target: &Target, limit: f64) -> bool {
    let center = target.patches[foot.patch].net.evaluate(foot.at.map(Interval::point));
    net.hull_points().all(|point| distance(&point, &center).hi <= limit)
}

/// Proves, if it can, that a cell is within the limit of one patch of B.
///
/// Each corner k of the cell gets parameters f_k in [0, 1]² of B's patch near it, found in float64
/// and from then on exact numbers. Let ψ be the bilinear map of [0, 1]² with ψ(corner k) = f_k and
/// D = A - B ∘ ψ, the length of whose value at (s, t) is an upper bound of the distance of A(s, t) from B. The
/// bilinear interpolant of D is longest at a corner, as norms are convex, and differs from D by at
/// most (max |D_ss| + max |D_tt|) / 8: with I_s and I_t the linear interpolation along s and t,
/// |D - I_s D| <= max |D_ss| / 8 and |I_s (D - I_t D)| <= max |D_tt| / 8. So
///
///   max |D| <= max_k |A_k - B(f_k)| + (|A_ss| + |A_tt| + |(B ∘ ψ)_ss| + |(B ∘ ψ)_tt|) / 8.
///
/// ψ is linear along s, so (B ∘ ψ)_ss = B''(ψ_s, ψ_s), and |ψ_s| is bounded component by component
/// by the differences of the f_k. B'' is bounded on the rectangle that the f_k span, to which the
/// patch is restricted first.
fn within(
    corners: &[Vector; 4],
    own: SecondDerivatives,
    foot: &Foot,
    target: &Target,
    limit: f64,
) -> Attempt {
    let feet = corners.map(|corner| target.finder.project_near(foot, middle(&corner)));
    // NaN is beyond every limit.
    if !feet.iter().all(|foot| foot.distance <= limit) {
        return Attempt::TooFar;
    }
    let net = &target.patches[foot.patch].net;
    let mut farthest = 0.0_f64;
    for (corner, foot) in corners.iter().zip(&feet) {
        let between = distance(corner, &net.evaluate(foot.at.map(Interval::point))).hi;
        if between > limit {
            return Attempt::TooFar;
        }
        farthest = farthest.max(between);
    }
    let eighth = Interval::point(0.125);
    let [a_ss, a_tt] = own.pure.map(Interval::point);
    let without_b = Interval::point(farthest) + eighth * (a_ss + a_tt);
    if without_b.hi > limit {
        return Attempt::TooBent(own.pure);
    }
    let [b_ss, b_tt] = bend(net, &feet);
    if (without_b + eighth * (b_ss + b_tt)).hi <= limit {
        Attempt::Proved
    } else {
        Attempt::TooBent([(a_ss + b_ss).hi, (a_tt + b_tt).hi])
    }
}

/// Upper bounds of |(B ∘ ψ)_ss| and |(B ∘ ψ)_tt| for the bilinear map ψ of [`within`]; `feet` at
/// (0, 0), (0, 1), (1, 0) and (1, 1).
fn bend(net: &Net, feet: &[Foot; 4]) -> [Interval; 2] {
    let range = |axis: usize| {
        feet.iter()
            .fold([1.0, 0.0], |[lo, hi], foot| [f64::min(lo, foot.at[axis]), f64::max(hi, foot.at[axis])])
    };
    let ranges = [range(0), range(1)];
    let restricted = net.restrict(0, ranges[0]).restrict(1, ranges[1]);
    let second = SecondDerivatives::of(&restricted);
    let [uu, vv] = second.pure.map(Interval::point);
    let mixed = Interval::point(2.0) * Interval::point(second.mixed);
    // How far ψ's derivative along s (pairs 0-2, 1-3) or t (pairs 0-1, 2-3) goes across the rectangle.
    let share = |axis: usize, pairs: [[usize; 2]; 2]| {
        let [lo, hi] = ranges[axis];
        if lo == hi {
            return Interval::ZERO;
        }
        let extent = Interval::point(hi) - Interval::point(lo);
        let shares = pairs.map(|[from, to]| {
            let step = Interval::point(feet[to].at[axis]) - Interval::point(feet[from].at[axis]);
            Interval::point((step / extent).magnitude())
        });
        shares[0].hull(shares[1])
    };
    [[[0, 2], [1, 3]], [[0, 1], [2, 3]]].map(|pairs| {
        let [du, dv] = [share(0, pairs), share(1, pairs)];
        uu * du.square() + mixed * du * dv + vv * dv.square()
    })
}
