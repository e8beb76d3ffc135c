//! Near points of a model in plain float64: candidates that proofs begin with, not part of any.

use super::bezier::Patch;
use super::boxes::BoxTree;
use super::interval::Interval;

/// The Newton steps of one projection, and the halvings of a step that gains nothing.
const MAX_STEPS: usize = 20;
const MAX_HALVINGS: usize = 8;

/// A step that changes no parameter by more ends a projection.
const STEP_TOLERANCE: f64 = 1e-12;

/// What a foot's distance may grow by, relatively, where one of its parameters is made another's.
const TIE_TOLERANCE: f64 = 1e-9;

/// A point of a patch near some point of space.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Foot {
    pub(crate) patch: usize,
    /// The patch's own parameters in [0, 1]².
    pub(crate) at: [f64; 2],
    pub(crate) distance: f64,
}

/// A Bézier patch in float64.
struct FloatPatch {
    degree: [usize; 2],
    /// Homogeneous control points, v fastest.
    points: Vec<[f64; 4]>,
    /// Points on a grid of `degree + 2` places along each axis, v fastest.
    samples: Vec<[f64; 3]>,
}

/// A model to find near points of.
pub(crate) struct Finder {
    patches: Vec<FloatPatch>,
    tree: BoxTree,
}

impl Finder {
    pub(crate) fn new(patches: &[Patch]) -> Self {
        let floats = patches
            .iter()
            .map(|patch| {
                let points = patch.net.points.iter().map(|point| point.map(Interval::mid)).collect();
                let mut float = FloatPatch { degree: patch.net.degree, points, samples: Vec::new() };
                let [rows, columns] = float.degree.map(|degree| degree + 2);
                for index in 0..rows * columns {
                    float.samples.push(float.jet(float.sample_at(index))[0]);
                }
                float
            })
            .collect();
        Self { patches: floats, tree: BoxTree::new(patches) }
    }

    /// The tree of the patches' boxes.
    pub(crate) fn tree(&self) -> &BoxTree {
        &self.tree
    }

    /// Near points on up to `count` patches, nearest first; almost always those of the nearest patches.
    pub(crate) fn nearest(&self, point: [f64; 3], count: usize) -> Vec<Foot> {
        let mut feet: Vec<Foot> = Vec::with_capacity(count + 1);
        self.tree.visit(point, |patch, bound| {
            let worst =
                feet.last().filter(|_| feet.len() == count).map_or(f64::INFINITY, |foot| foot.distance);
            if bound >= worst {
                return worst;
            }
            let foot = self.project(patch, point, self.patches[patch].nearest_sample(point));
            let index = feet.partition_point(|known| known.distance <= foot.distance);
            feet.insert(index, foot);
            feet.truncate(count);
            feet.last().filter(|_| feet.len() == count).map_or(f64::INFINITY, |foot| foot.distance)
        });
        feet
    }

    /// The foot of `point` on the patch of another foot, with parameters like that one's where they
    /// do not matter: those along an edge that is a single point are arbitrary.
    pub(crate) fn project_near(&self, other: &Foot, point: [f64; 3]) -> Foot {
        let mut foot = self.project(other.patch, point, other.at);
        for axis in 0..2 {
            let mut at = foot.at;
            at[axis] = other.at[axis];
            let residual = subtract(self.patches[other.patch].jet(at)[0], point);
            let distance = dot(residual, residual).sqrt();
            if distance <= foot.distance + TIE_TOLERANCE * f64::max(other.distance, foot.distance) {
                foot = Foot { at, distance, ..foot };
            }
        }
        foot
    }

    /// A local minimum of the distance on one patch, from a start: Newton's method with the
    /// parameters kept in [0, 1]², Gauss-Newton's where the Hessian is not positive definite.
    pub(crate) fn project(&self, patch: usize, point: [f64; 3], start: [f64; 2]) -> Foot {
        let float = &self.patches[patch];
        let mut at = start;
        let mut jet = float.jet(at);
        let mut residual = subtract(jet[0], point);
        for _ in 0..MAX_STEPS {
            let step = newton_step(&jet, residual, at);
            let mut factor = 1.0;
            let mut gained = false;
            for _ in 0..MAX_HALVINGS {
                let next = [0, 1].map(|axis| (at[axis] + factor * step[axis]).clamp(0.0, 1.0));
                let next_jet = float.jet(next);
                let next_residual = subtract(next_jet[0], point);
                if dot(next_residual, next_residual) < dot(residual, residual) {
                    gained = (0..2).any(|axis| (next[axis] - at[axis]).abs() > STEP_TOLERANCE);
                    (at, jet, residual) = (next, next_jet, next_residual);
                    break;
                }
                factor *= 0.5;
            }
            if !gained {
                break;
            }
        }
        Foot { patch, at, distance: dot(residual, residual).sqrt() }
    }
}

/// The Newton step of |S - p|² / 2 in the parameters that are free to move.
fn newton_step(jet: &[[f64; 3]; 6], residual: [f64; 3], at: [f64; 2]) -> [f64; 2] {
    let [_, u, v, uu, uv, vv] = *jet;
    let gradient = [dot(residual, u), dot(residual, v)];
    // A parameter at its end stays there if the distance falls outwards.
    let free = [0, 1].map(|axis| {
        let stuck = (at[axis] <= 0.0 && gradient[axis] > 0.0) || (at[axis] >= 1.0 && gradient[axis] < 0.0);
        !stuck
    });
    let gauss = [dot(u, u), dot(u, v), dot(v, v)];
    let full = [gauss[0] + dot(residual, uu), gauss[1] + dot(residual, uv), gauss[2] + dot(residual, vv)];
    let solve = |[a, b, c]: [f64; 3]| -> Option<[f64; 2]> {
        let step = match free {
            [true, true] => {
                let determinant = a * c - b * b;
                let definite = a > 0.0 && determinant > 1e-14 * a * c;
                definite.then(|| {
                    [
                        (b * gradient[1] - c * gradient[0]) / determinant,
                        (b * gradient[0] - a * gradient[1]) / determinant,
                    ]
                })
            }
            [true, false] => (a > 0.0).then(|| [-gradient[0] / a, 0.0]),
            [false, true] => (c > 0.0).then(|| [0.0, -gradient[1] / c]),
            [false, false] => None,
        };
        step.filter(|step| step.iter().all(|value| value.is_finite()))
    };
    // The diagonal's own part keeps the damped matrix definite.
    let damped = [gauss[0] * 1.0001, gauss[1], gauss[2] * 1.0001];
    solve(full).or_else(|| solve(damped)).unwrap_or([0.0; 2])
}

impl FloatPatch {
    fn sample_at(&self, index: usize) -> [f64; 2] {
        let columns = self.degree[1] + 2;
        [
            (index / columns) as f64 / (self.degree[0] + 1) as f64,
            (index % columns) as f64 / (self.degree[1] + 1) as f64,
        ]
    }

    fn nearest_sample(&self, point: [f64; 3]) -> [f64; 2] {
        let distance = |sample: [f64; 3]| {
            let between = subtract(sample, point);
            dot(between, between)
        };
        let nearest = (0..self.samples.len())
            .min_by(|&a, &b| distance(self.samples[a]).total_cmp(&distance(self.samples[b])));
        self.sample_at(nearest.unwrap_or(0))
    }

    /// The point and its derivatives along u, v, uu, uv and vv.
    fn jet(&self, at: [f64; 2]) -> [[f64; 3]; 6] {
        let mut columns: [Vec<[f64; 4]>; 3] = std::array::from_fn(|_| Vec::with_capacity(self.degree[0] + 1));
        let mut line = Vec::with_capacity(self.degree[1] + 1);
        for row in self.points.chunks(self.degree[1] + 1) {
            line.clear();
            line.extend_from_slice(row);
            for (column, value) in columns.iter_mut().zip(derivatives(&mut line, at[1])) {
                column.push(value);
            }
        }
        let [mut plain, mut along, mut twice] = columns;
        let [value, u, uu] = derivatives(&mut plain, at[0]);
        let [v, uv, _] = derivatives(&mut along, at[0]);
        let [vv, ..] = derivatives(&mut twice, at[0]);
        quotient([value, u, v, uu, uv, vv])
    }
}

/// The value, first and second derivative of a Bézier curve, by de Casteljau's algorithm in place.
fn derivatives(line: &mut [[f64; 4]], t: f64) -> [[f64; 4]; 3] {
    let degree = line.len() - 1;
    let factor = degree as f64;
    let [mut first, mut second] = [[0.0; 4]; 2];
    for length in (1..=degree).rev() {
        if length == 2 {
            second = std::array::from_fn(|k| {
                factor * (factor - 1.0) * (line[2][k] - 2.0 * line[1][k] + line[0][k])
            });
        }
        if length == 1 {
            first = std::array::from_fn(|k| factor * (line[1][k] - line[0][k]));
        }
        for index in 0..length {
            line[index] = std::array::from_fn(|k| (1.0 - t) * line[index][k] + t * line[index + 1][k]);
        }
    }
    [line[0], first, second]
}

/// The derivatives of X / w from those of X and w.
fn quotient([value, u, v, uu, uv, vv]: [[f64; 4]; 6]) -> [[f64; 3]; 6] {
    let w = value[3];
    let over = |numerator: &dyn Fn(usize) -> f64| -> [f64; 3] { std::array::from_fn(|k| numerator(k) / w) };
    let f = over(&|k| value[k]);
    let fu = over(&|k| u[k] - f[k] * u[3]);
    let fv = over(&|k| v[k] - f[k] * v[3]);
    let fuu = over(&|k| uu[k] - 2.0 * fu[k] * u[3] - f[k] * uu[3]);
    let fuv = over(&|k| uv[k] - fu[k] * v[3] - fv[k] * u[3] - f[k] * uv[3]);
    let fvv = over(&|k| vv[k] - 2.0 * fv[k] * v[3] - f[k] * vv[3]);
    [f, fu, fv, fuu, fuv, fvv]
}

pub(crate) fn subtract(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|axis| a[axis] - b[axis])
}

pub(crate) fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}
