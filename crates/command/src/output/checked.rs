//! The result of a check as text and as rows of a report.

use super::digits::{bounded, coordinates, interval, number};
use super::json::raw;
use crate::failure::Failure;
use crate::reports::{Answer, Outcome, Row, Rows, Verdict};
use nurbs_hausdorff::{
    BodyPair, CheckResult, CheckedBody, EmbeddedDoubt, EmbeddedUnknown, Orientation, PairState, Rule,
    SelfOverlap, UnkeptRule, one_line,
};
use std::fmt::Write;
use std::path::PathBuf;

/// The largest number of pairs in the first line, and of bodies that may be faulty; below it, all pairs are listed.
const MAX_NAMED: usize = 3;

/// Returns the verdict with the worst pairs, and a line for each pair, rule and faulty body, and for some bodies that may
/// be faulty.
pub(crate) fn text(result: &CheckResult, verdict: Verdict) -> String {
    let mut out = format!("{}\n", first(result, verdict));
    // Writing to a string does not fail, here and below.
    for pair in &result.pairs {
        let _ = writeln!(out, "{:<10} {}: {}", word(pair), both(pair), summary(pair, result));
    }
    for rule in &result.rules {
        let _ = writeln!(out, "{:<10} {}", rule_word(rule), rule_text(rule));
    }
    for body in &result.bodies {
        for fault in faults(body, result.diagonal) {
            let _ = writeln!(out, "body       {}: {fault}", one_line(&body.name));
        }
    }
    let of = |state| result.count(state);
    let _ = writeln!(
        out,
        "pairs      {} of {} bodies: {} clash, {} undecided, {} touching, {} near",
        result.pair_count,
        result.bodies.len(),
        of(PairState::Clash),
        of(PairState::Undecided),
        of(PairState::Touching),
        of(PairState::Near)
    );
    // The tolerance is a part of the diagonal unless the user states one: two digits suffice.
    let tolerance = format!("{:.1e}", result.tolerance).parse().unwrap_or(result.tolerance);
    let _ = writeln!(out, "tolerance  {}, up to which bodies touch", number(tolerance));
    let embedded = |known| result.bodies.iter().filter(|body| body.embedded == known).count();
    let _ = writeln!(
        out,
        "bodies     {}: {} embedded, {} meet themselves, {} undecided",
        result.bodies.len(),
        embedded(Some(true)),
        embedded(Some(false)),
        embedded(None)
    );
    let doubts = result.bodies.iter().filter_map(|body| Some((body, body.embedded_unknown.as_ref()?)));
    for (body, unknown) in doubts.take(MAX_NAMED) {
        let _ = writeln!(out, "body       {}: {}", one_line(&body.name), doubt(unknown, result.diagonal));
    }
    let _ =
        writeln!(out, "seconds    {:.3} prepare, {:.3} solve", result.seconds.prepare, result.seconds.solve);
    out
}

/// Returns the first line: `CLASH: 2 of 45 pairs: shaft and housing, at 1 2 3; …`.
fn first(result: &CheckResult, verdict: Verdict) -> String {
    let judged = |state| -> Vec<&BodyPair> {
        result.pairs.iter().filter(|pair| pair.state == state && !pair.intended).collect()
    };
    let listed = |name: &str, pairs: &[&BodyPair]| {
        let place =
            |pair: &&BodyPair| format!("{}, at {}", both(pair), coordinates(pair.point, result.diagonal));
        let mut places: Vec<String> = pairs.iter().take(MAX_NAMED).map(place).collect();
        if pairs.len() > MAX_NAMED {
            places.push(format!("and {} more", pairs.len() - MAX_NAMED));
        }
        format!("{name}: {} of {}: {}", pairs.len(), counted(result.pair_count, "pair"), places.join("; "))
    };
    let clashes = judged(PairState::Clash);
    if !clashes.is_empty() {
        return listed("CLASH", &clashes);
    }
    if let Some(rule) = result.rules.iter().find(|rule| rule.broken) {
        let count = result.rules.iter().filter(|rule| rule.broken).count();
        return format!("BROKEN: {}: {}", counted(count, "rule"), rule_text(rule));
    }
    let undecided = judged(PairState::Undecided);
    match (verdict, undecided.is_empty(), result.rules.first()) {
        (Verdict::Passed, ..) => format!(
            "CLEAN: {}, {} touching, {} near{}",
            counted(result.pair_count, "pair"),
            result.count(PairState::Touching),
            result.count(PairState::Near),
            crossed(result)
        ),
        (_, false, _) => listed("UNDECIDED", &undecided),
        (_, true, Some(rule)) => format!("UNDECIDED: {}", rule_text(rule)),
        (_, true, None) => "UNDECIDED: faces were left out".to_owned(),
    }
}

/// Returns how many bodies certainly meet themselves, where any do: no part of the verdict, and no clean model either.
fn crossed(result: &CheckResult) -> String {
    match result.bodies.iter().filter(|body| body.self_overlap.is_some()).count() {
        0 => String::new(),
        1 => "; 1 body meets itself".to_owned(),
        count => format!("; {count} bodies meet themselves"),
    }
}

/// Returns a row for each pair that is listed, with what `draw` makes of it, each rule that is not kept and each body
/// with a fault.
///
/// # Errors
/// That of JSON which cannot be written; those of `draw`.
pub(crate) fn rows(
    result: &CheckResult,
    files: &[PathBuf],
    mut draw: impl FnMut(&BodyPair) -> Result<String, Failure>,
) -> Result<Rows, Failure> {
    let mut rows = Vec::new();
    for pair in &result.pairs {
        let verdict = match pair.state {
            _ if pair.intended => Verdict::Passed,
            PairState::Clash => Verdict::Failed,
            PairState::Undecided => Verdict::Undecided,
            _ => Verdict::Passed,
        };
        rows.push(row(both(pair), verdict, word(pair), summary(pair, result), pair, draw(pair)?)?);
    }
    for rule in &result.rules {
        let verdict = if rule.broken { Verdict::Failed } else { Verdict::Undecided };
        let path = format!("{} and {}", rule.a, rule.b);
        rows.push(row(path, verdict, rule_word(rule), rule_text(rule), rule, String::new())?);
    }
    for body in &result.bodies {
        let faults = faults(body, result.diagonal);
        if !faults.is_empty() {
            rows.push(row(
                body.name.clone(),
                Verdict::Passed,
                "body",
                faults.join(", "),
                body,
                String::new(),
            )?);
        }
    }
    if rows.is_empty() {
        let summary =
            format!("{}, none nearer than {}", counted(result.pair_count, "pair"), number(result.below));
        rows.push(row(
            "all pairs".to_owned(),
            Verdict::Passed,
            "apart",
            summary,
            &result.bodies,
            String::new(),
        )?);
    }
    let names: Vec<String> = files.iter().map(|file| one_line(&file.display().to_string())).collect();
    Ok(Rows::new("check", [names.join(", "), String::new()], rows, [("", None), ("", None)]))
}

fn row(
    path: String,
    verdict: Verdict,
    word: &str,
    summary: String,
    json: &impl serde::Serialize,
    figures: String,
) -> Result<Row, Failure> {
    let answer = Answer {
        verdict,
        limit: None,
        judged: true,
        word: word.to_owned(),
        summary,
        findings: Vec::new(),
        text: String::new(),
        seconds: 0.0,
        repeatable: true,
        json: raw(json)?,
        figures,
    };
    Ok(Row { path: one_line(&path), outcome: Outcome::Answered(Box::new(answer)) })
}

fn counted(count: usize, noun: &str) -> String {
    format!("{count} {noun}{}", if count == 1 { "" } else { "s" })
}

fn both(pair: &BodyPair) -> String {
    format!("{} and {}", one_line(&pair.a), one_line(&pair.b))
}

fn word(pair: &BodyPair) -> &'static str {
    match pair.state {
        PairState::Clash if pair.intended => "intended",
        PairState::Clash => "clash",
        PairState::Touching => "touching",
        PairState::Near => "near",
        PairState::Apart => "apart",
        _ => "undecided",
    }
}

fn summary(pair: &BodyPair, result: &CheckResult) -> String {
    let at = coordinates(pair.point, result.diagonal);
    let ends = [pair.clearance.lower, pair.clearance.upper];
    if pair.state != PairState::Clash {
        return format!("{} apart at {at}", bounded(pair.clearance.upper, ends));
    }
    let volume = pair
        .volume
        .map(|found| format!("; common volume {}", bounded(found.middle(), [found.lower, found.upper])));
    // A number between ends that are far apart would say more than is known.
    let depth = pair.depth.map(|found| format!("; depth {}", interval([found.lower, found.upper])));
    format!("both have {at} inside{}{}", volume.unwrap_or_default(), depth.unwrap_or_default())
}

fn rule_word(rule: &UnkeptRule) -> &'static str {
    if rule.broken { "broken" } else { "undecided" }
}

fn rule_text(rule: &UnkeptRule) -> String {
    let [a, b] = [&rule.a, &rule.b].map(|name| one_line(name));
    match rule.rule {
        Rule::MustTouch => format!("{a} must touch {b}"),
        _ => {
            let required = rule.distance.map(number).unwrap_or_default();
            let found = rule.clearance.map(|found| bounded(found.upper, [found.lower, found.upper]));
            format!("{a} and {b} must be at least {required} apart: {}", found.unwrap_or_default())
        }
    }
}

fn meets_itself(SelfOverlap { point, winding, faces, .. }: &SelfOverlap, diagonal: f64) -> String {
    let at = coordinates(*point, diagonal);
    let faces: Vec<String> = faces.iter().map(usize::to_string).collect();
    let faces = if faces.is_empty() { String::new() } else { format!(", faces {}", faces.join(" and ")) };
    match winding {
        2.. => format!("meets itself: space counts {winding} times at {at}{faces}"),
        _ => format!("meets itself: walls have passed through each other at {at}{faces}"),
    }
}

/// Returns why it is not known whether a body is embedded, with the place.
fn doubt(EmbeddedUnknown { why, faces, point, .. }: &EmbeddedUnknown, diagonal: f64) -> String {
    let of = match &faces[..] {
        [] => String::new(),
        [face] => format!(" of face {face} with itself"),
        faces => {
            format!(" of faces {}", faces.iter().map(usize::to_string).collect::<Vec<_>>().join(" and "))
        }
    };
    let at = point.map(|point| format!(" at {}", coordinates(point, diagonal))).unwrap_or_default();
    let what = match why {
        EmbeddedDoubt::Contact => format!("a contact{of}{at} that may be a crossing"),
        EmbeddedDoubt::Budget => format!("the budget ended{at}"),
        EmbeddedDoubt::Gaps => "it is a mesh with gaps".to_owned(),
        _ => "it has too many triangles".to_owned(),
    };
    format!("may meet itself: {what}")
}

/// What is wrong with a body by itself.
fn faults(body: &CheckedBody, diagonal: f64) -> Vec<String> {
    let mut faults = Vec::new();
    if !body.closed {
        faults.push("is not closed".to_owned());
    }
    match body.orientation {
        Some(Orientation::InsideOut) => faults.push("is inside out".to_owned()),
        Some(Orientation::Mixed) => faults.push("has faces that are turned over".to_owned()),
        Some(Orientation::NotOrientable) => faults.push("has no sides that agree".to_owned()),
        _ => {}
    }
    if body.degenerate {
        faults.push("has no inside within the tolerance".to_owned());
    }
    faults.extend(body.self_overlap.as_ref().map(|found| meets_itself(found, diagonal)));
    if !body.duplicates.is_empty() {
        let names: Vec<String> = body.duplicates.iter().map(|name| one_line(name)).collect();
        faults.push(format!("has the shape and place of {}", names.join(", ")));
    }
    faults
}
