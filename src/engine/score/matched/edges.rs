//! The part of the length of a model's feature edges that has counterparts among those of another one.

use super::cuts::is_cut;
use super::shares::{Shares, largest_open, share, unknown};
use crate::engine::PreparedModel;
use crate::engine::clock::Clock;
use crate::engine::outlook::Outlook;
use crate::error::Result;
use crate::facets::{Facet, PreparedFacets};
use crate::features::{Counterparts, Faces, FeatureEdges, Piece, Sharpness};
use crate::interval::Interval;
use crate::model::RigidTransform;
use crate::normals::{Likeness, Reach};
use crate::progress::{Monitor, Progress};
use crate::solid::{Edges, joined_arcs};
use crate::threads::parallel::map_ranges;
use glam::DVec3;
use std::ops::Range;

/// The pieces from which on a search ends that is not to be expected to become narrow.
const PATIENCE: usize = 2048;

/// The number of pieces between two checkpoints.
const PIECES_AT_ONCE: usize = 1024;

/// The question about the edges of both models, and the budgets of each direction.
#[derive(Debug, Clone, Copy)]
pub(super) struct AskedEdges {
    /// The largest distance of a counterpart.
    pub(super) threshold: f64,
    /// The width of the interval.
    pub(super) part_tolerance: f64,
    /// The pieces after which the interval reached is returned.
    pub(super) max_pieces: usize,
    /// Seconds after which it is.
    pub(super) max_seconds: Option<f64>,
    /// The largest total length with which a model counts as one without feature edges.
    pub(super) least: f64,
}

/// The part with counterparts, the length of all feature edges, and whether both are narrow.
pub(super) struct MatchedEdges {
    pub(super) part: Interval,
    pub(super) length: Interval,
    pub(super) is_narrow: bool,
}

/// Returns the edges of a model, moved, that may be feature edges, at which faces turn by more than `angle` radians;
/// `None` for a cloud, and for a mesh of too many triangles to join them.
pub(super) fn feature_edges(
    model: &PreparedModel,
    transform: RigidTransform,
    [angle, least]: [f64; 2],
) -> Option<FeatureEdges<'_>> {
    if model.is_cloud() {
        return None;
    }
    let (faces, edges, error) = match model.facets() {
        Some(facets) => {
            let PreparedFacets { target, error, .. } = facets;
            let edges = facets.may_close().then(|| Edges::of_triangles(facets.joined_triangles()))?;
            (Faces::Triangles(target, *error), edges, facets.point_error())
        }
        None => {
            let bezier = model.bezier();
            let edges = Edges::of_surfaces(bezier, |surface| model.pieces().origin(surface));
            (Faces::of_patches(&bezier.patches), edges, bezier.point_error)
        }
    };
    let corners = |triangle: u32| match model.facets().map(|facets| facets.target.facet(triangle)) {
        Some(Facet::Triangle(corners)) => corners,
        _ => [DVec3::NAN; 3],
    };
    let mut joined = joined_arcs(edges, &corners, &model.control_box(), model.gap());
    if model.facets().is_none() {
        joined.retain(|edge| !is_cut(model, edge));
    }
    Some(FeatureEdges::new(faces, joined, transform, [angle, error.after(0), least]))
}

/// Returns the part of the feature edges of one model with counterparts among those of another one. For edges that count
/// as none it says nothing: see [`with_none`].
///
/// # Errors
/// [`crate::Error::Cancelled`].
pub(super) async fn matched_edges(
    [from, to]: [&FeatureEdges<'_>; 2],
    asked: AskedEdges,
    monitor: &mut dyn Monitor,
) -> Result<MatchedEdges> {
    let mut progress = Progress::new(monitor, false);
    let boxes = [from, to].map(FeatureEdges::bounding_box);
    let length = boxes.iter().flatten().map(|aabb| aabb.farthest_from_origin()).sum::<f64>();
    let counterparts =
        Counterparts::new(to, Reach::new(asked.threshold, [from.error() + to.error(), length]));
    let search = Search { from, counterparts, asked, clock: Clock::start(asked.max_seconds) };
    let (part, length, is_narrow) = search.run(&mut progress).await?;
    Ok(MatchedEdges { part, length, is_narrow })
}

/// Returns the part of one model's edges with counterparts where either model may have edges that count as none, shorter
/// together than `least`: of none and none the part is 1, and where one model alone has none it is 0.
pub(super) fn with_none([own, other]: [&MatchedEdges; 2], least: f64) -> Interval {
    let presence = |length: Interval| match (length.lower > least, length.upper <= least) {
        (true, _) => Some(true),
        (_, true) => Some(false),
        _ => None,
    };
    match (presence(own.length), presence(other.length)) {
        (Some(true), Some(true)) => own.part,
        (Some(false), Some(false)) => Interval::exactly(1.0),
        (Some(true), Some(false)) | (Some(false), Some(true)) => Interval::exactly(0.0),
        (Some(true), None) => Interval { lower: 0.0, upper: own.part.upper },
        (None, _) | (_, None) => Interval { lower: 0.0, upper: 1.0 },
    }
}

/// Returns the ends of the share of a piece that has counterparts: distances alone tell nothing of an edge.
fn of_edge(likeness: Likeness) -> [f64; 2] {
    share(likeness, || [0.0, 1.0])
}

struct Search<'a> {
    from: &'a FeatureEdges<'a>,
    counterparts: Counterparts<'a>,
    asked: AskedEdges,
    clock: Clock,
}

/// A piece that may be of a feature edge, with what is known of its counterparts.
type Compared<'a> = (&'a Piece, Likeness);

impl<'a> Search<'a> {
    fn compared(&self, piece: &'a Piece) -> Option<Compared<'a>> {
        match piece.sharpness() {
            Sharpness::Smooth => None,
            // Whether it counts is not known.
            Sharpness::Open | Sharpness::NoNormal => Some((piece, Likeness::Open)),
            Sharpness::Sharp => Some((piece, self.counterparts.of(piece))),
        }
    }

    async fn run(&self, progress: &mut Progress<'_>) -> Result<(Interval, Interval, bool)> {
        let all: Vec<&'a Piece> = self.from.pieces().iter().collect();
        let mut pieces = Vec::with_capacity(all.len());
        for page in all.chunks(PIECES_AT_ONCE) {
            let compared = |range: Range<usize>| {
                page[range].iter().filter_map(|piece| self.compared(piece)).collect::<Vec<_>>()
            };
            pieces.extend(map_ranges(page.len(), compared).into_iter().flatten());
            progress.checkpoint(0.0).await?;
        }
        let mut outlook = Outlook::new(PATIENCE);
        let limits = [self.asked.part_tolerance, self.asked.max_pieces as f64];
        loop {
            let shares = pieces.iter().map(|(piece, likeness)| (piece.length(), of_edge(*likeness)));
            let part = Shares::of(shares).part();
            let length = length(&pieces);
            let tolerance = self.asked.part_tolerance;
            let is_known = length.upper - length.lower <= tolerance * length.upper;
            let is_narrow =
                part.upper - part.lower <= tolerance && is_known || length.upper <= self.asked.least;
            // While no piece is certainly a feature this is 0: pieces are halved until one is, or none can be.
            let permitted = tolerance * length.lower;
            let is_over = self.clock.is_over()
                || outlook.is_hopeless(pieces.len(), part.upper - part.lower, limits)
                || self.counterparts.reach().is_hopeless();
            if is_narrow || is_over || !self.halve(&mut pieces, permitted, progress).await? {
                return Ok((part, length, is_narrow));
            }
        }
    }

    /// Halves the pieces that widen the part or the length most, and returns whether there were any and the budget
    /// permits it.
    async fn halve(
        &self,
        pieces: &mut Vec<Compared<'a>>,
        permitted: f64,
        progress: &mut Progress<'_>,
    ) -> Result<bool> {
        // A length that is not known well widens both as an open piece does.
        let sizes = pieces.iter().map(|(piece, likeness)| unknown(piece.length(), of_edge(*likeness)));
        let room = self.asked.max_pieces.saturating_sub(pieces.len());
        let chosen = largest_open(sizes, permitted, room);
        let (mut halved, mut smooth) = (false, Vec::new());
        for page in chosen.chunks(PIECES_AT_ONCE) {
            let found = map_ranges(page.len(), |range: Range<usize>| {
                let halves = |&index: &usize| {
                    let halves = self.from.halves(pieces[index].0)?;
                    Some(halves.each_ref().map(|half| self.compared(half)))
                };
                page[range].iter().map(halves).collect::<Vec<_>>()
            });
            for (&index, halves) in page.iter().zip(found.into_iter().flatten()) {
                let Some(halves) = halves else { continue };
                halved = true;
                let mut kept = halves.into_iter().flatten();
                match kept.next() {
                    Some(first) => pieces[index] = first,
                    None => smooth.push(index),
                }
                pieces.extend(kept);
            }
            progress.checkpoint((pieces.len() as f64 / self.asked.max_pieces as f64).min(1.0)).await?;
        }
        smooth.sort_unstable();
        for index in smooth.into_iter().rev() {
            pieces.swap_remove(index);
        }
        Ok(halved)
    }
}

/// Returns the length of the pieces that are certainly features, and of all.
fn length(pieces: &[Compared<'_>]) -> Interval {
    pieces
        .iter()
        .fold(Interval::exactly(0.0), |sum, (piece, _)| {
            let Interval { lower, upper } = piece.length();
            let is_sharp = piece.sharpness() == Sharpness::Sharp;
            sum + Interval { lower: if is_sharp { lower } else { 0.0 }, upper }
        })
        .not_negative()
}
