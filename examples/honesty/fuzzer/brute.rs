//! Distances by dense sampling and polishing: never too small.
//!
//! Where extreme weights crowd nearly all of a surface into a millionth of its
//! domain no grid finds its near points. Before a point counts as far, the
//! library's own closest point is therefore tried as one more start: what it
//! says of the distance is not believed, only its parameters are evaluated.

use super::sheet::Sheet;
use glam::{DVec2, DVec3, Vec2Swizzles};
use nurbs_hausdorff::Model;
use nurbs_hausdorff::bezier::extract;
use nurbs_hausdorff::closest::closest;
use nurbs_hausdorff::flatness::{Flatness, flatten};
use std::cell::OnceCell;

/// Grid points along each direction of a surface for a first look.
const GRID: usize = 17;

/// Starts of descents from that grid.
const STARTS: usize = 6;

/// Grid points along each direction of a surface to make sure. Descents start
/// from every one that is nearer than those around it: a second surface, or a
/// far part of the same, is not outvoted by a near one.
const DENSE: [usize; 2] = [65, 1025];

/// Descents from such a grid, at most; each is polished by looking around.
const DENSE_STARTS: usize = 64;

/// Width of the library's interval for a hint, relative to the diagonal.
const HINT_GAP: f64 = 1e-12;

/// Steps of a descent, at most.
const STEPS: usize = 40;

/// Damping of a descent: to begin with, and beyond which it ends.
const DAMPING: f64 = 1e-3;
const MAX_DAMPING: f64 = 1e12;

/// Looks over a grid around the best point: from the cloud's spacing to rounding.
const LOOKS: usize = 48;

/// Points on each side of such a grid's middle.
const REACH: i32 = 3;

/// A point of a model with its place.
#[derive(Clone, Copy)]
pub(crate) struct Placed {
    pub(crate) sheet: usize,
    pub(crate) place: DVec2,
    pub(crate) distance: f64,
}

/// The model measured to.
pub(crate) struct Target<'a> {
    model: &'a Model,
    /// What the sheets are relative to.
    origin: DVec3,
    flat: OnceCell<nurbs_hausdorff::closest::Target>,
    sheets: &'a [Sheet],
    coarse: Vec<(usize, DVec2, DVec3)>,
}

impl<'a> Target<'a> {
    pub(crate) fn new(model: &'a Model, origin: DVec3, sheets: &'a [Sheet]) -> Self {
        Self { model, origin, flat: OnceCell::new(), sheets, coarse: cloud(sheets) }
    }

    /// A near point of the target, from the nearest grid point or `warm`.
    pub(crate) fn near(&self, point: DVec3, warm: Option<Placed>) -> Placed {
        let nearest = nearest(&self.coarse, point, 1).into_iter().chain(warm);
        self.descend_all(nearest, point, 0.0)
    }

    /// Whether a point of the target within `limit` is found; looks harder and
    /// harder before it says no. `like` is where the point lies on its own
    /// model, of which the target may be a copy, or a transposed one.
    pub(crate) fn is_within(&self, point: DVec3, limit: f64, like: (usize, DVec2)) -> bool {
        let squared = limit * limit;
        let alike = |sheet: &Sheet| {
            let places = [like.1, like.1.yx()];
            places.iter().any(|&place| sheet.point(sheet.clamp(place)).distance_squared(point) <= squared)
        };
        self.sheets.get(like.0).is_some_and(alike)
            || self.coarse.iter().any(|(_, _, at)| at.distance_squared(point) <= squared)
            || self.descend_all(nearest(&self.coarse, point, STARTS), point, limit).distance <= limit
            || DENSE.iter().any(|&count| self.search(count, point, limit) <= limit)
            || self.hinted(point) <= limit
    }

    /// The distance of the place that the library takes for the nearest.
    fn hinted(&self, point: DVec3) -> f64 {
        let flat = || {
            let patches = flatten(&extract(self.model).patches, Flatness::Loose).patches;
            nurbs_hausdorff::closest::Target::new(patches)
        };
        let target = self.flat.get_or_init(flat);
        let diagonal = self.model.bounding_box().diagonal();
        let gap = HINT_GAP * diagonal.max(f64::MIN_POSITIVE);
        let Some(found) = closest(target, point + self.origin, gap) else {
            return f64::INFINITY;
        };
        let patch = target.patches.patch(found.patch);
        let place = DVec2::from_array(patch.surface_parameters(found.parameters));
        self.sheets[patch.surface].point(place).distance(point)
    }

    /// The least distance found by looking hard.
    pub(crate) fn least(&self, point: DVec3) -> f64 {
        self.search(DENSE[0], point, 0.0)
    }

    /// Descends from every grid point that is nearer than those around it,
    /// until one comes as near as is enough.
    fn search(&self, count: usize, point: DVec3, enough: f64) -> f64 {
        let mut least = f64::INFINITY;
        for start in minima(self.sheets, count, point) {
            let descended = self.descend(start, point, enough);
            least = least.min(descended.distance);
            if least > enough {
                least = least.min(self.polish(descended, count, point, enough).distance);
            }
            if least <= enough {
                break;
            }
        }
        least
    }

    fn descend_all(&self, starts: impl IntoIterator<Item = Placed>, point: DVec3, enough: f64) -> Placed {
        let mut best = Placed { sheet: 0, place: DVec2::ZERO, distance: f64::INFINITY };
        for start in starts {
            let found = self.descend(start, point, enough);
            if found.distance < best.distance {
                best = found;
            }
            if best.distance <= enough {
                break;
            }
        }
        best
    }

    /// Levenberg's and Marquardt's method within the domain.
    fn descend(&self, start: Placed, target: DVec3, enough: f64) -> Placed {
        let sheet = &self.sheets[start.sheet];
        let mut at = start.place;
        let mut tangents = sheet.tangents(at);
        let mut best = tangents.point.distance(target);
        let mut damping = DAMPING;
        for _ in 0..STEPS {
            if best <= enough || damping > MAX_DAMPING {
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
            let ahead = sheet.tangents(next);
            let distance = ahead.point.distance(target);
            if distance < best {
                (at, tangents, best) = (next, ahead, distance);
                damping *= 0.1;
            } else {
                damping *= 10.0;
            }
        }
        Placed { sheet: start.sheet, place: at, distance: best }
    }

    /// Looks over a grid around the best point, again and again, at half the
    /// spacing once the best is inside: slower than descending, and not misled
    /// by a kink or a narrow valley.
    fn polish(&self, start: Placed, count: usize, target: DVec3, enough: f64) -> Placed {
        let sheet = &self.sheets[start.sheet];
        let mut step = sheet.extent() / ((count - 1) as f64 * f64::from(REACH));
        let mut best = start;
        for _ in 0..LOOKS {
            let center = best.place;
            let mut at_rim = false;
            for i in -REACH..=REACH {
                for j in -REACH..=REACH {
                    let place = sheet.clamp(center + step * DVec2::new(f64::from(i), f64::from(j)));
                    let distance = sheet.point(place).distance(target);
                    if distance < best.distance {
                        best = Placed { place, distance, ..best };
                        at_rim = i.abs() == REACH || j.abs() == REACH;
                    }
                }
            }
            if best.distance <= enough {
                break;
            }
            if !at_rim {
                step *= 0.5;
            }
        }
        best
    }
}

/// Grid points of every surface.
fn cloud(sheets: &[Sheet]) -> Vec<(usize, DVec2, DVec3)> {
    let of_sheet = |(index, sheet): (usize, &Sheet)| {
        places(sheet, GRID).map(|place| (index, place, sheet.point(place))).collect::<Vec<_>>()
    };
    sheets.iter().enumerate().flat_map(of_sheet).collect()
}

/// A grid over a surface's domain, `count` by `count`.
fn places(sheet: &Sheet, count: usize) -> impl Iterator<Item = DVec2> {
    let fraction = move |index: usize| index as f64 / (count - 1) as f64;
    (0..count * count).map(move |at| sheet.at([fraction(at / count), fraction(at % count)]))
}

/// The nearest of the grid points that are as near as all around them, nearest first.
fn minima(sheets: &[Sheet], count: usize, target: DVec3) -> Vec<Placed> {
    let mut minima = Vec::new();
    for (index, sheet) in sheets.iter().enumerate() {
        let all: Vec<Placed> = places(sheet, count)
            .map(|place| Placed { sheet: index, place, distance: sheet.point(place).distance(target) })
            .collect();
        let around = |at: usize| at.saturating_sub(1)..(at + 2).min(count);
        minima.extend((0..count * count).filter_map(|at| {
            let mut others = around(at / count).flat_map(|i| around(at % count).map(move |j| i * count + j));
            others.all(|other| all[at].distance <= all[other].distance).then_some(all[at])
        }));
    }
    minima.sort_unstable_by(|a, b| a.distance.total_cmp(&b.distance));
    minima.truncate(DENSE_STARTS);
    minima
}

/// The nearest `starts` points of the cloud, nearest first.
fn nearest(cloud: &[(usize, DVec2, DVec3)], target: DVec3, starts: usize) -> Vec<Placed> {
    let mut all: Vec<Placed> = cloud
        .iter()
        .map(|&(sheet, place, point)| Placed { sheet, place, distance: point.distance(target) })
        .collect();
    let count = starts.min(all.len());
    all.select_nth_unstable_by(count - 1, |a, b| a.distance.total_cmp(&b.distance));
    all.truncate(count);
    all.sort_unstable_by(|a, b| a.distance.total_cmp(&b.distance));
    all
}
