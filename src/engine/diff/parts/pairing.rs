//! The pairs of parts of two assemblies, by proof where shapes are equal, else by name and place.

use super::motions::{candidates, most_matching};
use super::part::{Part, parts_of};
use super::{PartDifference, PartFaces, PartMotion, PartState, PartsUnknown};
use crate::engine::clock::Clock;
use crate::engine::diff::{DiffOptions, DiffResult, FaceDifference, FaceState};
use crate::engine::options::{CertifiedOptions, Method};
use crate::engine::{DistanceOptions, Engine, PreparedModel};
use crate::error::{Error, Result};
use crate::model::RigidTransform;
use crate::progress::Monitor;
use crate::sorting::sort_by_number;
use glam::DVec3;

/// The largest number of bodies of a model that are paired: a soup of triangles has one a triangle.
const MAX_PARTS: usize = 2000;

/// The part of a box by which those of parts in place may differ, control points of other parametrizations.
const BOX_PART: f64 = 0.05;

/// The part of the larger of two boxes that both have in common where a part is taken for the other one, changed.
const COMMON_PART: f64 = 0.4;

/// The largest number of cells of a search for a proof: copies take fewer, and what takes more is compared face by
/// face.
const PROOF_CELLS: usize = 65_536;

/// What became of the parts of both models.
#[derive(Default)]
pub(in crate::engine::diff) struct Parts {
    pub(in crate::engine::diff) all: Vec<PartDifference>,
    /// Why there are none.
    pub(in crate::engine::diff) unknown: Option<PartsUnknown>,
    /// Whether the files name more parts of the one model than of the other.
    pub(in crate::engine::diff) differ_in_number: bool,
}

/// Parts of both models, and those that are not paired yet.
struct Pairing<'a> {
    parts: [Vec<Part>; 2],
    open: [Vec<bool>; 2],
    options: &'a DiffOptions,
    clock: Clock,
    /// The comparison of the only parts in place, where both models have one with all faces.
    in_place: Option<&'a DiffResult>,
    found: Vec<(usize, PartDifference)>,
}

impl Engine {
    /// Returns what became of each part of A, in their order, and then the parts of B alone.
    ///
    /// Clouds have no parts. If a model has more than 2,000 bodies, or the budget of seconds is spent before the comparison
    /// begins, the result has the reason and no parts. If the budget ends during the comparison, the remaining parts are
    /// undecided.
    ///
    /// # Errors
    /// Those of [`Engine::distance`] and [`Engine::diff`].
    pub(in crate::engine::diff) async fn parts(
        &self,
        models: [&PreparedModel; 2],
        options: &DiffOptions,
        whole: &DiffResult,
        clock: Clock,
        monitor: &mut dyn Monitor,
    ) -> Result<Parts> {
        let is_late = || clock.is_over();
        if models.iter().any(|model| model.is_cloud()) {
            return Ok(Parts::default());
        }
        let without = |why| Ok(Parts { unknown: Some(why), ..Parts::default() });
        for model in models {
            if is_late() {
                return without(PartsUnknown::Budget);
            }
            if model.bodies().len() > MAX_PARTS {
                return without(PartsUnknown::TooMany);
            }
            // Bodies are paired by their facts, and areas take the longest of those.
            if !model.has_face_areas(&is_late) {
                return without(PartsUnknown::Budget);
            }
        }
        let parts = [parts_of(models[0])?, parts_of(models[1])?];
        let open = [vec![true; parts[0].len()], vec![true; parts[1].len()]];
        let has_all = |parts: &[Part], faces: &[FaceDifference]| matches!(parts, [only] if only.faces.len() == faces.len());
        let are_whole = has_all(&parts[0], &whole.faces_of_a) && has_all(&parts[1], &whole.faces_of_b);
        let in_place = are_whole.then_some(whole);
        let mut pairing = Pairing { parts, open, options, clock, in_place, found: Vec::new() };
        match in_place.map(|whole| whole.state) {
            Some(FaceState::Unchanged) => {
                pairing.add([0, 0], pairing.name_state([0, 0]), None, bounds(whole), PartFaces::default());
                return Ok(pairing.finished());
            }
            Some(FaceState::Changed) => {}
            Some(FaceState::Undecided) | None => self.pair_in_place(&mut pairing, monitor).await?,
        }
        self.pair_moved(&mut pairing, false, monitor).await?;
        self.pair_moved(&mut pairing, true, monitor).await?;
        self.pair_changed(&mut pairing, monitor).await?;
        Ok(pairing.finished())
    }

    /// Pairs the parts that are where they were.
    async fn pair_in_place(&self, pairing: &mut Pairing<'_>, monitor: &mut dyn Monitor) -> Result<()> {
        let rest = pairing.options.transform;
        for [a, b] in pairing.alike(|a, b, limit| has_place(a, b, &rest, limit)) {
            if pairing.is_late() {
                break;
            }
            if !pairing.is_open([a, b]) {
                continue;
            }
            let [one, other] = pairing.pair([a, b]);
            if let Some(bounds) = self.proven([&one.model, &other.model], &rest, pairing, monitor).await? {
                pairing.add([a, b], pairing.name_state([a, b]), None, bounds, PartFaces::default());
            }
        }
        Ok(())
    }

    /// Pairs the parts that a motion, after a mirror or not, lays on each other.
    async fn pair_moved(
        &self,
        pairing: &mut Pairing<'_>,
        is_mirrored: bool,
        monitor: &mut dyn Monitor,
    ) -> Result<()> {
        let rest = pairing.options.transform;
        for [a, b] in pairing.alike(|_, _, _| true) {
            if pairing.is_late() {
                break;
            }
            if !pairing.is_open([a, b]) {
                continue;
            }
            let [one, other] = pairing.pair([a, b]);
            let image = if is_mirrored { Some(one.mirrored()?) } else { None };
            let from = image.as_ref().unwrap_or(one);
            let mut proof = None;
            for motion in candidates(from, other, &rest) {
                if let Some(bounds) =
                    self.proven([&from.model, &other.model], &motion, pairing, monitor).await?
                {
                    proof = Some((motion, bounds));
                    break;
                }
            }
            let Some((motion, bounds)) = proof else { continue };
            let middles = [one, from].map(|part| rest.apply(part.aabb.center()));
            let motion = PartMotion::new(&after(&motion, &rest), middles);
            let state = if is_mirrored { PartState::Mirrored } else { PartState::Moved };
            pairing.add([a, b], state, Some(motion), bounds, PartFaces::default());
        }
        Ok(())
    }

    /// Pairs what is left by name, then by place, and compares it face by face.
    async fn pair_changed(&self, pairing: &mut Pairing<'_>, monitor: &mut dyn Monitor) -> Result<()> {
        let rest = pairing.options.transform;
        let by_name = pairing.ordered(|a, b| a.given.is_some() && a.given == b.given);
        let limit = pairing.options.limit;
        let by_place = pairing.ordered(|a, b| common_part(a, b, &rest, limit) >= COMMON_PART);
        for [a, b] in by_name.into_iter().chain(by_place) {
            if pairing.is_late() {
                break;
            }
            if !pairing.is_open([a, b]) {
                continue;
            }
            let [one, other] = pairing.pair([a, b]);
            let compared;
            let place = match pairing.in_place {
                Some(whole) => whole,
                None => {
                    compared = self.compared([one, other], rest, pairing, monitor).await?;
                    &compared
                }
            };
            let moved = match place.state {
                FaceState::Changed => self.moved_and_changed([one, other], place, pairing, monitor).await?,
                _ => None,
            };
            let faces = |of: &DiffResult| PartFaces {
                of_a: changed_faces(&of.faces_of_a, one),
                of_b: changed_faces(&of.faces_of_b, other),
            };
            let (state, motion, bounds, faces) = match &moved {
                Some((motion, moved)) => {
                    let state = match moved.state {
                        FaceState::Changed => PartState::MovedAndChanged,
                        FaceState::Unchanged => PartState::Moved,
                        FaceState::Undecided => PartState::Undecided,
                    };
                    let motion = PartMotion::new(&after(motion, &rest), [rest.apply(one.aabb.center()); 2]);
                    (state, Some(motion), bounds(moved), faces(moved))
                }
                None => {
                    let state = match place.state {
                        FaceState::Changed => PartState::Changed,
                        FaceState::Unchanged => pairing.name_state([a, b]),
                        FaceState::Undecided => PartState::Undecided,
                    };
                    (state, None, bounds(place), faces(place))
                }
            };
            pairing.add([a, b], state, motion, bounds, faces);
        }
        Ok(())
    }

    /// Returns the first motion that leaves fewer faces changed than there are in place and at most half of all, with
    /// the comparison after it.
    async fn moved_and_changed(
        &self,
        [one, other]: [&Part; 2],
        place: &DiffResult,
        pairing: &Pairing<'_>,
        monitor: &mut dyn Monitor,
    ) -> Result<Option<(RigidTransform, DiffResult)>> {
        let (rest, limit) = (pairing.options.transform, pairing.options.limit);
        let mut tried = vec![rest];
        for motion in most_matching(one, other, &rest) {
            if !tried.iter().all(|earlier| moves(&motion, earlier, one, limit)) {
                continue;
            }
            tried.push(motion);
            let moved = self.compared([one, other], motion, pairing, monitor).await?;
            let faces = moved.faces_of_a.len() + moved.faces_of_b.len();
            if changed(&moved) < changed(place) && 2 * changed(&moved) <= faces {
                return Ok(Some((motion, moved)));
            }
        }
        Ok(None)
    }

    /// Returns the bounds of the Hausdorff distance under a motion, if it is certainly at most the limit.
    async fn proven(
        &self,
        [a, b]: [&PreparedModel; 2],
        motion: &RigidTransform,
        pairing: &Pairing<'_>,
        monitor: &mut dyn Monitor,
    ) -> Result<Option<[f64; 2]>> {
        let limit = pairing.options.limit;
        let certified = CertifiedOptions {
            max_cells: Some(pairing.options.max_cells.min(PROOF_CELLS)),
            max_seconds: pairing.clock.left(),
            ..CertifiedOptions::default()
        };
        let options = DistanceOptions {
            limit: Some(limit),
            symmetric: true,
            transform: *motion,
            method: Method::Certified(certified),
            ..DistanceOptions::default()
        };
        let found = self.distance_of(a, b, &options, monitor).await?;
        // A search that is cancelled returns what it has.
        if monitor.cancelled() {
            return Err(Error::Cancelled);
        }
        Ok((found.upper <= limit).then_some([found.lower, found.upper]))
    }

    async fn compared(
        &self,
        [a, b]: [&Part; 2],
        transform: RigidTransform,
        pairing: &Pairing<'_>,
        monitor: &mut dyn Monitor,
    ) -> Result<DiffResult> {
        let max_seconds = pairing.clock.left();
        let options = DiffOptions { transform, max_seconds, ..pairing.options.clone() };
        self.diff_of_faces(&a.model, &b.model, &options, monitor).await
    }
}

impl Pairing<'_> {
    fn is_late(&self) -> bool {
        self.clock.is_over()
    }

    fn is_open(&self, [a, b]: [usize; 2]) -> bool {
        self.open[0][a] && self.open[1][b]
    }

    fn pair(&self, [a, b]: [usize; 2]) -> [&Part; 2] {
        [&self.parts[0][a], &self.parts[1][b]]
    }

    /// Returns the open pairs that may be copies, as [`Self::ordered`].
    fn alike(&self, is_wanted: impl Fn(&Part, &Part, f64) -> bool) -> Vec<[usize; 2]> {
        let limit = self.options.limit;
        self.ordered(|a, b| is_wanted(a, b, limit) && a.is_like(b, limit))
    }

    /// Returns the open pairs, those of equal names first, and then those that are nearest.
    fn ordered(&self, is_wanted: impl Fn(&Part, &Part) -> bool) -> Vec<[usize; 2]> {
        let rest = self.options.transform;
        let [mut named, mut others] = [const { Vec::new() }; 2];
        for (a, one) in self.parts[0].iter().enumerate() {
            for (b, other) in self.parts[1].iter().enumerate() {
                if self.is_open([a, b]) && is_wanted(one, other) {
                    let has_name = one.given.is_some() && one.given == other.given;
                    let distance = rest.apply(one.center).distance(other.center);
                    if has_name { &mut named } else { &mut others }.push((distance, [a, b]));
                }
            }
        }
        // Those at equal distances stay in the order of their parts.
        sort_by_number(&mut named, |&(distance, _)| distance);
        sort_by_number(&mut others, |&(distance, _)| distance);
        named.into_iter().chain(others).map(|(_, pair)| pair).collect()
    }

    fn add(
        &mut self,
        [a, b]: [usize; 2],
        state: PartState,
        motion: Option<PartMotion>,
        [lower, upper]: [f64; 2],
        faces: PartFaces,
    ) {
        (self.open[0][a], self.open[1][b]) = (false, false);
        let [one, other] = self.pair([a, b]);
        let (name_of_a, name_of_b) = (Some(one.name.clone()), Some(other.name.clone()));
        let (lower, upper) = (Some(lower), Some(upper));
        self.found.push((a, PartDifference { name_of_a, name_of_b, state, motion, lower, upper, faces }));
    }

    /// Returns the state of a part that is in its place. The part is renamed if its name is new in the other model, or is
    /// there the name of a part of another shape. Exporters number copies anew, so that other names of copies do not count.
    fn name_state(&self, pair: [usize; 2]) -> PartState {
        let [a, b] = self.pair(pair);
        let has_name = |index: usize, of: &Part| self.parts[index].iter().any(|part| part.given == of.given);
        let is_new = || !has_name(1, a) || !has_name(0, b);
        let is_of_another_shape = || {
            let mut named = self.parts[0].iter().filter(|part| part.given == b.given);
            named.any(|part| !part.is_like(a, self.options.limit))
        };
        let has_another = a.given.is_some() && b.given.is_some() && a.given != b.given;
        if has_another && (is_new() || is_of_another_shape()) { PartState::Renamed } else { PartState::Same }
    }

    /// Returns all parts: those of A in their order, then those of B alone.
    fn finished(mut self) -> Parts {
        let alone = |name_of_a: Option<&Part>, name_of_b: Option<&Part>, state| PartDifference {
            name_of_a: name_of_a.map(|part| part.name.clone()),
            name_of_b: name_of_b.map(|part| part.name.clone()),
            state,
            motion: None,
            lower: None,
            upper: None,
            faces: PartFaces::default(),
        };
        let is_late = self.is_late();
        let of_models = self.parts.iter().flatten().zip(self.open.iter().flatten());
        let are_named = of_models.filter(|(_, is_open)| **is_open).all(|(part, _)| part.given.is_some());
        let differ_in_number = self.parts[0].len() != self.parts[1].len() && are_named && !is_late;
        let or_undecided = |state| if is_late { PartState::Undecided } else { state };
        let [of_a, of_b] = &self.parts;
        for (index, part) in of_a.iter().enumerate().filter(|&(index, _)| self.open[0][index]) {
            self.found.push((index, alone(Some(part), None, or_undecided(PartState::Removed))));
        }
        sort_by_number(&mut self.found, |&(index, _)| index as f64);
        let added = of_b.iter().enumerate().filter(|&(index, _)| self.open[1][index]);
        let added = added.map(|(_, part)| alone(None, Some(part), or_undecided(PartState::Added)));
        let all = self.found.into_iter().map(|(_, part)| part).chain(added).collect();
        Parts { all, unknown: None, differ_in_number }
    }
}

/// Returns whether two parts may be the same in place, by their boxes.
fn has_place(a: &Part, b: &Part, rest: &RigidTransform, limit: f64) -> bool {
    let slack = limit + BOX_PART * b.aabb.diagonal();
    // A turned box is larger than that of the turned part: the centres decide.
    rest.apply(a.center).distance(b.center) <= slack
}

/// Returns the part of the larger of two boxes that both have in common, up to the limit: those of plane sheets have no
/// thickness.
fn common_part(a: &Part, b: &Part, rest: &RigidTransform, limit: f64) -> f64 {
    let shift = rest.apply(a.aabb.center()) - a.aabb.center();
    let low = (a.aabb.min + shift).max(b.aabb.min);
    let high = (a.aabb.max + shift).min(b.aabb.max);
    if low.cmpgt(high + limit).any() {
        return 0.0;
    }
    // By the diagonal, so that flat parts have one, too.
    let [one, other] = [a.aabb.diagonal(), b.aabb.diagonal()];
    let largest = if one > other { one } else { other };
    (high - low).max(DVec3::ZERO).length() / largest
}

/// Returns whether a motion takes a corner of the part's box farther than the limit from where another one takes it.
fn moves(motion: &RigidTransform, other: &RigidTransform, part: &Part, limit: f64) -> bool {
    part.aabb.corners().into_iter().any(|at| motion.apply(at).distance(other.apply(at)) > limit)
}

/// Returns a motion without another one that came before it.
fn after(motion: &RigidTransform, before: &RigidTransform) -> RigidTransform {
    let rotation = (motion.rotation() * before.rotation().inverse()).normalize();
    if motion.rotation() == before.rotation() {
        return RigidTransform::translation(motion.offset() - before.offset()).unwrap_or(*motion);
    }
    let offset = motion.offset() - rotation * before.offset();
    RigidTransform::new(rotation, offset).unwrap_or(*motion)
}

/// Returns the bounds of the Hausdorff distance by those of all faces.
fn bounds(result: &DiffResult) -> [f64; 2] {
    let faces = || result.faces_of_a.iter().chain(&result.faces_of_b);
    let lower = faces().map(|face| face.lower).fold(0.0, |most, next| if next > most { next } else { most });
    [lower, faces().map(|face| face.upper).fold(0.0, crate::rounding::upper_max)]
}

fn changed(result: &DiffResult) -> usize {
    let faces = result.faces_of_a.iter().chain(&result.faces_of_b);
    faces.filter(|face| face.state != FaceState::Unchanged).count()
}

/// Returns the changed faces by their indices in the whole model.
fn changed_faces(faces: &[FaceDifference], part: &Part) -> Vec<usize> {
    let changed = faces.iter().filter(|face| face.state == FaceState::Changed);
    changed.filter_map(|face| part.faces.get(face.face).copied()).collect()
}
