#![no_main]
//! The target `iges_text`.

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| nurbs_hausdorff_fuzz::fuzz::iges_text::check(bytes));
