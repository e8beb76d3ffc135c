//! A rectangular piece of a patch.

use super::{MAX_ORDER, Patch};
use glam::DVec4;

impl Patch<'_> {
    /// The controls of the piece over `s` x `t`, intervals inside [0, 1].
    ///
    /// Control k of a restricted Bézier curve of degree p is the blossom at
    /// the start, p - k times, and the end, k times: convex combinations
    /// only. O(p q (p + q)).
    #[must_use]
    pub fn restricted(&self, s: [f64; 2], t: [f64; 2]) -> Vec<DVec4> {
        let mut controls = self.controls.to_vec();
        let (rows, columns) = (self.degree[0] + 1, self.degree[1] + 1);
        if t != [0.0, 1.0] {
            for row in 0..rows {
                restrict_line(&mut controls, row * columns, 1, columns, t);
            }
        }
        if s != [0.0, 1.0] {
            for column in 0..columns {
                restrict_line(&mut controls, column, columns, rows, s);
            }
        }
        controls
    }
}

/// Cuts off [0, start], then what is left beyond `end`, by de Casteljau.
fn restrict_line(controls: &mut [DVec4], first: usize, stride: usize, order: usize, [start, end]: [f64; 2]) {
    let mut line = [DVec4::ZERO; MAX_ORDER];
    for (index, control) in line.iter_mut().enumerate().take(order) {
        *control = controls[first + index * stride];
    }
    for level in 1..order {
        for index in 0..order - level {
            line[index] = (1.0 - start) * line[index] + start * line[index + 1];
        }
    }
    // The low piece of [start, 1] up to `end`.
    let fraction = if start < 1.0 { ((end - start) / (1.0 - start)).min(1.0) } else { 0.0 };
    for level in 1..order {
        for index in (level..order).rev() {
            line[index] = (1.0 - fraction) * line[index - 1] + fraction * line[index];
        }
    }
    for (index, control) in line.iter().enumerate().take(order) {
        controls[first + index * stride] = *control;
    }
}
