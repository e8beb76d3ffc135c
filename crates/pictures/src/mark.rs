//! The mark of a place in a picture: a dark ring on a light one, whose middle stays as it is.

use super::raster::BACKGROUND;

/// The radius of the ring and the half widths of its dark and its light line, in pixels.
const RADIUS: f64 = 10.0;
const DARK_WIDTH: f64 = 1.2;
const LIGHT_WIDTH: f64 = 2.6;

/// The colour of the ring.
const DARK: [u8; 3] = [0, 0, 0];

/// Draws a ring about a place, in pixels from the left and from above.
pub(crate) fn ring(pixels: &mut [u8], [width, height]: [usize; 2], [x, y]: [f64; 2]) {
    let reach = RADIUS + LIGHT_WIDTH + 1.0;
    let range =
        |at: f64, size: usize| ((at - reach) as usize)..((at + reach).ceil().max(0.0) as usize).min(size);
    for row in range(y, height) {
        for column in range(x, width) {
            let distance = (column as f64 + 0.5 - x).hypot(row as f64 + 0.5 - y);
            let off = (distance - RADIUS).abs();
            let first = 3 * (row * width + column);
            for (line, color) in [(LIGHT_WIDTH, BACKGROUND), (DARK_WIDTH, DARK)] {
                // The part of the pixel that the line covers, about.
                let part = (line + 0.5 - off).clamp(0.0, 1.0);
                for (pixel, color) in pixels[first..first + 3].iter_mut().zip(color) {
                    *pixel = (f64::from(*pixel) * (1.0 - part) + f64::from(color) * part).round() as u8;
                }
            }
        }
    }
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;

    #[test]
    fn a_ring_is_about_its_place_and_leaves_the_middle() {
        let size = [60, 50];
        let mut pixels = vec![120; 3 * 60 * 50];
        ring(&mut pixels, size, [30.0, 20.0]);
        let at = |x: usize, y: usize| pixels[3 * (y * 60 + x)];
        assert_eq!([at(30, 20), at(25, 20), at(50, 40)], [120; 3]);
        assert_eq!([at(39, 20), at(20, 19), at(30, 29), at(29, 10)], [0; 4]);
        // Beyond the picture nothing is drawn.
        for place in [[-5.0, -5.0], [58.0, 49.0], [1e300, 0.0], [f64::NAN, 3.0], [f64::INFINITY; 2]] {
            ring(&mut pixels, size, place);
        }
    }
}
