#![no_main]
//! The target `trims`.

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| nurbs_hausdorff_fuzz::fuzz::trims::check(bytes));
