//! The unit of LAS coordinates, by the coordinate reference system of the file: as well-known text
//! (OGC 01-009 or ISO 19162), or as keys of GeoTIFF.

use super::FORMAT;
use super::records::Records;
use nurbs_hausdorff::Result;

const USER: &[u8] = b"LASF_Projection";
const WELL_KNOWN_TEXT: u16 = 2112;
const GEO_KEYS: u16 = 34735;

/// GeoTIFF: the key of the kind of system and its value for degrees; the keys of the units of the
/// plane and of heights.
const MODEL_KEY: u16 = 1024;
const GEOGRAPHIC: u16 = 2;
const UNIT_KEYS: [u16; 2] = [3076, 4099];

/// The units of EPSG that surveys use, in metres: metre, international foot, US survey foot.
const UNITS: [(u16, f64); 3] = [(9001, 1.0), (9002, 0.3048), (9003, 1200.0 / 3937.0)];

/// Systems whose coordinates are lengths, those whose coordinates are degrees, and the elements whose
/// unit is that of coordinates.
const OF_LENGTHS: [&str; 6] = ["PROJCS", "PROJCRS", "PROJECTEDCRS", "GEOCCS", "LOCAL_CS", "ENGCRS"];
const OF_DEGREES: [&str; 3] = ["GEOGCS", "GEOGCRS", "GEOGRAPHICCRS"];
const WITH_UNIT: [&str; 10] = [
    "PROJCS",
    "PROJCRS",
    "PROJECTEDCRS",
    "GEOCCS",
    "LOCAL_CS",
    "ENGCRS",
    "VERT_CS",
    "VERTCRS",
    "VERTICALCRS",
    "AXIS",
];

/// Returns the metres of a unit, if the file states it.
///
/// # Errors
/// [`nurbs_hausdorff::Error::MeshSyntax`] for degrees, or heights in another unit than the plane: distances
/// between such coordinates are none.
pub(super) fn unit(records: &Records<'_>) -> Result<Option<f64>> {
    let (is_degrees, units) = if let Some(text) = records.content(USER, WELL_KNOWN_TEXT) {
        of_text(&String::from_utf8_lossy(text))
    } else if let Some(keys) = records.content(USER, GEO_KEYS) {
        of_keys(keys)
    } else {
        return Ok(None);
    };
    if is_degrees {
        return Err(FORMAT.syntax("coordinates in degrees, expected lengths"));
    }
    match units.split_first() {
        Some((&first, rest)) if rest.iter().any(|&other| other != first) => {
            Err(FORMAT.syntax(format!("coordinates in units of {units:?} m, expected one unit")))
        }
        Some((&first, _)) => Ok(Some(first).filter(|unit| unit.is_finite() && *unit > 0.0)),
        None => Ok(None),
    }
}

/// Returns whether coordinates are degrees, and the units of coordinates.
fn of_keys(bytes: &[u8]) -> (bool, Vec<f64>) {
    let numbers: Vec<u16> = bytes.as_chunks().0.iter().map(|&bytes| u16::from_le_bytes(bytes)).collect();
    let keys = numbers.as_chunks::<4>().0;
    let value = |key: u16| keys.iter().skip(1).find(|found| found[..2] == [key, 0]).map(|found| found[3]);
    let unit = |code: u16| UNITS.iter().find(|(found, _)| *found == code).map(|(_, metres)| *metres);
    let units = UNIT_KEYS.into_iter().filter_map(value).filter_map(unit).collect();
    (value(MODEL_KEY) == Some(GEOGRAPHIC), units)
}

/// Returns whether coordinates are degrees, and the units of coordinates.
fn of_text(text: &str) -> (bool, Vec<f64>) {
    let mut within: Vec<&str> = Vec::new();
    let mut units = Vec::new();
    let [mut has_lengths, mut has_degrees] = [false; 2];
    // Names are quoted, so that every other piece is outside of quotes.
    let pieces: Vec<&str> = text.split('"').collect();
    for (index, piece) in pieces.iter().enumerate().step_by(2) {
        let mut rest = *piece;
        while let Some(at) = rest.find(['[', '(', ']', ')']) {
            let (before, bracket) = rest.split_at(at);
            rest = &bracket[1..];
            if bracket.starts_with([']', ')']) {
                within.pop();
                continue;
            }
            let word = before.trim_start_matches(|c: char| c == ',' || c.is_whitespace()).trim_end();
            has_lengths |= OF_LENGTHS.contains(&word);
            has_degrees |= OF_DEGREES.contains(&word);
            if ["UNIT", "LENGTHUNIT"].contains(&word)
                && within.last().is_some_and(|parent| WITH_UNIT.contains(parent))
            {
                units.extend(pieces.get(index + 2).and_then(|piece| number(piece)));
            }
            within.push(word);
        }
    }
    (has_degrees && !has_lengths, units)
}

/// Returns the number behind a comma.
fn number(piece: &str) -> Option<f64> {
    piece.strip_prefix(',')?.split([',', ']', ')']).next()?.trim().parse().ok()
}
