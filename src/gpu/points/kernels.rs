//! The kernels of closest points: stages `locate` and `bound_others`.

use super::layouts::LocateParams;
use crate::gpu::iteration::kernels::{FOOT, NEWTON, PROJECTED, TREE};
use crate::gpu::kernel::Access::{Read, ReadWrite};
use crate::gpu::kernel::Constant;
use crate::gpu::kernel::{Evaluation, JET, Kernel, PATCH, Source};

const BOUND: Source = Source {
    constants: &[Constant::f32("UNIT", f32::EPSILON)],
    text: include_str!("../../../shaders/points/bound.wgsl"),
};
const LOCATE: Source = Source::new(include_str!("../../../shaders/points/locate.wgsl"));

/// Stage `locate` on subpatches of these degrees.
pub(crate) fn locate(degree: [usize; 2]) -> Kernel {
    kernel("locate", degree)
}

/// Stage `bound_others` on subpatches of these degrees.
pub(crate) fn bound_others(degree: [usize; 2]) -> Kernel {
    kernel("bound_others", degree)
}

/// The entry point of this name.
fn kernel(name: &'static str, degree: [usize; 2]) -> Kernel {
    Kernel {
        name,
        entry_point: name,
        evaluation: Evaluation::Squares(degree),
        sources: &[JET, PATCH, PROJECTED, FOOT, NEWTON, TREE, BOUND, LOCATE],
        params_bytes: size_of::<LocateParams>(),
        storage: &[Read, ReadWrite, Read, Read, Read, Read],
    }
}
