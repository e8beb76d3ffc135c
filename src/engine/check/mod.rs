//! All pairs of bodies of one model or several: which clash, touch or come near.

mod depth;
mod duplicates;
mod options;
mod pair;
mod parting;
mod pattern;
mod rules;
mod sweep;

pub use options::CheckOptions;
pub use pair::{BodyPair, PairState};
pub use rules::{CheckRules, NamesOfPair, RequiredDistance, Rule, UnkeptRule};

use self::options::Limits;
use self::rules::Bound;
use super::bodies::unique_name;
use super::clock::Clock;
use super::overlap::Patience;
use super::section::Section;
use super::{
    BodyKind, Computation, EmbeddedUnknown, Embedding, Engine, OverlapOptions, PreparedModel, Seconds,
    SelfOverlap, Stop,
};
use crate::bvh::Aabb;
use crate::error::{Error, Result};
use crate::facts::Orientation;
use crate::interval::Interval;
use crate::model::level;
use crate::progress::{Monitor, Progress};
use crate::rounding::upper_max;
use crate::sorting::sort_by_number;
use crate::threads::parallel::map;
use serde::Serialize;
use std::collections::HashSet;
use std::sync::Arc;

/// The number of pairs searched between two reports of progress.
const PAIRS_AT_ONCE: usize = 64;

/// The part of the progress at which all pairs are judged.
const JUDGED_PART: f64 = 0.5;

/// The width of the volumes of common parts, as a fraction of the union's.
const VOLUME_TOLERANCE: f64 = 1e-4;

/// The number of pieces of patches for each of them, some tenths of a second.
const VOLUME_CELLS: usize = 10_000;

/// A model whose bodies are checked.
#[derive(Debug, Clone, Copy)]
pub struct NamedModel<'a> {
    /// The level above the names of its bodies, such as that of its file.
    pub name: Option<&'a str>,
    /// The model.
    pub model: &'a PreparedModel,
}

/// A body, by itself.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
#[non_exhaustive]
pub struct CheckedBody {
    /// The names of its levels, joined as those of a face are ([`crate::face_path`] splits them); bodies without a
    /// name, and of equal names, are numbered.
    pub name: String,
    /// The model that it is of, from 0.
    pub model: usize,
    /// What it is.
    pub kind: BodyKind,
    /// Whether every edge of its faces has a partner.
    pub closed: bool,
    /// How its faces are oriented.
    pub orientation: Option<Orientation>,
    /// Whether it closes and its volume is certainly less than that of a layer of the tolerance over half its area,
    /// so that it has no inside to speak of.
    pub degenerate: bool,
    /// Whether its boundary certainly meets itself nowhere, up to its gaps, or certainly does; none where neither is known.
    pub embedded: Option<bool>,
    /// Of a body that is embedded, the length of the way along its boundary between points of it that are as near to each
    /// other as its gaps, at most.
    pub embedded_within: Option<f64>,
    /// Why it is not known whether it is embedded.
    pub embedded_unknown: Option<EmbeddedUnknown>,
    /// A place at which its boundary meets itself; none unless it certainly does.
    pub self_overlap: Option<SelfOverlap>,
    /// The names of the bodies that certainly have its shape in its place, within the tolerance.
    pub duplicates: Vec<String>,
}

/// All pairs of bodies.
///
/// Guarantee: as [`PairState`] states. Every pair that is not listed is apart: its boxes are at least `below`, and
/// farther than the tolerance, from each other.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
#[non_exhaustive]
pub struct CheckResult {
    /// The distance below which bodies are near.
    pub below: f64,
    /// The distance up to which bodies touch, and the permitted width of intervals, in model units.
    pub tolerance: f64,
    /// Each body by itself.
    pub bodies: Vec<CheckedBody>,
    /// The pairs whose boxes are near, clashes first.
    pub pairs: Vec<BodyPair>,
    /// The rules that are not certainly kept.
    pub rules: Vec<UnkeptRule>,
    /// Whether all is certainly clean: no pair clashes that is not intended to, and all rules are kept. `Some(false)`
    /// is certain, too. Faults of single bodies are no part of it.
    pub clean: Option<bool>,
    /// The number of all pairs.
    pub pair_count: usize,
    /// The diagonal of the box of all bodies.
    pub diagonal: f64,
    /// Metres per unit of every length here, if the first model states its unit.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub unit: Option<f64>,
    /// Where the time went.
    pub seconds: Seconds,
}

impl CheckResult {
    /// Returns the number of pairs in this state: of those that are apart, only the listed ones.
    #[must_use]
    pub fn count(&self, state: PairState) -> usize {
        self.pairs.iter().filter(|pair| pair.state == state).count()
    }
}

/// Returns [`CheckResult::clean`].
fn are_clean(pairs: &[BodyPair], rules: &[UnkeptRule]) -> Option<bool> {
    let has = |state| pairs.iter().any(|pair| pair.state == state && !pair.intended);
    if has(PairState::Clash) || rules.iter().any(|rule| rule.broken) {
        return Some(false);
    }
    (!has(PairState::Undecided) && rules.is_empty()).then_some(true)
}

/// A body as a model, and the box that it is certainly in.
struct Checked {
    model: PreparedModel,
    aabb: Aabb,
    volume: Option<Interval>,
    area: Option<Interval>,
    /// The indices of its faces in the model that it is of.
    faces: Vec<usize>,
    /// The indices of the bodies that may be voids of this one, and of those that this one may be a void of.
    may_nest_with: Vec<usize>,
}

impl Checked {
    fn is_degenerate(&self, tolerance: f64) -> bool {
        let layer = self.area.map(|area| 0.5 * tolerance * area.lower);
        self.volume.zip(layer).is_some_and(|(volume, layer)| volume.upper < layer)
    }

    /// Returns whether the body is embedded, with the faces as they are in its model.
    fn embedding(&self, limits: &Limits) -> Embedding {
        let mut found = self.model.embedding(&|| limits.is_over());
        let overlap = found.self_overlap.iter_mut().flat_map(|found| &mut found.faces);
        let unknown = found.embedded_unknown.iter_mut().flat_map(|found| &mut found.faces);
        overlap.chain(unknown).for_each(|face| *face = self.faces[*face]);
        found
    }
}

impl Engine {
    /// Compares all pairs of bodies of these models, and looks at each body by itself.
    ///
    /// Guarantee: as [`CheckResult`] states. Time grows with the pairs whose boxes come near each other.
    ///
    /// # Errors
    /// [`Error::OptionOutOfRange`]; [`Error::OptionInvalid`]; [`Error::UnitsDiffer`];
    /// [`Error::FacetsUnsupported`] for a cloud of points; [`Error::EmptyModel`] without models;
    /// [`Error::Cancelled`].
    pub fn check<'a>(
        &'a self,
        models: &'a [NamedModel<'a>],
        options: &'a CheckOptions,
    ) -> Computation<'a, CheckResult> {
        Computation::new(move |mut watched| {
            Box::pin(async move { self.check_of(models, options, watched.monitor()).await })
        })
    }

    async fn check_of(
        &self,
        models: &[NamedModel<'_>],
        options: &CheckOptions,
        monitor: &mut dyn Monitor,
    ) -> Result<CheckResult> {
        options.validate()?;
        let clock = Clock::start(options.max_seconds);
        let (mut bodies, checked) = all_bodies(models, options)?;
        let aabb = checked.iter().fold(Aabb::EMPTY, |aabb, body| aabb.union(body.aabb));
        let limits = options.limits(aabb.diagonal(), clock);
        let embeddings = map(checked.len(), |index| checked[index].embedding(&limits));
        for ((body, of), found) in bodies.iter_mut().zip(&checked).zip(embeddings) {
            body.degenerate = of.is_degenerate(limits.tolerance);
            let Embedding { embedded, embedded_within, embedded_unknown, self_overlap } = found;
            body.embedded = embedded;
            body.embedded_within = embedded_within;
            body.embedded_unknown = embedded_unknown;
            body.self_overlap = self_overlap;
        }
        let rules = options.rules.bound(&bodies)?;
        let prepare = clock.seconds();
        let mut judged = judged(&bodies, &checked, &rules, &limits, monitor).await?;
        self.measure_clashes(&mut judged, &checked, &limits, monitor).await?;
        self.find_duplicates(&mut bodies, &judged, &checked, &limits).await?;
        monitor.progress(1.0);
        let rules = rules.unkept(&bodies, &judged);
        let mut pairs: Vec<BodyPair> = judged.into_iter().map(|(_, pair)| pair).collect();
        // Stable, so that pairs of one state stay in the order of their bodies.
        sort_by_number(&mut pairs, |pair| f64::from(pair.state as u8));
        Ok(CheckResult {
            clean: are_clean(&pairs, &rules),
            below: options.below,
            tolerance: limits.tolerance,
            pair_count: bodies.len() * bodies.len().saturating_sub(1) / 2,
            bodies,
            pairs,
            rules,
            diagonal: aabb.diagonal(),
            unit: models.first().and_then(|first| first.model.unit()),
            seconds: Seconds { prepare, compile: 0.0, solve: clock.seconds() - prepare },
        })
    }

    /// Measures the common volume of each clash, in the part of the progress behind [`JUDGED_PART`].
    async fn measure_clashes(
        &self,
        judged: &mut [Judged],
        checked: &[Checked],
        limits: &Limits,
        monitor: &mut dyn Monitor,
    ) -> Result<()> {
        let mut clashes: Vec<_> = judged
            .iter_mut()
            .filter(|(_, pair)| pair.state == PairState::Clash && pair.depth.is_some())
            .collect();
        let length = (1.0 - JUDGED_PART) / clashes.len() as f64;
        for (place, (of, pair)) in clashes.iter_mut().enumerate() {
            let mut section = Section { whole: monitor, part: [JUDGED_PART + length * place as f64, length] };
            let models = of.map(|index| &checked[index].model);
            pair.volume = self.common_volume(models, limits, &mut section).await?;
        }
        Ok(())
    }

    /// Names the bodies that have the shape and the place of another one.
    async fn find_duplicates(
        &self,
        bodies: &mut [CheckedBody],
        judged: &[Judged],
        checked: &[Checked],
        limits: &Limits,
    ) -> Result<()> {
        let alike = |of: [usize; 2]| {
            let [a, b] = of.map(|index| &checked[index].aabb);
            duplicates::are_alike(a, b, limits.tolerance)
        };
        for [a, b] in judged.iter().map(|&(of, _)| of).filter(|&of| alike(of)) {
            let models = [a, b].map(|index| &checked[index].model);
            if self.is_duplicate(models, limits).await? {
                let names = [a, b].map(|index| bodies[index].name.clone());
                bodies[a].duplicates.push(names[1].clone());
                bodies[b].duplicates.push(names[0].clone());
            }
        }
        Ok(())
    }
}

/// The indices of two bodies, and how they lie to each other.
type Judged = ([usize; 2], BodyPair);

/// Returns the pairs whose boxes are near, without volumes, in the order of their bodies.
async fn judged(
    bodies: &[CheckedBody],
    checked: &[Checked],
    rules: &Bound,
    limits: &Limits,
    monitor: &mut dyn Monitor,
) -> Result<Vec<Judged>> {
    let boxes: Vec<Aabb> = checked.iter().map(|body| body.aabb).collect();
    let reach_of = |pair| upper_max(limits.reach(), rules.required(pair));
    let mut near = sweep::pairs_within(&boxes, upper_max(limits.reach(), rules.largest()));
    near.retain(|&[a, b]| sweep::are_within(&boxes[a], &boxes[b], reach_of([a, b])));
    let mut section = Section { whole: monitor, part: [0.0, JUDGED_PART] };
    let mut progress = Progress::new(&mut section, false);
    let mut judged = Vec::with_capacity(near.len());
    let voids_of = |index: usize| &checked[index].may_nest_with;
    for chunk in near.chunks(PAIRS_AT_ONCE) {
        judged.extend(map(chunk.len(), |place| {
            let of = chunk[place];
            let models = of.map(|index| &checked[index].model);
            let may_be_voids: Vec<&PreparedModel> =
                of.iter().flat_map(|&index| voids_of(index)).map(|&index| &checked[index].model).collect();
            let judged = pair::judged(models, limits, reach_of(of), &may_be_voids)?;
            let [a, b] = of.map(|index| bodies[index].name.clone());
            Ok((of, BodyPair { a, b, intended: rules.is_intended(of), ..judged }))
        }));
        progress.checkpoint(judged.len() as f64 / near.len() as f64).await?;
    }
    judged.into_iter().collect()
}

impl Engine {
    /// Returns the volume of the common part of two bodies, where both have one.
    async fn common_volume(
        &self,
        [a, b]: [&PreparedModel; 2],
        limits: &Limits,
        monitor: &mut dyn Monitor,
    ) -> Result<Option<Interval>> {
        let options = OverlapOptions {
            tolerance: Some(VOLUME_TOLERANCE),
            max_seconds: limits.seconds(),
            max_cells: Some(VOLUME_CELLS),
            ..OverlapOptions::default()
        };
        let found = self.overlap_of(a, b, &options, Patience::LONG, monitor).await?;
        if found.stop == Stop::Cancelled {
            return Err(Error::Cancelled);
        }
        Ok(found.volumes.map(|volumes| volumes.intersection))
    }
}

/// Returns the bodies of these models, each as a model, in the order of [`CheckResult::bodies`] and in the unit of the
/// first model, for pictures of them.
///
/// # Errors
/// Those of [`Engine::check`] on models.
pub fn checked_bodies(models: &[NamedModel<'_>], scale_units: bool) -> Result<Vec<PreparedModel>> {
    let options = CheckOptions { scale_units, ..CheckOptions::default() };
    let (_, checked) = all_bodies(models, &options)?;
    Ok(checked.into_iter().map(|body| body.model).collect())
}

/// Returns the bodies of all models, those of other units scaled to that of the first.
fn all_bodies(models: &[NamedModel<'_>], options: &CheckOptions) -> Result<(Vec<CheckedBody>, Vec<Checked>)> {
    let first = models.first().ok_or(Error::EmptyModel)?.model;
    let (mut bodies, mut checked, mut taken) = (Vec::new(), Vec::new(), HashSet::new());
    for (model, &NamedModel { name: above, model: prepared }) in models.iter().enumerate() {
        let scaled: Option<Arc<PreparedModel>> = prepared.in_unit_of(first, options.scale_units)?;
        let prepared = scaled.as_deref().unwrap_or(prepared);
        let first_of_model = checked.len();
        let facts = prepared.body_facts().zip(prepared.body_parts());
        let all = prepared.bodies().into_iter().zip(prepared.single_bodies()?).zip(facts);
        for ((body, single), (facts, parts)) in all {
            let levels: Vec<String> = above.into_iter().map(level).chain([body.full_name]).collect();
            let name = unique_name(levels.join(" / "), &mut taken);
            let error = single.bezier().point_error.after(0);
            // A box of zero width may round to itself when it grows.
            let aabb = single.control_box().grown(error);
            let aabb = Aabb { min: aabb.min.map(f64::next_down), max: aabb.max.map(f64::next_up) };
            checked.push(Checked {
                model: single,
                aabb,
                volume: facts.volume,
                area: facts.area,
                faces: body.faces,
                may_nest_with: parts.may_nest_with.iter().map(|place| first_of_model + place).collect(),
            });
            bodies.push(CheckedBody {
                name,
                model,
                kind: body.kind,
                closed: body.closed,
                orientation: body.orientation,
                degenerate: false,
                embedded: None,
                embedded_within: None,
                embedded_unknown: None,
                self_overlap: None,
                duplicates: Vec::new(),
            });
        }
    }
    Ok((bodies, checked))
}
