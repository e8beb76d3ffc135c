#![no_main]
//! The target `options`.

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| nurbs_hausdorff_fuzz::fuzz::options::check(bytes));
