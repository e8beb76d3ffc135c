//! WGSL written for one pair of degrees.
//!
//! What depends on the degrees is written out instead of looped over: faster,
//! and llvmpipe ends every loop of an invocation after 65,535 turns of all its
//! loops together, whatever is then still to be summed.

use std::fmt::Write;

/// Controls of a patch that is written out row by row, and that threads may
/// keep in registers, at most: beyond, compiling takes minutes on llvmpipe.
const MOST_WRITTEN_OUT: usize = 36;

/// Constants and functions that `patch.wgsl` and `foot.wgsl` build on.
/// Subgroups of `lanes` threads load together, or each thread alone if 0.
pub(super) fn patch_text(degree: [usize; 2], lanes: u32) -> String {
    let mut text = String::new();
    // Writing to a string does not fail.
    let _ = write(&mut text, degree, lanes as usize);
    text
}

fn write(text: &mut String, [p, q]: [usize; 2], lanes: usize) -> std::fmt::Result {
    let order = p.max(q) + 1;
    writeln!(text, "const P: u32 = {p}u;\nconst Q: u32 = {q}u;")?;
    let array = format!("array<f32, {order}>");
    writeln!(text, "struct Basis {{ value: {array}, first: {array}, second: {array} }}")?;
    for (name, degree) in [("basis_s", p), ("basis_t", q)] {
        write_basis(text, name, degree, order)?;
    }
    let size = (p + 1) * (q + 1);
    let kept = write_take(text, size, lanes)?;
    let control = |k: usize| if kept { format!("net[{k}]") } else { format!("controls[first + {k}u]") };
    if size > MOST_WRITTEN_OUT {
        return write_loops(text, [p, q], order);
    }
    let row = |i: usize, basis: &str| -> String {
        let term = |j: usize| format!("in_t.{basis}[{j}] * {}", control(i * (q + 1) + j));
        joined(0..=q, " + ", term)
    };
    writeln!(text, "fn blend(first: u32, in_s: Basis, in_t: Basis) -> Blend {{")?;
    for i in 0..=p {
        for basis in ["value", "first", "second"] {
            writeln!(text, "let {basis}{i} = {};", row(i, basis))?;
        }
    }
    let sums = |[s, t]: [&str; 2]| joined(0..=p, " + ", |i| format!("in_s.{s}[{i}] * {t}{i}"));
    writeln!(text, "return Blend({});\n}}", SUMS.map(sums).join(",\n"))?;
    writeln!(text, "fn nearest_control(first: u32, local: vec3<f32>) -> vec2<f32> {{")?;
    writeln!(text, "var nearest = vec2<f32>(0.0);\nvar least = distance_squared({}, local);", control(0))?;
    for k in 1..size {
        let (i, j) = (k / (q + 1), k % (q + 1));
        writeln!(text, "let d{k} = distance_squared({}, local);", control(k))?;
        writeln!(text, "if d{k} < least {{ least = d{k}; nearest = vec2<f32>({i}.0, {j}.0); }}")?;
    }
    writeln!(text, "return nearest / vec2<f32>({p}.0, {q}.0);\n}}")
}

/// Derivatives by s and t of the members of `Blend`.
const SUMS: [[&str; 2]; 6] = [
    ["value", "value"],
    ["first", "value"],
    ["value", "first"],
    ["second", "value"],
    ["first", "first"],
    ["value", "second"],
];

fn joined(range: std::ops::RangeInclusive<usize>, between: &str, term: impl Fn(usize) -> String) -> String {
    range.map(term).collect::<Vec<_>>().join(between)
}

/// The same functions with rows looped over.
fn write_loops(text: &mut String, [p, q]: [usize; 2], order: usize) -> std::fmt::Result {
    let (rows, columns) = (p + 1, q + 1);
    let row = joined(0..=q, " + ", |j| format!("basis[{j}] * controls[first + {j}u]"));
    writeln!(text, "fn contract(first: u32, basis: array<f32, {order}>) -> vec4<f32> {{ return {row}; }}")?;
    writeln!(text, "fn blend(first: u32, in_s: Basis, in_t: Basis) -> Blend {{\nvar sums: Blend;")?;
    writeln!(text, "for (var i = 0u; i < {rows}u; i++) {{\nlet row = first + i * {columns}u;")?;
    for basis in ["value", "first", "second"] {
        writeln!(text, "let {basis} = contract(row, in_t.{basis});")?;
    }
    for (member, [s, t]) in ["h", "s", "t", "ss", "st", "tt"].into_iter().zip(SUMS) {
        writeln!(text, "sums.{member} += in_s.{s}[i] * {t};")?;
    }
    writeln!(text, "}}\nreturn sums;\n}}")?;
    writeln!(text, "fn nearest_control(first: u32, local: vec3<f32>) -> vec2<f32> {{")?;
    writeln!(text, "var nearest = vec2<f32>(0.0);\nvar least = FARTHEST;")?;
    writeln!(text, "for (var i = 0u; i < {rows}u; i++) {{")?;
    for j in 0..=q {
        writeln!(text, "let d{j} = distance_squared(controls[first + i * {columns}u + {j}u], local);")?;
        writeln!(text, "if d{j} < least {{ least = d{j}; nearest = vec2<f32>(f32(i), {j}.0); }}")?;
    }
    writeln!(text, "}}\nreturn nearest / vec2<f32>({p}.0, {q}.0);\n}}")
}

/// `join`, `any_of` and `take`, after which the functions above work on the
/// patch whose controls start at `first`; whether they find them in `net`.
///
/// A processor's adapter has no instruction that loads from as many places as
/// it has lanes. There all lanes of a subgroup load parts of one lane's patch
/// and hand them round, for one patch after the other, once a projection.
#[cfg(not(target_arch = "wasm32"))]
fn write_take(text: &mut String, size: usize, lanes: usize) -> Result<bool, std::fmt::Error> {
    if lanes == 0 || size > MOST_WRITTEN_OUT {
        return write_no_take(text);
    }
    writeln!(text, "var<private> lane: u32;\nvar<private> net: array<vec4<f32>, {size}>;")?;
    writeln!(text, "fn join() {{ lane = subgroupExclusiveAdd(1u); }}")?;
    writeln!(text, "fn any_of(wanted: bool) -> bool {{ return subgroupAny(wanted); }}")?;
    writeln!(text, "fn take(first: u32, wanted: bool) {{\nvar waits = wanted;\nwhile subgroupAny(waits) {{")?;
    writeln!(text, "let next = subgroupMin(select(0xffffffffu, first, waits));")?;
    writeln!(text, "let mine = waits && first == next;\nwaits = waits && !mine;")?;
    for part in 0..size.div_ceil(lanes) {
        writeln!(text, "let part{part} = controls[next + lane + {}u];", part * lanes)?;
    }
    for k in 0..size {
        let (part, from) = (k / lanes, k % lanes);
        writeln!(text, "let c{k} = subgroupBroadcast(part{part}, {from}u);")?;
        writeln!(text, "net[{k}] = select(net[{k}], c{k}, mine);")?;
    }
    writeln!(text, "}}\n}}")?;
    Ok(true)
}

#[cfg(target_arch = "wasm32")]
fn write_take(text: &mut String, _size: usize, _lanes: usize) -> Result<bool, std::fmt::Error> {
    write_no_take(text)
}

fn write_no_take(text: &mut String) -> Result<bool, std::fmt::Error> {
    writeln!(text, "fn join() {{}}\nfn any_of(wanted: bool) -> bool {{ return wanted; }}")?;
    writeln!(text, "fn take(first: u32, wanted: bool) {{}}")?;
    Ok(false)
}

/// Bernstein polynomials and two derivatives: `b<level>_<i>` by raising one
/// degree at a time, derivatives as differences of the lower levels.
fn write_basis(text: &mut String, name: &str, degree: usize, order: usize) -> std::fmt::Result {
    writeln!(text, "fn {name}(t: f32) -> Basis {{\nlet c = 1.0 - t;\nlet b0_0 = 1.0;")?;
    for level in 1..=degree {
        let below = level - 1;
        writeln!(text, "let b{level}_0 = c * b{below}_0;")?;
        for i in 1..level {
            writeln!(text, "let b{level}_{i} = t * b{below}_{} + c * b{below}_{i};", i - 1)?;
        }
        writeln!(text, "let b{level}_{level} = t * b{below}_{below};")?;
    }
    // Polynomial i of a level, or nothing beside its ends.
    let at = |level: usize, i: isize| {
        if (0..=level as isize).contains(&i) { format!("b{level}_{i}") } else { "0.0".to_owned() }
    };
    let n = degree as isize;
    let list = |entry: &dyn Fn(isize) -> String| {
        let entries: Vec<String> =
            (0..order as isize).map(|i| if i <= n { entry(i) } else { "0.0".to_owned() }).collect();
        entries.join(", ")
    };
    let value = list(&|i| at(degree, i));
    let first = list(&|i| format!("{n}.0 * ({} - {})", at(degree - 1, i - 1), at(degree - 1, i)));
    let second = list(&|i| {
        if degree < 2 {
            return "0.0".to_owned();
        }
        let below = |i| at(degree - 2, i);
        format!("{}.0 * ({} - 2.0 * {} + {})", n * (n - 1), below(i - 2), below(i - 1), below(i))
    });
    let array = format!("array<f32, {order}>");
    writeln!(text, "return Basis({array}({value}), {array}({first}), {array}({second}));\n}}")
}
