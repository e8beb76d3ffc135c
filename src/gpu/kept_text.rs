//! WGSL of patches that a subgroup loads together and its threads keep.
//!
//! A processor's adapter has no instruction that loads from as many places as
//! it has lanes: llvmpipe loads every component lane by lane, with a bounds
//! check each. There all lanes of a subgroup load parts of one patch and hand
//! them round, and those that want the patch keep it for their projection.

use super::patch_text::{BLEND, list};
use std::fmt::Write;

/// Controls of a patch that threads keep, at most: rows are then written out,
/// which takes llvmpipe's compiler minutes for the largest patches.
pub(super) const MAX_KEPT: usize = 36;

/// `join`, which all threads of a subgroup must call first, and what they find
/// out together: broadcasts, which llvmpipe has instructions for, unlike
/// `subgroupAny`, `subgroupMin` and their kind, for which it loops over the
/// lanes. Of floats that are not all negative, the largest is found by their
/// bits, in whose order there is no NaN to look for.
pub(super) fn write_together(text: &mut String, lanes: usize) -> std::fmt::Result {
    writeln!(text, "const LANES: u32 = {lanes}u;\nvar<private> lane: u32;")?;
    writeln!(text, "fn join() {{ lane = subgroupExclusiveAdd(1u); }}")?;
    writeln!(text, "fn any_of(wanted: bool) -> bool {{ return most_of(select(0, 1, wanted)) == 1; }}")?;
    let largest = "bitcast<f32>(most_of(bitcast<i32>(own)))";
    writeln!(text, "fn largest(own: f32) -> f32 {{ return {largest}; }}")?;
    for (name, kind, of) in
        [("least_of", "u32", "min"), ("most_of", "i32", "max"), ("largest3", "vec3<f32>", "max")]
    {
        writeln!(text, "fn {name}(own: {kind}) -> {kind} {{")?;
        for k in 0..lanes {
            writeln!(text, "let a{k} = subgroupBroadcast(own, {k}u);")?;
        }
        let mut all = "a0".to_owned();
        for k in 1..lanes {
            all = format!("{of}({all}, a{k})");
        }
        writeln!(text, "return {all};\n}}")?;
    }
    Ok(())
}

/// `take`, after which `center_of`, `blend` and `nearest_control` work on the
/// patch taken by the threads that wanted it. All threads of a subgroup must
/// call it.
pub(super) fn write_kept(text: &mut String, [p, q]: [usize; 2], lanes: usize) -> std::fmt::Result {
    let size = (p + 1) * (q + 1);
    writeln!(text, "var<private> net: array<vec4<f32>, {size}>;")?;
    writeln!(text, "var<private> center: vec3<f32>;")?;
    writeln!(text, "fn center_of(patch_index: u32) -> vec3<f32> {{ return center; }}")?;
    writeln!(text, "fn take(patch_index: u32, wanted: bool) {{\nlet first = patch_index * PATCH_SIZE;")?;
    writeln!(text, "var middle = vec3<f32>(0.0);\nif lane == 0u {{ middle = centers[patch_index].xyz; }}")?;
    writeln!(text, "center = select(center, subgroupBroadcast(middle, 0u), wanted);")?;
    for first in (0..size).step_by(lanes) {
        let part = first / lanes;
        writeln!(text, "var part{part} = vec4<f32>(0.0);\nif lane < {}u {{", size - first)?;
        writeln!(text, "part{part} = controls[first + lane + {first}u];\n}}")?;
    }
    for k in 0..size {
        let (part, from) = (k / lanes, k % lanes);
        writeln!(text, "net[{k}] = select(net[{k}], subgroupBroadcast(part{part}, {from}u), wanted);")?;
    }
    writeln!(text, "}}")?;
    writeln!(text, "fn blend(first: u32, in_s: Basis, in_t: Basis) -> Blend {{")?;
    for i in 0..=p {
        for basis in ["value", "first", "second"] {
            let row = list(q + 1, " + ", &|j| format!("in_t.{basis}[{j}] * net[{}]", i * (q + 1) + j));
            writeln!(text, "let {basis}{i} = {row};")?;
        }
    }
    let sums = BLEND.map(|(_, [s, t])| list(p + 1, " + ", &|i| format!("in_s.{s}[{i}] * {t}{i}")));
    writeln!(text, "return Blend({});\n}}", sums.join(",\n"))?;
    writeln!(text, "fn nearest_control(first: u32, local: vec3<f32>) -> vec2<f32> {{")?;
    writeln!(text, "var nearest = vec2<f32>(0.0);\nvar least = distance_squared(net[0], local);")?;
    for k in 1..size {
        let (i, j) = (k / (q + 1), k % (q + 1));
        writeln!(text, "let d{k} = distance_squared(net[{k}], local);")?;
        writeln!(text, "if d{k} < least {{ least = d{k}; nearest = vec2<f32>({i}.0, {j}.0); }}")?;
    }
    writeln!(text, "return nearest / vec2<f32>({p}.0, {q}.0);\n}}")
}
