#![no_main]
//! The target `mesh_file`.

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| nurbs_hausdorff_fuzz::fuzz::mesh_file::check(bytes));
