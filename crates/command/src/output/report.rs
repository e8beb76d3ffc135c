//! A result as text for people to read.

use nurbs_hausdorff::{
    Details, DistanceResult, SurfacePoint,
    result::{CertifiedDetails, HierarchyDetails, IterationDetails, Stop},
};
use std::fmt::{Result, Write};

/// Returns the lines below the first. Bounds and points are printed to full precision, so that rounding
/// cannot make an interval untrue.
pub(crate) fn text(result: &DistanceResult) -> String {
    let mut text = String::new();
    // Writing to a string does not fail.
    let _ = lines(&mut text, result);
    text
}

fn lines(out: &mut String, result: &DistanceResult) -> Result {
    interval(out, result)?;
    if result.gap > 0.0 {
        let origin = if result.gap_proven { "by what the files state" } else { "measured, not proven" };
        writeln!(out, "gap        {:?}, {origin}", result.gap)?;
        writeln!(out, "with gaps  [{:?}, {:?}]", result.with_gaps.lower, result.with_gaps.upper)?;
    }
    if let Some(unit) = result.unit {
        writeln!(out, "unit       {unit:?} m")?;
    }
    hint(out, result.hint.as_deref())?;
    point(out, "on A", &result.witness.a)?;
    point(out, "on B", &result.witness.b)?;
    for (name, directed) in [("A to B", &result.forward), ("B to A", &result.reverse)] {
        if let Some(directed) = directed {
            writeln!(out, "{name}     [{:?}, {:?}]", directed.lower, directed.upper)?;
            statistics(out, directed)?;
        }
    }
    match &result.details {
        Details::Certified(details) => certified(out, details)?,
        Details::Iteration(details) => iteration(out, details)?,
        Details::Hierarchy(details) => hierarchy(out, details)?,
        _ => {}
    }
    statistics(out, result)?;
    writeln!(out, "converged  {}", if result.converged { "yes" } else { "no" })?;
    writeln!(out, "patches    {} of A, {} of B", result.patches.a, result.patches.b)?;
    machine(out, result)
}

/// Writes what may be wrong with the units, if anything.
pub(crate) fn hint(out: &mut String, hint: Option<&str>) -> Result {
    hint.map_or(Ok(()), |hint| writeln!(out, "hint       {hint}"))
}

fn interval(out: &mut String, result: &DistanceResult) -> Result {
    write!(out, "interval   [{:?}, {:?}]", result.lower, result.upper)?;
    let width = (result.upper - result.lower) / result.diagonal;
    // The diagonal of models of one point is 0.
    if width.is_finite() {
        write!(out, ", width {width:.1e} of the diagonal {}", short(result.diagonal))?;
    }
    writeln!(out)
}

fn point(out: &mut String, name: &str, point: &SurfacePoint) -> Result {
    let SurfacePoint { face, face_name, u, v, triangle, barycentric, index, point: [x, y, z], .. } = point;
    if let Some(index) = index {
        return writeln!(out, "{name}       point {index}: {x:?} {y:?} {z:?}");
    }
    if let (Some(triangle), Some([a, b, c])) = (triangle, barycentric) {
        return writeln!(out, "{name}       triangle {triangle} at ({a:?}, {b:?}, {c:?}): {x:?} {y:?} {z:?}");
    }
    let face_name = face_name.as_ref().map_or(String::new(), |name| format!(" ({name})"));
    writeln!(out, "{name}       face {face}{face_name} at ({u:?}, {v:?}): {x:?} {y:?} {z:?}")
}

fn certified(out: &mut String, details: &CertifiedDetails) -> Result {
    let stop = match details.stop {
        Stop::Converged => "done",
        Stop::Cells => "ended by the budget of cells",
        Stop::Time => "ended by the budget of time",
        Stop::Precision => "ended by the precision of float64",
        Stop::Cancelled => "cancelled",
        _ => "ended",
    };
    writeln!(out, "search     {} cells, {} levels, {stop}", details.cells, details.levels)?;
    if details.stop == Stop::Precision {
        writeln!(
            out,
            "precision  coordinates of this size allow a tolerance of {:?}",
            details.min_tolerance
        )?;
    }
    Ok(())
}

fn iteration(out: &mut String, details: &IterationDetails) -> Result {
    let bounds = &details.bounds;
    let k_b = bounds.k_b.map_or("none observed".to_owned(), |k_b| format!("{} observed", short(k_b)));
    let (published, rigorous) = (short(bounds.k_a), short(bounds.k_a_rigorous));
    writeln!(out, "bounds     K_A {published} as published, {rigorous} rigorous; K_B {k_b}")?;
    let statuses = &details.statuses;
    writeln!(
        out,
        "samples    {}: {} converged, {} on an edge, {} at the iteration limit",
        details.samples, statuses.converged, statuses.on_edge, statuses.iteration_limit
    )
}

fn hierarchy(out: &mut String, details: &HierarchyDetails) -> Result {
    let pairs: Vec<String> = details.pairs.iter().map(u64::to_string).collect();
    let grid = details.grid;
    writeln!(out, "hierarchy  {grid} x {grid} cells a surface; pairs of boxes by level {}", pairs.join(", "))
}

fn statistics(out: &mut String, result: &DistanceResult) -> Result {
    let Some(statistics) = &result.statistics else { return Ok(()) };
    writeln!(
        out,
        "estimates  mean {}, rms {}, median {}, 95 % {}, 99 % {}",
        short(statistics.mean),
        short(statistics.rms),
        short(statistics.median),
        short(statistics.percentile_95),
        short(statistics.percentile_99)
    )
}

fn machine(out: &mut String, result: &DistanceResult) -> Result {
    let seconds = &result.seconds;
    let adapter = result.adapter.as_ref().map_or(String::new(), |adapter| format!(" ({adapter})"));
    writeln!(
        out,
        "seconds    {:.3} prepare, {:.3} compile, {:.3} solve, on the {}{adapter}",
        seconds.prepare, seconds.compile, seconds.solve, result.backend
    )?;
    result.notice.as_ref().map_or(Ok(()), |notice| writeln!(out, "notice     {notice}"))
}

/// The number to six digits without trailing zeros.
pub(crate) fn short(number: f64) -> String {
    let rounded = format!("{number:.5e}");
    rounded.parse::<f64>().map_or(rounded, |number| format!("{number:?}"))
}
