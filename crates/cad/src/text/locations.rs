//! The section of locations: elementary transforms and products of their powers.

use super::lexer::Lexer;
use glam::{DAffine3, DMat3, DVec3};
use nurbs_hausdorff::Result;

/// The largest power in a product. Assemblies use 1 and -1; computing a power takes
/// time in proportion to it.
const MAX_POWER: i64 = 1024;

/// Reads the locations; index 0 is the identity, which the file does not list.
pub(super) fn read(lexer: &mut Lexer<'_>) -> Result<Vec<DAffine3>> {
    lexer.keyword("Locations")?;
    let count = lexer.count("the number of locations")?;
    let mut locations = vec![DAffine3::IDENTITY];
    for _ in 0..count {
        let kind = lexer.word("the kind of a location, 1 or 2")?;
        let location = match kind {
            "1" => elementary(lexer)?,
            "2" => product(lexer, &locations)?,
            _ => return Err(lexer.error(kind, "the kind of a location, 1 or 2")),
        };
        if !location.is_finite() {
            return Err(lexer.error("a location that overflows", "a location of finite numbers"));
        }
        locations.push(location);
    }
    Ok(locations)
}

/// Reads a matrix of three rows, each with its translation.
fn elementary(lexer: &mut Lexer<'_>) -> Result<DAffine3> {
    let mut rows = [[0.0; 4]; 3];
    for value in rows.as_flattened_mut() {
        *value = lexer.number("an entry of a location's matrix")?;
    }
    let column = |index: usize| DVec3::new(rows[0][index], rows[1][index], rows[2][index]);
    let matrix = DMat3::from_cols(column(0), column(1), column(2));
    if matrix.determinant() == 0.0 {
        return Err(lexer.error("a singular matrix", "a location's matrix of non-zero determinant"));
    }
    Ok(DAffine3 { matrix3: matrix, translation: column(3) })
}

/// Reads pairs of index and power up to the index 0. Each factor is applied after those
/// listed before it.
fn product(lexer: &mut Lexer<'_>, locations: &[DAffine3]) -> Result<DAffine3> {
    let mut product = DAffine3::IDENTITY;
    loop {
        let index = lexer.index(locations.len() - 1, "the index of a location above, or 0")?;
        if index == 0 {
            return Ok(product);
        }
        let word = lexer.peek().unwrap_or_default();
        let power = lexer.integer("the power of a location")?;
        if power.abs() > MAX_POWER {
            return Err(lexer.error(word, "a power of at most 1024"));
        }
        let factor = if power < 0 { locations[index].inverse() } else { locations[index] };
        for _ in 0..power.abs() {
            product = factor * product;
        }
    }
}
