//! A rectangular piece of a patch.

use super::{MAX_ORDER, Patch};
use glam::DVec4;

impl Patch<'_> {
    /// The controls of the piece over `s` x `t`, intervals of positive length.
    ///
    /// Control k of a restricted Bézier curve of degree p is the blossom at
    /// the start, p - k times, and the end, k times: convex combinations
    /// only inside [0, 1]. O(p q (p + q)).
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

/// Cuts off [0, start] and what is left beyond `end`, by de Casteljau, the
/// side first that leaves more, or that goes on beyond an end.
fn restrict_line(controls: &mut [DVec4], first: usize, stride: usize, order: usize, [start, end]: [f64; 2]) {
    let mut line = [DVec4::ZERO; MAX_ORDER];
    for (index, control) in line.iter_mut().enumerate().take(order) {
        *control = controls[first + index * stride];
    }
    if end > 1.0 - start {
        keep_low(&mut line[..order], end);
        keep_high(&mut line[..order], start / end);
    } else {
        keep_high(&mut line[..order], start);
        keep_low(&mut line[..order], (end - start) / (1.0 - start));
    }
    for (index, control) in line.iter().enumerate().take(order) {
        controls[first + index * stride] = *control;
    }
}

fn keep_high(line: &mut [DVec4], start: f64) {
    for level in 1..line.len() {
        for index in 0..line.len() - level {
            line[index] = (1.0 - start) * line[index] + start * line[index + 1];
        }
    }
}

fn keep_low(line: &mut [DVec4], end: f64) {
    for level in 1..line.len() {
        for index in (level..line.len()).rev() {
            line[index] = (1.0 - end) * line[index - 1] + end * line[index];
        }
    }
}
