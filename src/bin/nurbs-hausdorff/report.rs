//! A result as text for people.

use nurbs_hausdorff::distance::{DistanceResult, SurfacePoint};
use std::fmt::Write;

/// Some lines, the distance first.
pub(crate) fn text(result: &DistanceResult) -> String {
    let mut text = String::new();
    // Writing to a string does not fail.
    let _ = lines(&mut text, result);
    text
}

fn lines(out: &mut String, result: &DistanceResult) -> std::fmt::Result {
    writeln!(out, "distance   {:.12}", result.computed)?;
    writeln!(
        out,
        "interval   [{:.12}, {:.12}], width {:.1e} of the diagonal {:.6}",
        result.lower,
        result.upper,
        (result.upper - result.lower) / result.diagonal,
        result.diagonal
    )?;
    point(out, "on A", &result.witness.a)?;
    point(out, "on B", &result.witness.b)?;
    if let Some(details) = &result.certified {
        writeln!(out, "search     {} cells, {} levels, {:?}", details.cells, details.levels, details.stop)?;
        if let Some(within) = details.within {
            writeln!(out, "limit      {}", if within { "kept" } else { "exceeded" })?;
        }
    }
    if let Some(details) = &result.iteration {
        let bounds = &details.bounds;
        let k_b = bounds.k_b.map_or("none observed".to_owned(), |k_b| format!("{k_b:.3e}"));
        writeln!(
            out,
            "bounds     K_A {:.6} as published, {:.6} rigorous; K_B {k_b}",
            bounds.k_a, bounds.k_a_rigorous
        )?;
        let statuses = &details.statuses;
        writeln!(
            out,
            "samples    {}: {} converged, {} on an edge, {} at the iteration limit",
            details.samples, statuses.converged, statuses.on_edge, statuses.iteration_limit
        )?;
    }
    if let Some(statistics) = &result.statistics {
        writeln!(
            out,
            "estimates  mean {:.6}, rms {:.6}, median {:.6}, 95 % {:.6}, 99 % {:.6}",
            statistics.mean,
            statistics.rms,
            statistics.median,
            statistics.percentile_95,
            statistics.percentile_99
        )?;
    }
    writeln!(out, "converged  {}", if result.converged { "yes" } else { "no" })?;
    writeln!(out, "patches    {} of A, {} of B", result.patches.a, result.patches.b)?;
    let seconds = &result.seconds;
    writeln!(
        out,
        "seconds    {:.3} prepare, {:.3} compile, {:.3} solve, on the {}{}",
        seconds.prepare,
        seconds.compile,
        seconds.solve,
        result.backend,
        result.adapter.as_ref().map_or(String::new(), |adapter| format!(" ({adapter})"))
    )?;
    if let Some(notice) = &result.notice {
        writeln!(out, "notice     {notice}")?;
    }
    for (name, directed) in [("A to B", &result.forward), ("B to A", &result.reverse)] {
        if let Some(directed) = directed {
            writeln!(out, "{name}     [{:.12}, {:.12}]", directed.lower, directed.upper)?;
        }
    }
    Ok(())
}

fn point(out: &mut String, name: &str, point: &SurfacePoint) -> std::fmt::Result {
    let [x, y, z] = point.point;
    writeln!(
        out,
        "{name}       surface {} at ({:.9}, {:.9}): {x:.9} {y:.9} {z:.9}",
        point.surface, point.u, point.v
    )
}
