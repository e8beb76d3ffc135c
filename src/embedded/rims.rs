//! The rims of trimmed faces: whether they meet themselves.
//!
//! What is stated of points of one face is stated along its surface, which may go on beyond the rim. If the rim does not
//! meet itself, neither does the region within it, and what is one point of the surface is one point of the face (lemma S10
//! of docs/solids.md).

use super::audit::{Audited, FromShared, Ways};
use super::complex::{Complex, RimArc};
use super::directions::{Direction, Directions, common_side};
use super::division::{Division, Shape, Task, decide};
use super::piece::{Piece, Side};
use super::{Limits, Verdict};
use crate::bezier::PatchSet;
use crate::bvh::Aabb;
use crate::clearance::hull_distance;
use crate::param_box::ParamBox;
use glam::DVec3;
use std::cell::OnceCell;

/// A part of an arc at which a face ends.
struct Part {
    /// The arc's number.
    arc: usize,
    rim: RimArc,
    /// The patch over the parameters of the part; only its side counts.
    piece: Piece,
    points: Vec<DVec3>,
    aabb: Aabb,
    along: Directions,
    samples: OnceCell<[DVec3; 3]>,
    halves: Option<[u32; 2]>,
}

/// The search over all pairs of parts of the rims of the same face.
pub(super) struct RimSearch<'a> {
    patches: &'a PatchSet,
    complex: &'a Complex,
    parts: Vec<Part>,
    audited: Audited,
}

impl<'a> RimSearch<'a> {
    /// `apart` is the distance up to which points are near each other, with the rounding of distances of computed points.
    pub(super) fn new(patches: &'a PatchSet, complex: &'a Complex, apart: f64) -> Self {
        let parts = complex.rims().iter().enumerate();
        let parts = parts.map(|(arc, &rim)| Part::new(patches, arc, rim, 0)).collect();
        Self { patches, complex, parts, audited: Audited::new(apart) }
    }

    /// Decides all pairs, or returns the first that is not decided.
    pub(super) fn run(self, limits: &Limits<'_>) -> Verdict {
        let sheets: Vec<usize> = self.parts.iter().map(|part| part.rim.sheet).collect();
        let is_pair = |[a, b]: [u32; 2]| sheets[a as usize] == sheets[b as usize];
        decide(self, sheets.len() as u32, is_pair, limits)
    }

    fn part(&self, index: u32) -> &Part {
        &self.parts[index as usize]
    }

    /// Returns an upper bound on the ways along a part between points of it that are near each other.
    fn alone(&self, part: &Part, most: f64) -> Option<f64> {
        let directions: Vec<Direction> = part.along.turned(false).collect();
        let ways = Ways { margin: common_side(&directions)?.1, rest: 2.0 * part.along.rest };
        self.audited.stated(ways, most, |slack| ways.hold_along(part.samples(self.patches), slack))
    }

    /// Returns an upper bound on the ways along the rim between points of two parts that are near each other, 0 if there are
    /// none.
    fn of_two(&self, [a, b]: [&Part; 2], most: f64) -> Option<f64> {
        let apart = self.audited.apart();
        if !a.aabb.grown(apart).meets(&b.aabb) {
            return Some(0.0);
        }
        let start = a.aabb.center() - b.aabb.center();
        if hull_distance(&a.points, &b.points, start, 2.0 * apart, 0.0).lower > apart {
            return Some(0.0);
        }
        if let Some(found) = self.along_edge([a, b], most) {
            return Some(found);
        }
        let ends = (0..2).flat_map(|of_a| (0..2).map(move |of_b| [of_a, of_b]));
        let mut stated = ends.filter_map(|ends| self.about([a, b], ends, most));
        stated.next()
    }

    /// Returns an upper bound on the ways from points of two parts that are near each other to the ends that they share.
    fn about(&self, [a, b]: [&Part; 2], [of_a, of_b]: [usize; 2], most: f64) -> Option<f64> {
        let spread = self.spread([a, b], [of_a, of_b])?;
        let back = b.along.turned(of_b == 0);
        let directions: Vec<Direction> = a.along.turned(of_a == 1).chain(back).collect();
        let rest = spread + 2.0 * (a.along.rest + b.along.rest);
        let ways = Ways { margin: common_side(&directions)?.1, rest };
        self.audited.stated_between(ways, most, || {
            [(a, of_a), (b, of_b)].map(|(part, end)| part.points_from(end, self.patches))
        })
    }

    /// Returns an upper bound on the ways between points of two parts that are near each other, along both and with a step
    /// between them, if these are of arcs that are joined to each other.
    fn along_edge(&self, [a, b]: [&Part; 2], most: f64) -> Option<f64> {
        let all = self.complex.edges([a.rim.patch, b.rim.patch], [a, b]);
        let own = all.filter(|(parts, edge)| (0..2).all(|k| parts[k].rim.side == edge.sides[k]));
        let found = own.flat_map(|(parts, edge)| {
            let pieces = parts.map(|part| &part.piece);
            let widths = [0, 1].map(|first| edge.width(pieces, first, self.audited.apart()));
            widths.into_iter().flatten().map(move |width| (parts, width))
        });
        let mut stated = found.filter_map(|(parts, (width, is_reversed))| {
            let [one, other] = parts.map(|part| &part.along);
            let directions: Vec<Direction> = one.turned(false).chain(other.turned(is_reversed)).collect();
            let rest = width + 2.0 * (one.rest + other.rest);
            let ways = Ways { margin: common_side(&directions)?.1, rest };
            self.audited.stated(ways, most, |slack| {
                parts.iter().all(|part| ways.hold_along(part.samples(self.patches), slack))
            })
        });
        stated.next()
    }

    /// Returns how far these ends of two parts are from each other, if they are one point of the rim or one corner.
    fn spread(&self, [a, b]: [&Part; 2], [of_a, of_b]: [usize; 2]) -> Option<f64> {
        if a.arc == b.arc && of_a != of_b && a.rim.range[of_a] == b.rim.range[of_b] {
            return Some(0.0);
        }
        let corner = a.rim.corners[of_a].filter(|_| a.rim.corners[of_a] == b.rim.corners[of_b])?;
        Some(self.complex.spread(corner))
    }
}

impl Division for RimSearch<'_> {
    fn shape(&self, index: u32) -> Shape {
        let Part { rim, piece, aabb, .. } = self.part(index);
        Shape { patch: rim.patch, aabb: *aabb, level: piece.level, is_first: false }
    }

    fn gain(&self, index: u32) -> f64 {
        self.part(index).aabb.diagonal()
    }

    fn halves(&mut self, index: u32) -> [u32; 2] {
        let part = self.part(index);
        if let Some(halves) = part.halves {
            return halves;
        }
        let RimArc { range: [from, to], corners: [start, end], .. } = part.rim;
        let middle = 0.5 * (from + to);
        let ends = [([from, middle], [start, None]), ([middle, to], [None, end])];
        let (arc, level) = (part.arc, part.piece.level + 1);
        let rims = ends.map(|(range, corners)| RimArc { range, corners, ..part.rim });
        let first = self.parts.len() as u32;
        self.parts.extend(rims.map(|rim| Part::new(self.patches, arc, rim, level)));
        let halves = [first, first + 1];
        self.parts[index as usize].halves = Some(halves);
        halves
    }

    fn within(&self, task: Task, most: f64) -> Option<f64> {
        match task {
            Task::One(index) => self.alone(self.part(index), most),
            Task::Two(pair) => self.of_two(pair.map(|index| self.part(index)), most),
        }
    }

    fn audited(&self) -> &Audited {
        &self.audited
    }
}

impl Part {
    fn new(patches: &PatchSet, arc: usize, rim: RimArc, level: u32) -> Self {
        let mut range = ParamBox::UNIT;
        range[rim.side.axis.other()] = rim.range;
        let patch = patches.patch(rim.patch as usize);
        let piece = Piece::new(&patch, rim.patch, range, level, std::iter::empty());
        let points = piece.side_points(rim.side);
        let aabb = points.iter().copied().fold(Aabb::EMPTY, Aabb::with);
        let along = piece.along_side(rim.side);
        Self { arc, rim, piece, points, aabb, along, samples: OnceCell::new(), halves: None }
    }

    /// Returns the points at both ends and in the middle, evaluated on the patch at first use.
    fn samples(&self, patches: &PatchSet) -> [DVec3; 3] {
        *self.samples.get_or_init(|| {
            let Side { axis, end } = self.rim.side;
            let patch = patches.patch(self.rim.patch as usize);
            [0.0, 0.5, 1.0].map(|share| {
                let mut shares = [end as f64; 2];
                shares[axis.other()] = share;
                patch.point(self.piece.range.at(shares))
            })
        })
    }

    /// Returns the points with their ways from an end.
    fn points_from(&self, end: usize, patches: &PatchSet) -> Vec<FromShared> {
        let samples = self.samples(patches);
        samples.iter().map(|&point| FromShared { point, way: point.distance(samples[2 * end]) }).collect()
    }
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;
    use crate::axis::Axis;
    use crate::bezier::extract;
    use crate::embedded::Doubt;
    use crate::embedded::tests::{BACK, back_and_forth, of, quads, spline};
    use crate::model::Model;
    use crate::solid::{Edges, SurfaceOrigin, joined_arcs};

    /// How near points are near to each other.
    const NEAR: f64 = 1e-9;

    /// The verdict on the rim of one face that consists of these surfaces.
    fn of_model(model: &Model) -> Verdict {
        let aabb = model.bounding_box();
        let limits = Limits { nearness: NEAR, most: 1e-3 * aabb.diagonal(), is_late: &|| false };
        with_search(model, |search| search.run(&limits))
    }

    fn with_search<T>(model: &Model, ask: impl FnOnce(RimSearch<'_>) -> T) -> T {
        let (bezier, aabb) = (extract(model), model.bounding_box());
        let edges = Edges::of_surfaces(&bezier, SurfaceOrigin::whole);
        let joined = joined_arcs(edges, &|_| [DVec3::NAN; 3], &aabb, 0.5 * NEAR);
        let complex = Complex::new(&bezier, joined, |_| Some(0), NEAR);
        ask(RimSearch::new(&bezier.patches, &complex, NEAR))
    }

    /// Up to which distance the rim of quadrilaterals is said to be embedded: none where it is not.
    fn within(corners: &[[[f64; 3]; 4]]) -> Option<f64> {
        let Verdict::Embedded { within } = of_model(&quads(corners)) else { return None };
        Some(within)
    }

    /// At a right angle, the ways to the corner are √2 times as long as its points are far apart.
    #[test]
    fn ways_to_a_corner_are_attained() {
        let found = within(&[[[0.0; 3], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]]]);
        let expected = 2.0_f64.sqrt() * NEAR;
        assert!(found.is_some_and(|found| (found - expected).abs() < 1e-6 * expected), "{found:?}");
    }

    /// A corner of one square is nearer to a side of the other than what is near.
    #[test]
    fn parts_that_are_near_each_other_are_not_apart() {
        let x = 1.0 + 0.8 * NEAR;
        let found = of_model(&quads(&[
            [[0.0; 3], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]],
            [[x, 0.4, 0.0], [x + 1.0, -0.6, 0.0], [x + 2.0, 0.4, 0.0], [x + 1.0, 1.4, 0.0]],
        ]));
        assert!(matches!(found, Verdict::Undecided { doubt: Doubt::Contact, .. }), "{found:?}");
    }

    #[test]
    fn what_has_no_direction_is_in_the_ways_along_a_part() {
        let of_side = |search: RimSearch<'_>| {
            let side = Side { axis: Axis::V, end: 0 };
            let rim = RimArc { sheet: 0, patch: 0, side, range: [0.0, 1.0], corners: [None; 2] };
            search.alone(&Part::new(search.patches, 0, rim, 0), 1.0)
        };
        let within = with_search(&back_and_forth(), of_side);
        assert!(within.is_some_and(|within| within >= BACK), "{within:?}");
    }

    /// Three squares about a reflex corner. One is moved, so that its rim crosses that of the square across the corner: the
    /// ways from there to both corners are as long as the move, one each.
    #[test]
    fn the_spread_of_a_corner_is_in_the_ways_to_it() {
        let gap = 1e-6;
        let square = |x: f64, y: f64, [right, down]: [f64; 2]| {
            let at = |s: f64, t: f64| [x + s + right, y + t - down, 0.0];
            [at(0.0, 0.0), at(1.0, 0.0), at(1.0, 1.0), at(0.0, 1.0)]
        };
        let still = [0.0; 2];
        let found =
            within(&[square(-1.0, -1.0, still), square(0.0, -1.0, still), square(-1.0, 0.0, [gap; 2])]);
        assert!(found.is_some_and(|found| 2.0 * gap <= found && found < 2.1 * gap), "{found:?}");
    }

    /// Two sheets whose sides are joined to each other: one is straight, and the other crosses it in the middle of both. The
    /// sides of their parts there are a step apart: the slope of 1.5 bends over the 64th that a part is long. The width of an
    /// edge exceeds that by less than the step.
    #[test]
    fn the_width_of_a_joined_edge_is_in_the_ways_along_it() {
        let bend = 3e-5;
        let sides = |xs: [[f64; 4]; 2]| {
            let row =
                |xs: [f64; 4]| (0..4).map(|k| DVec3::new(xs[k], k as f64 / 3.0, 0.0)).collect::<Vec<_>>();
            let mut sheet = spline([1, 3], &xs.map(row));
            sheet.knots = [vec![0.0, 0.0, 1.0, 1.0], [[0.0; 4], [1.0; 4]].concat()];
            sheet
        };
        let bent = sides([[-1.0; 4], [0.0, bend, -bend, 0.0]]);
        let found = of_model(&of(vec![bent, sides([[0.0; 4], [1.0; 4]])]));
        let Verdict::Embedded { within } = found else { panic!("{found:?}") };
        let step = 1.5 * bend / 64.0;
        assert!(0.9 * step < within && within < 2.0 * step, "{within:e} for {step:e}");
    }

    /// A sheet that is folded onto itself: the sides across from the fold cross each other, and are not those that are
    /// joined.
    #[test]
    fn sides_that_cross_are_not_taken_for_those_that_are_joined() {
        let found = of_model(&quads(&[
            [[0.0; 3], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]],
            [[0.0, 1.0, 0.0], [0.9, 1.0, 0.0], [1.1, 0.0, 0.0], [0.0; 3]],
        ]));
        assert!(matches!(found, Verdict::Undecided { doubt: Doubt::Contact, .. }), "{found:?}");
    }
}
