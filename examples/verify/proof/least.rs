//! The proof of an interval around the least distance of two models.

use super::bezier::{Net, Patch, patches_of, project};
use super::boxes::box_distance;
use super::frame::Frame;
use super::target::{distance, lengths};
use super::vector::{Vector, difference, dot, exactly, hull, middle, norm};
use super::{Model, Motion, Report, Settings, Verdict, Witness};
use std::time::Instant;

/// The pairs of pieces that a proof looks at.
const MAX_PAIRS: usize = 1_000_000;

/// What a result says of the least distance.
#[derive(Debug, Clone, Copy)]
pub(crate) struct LeastClaim {
    pub(crate) lower: f64,
    pub(crate) upper: f64,
    /// The points of A and of B that are said to be `upper` apart.
    pub(crate) witness: [Witness; 2],
}

/// How a limit lies to the distances of all pairs of points.
enum Separation {
    /// All are proved to be at least the limit.
    Farther,
    /// Two points are proved to be nearer.
    Nearer,
    /// Neither before the deadline or the last pair.
    Open,
}

/// Proves `lower - slack <= least distance of a moved point of A from a point of B <= upper + slack`,
/// or the contrary.
///
/// The lower end is proved by a separating direction for all pairs of pieces, and refuted by two
/// points that are proved nearer. The upper end is proved by the witnesses, and refuted if all of A is
/// proved farther from B.
pub(crate) fn check_least(
    a: &Model,
    motion: &Motion,
    b: &Model,
    claim: &LeastClaim,
    settings: &Settings,
) -> Report {
    let deadline = Instant::now() + settings.time;
    let frame = Frame::new(a, motion, b);
    let size = if frame.diagonal > 0.0 { frame.diagonal } else { claim.upper };
    let slack = settings.slack * size;
    let models = [(a, *motion), (b, Motion::IDENTITY)].map(|(model, motion)| Placed { model, motion, frame });
    let mut report =
        Report { lower: Verdict::NotProved, upper: Verdict::NotProved, notes: Vec::new(), cells: 0 };
    let mut compare = |limit: f64| separation(&models, limit * frame.scale, deadline, &mut report.cells);
    let lower = claim.lower - slack;
    let lower = if lower <= 0.0 { Separation::Farther } else { compare(lower) };
    let [one, other] = [0, 1].map(|side| models[side].points(claim.witness[side]));
    let apart = one.iter().flat_map(|p| other.iter().map(move |q| distance(p, q).hi));
    let is_attained = apart.fold(f64::INFINITY, f64::min) <= (claim.upper + slack) * frame.scale;
    let upper = if is_attained { Separation::Nearer } else { compare(claim.upper + slack) };
    report.lower = match lower {
        Separation::Farther => Verdict::Proved,
        Separation::Nearer => Verdict::Refuted,
        Separation::Open => Verdict::NotProved,
    };
    report.upper = match upper {
        Separation::Nearer => Verdict::Proved,
        Separation::Farther => Verdict::Refuted,
        Separation::Open => Verdict::NotProved,
    };
    if report.lower == Verdict::Refuted {
        report.notes.push("lower: two points are nearer".to_owned());
    }
    if report.upper == Verdict::Refuted {
        report.notes.push("upper: all points are farther apart".to_owned());
    }
    report
}

/// A model in the common frame.
struct Placed<'a> {
    model: &'a Model,
    motion: Motion,
    frame: Frame,
}

impl Placed<'_> {
    /// The box of each surface's control points, whose hull contains the surface.
    fn boxes(&self) -> Vec<Vector> {
        let of_surface = |points: &mut dyn Iterator<Item = [f64; 3]>| {
            let mut placed = points.map(|point| self.frame.place(point, &self.motion));
            let first = placed.next().unwrap_or_else(|| unreachable!("a surface has control points"));
            placed.fold(first, |bounds, point| hull(&bounds, &point))
        };
        let surfaces = self.model.surfaces.iter();
        surfaces
            .map(|surface| of_surface(&mut surface.ctrl.iter().flatten().map(|&[x, y, z, _]| [x, y, z])))
            .collect()
    }

    fn patches(&self, surface: usize) -> Vec<Patch> {
        patches_of(self.model, surface, &self.frame, &self.motion)
    }

    /// The points at a witness's parameters: one of each patch that has them, which are points of
    /// the model all.
    fn points(&self, Witness { surface, u, v }: Witness) -> Vec<Vector> {
        let patches = self.patches(surface);
        let at = |patch: &Patch| Some(patch.net.evaluate(patch.local([[u, v]; 2])?));
        patches.iter().filter_map(at).collect()
    }
}

/// Compares the distances of all pairs of points with a limit, in the frame.
///
/// Every pair of surfaces is covered: one is left out where the boxes of the control points are
/// farther apart, and a pair of pieces where a direction separates it; the halves of a piece cover it.
fn separation([a, b]: &[Placed<'_>; 2], limit: f64, deadline: Instant, pairs_seen: &mut usize) -> Separation {
    let (of_a, of_b) = (a.boxes(), b.boxes());
    let mut cut: Vec<Option<Vec<Patch>>> = vec![None; of_b.len()];
    for (one, bounds) in of_a.iter().enumerate() {
        let near: Vec<usize> =
            (0..of_b.len()).filter(|&other| !is_apart(bounds, &of_b[other], limit)).collect();
        if near.is_empty() {
            continue;
        }
        let patches = a.patches(one);
        for other in near {
            let partners = cut[other].get_or_insert_with(|| b.patches(other));
            for patch in &patches {
                for partner in partners.iter() {
                    let pair = [patch.net.clone(), partner.net.clone()];
                    match separation_of_nets(pair, limit, deadline, pairs_seen) {
                        Separation::Farther => {}
                        found => return found,
                    }
                }
            }
        }
    }
    Separation::Farther
}

/// Whether two boxes are proved at least `limit` apart.
fn is_apart(a: &Vector, b: &Vector, limit: f64) -> bool {
    box_distance(a, b) >= limit
}

fn separation_of_nets(pair: [Net; 2], limit: f64, deadline: Instant, pairs_seen: &mut usize) -> Separation {
    let mut pairs = vec![pair];
    while let Some([one, other]) = pairs.pop() {
        if lower_bound(&one, &other) >= limit {
            continue;
        }
        let [p, q] = [&one, &other].map(Net::corners);
        let nearest = p.iter().flat_map(|p| q.iter().map(move |q| distance(p, q).hi));
        if nearest.fold(f64::INFINITY, f64::min) < limit {
            return Separation::Nearer;
        }
        *pairs_seen += 2;
        if *pairs_seen > MAX_PAIRS || Instant::now() >= deadline {
            return Separation::Open;
        }
        let sizes = [&one, &other].map(lengths);
        let longest = |sizes: [f64; 2]| sizes[0].max(sizes[1]);
        let axis = |sizes: [f64; 2]| usize::from(sizes[1] > sizes[0]);
        if longest(sizes[0]) >= longest(sizes[1]) {
            pairs.extend(one.split(axis(sizes[0])).map(|half| [half, other.clone()]));
        } else {
            pairs.extend(other.split(axis(sizes[1])).map(|half| [one.clone(), half]));
        }
    }
    Separation::Farther
}

/// A lower bound of the distance of the points of two patches: that of their boxes, or along the
/// direction n between points of both, the least n · (p - q) / |n| over the control points, since
/// |x - y| >= n · (x - y) / |n| for x and y in their hulls.
fn lower_bound(one: &Net, other: &Net) -> f64 {
    let between_boxes = box_distance(&one.bounding_box(), &other.bounding_box());
    let inner = |net: &Net| project(&net.points[net.points.len() / 2]);
    let along = exactly(middle(&difference(&inner(one), &inner(other))));
    let length = norm(&along);
    let least = one.hull_points().map(|p| dot(&along, &p).lo).fold(f64::INFINITY, f64::min);
    let largest = other.hull_points().map(|q| dot(&along, &q).hi).fold(f64::NEG_INFINITY, f64::max);
    let gap = least - largest;
    // A positive difference is rounded by less than a unit in the last place, and so is the quotient.
    let directed = if gap > 0.0 { (gap.next_down() / length.hi).next_down() } else { 0.0 };
    between_boxes.max(directed)
}
