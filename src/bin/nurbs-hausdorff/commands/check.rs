//! The command `check`.

use crate::arguments::check::CheckArguments;
use crate::failure::Failure;
use crate::input::{Input, read};
use crate::output::checked::{rows, text};
use crate::output::json::{OfAllFiles, print_json};
use crate::output::print;
use crate::output::progress::Bar;
use crate::reports::{Format, Verdict, print_report};
use nurbs_hausdorff::{CheckRules, Engine, Error, NamedModel};
use std::path::Path;

/// Compares the bodies, prints which clash, touch or come near, and returns the exit status.
pub(crate) fn run(arguments: &CheckArguments) -> Result<u8, Failure> {
    let rules = arguments.rules.as_deref().map(rules_of).transpose()?.unwrap_or_default();
    let options = arguments.options(rules);
    options.validate()?;
    let inputs = arguments.files.iter().map(|path| read(path)).collect::<Result<Vec<Input>, Failure>>()?;
    let names: Vec<Option<String>> = match &arguments.files[..] {
        [_] => vec![None],
        files => files.iter().map(|path| Some(name_of(path))).collect(),
    };
    let model = |(name, input): (_, _)| named(name, input);
    let models: Vec<NamedModel<'_>> = names.iter().zip(&inputs).map(model).collect();
    let engine = Engine::cpu();
    let mut bar = Bar::new();
    let result = engine.check(&models, &options).monitored(&mut bar).wait()?;
    drop(bar);
    let skipped: usize = inputs.iter().map(|input| input.report.read.skipped.len()).sum();
    let is_judged = arguments.allow_skipped || skipped == 0;
    if !is_judged {
        eprintln!("undecided: {skipped} faces were left out; --allow-skipped judges the others");
    }
    let verdict = Verdict::of(result.is_clean().filter(|_| is_judged));
    match arguments.format() {
        Format::Json => print_json(&OfAllFiles::new("check", verdict, &result, &inputs))?,
        Format::Text => print(&text(&result, verdict))?,
        format => {
            print_report(&rows(&result, &arguments.files)?, format)?;
        }
    }
    Ok(verdict.status())
}

fn named<'a>(name: &'a Option<String>, input: &'a Input) -> NamedModel<'a> {
    NamedModel { name: name.as_deref(), model: &input.prepared }
}

/// Returns the name of a file without its folders and ending.
fn name_of(path: &Path) -> String {
    path.file_stem().unwrap_or(path.as_os_str()).to_string_lossy().into_owned()
}

/// Reads the rules in a file.
///
/// # Errors
/// [`Error::FileUnreadable`]; [`Error::OptionInvalid`] with what is wrong.
fn rules_of(path: &Path) -> Result<CheckRules, Failure> {
    let text = std::fs::read_to_string(path).map_err(|error| Error::FileUnreadable {
        path: path.display().to_string(),
        found: error.to_string(),
    })?;
    let invalid = |error: serde_json::Error| Error::OptionInvalid {
        found: format!("the rules in {}: {error}", path.display()),
    };
    Ok(serde_json::from_str(&text).map_err(invalid)?)
}
