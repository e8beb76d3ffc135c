//! The part of a model's area that has like counterparts in another one: near, and with a like tangent plane.

use super::shares::{Shares, largest_open, share, unknown};
use crate::area::Area;
use crate::certified::{Audit, AuditReport, Pair};
use crate::engine::PreparedModel;
use crate::engine::clock::Clock;
use crate::engine::outlook::Outlook;
use crate::engine::statistics::{Cells, Cover, audit, bounded, halve_page};
use crate::error::{Error, Result};
use crate::facets::{Parts, PreparedFacets, Source, Weighted};
use crate::interval::Interval;
use crate::model::RigidTransform;
use crate::normals::{ByFormula, Likeness, Likenesses, NormalTarget, OrientedPoint, Reach};
use crate::progress::{Monitor, Progress};
use glam::DVec3;
use std::ops::Range;

/// The part of the threshold within which distances are not looked at more closely.
const SUFFICIENT_PART: f64 = 0.125;

/// The parts from which on a search ends that is not to be expected to become narrow.
const PATIENCE: usize = 4096;

/// The number of parts between two checkpoints, where there is a limit of time.
const PARTS_AT_ONCE: usize = 256;

/// The question about the areas of both models, and the budgets of each direction.
#[derive(Debug, Clone, Copy)]
pub(super) struct AskedNormals {
    /// The largest distance of a counterpart.
    pub(super) threshold: f64,
    /// The largest angle between the tangent planes, in radians.
    pub(super) angle: f64,
    /// The width of the interval.
    pub(super) part_tolerance: f64,
    /// The parts after which the interval reached is returned.
    pub(super) max_cells: usize,
    /// Seconds after which it is.
    pub(super) max_seconds: Option<f64>,
}

/// Returns the part of the area of a model, moved, that has like counterparts in another one, and whether its
/// interval is as narrow as asked for; `None` for a cloud, which has no normals.
///
/// # Errors
/// [`Error::EmptyModel`]; [`Error::Cancelled`].
pub(super) async fn alike_part(
    [from, to]: [&PreparedModel; 2],
    transform: RigidTransform,
    asked: AskedNormals,
    monitor: &mut dyn Monitor,
) -> Result<Option<(Interval, bool)>> {
    if from.is_cloud() || to.is_cloud() {
        return Ok(None);
    }
    let mut progress = Progress::new(monitor, false);
    let clock = Clock::start(asked.max_seconds);
    let sufficient = SUFFICIENT_PART * asked.threshold;
    let boxes = [from, to].map(PreparedModel::bounding_box);
    let length =
        boxes[0].diagonal() + transform.apply(boxes[0].center()).length() + boxes[1].farthest_from_origin();
    let flat = to.facets().is_none().then(|| to.certified_target());
    let target = match (to.facets(), &flat) {
        (Some(PreparedFacets { target, error, .. }), _) => {
            NormalTarget::Triangles { facets: target, error: *error }
        }
        (None, Some(flat)) => NormalTarget::of_patches(&flat.target),
        (None, None) => return Err(Error::EmptyModel),
    };
    let search = |rounding: f64| {
        let reach = Reach::new(asked.threshold, [rounding, length]);
        Search { likenesses: Likenesses::new(&target, reach, asked.angle), asked, clock }
    };
    let found = if let Some(flat) = &flat {
        let own = from.certified_target();
        let pair = Pair { a: own.operand(from), b: flat.operand(to), transform };
        let triangles = from.facets().map(|facets| (&facets.target, facets.error));
        let mut cells = Cells::new(pair, triangles, sufficient);
        search(cells.rounding()).audited(&mut cells, &mut progress).await?
    } else {
        let measured = to.measured(None).ok_or(Error::EmptyModel)?;
        let source = match from.facets() {
            Some(PreparedFacets { target, error, .. }) => Source::Facets { facets: target, error: *error },
            None => from.patches_as_source(&from.bezier().patches),
        };
        let mut parts = Parts::new(source, measured, transform, sufficient);
        search(parts.rounding()).audited(&mut parts, &mut progress).await?
    };
    Ok(Some(found))
}

struct Search<'a> {
    likenesses: Likenesses<'a>,
    asked: AskedNormals,
    clock: Clock,
}

/// A part of a model in parts.
struct PartOf<'a, C: Cover> {
    cover: &'a C,
    part: &'a C::Part,
}

impl<C: Cover> ByFormula for PartOf<'_, C> {
    fn points(&self) -> Vec<DVec3> {
        self.cover.points(self.part)
    }

    fn beside(&self) -> Option<[OrientedPoint; 2]> {
        self.cover.beside(self.part)
    }
}

/// A part with what is known of it.
type Compared<P> = (P, Likeness);

impl Search<'_> {
    fn is_late(&self) -> bool {
        self.clock.is_over()
    }

    fn compared<C: Cover>(&self, cover: &C, part: C::Part) -> Compared<C::Part> {
        let spread = part.spread();
        let formula = PartOf { cover, part: &part };
        let likeness = self.likenesses.of(&cover.shape(&part), [spread.lower, spread.upper], &formula);
        (part, likeness)
    }

    /// Returns the area of a part, and the ends of the share of it that is alike.
    fn area_and_share<P: Weighted>(&self, (part, likeness): &Compared<P>) -> (Interval, [f64; 2]) {
        let Area { lower, upper } = part.weight();
        (Interval { lower, upper }, share(*likeness, || part.beyond(self.asked.threshold)))
    }

    /// Returns the halves of a part. Both ways to halve it are tried, the longer side first, and the halves with more
    /// answers are kept: the line between what is alike and what is not often runs along one side of a part.
    fn halved<C: Cover>(
        &self,
        cover: &C,
        (part, likeness): &Compared<C::Part>,
    ) -> Option<[Compared<C::Part>; 2]> {
        if *likeness == Likeness::ByDistance {
            return Some(cover.halves(part)?.map(|half| self.compared(cover, half)));
        }
        let compared = |halves: [C::Part; 2]| halves.map(|half| self.compared(cover, half));
        let open = |halves: &[Compared<C::Part>; 2]| {
            let is_open = |likeness| matches!(likeness, Likeness::Open | Likeness::ByDistance);
            halves.iter().filter(|(_, likeness)| is_open(*likeness)).count()
        };
        let [longer, other] = cover.cuts(part);
        let longer = longer.map(compared);
        let other =
            if longer.as_ref().is_some_and(|halves| open(halves) < 2) { None } else { other.map(compared) };
        let halves = longer.into_iter().chain(other).min_by_key(open)?;
        Some(halves.map(|(half, likeness)| match likeness {
            Likeness::Open | Likeness::ByDistance => self.compared(cover, cover.measured(&half)),
            decided => (cover.weighed(&half), decided),
        }))
    }

    /// Returns the part and whether it is narrow; where a bound of a distance is refuted, that without its lemma.
    async fn audited<C: Cover>(
        &self,
        cover: &mut C,
        progress: &mut Progress<'_>,
    ) -> Result<(Interval, bool)> {
        let (parts, found) = self.run(cover, progress).await?;
        if audit(cover, &parts, Audit::default(), &mut AuditReport::default()).is_none() {
            return Ok(found);
        }
        cover.strike();
        Ok(self.run(cover, progress).await?.1)
    }

    /// Halves parts that are open until the interval is narrow or a budget is spent; returns the parts, too.
    async fn run<C: Cover>(
        &self,
        cover: &C,
        progress: &mut Progress<'_>,
    ) -> Result<(Vec<C::Part>, (Interval, bool))> {
        let first = |range: Range<usize>| {
            let parts = cover.first(range, &|| self.is_late())?;
            Some(parts.into_iter().map(|part| self.compared(cover, part)).collect())
        };
        let mut parts: Vec<Compared<C::Part>> = bounded(cover.len(), PARTS_AT_ONCE, progress, first).await?;
        let mut outlook = Outlook::new(PATIENCE);
        let limits = [self.asked.part_tolerance, self.asked.max_cells as f64];
        loop {
            let part = Shares::of(parts.iter().map(|part| self.area_and_share(part))).part();
            let width = part.upper - part.lower;
            let is_narrow = width <= self.asked.part_tolerance;
            if is_narrow
                || outlook.is_hopeless(parts.len(), width, limits)
                || self.likenesses.reach().is_hopeless()
                || !self.halve(cover, &mut parts, progress).await?
            {
                return Ok((parts.into_iter().map(|(part, _)| part).collect(), (part, is_narrow)));
            }
        }
    }

    /// Halves the parts that widen the interval most, and returns whether there were any and the budgets permit it.
    async fn halve<C: Cover>(
        &self,
        cover: &C,
        parts: &mut Vec<Compared<C::Part>>,
        progress: &mut Progress<'_>,
    ) -> Result<bool> {
        let mut count = 0;
        let total: f64 = parts.iter().map(|(part, _)| part.weight().upper).sum();
        // An area that is not known well widens the part as an open one does.
        let open = parts.iter().map(|part| {
            let (area, share) = self.area_and_share(part);
            unknown(area, share)
        });
        let room = self.asked.max_cells.saturating_sub(parts.len());
        let chosen = largest_open(open, self.asked.part_tolerance * total, room);
        for page in chosen.chunks(PARTS_AT_ONCE) {
            if self.is_late() {
                break;
            }
            count += halve_page(parts, page, |part| self.halved(cover, part));
            progress.checkpoint((parts.len() as f64 / self.asked.max_cells as f64).min(1.0)).await?;
        }
        Ok(count > 0)
    }
}
