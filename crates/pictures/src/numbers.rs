//! Numbers and units as the page writes them, `www/src/common/numbers.ts` and `units.ts`.

/// Decimal digits that float64 represents faithfully.
const SIGNIFICANT_DIGITS: i32 = 15;
/// Digits of a distance below the models' order of magnitude.
const RELATIVE_DIGITS: i32 = 5;
/// The largest number of decimals.
const MAX_DIGITS: i32 = 100;

/// The units that have a name, in metres.
const UNITS: [(f64, &str); 11] = [
    (1e-9, "nm"),
    (1e-6, "µm"),
    (2.54e-5, "mil"),
    (1e-3, "mm"),
    (1e-2, "cm"),
    (0.0254, "in"),
    (0.1, "dm"),
    (0.3048, "ft"),
    (0.9144, "yd"),
    (1.0, "m"),
    (1e3, "km"),
];

/// The relative difference up to which a length counts as a unit: files state few digits.
const UNIT_TOLERANCE: f64 = 1e-6;

/// Returns a distance, to five digits below the order of magnitude of the diagonal. One that would
/// read 0, and is no rounding of the models' size, has two significant digits.
pub(crate) fn distance_text(distance: f64, diagonal: f64) -> String {
    let size = if diagonal > 0.0 { diagonal.log10().floor() as i32 } else { 0 };
    let digits = (RELATIVE_DIGITS - size).clamp(0, MAX_DIGITS) as usize;
    let fixed = format!("{distance:.digits$}");
    let reads_zero = fixed.parse() == Ok(0.0);
    if reads_zero && distance.abs() > 10_f64.powi(size - SIGNIFICANT_DIGITS) {
        format!("{distance:.1e}")
    } else {
        fixed
    }
}

/// Returns a signed distance, always with its sign.
pub(crate) fn signed_text(distance: f64, diagonal: f64) -> String {
    let sign = if distance < 0.0 { '−' } else { '+' };
    format!("{sign}{}", distance_text(distance.abs(), diagonal))
}

/// Returns the symbol of the unit of this many metres, or the number of metres.
pub(crate) fn unit_name(metres: f64) -> String {
    let known = UNITS.iter().find(|(size, _)| (metres - size).abs() <= UNIT_TOLERANCE * size);
    known.map_or_else(|| format!("{metres} m"), |(_, name)| (*name).to_owned())
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;

    #[test]
    fn texts_have_five_digits_below_the_size_of_the_models() {
        assert_eq!(distance_text(3.0, 120.0), "3.000");
        assert_eq!(distance_text(0.123_456_7, 1.5), "0.12346");
        assert_eq!(distance_text(1.5e-7, 120.0), "1.5e-7");
        assert_eq!(distance_text(1e-15, 120.0), "0.000");
        assert_eq!(signed_text(-0.5, 20.0), "−0.5000");
        assert_eq!(distance_text(7.0, 0.0), "7.00000");
        assert_eq!([unit_name(0.001), unit_name(0.0254), unit_name(0.5)], ["mm", "in", "0.5 m"]);
    }
}
