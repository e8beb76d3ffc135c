//! The GPU that the kernels' tests run on.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a panic is how a test fails")]

use crate::error::Error;
use crate::gpu::Gpu;
use std::sync::Arc;

/// Opens the GPU. Without an adapter the test fails, or, if the environment
/// variable `NURBS_HAUSDORFF_ALLOW_NO_GPU` is set, prints a line and returns `None`.
pub(crate) fn gpu(test: &str) -> Option<Arc<Gpu>> {
    match pollster::block_on(Gpu::new()) {
        Ok(gpu) => Some(Arc::new(gpu)),
        Err(Error::NoAdapter { .. }) if std::env::var_os("NURBS_HAUSDORFF_ALLOW_NO_GPU").is_some() => {
            // Written directly, since libtest hides what a passing test prints by macro.
            let line = format!("\nSKIPPED {test}: no adapter\n");
            std::io::Write::write_all(&mut std::io::stderr(), line.as_bytes()).unwrap();
            None
        }
        Err(error) => panic!("{error}"),
    }
}
