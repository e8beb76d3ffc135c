//! A fuzzer: random pairs, with intervals checked by brute force.
//!
//! `cargo run --release --example honesty -- --pairs 10000 --seed 1`
//!
//! Half of the pairs are ordinary ones by method `certified`; half are of the families
//! of an attack, at the edge of what is accepted, by all three methods and, where there
//! is an adapter, one in 32 on the GPU. Every pair has a budget of cells, so that many searches end early with a wide
//! interval, which must be valid too. An evaluator that shares no code with the
//! library then checks that
//!
//! - no sampled point of A is farther from B than `upper`: where no near point of B is found, the
//!   point is compared with all of B in interval arithmetic, by the code of the example `verify`;
//!   what is proved farther is a violation, what is proved neither way is counted;
//! - the witness on A is at least `lower` away from every sampled and refined point
//!   of B, and is the point of A at its parameters.
//!
//! All upper bounds of the searches are audited, and each pair is measured once more with a decoy: a far square
//! in both models, moved by 0.2 to 0.999 of the lower bound found, which must not lower `upper`. Areas of the faces
//! of one pair in 32 are computed by a second rule.
//!
//! With `--trimmed`, models have trimmed faces: random loops of lines, arcs, cubics and splines with
//! holes, slivers and loops that touch, discs of three arcs under affine maps, and loops whose ends and
//! extremes lie on one level but for units in the last place, on every kind of surface, on A, on B or on both; one
//! pair in seven is a face against itself divided into several that meet in lines and corners, with slits or without,
//! and one of narrow strips within holes over the seam or at the pole of a closed surface. Points are
//! classified by counts of crossings, and points of the loops belong to the face. Where no near
//! point of B's faces is found, B's parts are left out of the proof that lie outside the loops by
//! these counts.
//!
//! With `--clearance`, least distances and overlaps are checked: half of random models, half of the
//! shapes that ship and the parts of `../shared/models` at random poses. A quarter of these poses is then
//! moved so that the models touch but for rounding, or are a small distance nearer or farther. No two
//! points are found, by samples and descents from the nearest ones, that are nearer than `lower`; the
//! witnesses are points of both models, `upper` apart; one seed in four is proved in interval arithmetic;
//! and sides of points by rays through triangles agree with the overlap.
//!
//! With `--solids`, closed shapes under affine and projective maps, of any size and place: volume, centroid, inertia,
//! area and extents are compared with a second rule and with points, sides with rays through triangles, every point
//! of a signed distance grid with its own closest point, and statistics with samples; all parts of statistics are
//! audited. Volumes in common, of a solid with itself, shifted, and with another one, are compared with counts of
//! points, the other way round, and with the volumes that they are parts of. None of the shapes may be said to meet itself. Statistics of one in eight ordinary pairs are checked in the same way.
//!
//! With `--zones`, scans with noise and bumps are fitted to such shapes in the largest distance: of 120 motions of the
//! box, drawn and descended to, none may lay all points nearer than `zone.lower`; half of the zones are of one side, inside or
//! outside.
//!
//! With `--scores`, such shapes are scored before themselves, moved a little, and before others, one in four as triangles:
//! parts of areas with like counterparts are compared with samples and cells of the other surface, and parts and lengths of
//! feature edges with samples of all sides, whose turns are those of the directions into both faces.
//!
//! With `--collapsed`, all control points of most surfaces lie on a point, on a line, in a plane or in
//! parallel rows, exactly or within rounding; otherwise one pair in 26 is of these.
//!
//! With `--reparametrized`, both models are ellipsoids, discs, surfaces of revolution, one of them divided at
//! parameter lines, or polynomial surfaces that lie on each other, or nearly so, in other parameters, with poles,
//! with ends along which a derivative vanishes, and with ends that one goes beyond; otherwise one pair in 32 is
//! of these.
//!
//! With `--facets`, at least one model of each pair is a mesh or a cloud of points: tessellations, near
//! copies, sheets, slivers and degenerate triangles. Distances to facets are compared with all of them
//! one by one; faces are compared with the whole. Every bound that drops a part is audited at points of it.
//!
//! Progress is printed every 250 pairs, violations and computations of over 10 s at once. The exit status is 1 if any
//! interval is violated or any computation takes more than 60 s.
// Prepared models that threads share hold types of wgpu, nested deeper than 128.
#![recursion_limit = "256"]
#![allow(clippy::unwrap_used, clippy::panic, reason = "a tool that stops at the first surprise")]

mod fuzzer;
#[path = "../verify/proof/mod.rs"]
#[allow(dead_code, unused_imports, reason = "the fuzzer compares single points")]
mod proof;
#[path = "../../tests/support/mod.rs"]
mod support;

use clap::Parser;
use fuzzer::check::{Outcome, check, check_attack, check_collapsed, check_reparametrized, check_trimmed};
use fuzzer::clearance::{Subjects, check_clearance};
use fuzzer::facets::check_facets;
use fuzzer::scores::check_score;
use fuzzer::solids::{Shapes, check_solid};
use fuzzer::zones::check_zone;
use nurbs_hausdorff::internals::facets::audit_facet_searches;
use nurbs_hausdorff::result::Lemma;
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::process::ExitCode;
use std::sync::Mutex;

/// Checks random pairs.
#[derive(Parser)]
struct Arguments {
    /// The number of pairs.
    #[arg(long, default_value_t = 1000)]
    pairs: u64,
    /// The seed of the first pair; the others have the following ones.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Draws models of trimmed faces.
    #[arg(long)]
    trimmed: bool,
    /// Checks clearances of models and parts at random poses.
    #[arg(long, conflicts_with_all = ["trimmed", "collapsed"])]
    clearance: bool,
    /// Checks facts, sides, grids and statistics of closed shapes under random maps.
    #[arg(long, conflicts_with_all = ["trimmed", "collapsed", "clearance", "facets", "reparametrized"])]
    solids: bool,
    /// Checks the least largest distances of scans over boxes of motions.
    #[arg(long, conflicts_with_all = ["trimmed", "collapsed", "clearance", "facets", "reparametrized", "solids"])]
    zones: bool,
    /// Checks parts of areas and of feature edges of scores.
    #[arg(long, conflicts_with_all = ["trimmed", "collapsed", "clearance", "facets", "reparametrized", "solids", "zones"])]
    scores: bool,
    /// Draws models of collapsed control nets.
    #[arg(long, conflicts_with = "trimmed")]
    collapsed: bool,
    /// Draws surfaces that lie on each other, or nearly so, in other parameters.
    #[arg(long, conflicts_with_all = ["trimmed", "collapsed", "facets", "clearance"])]
    reparametrized: bool,
    /// Draws meshes and clouds of points.
    #[arg(long, conflicts_with_all = ["trimmed", "collapsed"])]
    facets: bool,
}

/// The pairs after which progress is printed.
const REPORT: usize = 250;

/// The seconds over which a computation is printed, and over which it counts as one that
/// does not end.
const SLOW_SECONDS: f64 = 10.0;
const ENDLESS_SECONDS: f64 = 60.0;

/// What the pairs so far gave.
#[derive(Default)]
struct Summary {
    pairs: usize,
    converged: usize,
    /// The numbers of refusals by their codes.
    refused: BTreeMap<&'static str, usize>,
    endless: usize,
    slowest: f64,
    cells: Vec<usize>,
    violations: Vec<String>,
    undecided: usize,
    audited: BTreeMap<Lemma, usize>,
}

impl Summary {
    fn add(&mut self, outcome: Outcome) {
        self.pairs += 1;
        self.converged += usize::from(outcome.converged);
        if let Some(code) = outcome.refusal {
            *self.refused.entry(code).or_default() += 1;
        }
        self.endless += usize::from(outcome.seconds > ENDLESS_SECONDS);
        self.slowest = self.slowest.max(outcome.seconds);
        self.cells.push(outcome.cells);
        for violation in &outcome.violations {
            println!("{violation}");
        }
        self.undecided += outcome.undecided;
        for (lemma, count) in outcome.audited {
            *self.audited.entry(lemma).or_default() += count;
        }
        self.violations.extend(outcome.violations);
    }

    fn print(&mut self) {
        self.cells.sort_unstable();
        let Self { pairs, converged, refused, endless, slowest, cells, violations, undecided, audited } =
            self;
        println!(
            "{pairs} pairs: {converged} converged, refused {refused:?}, {} ended by the budget; median {} cells; \
             slowest {slowest:.1} s, {endless} over {ENDLESS_SECONDS} s; {} violations; {undecided} directions with points that \
             are proved neither way",
            *pairs - *converged - refused.values().sum::<usize>(),
            cells.get(cells.len() / 2).copied().unwrap_or(0),
            violations.len()
        );
        let audited: Vec<String> = audited.iter().map(|(lemma, count)| format!("{lemma}: {count}")).collect();
        println!("bounds audited by lemma: {}", audited.join(", "));
    }
}

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    let seeds = arguments.seed..arguments.seed + arguments.pairs;
    let summary = Mutex::new(Summary::default());
    let subjects = arguments.clearance.then(|| Subjects::new(true));
    let shapes = (arguments.solids || arguments.zones || arguments.scores).then(Shapes::new);
    let audit = arguments.facets.then(audit_facet_searches);
    seeds.into_par_iter().for_each(|seed| {
        // Ordinary pairs and the attack's families by turns.
        let outcome = if let Some(subjects) = &subjects {
            check_clearance(seed, subjects)
        } else if let Some(shapes) = &shapes {
            let check = match (arguments.zones, arguments.scores) {
                (true, _) => check_zone,
                (_, true) => check_score,
                _ => check_solid,
            };
            check(seed, shapes)
        } else if arguments.facets {
            check_facets(seed)
        } else if arguments.trimmed {
            check_trimmed(seed)
        } else if arguments.collapsed {
            check_collapsed(seed)
        } else if arguments.reparametrized {
            check_reparametrized(seed)
        } else if seed.is_multiple_of(2) {
            check(seed)
        } else {
            check_attack(seed)
        };
        if outcome.seconds > SLOW_SECONDS {
            println!("seed {seed} takes {:.1} s, {} cells", outcome.seconds, outcome.cells);
        }
        let mut summary = summary.lock().unwrap();
        summary.add(outcome);
        if summary.pairs.is_multiple_of(REPORT) {
            summary.print();
        }
    });
    let mut summary = summary.into_inner().unwrap();
    if let Some(audit) = audit {
        let ([parts, points], refuted) = (audit.counts(), audit.refuted());
        println!("audited: {points} points of {parts} parts, {} beyond their bounds", refuted.len());
        summary.violations.extend(refuted.into_iter().inspect(|line| println!("{line}")));
    }
    summary.print();
    ExitCode::from(u8::from(!summary.violations.is_empty() || summary.endless > 0))
}
