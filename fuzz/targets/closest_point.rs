#![no_main]
//! The target `closest_point`.

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| nurbs_hausdorff_fuzz::fuzz::closest_point::check(bytes));
