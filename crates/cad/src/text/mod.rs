//! Reading of the text into curves, surfaces and shapes, as they stand in it.

mod curves;
mod lexer;
mod locations;
mod surfaces;
mod topology;

use super::topology::Topology;
use lexer::{Dimension, Lexer};
use nurbs_hausdorff::Result;
use std::collections::HashMap;
use topology::Sections;

/// Parses a text. O(length).
///
/// # Errors
/// [`nurbs_hausdorff::Error::BrepSyntax`] with the line of the first word that is not what
/// the format requires.
pub(super) fn parse(text: &str) -> Result<Topology> {
    let mut lexer = Lexer::new(text);
    let version = version(&mut lexer)?;
    let locations = locations::read(&mut lexer)?;
    let p_curves = curves::read(&mut lexer, "Curve2ds", Dimension::Two)?;
    let curves = curves::read(&mut lexer, "Curves", Dimension::Three)?;
    // Polygons and triangles approximate what the curves and surfaces give exactly.
    skip_to(&mut lexer, "Surfaces")?;
    let surfaces = surfaces::read(&mut lexer)?;
    skip_to(&mut lexer, "TShapes")?;
    let sections = Sections {
        version,
        locations: &locations,
        curves_2d: p_curves.len(),
        curves_3d: curves.len(),
        surfaces: surfaces.len(),
    };
    let (shapes, root) = topology::read(&mut lexer, &sections)?;
    let colors = HashMap::new();
    Ok(Topology { p_curves, curves, surfaces, shapes, root, unit: None, colors, remarks: Vec::new() })
}

/// Reads the header, `CASCADE Topology V1` to `V3`, before which the name of a Draw
/// object may stand.
fn version(lexer: &mut Lexer<'_>) -> Result<u8> {
    const HEADER: &str = "the header CASCADE Topology V1, V2 or V3";
    let mut word = lexer.word(HEADER)?;
    if word == "DBRep_DrawableShape" {
        word = lexer.word(HEADER)?;
    }
    if word != "CASCADE" {
        return Err(lexer.error(word, HEADER));
    }
    lexer.keyword("Topology")?;
    let word = lexer.word(HEADER)?;
    let version = match word.trim_end_matches(',') {
        "V1" => 1,
        "V2" => 2,
        "V3" => 3,
        _ => return Err(lexer.error(word, HEADER)),
    };
    lexer.rest_of_line();
    Ok(version)
}

/// Skips words up to the keyword of a section.
fn skip_to(lexer: &mut Lexer<'_>, keyword: &str) -> Result<()> {
    while lexer.peek() != Some(keyword) {
        lexer.word(keyword)?;
    }
    Ok(())
}
