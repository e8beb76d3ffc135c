//! The searches that decide the faces' states.

use super::counterpart::pair_round_faces;
use super::face_search::{FaceSearch, Faces};
use super::pair::PairParts;
use super::{DiffOptions, DiffResult, FaceDifference, FaceState};
use crate::engine::clock::Clock;
use crate::engine::query::Opened;
use crate::engine::section::Section;
use crate::engine::{Computation, Engine, PreparedModel, Seconds, Witness};
use crate::error::{Error, Result};
use crate::interval::{Interval, Limit};
use crate::model::RigidTransform;
use crate::progress::{Monitor, Progress};
use crate::threads::parallel::map;

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
        let opened = Opened::new([a, b], options)?;
        let [a, b] = opened.models();
        let mut result = self.diff_of_faces(a, b, options, monitor).await?;
        result.hint = opened.hint();
        pair_round_faces(&mut result, [a, b], options);
        // The progress is that of the faces.
        let mut section = Section { whole: monitor, part: [1.0, 0.0] };
        let parts = self.parts([a, b], options, &result, opened.clock(), &mut section).await?;
        (result.parts, result.parts_unknown) = (parts.all, parts.unknown);
        if parts.differ_in_number {
            for state in [&mut result.state, &mut result.with_gaps] {
                *state = (*state).max(FaceState::Changed);
            }
        }
        result.seconds.solve = opened.clock().seconds() - result.seconds.prepare;
        Ok(result)
    }

    /// Compares the faces of models of one unit, without their parts and hints.
    pub(in crate::engine) async fn diff_of_faces(
        &self,
        a: &PreparedModel,
        b: &PreparedModel,
        options: &DiffOptions,
        monitor: &mut dyn Monitor,
    ) -> Result<DiffResult> {
        let mut progress = Progress::new(monitor, true);
        let clock = Clock::start(options.max_seconds);
        let of_pair = PairParts::new([a, b]);
        let prepare = clock.seconds();
        let transform = options.transform;
        let budget = Budget { clock, max_cells: options.max_cells };
        let forward =
            Side { faces: of_pair.faces(0).ok_or(Error::EmptyModel)?, models: [a, b], transform, budget };
        let of_a = forward.differences(options, &mut progress).await?;
        progress.second_half();
        let inverse = transform.inverse();
        let reverse = Side {
            faces: of_pair.faces(1).ok_or(Error::EmptyModel)?,
            models: [b, a],
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
            hint: None,
            gap: a.gap() + b.gap(),
            gap_proven: a.is_gap_proven() && b.is_gap_proven(),
            diagonal: a.bounding_box().diagonal().max(b.bounding_box().diagonal()),
            faces_of_a: of_a,
            faces_of_b: of_b,
            parts: Vec::new(),
            parts_unknown: None,
            seconds: Seconds { prepare, compile: 0.0, solve: clock.seconds() - prepare },
        })
    }
}

/// The faces of one model, and the model that they are compared with.
struct Side<'a> {
    faces: Faces<'a>,
    /// The model of the faces, and the other one.
    models: [&'a PreparedModel; 2],
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
            let limits: Vec<Limit> = (first..first + count).map(|face| self.limit(face, options)).collect();
            let (faces, transform, budget) = (&self.faces, self.transform, self.budget);
            let searches = map(count, |index| {
                let limit = limits[index];
                let tolerance = DECISION_PART * limit.at;
                let mut search = faces.search(first + index, transform, tolerance, Some(limit));
                // Each face has an interval, however late it is.
                search.advance(if budget.is_over() { 1 } else { FIRST_CELLS });
                search
            });
            for search in searches {
                found.push(self.finished(found.len(), search, options, progress).await?);
            }
            progress.checkpoint(found.len() as f64 / self.faces.len() as f64).await?;
        }
        Ok(found)
    }

    /// The limit on the distance of a face, with the gaps between the sources.
    fn limit(&self, face: usize, options: &DiffOptions) -> Limit {
        let [model, other] = self.models;
        Limit { at: options.limit, gap: model.face_gaps()[face] + other.gap() }
    }

    /// Ends the search of a face, and narrows the interval of a changed one.
    async fn finished(
        &self,
        face: usize,
        mut decision: FaceSearch<'a>,
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
        let mut narrowing = self.faces.search(face, self.transform, CHANGE_PART * interval.lower, None);
        let max_cells = NARROWING_CELLS.min(options.max_cells);
        exhaust(&mut narrowing, Budget { max_cells, ..self.budget }, fraction, progress).await?;
        // Both intervals hold, and the witness is the farther one.
        let Interval { lower, upper } = narrowing.interval();
        let farther = if lower >= interval.lower { &narrowing } else { &decision };
        let both = Interval { lower: lower.max(interval.lower), upper: upper.min(interval.upper) };
        let found = self.difference(face, farther, both, options)?;
        Ok(FaceDifference { cells: decided.cells + narrowing.cells(), ..found })
    }

    /// The difference of a face by this interval, with the witness of a search.
    fn difference(
        &self,
        face: usize,
        search: &FaceSearch<'_>,
        interval: Interval,
        options: &DiffOptions,
    ) -> Result<FaceDifference> {
        let Interval { lower, upper } = interval;
        let limit = self.limit(face, options);
        let [state, with_gaps] = [limit.keeps(interval), limit.sources_keep(interval)].map(state);
        let [a, b] = search.witness(self.models).ok_or(Error::EmptyModel)?;
        let (gap, cells, witness) = (limit.gap, search.cells(), Witness { a, b });
        let counterpart = None;
        Ok(FaceDifference { face, state, lower, upper, gap, with_gaps, witness, cells, counterpart })
    }
}

/// What ends the search of a face.
#[derive(Clone, Copy)]
struct Budget {
    /// That of the comparison.
    clock: Clock,
    max_cells: usize,
}

impl Budget {
    fn is_spent(&self, search: &FaceSearch<'_>) -> bool {
        search.cells() >= self.max_cells || self.is_over()
    }

    /// Returns whether the time is over.
    fn is_over(&self) -> bool {
        self.clock.is_over()
    }
}

/// Runs a search to its end, or until the budget is spent.
async fn exhaust(
    search: &mut FaceSearch<'_>,
    budget: Budget,
    fraction: f64,
    progress: &mut Progress<'_>,
) -> Result<()> {
    if let Some(deadline) = budget.clock.deadline() {
        search.stop_at(deadline);
    }
    while !budget.is_spent(search) && !search.advance(FIRST_CELLS.min(budget.max_cells)) {
        progress.checkpoint(fraction).await?;
    }
    search.finish();
    Ok(())
}

/// The state that follows from whether a face keeps the limit.
fn state(keeps: Option<bool>) -> FaceState {
    match keeps {
        Some(true) => FaceState::Unchanged,
        Some(false) => FaceState::Changed,
        None => FaceState::Undecided,
    }
}
