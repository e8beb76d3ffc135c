#![no_main]
//! The target `arrays`.

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| nurbs_hausdorff_fuzz::fuzz::arrays::check(bytes));
