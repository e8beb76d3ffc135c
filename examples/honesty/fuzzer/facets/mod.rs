//! Pairs with a mesh or a cloud of points as one model or both.

mod brute;
mod draw;

use super::check::Outcome;
pub(in crate::fuzzer) use brute::to_triangle;
use brute::{Brute, Within, points};
use draw::{Drawn, FacetPair};
use fastrand::Rng;
use glam::DVec3;
use nurbs_hausdorff::{
    CertifiedOptions, DiffOptions, DiffResult, DistanceOptions, DistanceResult, Engine, Method,
    PreparedModel, RigidTransform, SurfacePoint,
};
use std::time::Instant;

/// The rounding of coordinates, of both computations, relative to the largest one.
const ROUNDING: f64 = 64.0 * f64::EPSILON;

/// The faces of a pair up to which it is compared face by face too.
const MAX_FACES: usize = 8;

/// Checks the pair of a seed: the interval, its witness and its verdict, and those of its faces.
pub(crate) fn check_facets(seed: u64) -> Outcome {
    let pair = FacetPair::new(seed);
    let [a, b] = [&pair.models[0], &pair.models[1]].map(Drawn::prepared);
    let size = a.bounding_box().diagonal().max(b.bounding_box().diagonal());
    let budgets = CertifiedOptions { max_cells: Some(pair.max_cells), ..CertifiedOptions::default() };
    let options = DistanceOptions {
        method: Method::Certified(budgets),
        relative_tolerance: Some(pair.tolerance),
        limit: pair.limit.map(|limit| limit * size),
        symmetric: pair.symmetric,
        transform: pair.transform,
        ..DistanceOptions::default()
    };
    let engine = Engine::cpu();
    let started = Instant::now();
    let result = match engine.distance(&a, &b, &options).wait() {
        Ok(result) => result,
        Err(error) => {
            let violations = vec![format!("seed {seed}: refused by {}", error.code())];
            return Outcome { violations, ..Outcome::default() };
        }
    };
    let mut check = Check::new(seed, &pair, [&a, &b]);
    let forward = result.forward.as_deref().unwrap_or(&result);
    check.direction(forward, 0, pair.tolerance * size, options.limit);
    if let Some(reverse) = &result.reverse {
        check.direction(reverse, 1, pair.tolerance * size, options.limit);
    }
    if size > 0.0 && a.face_count() + b.face_count() <= MAX_FACES {
        let options = DiffOptions {
            limit: 1e-2 * size,
            max_cells: pair.max_cells,
            transform: pair.transform,
            ..DiffOptions::default()
        };
        match engine.diff(&a, &b, &options).wait() {
            Ok(faces) => check.faces(&faces, forward, result.reverse.as_deref()),
            Err(error) => check.violations.push(format!("diff refused by {}", error.code())),
        }
    }
    let kind = format!("{} to {}", pair.models[0].kind(), pair.models[1].kind());
    Outcome {
        converged: result.converged,
        cells: result.certified().map_or(0, |details| details.cells),
        seconds: started.elapsed().as_secs_f64(),
        undecided: usize::from(check.undecided > 0),
        violations: check.violations.iter().map(|what| format!("seed {seed} ({kind}): {what}")).collect(),
        ..Outcome::default()
    }
}

struct Check<'a> {
    rng: Rng,
    pair: &'a FacetPair,
    /// Both models in the frame of B.
    poses: [RigidTransform; 2],
    brute: [Brute; 2],
    rounding: f64,
    violations: Vec<String>,
    undecided: usize,
}

impl<'a> Check<'a> {
    fn new(seed: u64, pair: &'a FacetPair, models: [&PreparedModel; 2]) -> Self {
        let poses = [pair.transform, RigidTransform::IDENTITY];
        let lengths = models.map(|model| model.bounding_box().farthest_from_origin());
        let length = lengths[0] + lengths[1] + pair.transform.offset().length();
        let brute = [0, 1].map(|index| Brute::new(&pair.models[index], poses[index]));
        let rounding = ROUNDING * length;
        let (violations, undecided) = (Vec::new(), 0);
        Self { rng: Rng::with_seed(seed), pair, poses, brute, rounding, violations, undecided }
    }

    /// Checks the interval of a direction from the model of this index.
    fn direction(&mut self, result: &DistanceResult, from: usize, tolerance: f64, limit: Option<f64>) {
        let DistanceResult { lower, upper, computed, converged, .. } = *result;
        if !(0.0 <= lower && lower <= upper && upper.is_finite()) {
            self.violations.push(format!("the interval [{lower}, {upper}]"));
        }
        if converged && limit.is_none() && upper - lower > tolerance + self.rounding {
            self.violations.push(format!("converged, but [{lower}, {upper}] is {} wide", upper - lower));
        }
        self.largest(lower, upper, from);
        let ends = [&result.witness.a, &result.witness.b];
        let at = ends.map(|end| DVec3::from_array(end.point));
        for (index, end) in ends.into_iter().enumerate() {
            self.on_model(index, end);
        }
        if (at[0].distance(at[1]) - computed).abs() > self.rounding {
            self.violations
                .push(format!("the witnesses are {} apart, computed {computed}", at[0].distance(at[1])));
        }
        let least = self.brute[1 - from].distance(at[from]);
        if least < lower - self.rounding {
            self.violations.push(format!("the witness is {least} from the other model, lower {lower}"));
        }
        let decided = limit
            .and_then(|limit| if upper <= limit { Some(true) } else { (lower > limit).then_some(false) });
        let within = result.certified().and_then(|details| details.within);
        if within.is_some() && limit.is_some() && within != decided {
            self.violations.push(format!("within {within:?}, [{lower}, {upper}], limit {limit:?}"));
        }
    }

    /// Checks that no drawn point is farther than `upper`.
    fn largest(&mut self, lower: f64, upper: f64, from: usize) {
        for point in points(&self.pair.models[from], self.poses[from], &mut self.rng) {
            match self.brute[1 - from].is_within(point, upper + self.rounding) {
                Within::Yes => {}
                Within::No => {
                    let distance = self.brute[1 - from].distance(point);
                    self.violations.push(format!("a point is {distance} away, [{lower}, {upper}]"));
                    return;
                }
                Within::Unknown => self.undecided += 1,
            }
        }
    }

    /// Checks that a point of facets is the one that its index or its weights name.
    fn on_model(&mut self, index: usize, end: &SurfacePoint) {
        let at = match &self.pair.models[index] {
            Drawn::Surfaces(_) => return,
            Drawn::Cloud(points) => end.index.and_then(|point| points.get(point).copied()),
            Drawn::Mesh(mesh) => end.triangle.zip(end.barycentric).and_then(|(triangle, weights)| {
                let corners = mesh.triangles().get(triangle)?.map(|k| mesh.vertices()[k as usize]);
                Some((0..3).map(|corner| corners[corner] * weights[corner]).sum())
            }),
        };
        let error = at.map(|at| self.poses[index].apply(at).distance(DVec3::from_array(end.point)));
        if error.is_none_or(|error| error > self.rounding) {
            self.violations.push(format!("a witness is {error:?} from the point that it names"));
        }
    }

    /// Checks that the intervals of faces are those of parts of their models.
    fn faces(&mut self, faces: &DiffResult, forward: &DistanceResult, reverse: Option<&DistanceResult>) {
        for (index, (of_model, whole)) in
            [(&faces.faces_of_a, Some(forward)), (&faces.faces_of_b, reverse)].into_iter().enumerate()
        {
            let upper = of_model.iter().map(|face| face.upper).fold(0.0, f64::max);
            let lower = of_model.iter().map(|face| face.lower).fold(0.0, f64::max);
            if whole.is_some_and(|whole| lower > whole.upper || upper < whole.lower) {
                self.violations.push(format!("the faces are in [{lower}, {upper}], the model is not"));
            }
            self.largest(lower, upper, index);
            for face in of_model {
                let ends = [&face.witness.a, &face.witness.b];
                let least = self.brute[1 - index].distance(DVec3::from_array(ends[index].point));
                if least < face.lower - self.rounding || ends[index].face != face.face {
                    let (number, lower) = (face.face, face.lower);
                    self.violations
                        .push(format!("face {number}: the witness is {least} away, lower {lower}"));
                }
                self.on_model(index, ends[index]);
            }
        }
    }
}
