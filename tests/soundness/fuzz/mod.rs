//! The properties that the fuzzers of `fuzz/` and the replay of their seeds check.
//!
//! Each file is one target: a function of bytes that panics where a property is
//! violated. Every sequence of bytes is a valid input.
#![allow(unreachable_pub, reason = "the crate in `fuzz/` makes this module public")]

pub mod arrays;
pub mod brep_text;
pub mod closest_point;
pub mod extraction;
pub mod iges_text;
pub mod json_text;
pub mod mesh_file;
pub mod options;
pub mod search;
pub mod step_text;
mod support;
pub mod trims;

/// A target.
pub type Check = fn(&[u8]);

/// The targets by name.
pub const TARGETS: [(&str, Check); 11] = [
    ("arrays", arrays::check),
    ("brep_text", brep_text::check),
    ("closest_point", closest_point::check),
    ("extraction", extraction::check),
    ("iges_text", iges_text::check),
    ("json_text", json_text::check),
    ("mesh_file", mesh_file::check),
    ("options", options::check),
    ("search", search::check),
    ("step_text", step_text::check),
    ("trims", trims::check),
];
