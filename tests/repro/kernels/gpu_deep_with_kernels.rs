use super::super::models::nets;
use super::super::{budgeted, measure, measure_by};
use nurbs_hausdorff::internals::engine::{Backend, DistanceOptions, Engine};

/// The pair of [`super::gpu_deep`] with kernels, which must not take cells 2^-25 of a patch wide: float32
/// does not hold them exactly.
pub(crate) async fn gpu_deep_with_kernels(engine: &Engine) {
    let [a, b] = nets!(gpu_deep);
    let options = DistanceOptions { relative_tolerance: Some(1e-5), ..budgeted() };
    let on_cpu = measure(&a, &b, &options).await;
    let on_gpu = measure_by(engine, &a, &b, &DistanceOptions { backend: Backend::Gpu, ..options }).await;
    assert!(on_cpu.converged && on_gpu.converged, "[{}, {}]", on_gpu.lower, on_gpu.upper);
    assert!(on_cpu.lower <= on_gpu.upper && on_gpu.lower <= on_cpu.upper);
}
