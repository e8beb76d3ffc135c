//! The arguments of motions by hand: pairs of points in a file, and datums.

use crate::arguments::models::motion::numbers;
use crate::failure::Failure;
use nurbs_hausdorff::{Datum, Error, Feature, PointPair};
use std::path::Path;
use std::str::FromStr;

/// `face:3=7`, `plane:x,y,z,nx,ny,nz=x,y,z,nx,ny,nz`, `axis:…` by a point and a direction, or `point:x,y,z=x,y,z`:
/// a feature of A, and that of B on which it belongs.
#[derive(Debug, Clone, Copy)]
pub(crate) struct DatumText(pub(crate) Datum);

impl FromStr for DatumText {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let expected = || format!("found {text:?}, expected KIND:FEATURE=FEATURE");
        let (kind, features) = text.split_once(':').ok_or_else(expected)?;
        let (a, b) = features.split_once('=').ok_or_else(expected)?;
        Ok(Self(Datum { a: feature(kind, a)?, b: feature(kind, b)? }))
    }
}

fn feature(kind: &str, text: &str) -> Result<Feature, String> {
    match kind {
        "face" => match text.trim().parse() {
            Ok(index) => Ok(Feature::Face { index }),
            Err(_) => Err(format!("found {text:?}, expected the index of a face")),
        },
        "plane" => halves(text).map(|[point, normal]| Feature::Plane { point, normal }),
        "axis" => halves(text).map(|[point, direction]| Feature::Axis { point, direction }),
        "point" => numbers(text).map(|point| Feature::Point { point }),
        _ => Err(format!("found {kind:?}, expected face, plane, axis or point")),
    }
}

fn halves(text: &str) -> Result<[[f64; 3]; 2], String> {
    let [x, y, z, u, v, w] = numbers(text)?;
    Ok([[x, y, z], [u, v, w]])
}

/// Reads pairs of points: lines of six numbers and perhaps a weight, separated by commas or spaces, or JSON.
/// Lines that are empty or begin with # are left out.
///
/// # Errors
/// [`Error::FileUnreadable`]; [`Error::OptionInvalid`] for a line that is no pair.
pub(crate) fn read_pairs(path: &Path) -> Result<Vec<PointPair>, Failure> {
    let text = std::fs::read_to_string(path).map_err(|error| Error::FileUnreadable {
        path: path.display().to_string(),
        found: error.to_string(),
    })?;
    let invalid = |found: String| Error::OptionInvalid { found: format!("{}: {found}", path.display()) };
    if text.trim_start().starts_with('[') {
        return Ok(serde_json::from_str(&text).map_err(|error| invalid(error.to_string()))?);
    }
    let lines = text.lines().enumerate().map(|(index, line)| (index, line.trim()));
    let lines = lines.filter(|(_, line)| !line.is_empty() && !line.starts_with('#'));
    let pairs = lines
        .map(|(index, line)| pair(line).map_err(|found| invalid(format!("line {}: {found}", index + 1))));
    let pairs: Vec<PointPair> = pairs.collect::<Result<_, _>>()?;
    if pairs.is_empty() {
        return Err(invalid("found no pairs, expected at least 3".to_owned()).into());
    }
    Ok(pairs)
}

fn pair(line: &str) -> Result<PointPair, String> {
    let separated = |letter: char| letter == ',' || letter == ';' || letter.is_whitespace();
    let list: Vec<&str> = line.split(separated).filter(|word| !word.is_empty()).collect();
    let weighted = match list.len() {
        6 => [list.as_slice(), &["1"]].concat(),
        7 => list,
        count => return Err(format!("found {count} numbers, expected 6, or 7 with a weight")),
    };
    let [a, b, c, x, y, z, weight] = numbers(&weighted.join(","))?;
    Ok(PointPair { a: [a, b, c], b: [x, y, z], weight })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn datums_are_read_by_their_kind() {
        let read = |text: &str| text.parse::<DatumText>().map(|DatumText(datum)| datum);
        let faces = Datum { a: Feature::Face { index: 3 }, b: Feature::Face { index: 7 } };
        assert_eq!(read("face:3=7"), Ok(faces));
        let up = Feature::Plane { point: [0.0; 3], normal: [0.0, 0.0, 1.0] };
        assert_eq!(read("plane:0,0,0,0,0,1=0,0,0,0,0,1"), Ok(Datum { a: up, b: up }));
        for wrong in ["face:3", "3=7", "face:x=1", "plane:0,0,1=0,0,1", "line:1=2"] {
            assert!(read(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn pairs_have_six_numbers_and_perhaps_a_weight() {
        let of = |weight| PointPair { a: [1.0, 2.0, 3.0], b: [4.0, 5.0, 6.0], weight };
        assert_eq!(pair("1 2 3  4 5 6"), Ok(of(1.0)));
        assert_eq!(pair("1,2,3;4,5,6, 0.5"), Ok(of(0.5)));
        assert!(pair("1 2 3 4 5").is_err() && pair("1 2 3 4 5 x").is_err());
    }
}
