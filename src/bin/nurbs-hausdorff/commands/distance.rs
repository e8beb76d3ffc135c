//! The command `distance`.

use crate::arguments::DistanceArguments;
use crate::failure::Failure;
use crate::input::{Input, is_judged};
use crate::output::json::{OfFiles, raw};
use crate::output::progress::Bar;
use crate::output::report;
use crate::pairs::{self, Comparison};
use crate::reports::{Answer, Verdict};
use nurbs_hausdorff::pictures::{PictureOptions, Place, Shown};
use nurbs_hausdorff::{Backend, Details, DistanceOptions, DistanceResult, Engine, MethodName, SurfacePoint};

/// Computes and prints the distance, and returns the exit status.
pub(crate) fn run(arguments: &DistanceArguments) -> Result<u8, Failure> {
    let options = arguments.options()?;
    options.validate()?;
    // Method certified usually ends in float64 before a GPU could be initialised.
    let staged = options.method.name() != MethodName::Certified || options.deviations;
    let uses_gpu = staged || options.backend == Backend::Gpu;
    let backend = if uses_gpu { options.backend } else { Backend::Cpu };
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

    fn compare(&self, a: &Input, b: &Input) -> Result<(Answer, PictureOptions), Failure> {
        let mut bar = Bar::new();
        let distance = self.engine.distance(&a.prepared, &b.prepared, &self.options);
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
        let gap = if result.gap > 0.0 { format!(", gap {:?}", result.gap) } else { String::new() };
        let seconds = &result.seconds;
        let answer = Answer {
            verdict: match within {
                Some(true) => Verdict::Passed,
                Some(false) => Verdict::Failed,
                None => Verdict::Undecided,
            },
            limit,
            word: word(limit, within).to_owned(),
            summary: format!("distance in [{:?}, {:?}]{gap}", result.lower, result.upper),
            findings: Vec::new(),
            text: report::text(&result),
            seconds: seconds.prepare + seconds.compile + seconds.solve,
            repeatable: result.converged || limit.is_some() && within.is_some(),
            json: raw(&OfFiles::new(&result, a, b))?,
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
        let side = |result: &DistanceResult, [from, to]: [&SurfacePoint; 2]| Shown {
            uppers: vec![result.upper],
            farthest: Some(Place { face: from.face, point: from.point, foot: to.point }),
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

/// The verdict that follows from the interval and the limit, for all methods.
fn within(result: &DistanceResult, limit: f64) -> Option<bool> {
    if result.upper <= limit {
        Some(true)
    } else if result.lower > limit {
        Some(false)
    } else {
        None
    }
}
