//! Feature edges by the directions into both faces along their sides: no normals are compared, and no shells.

use super::areas::Surface;
use super::{Asked, outside};
use glam::DVec3;
use nurbs_hausdorff::Interval;
use std::f64::consts::PI;

/// The samples of a side of a surface.
const STEPS: usize = 120;

/// The largest distance, relative to the rounding of distances, at which two sides are edges of neighbours.
const JOINED: f64 = 1e3;

/// The least difference between two angles of which the sampler says which is larger: samples of the two sides are not at
/// the same point.
const ANGLE: f64 = 1e-3;

/// The part of a length by which polygons are off at most.
const COARSENESS: f64 = 0.01;

/// The part of a model's size up to which edges count as none.
const NONE: f64 = 1e-5;

/// A point of an edge of a model, with half of the length that it stands for, as both faces have it.
#[derive(Clone, Copy)]
struct Sample {
    point: DVec3,
    length: f64,
    /// Whether the surface turns by more than the angle there; none where the difference is too small to say.
    is_feature: Option<bool>,
    /// Whether it is the first one of its side.
    is_first: bool,
}

/// Returns the lengths of the samples between which an answer changes along a side: each change is anywhere between.
fn of_changes<T: PartialEq>(samples: &[Sample], answer: impl Fn(&Sample) -> T) -> f64 {
    let change = |pair: &[Sample]| {
        let is_change = !pair[1].is_first && answer(&pair[0]) != answer(&pair[1]);
        if is_change { pair[0].length + pair[1].length } else { 0.0 }
    };
    samples.windows(2).map(change).sum()
}

/// A side of a surface's parameters.
#[derive(Clone, Copy)]
struct Side {
    sheet: usize,
    axis: usize,
    end: f64,
}

impl Side {
    fn fractions(&self, along: f64) -> [f64; 2] {
        if self.axis == 0 { [self.end, along] } else { [along, self.end] }
    }

    fn point(&self, surface: &Surface, along: f64) -> DVec3 {
        let sheet = &surface.sheets[self.sheet];
        surface.place(sheet.point(sheet.at(self.fractions(along))))
    }

    /// Returns the unit vector at right angles to the side that points into the face; `None` where the face has no tangent
    /// plane.
    fn inward(&self, surface: &Surface, along: f64) -> Option<DVec3> {
        let sheet = &surface.sheets[self.sheet];
        let at = sheet.tangents(sheet.at(self.fractions(along)));
        let (across, tangent) = if self.axis == 0 { (at.u, at.v) } else { (at.v, at.u) };
        let across = if self.end > 0.0 { -across } else { across };
        let tangent = tangent.try_normalize()?;
        let inward = across.reject_from_normalized(tangent);
        // Nearly along the side nothing is left of it but rounding.
        (inward.length() > ANGLE * across.length()).then(|| surface.rotate(inward).normalize())
    }

    /// Returns the fraction along the side at which it is nearest to a point, and the distance there.
    fn nearest(&self, surface: &Surface, point: DVec3, polygon: &[DVec3]) -> (f64, f64) {
        let distance = |along: f64| self.point(surface, along).distance(point);
        let (index, _) = polygon
            .iter()
            .enumerate()
            .map(|(index, other)| (index, other.distance(point)))
            .fold((0, f64::INFINITY), |best, one| if one.1 < best.1 { one } else { best });
        let at = |k: usize| k as f64 / STEPS as f64;
        let (mut low, mut high) = (at(index.saturating_sub(1)), at((index + 1).min(STEPS)));
        for _ in 0..60 {
            let (one, other) = (low + (high - low) / 3.0, high - (high - low) / 3.0);
            if distance(one) <= distance(other) {
                high = other;
            } else {
                low = one;
            }
        }
        let along = 0.5 * (low + high);
        [along, low, high].map(|at| (at, distance(at))).into_iter().fold(
            (along, f64::INFINITY),
            |best, one| {
                if one.1 < best.1 { one } else { best }
            },
        )
    }
}

/// Returns samples of all edges of a closed model.
fn samples(surface: &Surface, feature: f64, joined: f64) -> Vec<Sample> {
    let of = |sheet| [(0, 0.0), (0, 1.0), (1, 0.0), (1, 1.0)].map(|(axis, end)| Side { sheet, axis, end });
    let sides: Vec<Side> = (0..surface.sheets.len()).flat_map(of).collect();
    let polygon =
        |side: &Side| (0..=STEPS).map(|k| side.point(surface, k as f64 / STEPS as f64)).collect::<Vec<_>>();
    let polygons: Vec<Vec<DVec3>> = sides.iter().map(polygon).collect();
    let mut found = Vec::new();
    for (index, side) in sides.iter().enumerate() {
        for step in 0..STEPS {
            let along = (step as f64 + 0.5) / STEPS as f64;
            let point = side.point(surface, along);
            let length = 0.5 * polygons[index][step].distance(polygons[index][step + 1]);
            // The other side of a thin face may be within the distance as well.
            let others = (0..sides.len()).filter(|&other| other != index).filter_map(|other| {
                let coarse =
                    polygons[other].iter().map(|at| at.distance(point)).fold(f64::INFINITY, f64::min);
                let reach = 2.0
                    * polygons[other].windows(2).map(|pair| pair[0].distance(pair[1])).fold(0.0, f64::max);
                let near = (coarse <= reach + joined)
                    .then(|| sides[other].nearest(surface, point, &polygons[other]));
                near.filter(|(_, distance)| *distance <= joined).map(|(at, distance)| (other, at, distance))
            });
            let other = others.min_by(|(.., one), (.., other)| one.total_cmp(other));
            let turn = other.and_then(|(other, at, _)| {
                let (one, two) = (side.inward(surface, along)?, sides[other].inward(surface, at)?);
                Some(PI - one.cross(two).length().atan2(one.dot(two)))
            });
            let is_feature = turn.filter(|turn| (turn - feature).abs() > ANGLE).map(|turn| turn > feature);
            found.push(Sample { point, length, is_feature, is_first: step == 0 });
        }
    }
    found
}

/// Returns in words which parts of both models' edges, and which lengths, are refuted by samples.
pub(super) fn violations(
    surfaces: &[Surface; 2],
    parts: [Interval; 2],
    lengths: [Interval; 2],
    asked: &Asked,
) -> Vec<String> {
    let all = [0, 1].map(|k| samples(&surfaces[k], asked.angles[1], JOINED * asked.rounding));
    let mut found = Vec::new();
    let mut totals = [[0.0; 2]; 2];
    for (k, samples) in all.iter().enumerate() {
        let sum = |is: &dyn Fn(&Sample) -> bool| -> f64 {
            samples.iter().filter(|sample| is(sample)).map(|sample| sample.length).sum()
        };
        let [least, most] = [sum(&|of| of.is_feature == Some(true)), sum(&|of| of.is_feature != Some(false))];
        let changes = of_changes(samples, |sample| sample.is_feature);
        let error = COARSENESS * most + changes + JOINED * asked.rounding;
        found.extend(outside(["candidate's edges", "truth's edges"][k], lengths[k], [least, most], error));
        totals[k] = [least, most];
    }
    let size = asked.threshold.max(totals[0][1]).max(totals[1][1]);
    for k in [0, 1] {
        // Where a model may have edges or none, the part may be anything.
        if totals.iter().any(|of| of[0] <= NONE * size && of[1] > 0.0) {
            continue;
        }
        let [of_own, of_other] = [totals[k][1] > 0.0, totals[1 - k][1] > 0.0];
        let ([least, most], error) = match (of_own, of_other) {
            (false, false) => ([1.0; 2], 0.0),
            (true, true) => part(&all[k], &all[1 - k], asked),
            _ => ([0.0; 2], 0.0),
        };
        let error = COARSENESS + error;
        found.extend(outside(["edge precision", "edge recall"][k], parts[k], [least, most], error));
    }
    found
}

/// What is known of a sample.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Answer {
    /// It is of no feature edge.
    Smooth,
    /// It has a counterpart.
    Near,
    /// It has none.
    Far,
    /// Neither is told.
    Open,
}

/// Returns the part of the length of edges whose samples have a counterpart among those of the other model at least, the
/// part that may have, and what steps may be off.
fn part(own: &[Sample], other: &[Sample], asked: &Asked) -> ([f64; 2], f64) {
    // A point of an edge is within half of a step of a sample, whose length stands for half of both faces'.
    let spacing = other.iter().map(|sample| sample.length).fold(0.0, f64::max) * 2.0;
    let answer = |sample: &Sample| {
        let within = |reach: f64, is_certain: bool| {
            other.iter().any(|of| {
                let counts =
                    if is_certain { of.is_feature == Some(true) } else { of.is_feature != Some(false) };
                counts && of.point.distance(sample.point) <= reach
            })
        };
        match sample.is_feature {
            Some(false) => Answer::Smooth,
            None => Answer::Open,
            Some(true) if within(asked.threshold - asked.rounding, true) => Answer::Near,
            Some(true) if within(asked.threshold + spacing + asked.rounding, false) => Answer::Open,
            Some(true) => Answer::Far,
        }
    };
    let answers: Vec<Answer> = own.iter().map(answer).collect();
    let sum = |of: Answer| -> f64 {
        own.iter().zip(&answers).filter(|(_, answer)| **answer == of).map(|(sample, _)| sample.length).sum()
    };
    let [near, far, open] = [Answer::Near, Answer::Far, Answer::Open].map(sum);
    let changes: f64 = (1..own.len())
        .filter(|&index| !own[index].is_first && answers[index] != answers[index - 1])
        .map(|index| own[index].length + own[index - 1].length)
        .sum();
    let total = near + far + open;
    if total > 0.0 { ([near / total, 1.0 - far / total], changes / total) } else { ([0.0, 1.0], 0.0) }
}
