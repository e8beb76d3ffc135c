//! Facts of both models, compared.

use super::result::{AtAngle, AtThreshold, Difference, EdgesAt, FaceCounts, ScoredModel, SurfaceScore};
use crate::engine::info::first_alike;
use crate::engine::statistics::Sums;
use crate::engine::{Beyond, Body, BodyKind, Counts, DiffResult, FaceDifference, FaceState, PreparedModel};
use crate::facts::Orientation;
use crate::interval::Interval;
use crate::model::RigidTransform;
use crate::threads::parallel::map;
use glam::DVec3;
use std::collections::{BTreeSet, HashSet};

/// The interval of a part of a whole.
const PART: Interval = Interval { lower: 0.0, upper: 1.0 };

impl ScoredModel {
    /// Measures a model moved by a transform; a cloud has no bodies that could meet themselves. The facts are computed
    /// at first use. When it is late, nothing is known of whether bodies meet themselves.
    pub(super) fn new(
        model: &PreparedModel,
        transform: &RigidTransform,
        is_late: &(dyn Fn() -> bool + Sync),
    ) -> Self {
        let (bodies, facts) = (model.bodies(), model.facts());
        let duplicates = duplicates(model, &bodies);
        let of_kind = |kind| bodies.iter().filter(|body| body.kind == kind).count();
        let closed = !bodies.is_empty() && of_kind(BodyKind::Solid) == bodies.len();
        let oriented = oriented(&bodies);
        let singles = model.single_bodies().unwrap_or_default();
        let embedded = map(singles.len(), |index| singles[index].embedding(is_late).embedded);
        let self_overlaps = embedded.iter().filter(|&&embedded| embedded == Some(false)).count();
        let is_known = !embedded.is_empty() && embedded.iter().all(Option::is_some);
        let embedded = if self_overlaps > 0 { Some(false) } else { is_known.then_some(true) };
        Self {
            valid: validity(closed && duplicates == 0, [oriented, embedded]),
            embedded,
            closed,
            oriented,
            duplicates,
            self_overlaps,
            bodies: of_kind(BodyKind::Solid),
            sheets: of_kind(BodyKind::Sheet),
            voids: bodies.iter().map(|body| body.voids).sum(),
            volume: facts.volume,
            area: facts.area,
            centroid: facts.centroid.map(|centroid| moved(&centroid, transform)),
            extents: model.moved_extents(transform).map(Interval::not_negative),
        }
    }
}

/// Returns the number of duplicate faces or triangles.
///
/// A face is a duplicate if an earlier face of its body has the same surface and loops. All faces of a body are duplicates
/// if an earlier body has the same faces. Two bodies that lie flush on each other each have a face there, which is no
/// duplicate. A triangle is a duplicate if an earlier one has the same corners.
fn duplicates(model: &PreparedModel, bodies: &[Body]) -> usize {
    let Some(source) = model.source() else { return Counts::of_prepared(model).duplicate_triangles };
    let first = first_alike(source);
    let mut known = HashSet::new();
    let of_body = |body: &Body| {
        let different: BTreeSet<usize> = body.faces.iter().map(|&face| first[face]).collect();
        let count = different.len();
        if known.insert(different) { body.faces.len() - count } else { body.faces.len() }
    };
    bodies.iter().map(of_body).sum()
}

/// Returns whether the normals of all bodies point out of them.
fn oriented(bodies: &[Body]) -> Option<bool> {
    let mut all = Some(!bodies.is_empty());
    for body in bodies {
        match body.orientation {
            Some(Orientation::Consistent) => {}
            Some(Orientation::Undecided) => all = all.filter(|&known| !known),
            _ => return Some(false),
        }
    }
    all
}

fn validity(is_whole: bool, others: [Option<bool>; 2]) -> Interval {
    if !is_whole || others.contains(&Some(false)) {
        Interval::exactly(0.0)
    } else if others == [Some(true); 2] {
        Interval::exactly(1.0)
    } else {
        PART
    }
}

/// Returns the image of a point that is known in intervals.
fn moved(point: &[Interval; 3], transform: &RigidTransform) -> [Interval; 3] {
    let middle = DVec3::from_array(point.map(|one| one.middle()));
    let radius = length(&point.map(|one| Interval::exactly(one.radius()))).upper;
    let error = Interval::exactly(radius) + Interval::exactly(transform.rounding(middle.length()));
    transform.apply(middle).to_array().map(|at| Interval::about(at, error.upper))
}

/// Returns the length of a vector that is known in intervals.
fn length(vector: &[Interval; 3]) -> Interval {
    let square = |one: Interval| one.absolute() * one.absolute();
    (square(vector[0]) + square(vector[1]) + square(vector[2])).root()
}

/// Returns the distance of two points that are known in intervals.
pub(super) fn distance(one: [Interval; 3], other: [Interval; 3]) -> Interval {
    length(&[0, 1, 2].map(|axis| one[axis] - other[axis]))
}

impl Difference {
    /// Compares two numbers that are not negative; of 0 and 0 nothing is known of the ratio.
    pub(super) fn new(candidate: Interval, truth: Interval) -> Self {
        let ratio = candidate.over(truth).smaller(truth.over(candidate)).within(PART);
        Self { difference: candidate - truth, ratio }
    }
}

/// Returns the part within a limit, of the part beyond it.
fn within(beyond: &Beyond) -> Interval {
    (Interval::exactly(1.0) - beyond.part).within(PART)
}

/// Returns the part within the least of ascending limits.
pub(super) fn within_least(beyond: &[Beyond]) -> Option<Interval> {
    beyond.first().map(within)
}

impl SurfaceScore {
    pub(super) fn new(mean: Interval, rms: Interval) -> Self {
        Self { mean, mean_square: (rms * rms).not_negative() }
    }

    /// What statistics that go on know so far.
    pub(super) fn of_sums(sums: &Sums) -> Self {
        Self::new(sums.mean, sums.rms)
    }
}

/// Combines the parts beyond thresholds of both directions.
pub(super) fn at_thresholds(forward: &[Beyond], reverse: &[Beyond]) -> Vec<AtThreshold> {
    let at = |(one, other): (&Beyond, &Beyond)| {
        let (precision, recall) = (within(one), within(other));
        let f1 = super::numbers::f1(precision, recall);
        AtThreshold { threshold: one.limit, precision, recall, f1, normals: None, edges: None }
    };
    forward.iter().zip(reverse).map(at).collect()
}

impl AtAngle {
    /// Combines the parts with like counterparts of both directions.
    pub(super) fn new(normal_angle: f64, [normal_precision, normal_recall]: [Interval; 2]) -> Self {
        let normal_f1 = super::numbers::f1(normal_precision, normal_recall);
        Self { normal_angle, normal_precision, normal_recall, normal_f1 }
    }
}

impl EdgesAt {
    /// Combines the parts of feature edges of both directions.
    pub(super) fn new([edge_precision, edge_recall]: [Interval; 2]) -> Self {
        Self { edge_precision, edge_recall, edge_f1: super::numbers::f1(edge_precision, edge_recall) }
    }
}

impl FaceCounts {
    pub(super) fn new(diff: &DiffResult) -> Self {
        let [candidate, truth] = [&diff.faces_of_a, &diff.faces_of_b].map(|faces| unchanged(faces));
        let changed = |faces: &[FaceDifference]| {
            [faces.iter().filter(|face| face.state == FaceState::Changed).count(), faces.len()]
        };
        Self {
            limit: diff.limit,
            candidate,
            truth,
            changed_of_candidate: changed(&diff.faces_of_a),
            changed_of_truth: changed(&diff.faces_of_b),
        }
    }
}

/// Returns the part of faces, by number, that are unchanged.
fn unchanged(faces: &[FaceDifference]) -> Interval {
    let count = |state| faces.iter().filter(|face| face.state == state).count() as f64;
    let least = count(FaceState::Unchanged);
    let found = Interval { lower: least, upper: least + count(FaceState::Undecided) };
    found.over(Interval::exactly(faces.len() as f64)).within(PART)
}
