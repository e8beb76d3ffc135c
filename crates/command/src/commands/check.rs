//! The command `check`.

use crate::arguments::check::CheckArguments;
use crate::failure::Failure;
use crate::input::{Input, read};
use crate::output::checked::{rows, text};
use crate::output::json::{OfAllFiles, print_json};
use crate::output::print;
use crate::output::progress::Bar;
use crate::pairs::MAX_DRAWN;
use crate::reports::{Format, NO_PICTURES, Verdict, clash_figures, print_report};
use nurbs_hausdorff::{
    BodyPair, CheckResult, CheckRules, Engine, Error, NamedModel, PairState, PreparedModel, checked_bodies,
};
use nurbs_hausdorff_pictures::Clash;
use serde_json::Value;
use std::cell::Cell;
use std::collections::HashMap;
use std::fmt::Display;
use std::path::{Path, PathBuf};

/// Compares the bodies, prints which clash, touch or come near, and returns the exit status.
pub(crate) fn run(arguments: &CheckArguments) -> Result<u8, Failure> {
    let rules = arguments.rules.as_deref().map(rules_of).transpose()?.unwrap_or_default();
    let options = arguments.options(rules);
    options.validate()?;
    let inputs = arguments.files.iter().map(|path| read(path)).collect::<Result<Vec<Input>, Failure>>()?;
    let inputs: Vec<&Input> = inputs.iter().collect();
    note_unknown_units(&inputs);
    let levels = levels(&arguments.files);
    let models = named(&levels, &inputs);
    let engine = Engine::cpu();
    let mut bar = Bar::new();
    let result = engine.check(&models, &options).monitored(&mut bar).wait()?;
    drop(bar);
    let skipped: usize = inputs.iter().map(|input| input.report.read.skipped.len()).sum();
    let is_judged = arguments.allow_skipped || skipped == 0;
    if !is_judged {
        eprintln!("undecided: {skipped} faces were left out; --allow-skipped judges the others");
    }
    let verdict = Verdict::of(result.clean.filter(|_| is_judged));
    match arguments.format() {
        Format::Json => print_json(&OfAllFiles::new("check", verdict, &result, &inputs))?,
        Format::Text => print(&text(&result, verdict))?,
        Format::Html => {
            let drawings = Drawings::new(&models, &result, options.scale_units)?;
            print_report(&rows(&result, &arguments.files, |pair| drawings.of(pair))?, Format::Html)?;
        }
        format => {
            print_report(&rows(&result, &arguments.files, |_| Ok(String::new()))?, format)?;
        }
    }
    Ok(verdict.status())
}

/// Says which of several files states no unit while another one does: nothing is scaled for it.
fn note_unknown_units(inputs: &[&Input]) {
    if let Some(stated) = inputs.iter().find_map(|input| input.prepared.unit()) {
        for input in inputs.iter().filter(|input| input.prepared.unit().is_none()) {
            let path = input.source.path();
            eprintln!("note: {path}: it states no unit, and its lengths are taken as units of {stated:?} m");
        }
    }
}

/// Returns the levels above the names of the bodies: the names of several files without folders and endings.
pub(crate) fn levels(files: &[PathBuf]) -> Vec<Option<String>> {
    let name = |path: &PathBuf| path.file_stem().unwrap_or(path.as_os_str()).to_string_lossy().into_owned();
    files.iter().map(|path| (files.len() > 1).then(|| name(path))).collect()
}

/// Returns the models with the levels above the names of their bodies.
pub(crate) fn named<'a>(levels: &'a [Option<String>], inputs: &[&'a Input]) -> Vec<NamedModel<'a>> {
    let model = |(level, input): (&'a Option<String>, &&'a Input)| NamedModel {
        name: level.as_deref(),
        model: &input.prepared,
    };
    levels.iter().zip(inputs).map(model).collect()
}

/// The pictures of clashes.
struct Drawings<'a> {
    bodies: HashMap<&'a str, PreparedModel>,
    drawn: Cell<usize>,
}

impl<'a> Drawings<'a> {
    fn new(models: &[NamedModel<'_>], result: &'a CheckResult, scale_units: bool) -> Result<Self, Failure> {
        let names = result.bodies.iter().map(|body| body.name.as_str());
        let bodies = names.zip(checked_bodies(models, scale_units)?).collect();
        Ok(Self { bodies, drawn: Cell::new(0) })
    }

    /// Returns the pictures of a clash that is not meant, of the first [`MAX_DRAWN`]; of other pairs none.
    fn of(&self, pair: &BodyPair) -> Result<String, Failure> {
        let bodies = (self.bodies.get(pair.a.as_str()), self.bodies.get(pair.b.as_str()));
        let (PairState::Clash, false, (Some(a), Some(b))) = (pair.state, pair.intended, bodies) else {
            return Ok(String::new());
        };
        if self.drawn.replace(self.drawn.get() + 1) >= MAX_DRAWN {
            return Ok(NO_PICTURES.to_owned());
        }
        clash_figures(&Clash { bodies: [a, b], names: [&pair.a, &pair.b], point: pair.point })
    }
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
    let invalid =
        |why: &dyn Display| Error::OptionInvalid { found: format!("the rules in {}: {why}", path.display()) };
    // Some editors write a byte order mark at the start of a file.
    let rules: Value =
        serde_json::from_str(text.trim_start_matches('\u{feff}')).map_err(|error| invalid(&error))?;
    if !is_by_names(&rules) {
        return Err(invalid(&"expected lists of objects by name, as intended").into());
    }
    Ok(serde_json::from_value(rules).map_err(|error| invalid(&error))?)
}

/// Returns whether rules are an object of lists of objects. Serde would also accept an array as the values of an object.
fn is_by_names(rules: &Value) -> bool {
    let are_objects = |list: &Value| list.as_array().is_none_or(|list| list.iter().all(Value::is_object));
    rules.as_object().is_some_and(|rules| rules.values().all(are_objects))
}
