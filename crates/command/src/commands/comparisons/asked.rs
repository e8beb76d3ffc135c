//! Questions about two files.

use crate::arguments::models::UnitsOfFiles;
use crate::failure::Failure;
use crate::input::{Input, read_both};
use crate::output::progress::Bar;
use nurbs_hausdorff::{Engine, Query};
use std::path::Path;

/// Checks the options, reads A and B and answers the question with a bar of its progress. Returns the answer with both
/// inputs.
pub(crate) fn answered<Q: Query>(
    question: &Q,
    files: [&Path; 2],
    units: UnitsOfFiles,
) -> Result<(Q::Answer, [Input; 2]), Failure> {
    question.validate()?;
    let inputs = read_both(files, units)?;
    let mut bar = Bar::new();
    let [a, b] = &inputs;
    let answer = question.ask(&Engine::cpu(), [&a.prepared, &b.prepared]).monitored(&mut bar).wait()?;
    drop(bar);
    Ok((answer, inputs))
}
