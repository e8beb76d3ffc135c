//! The section of a report on one pair: verdict, what was allowed and found, where, files and faces.

use super::histogram::histogram;
use super::{Answer, Outcome, Row, Verdict};
use quick_xml::escape::escape;
use serde_json::Value;
use std::fmt::Write;

/// The largest number of faces of one pair in the report; JSON has all.
const MAX_FACES: usize = 200;

/// What a section without pictures says.
pub(crate) const NO_PICTURES: &str =
    "<p>The sections before this one have pictures; there are no more in one report.</p>";

/// Both models, as JSON names them and as people read them.
const SIDES: [(&str, &str); 2] = [("a", "A"), ("b", "B")];

/// Writes the section, for a pair that was answered.
pub(super) fn section(text: &mut String, row: &Row) {
    let Outcome::Answered(answer) = &row.outcome else { return };
    // The JSON is of this program.
    let found: Value = serde_json::from_str(answer.json.get()).unwrap_or_default();
    let sentence = format!("{}: {}", answer.word, answer.summary);
    // Writing to a string does not fail, here and below.
    let _ = write!(
        text,
        "<section class=\"pair status-{}\">\n<h2>{}</h2>\n<p><b class=\"badge\">{}</b> {}</p>\n<dl>\n",
        row.status(),
        escape(&row.path),
        badge(answer),
        escape(&sentence)
    );
    for (term, of) in if answer.judged { terms_of_bodies(&found) } else { terms(answer.limit, &found) } {
        if let Some(of) = of {
            let _ = writeln!(text, "<dt>{term}</dt><dd>{}</dd>", escape(&of));
        }
    }
    text.push_str("</dl>\n");
    files(text, &found);
    text.push_str(&answer.figures);
    if answer.figures.is_empty() && !answer.judged {
        let _ = writeln!(text, "{NO_PICTURES}");
    }
    text.push_str(&histogram(&upper_ends(&found), answer.limit));
    faces(text, &found);
    text.push_str("</section>\n");
}

fn badge(answer: &Answer) -> &'static str {
    match (answer.judged || answer.limit.is_some(), answer.verdict) {
        (false, _) => "NO VERDICT",
        (_, Verdict::Passed) => "PASS",
        (_, Verdict::Failed) => "FAIL",
        (_, Verdict::Undecided) => "UNDECIDED",
        (_, Verdict::Error) => "ERROR",
    }
}

/// Terms with their texts, where the answer has them.
fn terms(limit: Option<f64>, found: &Value) -> Vec<(&'static str, Option<String>)> {
    let gap = found["gap"].as_f64().filter(|&gap| gap > 0.0);
    let witness = &found["witness"];
    let point = &witness["a"]["point"];
    vec![
        ("Allowed deviation", Some(limit.map_or("not stated".to_owned(), full))),
        ("Found", number(&found["computed"])),
        ("Certified interval", interval(found)),
        ("Precision", number(&found["tolerance"])),
        ("Gap of the files", gap.map(full)),
        ("With the gaps of the files", gap.and_then(|_| interval(&found["withGaps"]))),
        ("Where", witness.is_object().then(|| SIDES.map(|side| place(side, witness)).join(", "))),
        ("At", point.is_array().then(|| coordinates(point))),
        ("Metres per unit", number(&found["unit"])),
    ]
}

/// The same of two bodies, or of a rule on them.
fn terms_of_bodies(found: &Value) -> Vec<(&'static str, Option<String>)> {
    let point = &found["point"];
    vec![
        ("Required distance", number(&found["distance"])),
        ("Clearance", interval(&found["clearance"])),
        ("Common volume", interval(&found["volume"])),
        ("Depth", interval(&found["depth"])),
        ("At", point.is_array().then(|| coordinates(point))),
        ("Undecided because of", found["why"].as_str().map(str::to_owned)),
    ]
}

pub(super) fn full(value: f64) -> String {
    format!("{value:?}")
}

fn number(value: &Value) -> Option<String> {
    value.as_f64().map(full)
}

fn interval(of: &Value) -> Option<String> {
    Some(format!("[{}, {}]", number(&of["lower"])?, number(&of["upper"])?))
}

fn place((key, name): (&str, &str), witness: &Value) -> String {
    let of = &witness[key];
    match of["faceName"].as_str().filter(|face| !face.is_empty()) {
        Some(face) => format!("{name} {face}"),
        None => format!("{name} face {}", of["face"]),
    }
}

fn coordinates(point: &Value) -> String {
    let all: Vec<String> = point.as_array().into_iter().flatten().filter_map(number).collect();
    all.join(", ")
}

fn files(text: &mut String, found: &Value) {
    // Bodies are of files that the head of the page names.
    if !found["files"].is_object() {
        return;
    }
    let rows = SIDES.into_iter().filter_map(|(key, name)| {
        let file = &found["files"][key];
        let skipped = found["skipped"][key].as_array().map_or(0, Vec::len);
        let [path, sha256] = ["path", "sha256"].map(|name| file[name].as_str().map(str::to_owned));
        Some(vec![name.to_owned(), path?, sha256?, skipped.to_string()])
    });
    table(text, &["", "File", "SHA-256", "Skipped faces"], rows);
}

/// How far each face of both models is at most.
fn upper_ends(found: &Value) -> Vec<f64> {
    let faces = ["facesOfA", "facesOfB"].into_iter().filter_map(|key| found[key].as_array()).flatten();
    faces.filter_map(|face| face["upper"].as_f64()).collect()
}

/// The faces of both models, the largest lower bound first.
fn faces(text: &mut String, found: &Value) {
    let of = |key: &str| found[key].as_array().map_or(&[][..], Vec::as_slice);
    let [a, b] = [of("facesOfA"), of("facesOfB")];
    let mut all: Vec<_> =
        a.iter().map(|face| (SIDES[0], face)).chain(b.iter().map(|face| (SIDES[1], face))).collect();
    if all.is_empty() {
        return;
    }
    let lower = |face: &Value| face["lower"].as_f64().unwrap_or(f64::NEG_INFINITY);
    all.sort_by(|one, other| lower(other.1).total_cmp(&lower(one.1)));
    let rows = all.iter().take(MAX_FACES).map(|&(side, face)| {
        let witness = &face["witness"];
        vec![
            place(side, witness),
            face["state"].as_str().unwrap_or_default().to_owned(),
            number(&face["lower"]).unwrap_or_default(),
            number(&face["upper"]).unwrap_or_default(),
            coordinates(&witness[side.0]["point"]),
        ]
    });
    table(text, &["Face", "State", "At least", "At most", "At"], rows);
    if all.len() > MAX_FACES {
        let _ = writeln!(text, "<p>and {} more faces, which the JSON has</p>", all.len() - MAX_FACES);
    }
}

fn table(text: &mut String, head: &[&str], rows: impl Iterator<Item = Vec<String>>) {
    let head: Vec<String> = head.iter().map(|&cell| cell.to_owned()).collect();
    let _ = write!(text, "<table>\n<thead>{}</thead>\n<tbody>\n", table_row("th", &head));
    for row in rows {
        let _ = writeln!(text, "{}", table_row("td", &row));
    }
    text.push_str("</tbody>\n</table>\n");
}

fn table_row(name: &str, cells: &[String]) -> String {
    let cells: String =
        cells.iter().map(|cell| format!("<{name}>{}</{name}>", escape(cell.as_str()))).collect();
    format!("<tr>{cells}</tr>")
}
