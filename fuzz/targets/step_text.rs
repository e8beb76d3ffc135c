#![no_main]
//! The target `step_text`.

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| nurbs_hausdorff_fuzz::fuzz::step_text::check(bytes));
