//! Two files, or the files of two directories, compared by one command.

mod earlier;
mod tree;

use crate::arguments::models::{Pair, Reporting, UnitsOfFiles};
use crate::failure::Failure;
use crate::input::{File, Input, STANDARD_STREAM, in_units, refuse_one_stream};
use crate::output::{json::print_json, print};
use crate::reports::{Answer, Format, Outcome, Row, Rows, Verdict, figures, print_report};
use earlier::Earlier;
use nurbs_hausdorff::{Error, one_line};
use nurbs_hausdorff_pictures::PictureOptions;
use std::cell::Cell;
use std::path::Path;

/// The largest number of pairs with pictures in one report, which a pair makes some 500 KB longer.
pub(crate) const MAX_DRAWN: usize = 20;

/// What a command does with a pair.
pub(crate) trait Comparison {
    /// The command's name.
    const NAME: &'static str;

    /// Everything but the files and their units on which the answer depends.
    fn options(&self) -> String;

    /// The units of the files.
    fn units(&self) -> UnitsOfFiles;

    /// Compares two models; returns what pictures of them show, too.
    ///
    /// # Errors
    /// Those of the computation.
    fn compare(&self, a: &Input, b: &Input) -> Result<(Answer, PictureOptions), Failure>;
}

/// The pairs of a report that have pictures: those with a section of their own.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Drawn {
    None,
    NotPassed,
    All,
}

/// Compares, prints and returns the exit status.
///
/// # Errors
/// Those of a pair of files, unless the format has a place for them; of a directory beside a file.
pub(crate) fn run<C: Comparison>(pair: &Pair, reporting: &Reporting, comparison: &C) -> Result<u8, Failure> {
    let Pair { a, b } = pair;
    refuse_one_stream([a, b])?;
    let format = reporting.format();
    let draws = match format {
        Format::Html if a.is_dir() => Drawn::NotPassed,
        Format::Html => Drawn::All,
        _ => Drawn::None,
    };
    let earlier = reporting.reuse.as_deref().map(Earlier::new).transpose()?;
    let comparer = Comparer { comparison, earlier, draws, drawn: Cell::new(0) };
    let rows = match (a.is_dir(), b.is_dir()) {
        (true, true) => tree::pairs(a, b, reporting.include.as_deref())?
            .into_iter()
            .map(|pair| comparer.row(pair.path, pair.a.as_deref(), pair.b.as_deref()))
            .collect(),
        (false, false) if format.is_report() => {
            vec![comparer.row(b.display().to_string(), Some(a), Some(b))]
        }
        (false, false) => {
            if reporting.include.is_some() {
                let found = "found --include with two files, expected two directories".to_owned();
                return Err(Error::OptionInvalid { found }.into());
            }
            let answer = comparer.answer(a, b)?;
            match format {
                Format::Json => print_json(&answer.json)?,
                _ => print(&answer.text)?,
            }
            return Ok(answer.verdict.status());
        }
        _ => {
            present(a)?;
            present(b)?;
            let found = format!("{} and {} are a directory and a file", a.display(), b.display());
            return Err(Error::OptionInvalid { found }.into());
        }
    };
    let names = [a, b].map(|path| one_line(&path.display().to_string()));
    let fields = [("Part", reporting.part.clone()), ("Operator", reporting.operator.clone())];
    print_report(&Rows::new(C::NAME, names, rows, fields), format)
}

/// Fails if there is neither a file nor a directory.
fn present(path: &Path) -> Result<(), Error> {
    let unreadable = |error: std::io::Error| Error::FileUnreadable {
        path: path.display().to_string(),
        found: error.to_string(),
    };
    match path.as_os_str() == STANDARD_STREAM {
        true => Ok(()),
        false => path.metadata().map(drop).map_err(unreadable),
    }
}

struct Comparer<'a, C> {
    comparison: &'a C,
    earlier: Option<Earlier>,
    draws: Drawn,
    /// The number of pairs with pictures so far.
    drawn: Cell<usize>,
}

impl<C: Comparison> Comparer<'_, C> {
    fn row(&self, path: String, a: Option<&Path>, b: Option<&Path>) -> Row {
        let outcome = match (a, b) {
            (Some(a), Some(b)) => match self.answer(a, b) {
                Ok(answer) => Outcome::Answered(Box::new(answer)),
                Err(failure) => Outcome::Failed {
                    code: failure.code().to_owned(),
                    message: one_line(&failure.to_string()),
                },
            },
            (None, _) => Outcome::Added,
            (_, None) => Outcome::Removed,
        };
        Row { path: one_line(&path), outcome }
    }

    fn answer(&self, a: &Path, b: &Path) -> Result<Answer, Failure> {
        let (a, b) = (File::open(a)?, File::open(b)?);
        let draws = if self.drawn.get() < MAX_DRAWN { self.draws } else { Drawn::None };
        let units = self.comparison.units();
        let options = format!("{} {units:?} {draws:?}", self.comparison.options());
        let key = earlier::key(C::NAME, &options, [&a, &b]);
        let known = self.earlier.as_ref().and_then(|earlier| earlier.find(&key));
        let answer = match known {
            Some(answer) => answer,
            None => {
                let [a, b] = in_units([a.read()?, b.read()?], units)?;
                let answer = self.computed(&a, &b, draws)?;
                if let Some(earlier) = &self.earlier {
                    earlier.keep(&key, &answer)?;
                }
                answer
            }
        };
        if !answer.figures.is_empty() {
            self.drawn.set(self.drawn.get() + 1);
        }
        Ok(answer)
    }

    fn computed(&self, a: &Input, b: &Input, draws: Drawn) -> Result<Answer, Failure> {
        let (mut answer, shown) = self.comparison.compare(a, b)?;
        if draws == Drawn::All || draws == Drawn::NotPassed && answer.verdict != Verdict::Passed {
            answer.figures = figures(a, b, &shown)?;
        }
        Ok(answer)
    }
}
