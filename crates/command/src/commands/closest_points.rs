//! The command `closest-points`.

use crate::arguments::points::ClosestPointsArguments;
use crate::failure::Failure;
use crate::input::{Input, Points, read, read_points};
use crate::output::digits::bounded;
use crate::output::file::{is_stream, write_file};
use crate::output::json::{OfFile, print_json};
use crate::output::print;
use crate::output::progress::Bar;
use nurbs_hausdorff::{ClosestPoints, Engine, Error, RigidTransform, Signs, Skipped};
use serde::Serialize;
use std::fmt::Write as _;
use std::io::{self, Write};

/// Measures the points, and prints or writes their distances.
pub(crate) fn run(arguments: &ClosestPointsArguments) -> Result<(), Failure> {
    let options = arguments.options()?;
    let output = arguments.output.as_deref();
    let is_stream =
        output.map_or(Ok(false), |path| is_stream(path, "csv", "a file whose name ends with .csv, or -"))?;
    if is_stream && arguments.json {
        let found = "--json beside --output -: standard output has either".to_owned();
        return Err(Error::OptionInvalid { found }.into());
    }
    let input = read(&arguments.model)?;
    let points = read_points(&arguments.points)?;
    if let (Some(a), Some(b)) = (points.unit, input.prepared.unit())
        && a != b
    {
        return Err(Error::UnitsDiffer { a, b }.into());
    }
    let engine = Engine::new_blocking(options.backend)?;
    let mut bar = Bar::new();
    let found =
        engine.closest_points(&input.prepared, &points.coordinates, &options).monitored(&mut bar).wait()?;
    drop(bar);
    if is_stream {
        let mut lines = Vec::new();
        csv(&mut lines, &points.coordinates, &found).map_err(Failure::Output)?;
        return print(&String::from_utf8_lossy(&lines));
    }
    if let Some(path) = output {
        write_file(path, arguments.overwrite, |out| csv(out, &points.coordinates, &found))?;
    }
    if arguments.json {
        return print_json(&OfFile::new(
            "closest-points",
            &Lists::new(&points, &found, &input),
            &input.source,
        ));
    }
    let place = if options.transform == RigidTransform::IDENTITY { "at" } else { "before its motion at" };
    print(&text(&points.coordinates, &found, place))
}

/// Writes a line for each point, with every digit of its numbers.
fn csv(out: &mut dyn Write, points: &[f64], found: &ClosestPoints) -> io::Result<()> {
    writeln!(out, "x,y,z,signed,distance,bound,footX,footY,footZ,face,u,v")?;
    let triples = |numbers: &[f64]| numbers.as_chunks::<3>().0.to_vec();
    for (index, (point, foot)) in triples(points).iter().zip(triples(&found.feet)).enumerate() {
        let [[x, y, z], [foot_x, foot_y, foot_z]] = [*point, foot];
        let (signed, distance, bound) = (found.signed[index], found.distances[index], found.bounds[index]);
        let (face, u, v) = (found.faces[index], found.parameters[2 * index], found.parameters[2 * index + 1]);
        writeln!(
            out,
            "{x:?},{y:?},{z:?},{signed:?},{distance:?},{bound:?},{foot_x:?},{foot_y:?},{foot_z:?},{face},{u:?},{v:?}"
        )?;
    }
    Ok(())
}

/// The result as JSON, a list for each number of a point; a sign that is not decided is null.
#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct Lists<'a> {
    points: &'a crate::input::Source,
    count: usize,
    signs: Signs,
    decided_on_gpu: usize,
    distances: &'a [f64],
    bounds: &'a [f64],
    signed: &'a [f64],
    feet: &'a [f64],
    faces: &'a [u32],
    parameters: &'a [f64],
    skipped: &'a [Skipped],
}

impl<'a> Lists<'a> {
    fn new(points: &'a Points, found: &'a ClosestPoints, input: &'a Input) -> Self {
        Self {
            points: &points.source,
            count: found.distances.len(),
            signs: found.signs,
            decided_on_gpu: found.decided_on_gpu,
            distances: &found.distances,
            bounds: &found.bounds,
            signed: &found.signed,
            feet: &found.feet,
            faces: &found.faces,
            parameters: &found.parameters,
            skipped: &input.report.read.skipped,
        }
    }
}

/// Returns what is printed; `place` stands before the coordinates of points.
fn text(points: &[f64], found: &ClosestPoints, place: &str) -> String {
    let mut text = String::new();
    // Writing to a string does not fail.
    let _ = lines(&mut text, points, found, place);
    text
}

fn lines(out: &mut String, points: &[f64], found: &ClosestPoints, place: &str) -> std::fmt::Result {
    let order = |one: &usize, other: &usize| found.distances[*one].total_cmp(&found.distances[*other]);
    let indices = 0..found.distances.len();
    let mut end = |name: &str, index: Option<usize>| {
        let Some(index) = index else { return Ok(()) };
        let (distance, bound) = (found.distances[index], found.bounds[index]);
        let [x, y, z] = [0, 1, 2].map(|axis| points[3 * index + axis]);
        let distance = bounded(distance, [(distance - bound).max(0.0), distance + bound]);
        writeln!(
            out,
            "{name} {distance} of point {index}, {place} {x:?} {y:?} {z:?}, to face {}",
            found.faces[index]
        )
    };
    end("farthest  ", indices.clone().max_by(order))?;
    end("nearest   ", indices.min_by(order))?;
    let negative = found.signed.iter().filter(|signed| **signed < 0.0).count();
    // A sign that is not decided is that of 0 or of NaN.
    let decided = found.signed.iter().filter(|signed| signed.abs() > 0.0).count();
    let undecided = found.signed.len() - decided;
    let side = match found.signs {
        Signs::Solid => "inside the solid",
        _ => "behind the faces",
    };
    write!(out, "points     {}, {negative} {side}, {undecided} without a sign", found.distances.len())?;
    match found.decided_on_gpu {
        0 => writeln!(out),
        decided => writeln!(out, ", {decided} decided on the GPU"),
    }
}
