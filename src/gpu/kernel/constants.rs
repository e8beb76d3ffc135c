//! Constants that kernels and host share, written into the WGSL text from
//! their one definition in Rust.

use std::fmt;

/// A WGSL `const` declaration.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Constant {
    name: &'static str,
    value: Value,
}

#[derive(Debug, Clone, Copy)]
enum Value {
    F32(f32),
    U32(u32),
}

impl Constant {
    /// A `u32` of this name.
    pub(crate) const fn u32(name: &'static str, value: u32) -> Self {
        Self { name, value: Value::U32(value) }
    }

    /// A finite `f32` of this name.
    pub(crate) const fn f32(name: &'static str, value: f32) -> Self {
        Self { name, value: Value::F32(value) }
    }
}

impl fmt::Display for Constant {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let name = self.name;
        match self.value {
            // The exponent keeps the shortest digits that parse to the same float.
            Value::F32(value) => writeln!(f, "const {name}: f32 = {value:e}f;"),
            Value::U32(value) => writeln!(f, "const {name}: u32 = {value}u;"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Constant;

    #[test]
    fn floats_keep_all_their_digits() {
        let text = [f32::EPSILON, 3e38, 0.01, 1.0 / 3.0].map(|value| {
            let text = Constant::f32("X", value).to_string();
            let digits = text.trim_start_matches("const X: f32 = ").trim_end_matches("f;\n").to_owned();
            assert_eq!(digits.parse(), Ok(value), "{text}");
            text
        });
        assert_eq!(text[1], "const X: f32 = 3e38f;\n");
        assert_eq!(Constant::u32("N", 64).to_string(), "const N: u32 = 64u;\n");
    }
}
