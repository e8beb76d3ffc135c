//! WGSL functions generated for one pair of degrees.
//!
//! Arrays of the degrees' size are written out instead of looped over, which
//! keeps them in registers. Only the sum over rows of controls is a loop.

use std::fmt::Write;

/// Generates the degrees `P` and `Q`, `Basis` with `basis_s` and `basis_t`,
/// `blend` and `nearest_control`, on which `patch.wgsl` and `foot.wgsl` build.
pub(crate) fn patch_wgsl(degree: [usize; 2]) -> String {
    let mut text = String::new();
    // Writing to a string does not fail.
    let _ = write(&mut text, degree);
    text
}

/// Generates `binomial_s` and `binomial_t`, the binomial coefficients of the degrees, and `inverse_s` and `inverse_t`, the
/// inverses of those of twice the degrees: each rounded once.
pub(crate) fn binomials_wgsl(degree: [usize; 2]) -> String {
    let mut text = String::new();
    for (axis, degree) in ["s", "t"].into_iter().zip(degree) {
        let plain = binomials(degree);
        let inverse: Vec<f64> = binomials(2 * degree).iter().map(|binomial| binomial.recip()).collect();
        for (name, values) in [("binomial", plain), ("inverse", inverse)] {
            let entries = list(values.len(), ", ", &|k| format!("{:e}f", values[k] as f32));
            let count = values.len();
            // Writing to a string does not fail.
            let _ = writeln!(text, "const {name}_{axis} = array<f32, {count}>({entries});");
        }
    }
    text
}

/// The binomial coefficients of a degree, exact up to degree 30.
fn binomials(degree: usize) -> Vec<f64> {
    let next = |&(k, binomial): &(usize, f64)| Some((k + 1, binomial * (degree - k) as f64 / (k + 1) as f64));
    std::iter::successors(Some((0, 1.0)), next).take(degree + 1).map(|(_, binomial)| binomial).collect()
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

/// The members of `Blend` with the members of `Basis` in s and t that they are sums of.
const BLEND: [(&str, [&str; 2]); 6] = [
    ("h", ["value", "value"]),
    ("s", ["first", "value"]),
    ("t", ["value", "first"]),
    ("ss", ["second", "value"]),
    ("st", ["first", "first"]),
    ("tt", ["value", "second"]),
];

/// Writes the functions that read control points: `contract` sums one row,
/// `blend` is the tensor product, `nearest_control` the start of an iteration.
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
    writeln!(text, "var nearest = vec2<f32>(0.0);\nvar smallest = UNKNOWN_DISTANCE;")?;
    writeln!(text, "for (var i = 0u; i < {rows}u; i++) {{")?;
    for j in 0..=q {
        writeln!(text, "let d{j} = distance_squared(controls[first + i * {columns}u + {j}u], local);")?;
        writeln!(text, "if d{j} < smallest {{ smallest = d{j}; nearest = vec2<f32>(f32(i), {j}.0); }}")?;
    }
    writeln!(text, "}}\nreturn nearest / vec2<f32>({p}.0, {q}.0);\n}}")
}

/// Writes the Bernstein polynomials and two derivatives: `b<level>_<i>` by the
/// recurrence in the degree, derivatives as differences of the lower degrees.
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
    // Polynomial i of a level, which is 0 outside 0..=level.
    let term = |level: usize, i: isize| {
        if (0..=level as isize).contains(&i) { format!("b{level}_{i}") } else { "0.0".to_owned() }
    };
    let n = degree as isize;
    let values = |entry: &dyn Fn(isize) -> String| {
        list(order, ", ", &|i| if i <= degree { entry(i as isize) } else { "0.0".to_owned() })
    };
    let value = values(&|i| term(degree, i));
    let first = values(&|i| format!("{n}.0 * ({} - {})", term(degree - 1, i - 1), term(degree - 1, i)));
    let second = values(&|i| {
        if degree < 2 {
            return "0.0".to_owned();
        }
        let below = |i| term(degree - 2, i);
        format!("{}.0 * ({} - 2.0 * {} + {})", n * (n - 1), below(i - 2), below(i - 1), below(i))
    });
    let array = format!("array<f32, {order}>");
    writeln!(text, "return Basis({array}({value}), {array}({first}), {array}({second}));\n}}")
}

/// Joins `count` entries.
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
