//! The global section: delimiters, the unit of length and the resolution.

use super::lines::error;
use super::values::{Delimiters, Value, values};
use nurbs_hausdorff::Result;

/// The facts of a file that concern all of its entities.
#[derive(Debug, Clone, Copy)]
pub(in crate::iges) struct Global {
    pub(super) delimiters: Delimiters,
    /// Millimetres per unit of length; `None` for a unit that is not known.
    pub(in crate::iges) unit: Option<f64>,
    /// The smallest distance that the file resolves, in its unit.
    pub(in crate::iges) resolution: f64,
}

/// The numbers, from 1, of the values that are read.
const UNIT_FLAG: usize = 14;
const UNIT_NAME: usize = 15;
const RESOLUTION: usize = 19;

/// The flag of a unit that its name alone states.
const BY_NAME: f64 = 3.0;

impl Global {
    /// Parses the section. A value that is left out has its default: delimiters `,` and `;`,
    /// inches, and no resolution.
    ///
    /// # Errors
    /// [`nurbs_hausdorff::Error::IgesSyntax`] for a section that does not end.
    pub(super) fn parse(lines: &[&[u8]], first_line: usize) -> Result<Self> {
        let text = lines.concat();
        let (value, rest) = delimiter(&text, b',');
        let rest = rest.strip_prefix(&[value]).unwrap_or(rest);
        let (record, rest) = delimiter(rest, b';');
        let delimiters = Delimiters { value, record };
        let rest = rest.strip_prefix(&[value]).unwrap_or(rest);
        let values = values(rest, delimiters)
            .map_err(|_| error(first_line, &text, "values up to the end of the global section"))?;
        // The delimiters are the first two values.
        let at = |number: usize| values.get(number - 3).unwrap_or(&Value::Omitted);
        let resolution = match at(RESOLUTION) {
            Value::Number(resolution) if *resolution > 0.0 => *resolution,
            _ => 0.0,
        };
        Ok(Self { delimiters, unit: unit(at(UNIT_FLAG), at(UNIT_NAME)), resolution })
    }
}

/// Reads a delimiter, a string of one character that may be left out.
fn delimiter(text: &[u8], default: u8) -> (u8, &[u8]) {
    let text = text.trim_ascii_start();
    match text {
        [b'1', b'H', delimiter, rest @ ..] => (*delimiter, rest),
        _ => (default, text),
    }
}

/// Returns a unit in millimetres.
fn unit(flag: &Value, name: &Value) -> Option<f64> {
    let flag = match flag {
        Value::Number(flag) => *flag,
        Value::Omitted => 1.0,
        _ => return None,
    };
    if flag == BY_NAME {
        let Value::Text(name) = name else { return None };
        let known =
            UNITS.iter().find(|(_, names, _)| names.contains(&name.trim().to_ascii_uppercase().as_str()));
        return known.map(|&(_, _, millimetres)| millimetres);
    }
    UNITS.iter().find(|&&(one, _, _)| one == flag).map(|&(_, _, millimetres)| millimetres)
}

/// Flags and names of units, and their lengths in millimetres.
const UNITS: [(f64, &[&str], f64); 10] = [
    (1.0, &["IN", "INCH"], 25.4),
    (2.0, &["MM"], 1.0),
    (4.0, &["FT"], 304.8),
    (5.0, &["MI"], 1_609_344.0),
    (6.0, &["M"], 1000.0),
    (7.0, &["KM"], 1e6),
    (8.0, &["MIL"], 0.0254),
    (9.0, &["UM"], 1e-3),
    (10.0, &["CM"], 10.0),
    (11.0, &["UIN"], 2.54e-5),
];
