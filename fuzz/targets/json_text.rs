#![no_main]
//! The target `json_text`.

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| nurbs_hausdorff_fuzz::fuzz::json_text::check(bytes));
