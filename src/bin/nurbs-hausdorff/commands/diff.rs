//! The command `diff`.

use crate::arguments::DiffArguments;
use crate::failure::Failure;
use crate::input::{is_judged, read};
use crate::output::json::{OfFiles, print_json};
use crate::output::print;
use crate::output::progress::Bar;
use crate::output::report::GAPS_DECIDE;
use nurbs_hausdorff::{DiffResult, Engine, FaceState};
use std::fmt::{Result, Write};

/// The largest number of faces of one model and state that the table lists; JSON has all.
const MAX_LISTED: usize = 100;

/// Compares the models face by face, prints the differences and returns the exit status.
pub(crate) fn run(arguments: &DiffArguments) -> std::result::Result<u8, Failure> {
    let options = arguments.options()?;
    options.validate()?;
    let (a, b) = (read(&arguments.a)?, read(&arguments.b)?);
    let engine = Engine::cpu();
    let mut bar = Bar::new();
    let mut result = engine.diff(&a.prepared, &b.prepared, &options).monitored(&mut bar).wait()?;
    drop(bar);
    if !is_judged(&a, &b, arguments.allow_skipped) {
        (result.state, result.with_gaps) = (FaceState::Undecided, FaceState::Undecided);
    }
    if arguments.json {
        print_json(&OfFiles::new(&result, &a, &b))?;
    } else {
        let mut text = String::new();
        // Writing to a string does not fail.
        let _ = lines(&mut text, &result);
        print(&text)?;
    }
    Ok(match if arguments.strict_gaps { result.with_gaps } else { result.state } {
        FaceState::Unchanged => 0,
        FaceState::Changed => 1,
        FaceState::Undecided => 3,
    })
}

fn lines(out: &mut String, result: &DiffResult) -> Result {
    let state = |state| match state {
        FaceState::Unchanged => "unchanged",
        FaceState::Undecided => "undecided",
        FaceState::Changed => "changed",
    };
    let doubt = if result.with_gaps == result.state { "" } else { GAPS_DECIDE };
    writeln!(out, "models     {} at a limit of {:?}{doubt}", state(result.state), result.limit)?;
    let listed = [FaceState::Changed, FaceState::Undecided];
    for (index, (name, faces)) in
        [("A", &result.faces_of_a), ("B", &result.faces_of_b)].into_iter().enumerate()
    {
        let [changed, undecided] = listed.map(|state| result.faces_in(state)[index].len());
        let unchanged = faces.len() - changed - undecided;
        writeln!(
            out,
            "faces of {name} {} unchanged, {} changed, {} undecided",
            unchanged, changed, undecided
        )?;
    }
    for listed in listed {
        for (index, name) in ["A", "B"].into_iter().enumerate() {
            let faces = &result.faces_in(listed)[index];
            for face in faces.iter().take(MAX_LISTED) {
                let [x, y, z] = if index == 0 { face.witness.a.point } else { face.witness.b.point };
                writeln!(
                    out,
                    "{:<10} {name} face {}: [{:?}, {:?}] at {x:?} {y:?} {z:?}",
                    state(listed),
                    face.face,
                    face.lower,
                    face.upper
                )?;
            }
            if faces.len() > MAX_LISTED {
                writeln!(out, "           and {} more faces of {name}", faces.len() - MAX_LISTED)?;
            }
        }
    }
    writeln!(out, "seconds    {:.3} prepare, {:.3} solve", result.seconds.prepare, result.seconds.solve)
}
