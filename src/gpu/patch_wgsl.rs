//! WGSL written for one pair of degrees.
//!
//! What depends on the degrees is written out instead of looped over: faster,
//! and llvmpipe ends every loop of an invocation after 65,535 turns of all its
//! loops together, whatever is then still to be summed.

use std::fmt::Write;

/// Constants and functions that `patch.wgsl` and `foot.wgsl` build on.
pub(crate) fn patch_text(degree: [usize; 2]) -> String {
    let mut text = String::new();
    // Writing to a string does not fail.
    let _ = write(&mut text, degree);
    text
}

fn write(text: &mut String, [p, q]: [usize; 2]) -> std::fmt::Result {
    let order = p.max(q) + 1;
    writeln!(text, "const P: u32 = {p}u;\nconst Q: u32 = {q}u;")?;
    let array = format!("array<f32, {order}>");
    writeln!(text, "struct Basis {{ value: {array}, first: {array}, second: {array} }}")?;
    for (name, degree) in [("basis_s", p), ("basis_t", q)] {
        write_basis(text, name, degree, order)?;
    }
    write_controls(text, [p, q], &array)
}

/// Derivatives by s and t of the members of `Blend`.
const BLEND: [(&str, [&str; 2]); 6] = [
    ("h", ["value", "value"]),
    ("s", ["first", "value"]),
    ("t", ["value", "first"]),
    ("ss", ["second", "value"]),
    ("st", ["first", "first"]),
    ("tt", ["value", "second"]),
];

/// Functions that read the controls where they are wanted.
fn write_controls(text: &mut String, [p, q]: [usize; 2], array: &str) -> std::fmt::Result {
    let (rows, columns) = (p + 1, q + 1);
    let terms = list(q + 1, " + ", &|j| format!("basis[{j}] * controls[first + {j}u]"));
    writeln!(text, "fn contract(first: u32, basis: {array}) -> vec4<f32> {{ return {terms}; }}")?;
    writeln!(text, "fn blend(first: u32, in_s: Basis, in_t: Basis) -> Blend {{\nvar sums: Blend;")?;
    writeln!(text, "for (var i = 0u; i < {rows}u; i++) {{\nlet row = first + i * {columns}u;")?;
    for basis in ["value", "first", "second"] {
        writeln!(text, "let {basis} = contract(row, in_t.{basis});")?;
    }
    for (member, [s, t]) in BLEND {
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
    let values = |entry: &dyn Fn(isize) -> String| {
        list(order, ", ", &|i| if i <= degree { entry(i as isize) } else { "0.0".to_owned() })
    };
    let value = values(&|i| at(degree, i));
    let first = values(&|i| format!("{n}.0 * ({} - {})", at(degree - 1, i - 1), at(degree - 1, i)));
    let second = values(&|i| {
        if degree < 2 {
            return "0.0".to_owned();
        }
        let below = |i| at(degree - 2, i);
        format!("{}.0 * ({} - 2.0 * {} + {})", n * (n - 1), below(i - 2), below(i - 1), below(i))
    });
    let array = format!("array<f32, {order}>");
    writeln!(text, "return Basis({array}({value}), {array}({first}), {array}({second}));\n}}")
}

/// So many entries in a row.
fn list(count: usize, separator: &str, entry: &dyn Fn(usize) -> String) -> String {
    let mut list = String::new();
    for index in 0..count {
        if index > 0 {
            list.push_str(separator);
        }
        list.push_str(&entry(index));
    }
    list
}
