#![no_main]
//! The target `extraction`.

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| nurbs_hausdorff_fuzz::fuzz::extraction::check(bytes));
