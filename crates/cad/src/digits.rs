//! Lengths in messages.

/// The least and the largest length that is written without an exponent.
const PLAIN: [f64; 2] = [1e-3, 1e6];

/// Returns a length with three significant digits: what a message says is how large it is.
pub(crate) fn three_digits(length: f64) -> String {
    if length == 0.0 || !length.is_finite() {
        return length.to_string();
    }
    let [least, largest] = PLAIN;
    if !(least..largest).contains(&length.abs()) {
        return format!("{length:.2e}");
    }
    // Below a million, so that the number of digits before the point is small.
    let decimals = (2.0 - length.abs().log10().floor()).max(0.0) as usize;
    format!("{length:.decimals$}")
}

#[cfg(test)]
mod tests {
    use super::three_digits;

    #[test]
    fn a_length_has_three_digits() {
        let cases = [
            (1.802_775_637_731_994_3, "1.80"),
            (0.0012345, "0.00123"),
            (123.456, "123"),
            (123_456.0, "123456"),
            (2.5e-4, "2.50e-4"),
            (1.234_567e7, "1.23e7"),
            (0.0, "0"),
            (f64::NAN, "NaN"),
            (f64::INFINITY, "inf"),
        ];
        for (length, expected) in cases {
            assert_eq!(three_digits(length), expected);
        }
    }
}
