//! The columns of x, y and z, by their names.

/// The names of the columns of each axis, in lower case and without blanks and marks. Those of the
/// first entry come before all others: a file may have a column `height` besides `z`.
const NAMES: [[&[&str]; 3]; 2] = [
    [&["x"], &["y"], &["z"]],
    [
        &[
            "easting",
            "east",
            "e",
            "xcoord",
            "xcoordinate",
            "coordx",
            "posx",
            "positionx",
            "pointsx",
            "points0",
            "point0",
            "position0",
            "xm",
            "xmm",
        ],
        &[
            "northing",
            "north",
            "n",
            "ycoord",
            "ycoordinate",
            "coordy",
            "posy",
            "positiony",
            "pointsy",
            "points1",
            "point1",
            "position1",
            "ym",
            "ymm",
        ],
        &[
            "elevation",
            "elev",
            "height",
            "altitude",
            "h",
            "zcoord",
            "zcoordinate",
            "coordz",
            "posz",
            "positionz",
            "pointsz",
            "points2",
            "point2",
            "position2",
            "zm",
            "zmm",
        ],
    ],
];

/// The metres of the units that names of columns state in brackets.
const UNITS: [(&str, f64); 8] = [
    ("m", 1.0),
    ("dm", 0.1),
    ("cm", 1e-2),
    ("mm", 1e-3),
    ("um", 1e-6),
    ("km", 1e3),
    ("in", 0.0254),
    ("ft", 0.3048),
];

/// The columns of x, y and z, and the metres of the unit that their names state.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Columns {
    pub(super) places: [usize; 3],
    pub(super) unit: Option<f64>,
    /// Whether the names state units that differ.
    pub(super) have_several_units: bool,
}

impl Columns {
    /// Returns the columns of these names; none unless each axis has one column.
    pub(super) fn named(names: &[&str]) -> Option<Self> {
        let places = NAMES.iter().find_map(|spellings| {
            let mut places = [0; 3];
            for (place, spellings) in places.iter_mut().zip(spellings) {
                let mut found = (0..names.len()).filter(|&at| spellings.contains(&key(names[at]).as_str()));
                *place = found.next()?;
                if found.next().is_some() {
                    return None;
                }
            }
            Some(places)
        })?;
        let units = places.map(|place| unit(names[place]));
        let [x, y, z] = units;
        let mut stated = units.into_iter().flatten();
        let first = stated.next();
        let have_several_units = stated.any(|unit| Some(unit) != first);
        Some(Self { places, unit: x.filter(|_| x == y && y == z), have_several_units })
    }

    /// Returns the unit that the names of the coordinates state, if that unit is unknown.
    pub(super) fn unknown_unit<'a>(&self, names: &[&'a str]) -> Option<&'a str> {
        let stated = self.places.iter().filter_map(|&place| stem_and_unit(names.get(place)?).1);
        stated.map(str::trim).find(|unit| !unit.is_empty() && metres(unit).is_none())
    }

    /// Whether the columns follow each other, as those of names in a comment of words need not.
    pub(super) fn are_adjacent(&self) -> bool {
        let mut sorted = self.places;
        sorted.sort_unstable();
        sorted[0] + 1 == sorted[1] && sorted[1] + 1 == sorted[2]
    }
}

/// Returns a name in lower case, without its unit, blanks and marks.
fn key(name: &str) -> String {
    let name = stem_and_unit(name).0;
    name.chars().filter(|character| character.is_alphanumeric()).flat_map(char::to_lowercase).collect()
}

/// Returns the metres of the unit of a name.
fn unit(name: &str) -> Option<f64> {
    metres(stem_and_unit(name).1?)
}

/// Returns a name and what stands in brackets behind it, `x [mm]`, or the unit behind its last underscore, `x_mm`.
fn stem_and_unit(name: &str) -> (&str, Option<&str>) {
    if let Some((stem, rest)) = name.split_once(['[', '(', '{']) {
        return (stem, rest.split([']', ')', '}']).next());
    }
    match name.rsplit_once('_') {
        Some((stem, unit)) if metres(unit).is_some() => (stem, Some(unit)),
        _ => (name, None),
    }
}

fn metres(unit: &str) -> Option<f64> {
    UNITS.iter().find(|(name, _)| unit.trim().eq_ignore_ascii_case(name)).map(|&(_, metres)| metres)
}
