//! Control nets of rational Bézier patches, in intervals.

use crate::proof::interval::Interval;
use crate::proof::vector::{Vector, hull};

/// A control point multiplied by its weight, and the weight.
pub(crate) type Homogeneous = [Interval; 4];

/// A rational Bézier patch over [0, 1]², control points v fastest.
///
/// Every operation keeps the inclusion: a patch whose exact control points lie in the net's
/// intervals has its exact sub-patches, points and hull in what the operation returns.
#[derive(Debug, Clone)]
pub(crate) struct Net {
    pub(crate) degree: [usize; 2],
    pub(crate) points: Vec<Homogeneous>,
}

const HALF: Interval = Interval { lo: 0.5, hi: 0.5 };

/// (1 - t) a + t b.
pub(crate) fn blend(a: &Homogeneous, b: &Homogeneous, t: Interval) -> Homogeneous {
    let rest = (Interval::ONE - t).in_unit();
    std::array::from_fn(|component| rest * a[component] + t * b[component])
}

/// The point of a homogeneous point: [`Interval::ENTIRE`] where the weight may be 0.
pub(crate) fn project(point: &Homogeneous) -> Vector {
    let [x, y, z, w] = *point;
    [x / w, y / w, z / w]
}

impl Net {
    /// The number of lines along an axis, the control points of one, the distance in `points`
    /// between the starts of lines and between the points of a line.
    fn lines(&self, axis: usize) -> [usize; 4] {
        let [rows, columns] = self.degree.map(|degree| degree + 1);
        if axis == 0 { [columns, rows, 1, columns] } else { [rows, columns, columns, 1] }
    }

    /// The patch whose lines along `axis` are what `refine` makes of this patch's.
    fn mapped(&self, axis: usize, refine: impl Fn(&mut [Homogeneous])) -> Self {
        let [count, length, start, step] = self.lines(axis);
        let mut mapped = self.clone();
        let mut line = Vec::with_capacity(length);
        for index in 0..count {
            line.clear();
            line.extend((0..length).map(|k| self.points[index * start + k * step]));
            refine(&mut line);
            for (k, point) in line.iter().enumerate() {
                mapped.points[index * start + k * step] = *point;
            }
        }
        mapped
    }

    /// The two halves along an axis, by de Casteljau's algorithm.
    pub(crate) fn split(&self, axis: usize) -> [Self; 2] {
        let middle = |a: &Homogeneous, b: &Homogeneous| std::array::from_fn(|k| (a[k] + b[k]) * HALF);
        let first = self.mapped(axis, |line| {
            for round in 1..line.len() {
                for k in (round..line.len()).rev() {
                    line[k] = middle(&line[k - 1], &line[k]);
                }
            }
        });
        let second = self.mapped(axis, |line| {
            for round in 1..line.len() {
                for k in 0..line.len() - round {
                    line[k] = middle(&line[k], &line[k + 1]);
                }
            }
        });
        [first, second]
    }

    /// The sub-patch over a range of [0, 1] along an axis, by blossoming: its control point k is
    /// the blossom at `degree - k` times the start and k times the end. The range may be a point.
    pub(crate) fn restrict(&self, axis: usize, range: [f64; 2]) -> Self {
        let range = range.map(Interval::point);
        self.mapped(axis, |line| {
            let degree = line.len() - 1;
            let whole = line.to_vec();
            for (k, point) in line.iter_mut().enumerate() {
                let mut blossom = whole.clone();
                for round in 0..degree {
                    let parameter = range[usize::from(round < k)];
                    for index in 0..degree - round {
                        blossom[index] = blend(&blossom[index], &blossom[index + 1], parameter);
                    }
                }
                *point = blossom[0];
            }
        })
    }

    /// The point at parameters in [0, 1]², by de Casteljau's algorithm.
    pub(crate) fn evaluate(&self, parameters: [Interval; 2]) -> Vector {
        let fold = |line: &mut [Homogeneous], t: Interval| {
            for length in (1..line.len()).rev() {
                for k in 0..length {
                    line[k] = blend(&line[k], &line[k + 1], t);
                }
            }
            line[0]
        };
        let mut rows = self.points.clone();
        let mut ends: Vec<Homogeneous> =
            rows.chunks_mut(self.degree[1] + 1).map(|row| fold(row, parameters[1])).collect();
        project(&fold(&mut ends, parameters[0]))
    }

    /// The patch's corners at (0, 0), (0, 1), (1, 0) and (1, 1).
    pub(crate) fn corners(&self) -> [Vector; 4] {
        let last = self.points.len() - 1;
        [0, self.degree[1], last - self.degree[1], last].map(|index| project(&self.points[index]))
    }

    /// The control points, whose convex hull contains the patch as weights are positive.
    pub(crate) fn hull_points(&self) -> impl Iterator<Item = Vector> {
        self.points.iter().map(project)
    }

    /// The box of the control points.
    pub(crate) fn bounding_box(&self) -> Vector {
        let first = project(&self.points[0]);
        self.hull_points().fold(first, |bounds, point| hull(&bounds, &point))
    }
}
