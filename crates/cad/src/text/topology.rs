//! The section of shapes: vertices, edges, wires, faces and what contains them.

use super::lexer::{Dimension, Lexer};
use crate::report::FaceFault;
use crate::topology::{Edge, Face, Orientation, PCurve, Shape, ShapeKind, SpaceCurve, Use};
use glam::DAffine3;
use nurbs_hausdorff::Result;

/// The sections above the shapes, to which shapes refer.
pub(super) struct Sections<'a> {
    pub(super) version: u8,
    pub(super) locations: &'a [DAffine3],
    pub(super) curves_2d: usize,
    pub(super) curves_3d: usize,
    pub(super) surfaces: usize,
}

/// Reads the shapes and the root. Children precede their parents, so that shapes
/// form no cycles.
pub(super) fn read(lexer: &mut Lexer<'_>, sections: &Sections<'_>) -> Result<(Vec<Shape>, Use)> {
    lexer.keyword("TShapes")?;
    let count = lexer.count("the number of shapes")?;
    let mut shapes = Vec::new();
    for _ in 0..count {
        let kind = kind(lexer, sections)?;
        let mut flags = lexer.word("the flags of a shape")?;
        // A face that was triangulated names its triangles first.
        if flags == "2" && matches!(kind, ShapeKind::Face(_)) {
            lexer.count("the index of a triangulation")?;
            flags = lexer.word("the flags of a shape")?;
        }
        if flags.len() != 7 || !flags.bytes().all(|byte| matches!(byte, b'0' | b'1')) {
            return Err(lexer.error(flags, "the 7 flags of a shape"));
        }
        let mut children = Vec::new();
        while lexer.peek() != Some("*") {
            children.push(child(lexer, sections, count, shapes.len())?);
        }
        lexer.keyword("*")?;
        shapes.push(Shape { kind, children });
    }
    let root = child(lexer, sections, count, shapes.len())?;
    Ok((shapes, root))
}

/// Reads the use of a shape. Shapes are numbered from the last to the first.
fn child(lexer: &mut Lexer<'_>, sections: &Sections<'_>, count: usize, read: usize) -> Result<Use> {
    const EXPECTED: &str = "+, -, i or e and the number of a shape above";
    let word = lexer.word(EXPECTED)?;
    let orientation = match word.as_bytes()[0] {
        b'+' => Orientation::Forward,
        b'-' => Orientation::Reversed,
        b'i' => Orientation::Internal,
        b'e' => Orientation::External,
        _ => return Err(lexer.error(word, EXPECTED)),
    };
    let shape = word[1..].parse::<usize>().ok().and_then(|number| count.checked_sub(number));
    match shape {
        Some(shape) if shape < read => Ok(Use { shape, orientation, location: location(lexer, sections)? }),
        _ => Err(lexer.error(word, EXPECTED)),
    }
}

fn location(lexer: &mut Lexer<'_>, sections: &Sections<'_>) -> Result<DAffine3> {
    let index = lexer.index(sections.locations.len() - 1, "the index of a location")?;
    Ok(sections.locations[index])
}

fn kind(lexer: &mut Lexer<'_>, sections: &Sections<'_>) -> Result<ShapeKind> {
    const KINDS: &str = "a kind of shape: Ve, Ed, Wi, Fa, Sh, So, CS or Co";
    let kind = lexer.word(KINDS)?;
    Ok(match kind {
        "Ve" => vertex(lexer, sections)?,
        "Ed" => ShapeKind::Edge(edge(lexer, sections)?),
        "Wi" => ShapeKind::Wire,
        "Fa" => {
            const NATURAL: &str = "0, or 1 for natural bounds, or 2 for triangles only";
            let word = lexer.word(NATURAL)?;
            match word {
                "0" | "1" => {}
                "2" => {
                    lexer.count("the index of a triangulation")?;
                    let why = "the face has triangles and no surface";
                    let surface = Err(FaceFault::new("BREP_NO_SURFACE", why));
                    return Ok(ShapeKind::Face(Face { surface, ..Face::on(0) }));
                }
                _ => return Err(lexer.error(word, NATURAL)),
            }
            lexer.number("a tolerance")?;
            let surface = lexer.index(sections.surfaces, "the index of a surface")?.checked_sub(1);
            let surface = surface.ok_or_else(|| FaceFault::new("BREP_NO_SURFACE", "the face has no surface"));
            ShapeKind::Face(Face { surface, location: location(lexer, sections)?, ..Face::on(0) })
        }
        "So" => ShapeKind::Solid(None),
        "Sh" | "CS" | "Co" => ShapeKind::Group(None),
        _ => return Err(lexer.error(kind, KINDS)),
    })
}

/// Reads a vertex and its tolerance, and skips its parameters on curves and surfaces.
fn vertex(lexer: &mut Lexer<'_>, sections: &Sections<'_>) -> Result<ShapeKind> {
    const KINDS: &str = "the kind of a vertex's parameter, 0 to 3";
    let tolerance = lexer.number("a tolerance")?;
    lexer.point(Dimension::Three)?;
    loop {
        lexer.number("a vertex's parameter")?;
        let kind = lexer.word(KINDS)?;
        match kind {
            "0" => return Ok(ShapeKind::Vertex(tolerance)),
            "1" => drop(lexer.index(sections.curves_3d, "the index of a curve")?),
            "2" => {
                lexer.index(sections.curves_2d, "the index of a curve")?;
                lexer.index(sections.surfaces, "the index of a surface")?;
            }
            "3" => {
                lexer.number("a vertex's parameter")?;
                lexer.index(sections.surfaces, "the index of a surface")?;
            }
            _ => return Err(lexer.error(kind, KINDS)),
        }
        location(lexer, sections)?;
    }
}

fn edge(lexer: &mut Lexer<'_>, sections: &Sections<'_>) -> Result<Edge> {
    const KINDS: &str = "the kind of an edge's representation, 0 to 7";
    let tolerance = lexer.number("a tolerance")?;
    lexer.flag("the flag of equal parameters")?;
    lexer.flag("the flag of equal ranges")?;
    let degenerate = lexer.flag("the flag of degenerate edges")?;
    let mut edge = Edge { tolerance, degenerate, curve: None, p_curves: Vec::new() };
    loop {
        let kind = lexer.word(KINDS)?;
        match kind {
            "0" => return Ok(edge),
            "1" => {
                let curve = lexer.index(sections.curves_3d, "the index of a curve")?.checked_sub(1);
                let (location, range) = (location(lexer, sections)?, range(lexer)?);
                edge.curve = curve.map(|curve| SpaceCurve { curve, location, range }).or(edge.curve);
            }
            "2" | "3" => edge.p_curves.extend(p_curve(lexer, sections, kind == "3")?),
            "4" => {
                lexer.word("a continuity")?;
                for _ in 0..2 {
                    lexer.index(sections.surfaces, "the index of a surface")?;
                    location(lexer, sections)?;
                }
            }
            "5" => {
                lexer.count("the index of a polygon")?;
                location(lexer, sections)?;
            }
            "6" | "7" => {
                // One polygon, or the two of a seam, and the triangles that they are on.
                for _ in 0..if kind == "7" { 3 } else { 2 } {
                    lexer.count("the index of a polygon or triangulation")?;
                }
                location(lexer, sections)?;
            }
            _ => return Err(lexer.error(kind, KINDS)),
        }
    }
}

/// Reads a curve on a surface; `None` if the file refers to no curve or surface.
fn p_curve(lexer: &mut Lexer<'_>, sections: &Sections<'_>, seam: bool) -> Result<Option<PCurve>> {
    const INDEX: &str = "the index of a curve";
    let first = lexer.index(sections.curves_2d, INDEX)?;
    let mut second = first;
    if seam {
        // The continuity follows the index without a space.
        let word = lexer.word(INDEX)?;
        let digits = word.bytes().take_while(u8::is_ascii_digit).count();
        second = match word[..digits].parse() {
            Ok(index) if index <= sections.curves_2d => index,
            _ => return Err(lexer.error(word, INDEX)),
        };
        if digits == word.len() {
            lexer.word("a continuity")?;
        }
    }
    let surface = lexer.index(sections.surfaces, "the index of a surface")?;
    let (location, range) = (location(lexer, sections)?, range(lexer)?);
    if sections.version == 2 {
        // The ends of the curve, of a seam those of one of its curves.
        for _ in 0..4 {
            lexer.number("a coordinate of an end")?;
        }
    }
    Ok((first > 0 && second > 0 && surface > 0).then(|| PCurve {
        curves: [first - 1, second - 1],
        surface: surface - 1,
        location,
        range,
    }))
}

fn range(lexer: &mut Lexer<'_>) -> Result<[f64; 2]> {
    Ok([lexer.number("a parameter")?, lexer.number("a parameter")?])
}
