//! Pictures as PNG (ISO/IEC 15948), compressed by the caller's zlib.

/// The first bytes of a PNG.
const SIGNATURE: [u8; 8] = *b"\x89PNG\r\n\x1a\n";

/// Eight bits for each of red, green and blue; one method of compression and of filters; no interlacing.
const TRUECOLOR: [u8; 5] = [8, 2, 0, 0, 0];

/// The filter of each row: the difference from Paeth's predictor.
const PAETH: u8 = 4;

/// Bytes of a pixel.
const CHANNELS: usize = 3;

/// The polynomial of the checksum, its bits reversed.
const POLYNOMIAL: u32 = 0xedb8_8320;

/// Returns the file of pixels, the upper row first; `deflate` makes a zlib stream of bytes.
pub(crate) fn png<E>(
    pixels: &[u8],
    [width, height]: [usize; 2],
    deflate: impl FnOnce(&[u8]) -> Result<Vec<u8>, E>,
) -> Result<Vec<u8>, E> {
    let mut png = SIGNATURE.to_vec();
    let header = [(width as u32).to_be_bytes(), (height as u32).to_be_bytes()].concat();
    chunk(&mut png, *b"IHDR", &[&header[..], &TRUECOLOR].concat());
    chunk(&mut png, *b"IDAT", &deflate(&filtered(pixels, width * CHANNELS))?);
    chunk(&mut png, *b"IEND", &[]);
    Ok(png)
}

fn filtered(pixels: &[u8], stride: usize) -> Vec<u8> {
    let mut all = Vec::with_capacity(pixels.len() + pixels.len() / stride.max(1));
    let mut above = vec![0; stride];
    for row in pixels.chunks_exact(stride.max(1)) {
        all.push(PAETH);
        for (index, &value) in row.iter().enumerate() {
            let before = |row: &[u8]| if index < CHANNELS { 0 } else { row[index - CHANNELS] };
            all.push(value.wrapping_sub(paeth(before(row), above[index], before(&above))));
        }
        above.copy_from_slice(row);
    }
    all
}

/// Returns the one of left, above and above left that is nearest to left + above - above left.
fn paeth(left: u8, above: u8, corner: u8) -> u8 {
    let [a, b, c] = [left, above, corner].map(i32::from);
    let [to_left, to_above, to_corner] = [b - c, a - c, a + b - 2 * c].map(i32::abs);
    if to_left <= to_above && to_left <= to_corner {
        left
    } else if to_above <= to_corner {
        above
    } else {
        corner
    }
}

fn chunk(png: &mut Vec<u8>, name: [u8; 4], data: &[u8]) {
    png.extend((data.len() as u32).to_be_bytes());
    let start = png.len();
    png.extend(name);
    png.extend(data);
    let checksum = crc32(&png[start..]);
    png.extend(checksum.to_be_bytes());
}

fn crc32(data: &[u8]) -> u32 {
    !data.iter().fold(u32::MAX, |crc, &byte| {
        (0..8).fold(crc ^ u32::from(byte), |crc, _| (crc >> 1) ^ if crc & 1 == 1 { POLYNOMIAL } else { 0 })
    })
}

#[cfg(all(test, not(target_arch = "wasm32")))]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod tests {
    use super::*;

    #[test]
    fn checksums_and_predictions_are_those_of_the_standard() {
        // The check value of CRC-32, and of the chunk IEND.
        assert_eq!(crc32(b"123456789"), 0xcbf4_3926);
        assert_eq!(crc32(b"IEND"), 0xae42_6082);
        // 30 + 20 - 10 is nearest to 30; of equal distances left comes before above, and that before the corner.
        assert_eq!(
            [paeth(30, 20, 10), paeth(10, 10, 10), paeth(10, 20, 20), paeth(20, 10, 20)],
            [30, 10, 10, 10]
        );
        assert_eq!(paeth(50, 60, 55), 55);
    }

    #[test]
    fn the_header_states_size_and_kind() {
        let pixels = [1, 2, 3, 4, 5, 6];
        let file = png(&pixels, [2, 1], |bytes| Ok::<_, ()>(bytes.to_vec())).unwrap();
        assert_eq!(&file[..8], b"\x89PNG\r\n\x1a\n");
        assert_eq!(&file[8..29], b"\0\0\0\x0dIHDR\0\0\0\x02\0\0\0\x01\x08\x02\0\0\0");
        // The first row has nothing above it: each part less that of the pixel before.
        assert_eq!(&file[33..48], b"\0\0\0\x07IDAT\x04\x01\x02\x03\x03\x03\x03");
    }
}
