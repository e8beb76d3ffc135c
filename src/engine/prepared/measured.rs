//! The facts of a model's bodies.

use super::PreparedModel;
use super::bodies::{BodyParts, ShellParts};
use crate::area::Area;
use crate::bezier::Patch;
use crate::bvh::Aabb;
use crate::facets::Facet;
use crate::facts::{
    Facts, IntervalMoments, Mass, Moments, Orientation, VolumeUnknown, area_of_triangle, largest,
    largest_of_points, of_patch, of_triangle, shifted,
};
use crate::interval::Interval;
use crate::model::RigidTransform;
use crate::solid::ShellState;
use crate::threads::computed;
use crate::threads::parallel::{join, map, map_ranges};
use glam::{DQuat, DVec3};

/// The width of a coordinate's largest value, relative to the diagonal.
const RELATIVE_WIDTH: f64 = 1e-10;

/// A body with what is measured of it.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::engine) struct MeasuredBody {
    pub(in crate::engine) orientation: Orientation,
    pub(in crate::engine) facts: Facts,
    /// The moments about the middle of its box, if it has a volume.
    moments: Option<IntervalMoments>,
    /// Whether the surfaces of each shell, as they agree with its first one, are to be turned over so that their normals
    /// are out of the body; none where that is not known.
    pub(in crate::engine) turned: Vec<Option<bool>>,
}

/// A shell with its moments, as its first surface is oriented.
struct MeasuredShell {
    moments: Moments,
    state: ShellState,
}

impl PreparedModel {
    /// Returns the facts of each body, in the order of [`Self::bodies`], computed at first use, on all cores.
    pub fn body_facts(&self) -> impl ExactSizeIterator<Item = &Facts> {
        let cloud = self.is_cloud().then(|| self.facts());
        let bodies = if cloud.is_some() { &[] } else { self.measured_bodies() };
        let all: Vec<&Facts> = cloud.into_iter().chain(bodies.iter().map(|body| &body.facts)).collect();
        all.into_iter()
    }

    /// Returns the facts of the model, computed at first use, on all cores.
    ///
    /// The volume and what is derived from it are those of all bodies together; where these overlap, their common
    /// part counts for each. There is none where one of the bodies has none.
    pub fn facts(&self) -> &Facts {
        computed::<Facts>(&self.kept.facts, || {
            if self.is_cloud() {
                let [min, max] = self.range(None);
                return Facts::within(min, max, VolumeUnknown::Points);
            }
            self.facts_of_all(self.measured_bodies())
        })
    }

    /// Returns the lengths along x, y and z of the model moved by a transform.
    pub(in crate::engine) fn moved_extents(&self, transform: &RigidTransform) -> [Interval; 3] {
        let rotation = transform.rotation();
        if rotation == DQuat::IDENTITY {
            return self.facts().extents;
        }
        let turned = RigidTransform::about(rotation, DVec3::ZERO, DVec3::ZERO);
        // Each end is off by the rounding of the direction, times the distance from the middle.
        let rounding = 2.0 * turned.rounding(self.control_box.diagonal());
        DVec3::AXES.map(|axis| {
            self.extent(None, rotation.inverse() * axis) + Interval { lower: -rounding, upper: rounding }
        })
    }

    /// Returns the bodies as measured, in the order of [`Self::body_parts`].
    pub(in crate::engine) fn measured_bodies(&self) -> &[MeasuredBody] {
        computed::<Vec<MeasuredBody>>(&self.kept.measured, || {
            if self.facets.is_none() {
                // Edges are joined on one core. Areas do not wait for them.
                let parts = || {
                    self.body_parts();
                };
                let areas = || {
                    self.face_areas();
                };
                join(true, parts, areas);
            }
            let parts = self.body_parts();
            map(parts.len(), |index| self.measured_body(&parts[index]))
        })
    }

    /// Returns the facts of all bodies together.
    fn facts_of_all(&self, bodies: &[MeasuredBody]) -> Facts {
        if let [body] = bodies {
            return body.facts.clone();
        }
        let Some(first) = bodies.first() else {
            let [min, max] = self.range(None);
            return Facts::within(min, max, VolumeUnknown::Open);
        };
        let unite = |of: fn(&Facts) -> [Interval; 3], upper: bool| {
            bodies.iter().skip(1).fold(of(&first.facts), |all, body| {
                let other = of(&body.facts);
                [0, 1, 2].map(|axis| {
                    if upper { all[axis].larger(other[axis]) } else { -(-all[axis]).larger(-other[axis]) }
                })
            })
        };
        let [min, max] = [unite(|facts| facts.min, false), unite(|facts| facts.max, true)];
        let areas = bodies.iter().filter_map(|body| body.facts.area);
        let area = areas.fold(Interval::exactly(0.0), |sum, area| sum + area);
        let why = bodies.iter().find_map(|body| body.facts.volume_unknown);
        let facts = Facts { area: Some(area), ..Facts::within(min, max, why.unwrap_or(VolumeUnknown::Open)) };
        if why.is_some() {
            return facts;
        }
        let origin = self.control_box.center();
        let mut sum = [Interval::exactly(0.0); 10];
        for (body, parts) in bodies.iter().zip(self.body_parts()) {
            let center = parts.aabb.center();
            let offset =
                [0, 1, 2].map(|axis| Interval::exactly(center[axis]) - Interval::exactly(origin[axis]));
            let moments = body.moments.as_ref().map(|moments| shifted(moments, offset));
            for (sum, more) in sum.iter_mut().zip(moments.into_iter().flatten()) {
                *sum = *sum + more;
            }
        }
        let of_gaps = bodies.iter().filter_map(|body| body.facts.volume_of_gap).sum();
        let facts = facts.with_mass(Mass::new(&sum, origin), |axis| self.extent(None, axis));
        Facts { volume_of_gap: Some(of_gaps), ..facts }
    }

    /// Measures a body.
    fn measured_body(&self, parts: &BodyParts) -> MeasuredBody {
        let origin = parts.aabb.center();
        let [min, max] = self.range(Some(parts));
        let area = self.area_of(parts);
        let is_open = self.free_edges_of(parts) > 0;
        let shells: Vec<MeasuredShell> =
            parts.shells.iter().map(|shell| self.measured_shell(shell, &parts.aabb, origin)).collect();
        let one_sided = shells.iter().any(|shell| shell.state.is_one_sided);
        let why = if is_open {
            Some(VolumeUnknown::Open)
        } else if one_sided {
            Some(VolumeUnknown::NotOrientable)
        } else {
            (!parts.may_nest_with.is_empty()).then_some(VolumeUnknown::Nesting)
        };
        let (moments, orientation) = if is_open || one_sided {
            (Moments::ZERO, orientation_of_sheet(&shells, one_sided))
        } else {
            summed(&shells)
        };
        let turned = shells.iter().enumerate().map(|(index, shell)| shell.is_turned(index > 0)).collect();
        // Which of a sliver's two long edges joins a neighbour is not known, and so not its side either.
        let is_guessed = orientation == Orientation::Mixed && self.trimmed_faces.is_some();
        let orientation = if is_guessed { Orientation::Undecided } else { orientation };
        let facts = Facts { area: Some(area), ..Facts::within(min, max, why.unwrap_or(VolumeUnknown::Open)) };
        if why.is_some() {
            return MeasuredBody { orientation, facts, moments: None, turned };
        }
        let moments = moments.intervals();
        let facts = facts.with_mass(Mass::new(&moments, origin), |axis| self.extent(Some(parts), axis));
        let facts = Facts { volume_of_gap: Some(self.layer(parts) * area.upper), ..facts };
        MeasuredBody { orientation, facts, moments: Some(moments), turned }
    }

    /// Returns, for each shell, whether its normals in the source point out of it; `None` where they do not agree with
    /// each other, and where the sign of its volume is not known. Computed at first use.
    pub(super) fn faces_out(&self) -> &[Option<bool>] {
        computed::<Vec<Option<bool>>>(&self.kept.faces_out, || {
            let mut faces_out = vec![None; self.joined().of_shell.len()];
            let origin = self.control_box.center();
            for shell in self.shell_parts() {
                let measured = self.measured_shell(&shell, &self.control_box, origin);
                let signs = measured.is_turned(false).zip(measured.state.of_source);
                faces_out[shell.shell as usize] = signs.map(|(outward, of_source)| outward == of_source);
            }
            faces_out
        })
    }

    /// Returns the moments of a shell in a box about `origin`, with all that closes it.
    fn measured_shell(&self, shell: &ShellParts, aabb: &Aabb, origin: DVec3) -> MeasuredShell {
        let joined = self.joined();
        let state = joined.of_shell[shell.shell as usize];
        let mut moments = Moments::ZERO;
        if state.free == 0 && !state.is_one_sided {
            let moved = self.moved();
            let sums = map_ranges(shell.surfaces.len(), |range| {
                let mut sum = Moments::ZERO;
                for &surface in &shell.surfaces[range] {
                    let is_turned = joined.turned[surface as usize];
                    self.for_each_cone(surface, origin, moved, |cone| sum.add(cone, is_turned));
                }
                sum
            });
            sums.iter().for_each(|sum| moments.add(sum, false));
            let radius = aabb.max_distance_squared(origin).sqrt() + moved;
            moments.add_surface(state.cracks, radius);
        }
        MeasuredShell { moments, state }
    }

    /// Calls a function with the moments of the cones over all patches of a surface.
    fn for_each_cone(&self, surface: u32, origin: DVec3, moved: f64, mut each: impl FnMut(&Moments)) {
        match &self.facets {
            Some(facets) => {
                if let Facet::Triangle(corners) = facets.target.facet(surface) {
                    each(&of_triangle(corners, origin, moved));
                }
            }
            None => self.patches_of(surface).for_each(|patch| each(&of_patch(&patch, origin, moved))),
        }
    }

    /// Returns the patches of a surface.
    pub(super) fn patches_of(&self, surface: u32) -> impl Iterator<Item = Patch<'_>> {
        let grid = &self.bezier.grids[surface as usize];
        let count: usize = grid.counts().iter().product();
        (grid.first..grid.first + count).map(|index| self.bezier.patches.patch(index))
    }

    /// Returns an upper bound on the distance of points of patches, at their parameters, from the exact ones,
    /// without that of trimmed faces.
    pub(in crate::engine) fn moved(&self) -> f64 {
        match &self.facets {
            Some(facets) => facets.error,
            None => self.bezier.point_error.after(0) - self.pieces.deviation(),
        }
    }

    /// Returns the area of a body.
    fn area_of(&self, parts: &BodyParts) -> Interval {
        let zero = Interval::exactly(0.0);
        match &self.facets {
            Some(facets) => {
                let surfaces = parts.shells.iter().flat_map(|shell| &shell.surfaces);
                surfaces.fold(zero, |sum, &surface| match facets.target.facet(surface) {
                    Facet::Triangle(corners) => sum + area_of_triangle(corners, facets.error),
                    Facet::Point(_) => sum,
                })
            }
            None => {
                let areas = self.face_areas();
                let area = |face: usize| {
                    let Area { lower, upper } = areas[face];
                    Interval { lower, upper }
                };
                self.faces_of(parts).into_iter().fold(zero, |sum, face| sum + area(face))
            }
        }
    }

    /// Returns the largest distance between the faces of a body and their source, as far as it is stated.
    fn layer(&self, parts: &BodyParts) -> f64 {
        let gap = self
            .faces_of(parts)
            .into_iter()
            .map(|face| self.face_gaps[face])
            .fold(0.0, crate::rounding::upper_max);
        gap + self.deviation()
    }

    /// Returns the least and the largest coordinates of a body, or of the model.
    fn range(&self, parts: Option<&BodyParts>) -> [[Interval; 3]; 2] {
        let origin = self.aabb_of(parts).center();
        let largest = |direction: DVec3| self.largest(parts, direction, origin);
        let at = |axis: usize| Interval::exactly(origin[axis]);
        let min = [0, 1, 2].map(|axis| at(axis) - largest(-DVec3::AXES[axis]));
        [min, [0, 1, 2].map(|axis| at(axis) + largest(DVec3::AXES[axis]))]
    }

    /// Returns the lengths of the model along x, y and z, to about their intervals' width.
    pub(in crate::engine) fn lengths(&self) -> [f64; 3] {
        let [min, max] = self.range(None);
        [0, 1, 2].map(|axis| (max[axis] - min[axis]).middle())
    }

    /// Returns the length of a body, or of the model, along a direction.
    fn extent(&self, parts: Option<&BodyParts>, direction: DVec3) -> Interval {
        let origin = self.aabb_of(parts).center();
        self.largest(parts, direction, origin) + self.largest(parts, -direction, origin)
    }

    fn aabb_of(&self, parts: Option<&BodyParts>) -> Aabb {
        parts.map_or(self.control_box, |parts| parts.aabb)
    }

    /// Returns the largest n·(x − origin) of a body, or of the model.
    pub(in crate::engine) fn largest(
        &self,
        parts: Option<&BodyParts>,
        direction: DVec3,
        origin: DVec3,
    ) -> Interval {
        let surfaces = || {
            parts.into_iter().flat_map(|parts| &parts.shells).flat_map(|shell| shell.surfaces.iter().copied())
        };
        match &self.facets {
            Some(facets) => {
                let corners = |place: u32| match facets.target.facet(place) {
                    Facet::Triangle(corners) => corners,
                    Facet::Point(point) => [point; 3],
                };
                let all = if parts.is_none() { 0..facets.target.len() as u32 } else { 0..0 };
                let points = surfaces().chain(all).flat_map(corners);
                largest_of_points(points, direction, origin, facets.error)
            }
            None => {
                let width = RELATIVE_WIDTH * self.aabb_of(parts).diagonal();
                let moved = self.bezier.point_error.after(0);
                let all = if parts.is_none() { 0..self.bezier.grids.len() as u32 } else { 0..0 };
                let patches = surfaces().chain(all).flat_map(|surface| self.patches_of(surface));
                largest(patches, direction, origin, width, moved)
            }
        }
    }
}

impl MeasuredShell {
    /// Returns whether the surfaces are to be turned over so that the volume is positive, or negative if the shell is a
    /// void; `None` where its sign is not known.
    fn is_turned(&self, is_void: bool) -> Option<bool> {
        let volume = self.moments.volume();
        let is_negative = volume.upper < 0.0;
        (is_negative || volume.lower > 0.0).then_some(is_negative != is_void)
    }
}

/// Returns the orientation of a body without a volume.
fn orientation_of_sheet(shells: &[MeasuredShell], one_sided: bool) -> Orientation {
    if one_sided {
        Orientation::NotOrientable
    } else if shells.iter().all(|shell| shell.state.of_source.is_some()) {
        Orientation::Consistent
    } else {
        Orientation::Mixed
    }
}

/// Returns the moments of an outer shell less those of its voids, and how the source orients all of them.
fn summed(shells: &[MeasuredShell]) -> (Moments, Orientation) {
    let mut sum = Moments::ZERO;
    let (mut agree, mut oppose, mut decided) = (true, true, true);
    for (index, shell) in shells.iter().enumerate() {
        let Some(is_turned) = shell.is_turned(index > 0) else {
            sum.add(&shell.moments.of_either_sign(), false);
            decided = false;
            agree &= shell.state.of_source.is_some();
            continue;
        };
        sum.add(&shell.moments, is_turned);
        agree &= shell.state.of_source == Some(is_turned);
        oppose &= shell.state.of_source == Some(!is_turned);
    }
    let orientation = match (decided, agree, oppose) {
        (false, true, _) => Orientation::Undecided,
        (true, true, _) => Orientation::Consistent,
        (true, false, true) => Orientation::InsideOut,
        _ => Orientation::Mixed,
    };
    (sum, orientation)
}
