//! The report as JUnit's XML, which CI services show as tests.

use super::{Outcome, Row, Rows, Verdict};
use crate::failure::Failure;
use quick_xml::events::{BytesDecl, BytesText, Event};
use quick_xml::writer::Writer;
use std::io::Result;

/// Returns one suite with a case for each pair. A pair that is beyond the limit, was added or removed
/// is a failure; one that is undecided or could not be compared is an error.
///
/// # Errors
/// [`Failure::Output`], which writing to memory does not cause.
pub(super) fn report(rows: &Rows) -> std::result::Result<String, Failure> {
    let mut writer = Writer::new_with_indent(Vec::new(), b' ', 2);
    write(&mut writer, rows).map_err(Failure::Output)?;
    let mut text = String::from_utf8_lossy(&writer.into_inner()).into_owned();
    text.push('\n');
    Ok(text)
}

fn write(writer: &mut Writer<Vec<u8>>, rows: &Rows) -> Result<()> {
    let count = |kind| rows.rows.iter().filter(|row| kind_of(row) == Some(kind)).count().to_string();
    let name = format!("nurbs-hausdorff {}", rows.command);
    let (tests, failures, errors) = (rows.rows.len().to_string(), count("failure"), count("error"));
    let time = seconds(rows.rows.iter().map(seconds_of).sum());
    let attributes = [
        ("name", name.as_str()),
        ("tests", &tests),
        ("failures", &failures),
        ("errors", &errors),
        ("time", &time),
    ];
    writer.write_event(Event::Decl(BytesDecl::new("1.0", Some("UTF-8"), None)))?;
    writer.create_element("testsuites").with_attributes(attributes).write_inner_content(|writer| {
        writer
            .create_element("testsuite")
            .with_attributes(attributes)
            .write_inner_content(|writer| rows.rows.iter().try_for_each(|row| case(writer, &name, row)))?;
        Ok(())
    })?;
    Ok(())
}

fn case(writer: &mut Writer<Vec<u8>>, class: &str, row: &Row) -> Result<()> {
    let (summary, time) = (row.summary(), seconds(seconds_of(row)));
    let lines = [std::slice::from_ref(&summary), row.findings()].concat().join("\n");
    let attributes = [("name", row.path.as_str()), ("classname", class), ("time", &time)];
    writer.create_element("testcase").with_attributes(attributes).write_inner_content(|writer| {
        let (element, attributes) = match kind_of(row) {
            Some(kind) => (kind, vec![("type", row.word()), ("message", summary.as_str())]),
            None => ("system-out", Vec::new()),
        };
        let element = writer.create_element(element).with_attributes(attributes);
        element.write_text_content(BytesText::new(&lines))?;
        Ok(())
    })?;
    Ok(())
}

/// JUnit's element for what went wrong; none if nothing did.
fn kind_of(row: &Row) -> Option<&'static str> {
    match row.status() {
        0 => None,
        status if status == Verdict::Failed.status() => Some("failure"),
        _ => Some("error"),
    }
}

fn seconds_of(row: &Row) -> f64 {
    match &row.outcome {
        Outcome::Answered(answer) => answer.seconds,
        _ => 0.0,
    }
}

fn seconds(seconds: f64) -> String {
    format!("{seconds:.3}")
}
