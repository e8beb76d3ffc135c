//! Surfaces of revolution, told from their Bézier patches.

use super::Sphere;
use super::axis::Line;
use super::winding_number::winding;
use crate::bezier::{BezierModel, Patch, PatchGrid, PatchSet, length_bounds};
use glam::{DVec2, DVec3, Vec4Swizzles};

/// How far points may be from a surface of revolution for it to count as one,
/// relative to its size: nets written with seven digits.
const MAX_OFF: f64 = 1e-6;

/// How far points move, relative to their largest coordinate, for the relative
/// error of their weights: less than four times that of the extent, twice as large.
const WEIGHTS: f64 = 8.0;

/// A surface whose points, up to `off`, are turned about an axis as one
/// parameter runs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Revolution {
    /// That parameter: 0 for u, 1 for v.
    pub(crate) round: usize,
    /// Where it starts.
    pub(crate) start: f64,
    pub(crate) axis: Line,
    /// At least how far a point is from where the turns take the profile.
    pub(crate) off: f64,
    /// At least how far a point is from the axis' origin.
    pub(crate) reach: f64,
    /// Whether the turns make up a full one.
    pub(crate) full: bool,
    /// The sphere that it is, if it is one.
    pub(crate) sphere: Option<Sphere>,
}

/// What each surface of the model is. O(patches p^2 q^2) of such surfaces, less
/// of others.
pub(crate) fn revolutions(model: &BezierModel) -> Vec<Option<Revolution>> {
    let of = |grid: &PatchGrid| {
        let strips = |round| Strips { patches: &model.patches, grid, round };
        strips(0).revolution().or_else(|| strips(1).revolution())
    };
    model.grids.iter().map(of).collect()
}

/// The patches of a surface, by a parameter that may go round.
struct Strips<'a> {
    patches: &'a PatchSet,
    grid: &'a PatchGrid,
    round: usize,
}

impl<'a> Strips<'a> {
    /// The patch of these numbers along the profile and round.
    fn patch(&self, along: usize, round: usize) -> Patch<'a> {
        let [u, v] = if self.round == 0 { [round, along] } else { [along, round] };
        self.patches.patch(self.grid.first + u * self.grid.counts()[1] + v)
    }

    fn revolution(&self) -> Option<Revolution> {
        let counts = self.grid.counts();
        let (rounds, strips) = (counts[self.round], counts[1 - self.round]);
        let axis = self.axis(strips)?;
        let (mut off, mut reach, mut gap, mut full) = (0.0_f64, 0.0_f64, 0.0_f64, true);
        let mut ends: Option<[DVec3; 2]> = None;
        for along in 0..strips {
            let mut arcs = Vec::with_capacity(rounds);
            for round in 0..rounds {
                arcs.push(Arc::new(&self.patch(along, round), self.round, &axis)?);
            }
            let first = &arcs[0];
            let across = axis.direction.cross(first.from);
            let mut corners = Vec::with_capacity(rounds);
            for (index, arc) in arcs.iter().enumerate() {
                reach = reach.max(arc.reach);
                let mut joint = arc.widest * arc.to.distance(arcs[(index + 1) % rounds].from);
                if index + 1 == rounds && joint > MAX_OFF * reach {
                    (full, joint) = (false, 0.0);
                }
                off = off.max(arc.off + arc.apart(first) + joint);
                if off > MAX_OFF * reach {
                    return None;
                }
                full &= arc.is_short;
                corners.push(DVec2::new(arc.from.dot(first.from), arc.from.dot(across)));
            }
            full = full && winding(&corners) != 0;
            let edges = first.edges(&axis);
            gap = gap.max(ends.map_or(0.0, |ends| ends[1].distance(edges[0])));
            ends = Some([ends.map_or(edges[0], |ends| ends[0]), edges[1]]);
        }
        let profile = (0..strips).map(|along| self.patch(along, 0));
        let sphere = ends.filter(|_| full).map(|ends| Sphere::swept(&axis, ends, profile, off + gap));
        let sphere = sphere.filter(|sphere| sphere.off <= MAX_OFF * reach);
        let start = self.grid.breaks[self.round][0];
        Some(Revolution { round: self.round, start, axis, off, reach, full, sphere })
    }

    /// The axis of the widest of some arcs at the start.
    fn axis(&self, strips: usize) -> Option<Line> {
        let (mut widest, mut of_widest) = (0.0, None);
        for along in 0..strips {
            let patch = self.patch(along, 0);
            for across in [0.5, 1.0] {
                let points = [0.0, 0.5, 1.0].map(|s| {
                    patch.point([0, 1].map(|parameter| if parameter == self.round { s } else { across }))
                });
                let width = points[0].distance_squared(points[2]);
                if width > widest {
                    (widest, of_widest) = (width, Some(points));
                }
            }
        }
        let axis = Line::axis(of_widest?);
        (axis.direction.is_finite() && axis.origin.is_finite()).then_some(axis)
    }
}

/// A patch as what one arc and one profile make: up to `off`, its points are
/// `height(t) axis + radius(t) e(s)` with e on the unit circle.
struct Arc {
    off: f64,
    reach: f64,
    /// The largest radius of the profile's control points.
    widest: f64,
    /// The first and last e.
    from: DVec3,
    to: DVec3,
    /// Whether the arc is less than half a circle.
    is_short: bool,
    /// The profile's control points: radius, height, weight.
    profile: Vec<DVec3>,
}

impl Arc {
    /// If all rows of controls, relative to the axis, are one row e_i scaled,
    /// with weights that are products, `Σ a_i b_j B_i B_j (ζ_j axis + ρ_j e_i)`
    /// over `Σ a_i b_j B_i B_j` falls apart into the profile and
    /// `e(s) = Σ a_i e_i B_i / Σ a_i B_i`. How far controls and weights are
    /// from that, and |e| from 1, is `off`. `None` where all
    /// lies on the axis.
    fn new(patch: &Patch<'_>, round: usize, axis: &Line) -> Option<Self> {
        let columns = patch.degree[1] + 1;
        let orders = [patch.degree[round] + 1, patch.degree[1 - round] + 1];
        // Row by row: away from the axis, and height and weight.
        let mut controls = Vec::with_capacity(patch.controls.len());
        let (mut widest, mut row) = (0.0, None);
        let mut reach = 0.0_f64;
        for index in 0..patch.controls.len() {
            let (j, i) = (index / orders[0], index % orders[0]);
            let control = patch.controls[if round == 0 { i * columns + j } else { j * columns + i }];
            let point = control.xyz() / control.w + patch.center;
            let radial = axis.way_to(point);
            let height = axis.direction.dot(point - axis.origin);
            controls.push((radial, height, control.w));
            reach = reach.max(point.distance(axis.origin));
            let width = radial.length();
            if i == 0 && width > widest {
                (widest, row) = (width, Some(index));
            }
        }
        let row = row?;
        let mut arc = Vec::with_capacity(orders[0]);
        for (radial, _, weight) in &controls[row..row + orders[0]] {
            let weight = weight / controls[row].2;
            arc.push((weight / widest * *radial).extend(weight));
        }
        let unit = |i: usize| arc[i].xyz() / arc[i].w;
        let (from, to) = (unit(0), unit(orders[0] - 1));
        let (mut off, mut bent, mut is_short) = (0.0_f64, 0.0_f64, true);
        let mut profile = Vec::with_capacity(orders[1]);
        for (index, (radial, height, weight)) in controls.iter().enumerate() {
            let i = index % orders[0];
            if i == 0 {
                profile.push(DVec3::new(radial.dot(from), *height, *weight));
            }
            let start = profile[index / orders[0]];
            off = off.max((height - start.y).abs() + radial.distance(start.x * unit(i)));
            bent = bent.max((weight / (arc[i].w * start.z) - 1.0).abs());
            is_short &= unit(i).dot(from + to) > 0.0;
        }
        let [least, largest] = length_bounds([orders[0] - 1, 0], &arc);
        off += WEIGHTS * bent * reach + (largest - 1.0).max(1.0 - least) * widest;
        Some(Self { off, reach, widest, from, to, is_short, profile })
    }

    /// At least how far the two profiles, of one strip, are apart.
    fn apart(&self, other: &Self) -> f64 {
        let (mut apart, mut bent) = (0.0_f64, 0.0_f64);
        for (mine, others) in self.profile.iter().zip(&other.profile) {
            apart = apart.max(mine.truncate().distance(others.truncate()));
            bent = bent.max((mine.z * other.profile[0].z / (others.z * self.profile[0].z) - 1.0).abs());
        }
        apart + WEIGHTS * bent * self.reach.max(other.reach)
    }

    /// Where the profile begins and ends at the first e.
    fn edges(&self, axis: &Line) -> [DVec3; 2] {
        [0, 1].map(|end| {
            let [radius, height, _] = self.profile[end * (self.profile.len() - 1)].to_array();
            axis.origin + height * axis.direction + radius * self.from
        })
    }
}
