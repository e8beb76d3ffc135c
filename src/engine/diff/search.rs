//! The searches that decide the faces' states.

use super::face::FacePatches;
use super::{DiffOptions, DiffResult, FaceDifference, FaceState};
use crate::certified::{BranchAndBound, Interval, Limit, Operand, Pair};
use crate::engine::{Computation, Engine, PreparedModel, Seconds, Witness};
use crate::error::{Error, Result};
use crate::flatness::Flatness;
use crate::model::RigidTransform;
use crate::pieces::FacePieces;
use crate::progress::{Monitor, Progress};
use crate::threads::parallel::map;
use glam::DVec3;
use web_time::Instant;

/// The part of the limit to which the distance of a face is searched while its
/// state is undecided: a face whose distance differs from the limit by more than
/// a hundredth is decided.
const DECISION_PART: f64 = 1e-2;

/// The part of its distance to which that of a changed face is known: three digits
/// say how large a change is.
const CHANGE_PART: f64 = 1e-3;

/// The largest number of cells for those digits, a quarter of a second: nearly all changed faces
/// take fewer than 1,000, and a plate whose hole moved takes a million. Its state is known.
const NARROWING_CELLS: usize = 65_536;

/// The number of faces that are begun at once, enough for all threads, few enough
/// that an event loop gets its turn in time.
const FACES_AT_ONCE: usize = 16;

/// After this many cells a face leaves the parallel pass and is searched alone: nearly all faces need fewer.
const FIRST_CELLS: usize = 256;

impl Engine {
    /// Compares every face of A, moved by the options' transform, with B, and every
    /// face of B with A, by method `certified` in float64.
    ///
    /// Guarantee: each face's directed distance to the other model is in its interval,
    /// and its state follows from the interval. Searches end when they decide the
    /// state, and those of changed faces when three digits of the distance are known.
    ///
    /// # Errors
    /// [`crate::Error::OptionOutOfRange`]; [`crate::Error::UnitsDiffer`];
    /// [`crate::Error::Cancelled`].
    pub fn diff<'a>(
        &'a self,
        a: &'a PreparedModel,
        b: &'a PreparedModel,
        options: &'a DiffOptions,
    ) -> Computation<'a, DiffResult> {
        Computation::new(move |mut watched| {
            Box::pin(async move { self.diff_of(a, b, options, watched.monitor()).await })
        })
    }

    async fn diff_of(
        &self,
        a: &PreparedModel,
        b: &PreparedModel,
        options: &DiffOptions,
        monitor: &mut dyn Monitor,
    ) -> Result<DiffResult> {
        options.validate()?;
        let scaled = b.in_unit_of(a, options.scale_units)?;
        let b = scaled.as_deref().unwrap_or(b);
        a.require_surfaces("a comparison face by face")?;
        b.require_surfaces("a comparison face by face")?;
        let mut progress = Progress::new(monitor, true);
        let started = Instant::now();
        let [flat_a, flat_b] = [a, b].map(|model| model.target(Flatness::Loose));
        let (whole_a, whole_b) = (flat_a.operand(a), flat_b.operand(b));
        let faces_a = FacePatches::all(a, &flat_a);
        let faces_b = FacePatches::all(b, &flat_b);
        let prepare = started.elapsed().as_secs_f64();
        let transform = options.transform;
        let budget = Budget { started, max_cells: options.max_cells, max_seconds: options.max_seconds };
        let forward = Side {
            whole: whole_a,
            faces: &faces_a,
            other: whole_b,
            others: &faces_b,
            pieces: [a.pieces(), b.pieces()],
            gaps: (a.face_gaps(), b.gap()),
            transform,
            budget,
        };
        let of_a = forward.differences(options, &mut progress).await?;
        progress.second_half();
        let inverse = transform.inverse();
        let reverse = Side {
            whole: whole_b,
            faces: &faces_b,
            other: whole_a,
            others: &faces_a,
            pieces: [b.pieces(), a.pieces()],
            gaps: (b.face_gaps(), a.gap()),
            transform: inverse,
            budget,
        };
        let of_b = reverse.differences(options, &mut progress).await?;
        progress.finish();
        let of_b: Vec<_> = of_b.into_iter().map(|found| found.reversed(&transform)).collect();
        let largest = |state: fn(&FaceDifference) -> FaceState| {
            of_a.iter().chain(&of_b).map(state).max().unwrap_or(FaceState::Unchanged)
        };
        Ok(DiffResult {
            state: largest(|face| face.state),
            with_gaps: largest(|face| face.with_gaps),
            limit: options.limit,
            unit: a.unit().or(b.unit()),
            gap: a.gap() + b.gap(),
            gap_proven: a.is_gap_proven() && b.is_gap_proven(),
            diagonal: a.bounding_box().diagonal().max(b.bounding_box().diagonal()),
            faces_of_a: of_a,
            faces_of_b: of_b,
            seconds: Seconds { prepare, compile: 0.0, solve: started.elapsed().as_secs_f64() - prepare },
        })
    }
}

/// The faces of one model, and the model that they are compared with.
struct Side<'a> {
    whole: Operand<'a>,
    faces: &'a [FacePatches],
    other: Operand<'a>,
    others: &'a [FacePatches],
    /// The pieces of both models.
    pieces: [&'a FacePieces; 2],
    /// The gaps of the faces, and the largest of the other model.
    gaps: (&'a [f64], f64),
    transform: RigidTransform,
    budget: Budget,
}

impl FaceDifference {
    /// Returns the difference of a face of B, which was searched in A's own frame, in
    /// the frame of B.
    fn reversed(self, transform: &RigidTransform) -> Self {
        let Witness { a: of_face, b: of_other } = self.witness;
        let witness = Witness { a: of_other.moved(transform), b: of_face.moved(transform) };
        Self { witness, ..self }
    }
}

impl<'a> Side<'a> {
    /// The intervals of all faces, in order.
    async fn differences(
        &self,
        options: &DiffOptions,
        progress: &mut Progress<'_>,
    ) -> Result<Vec<FaceDifference>> {
        let mut found = Vec::with_capacity(self.faces.len());
        while found.len() < self.faces.len() {
            let first = found.len();
            let count = FACES_AT_ONCE.min(self.faces.len() - first);
            let searches = map(count, |index| {
                let mut search = self.decision(first + index, options);
                advance(&mut search, FIRST_CELLS);
                search
            });
            for search in searches {
                found.push(self.finished(found.len(), search, options, progress).await?);
            }
            progress.checkpoint(found.len() as f64 / self.faces.len() as f64).await?;
        }
        Ok(found)
    }

    /// The face and the other model as a pair.
    fn pair(&self, face: usize) -> Pair<'a> {
        let offset = self.transform.apply(DVec3::ZERO);
        let counterpart = self.faces[face].counterpart(self.others, offset);
        let other = counterpart.map_or(self.other, |face| self.other.with_uncut(face.patches()));
        Pair { a: self.faces[face].operand(&self.whole), b: other, transform: self.transform }
    }

    /// The search that decides the state of a face.
    fn decision(&self, face: usize, options: &DiffOptions) -> BranchAndBound<'a> {
        let limit = self.limit(face, options);
        BranchAndBound::new(self.pair(face), DECISION_PART * limit.at, Some(limit), 0.0)
    }

    /// The limit on the distance of a face, with the gaps between the sources.
    fn limit(&self, face: usize, options: &DiffOptions) -> Limit {
        let (gaps, of_other) = self.gaps;
        Limit { at: options.limit, gap: gaps[face] + of_other }
    }

    /// Ends the search of a face, and narrows the interval of a changed one.
    async fn finished(
        &self,
        face: usize,
        mut decision: BranchAndBound<'a>,
        options: &DiffOptions,
        progress: &mut Progress<'_>,
    ) -> Result<FaceDifference> {
        let fraction = face as f64 / self.faces.len() as f64;
        exhaust(&mut decision, self.budget, fraction, progress).await?;
        let interval = decision.interval();
        let decided = self.difference(face, &decision, interval, options)?;
        let is_narrow = interval.upper - interval.lower <= CHANGE_PART * interval.lower;
        if decided.state != FaceState::Changed || is_narrow || self.budget.is_over() {
            return Ok(decided);
        }
        let mut narrowing = BranchAndBound::new(self.pair(face), CHANGE_PART * interval.lower, None, 0.0);
        let max_cells = NARROWING_CELLS.min(options.max_cells);
        exhaust(&mut narrowing, Budget { max_cells, ..self.budget }, fraction, progress).await?;
        // Both intervals hold, and the witness is the farther one.
        let Interval { lower, upper } = narrowing.interval();
        let farther = if lower >= interval.lower { &narrowing } else { &decision };
        let both = Interval { lower: lower.max(interval.lower), upper: upper.min(interval.upper) };
        let found = self.difference(face, farther, both, options)?;
        Ok(FaceDifference { cells: decided.cells + narrowing.work().cells, ..found })
    }

    /// The difference of a face by this interval, with the witness of a search.
    fn difference(
        &self,
        face: usize,
        search: &BranchAndBound<'_>,
        interval: Interval,
        options: &DiffOptions,
    ) -> Result<FaceDifference> {
        let Interval { lower, upper } = interval;
        let limit = self.limit(face, options);
        let [state, with_gaps] = [limit.keeps(interval), limit.sources_keep(interval)].map(state);
        let witness = witness(search, self.pieces).ok_or(Error::EmptyModel)?;
        let (gap, cells) = (limit.gap, search.work().cells);
        Ok(FaceDifference { face, state, lower, upper, gap, with_gaps, witness, cells })
    }
}

/// What ends the search of a face.
#[derive(Clone, Copy)]
struct Budget {
    /// When the comparison began.
    started: Instant,
    max_cells: usize,
    max_seconds: Option<f64>,
}

impl Budget {
    fn is_spent(&self, search: &BranchAndBound<'_>) -> bool {
        search.work().cells >= self.max_cells || self.is_over()
    }

    /// Returns whether the time is over.
    fn is_over(&self) -> bool {
        self.max_seconds.is_some_and(|most| self.started.elapsed().as_secs_f64() >= most)
    }
}

/// Runs a search to its end, or until the budget is spent.
async fn exhaust(
    search: &mut BranchAndBound<'_>,
    budget: Budget,
    fraction: f64,
    progress: &mut Progress<'_>,
) -> Result<()> {
    while !budget.is_spent(search) && !advance(search, FIRST_CELLS.min(budget.max_cells)) {
        progress.checkpoint(fraction).await?;
    }
    search.finish();
    Ok(())
}

/// Bounds at most `cells` more cells; returns whether the search has ended.
fn advance(search: &mut BranchAndBound<'_>, cells: usize) -> bool {
    let end = search.work().cells + cells;
    while search.work().cells < end {
        if search.advance_once(end - search.work().cells).is_some() {
            return true;
        }
    }
    false
}

/// The state that follows from whether a face keeps the limit.
fn state(keeps: Option<bool>) -> FaceState {
    match keeps {
        Some(true) => FaceState::Unchanged,
        Some(false) => FaceState::Changed,
        None => FaceState::Undecided,
    }
}

/// The witness of a search, on the face and on the other model; `None` for a face
/// without patches, which validation rules out.
fn witness(search: &BranchAndBound<'_>, [from_pieces, to_pieces]: [&FacePieces; 2]) -> Option<Witness> {
    let witness = search.witness()?;
    let [from, to] = search.witness_patches(witness);
    let closest = &witness.closest;
    Some(Witness {
        a: from_pieces.surface_point(
            from.surface,
            from.surface_parameters(witness.parameters),
            witness.point,
        ),
        b: to_pieces.surface_point(to.surface, to.surface_parameters(closest.parameters), closest.point),
    })
}
