//! The command `distance`.

use crate::arguments::comparisons::DistanceArguments;
use crate::arguments::models::UnitsOfFiles;
use crate::failure::Failure;
use crate::input::{Input, is_judged};
use crate::output::digits::number;
use crate::output::headline::{self, GAPS_DECIDE};
use crate::output::json::{Asked, OfFiles, raw};
use crate::output::progress::Bar;
use crate::output::report;
use crate::pairs::{self, Comparison};
use crate::reports::{Answer, Verdict};
use nurbs_hausdorff::{
    Backend, Details, DistanceOptions, DistanceResult, Engine, FarthestPoint, KnownDeviation, Query,
    SurfacePoint,
};
use nurbs_hausdorff_pictures::PictureOptions;

/// Computes and prints the distance, and returns the exit status.
pub(crate) fn run(arguments: &DistanceArguments) -> Result<u8, Failure> {
    let options = arguments.options()?;
    options.validate()?;
    let backend = if options.may_use_gpu() { options.backend } else { Backend::Cpu };
    let comparison = Distance { arguments, options, engine: Engine::new_blocking(backend)? };
    pairs::run(&arguments.pair, &arguments.reporting, &comparison)
}

struct Distance<'a> {
    arguments: &'a DistanceArguments,
    options: DistanceOptions,
    engine: Engine,
}

impl Comparison for Distance<'_> {
    const NAME: &'static str = "distance";

    fn options(&self) -> String {
        let DistanceArguments { limit, allow_skipped, strict_gaps, .. } = self.arguments;
        format!("{:?} {limit:?} {allow_skipped} {strict_gaps}", self.options)
    }

    fn units(&self) -> UnitsOfFiles {
        self.arguments.placement.units
    }

    fn compare(&self, a: &Input, b: &Input) -> Result<(Answer, PictureOptions), Failure> {
        let mut bar = Bar::new();
        let distance = self.options.ask(&self.engine, [&a.prepared, &b.prepared]);
        let mut result = distance.monitored(&mut bar).wait()?;
        drop(bar);
        let limit = self.arguments.limit;
        let is_judged = limit.is_none() || is_judged(a, b, self.arguments.allow_skipped);
        if !is_judged {
            forget_verdict(&mut result);
        }
        let within = match (limit, result.with_gaps.within) {
            (None, _) => Some(true),
            _ if !is_judged => None,
            (_, within) if self.arguments.strict_gaps => within,
            (Some(limit), _) => within(&result, limit),
        };
        let verdict = Verdict::of(within);
        let word = word(limit, within);
        let found = headline::distance(&result, limit, a, b);
        let gap = if result.gap > 0.0 { format!(", gap {}", number(result.gap)) } else { String::new() };
        let doubt = doubt(&result, limit.filter(|_| is_judged));
        let first = limit.map_or("distance ".to_owned(), |limit| headline::verdict(word, limit));
        let asked = Asked {
            command: Self::NAME,
            verdict: limit.map(|_| verdict),
            limit,
            symmetric: Some(self.options.symmetric),
        };
        let answer = Answer {
            verdict,
            limit,
            judged: false,
            word: word.to_owned(),
            text: format!("{first}{found}{doubt}\n{}", report::text(&result)),
            summary: format!("{found}{gap}{doubt}"),
            findings: result.hint.iter().map(|hint| format!("hint: {hint}")).collect(),
            seconds: result.seconds.prepare + result.seconds.compile + result.seconds.solve,
            repeatable: result.converged || limit.is_some() && within.is_some(),
            json: raw(&OfFiles::new(asked, &result, a, b))?,
            figures: String::new(),
        };
        Ok((answer, self.shown(&result)))
    }
}

impl Distance<'_> {
    /// The models whose points were measured, with the farthest ones.
    fn shown(&self, result: &DistanceResult) -> PictureOptions {
        let (forward, reverse) = match (&result.forward, &result.reverse) {
            (Some(forward), Some(reverse)) => (&**forward, Some(reverse)),
            _ => (result, None),
        };
        let side = |result: &DistanceResult, [from, to]: [&SurfacePoint; 2]| KnownDeviation {
            uppers: vec![result.upper],
            farthest: Some(FarthestPoint { face: from.face, point: from.point, foot: to.point }),
        };
        PictureOptions {
            allowed: self.arguments.limit,
            a: Some(side(forward, [&forward.witness.a, &forward.witness.b])),
            b: reverse.map(|reverse| side(reverse, [&reverse.witness.b, &reverse.witness.a])),
            scale_units: self.options.scale_units,
            transform: self.options.transform,
        }
    }
}

/// Returns the end of a line with a verdict that does not hold for every reading of the files.
fn doubt(result: &DistanceResult, limit: Option<f64>) -> &'static str {
    let is_doubtful = limit.is_some_and(|limit| within(result, limit) != result.with_gaps.within);
    if is_doubtful { GAPS_DECIDE } else { "" }
}

fn word(limit: Option<f64>, within: Option<bool>) -> &'static str {
    match (limit, within) {
        (None, _) => "computed",
        (_, Some(true)) => "within",
        (_, Some(false)) => "beyond",
        (_, None) => "undecided",
    }
}

/// Takes the verdict out of a result, and out of those of both directions.
fn forget_verdict(result: &mut DistanceResult) {
    if let Details::Certified(details) = &mut result.details {
        details.within = None;
    }
    result.with_gaps.within = None;
    for direction in [&mut result.forward, &mut result.reverse].into_iter().flatten() {
        forget_verdict(direction);
    }
}

/// Returns the verdict that follows from the interval and the limit, for all methods.
pub(crate) fn of_limit(result: &DistanceResult, limit: f64) -> Verdict {
    Verdict::of(within(result, limit))
}

fn within(result: &DistanceResult, limit: f64) -> Option<bool> {
    if result.upper <= limit {
        Some(true)
    } else if result.lower > limit {
        Some(false)
    } else {
        None
    }
}
