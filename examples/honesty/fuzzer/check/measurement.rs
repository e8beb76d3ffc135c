//! The computation of a pair, on the backend and at the scale that were drawn.

use super::super::pairs::Pair;
use super::super::partners::scale_and_shift;
use nurbs_hausdorff::internals::engine::{
    Backend, Details, DistanceOptions, DistanceResult, Engine, PreparedModel,
};
use nurbs_hausdorff::{Error, Model, RigidTransform};

thread_local! {
    /// An engine on the GPU, if there is one: its set-up takes longer than a pair.
    static GPU: Engine = Engine::new_blocking(Backend::Auto).unwrap();
    static CPU: Engine = Engine::cpu();
}

/// Measures a pair scaled by its power of two, and returns the result scaled back, with the
/// deviations of the pieces of both models' trimmed faces.
pub(super) fn measure(pair: &Pair, options: &DistanceOptions) -> Result<(DistanceResult, [f64; 2]), Error> {
    let scale = 2.0_f64.powi(pair.exponent);
    let mut scaled = [pair.a.clone(), pair.b.clone()];
    let mut options = options.clone();
    if pair.exponent != 0 {
        for model in &mut scaled {
            let mut surfaces: Vec<_> =
                model.surfaces().iter().map(|surface| surface.clone().into_arrays()).collect();
            scale_and_shift(&mut surfaces, scale, [0.0; 3]);
            *model = Model::from_arrays(None, surfaces)?;
        }
        options.limit = options.limit.map(|limit| limit * scale);
        let offset = pair.transform.offset() * scale;
        options.transform = RigidTransform::new(pair.transform.rotation(), offset)?;
        options.tolerance = options.tolerance.map(|tolerance| tolerance * scale);
    }
    let [a, b] = [PreparedModel::new(&scaled[0])?, PreparedModel::new(&scaled[1])?];
    let engine = if pair.backend == Backend::Cpu { &CPU } else { &GPU };
    let mut result = engine.with(|engine| {
        // `Auto` would not use an adapter in software.
        options.backend = if engine.has_gpu() { Backend::Gpu } else { Backend::Cpu };
        engine.distance(&a, &b, &options).wait()
    })?;
    scale_back(&mut result, scale.recip());
    Ok((result, [a.deviation(), b.deviation()].map(|deviation| deviation / scale)))
}

/// Multiplies all lengths of a result that are checked.
fn scale_back(result: &mut DistanceResult, scale: f64) {
    for length in [&mut result.diagonal, &mut result.computed, &mut result.lower, &mut result.upper]
        .into_iter()
        .chain(&mut result.witness.a.point)
        .chain(&mut result.witness.b.point)
    {
        *length *= scale;
    }
    if let Details::Certified(details) = &mut result.details {
        details.tolerance *= scale;
        details.min_tolerance *= scale;
    }
    for directed in [&mut result.forward, &mut result.reverse].into_iter().flatten() {
        scale_back(directed, scale);
    }
}

/// Whether an error is one by which a pair may be refused.
pub(super) fn is_refusal(error: &Error) -> bool {
    matches!(
        error.code(),
        "PAIR_BUDGET_EXCEEDED" | "NUMBER_TOO_LARGE" | "WEIGHT_RATIO_TOO_LARGE" | "FACE_NOT_CUT"
    )
}
