//! Options from any text are either refused, by their form, by their method or by their ranges,
//! or lead to an interval within small budgets.

use super::support::bytes::Bytes;
use super::support::results::{assert_numbers, distance};
use super::support::surfaces::tame_model;
use nurbs_hausdorff::{Backend, DistanceOptions, Error, Method, NamedOptions, Query};

/// The budgets: the search of a tiny model then ends in milliseconds.
const MAX_CELLS: usize = 50;
const MAX_SAMPLES: usize = 6;

/// The bytes before the text, which a pair of models is made of.
const MODEL_BYTES: usize = 64;

pub fn check(bytes: &[u8]) {
    let (models, text) = bytes.split_at(bytes.len().min(MODEL_BYTES));
    let Ok(named) = serde_json::from_slice::<NamedOptions>(text) else { return };
    let Ok(mut options) = DistanceOptions::try_from(named) else { return };
    let valid = options.validate();
    // A budget that is out of range stays so; one that is within is cut.
    let cut =
        |count: &mut usize, limit: usize| *count = if valid.is_ok() { (*count).min(limit) } else { *count };
    cut(&mut options.samples, MAX_SAMPLES);
    match &mut options.method {
        Method::Certified(budgets) => cut(budgets.max_cells.get_or_insert(MAX_CELLS), MAX_CELLS),
        Method::Hierarchy(hierarchy) => cut(&mut hierarchy.grid, MAX_SAMPLES),
        _ => {}
    }
    if options.backend == Backend::Auto {
        options.backend = Backend::Cpu;
    }
    let mut models = Bytes::new(models);
    let (Some(a), Some(b)) = (tame_model(&mut models), tame_model(&mut models)) else { return };
    match distance(&a, &b, &options) {
        Ok(result) => {
            assert!(valid.is_ok(), "{options:?}");
            assert_numbers(&result);
        }
        Err(error) => match error {
            Error::OptionOutOfRange { .. } => assert_eq!(valid, Err(error)),
            Error::NoAdapter { .. } | Error::PairBudgetExceeded { .. } => {}
            _ => panic!("{error}"),
        },
    }
}
