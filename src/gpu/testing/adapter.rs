//! The GPU that the kernels' own tests run on.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a panic is how a test fails")]

use crate::error::Error;
use crate::gpu::Gpu;
use std::rc::Rc;

/// Without an adapter a failure, or `None` and a visible line if the
/// environment allows it.
pub(crate) fn gpu(test: &str) -> Option<Rc<Gpu>> {
    match pollster::block_on(Gpu::new()) {
        Ok(gpu) => Some(Rc::new(gpu)),
        Err(Error::NoAdapter { .. }) if std::env::var_os("NURBS_HAUSDORFF_ALLOW_NO_GPU").is_some() => {
            // Past libtest, which hides what a passing test prints by macro.
            let line = format!("\nSKIPPED {test}: no adapter\n");
            std::io::Write::write_all(&mut std::io::stderr(), line.as_bytes()).unwrap();
            None
        }
        Err(error) => panic!("{error}"),
    }
}
