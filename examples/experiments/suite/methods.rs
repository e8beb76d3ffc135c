//! The methods compared.

use nurbs_hausdorff::internals::closest::Projection;
use nurbs_hausdorff::internals::engine::{
    Backend, DistanceOptions, HierarchyOptions, IterationOptions, Method, MethodName,
};
use nurbs_hausdorff::internals::flatness::Flatness;
use nurbs_hausdorff::internals::iteration::Culling;

/// A method with its settings.
#[derive(Debug, Clone)]
pub(crate) struct Entry {
    pub(crate) name: &'static str,
    pub(crate) options: DistanceOptions,
    /// Whether every sample is projected on every patch, as in the 2012 paper.
    pub(crate) on_all_patches: bool,
}

/// The ratio of the finer boxes to the samples along each axis.
const FINER: usize = 4;

/// Returns the options of method `certified` in float64 on the CPU, whose cells and
/// times do not depend on a GPU or its substitute.
pub(crate) fn certified() -> DistanceOptions {
    DistanceOptions { backend: Backend::Cpu, ..DistanceOptions::default() }
}

/// Returns all methods, `certified` first, with `samples` along each axis of a surface.
pub(crate) fn methods(samples: usize) -> Vec<Entry> {
    let iteration =
        DistanceOptions { method: MethodName::Iteration.into(), samples, ..DistanceOptions::default() };
    let published = |name, flatness| Entry {
        name,
        options: DistanceOptions {
            method: Method::Iteration(IterationOptions {
                flatness,
                projection: Projection::TangentPlane,
                culling: Culling::None,
                ..Default::default()
            }),
            ..iteration.clone()
        },
        on_all_patches: true,
    };
    let boxes = |name, grid| Entry {
        name,
        options: DistanceOptions {
            method: Method::Hierarchy(HierarchyOptions { grid, ..Default::default() }),
            ..DistanceOptions::default()
        },
        on_all_patches: false,
    };
    vec![
        Entry { name: "certified", options: certified(), on_all_patches: false },
        Entry { name: "iteration", options: iteration.clone(), on_all_patches: false },
        published("2012 paper: none", Flatness::None),
        published("2012 paper: loose", Flatness::Loose),
        published("2012 paper: tight", Flatness::Tight),
        boxes("hierarchy", samples),
        boxes("hierarchy: finer", FINER * samples),
    ]
}
