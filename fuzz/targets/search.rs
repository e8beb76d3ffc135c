#![no_main]
//! The target `search`.

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| nurbs_hausdorff_fuzz::fuzz::search::check(bytes));
