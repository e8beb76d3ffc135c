//! Detection of surfaces of revolution from their Bézier patches.

use super::Sphere;
use super::axis::RotationAxis;
use super::winding_number::winding;
use crate::axis::Axis;
use crate::bezier::{BezierModel, Patch, PatchGrid, PatchSet, length_bounds};
use crate::rounding::{gamma, upper_max};
use crate::threads::parallel::map;
use glam::{DVec2, DVec3, Vec4Swizzles};

/// The largest deviation from a surface of revolution, relative to its size, at
/// which a surface counts as one: nets written with seven digits pass.
const MAX_DEVIATION: f64 = 1e-6;

/// The largest distance by which points move, relative to the radius, per relative
/// error of their weights: less than four times the extent, which is at most
/// twice the radius.
const WEIGHT_FACTOR: f64 = 8.0;

/// Roundings of a height or radius about an axis, relative to the lengths of the
/// point and the axis' origin.
const AXIS_ROUNDINGS: f64 = 64.0;

/// A surface that, up to `deviation`, is swept by rotating a profile about an
/// axis as one parameter runs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Revolution {
    /// The parameter along which the profile rotates.
    pub(crate) round: Axis,
    /// The first value of that parameter.
    pub(crate) start: f64,
    /// The axis of rotation.
    pub(crate) axis: RotationAxis,
    /// An upper bound on the distance between a point and the rotated point of the profile.
    pub(crate) deviation: f64,
    /// An upper bound on the distance of its points from the axis' origin.
    pub(crate) radius: f64,
    /// Whether the profile makes a full turn.
    pub(crate) full: bool,
    /// The sphere that the surface is, if it is one.
    pub(crate) sphere: Option<Sphere>,
}

/// Returns for each surface of the model the surface of revolution that it is, if
/// it is one. O(patches p² q²), less for other surfaces.
pub(crate) fn revolutions(model: &BezierModel) -> Vec<Option<Revolution>> {
    let detect = |grid: &PatchGrid| {
        Axis::BOTH.into_iter().find_map(|round| Strips { patches: &model.patches, grid, round }.revolution())
    };
    map(model.grids.len(), |index| detect(&model.grids[index]))
}

/// The patches of a surface in strips along `round`, the parameter that may rotate the profile.
struct Strips<'a> {
    patches: &'a PatchSet,
    grid: &'a PatchGrid,
    round: Axis,
}

impl<'a> Strips<'a> {
    /// Returns the patch with these indices along the profile and around the axis.
    fn patch(&self, along: usize, round: usize) -> Patch<'a> {
        let [u, v] = if self.round == Axis::U { [round, along] } else { [along, round] };
        self.patches.patch(self.grid.first + u * self.grid.counts()[1] + v)
    }

    /// Returns the surface of revolution, if every strip is one and all have the
    /// same axis.
    fn revolution(&self) -> Option<Revolution> {
        let counts = self.grid.counts();
        let (arc_count, strips) = (counts[self.round], counts[self.round.other()]);
        let axis = self.axis(strips)?;
        let (mut deviation, mut radius, mut gap, mut full) = (0.0_f64, 0.0_f64, 0.0_f64, true);
        let mut ends: Option<[DVec3; 2]> = None;
        for along in 0..strips {
            let mut arcs = Vec::with_capacity(arc_count);
            for round in 0..arc_count {
                arcs.push(ArcAlongProfile::new(&self.patch(along, round), self.round, &axis)?);
            }
            let first = &arcs[0];
            let across = axis.direction.cross(first.from);
            let mut corners = Vec::with_capacity(arc_count);
            for (index, arc) in arcs.iter().enumerate() {
                radius = upper_max(radius, arc.radius);
                let mut joint = arc.widest * arc.to.distance(arcs[(index + 1) % arc_count].from);
                if index + 1 == arc_count && joint > MAX_DEVIATION * radius {
                    (full, joint) = (false, 0.0);
                }
                deviation = upper_max(deviation, arc.deviation + arc.profile_difference(first) + joint);
                if !radius.is_finite() || deviation > MAX_DEVIATION * radius {
                    return None;
                }
                full &= arc.is_short;
                corners.push(DVec2::new(arc.from.dot(first.from), arc.from.dot(across)));
            }
            full = full && winding(&corners) != 0;
            let edges = first.edges(&axis);
            gap = upper_max(gap, ends.map_or(0.0, |ends| ends[1].distance(edges[0])));
            ends = Some([ends.map_or(edges[0], |ends| ends[0]), edges[1]]);
        }
        let profile = (0..strips).map(|along| self.patch(along, 0));
        let sphere = ends.filter(|_| full).map(|ends| Sphere::swept(&axis, ends, profile, deviation + gap));
        let sphere = sphere.filter(|sphere| sphere.deviation <= MAX_DEVIATION * radius);
        let start = self.grid.breaks[self.round][0];
        Some(Revolution { round: self.round, start, axis, deviation, radius, full, sphere })
    }

    /// Returns the axis of the widest of a few arcs at the start of the parameter.
    fn axis(&self, strips: usize) -> Option<RotationAxis> {
        let (mut widest, mut widest_arc) = (0.0, None);
        for along in 0..strips {
            let patch = self.patch(along, 0);
            for across in [0.5, 1.0] {
                let points = [0.0, 0.5, 1.0].map(|around| {
                    let mut parameters = [across; 2];
                    parameters[self.round] = around;
                    patch.point(parameters)
                });
                let width = points[0].distance_squared(points[2]);
                if width > widest {
                    (widest, widest_arc) = (width, Some(points));
                }
            }
        }
        let axis = RotationAxis::of_circle(widest_arc?);
        (axis.direction.is_finite() && axis.origin.is_finite()).then_some(axis)
    }
}

/// A patch as the product of an arc and a profile: its points are
/// `height(t) axis + radius(t) e(s)` with e on the unit circle, up to `deviation`.
struct ArcAlongProfile {
    deviation: f64,
    /// An upper bound on the distance of its points from the axis' origin.
    radius: f64,
    /// The largest distance of the profile's control points from the axis.
    widest: f64,
    /// The first and the last e.
    from: DVec3,
    to: DVec3,
    /// Whether the arc is less than half a circle.
    is_short: bool,
    /// The profile's control points `(radius, height, weight)`.
    profile: Vec<DVec3>,
}

impl ArcAlongProfile {
    /// Factorises a patch; `None` if all of it lies on the axis.
    ///
    /// If all rows of controls, relative to the axis, are multiples of one row
    /// e_i, with weights that are products, then
    /// `Σ a_i b_j B_i B_j (ζ_j axis + ρ_j e_i)` over `Σ a_i b_j B_i B_j` is the sum
    /// of the profile along the axis and its radius times
    /// `e(s) = Σ a_i e_i B_i / Σ a_i B_i`. The deviation bounds the errors of
    /// controls and weights from that form, and of |e| from 1.
    fn new(patch: &Patch<'_>, round: Axis, axis: &RotationAxis) -> Option<Self> {
        let columns = patch.degree[1] + 1;
        let orders = [patch.degree[round] + 1, patch.degree[round.other()] + 1];
        // The radial vector, height and weight of every control, row by row around the axis.
        let mut controls = Vec::with_capacity(patch.controls.len());
        let (mut widest, mut row) = (0.0, None);
        let mut radius = 0.0_f64;
        for index in 0..patch.controls.len() {
            let (j, i) = (index / orders[0], index % orders[0]);
            let control = patch.controls[if round == Axis::U { i * columns + j } else { j * columns + i }];
            let point = control.xyz() / control.w + patch.center;
            let radial = axis.radial(point);
            let height = axis.direction.dot(point - axis.origin);
            controls.push((radial, height, control.w));
            radius = upper_max(radius, point.distance(axis.origin));
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
        let (mut deviation, mut weight_error, mut is_short) = (0.0_f64, 0.0_f64, true);
        let mut profile = Vec::with_capacity(orders[1]);
        for (index, (radial, height, weight)) in controls.iter().enumerate() {
            let i = index % orders[0];
            if i == 0 {
                profile.push(DVec3::new(radial.dot(from), *height, *weight));
            }
            let start = profile[index / orders[0]];
            deviation = upper_max(deviation, (height - start.y).abs() + radial.distance(start.x * unit(i)));
            weight_error = upper_max(weight_error, (weight / (arc[i].w * start.z) - 1.0).abs());
            is_short &= unit(i).dot(from + to) > 0.0;
        }
        let [least, largest] = length_bounds([orders[0] - 1, 0], &arc);
        deviation += WEIGHT_FACTOR * weight_error * radius + upper_max(largest - 1.0, 1.0 - least) * widest;
        // Heights and radii are dot products with a unit axis (docs/rounding.md, lemma R13).
        deviation += gamma(AXIS_ROUNDINGS) * (radius + axis.origin.length() + patch.center.length());
        Some(Self { deviation, radius, widest, from, to, is_short, profile })
    }

    /// Returns an upper bound on the distance between corresponding points of the
    /// profiles of two arcs of one strip.
    fn profile_difference(&self, other: &Self) -> f64 {
        let (mut distance, mut weight_error) = (0.0_f64, 0.0_f64);
        for (mine, others) in self.profile.iter().zip(&other.profile) {
            distance = upper_max(distance, mine.truncate().distance(others.truncate()));
            let ratio = mine.z * other.profile[0].z / (others.z * self.profile[0].z);
            weight_error = upper_max(weight_error, (ratio - 1.0).abs());
        }
        distance + WEIGHT_FACTOR * weight_error * self.radius.max(other.radius)
    }

    /// Returns the two ends of the profile at the first e.
    fn edges(&self, axis: &RotationAxis) -> [DVec3; 2] {
        [0, 1].map(|end| {
            let [radius, height, _] = self.profile[end * (self.profile.len() - 1)].to_array();
            axis.origin + height * axis.direction + radius * self.from
        })
    }
}
