//! WGSL written for one pair of degrees.
//!
//! What depends on the degrees is written out instead of looped over: faster,
//! and llvmpipe ends every loop of an invocation after 65,535 turns of all its
//! loops together, whatever is then still to be summed.

use std::fmt::Write;

/// Constants and functions that `patch.wgsl` and `foot.wgsl` build on.
pub(super) fn patch_text([p, q]: [usize; 2]) -> String {
    let mut text = String::new();
    // Writing to a string does not fail.
    let _ = write(&mut text, p, q);
    text
}

fn write(text: &mut String, p: usize, q: usize) -> std::fmt::Result {
    let order = p.max(q) + 1;
    writeln!(text, "const P: u32 = {p}u;\nconst Q: u32 = {q}u;\nconst ORDER: u32 = {order}u;")?;
    let array = format!("array<f32, {order}>");
    writeln!(text, "struct Basis {{ value: {array}, first: {array}, second: {array} }}")?;
    for (name, degree) in [("basis_s", p), ("basis_t", q)] {
        write_basis(text, name, degree, order)?;
    }
    let terms: Vec<String> = (0..=q).map(|j| format!("basis[{j}] * controls[first + {j}u]")).collect();
    writeln!(
        text,
        "fn contract(first: u32, basis: {array}) -> vec4<f32> {{ return {}; }}",
        terms.join(" + ")
    )?;
    writeln!(text, "fn nearest_in_row(first: u32, local: vec3<f32>) -> vec2<f32> {{")?;
    writeln!(text, "var nearest = vec2<f32>(control_distance_squared(first, local), 0.0);")?;
    for j in 1..=q {
        writeln!(text, "let d{j} = control_distance_squared(first + {j}u, local);")?;
        writeln!(text, "if d{j} < nearest.x {{ nearest = vec2<f32>(d{j}, {j}.0); }}")?;
    }
    writeln!(text, "return nearest;\n}}")
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
