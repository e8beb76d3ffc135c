//! Quadrature for areas and volumes.

use std::f64::consts::PI;

/// Nodes and weights of Gauss's rule on [0, 1], by Newton's method on Legendre polynomials.
pub fn gauss(count: usize) -> Vec<[f64; 2]> {
    (0..count)
        .map(|k| {
            let mut x = (PI * (k as f64 + 0.75) / (count as f64 + 0.5)).cos();
            let mut slope = 1.0;
            for _ in 0..20 {
                let (mut before, mut value) = (1.0, x);
                for n in 2..=count {
                    let n = n as f64;
                    (before, value) = (value, ((2.0 * n - 1.0) * x * value - (n - 1.0) * before) / n);
                }
                slope = count as f64 * (x * value - before) / (x * x - 1.0);
                x -= value / slope;
            }
            [0.5 + 0.5 * x, 1.0 / ((1.0 - x * x) * slope * slope)]
        })
        .collect()
}
