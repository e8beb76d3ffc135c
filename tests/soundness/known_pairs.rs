//! The known pairs natively; `tests/wasm.rs` runs them in a browser.

use crate::pairs;
use crate::support::gpu;

macro_rules! declare {
    ($($name:ident)*) => {
        $(
            #[test]
            fn $name() {
                pollster::block_on(pairs::$name());
            }
        )*
    };
}
pairs::for_each_pair!(declare);

#[test]
fn hierarchy_point() {
    let Some(engine) = gpu::engine("hierarchy_point") else { return };
    pollster::block_on(pairs::hierarchy_point(&engine));
}

#[test]
fn gpu_deep_with_kernels() {
    let Some(engine) = gpu::engine("gpu_deep_with_kernels") else { return };
    pollster::block_on(pairs::gpu_deep_with_kernels(&engine));
}
