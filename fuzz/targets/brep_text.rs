#![no_main]
//! The target `brep_text`.

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| nurbs_hausdorff_fuzz::fuzz::brep_text::check(bytes));
