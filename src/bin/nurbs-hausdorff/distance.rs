//! The command `distance`.

use crate::args::DistanceArguments;
use crate::files::read;
use crate::progress::Bar;
use crate::report;
use nurbs_hausdorff::distance::{Backend, Engine, Method, PreparedModel};
use nurbs_hausdorff::{Error, Result};

/// Exit statuses with `--max`.
const WITHIN: u8 = 0;
const BEYOND: u8 = 1;
const UNDECIDED: u8 = 3;

/// Measures, prints, and returns the exit status.
pub(crate) fn run(arguments: &DistanceArguments) -> Result<u8> {
    let options = arguments.options()?;
    options.validate()?;
    let (a, b) = (read(&arguments.a)?, read(&arguments.b)?);
    // The certificate alone is float64 work: no GPU is woken for it.
    let samples = options.method == Method::Iteration || options.field;
    let backend = if samples { options.backend } else { Backend::Cpu };
    let engine = pollster::block_on(Engine::new(backend))?;
    let (a, b) = (PreparedModel::new(&a), PreparedModel::new(&b));
    let mut bar = Bar::new();
    let result = pollster::block_on(engine.distance(&a, &b, &options, &mut bar))?;
    drop(bar);
    if arguments.json {
        let json =
            serde_json::to_string(&result).map_err(|error| Error::JsonShape { found: error.to_string() })?;
        println!("{json}");
    } else {
        print!("{}", report::text(&result));
    }
    let Some(details) = result.certified.filter(|_| arguments.max.is_some()) else { return Ok(0) };
    Ok(match details.within {
        Some(true) => WITHIN,
        Some(false) => BEYOND,
        None => UNDECIDED,
    })
}
