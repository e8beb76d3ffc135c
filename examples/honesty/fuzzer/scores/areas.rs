//! Samples of surfaces with their normals, and cells that have all points of the other one.
//!
//! A sample has a like counterpart if a corner of a cell is one, and has none if no cell may hold one. Between both it
//! counts for either answer.

use super::super::facets::to_triangle;
use super::super::sheet::{Sheet, sheets};
use super::{Asked, outside};
use fastrand::Rng;
use glam::DVec3;
use nurbs_hausdorff::{Interval, Model, RigidTransform};

/// The samples of a surface, and the cells of all surfaces of a model, about.
const SAMPLES: usize = 300;
const CELLS: usize = 12_000;

/// The factor by which the radius of a cell and the turn of its normals may exceed those at its corners.
const GROWTH: f64 = 1.5;

/// The standard errors by which a part of samples may be off, the slack of a part where all samples agree, and the share of
/// the parameters that this number of samples may miss. They are those of the family of statistics.
const STANDARD_ERRORS: f64 = 6.0;
const BINOMIAL: f64 = 0.05;
const UNSEEN: f64 = 0.05;

/// A model, moved, about an origin.
pub(super) struct Surface {
    pub(super) sheets: Vec<Sheet>,
    triangles: Option<Vec<[DVec3; 3]>>,
    center: DVec3,
    transform: RigidTransform,
    origin: DVec3,
}

struct Sample {
    point: DVec3,
    normal: DVec3,
    weight: f64,
}

/// A part of a surface.
enum Cell {
    /// All points are within the radius of the middle, and all normals within the angle of the one there. Corners are points
    /// with normals.
    Patch {
        middle: DVec3,
        radius: f64,
        normal: DVec3,
        turn: f64,
        corners: Vec<(DVec3, DVec3)>,
    },
    Triangle([DVec3; 3]),
}

impl Surface {
    pub(super) fn new(
        model: &Model,
        triangles: Option<Vec<[DVec3; 3]>>,
        transform: RigidTransform,
        origin: DVec3,
    ) -> Self {
        let center = model.bounding_box().center();
        let mut surface = Self { sheets: sheets(model, center), triangles: None, center, transform, origin };
        surface.triangles =
            triangles.map(|all| all.into_iter().map(|of| of.map(|at| surface.place(at - center))).collect());
        surface
    }

    /// Moves a point of a sheet.
    pub(super) fn place(&self, point: DVec3) -> DVec3 {
        self.transform.apply(point + self.center) - self.origin
    }

    pub(super) fn rotate(&self, vector: DVec3) -> DVec3 {
        self.transform.rotation() * vector
    }

    /// Returns a point with its normal, not of unit length, whose length is the density of the area.
    fn at(&self, sheet: &Sheet, fractions: [f64; 2]) -> (DVec3, DVec3) {
        let at = sheet.tangents(sheet.at(fractions));
        (self.place(at.point), self.rotate(at.u.cross(at.v)))
    }

    fn samples(&self, rng: &mut Rng) -> Vec<Sample> {
        if let Some(triangles) = &self.triangles {
            let each = SAMPLES.div_ceil(triangles.len());
            let of = |&[a, b, c]: &[DVec3; 3], rng: &mut Rng| {
                let (root, part) = (rng.f64().sqrt(), rng.f64());
                let point = a + (b - a) * (root * (1.0 - part)) + (c - a) * (root * part);
                let normal = (b - a).cross(c - a);
                Sample { point, normal: normal.normalize_or_zero(), weight: normal.length() }
            };
            let all = triangles.iter().flat_map(|triangle| std::iter::repeat_n(triangle, each));
            return all.map(|triangle| of(triangle, rng)).collect();
        }
        let each = SAMPLES.div_ceil(self.sheets.len());
        let all = self.sheets.iter().flat_map(|sheet| std::iter::repeat_n(sheet, each));
        let of = |sheet: &Sheet, rng: &mut Rng| {
            let (point, normal) = self.at(sheet, [rng.f64(), rng.f64()]);
            let weight = normal.length() * sheet.extent().x * sheet.extent().y;
            Sample { point, normal: normal.normalize_or_zero(), weight }
        };
        all.map(|sheet| of(sheet, rng)).collect()
    }

    fn cells(&self) -> Vec<Cell> {
        if let Some(triangles) = &self.triangles {
            return triangles.iter().copied().map(Cell::Triangle).collect();
        }
        let steps = ((CELLS / self.sheets.len()) as f64).sqrt().ceil() as usize;
        let of = |sheet: &Sheet, i: usize, j: usize| {
            let at = |k: f64, l: f64| {
                let (point, normal) =
                    self.at(sheet, [(i as f64 + k) / steps as f64, (j as f64 + l) / steps as f64]);
                (point, normal.normalize_or_zero())
            };
            let (middle, normal) = at(0.5, 0.5);
            let corners: Vec<_> = [[0.0, 0.0], [0.0, 1.0], [1.0, 0.0], [1.0, 1.0], [0.5, 0.0], [0.0, 0.5]]
                .map(|[k, l]| at(k, l))
                .into();
            let radius = corners.iter().map(|(point, _)| point.distance(middle)).fold(0.0, f64::max);
            let turn = corners.iter().map(|(_, other)| angle(normal, *other)).fold(0.0, f64::max);
            Cell::Patch { middle, radius: GROWTH * radius, normal, turn: GROWTH * turn, corners }
        };
        let squares = |sheet| (0..steps * steps).map(move |k| of(sheet, k / steps, k % steps));
        self.sheets.iter().flat_map(squares).collect()
    }
}

/// The angle between two lines, at most a right one; that of a vector without length with any is a right one.
fn angle(one: DVec3, other: DVec3) -> f64 {
    one.cross(other).length().atan2(one.dot(other).abs())
        + if one == DVec3::ZERO || other == DVec3::ZERO { std::f64::consts::FRAC_PI_2 } else { 0.0 }
}

/// The least difference between two angles of which the sampler says which is larger.
const ANGLE: f64 = 1e-7;

impl Cell {
    /// Returns whether it certainly holds a like counterpart, and whether it may.
    fn answers(&self, sample: &Sample, asked: &Asked) -> [bool; 2] {
        let &Asked { threshold, angles: [most, _], rounding } = asked;
        let holds = |(point, normal): (DVec3, DVec3)| {
            normal != DVec3::ZERO
                && sample.point.distance(point) <= threshold - rounding
                && angle(sample.normal, normal) <= most - ANGLE
        };
        match self {
            Self::Triangle(corners) => {
                let normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalize_or_zero();
                let distance = to_triangle(corners, sample.point);
                let between = angle(sample.normal, normal);
                let is_like =
                    normal != DVec3::ZERO && distance <= threshold - rounding && between <= most - ANGLE;
                [is_like, distance <= threshold + rounding && between <= most + ANGLE]
            }
            Self::Patch { middle, radius, normal, turn, corners } => {
                let is_near = sample.point.distance(*middle) <= threshold + radius + rounding;
                let may_be = is_near && angle(sample.normal, *normal) <= most + turn + ANGLE;
                let is_held =
                    may_be && (holds((*middle, *normal)) || corners.iter().any(|&corner| holds(corner)));
                [is_held, may_be]
            }
        }
    }
}

/// Returns in words which parts of both areas are refuted by samples.
pub(super) fn violations(
    rng: &mut Rng,
    surfaces: &[Surface; 2],
    parts: [Interval; 2],
    asked: &Asked,
) -> Vec<String> {
    let compared = |index: usize, rng: &mut Rng| {
        let samples = surfaces[index].samples(rng);
        let cells = surfaces[1 - index].cells();
        let total: f64 = samples.iter().map(|sample| sample.weight).sum();
        let heaviest = samples.iter().map(|sample| sample.weight).fold(0.0, f64::max);
        let mut sums = [0.0; 2];
        let mut answers = Vec::with_capacity(samples.len());
        for sample in &samples {
            let mut any = [false; 2];
            for cell in &cells {
                let of = cell.answers(sample, asked);
                any = [any[0] || of[0], any[1] || of[1]];
                if any[0] {
                    break;
                }
            }
            let any = [any[0], any[0] || any[1]];
            answers.push(any);
            sums = [0, 1].map(|k| sums[k] + if any[k] { sample.weight } else { 0.0 });
        }
        let [least, most] = sums.map(|sum| sum / total);
        let error = [(0, least), (1, most)].map(|(k, mean)| {
            let term = |(sample, any): (&Sample, &[bool; 2])| {
                (sample.weight * (f64::from(u8::from(any[k])) - mean)).powi(2)
            };
            samples.iter().zip(&answers).map(term).sum::<f64>().sqrt() / total
        });
        let unseen = UNSEEN * heaviest * samples.len() as f64 / total;
        let error = STANDARD_ERRORS * error[0].max(error[1]) + BINOMIAL + unseen;
        outside(["normal precision", "normal recall"][index], parts[index], [least, most], error)
    };
    [0, 1].into_iter().filter_map(|index| compared(index, rng)).collect()
}
