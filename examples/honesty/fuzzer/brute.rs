//! Upper bounds on distances by dense sampling and local descent.
//!
//! A near point that is not found proves nothing: extreme weights and knots close together
//! concentrate nearly all of a surface where no grid looks, and rounded parameters miss it.

use super::sheet::Sheet;
use super::trims::Rim;
use glam::{DVec2, DVec3, Vec2Swizzles};

/// The number of grid points along each axis of a surface for a first estimate.
const COARSE_GRID: usize = 17;

/// The number of descents that start from that grid.
const STARTS: usize = 6;

/// The number of grid points along each axis of a surface for the final search.
/// Descents start from every local minimum of the grid, so that a nearer part of a
/// surface does not hide another minimum.
const DENSE_GRID: usize = 65;

/// The largest number of descents from such a grid; each is refined by a pattern search.
const DENSE_STARTS: usize = 64;

/// The largest number of steps of a descent.
const MAX_STEPS: usize = 40;

/// The initial damping of a descent, and the damping at which it ends.
const DAMPING: f64 = 1e-3;
const MAX_DAMPING: f64 = 1e12;

/// The rounding of the parameters of a point of a loop, relative to them.
pub(crate) const RIM_ROUNDING: f64 = 64.0 * f64::EPSILON;

/// The rounds of the pattern search, limit from the grid's spacing to rounding.
const PATTERN_ROUNDS: usize = 48;

/// The number of pattern points on each side of its middle.
const PATTERN_RADIUS: i32 = 3;

/// A point of a model, by surface and parameters, with its distance from a target point.
#[derive(Clone, Copy)]
pub(crate) struct Placed {
    pub(crate) sheet: usize,
    pub(crate) parameters: DVec2,
    pub(crate) distance: f64,
    /// Where the point is on a loop of its face, if it was found there.
    rim: Option<Rim>,
}

/// No point.
const NOWHERE: Placed = Placed { sheet: 0, parameters: DVec2::ZERO, distance: f64::INFINITY, rim: None };

fn nearer(a: Placed, b: Placed) -> Placed {
    if b.distance < a.distance { b } else { a }
}

/// The model to which distances are computed.
pub(crate) struct Target<'a> {
    sheets: &'a [Sheet],
    coarse: Vec<CloudPoint>,
}

impl<'a> Target<'a> {
    pub(crate) fn new(sheets: &'a [Sheet]) -> Self {
        Self { sheets, coarse: cloud(sheets) }
    }

    /// Returns a near point of the target, found from the nearest grid point and `warm`.
    pub(crate) fn near(&self, point: DVec3, warm: Option<Placed>) -> Placed {
        let nearest = nearest(&self.coarse, point, 1).into_iter().chain(warm);
        self.descend_all(nearest, point, 0.0)
    }

    /// Returns whether a point of the target within `limit` is found, by searches of
    /// increasing cost. `counterpart` is the point's surface and parameters on its own
    /// model; the target may be a copy of it, or a transposed copy.
    pub(crate) fn is_within(&self, point: DVec3, limit: f64, counterpart: (usize, DVec2)) -> bool {
        let squared = limit * limit;
        let is_near_copy = |sheet: &Sheet| {
            let grid_parameters = [counterpart.1, counterpart.1.yx()];
            grid_parameters.iter().any(|&parameters| {
                sheet.contains(sheet.clamp(parameters))
                    && sheet.point(sheet.clamp(parameters)).distance_squared(point) <= squared
            })
        };
        self.sheets.get(counterpart.0).is_some_and(is_near_copy)
            || self.coarse.iter().any(|sample| sample.point.distance_squared(point) <= squared)
            || self.descend_all(nearest(&self.coarse, point, STARTS), point, limit).distance <= limit
            || self.search(point, limit).distance <= limit
    }

    /// Returns a bound on what the rounding of its parameters moves a point of a loop by.
    pub(crate) fn rim_error(&self, placed: &Placed) -> f64 {
        if placed.rim.is_none() {
            return 0.0;
        }
        let sheet = &self.sheets[placed.sheet];
        let at = sheet.point(placed.parameters);
        let error = RIM_ROUNDING * placed.parameters.abs();
        let signs = [-1.0, 1.0].into_iter().flat_map(|u| [-1.0, 1.0].map(|v| DVec2::new(u, v)));
        let moved = signs.map(|sign| sheet.point(sheet.clamp(placed.parameters + sign * error)).distance(at));
        moved.fold(0.0, f64::max)
    }

    /// Returns the nearest point found by a dense search.
    pub(crate) fn least(&self, point: DVec3) -> Placed {
        self.search(point, 0.0)
    }

    /// Descends from every local minimum of a grid until one is within `limit`.
    fn search(&self, point: DVec3, limit: f64) -> Placed {
        let mut least = NOWHERE;
        for start in minima(self.sheets, DENSE_GRID, point) {
            let descended = self.descend(start, point, limit);
            least = nearer(least, descended);
            if least.distance > limit {
                least = nearer(least, self.pattern_search(descended, point, limit));
            }
            if least.distance <= limit {
                break;
            }
        }
        least
    }

    fn descend_all(&self, starts: impl IntoIterator<Item = Placed>, point: DVec3, limit: f64) -> Placed {
        let mut best = NOWHERE;
        for start in starts {
            best = nearer(best, self.descend(start, point, limit));
            if best.distance <= limit {
                break;
            }
        }
        best
    }

    /// Runs the Levenberg–Marquardt method within the domain, or along the loop that the start is
    /// on; the start is the result where it leaves the face.
    fn descend(&self, start: Placed, target: DVec3, limit: f64) -> Placed {
        let sheet = &self.sheets[start.sheet];
        if let (Some(rim), Some(region)) = (start.rim, &sheet.region) {
            let rim = region.slide(rim, |parameters| sheet.point(parameters).distance(target));
            let parameters = region.at(rim);
            let distance = sheet.point(parameters).distance(target);
            return Placed { parameters, distance, rim: Some(rim), ..start };
        }
        let mut at = start.parameters;
        let mut tangents = sheet.tangents(at);
        let mut best = tangents.point.distance(target);
        let mut damping = DAMPING;
        for _ in 0..MAX_STEPS {
            if best <= limit || damping > MAX_DAMPING {
                break;
            }
            let residual = tangents.point - target;
            let gradient = DVec2::new(residual.dot(tangents.u), residual.dot(tangents.v));
            let [uu, uv, vv] =
                [tangents.u.dot(tangents.u), tangents.u.dot(tangents.v), tangents.v.dot(tangents.v)];
            let (a, c) = (uu * (1.0 + damping), vv * (1.0 + damping));
            let stuck = [0, 1].map(|axis| {
                let next = sheet.clamp(at - DVec2::AXES[axis] * gradient[axis].signum() * sheet.extent());
                next[axis] == at[axis]
            });
            let step = match stuck {
                [true, true] => break,
                [true, false] => DVec2::new(0.0, -gradient.y / c),
                [false, true] => DVec2::new(-gradient.x / a, 0.0),
                [false, false] => {
                    DVec2::new(uv * gradient.y - c * gradient.x, uv * gradient.x - a * gradient.y)
                        / (a * c - uv * uv)
                }
            };
            let next = sheet.clamp(at + step);
            if !step.is_finite() || next == at {
                break;
            }
            let next_tangents = sheet.tangents(next);
            let distance = next_tangents.point.distance(target);
            if distance < best {
                (at, tangents, best) = (next, next_tangents, distance);
                damping *= 0.1;
            } else {
                damping *= 10.0;
            }
        }
        if at != start.parameters && !sheet.contains(at) {
            return start;
        }
        Placed { parameters: at, distance: best, ..start }
    }

    /// Runs a pattern search: evaluates a grid around the best point repeatedly, and
    /// halves its spacing when the best point is inside. It is slower than descent,
    /// and robust against kinks and narrow valleys.
    fn pattern_search(&self, start: Placed, target: DVec3, limit: f64) -> Placed {
        let sheet = &self.sheets[start.sheet];
        if start.rim.is_some() {
            return start;
        }
        let mut step = sheet.extent() / ((DENSE_GRID - 1) as f64 * f64::from(PATTERN_RADIUS));
        let mut best = start;
        for _ in 0..PATTERN_ROUNDS {
            let center = best.parameters;
            let mut at_rim = false;
            for i in -PATTERN_RADIUS..=PATTERN_RADIUS {
                for j in -PATTERN_RADIUS..=PATTERN_RADIUS {
                    let parameters = sheet.clamp(center + step * DVec2::new(f64::from(i), f64::from(j)));
                    let distance = sheet.point(parameters).distance(target);
                    if distance < best.distance && sheet.contains(parameters) {
                        best = Placed { parameters, distance, ..best };
                        at_rim = i.abs() == PATTERN_RADIUS || j.abs() == PATTERN_RADIUS;
                    }
                }
            }
            if best.distance <= limit {
                break;
            }
            if !at_rim {
                step *= 0.5;
            }
        }
        best
    }
}

/// A point of a face.
struct CloudPoint {
    sheet: usize,
    parameters: DVec2,
    point: DVec3,
    rim: Option<Rim>,
}

/// Returns grid points and points of the loops of every face.
fn cloud(sheets: &[Sheet]) -> Vec<CloudPoint> {
    let of_sheet = |(index, sheet): (usize, &Sheet)| {
        let place = move |parameters: DVec2, rim: Option<Rim>| CloudPoint {
            sheet: index,
            parameters,
            point: sheet.point(parameters),
            rim,
        };
        let inside = grid_parameters(sheet, COARSE_GRID).filter(|&parameters| sheet.contains(parameters));
        let mut points: Vec<CloudPoint> = inside.map(|parameters| place(parameters, None)).collect();
        if let Some(region) = &sheet.region {
            points.extend(region.rims().map(|rim| place(region.at(rim), Some(rim))));
        }
        points
    };
    sheets.iter().enumerate().flat_map(of_sheet).collect()
}

/// Returns a grid of `count` × `count` points over a surface's domain.
fn grid_parameters(sheet: &Sheet, count: usize) -> impl Iterator<Item = DVec2> {
    let fraction = move |index: usize| index as f64 / (count - 1) as f64;
    (0..count * count).map(move |at| sheet.at([fraction(at / count), fraction(at % count)]))
}

/// Returns the local minima of the distance on the grids and on the loops, nearest first.
fn minima(sheets: &[Sheet], count: usize, target: DVec3) -> Vec<Placed> {
    let mut minima = Vec::new();
    for (index, sheet) in sheets.iter().enumerate() {
        let place = |parameters: DVec2, rim: Option<Rim>| Placed {
            sheet: index,
            parameters,
            distance: sheet.point(parameters).distance(target),
            rim,
        };
        let outside = |parameters: DVec2| Placed { distance: f64::INFINITY, ..place(parameters, None) };
        let all: Vec<Placed> = grid_parameters(sheet, count)
            .map(
                |parameters| {
                    if sheet.contains(parameters) { place(parameters, None) } else { outside(parameters) }
                },
            )
            .collect();
        let around = |at: usize| at.saturating_sub(1)..(at + 2).min(count);
        minima.extend((0..count * count).filter_map(|at| {
            let mut others = around(at / count).flat_map(|i| around(at % count).map(move |j| i * count + j));
            let least = others.all(|other| all[at].distance <= all[other].distance);
            (least && all[at].distance.is_finite()).then_some(all[at])
        }));
        if let Some(region) = &sheet.region {
            let rims: Vec<Placed> = region.rims().map(|rim| place(region.at(rim), Some(rim))).collect();
            minima.extend((0..rims.len()).filter_map(|at| {
                let [before, after] = [at + rims.len() - 1, at + 1].map(|k| rims[k % rims.len()].distance);
                (rims[at].distance <= before && rims[at].distance <= after).then_some(rims[at])
            }));
        }
    }
    minima.sort_unstable_by(|a, b| a.distance.total_cmp(&b.distance));
    minima.truncate(DENSE_STARTS);
    minima
}

/// Returns the nearest `starts` points of a cloud, nearest first.
fn nearest(cloud: &[CloudPoint], target: DVec3, starts: usize) -> Vec<Placed> {
    let place = |&CloudPoint { sheet, parameters, point, rim }: &CloudPoint| Placed {
        sheet,
        parameters,
        distance: point.distance(target),
        rim,
    };
    let mut all: Vec<Placed> = cloud.iter().map(place).collect();
    let count = starts.min(all.len());
    all.select_nth_unstable_by(count - 1, |a, b| a.distance.total_cmp(&b.distance));
    all.truncate(count);
    all.sort_unstable_by(|a, b| a.distance.total_cmp(&b.distance));
    all
}
